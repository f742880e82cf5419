"""Convex polyhedra with few corners, which contain others and stay convex in single precision.

Source of the collapses: P. V. Sander, X. Gu, S. J. Gortler, H. Hoppe, J. Snyder, Silhouette
Clipping, SIGGRAPH 2000 (progressive hulls).
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError, cKDTree

from .hull import hull_mesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..meshes.triangles import TriangleMesh
    from .sampling import Floats, Whole

MOST_CORNERS = 64
"""Corners of a piece: more than that PhysX does not take on a GPU."""
ROUGH = 200
"""Corners of the polyhedron whose edges collapse."""
AT_ONCE = 10
"""Of this number of corners one goes at once."""
AROUND = 14
"""Planes around an edge, above which it stays."""
NEAR = 1e-6
"""Corners that are as near as this, by the size of their piece, are one."""
LOW = (1e-5, 1e-4, 5e-4, 2e-3)
"""Corners that are not higher above the hull of the others go: the first that is enough."""
DENT = 4e-6
"""How far a corner may be above the next triangle in single precision, by the size of a piece."""
ABOUT = 1e-9
"""How far under a plane a corner is still on it, by the size of a piece."""
UPRIGHT = 1e-7
"""The volume that three unit normals span, below which their planes do not meet in one point."""


def simplified(corners: Floats, most: int = MOST_CORNERS) -> Floats:
    """Return corners, at most `most`, of a polyhedron that contains a convex one.

    It is cut out of a box by planes of faces, each the one that is farthest below the corner that
    is farthest outside. So large faces stay where they are. Then edges collapse.
    """
    size = float(np.ptp(corners, axis=0).max())
    found = corners
    try:
        if len(corners) > most:
            found = _collapsed(_cut_out(corners, max(most, ROUGH), size), most, size)
            if len(found) > most:
                found = _cut_out(corners, most, size)
        for low in LOW:
            found = _clean(corners, found, size, low)
            if _dent(hull_mesh(found)) < DENT * size:
                break
    except (QhullError, ValueError):  # nearly flat
        pass
    return found


def _cut_out(corners: Floats, most: int, size: float) -> Floats:
    faces = np.unique(np.round(ConvexHull(corners).equations, 12), axis=0)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    middle = (middle + corners.mean(axis=0)) / 2
    sides = (*np.eye(3), *-np.eye(3))
    planes = [np.append(side, -(corners @ side).max()) for side in sides]
    found = corners
    while True:
        outer: Floats = HalfspaceIntersection(np.array(planes), middle).intersections
        outer = outer[ConvexHull(outer).vertices]
        distinct = _distinct(outer, NEAR * size)
        if len(distinct) > most:
            return found
        found = distinct
        outside = np.round(outer @ faces[:, :3].T + faces[:, 3], 12)
        corner = int(outside.max(axis=1).argmax())
        face = int(outside[corner].argmax())
        if not outside[corner, face] > NEAR * size or len(planes) > 2 * most:
            return found
        planes.append(faces[face])


def _collapsed(corners: Floats, most: int, size: float) -> Floats:
    """Return corners of a polyhedron around a convex one, at most `most` where edges can collapse.

    An edge becomes the corner outside of all planes around it that adds the least volume.
    """
    found = corners
    while len(found) > most:
        hull = ConvexHull(found)
        if len(hull.vertices) < len(found):
            found = found[np.sort(hull.vertices)]
            continue
        # Those at once must not see the same triangles, or one would be under the other.
        touched: set[int] = set()
        gone: set[int] = set()
        new: list[Floats] = []
        enough = max(1, min(len(found) - most, len(found) // AT_ONCE))
        for edge, corner, triangles in _collapses(found, hull, size):
            if not triangles & touched:
                touched |= triangles
                gone.update(edge)
                new.append(corner)
                if len(new) == enough:
                    break
        if not new:
            break
        found = np.vstack([np.delete(found, sorted(gone), axis=0), *new])
    return found


def _collapses(
    points: Floats, hull: ConvexHull, size: float
) -> list[tuple[tuple[int, int], Floats, set[int]]]:
    """Return edges, the corner that each would become, and the triangles it touches, best first."""
    a, b, c = np.moveaxis(points[hull.simplices], 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    _, first, plane_of = np.unique(
        np.round(hull.equations, 9), axis=0, return_index=True, return_inverse=True
    )
    stars: list[set[int]] = [set() for _ in points]
    for number, corners in enumerate(hull.simplices.tolist()):
        for corner in corners:
            stars[corner].add(number)
    sides = np.sort(hull.simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    rows: dict[int, list[tuple[tuple[int, int], Floats, Floats]]] = {}
    for i, j in np.unique(sides, axis=0).tolist():
        around = sorted(stars[i] | stars[j])
        own, places = np.unique(plane_of.reshape(-1)[around], return_inverse=True)
        if 3 <= len(own) <= AROUND:
            shares: Floats = np.bincount(places.reshape(-1), areas[around]).astype(float)
            planes: Floats = hull.equations[first[own]]
            rows.setdefault(len(own), []).append(((i, j), planes, shares))
    found: list[tuple[float, tuple[int, int], Floats, set[int]]] = []
    for count, some in sorted(rows.items()):
        edges, around_each, shares_of_each = zip(*some, strict=True)
        threes = np.array(list(combinations(range(count), 3)))
        new, exists = _lowest(np.array(around_each), np.array(shares_of_each), threes, size)
        heights = new @ hull.equations[:, :3].T + hull.equations[:, 3]
        heights[heights < ABOUT * size] = 0.0
        added = np.round((heights * areas).sum(axis=1) / size**3, 12).tolist()
        for index in np.flatnonzero(exists):
            i, j = edges[index]
            touched = set(np.flatnonzero(heights[index]).tolist()) | stars[i] | stars[j]
            found.append((added[index], (i, j), new[index], touched))
    found.sort(key=lambda each: each[:2])
    return [each[1:] for each in found]


def _lowest(
    planes: Floats, shares: Floats, threes: Whole, size: float
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the points outside of planes that are lowest above them, and whether there is one.

    Args:
        planes: of each of N edges, M planes, as normal and offset, N×M×4.
        shares: what the height above each of them counts, N×M.
        threes: which three planes may meet in such a point, K×3.
        size: that of the polyhedron, in metres.
    """
    normals, offsets = planes[:, threes, :3], -planes[:, threes, 3]
    meets = np.abs(np.linalg.det(normals)) > UPRIGHT
    normals = np.where(meets[..., None, None], normals, np.eye(3))
    points = np.linalg.solve(normals, offsets[..., None])[..., 0]
    heights = np.einsum("ijk,ilk->ijl", points, planes[..., :3]) + planes[:, None, :, 3]
    is_outside = meets & (heights >= -ABOUT * size).all(axis=2)
    costs = (np.maximum(heights, 0.0) * shares[:, None]).sum(axis=2) / size**3
    costs = np.where(is_outside, np.round(costs, 12), np.inf)
    best, every = costs.argmin(axis=1), np.arange(len(costs))
    return points[every, best], np.isfinite(costs[every, best])


