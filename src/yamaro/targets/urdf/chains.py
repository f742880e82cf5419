"""Universal joints and screws of SDF in URDF: chains of joints, with links without mass between.

A universal joint turns about its first axis, then about its second one. A screw turns, and slides
along the same axis by its pitch for each turn: a joint that follows the other. The joint of SDF is
the last of the chain, and fixed: it leads from where the axes meet to the link.
"""

from __future__ import annotations

from math import inf, isfinite

from ...model import making
from ...model.joint import CONTINUOUS, FIXED, PRISMATIC, REVOLUTE, UNLIMITED
from ...model.making import Place
from ...model.pose import UNTURNED, Pose
from ...model.values import child_named, content, numbers_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container

    from ...model.robot import Robot
    from ...xml.tree import Element, Node
    from ..translation import Move

NONE = 10 * UNLIMITED
"""A limit that means none."""
LIMITS = {"lower", "upper", "effort", "velocity"}
DYNAMICS = {"damping", "friction"}


def chain(
    robot: Robot, name: str, moves: list[Move], where: tuple[float, ...], factor: float | None
) -> list[Element]:
    """Return the joints and links that are a joint of SDF together.

    Args:
        robot: the robot.
        name: the name of the joint, which is fixed in the model.
        moves: how it moves, from the parent to the child.
        where: where it is in its child.
        factor: by how much the second of the moves follows the first one, in m/rad; None if it does
            not.
    """
    joint = robot.joints[name]
    x, y, z = where
    above = joint.parent
    made: list[Element] = []
    at_joint = joint.origin @ Pose(UNTURNED, (x, y, z))
    place = Place(joint.span)
    names: list[str] = []
    for move in moves:
        names.append(_fresh(f"{name}_{move.suffix}", robot.joints))
        link = _fresh(f"{names[-1]}_link", robot.links)
        inner: list[Node] = []
        if not made:
            inner.append(making.origin(place, at_joint.position, at_joint.rpy))
        inner.append(making.element("axis", Place(move.element.span), {"xyz": move.axis}))
        kind = PRISMATIC
        if move.slides:
            ends = {"lower": -NONE, "upper": NONE, "effort": NONE, "velocity": NONE}
            inner.append(making.element("limit", place, ends))
            values = {"joint": names[0], "multiplier": factor}
            inner.append(making.element("mimic", place, values))
        else:
            kind, said = _said(move.element)
            inner += said
        made += [making.joint(place, names[-1], kind, above, link, inner), making.link(place, link)]
        above = link
    back = [making.origin(place, (-x, -y, -z))] if any(where) else []
    return [*made, making.joint(place, name, FIXED, above, joint.child, back)]


def is_whole(axis: Element) -> bool:
    """Return whether URDF has all that an axis of SDF says."""
    known: dict[str, set[str]] = {"xyz": set(), "limit": LIMITS, "dynamics": DYNAMICS}
    return all(
        each.name in known and {inner.name for inner in each.elements()} <= known[each.name]
        for each in axis.elements()
    )


def _said(axis: Element) -> tuple[str, list[Element]]:
    """Return the type of a joint that turns about an axis of SDF, its limit and dynamics."""
    limit, dynamics = child_named(axis, "limit"), child_named(axis, "dynamics")
    given = {
        each.name: numbers[0]
        for owner in (limit, dynamics)
        for each in (owner.elements() if owner is not None else ())
        if len(numbers := numbers_in(content(each))) == 1
    }
    lower, upper = given.get("lower", -inf), given.get("upper", inf)
    is_limited = any(isfinite(end) and abs(end) < UNLIMITED for end in (lower, upper))
    most = {name: given.get(name, -1.0) for name in ("effort", "velocity")}
    most = {name: value if 0 <= value < UNLIMITED else NONE for name, value in most.items()}
    ends = {"lower": max(lower, -NONE), "upper": min(upper, NONE)} if is_limited else {}
    found = []
    if is_limited or min(most.values()) < NONE:
        span = limit.span if limit is not None else axis.span
        found.append(making.element("limit", Place(span), {**ends, **most}))
    values = {name: given[name] for name in ("damping", "friction") if given.get(name)}
    if dynamics is not None and values:
        found.append(making.element("dynamics", Place(dynamics.span), values))
    return REVOLUTE if is_limited else CONTINUOUS, found


def _fresh(name: str, taken: Container[str]) -> str:
    """Return a name that is not taken, such as the one that is given."""
    found, number = name, 1
    while found in taken:
        number += 1
        found = f"{name}_{number}"
    return found


def in_tree(root: Element, chains: dict[str, list[Element]], robot: Robot) -> Element:
    """Return a `<robot>` with the chains in place of their joints."""
    places = {id(robot.joints[name].element): made for name, made in chains.items()}
    children: list[Node] = []
    for child in root.children:
        children += places.get(id(child), [child])
    return root.with_children(children)
