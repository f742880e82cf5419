"""Reach and workspace of the tips of a robot, and its bounding box.

Chains of joints from the root to a point are evaluated for many positions at once with numpy.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cache
from math import hypot, inf
from typing import Any

import numpy as np

from ...diagnostics import YamaroError, failure
from ...files.mesh_files import MeshFinder
from ...model.joint import CONTINUOUS, PRISMATIC, REVOLUTE, Joint
from ...model.kinematics import link_poses
from ...model.pose import IDENTITY, Pose, Vector
from ...model.positions import home_positions
from ...model.robot import Robot
from ...model.shapes import Box, Capsule, Cylinder, Mesh, Shape, Sphere
from ...source import Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]


def metric_failure(message: str, span: Span, *, hint: str | None = None) -> YamaroError:
    """Return the error of a metric that a robot has no value for."""
    return failure("metric-failed", message, span, hint=hint)


def named_link(robot: Robot, name: str) -> str:
    """Return the name of a link or frame, which may be given as that of its part.

    Raises:
        YamaroError: there is none.
    """
    from ...model.positions import link_named

    try:
        return link_named(robot, name).name
    except ValueError as error:
        message, _, hint = str(error).partition("; ")
        hint = hint or f"it has {', '.join(list(robot.links)[:8])}"
        raise metric_failure(message, robot.span, hint=hint) from None


# --- chains of joints -------------------------------------------------------------------------


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
        path: list[Joint] = []
        seen = {name}
        above = robot.parent_joint(name)
        while above is not None and above.parent not in seen:
            path.append(above)
            seen.add(above.parent)
            above = robot.parent_joint(above.parent)
        for joint in reversed(path):
            pose = pose @ joint.origin
            leader, factor, offset = _leader(robot, joint)
            if leader is None:
                continue
            if leader.name not in known:
                known[leader.name] = len(self.variables)
                moving = Variable(leader)
                if not moving.turns and max(abs(moving.lower), abs(moving.upper)) >= FARTHEST:
                    raise metric_failure(
                        f"the joint '{leader.name}' has no limits, so nothing is the farthest",
                        leader.span,
                        hint="give it a lower and an upper limit",
                    )
                self.variables.append(moving)
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


def tips_of(robot: Robot) -> list[str]:
    """Return the links and frames at the ends of a robot: those that no joint leads on from."""
    return [name for name in robot.links if not robot.joints_below(name)]


# --- how far the tips of a robot get from its root, over the limits of its joints -------------


STARTS = 32
MOST_ROUNDS = 500
CLOSE = 1e-12
"""The part of the distance that a round has to gain for there to be another one."""
GRID = 65
ZOOMS = 6


def reach(robot: Robot, names: Sequence[str] = ()) -> float:
    """Return the greatest distance from the origin of the root to a tip, in metres.

    Args:
        robot: the robot.
        names: links and frames whose origins are the tips; by default those at the ends.

    Raises:
        YamaroError: a joint that slides has no limits.
    """
    return max(chain_reach(Chain(robot, name)) for name in names or tips_of(robot))


def chain_reach(chain: Chain) -> float:
    """Return the greatest distance from the origin of the root to the tip of a chain."""
    positions = _starts(len(chain.variables)) * np.diff(chain.limits, axis=0) + chain.limits[0]
    farthest = _farthest(chain, positions)
    for _ in range(MOST_ROUNDS if chain.variables else 0):
        points = np.broadcast_to(chain.tip, (len(positions), 3))
        arms: list[Floats] = []
        """Of each joint, where the tip is in the frame below it."""
        for step in reversed(chain.steps):
            arms.insert(0, points)
            angles = step.factor * positions[:, step.variable] + step.offset
            points = step.before(step.moved(points, angles))
        root: Floats = np.zeros((len(positions), 3))
        for step, arm in zip(chain.steps, arms, strict=True):
            variable = chain.variables[step.variable]
            root = step.after(root)  # the root as it is seen from the joint
            if variable.is_plain:
                positions[:, step.variable] = _best(step, variable, arm, root)
            current = step.factor * positions[:, step.variable] + step.offset
            root = step.moved(root, -current)
        for index, variable in enumerate(chain.variables):
            if not variable.is_plain:
                positions[:, index] = _searched(chain, positions, index)
        before, farthest = farthest, _farthest(chain, positions)
        if farthest <= before * (1 + CLOSE):
            break
    return farthest


def _farthest(chain: Chain, positions: Floats) -> float:
    return float(np.sqrt(_squares(chain.points(positions)).max()))


def _squares(points: Floats) -> Floats:
    squares: Floats = np.einsum("ij,ij->i", points, points)
    return squares


@cache
def _starts(count: int) -> Floats:
    """Return the positions that the search begins at, as parts of the ranges: always the same."""
    inner = np.random.Generator(np.random.Philox(0)).random((STARTS - 3, count))
    return np.vstack([np.zeros(count), np.full(count, 0.5), np.ones(count), inner])


def _best(step: Step, variable: Variable, arm: Floats, root: Floats) -> Floats:
    """Return the positions of a joint at which its arm leads the farthest from the root.

    Args:
        step: the joint.
        variable: its limits.
        arm: where the tip is in the frame below the joint, N×3.
        root: where the root is in the frame of the joint, N×3.
    """
    low, high = np.full(len(arm), variable.lower), np.full(len(arm), variable.upper)
    if not step.turns:  # |arm + q·axis − root|² grows on both sides of its lowest point
        lowest = (root - arm) @ step.axis
        return np.where(abs(high - lowest) > abs(low - lowest), high, low)
    along = (arm @ step.axis)[:, None] * step.axis
    cosine = np.einsum("ij,ij->i", root, arm - along)
    sine = np.einsum("ij,ij->i", root, arm @ step.cross.T)
    # The distance is the greatest where root·R(q)·arm = … + cosine·cos q + sine·sin q is least.
    best = np.arctan2(-sine, -cosine)
    best = low + np.mod(best - low, 2 * np.pi)

    def nearness(angles: Floats) -> Floats:
        value: Floats = cosine * np.cos(angles) + sine * np.sin(angles)
        return value

    end = np.where(nearness(high) < nearness(low), high, low)
    return np.where(best <= high, best, end)


def _searched(chain: Chain, positions: Floats, index: int) -> Floats:
    """Return the positions of a joint that others follow at which the tip is the farthest.

    The distance is not a sinusoid then; a grid finds the highest value, and finer ones around it.
    """
    lower, upper = chain.limits[:, index]
    count = len(positions)
    middle, half = np.full(count, (lower + upper) / 2), (upper - lower) / 2
    grid = np.linspace(-1, 1, GRID)
    best = positions[:, index].copy()
    found = _squares(chain.points(positions))
    for _ in range(ZOOMS):
        tried = np.clip(middle[:, None] + half * grid, lower, upper)
        every = np.repeat(positions, GRID, axis=0)
        every[:, index] = tried.ravel()
        squares = _squares(chain.points(every)).reshape(count, GRID)
        at = squares.argmax(axis=1)
        rows = np.arange(count)
        is_better = squares[rows, at] > found
        found = np.where(is_better, squares[rows, at], found)
        best = np.where(is_better, tried[rows, at], best)
        middle = best
        half *= 2 / (GRID - 1)
    return best


# --- the volume of the places that a tool gets to, over the limits of the joints --------------


POWER = 15
"""Two to this power is the number of samples."""
CELLS = 40
"""How many cells are at least across what is reached."""
MOST_CELLS = CELLS << 6
CROWDED = 64
"""The mean number of samples in a cell from which finer cells have enough of them as well."""
PROBES = 16
RANK_TOLERANCE = 1e-7


def workspace(robot: Robot, name: str) -> float:
    """Return the volume of the places that the origin of a link or frame gets to, in m³.

    Args:
        robot: the robot; its parts may pass through each other.
        name: of the link or frame.

    Raises:
        YamaroError: the first joint moves others as well, or a joint that slides has no limits.
    """
    chain = Chain(robot, name)
    if not _fills_space(chain):
        return 0.0
    first = chain.variables[chain.steps[0].variable]
    if not first.is_plain:
        raise metric_failure(
            f"the joint '{first.joint.name}' also moves joints after it, so the volume is unknown",
            first.joint.span,
        )
    lower, upper = chain.limits
    positions = lower + _samples(len(lower)) * (upper - lower)
    positions[:, chain.steps[0].variable] = 0.0
    points = _across(chain, chain.points(positions, first=1))
    stroke = min(first.upper - first.lower, 2 * np.pi) if first.turns else first.upper - first.lower
    cells = CELLS
    coarse, _ = _volume(points, stroke, cells // 2, first.turns)
    fine, reached = _volume(points, stroke, cells, first.turns)
    while len(points) > CROWDED * reached and cells < MOST_CELLS:
        cells *= 2
        coarse = fine
        fine, reached = _volume(points, stroke, cells, first.turns)
    return max(2 * fine - coarse, 0.0)


@cache
def _samples(count: int) -> Floats:
    """Return points of Sobol's sequence, always the same: variants are compared at equal ones."""
    from scipy.stats import qmc

    points: Floats = qmc.Sobol(count, scramble=False).random_base2(POWER)
    return points + 0.5 / len(points)


