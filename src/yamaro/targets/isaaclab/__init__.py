"""Configurations for Isaac Lab, which trains policies in Isaac Sim and in Newton.

Sources: the package isaaclab 3.0.0, https://pypi.org/project/isaaclab/: `isaaclab.actuators`,
`isaaclab.assets`; for the names of limits in 2.x
https://isaac-sim.github.io/IsaacLab/v2.3.2/source/api/lab/isaaclab.actuators.html.
"""
