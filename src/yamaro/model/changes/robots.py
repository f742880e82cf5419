"""Compares two robots by meaning; see `Robot.changes`."""

from __future__ import annotations

from .change import ADDED, CHANGED, REMOVED, RENAMED, Change, Changes
from .context import Comparing, Owner
from .elements import compare_other_elements, compare_rest
from .extras import compare_extras, extras_held
from .joints import compare_joints, joint_facts
from .links import compare_links, link_facts
from .matching import Matching
from .materials import compare_materials
from .motion import KINEMATIC, MotionComparison
from .tolerance import DEFAULT, Tolerance

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from ..joint import Joint
    from ..link import Link
    from ..pose import Vector
    from ..robot import Robot
    from .context import SameFile

COMPARISONS: dict[str, tuple[Callable[..., None], Callable[..., object]]] = {
    "link": (compare_links, link_facts),
    "joint": (compare_joints, joint_facts),
}
"""How links and joints are compared, and what to say of one that only one robot has."""


def compare_robots(
    first: Robot,
    second: Robot,
    *,
    tolerance: float = DEFAULT,
    same_file: SameFile | None = None,
    has_extras: bool = True,
) -> Changes:
    """Return what changed from one robot to another.

    Args:
        first: the robot before.
        second: the robot after.
        tolerance: how far numbers may differ, as a part of the larger one; rotations in radians.
        same_file: says whether two mesh or texture files have the same content; by default they
            are compared by name.
        has_extras: whether both robots can hold what URDF has no elements for, such as sensors.
    """
    matching = Matching(first, second)
    comparing = Comparing(
        first, second, matching=matching, tolerance=Tolerance(tolerance), same_file=same_file
    )
    owner = Owner("robot", first.name, new_name=None, places=(first.span, second.span))
    comparing.text(owner, "name", (first.name, second.name))
    compare_materials(comparing)
    _compare_all("link", (first.links, second.links), matching.links, comparing)
    _compare_all("joint", (first.joints, second.joints), matching.joints, comparing)
    compare_other_elements(comparing)
    if has_extras:
        compare_extras(comparing)
    return _with_consequences(comparing, has_extras=has_extras)


def _compare_all(
    of: str,
    rows: tuple[Mapping[str, Link | Joint], Mapping[str, Link | Joint]],
    names: dict[str, str],
    comparing: Comparing,
) -> None:
    """Compare all links, or all joints: those that both robots have, and those that one has."""
    compare, facts = COMPARISONS[of]
    first, second = rows
    for name, one in first.items():
        if name not in names:
            comparing.add(of, name, is_new=False, value=facts(one), place=one.span)
            continue
        other = second[names[name]]
        _note_renamed(of, one, other, comparing)
        if one.element is not other.element:
            compare(one, other, comparing)
            owner = Owner(of, one.name, new_name=other.name, places=(one.span, other.span))
            compare_rest(one.element, other.element, "", owner, comparing)
    known = set(names.values())
    for name, other in second.items():
        if name not in known:
            comparing.add(of, name, is_new=True, value=facts(other), place=other.span)


def _note_renamed(of: str, one: Link | Joint, other: Link | Joint, comparing: Comparing) -> None:
    if one.name != other.name:
        renamed = Change(
            RENAMED, of, one.name, new_name=other.name, first=one.span, second=other.span
        )
        comparing.changes.append(renamed)


# --- what follows ---


def _with_consequences(comparing: Comparing, *, has_extras: bool) -> Changes:
    """Return the changes with the links that moved because of them."""
    first, second = comparing.first, comparing.second
    motions = MotionComparison(comparing)
    causes: dict[str, Change] = {}
    for change in comparing.changes:
        if change.of == "joint" and _could_move(change):
            causes.setdefault(change.name, change)
    for cause, moved in motions.moved_by(list(causes.values())):
        cause.moved = moved
    new = comparing.matching.links.get(motions.reference, "")
    skipped = [] if has_extras else [*extras_held(first), *extras_held(second)]
    return Changes(
        comparing.changes,
        motion=motions.motion(),
        mass=(first.mass, second.mass),
        center=(_center(first, motions.reference), _center(second, new)),
        links=comparing.matching.links,
        joints=comparing.matching.joints,
        skipped=skipped,
    )


def _could_move(change: Change) -> bool:
    """Return whether links can be elsewhere because of a change of a joint."""
    if change.kind in (ADDED, REMOVED):
        return True
    return change.kind == CHANGED and change.what.partition(".")[0] in KINEMATIC


def _center(robot: Robot, reference: str) -> Vector | None:
    """Return the centre of mass in the frame of a link, with all joints at zero."""
    if not robot.mass:
        return None
    center = robot.center_of_mass()
    return robot.pose(reference).inverse().apply(center) if reference else center
