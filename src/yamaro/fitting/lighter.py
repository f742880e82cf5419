"""Meshes with fewer triangles, which look the same.

Edges are collapsed where that changes the surface least, by fast-simplification. Source:
M. Garland, P. S. Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..meshes.formats import MissingLibraryError
from ..meshes.surfaces import read_surfaces
from ..meshes.triangles import TriangleMesh, joined
from .quality import quality_of
from .sampling import arrays_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from .fit import Color

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

FARTHEST = 0.01
"""How far the surfaces may be apart, as a part of the mesh's size."""
HASTES = (1, 2, 3, 4, 5, 7)
"""How hastily edges are collapsed: the lower, the nearer, and the fewer of them."""
STEP = 1.6
"""How many times as many triangles are tried if they are farther apart."""
MOST_COLORS = 32
"""Colours that a mesh keeps; each is a mesh of its own."""


def parts_by_color(
    path: str, allows: Callable[[str], bool] | None
) -> tuple[list[tuple[TriangleMesh, Color | None]], str]:
    """Return the parts of a mesh file that have one colour each, and what of its look is lost.

    Lost is a `texture`, or `colours` that change within a triangle or are more than `MOST_COLORS`;
    "" if nothing is. The part that they were on has no colour.

    Args:
        path: the file.
        allows: whether another file that this one names may be read, such as a texture.

    Raises:
        MeshFileError: the file cannot be read.
        MissingLibraryError: its format needs a library that is not installed.
    """
    found: dict[Color | None, list[TriangleMesh]] = {}
    lost = ""
    for surface in read_surfaces(path, allows):
        points, triangles = surface.points, surface.triangles
        if surface.point_colors is None:
            lost = lost if surface.texture is None else "texture"
            groups = [(triangles, surface.color)]
        else:
            corners = surface.point_colors[triangles]
            is_one = (corners == corners[:, :1]).all(axis=(1, 2))
            groups = []
            if not is_one.all():
                lost = lost or "colours"
                groups.append((triangles[~is_one], None))
            for row in np.unique(corners[is_one, 0], axis=0)[: MOST_COLORS + 1]:
                own = is_one & (corners[:, 0] == row).all(axis=1)
                groups.append((triangles[own], tuple((row / 255).tolist())))
        for chosen, color in groups:
            key: Color | None = None
            if color is not None:
                red, green, blue, alpha = (round(float(each), 4) for each in color)
                key = red, green, blue, alpha
            found.setdefault(key, []).append(_mesh_of(points, chosen))
    if len(found) > MOST_COLORS:
        return [(joined([part for parts in found.values() for part in parts]), None)], "colours"
    return [(joined(parts), color) for color, parts in found.items()], lost


def lighter(mesh: TriangleMesh, most: int, *, size: float = 0.0) -> TriangleMesh:
    """Return a mesh of at most `most` triangles, or of more if it takes more to be near the first.

    The surfaces are nowhere farther apart than `FARTHEST`. A mesh that has no more triangles is
    returned as it is.

    Args:
        mesh: the mesh, or a part of one.
        most: the greatest number of triangles.
        size: the longest side of the box around what it is a part of; by default its own.

    Raises:
        MeshFileError: the mesh has no surface.
        MissingLibraryError: fast-simplification is not installed.
    """
    if len(mesh.triangles) <= most:
        return mesh
    points, triangles = arrays_of(mesh)
    size = max(size, float(np.ptp(points, axis=0).max()))
    wanted = float(most)
    while wanted < len(triangles):
        found = collapsed(points, triangles, int(wanted))
        if len(found[1]) <= wanted:
            other = _mesh_of(*found)
            if quality_of(mesh, [other])[0] <= FARTHEST * size:
                return other
        wanted *= STEP
    return mesh


def collapsed(points: Floats, triangles: Whole, most: int) -> tuple[Floats, Whole]:
    """Return corners and triangles near those of a mesh: `most`, or more where it takes more.

    Raises:
        MissingLibraryError: fast-simplification is not installed.
    """
    try:
        from fast_simplification import simplify
    except ImportError as error:
        raise MissingLibraryError("fast-simplification") from error
    low, size = points.min(axis=0), float(np.ptp(points, axis=0).max())
    unit, rows = (points - low) / size, triangles.astype(np.int32)
    fewest = points, triangles
    for haste in HASTES:
        found, corners = simplify(unit, rows, target_count=most, agg=haste)
        corners = np.asarray(corners, int)
        corners = corners[(np.diff(np.sort(corners, axis=1), axis=1) > 0).all(axis=1)]
        if 0 < len(corners) < len(fewest[1]):
            fewest = np.asarray(found, float) * size + low, corners
        if len(fewest[1]) <= most:
            break
    return fewest


def _mesh_of(points: Floats, triangles: Whole) -> TriangleMesh:
    used, places = np.unique(triangles.ravel(), return_inverse=True)
    rows = places.reshape(-1, 3).tolist()
    return TriangleMesh(
        [(x, y, z) for x, y, z in points[used].tolist()], [(i, j, k) for i, j, k in rows]
    )
