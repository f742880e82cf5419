"""Loops of links: how far they are open, positions that close them, joints that follow exactly.

A loop says that two frames are held together. The positions of the joints between them solve its
equations: three for the points that meet, and as many for the turn as the type holds.
"""

from __future__ import annotations

from math import atan2, dist, hypot, pi

from .convex import cross, dot, minus
from .joint import FIXED, LIMITED, PRISMATIC, TURNING
from .kinematics import joint_transform, link_poses
from .pose import IDENTITY, multiply, rotate, transposed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from .extras import Loop
    from .joint import Joint
    from .pose import Pose, Vector
    from .robot import Robot

    Row = list[float]
    Moves = dict[str, tuple[Vector, Vector]]
    """How fast a frame moves and turns for a joint's speed of 1, by the names of joints."""

CLOSED = 1e-9
"""In metres and radians: what is open by less is closed."""
LARGEST_GAP = 1e-6
"""In metres and radians: simulators close gaps of this size without a jerk."""
WIDEST, WIDEST_TURN = 0.1, 0.5
"""What is open by more is not closed but wrong: a part of the robot's size, and radians."""
_STEPS = 60
_SAMPLES = 12
"""Positions of the leading joint on each side of `home`, at which the others are looked at."""


def gap_of(loop: Loop, one: Pose, other: Pose) -> tuple[float, float]:
    """Return how far two frames are from where a loop holds them: in metres and in radians.

    A ball leaves all angles free; a revolute one that about its axis, which both frames have.

    Args:
        loop: the loop.
        one: T_root_frame of its first frame.
        other: T_root_frame of its second frame.
    """
    distance = dist(one.position, other.position)
    if loop.type == "ball":
        return distance, 0.0
    if loop.type == "revolute" and loop.axis is not None:
        first, second = rotate(one.rotation, loop.axis), rotate(other.rotation, loop.axis)
        return distance, atan2(hypot(*cross(first, second)), dot(first, second))
    turn = multiply(transposed(one.rotation), other.rotation)
    sines = turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1]
    return distance, atan2(hypot(*sines), turn[0][0] + turn[1][1] + turn[2][2] - 1)


def driven_joints(robot: Robot) -> set[str]:
    """Return the names of the joints that an actuator or ros2_control drives."""
    driven = {actuator.joint for actuator in robot.actuators.values()}
    return driven.union(*(control.joints for control in robot.controls))


def size_of(robot: Robot, positions: Mapping[str, float]) -> float:
    """Return the diagonal of the box around the origins of the links, in metres; never 0."""
    places = [pose.position for pose in link_poses(robot, positions).values()]
    sides = [max(row) - min(row) for row in zip(*places, strict=True)]
    return hypot(*sides) or 1.0


