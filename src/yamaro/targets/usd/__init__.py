"""USD with physics (UsdPhysics), as Isaac Sim, Newton and Omniverse read it.

The bodies lie flat under the robot, each where it is while all joints are at 0. Angles are in
degrees, and most numbers of UsdPhysics have single precision, both as the format has it.

Source: the documentation of UsdPhysics, https://openusd.org/release/api/usd_physics_page_front.html.
"""
