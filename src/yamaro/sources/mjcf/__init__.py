"""MJCF, the format of MuJoCo, read into the model as MuJoCo's compiler reads it.

Source: https://mujoco.readthedocs.io/en/stable/XMLreference.html.
"""