def _fills_space(chain: Chain) -> bool:
    """Return whether the tip can move in three directions anywhere."""
    count = len(chain.variables)
    if count < 3:
        return False
    lower, upper = chain.limits
    inner = np.random.Generator(np.random.Philox(0)).random((PROBES, count))
    positions = lower + inner * (upper - lower)
    step = 1e-6
    columns = []
    for index in range(count):
        moved = np.array([positions, positions])
        moved[0, :, index] -= step
        moved[1, :, index] += step
        columns.append((chain.points(moved[1]) - chain.points(moved[0])) / (2 * step))
    jacobians = np.stack(columns, axis=-1)
    sizes = np.linalg.svd(jacobians, compute_uv=False)
    return bool((sizes[:, 2] > RANK_TOLERANCE * np.maximum(sizes[:, 0], 1e-30)).any())


def _across(chain: Chain, points: Floats) -> Floats:
    """Return points in the frame below the first joint as two coordinates across, and one along.

    For a joint that turns: distance from the axis, height along it, angle about it. For one that
    slides: two directions across it, and the way along it.
    """
    axis = chain.steps[0].axis
    helper = np.eye(3)[abs(axis).argmin()]
    one = np.cross(axis, helper)
    one /= np.linalg.norm(one)
    other = np.cross(axis, one)
    x, y, z = points @ one, points @ other, points @ axis
    if chain.steps[0].turns:
        return np.column_stack([np.hypot(x, y), z, np.arctan2(y, x)])
    return np.column_stack([x, y, z])


