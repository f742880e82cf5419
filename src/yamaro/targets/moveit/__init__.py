"""A MoveIt configuration package: what MoveItConfigsBuilder of moveit_configs_utils looks for.

The robot, its SRDF, and the files of limits, solvers and controllers are in `config/`; the files of
a package of ament are beside it, and launch files that call those of moveit_configs_utils.
"""
