"""Geoms: the shapes of links, and their surfaces."""

from __future__ import annotations

from math import log, pi, sqrt

from ...model.shapes import Box, Capsule, Cylinder, Mesh, Sphere
from ..elements import element
from ..gains import TIME_STEP
from .model import GEOM, Writing, pose_attributes, stem_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.extras import Surface
    from ...model.link import Collision, Link, Visual
    from ...model.pose import Vector
    from ...source import Span
    from ...xml.tree import Element
    from ..elements import Attributes
    from .assets import Looks


def add_geoms(writing: Writing, looks: Looks) -> None:
    """Append the shapes of every link to its body.

    Args:
        writing: the run.
        looks: gives the materials and meshes of shapes.
    """
    surfaces = {(each.link, each.index): each for each in writing.robot.surfaces}
    for link in writing.plan.order:
        if link.name in writing.plan.passed:
            continue
        body = writing.body_of(link.name)
        is_whole = writing.blocks.is_whole
        given = writing.blocks.geoms(link.name)
        colliding = {each.name: each.shape for each in link.collisions if each.name}
        both: dict[str, Visual] = {}
        for visual in link.visuals:
            is_one = is_whole or visual.name in given
            name = visual.name or _made_name(writing, link, "visual")
            if is_one and visual.name in colliding:
                if visual.shape == colliding[visual.name]:
                    both[visual.name] = visual
                    continue
                name = _made_name(writing, link, "visual")
            body.children += _visual(writing, link, visual, looks, name=name, is_one=is_one)
        for index, collision in enumerate(link.collisions):
            surface = surfaces.get((link.name, index))
            look: Attributes = {}
            if collision.name in both:
                look = {"group": 0, **looks.of_visual(link, both[collision.name])}
            body.children += _collision(writing, link, collision, surface, looks, look)


def _visual(
    writing: Writing, link: Link, visual: Visual, looks: Looks, *, name: str, is_one: bool
) -> list[Element]:
    """Return the geoms of a visual, of which a mesh has one for each of its materials.

    One that a block names is one geom, and so are all of a robot that blocks say the rest of.
    """
    look = looks.of_visual(link, visual)
    parts: list[Attributes]
    if not isinstance(visual.shape, Mesh):
        sizes = _sizes(writing, link, visual)
        parts = [{**sizes, **look}] if sizes is not None else []
    elif is_one:
        whole = looks.whole_mesh(link, visual, visual.shape)
        parts = [{**whole, **look}] if whole is not None else []
    else:
        parts = looks.visual_mesh(link, visual, visual.shape, look)
    return [_geom(writing, link, visual, name, writing.classes.visual, part) for part in parts]


def _collision(
    writing: Writing,
    link: Link,
    collision: Collision,
    surface: Surface | None,
    looks: Looks,
    look: Attributes,
) -> list[Element]:
    """Return the geom of a collision, or none if MJCF cannot hold its shape.

    It has a `look` where it is seen as well.
    """
    shape = collision.shape
    part: Attributes | None
    points: Sequence[Vector] = ()
    if isinstance(shape, Mesh):
        part = looks.collision_mesh(link, collision, shape)
        if part is not None:
            points = looks.corners_of(shape)
            if not writing.robot.is_convex(link, collision):
                what, how = "meshes of collisions", "their convex hulls"
                writing.losses.approximate(what, link, part=collision, how=how)
    else:
        part = _sizes(writing, link, collision)
    if part is None:
        return []
    writing.collisions.append((link, collision, points))
    part |= look
    if surface is not None:
        part |= surface_attributes(writing, link, surface)
    name = collision.name or _made_name(writing, link, "collision")
    return [_geom(writing, link, collision, name, writing.classes.collision, part)]


def _made_name(writing: Writing, link: Link, kind: str) -> str:
    """Return the name of a shape that has none; "" where blocks say all that links do not."""
    return "" if writing.blocks.is_whole else f"{stem_of(link.name)}_{kind}"


