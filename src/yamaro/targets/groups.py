"""The joints in the groups of a robot, as MoveIt finds them."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.extras import Group
    from ..model.robot import Robot


def joints_of(robot: Robot, group: Group, *, seen: frozenset[str] = frozenset()) -> list[str]:
    """Return the names of the joints in a group: of its chains, joints, links and groups.

    Those of a chain are in its order, from its base on.
    """
    found: dict[str, None] = {}
    for base, tip in group.chains:
        chain: list[str] = []
        link = tip
        while link != base:
            joint = robot.parent_joint(link)
            if joint is None or joint.name in chain:
                break
            chain.append(joint.name)
            link = joint.parent
        found |= dict.fromkeys(reversed(chain))
    found |= dict.fromkeys(group.joints)
    for link in group.links:
        joint = robot.parent_joint(link)
        if joint is not None:
            found[joint.name] = None
    seen |= {group.name}
    for name in group.groups:
        inner = robot.groups.get(name)
        if inner is not None and name not in seen:
            found |= dict.fromkeys(joints_of(robot, inner, seen=seen))
    found.pop("", None)
    return [*found]
