"""Meshes of simple shapes at random poses, with noise, made by numbers alone."""

from __future__ import annotations

from math import cos, pi, sin
from random import Random
from typing import TYPE_CHECKING

from yamaro.meshes.triangles import TriangleMesh
from yamaro.model.pose import Pose, rotation_from_rpy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from yamaro.model.pose import Vector

Faces = list[tuple[int, int, int]]
STEPS = 24


def box(size: Sequence[float]) -> tuple[list[Vector], Faces]:
    """Return a box whose sides are grids."""
    points: list[Vector] = []
    faces: Faces = []
    steps = 6
    for axis in range(3):
        for end in (-0.5, 0.5):
            start = len(points)
            for i in range(steps + 1):
                for j in range(steps + 1):
                    u, v = i / steps - 0.5, j / steps - 0.5
                    place = [0.0, 0.0, 0.0]
                    place[axis] = end * size[axis]
                    place[(axis + 1) % 3] = u * size[(axis + 1) % 3]
                    place[(axis + 2) % 3] = v * size[(axis + 2) % 3]
                    points.append((place[0], place[1], place[2]))
            faces += _grid(start, steps, steps + 1, flips=end < 0)
    return points, faces


def _grid(start: int, rows: int, width: int, *, flips: bool) -> Faces:
    faces: Faces = []
    for i in range(rows):
        for j in range(width - 1):
            a, b = start + i * width + j, start + (i + 1) * width + j
            for one, two, three in ((a, b, b + 1), (a, b + 1, a + 1)):
                faces.append((one, three, two) if flips else (one, two, three))
    return faces


def turned(profile: Sequence[tuple[float, float]]) -> tuple[list[Vector], Faces]:
    """Return the surface that a profile of radius and height makes about z, from bottom to top."""
    points: list[Vector] = []
    for radius, z in profile:
        for step in range(STEPS + 1):
            angle = 2 * pi * step / STEPS
            points.append((radius * cos(angle), radius * sin(angle), z))
    return points, _grid(0, len(profile) - 1, STEPS + 1, flips=True)


def profile_of(kind: str, size: Sequence[float]) -> list[tuple[float, float]]:
    """Return the profile of a sphere, cylinder or capsule."""
    radius = size[0]
    if kind == "cylinder":
        half = size[1] / 2
        rows = [radius * step / 4 for step in range(5)]
        sides = [(radius, half * (step / 4 - 1)) for step in range(1, 8)]
        return [*[(r, -half) for r in rows], *sides, *[(r, half) for r in reversed(rows)]]
    half = size[1] / 2 if kind == "capsule" else 0.0
    turn = [pi * step / 32 for step in range(17)]
    low = [(radius * sin(t), -half - radius * cos(t)) for t in turn]
    high = [(radius * cos(t), half + radius * sin(t)) for t in turn]
    middle = [(radius, half * (step / 4 - 1)) for step in range(1, 8)] if half else []
    return [*low, *middle, *high]


def noisy(kind: str, size: Sequence[float], seed: int, noise: float) -> tuple[TriangleMesh, Pose]:
    """Return a shape at a random pose, whose corners are off by a part of its least size."""
    random = Random(seed)
    points, faces = box(size) if kind == "box" else turned(profile_of(kind, size))
    rpy = (random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3))
    far = 2 * max(size)
    place = (random.uniform(-far, far), random.uniform(-far, far), random.uniform(-far, far))
    pose = Pose(rotation_from_rpy(*rpy), place)
    off = noise * min(size)
    vertices = []
    for point in points:
        x, y, z = pose.apply(point)
        vertices.append(
            (x + random.gauss(0, off), y + random.gauss(0, off), z + random.gauss(0, off))
        )
    return TriangleMesh(vertices, faces), pose
