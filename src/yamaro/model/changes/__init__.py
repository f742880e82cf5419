"""What changed from one robot to another, by meaning."""
