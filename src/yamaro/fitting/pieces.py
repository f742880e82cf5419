"""Convex pieces of meshes: the convex hull, and a decomposition into several hulls.

Planes cut the mesh, and a piece is the hull of what is on one side of each of some planes: of the
surface there, and of the points in the solid where three planes meet. The farthest points of the
solid between planes are among these. So pieces contain the surface by construction, also where it
is open or not a manifold, and the solid. Where no plane saves much, as in a tube, the next ones are
looked at as well. More pieces are cut than asked for, and those merged whose common hull is the
least larger. Source of that: K. Mamou, F. Ghorbel, A simple and efficient approach for 3D mesh
approximate convex decomposition, ICIP 2009.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError, cKDTree

from ..meshes.formats import MeshFileError
from ..meshes.triangles import TriangleMesh, is_closed
from .sampling import Solid, arrays_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .sampling import Floats, Whole

MOST_CORNERS = 64
"""Corners of a piece: more than that PhysX does not take on a GPU."""
FEW = 2_000
"""Triangles that are all used to choose planes."""
CELLS = 40
"""Cells along the longest side of a mesh, of whose corners one is used to choose planes."""
CUTS = 9
"""Planes that are tried along each direction, and again around the best one."""
SPARE = 1.5
"""How many times as many pieces are cut as asked for, before they are merged."""
BALANCE = 0.03
"""How much planes count that cut a piece in parts of equal size, as against those that save."""
LITTLE = 0.03
"""Part of a piece that a cut has to save; else the next cuts are looked at as well."""
WORTH = 0.004
"""Part of the hull's volume that one more piece has to save."""
PARALLEL = 1e-6
"""The volume that three unit normals span, below which their planes do not meet in one point."""
NEAR = 1e-6
"""Corners that are as near as this, by the size of their piece, are one."""
LOW = (1e-5, 1e-4, 5e-4, 2e-3)
"""Corners that are not higher above the hull of the others go: the first that is enough."""
DENT = 4e-6
"""How far a corner may be above the next triangle in single precision, by the size of a piece."""
NO_POINTS, NO_PLANES = np.empty((0, 3)), np.empty((0, 4))
NO_TRIANGLES = np.empty((0, 3, 3))
DIGITS = 9
"""Digits by which volumes are compared, so that equal ones are equal on all machines."""
Split = tuple[float, "Floats", float]
"""How good a plane is to cut a piece with, its normal, and its place along that."""


class Piece:
    """The part of a solid between planes, and the hull around it.

    Attributes:
        triangles: the surface there, N×3×3, in metres.
        coarse: the same with few triangles, by which planes are chosen.
        solid: what is cut, the same for all pieces.
        planes: those around it, each as its normal, which points outward, and its place along
            that, N×4.
        deep: where three of these planes meet in the solid, N×3.
        inner: places of a grid that are in the solid and in this part, N×3.
        corners: those of the hull of `coarse` and `deep`, N×3.
        volume: of that hull.
        split: how good the best plane is, its normal and its place along that; None before it was
            looked for.
    """

    __slots__ = (
        "coarse", "corners", "deep", "inner", "planes", "solid", "split", "triangles", "volume",
    )  # fmt: skip

    def __init__(
        self,
        triangles: Floats,
        coarse: Floats,
        solid: Solid,
        inner: Floats,
        planes: Floats = NO_PLANES,
        deep: Floats = NO_POINTS,
    ) -> None:
        self.triangles = triangles
        self.coarse = coarse
        self.solid = solid
        self.inner = inner
        self.planes = planes
        self.deep = deep
        self.corners, self.volume = _hull(np.concatenate([coarse.reshape(-1, 3), deep]))
        self.split: Split | None = None

    def points(self) -> tuple[Floats, Floats]:
        """Return the corners of the surface in the piece, and the other points it has to hold."""
        return self.triangles.reshape(-1, 3), self.deep

    def parts(self) -> list[Piece]:
        """Return the two parts that the best plane makes."""
        assert self.split is not None
        _, normal, place = self.split
        (met,) = self.met(normal, [place])
        return self._cut(normal, place, self.triangles, met[self.solid.holds(met)])

    def ahead(self, split: Split) -> float:
        """Return the volume that a plane saves, with the next one in each of its parts."""
        gain, normal, place = split
        (met,) = self.met(normal, [place])
        saved = gain * self.volume
        for part in self._cut(normal, place, NO_TRIANGLES, met[self.solid.is_near(met)]):
            if part.volume > 0:
                saved += part.volume * max(each[0] for each in _scans(part))
        return saved

    def _cut(self, normal: Floats, place: float, triangles: Floats, met: Floats) -> list[Piece]:
        fine = cut(triangles, normal, place)
        coarse = cut(self.coarse, normal, place)
        found = []
        for number, sign in enumerate((1.0, -1.0)):
            plane = sign * np.append(normal, place)
            deep = self.deep[sign * (self.deep @ normal - place) <= 0]
            inner = self.inner[sign * (self.inner @ normal - place) <= 0]
            planes = np.vstack([self.planes, plane])
            deep = np.concatenate([deep, met])
            found.append(Piece(fine[number], coarse[number], self.solid, inner, planes, deep))
        return found

    def met(self, normal: Floats, places: Sequence[float] | Floats) -> list[Floats]:
        """Return the points where each of parallel planes meets two of those around the piece."""
        found: list[Floats] = [NO_POINTS] * len(places)
        for first, second in combinations(self.planes, 2):
            line = np.cross(first[:3], second[:3])
            slope = float(line @ normal)
            if abs(slope) < PARALLEL:
                continue
            across, along = np.cross(second[:3], normal), np.cross(normal, first[:3])
            middle = first[3] * across + second[3] * along
            points = (middle + np.outer(places, line)) / slope
            above = points @ self.planes[:, :3].T - self.planes[:, 3]
            is_met = (above <= 1e-9 * self.solid.size).all(axis=1)
            for index in np.flatnonzero(is_met):
                found[index] = np.vstack([found[index], points[index]])
        return found


