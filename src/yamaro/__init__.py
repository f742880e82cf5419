"""Yamaro compiles YAML robot descriptions to URDF, or any other XML."""
