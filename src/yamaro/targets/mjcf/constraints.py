"""Constraints: joints that follow others, joints that close loops, pairs that do not collide."""

from __future__ import annotations

from ...model.pose import UNTURNED, Pose, rotate, transposed
from ...xml.values import format_value
from ..contacts import disturbing_pairs, lose_contacts
from ..elements import element
from ..holding import leader_of
from .model import EQUALITY, SITE, Writing, pose_attributes
from .scene import home_poses, solids_at_home

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Loop
    from ...model.link import Link
    from ...model.pose import Vector
    from ...source import Span
    from ..elements import Attributes

HINGE_LENGTH = 0.1
"""The distance in metres of the two points that make the axis of a hinge."""


def add_mimics(writing: Writing) -> None:
    """Append an equality for each joint that follows another."""
    robot = writing.robot
    for joint in robot.joints.values():
        mimic, leader = joint.mimic, leader_of(robot, joint)
        if mimic is None or leader is None or joint.name not in writing.joints:
            continue
        name, other = writing.joint_name(joint.name), writing.joint_name(leader.name)
        if writing.blocks.equality_of(joint.name, (name, other)):
            continue
        places: dict[str, Span] = {
            "joint2": mimic.span_of("joint"),
            "polycoef": mimic.span_of("multiplier"),
        }
        attributes: Attributes = {
            "name": writing.names.fresh(EQUALITY, joint.name),
            "class": writing.classes.model,
            "joint1": name,
            "joint2": other,
            "polycoef": (mimic.offset, mimic.multiplier, 0, 0, 0),
        }
        made = element("joint", attributes, owner=joint, part=mimic, places=places)
        writing.add("equality", made)


def add_loops(writing: Writing) -> None:
    """Append the equalities of joints that close loops."""
    for loop in writing.robot.loops.values():
        first, second = loop.between
        if writing.blocks.equality_of(loop.name):
            continue
        if not {first, second} <= writing.plan.carriers.keys():
            writing.losses.lose("loops between links that are not there", loop)
        elif loop.type == "fixed":
            _add(writing, loop, "weld", loop.name, (None, None))
        else:
            _add(writing, loop, "connect", loop.name, (None, None))
            if loop.type == "revolute" and loop.axis is not None:
                poses = home_poses(writing)
                first_turn, second_turn = (poses[name].rotation for name in loop.between)
                axes = loop.axis, rotate(transposed(second_turn), rotate(first_turn, loop.axis))
                _add(writing, loop, "connect", f"{loop.name}_axis", axes)


def _add(
    writing: Writing,
    loop: Loop,
    word: str,
    wanted: str,
    axes: tuple[Vector, Vector] | tuple[None, None],
) -> None:
    """Append an equality of two sites: those of two frames, or points on the axes in them."""
    name = writing.names.fresh(EQUALITY, wanted)
    sites = [
        _site(writing, loop, frame, f"{wanted}_{index}", axis)
        for index, (frame, axis) in enumerate(zip(loop.between, axes, strict=True), start=1)
    ]
    attributes: Attributes = {
        "name": name,
        "class": writing.classes.model,
        "site1": sites[0],
        "site2": sites[1],
    }
    writing.add("equality", element(word, attributes, owner=loop))


def _site(writing: Writing, loop: Loop, frame: str, wanted: str, axis: Vector | None) -> str:
    """Return the site of a frame, or a new one: in a body, or on an axis."""
    plan = writing.plan
    if axis is None and frame in plan.sites:
        return writing.site_name(frame)
    pose = plan.poses[frame]
    if axis is not None:
        x, y, z = (HINGE_LENGTH * part for part in axis)
        pose = pose @ Pose(UNTURNED, (x, y, z))
    name = writing.names.fresh(SITE, wanted)
    attributes: Attributes = {"name": name, "class": writing.classes.frame, **pose_attributes(pose)}
    writing.body_of(frame).children.append(element("site", attributes, owner=loop))
    return name


# --- contacts ---------------------------------------------------------------------------------


def add_excludes(writing: Writing) -> None:
    """Append the pairs of links whose contacts only disturb, except those that are to be kept.

    MuJoCo itself leaves out only adjacent links of which the upper body can move. Where a block has
    a section `contact`, the file itself says which pairs have none.
    """
    if writing.blocks.is_whole:
        return
    plan = writing.plan
    said = writing.blocks.in_section("contact")
    seen = {
        (format_value(each.attributes.get("body1")), format_value(each.attributes.get("body2")))
        for each in said
        if each.name == "exclude"
    }
    for first, second, overlaps in disturbing_pairs(
        writing.robot, plan.order, solids_at_home(writing), still=plan.static, world=plan.world
    ):
        if _exclude(writing, first, second, seen) and overlaps:
            lose_contacts(writing.losses, first, second)


def _exclude(writing: Writing, first: Link, second: Link, seen: set[tuple[str, str]]) -> bool:
    """Append a pair of links, unless that of their bodies is there; return whether it was not."""
    pair = (writing.body_name(first.name), writing.body_name(second.name))
    if pair in seen or pair[::-1] in seen:
        return False
    seen.add(pair)
    owner = writing.robot.parent_joint(second.name) or second
    made = element("exclude", {"body1": pair[0], "body2": pair[1]}, owner=owner)
    writing.add("contact", made)
    return True
