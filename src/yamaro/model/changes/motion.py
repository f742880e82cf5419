"""Whether two robots move the same, and which changed joint is why a link is elsewhere.

All joints at zero cannot show a wrong axis, so that the poses of links are compared in other
positions too: the same ones each time, within the limits of the joints.
"""

from __future__ import annotations

from ...source import Public
from ..joint import FLOATING, PLANAR, SINGLE
from ..kinematics import link_poses
from ..pose import IDENTITY, Pose, rotation_from_rpy
from .change import ADDED, CHANGED, REMOVED, Moved
from .context import angle_between, distance_between

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..joint import Joint
    from ..positions import Position
    from ..robot import Robot
    from .change import Change
    from .context import Comparing

SAMPLES = 6
"""Positions of the joints that are tried besides zero."""
GOLDEN = 0.6180339887498949
"""Fractions of it are spread evenly: the fractional part of k·(√5 − 1)/2 for k = 1, 2, …."""
WIDEST = 7.0
"""The widest range of a joint in which positions are tried: a little more than a turn."""
LEAST = 1e-7
"""Distances in metres, for a robot of 1 m, and angles in radians, up to which nothing has moved."""
KINEMATIC = ("type", "parent", "child", "origin", "axis", "mimic")
"""What decides where the child of a joint is."""

Poses = dict[str, Pose]


class Motion(Public):
    """Whether the links that two robots have in common move the same.

    Attributes:
        is_same: whether each link is at the same pose for the same positions of the joints.
        reason: why not, as a phrase; or "".
        reference: the link, of the first robot, whose frame poses are compared in; "" if the
            robots share no link.
        opposite: the joints, of the first robot, that only have to turn the other way.
        ranges: the joints whose limits differ.
    """

    __slots__ = ("is_same", "opposite", "ranges", "reason", "reference")

    def __init__(
        self,
        *,
        is_same: bool,
        reason: str = "",
        reference: str = "",
        opposite: tuple[str, ...] = (),
        ranges: tuple[str, ...] = (),
    ) -> None:
        self.is_same = is_same
        self.reason = reason
        self.reference = reference
        self.opposite = opposite
        self.ranges = ranges


