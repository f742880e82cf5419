"""Boxes, cylinders, spheres and capsules fitted to meshes.

Without `covers` a shape is that of the least squares of the distances between its surface and
points of the mesh, which are spread evenly over the area that is seen from outside. With it, it is
the smallest shape by volume that contains every corner of the mesh, among those that a search from
many directions finds.

Sizes and positions are rounded to a part of the mesh's size, so that they read well, and so that
what differs between processors in the last digits does not matter. With `covers` sizes are rounded
up.
"""

from __future__ import annotations

from math import ceil, floor, log10, pi
from typing import TYPE_CHECKING

import numpy as np

from ..model.pose import rotation_from_rpy, rotation_from_z, rpy_from_rotation
from ..model.shapes import SIMPLE_SHAPES
from .fit import BEST, Placed
from .sampling import arrays_of, directions, seen, spread_over

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..meshes.triangles import TriangleMesh
    from ..model.pose import Vector
    from .sampling import Floats, Whole

SAMPLES, FEW = 4000, 400
"""Points of the mesh in the end, and to try beginnings with."""
DIRECTIONS = 40
TURNS = 60
"""Directions of axes, and rotations of boxes, from which searches begin, besides the mesh's own."""
DIGITS = 5
"""Decimals of a part of the mesh's size."""
ANGLE_DIGITS = 6
SIMPLER = ("sphere", "capsule", "box", "cylinder")
"""The shapes in the order of what a test of contact costs."""
ALIKE = 0.1
"""The part by which an error may be greater: then the simpler shape is taken."""
SLIGHT = 1e-3
"""The same without `covers`, by the mesh's size: a ball of flat triangles is not a capsule."""
PREFERS_AXES = 1e-3
"""The same for the axes of the mesh, in place of others."""
THINNEST = 1e-3
"""The least size of a shape, as a part of the mesh's size: what is flat gets a thickness."""
CAP, NEARLY, WORSE = 0.5, 0.1, 1.5
"""Of its radius, how far a mesh goes into each cap of a capsule that is longer, and how much may be
missing; how many times the error is of a capsule that is no longer than the mesh."""
SLACK = 1e-9
"""How far beyond a corner a shape that contains it reaches, as a part of the mesh's size."""


def primitive_of(mesh: TriangleMesh, kind: str, *, covers: bool) -> Placed:
    """Return a simple shape fitted to a mesh.

    Args:
        mesh: the mesh, in metres.
        kind: `box`, `cylinder`, `sphere` or `capsule`; or `best`: the one with the least error,
            or with `covers` the least volume, where of those that are as good the simpler is taken.
        covers: whether it has to contain every corner of the mesh.

    Raises:
        MeshFileError: the mesh has no area.
    """
    points, triangles = arrays_of(mesh)
    low, high = points.min(axis=0), points.max(axis=0)
    frame = _Frame((low + high) / 2, float((high - low).max()))
    body = _Body(frame.inside(points), triangles)
    kinds = SIMPLER if kind == BEST else (kind,)
    found: list[tuple[float, Placed]] = []
    for each in kinds:
        if covers:
            guess = _smallest(body, each)
            placed = _containing(each, guess, points, frame)
            found.append((placed.shape.volume(), placed))
        else:
            error, guess = _least_squares(body, each)
            found.append((error, _rounded(each, guess, frame)))
    least = min(error for error, _ in found)
    most = least * (1 + ALIKE) + (0.0 if covers else SLIGHT + 1e-9)
    return next(placed for error, placed in found if error <= most)


class _Frame:
    """Takes a mesh to the middle of a frame where its longest side is 1."""

    __slots__ = ("center", "size")

    def __init__(self, center: Floats, size: float) -> None:
        self.center = center
        self.size = size

    def inside(self, points: Floats) -> Floats:
        return (points - self.center) / self.size


