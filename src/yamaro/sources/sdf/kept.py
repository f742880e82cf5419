"""What the model does not hold of an element of SDF, as elements for the blocks `sdf`.

A `Held` table says of an element what the model holds: True for a child that is held with all that
is in it, a table for a child that is held in part; `@name` is an attribute. What no table names is
kept. The writer of SDF merges what a block holds into what it writes itself.
"""

from __future__ import annotations

from ...diagnostics import meant_word
from ...model.values import child_named
from ...xml.reader import CData
from ...xml.tree import Element, RawBlock, Text
from ...xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ...model.pose import Pose
    from ...source import Span
    from ...xml.tree import Node
    from .values import Reading

    Held = Mapping[str, "bool | Held"]

FORMAT = "sdf"
NAMESPACES = {
    "drake": "https://drake.mit.edu",
    "gz": "http://gazebosim.org/schema",
    "ignition": "http://ignitionrobotics.org/schema",
    "experimental": "http://sdformat.org/schemas/experimental",
}
"""What prefixes mean that a file uses and does not declare, as libsdformat allows."""

KNOWN = {
    "model": "allow_auto_disable enable_wind frame gripper include joint link model plugin pose "
    "self_collide static",
    "link": "audio_sink audio_source battery collision enable_wind gravity inertial kinematic "
    "light must_be_base_link particle_emitter plugin pose projector self_collide sensor "
    "velocity_decay visual",
    "joint": "axis axis2 child gearbox_ratio gearbox_reference_body parent physics plugin pose "
    "screw_thread_pitch sensor thread_pitch",
    "axis": "dynamics initial_position limit mimic use_parent_model_frame xyz",
    "limit": "dissipation effort lower stiffness upper velocity",
    "dynamics": "damping friction spring_reference spring_stiffness",
    "mimic": "multiplier offset reference",
    "inertial": "auto_inertia_params density fluid_added_mass inertia mass pose",
    "inertia": "ixx ixy ixz iyy iyz izz",
    "collision": "auto_inertia_params density geometry laser_retro max_contacts pose plugin "
    "surface",
    "visual": "cast_shadows geometry laser_retro material meta plugin pose transparency "
    "visibility_flags",
    "geometry": "box capsule cone cylinder ellipsoid empty heightmap image mesh plane polyline "
    "sphere",
    "box": "size",
    "cylinder": "length radius",
    "capsule": "length radius",
    "cone": "length radius",
    "ellipsoid": "radii",
    "sphere": "radius",
    "plane": "normal size",
    "mesh": "convex_decomposition scale submesh uri",
    "material": "ambient diffuse double_sided emissive lighting pbr render_order script shader "
    "shininess specular",
    "surface": "bounce contact friction soft_contact",
    "frame": "pose",
    "include": "name placement_frame plugin pose static uri",
}
"""What SDFormat 1.2 to 1.12 know in the elements that are read. Source: the descriptions of the
elements, `sdf/1.4` to `sdf/1.12` of libsdformat."""
_WORDS = {name: frozenset(words.split()) for name, words in KNOWN.items()}


def kept_of(element: Element, held: Held, *, name: str | None = None) -> Element | None:
    """Return what a table does not hold of an element, or None if it holds all.

    Args:
        element: the element.
        held: what the model holds of it.
        name: the name that the element has in the output.
    """
    children: list[Node] = []
    for child in element.elements():
        of_child = held.get(child.name, False)
        if of_child is True:  # what other programs say of it is beside what the model holds
            others = {key: value for key, value in child.attributes.items() if ":" in key}
            if others:
                children.append(Element(child.name, child.span, others))
            continue
        inner = child if of_child is False else kept_of(child, of_child)
        if inner is not None:
            children.append(inner)
    attributes = {
        key: value
        for key, value in element.attributes.items()
        if value is not None and held.get("@" + key) is not True and not key.startswith("xmlns:")
    }
    if not children and not attributes:
        return None
    if name is not None:
        attributes = {"name": name, **attributes}
    return Element(
        element.name, element.span, attributes, children, element.trace, element.value_spans
    )


def block_of(reading: Reading, span: Span, elements: Iterable[Element]) -> list[Node]:
    """Return a block of elements, or nothing without any."""
    inner: list[Node] = []
    for element in elements:
        _tidy(reading, element)
        inner.append(element)
    if not inner:
        return []
    return [RawBlock(FORMAT, span, {}, inner, reading.trace(span))]


def _tidy(reading: Reading, kept: Element) -> None:
    """Leave out the space between elements, and declare the prefixes where they are used."""
    trace = reading.trace(kept.span)
    for element in kept.iter():
        element.trace = trace
        children: list[Node] = []
        has_elements = any(isinstance(each, Element) for each in element.children)
        for child in element.children:
            if isinstance(child, Text):
                text = format_value(child.value)
                if has_elements and not text.strip():
                    continue
                if type(child) is CData:
                    child = Text(text, child.span)
            children.append(child)
        element.children = children
        for name in (element.name, *element.attributes):
            prefix, colon, _ = name.partition(":")
            if colon and prefix != "xmlns" and f"xmlns:{prefix}" not in element.attributes:
                address = NAMESPACES.get(prefix, f"http://sdformat.org/schemas/{prefix}")
                element.attributes = {f"xmlns:{prefix}": address, **element.attributes}


def placed(element: Element, pose: Pose) -> Element:
    """Return an element that is kept whole, with a pose in the frame of what it is in."""
    own = child_named(element, "pose")
    rest = [each for each in element.children if each is not own]
    if not any((*pose.position, *pose.rpy)):
        return element.with_children(rest)
    return element.with_children([pose_element(pose, own or element), *rest])


def pose_element(pose: Pose, owner: Element, relative_to: str | None = None) -> Element:
    """Return a `<pose>` of SDF."""
    numbers = (*pose.position, *pose.rpy)
    made = leaf("pose", " ".join(format_value(clean(each)) for each in numbers), owner.span)
    if relative_to is not None:
        made.attributes["relative_to"] = relative_to
    return made


def clean(number: float) -> float:
    """Return a number without the noise of rounding about 0."""
    return 0.0 if abs(number) < 1e-15 else number


def leaf(name: str, text: str, span: Span) -> Element:
    """Return an element with a text in it."""
    return Element(name, span, {}, [Text(text, span)])


def check_words(reading: Reading, element: Element) -> None:
    """Warn of elements that SDFormat does not know; those with a prefix are of other programs."""
    known = _WORDS[element.name]
    for child in element.elements():
        if child.name in known or ":" in child.name:
            continue
        hint, _ = meant_word(child.name, known, child.span)
        reading.warn(
            "unknown-sdf",
            f"SDFormat has no <{child.name}> in <{element.name}>; it is kept for SDF",
            child.span,
            hint=hint or f"there are {', '.join(sorted(known))}",
        )
