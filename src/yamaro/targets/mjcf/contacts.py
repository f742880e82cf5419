"""Pairs of bodies that do not collide: that a joint connects, or that overlap at home."""

from __future__ import annotations

from itertools import combinations

from ...model.convex import near, overlap
from ...model.joint import FIXED
from ..output import LOST
from .solids import solids_at_home
from .writing import Writing, made

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...model.link import Link

    Pairs = set[tuple[str, str]]

KEEP_HINT = "`keep` of `collisions` names the pairs that have contacts in any case"


def add_excludes(writing: Writing) -> None:
    """Append the pairs of links whose contacts only disturb, except those that are to be kept.

    These are adjacent links, also across links that have no shapes to collide, and links that
    overlap at home, which contacts would push apart; what is lost so is reported.

    Source: MoveIt's setup assistant calls these pairs adjacent, and default; MuJoCo leaves out only
    adjacent ones of which the upper body can move.
    """
    rigid = _rigid_groups(writing)
    settings = writing.robot.collision_settings
    kept = {frozenset(pair) for pair in settings.keep} if settings is not None else set()
    seen: Pairs = set()
    for first, second in _adjacent(writing):
        if frozenset((first.name, second.name)) not in kept:
            if rigid[first.name] != rigid[second.name]:
                _exclude(writing, first, second, seen)
    for first, second in _overlapping(writing, rigid):
        if frozenset((first.name, second.name)) not in kept:
            if _exclude(writing, first, second, seen):
                what = "contacts of links that overlap at home"
                owner = f"links '{first.name}' and '{second.name}'"
                span, trace = second.span, second.trace
                writing.lose(LOST, what, owner, span, trace=trace, hint=KEEP_HINT)


def _exclude(writing: Writing, first: Link, second: Link, seen: Pairs) -> bool:
    """Append a pair of links, unless that of their bodies is there; return whether it was not."""
    pair = (writing.body_name(first.name), writing.body_name(second.name))
    if pair in seen or pair[::-1] in seen:
        return False
    seen.add(pair)
    attributes = {"body1": pair[0], "body2": pair[1]}
    owner = writing.robot.parent_joint(second.name) or second
    writing.add("contact", made("exclude", owner, attributes, owner.trace))
    return True


def _overlapping(writing: Writing, rigid: dict[str, str]) -> Iterator[tuple[Link, Link]]:
    """Yield pairs of links that overlap at home, in the order of the robot.

    Links that cannot move against each other are left out, and those of which one carries the other
    and can move: MuJoCo has no contacts of them.
    """
    solids = solids_at_home(writing)
    static = writing.plan.static
    above: dict[str, str | None] = {}
    for name in dict.fromkeys(rigid.values()):
        joint = writing.robot.parent_joint(name)
        carrier = rigid[joint.parent] if joint is not None else None
        above[name] = carrier if carrier not in static else None
    found: set[tuple[str, str]] = set()
    for index, other in sorted(near([solid.convex for solid in solids])):
        first, second = solids[index], solids[other]
        one, two = rigid[first.link.name], rigid[second.link.name]
        if one == two or above[one] == two or above[two] == one:
            continue
        if one in static and two in static:
            continue
        pair = (first.link.name, second.link.name)
        if pair not in found and overlap(first.convex, second.convex):
            found.add(pair)
            yield first.link, second.link


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
