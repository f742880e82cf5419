"""Points spread over the surface of a mesh, the same ones each time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..meshes.formats import MeshFileError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..meshes.triangles import TriangleMesh

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

PLASTIC = 1.32471795724474602596
"""The real root of x³ = x + 1, of which the R2 sequence is made.

Source: M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
"""


def arrays_of(mesh: TriangleMesh) -> tuple[Floats, Whole]:
    """Return the corners of a mesh that triangles use, N×3, and its triangles, M×3."""
    points = np.array(mesh.vertices, float).reshape(-1, 3)
    triangles = np.array(mesh.triangles, int).reshape(-1, 3)
    used, places = np.unique(triangles.ravel(), return_inverse=True)
    return points[used], places.reshape(-1, 3)


def areas_of(points: Floats, triangles: Whole) -> Floats:
    """Return the areas of triangles."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    sides = np.cross(b - a, c - a)
    areas: Floats = np.sqrt((sides * sides).sum(axis=1)) / 2
    return areas


def spread_over(points: Floats, triangles: Whole, count: int) -> tuple[Floats, Whole]:
    """Return points spread evenly over the area of triangles, and the triangle of each.

    Each has the same share of the area: they are taken at equal steps of the area summed over the
    triangles, and inside of their triangles by a sequence that fills a square evenly.

    Raises:
        MeshFileError: the triangles have no area.
    """
    sums = np.cumsum(areas_of(points, triangles))
    if not sums[-1] > 0:
        raise MeshFileError("its triangles have no area")
    steps = (np.arange(count) + 0.5) * (sums[-1] / count)
    chosen = np.minimum(np.searchsorted(sums, steps, side="right"), len(sums) - 1)
    turns = np.arange(1, count + 1)
    u, v = (0.5 + turns / PLASTIC) % 1, (0.5 + turns / PLASTIC**2) % 1
    is_outside = u + v > 1
    u, v = np.where(is_outside, 1 - u, u)[:, None], np.where(is_outside, 1 - v, v)[:, None]
    a, b, c = (points[triangles[chosen, corner]] for corner in range(3))
    return a + u * (b - a) + v * (c - a), chosen
