"""Files, packages and meshes: finding and reading them, as far as that is permitted."""
