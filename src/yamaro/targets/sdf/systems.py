"""Systems of Gazebo (gz-sim) that drive the joints as the actuators of the robot say.

A position is held by a PID controller of efforts without its I, which has the gain 0.1 by default;
its D is of the position alone, while the target stands still. A velocity is held by efforts too.
All listen to topics of their own: `/model/MODEL/joint/JOINT/0/cmd_pos`, `…/cmd_vel` without the
number, `…/cmd_force`.

Source: gz-sim 8, src/systems: joint_position_controller, joint_controller, apply_joint_force.
"""

from __future__ import annotations

from ...model.joint import SINGLE
from ...model.kinematics import joint_positions
from ...model.positions import home_positions
from ...model.values import content
from ..elements import element, given
from ..gains import EFFORT, POSITION, Gains

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..elements import Attributes

CONTROLLERS = {
    POSITION: ("gz-sim-joint-position-controller-system", "JointPositionController"),
    EFFORT: ("gz-sim-apply-joint-force-system", "ApplyJointForce"),
    "": ("gz-sim-joint-controller-system", "JointController"),
}
"""The file and the class of the system for each command; the last one is for velocities."""
GREATEST = 1e9
"""The effort, in N·m or N, of joints without a limit: Gazebo's default is 1000."""
ROS = "ros2_control"


def joint_systems(
    robot: Robot,
    names: Mapping[str, str],
    gains: Gains,
    efforts: Mapping[str, float | None],
    plugins: Iterable[Element],
) -> list[Element]:
    """Return a system for each actuator, except for joints that a plugin of the robot drives.

    Args:
        robot: the robot.
        names: of the joints in SDFormat, by those in the robot.
        gains: gives the gains that are not given.
        efforts: the greatest effort of each joint in SDFormat.
        plugins: those that the robot has.
    """
    driven: set[str | None] = set()
    for plugin in plugins:
        driven.update(content(each) for each in plugin.elements() if each.name == "joint_name")
        if ROS in str(plugin.attributes.get("filename")):
            driven.update(names.get(j) for control in robot.controls for j in control.joints)
    found = []
    positions = joint_positions(robot, home_positions(robot))
    for name, actuator in robot.actuators.items():
        joint = robot.joints.get(name)
        is_moved = joint is not None and joint.type in SINGLE and joint.mimic is None
        if joint is None or not is_moved or names.get(name) in driven or name not in efforts:
            continue
        command, effort = actuator.command, efforts[name]
        file, system = CONTROLLERS.get(command, CONTROLLERS[""])
        values: list[tuple[str, float | str | None]] = [("joint_name", names[name])]
        if command != EFFORT:
            kd = 0.0
            if command == POSITION:
                kp = actuator.kp if actuator.kp is not None else gains.of_position(joint)
                kd = actuator.kd if actuator.kd is not None else gains.damping(joint, kp)
                home = positions.get(name)
                values.append(("initial_position", home if isinstance(home, float) else 0.0))
            else:
                kp = gains.of_velocity(joint, actuator)
                values.append(("use_force_commands", "true"))
            most = effort if effort is not None and effort < GREATEST else GREATEST
            values += [("p_gain", kp), ("i_gain", 0.0), ("d_gain", kd)]
            values += [("cmd_max", most), ("cmd_min", -most)]
        attributes: Attributes = {"filename": file, "name": f"gz::sim::systems::{system}"}
        found.append(element("plugin", attributes, children=given(*values), owner=actuator))
    return found
