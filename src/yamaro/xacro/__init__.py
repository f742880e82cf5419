"""xacro's language: what a `.xacro` file says, and the elements it expands to."""
