"""Configurations for mjlab 1.6, which trains policies in MuJoCo Warp.

Source: the package mjlab 1.6.0, https://pypi.org/project/mjlab/: `mjlab.entity`, `mjlab.actuator`.
"""
