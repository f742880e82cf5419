"""xacro files as Yamaro sources."""
