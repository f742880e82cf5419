"""Convex pieces of meshes.

Planes cut the mesh into parts, and a piece is the hull of some of these: of the surface in them,
and of the points in the solid where three of their planes meet. The farthest points of the solid
between planes are among these. So pieces contain the surface by construction, also where it is open
or not a manifold, and the solid. Where no plane saves much, as in a tube, the next ones are looked
at as well. More pieces are cut than asked for, and those merged whose common hull is the least
larger; then pieces are cut and merged again as long as that makes them smaller. Source of merging:
K. Mamou, F. Ghorbel, A simple and efficient approach for 3D mesh approximate convex decomposition,
ICIP 2009.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ..meshes.formats import MeshFileError, MissingLibraryError
from ..meshes.triangles import TriangleMesh, is_closed
from .corners import simplified
from .hull import hull_mesh
from .sampling import Solid, areas_of, arrays_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from .sampling import Floats, Whole

FEW, MANY = 2_000, 20_000
"""Triangles by which planes are chosen, and by which the pieces between them are measured."""
VERY_MANY, CELLS = 100_000, 256
"""Triangles from which on corners are one that are in the same cell of a grid, and its cells along
the longest side."""
HASTES = (1, 2, 3, 4, 5, 7)
"""How hastily fast-simplification collapses edges: the lower, the nearer, and the fewer of them."""
CUTS = 15
"""Planes that are tried along each direction, and again around the best one."""
FINER = 2
"""How often planes are tried around the best one, nearer each time."""
KINDS = 3
"""Directions of which the best plane is tried for a piece that is cut again."""
SPARE = 1.5
"""How many times as many pieces are cut as asked for, before they are merged."""
AGAIN = 8
"""Pieces that are cut again, those with the most empty space."""
STEPS = 10
"""How often pieces are cut and merged again at most."""
BALANCE = 0.03
"""How much planes count that cut a piece in parts of equal size, as against those that save."""
LITTLE = 0.03
"""Part of a piece that a cut has to save; else the next cuts are looked at as well."""
AHEAD = 0.02
"""Part of the whole hull that is empty in a piece for which the next cuts are looked at."""
DEEP = 0.003
"""How deep the surface of a piece has to be in its hull, by the size of the whole, to be cut."""
WORTH = 0.004
"""Part of the whole hull that one more piece has to save."""
BETTER = 1e-4
"""Part of the whole hull that cutting and merging again has to save."""
PARALLEL = 1e-6
"""The volume that three unit normals span, below which their planes do not meet in one point."""
SAME = 0.9999
"""The cosine of the angle between directions from which on only one of them is tried."""
ALIKE = 0.01
"""How far unit normals of one flat side are apart."""
NO_POINTS, NO_PLANES = np.empty((0, 3)), np.empty((0, 4))
DIGITS = 9
"""Digits by which volumes are compared, so that equal ones are equal on all machines."""
Split = tuple[float, "Floats", float]
"""How good a plane is to cut a piece with, its normal, and its place along that."""


def decompose(mesh: TriangleMesh, count: int) -> list[TriangleMesh]:
    """Return at most `count` convex pieces that contain the surface, the greatest piece first.

    It is one piece where no more are worth it.

    Raises:
        MeshFileError: the mesh has no triangles, or is flat.
        MissingLibraryError: fast-simplification is not installed, and there are many triangles.
    """
    points, indices = arrays_of(mesh)
    triangles = points[indices]
    search = _Search(points, indices)
    whole = search.whole
    if not whole.volume > 0:
        raise MeshFileError("it is flat, so that no convex piece has a volume")
    pieces = [whole]
    excess = whole.volume - _volume(triangles)
    if count > 1 and not (excess < WORTH * whole.volume and is_closed(mesh)):
        pieces = search.improved(search.merged(search.split(pieces, SPARE * count), count), count)
    found = [
        _hull(np.vstack([points for part in piece.parts for points in part.points(triangles)]))
        for piece in pieces
    ]
    found.sort(key=lambda each: -each[1])
    return [hull_mesh(simplified(corners)) for corners, _ in found]


def _volume(triangles: Floats) -> float:
    """Return what a closed surface encloses, N×3×3, summed over tetrahedra."""
    a, b, c = np.moveaxis(triangles - triangles.mean(axis=(0, 1)), 1, 0)
    return abs(float((a * np.cross(b, c)).sum())) / 6


def _hull(points: Floats) -> tuple[Floats, float]:
    """Return the corners of the hull of points, and its volume; all points if they are flat."""
    if len(points) < 4:
        return points, 0.0
    try:
        found = ConvexHull(points)
    except (QhullError, ValueError):
        return np.unique(points, axis=0), 0.0
    return points[found.vertices], float(found.volume)


# --- parts and pieces -------------------------------------------------------------------------


class Part:
    """What is between planes.

    Attributes:
        coarse: the surface there with few triangles, by which planes are chosen, N×3×3, in metres.
        fine: the same with more triangles.
        inner: places of a grid that are in the solid and in this part, N×3.
        planes: those around it, each as its normal, which points outward, and its place along
            that, N×4.
        deep: where three of these planes meet in the solid, N×3.
    """

    __slots__ = ("coarse", "deep", "fine", "inner", "planes")

    def __init__(
        self,
        coarse: Floats,
        fine: Floats,
        inner: Floats,
        planes: Floats = NO_PLANES,
        deep: Floats = NO_POINTS,
    ) -> None:
        self.coarse = coarse
        self.fine = fine
        self.inner = inner
        self.planes = planes
        self.deep = deep

    def points(self, triangles: Floats) -> tuple[Floats, Floats]:
        """Return the corners of a surface in the part, and the other points it has to hold."""
        for plane in self.planes:
            triangles, _ = cut(triangles, plane[:3], plane[3])
        return triangles.reshape(-1, 3), self.deep

    def halves(self, normal: Floats, place: float, solid: Solid) -> tuple[Part | None, Part | None]:
        """Return what is below a plane and above it: the whole part where the other is empty."""
        (met,) = self.met(normal, [place], solid.size)
        met = met[solid.holds(met)]
        found = []
        coarse, fine = cut(self.coarse, normal, place), cut(self.fine, normal, place)
        for side, sign in enumerate((1.0, -1.0)):
            deep = self.deep[sign * (self.deep @ normal - place) <= 0]
            inner = self.inner[sign * (self.inner @ normal - place) <= 0]
            planes = np.vstack([self.planes, sign * np.append(normal, place)])
            deep = np.concatenate([deep, met])
            found.append(Part(coarse[side], fine[side], inner, planes, deep))
        below, above = found
        if not len(above.fine):
            return self, None
        return (below, above) if len(below.fine) else (None, self)

    def met(self, normal: Floats, places: Sequence[float] | Floats, size: float) -> list[Floats]:
        """Return the points where each of parallel planes meets two of those around the part."""
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
            is_met = (above <= 1e-9 * size).all(axis=1)
            for index in np.flatnonzero(is_met):
                found[index] = np.vstack([found[index], points[index]])
        return found


class Piece:
    """Parts of a solid, and the hull around them.

    Attributes:
        number: which piece it is of all that were looked at.
        parts: what is in it.
        corners: those of the hull of their surfaces and deep points.
        volume: of that hull.
        empty: the volume of that hull outside of the solid, about.
        splits: planes to cut it with, the best first; None before they were looked for.
        halves: what these make of it, by their place in `splits`.
    """

    __slots__ = ("corners", "empty", "halves", "number", "parts", "splits", "volume")

    def __init__(
        self, number: int, parts: list[Part], cell: float, hull: tuple[Floats, float] | None
    ) -> None:
        """Collect parts; the hull around them is worked out if it is not known."""
        self.number = number
        self.parts = parts
        self.corners, self.volume = hull or _hull(
            np.vstack([each.fine.reshape(-1, 3) for each in parts] + [each.deep for each in parts])
        )
        self.empty = self.volume - cell * sum(len(each.inner) for each in parts)
        self.splits: list[Split] | None = None
        self.halves: dict[int, list[Piece]] = {}


class _Search:
    """Pieces of a solid, cut and merged until they are small.

    Attributes:
        whole: the piece that is all of it.
    """

    def __init__(self, points: Floats, indices: Whole) -> None:
        self._solid = Solid(points, indices)
        self._frame = _frame(points, indices)
        self._count = 0
        self._common: dict[tuple[int, int], tuple[float, tuple[Floats, float]]] = {}
        self._merged: dict[tuple[int, int], Piece] = {}
        fine = _lighter(points, indices, MANY)
        coarse = _lighter(*fine, FEW)
        part = Part(coarse[0][coarse[1]], fine[0][fine[1]], self._solid.inner)
        self.whole = self._piece([part])
        self._least = WORTH * self.whole.volume

    def _piece(self, parts: list[Part], hull: tuple[Floats, float] | None = None) -> Piece:
        self._count += 1
        return Piece(self._count, parts, self._solid.cell, hull)

    def split(self, pieces: list[Piece], most: float) -> list[Piece]:
        """Return `most` pieces or more in place of fewer, as far as cutting saves anything."""
        found = list(pieces)
        while len(found) < most:
            # By what is empty in them: of a ring the first plane saves nothing.
            for piece in self._emptiest(found):
                if self._splits(piece):
                    break
            else:
                break
            index = found.index(piece)
            found[index : index + 1] = self._halves(piece, 0)
        return found

    def _emptiest(self, pieces: list[Piece]) -> list[Piece]:
        """Return the pieces that are worth to be cut, that with the most empty space first."""
        empty = [(-round(each.empty / self._least, DIGITS), each) for each in pieces]
        empty.sort(key=lambda each: each[0])
        return [each for worth, each in empty if -worth >= 1 / SPARE]

    def merged(self, pieces: list[Piece], count: int) -> list[Piece]:
        """Return at most `count` pieces, those merged first whose common hull adds least volume.

        Others are merged while that adds less than a piece has to save.
        """
        found = {each.number: each for each in pieces}
        while len(found) > 1:
            added = {pair: self._added(*pair) for pair in combinations(found.values(), 2)}
            pair = min(added, key=lambda each: added[each])
            is_flat = not min(each.volume for each in pair) > 0
            if len(found) <= count and added[pair] >= 1 and not is_flat:
                flat = [each for each in found.values() if not each.volume > 0]
                if not flat:
                    break
                pair = min((each for each in added if flat[0] in each), key=lambda p: added[p])
            one, other = pair
            del found[one.number], found[other.number]
            key = one.number, other.number
            if key not in self._merged:
                hull = self._common[key][1]
                self._merged[key] = self._piece(one.parts + other.parts, hull)
            found[self._merged[key].number] = self._merged[key]
        return list(found.values())

    def _added(self, one: Piece, other: Piece) -> float:
        """Return how much larger the common hull of two pieces is, by what a piece has to save."""
        key = one.number, other.number
        if key not in self._common:
            hull = _hull(np.concatenate([one.corners, other.corners]))
            added = round((hull[1] - one.volume - other.volume) / self._least, DIGITS)
            self._common[key] = added, hull
        return self._common[key][0]

    def improved(self, pieces: list[Piece], count: int) -> list[Piece]:
        """Return smaller pieces, at most `count`, if cutting one or two and merging makes any."""
        total = self._total(pieces)
        for _ in range(STEPS):
            again = self._emptiest(pieces)[:AGAIN]
            ways = [
                [[(each, way)] for each in again for way in range(len(self._splits(each)))],
                [[(one, 0), (other, 0)] for one, other in combinations(again, 2)
                 if self._splits(one) and self._splits(other)],
            ]  # fmt: skip
            for some in ways:
                tried = [self.merged(self._cut(pieces, chosen), count) for chosen in some]
                best = min(tried, key=self._total, default=pieces)
                if self._total(best) < total - BETTER / WORTH:
                    break
            else:
                break
            pieces, total = best, self._total(best)
        return pieces

    def _total(self, pieces: list[Piece]) -> float:
        """Return the volume of pieces, by what each has to save, and 1 for each of them."""
        return round(sum(each.volume for each in pieces) / self._least + len(pieces), DIGITS)

    def _cut(self, pieces: list[Piece], chosen: Iterable[tuple[Piece, int]]) -> list[Piece]:
        places = dict(chosen)
        return [
            each
            for piece in pieces
            for each in (self._halves(piece, places[piece]) if piece in places else [piece])
        ]

    # --- planes ---

    def _splits(self, piece: Piece) -> list[Split]:
        """Return planes to cut a piece with, the best first, each along another direction."""
        if piece.splits is None and self._is_convex(piece):
            piece.splits = []
        elif piece.splits is None:
            found = [split for split in self._scans(piece) if split[0] > 0]
            found.sort(key=lambda split: -split[0])
            if found and found[0][0] < LITTLE and piece.empty > AHEAD * self.whole.volume:
                found.sort(key=lambda split: -self._ahead(piece, split))
            piece.splits = found[:KINDS]
        return piece.splits

    def _is_convex(self, piece: Piece) -> bool:
        """Return whether all of the surface of a piece is about on its hull."""
        triangles = _coarse(piece)
        points = [triangles.reshape(-1, 3), *[part.deep for part in piece.parts]]
        try:
            planes = ConvexHull(np.vstack(points)).equations
        except (QhullError, ValueError):
            return True
        heights = triangles.mean(axis=1) @ planes[:, :3].T + planes[:, 3]
        return bool((heights.max(axis=1) > -DEEP * self._solid.size).all())

    def _ahead(self, piece: Piece, split: Split) -> float:
        """Return what a plane saves of a piece, with the next one in each of its halves."""
        saved = split[0] * piece.volume
        for half in self._both(piece, split):
            if half.volume > 0:
                saved += half.volume * max([0.0, *[each[0] for each in self._scans(half)]])
        return round(saved / piece.volume, DIGITS)

    def _halves(self, piece: Piece, way: int) -> list[Piece]:
        """Return what a plane makes of a piece, after others near that plane were tried."""
        if way not in piece.halves:
            best = self._splits(piece)[way]
            normal = best[1]
            heights = _coarse(piece) @ normal
            step = float(np.ptp(heights)) / (CUTS + 1)
            for _ in range(FINER):
                around = self._scan(piece, normal, best[2] - step, best[2] + step)
                best = max(best, around, key=lambda found: found[0])
                step *= 2 / (CUTS + 1)
            piece.halves[way] = self._both(piece, best)
        return piece.halves[way]

    def _both(self, piece: Piece, split: Split) -> list[Piece]:
        _, normal, place = split
        halves = [part.halves(normal, place, self._solid) for part in piece.parts]
        sides = ([part for part in side if part is not None] for side in zip(*halves, strict=True))
        return [self._piece(parts) for parts in sides if parts]

    def _scans(self, piece: Piece) -> list[Split]:
        """Return the best plane along each direction that is tried."""
        found = []
        triangles = _coarse(piece)
        for normal in _directions(triangles, self._frame) if len(triangles) else ():
            heights = triangles @ normal
            found.append(self._scan(piece, normal, float(heights.min()), float(heights.max())))
        return found

    def _scan(self, piece: Piece, normal: Floats, low: float, high: float) -> Split:
        """Return how good the best of some planes between two places is, its normal and its place.

        That is the part of the volume that it saves, and a little for parts of equal size.
        """
        places = np.linspace(low, high, CUTS + 2)[1:-1]
        met = [NO_POINTS] * CUTS
        for part in piece.parts:
            for index, points in enumerate(part.met(normal, places, self._solid.size)):
                near = points[self._solid.is_near(points)]
                met[index] = np.concatenate([met[index], near])
        points = np.concatenate([part.deep for part in piece.parts])
        slabs = np.searchsorted(places, points @ normal)
        more = [
            np.concatenate([points[slabs == index], *met[max(index - 1, 0) : index + 1]])
            for index in range(CUTS + 1)
        ]
        parts = []
        rest = _coarse(piece)
        for index, place in enumerate(places):  # slabs from below, each as the corners of its hull
            is_touched = (rest @ normal).min(axis=1) < place
            slab, above = cut(rest[is_touched], normal, place)
            rest = np.concatenate([rest[~is_touched], above])
            parts.append(_hull(np.concatenate([slab.reshape(-1, 3), more[index]]))[0])
        parts.append(_hull(np.concatenate([rest.reshape(-1, 3), more[-1]]))[0])
        volumes = np.array(_growing(parts))
        below, above = volumes[:-1], np.array(_growing(parts[:0:-1])[::-1])
        both = below + above - BALANCE * np.minimum(below, above)
        worth = 1 - both / max(float(volumes[-1]), 1e-300)
        index = int(np.round(worth, DIGITS).argmax())
        return round(float(worth[index]), DIGITS), normal, float(places[index])


def _coarse(piece: Piece) -> Floats:
    return np.concatenate([part.coarse for part in piece.parts])


def _lighter(points: Floats, indices: Whole, most: int) -> tuple[Floats, Whole]:
    """Return corners and triangles of a mesh, or about `most` that are near it."""
    if len(indices) > VERY_MANY:
        points, indices = _clustered(points, indices, CELLS)
    if len(indices) > most:
        points, indices = _collapsed(points, indices, most)
    if len(indices) > 2 * most:
        points, indices = _clustered(points, indices, int((most / 2) ** 0.5))
    return points, indices


def _collapsed(points: Floats, triangles: Whole, most: int) -> tuple[Floats, Whole]:
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


def _clustered(points: Floats, indices: Whole, cells: int) -> tuple[Floats, Whole]:
    """Return a mesh whose corners are one if they are in the same cell of a grid."""
    places = np.floor((points - points.min(axis=0)) * (cells / np.ptp(points, axis=0).max()))
    numbers = (places @ (1, 2 * cells, 4 * cells * cells)).astype(np.int64)
    _, first, cell = np.unique(numbers, return_index=True, return_inverse=True)
    corners = np.sort(cell[indices], axis=1)
    corners = np.unique(corners[(np.diff(corners, axis=1) > 0).all(axis=1)], axis=0)
    return (points[first], corners) if len(corners) else (points, indices)


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


def _frame(points: Floats, indices: Whole) -> Floats:
    """Return three unit vectors at right angles, the normals of the largest flat sides."""
    a, b, c = (points[indices[:, corner]] for corner in range(3))
    areas = areas_of(points, indices)
    normals = np.cross(b - a, c - a)[areas > 0] / (2 * areas[areas > 0, None])
    shares = areas[areas > 0] / areas.sum()
    largest = np.abs(normals).argmax(axis=1)
    normals *= np.sign(normals[np.arange(len(normals)), largest])[:, None]

    def flattest(chosen: NDArray[np.bool_]) -> Floats:
        rounded, sides = np.unique(
            np.round(normals[chosen] / ALIKE) * ALIKE + 0.0, axis=0, return_inverse=True
        )
        sums = np.round(np.bincount(sides.reshape(-1), shares[chosen]), 6)
        near = np.abs(normals - rounded[int(sums.argmax())]).max(axis=1) <= ALIKE
        side = (normals[near] * shares[near, None]).sum(axis=0)
        found: Floats = side / np.linalg.norm(side)
        return found

    first = flattest(np.ones(len(normals), bool))
    across = np.abs(normals @ first) < 2 * ALIKE
    second = flattest(across) if across.any() else np.eye(3)[np.abs(first).argmin()]
    third = np.cross(first, second)
    third /= np.linalg.norm(third)
    return np.array([first, np.cross(third, first), third])


def _directions(triangles: Floats, frame: Floats) -> list[Floats]:
    """Return the normals of planes that are tried.

    They are the axes, the normals of the largest flat sides of the whole, and the main axes of the
    surface.
    """
    found: list[Floats] = list(np.eye(3))
    a, b, c = np.moveaxis(triangles, 1, 0)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    others = list(frame)
    if areas.sum() > 0:
        middles = (a + b + c) / 3
        offsets = middles - np.average(middles, axis=0, weights=areas)
        _, axes = np.linalg.eigh((offsets * areas[:, None]).T @ offsets)
        others += list(axes.T)
    for axis in others:
        turned = axis * (1.0 if axis[np.abs(axis).argmax()] > 0 else -1.0)
        turned = np.round(turned, 6)  # the rest is rounding, and differs between machines
        turned /= np.linalg.norm(turned)
        if all(abs(float(turned @ each)) < SAME for each in found):
            found.append(turned)
    return found


def _growing(parts: Sequence[Floats]) -> list[float]:
    """Return the volumes of the hulls of the first part, of the first two, and so on."""
    volumes = []
    corners: Floats = NO_POINTS
    for part in parts:
        corners, volume = _hull(np.concatenate([corners, part]))
        volumes.append(volume)
    return volumes
