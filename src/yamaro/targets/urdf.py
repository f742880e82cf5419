"""What URDF cannot hold of a robot; said only where URDF was asked for by name."""

from __future__ import annotations

from .output import APPROXIMATED, LOST, Loss
from .shared_losses import cones, lost_sections

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.extras import Noted
    from ..model.robot import Robot
    from ..model.sensors import Sensor

GAZEBO_HINT = "--gazebo also writes it for Gazebo"


def losses_of(robot: Robot, has_gazebo: bool) -> list[Loss]:
    """Return what is lost of a robot in URDF, except for loops, which lowering refuses.

    Args:
        robot: the robot.
        has_gazebo: whether sensors and surfaces are written for Gazebo.
    """
    losses: list[Loss] = cones(robot) if has_gazebo else []
    if not has_gazebo:
        losses += [
            _loss(
                "sensors",
                f"sensor '{sensor.name}'",
                sensor,
                kind=APPROXIMATED,
                how="their frames",
                hint=GAZEBO_HINT,
            )
            for sensor in robot.sensors.values()
        ]
        losses += [
            _loss("surfaces", f"link '{surface.link}'", surface, hint=GAZEBO_HINT)
            for surface in robot.surfaces
        ]
    driven = {joint for control in robot.controls for joint in control.joints}
    for actuator in robot.actuators.values():
        owner = f"joint '{actuator.joint}'"
        if actuator.joint not in driven:
            losses.append(_loss("actuators", owner, actuator, hint="add a section `control`"))
        elif any(each is not None for each in (actuator.kp, actuator.kd, actuator.armature)):
            losses.append(_loss("gains and armatures of actuators", owner, actuator))
    losses += lost_sections(robot, states=True)
    if robot.base is not None and robot.base.type == "free":
        losses.append(_loss("free bases", f"robot '{robot.name}'", robot.base))
    return losses


def _loss(
    what: str, owner: str, noted: Noted | Sensor, *, kind: str = LOST, how: str = "", hint: str = ""
) -> Loss:
    return Loss(kind, what, owner, noted.span, trace=noted.trace, how=how, hint=hint)