class _Body:
    """A mesh to fit to, in its frame.

    Attributes:
        samples: points spread over its surface, as far as it is seen from outside.
        few: some of them.
        outer: the corners that are farthest in many directions.
    """

    __slots__ = ("_spread", "few", "outer", "samples")

    def __init__(self, points: Floats, triangles: Whole) -> None:
        samples = spread_over(points, triangles, 2 * SAMPLES)[0]
        outside = samples[seen(points, triangles, samples)]
        if len(outside) > FEW:
            samples = outside
        self.samples = samples[:: -(-len(samples) // SAMPLES)]
        self.few = self.samples[:: max(1, len(self.samples) // FEW)]
        ways = directions(400)
        ways = np.concatenate([ways, -ways])
        farthest: list[int] = []
        for start in range(0, len(ways), 32):
            farthest += np.argmax(ways[start : start + 32] @ points.T, axis=1).tolist()
        self.outer = points[sorted(set(farthest))]
        middle = self.samples.mean(axis=0)
        spread = self.samples - middle
        self._spread: Floats = np.linalg.eigh(spread.T @ spread)[1].T

    def axes(self) -> list[Floats]:
        """Return the directions from which the search for an axis begins, the mesh's own first."""
        return [*np.eye(3)[::-1], *self._spread, *directions(DIRECTIONS)]

    def rotations(self) -> list[Floats]:
        """Return the rotations from which the search for a box begins."""
        own = self._spread.T
        own = own * np.linalg.det(own)
        return [np.eye(3), own, *_rotations(TURNS)]


def _rotations(count: int) -> list[Floats]:
    """Return rotations spread evenly.

    Source: M. Alexa, Super-Fibonacci Spirals, CVPR 2022.
    """
    found = []
    phi, psi = 2**0.5, 1.533751168755204288118041
    for index in range(count):
        s = index + 0.5
        r, q = (s / count) ** 0.5, (1 - s / count) ** 0.5
        a, b = 2 * pi * s / phi, 2 * pi * s / psi
        x, y, z, w = r * np.sin(a), r * np.cos(a), q * np.sin(b), q * np.cos(b)
        found.append(
            np.array(
                [
                    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
                ]
            )
        )
    return found


class Guess:
    """A shape in the frame of a mesh.

    Attributes:
        center: its middle.
        rotation: its axes as columns.
        halves: half a box's sides; radius and half the length of a cylinder or capsule; the radius
            of a sphere.
    """

    __slots__ = ("center", "halves", "rotation")

    def __init__(self, center: Floats, rotation: Floats, halves: Floats) -> None:
        self.center = center
        self.rotation = rotation
        self.halves = halves

    def changed(self, step: Floats) -> Guess:
        """Return the guess moved, turned and sized by nine or fewer numbers."""
        halves = np.maximum(self.halves + step[6:], 0.0)
        return Guess(
            self.center + self.rotation @ step[:3], _turned(self.rotation, step[3:6]), halves
        )


def _turned(rotation: Floats, by: Floats) -> Floats:
    """Return a rotation after a turn about its own axes by a rotation vector in radians.

    Source: O. Rodrigues' formula; J. J. Craig, Introduction to Robotics, 3rd edition, 2.80.
    """
    angle = float(np.sqrt((by * by).sum()))
    if angle < 1e-14:
        return rotation
    x, y, z = by / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)
    turned: Floats = rotation @ turn
    return turned


def distances(kind: str, guess: Guess, points: Floats) -> Floats:
    """Return the signed distances of points to the surface of a shape, negative inside.

    Source: I. Quilez, Distance functions.
    """
    local = (points - guess.center) @ guess.rotation
    found: Floats
    if kind == "sphere":
        found = np.sqrt((local * local).sum(axis=1)) - guess.halves[0]
        return found
    if kind == "box":
        beyond = abs(local) - guess.halves
        outside = np.maximum(beyond, 0)
        found = np.sqrt((outside * outside).sum(axis=1)) + np.minimum(beyond.max(axis=1), 0)
        return found
    radius, half = guess.halves
    across = np.hypot(local[:, 0], local[:, 1])
    along = abs(local[:, 2]) - half
    if kind == "capsule":
        found = np.hypot(across, np.maximum(along, 0)) - radius
        return found
    across = across - radius
    outer = np.hypot(np.maximum(across, 0), np.maximum(along, 0))
    found = outer + np.minimum(np.maximum(across, along), 0)
    return found


# --- least squares ------------------------------------------------------------------------------


_FREE = {
    "sphere": (0, 1, 2, 6),
    "capsule": (0, 1, 2, 3, 4, 6, 7),
    "cylinder": (0, 1, 2, 3, 4, 6, 7),
    "box": (0, 1, 2, 3, 4, 5, 6, 7, 8),
}
"""Which of the numbers of a step count: a move, a turn about x and y of the shape, and sizes."""
_SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3}
_STEP = 1e-7


def _least_squares(body: _Body, kind: str) -> tuple[float, Guess]:
    """Return the root of the mean square of the distances, and the shape for which it is least."""
    few = body.few
    begun = [_improved(kind, guess, few, 4, body.outer) for guess in _beginnings(body, kind)]
    begun.sort(key=_error_of)
    better = [_improved(kind, guess, few, 30, body.outer) for _, guess in begun[:5]]
    better.sort(key=_error_of)
    found = [_improved(kind, guess, body.samples, 60, body.outer) for _, guess in better[:2]]
    error, guess = min(found, key=_error_of)
    if kind != "sphere":
        straight = _straightened(kind, guess)
        plain, along = _improved(kind, straight, body.samples, 60, body.outer, turns=False)
        if plain <= error * (1 + PREFERS_AXES) + 1e-9:
            error, guess = plain, along
    if kind == "capsule":
        longer, free = _improved(kind, guess, body.samples, 60)
        if longer * WORSE < error and _is_cut_off(body, free):
            error, guess = longer, free
    return error, guess


def _is_cut_off(body: _Body, capsule: Guess) -> bool:
    """Return whether the mesh is a capsule whose caps end in openings.

    What is there of a cap has to be curved so much that it says where the capsule would end.
    """
    radius, half = capsule.halves
    local = (body.outer - capsule.center) @ capsule.rotation
    low, high = -local.min(axis=0), local.max(axis=0)
    least = radius * (1 - NEARLY)
    if min(*low[:2], *high[:2]) < least:  # it is not on all sides
        return False
    places = (body.samples - capsule.center) @ capsule.rotation
    across = np.hypot(places[:, 0], places[:, 1])
    for reach, heights in ((low[2] - half, -places[:, 2]), (high[2] - half, places[:, 2])):
        if reach < least:
            opening = float(np.sqrt(radius * radius - reach * reach))
            inmost = float(across[heights > half].min(initial=radius))
            if reach < CAP * radius or inmost < opening * (1 - 2 * NEARLY):
                return False
    return True


def _error_of(found: tuple[float, Guess]) -> float:
    """Return the error without the digits that differ between processors."""
    return round(found[0], 9)


def _beginnings(body: _Body, kind: str) -> list[Guess]:
    few, outer = body.few, body.outer
    if kind == "sphere":
        center = few.mean(axis=0)
        radius = np.sqrt(((few - center) ** 2).sum(axis=1)).mean()
        return [Guess(center, np.eye(3), np.array([radius]))]
    if kind == "box":
        found = []
        for rotation in body.rotations():
            local = outer @ rotation
            low, high = local.min(axis=0), local.max(axis=0)
            found.append(Guess(rotation @ ((low + high) / 2), rotation, (high - low) / 2))
        return found
    found = []
    for axis in body.axes():
        rotation = _frame_along(axis)
        local = outer @ rotation
        low, high = local.min(axis=0), local.max(axis=0)
        middle = (low + high) / 2
        radius = float((high - low)[:2].mean()) / 2
        half = float(high[2] - low[2]) / 2
        if kind == "capsule":
            half = max(half - radius, 0.05 * half)
        found.append(Guess(rotation @ middle, rotation, np.array([radius, half])))
    return found


def _frame_along(axis: Floats) -> Floats:
    x, y, z = (float(each) for each in axis / np.sqrt((axis * axis).sum()))
    return np.array(rotation_from_z((x, y, max(-1.0, min(1.0, z)))))


def _bounded(kind: str, guess: Guess, outer: Floats) -> Guess:
    """Return a shape that reaches no farther along its axes than the mesh does.

    The points of a mesh do not say where a shape ends that they have no end of, such as a capsule
    along the diagonal of an angle: without a bound it may become any length.
    """
    local = outer @ guess.rotation
    low, high = local.min(axis=0), local.max(axis=0)
    ranges = (high - low) / 2
    middle = guess.center @ guess.rotation
    halves = guess.halves.copy()
    if kind == "box":
        halves = np.minimum(halves, ranges)
        reach = halves
    else:
        halves[0] = min(halves[0], float(np.sqrt((ranges[:2] ** 2).sum())))
        reach = np.array([0.0, 0.0, 0.0])
        if kind != "sphere":
            cap = min(halves[0], ranges[2]) if kind == "capsule" else 0.0
            halves[1] = min(halves[1], max(ranges[2] - cap, 0.0))
            reach[2] = halves[1] + cap
    middle = np.clip(middle, low + np.minimum(reach, ranges), high - np.minimum(reach, ranges))
    return Guess(guess.rotation @ middle, guess.rotation, halves)


def _improved(
    kind: str,
    guess: Guess,
    points: Floats,
    steps: int,
    outer: Floats | None = None,
    *,
    turns: bool = True,
) -> tuple[float, Guess]:
    """Return the error and the shape after some steps of a search for the least squares.

    With outer corners it reaches no farther than they do.

    Source: K. Levenberg, A Method for the Solution of Certain Non-Linear Problems in Least Squares,
    1944; D. Marquardt, 1963.
    """
    free = [each for each in _FREE[kind] if turns or not 3 <= each < 6]
    width = 6 + _SIZES[kind]
    off = distances(kind, guess, points)
    error = float((off * off).sum())
    damping = 1e-3
    for _ in range(steps):
        slopes = np.empty((len(points), len(free)))
        for column, number in enumerate(free):
            step = np.zeros(width)
            step[number] = _STEP
            slopes[:, column] = (distances(kind, guess.changed(step), points) - off) / _STEP
        square, toward = slopes.T @ slopes, slopes.T @ off
        is_better = False
        while damping < 1e6:
            damped = square + damping * np.diag(np.maximum(np.diag(square), 1e-9))
            step = np.zeros(width)
            step[free] = -np.linalg.solve(damped, toward)
            changed = guess.changed(step)
            if outer is not None:
                changed = _bounded(kind, changed, outer)
            tried = distances(kind, changed, points)
            least = float((tried * tried).sum())
            if least < error:
                is_better = True
                break
            damping *= 4
        if not is_better:
            break
        gain = error - least
        guess, off, error = changed, tried, least
        damping = max(damping / 8, 1e-9)
        if gain < 1e-13 * error + 1e-24:
            break
    return float((error / len(points)) ** 0.5), guess


def _straightened(kind: str, guess: Guess) -> Guess:
    """Return a shape turned so that it lies along the axes of the mesh."""
    guess = _canonical(kind, guess)
    rotation: Floats = np.eye(3)
    if kind != "box":
        axis = np.round(abs(guess.rotation[:, 2]), 6)
        rotation = _frame_along(np.eye(3)[int(np.argmax(axis))])
    return Guess(guess.center, rotation, guess.halves)


# --- what contains the mesh ---------------------------------------------------------------------


def _smallest(body: _Body, kind: str) -> Guess:
    """Return a shape of small volume around the outer corners of a mesh."""
    outer = body.outer
    if kind == "sphere":
        center, radius = smallest_ball(outer)
        return Guess(center, np.eye(3), np.array([radius]))
    around = _AROUND[kind]
    if kind == "box":
        begun = [
            (around(outer, each)[0], index, each) for index, each in enumerate(body.rotations())
        ]
    else:
        frames = [_frame_along(axis) for axis in body.axes()]
        begun = [(around(outer, each)[0], index, each) for index, each in enumerate(frames)]
    volume, guess = around(outer, begun[0][2])
    for _, _, rotation in sorted(begun, key=lambda each: each[:2])[:4]:
        least, found = _searched(around, outer, rotation, 3 if kind == "box" else 2)
        if least < volume * (1 - PREFERS_AXES):
            volume, guess = least, found
    for axis in np.eye(3)[::-1]:  # the mesh's own axes, where they are as good
        rotation = np.eye(3) if kind == "box" else _frame_along(axis)
        least, found = around(outer, rotation)
        if least <= volume * (1 + PREFERS_AXES):
            return found
    return guess


def _searched(
    around: Callable[[Floats, Floats], tuple[float, Guess]],
    outer: Floats,
    rotation: Floats,
    turns: int,
) -> tuple[float, Guess]:
    """Return the least volume that small turns lead to, with its shape."""
    volume, guess = around(outer, rotation)
    reach = 0.15
    while reach > 2e-4:
        has_moved = False
        for axis in range(turns):
            for sign in (reach, -reach):
                by = np.zeros(3)
                by[axis] = sign
                least, found = around(outer, _turned(guess.rotation, by))
                if least < volume * (1 - 1e-9):
                    volume, guess, has_moved = least, found, True
                    break
        if not has_moved:
            reach /= 2
    return volume, guess


def _box_around(points: Floats, rotation: Floats) -> tuple[float, Guess]:
    local = points @ rotation
    low, high = local.min(axis=0), local.max(axis=0)
    halves = np.maximum((high - low) / 2, THINNEST / 2)
    return float(8 * halves.prod()), Guess(rotation @ ((low + high) / 2), rotation, halves)


def _cylinder_around(points: Floats, rotation: Floats) -> tuple[float, Guess]:
    local = points @ rotation
    center, radius = smallest_ball(local[:, :2])
    low, high = float(local[:, 2].min()), float(local[:, 2].max())
    half = max((high - low) / 2, THINNEST / 2)
    middle = np.array([*center, (low + high) / 2])
    return pi * radius * radius * 2 * half, Guess(
        rotation @ middle, rotation, np.array([max(radius, THINNEST), half])
    )


def _capsule_around(points: Floats, rotation: Floats) -> tuple[float, Guess]:
    """A larger radius than that of the narrowest one may make it shorter by more."""
    local = points @ rotation
    center, least = smallest_ball(local[:, :2])
    least = max(least, THINNEST)
    across = ((local[:, :2] - center) ** 2).sum(axis=1)
    z = local[:, 2]

    def sized(radius: float) -> tuple[float, float, float]:
        depth = np.sqrt(np.maximum(radius * radius - across, 0))
        top, bottom = float((z - depth).max()), float((z + depth).min())
        length = max(top - bottom, 0.0)
        return pi * radius * radius * (length + 4 / 3 * radius), length, (top + bottom) / 2

    radii = [least * (1 + 0.02 * index) for index in range(26)]
    best = min(range(len(radii)), key=lambda index: sized(radii[index])[0])
    volume, length, height = sized(radii[best])
    middle = np.array([*center, height])
    return volume, Guess(rotation @ middle, rotation, np.array([radii[best], length / 2]))


_AROUND: dict[str, Callable[[Floats, Floats], tuple[float, Guess]]] = {
    "box": _box_around,
    "cylinder": _cylinder_around,
    "capsule": _capsule_around,
}


def smallest_ball(points: Floats) -> tuple[Floats, float]:
    """Return the center and the radius of the smallest circle or sphere around points.

    The point that is farthest out joins those that hold the ball, and of these the ones are kept
    that are needed; the radius grows with each step, so that none comes twice.

    Source: B. Gärtner, Fast and Robust Smallest Enclosing Balls, ESA 1999.
    """
    low = int(np.argmin(points[:, 0]))
    apart = ((points - points[low]) ** 2).sum(axis=1)
    support = [low, int(np.argmax(apart))]
    center, radius = _ball_of(points[support])
    for _ in range(100):
        apart = np.sqrt(((points - center) ** 2).sum(axis=1))
        farthest = int(np.argmax(apart))
        if apart[farthest] <= radius * (1 + 1e-10) + 1e-15:
            break
        support.append(farthest)
        center, radius, support = _smallest_of(points, support)
    return center, float(np.sqrt(((points - center) ** 2).sum(axis=1).max()))


def _smallest_of(points: Floats, support: Sequence[int]) -> tuple[Floats, float, list[int]]:
    """Return the smallest ball around a few points, and those of them on its surface.

    The last point is on it, as it was outside of the smallest ball around the others.
    """
    from itertools import combinations

    some = points[list(support)]
    best: tuple[Floats, float, list[int]] | None = None
    last = len(support) - 1
    for count in range(1, points.shape[1] + 1):
        for others in combinations(range(last), count):
            chosen = (*others, last)
            center, radius = _ball_of(some[list(chosen)])
            holds = np.sqrt(((some - center) ** 2).sum(axis=1).max()) <= radius * (1 + 1e-9) + 1e-14
            if holds and (best is None or radius < best[1]):
                best = center, radius, [support[each] for each in chosen]
    if best is None:
        center = (some.min(axis=0) + some.max(axis=0)) / 2
        return center, float(np.sqrt(((some - center) ** 2).sum(axis=1).max())), list(support)[-4:]
    return best


def _ball_of(points: Floats) -> tuple[Floats, float]:
    """Return the smallest ball with points on its surface, in the space that they span."""
    first, sides = points[0], points[1:] - points[0]
    square = 2 * sides @ sides.T
    lengths = (sides * sides).sum(axis=1)
    parts = np.linalg.lstsq(square, lengths, rcond=1e-12)[0]
    offset = parts @ sides
    return first + offset, float(np.sqrt((offset * offset).sum()))


# --- the result in metres -----------------------------------------------------------------------


def _decimals(size: float) -> int:
    """Return how many decimals lengths have for a mesh of a size."""
    return DIGITS - floor(log10(size))


def _canonical(kind: str, guess: Guess) -> Guess:
    """Return the same shape with its axes named in one of the ways that there are.

    Those of a box are the nearest to the axes of the mesh, and that of a cylinder or capsule points
    along an axis of the mesh rather than against it.
    """
    if kind == "sphere":
        return guess
    if kind != "box":
        axis = guess.rotation[:, 2]
        largest = int(np.argmax(np.round(abs(axis), 6)))
        rotation = _frame_along(axis if axis[largest] > 0 else -axis)
        return Guess(guess.center, rotation, guess.halves)
    from itertools import permutations, product

    best: tuple[float, Guess] | None = None
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            rotation = guess.rotation[:, list(order)] * np.array(signs)
            if np.linalg.det(rotation) < 0:
                continue
            nearness = float(np.round(np.trace(rotation), 6))
            if best is None or nearness > best[0]:
                best = nearness, Guess(guess.center, rotation, guess.halves[list(order)])
    assert best is not None
    return best[1]


def _angles(kind: str, rotation: Floats) -> Vector:
    """Return roll, pitch and yaw, rounded; right angles are exact."""
    if kind == "sphere":
        return (0.0, 0.0, 0.0)
    a, b, c = ((float(row[0]), float(row[1]), float(row[2])) for row in rotation)
    roll, pitch, yaw = map(_angle, rpy_from_rotation((a, b, c)))
    return (roll, pitch, yaw)


def _angle(angle: float) -> float:
    quarters = round(angle / (pi / 2))
    if abs(angle - quarters * pi / 2) < 10**-ANGLE_DIGITS:
        return round(quarters * pi / 2, 13) + 0.0
    return round(angle, ANGLE_DIGITS) + 0.0


def _rounded(kind: str, guess: Guess, frame: _Frame) -> Placed:
    """Return a shape in metres."""
    guess = _canonical(kind, guess)
    decimals = _decimals(frame.size)
    lengths = [
        round(max(each, THINNEST) * frame.size, decimals) for each in _lengths(kind, guess.halves)
    ]
    xyz = _rounded_point(frame.center + guess.center * frame.size, decimals)
    return Placed(SIMPLE_SHAPES[kind](*lengths), xyz, _angles(kind, guess.rotation))


def _lengths(kind: str, halves: Floats) -> list[float]:
    """Return the sizes of a shape: the sides; radius and length; radius."""
    first, *others = (float(each) for each in halves)
    return [2 * first if kind == "box" else first, *(2 * each for each in others)]


def _rounded_point(point: Floats, decimals: int) -> Vector:
    x, y, z = (round(float(each), decimals) + 0.0 for each in point)
    return (x, y, z)


def _containing(kind: str, guess: Guess, points: Floats, frame: _Frame) -> Placed:
    """Return a shape in metres that contains all corners where its pose is rounded.

    Args:
        kind: which shape.
        guess: gives its axes, and the radius of a capsule.
        points: the corners, in metres.
        frame: that of the guess.
    """
    guess = _canonical(kind, guess)
    decimals = _decimals(frame.size)
    rpy = _angles(kind, guess.rotation)
    rotation = np.array(rotation_from_rpy(*rpy))
    slack = SLACK * frame.size + 1e-13 * float(abs(points).max())
    least = THINNEST * frame.size

    def up(length: float) -> float:
        steps = ceil((max(length, least) + slack) * 10.0**decimals)
        return round(steps / 10.0**decimals, decimals)

    local = points @ rotation
    low, high = local.min(axis=0), local.max(axis=0)
    middle = (low + high) / 2
    wide = 0.0
    if kind == "sphere":
        middle = smallest_ball(local)[0]
    elif kind != "box":
        middle[:2] = smallest_ball(local[:, :2])[0]
        if kind == "capsule":
            across = ((local[:, :2] - middle[:2]) ** 2).sum(axis=1)
            wide = max(float(guess.halves[0]) * frame.size, float(across.max()) ** 0.5)
            depth = np.sqrt(np.maximum(wide * wide - across, 0))
            middle[2] = ((local[:, 2] - depth).max() + (local[:, 2] + depth).min()) / 2
    xyz = _rounded_point(rotation @ middle, decimals)
    local = (points - np.array(xyz)) @ rotation
    far = abs(local).max(axis=0)
    if kind == "box":
        lengths = [up(2 * float(each)) for each in far]
    elif kind == "sphere":
        lengths = [up(float(np.sqrt((local * local).sum(axis=1)).max()))]
    else:
        across = (local[:, :2] ** 2).sum(axis=1)
        radius = up(max(float(across.max()) ** 0.5, wide))
        half = float(far[2])
        if kind == "capsule":
            depth = np.sqrt(np.maximum(radius * radius - across, 0))
            half = float((abs(local[:, 2]) - depth).max())
        lengths = [radius, up(2 * half)]
    return Placed(SIMPLE_SHAPES[kind](*lengths), xyz, rpy)
