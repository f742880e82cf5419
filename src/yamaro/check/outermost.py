"""Elements directly under `robot`, with extensions of other programs: names, references."""

from __future__ import annotations

from ..model.schema import ELEMENTS, OTHER_FORMATS
from ..model.values import attribute_text, child_named
from ..xml.tree import Element
from .context import REFERENCES, CheckContext, place_of
from .robot import is_fixed, near_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..model.joint import Joint
    from ..model.robot import Robot
    from .robot import Tree

USED_LIKE: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "link": ((), ("inertial", "visual", "collision")),
    "joint": (("type",), ("parent", "child")),
    "material": ((), ("color", "texture")),
    "transmission": ((), ("type", "joint", "actuator")),
    "ros2_control": (("type",), ("hardware", "joint")),
}
"""Attributes and children by which an element of a misspelt name is recognised."""
PARENTS = {
    **{
        child: f"a {name}"
        for name in ("link", "joint", "material", "geometry")
        for child in ELEMENTS[name].children
    },
    **dict.fromkeys(ELEMENTS["inertial"].children, "the inertial of a link"),
    "origin": "a joint, visual, collision or inertial",
    "geometry": "a visual or collision",
    "material": "a visual",
}
LISTS = {
    "links": "there is no list of links: write each as `link/name=NAME:`, or with its joint as "
    "`part:`",
    "joints": "there is no list of joints: write each as `joint/name=NAME, type=TYPE:`, or with "
    "its link as `part:`",
    "materials": "there is no list of materials: write each as `material/name=NAME:`",
    "parts": "there is no list of parts: write each as `part:`",
}
"""Lists that other languages have directly under a robot, and what to write instead."""


def check_outermost(child: Element, context: CheckContext) -> None:
    """Check an element directly under `robot`, where everybody's extensions stand as well."""
    name = child.name
    if name in PARENTS:
        context.report(
            "unknown-element",
            f"'{name}' has no meaning directly under 'robot'; parsers ignore it",
            child,
            hint=f"it belongs in {PARENTS[name]}",
        )
        return
    if OTHER_FORMATS.get(name) == "SDF":  # MuJoCo reads a `mujoco` element in URDF
        context.report(
            "unknown-element",
            f"'{name}' is an element of {OTHER_FORMATS[name]}; parsers of URDF ignore it",
            child,
            hint="describe links and joints in URDF, or use the file where its format is read",
        )
        return
    # A robot that has links may have such elements for programs of its own.
    if (name in LISTS or name == "name") and not any(
        each.name == "link" for each in context.root.elements()
    ):
        context.report(
            "unknown-element",
            f"URDF has no element '{name}', so parsers ignore it",
            child,
            hint=LISTS.get(
                name, f"in URDF it is an attribute: `robot/name={child.text().strip()}:`"
            ),
        )
        return
    near = _near_outermost(child)
    if near is not None:
        message = f"URDF has no element '{name}', so parsers ignore it"
        report_misspelt(child, near, message, context)


def report_misspelt(child: Element, near: str, message: str, context: CheckContext) -> None:
    """Report an element whose name is nearly that of another one."""
    from ..fixes import respelling

    hint, fix = f"did you mean '{near}'?", respelling(child.span, child.name, near)
    context.report("unknown-element", message, child, hint=hint, fix=fix)


def _near_outermost(child: Element) -> str | None:
    """Return the element meant, if the name is one slip away from it and it is used like it."""
    if ":" in child.name or "name" not in child.attributes:
        return None
    for known, (attributes, children) in USED_LIKE.items():
        if not is_one_slip_away(child.name, known):
            continue
        is_used_like = any(name in child.attributes for name in attributes) or any(
            inner.name in children for inner in child.elements()
        )
        # `<line name="l"/>` may be anything; `<lnik name="l"/>` has the very letters of a link.
        if is_used_like or sorted(child.name.lower()) == sorted(known):
            return known
    return None


def is_one_slip_away(word: str, known: str) -> bool:
    """Return whether one letter too many, too few, wrong, swapped or of another case separates."""
    if word.lower() == known.lower():
        return word != known
    if abs(len(word) - len(known)) > 1:
        return False
    start = 0
    while start < min(len(word), len(known)) and word[start] == known[start]:
        start += 1
    left, right = word[start:], known[start:]
    if len(word) == len(known):
        swapped = left[:2] == right[:2][::-1] and left[2:] == right[2:]
        return swapped or left[1:] == right[1:]
    return left[1:] == right if len(word) > len(known) else left == right[1:]


