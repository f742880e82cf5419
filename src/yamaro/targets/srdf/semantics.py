"""A robot's groups, states and end effectors, and the pairs of links that need no check."""

from __future__ import annotations

from ...diagnostics import Diagnostic, YamaroError
from ...model.kinematics import WORLD
from ..output import LOST, Loss, Output
from ..tags import Tag
from .pairs import disabled_pairs

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Group
    from ...model.link import Link
    from ...model.robot import Robot
    from ..output import Wanted


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the SRDF that belongs to a robot's URDF.

    Raises:
        YamaroError: links are seen that collide with nothing, or what samples is not installed.
    """
    losses: list[Loss] = []
    _refuse_without_collisions(robot)
    parts = [_group(group) for group in robot.groups.values()]
    parts += _states(robot, losses)
    parts += [_end_effector(robot, each) for each in robot.groups.values() if each.is_end_effector]
    parts += _virtual_joint(robot, wanted)
    for pair in disabled_pairs(robot, wanted):
        link = robot.links[pair.first]
        parts.append(
            Tag(
                "disable_collisions",
                link1=pair.first,
                link2=pair.second,
                reason=pair.reason,
                span=link.span,
                trace=link.trace,
            )
        )
    root = Tag("robot", parts, name=robot.name or wanted.name).made(robot.span, None)
    return Output(root, losses)


def _refuse_without_collisions(robot: Robot) -> None:
    """Raise YamaroError if links can be seen and have no shape that collides."""
    found = [each for each in robot.links.values() if each.visuals and not each.collisions]
    if found:
        raise YamaroError([_without_collisions(found)])


def _without_collisions(links: list[Link]) -> Diagnostic:
    first = links[0]
    others = f" and {len(links) - 1} more" if len(links) > 1 else ""
    have = "have" if others else "has"
    return Diagnostic(
        "missing-collision",
        f"the link '{first.name}'{others} {have} visuals and no collision, so that SRDF cannot say "
        "what it never touches",
        first.span,
        hint="add a collision; in a part, `collision:` takes the geometry of the link",
        notes=[f"also the link '{each.name}', at {each.span.place()}" for each in links[1:]],
        trace=first.trace,
    )


# --- groups -----------------------------------------------------------------------------------


def _group(group: Group) -> Tag:
    members = [Tag("link", name=name) for name in group.links]
    members += [Tag("joint", name=name) for name in group.joints]
    members += [Tag("chain", base_link=base, tip_link=tip) for base, tip in group.chains]
    members += [Tag("group", name=name) for name in group.groups]
    return Tag("group", members, name=group.name, span=group.span, trace=group.trace)


def _end_effector(robot: Robot, group: Group) -> Tag:
    parent = group.parent or ""
    around = next(
        (
            each.name
            for each in robot.groups.values()
            if each is not group and parent in _ends_of(each)
        ),
        None,
    )
    return Tag(
        "end_effector",
        name=group.name,
        parent_link=parent,
        group=group.name,
        parent_group=around,
        span=group.span,
        trace=group.trace,
    )


def _ends_of(group: Group) -> set[str]:
    return {tip for _, tip in group.chains} | set(group.links)


def joints_of(robot: Robot, group: Group, *, seen: frozenset[str] = frozenset()) -> set[str]:
    """Return the names of the joints in a group: of its chains, links, joints and groups."""
    found = set(group.joints)
    found |= {_above(robot, link) for link in group.links}
    for base, tip in group.chains:
        link = tip
        while link != base:
            joint = robot.parent_joint(link)
            if joint is None:
                break
            found.add(joint.name)
            link = joint.parent
    seen |= {group.name}
    for name in group.groups:
        inner = robot.groups.get(name)
        if inner is not None and name not in seen:
            found |= joints_of(robot, inner, seen=seen)
    return found - {""}


def _above(robot: Robot, link: str) -> str:
    joint = robot.parent_joint(link)
    return "" if joint is None else joint.name


def _states(robot: Robot, losses: list[Loss]) -> list[Tag]:
    """Return each state for each group that it says something of."""
    members = {name: joints_of(robot, group) for name, group in robot.groups.items()}
    found = []
    for state in robot.states.values():
        left = set(state.positions)
        # The fullest group comes first: pinocchio reads no other of a state.
        parts = {
            group: [name for name in state.positions if name in joints]
            for group, joints in members.items()
        }
        for group, named in sorted(parts.items(), key=lambda part: -len(part[1])):
            left -= set(named)
            values = [Tag("joint", name=name, value=state.positions[name]) for name in named]
            if values:
                where = {"name": state.name, "group": group}
                found.append(
                    Tag("group_state", values, span=state.span, trace=state.trace, **where)
                )
        for joint in state.positions:
            if joint in left:
                what = "states of joints in no group"
                owner = f"joint '{joint}' of '{state.name}'"
                losses.append(Loss(LOST, what, owner, state.span_of(joint), trace=state.trace))
    return found


def _virtual_joint(robot: Robot, wanted: Wanted) -> list[Tag]:
    """Return the joint between the world and the root, unless the root is the world."""
    roots = robot.roots
    if not roots or roots[0].name == WORLD:
        return []
    kind = "fixed" if wanted.is_fixed else "floating"
    root = roots[0].name
    return [
        Tag("virtual_joint", name="virtual_joint", type=kind, parent_frame=WORLD, child_link=root)
    ]
