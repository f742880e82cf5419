"""Where a robot is in a state: its links, what collides, and how high it stands on the floor."""

from __future__ import annotations

from ...model.convex import Convex
from ...model.kinematics import link_poses
from ...model.positions import home_positions
from ...model.shapes import Mesh

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.link import Link
    from ...model.pose import Pose
    from .writing import Writing

DOWN = (0.0, 0.0, -1.0)
DIGITS = 12
"""Decimals of a height in metres: more is rounding."""


class Solid:
    """A convex shape, and the link that it is of."""

    __slots__ = ("convex", "link")

    def __init__(self, link: Link, convex: Convex) -> None:
        self.link = link
        self.convex = convex


def home_poses(writing: Writing) -> dict[str, Pose]:
    """Return T_root_link of every link at home, by name."""
    return link_poses(writing.robot, home_positions(writing.robot))


def solids_at_home(writing: Writing) -> Sequence[Solid]:
    """Return what collides, in the order of the links, in the axes of the root."""
    if writing.solids is None:
        writing.solids = solids_at(writing, home_poses(writing))
    return writing.solids


def solids_at(writing: Writing, poses: Mapping[str, Pose]) -> list[Solid]:
    """Return what collides where the links have these poses."""
    found = []
    for link, collision, points in writing.collisions:
        shape = collision.shape
        simple = None if shape is None or isinstance(shape, Mesh) else shape
        if simple is not None or points:
            placed = poses[link.name] @ collision.pose
            found.append(Solid(link, Convex(placed, simple, points)))
    return found


def heights_at(writing: Writing, poses: Mapping[str, Pose]) -> dict[str, float]:
    """Return how much higher links that move freely have to be than in these poses.

    A free root stands on the floor, which is at 0. A link on a floating joint is where that joint
    has it, but not in the floor.
    """
    lowest: dict[str, float] = {}
    carriers = writing.plan.free
    for solid in solids_at(writing, poses) if any(carriers.values()) else ():
        carrier = carriers[solid.link.name]
        if carrier is not None:
            height = solid.convex.farthest(DOWN)[2]
            lowest[carrier] = min(lowest.get(carrier, height), height)
    return {
        link: round(-height, DIGITS) + 0.0
        for link, height in lowest.items()
        if height < 0 or writing.robot.parent_joint(link) is None
    }
