"""Tells whether two documents are the same robot, with lxml and nothing of Yamaro.

Aside from what means nothing: the order of attributes, white space, the spelling of numbers,
comments, and in what order a robot, link, joint, visual, collision, inertial or material holds
children of different names, which URDF leaves open (the schema of urdfdom says `all`). Unless the
comparison is exact, so does a pose that is left out: to every reader of URDF, a joint, visual,
collision or inertial without `<origin>` is at zeros, and so is an origin without `xyz` or `rpy`. So
does a material under the robot that says just what an earlier one does: parsers take the first, or
refuse both.
"""

from __future__ import annotations

from typing import Any

from lxml import etree

LOOSE = ("robot", "link", "joint", "visual", "collision", "inertial", "material")
Shape = tuple[str, dict[str, tuple[object, ...]], tuple[object, ...], list[Any]]


def write_poses(root: Any) -> None:
    """Write out the poses that a robot leaves out."""
    if root.tag != "robot":
        return
    paths = ("joint", "link/visual", "link/collision", "link/inertial")
    for holder in [found for path in paths for found in root.findall(path)]:
        if holder.find("origin") is None:
            etree.SubElement(holder, "origin")
        for origin in holder.findall("origin"):
            for name in ("xyz", "rpy"):
                origin.set(name, origin.get(name, "0 0 0"))


def drop_repeated_materials(root: Any) -> None:
    """Take out each material of a robot that an earlier one equals."""
    if root.tag != "robot":
        return
    kept: list[Shape] = []
    for material in root.findall("material"):
        shape = shape_of(material)
        if shape in kept:
            root.remove(material)
        else:
            kept.append(shape)


def shape_of(element: Any) -> Shape:
    """Return what an element says, in a form that can be compared."""
    children = [child for child in element if isinstance(child.tag, str)]
    if element.tag in LOOSE:
        children.sort(key=lambda child: str(child.tag))
    pieces = [element.text or ""]
    for child in element:
        pieces += [" " if isinstance(child.tag, str) else "", child.tail or ""]
    attributes = {name: words(value) for name, value in element.attrib.items()}
    return element.tag, attributes, words("".join(pieces)), [shape_of(c) for c in children]


def words(text: str) -> tuple[object, ...]:
    """Return the words of a text, numbers as numbers."""
    return tuple(number(word) for word in text.split())


def number(word: str) -> object:
    try:
        value = float(word)
    except ValueError:
        return word
    return Number(value) if value - value == 0 else word


class Number:
    """A number that equals others which differ by one part in 10⁹."""

    def __init__(self, value: float) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Number):
            return False
        return abs(self.value - other.value) <= max(1e-9 * abs(self.value), 1e-12)

    def __hash__(self) -> int:
        return 0

    def __repr__(self) -> str:
        return repr(self.value)


def is_same_robot(first: bytes, second: bytes, *, exact: bool = False) -> bool:
    """Tell whether two documents are the same."""
    parser = etree.XMLParser(huge_tree=True, remove_pis=True, resolve_entities=False)
    one, other = (etree.fromstring(text, parser) for text in (first, second))
    if not exact:
        for root in (one, other):
            write_poses(root)
            drop_repeated_materials(root)
    return shape_of(one) == shape_of(other)
