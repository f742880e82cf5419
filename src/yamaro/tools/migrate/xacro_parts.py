"""Which joints and links of a xacro file are written as parts, and how."""

from __future__ import annotations

from itertools import pairwise

from ...xmltree import Element, format_value
from .document import Body, Entry, Value
from .elements import ElementWriter, spelled, walk
from .pairing import child_of, name_of
from .parts import Names, NoPart, PartWriter, is_short_material

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ...xmltree import Node


def part_of(link: Element, joint: Element | None, translate: Callable[[str], str]) -> Entry | None:
    """Return a joint and a link as a part, or None if they are more than a part can say.

    Args:
        link: as it stands in the file.
        joint: the joint whose child the link is, or None.
        translate: gives a text of xacro in the language's spelling.
    """
    if _has_statements(link) or (joint is not None and _has_statements(joint)):
        return None
    try:
        own = spelled(link, translate)
        around = None
        if joint is not None:
            around = spelled(joint, translate)
            if not _may_be_part(around):
                return None
        robot = Element("robot", link.span, {}, [own])
        writer = PartWriter(
            ElementWriter(lambda file: file), Names(robot), _material, resolves=True
        )
        return writer.part(own, around, joint_first=True)
    except NoPart:
        return None


def links_of_joints(nodes: list[Node]) -> dict[int, Element]:
    """Return the link beside each joint whose child it is, by the joint's identity."""
    elements = [node for node in nodes if isinstance(node, Element)]
    found: dict[int, Element] = {}
    taken: set[int] = set()
    for first, second in pairwise(elements):
        joint, link = (first, second) if first.name == "joint" else (second, first)
        if joint.name != "joint" or link.name != "link" or id(link) in taken or id(joint) in found:
            continue
        if first is joint and child_of(joint) == name_of(link):
            found[id(joint)] = link
            taken.add(id(link))
    return found


def _material(material: Element) -> Value | None:
    if not is_short_material(material) or not format_value(material.attributes["name"]):
        return None
    details = material.elements()
    name = format_value(material.attributes["name"])
    if not details:
        return name
    entries = [Entry(e.name, format_value(next(iter(e.attributes.values())))) for e in details]
    return Body([Entry("name", name), *entries], in_braces=True)


def _may_be_part(joint: Element) -> bool:
    """Tell whether a joint's limit would not be filled in."""
    kind = format_value(joint.attributes.get("type"))
    if kind in ("fixed", "continuous", "floating", "planar"):
        return True
    limits = [child for child in joint.elements() if child.name == "limit"]
    return len(limits) == 1 and {"lower", "upper", "effort", "velocity"} <= set(
        limits[0].attributes
    )


def _has_statements(element: Element) -> bool:
    return any(inner.name.startswith("xacro:") for inner in walk(element))