class MotionComparison:
    """Compares where links are, for the same positions of the joints of two robots.

    Attributes:
        reference: see `Motion.reference`.
    """

    def __init__(self, comparing: Comparing) -> None:
        """Work out the poses of all links that both robots have."""
        self._comparing = comparing
        self._first, self._second = comparing.first, comparing.second
        self._joints = comparing.matching.joints
        self._links = comparing.matching.links
        self.reference = _reference(comparing)
        self._samples = [self._positions(number) for number in range(SAMPLES + 1)]
        self._mine = [self._relative(self._first, given, self.reference) for given in self._samples]
        new = self._links.get(self.reference, "")
        self._theirs = [
            self._relative(self._second, self._translated(given), new) for given in self._samples
        ]
        size = max((abs(c) for p in self._mine[0].values() for c in p.position), default=0.0)
        least = max(LEAST, 10 * comparing.tolerance.part)
        self._angle = least
        self._distance = least * max(1.0, size)

    # --- positions ---

    def _positions(self, number: int) -> dict[str, Position]:
        """Return positions, by the names of the first robot, of the joints that both can be given.

        The first are all zero; the others are within the limits of both where these overlap. They
        are the same ones if the second robot is compared with the first.
        """
        if not number:
            return {}
        positions: dict[str, Position] = {}
        either_way = sorted(self._joints.items(), key=sorted)
        for index, (name, new) in enumerate(either_way, 1):
            joint, other = self._first.joints[name], self._second.joints[new]
            if joint.mimic is None and other.mimic is None and _kind(joint) == _kind(other):
                share = (number * index * GOLDEN + number / (SAMPLES + 1)) % 1
                position = _position(joint, other, share)
                if position is not None:
                    positions[name] = position
        return positions

    def _translated(self, positions: dict[str, Position]) -> dict[str, Position]:
        return {self._joints[name]: position for name, position in positions.items()}

    @staticmethod
    def _relative(robot: Robot, positions: dict[str, Position], reference: str) -> Poses:
        """Return T_reference_link of every link."""
        poses = link_poses(robot, positions)
        if reference not in poses or poses[reference] == IDENTITY:
            return poses
        inverse = poses[reference].inverse()
        return {name: inverse @ pose for name, pose in poses.items()}

    # --- the answer ---

    def motion(self) -> Motion:
        """Return whether the robots move the same."""
        if not self._links:
            return Motion(is_same=False, reason="the robots have no link in common")
        others = []  # joints with other ranges
        same = self._comparing.tolerance.same
        for name, new in self._joints.items():
            one, other = self._first.joints[name], self._second.joints[new]
            if _moves(one) and _moves(other):
                if not (same(one.lower, other.lower) and same(one.upper, other.upper)):
                    others.append(name)
        ranges = tuple(others)
        reason = self._other_joints()
        if reason is None:
            reason = self._worst(self._theirs)
        if reason is None:
            return Motion(is_same=True, reference=self.reference, ranges=ranges)
        opposite = self._opposite()
        return Motion(
            is_same=False, reason=reason, reference=self.reference, opposite=opposite, ranges=ranges
        )

    def _other_joints(self) -> str | None:
        """Return which joint moves in only one of the robots, or None."""
        for robot, joints, words in (
            (self._first, self._joints, "no longer"),
            (self._second, {new: old for old, new in self._joints.items()}, "now"),
        ):
            other = self._second if robot is self._first else self._first
            for name, joint in robot.joints.items():
                twin = other.joints[joints[name]] if name in joints else None
                if _moves(joint) and not (twin is not None and _moves(twin)):
                    return f"'{name}' {words} moves freely"
        return None

    def _worst(self, theirs: list[Poses]) -> str | None:
        """Return which link is the furthest from where it was, or None if none is elsewhere."""
        found = self._furthest(list(self._links), theirs)
        if found is None:
            return None
        from .context import angle_text, length_text

        distance, angle, name, number = found
        where = "with all joints at zero" if not number else "when the joints move"
        if distance <= self._distance:
            return f"'{name}' is turned by {angle_text(angle)} {where}"
        return f"'{name}' is {length_text(distance)} away {where}"

    def _opposite(self) -> tuple[str, ...]:
        """Return the joints that move the other way, if nothing else differs; else none."""
        names = []
        for name, new in self._joints.items():
            one, other = self._first.joints[name], self._second.joints[new]
            negative = tuple(-component for component in other.axis)
            if one.type in SINGLE and self._comparing.tolerance.same_row(one.axis, negative):
                names.append(name)
        if not names or self._other_joints() is not None:
            return ()
        theirs = []
        for given in self._samples:
            turned = {
                name: -at if name in names and isinstance(at, float) else at
                for name, at in given.items()
            }
            new = self._links.get(self.reference, "")
            theirs.append(self._relative(self._second, self._translated(turned), new))
        return tuple(names) if self._worst(theirs) is None else ()

    # --- causes ---

    def moved_by(self, causes: list[Change]) -> list[tuple[Change, Moved]]:
        """Return the links that are elsewhere, by the nearest change of a joint above each.

        Args:
            causes: changes that could move links, at most one of each joint.
        """
        mine = {change.name: change for change in causes if change.kind != ADDED}
        theirs = {change.new_name or change.name: change for change in causes}
        theirs = {new: change for new, change in theirs.items() if change.kind != REMOVED}
        nearest: dict[str, Change | None] = {}
        groups: dict[int, tuple[Change, list[str]]] = {}
        for name in self._links if causes else ():
            if self._is_elsewhere(name):
                cause = self._nearest(name, mine, theirs, nearest)
                if cause is not None:
                    groups.setdefault(id(cause), (cause, []))[1].append(name)
        moved = []
        for cause, names in groups.values():
            found = self._furthest(names, self._theirs)
            assert found is not None, "these links are elsewhere"
            distance, angle, link, number = found
            furthest = Moved(
                names, link=link, distance=distance, angle=angle, is_at_zero=not number
            )
            moved.append((cause, furthest))
        return moved

    def _nearest(
        self,
        start: str,
        mine: dict[str, Change],
        theirs: dict[str, Change],
        nearest: dict[str, Change | None],
    ) -> Change | None:
        """Return the nearest change of a joint above a link in either robot.

        Where no joint has changed, the link above is the same one in both.

        Args:
            start: the link.
            mine: the changes, by the names of the joints in the first robot.
            theirs: the same, by those in the second.
            nearest: the answers so far, by links.
        """
        found: Change | None = None
        way: list[str] = []
        name = start
        while name not in nearest:
            nearest[name] = None
            way.append(name)
            above = self._first.parent_joint(name)
            others = self._second.parent_joint(self._links[name])
            found = _cause(
                None if above is None else mine.get(above.name),
                None if others is None else theirs.get(others.name),
            )
            if found is not None or above is None or above.parent not in self._links:
                break
            name = above.parent
        else:
            found = nearest[name]
        nearest.update(dict.fromkeys(way, found))
        return found

    def _is_elsewhere(self, name: str) -> bool:
        new = self._links[name]
        for mine, theirs in zip(self._mine, self._theirs, strict=True):
            distance, angle = _between(mine[name], theirs[new])
            if distance > self._distance or angle > self._angle:
                return True
        return False

    def _furthest(
        self, names: list[str], theirs: list[Poses]
    ) -> tuple[float, float, str, int] | None:
        """Return which link is the furthest from where it was.

        Returns:
            The distance, the angle, the link, and the number of the positions: with all joints at
            zero if any link is elsewhere then. None if no link is elsewhere.
        """
        found: tuple[float, float, str, int] | None = None
        for number, (mine, others) in enumerate(zip(self._mine, theirs, strict=True)):
            for name in names:
                distance, angle = _between(mine[name], others[self._links[name]])
                if distance > self._distance or angle > self._angle:
                    if found is None or _is_beyond((distance, angle), found[:2]):
                        found = (distance, angle, name, number)
            if found is not None and not number:
                break
        return found


