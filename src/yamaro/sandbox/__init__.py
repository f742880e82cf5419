"""Deadlines, the jail, and its answers."""
