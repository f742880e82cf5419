"""A robot as a scene: links that hang on joints, with shapes at poses, each with its origin."""
