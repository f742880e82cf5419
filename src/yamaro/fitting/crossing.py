"""Whether the surfaces of two meshes cross or touch."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .sampling import Floats

FEW = 4096
"""Pairs of triangles that are compared at once."""
ROUNDING = 1e-9
"""How far beyond its edges a triangle is touched, as a part of its sides."""


def are_crossing(one: Floats, other: Floats) -> bool:
    """Return whether any triangles of two meshes, N×3×3 and M×3×3 corners, cross or touch.

    Both are halved again and again, and what is not in the box around the other one is left out.
    """
    waiting = [(one, other)]
    while waiting:
        a, b = waiting.pop()
        if not len(a) or not len(b):
            continue
        low = np.maximum(a.min(axis=(0, 1)), b.min(axis=(0, 1)))
        high = np.minimum(a.max(axis=(0, 1)), b.max(axis=(0, 1)))
        a, b = (
            each[((each.max(axis=1) >= low) & (each.min(axis=1) <= high)).all(axis=1)]
            for each in (a, b)
        )
        if len(a) * len(b) <= FEW:
            is_near = (a.max(axis=1)[:, None] >= b.min(axis=1)).all(axis=2)
            is_near &= (a.min(axis=1)[:, None] <= b.max(axis=1)).all(axis=2)
            first, second = np.nonzero(is_near)
            if _any_edge_meets(a[first], b[second]) or _any_edge_meets(b[second], a[first]):
                return True
            continue
        small, large = sorted((a, b), key=len)
        middles = large.mean(axis=1)
        axis = int(np.ptp(middles, axis=0).argmax())
        order = np.argsort(middles[:, axis], kind="stable")
        half = len(order) // 2
        waiting += [(small, large[order[:half]]), (small, large[order[half:]])]
    return False


def _any_edge_meets(edged: Floats, triangles: Floats) -> bool:
    """Return whether an edge of the n-th triangle of `edged` meets the n-th of `triangles`.

    Source: T. Möller, B. Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
    """
    a, b, c = np.moveaxis(triangles, 1, 0)
    first, second = b - a, c - a
    for corner in range(3):
        start = edged[:, corner]
        way = edged[:, corner - 1] - start
        across = np.cross(way, second)
        volume = (first * across).sum(axis=1)
        safe = np.where(volume == 0, np.inf, volume)  # the edge is in the plane, or parallel
        from_a = start - a
        u = (from_a * across).sum(axis=1) / safe
        turned = np.cross(from_a, first)
        v = (way * turned).sum(axis=1) / safe
        along = (second * turned).sum(axis=1) / safe
        least = np.minimum(np.minimum(u, v), np.minimum(1 - u - v, np.minimum(along, 1 - along)))
        if ((least >= -ROUNDING) & (volume != 0)).any():
            return True
    return False
