"""What collides of a robot, where it is at home."""

from __future__ import annotations

from ...model.convex import Convex
from ...model.shapes import Mesh
from .keyframes import home_poses

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.link import Link
    from .writing import Writing


class Solid:
    """A convex shape, and the link that it is of."""

    __slots__ = ("convex", "link")

    def __init__(self, link: Link, convex: Convex) -> None:
        self.link = link
        self.convex = convex


def solids_at_home(writing: Writing) -> list[Solid]:
    """Return what collides, in the order of the links, in the axes of the root."""
    if writing.solids is None:
        poses = home_poses(writing)
        writing.solids = []
        for link, collision, points in writing.collisions:
            shape = collision.shape
            simple = None if shape is None or isinstance(shape, Mesh) else shape
            if simple is not None or points:
                placed = poses[link.name] @ collision.pose
                writing.solids.append(Solid(link, Convex(placed, simple, points)))
    return writing.solids
