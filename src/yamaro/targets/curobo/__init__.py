"""cuRobo's configuration of a robot, beside its URDF.

The entry is `writer.write`.
"""
