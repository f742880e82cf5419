"""The files around `config/`: those of a package of ament, the launch files, a view for RViz."""

from __future__ import annotations

from ..output import MARK

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

LAUNCHES = (
    *("demo", "move_group", "moveit_rviz", "rsp", "spawn_controllers"),
    *("static_virtual_joint_tfs", "warehouse_db"),
)
"""The launch files, each of which calls the function of its name in moveit_configs_utils."""
_DEPENDS = (
    *("controller_manager", "hardware_interface", "moveit_configs_utils", "moveit_kinematics"),
    *("moveit_planners", "moveit_ros_move_group", "moveit_ros_visualization"),
    *("moveit_simple_controller_manager", "robot_state_publisher", "rviz2", "tf2_ros", "xacro"),
)
_PACKAGES = {
    "position_controllers/GripperActionController": "gripper_controllers",
    "effort_controllers/GripperActionController": "gripper_controllers",
    "parallel_gripper_action_controller/GripperActionController": "parallel_gripper_controller",
}
"""The packages of plugins that are not named as the plugin says."""


def package_xml(package: str, robot: str, plugins: Iterable[str]) -> str:
    """Return the manifest, which depends on the controllers too."""
    from ...xml.values import escaped_text

    controllers = {_PACKAGES.get(each, each.partition("/")[0]) for each in plugins}
    depends = "\n".join(
        f"  <exec_depend>{name}</exec_depend>" for name in sorted({*_DEPENDS, *controllers})
    )
    return f"""<?xml version="1.0"?>
<!-- {MARK} -->
<package format="3">
  <name>{package}</name>
  <version>0.1.0</version>
  <description>The MoveIt configuration of {escaped_text(robot)}</description>
  <maintainer email="robots@example.com">The maintainers of {escaped_text(robot)}</maintainer>
  <license>TODO: license</license>

  <buildtool_depend>ament_cmake</buildtool_depend>

{depends}

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""


def cmake_lists(package: str, *, has_assets: bool) -> str:
    """Return what installs the files."""
    folders = "assets config launch" if has_assets else "config launch"
    return f"""# {MARK}
cmake_minimum_required(VERSION 3.20)
project({package} NONE)
find_package(ament_cmake REQUIRED)

install(DIRECTORY {folders} DESTINATION share/${{PROJECT_NAME}})
install(FILES .setup_assistant DESTINATION share/${{PROJECT_NAME}})

ament_package()
"""


def launch_file(name: str, stem: str, package: str) -> str:
    """Return a launch file."""
    function = f"generate_{name}_launch"
    return f"""# {MARK}
from moveit_configs_utils import MoveItConfigsBuilder
from moveit_configs_utils.launches import {function}


def generate_launch_description():
    builder = MoveItConfigsBuilder({stem!r}, package_name={package!r})
    return {function}(builder.to_moveit_configs())
"""


def setup_assistant(stem: str, package: str) -> dict[str, object]:
    """Return where the builder, and the setup assistant, find URDF and SRDF."""
    return {
        "moveit_setup_assistant_config": {
            "urdf": {"package": package, "relative_path": f"config/{stem}.urdf"},
            "srdf": {"relative_path": f"config/{stem}.srdf"},
            "package_settings": {
                "author_name": "The maintainers",
                "author_email": "robots@example.com",
            },
        }
    }


def rviz(root: str) -> dict[str, object]:
    """Return a view of RViz with the panel for motion planning, seen from a fixed frame."""
    displays: list[object] = [
        {"Class": "rviz_default_plugins/Grid", "Name": "Grid", "Value": True},
        {
            "Class": "moveit_rviz_plugin/MotionPlanning",
            "Name": "MotionPlanning",
            "Planning Scene Topic": "monitored_planning_scene",
            "Robot Description": "robot_description",
            "Value": True,
        },
    ]
    return {
        "Panels": [{"Class": "rviz_common/Displays", "Name": "Displays"}],
        "Visualization Manager": {
            "Displays": displays,
            "Global Options": {"Fixed Frame": root},
            "Tools": [
                {"Class": f"rviz_default_plugins/{name}"}
                for name in ("Interact", "MoveCamera", "Select")
            ],
            "Value": True,
            "Views": {
                "Current": {
                    "Class": "rviz_default_plugins/Orbit",
                    "Distance": 2.0,
                    "Name": "Current View",
                    "Pitch": 0.5,
                    "Target Frame": root,
                    "Yaw": 0.5,
                }
            },
        },
        "Window Geometry": {"Height": 900, "Width": 1300},
    }
