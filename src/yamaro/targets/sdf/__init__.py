"""SDFormat 1.9, 1.11 and 1.12, as Gazebo and Drake read it.

Nothing is lumped together: each link with mass is a `<link>`, each link without mass a `<frame>` in
the link that holds it. A joint's pose is relative to its parent and a link's to its joint, so that
the numbers are those of the robot's description.

Source: the specification, http://sdformat.org/spec, and its documentation of frames, "Pose Frame
Semantics: Specification for Model Kinematics".
"""
