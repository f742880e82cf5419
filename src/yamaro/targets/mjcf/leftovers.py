"""What a robot has that no part of MJCF holds."""

from __future__ import annotations

from ..foreign_xml import foreign_losses
from ..output import LOST

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .writing import Writing

SRDF_HINT = "--to srdf writes them"


def lose_leftovers(writing: Writing) -> None:
    """Report the hardware, the groups and the settings of a robot, and XML of other programs."""
    robot = writing.robot
    for control in robot.controls:
        owner = f"'{control.name or robot.name}'"
        writing.lose(LOST, "blocks of ros2_control", owner, control.span, trace=control.trace)
    for name, group in robot.groups.items():
        owner = f"group '{name}'"
        writing.lose(LOST, "groups", owner, group.span, trace=group.trace, hint=SRDF_HINT)
    settings = robot.collision_settings
    if settings is not None:
        owner, what = "`collisions`", "pairs of links that never collide"
        writing.lose(LOST, what, owner, settings.span, trace=settings.trace, hint=SRDF_HINT)
    writing.losses += foreign_losses(robot)
