"""Shows a robot in RViz: ros2 launch yamaro_ros display.launch.py model:=robot.yaml ."""

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition, UnlessCondition
from launch.logging import get_logger
from launch.substitutions import LaunchConfiguration, SubstitutionFailure
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from yamaro_ros.robots import RobotError, build_robot, split_words

PACKAGE = "yamaro_ros"
ARGUMENTS = {
    "model": (None, "the file of the robot: YAML, URDF or xacro"),
    "args": ("", "variables of the robot, as in 'length:=0.5 side:=left'"),
    "trust": ("trust", "how far the file is trusted: trust, jail or safe"),
    "gui": ("true", "whether to show sliders for the joints"),
    "rviz": ("true", "whether to start RViz"),
    "rvizconfig": (
        f"{get_package_share_directory(PACKAGE)}/rviz/display.rviz",
        "the configuration of RViz",
    ),
    "reload": ("false", "whether to build the robot again at each save"),
}


def build(context):
    """Return the robot that the arguments describe, and its variables as words."""

    def value(name):
        return LaunchConfiguration(name).perform(context)

    logger = get_logger("yamaro")
    try:
        words = split_words(value("args"))
        robot = build_robot(
            value("model"),
            words=words,
            trust=value("trust"),
            has_root=True,
            warn=logger.warning,
            inform=logger.info,
        )
    except RobotError as error:
        raise SubstitutionFailure(f"{value('model')} cannot be built:\n{error}") from None
    return robot, words


def make_nodes(context):
    """Build the robot, and return the nodes that show it."""
    robot, words = build(context)
    roots = robot.robot.roots
    frame = ["-f", roots[0].name] if roots else []
    gui = LaunchConfiguration("gui")
    model, trust = LaunchConfiguration("model"), LaunchConfiguration("trust")
    return [
        Node(
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[{"robot_description": ParameterValue(robot.xml(), value_type=str)}],
        ),
        Node(
            package="joint_state_publisher_gui",
            executable="joint_state_publisher_gui",
            condition=IfCondition(gui),
        ),
        Node(
            package="joint_state_publisher",
            executable="joint_state_publisher",
            condition=UnlessCondition(gui),
        ),
        Node(
            package="rviz2",
            executable="rviz2",
            arguments=["-d", LaunchConfiguration("rvizconfig"), *frame],
            condition=IfCondition(LaunchConfiguration("rviz")),
        ),
        Node(
            package=PACKAGE,
            executable="reload",
            arguments=[model, *words, "--trust", trust],
            output="screen",
            condition=IfCondition(LaunchConfiguration("reload")),
        ),
    ]


def generate_launch_description():
    """Return the arguments, and what is made of them."""
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, (default, description) in ARGUMENTS.items()
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=make_nodes)])
