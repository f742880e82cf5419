"""Deadlines, the jail, and what comes back from it."""
