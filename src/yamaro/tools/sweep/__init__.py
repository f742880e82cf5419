"""Sweeps: many variants of a robot, and a table of them."""
