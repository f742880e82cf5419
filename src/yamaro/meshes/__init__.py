"""Mesh files: their formats by their bytes, their bounds, and what is in them."""
