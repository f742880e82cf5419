"""How good a shape is that was worked out from a mesh: distances and volumes.

The distance is that of Hausdorff between the surface of the mesh and that of all pieces together:
the greatest one from a point of either to the nearest point of the other. The points are spread
evenly over both surfaces, and the corners of the mesh are among them. What is in the mesh and not
seen from outside does not count: gears in a housing say nothing about its shape.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull, QhullError, cKDTree

from ..meshes.triangles import TriangleMesh, is_closed
from ..model.pose import rotation_from_rpy
from .primitives import Guess, distances
from .sampling import arrays_of, enclosed, seen, spread_over

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .fit import Placed
    from .sampling import Floats, Whole

SAMPLES = 4000
"""Points on the mesh."""
FEWER = 1500
"""Points on the pieces."""
NEAREST = 4
"""Triangles that are looked at around a point."""
MOST_CORNERS = 20_000
"""Corners of the mesh that are looked at."""
CELLS = 48
"""Points along the longest side of the box in which the volume of overlapping pieces is counted."""
CONVEX = 1e-4
"""How much less volume than its hull a convex mesh may have, as a part of it."""
DEEP = 0.02
"""How deep in the pieces, by the size, points of the mesh count only if seen from outside."""
MOST_PLANES = 5_000
"""Planes of a convex piece with which points are compared, about; of more, some."""
HAIR = 1e-6
"""How far outside of a piece points on its surface are looked at, as a part of its size."""
DIGITS = 6


def quality_of(
    mesh: TriangleMesh, pieces: Sequence[Placed | TriangleMesh]
) -> tuple[float, float | None]:
    """Return the greatest distance in metres, and the excess of volume as a part of the mesh's.

    There is no excess where the mesh is not closed.
    """
    points, triangles = arrays_of(mesh)
    own = Surface(points, triangles)
    pairs = [_Piece(piece) for piece in pieces]
    step = max(1, len(points) // MOST_CORNERS)
    looked_at = np.concatenate([own.samples, points[::step]])
    inner = np.full(len(looked_at), np.inf)
    for piece in pairs:
        inner = np.minimum(inner, piece.distances(looked_at))
    deep = np.flatnonzero(inner < -DEEP * float(np.ptp(points, axis=0).max()))
    if len(deep):
        inner[deep[~seen(points, triangles, looked_at[deep])]] = 0
    farthest = float(abs(inner).max())
    for index, piece in enumerate(pairs):
        outer = piece.samples(max(200, FEWER // len(pairs)))
        for number, other in enumerate(pairs):
            if number != index and len(outer):  # what is inside of another piece does not count
                outer = outer[other.distances(outer) > -1e-9]
        if len(outer):
            farthest = max(farthest, own.farthest(outer))
    inside = volume_of(mesh)
    if inside is None:
        return float(f"{farthest:.{DIGITS}g}"), None
    volume = pairs[0].volume() if len(pairs) == 1 else _volume_together(pairs)
    return float(f"{farthest:.{DIGITS}g}"), round(volume / inside - 1, DIGITS) + 0.0


def volume_of(mesh: TriangleMesh) -> float | None:
    """Return the volume in m³ that a mesh encloses; None for one that is not closed, or flat."""
    points, triangles = arrays_of(mesh)
    inside = enclosed(points, triangles)
    flat = 1e-9 * float(np.ptp(points, axis=0).max()) ** 3
    return None if inside <= flat or not is_closed(mesh) else inside


def _volume_together(pieces: Sequence[_Piece]) -> float:
    """Return the volume of pieces that may overlap, by points of a grid that are in any of them."""
    bounds = [piece.bounds() for piece in pieces]
    low = np.min([each[0] for each in bounds], axis=0)
    high = np.max([each[1] for each in bounds], axis=0)
    cell = float((high - low).max()) / CELLS
    axes = [np.arange(a + cell / 2, b, cell) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    is_in = np.zeros(len(grid), bool)
    for piece, (least, most) in zip(pieces, bounds, strict=True):
        near = ~is_in & (grid >= least).all(axis=1) & (grid <= most).all(axis=1)
        is_in[near] = piece.distances(grid[near]) <= 0
    return float(is_in.sum()) * cell**3


class Surface:
    """The surface of triangles.

    Attributes:
        samples: points spread over it.
        normals: those of the triangles that these are in, N×3; zeros where a triangle has none.
    """

    __slots__ = (
        "_by_reach", "_found_in", "_points", "_tree", "_triangles", "normals", "samples",
    )  # fmt: skip

    def __init__(self, points: Floats, triangles: Whole) -> None:
        self._points = points
        self._triangles = triangles
        samples, found_in = spread_over(points, triangles, SAMPLES)
        middles = points[triangles].mean(axis=1)
        self.samples = samples
        a, b, c = np.moveaxis(points[triangles[found_in]], 1, 0)
        normals = np.cross(b - a, c - a)
        lengths = np.linalg.norm(normals, axis=1)
        self.normals = normals / np.where(lengths > 0, lengths, 1.0)[:, None]
        self._found_in = np.concatenate([found_in, np.arange(len(middles))])
        self._tree = cKDTree(np.concatenate([samples, middles]))
        reach = np.sqrt(((points[triangles] - middles[:, None]) ** 2).sum(axis=2)).max(axis=1)
        octaves = np.ceil(np.log2(np.maximum(reach, 1e-300)))
        self._by_reach: list[tuple[Whole, cKDTree, float]] = []
        for octave in np.unique(octaves):
            some = np.flatnonzero(octaves == octave)
            self._by_reach.append((some, cKDTree(middles[some]), float(reach[some].max())))

    def apart_from(self, other: Surface, enough: float) -> float:
        """Return the greatest distance from a point of either surface to the other, in metres.

        Below `enough` it is an upper bound.
        """
        return max(
            self.farthest(other.looked_at(), enough), other.farthest(self.looked_at(), enough)
        )

    def looked_at(self) -> Floats:
        """Return points spread over the surface, corners, and the middles of edges."""
        step = max(1, len(self._points) // MOST_CORNERS)
        sides = np.sort(self._triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        sides = sides[:: max(1, len(sides) // MOST_CORNERS)]
        middles = self._points[sides].mean(axis=1)
        return np.concatenate([self.samples, self._points[::step], middles])

    def distances(self, points: Floats) -> Floats:
        """Return the distances of points to the triangles."""
        found: list[Floats] = [np.zeros(0)]
        for start in range(0, len(points), 256):
            some = points[start : start + 256]
            found.append(self._measured(some, self._at_most(some)))
        return np.concatenate(found)

    def farthest(self, points: Floats, enough: float = 0.0) -> float:
        """Return the greatest distance of points to the triangles; below `enough` an upper bound.

        Only points are measured that may be farther away than those which were.
        """
        most = np.concatenate(
            [self._at_most(points[start : start + 1024]) for start in range(0, len(points), 1024)]
        )
        order, found = np.argsort(-most, kind="stable"), 0.0
        for start in range(0, len(points), 64):
            some = order[start : start + 64]
            if most[some[0]] <= max(found, enough):
                return max(found, float(most[some[0]]))
            found = max(found, float(self._measured(points[some], most[some]).max()))
        return found

    def _at_most(self, points: Floats) -> Floats:
        """Return the distances of points to the triangles that the nearest samples are in."""
        count = min(NEAREST, len(self._found_in))
        nearest = self._tree.query(points, k=[*range(1, count + 1)])[1]
        corners = self._points[self._triangles[self._found_in[nearest]]]
        found: Floats = _to_triangles(points[:, None, :], corners).min(axis=1)
        return found

    def _measured(self, points: Floats, most: Floats) -> Floats:
        """Return the distances of points to the triangles, which are at most these."""
        least = most.copy()
        for chosen, tree, reach in self._by_reach:
            lists = tree.query_ball_point(points, least + reach)
            which = np.repeat(np.arange(len(points)), [*map(len, lists)])
            if len(which):
                near = chosen[np.concatenate(lists).astype(int)]
                corners = self._points[self._triangles[near]]
                np.minimum.at(least, which, _to_triangles(points[which], corners))
        return least


def _to_triangles(points: Floats, corners: Floats) -> Floats:
    """Return the distances of points, …×3, to triangles, …×3×3.

    Source: C. Ericson, Real-Time Collision Detection, 5.1.5: the nearest point is in the triangle,
    or on one of its edges.
    """
    a, b, c = corners[..., 0, :], corners[..., 1, :], corners[..., 2, :]
    normal = np.cross(b - a, c - a)
    length = np.sqrt((normal * normal).sum(axis=-1))
    safe = np.where(length > 0, length, 1.0)
    height = ((points - a) * normal).sum(axis=-1) / safe
    is_over = length > 0
    nearest = np.full(height.shape, np.inf)
    for one, two in ((a, b), (b, c), (c, a)):
        side = two - one
        inward = (np.cross(normal, side) * (points - one)).sum(axis=-1)
        is_over &= inward >= 0
        square = (side * side).sum(axis=-1)
        along = ((points - one) * side).sum(axis=-1) / np.where(square > 0, square, 1.0)
        off = points - one - np.clip(along, 0, 1)[..., None] * side
        nearest = np.minimum(nearest, np.sqrt((off * off).sum(axis=-1)))
    return np.where(is_over, abs(height), nearest)


class _Piece:
    """A piece as a surface with an inside; a mesh has one if it is convex."""

    __slots__ = ("_guess", "_inside", "_piece", "_surface")

    def __init__(self, piece: Placed | TriangleMesh) -> None:
        self._piece = piece
        self._surface: Surface | None = None
        self._inside: tuple[Floats, Floats] | None = None
        if isinstance(piece, TriangleMesh):
            points, triangles = arrays_of(piece)
            self._surface = Surface(points, triangles)
            self._inside = _planes(points, enclosed(points, triangles))
            return
        sizes = np.array(piece.shape.size)
        halves = sizes / 2 if piece.shape.kind == "box" else sizes / [1, 2][: len(sizes)]
        rotation = np.array(rotation_from_rpy(*piece.rpy))
        self._guess = Guess(np.array(piece.xyz), rotation, halves)

    def distances(self, points: Floats) -> Floats:
        """Return the signed distances of points to the surface, negative inside of it."""
        if not isinstance(self._piece, TriangleMesh):
            return distances(self._piece.shape.kind, self._guess, points)
        assert self._surface is not None
        if self._inside is None:
            return self._surface.distances(points)
        normals, heights = self._inside
        depth = np.empty(len(points))
        every = -(-len(normals) // MOST_PLANES)
        normals, heights = normals[::every], heights[::every]
        for start in range(0, len(points), 1024):
            some = points[start : start + 1024]
            depth[start : start + 1024] = (some @ normals.T - heights).max(axis=1)
        is_measured = (depth > 0) | (every > 1)
        if is_measured.any():
            apart = self._surface.distances(points[is_measured])
            depth[is_measured] = np.where(depth[is_measured] > 0, apart, -apart)
        return depth

    def samples(self, count: int) -> Floats:
        """Return points spread over the surface, of a convex mesh a hair outside of it.

        So those on a face that two pieces share are inside of the other one.
        """
        if self._surface is not None:
            step = max(1, SAMPLES // count)
            points = self._surface.samples[::step]
            if self._inside is None:
                return points
            hair = HAIR * float(np.ptp(points, axis=0).max())
            outside: Floats = points + hair * self._surface.normals[::step]
            return outside
        assert not isinstance(self._piece, TriangleMesh)
        local = _spread_over_shape(self._piece.shape.kind, self._guess.halves, count)
        found: Floats = local @ self._guess.rotation.T + self._guess.center
        return found

    def volume(self) -> float:
        """Return the volume in m³."""
        if isinstance(self._piece, TriangleMesh):
            return enclosed(*arrays_of(self._piece))
        return self._piece.shape.volume()

    def bounds(self) -> tuple[Floats, Floats]:
        """Return two corners of a box around it."""
        if isinstance(self._piece, TriangleMesh):
            points = np.array(self._piece.vertices)
            return points.min(axis=0), points.max(axis=0)
        around = self._piece.shape.radius_around()
        return self._guess.center - around, self._guess.center + around


def _planes(points: Floats, volume: float) -> tuple[Floats, Floats] | None:
    """Return normals and heights of the planes of a convex mesh; None for another one.

    They are those of its hull, since the small triangles of a mesh have no exact normals.
    """
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):  # flat
        return None
    if abs(hull.volume - volume) > CONVEX * hull.volume:
        return None
    planes = np.unique(hull.equations, axis=0)
    return planes[:, :3], -planes[:, 3]


def _spread_over_shape(kind: str, halves: Floats, count: int) -> Floats:
    """Return points spread over the surface of a shape at the origin."""
    if kind == "box":
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * halves
        sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        triangles = np.array([each for a, b, c, d in sides for each in ((a, b, c), (a, c, d))])
        return np.concatenate([corners, spread_over(corners, triangles, count)[0]])
    steps = np.arange(count) + 0.5
    turn = np.arange(count) * (pi * (3 - 5**0.5))
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    radius = float(halves[0])
    if kind == "cylinder":
        half = float(halves[1])
        side = np.column_stack([circle * radius, (steps / count * 2 - 1) * half])
        disc = circle * (radius * np.sqrt(steps / (count - 0.5)))[:, None]
        ends = [np.column_stack([disc, np.full(count, end)]) for end in (half, -half)]
        return np.concatenate([side, *ends])
    z = 1 - 2 * steps / count
    ball = np.column_stack([circle * np.sqrt(1 - z * z)[:, None], z]) * radius
    if kind == "sphere":
        return ball
    half = float(halves[1])
    ball[:, 2] += np.where(z >= 0, half, -half)
    side = np.column_stack([circle * radius, (steps / count * 2 - 1) * half])
    return np.concatenate([ball, side])
