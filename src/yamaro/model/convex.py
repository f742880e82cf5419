"""Convex shapes where they are placed: how far they reach, and which of them overlap.

Source of the test: E. Gilbert, D. Johnson, S. Keerthi, A fast procedure for computing the distance
between complex objects in three-dimensional space, 1988; with the case distinction of C. Muratori,
Implementing GJK, 2006.
"""

from __future__ import annotations

from math import hypot

from .pose import ZERO, rotate, transposed
from .shapes import Box, Capsule, Cylinder

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from .pose import Pose, Vector
    from .shapes import SimpleShape

SHRUNK = 0.999
"""How large shapes are in the test of what overlaps: shapes that only touch do not overlap."""
MOST_STEPS = 64
ROUNDING = 1e-24
"""The square of an angle that comes from rounding."""
CELLS = 12
"""Cells along each side of a cube, by which points are chosen."""
FEW = 256
"""Points that are all used."""


class Convex:
    """A convex shape in the world.

    Attributes:
        center: a point in it.
        radius: how far it reaches from there, at most.
    """

    __slots__ = ("_axes", "_local", "_pose", "_shape", "center", "points", "radius")

    def __init__(
        self, pose: Pose, shape: SimpleShape | None, points: Sequence[Vector] = ()
    ) -> None:
        """Place a shape, or the convex hull of some points."""
        self._pose = pose
        self._axes = transposed(pose.rotation)
        self._shape = shape
        self._local = ZERO
        self.points = points
        if shape is None:
            spans = [(min(axis), max(axis)) for axis in zip(*points, strict=True)]
            x, y, z = ((low + high) / 2 for low, high in spans)
            self._local = (x, y, z)
            self.radius = max(hypot(p[0] - x, p[1] - y, p[2] - z) for p in points)
        elif isinstance(shape, Box):
            self.radius = hypot(shape.x, shape.y, shape.z) / 2
        elif isinstance(shape, Cylinder):
            self.radius = hypot(shape.radius, shape.length / 2)
        elif isinstance(shape, Capsule):
            self.radius = shape.radius + shape.length / 2
        else:
            self.radius = shape.radius
        self.center = pose.apply(self._local)

    def farthest(self, way: Vector) -> Vector:
        """Return the point of the shape that is farthest in a direction."""
        return self._pose.apply(self._farthest(rotate(self._axes, way)))

    def shrunk(self, way: Vector) -> Vector:
        """Return the farthest point of the shape made a little smaller."""
        x, y, z = self.farthest(way)
        a, b, c = self.center
        return (a + (x - a) * SHRUNK, b + (y - b) * SHRUNK, c + (z - c) * SHRUNK)

    def _farthest(self, way: Vector) -> Vector:
        x, y, z = way
        shape = self._shape
        if shape is None:
            return max(self.points, key=lambda p: p[0] * x + p[1] * y + p[2] * z)
        if isinstance(shape, Box):
            return (_signed(shape.x / 2, x), _signed(shape.y / 2, y), _signed(shape.z / 2, z))
        if isinstance(shape, Cylinder):
            across = hypot(x, y)
            part = shape.radius / across if across else 0.0
            return (x * part, y * part, _signed(shape.length / 2, z))
        length = hypot(x, y, z)
        part = shape.radius / length if length else 0.0
        end = _signed(shape.length / 2, z) if isinstance(shape, Capsule) else 0.0
        return (x * part, y * part, z * part + end)


def _signed(size: float, way: float) -> float:
    return size if way >= 0 else -size


def outer_points(points: Iterable[Vector]) -> list[Vector]:
    """Return points that have nearly the same convex hull: the farthest one in each direction.

    Directions are cells on a cube around the points, which has their proportions.
    """
    found = list(dict.fromkeys(points))
    if len(found) <= FEW:
        return found
    spans = [(min(axis), max(axis)) for axis in zip(*found, strict=True)]
    (x0, rx), (y0, ry), (z0, rz) = (
        ((low + high) / 2, (high - low) / 2 or 1.0) for low, high in spans
    )
    farthest: dict[tuple[int, int, int], tuple[float, Vector]] = {}
    for point in found:
        x, y, z = (point[0] - x0) / rx, (point[1] - y0) / ry, (point[2] - z0) / rz
        size = max(abs(x), abs(y), abs(z))
        if not size:
            continue
        part = CELLS / size
        cell = (int(x * part + CELLS), int(y * part + CELLS), int(z * part + CELLS))
        far = x * x + y * y + z * z
        kept = farthest.get(cell)
        if kept is None or far > kept[0]:
            farthest[cell] = (far, point)
    return [point for _, point in farthest.values()]


