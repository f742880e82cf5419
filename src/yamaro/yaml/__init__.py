"""libyaml's events as nodes with places."""
