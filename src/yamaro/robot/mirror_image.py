"""The mirror image of lowered links and joints.

S is the reflection in the plane, a diagonal matrix with −1 for the plane's normal. A pose (R, x)
becomes (S·R·S, S·x), an inertia I becomes S·I·S. An axis is mirrored as what it moves: a prismatic
joint's a becomes S·a, a revolute one's, which turns the other way in a mirror, −S·a.

Source: E. W. Weisstein, "Pseudovector", MathWorld; R. Featherstone, Rigid Body Dynamics
Algorithms, section 2.8, for the transformation of inertia.
"""

from __future__ import annotations

from ..model.pose import Pose
from ..model.schema import ELEMENTS, KEPT, NEGATED, RECORDS
from ..xml.tree import Comment, Element, RawBlock, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..xml.tree import Node

PLANES = {"yz": 0, "xz": 1, "xy": 2}
"""The planes, each with the number of its normal."""

_MOMENTS = {"ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}
_TURNING = ("revolute", "continuous")
_SLIDING = ("prismatic", "planar")


def negated(word: str) -> str:
    """Return a number with the other sign, in its spelling; a zero as it is."""
    if float(word) == 0:
        return word
    if word.startswith("-"):
        return word[1:]
    return "-" + word.removeprefix("+")


def mirrored_row(text: str, normal: int, *, turns: bool = False) -> str:
    """Return three numbers mirrored: a position S·x, or angles, of which two change their sign."""
    words = text.split()
    return " ".join(
        negated(word) if (index == normal) != turns else word for index, word in enumerate(words)
    )


def mirrored_pose(pose: Pose, normal: int) -> Pose:
    """Return the pose (S·R·S, S·x)."""
    (a, b, c), (d, e, f), (g, h, i) = [
        tuple(-x if (row == normal) != (column == normal) else x for column, x in enumerate(values))
        for row, values in enumerate(pose.rotation)
    ]
    x, y, z = [-each if row == normal else each for row, each in enumerate(pose.position)]
    return Pose(((a, b, c), (d, e, f), (g, h, i)), (x, y, z))


def copy_of(element: Element) -> Element:
    """Return a copy of an element and of all that is in it."""
    children: list[Node] = []
    for child in element.children:
        if isinstance(child, Element):
            children.append(copy_of(child))
        elif isinstance(child, Text):
            children.append(Text(child.value, child.span))
        else:
            children.append(child)
    copy = element.with_children(children)
    copy.attributes = dict(element.attributes)
    return copy


def mirror_origin(element: Element, normal: int) -> None:
    """Mirror the `<origin>` in an element."""
    for origin in element.elements():
        if origin.name == "origin":
            change_text(origin, "xyz", lambda text: mirrored_row(text, normal))
            change_text(origin, "rpy", lambda text: mirrored_row(text, normal, turns=True))


def mirror_link(link: Element, normal: int) -> None:
    """Mirror a link's inertia and shapes; what its meshes need is another matter."""
    for section in link.elements():
        if section.name in ("inertial", "visual", "collision"):
            mirror_origin(section, normal)
        if section.name != "inertial":
            continue
        for inertia in section.elements():
            if inertia.name == "inertia":
                for name, axes in _MOMENTS.items():
                    if normal in axes:
                        change_text(inertia, name, negated)


def meshes_of(link: Element) -> list[Element]:
    """Return the `<mesh>` elements of a link."""
    return [
        mesh
        for section in link.elements()
        if section.name in ("visual", "collision")
        for geometry in section.elements()
        if geometry.name == "geometry"
        for mesh in geometry.elements()
        if mesh.name == "mesh"
    ]


def turn_mesh(mesh: Element, normal: int) -> None:
    """Scale a mesh by −1 along the plane's normal."""
    if mesh.attributes.get("scale") is None:
        mesh.attributes["scale"] = "1 1 1"
    change_text(mesh, "scale", lambda text: mirrored_row(text, normal))


def mirrored_axis(joint: Element, normal: int) -> tuple[str, str] | None:
    """Return a joint's axis and its image, or None if it has none that counts."""
    kind = format_value(joint.attributes.get("type"))
    if kind not in _TURNING + _SLIDING:
        return None
    axis = "1 0 0"
    for child in joint.elements():
        if child.name == "axis" and child.attributes.get("xyz") is not None:
            axis = format_value(child.attributes["xyz"])
    return axis, mirrored_row(axis, normal, turns=kind in _TURNING)


def set_axis(joint: Element, axis: str) -> None:
    """Give a joint another axis."""
    for child in joint.elements():
        if child.name == "axis":
            child.attributes["xyz"] = axis
            return
    joint.children.append(Element("axis", joint.span, {"xyz": axis}, trace=joint.trace))


def reverse(joint: Element) -> None:
    """Let the positions of a joint count the other way: its limits change sides and signs."""
    for part in joint.elements():
        for field in ELEMENTS[part.name].fields.values() if part.name in RECORDS else ():
            if field.reversal == NEGATED:
                change_text(part, field.name, negated)
            elif field.reversal != KEPT and field.name < field.reversal:  # each pair once
                _swap(part, field.name, field.reversal)


def _swap(element: Element, lower: str, upper: str) -> None:
    """Give each of two limits the negated value of the other, in the order they were written.

    Its place goes with it.
    """
    old, places = element.attributes, element.value_spans
    if lower not in old and upper not in old:
        return
    other = {lower: upper, upper: lower}
    new: dict[str, object] = {}
    for name, value in old.items():
        if name not in other:
            new[name] = value
        elif other[name] in old:
            new[name] = negated(format_value(old[other[name]]).strip())
        else:
            new[other[name]] = negated(format_value(value).strip())
    element.attributes = new
    if places is not None:
        moved = {name: places.get(other.get(name, name)) for name in new}
        element.value_spans = {name: place for name, place in moved.items() if place is not None}


def reverse_interfaces(joint: Element) -> None:
    """Let the interfaces of a joint in `<ros2_control>` count the other way, as `reverse` does."""
    for interface in joint.elements():
        params = {format_value(each.attributes.get("name")): each for each in interface.elements()}
        for name in ("min", "max", "initial_value"):
            if name in params:
                for text in params[name].children:
                    if isinstance(text, Text):
                        text.value = _negated_text(format_value(text.value))
        if "min" in params and "max" in params:
            low, high = params["min"], params["max"]
            low.children, high.children = high.children, low.children
        elif "min" in params:
            params["min"].attributes["name"] = "max"
        elif "max" in params:
            params["max"].attributes["name"] = "min"


def _negated_text(text: str) -> str:
    try:
        return negated(text.strip())
    except ValueError:
        return text


def reverse_mimic(joint: Element, *, follower: int, leader: int) -> None:
    """Let a joint follow its leader as before, where the positions of either count the other way.

    From q = multiplier · q_leader + offset, with q' = follower · q and so for the leader.
    """
    for mimic in joint.elements():
        if mimic.name != "mimic":
            continue
        if follower * leader < 0:
            mimic.attributes.setdefault("multiplier", "1")
            change_text(mimic, "multiplier", negated)
        if follower < 0:
            change_text(mimic, "offset", negated)


def change_text(element: Element, attribute: str, change: Callable[[str], str]) -> None:
    """Change an attribute that holds numbers; other text stays, and is reported elsewhere."""
    value = element.attributes.get(attribute)
    if value is None:
        return
    try:
        element.attributes[attribute] = change(format_value(value).strip())
    except ValueError:
        return


def holds_pose(element: Element) -> bool:
    """Return whether some XML may hold a pose, which is not mirrored."""
    words: tuple[str, ...] = ("pose", "origin", "xyz", "rpy")
    if isinstance(element, RawBlock):
        words += ("pos", "quat", "euler", "axisangle", "zaxis", "fromto", "axis", "gravity")
    pending: list[Node] = [element]
    while pending:
        node = pending.pop()
        if isinstance(node, (Text, Comment)):
            continue
        if node.name in words or any(name in words for name in node.attributes):
            return True
        pending += node.children
    return False


def what_it_says(node: Node) -> object:
    """Return what a node says, without its places: two are equal if it is the same."""
    if isinstance(node, Element):
        attributes = {name: format_value(value) for name, value in node.attributes.items()}
        return node.name, attributes, [what_it_says(child) for child in node.children]
    return format_value(node.value) if isinstance(node, Text) else None
