"""The guards of safe mode."""
