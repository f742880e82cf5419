"""What the blocks of ros2_control offer controllers: the interfaces of joints and of sensors."""

from __future__ import annotations

from ...model.joint import SINGLE
from ...model.values import attribute_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.robot import Robot
    from ...xml.tree import Element

IMU, FORCE_TORQUE = "imu", "force_torque"
_INTERFACES = {
    IMU: {
        *(f"orientation.{axis}" for axis in "xyzw"),
        *(f"angular_velocity.{axis}" for axis in "xyz"),
        *(f"linear_acceleration.{axis}" for axis in "xyz"),
    },
    FORCE_TORQUE: {f"{what}.{axis}" for what in ("force", "torque") for axis in "xyz"},
}
"""The state interfaces that the broadcasters of sensors read."""


class Reading:
    """A sensor in a block.

    Attributes:
        name: its name.
        type: `imu` or `force_torque`; "" if its interfaces are those of neither.
        frame: the frame that it measures in, or "".
    """

    __slots__ = ("frame", "name", "type")

    def __init__(self, robot: Robot, element: Element) -> None:
        """Read a `<sensor>`; what the block does not say of its frame, the robot may know."""
        self.name = attribute_text(element, "name") or ""
        states = {attribute_text(e, "name") for e in element.elements()}
        self.type = next((kind for kind, names in _INTERFACES.items() if names <= states), "")
        frames = [
            each.text().strip()
            for each in element.elements()
            if each.name == "param" and attribute_text(each, "name") == "frame_id"
        ]
        sensor = robot.sensors.get(self.name)
        if not frames and sensor is not None:
            joint = robot.joints.get(sensor.joint or "")
            frames = [sensor.frame or (joint.child if joint is not None else "")]
        self.frame = frames[0] if frames else ""


class Hardware:
    """The interfaces that controllers may take.

    Attributes:
        commands: those that each driven joint takes, the usual one first.
        sensors: the sensors that are read, by name.
        is_assumed: whether nothing says what drives the joints.
    """

    __slots__ = ("commands", "is_assumed", "sensors")

    def __init__(self, robot: Robot) -> None:
        """Read the blocks of a robot, which those of the section `control` are among."""
        self.commands: dict[str, tuple[str, ...]] = {}
        self.sensors: dict[str, Reading] = {}
        blocks = [each for each in robot.element.elements() if each.name == "ros2_control"]
        self.is_assumed = not blocks
        found: dict[str, tuple[str, ...]] = {}
        for block in blocks:
            for child in block.elements():
                name = attribute_text(child, "name") or ""
                if child.name == "joint":
                    found[name] = (*found.get(name, ()), *_commands(child))
                elif child.name == "sensor":
                    self.sensors[name] = Reading(robot, child)
        for joint in robot.joints.values():
            if joint.type not in SINGLE or joint.mimic is not None:
                continue
            if self.is_assumed:
                actuator = robot.actuators.get(joint.name)
                found[joint.name] = ("position",) if actuator is None else actuator.commands
            if found.get(joint.name):
                self.commands[joint.name] = found[joint.name]


def _commands(joint: Element) -> list[str]:
    return [
        attribute_text(each, "name") or ""
        for each in joint.elements()
        if each.name == "command_interface"
    ]
