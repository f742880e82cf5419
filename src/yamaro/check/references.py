"""Check of what refers to links and joints by name outside of the joints: extensions of URDF.

Only places whose meaning is documented are looked at; what plugins hold is theirs.
"""

from __future__ import annotations

from ..model.values import attribute_text, child_named
from ..xml.tree import Element
from .context import REFERENCES, CheckContext, place_of
from .tree import is_fixed, near_name

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..model.joint import Joint
    from ..model.robot import Robot
    from .tree import Tree


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
            _check_ros2_control(element, tree, context)
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
    context.warn(
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


def _check_ros2_control(control: Element, tree: Tree, context: CheckContext) -> None:
    """Report joints that are not there: ros2_control ends with an error, or commands nothing."""
    for joint in _children(control, "joint"):
        _check_joint_name(joint, "this 'ros2_control' block", tree, context)
        for param in _children(joint, "param"):
            name = param.text().strip()
            if attribute_text(param, "name") == "mimic" and name and name not in tree.joints:
                _report_joint(name, param, None, "this 'mimic' parameter", tree, context)
    for transmission in _children(control, "transmission"):
        _check_transmission(transmission, tree, context)


def _check_sensor(sensor: Element, tree: Tree, context: CheckContext) -> None:
    """Report a sensor on a link that is not there; no reader could place it."""
    parent = child_named(sensor, "parent")
    name = attribute_text(parent, "link")
    if parent is None or not name or name in tree.links:
        return
    hint, fix = near_name(parent.value_span("link"), name, tree, "_link", context)
    context.warn(
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
    context.warn(
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
    context.warn(
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
