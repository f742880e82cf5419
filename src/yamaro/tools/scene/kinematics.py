"""Forward kinematics: where each link is for given joint positions."""

from __future__ import annotations

from .robot import CONTINUOUS, PRISMATIC, REVOLUTE
from .transforms import IDENTITY, UNTURNED, Transform, rotation_about

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from .robot import Joint, Robot


def joint_positions(robot: Robot, given: Mapping[str, float] | None = None) -> dict[str, float]:
    """Return the position of every joint that moves, in radians or metres, by name.

    Args:
        robot: the robot.
        given: positions of some joints that are free; others are at rest, see `Joint.rest`. A
            joint that mimics another follows it, through as many joints as it takes.
    """
    given = given or {}
    positions = {
        joint.name: given.get(joint.name, joint.rest)
        for joint in robot.joints.values()
        if not joint.mimic
    }
    for joint in robot.joints.values():
        _follow(joint, robot, positions)
    return positions


def _follow(joint: Joint, robot: Robot, positions: dict[str, float]) -> None:
    """Add the position of a joint that mimics another, and of those on the way to it."""
    chain: dict[str, Joint] = {}
    leader: Joint | None = joint
    while leader is not None and leader.name not in positions and leader.name not in chain:
        chain[leader.name] = leader
        leader = robot.joints.get(leader.mimic)
    position = positions.get(leader.name, 0.0) if leader is not None else 0.0
    for follower in reversed(chain.values()):
        position = follower.multiplier * position + follower.offset
        positions[follower.name] = position


def joint_transform(joint: Joint, position: float) -> Transform:
    """Return T_parent_child of a joint's links, for its position in radians or metres."""
    if joint.kind in (REVOLUTE, CONTINUOUS):
        return joint.origin @ Transform(rotation_about(joint.axis, position), (0.0, 0.0, 0.0))
    if joint.kind == PRISMATIC:
        x, y, z = joint.axis
        way = (position * x, position * y, position * z)
        return joint.origin @ Transform(UNTURNED, way)
    return joint.origin


def link_poses(robot: Robot, given: Mapping[str, float] | None = None) -> dict[str, Transform]:
    """Return T_root_link of every link by name; see `joint_positions` for what may be given.

    Each link without a parent is at the origin. So is what hangs on no root, as in a loop.
    """
    positions = joint_positions(robot, given)
    joints_from: dict[str, list[Joint]] = {}
    children = set()
    for joint in robot.joints.values():
        if joint.parent in robot.links and joint.child in robot.links:
            joints_from.setdefault(joint.parent, []).append(joint)
            children.add(joint.child)
    poses: dict[str, Transform] = {}
    roots = [name for name in robot.links if name not in children]
    for start in (*roots, *robot.links):
        if start in poses:
            continue
        poses[start] = IDENTITY
        pending = [start]
        while pending:
            parent = pending.pop()
            for joint in joints_from.get(parent, ()):
                if joint.child not in poses:
                    step = joint_transform(joint, positions.get(joint.name, 0.0))
                    poses[joint.child] = poses[parent] @ step
                    pending.append(joint.child)
    return poses
