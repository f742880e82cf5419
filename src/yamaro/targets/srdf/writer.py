"""A robot's groups, states and end effectors, and the pairs of links that need no check."""

from __future__ import annotations

from ...diagnostics import Diagnostic, YamaroError
from ...model.kinematics import WORLD
from ...model.shapes import Sphere
from ..elements import element
from ..groups import joints_of
from ..losses import Losses
from ..output import Output
from .pairs import disabled_pairs

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.link import Collision
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..elements import Attributes
    from ..output import Wanted


def write(robot: Robot, wanted: Wanted) -> Output:
    """Return the SRDF that belongs to a robot's URDF.

    Raises:
        YamaroError: links are seen that collide with nothing, or what samples is not installed.
    """
    _refuse_without_collisions(robot)
    losses = Losses()
    groups = robot.groups.values()
    parts = []
    for group in groups:
        members = [element("link", {"name": name}) for name in group.links]
        members += [element("joint", {"name": name}) for name in group.joints]
        members += [element("chain", {"base_link": b, "tip_link": t}) for b, t in group.chains]
        members += [element("group", {"name": name}) for name in group.groups]
        parts.append(element("group", {"name": group.name}, children=members, owner=group))
    parts += _states(robot, losses)
    for group in (each for each in groups if each.is_end_effector):
        parent = group.parent or ""
        around = [
            each.name
            for each in groups
            if each is not group and (parent in each.links or parent in [t for _, t in each.chains])
        ]
        effector: Attributes = {
            "name": group.name,
            "parent_link": parent,
            "group": group.name,
            "parent_group": around[0] if around else None,
        }
        parts.append(element("end_effector", effector, owner=group))
    roots = robot.roots
    if roots and roots[0].name != WORLD:
        attributes: Attributes = {
            "name": "virtual_joint",
            "type": "fixed" if wanted.is_fixed else "floating",
            "parent_frame": WORLD,
            "child_link": roots[0].name,
        }
        parts.append(element("virtual_joint", attributes))
    parts += _spheres(robot)
    for pair in disabled_pairs(robot, wanted):
        attributes = {"link1": pair.first, "link2": pair.second, "reason": pair.reason}
        owner = robot.links[pair.first]
        parts.append(element("disable_collisions", attributes, owner=owner))
    name = robot.name or wanted.name
    return Output(element("robot", {"name": name}, children=parts, owner=robot.element), losses)


def _refuse_without_collisions(robot: Robot) -> None:
    """Raise YamaroError if links can be seen and have no shape that collides."""
    found = [each for each in robot.links.values() if each.visuals and not each.collisions]
    if not found:
        return
    first = found[0]
    others = f" and {len(found) - 1} more" if len(found) > 1 else ""
    have = "have" if others else "has"
    error = Diagnostic(
        "missing-collision",
        f"the link '{first.name}'{others} {have} visuals and no collision, so that SRDF cannot say "
        "what it never touches",
        first.span,
        hint="add a collision; in a part, `collision:` takes the geometry of the link",
        notes=[f"also the link '{each.name}', at {each.span.place()}" for each in found[1:]],
        trace=first.trace,
    )
    raise YamaroError([error])


def _spheres(robot: Robot) -> list[Element]:
    """Return the spheres of links that were asked for as spheres, or collide with several alone."""
    asked: dict[str, list[Collision]] = {}
    for fit in robot.fits:
        if fit.word == "spheres" and fit.section == "collision" and fit.link in robot.links:
            made = robot.links[fit.link].collisions[fit.index : fit.index + fit.count]
            asked.setdefault(fit.link, []).extend(made)
    found = []
    for link in robot.links.values():
        solid = asked.get(link.name) or (link.collisions if len(link.collisions) > 1 else ())
        spheres = [
            element("sphere", {"center": each.pose.position, "radius": each.shape.radius})
            for each in solid
            if isinstance(each.shape, Sphere)
        ]
        if spheres and len(spheres) == len(solid):
            attributes: Attributes = {"link": link.name}
            found.append(
                element("link_sphere_approximation", attributes, children=spheres, owner=link)
            )
    return found


# --- groups -----------------------------------------------------------------------------------


def _states(robot: Robot, losses: Losses) -> list[Element]:
    """Return each state for each group that it says something of."""
    members = {name: {*joints_of(robot, group)} for name, group in robot.groups.items()}
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
            values = [
                element("joint", {"name": name, "value": state.positions[name]}) for name in named
            ]
            if values:
                where: Attributes = {"name": state.name, "group": group}
                found.append(element("group_state", where, children=values, owner=state))
        for joint in state.positions:
            if joint in left:
                what, label = "states of joints in no group", f"joint '{joint}' of '{state.name}'"
                losses.lose(what, state, field=joint, label=label)
    return found
