"""SRDF, as MoveIt reads it: groups, named states, end effectors, and pairs that never collide.

Source: the documentation of SRDF, http://wiki.ros.org/srdf, and how MoveIt's setup assistant finds
pairs of links, `compute_default_collisions` of moveit_setup_assistant.
"""
