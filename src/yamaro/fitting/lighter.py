"""Meshes with fewer triangles, which look the same.

Edges collapse until there are few enough triangles, or the surfaces would be too far apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..meshes.surfaces import read_surfaces
from ..meshes.triangles import TriangleMesh, joined
from .collapse import states
from .quality import Surface

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from .collapse import State
    from .fit import Color

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

FARTHEST = 0.01
"""How far the surfaces may be apart, as a part of the mesh's size."""
EXACT = 1e-3
"""Below this part of the mesh's size a distance is an upper bound."""
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


def lighter(
    parts: Sequence[TriangleMesh], most: int, *, size: float
) -> tuple[list[TriangleMesh], float]:
    """Return the parts of a mesh with at most `most` triangles together, and how far they are away.

    They have more triangles if it takes more to stay within `FARTHEST`, and are those given if
    nothing lighter does. A part that is too small to be seen may lose all.

    Args:
        parts: the parts; where they touch, they stay together.
        most: the greatest number of triangles.
        size: the longest side of the box around all of them, in metres.
    """
    corners = [np.array(part.vertices, float).reshape(-1, 3) for part in parts]
    firsts = np.cumsum([0, *map(len, corners)])
    rows = [np.array(part.triangles, int).reshape(-1, 3) for part in parts]
    labels = np.repeat(np.arange(len(parts)), [*map(len, rows)])
    every = np.concatenate([each + first for each, first in zip(rows, firsts[:-1], strict=True)])
    used, places = np.unique(every, return_inverse=True)
    points, corner = np.unique(np.concatenate(corners)[used], axis=0, return_inverse=True)
    triangles = corner.reshape(-1)[places].reshape(-1, 3)
    first = Surface(points, triangles)
    found: State | None = None
    tried = list(states(points, triangles, labels, most))
    limit = FARTHEST * size
    low, high = 0, len(tried)  # of those before low one is near enough, and of those from high none
    index = high - 1
    while low < high:
        if first.apart_from(Surface(*tried[index][:2]), limit) <= limit:
            found, low = tried[index], index + 1
        else:
            high = index
        index = (low + high) // 2
    if found is None:
        return [*parts], 0.0
    places_left, left, owners = found
    apart = first.apart_from(Surface(places_left, left), EXACT * size)
    return [_mesh_of(places_left, left[owners == label]) for label in range(len(parts))], apart


def _mesh_of(points: Floats, triangles: Whole) -> TriangleMesh:
    used, places = np.unique(triangles.ravel(), return_inverse=True)
    rows = places.reshape(-1, 3).tolist()
    return TriangleMesh(
        [(x, y, z) for x, y, z in points[used].tolist()], [(i, j, k) for i, j, k in rows]
    )