class Closure:
    """The loops of a robot that share joints, as equations of the positions of these joints.

    Attributes:
        loops: the loops.
        joints: the joints that move independently and change how far the loops are open, in the
            order of the robot.
    """

    __slots__ = ("_leaders", "_order", "_paths", "_size", "joints", "loops")

    def __init__(self, robot: Robot, loops: Sequence[Loop], size: float) -> None:
        """Take loops whose frames are links of the robot, and the robot's size in metres."""
        self.loops = loops
        self._size = size
        self._leaders: dict[str, tuple[str, float, float]] = {}
        self._paths: list[tuple[list[Joint], list[Joint]]] = []
        needed: dict[str, Joint] = {}
        for loop in loops:
            first, second = (_path_to(robot, name) for name in loop.between)
            shared = {joint.name for joint in first} & {joint.name for joint in second}
            needed |= {joint.name: joint for joint in (*first, *second)}
            self._paths.append(
                (
                    [joint for joint in first if joint.name not in shared],
                    [joint for joint in second if joint.name not in shared],
                )
            )
        self._order = list(needed.values())
        between = {joint.name for pair in self._paths for path in pair for joint in path}
        for name in between:
            followed = _followed(robot, needed[name])
            if followed is not None:
                self._leaders[name] = followed
        leaders = {name for name, _, _ in self._leaders.values()}
        self.joints = [joint for joint in robot.joints.values() if joint.name in leaders]

    def errors(self, positions: Mapping[str, float]) -> tuple[Row, list[Row]]:
        """Return how far the loops are open, and the derivatives by the positions of `joints`.

        Lengths are parts of the robot's size. The derivatives of turns are exact where these are
        closed.
        """
        poses, axes = self._placed(positions)
        errors: Row = []
        rows: list[Row] = []
        for loop, paths in zip(self.loops, self._paths, strict=True):
            one, other = (poses.get(name, IDENTITY) for name in loop.between)
            first, second = (
                self._moves(path, axes, end.position)
                for path, end in zip(paths, (one, other), strict=True)
            )
            for values, change in _equations(loop, one, other):
                scale = 1.0 if change is not None else 1 / self._size
                errors += [scale * value for value in values]
                columns = []
                for joint in self.joints:
                    none = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
                    move_1, turn_1 = first.get(joint.name, none)
                    move_2, turn_2 = second.get(joint.name, none)
                    if change is None:
                        columns.append([scale * x for x in minus(move_2, move_1)])
                    else:
                        a_1, a_2 = change
                        left = cross(cross(turn_1, a_1), a_2)
                        right = cross(a_1, cross(turn_2, a_2))
                        columns.append([x + y for x, y in zip(left, right, strict=True)])
                rows += [list(row) for row in zip(*columns, strict=True)] if columns else []
        return errors, rows

    def is_closed(self, positions: Mapping[str, float]) -> bool:
        """Return whether all loops are closed, to `CLOSED`."""
        poses, _ = self._placed(positions)
        return all(
            max(gap_of(loop, *(poses.get(name, IDENTITY) for name in loop.between))) <= CLOSED
            for loop in self.loops
        )

    def close(
        self, start: Mapping[str, float], movable: Collection[str]
    ) -> dict[str, float] | None:
        """Return positions near others in which the loops are closed, or None if there are none.

        Limits are kept. Each step is one of Levenberg and Marquardt, whose damping is the square of
        the error, so that it converges quadratically also where equations repeat each other.
        Source: N. Yamashita, M. Fukushima, On the Rate of Convergence of the Levenberg-Marquardt
        Method, Computing Supplement 15, 2001.

        Args:
            start: the positions of all joints in radians or metres, by name.
            movable: the names of the joints that may move.
        """
        moving = [i for i, joint in enumerate(self.joints) if joint.name in movable]
        positions = dict(start)
        errors, rows = self.errors(positions)
        least = sum(x * x for x in errors)
        extra = 1.0
        for _ in range(_STEPS):
            if least < 1e-30 or extra > 1e12:
                break
            step = _step([[row[i] for i in moving] for row in rows], errors, extra * least + 1e-15)
            tried = dict(positions)
            for i, change in zip(moving, step, strict=True):
                joint = self.joints[i]
                tried[joint.name] = _within(joint, positions.get(joint.name, 0.0) + change)
            errors_there, rows_there = self.errors(tried)
            squares = sum(x * x for x in errors_there)
            if squares < least:
                positions, errors, rows, least = tried, errors_there, rows_there, squares
                extra = max(extra / 10, 1.0)
            else:
                extra *= 10
        return positions if self.is_closed(positions) else None

    def freedom(self, positions: Mapping[str, float]) -> int:
        """Return in how many ways the closed loops can move, at a position."""
        _, rows = self.errors(positions)
        return len(self.joints) - _rank(rows)

    def _placed(
        self, positions: Mapping[str, float]
    ) -> tuple[dict[str, Pose], dict[str, tuple[Vector, Vector]]]:
        """Return T_root_link of the links on the way, and the axis and the point of each joint."""
        poses: dict[str, Pose] = {}
        axes: dict[str, tuple[Vector, Vector]] = {}
        for joint in self._order:
            above = poses.get(joint.parent, IDENTITY)
            at = above @ joint.origin
            axes[joint.name] = rotate(at.rotation, joint.axis), at.position
            position = positions.get(joint.name, 0.0)
            if joint.name in self._leaders:
                name, multiplier, offset = self._leaders[joint.name]
                position = multiplier * positions.get(name, 0.0) + offset
            poses[joint.child] = above @ joint_transform(joint, position)
        return poses, axes

    def _moves(
        self, path: Sequence[Joint], axes: Mapping[str, tuple[Vector, Vector]], end: Vector
    ) -> Moves:
        """Return how the end of a path moves and turns with each joint that leads on it."""
        moves: Moves = {}
        for joint in path:
            if joint.name not in self._leaders:
                continue
            name, factor, _ = self._leaders[joint.name]
            axis, point = axes[joint.name]
            axis = _scaled(axis, factor)
            turns = joint.type in TURNING
            move = cross(axis, minus(end, point)) if turns else axis
            turn = axis if turns else (0.0, 0.0, 0.0)
            before = moves.get(name)
            if before is not None:
                move, turn = _sum(before[0], move), _sum(before[1], turn)
            moves[name] = move, turn
        return moves


