"""`yamaro diff`: what changed from one robot to another, from files and from git."""