def hull_of(mesh: TriangleMesh) -> TriangleMesh:
    """Return the convex hull of a mesh, closed, seen from outside.

    Raises:
        MeshFileError: the mesh has no triangles, or is flat.
    """
    points, _ = arrays_of(mesh)
    return _hull_mesh(points)


def decompose(mesh: TriangleMesh, count: int) -> list[TriangleMesh]:
    """Return at most `count` convex pieces that contain the surface, the greatest piece first.

    It is one piece where no more are worth it.

    Raises:
        MeshFileError: the mesh has no triangles, or is flat.
    """
    points, indices = arrays_of(mesh)
    triangles = points[indices]
    solid = Solid(points, indices)
    whole = Piece(triangles, _coarse(points, indices), solid, solid.inner)
    if not whole.volume > 0:
        raise MeshFileError("it is flat, so that no convex piece has a volume")
    least = WORTH * whole.volume
    if whole.volume - _volume(triangles) < least and is_closed(mesh):
        count = 1
    pieces = [whole]
    while count > 1 and len(pieces) < SPARE * count:
        # By what is empty in them: of a ring the first plane saves nothing.
        empty = [round((e.volume - len(e.inner) * solid.cell) / least, DIGITS) for e in pieces]
        index = max(range(len(pieces)), key=lambda i: empty[i])
        if empty[index] < 1 / SPARE or not _find_cut(pieces[index]):
            break
        pieces[index : index + 1] = pieces[index].parts()
    found = [
        _hull(np.vstack([points for each in group for points in each.points()]))
        for group in _merged(pieces, count, least)
    ]
    found.sort(key=lambda each: -each[1])
    return [_hull_mesh(simplified(corners)) for corners, _ in found]


def _volume(triangles: Floats) -> float:
    """Return what a closed surface encloses, N×3×3, summed over tetrahedra."""
    a, b, c = np.moveaxis(triangles - triangles.mean(axis=(0, 1)), 1, 0)
    return abs(float((a * np.cross(b, c)).sum())) / 6


def _coarse(points: Floats, indices: Whole) -> Floats:
    """Return triangles of a mesh whose corners are one if they are in the same cell of a grid."""
    if len(indices) <= FEW:
        return points[indices]
    cells = np.floor((points - points.min(axis=0)) * (CELLS / np.ptp(points, axis=0).max()))
    numbers = (cells @ (1, 2 * CELLS, 4 * CELLS * CELLS)).astype(np.int64)
    _, first, cell = np.unique(numbers, return_index=True, return_inverse=True)
    corners = np.sort(cell[indices], axis=1)
    corners = np.unique(corners[(np.diff(corners, axis=1) > 0).all(axis=1)], axis=0)
    return points[first[corners]] if len(corners) else points[indices]


