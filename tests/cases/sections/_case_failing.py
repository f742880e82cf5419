"""Fails when loaded."""

value = {}["missing"]