def _equations(
    loop: Loop, one: Pose, other: Pose
) -> Iterator[tuple[Vector, tuple[Vector, Vector] | None]]:
    """Yield what is zero in a closed loop: the way between the points, and products of axes.

    With a product come its two axes, in the root's frame.
    """
    yield minus(other.position, one.position), None
    axes: list[Vector] = []
    if loop.type == "revolute" and loop.axis is not None:
        axes = [_scaled(loop.axis, 1 / (hypot(*loop.axis) or 1.0))]
    elif loop.type == FIXED:
        axes = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    for axis in axes:
        first, second = rotate(one.rotation, axis), rotate(other.rotation, axis)
        yield cross(first, second), (first, second)


# --- closing a robot --------------------------------------------------------------------------


def closures(robot: Robot, size: float) -> list[Closure]:
    """Return the loops of a robot, those that share joints in one, without those of no links."""
    groups: list[tuple[set[str], list[Loop]]] = []
    for loop in robot.loops.values():
        if not all(name in robot.links for name in loop.between):
            continue
        names = {joint.name for joint in Closure(robot, [loop], size).joints}
        loops = [loop]
        apart = []
        for others, members in groups:
            if others & names:
                names |= others
                loops = [*members, *loops]
            else:
                apart.append((others, members))
        groups = [*apart, (names, loops)]
    return [Closure(robot, loops, size) for _, loops in groups]


def closed_near(
    closure: Closure, start: Mapping[str, float], said: Collection[str], driven: Collection[str]
) -> dict[str, float] | None:
    """Return the positions that change for loops to be closed, or None if they cannot be.

    Joints that nobody said a position for move first, and before them those that nothing drives.
    """
    names = [joint.name for joint in closure.joints]
    left = [name for name in names if name not in said]
    tried: list[list[str]] = []
    for movable in ([name for name in left if name not in driven], left, names):
        if movable and movable not in tried:
            tried.append(movable)
            found = closure.close(start, movable)
            if found is not None:
                return {name: found[name] for name in movable if found[name] != start.get(name)}
    return None


# --- joints that follow exactly -----------------------------------------------------------------


def exact_mimics(
    robot: Robot, home: Mapping[str, float], driven: Collection[str]
) -> tuple[dict[str, tuple[Loop, str, float, float]], set[str]]:
    """Return the joints that follow another one linearly, because loops of one freedom hold them.

    The relation is looked at between the limits of the leading joint: the first that is driven,
    else the first.

    Args:
        robot: the robot.
        home: positions in which the loops are closed, of all joints.
        driven: the joints that something drives.

    Returns:
        By name of the joint, the first loop that holds it, the leading joint, the multiplier and
        the offset; and the names of the loops that these joints keep closed.
    """
    mimics: dict[str, tuple[Loop, str, float, float]] = {}
    held: set[str] = set()
    for closure in closures(robot, size_of(robot, home)):
        if not closure.is_closed(home) or closure.freedom(home) != 1:
            continue
        leader = next((j for j in closure.joints if j.name in driven), closure.joints[0])
        samples = _samples(closure, leader, home)
        if len(samples) < _SAMPLES:
            continue
        followers = [joint.name for joint in closure.joints if joint is not leader]
        for name in followers:
            relation = _linear(samples, leader.name, name)
            if relation is not None:
                mimics[name] = (closure.loops[0], leader.name, *relation)
        if mimics.keys() >= set(followers):
            held.update(loop.name for loop in closure.loops)
    return mimics, held


def _samples(closure: Closure, leader: Joint, home: Mapping[str, float]) -> list[dict[str, float]]:
    """Return closed positions with the leader between its limits, as far as it can go."""
    start = home.get(leader.name, 0.0)
    lower, upper = leader.lower, leader.upper
    if lower is None or upper is None or upper - lower > 2 * pi:
        lower, upper = start - pi, start + pi
    others = [joint.name for joint in closure.joints if joint is not leader]
    samples = [dict(home)]
    for end in (lower, upper):
        before, now = dict(home), dict(home)
        for number in range(1, _SAMPLES + 1):
            guess = {name: 2 * now[name] - before.get(name, 0.0) for name in others if name in now}
            guess = {**now, **guess, leader.name: start + (end - start) * number / _SAMPLES}
            found = closure.close(guess, others)
            if found is None:
                break
            before, now = now, found
            samples.append(found)
    return samples


