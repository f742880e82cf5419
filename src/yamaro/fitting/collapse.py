"""Edges of a mesh that collapse one after the other, where that moves its surface least.

Each corner has a quadric: the sum of squared distances to the planes of the triangles around it.
The planes count by the square root of the triangle's area: by the area, small features go first,
and the greatest distance is that of a small feature. Along borders, and where colours meet, there
are planes across the surface as well. Many edges that are far enough apart collapse at once.

Source: M. Garland, P. S. Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH
1997. Cells: P. Lindstrom, Out-of-core simplification of large polygonal models, SIGGRAPH 2000.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from .sampling import Floats, Whole

    State = tuple[Floats, Whole, Whole]

VERY_MANY, CELLS = 200_000, 256
"""Triangles from which on corners are one that are in the same cell of a grid, and its cells along
the longest side: no corner moves by 1 % of it."""
SHARE, FEWEST = 0.3, 64
"""Part of the edges, the cheapest, that may collapse in a pass, and their number at least."""
ROUNDS = 3
"""How often a pass looks for further edges far enough from those that were found."""
TURNED = 0.2
"""The cosine of the angle by which a triangle may turn."""
NEEDLE = 1e-4
"""How much area a triangle keeps at least, as a part of the square of its longest side."""
FIRM = 1e-3
"""How firmly a corner is held at the middle of its edge, as a part of the sum of its planes."""
STEP = 1.1
"""How many times fewer triangles each state has than the one before."""
_ROWS, _COLUMNS = (0, 0, 0, 0, 1, 1, 1, 2, 2, 3), (0, 1, 2, 3, 1, 2, 3, 2, 3, 3)
"""Places of the ten numbers of a quadric in a symmetric matrix of 4×4."""


def states(points: Floats, triangles: Whole, labels: Whole, most: int) -> Iterator[State]:
    """Yield corners, triangles and labels, each time fewer, down to `most` triangles if they can.

    Args:
        points: the corners, N×3, each of them once.
        triangles: M×3.
        labels: a number of each triangle, such as that of its colour; no triangle changes it.
        most: the greatest number of triangles.
    """
    low, size = points.min(axis=0), float(np.ptp(points, axis=0).max())
    points = (points - low) / size
    quadrics = _quadrics(points, triangles, labels)
    if len(triangles) > VERY_MANY:
        points, triangles, labels, quadrics = _clustered(points, triangles, labels, quadrics)
        yield points * size + low, triangles, labels
    share, said = SHARE, len(triangles)
    while len(triangles) > most:
        ends, corners = _edges(points, triangles, quadrics, share)
        if not len(ends):
            if share >= 1:
                break
            share = min(1.0, 2 * share)
            continue
        chosen = _apart(ends, triangles, len(points))[: (len(triangles) - most + 1) // 2]
        kept, gone = ends[chosen].T
        points[kept] = corners[chosen]
        quadrics[kept] += quadrics[gone]
        moved = np.arange(len(points))
        moved[gone] = kept
        found = _without_doubles(moved[triangles], labels)
        if not len(found[0]):
            break
        used, places = np.unique(found[0], return_inverse=True)
        triangles, labels = places.reshape(-1, 3), found[1]
        points, quadrics = points[used], quadrics[used]
        if len(triangles) <= max(most, said / STEP):
            said = len(triangles)
            yield points * size + low, triangles, labels
    if len(triangles) < said:
        yield points * size + low, triangles, labels


def _quadrics(points: Floats, triangles: Whole, labels: Whole) -> Floats:
    """Return the quadrics of corners, N×10."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    doubled = np.sqrt((normals * normals).sum(axis=1))
    normals /= np.where(doubled > 0, doubled, 1.0)[:, None]
    found = np.zeros((len(points), len(_ROWS)))

    def add(ends: Whole, normals: Floats, weights: Floats) -> None:
        offsets = -(normals * points[ends[:, 0]]).sum(axis=1)
        planes = np.column_stack([normals, offsets])
        for place, (i, j) in enumerate(zip(_ROWS, _COLUMNS, strict=True)):
            values = planes[:, i] * planes[:, j] * weights
            for end in ends.T:
                found[:, place] += np.bincount(end, values, len(points))

    add(triangles, normals, np.sqrt(doubled / 2))
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    owners = np.tile(np.arange(len(triangles)), 3)
    numbers = sides.min(axis=1) * len(points) + sides.max(axis=1)
    order = np.argsort(numbers, kind="stable")
    starts = np.flatnonzero(np.diff(numbers[order], prepend=-1))
    counts = np.diff(np.append(starts, len(order)))
    own = labels[owners[order]]
    is_border = (counts != 2) | (
        np.minimum.reduceat(own, starts) != np.maximum.reduceat(own, starts)
    )
    borders = order[np.repeat(is_border, counts)]
    if len(borders):
        ends = sides[borders]
        along = points[ends[:, 1]] - points[ends[:, 0]]
        across = np.cross(along, normals[owners[borders]])
        lengths = np.sqrt((along * along).sum(axis=1))
        add(ends, across / np.where(lengths > 0, lengths, 1.0)[:, None], lengths)
    return found