def _hull(points: Floats) -> tuple[Floats, float]:
    """Return the corners of the hull of points, and its volume; all points if they are flat."""
    if len(points) < 4:
        return points, 0.0
    try:
        found = ConvexHull(points)
    except (QhullError, ValueError):
        return np.unique(points, axis=0), 0.0
    return points[found.vertices], float(found.volume)


# --- planes -----------------------------------------------------------------------------------


def cut(triangles: Floats, normal: Floats, place: float) -> tuple[Floats, Floats]:
    """Return the triangles below and above the plane n·x = place, those on it cut in two."""
    heights = triangles @ normal - place
    is_below = (heights <= 0).all(axis=1)
    is_above = (heights >= 0).all(axis=1) & ~is_below
    crossing = triangles[~is_below & ~is_above]
    across = heights[~is_below & ~is_above]
    below, above = [triangles[is_below]], [triangles[is_above]]
    if len(crossing):
        # Turned so that the first corner is alone on its side.
        side = across > 0
        alone = np.where(side.sum(axis=1) == 1, side.argmax(axis=1), (~side).argmax(axis=1))
        order = (alone[:, None] + np.arange(3)) % 3
        rows = np.arange(len(crossing))[:, None]
        a, b, c = np.moveaxis(crossing[rows, order], 1, 0)
        ha, hb, hc = across[rows, order].T
        ab = a + (b - a) * (ha / (ha - hb))[:, None]
        ac = a + (c - a) * (ha / (ha - hc))[:, None]
        tip = np.stack([a, ab, ac], axis=1)
        rest = np.concatenate([np.stack([ab, b, c], axis=1), np.stack([ab, c, ac], axis=1)])
        top, twice = ha > 0, np.tile(ha > 0, 2)
        below += [tip[~top], rest[twice]]
        above += [tip[top], rest[~twice]]
    return np.concatenate(below), np.concatenate(above)


def _find_cut(piece: Piece) -> bool:
    """Find the best plane to cut a piece with; return whether there is one."""
    tried = _scans(piece)
    best = max(tried, key=lambda found: found[0])
    if 0 < best[0] < LITTLE:
        some = [found for found in tried if found[0] > 0]
        best = max(some, key=lambda found: round(piece.ahead(found) / piece.volume, DIGITS))
    gain, normal, place = best
    if gain > 0:
        heights = piece.coarse @ normal
        step = float(np.ptp(heights)) / (CUTS + 1)
        fine = _scan(piece, normal, heights, place - step, place + step)
        best = max(best, fine, key=lambda found: found[0])
    piece.split = best
    return gain > 0


def _scans(piece: Piece) -> list[Split]:
    """Return the best plane along each direction that is tried."""
    found = []
    for normal in _directions(piece):
        heights = piece.coarse @ normal
        found.append(_scan(piece, normal, heights, float(heights.min()), float(heights.max())))
    return found


