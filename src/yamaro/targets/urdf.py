"""URDF, which a robot is in as it is: what is added for Gazebo, and what URDF cannot hold."""

from __future__ import annotations

from ..diagnostics import Reporter
from .gazebo import with_gazebo
from .holding import lost_fields
from .output import APPROXIMATED, LOST, Loss, Output
from .shared_losses import cones, lost_sections

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.extras import Noted, Sensor
    from ..model.robot import Robot
    from .output import Wanted

GAZEBO_HINT = "--gazebo also writes it for Gazebo"


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return a robot as URDF, with meshes named as they are in the source.

    Loops are not among the losses, since lowering refuses them. What the robot says to Gazebo in
    elements of its own is written already, and so is not to be read.
    """
    reporter, root = Reporter(), robot.element
    losses: list[Loss] = []
    if wanted.has_gazebo:
        losses = cones(robot)
        root = with_gazebo(root, robot, reporter)
    output = Output(root, losses, warnings=reporter.diagnostics)
    if not wanted.is_named:
        return output
    if not wanted.has_gazebo:
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
    geared = {
        f"joint '{joint}'"
        for control in robot.controls
        for joint in control.joints
        if control.has_transmissions
    }
    for actuator in robot.actuators.values():
        owner = f"joint '{actuator.joint}'"
        if actuator.joint not in driven:
            losses.append(_loss("actuators", owner, actuator, hint="add a section `control`"))
            continue
        for name, missing in lost_fields("urdf", "actuator").items():
            if actuator.number(name) is not None and not (name == "gear" and owner in geared):
                losses.append(
                    Loss(
                        *(LOST, missing.what, owner, actuator.span_of(name)),
                        trace=actuator.trace,
                        hint=missing.hint,
                    )
                )
    losses += lost_sections(robot, states=True)
    if robot.base is not None and robot.base.type == "free":
        losses.append(_loss("free bases", f"robot '{robot.name}'", robot.base))
    return output


def _loss(
    what: str, owner: str, noted: Noted | Sensor, *, kind: str = LOST, how: str = "", hint: str = ""
) -> Loss:
    return Loss(kind, what, owner, noted.span, trace=noted.trace, how=how, hint=hint)
