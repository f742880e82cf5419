"""The overlay that leads from one robot to another, as far as one can: `yamaro diff --overlay`.

It names each value of the joints and links of the first robot that the second one has otherwise, by
the rows of the schema. A comparison shows whether it says all.
"""

from __future__ import annotations

from ...model.reading import DYNAMICS
from ...model.schema import ACTUATOR, ELEMENTS, RECORDS, TEXT
from ...xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ...model.extras import Actuator
    from ...model.joint import Joint
    from ...model.robot import Robot
    from ...xml.tree import Element, Node

    Said = dict[str, "str | Said"]

POSE = ("xyz", "rpy")
DERIVED = {"frequency": ("kp", "kd"), "rotor_inertia": ("armature",)}
"""Entries of an actuator, each with those that follow from it."""


def overlay_between(first: Robot, second: Robot, renamed: Mapping[tuple[str, str], str]) -> Said:
    """Return what leads from the values of one robot to those of another, by the first names.

    Args:
        first: the robot that the overlay changes.
        second: what it becomes.
        renamed: the names in the second robot of links and joints that have others there, by
            `link` or `joint` and the name in the first one.
    """
    joints: Said = {}
    for name, joint in first.joints.items():
        other = second.joints.get(renamed.get(("joint", name), name))
        if other is not None:
            said = _joint(joint, other)
            actuator = _actuator(first.actuators.get(name), second.actuators.get(other.name))
            if actuator:
                said["actuator"] = actuator
            if said:
                joints[name] = said
    links: Said = {}
    for name, link in first.links.items():
        same = second.links.get(renamed.get(("link", name), name))
        if same is not None:
            said = _link(link.element, same.element)
            if said:
                links[name] = said
    overlay: Said = {}
    if joints:
        overlay["joints"] = joints
    if links:
        overlay["links"] = links
    return overlay


def _joint(first: Joint, second: Joint) -> Said:
    one, other = (_with_dynamics(each) for each in (first, second))
    said: Said = {}
    kinds = [format_value(each.attributes.get("type")) for each in (one, other)]
    if kinds[0] != kinds[1]:
        said["type"] = kinds[1]
    said |= _pose(one, other)
    for name in RECORDS:
        values = _record(name, one, other)
        if values:
            said[name] = values
    return said


def _with_dynamics(joint: Joint) -> Element:
    """Return the element of a joint with all of its `dynamics`, also what URDF does not have."""
    element, dynamics = joint.element, joint.dynamics
    if dynamics is None or not dynamics.armature:
        return element
    rest: list[Node] = [each for each in element.children if each is not _child(element, DYNAMICS)]
    return element.with_children([*rest, dynamics.element])


def _link(one: Element, other: Element) -> Said:
    inner = [_child(each, "inertial") for each in (one, other)]
    if inner[1] is None:
        return {}
    before = inner[0] if inner[0] is not None else inner[1].with_children([])
    said: Said = {}
    mass = _record("mass", before, inner[1])
    if mass:
        said["mass"] = mass["value"]
    inertia = _record("inertia", before, inner[1])
    if inertia:
        said["inertia"] = inertia
    pose = _pose(before, inner[1])
    if pose:
        said["inertial"] = pose
    return said


def _pose(one: Element, other: Element) -> Said:
    """Return the rows of an `<origin>` that differ; one that is left out is one of zeros."""
    rows = [
        {name: _numbers(origin, name) or "0 0 0" for name in POSE}
        for origin in (_child(one, "origin"), _child(other, "origin"))
    ]
    return {name: rows[1][name] for name in POSE if not _are_equal(rows[0][name], rows[1][name])}


def _record(name: str, one: Element, other: Element) -> Said:
    """Return the values of a child that differ; one that the second lacks is its default."""
    before, after = _child(one, name), _child(other, name)
    said: Said = {}
    for field in ELEMENTS[name].fields.values():
        values = [None if each is None else _numbers(each, field.name) for each in (before, after)]
        old, new = values
        if new is None and old is not None and field.count != TEXT and field.default is not None:
            default = field.default if isinstance(field.default, tuple) else (field.default,)
            new = " ".join(map(format_value, default))
        if new is None or (old is not None and _are_equal(old, new)):
            continue
        said[field.name] = new
    return said


def _actuator(one: Actuator | None, other: Actuator | None) -> Said:
    """Return the entries of an actuator that differ, without those that follow from others."""
    before, after = (
        {}
        if each is None
        else {
            name: format_value(value)
            for name, value in each.element.attributes.items()
            if name in ACTUATOR.fields and name != "motor" and value is not None
        }
        for each in (one, other)
    )
    said: Said = {
        name: value
        for name, value in after.items()
        if name not in before or not _are_equal(before[name], value)
    }
    for name, derived in DERIVED.items():
        if name in after:
            for each in derived:
                said.pop(each, None)
    return said


def _child(element: Element, name: str) -> Element | None:
    return next((each for each in element.elements() if each.name == name), None)


def _numbers(element: Element | None, name: str) -> str | None:
    value = None if element is None else element.attributes.get(name)
    return None if value is None else format_value(value).strip()


def _are_equal(one: str, other: str) -> bool:
    """Return whether two texts are the same, or rows of the same numbers."""
    if one == other:
        return True
    try:
        return [float(each) for each in one.split()] == [float(each) for each in other.split()]
    except ValueError:
        return False


# --- as text ------------------------------------------------------------------------------------


def overlay_text(overlay: Said) -> str:
    """Return an overlay as the file that it is."""
    if not overlay:
        return "overlay: {}\n"
    return "\n".join(["overlay:", *_lines(overlay, 1)]) + "\n"


def _lines(said: Said, depth: int) -> Iterator[str]:
    for name, value in said.items():
        key = "  " * depth + _spelled(name)
        if isinstance(value, str):
            yield f"{key}: {_spelled(value)}"
        elif depth > 2 and all(isinstance(each, str) for each in value.values()):
            inner = ", ".join(f"{_spelled(n)}: {_spelled(str(v))}" for n, v in value.items())
            yield f"{key}: {{{inner}}}"
        else:
            yield f"{key}:"
            yield from _lines(value, depth + 1)


def _spelled(text: str) -> str:
    """Return a text as YAML, in quotes where it would be something else without."""
    is_plain = text.replace(" ", "a").replace(".", "a").replace("-", "a").replace("_", "a")
    is_plain = is_plain.replace("+", "a").replace("/", "a")
    if is_plain.isalnum() and is_plain.isascii() and text.strip() == text and text[0] not in "-+/":
        return text
    try:
        [float(each) for each in text.split()]
    except ValueError:
        import json

        return json.dumps(text, ensure_ascii=False)
    return text
