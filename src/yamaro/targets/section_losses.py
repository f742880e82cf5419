"""What of a robot has no place in a format, whichever robot it is."""

from __future__ import annotations

from .output import LOST, Loss

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.extras import Noted
    from ..model.robot import Robot


def lost_sections(
    robot: Robot,
    *,
    states: bool = False,
    groups: bool = False,
    actuators: bool = False,
    controls: bool = False,
) -> list[Loss]:
    """Return the losses of a format that has no place for what is named.

    Args:
        robot: the robot.
        states: whether named positions are lost.
        groups: whether groups of links and joints, and pairs of links to ignore, are lost.
        actuators: whether actuators are lost.
        controls: whether the hardware that drives joints is lost.
    """
    found: list[Loss] = []
    if actuators:
        found += [
            _lost("actuators", f"joint '{each.joint}'", each) for each in robot.actuators.values()
        ]
    if controls:
        name = robot.name
        found += [
            _lost("blocks of ros2_control", f"'{each.name or name}'", each)
            for each in robot.controls
        ]
    if states:
        found += [_lost("states", f"'{each.name}'", each) for each in robot.states.values()]
    if groups:
        found += [_lost("groups", f"'{each.name}'", each) for each in robot.groups.values()]
        if robot.collision_settings is not None:
            found.append(_lost("`collisions` sections", "the robot", robot.collision_settings))
    return found


def _lost(what: str, owner: str, thing: Noted) -> Loss:
    return Loss(LOST, what, owner, thing.span, trace=thing.trace)
