"""What a robot has that no part of MJCF holds."""

from __future__ import annotations

from ...model.joint import FLOATING, PLANAR
from ..foreign_xml import foreign_losses
from ..shared_losses import cones, lost_of_joints, lost_sections, renamed_sensors

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .writing import Writing

OF_SEVERAL = (PLANAR, FLOATING)
"""The joints of several numbers, each of which takes damping and friction."""


def lose_leftovers(writing: Writing) -> None:
    """Report parts of joints, names of sensors, sections, and XML of other programs."""
    robot = writing.robot
    writing.losses += lost_of_joints(robot, "mjcf", has_dynamics=OF_SEVERAL)
    writing.losses += renamed_sensors(robot)
    writing.losses += cones(robot)
    writing.losses += lost_sections(robot, controls=True)
    writing.losses += foreign_losses(robot)
