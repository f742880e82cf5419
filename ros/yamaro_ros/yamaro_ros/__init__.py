"""Yamaro in ROS 2: robots for launch files, and for nodes that are running."""
