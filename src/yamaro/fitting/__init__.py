"""Shapes worked out from meshes: primitives, convex pieces, spheres, lighter meshes."""
