"""Shapes worked out for the meshes of a whole robot: `yamaro fit`."""
