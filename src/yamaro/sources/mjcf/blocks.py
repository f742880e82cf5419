"""Blocks: what the model of a robot cannot hold, kept as MJCF at its place.

An element in a block has all that its classes say, its angles in radians and its orientation as
`quat`, since that is how the writer of MJCF declares its documents.
"""

from __future__ import annotations

from ...model.pose import UNTURNED, quaternion_from_rotation
from ...xml.tree import Element, RawBlock, Text
from ...xml.values import Numbers
from .compiler import ORIENTATIONS, numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ...model.pose import Pose, Vector
    from ...source import Span
    from ...xml.tree import Node
    from .tree import Thing

NAME = "mjcf"
"""The format that the blocks are for."""
FILES = frozenset(("file", "fileback", "filedown", "filefront", "fileleft", "fileright", "fileup"))
"""The attributes that name files."""
_OF_POSE = (*ORIENTATIONS, "pos")


def block(span: Span, children: Iterable[Node]) -> RawBlock:
    """Return a block with some elements."""
    return RawBlock(NAME, span, children=[*children])


def setting(name: str, value: object, span: Span) -> Element:
    """Return what sets an attribute of the element that a block is for."""
    return Element(name, span, children=[Text(value, span)])


def row(values: Iterable[float]) -> Numbers:
    """Return numbers as they are written."""
    return Numbers.of(*values)


def quaternion(pose: Pose) -> Numbers | None:
    """Return the quaternion of a pose, w first, or None if it is not turned."""
    if pose.rotation == UNTURNED:
        return None
    return row(quaternion_from_rotation(pose.rotation))


def kept(
    thing: Thing,
    *,
    pose: Pose | None = None,
    changed: Mapping[str, object] | None = None,
    without: Iterable[str] = (),
) -> Element:
    """Return an element for a block: a thing with all that it has.

    Args:
        thing: the thing.
        pose: its pose, where that is not what its attributes say.
        changed: attributes in place of its own; None leaves one out.
        without: attributes that are left out.
    """
    attributes: dict[str, object] = {}
    spans: dict[str, Span] = {}
    if thing.name:
        attributes["name"] = thing.name
        spans["name"] = thing.name_span
    left_out = {*without, *(_OF_POSE if pose is not None else ())}
    for name, (value, span) in thing.given.items():
        if name not in left_out:
            attributes[name] = value
            spans[name] = span
    if pose is not None:
        if any(pose.position):
            attributes["pos"] = row(pose.position)
        attributes["quat"] = quaternion(pose)
    for name in FILES & attributes.keys():
        folder = "texturedir" if thing.kind == "texture" else "meshdir"
        folder = getattr(thing.context.compiler, folder)
        attributes[name] = thing.context.path(str(attributes[name]), folder)
    attributes.update(changed or {})
    attributes = {name: value for name, value in attributes.items() if value is not None}
    children: list[Node] = [kept(child) for child in thing.children]
    return Element(thing.kind, thing.span, attributes, children, value_spans=spans)


def in_radians(thing: Thing, *names: str) -> dict[str, object]:
    """Return the attributes of a thing that are angles, in radians."""
    angle = thing.context.compiler.angle
    found: dict[str, object] = {}
    for name in names:
        values = numbers(thing.given, name, 1, 2)
        if values is not None:
            found[name] = row(map(angle, values))
    return found


def turned(pose: Pose, vector: Vector) -> Vector:
    """Return a direction in a frame as it is around the frame."""
    from ...model.pose import rotate

    return rotate(pose.rotation, vector)
