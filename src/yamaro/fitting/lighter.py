"""Meshes with fewer triangles, which look the same.

Edges are collapsed where that changes the surface least, by fast-simplification. Source:
M. Garland, P. S. Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..meshes.formats import MissingLibraryError
from ..meshes.triangles import TriangleMesh
from .quality import quality_of
from .sampling import arrays_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

FARTHEST = 0.01
"""How far the surfaces may be apart, as a part of the mesh's size."""
HASTES = (1, 2, 3, 4, 5, 7)
"""How hastily edges are collapsed: the lower, the nearer, and the fewer of them."""
STEP = 1.6
"""How many times as many triangles are tried if they are farther apart."""


def lighter(mesh: TriangleMesh, most: int) -> TriangleMesh:
    """Return a mesh of at most `most` triangles, or of more if it takes more to be near the first.

    The surfaces are nowhere farther apart than `FARTHEST`. A mesh that has no more triangles is
    returned as it is.

    Raises:
        MeshFileError: the mesh has no surface.
        MissingLibraryError: fast-simplification is not installed.
    """
    if len(mesh.triangles) <= most:
        return mesh
    try:
        from fast_simplification import simplify
    except ImportError as error:
        raise MissingLibraryError("fast-simplification") from error
    points, triangles = arrays_of(mesh)
    low = points.min(axis=0)
    size = float(np.ptp(points, axis=0).max())
    unit = (points - low) / size
    wanted = float(most)
    while wanted < len(triangles):
        for haste in HASTES:
            found, corners = simplify(
                unit, triangles.astype(np.int32), target_count=int(wanted), agg=haste
            )
            corners = np.asarray(corners, int)
            corners = corners[(np.diff(np.sort(corners, axis=1), axis=1) > 0).all(axis=1)]
            if 0 < len(corners) <= wanted:
                other = _mesh_of(np.asarray(found, float) * size + low, corners)
                if quality_of(mesh, [other])[0] <= FARTHEST * size:
                    return other
                break
        wanted *= STEP
    return mesh


def _mesh_of(points: Floats, triangles: Whole) -> TriangleMesh:
    used, places = np.unique(triangles.ravel(), return_inverse=True)
    rows = places.reshape(-1, 3).tolist()
    return TriangleMesh(
        [(x, y, z) for x, y, z in points[used].tolist()], [(i, j, k) for i, j, k in rows]
    )
