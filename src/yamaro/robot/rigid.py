"""Poses of lowered links that are rigidly joined, by the `<origin>` of their fixed joints."""

from __future__ import annotations

from ..model.pose import IDENTITY, ZERO, Pose, rotation_from_rpy
from ..xml.tree import Element
from ..xml.values import format_value
from .numbers import format_component

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..model.pose import Vector


def name_of(element: Element) -> str:
    """Return the name that an element gives itself."""
    return format_value(element.attributes.get("name"))


def link_of(reference: Element) -> str:
    """Return the link that a `<parent>` or `<child>` names."""
    return format_value(reference.attributes.get("link"))


def ends_of(joint: Element) -> dict[str, str]:
    """Return the links that a joint names as its `parent` and `child`."""
    return {
        each.name: link_of(each) for each in joint.elements() if each.name in ("parent", "child")
    }


def child_links(elements: Iterable[Element]) -> set[str]:
    """Return the links that are the child of a joint among some elements."""
    ends = [ends_of(each) for each in elements if each.name == "joint"]
    return {end["child"] for end in ends if "child" in end}


def origin_of(element: Element) -> Element | None:
    """Return the `<origin>` in an element."""
    return next((each for each in element.elements() if each.name == "origin"), None)


def pose_of(element: Element) -> Pose:
    """Return the pose that the `<origin>` in a joint or section gives."""
    origin = origin_of(element)
    if origin is None:
        return IDENTITY
    roll, pitch, yaw = _row(origin, "rpy")
    return Pose(rotation_from_rpy(roll, pitch, yaw), _row(origin, "xyz"))


def set_pose(element: Element, pose: Pose) -> None:
    """Write a pose into the `<origin>` of an element, which is added if there is none."""
    old = origin_of(element)
    source = element if old is None else old
    attributes: dict[str, object] = {
        "xyz": " ".join(map(format_component, pose.position)),
        "rpy": " ".join(map(format_component, pose.rpy)),
    }
    origin = Element("origin", source.span, attributes, trace=source.trace)
    if old is None:
        element.children.append(origin)
    else:
        element.children[element.children.index(old)] = origin


def _row(origin: Element, name: str) -> Vector:
    words = format_value(origin.attributes.get(name) or "0 0 0").split()
    try:
        x, y, z = map(float, words)
    except ValueError:
        return ZERO
    return x, y, z


class RigidLinks:
    """Which of some links are rigidly joined, and their poses in each other."""

    __slots__ = ("_above",)

    def __init__(self, elements: Iterable[Element] = ()) -> None:
        """Take the fixed joints among some elements of a robot."""
        self._above: dict[str, tuple[str, Element]] = {}
        self.add(elements)

    def add(self, elements: Iterable[Element]) -> None:
        """Take the fixed joints among more elements."""
        for joint in elements:
            if joint.name == "joint" and format_value(joint.attributes.get("type")) == "fixed":
                ends = ends_of(joint)
                if len(ends) == 2:
                    self._above[ends["child"]] = (ends["parent"], joint)

    def top_of(self, link: str) -> tuple[str, Pose]:
        """Return the first link that a link is rigidly joined to, and its pose in it."""
        pose = IDENTITY
        seen: set[str] = set()
        while link in self._above and link not in seen:
            seen.add(link)
            link, joint = self._above[link]
            pose = pose_of(joint) @ pose
        return link, pose