def _volume(points: Floats, stroke: float, cells: int, turns: bool) -> tuple[float, int]:
    """Return the volume with a grid of square cells, and how many of them are reached.

    Args:
        points: from `_across`.
        stroke: how far the first joint moves them along.
        cells: how many are across what is reached.
        turns: whether along is about an axis.
    """
    low = points[:, :2].min(axis=0)
    if turns:
        low[0] = 0.0
    width = (points[:, :2].max(axis=0) - low).max() * (1 + 1e-9) / cells
    column, row = ((points[:, :2] - low) / width).astype(np.int64).T
    cell = column * (cells + 1) + row
    order = np.lexsort((points[:, 2], cell))
    cell, along = cell[order], points[order, 2]
    starts = np.flatnonzero(np.diff(cell, prepend=-1))
    # The intervals from each place to the stroke after it cover the gap to the next place, but no
    # more of it than the stroke.
    gaps = np.diff(along, append=0.0)
    ends = np.append(starts[1:], len(cell)) - 1
    gaps[ends] = along[starts] + 2 * np.pi - along[ends] if turns else stroke
    covered = np.add.reduceat(np.minimum(gaps, stroke), starts)
    radii = (cell[starts] // (cells + 1) + 0.5) * width if turns else 1.0
    return float((covered * radii).sum() * width**2), len(starts)


# --- the box around a robot at home, along the axes of the root -------------------------------


_known_corners: dict[tuple[str, int, int], Any] = {}
"""The corners of meshes that were read in this process, by path, time and size of the file."""


def bounding_box(robot: Robot, finder: MeshFinder) -> Vector:
    """Return the lengths of the box along x, y and z of the root, in metres.

    The joints are as in the state `home`; those that it does not name, and all where there is no
    such state, are at 0, or in the middle of limits that exclude 0. The box is around the visual
    shapes, or around the collision shapes of a robot that has no visual ones.

    Args:
        robot: the robot.
        finder: finds the files of meshes.

    Raises:
        YamaroError: the robot has no shapes, or a mesh cannot be read.
    """
    poses = link_poses(robot, home_positions(robot))
    low, high = [inf] * 3, [-inf] * 3
    for name, pose, shape in _shapes(robot):
        if isinstance(shape, Mesh):
            spans = _mesh_spans(poses[name] @ pose, shape, finder)
        else:
            spans = [
                (middle - half, middle + half)
                for middle, half in zip(*_halves(poses[name] @ pose, shape), strict=True)
            ]
        low = [min(known, span[0]) for known, span in zip(low, spans, strict=True)]
        high = [max(known, span[1]) for known, span in zip(high, spans, strict=True)]
    if low[0] == inf:
        raise metric_failure("the robot has no shapes, so there is no box around it", robot.span)
    x, y, z = (end - start for start, end in zip(low, high, strict=True))
    return (x, y, z)


def _shapes(robot: Robot) -> list[tuple[str, Pose, Shape]]:
    """Return the shapes that count, each with its link and its pose there."""
    for kind in ("visuals", "collisions"):
        found = [
            (link.name, each.pose, each.shape)
            for link in robot.links.values()
            for each in getattr(link, kind)
            if each.shape is not None
        ]
        if found:
            return found
    return []


def _halves(placed: Pose, shape: Shape) -> tuple[Vector, tuple[float, ...]]:
    """Return the middle of a shape, and how far it extends from there along each axis.

    These are the support functions of the shapes: of a box Σ|rᵢ|·sizeᵢ/2, of a disc across the
    unit vector a, radius·√(1 − a²).
    """
    if isinstance(shape, Box):
        sizes = (shape.x / 2, shape.y / 2, shape.z / 2)
        rows = placed.rotation
        return placed.position, tuple(
            sum(abs(part) * size for part, size in zip(row, sizes, strict=True)) for row in rows
        )
    if isinstance(shape, Sphere):
        return placed.position, (shape.radius,) * 3
    assert isinstance(shape, (Cylinder, Capsule))
    rim = isinstance(shape, Cylinder)
    return placed.position, tuple(
        abs(z) * shape.length / 2 + shape.radius * (hypot(x, y) if rim else 1)
        for x, y, z in placed.rotation
    )


def _mesh_spans(placed: Pose, shape: Mesh, finder: MeshFinder) -> list[tuple[float, float]]:
    """Return the extent of a mesh along each axis."""
    from ...meshes.formats import MeshFileError, MissingLibraryError
    from ...meshes.surfaces import read_surfaces

    assert shape.element is not None
    span = shape.element.value_span("filename")
    path = finder.resolve(shape.filename, span)
    if path is None:
        raise metric_failure(f"the mesh '{shape.filename}' is not found", span)
    try:
        state = os.stat(path)
        key = (path, state.st_mtime_ns, state.st_size)
        if key not in _known_corners:
            surfaces = read_surfaces(path, finder.allows)
            _known_corners[key] = np.concatenate([surface.points for surface in surfaces])
    except (MeshFileError, MissingLibraryError, OSError) as error:
        raise metric_failure(f"the mesh '{shape.filename}' cannot be read: {error}", span) from None
    corners = _known_corners[key]
    points = corners * np.array(shape.scale) @ np.array(placed.rotation).T + placed.position
    return list(zip(points.min(axis=0).tolist(), points.max(axis=0).tolist(), strict=True))