def _linear(
    samples: Sequence[Mapping[str, float]], leader: str, follower: str
) -> tuple[float, float] | None:
    """Return multiplier and offset of a joint that follows another one, or None if it does not."""
    low = min(samples, key=lambda each: each[leader])
    high = max(samples, key=lambda each: each[leader])
    span = high[leader] - low[leader]
    if span <= 0:
        return None
    multiplier = (high.get(follower, 0.0) - low.get(follower, 0.0)) / span
    multiplier = _round(multiplier)
    offset = _round(low.get(follower, 0.0) - multiplier * low[leader])
    for each in samples:
        if abs(multiplier * each[leader] + offset - each.get(follower, 0.0)) > CLOSED:
            return None
    return multiplier, offset


def _round(value: float) -> float:
    """Return a number without the noise of the solution."""
    return round(value, 13) + 0.0


# --- joints ----------------------------------------------------------------------------------


def _path_to(robot: Robot, link: str) -> list[Joint]:
    """Return the joints from the root to a link."""
    path: list[Joint] = []
    seen: set[str] = set()
    joint = robot.parent_joint(link)
    while joint is not None and joint.name not in seen:
        seen.add(joint.name)
        path.append(joint)
        joint = robot.parent_joint(joint.parent)
    return path[::-1]


def _followed(robot: Robot, joint: Joint) -> tuple[str, float, float] | None:
    """Return which joint sets a position, the multiplier and the offset; itself, 1 and 0 if free.

    None is for joints that do not turn or move along an axis.
    """
    multiplier, offset = 1.0, 0.0
    seen: set[str] = set()
    leader: Joint | None = joint
    while leader is not None and leader.mimic is not None and leader.name not in seen:
        seen.add(leader.name)
        offset += multiplier * leader.mimic.offset
        multiplier *= leader.mimic.multiplier
        leader = robot.joints.get(leader.mimic.joint)
    if joint.type not in (*TURNING, PRISMATIC) or leader is None or not leader.is_free:
        return None
    return leader.name, multiplier, offset


def _within(joint: Joint, position: float) -> float:
    """Return a position between the limits of a joint."""
    if joint.type not in LIMITED or joint.lower is None or joint.upper is None:
        return position
    return max(joint.lower, min(joint.upper, position))


# --- linear algebra ---------------------------------------------------------------------------


def _scaled(vector: Vector, factor: float) -> Vector:
    x, y, z = vector
    return (factor * x, factor * y, factor * z)


def _sum(first: Vector, second: Vector) -> Vector:
    x, y, z = first
    u, v, w = second
    return (x + u, y + v, z + w)


def _step(rows: Sequence[Row], errors: Sequence[float], damping: float) -> Row:
    """Return x for which |J·x + e|² + damping·|x|² is least."""
    count = len(rows[0]) if rows else 0
    columns = [[row[i] for row in rows] for i in range(count)]
    matrix = [
        [sum(a * b for a, b in zip(one, other, strict=True)) for other in columns]
        + [-sum(a * b for a, b in zip(one, errors, strict=True))]
        for one in columns
    ]
    for i in range(count):
        matrix[i][i] += damping
    for i in range(count):  # positive definite: no pivots are needed
        for j in range(i + 1, count):
            factor = matrix[j][i] / matrix[i][i]
            matrix[j] = [a - factor * b for a, b in zip(matrix[j], matrix[i], strict=True)]
    found = [0.0] * count
    for i in reversed(range(count)):
        known = sum(matrix[i][j] * found[j] for j in range(i + 1, count))
        found[i] = (matrix[i][count] - known) / matrix[i][i]
    return found


def _rank(rows: Sequence[Row]) -> int:
    """Return the rank of a matrix, by elimination with full pivots."""
    matrix = [list(row) for row in rows]
    largest = max((abs(x) for row in matrix for x in row), default=0.0)
    rank = 0
    while matrix and matrix[0]:
        size, i, j = max((abs(x), i, j) for i, row in enumerate(matrix) for j, x in enumerate(row))
        if size <= 1e-8 * largest or not size:
            break
        pivot = matrix.pop(i)
        rank += 1
        matrix = [
            [
                a - row[j] / pivot[j] * b
                for k, (a, b) in enumerate(zip(row, pivot, strict=True))
                if k != j
            ]
            for row in matrix
        ]
    return rank