# --- what they refer to -----------------------------------------------------------------------
# Only places whose meaning is documented are looked at; what plugins hold is theirs.


def check_references(robot: Robot, tree: Tree, context: CheckContext) -> None:
    """Check what `gazebo`, `transmission`, `ros2_control`, `sensor` and `mimic` refer to."""
    context.stage = REFERENCES
    for element in robot.element.children:
        if not isinstance(element, Element):
            continue
        context.outermost = element
        if element.name == "gazebo":
            _check_gazebo(element, tree, context)
        elif element.name == "transmission":
            _check_transmission(element, tree, context)
        elif element.name == "ros2_control":
            for driven in _children(element, "joint"):
                _check_joint_name(driven, "this 'ros2_control' block", tree, context)
                for param in _children(driven, "param"):
                    name = param.text().strip()
                    is_mimic = attribute_text(param, "name") == "mimic"
                    if is_mimic and name and name not in tree.joints:
                        _report_joint(name, param, None, "this 'mimic' parameter", tree, context)
            for transmission in _children(element, "transmission"):
                _check_transmission(transmission, tree, context)
        elif element.name == "sensor":
            _check_sensor(element, tree, context)
    for joint in robot.all_joints:
        if joint.mimic is not None:
            context.outermost = joint.element
            _check_mimic(joint, tree, context)
    context.outermost = None


def _check_gazebo(gazebo: Element, tree: Tree, context: CheckContext) -> None:
    """Report a block for a link or joint that is not there: Gazebo drops it without a word."""
    name = attribute_text(gazebo, "reference")
    if not name or name in tree.links or name in tree.joints:
        return
    span = gazebo.value_span("reference")
    hint, fix = near_name(span, name, tree, "_link", context)
    if hint is None:
        hint, fix = near_name(span, name, tree, "_joint", context)
    context.report(
        "unknown-reference",
        f"this block refers to '{name}', which is not a link or joint of the robot",
        gazebo,
        attribute="reference",
        hint=hint or "refer to an existing link or joint; Gazebo ignores the block",
        fix=fix,
    )


def _check_transmission(transmission: Element, tree: Tree, context: CheckContext) -> None:
    """Report joints that are not there: ros_control does not load the transmission.

    The old style, of the PR2, has its joints in the same place as the one with a `type` element.
    """
    for joint in _children(transmission, "joint"):
        _check_joint_name(joint, "this transmission", tree, context)


def _check_sensor(sensor: Element, tree: Tree, context: CheckContext) -> None:
    """Report a sensor on a link that is not there; no reader could place it."""
    parent = child_named(sensor, "parent")
    name = attribute_text(parent, "link")
    if parent is None or not name or name in tree.links:
        return
    hint, fix = near_name(parent.value_span("link"), name, tree, "_link", context)
    context.report(
        "unknown-reference",
        f"the sensor '{attribute_text(sensor, 'name') or ''}' is on '{name}', which is not a link "
        "of the robot",
        parent,
        attribute="link",
        hint=hint or "refer to an existing link",
        fix=fix,
    )


def _check_joint_name(joint: Element, holder: str, tree: Tree, context: CheckContext) -> None:
    name = attribute_text(joint, "name")
    if name and name not in tree.joints:
        _report_joint(name, joint, "name", holder, tree, context)


def _report_joint(
    name: str,
    element: Element,
    attribute: str | None,
    holder: str,
    tree: Tree,
    context: CheckContext,
) -> None:
    span = place_of(element, attribute)
    hint, fix = near_name(span, name, tree, "_joint", context)
    context.report(
        "unknown-joint",
        f"{holder} names '{name}', which is not a joint of the robot",
        element,
        attribute=attribute,
        hint=hint or "refer to an existing joint",
        fix=fix,
    )


def _check_mimic(joint: Joint, tree: Tree, context: CheckContext) -> None:
    """Report a joint that mimics a fixed one: joint_state_publisher and MoveIt never move it."""
    mimic = joint.mimic
    master = tree.joints.get(mimic.joint) if mimic is not None else None
    if mimic is None or master is None or is_fixed(joint) or not is_fixed(master):
        return
    context.report(
        "fixed-mimic",
        f"joint '{joint.name}' mimics '{master.name}', which is fixed, so it never moves",
        mimic.element,
        attribute="joint",
        hint="mimic a joint that moves",
    )


def _children(element: Element, name: str) -> Iterator[Element]:
    for child in element.children:
        if isinstance(child, Element) and child.name == name:
            yield child
