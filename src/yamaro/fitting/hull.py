"""The convex hull of a mesh, which stays closed and convex in single precision.

Its corners are those of the mesh, as an STL holds them. Needles go with their middle corner: one
that is nearly on the line between two others, which another rounding would put inside of the hull.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ..meshes.formats import MeshFileError
from ..meshes.triangles import TriangleMesh
from .sampling import arrays_of

if TYPE_CHECKING:
    from .sampling import Floats, Whole

THINNEST = 1e-7
"""The height of a triangle, as a part of the hull's size, under which it is a needle."""
ROUNDS = 20
"""How often needles are looked for at most: others come where some went."""


def hull_of(mesh: TriangleMesh) -> TriangleMesh:
    """Return the convex hull of a mesh, closed, seen from outside.

    Raises:
        MeshFileError: the mesh has no triangles, or is flat.
    """
    points = arrays_of(mesh)[0]
    size = float(np.ptp(points, axis=0).max())
    corners, _ = _hulled(points)
    corners, triangles = _hulled(corners.astype(np.float32).astype(float))
    for _ in range(ROUNDS):
        needless = _needless(corners, triangles, THINNEST * size)
        if not len(needless) or len(corners) - len(needless) < 4:
            break
        corners, triangles = _hulled(np.delete(corners, needless, axis=0))
    return _mesh_of(corners, triangles)


def hull_mesh(points: Floats) -> TriangleMesh:
    """Return the hull of points as a mesh, its triangles counterclockwise as seen from outside.

    Raises:
        MeshFileError: they are flat.
    """
    return _mesh_of(*_hulled(points))


def _mesh_of(corners: Floats, triangles: Whole) -> TriangleMesh:
    return TriangleMesh(
        [(x, y, z) for x, y, z in corners.tolist()],
        [(i, j, k) for i, j, k in triangles[np.lexsort(triangles.T[::-1])].tolist()],
    )


def _hulled(points: Floats) -> tuple[Floats, Whole]:
    """Return the corners of the hull of points, in their order, and its triangles."""
    try:
        found = ConvexHull(points)
    except (QhullError, ValueError):
        raise MeshFileError("it is flat, so that its convex hull has no volume") from None
    kept = np.sort(found.vertices)
    triangles = np.searchsorted(kept, found.simplices)
    corners: Floats = points[kept]
    a, b, c = np.moveaxis(corners[triangles], 1, 0)
    turned = (np.cross(b - a, c - a) * found.equations[:, :3]).sum(axis=1) < 0
    triangles[turned] = triangles[turned][:, [0, 2, 1]]
    return corners, triangles


def _needless(corners: Floats, triangles: Whole, low: float) -> Whole:
    """Return middle corners of needles, of which no two are in one triangle."""
    sides = corners[np.roll(triangles, -2, axis=1)] - corners[np.roll(triangles, -1, axis=1)]
    lengths = np.linalg.norm(sides, axis=2)
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    longest = lengths.argmax(axis=1)
    heights = areas / np.maximum(lengths.max(axis=1), 1e-300)
    thin = np.flatnonzero(heights < low)
    order = thin[np.argsort(heights[thin], kind="stable")]
    around: dict[int, set[int]] = {}
    middles = triangles[order, longest[order]]
    near = triangles[np.isin(triangles, middles).any(axis=1)]
    for row in near.tolist():
        for corner in row:
            around.setdefault(corner, set()).update(row)
    found: set[int] = set()
    for middle in middles.tolist():
        if not found & around[middle]:
            found.add(middle)
    return np.array(sorted(found), int)
