"""The link of a part: its sections, each with its pose and shape."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..xml.tree import Element
from .fields import (
    COLLISION,
    FIT_KEYS,
    INERTIAL,
    LIGHTER_KEYS,
    LINK,
    VISUAL,
    Fields,
    sort_fields,
)
from .geometry import LinkGeometry, section_geometry
from .inertial import LinkMass, lower_inertial
from .notes import is_surface
from .pose import NO_POSE, Pose, compose_poses, origin_element, read_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Diagnostic
    from ..xml.tree import Node
    from .lowering import Lowering


WORKED_OUT = FIT_KEYS | LIGHTER_KEYS | {"cover"}
"""The keys with which the shape of a section is not the mesh itself."""


class LinkFrame:
    """What the sections of a link take from it."""

    __slots__ = ("geometry", "mass", "pose")

    def __init__(self, fields: Fields, pose: Pose) -> None:
        self.pose = pose
        self.geometry = LinkGeometry(fields)
        self.mass = LinkMass(fields)


def lower_link(lowering: Lowering, key: Element, name: str) -> Element:
    """Return `<link>` with its sections in the order written; record errors and go on."""
    lowering.link_name = name
    common = lowering.once(key, _lower_common, own=0)
    attributes: dict[str, object] = {"name": name}
    for attribute, value in key.attributes.items():
        attributes.setdefault(attribute, value)
    link = common.like(attributes, common.children, common.trace)
    lowering.give_trace(link)
    return link


def _lower_common(lowering: Lowering, key: Element) -> Element:
    """Return a `<link>` without its name, which nothing else in it depends on."""
    fields = sort_fields(lowering, key, LINK)
    try:
        pose = read_pose(lowering, fields)
    except YamaroError as error:
        lowering.absorb(error)
        pose = NO_POSE
    frame = LinkFrame(fields, pose)
    children: list[Node] = []
    is_faulty = False
    for child in fields.rest:
        if type(child) is not Element or child.verbatim:
            children.append(child)
            continue
        try:
            children += _lower_child(lowering, child, fields, frame)
        except YamaroError as error:
            lowering.absorb(error)
            is_faulty = True
    # A faulty section may be the one that was to use the geometry.
    if not is_faulty:
        _warn_of_unused(lowering, frame.geometry)
    return Element("link", key.span, {}, children, key.trace, key.value_spans)


def _lower_child(
    lowering: Lowering, child: Element, fields: Fields, frame: LinkFrame
) -> list[Element]:
    """Return what a child of a link becomes: nothing if it is worked in elsewhere."""
    match child.name:
        case "collision" | "visual":
            return _lower_section(lowering, child, frame)
        case "inertial":
            own = sort_fields(lowering, child, INERTIAL)
        case "mass" | "density":
            if "inertial" in fields.keys or child is not frame.mass.key():
                return []
            own = Fields()
        case _:
            return [child]
    inertial = lower_inertial(
        lowering,
        child,
        own,
        link_pose=frame.pose,
        link_geometry=frame.geometry,
        link_mass=frame.mass,
    )
    return [inertial]


def _lower_section(lowering: Lowering, key: Element, frame: LinkFrame) -> list[Element]:
    """Return `<collision>` or `<visual>`: origin, geometry, then the rest as written.

    There are several if the shape is made of several pieces.
    """
    fields = sort_fields(lowering, key, VISUAL if key.name == "visual" else COLLISION)
    if fields.has_text:
        return [key]
    faults: list[Diagnostic] = []
    pose = NO_POSE
    try:
        pose = compose_poses(frame.pose, read_pose(lowering, fields))
    except YamaroError as error:
        faults += error.diagnostics
    geometry = fields.plain.get("geometry")
    shape = None
    if geometry is None:
        try:
            shape = section_geometry(lowering, fields, frame.geometry)
        except YamaroError as error:
            faults += error.diagnostics
        if shape is not None:
            geometry = shape.element
        elif not faults:
            raise failure(
                "missing-geometry",
                f"this {key.name} has no geometry, and its link has none to inherit",
                key.span,
                hint="write geometry: box and scale: 0.4 0.3 0.2, in the link or in the section",
                trace=key.trace,
            )
    children: list[Node] = []
    for child in fields.rest:
        try:
            if type(child) is Element and child.name == "material" and not child.verbatim:
                from .material import lower_material

                children.append(lowering.once(child, lower_material))
            elif type(child) is Element and child.name == "color" and key.name == "visual":
                children.append(_material_of_color(lowering, child, fields))
            elif key.name != "collision" or not is_surface(child):  # a note beside the link
                children.append(child)
        except YamaroError as error:
            faults += error.diagnostics
    if faults or geometry is None:
        raise YamaroError(faults)
    if not WORKED_OUT.isdisjoint(fields.keys):
        from .fits import fitted_sections

        return fitted_sections(lowering, key, fields, shape, pose, children)
    origin = fields.plain.get("origin") or origin_element(pose, key)
    children = [geometry, *children] if origin is None else [origin, geometry, *children]
    return [key.with_children(children)]


def _material_of_color(lowering: Lowering, key: Element, fields: Fields) -> Element:
    """Return the `<material>` of a `color` key, or an element in angle brackets as it is.

    Raises:
        YamaroError: there is a `material` as well, or the colour is faulty.
    """
    if key.verbatim:
        return key
    material = fields.keys.get("material")
    if material is not None:
        raise failure(
            "given-twice",
            "this visual has a 'color' and a 'material'",
            key.span,
            hint="write the color in the material, or remove one of the two",
            notes=(f"'material' is given at {material.span.place()}",),
            trace=key.trace,
        )
    from .material import lower_color_material

    return lowering.once(key, lower_color_material)


def _warn_of_unused(lowering: Lowering, geometry: LinkGeometry) -> None:
    """Warn of a geometry or scale in a link that no section uses."""
    if geometry.is_used:
        return
    key = geometry.key or next(iter(geometry.sizes), None)
    if key is None:
        return
    lowering.report(
        "unused-geometry",
        f"no section of this link uses its '{key.name}'",
        key.span,
        hint="add 'collision:' or 'visual:', which inherit it, or remove it"
        if geometry.key is not None
        else "add the 'geometry' it belongs to, or remove it",
        trace=key.trace,
    )
