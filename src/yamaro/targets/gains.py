"""Gains for actuators that are given none, by effort limit, carried weight and moved inertia."""

from __future__ import annotations

from math import hypot, isfinite, sqrt

from ..model.convex import cross, minus
from ..model.joint import FLOATING, PLANAR, PRISMATIC, SINGLE, UNLIMITED
from ..model.kinematics import from_the_roots, link_poses
from ..model.pose import multiply, rotate, transposed
from ..model.schema import COMMANDS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..model.extras import Actuator
    from ..model.joint import Joint
    from ..model.pose import Pose, Rotation, Vector
    from ..model.robot import Robot

POSITION, VELOCITY, EFFORT = COMMANDS
"""What an actuator is commanded."""
TIME_STEP = 0.002
"""MuJoCo's default time step, in s, with which the gains are stable."""
GRAVITY = 9.81
"""In m/s²."""
SAG = 0.01
"""How far the weight may move a joint, as part of its range; of 1 rad or 1 m without limits."""
STRAIN = 0.1
"""How far a joint is from where it should be when its actuator gives its greatest effort, as part
of its range; of 1 rad or 1 m without limits. With less, large steps would overshoot: a critically
damped joint of stiffness k that starts and stops at its greatest effort T overshoots in steps
longer than 16 T / k."""
SLOWEST, FASTEST = 50.0, 1.5 / TIME_STEP
"""The least and the greatest natural frequency of a joint with its load, in rad/s. With critical
damping, which MuJoCo integrates implicitly, it would have to be below 4.8 / TIME_STEP: the roots of
λ²(1 + 2a) − λ(2 + 2a − a²) + 1, with the step a, are then inside of the unit circle."""
BRISK = 1 / TIME_STEP
"""The greatest frequency of a joint whose effort asks for the stiffness, in rad/s: small enough
that steps in which it gives its greatest effort do not overshoot because of the time step."""
COUPLED = 0.5 / TIME_STEP
"""The greatest frequency of a joint that others follow: as fast as the equalities are, whose
stiffness is by the lighter one of two joints."""
LEAST_INERTIA = 1e-12
"""In kg·m² or kg, for what has none."""
SLIP = 0.05
"""The part of its greatest speed by which a velocity actuator slips at its greatest effort."""
SETTLING = 0.01
"""The time in s in which a velocity actuator without limits changes the speed of its load."""


class Load:
    """What a joint moves.

    Attributes:
        mass: in kg.
        first: ∫x dm, in the axes of the root, about its origin.
        second: ∫x·xᵀ dm, the same.
        reach: how far from the root's origin links are, as points.
    """

    __slots__ = ("first", "mass", "points", "second")

    def __init__(self) -> None:
        self.mass = 0.0
        self.first = [0.0, 0.0, 0.0]
        self.second = [[0.0] * 3 for _ in range(3)]
        self.points: list[Vector] = []

    def add(self, other: Load) -> None:
        """Add what another joint moves."""
        self.mass += other.mass
        self.points += other.points
        for i in range(3):
            self.first[i] += other.first[i]
            for j in range(3):
                self.second[i][j] += other.second[i][j]

    def add_body(self, mass: float, center: Vector, inertia: Rotation) -> None:
        """Add a body, with its inertia about its centre of mass along the root's axes."""
        half_trace = (inertia[0][0] + inertia[1][1] + inertia[2][2]) / 2
        self.mass += mass
        self.points.append(center)
        for i in range(3):
            self.first[i] += mass * center[i]
            for j in range(3):
                own = (half_trace if i == j else 0.0) - inertia[i][j]
                self.second[i][j] += own + mass * center[i] * center[j]

    def about(self, point: Vector, axis: Vector) -> float:
        """Return the moment of inertia about an axis through a point, in kg·m²."""
        found = 0.0
        for i in range(3):
            for j in range(3):
                moved = self.second[i][j] - point[i] * self.first[j] - self.first[i] * point[j]
                moved += self.mass * point[i] * point[j]
                found += moved * ((1.0 if i == j else 0.0) - axis[i] * axis[j])
        return found


