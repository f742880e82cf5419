"""SDFormat 1.2 to 1.12: models of Gazebo and Drake, read into the model.

Links keep their frames: where a joint turns about an axis that does not pass through the frame of
its child, a link without mass stands at the joint. Nested and included models become part of the
one robot. What the model does not hold is kept in blocks `sdf`: of its link, joint or the robot.

Sources: the specification, http://sdformat.org/spec; its documentation, "Pose Frame Semantics:
Specification for Model Kinematics" and "Model Composition: Proposed Behavior".
"""
