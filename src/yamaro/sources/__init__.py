"""Sources: robots in other formats than URDF, read into the model."""
