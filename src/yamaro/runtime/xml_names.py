"""Puts a prefix before the names in a URDF, so that a robot can be included several times."""

from __future__ import annotations

import re

from ..xml.tree import Element, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

_BODIES = ("link", "joint")
_REFERS = re.compile("link|joint|frame|body|reference|parent|child|mimic", re.IGNORECASE)
"""Tags and attributes that name links and joints, in extensions of URDF that no schema tells of."""
_DEVICES = ("transmission", "actuator", "sensor", "ros2_control", "gpio")
"""What else is named once in a robot, whatever it is in."""
_REFERS_TO_DEVICE = re.compile("transmission|actuator|sensor|gpio", re.IGNORECASE)


def rename(root: Element, prefix: str) -> None:
    """Put a prefix before the names of a robot's links, joints, transmissions and sensors.

    Also where they are referred to; materials are another matter.
    """
    bodies = {_name(element) for element in root.elements() if element.name in _BODIES}
    devices = {_name(element) for element in _below(root) if element.name in _DEVICES}
    names = _Names(prefix, bodies, devices)
    for element in _below(root):
        names.rename(element)


class _Names:
    """Knows what is named in a robot."""

    __slots__ = ("_bodies", "_devices", "_prefix")

    def __init__(self, prefix: str, bodies: set[str], devices: set[str]) -> None:
        self._prefix = prefix
        self._bodies = bodies
        self._devices = devices

    def rename(self, element: Element) -> None:
        """Rename an element, and what it refers to."""
        for name, value in element.attributes.items():
            known = self._named_by(element) if name == "name" else self._referred_to_by(name)
            if known:
                element.attributes[name] = self._renamed(format_value(value), known)
        known = self._referred_to_by(element.name)
        if element.name == "param":  # of ros2_control: what it is called is an attribute
            known = self._referred_to_by(_name(element))
        if known:
            for child in element.children:
                if isinstance(child, Text):
                    child.value = self._renamed(format_value(child.value), known)

    def _named_by(self, element: Element) -> set[str]:
        if element.name in _BODIES:
            return self._bodies
        return self._devices if element.name in _DEVICES else set()

    def _referred_to_by(self, word: str) -> set[str]:
        """Return the names that may stand under a tag or attribute."""
        if _REFERS.search(word):
            return self._bodies
        return self._devices if _REFERS_TO_DEVICE.search(word) else set()

    def _renamed(self, text: str, known: set[str]) -> str:
        words = text.split()
        if not any(word in known for word in words):
            return text
        return " ".join([self._prefix + word if word in known else word for word in words])


def _below(root: Element) -> Iterator[Element]:
    pending = root.elements()
    while pending:
        element = pending.pop()
        yield element
        pending += element.elements()


def _name(element: Element) -> str:
    return format_value(element.attributes.get("name"))