def _directions(piece: Piece) -> list[Floats]:
    """Return the normals of planes that are tried: the axes, and the main axes of the surface."""
    found: list[Floats] = list(np.eye(3))
    a, b, c = np.moveaxis(piece.coarse, 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    if areas.sum() > 0:
        middles = (a + b + c) / 3
        offsets = middles - np.average(middles, axis=0, weights=areas)
        _, axes = np.linalg.eigh((offsets * areas[:, None]).T @ offsets)
        for axis in axes.T:
            turned = axis * (1.0 if axis[np.abs(axis).argmax()] > 0 else -1.0)
            turned = np.round(turned, 6)  # the rest is rounding, and differs between machines
            if np.abs(turned).max() < 0.999:
                found.append(turned / np.linalg.norm(turned))
    return found


def _scan(piece: Piece, normal: Floats, heights: Floats, low: float, high: float) -> Split:
    """Return how good the best of some planes between two places is, its normal and its place.

    That is the part of the volume that it saves, and a little for parts of equal size.
    """
    places = np.linspace(low, high, CUTS + 2)[1:-1]
    parts = []
    rest, rest_heights = piece.coarse, heights
    met = [points[piece.solid.is_near(points)] for points in piece.met(normal, places)]
    deep = np.searchsorted(places, piece.deep @ normal)
    more = [
        np.concatenate([piece.deep[deep == index], *met[max(index - 1, 0) : index + 1]])
        for index in range(CUTS + 1)
    ]
    for index, place in enumerate(places):  # slabs from below, each as the corners of its hull
        touched = rest_heights.min(axis=1) < place
        slab, above = cut(rest[touched], normal, place)
        rest = np.concatenate([rest[~touched], above])
        rest_heights = rest @ normal
        parts.append(_hull(np.concatenate([slab.reshape(-1, 3), more[index]]))[0])
    parts.append(_hull(np.concatenate([rest.reshape(-1, 3), more[-1]]))[0])
    below, above = np.array(_growing(parts[:-1])), np.array(_growing(parts[:0:-1])[::-1])
    worth = 1 - (below + above - BALANCE * np.minimum(below, above)) / piece.volume
    index = int(np.round(worth, DIGITS).argmax())
    return round(float(worth[index]), DIGITS), normal, float(places[index])


def _growing(parts: Sequence[Floats]) -> list[float]:
    """Return the volumes of the hulls of the first part, of the first two, and so on."""
    volumes = []
    corners: Floats = np.empty((0, 3))
    for part in parts:
        corners, volume = _hull(np.concatenate([corners, part]))
        volumes.append(volume)
    return volumes


# --- merging ----------------------------------------------------------------------------------


def _merged(pieces: list[Piece], count: int, least: float) -> list[list[Piece]]:
    """Return pieces in at most `count` groups, each of which becomes one piece.

    The two are merged first whose common hull adds least volume, and further while that adds less
    than `least`.
    """
    hulls = {index: (each.corners, each.volume) for index, each in enumerate(pieces)}
    groups = {index: [each] for index, each in enumerate(pieces)}
    common: dict[tuple[int, int], tuple[Floats, float]] = {}
    while len(groups) > 1:
        for one, other in combinations(groups, 2):
            if (one, other) not in common:
                corners = np.concatenate([hulls[one][0], hulls[other][0]])
                common[one, other] = _hull(corners)
        added = {
            pair: round((volume - hulls[pair[0]][1] - hulls[pair[1]][1]) / least, DIGITS)
            for pair, (_, volume) in common.items()
        }
        pair = min(added, key=lambda each: (added[each], each))
        is_flat = not min(hulls[each][1] for each in pair) > 0
        if len(groups) <= count and added[pair] >= 1 and not is_flat:
            flat = [each for each in groups if not hulls[each][1] > 0]
            if not flat:
                break
            pair = min((each for each in added if flat[0] in each), key=lambda p: (added[p], p))
        number = max(groups) + 1
        hulls[number] = common[pair]
        groups[number] = groups.pop(pair[0]) + groups.pop(pair[1])
        common = {key: each for key, each in common.items() if not set(key) & set(pair)}
    return list(groups.values())


# --- fewer corners ----------------------------------------------------------------------------


def simplified(corners: Floats, most: int = MOST_CORNERS) -> Floats:
    """Return corners, at most `most`, of a polyhedron that contains a convex one.

    It is cut out of a box by planes of faces, each the one that is farthest below the corner that
    is farthest outside. So large faces stay where they are.
    """
    size = float(np.ptp(corners, axis=0).max())
    found = corners
    try:
        if len(corners) > most:
            found = _cut_out(corners, most, size)
        for low in LOW:
            found = _clean(corners, found, size, low)
            if _dent(_hull_mesh(found)) < DENT * size:
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


def _hull_mesh(points: Floats) -> TriangleMesh:
    """Return the hull of points as a mesh, its triangles counterclockwise as seen from outside."""
    try:
        found = ConvexHull(points)
    except (QhullError, ValueError):
        raise MeshFileError("it is flat, so that its convex hull has no volume") from None
    numbers = {int(old): new for new, old in enumerate(sorted(found.vertices))}
    corners = points[sorted(found.vertices)]
    triangles = []
    for corner, equation in zip(found.simplices, found.equations, strict=True):
        a, b, c = (int(each) for each in corner)
        if np.dot(np.cross(points[b] - points[a], points[c] - points[a]), equation[:3]) < 0:
            b, c = c, b
        triangles.append((numbers[a], numbers[b], numbers[c]))
    return TriangleMesh([(x, y, z) for x, y, z in corners.tolist()], sorted(triangles))
