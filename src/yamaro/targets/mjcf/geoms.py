"""The shapes of links as geoms."""

from __future__ import annotations

from ...model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from ..output import APPROXIMATED, LOST, RENAMED
from .names import GEOM, stem_of
from .surfaces import surface_attributes
from .writing import Writing, made, pose_attributes, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.extras import Surface
    from ...model.link import Collision, Link, Visual
    from ...model.pose import Vector
    from ...model.shapes import SimpleShape
    from ...source import Span
    from ...xml.tree import Element
    from .assets import Looks

    Attributes = dict[str, str | None]


def add_geoms(writing: Writing, looks: Looks) -> None:
    """Append the shapes of every link to its body.

    Args:
        writing: the run.
        looks: gives the materials and meshes of shapes.
    """
    surfaces = {(each.link, each.index): each for each in writing.robot.surfaces}
    for link in writing.plan.order:
        body = writing.body_of(link.name)
        for visual in link.visuals:
            body.children += _visual(writing, link, visual, looks)
        for index, collision in enumerate(link.collisions):
            surface = surfaces.get((link.name, index))
            body.children += _collision(writing, link, collision, surface, looks)


def _visual(writing: Writing, link: Link, visual: Visual, looks: Looks) -> list[Element]:
    """Return the geoms of a visual: one for each material of a mesh."""
    look = looks.of_visual(link, visual)
    if isinstance(visual.shape, Mesh):
        parts = looks.visual_mesh(link, visual, visual.shape, look)
    else:
        sizes = _sizes(writing, link, visual)
        parts = [{**sizes, **look}] if sizes is not None else []
    name = visual.name or f"{stem_of(link.name)}_visual"
    return [_geom(writing, link, visual, name, writing.classes.visual, part) for part in parts]


def _collision(
    writing: Writing, link: Link, collision: Collision, surface: Surface | None, looks: Looks
) -> list[Element]:
    """Return the geom of a collision, or none if MJCF cannot hold its shape."""
    shape = collision.shape
    part: Attributes | None
    points: Sequence[Vector] = ()
    if isinstance(shape, Mesh):
        part = looks.collision_mesh(link, collision, shape)
        if part is not None:
            points = looks.corners_of(shape)
            writing.lose(
                APPROXIMATED,
                "meshes of collisions",
                f"link '{link.name}'",
                collision.span,
                trace=collision.trace_in(link),
                how="their convex hulls",
            )
    else:
        part = _sizes(writing, link, collision)
    if part is None:
        return []
    writing.collisions.append((link, collision, points))
    if surface is not None:
        part |= surface_attributes(writing, link, surface)
    name = collision.name or f"{stem_of(link.name)}_collision"
    return [_geom(writing, link, collision, name, writing.classes.collision, part)]


def _geom(
    writing: Writing,
    link: Link,
    owner: Visual | Collision,
    name: str,
    default: str,
    attributes: Attributes,
) -> Element:
    """Return a geom under a name that is free."""
    found = writing.names.fresh(GEOM, name)
    if found != name and owner.name:
        found = writing.names.fresh(GEOM, f"{stem_of(link.name)}_{name}")
        kind = "visuals" if default == writing.classes.visual else "collisions"
        label = f"'{owner.name}' of link '{link.name}'"
        trace = owner.trace_in(link)
        writing.lose(RENAMED, kind, label, owner.span, trace=trace, how=found)
    pose = owner.pose
    places: dict[str, Span] = {}
    if pose.span is not None:
        places |= {"pos": pose.span, "quat": pose.span}
    if owner.shape is not None and owner.shape.span is not None:
        places["size"] = owner.shape.span
    whole = {"name": found, "class": default, **attributes, **pose_attributes(pose)}
    return made("geom", owner, whole, owner.trace_in(link), places)


def _sizes(writing: Writing, link: Link, owner: Visual | Collision) -> Attributes | None:
    """Return the type and the size of a shape of numbers, or None if it has no volume."""
    shape = owner.shape
    if shape is None or isinstance(shape, Mesh):
        return None
    if min(shape.size) <= 0:
        writing.lose(
            LOST,
            "shapes with a size that is not positive",
            f"{shape.kind} of link '{link.name}'",
            owner.span,
            trace=owner.trace_in(link),
        )
        return None
    return {"type": shape.kind, "size": row(_halves(shape))}


def _halves(shape: SimpleShape) -> tuple[float, ...]:
    """Return the sizes that MJCF takes: radii, and halves of lengths."""
    if isinstance(shape, Box):
        return (shape.x / 2, shape.y / 2, shape.z / 2)
    if isinstance(shape, (Cylinder, Capsule)):
        return (shape.radius, shape.length / 2)
    assert isinstance(shape, Sphere)
    return (shape.radius,)
