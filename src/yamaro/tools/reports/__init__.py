"""Findings of several files, as programs read them: `yamaro check --format`."""
