"""The features of a robot, read from each format by itself."""
