"""URDF, which a robot is in as it is."""
