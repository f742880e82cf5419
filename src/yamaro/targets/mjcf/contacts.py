"""Pairs of bodies that do not collide: those that a joint connects."""

from __future__ import annotations

from itertools import combinations

from ...model.joint import FIXED
from .writing import Writing, made

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...model.link import Link


def add_excludes(writing: Writing) -> None:
    """Append the pairs of adjacent links, also across links that have no shapes to collide.

    Source: MoveIt's setup assistant calls these pairs adjacent; MuJoCo leaves out only those of
    which the upper body can move.
    """
    rigid = _rigid_groups(writing)
    seen: set[tuple[str, str]] = set()
    for first, second in _adjacent(writing):
        if rigid[first.name] == rigid[second.name]:
            continue
        pair = (writing.body_name(first.name), writing.body_name(second.name))
        if pair in seen:
            continue
        seen.add(pair)
        attributes = {"body1": pair[0], "body2": pair[1]}
        joint = writing.robot.parent_joint(second.name)
        owner = joint or second
        writing.add("contact", made("exclude", owner, attributes, owner.trace))


def _rigid_groups(writing: Writing) -> dict[str, str]:
    """Return the uppermost link that fixed joints connect each link to."""
    groups: dict[str, str] = {}
    for link in writing.plan.order:
        joint = writing.robot.parent_joint(link.name)
        is_fixed = joint is not None and joint.type == FIXED
        groups[link.name] = groups[joint.parent] if joint is not None and is_fixed else link.name
    return groups


def _adjacent(writing: Writing) -> Iterator[tuple[Link, Link]]:
    """Yield pairs of links with shapes that collide, and nothing but links without between them."""
    robot, world = writing.robot, writing.plan.world
    around: dict[str, list[Link]] = {}  # by the uppermost of connected links without shapes
    uppermost: dict[str, str] = {}
    for link in writing.plan.order:
        joint = robot.parent_joint(link.name)
        above = robot.links[joint.parent] if joint is not None else None
        if link.collisions:
            if above is None:
                continue
            if above.collisions:
                yield above, link
            elif above is not world:
                around[uppermost[above.name]].append(link)
            continue
        if above is None or above.collisions or above is world:
            uppermost[link.name] = link.name
            around[link.name] = [above] if above is not None and above.collisions else []
        else:
            uppermost[link.name] = uppermost[above.name]
    for links in around.values():
        yield from combinations(links, 2)