def _clean(corners: Floats, outer: Floats, size: float, low: float) -> Floats:
    """Return corners of a polyhedron around others, without needles, so that single precision does.

    Corners that are near others or hardly above the hull of the others go, and what is left
    becomes larger by what is missing.
    """
    found = _distinct(outer, NEAR * size)
    hull = ConvexHull(found)
    order = sorted(hull.vertices)
    found = found[order]
    index = 0
    while index < len(found) > 4:
        others = np.delete(found, index, axis=0)
        equations = ConvexHull(others).equations
        if (equations[:, :3] @ found[index] + equations[:, 3]).max() < low * size:
            found = others
        else:
            index += 1
    equations = ConvexHull(found).equations
    middle = found.mean(axis=0)
    depths = -(equations[:, :3] @ middle + equations[:, 3])
    missing = (corners @ equations[:, :3].T + equations[:, 3]).max(axis=0)
    grown = float((np.maximum(missing, 0.0) / depths).max())
    if grown * size > 1e-12 * size:
        found = middle + (found - middle) * (1 + grown + 1e-12)
    return found


def _dent(mesh: TriangleMesh) -> float:
    """Return how far corners are above the plane of a next triangle, in single precision."""
    points = np.array(mesh.vertices, np.float32).astype(float)
    triangles = np.array(mesh.triangles)
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    owners = {(i, j): row for row, each in enumerate(mesh.triangles)
              for i, j in zip(each, (*each[1:], each[0]), strict=True)}  # fmt: skip
    others = [
        [owners[j, i] for i, j in zip(each, (*each[1:], each[0]), strict=True)]
        for each in mesh.triangles
    ]
    across = points[triangles[np.array(others)]] - a[:, None, None]
    return float(np.einsum("ijkl,il->ijk", across, normals).max())


def _distinct(points: Floats, apart: float) -> Floats:
    """Return points without those that are near an earlier one."""
    pairs = cKDTree(points).query_pairs(apart, output_type="ndarray")
    return np.delete(points, np.unique(pairs.max(axis=1)), axis=0) if len(pairs) else points
