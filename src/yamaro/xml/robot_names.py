"""Changes the names in a URDF wherever they stand, so that a robot can be there several times."""

from __future__ import annotations

import re

from .mjcf_references import SHARED, kind_in, references
from .tree import Element, RawBlock, Text
from .values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

_BODIES = ("link", "joint")
_REFERS = re.compile(
    "link|joint|frame|body|reference|parent|child|mimic|site|objname|refname|relative_to|attached",
    re.IGNORECASE,
)
"""Tags and attributes that name links and joints, in extensions of URDF that are in no schema."""
_DEVICES = (
    *("transmission", "actuator", "sensor", "ros2_control", "gpio"),
    *("robot-group", "robot-loop", "robot-controller"),
)
"""What else is named once in a robot, whatever it is in."""
_REFERS_TO_DEVICE = re.compile("transmission|actuator|sensor|gpio", re.IGNORECASE)
_BLOCK = "mjcf"
"""The blocks in which all names belong to one robot, except for those of materials and meshes."""
_SHAPES = ("visual", "collision")


def rename(root: Element, prefix: str) -> None:
    """Put a prefix before the names of a robot's links, joints, transmissions and sensors.

    Also where they are referred to; materials are another matter.
    """
    RobotNames(root.elements()).rename(root.elements(), lambda name: prefix + name)


class RobotNames:
    """The names that some elements of a robot give, and where they are referred to."""

    __slots__ = ("_bodies", "_devices", "_in_blocks", "_own_shapes", "_shapes")

    def __init__(self, elements: Sequence[Element]) -> None:
        """Gather the names of links and joints, and of what devices these elements hold."""
        self._bodies = {_name(element) for element in elements if element.name in _BODIES}
        below = [inner for element in elements for inner in element.iter()]
        self._devices = {_name(each) for each in below if each.name in _DEVICES}
        shapes = {_name(each) for each in below if each.name in _SHAPES}
        within = [*_within_blocks(elements)]
        named = (name for each in within for kind, name in references(each) if kind == "geom")
        self._own_shapes = shapes.intersection(named)
        self._shapes = shapes - self._own_shapes
        self._in_blocks = set(map(_own_name, filter(self._is_own, within))) - {""}

    def rename(self, elements: Sequence[Element], change: Callable[[str], str]) -> None:
        """Change the names in some elements and in what is below them, wherever they stand.

        Args:
            elements: what is changed.
            change: gives the new name for one of the names that were gathered.
        """
        blocks = {id(each) for each in _within_blocks(elements)} if self._in_blocks else ()
        for element in elements:
            for inner in element.iter():
                if id(inner) in blocks:
                    self._rename_in_block(inner, change)
                    continue
                for name, value in inner.attributes.items():
                    known = self._named_by(inner) if name == "name" else self._referred_to_by(name)
                    if known:
                        inner.attributes[name] = _renamed(format_value(value), known, change)
                known = self._referred_to_by(inner.name)
                if inner.name == "param":  # of ros2_control: what it is called is an attribute
                    known = self._referred_to_by(_name(inner))
                if known:
                    for child in inner.children:
                        if isinstance(child, Text):
                            child.value = _renamed(format_value(child.value), known, change)

    def _rename_in_block(self, element: Element, change: Callable[[str], str]) -> None:
        for name, value in element.attributes.items():
            known = self._referred_to_by(name)
            if name == "name":
                known = self._in_blocks | self._bodies if self._is_own(element) else set()
            elif kind_in(element, name) not in (None, *SHARED):
                known = known | self._in_blocks | self._bodies | self._own_shapes
            if known:
                element.attributes[name] = _renamed(format_value(value), known, change)
        if element.name == "name":
            for child in element.children:
                if isinstance(child, Text):
                    child.value = _renamed(format_value(child.value), self._in_blocks, change)

    def _is_own(self, element: Element) -> bool:
        """Return whether the name of an element in a block is changed.

        Shapes are called alike in several links and robots; what blocks refer to is not.
        """
        is_shape = element.name == "geom" and _name(element) in self._shapes
        return element.name not in SHARED and not is_shape

    def _named_by(self, element: Element) -> set[str]:
        if element.name in _BODIES:
            return self._bodies
        if element.name in _SHAPES:
            return self._own_shapes
        return self._devices if element.name in _DEVICES else set()

    def _referred_to_by(self, word: str) -> set[str]:
        """Return the names that may stand under a tag or attribute."""
        if _REFERS.search(word):
            return self._bodies
        return self._devices if _REFERS_TO_DEVICE.search(word) else set()


def _within_blocks(elements: Sequence[Element]) -> Iterator[Element]:
    """Yield the elements in blocks for MJCF, which are in links and joints or beside these."""
    for element in elements:
        for each in (element, *element.elements()):
            if type(each) is RawBlock and each.name == _BLOCK:
                for inner in each.elements():
                    yield from inner.iter()


def _own_name(element: Element) -> str:
    """Return the name of an element in a block, which a `<name>` gives to what the block is in."""
    return element.text().strip() if element.name == "name" else _name(element)


def _renamed(text: str, known: set[str], change: Callable[[str], str]) -> str:
    words = text.split()
    if not any(word in known for word in words):
        return text
    return " ".join([change(word) if word in known else word for word in words])


def _name(element: Element) -> str:
    return format_value(element.attributes.get("name"))
