"""Checks an SRDF, MoveIt's semantic description of a robot: alone, and against the robot.

What srdfdom (model.cpp) and MoveIt's RobotModel leave out with no more than a line in a log.
"""

from __future__ import annotations

from ..model.sdf_schema import NOT_NEGATIVE, THREE, Value
from ..model.values import attribute_text
from .context import CheckContext, shown
from .robot import is_fixed
from .values import (
    UniqueNames,
    check_required,
    check_value,
    children,
    named,
    numbers,
    report_word,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from ..diagnostics import Reporter
    from ..model.robot import Robot
    from ..xml.tree import Element

    Members = dict[str, set[str]]
    """The joints of each group."""

IGNORES = "MoveIt ignores it"
NEEDED = {
    "group": ("name",),
    "group_state": ("name", "group"),
    "end_effector": ("name", "parent_link", "group"),
    "virtual_joint": ("name", "type", "parent_frame", "child_link"),
    "passive_joint": ("name",),
    "joint_property": ("joint_name", "property_name", "value"),
    "disable_collisions": ("link1", "link2"),
    "enable_collisions": ("link1", "link2"),
    "disable_default_collisions": ("link",),
    "link_sphere_approximation": ("link",),
}
"""The elements of SRDF, and the attributes without which they are ignored."""
MEMBERS = {
    "link": ("name",),
    "joint": ("name",),
    "chain": ("base_link", "tip_link"),
    "group": ("name",),
}
"""What can be in a group."""
LINKS = {
    "end_effector": ("parent_link",),
    "virtual_joint": ("child_link",),
    "disable_collisions": ("link1", "link2"),
    "enable_collisions": ("link1", "link2"),
    "disable_default_collisions": ("link",),
    "link_sphere_approximation": ("link",),
}
"""The attributes that name links of the robot."""
JOINTS = {"passive_joint": "name", "joint_property": "joint_name"}
VIRTUAL = {"fixed": 0, "planar": 3, "floating": 7}
"""The types of virtual joints, and how many numbers the position of each has."""
MOST_SHOWN = 8
"""Groups of a circle that a message names."""
DEEPEST = 20
"""Groups in groups in groups that are followed."""
TOLERANCE = 1e-6
"""How far beside its limits a joint may be in a state, in m and rad."""


# --- alone ----------------------------------------------------------------------------------


def check_semantics(root: Element, context: CheckContext) -> None:
    """Check an SRDF without its robot: what is missing, repeated, or names no group."""
    groups = {named(each): each for each in children(root, "group")}
    names = {
        "group": UniqueNames("groups", "MoveIt keeps the first"),
        "end_effector": UniqueNames("end effectors", "MoveIt keeps one of them"),
        "virtual_joint": UniqueNames("virtual joints", "MoveIt keeps one of them"),
        "passive_joint": UniqueNames("passive joints", "one is enough"),
    }
    virtual = {
        named(each): VIRTUAL.get((attribute_text(each, "type") or "").strip().lower(), 0)
        for each in children(root, "virtual_joint")
    }
    states: dict[str, UniqueNames] = {}
    pairs: dict[tuple[str, ...], Element] = {}
    for child in root.elements():
        context.outermost = child
        needed = NEEDED.get(child.name)
        if needed is None:
            _check_unknown(child, NEEDED, "an SRDF", context)
            continue
        where = _where(child)
        check_required(child, needed, where, IGNORES, context)
        if child.name in names:
            names[child.name].add(child, context)
        if child.name == "group":
            _check_group(child, groups, where, context)
        elif child.name == "group_state":
            group = (attribute_text(child, "group") or "").strip()
            states.setdefault(group, UniqueNames(f"states of '{group}'", "MoveIt keeps one")).add(
                child, context
            )
            _check_group_name(child, "group", groups, where, context)
            _check_state(child, virtual, where, context)
        elif child.name == "end_effector":
            for attribute in ("group", "parent_group"):
                _check_group_name(child, attribute, groups, where, context)
        elif child.name == "virtual_joint":
            kind = (attribute_text(child, "type") or "").strip()
            if kind and kind.lower() not in VIRTUAL and "$" not in kind:
                report_word(
                    kind, VIRTUAL, f"the type of {where}", child, child.value_span("type"), context,
                    result="so MoveIt takes it as fixed",
                )  # fmt: skip
        elif child.name in ("disable_collisions", "enable_collisions"):
            _check_pair(child, pairs, context)
        elif child.name == "link_sphere_approximation":
            for sphere in children(child, "sphere"):
                own = f"a sphere of {where}"
                if check_required(sphere, ("center", "radius"), own, IGNORES, context):
                    check_value(sphere, THREE, f"'center' of {own}", context, attribute="center")
                    check_value(
                        sphere, NOT_NEGATIVE, f"'radius' of {own}", context, attribute="radius"
                    )
    context.outermost = None
    _check_circles(groups, context)
    if not any(child.name in NEEDED for child in root.elements()):
        context.report(
            "missing-element",
            "this SRDF says nothing of its robot",
            root,
            missing="group",
            hint="add groups; `yamaro FILE --to srdf` writes an SRDF",
        )


def _where(element: Element) -> str:
    what = element.name.replace("_", " ")
    name = named(element)
    return f"the {what} '{name}'" if name else f"a '{element.name}'"


def _check_unknown(child: Element, known: Iterable[str], where: str, context: CheckContext) -> None:
    """Report what MoveIt ignores: nobody else reads SRDF."""
    if ":" in child.name:
        return
    hint, fix = context.near(child.name, list(known), child.span)
    belongs = child.name in MEMBERS and known is NEEDED
    context.report(
        "unknown-element",
        f"'{child.name}' has no meaning in {where}; {IGNORES}",
        child,
        hint="it belongs in a group" if belongs else hint or f"it can hold {', '.join(known)}",
        fix=None if belongs else fix,
    )


def _check_group(
    group: Element, groups: dict[str, Element], where: str, context: CheckContext
) -> None:
    """Check what a group holds."""
    members = 0
    for member in group.elements():
        needed = MEMBERS.get(member.name)
        if needed is None:
            _check_unknown(member, MEMBERS, where, context)
            continue
        members += 1
        check_required(member, needed, f"a {member.name} of {where}", IGNORES, context)
        if member.name == "group":
            _check_group_name(member, "name", groups, where, context)
        elif member.name == "chain":
            ends = [attribute_text(member, end) for end in needed]
            if ends[0] and ends[0] == ends[1]:
                context.report(
                    "bad-value",
                    f"the chain of {where} begins and ends at '{ends[0]}', so it has no joint",
                    member,
                    attribute="tip_link",
                    hint="name the last link of the chain",
                )
    if not members:
        context.report(
            "missing-element",
            f"{where} is empty, so MoveIt moves nothing with it",
            group,
            missing="member",
            hint="add a chain, joints, links or groups",
        )


def _check_group_name(
    element: Element,
    attribute: str,
    groups: dict[str, Element],
    where: str,
    context: CheckContext,
) -> None:
    name = (attribute_text(element, attribute) or "").strip()
    if not name or name in groups or "$" in name:
        return
    hint, fix = context.near(name, groups, element.value_span(attribute))
    context.report(
        "unknown-reference",
        f"{where} names the group '{name}', which does not exist; {IGNORES}",
        element,
        attribute=attribute,
        hint=hint or "name a group of this file",
        fix=fix,
    )


def _check_circles(groups: dict[str, Element], context: CheckContext) -> None:
    """Report, once, groups that contain themselves."""
    inner = {
        name: [each for each in map(named, children(group, "group")) if each in groups]
        for name, group in groups.items()
    }
    done: set[str] = set()
    for name in groups:
        path = {name: iter(inner[name])}  # in the order gone, with what is left of each
        while path and name not in done:
            own = next(reversed(path))
            below = next(path[own], None)
            if below is None:
                done.add(own)
                del path[own]
            elif below in path:
                gone = list(path)
                circle = [*gone[gone.index(below) :], below]
                if len(circle) > MOST_SHOWN:
                    circle = [*circle[: MOST_SHOWN // 2], "…", *circle[-MOST_SHOWN // 2 :]]
                context.report(
                    "joint-cycle",
                    f"the group '{below}' contains itself: {' → '.join(circle)}",
                    groups[below],
                    attribute="name",
                    hint="remove one of these groups from the other",
                )
                return
            elif below not in done:
                path[below] = iter(inner[below])


def _check_state(
    state: Element, virtual: dict[str, int], where: str, context: CheckContext
) -> None:
    """Check the joints of a state: one number each, several for a virtual joint."""
    names = UniqueNames(f"joints of {where}", "the last counts")
    for joint in children(state, "joint"):
        name = named(joint)
        check_required(joint, ("name", "value"), f"a joint of {where}", IGNORES, context)
        names.add(joint, context)
        if attribute_text(joint, "value"):
            rule = Value(count=virtual.get(name) or 1)
            check_value(joint, rule, f"'{name}' of {where}", context, attribute="value")
    if not any(True for _ in children(state, "joint")):
        context.report(
            "missing-element",
            f"{where} has no joint, so it says nothing",
            state,
            missing="joint",
            hint="add `joint/name=…, value=0:` for each joint",
        )


def _check_pair(
    pair: Element, pairs: dict[tuple[str, ...], Element], context: CheckContext
) -> None:
    links = [attribute_text(pair, name) or "" for name in ("link1", "link2")]
    if not all(links):
        return
    if links[0] == links[1]:
        context.report(
            "bad-value",
            f"'{pair.name}' names the link '{links[0]}' twice; no link collides with itself",
            pair,
            attribute="link2",
            hint="name another link",
        )
        return
    key = (pair.name, *sorted(links))
    first = pairs.get(key)
    if first is None:
        pairs[key] = pair
    else:
        context.report(
            "repeated-element",
            f"'{pair.name}' of '{links[0]}' and '{links[1]}' is given twice",
            pair,
            hint="remove one of them",
            notes=(f"first given at {first.span.place()}",),
        )


# --- against the robot --------------------------------------------------------------------------


def findings_against(root: Element, robot: Robot, reporter: Reporter) -> None:
    """Report what an SRDF says of links and joints that the robot does not have."""
    context = CheckContext(root, reporter, is_advice=True)
    name = named(root)
    if name and robot.name and name != robot.name:
        context.report(
            "unknown-reference",
            f"this SRDF is for the robot '{name}', but the robot is called '{robot.name}'",
            root,
            attribute="name",
            hint=f"write name={robot.name}, or check it with the robot that it is for",
        )
    virtual = {named(each) for each in children(root, "virtual_joint")}
    joints = [*robot.joints, *virtual]
    groups = {named(each): each for each in children(root, "group")}
    members = _members(groups, robot)
    roots = [link.name for link in robot.roots]
    for child in root.elements():
        context.outermost = child
        where = _where(child)
        for attribute in LINKS.get(child.name, ()):
            _check_name(child, attribute, robot.links, "link", where, context)
        if child.name in JOINTS:
            _check_name(child, JOINTS[child.name], joints, "joint", where, context)
        elif child.name == "group":
            for link in children(child, "link"):
                _check_name(link, "name", robot.links, "link", where, context)
            for joint in children(child, "joint"):
                _check_name(joint, "name", joints, "joint", where, context)
            for chain in children(child, "chain"):
                _check_chain(chain, robot, where, context)
        elif child.name == "group_state":
            _check_positions(child, robot, joints, members, where, context)
        elif child.name == "end_effector":
            _check_end_effector(child, groups, where, context)
        elif child.name == "virtual_joint":
            _check_attached(child, robot, roots, where, context)
    context.outermost = None
    context.flush()


def _check_name(
    element: Element,
    attribute: str,
    known: Collection[str],
    kind: str,
    where: str,
    context: CheckContext,
) -> None:
    name = (attribute_text(element, attribute) or "").strip()
    if not name or name in known:
        return
    hint, fix = context.near(name, known, element.value_span(attribute))
    context.report(
        "unknown-joint" if kind == "joint" else "unknown-reference",
        f"{where} names '{name}', which is not a {kind} of the robot; {IGNORES}",
        element,
        attribute=attribute,
        hint=hint or f"name a {kind} of the robot",
        fix=fix,
    )


def _check_chain(chain: Element, robot: Robot, where: str, context: CheckContext) -> None:
    for end in ("base_link", "tip_link"):
        _check_name(chain, end, robot.links, "link", where, context)
    base, tip = ((attribute_text(chain, end) or "").strip() for end in ("base_link", "tip_link"))
    if base in robot.links and tip in robot.links and base != tip and tip in _way_up(base, robot):
        context.report(
            "reversed-chain",
            f"the chain of {where} begins at '{base}', which is below its end '{tip}'",
            chain,
            attribute="base_link",
            hint="swap the two: `base_link` is nearer to the root",
        )


def _way_up(link: str, robot: Robot) -> list[str]:
    """Return the links above a link, the nearest first."""
    found: list[str] = []
    seen = {link}
    while (joint := robot.parent_joint(link)) is not None and joint.parent not in seen:
        link = joint.parent
        seen.add(link)
        found.append(link)
    return found


def _members(groups: dict[str, Element], robot: Robot) -> Members:
    """Return the joints of each group: its own, those above its links, of chains and groups.

    There are none if groups are nested too deeply.
    """
    found: Members = {}
    for name, group in groups.items():
        own = {named(joint) for joint in children(group, "joint")}
        for link in children(group, "link"):
            own |= _joint_above(named(link), robot)
        for chain in children(group, "chain"):
            base = (attribute_text(chain, "base_link") or "").strip()
            tip = (attribute_text(chain, "tip_link") or "").strip()
            ways = [[end, *_way_up(end, robot)] for end in (base, tip)]
            shared = set(ways[0]) & set(ways[1])
            for below in {*ways[0], *ways[1]} - shared:
                own |= _joint_above(below, robot)
        found[name] = own
    for _ in range(DEEPEST):
        before = sum(map(len, found.values()))
        for name, group in groups.items():
            for inner in children(group, "group"):
                found[name] |= found.get(named(inner), set())
        if sum(map(len, found.values())) == before:
            return found
    return {}


def _joint_above(link: str, robot: Robot) -> set[str]:
    joint = robot.parent_joint(link) if link in robot.links else None
    return set() if joint is None else {joint.name}


def _check_positions(
    state: Element,
    robot: Robot,
    joints: Collection[str],
    members: Members,
    where: str,
    context: CheckContext,
) -> None:
    """Check the joints of a state: that they move, are in the group, and within their limits."""
    group = (attribute_text(state, "group") or "").strip()
    for value in children(state, "joint"):
        _check_name(value, "name", joints, "joint", where, context)
        name = named(value)
        joint = robot.joints.get(name)
        if joint is None:
            continue
        if is_fixed(joint):
            context.report(
                "fixed-joint",
                f"{where} moves the joint '{name}', which is fixed",
                value,
                attribute="name",
                hint="remove it from the state",
            )
            continue
        if group in members and name not in members[group]:
            context.report(
                "unknown-joint",
                f"{where} moves the joint '{name}', which is not in the group '{group}'; {IGNORES}",
                value,
                attribute="name",
                hint="add it to the group, or write a state of another group",
            )
        row = numbers(attribute_text(value, "value") or "")
        if row is None or len(row) != 1 or joint.limit is None or joint.type == "continuous":
            continue
        lower, upper = joint.limit.number("lower") or 0.0, joint.limit.number("upper") or 0.0
        if lower <= upper and not lower - TOLERANCE <= row[0] <= upper + TOLERANCE:
            context.report(
                "state-outside-limit",
                f"the position {shown(row[0])} of '{name}' in {where} is outside of its limits, "
                f"{shown(lower)} and {shown(upper)}",
                value,
                attribute="value",
                hint="positions are in radians or metres",
            )


def _check_end_effector(
    element: Element, groups: dict[str, Element], where: str, context: CheckContext
) -> None:
    """Report an end effector whose group has the link that it is on."""
    name = (attribute_text(element, "group") or "").strip()
    parent = (attribute_text(element, "parent_link") or "").strip()
    group = groups.get(name)
    if group is not None and parent in {named(link) for link in children(group, "link")}:
        context.report(
            "unknown-reference",
            f"{where} is on '{parent}', which is a link of its own group '{name}'",
            element,
            attribute="parent_link",
            hint="name the link of the arm that it is fixed to",
        )


def _check_attached(
    element: Element, robot: Robot, roots: list[str], where: str, context: CheckContext
) -> None:
    """Report a virtual joint that is not on the root: MoveIt skips it."""
    child = (attribute_text(element, "child_link") or "").strip()
    if child in robot.links and roots and child not in roots:
        context.report(
            "unknown-reference",
            f"{where} is on '{child}', but only the root '{roots[0]}' can be attached to the "
            f"world; {IGNORES}",
            element,
            attribute="child_link",
            hint=f"write child_link={roots[0]}",
        )
