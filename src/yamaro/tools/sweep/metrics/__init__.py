"""The metrics that `yamaro sweep` knows."""
