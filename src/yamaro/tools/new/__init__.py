"""New packages of robots: a folder that pip and colcon can both install."""
