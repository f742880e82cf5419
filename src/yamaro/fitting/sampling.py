"""Points on the surface of a mesh and inside of it, the same ones each time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial import cKDTree

from ..meshes.formats import MeshFileError
from ..meshes.triangles import TriangleMesh

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]

SAMPLES = 3_000
"""Points spread over the surface of a solid."""
MOST_CORNERS = 3_000
"""Corners of the mesh that are points as well."""
CELLS = 24
"""Places along the longest side of the box around a solid."""
ON_SURFACE = 0.4
"""Part of all directions in which a place sees the inside if it is not outside."""
CLUSTERED, CLUSTERS = 20_000, 32
"""Triangles that a solid has at least if those far away count together, and cells along its longest
side for that."""
FLAT = 1e-9
"""How far from the plane of a triangle, by its size, a place is on it."""
HIDDEN = 1.25
"""How often a surface is around its own parts that are inside: once and a half if they are flat."""
VIEWS, PIXELS, DENSE = 40, 128, 60_000
"""Pairs of opposite directions from which a surface is looked at, the side of each picture, and the
points of the surface in it."""
BEHIND = 2
"""How many pixels deep below the nearest point of the surface a point is seen."""
HAIR = 1e-6
"""How far outside, by its size, points are on the surface of a solid."""
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


def without_twins(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh in which each triangle is once, whatever side it is seen from.

    Exporters write surfaces twice, also once for each side: then their volume has no meaning.
    """
    points = np.array(mesh.vertices, float).reshape(-1, 3)
    _, places = np.unique(points, axis=0, return_inverse=True)
    corners = np.sort(places.reshape(-1)[np.array(mesh.triangles, int).reshape(-1, 3)], axis=1)
    first = np.unique(corners, axis=0, return_index=True)[1]
    if len(first) == len(corners):
        return mesh
    return TriangleMesh(mesh.vertices, [mesh.triangles[index] for index in np.sort(first)])


