"""Advice on where the centre of mass of a link is."""

from __future__ import annotations

from math import dist

from ..model.shapes import Mesh
from .context import CheckContext, label, shown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.link import Link
    from ..model.pose import Vector

LEAST_GAP = 0.3
"""Metres between the centre of mass and the shapes that are never reported."""


def advise_on_center(link: Link, context: CheckContext) -> None:
    """Report a centre of mass that lies far outside of the link's shapes.

    All readers take it, and simulators swing the link about a point in the air.
    """
    inertial = link.inertial
    if inertial is None or inertial.inner("mass") is None:
        return
    balls = _balls(link)
    if not balls:
        return
    center = inertial.pose.position
    gap = min(dist(center, middle) - radius for middle, radius in balls)
    largest = max(radius for _, radius in balls)
    if gap <= max(4 * largest, LEAST_GAP):
        return
    origin = inertial.pose.element
    context.warn(
        "far-center",
        f"the centre of mass of {label(link.element)} is {shown(gap)} m away from its shapes",
        inertial.element if origin is None else origin,
        attribute=None if origin is None else "xyz",
        hint="check the units (metres) and the frame, which is that of the link",
    )


def _balls(link: Link) -> list[tuple[Vector, float]]:
    """Return the middles and radii of spheres around the collisions, or else the visuals.

    There are none if a mesh is among them.
    """
    for sections in (link.collisions, link.visuals):
        shapes = [(section.pose.position, section.shape) for section in sections]
        balls = [
            (middle, shape.radius_around())
            for middle, shape in shapes
            if shape is not None and not isinstance(shape, Mesh) and shape.radius_around() > 0
        ]
        if balls and len(balls) == len(sections):
            return balls
    return []
