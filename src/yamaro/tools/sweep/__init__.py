"""Sweeps: builds many variants of a robot, and keeps a table of what they are."""