def _geom(
    writing: Writing,
    link: Link,
    owner: Visual | Collision,
    name: str,
    default: str,
    attributes: Attributes,
) -> Element:
    """Return a geom under a name that is free."""
    found = writing.names.fresh(GEOM, name) if name else ""
    if found != name and owner.name:
        found = writing.names.fresh(GEOM, f"{stem_of(link.name)}_{name}")
        kind = "visuals" if default == writing.classes.visual else "collisions"
        label = f"'{owner.name}' of link '{link.name}'"
        writing.losses.rename(kind, link, part=owner, label=label, new=found)
        writing.renamed_geoms.setdefault((link.name, owner.name), found)
    pose = owner.pose
    places: dict[str, Span] = {}
    if pose.span is not None:
        places |= {"pos": pose.span, "quat": pose.span}
    if owner.shape is not None and owner.shape.span is not None:
        places["size"] = owner.shape.span
    whole: Attributes = {
        "name": found or None,
        "class": default,
        **attributes,
        **pose_attributes(pose),
    }
    return element("geom", whole, owner=link, part=owner, places=places)


def _sizes(writing: Writing, link: Link, owner: Visual | Collision) -> Attributes | None:
    """Return the type and the size of a shape of numbers, or None if it has no volume."""
    shape = owner.shape
    if shape is None or isinstance(shape, Mesh):
        return None
    if min(shape.size) <= 0:
        what = "shapes with a size that is not positive"
        label = f"{shape.kind} of link '{link.name}'"
        writing.losses.lose(what, link, part=owner, label=label)
        return None
    halves: tuple[float, ...]
    match shape:  # MJCF takes radii, and halves of lengths
        case Box():
            halves = (shape.x / 2, shape.y / 2, shape.z / 2)
        case Cylinder() | Capsule():
            halves = (shape.radius, shape.length / 2)
        case Sphere():
            halves = (shape.radius,)
    return {"type": shape.kind, "size": halves}


# --- surfaces of collisions: friction, and how contacts give way ------------------------------


TORSIONAL, ROLLING = 0.005, 0.0001
"""MuJoCo's default coefficients of the friction that stops turning and rolling, in metres."""
TIME_CONSTANT = 0.02
"""MuJoCo's default time constant of contacts, in seconds."""
STIFFEST = (0.5 / TIME_STEP) ** 2
"""The greatest stiffness by mass, in 1/s², that MuJoCo's default time step can follow."""


def surface_attributes(writing: Writing, link: Link, surface: Surface) -> Attributes:
    """Return the attributes of a geom that a surface gives, and report what it does not give."""
    losses = writing.losses
    attributes: Attributes = {}
    friction = surface.friction
    if friction is not None:
        attributes["friction"] = (friction, TORSIONAL, ROLLING)
    if surface.friction2 != friction:
        losses.lose("second coefficients of friction", surface, field="friction2")
    if surface.stiffness is not None or surface.damping is not None:
        how = "accelerations by depth and speed, for the mass of the link"
        for name in ("stiffness", "damping"):
            if getattr(surface, name) is not None:
                losses.approximate(f"{name} of contacts", surface, field=name, how=how)
        attributes["solref"] = _stiff(writing, link, surface)
        if surface.restitution is not None:
            what = "restitutions of surfaces that are stiff"
            losses.lose(what, surface, field="restitution")
    elif surface.restitution is not None:
        what, how = "restitutions of surfaces", "damping of contacts"
        losses.approximate(what, surface, field="restitution", how=how)
        ratio = damping_ratio(surface.restitution)
        attributes["solref"] = None if ratio == 1 else (TIME_CONSTANT, ratio)
    return attributes


def damping_ratio(restitution: float) -> float:
    """Return the damping ratio of a spring that gives back this part of the speed, at most 1.

    Source: the half period of a damped oscillator, e = exp(−π·ζ/√(1 − ζ²)), solved for ζ; see
    https://en.wikipedia.org/wiki/Logarithmic_decrement.
    """
    if restitution <= 0:
        return 1.0
    if restitution >= 1:
        return 1e-3  # MuJoCo takes none that is 0
    decrement = log(restitution)
    return -decrement / sqrt(pi * pi + decrement * decrement)


def _stiff(writing: Writing, link: Link, surface: Surface) -> tuple[float, float] | None:
    """Return `solref` for a stiffness in N/m and a damping in N·s/m; None for MuJoCo's default.

    MuJoCo counts both by mass. What is missing gives critical damping. A surface that is stiffer
    than the time step can follow is as stiff as MuJoCo's default.
    """
    mass = link.mass or writing.robot.mass or 1.0
    stiffness = surface.stiffness / mass if surface.stiffness else None
    damping = surface.damping / mass if surface.damping else None
    if stiffness is None:
        if damping is None:
            return None
        stiffness = damping * damping / 4
    elif damping is None:
        damping = 2 * sqrt(stiffness)
    if stiffness > STIFFEST:
        return None
    return -stiffness, -damping
