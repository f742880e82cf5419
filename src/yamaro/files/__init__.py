"""Where files, packages and meshes are found, and what may be read."""
