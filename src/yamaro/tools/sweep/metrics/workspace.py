"""The volume of the places that a tool gets to, over the limits of the joints.

The first joint is integrated exactly: it turns or slides the places that the tool gets to by the
other joints along circles or lines. Of each circle or line the part that is reached is measured,
which is a union of intervals of equal length, one for each sample of the other joints. The circles
or lines are those through the cells of a square grid.

A cell at the border counts as a whole, which adds what is in proportion to the width of the cells.
So the volume is worked out with two widths, as fine as the samples allow, and extrapolated to width
0 (L. F. Richardson, The Approximate Arithmetical Solution by Finite Differences, 1911).
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from .chains import Chain
from .failures import metric_failure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ....model.robot import Robot

    Floats = NDArray[np.floating[Any]]

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
