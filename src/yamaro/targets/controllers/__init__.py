"""The file of parameters with which ROS 2 starts the controllers of ros2_control.

What a controller needs and the robot knows, such as joints, interfaces and the size of wheels, is
written; the rest is as the section `controllers` gives it.
"""