def _cause(mine: Change | None, theirs: Change | None) -> Change | None:
    """Return which of two changes to name: either way the same one."""
    if mine is None or theirs is None or mine is theirs:
        return mine or theirs
    changed = [change for change in (mine, theirs) if change.kind == CHANGED]
    return min(changed or (mine, theirs), key=lambda change: change.name)


def _is_beyond(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Return whether a link is further away than another; by rounding alone it is not."""
    if abs(one[0] - other[0]) > LEAST:
        return one[0] > other[0]
    return one[1] > other[1] + LEAST


def _between(one: Pose, other: Pose) -> tuple[float, float]:
    """Return the distance and the angle between two poses."""
    return (
        distance_between(one.position, other.position),
        angle_between(one.rotation, other.rotation),
    )


def _reference(comparing: Comparing) -> str:
    """Return the link, that both robots have, which is nearest to both roots.

    Of several, it is the one that is written first, whichever robot is the first.
    """
    first, second = _depths(comparing.first), _depths(comparing.second)
    rows = [
        {name: i for i, name in enumerate(r.links)} for r in (comparing.first, comparing.second)
    ]
    links = comparing.matching.links

    def rank(name: str) -> tuple[int, int, list[str]]:
        new = links[name]
        return (first[name] + second[new], rows[0][name] + rows[1][new], sorted((name, new)))

    return min(links, key=rank, default="")


def _depths(robot: Robot) -> dict[str, int]:
    """Return how many joints each link is below its root."""
    depths: dict[str, int] = {}
    for start in robot.links:
        way: dict[str, None] = {}
        name = start
        while name not in depths and name not in way:
            way[name] = None
            joint = robot.parent_joint(name)
            if joint is None:
                break
            name = joint.parent
        depth = depths.get(name, -1)
        for link in reversed(way):
            depth += 1
            depths[link] = depth
    return depths


def _moves(joint: Joint) -> bool:
    return joint.mimic is None and (joint.type in SINGLE or joint.type in (PLANAR, FLOATING))


def _kind(joint: Joint) -> str:
    """Return what positions a joint takes: those of a `single` one are numbers."""
    return "single" if joint.type in SINGLE else joint.type


def _position(joint: Joint, other: Joint, share: float) -> Position | None:
    """Return a position for two joints of one kind; `share` of the way through their range."""
    if joint.type in SINGLE:
        (low, high), (lower, upper) = joint.range, other.range
        start, end = max(low, lower), min(high, upper)
        if start >= end:
            start, end = min(low, lower), max(high, upper)
        if not end - start <= WIDEST:  # in a range without end, near zero
            middle = min(max(0.0, start), end)
            start, end = max(start, middle - WIDEST / 2), min(end, middle + WIDEST / 2)
        return start + share * (end - start)
    if joint.type == PLANAR:
        return (share, 0.5 - share, 2 * share - 1)
    if joint.type == FLOATING:
        return Pose(rotation_from_rpy(share, 0.3 - share, 2 * share), (share, -share, 0.4))
    return None
