"""The floor under a robot: its soft shadow, and the lines of a grid."""

from __future__ import annotations

from math import floor, log10
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]

CELLS = 192
"""Cells of the shadow along each side."""

DARKNESS = 0.5
"""How dark the shadow is where the robot touches the floor, from 0 to 1."""


class Shadow:
    """The shadow that light from everywhere leaves on the floor: dark where something is near it.

    Attributes:
        alpha: how dark each cell is, from 0 to 1; rows along y, columns along x.
        low, high: opposite corners of it on the floor, x and y in metres.
    """

    __slots__ = ("alpha", "high", "low")

    def __init__(self, samples: Floats, level: float, size: float) -> None:
        """Work it out.

        Args:
            samples: points all over the surface of the robot, N×3.
            level: the height of the floor.
            size: how large the robot is, in metres.
        """
        middle = (samples[:, :2].min(axis=0) + samples[:, :2].max(axis=0)) / 2
        extent = float((samples[:, :2].max(axis=0) - samples[:, :2].min(axis=0)).max())
        half = extent / 2 + 0.35 * size
        self.low, self.high = middle - half, middle + half
        cells = ((samples[:, :2] - self.low) / (2 * half) * CELLS).astype(int).clip(0, CELLS - 1)
        near = np.exp(-(samples[:, 2] - level).clip(0) / (0.12 * size))
        dark = np.zeros((CELLS, CELLS))
        np.maximum.at(dark, (cells[:, 1], cells[:, 0]), near)
        soft = 0.02 * size / (2 * half) * CELLS
        contact, around = _blurred(dark, soft), _blurred(dark, 4 * soft)
        self.alpha = (DARKNESS * (0.6 * contact + 0.7 * around)).clip(0, 1)


def surface_samples(points: Floats, triangles: NDArray[np.integer[Any]], count: int) -> Floats:
    """Return points all over a surface, the same each time, count×3."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    total = areas.sum()
    if not total > 0:
        return points[:count]
    source = np.random.default_rng(0)
    chosen = source.choice(len(triangles), count, p=areas / total)
    u, v = source.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    samples: Floats = a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]
    return samples


def grid_step(size: float) -> float:
    """Return the distance between lines, 1, 2 or 5 times a power of ten, for about ten of them."""
    power = 10.0 ** floor(log10(size / 10))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= size / 10)


def grid_lines(middle: Floats, size: float, level: float) -> Floats:
    """Return lines on the floor around a point, at round coordinates, as pairs of points N×2×3."""
    step = grid_step(size)
    count = int(1.2 * size / step) + 1
    low = (np.round(middle[:2] / step) - count) * step
    along = np.arange(2 * count + 1) * step
    span = along[-1]
    lines = []
    for axis in (0, 1):
        ends = np.zeros((len(along), 2, 3))
        ends[:, :, axis] = (low[axis] + along)[:, None]
        ends[:, 0, 1 - axis] = low[1 - axis]
        ends[:, 1, 1 - axis] = low[1 - axis] + span
        ends[:, :, 2] = level
        lines.append(ends)
    return np.concatenate(lines)


def _blurred(image: Floats, width: float) -> Floats:
    """Return an image blurred by a bell curve of this width, in cells."""
    radius = max(int(3 * width), 1)
    weights = np.exp(-0.5 * (np.arange(-radius, radius + 1) / max(width, 0.3)) ** 2)
    weights /= weights.sum()
    for _ in range(2):
        image = np.stack([np.convolve(row, weights, "same") for row in image]).T
    return image