def areas_of(points: Floats, triangles: Whole) -> Floats:
    """Return the areas of triangles."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    sides = np.cross(b - a, c - a)
    areas: Floats = np.sqrt((sides * sides).sum(axis=1)) / 2
    return areas


def enclosed(points: Floats, triangles: Whole) -> float:
    """Return the volume that a closed surface encloses, summed over tetrahedra."""
    a, b, c = np.moveaxis(points[triangles] - (points.min(axis=0) + points.max(axis=0)) / 2, 1, 0)
    return abs(float((a * np.cross(b, c)).sum())) / 6


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


def directions(count: int) -> Floats:
    """Return unit vectors spread over half a sphere, as a spiral.

    Source: R. Swinbank, R. J. Purser, Fibonacci grids, Quarterly Journal of the Royal
    Meteorological Society 132, 2006.
    """
    steps = np.arange(count)
    z = (steps + 0.5) / count
    angle = steps * (np.pi * (3 - 5**0.5))
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(angle), across * np.sin(angle), z], axis=1)


def seen(points: Floats, triangles: Whole, places: Floats) -> NDArray[np.bool_]:
    """Return which places on a surface, N×3, are seen from outside.

    Gears in a housing, and the inner side of its wall, are not. A place is seen if in one of many
    parallel projections no point of the surface near it is nearer.
    """
    dense = spread_over(points, triangles, DENSE)[0]
    low, high = dense.min(axis=0), dense.max(axis=0)
    pixel = float(np.sqrt(((high - low) ** 2).sum())) / PIXELS
    found = np.zeros(len(places), bool)
    for way in directions(VIEWS):
        u = np.cross(way, np.eye(3)[int(np.abs(way).argmin())])
        u /= np.sqrt((u * u).sum())
        axes = np.stack([u, np.cross(way, u), way])
        surface, here = (
            np.round(((each - (low + high) / 2)[:, None] * axes).sum(axis=2) / pixel, 6)
            for each in (dense, places)
        )
        x, y = (np.floor(surface[:, :2]).astype(int) + PIXELS // 2 + 2).T
        i, j = np.clip(np.floor(here[:, :2]).astype(int) + PIXELS // 2 + 2, 1, PIXELS + 2).T
        for sign in (1.0, -1.0):
            picture = np.full((PIXELS + 4, PIXELS + 4), -np.inf)
            np.maximum.at(picture, (x, y), sign * surface[:, 2])
            around = np.maximum(np.maximum(picture[:-2], picture[1:-1]), picture[2:])
            around = np.maximum(np.maximum(around[:, :-2], around[:, 1:-1]), around[:, 2:])
            found |= sign * here[:, 2] >= around[i - 1, j - 1] - BEHIND
    return found


class Solid:
    """What a mesh encloses, also where it is not quite closed.

    Attributes:
        cell: the volume for which each of these places stands; 0 if there is none inside.
        size: the longest side of the box around it, in metres.
        points: points of the surface that spheres have to hold, N×3.
        inner: places inside, N×3, and their distances to the surface.
        depths: these distances.
        triangles: its surface seen from outside, M×3×3.
    """

    __slots__ = (
        "_clusters", "_is_inside", "_low", "_normals", "_openings", "_spacing", "_step", "_tree",
        "cell", "depths", "inner", "points", "size", "triangles",
    )  # fmt: skip

    def __init__(self, points: Floats, triangles: Whole) -> None:
        """Look at a surface: corners, N×3, and triangles, M×3."""
        samples, found_in = spread_over(points, triangles, SAMPLES)
        a, b, c = (points[triangles[found_in, corner]] for corner in range(3))
        normals = np.cross(b - a, c - a)
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
        area = float(areas_of(points, triangles).sum()) / SAMPLES
        used = points[np.unique(triangles)]
        low, high = used.min(axis=0), used.max(axis=0)
        self.size = float((high - low).max())
        self._step = step = self.size / CELLS
        self._low = low
        axes = [
            low[axis] + step * np.arange(int((high - low)[axis] / step) + 1) for axis in range(3)
        ]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        places = grid.reshape(-1, 3)
        turns = _turns(places, samples, normals, area)
        if turns.sum() < 0:  # inside out
            turns, normals = -turns, -normals
            triangles = triangles[:, ::-1]
        # Where bodies overlap, the surface of one is inside of the other and not the solid's.
        is_seen = _turns(samples, samples, normals, area) < HIDDEN
        if is_seen.any():
            samples, normals = samples[is_seen], normals[is_seen]
        self._normals = normals
        self._tree = cKDTree(samples)
        self._spacing = area**0.5
        self.points = np.concatenate([samples, used[:: len(used) // MOST_CORNERS + 1]])
        self.triangles: Floats = points[triangles]
        self._clusters: _Clusters | None = None
        self._is_inside = (np.round(turns, 6) > 0.5).reshape(grid.shape[:3])
        self._openings: cKDTree | None = None
        openings = self._openings_between(np.pad(self._is_inside, 1))
        if len(openings):
            self._openings = cKDTree(openings)
        depths = -self.distances(places)
        is_deep = depths > 0
        self.inner, self.depths = places[is_deep], depths[is_deep]
        self.cell = step**3
        if not len(self.inner):
            self.cell = 0.0
            self.inner, self.depths = samples, np.zeros(len(samples))

    def _openings_between(self, is_inside: NDArray[np.bool_]) -> Floats:
        """Return places where the inside ends without a surface, as at the end of an open tube."""
        found = []
        for axis in range(3):
            ends = np.argwhere(np.diff(is_inside, axis=axis)) - 1.0
            ends[:, axis] += 0.5
            found.append(self._low + self._step * ends)
        places = np.concatenate(found)
        far: Floats = places[self._tree.query(places)[0] > max(self._step, 2 * self._spacing)]
        return far

    def distances(self, places: Floats) -> Floats:
        """Return the signed distances of places, N×3, to the surface, negative inside.

        Where the mesh is open, the surface goes across the opening.
        """
        apart, nearest = self._tree.query(places, k=3)
        ahead = places[:, None] - self._tree.data[nearest]
        facing = np.einsum("ijk,ijk->ij", ahead, self._normals[nearest])
        outside = facing.sum(axis=1) > 0
        cells = np.round((places - self._low) / self._step).astype(int)
        limits: Whole = np.array(self._is_inside.shape) - 1
        i, j, k = np.clip(cells, 0, limits).T
        is_far = apart[:, 0] > max(self._step, 2 * self._spacing)
        is_around = ((cells < 0) | (cells > limits)).any(axis=1)
        outside = np.where(is_far, is_around | ~self._is_inside[i, j, k], outside)
        # A sample is up to its spacing aside of the nearest point: the height over it is nearer.
        height = np.minimum(np.abs(facing[:, 0]), apart[:, 0])
        near = np.where(apart[:, 0] < 2 * self._spacing, height, apart[:, 0])
        if self._openings is not None:
            near = np.minimum(near, self._openings.query(places)[0])
        found: Floats = np.where(outside, near, -near)
        return found

    def is_near(self, places: Floats) -> NDArray[np.bool_]:
        """Return whether places, N×3, are inside or about on the surface."""
        if not len(places):
            return np.zeros(0, bool)
        return self.distances(places) <= HAIR * self.size

    def holds(self, places: Floats) -> NDArray[np.bool_]:
        """Return whether places, N×3, are inside or on the surface; takes longer, but is exact.

        Of many triangles those far from a place count as clusters, each as one flat piece.

        Source: A. van Oosterom, J. Strackee, The solid angle of a plane triangle, 1983. The solid
        angles add up to 4π inside, and to 2π on a flat surface. Clusters: G. Barill et al., Fast
        winding numbers for soups and clouds, 2018.
        """
        turns = np.zeros(len(places))
        if self._clusters is None and len(places) and len(self.triangles) > CLUSTERED:
            self._clusters = _Clusters(self.triangles, self.size / CLUSTERS)
        for index, place in enumerate(places):
            near = self.triangles
            if self._clusters is not None:
                near, turns[index] = self._clusters.around(place)
            a, b, c = np.moveaxis(near - place, 1, 0)
            la, lb, lc = (np.sqrt((each * each).sum(axis=1)) for each in (a, b, c))
            over = (a * np.cross(b, c)).sum(axis=1)
            lengths = la * lb * lc
            over[abs(over) <= FLAT * lengths] = np.nan  # in its plane: no angle
            under = lengths.copy()
            for one, two, length in ((a, b, lc), (b, c, la), (c, a, lb)):
                under += (one * two).sum(axis=1) * length
            turns[index] += np.nansum(np.arctan2(over, under)) / (2 * np.pi)
        return turns > ON_SURFACE


class _Clusters:
    """Triangles, N×3×3, in the cells of a grid."""

    __slots__ = ("_ends", "_middles", "_normals", "_reach", "_triangles")

    def __init__(self, triangles: Floats, cell: float) -> None:
        middles = triangles.mean(axis=1)
        cells = np.floor((middles - middles.min(axis=0)) / cell).astype(np.int64)
        numbers = cells @ np.array((1, 4 * CLUSTERS, 16 * CLUSTERS**2))
        order = np.argsort(numbers, kind="stable")
        starts = np.flatnonzero(np.diff(numbers[order], prepend=-1))
        self._triangles = triangles[order]
        self._ends = np.append(starts, len(order))
        a, b, c = np.moveaxis(self._triangles, 1, 0)
        normals = np.cross(b - a, c - a) / 2
        areas = np.maximum(np.sqrt((normals * normals).sum(axis=1)), 1e-300)[:, None]
        self._normals = np.add.reduceat(normals, starts)
        sums = np.add.reduceat(areas * middles[order], starts)
        self._middles = sums / np.add.reduceat(areas, starts)
        own = np.repeat(self._middles, np.diff(self._ends), axis=0)[:, None]
        apart = np.sqrt(((self._triangles - own) ** 2).sum(axis=2)).max(axis=1)
        self._reach = np.maximum.reduceat(apart, starts)

    def around(self, place: Floats) -> tuple[Floats, float]:
        """Return the triangles near a place, and how often the others are around it."""
        ahead = self._middles - place
        apart = np.sqrt((ahead * ahead).sum(axis=1))
        is_near = apart < 3 * self._reach
        far = ~is_near
        turns = ((self._normals[far] * ahead[far]).sum(axis=1) / apart[far] ** 3).sum()
        chosen = [
            self._triangles[self._ends[index] : self._ends[index + 1]]
            for index in np.flatnonzero(is_near)
        ]
        near = np.concatenate(chosen) if chosen else self._triangles[:0]
        return near, float(turns) / (4 * np.pi)


def _turns(places: Floats, samples: Floats, normals: Floats, area: float) -> Floats:
    """Return how often a surface is around places, N×3, from its samples, of the same area each.

    The winding number: A. Jacobson et al., Robust inside-outside segmentation using generalized
    winding numbers, 2013, with a small disc in place of each sample.
    """
    middle = samples.mean(axis=0)
    local = samples - middle
    facing = (local * normals).sum(axis=1)
    found = np.empty(len(places))
    for start in range(0, len(places), 1024):
        some = places[start : start + 1024] - middle
        square = (some * some).sum(axis=1)[:, None] + (local * local).sum(axis=1)
        square -= 2 * (some @ local.T)
        np.maximum(square, 0.0, out=square)
        square += area / 8
        square *= np.sqrt(square)
        found[start : start + 1024] = ((facing - some @ normals.T) / square).sum(axis=1)
    turns: Floats = found * (area / (4 * np.pi))
    return turns
