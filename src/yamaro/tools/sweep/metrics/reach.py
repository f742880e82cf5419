"""How far the tips of a robot get from its root, over the limits of its joints.

The square of the distance of a point from the root is a + b·cos q + c·sin q in the angle q of one
joint, with constants that depend on the other joints, and a parabola in the position of one that
slides. So the best position of one joint for given others is known exactly, and the joints are
moved to it in turn until nothing changes. That is done from many positions at once: the search
ends in the farthest of the local maxima found. What is found is a position of the robot, so the
true reach is never less.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from .chains import Chain, tips_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ....model.robot import Robot
    from .chains import Step, Variable

    Floats = NDArray[np.floating[Any]]

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
        _improve(chain, positions)
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


def _improve(chain: Chain, positions: Floats) -> None:
    """Move each joint to where the tip is the farthest, from the root to the tip."""
    arms = _arms(chain, positions)
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


def _arms(chain: Chain, positions: Floats) -> list[Floats]:
    """Return for each joint where the tip is in the frame below it."""
    points = np.broadcast_to(chain.tip, (len(positions), 3))
    found: list[Floats] = []
    for step in reversed(chain.steps):
        found.append(points)
        angles = step.factor * positions[:, step.variable] + step.offset
        points = step.before(step.moved(points, angles))
    return found[::-1]


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