def _clustered(
    points: Floats, triangles: Whole, labels: Whole, quadrics: Floats
) -> tuple[Floats, Whole, Whole, Floats]:
    """Return a mesh in which corners are one if they are in the same cell of a grid."""
    cells = np.floor(points * CELLS).astype(np.int64)
    numbers = (cells[:, 0] * 2 * CELLS + cells[:, 1]) * 2 * CELLS + cells[:, 2]
    _, cell, counts = np.unique(numbers, return_inverse=True, return_counts=True)
    cell = cell.reshape(-1)
    together = [np.bincount(cell, column) for column in quadrics.T]
    middles = np.stack([np.bincount(cell, column) / counts for column in points.T], axis=1)
    summed: Floats = np.stack(together, axis=1).astype(float)
    corners, _ = _lowest(summed, middles[None], np.full(len(middles), 0.25 / CELLS**2))
    triangles, labels = _without_doubles(cell[triangles], labels)
    used, places = np.unique(triangles, return_inverse=True)
    rows: Whole = places.reshape(-1, 3)
    return corners[used], rows, labels, summed[used]


def _edges(
    points: Floats, triangles: Whole, quadrics: Floats, share: float
) -> tuple[Whole, Floats]:
    """Return the ends of edges that may collapse, the cheapest first, and what each becomes."""
    count = len(points)
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    numbers = np.sort(sides.min(axis=1) * count + sides.max(axis=1))
    numbers = numbers[np.diff(numbers, prepend=-1) > 0]
    ends = np.stack([numbers // count, numbers % count], axis=1)
    one, two = points[ends[:, 0]], points[ends[:, 1]]
    places = np.stack([(one + two) / 2, one, two])
    reach = ((one - two) ** 2).sum(axis=1)
    corners, costs = _lowest(quadrics[ends[:, 0]] + quadrics[ends[:, 1]], places, reach)
    # Edges of about the same cost are shuffled: else they would be side by side.
    shuffled = (ends[:, 0] * 0x9E3779B1 + ends[:, 1] * 0x85EBCA6B) & 0xFFFFFFFF
    order = np.lexsort((shuffled, np.frexp(np.maximum(costs, 0.0) + 1e-16)[1]))
    order = order[: max(FEWEST, int(len(order) * share))]
    ends, corners = ends[order], corners[order]
    allowed = ~_turns_any(points, triangles, ends, corners)
    return ends[allowed], corners[allowed]


def _lowest(quadrics: Floats, places: Floats, reach: Floats) -> tuple[Floats, Floats]:
    """Return where quadrics, N×10, are lowest, and how low.

    Args:
        quadrics: N×10.
        places: where they are looked at, K×N×3.
        reach: how far from the first of these the lowest point may be, squared.
    """
    a, b, c, d, e, f, g, h, i, j = quadrics.T
    rows = np.arange(len(quadrics))

    def value(at: Floats) -> Floats:
        x, y, z = np.moveaxis(at, -1, 0)
        found: Floats = x * (a * x + 2 * (b * y + c * z + d)) + y * (e * y + 2 * (f * z + g))
        found += z * (h * z + 2 * i) + j
        return found

    low = value(places)
    best = low.argmin(axis=0)
    found, lowest = places[best, rows], low[best, rows]
    x, y, z = places[0].T
    slope = (a * x + b * y + c * z + d, b * x + e * y + f * z + g, c * x + f * y + h * z + i)
    trace = a + e + h
    a, e, h = (each + FIRM * FIRM * trace for each in (a, e, h))
    aa, ab, ac = e * h - f * f, c * f - b * h, b * f - c * e
    bb, bc, cc = a * h - c * c, b * c - a * f, a * e - b * b
    det = a * aa + b * ab + c * ac
    is_one = det > 1e-12 * trace**3
    safe = -np.where(is_one, det, 1.0)
    minors = ((aa, ab, ac), (ab, bb, bc), (ac, bc, cc))
    u, v, w = slope
    off = np.stack([(p * u + q * v + r * w) / safe for p, q, r in minors], axis=1)
    a, e, h = quadrics.T[[0, 4, 7]]
    at = places[0] + off
    lower = np.where(is_one & ((off * off).sum(axis=1) <= reach), value(at), np.inf)
    is_lower = lower <= lowest
    found[is_lower] = at[is_lower]
    return found, np.where(is_lower, lower, lowest)


def _turns_any(points: Floats, triangles: Whole, ends: Whole, corners: Floats) -> NDArray[np.bool_]:
    """Return whether a collapse of edges would turn a triangle around, or make a needle of one."""
    flat = triangles.ravel()
    order = np.argsort(flat, kind="stable")
    starts = np.searchsorted(flat[order], np.arange(len(points) + 1))
    found = np.zeros(len(ends), bool)
    for one, two in (ends.T, ends.T[::-1]):
        counts = starts[one + 1] - starts[one]
        edges = np.repeat(np.arange(len(ends)), counts)
        firsts = np.repeat(starts[one] - np.cumsum(counts) + counts, counts)
        around = triangles[order[firsts + np.arange(len(edges))] // 3]
        stays = (around != two[edges, None]).all(axis=1)
        edges, around = edges[stays], around[stays]
        before = points[around]
        is_moved = (around == one[edges, None])[:, :, None]
        after = np.where(is_moved, corners[edges, None], before)
        was, now = (np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]) for x in (before, after))
        length_was, length_now = (np.sqrt((x * x).sum(axis=1)) for x in (was, now))
        turned = (was * now).sum(axis=1) < TURNED * length_was * length_now
        longest = ((after - np.roll(after, 1, axis=1)) ** 2).sum(axis=2).max(axis=1)
        thin = (length_now < NEEDLE * longest) & (length_now < length_was)
        found |= np.bincount(edges, (turned & (length_was > 1e-14)) | thin, len(ends)) > 0
    return found


def _apart(ends: Whole, triangles: Whole, count: int) -> Whole:
    """Return edges, the first ones first, of which no two change the same triangle."""
    is_chosen, is_free = np.zeros(len(ends), bool), np.ones(len(ends), bool)
    is_near = np.zeros(count, bool)
    for _ in range(ROUNDS):
        free = np.flatnonzero(is_free)
        first = np.full(count, len(ends))
        for end in ends[free].T:
            np.minimum.at(first, end, free)
        around = first.copy()
        for corner in triangles.T:
            np.minimum.at(around, corner, first[triangles].min(axis=1))
        new = free[(around[ends[free]] == free[:, None]).all(axis=1)]
        if not len(new):
            break
        is_chosen[new] = True
        is_end = np.zeros(count, bool)
        is_end[ends[new]] = True
        is_near[triangles[is_end[triangles].any(axis=1)]] = True
        is_free &= ~is_near[ends].any(axis=1)
    return np.flatnonzero(is_chosen)


def _without_doubles(triangles: Whole, labels: Whole) -> tuple[Whole, Whole]:
    """Return triangles with three corners, each once; one for each side is kept."""
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    triangles, labels = triangles[whole], labels[whole]
    if not len(triangles):
        return triangles, labels
    turns = (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3
    turned = np.take_along_axis(triangles, turns, axis=1)
    order = np.lexsort(turned.T)
    is_same = (np.diff(turned[order], axis=0) == 0).all(axis=1)
    kept = np.sort(np.delete(order, np.flatnonzero(is_same) + 1))
    return triangles[kept], labels[kept]
