"""Chains of joints from the root to a point, evaluated for many positions at once with numpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ....model.joint import CONTINUOUS, PRISMATIC, REVOLUTE
from ....model.pose import IDENTITY, Pose
from .failures import metric_failure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ....model.joint import Joint
    from ....model.robot import Robot

    Floats = NDArray[np.floating[Any]]

FARTHEST = 1e6
"""Metres from which a limit means that there is none, as ±1e16 in some robots."""


class Variable:
    """The position of an independent joint.

    Attributes:
        joint: the joint.
        lower, upper: between which it is, in radians or metres.
        turns: whether it is an angle.
        is_plain: whether nothing else in the chain depends on it.
    """

    __slots__ = ("is_plain", "joint", "lower", "turns", "upper")

    def __init__(self, joint: Joint) -> None:
        self.joint = joint
        self.lower, self.upper = joint.range
        self.turns = joint.type != PRISMATIC
        self.is_plain = True

    @property
    def is_full_turn(self) -> bool:
        """Return whether it can point in every direction."""
        return self.turns and self.upper - self.lower >= 2 * np.pi * (1 - 1e-9)


class Step:
    """A joint of a chain, and what lies between it and the joint before.

    Attributes:
        rotation, position: T_before_joint.
        axis: the axis in the joint's frame.
        cross: the matrix of the product axis × v.
        turns: whether it turns about the axis, or slides along it.
        variable: the index of the variable that it depends on.
        factor, offset: its position is factor·variable + offset.
    """

    __slots__ = ("axis", "cross", "factor", "offset", "position", "rotation", "turns", "variable")

    def __init__(self, pose: Pose, joint: Joint, variable: int, factor: float, offset: float):
        self.rotation: Floats = np.array(pose.rotation)
        self.position: Floats = np.array(pose.position)
        self.axis: Floats = np.array(joint.axis)
        x, y, z = joint.axis
        self.cross: Floats = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        self.turns = joint.type != PRISMATIC
        self.variable = variable
        self.factor = factor
        self.offset = offset

    def moved(self, points: Floats, positions: Floats) -> Floats:
        """Return points N×3 of the frame below the joint in the joint's frame, at N positions."""
        if not self.turns:
            return points + positions[:, None] * self.axis
        along = (points @ self.axis)[:, None] * self.axis
        cosines, sines = np.cos(positions)[:, None], np.sin(positions)[:, None]
        return along + cosines * (points - along) + sines * (points @ self.cross.T)

    def before(self, points: Floats) -> Floats:
        """Return points N×3 of the joint's frame in the frame of the joint before."""
        moved: Floats = points @ self.rotation.T + self.position
        return moved

    def after(self, points: Floats) -> Floats:
        """Return points N×3 of the frame of the joint before in the joint's frame."""
        moved: Floats = (points - self.position) @ self.rotation
        return moved


class Chain:
    """The joints between the root and the origin of a link or frame.

    Planar and floating joints rest at their origins.

    Attributes:
        name: of the link or frame.
        variables: what it depends on, in the order from the root.
        steps: its joints, in the order from the root.
        tip: the point in the frame below the last joint.
    """

    __slots__ = ("name", "steps", "tip", "variables")

    def __init__(self, robot: Robot, name: str) -> None:
        """Read the chain from a robot without loops.

        Raises:
            YamaroError: the joint it depends on has no limits.
        """
        self.name = name
        self.variables: list[Variable] = []
        self.steps: list[Step] = []
        known: dict[str, int] = {}
        pose = IDENTITY
        for joint in _joints_to(robot, name):
            pose = pose @ joint.origin
            leader, factor, offset = _leader(robot, joint)
            if leader is None:
                continue
            if leader.name not in known:
                known[leader.name] = len(self.variables)
                self.variables.append(_variable(leader))
            variable = known[leader.name]
            if joint is not leader or any(step.variable == variable for step in self.steps):
                self.variables[variable].is_plain = False
            self.steps.append(Step(pose, joint, variable, factor, offset))
            pose = IDENTITY
        self.tip: Floats = np.array(pose.position)

    @property
    def limits(self) -> Floats:
        """Return the lower and the upper limits of the variables, 2×n."""
        rows = [[each.lower for each in self.variables], [each.upper for each in self.variables]]
        return np.array(rows, float).reshape(2, -1)

    def points(self, positions: Floats, first: int = 0) -> Floats:
        """Return where the tip is, N×3, for positions of the variables, N×n.

        Args:
            positions: of the variables.
            first: the joint before whose motion the points are given, in the frame before it.
        """
        points = np.broadcast_to(self.tip, (len(positions), 3))
        for step in reversed(self.steps[first:]):
            angles = step.factor * positions[:, step.variable] + step.offset
            points = step.before(step.moved(points, angles))
        return points


def _joints_to(robot: Robot, name: str) -> list[Joint]:
    """Return the joints from the root to a link."""
    found: list[Joint] = []
    seen = {name}
    joint = robot.parent_joint(name)
    while joint is not None and joint.parent not in seen:
        found.append(joint)
        seen.add(joint.parent)
        joint = robot.parent_joint(joint.parent)
    return found[::-1]


def _leader(robot: Robot, joint: Joint) -> tuple[Joint | None, float, float]:
    """Return the independent joint that a joint follows, or itself, with factor and offset."""
    factor, offset = 1.0, 0.0
    seen = {joint.name}
    while joint.mimic is not None:
        offset += factor * joint.mimic.offset
        factor *= joint.mimic.multiplier
        leader = robot.joints.get(joint.mimic.joint)
        if leader is None or leader.name in seen:
            return None, factor, offset
        seen.add(leader.name)
        joint = leader
    return (joint if joint.type in (REVOLUTE, CONTINUOUS, PRISMATIC) else None), factor, offset


def _variable(joint: Joint) -> Variable:
    variable = Variable(joint)
    if not variable.turns and max(abs(variable.lower), abs(variable.upper)) >= FARTHEST:
        raise metric_failure(
            f"the joint '{joint.name}' has no limits, so nothing is the farthest",
            joint.span,
            hint="give it a lower and an upper limit",
        )
    return variable


def tips_of(robot: Robot) -> list[str]:
    """Return the links and frames at the ends of a robot: those that no joint leads on from."""
    return [name for name in robot.links if not robot.joints_below(name)]
