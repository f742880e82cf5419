"""Output tree to URDF; knows no YAML and no scopes."""
