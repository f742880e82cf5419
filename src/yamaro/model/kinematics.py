"""Forward kinematics: where links and the centre of mass are for given joint positions.

Also whether the root of a robot stands still.
"""

from __future__ import annotations

from .joint import CONTINUOUS, FIXED, FLOATING, PLANAR, PRISMATIC, REVOLUTE, TURNING, UNLIMITED
from .pose import IDENTITY, UNTURNED, Pose, multiply, rotate, rotation_about, rotation_from_z

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from .joint import Joint
    from .link import Link
    from .pose import Vector
    from .positions import GivenPositions, Position
    from .robot import Robot


def joint_positions(robot: Robot, given: GivenPositions | None = None) -> dict[str, Position]:
    """Return the position of every joint that moves, by name.

    Args:
        robot: the robot.
        given: positions of some joints; others are at 0. See `Robot.pose`.

    Raises:
        ValueError: see `positions.read_positions`.
    """
    positions: dict[str, Position] = {}
    if given:
        from .positions import read_positions

        positions = read_positions(robot, given)
    for joint in robot.joints.values():
        if joint.mimic is not None:
            chain: dict[str, Joint] = {}  # to the first whose position is known, or its own
            leader: Joint | None = joint
            while leader is not None and leader.mimic is not None and leader.name not in chain:
                if leader.name in positions:
                    break
                chain[leader.name] = leader
                leader = robot.joints.get(leader.mimic.joint)
            found = positions.get(leader.name, 0.0) if leader is not None else 0.0
            position = found if isinstance(found, float) else 0.0
            for follower in reversed(chain.values()):
                assert follower.mimic is not None
                position = follower.mimic.multiplier * position + follower.mimic.offset
                positions[follower.name] = position
        elif joint.name not in positions and joint.type != FIXED:
            positions[joint.name] = _ZERO.get(joint.type, 0.0)
    return positions


_ZERO: dict[str, Position] = {PLANAR: (0.0, 0.0, 0.0), FLOATING: IDENTITY}


def joint_transform(joint: Joint, position: Position) -> Pose:
    """Return T_parent_child of a joint's links.

    Args:
        joint: the joint.
        position: as `joint_positions` gives it. A joint that is fixed or of an unknown type
            ignores it.
    """
    origin = joint.origin
    if isinstance(position, Pose):
        return origin @ position if joint.type == FLOATING else origin
    if not isinstance(position, float):
        return origin @ _planar(joint.axis, position) if joint.type == PLANAR else origin
    if joint.type in TURNING:
        turn = rotation_about(joint.axis, position)
        return Pose(multiply(origin.rotation, turn), origin.position)
    if joint.type == PRISMATIC:
        x, y, z = joint.axis
        way = (position * x, position * y, position * z)
        return Pose(origin.rotation, origin.apply(way))
    return origin


def _planar(axis: Vector, position: Sequence[float]) -> Pose:
    """Return T_joint_child of a planar joint.

    Its x and y are those of the joint's frame, turned the shortest way so that z is the axis.
    """
    x, y, angle = position
    place = rotate(rotation_from_z(axis), (x, y, 0.0))
    return Pose(rotation_about(axis, angle) if angle else UNTURNED, place)


def pose_of(robot: Robot, name: str, given: GivenPositions | None) -> Pose:
    """Return T_root_link of one link; see `Robot.pose`."""
    name = robot.need_link(name).name
    positions = joint_positions(robot, given)
    pose = IDENTITY
    seen = set()
    joint = robot.parent_joint(name)
    while joint is not None and name not in seen:
        seen.add(name)
        pose = joint_transform(joint, positions.get(joint.name, 0.0)) @ pose
        name = joint.parent
        joint = robot.parent_joint(name)
    return pose


def link_poses(robot: Robot, given: GivenPositions | None = None) -> dict[str, Pose]:
    """Return T_root_link of every link by name, in order; see `Robot.poses`."""
    positions = joint_positions(robot, given)
    poses: dict[str, Pose] = {}
    for start in robot.links:
        way: dict[str, Joint] = {}
        name = start
        while name not in poses:
            joint = robot.parent_joint(name)
            if joint is None or name in way:
                poses[name] = IDENTITY
                way.pop(name, None)
                break
            way[name] = joint
            name = joint.parent
        for child, joint in reversed(way.items()):
            step = joint_transform(joint, positions.get(joint.name, 0.0))
            if child not in poses:
                poses[child] = poses[joint.parent] @ step
    return {name: poses[name] for name in robot.links}


def adjacent_links(robot: Robot, solid: Iterable[str]) -> set[tuple[str, str]]:
    """Return the pairs that joints join, with no other link with shapes between them.

    Args:
        robot: the robot.
        solid: the names of the links with shapes.
    """
    solid = set(solid)
    near: dict[str, set[str]] = {name: set() for name in robot.links}
    for joint in robot.joints.values():
        if joint.parent in near and joint.child in near:
            near[joint.parent].add(joint.child)
            near[joint.child].add(joint.parent)
    found = set()
    for start in solid:
        seen, waiting = {start}, [start]
        for link in waiting:
            for other in near[link] - seen:
                seen.add(other)
                if other in solid:
                    found.add((min(start, other), max(start, other)))
                else:
                    waiting.append(other)
    return found


