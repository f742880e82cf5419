"""URDF and xacro to Yamaro sources: `yamaro migrate`."""
