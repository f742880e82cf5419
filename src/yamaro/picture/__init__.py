"""Draws robots without a display: `yamaro picture`."""