class Gains:
    """Works out gains, at the positions where joints rest."""

    __slots__ = ("_followers", "_is_fixed", "_loads", "_poses", "_robot")

    def __init__(self, robot: Robot, *, is_fixed: bool) -> None:
        """Prepare for a robot, whose root is fixed in the world or not."""
        self._robot = robot
        self._is_fixed = is_fixed
        self._followers: dict[str, list[tuple[float, Joint]]] = {}
        for joint in robot.joints.values():
            if joint.mimic is not None and joint.type in SINGLE:
                followers = self._followers.setdefault(joint.mimic.joint, [])
                followers.append((joint.mimic.multiplier, joint))
        self._poses: Mapping[str, Pose] = {}
        self._loads: dict[str, Load] = {}

    def of_position(self, joint: Joint) -> float:
        """Return the stiffness of a joint, in N·m/rad or N/m; see `_inertia_and_weight`.

        It is the greatest of three. The joint gives its greatest effort at a distance of `STRAIN`,
        unless the load then swings faster than with `BRISK`. At most `SAG` of the joint's range
        gives way under the weight of what it carries: of all above it, and for a robot that stands
        on its joints of the whole robot. The load swings at least with `SLOWEST`: weight on the
        axis, such as that of a flange or a turntable, asks for nothing.

        But the load swings at most with `FASTEST`, and where other joints follow, what the joint
        moves itself at most with `COUPLED`.
        """
        inertia, weight = self._inertia_and_weight(joint)
        low, high = joint.range if joint.lower is not None else (0.0, 1.0)
        room = min(max(high - low, 1e-3), 1.0)
        effort = joint.limit.effort if joint.limit is not None else None
        effort = effort if effort is not None and 0 < effort < UNLIMITED else 0.0
        by_effort = min(effort / (STRAIN * room), inertia * BRISK * BRISK)
        wanted = max(by_effort, weight / (SAG * room), inertia * SLOWEST * SLOWEST)
        most = inertia * FASTEST * FASTEST
        if joint.name in self._followers:
            most = min(most, self._own(joint)[0] * COUPLED * COUPLED)
        return _rounded(min(wanted, most))

    def damping(self, joint: Joint, stiffness: float) -> float:
        """Return the damping with which the load just does not swing, in N·m·s/rad or N·s/m.

        Where other joints follow, it is at most that of what the joint moves itself with `COUPLED`:
        simulators hold those with equalities, which would not be stable with more.
        """
        found = 2 * sqrt(max(stiffness, 0.0) * self._inertia_and_weight(joint)[0])
        if joint.name in self._followers:
            found = min(found, 2 * self._own(joint)[0] * COUPLED)
        return _rounded(found)

    def of_velocity(self, joint: Joint, actuator: Actuator) -> float:
        """Return the gain of a velocity actuator, given or not, in N·m·s/rad or N·s/m."""
        given = actuator.kd if actuator.kd is not None else actuator.kp
        if given is not None:
            return given
        limit = joint.limit
        if limit is not None and limit.effort and limit.velocity:
            gain = abs(limit.effort / (SLIP * limit.velocity))
            if isfinite(gain):
                return _rounded(gain)
        return _rounded(self._inertia_and_weight(joint)[0] / SETTLING)

    def _inertia_and_weight(self, joint: Joint) -> tuple[float, float]:
        """Return the inertia that a joint moves, and the greatest effort of its weight.

        The joints that follow it count as well: at a multiplier m their inertia m² times, and their
        weight |m| times.
        """
        if not self._loads:
            self._read()
        inertia, weight = self._own(joint)
        for multiplier, follower in self._followers.get(joint.name, ()):
            if self._robot.parent_joint(follower.child) is follower:
                more, heavier = self._own(follower)
                inertia += multiplier * multiplier * more
                weight += abs(multiplier) * heavier
        return inertia, weight

    def _own(self, joint: Joint) -> tuple[float, float]:
        """Return the inertia that a joint moves itself, and the greatest effort of its weight."""
        load, pose = self._loads[joint.child], self._poses[joint.child]
        axis = rotate(pose.rotation, joint.axis)
        actuator = self._robot.actuators.get(joint.name)
        armature = actuator.armature or 0.0 if actuator is not None else 0.0
        mass = self._carried(joint).mass
        if joint.type == PRISMATIC:
            return max(load.mass + armature, LEAST_INERTIA), GRAVITY * mass
        inertia = load.about(pose.position, axis) + armature
        # The distance of the points from the axis.
        crossed = (cross(minus(point, pose.position), axis) for point in load.points)
        reach = max((hypot(*each) for each in crossed), default=0.0)
        return max(inertia, LEAST_INERTIA), GRAVITY * mass * reach

    def _carried(self, joint: Joint) -> Load:
        """Return what a joint carries: what it moves, or all of a robot that stands on it."""
        robot = self._robot
        own = self._loads[joint.child]
        name = joint.parent
        above = robot.parent_joint(name)
        while above is not None:
            if above.type in (FLOATING, PLANAR):
                return self._loads[name]
            name = above.parent
            above = robot.parent_joint(name)
        return own if self._is_fixed else self._loads[name]

    def _read(self) -> None:
        """Work out what is above each link, from the leaves to the roots."""
        robot = self._robot
        rest = {joint.name: joint.rest for joint in robot.free_joints()}
        self._poses = link_poses(robot, rest)
        for link in reversed(from_the_roots(robot)):
            load = self._loads.setdefault(link.name, Load())
            inertial, pose = link.inertial, self._poses[link.name]
            if inertial is not None and inertial.mass:
                turn = multiply(pose.rotation, inertial.pose.rotation)
                matrix = multiply(multiply(turn, inertial.matrix()), transposed(turn))
                load.add_body(inertial.mass, pose.apply(inertial.pose.position), matrix)
            joint = robot.parent_joint(link.name)
            if joint is not None:
                self._loads.setdefault(joint.parent, Load()).add(load)


def _rounded(value: float) -> float:
    """Return a number with two digits: more would say more than is known."""
    return float(f"{value:.2g}")