def near(shapes: Sequence[Convex]) -> Iterator[tuple[int, int]]:
    """Yield the pairs of shapes, by index, whose bounding spheres overlap."""
    order = sorted(range(len(shapes)), key=lambda i: shapes[i].center[0] - shapes[i].radius)
    open_ones: list[int] = []
    for index in order:
        shape = shapes[index]
        start = shape.center[0] - shape.radius
        open_ones = [i for i in open_ones if shapes[i].center[0] + shapes[i].radius > start]
        for other in open_ones:
            x, y, z = minus(shape.center, shapes[other].center)
            reach = shape.radius + shapes[other].radius
            if x * x + y * y + z * z < reach * reach:
                yield (other, index) if other < index else (index, other)
        open_ones.append(index)


def overlapping(
    shapes: Sequence[Convex], owners: Sequence[str], may: Callable[[str, str], bool]
) -> tuple[tuple[int, int], ...]:
    """Return pairs of shapes, by index, that overlap: the first pair of each two owners.

    Args:
        shapes: the shapes.
        owners: whose they are.
        may: whether shapes of two owners count.
    """
    found: dict[tuple[str, str], tuple[int, int]] = {}
    for index, other in sorted(near(shapes)):
        pair = (owners[index], owners[other])
        if pair not in found and may(*pair) and overlap(shapes[index], shapes[other]):
            found[pair] = (index, other)
    return tuple(found.values())


def overlap(first: Convex, second: Convex) -> bool:
    """Return whether two shapes overlap by more than they may touch."""
    return witness(first, second)[0]


def witness(first: Convex, second: Convex) -> tuple[bool, list[Vector]]:
    """Return whether two shapes overlap by more than they may touch, and the ways that show it.

    The farthest points of their difference one way show that they do not; those four ways, which
    are a tetrahedron around the origin, show that they do. There is none where rounding decides.
    """
    way = minus(second.center, first.center)
    if not any(way):
        return True, []
    simplex = [_difference(first, second, way)]
    ways = {simplex[0]: way}
    way = _opposite(simplex[0])
    for _ in range(MOST_STEPS):
        if not any(way):
            return True, []
        point = _difference(first, second, way)
        if dot(point, way) <= 0:
            return False, [way]
        ways[point] = way
        simplex.append(point)
        step = _next(simplex)
        if step is None:
            return True, [ways[each] for each in simplex]
        simplex, way = step
    return False, []


def _difference(first: Convex, second: Convex, way: Vector) -> Vector:
    """Return the farthest point of all differences between points of two shapes."""
    return minus(first.shrunk(way), second.shrunk(_opposite(way)))


Step = tuple[list["Vector"], "Vector"]


def _next(simplex: list[Vector]) -> Step | None:
    """Return what of a simplex is nearest to the origin, and the way to it; None if it is inside.

    The last point is the newest.
    """
    if len(simplex) == 2:
        return _of_line(simplex[1], simplex[0])
    if len(simplex) == 3:
        return _of_triangle(simplex[2], simplex[1], simplex[0])
    a, b, c, d = simplex[3], simplex[2], simplex[1], simplex[0]
    to_origin = _opposite(a)
    for one, two, three in ((b, c, d), (c, d, b), (d, b, c)):
        normal = cross(minus(one, a), minus(two, a))
        if dot(normal, minus(three, a)) > 0:
            normal = _opposite(normal)
        if dot(normal, to_origin) > 0:
            return _of_triangle(a, one, two)
    return None


def _of_line(a: Vector, b: Vector) -> Step:
    along, to_origin = minus(b, a), _opposite(a)
    if dot(along, to_origin) <= 0:
        return [a], to_origin
    aside = cross(along, to_origin)
    if dot(aside, aside) <= ROUNDING * dot(along, along) * dot(to_origin, to_origin):
        return [b, a], ZERO  # the origin is on the line
    return [b, a], cross(aside, along)


def _of_triangle(a: Vector, b: Vector, c: Vector) -> Step:
    ab, ac, to_origin = minus(b, a), minus(c, a), _opposite(a)
    normal = cross(ab, ac)
    if dot(cross(normal, ac), to_origin) > 0:
        return _of_line(a, c) if dot(ac, to_origin) > 0 else _of_line(a, b)
    if dot(cross(ab, normal), to_origin) > 0:
        return _of_line(a, b)
    if dot(normal, to_origin) > 0:
        return [c, b, a], normal
    return [b, c, a], _opposite(normal)


def minus(a: Vector, b: Vector) -> Vector:
    """Return a − b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _opposite(a: Vector) -> Vector:
    return (-a[0], -a[1], -a[2])


def dot(a: Vector, b: Vector) -> float:
    """Return a·b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a×b."""
    x, y, z = a
    u, v, w = b
    return (y * w - z * v, z * u - x * w, x * v - y * u)
