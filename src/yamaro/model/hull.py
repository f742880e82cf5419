"""The convex hull of points in space.

Source: C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, ACM
Transactions on Mathematical Software 22, 1996.
"""

from __future__ import annotations

from math import hypot

from .convex import cross, dot, minus

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from .pose import Vector

    Triangle = tuple[int, int, int]

ROUNDING = 1e-12
"""What is nearer to a face than this part of the size of the points is in it."""


class _Face:
    """A triangle of the hull, and the points outside of it."""

    __slots__ = ("corners", "height", "normal", "outside")

    def __init__(self, corners: Triangle, points: Sequence[Vector]) -> None:
        self.corners = corners
        a, b, c = (points[index] for index in corners)
        normal = cross(minus(b, a), minus(c, a))
        length = hypot(*normal) or 1.0
        x, y, z = normal
        self.normal = (x / length, y / length, z / length)
        self.height = dot(self.normal, a)
        self.outside: list[int] = []


def hull(points: Sequence[Vector]) -> list[Triangle]:
    """Return the triangles of the hull as corners, counterclockwise as seen from outside.

    There are none if all points are in a plane.
    """
    first = _tetrahedron(points)
    if not first:
        return []
    size = max(hypot(*minus(point, points[first[0]])) for point in points)
    least = ROUNDING * size
    edges: dict[tuple[int, int], _Face] = {}

    def add(corners: Triangle) -> _Face:
        face = _Face(corners, points)
        a, b, c = corners
        edges[a, b] = edges[b, c] = edges[c, a] = face
        return face

    def share(indices: list[int], faces: list[_Face]) -> None:
        for index in indices:
            point = points[index]
            for face in faces:
                if dot(face.normal, point) - face.height > least:
                    face.outside.append(index)
                    break

    a, b, c, d = first
    faces = [add((a, b, c)), add((a, d, b)), add((b, d, c)), add((c, d, a))]
    share([i for i in range(len(points)) if i not in first], faces)
    pending = [face for face in faces if face.outside]
    while pending:
        face = pending.pop()
        if not face.outside or edges.get(face.corners[:2]) is not face:
            continue
        apex = max(face.outside, key=lambda i: dot(face.normal, points[i]))
        seen, rim = _visible(face, points[apex], edges, least)
        left = [index for each in seen for index in each.outside if index != apex]
        for each in seen:
            a, b, c = each.corners
            for edge in ((a, b), (b, c), (c, a)):
                if edges.get(edge) is each:
                    del edges[edge]
        made = [add((start, end, apex)) for start, end in rim]
        share(left, made)
        pending += [each for each in made if each.outside]
    return list(dict.fromkeys(face.corners for face in edges.values()))


def _visible(
    face: _Face, apex: Vector, edges: dict[tuple[int, int], _Face], least: float
) -> tuple[list[_Face], list[tuple[int, int]]]:
    """Return the faces that are seen from a point, beginning with one, and the edges around."""
    seen, rim = [face], []
    known = {id(face)}
    for each in seen:
        a, b, c = each.corners
        for start, end in ((a, b), (b, c), (c, a)):
            other = edges[end, start]
            if id(other) in known:
                continue
            if dot(other.normal, apex) - other.height > least:
                known.add(id(other))
                seen.append(other)
    for each in seen:
        a, b, c = each.corners
        rim += [edge for edge in ((a, b), (b, c), (c, a)) if id(edges[edge[::-1]]) not in known]
    return seen, rim


def _tetrahedron(points: Sequence[Vector]) -> tuple[int, int, int, int] | None:
    """Return four points far apart, the last one below the others, or None if all are in a plane.

    That makes the first three counterclockwise as seen from outside.
    """
    if len(points) < 4:
        return None
    a = min(range(len(points)), key=lambda i: points[i])
    b = max(range(len(points)), key=lambda i: hypot(*minus(points[i], points[a])))
    along = minus(points[b], points[a])
    c = max(range(len(points)), key=lambda i: hypot(*cross(along, minus(points[i], points[a]))))
    normal = cross(along, minus(points[c], points[a]))
    length = hypot(*normal)
    if not length:
        return None
    heights = [dot(normal, minus(point, points[a])) / length for point in points]
    d = max(range(len(points)), key=lambda i: abs(heights[i]))
    if abs(heights[d]) <= ROUNDING * hypot(*along):
        return None
    return (a, b, c, d) if heights[d] < 0 else (a, c, b, d)
