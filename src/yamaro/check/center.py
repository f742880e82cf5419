"""Advice on where the centre of mass of a link is."""

from __future__ import annotations

from math import dist, hypot

from ..model.values import child_named
from ..xml.tree import Element
from .context import CheckContext, label, shown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

LEAST_GAP = 0.3
"""Metres between the centre of mass and the shapes that are never reported."""

Ball = tuple[tuple[float, ...], float]
"""A sphere around a shape: centre and radius, in the link's frame."""


def advise_on_center(link: Element, context: CheckContext) -> None:
    """Report a centre of mass that lies far outside of the link's shapes.

    All readers take it, and simulators swing the link about a point in the air.
    """
    inertial = child_named(link, "inertial")
    if inertial is None or child_named(inertial, "mass") is None:
        return
    balls = _balls(link, context)
    if not balls:
        return
    origin = child_named(inertial, "origin")
    center = context.numbers(origin, "xyz", 3) or (0.0, 0.0, 0.0)
    gap = min(dist(center, middle) - radius for middle, radius in balls)
    largest = max(radius for _, radius in balls)
    if gap <= max(4 * largest, LEAST_GAP):
        return
    context.warn(
        "far-center",
        f"the centre of mass of {label(link)} is {shown(gap)} m away from its shapes",
        inertial if origin is None else origin,
        attribute=None if origin is None else "xyz",
        hint="check the units (metres) and the frame, which is that of the link",
    )


def _balls(link: Element, context: CheckContext) -> Sequence[Ball]:
    """Return spheres around the collisions, or the visuals; none if a mesh is among them."""
    for name in ("collision", "visual"):
        balls = [
            _ball(child, context)
            for child in link.children
            if isinstance(child, Element) and child.name == name
        ]
        known = [ball for ball in balls if ball is not None]
        if known and len(known) == len(balls):
            return known
    return ()


def _ball(section: Element, context: CheckContext) -> Ball | None:
    geometry = child_named(section, "geometry")
    shapes = geometry.elements() if geometry is not None else []
    if len(shapes) != 1:
        return None
    shape = shapes[0]
    radius = context.number(shape, "radius") or 0.0
    length = context.number(shape, "length") or 0.0
    if shape.name == "box":
        radius = hypot(*context.numbers(shape, "size", 3)) / 2
    elif shape.name == "cylinder":
        radius = hypot(radius, length / 2)
    elif shape.name == "capsule":
        radius += length / 2
    elif shape.name != "sphere":
        return None
    middle = context.numbers(child_named(section, "origin"), "xyz", 3) or (0.0, 0.0, 0.0)
    return (middle, radius) if radius > 0 else None
