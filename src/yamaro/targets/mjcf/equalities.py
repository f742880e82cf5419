"""Equalities: joints that follow others, and joints that close loops."""

from __future__ import annotations

from ...model.pose import UNTURNED, Pose, rotate, transposed
from ..output import LOST
from ..shared_losses import leader_of
from .names import EQUALITY, SITE
from .solids import home_poses
from .writing import Writing, made, pose_attributes, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Loop
    from ...model.pose import Vector
    from ...source import Span

HINGE_LENGTH = 0.1
"""The distance in metres of the two points that make the axis of a hinge."""


def add_mimics(writing: Writing) -> None:
    """Append an equality for each joint that follows another."""
    robot = writing.robot
    for joint in robot.joints.values():
        mimic, leader = joint.mimic, leader_of(robot, joint)
        if mimic is None or leader is None or joint.child not in writing.plan.carriers:
            continue
        places: dict[str, Span] = {
            "joint2": mimic.span_of("joint"),
            "polycoef": mimic.span_of("multiplier"),
        }
        attributes = {
            "name": writing.names.fresh(EQUALITY, joint.name),
            "class": writing.classes.model,
            "joint1": joint.name,
            "joint2": leader.name,
            "polycoef": row((mimic.offset, mimic.multiplier, 0, 0, 0)),
        }
        trace = mimic.trace_in(joint)
        writing.add("equality", made("joint", mimic, attributes, trace, places))


def add_loops(writing: Writing) -> None:
    """Append the equalities of joints that close loops."""
    for loop in writing.robot.loops.values():
        first, second = loop.between
        if not {first, second} <= writing.plan.carriers.keys():
            what = "loops between links that are not there"
            writing.lose(LOST, what, f"loop '{loop.name}'", loop.span, trace=loop.trace)
        elif loop.type == "fixed":
            _add(writing, loop, "weld", loop.name, (None, None))
        else:
            _add(writing, loop, "connect", loop.name, (None, None))
            if loop.type == "revolute" and loop.axis is not None:
                _add(writing, loop, "connect", f"{loop.name}_axis", _axes(writing, loop, loop.axis))


def _axes(writing: Writing, loop: Loop, axis: Vector) -> tuple[Vector, Vector]:
    """Return the axis of a loop's hinge in both of its frames, as the robot stands at home."""
    poses = home_poses(writing)
    first, second = (poses[name].rotation for name in loop.between)
    return axis, rotate(transposed(second), rotate(first, axis))


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
    default = writing.classes.model
    attributes = {"name": name, "class": default, "site1": sites[0], "site2": sites[1]}
    writing.add("equality", made(word, loop, attributes, loop.trace))


def _site(writing: Writing, loop: Loop, frame: str, wanted: str, axis: Vector | None) -> str:
    """Return the site of a frame, or a new one: in a body, or on an axis."""
    plan = writing.plan
    if axis is None and frame in plan.sites:
        return frame
    pose = plan.poses[frame]
    if axis is not None:
        x, y, z = (HINGE_LENGTH * part for part in axis)
        pose = pose @ Pose(UNTURNED, (x, y, z))
    name = writing.names.fresh(SITE, wanted)
    attributes = {"name": name, "class": writing.classes.frame, **pose_attributes(pose)}
    writing.body_of(frame).children.append(made("site", loop, attributes, loop.trace))
    return name