def center_of_mass(robot: Robot, given: GivenPositions | None) -> Vector:
    """Return the centre of mass in the frame of the root, in metres; see `Robot.center_of_mass`."""
    mass = robot.mass
    if not mass:
        raise ValueError(f"the robot '{robot.name}' has no mass")
    poses = link_poses(robot, given)
    sums = [0.0, 0.0, 0.0]
    for name, link in robot.links.items():
        if link.inertial is None:
            continue
        center = poses[name].apply(link.inertial.pose.position)
        for axis in range(3):
            sums[axis] += link.mass * center[axis]
    x, y, z = (component / mass for component in sums)
    return (x, y, z)


def from_the_roots(robot: Robot) -> list[Link]:
    """Return the links, each after the one it is attached to; links in a circle are left out."""
    found = list(robot.roots)
    for link in found:
        found += [robot.links[joint.child] for joint in robot.joints_below(link.name)]
    return found


def rigid_parts(robot: Robot, order: Iterable[Link]) -> dict[str, str]:
    """Return by the name of each link the uppermost one that fixed joints hold it to.

    Args:
        robot: the robot.
        order: the links, each after the one it is attached to.
    """
    found: dict[str, str] = {}
    for link in order:
        joint = robot.parent_joint(link.name)
        is_held = joint is not None and joint.type == FIXED
        found[link.name] = found[joint.parent] if joint is not None and is_held else link.name
    return found


# --- the base ---------------------------------------------------------------------------------

FREE = "free"
WORLD = "world"
"""The name of a root link that is fixed in the world."""
LIMBS = 4
"""The number of limbs with which a robot walks."""
TRUNK = 4
"""The moving joints from the root to where limbs are counted; farther out are hands."""


def base_of(robot: Robot, asked: str | None = None) -> tuple[str, str]:
    """Return whether the root is `fixed` in the world or `free`, and why if that is assumed.

    What is asked for counts, then the robot's `base`; a root `world` is fixed. Otherwise these are
    assumed, in this order: fixed if nothing that is rigidly joined to the root has mass, or if a
    floating or planar joint lets go of it; free with a joint that turns endlessly, as wheels do, or
    with `LIMBS` limbs; else fixed.

    Args:
        robot: the robot.
        asked: `fixed`, `free`, or None to do as the robot says.

    Returns:
        `fixed` or `free`; the reason as a clause, "" if nothing is assumed.
    """
    said = asked or (robot.base.type if robot.base is not None else None)
    roots = robot.roots
    if said is not None or not roots or roots[0].name == WORLD:
        return said or FIXED, ""
    held = [roots[0].name]
    leaving: list[Joint] = []
    for link in held:
        for joint in robot.joints_below(link):
            if joint.type == FIXED:
                held.append(joint.child)
            else:
                leaving.append(joint)
    if all(robot.links[link].mass <= 0 for link in held):
        return FIXED, f"the root '{roots[0].name}' has no mass"
    for joint in leaving:
        if joint.type in (FLOATING, PLANAR):
            return FIXED, f"the joint '{joint.name}' is {joint.type}"
    for joint in robot.joints.values():
        if _is_endless(joint):
            return FREE, f"the joint '{joint.name}' turns endlessly"
    limbs = count_limbs(robot)
    if limbs >= LIMBS:
        return FREE, f"it has {limbs} limbs"
    return FIXED, "no joint turns endlessly, and it has fewer than four limbs"


def _is_endless(joint: Joint) -> bool:
    """Return whether a joint turns on and on: a wheel, also one with limits that mean none."""
    limit = joint.limit
    if joint.type != REVOLUTE or limit is None:
        return joint.type == CONTINUOUS
    return limit.lower <= -UNLIMITED and limit.upper >= UNLIMITED


def count_limbs(robot: Robot) -> int:
    """Return how many limbs a robot has: branches of its tree that end in links that move.

    Only the first `TRUNK` moving joints on the way from the root count, so an arm with its hand is
    one limb. Branches that only mimic joints move do not count, and two that a loop joins are one.
    """
    tops = {link.name: link.name for link in robot.roots}  # of the rigid part that a link is in
    above: dict[str, str] = {}
    depths = dict.fromkeys(tops, 0)
    driven: set[str] = set()
    for link in from_the_roots(robot):
        top = tops[link.name]
        for joint in robot.joints_below(link.name):
            if joint.type == FIXED or depths[top] == TRUNK:
                tops[joint.child] = top
            else:
                tops[joint.child] = joint.child
                above[joint.child] = top
                depths[joint.child] = depths[top] + 1
            if joint.type != FIXED and joint.mimic is None:
                driven.add(tops[joint.child])
    ends: dict[str, set[str]] = {}  # of the limbs at or beyond a part
    for part in reversed(above):
        if part in driven and part not in ends:
            ends[part] = {part}
        if part in ends:
            ends.setdefault(above[part], set()).update(ends[part])
    limbs = {end: end for part in above for end in ends.get(part, ())}
    for loop in robot.loops.values():
        first, second = (ends.get(tops.get(name, ""), set()) for name in loop.between)
        if len(first) == len(second) == 1:
            one, other = limbs[min(first)], limbs[min(second)]
            limbs = {end: one if limb == other else limb for end, limb in limbs.items()}
    return len(set(limbs.values()))
