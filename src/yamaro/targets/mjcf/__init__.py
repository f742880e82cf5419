"""MJCF, the format of MuJoCo, in the style of MuJoCo Menagerie.

Source: https://mujoco.readthedocs.io/en/stable/XMLreference.html.
"""
