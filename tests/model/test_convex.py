"""Convex shapes: what overlaps, against coal; how far they reach."""

from __future__ import annotations

import random
from typing import Any

import numpy as np

from tests.consumers.oracles import require_module
from yamaro.model.convex import SHRUNK, Convex, near, outer_points, overlap
from yamaro.model.pose import IDENTITY, UNTURNED, Pose, rotation_from_rpy
from yamaro.model.shapes import Box, Capsule, Cylinder, Sphere

NOISE = 1e-6


def some_shape(rng: random.Random, coal: Any) -> tuple[Convex, Any, Any]:
    """Return a shape at a random pose, and what coal makes of it, shrunk alike."""
    turn = rotation_from_rpy(*(rng.uniform(-3, 3) for _ in range(3)))
    x, y, z = (rng.uniform(-0.4, 0.4) for _ in range(3))
    pose = Pose(turn, (x, y, z))
    a, b, c = (rng.uniform(0.05, 0.5) for _ in range(3))
    s = SHRUNK
    points: list[tuple[float, float, float]] = []
    kind = rng.randrange(5)
    shape: Any = None
    if kind == 0:
        shape, other = Box(a, b, c), coal.Box(a * s, b * s, c * s)
    elif kind == 1:
        shape, other = Cylinder(a / 2, b), coal.Cylinder(a / 2 * s, b * s)
    elif kind == 2:
        shape, other = Sphere(a / 2), coal.Sphere(a / 2 * s)
    elif kind == 3:
        shape, other = Capsule(a / 2, b), coal.Capsule(a / 2 * s, b * s)
    else:
        count = rng.choice((8, 60))
        points = [(rng.gauss(0, a / 3), rng.gauss(0, b / 3), rng.gauss(0, 0.1))
                  for _ in range(count)]  # fmt: skip
        corners = np.array(points)
        middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
        vector = coal.StdVec_Vec3s()
        for corner in (corners - middle) * s + middle:
            vector.append(corner)
        other = coal.Convex.convexHull(vector, False, "")
    place = coal.Transform3s(np.array(pose.rotation), np.array(pose.position))
    return Convex(pose, shape, points), other, place


def test_what_overlaps_is_what_coal_finds() -> None:
    coal = require_module("coal")
    rng = random.Random(7)
    counts = {True: 0, False: 0}
    for _ in range(1500):
        first, one, T_one = some_shape(rng, coal)
        second, two, T_two = some_shape(rng, coal)
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        request.enable_signed_distance = True
        distance = coal.distance(one, T_one, two, T_two, request, result)
        if abs(distance) > NOISE:
            found = overlap(first, second)
            assert found == (distance < 0), (first, second, distance)
            counts[found] += 1
            if found:
                assert list(near([first, second])) == [(0, 1)]
    assert min(counts.values()) > 200


def test_shapes_that_touch_do_not_overlap() -> None:
    box = Box(1, 1, 1)
    for gap, is_one in ((0, False), (0.0005, False), (0.01, True)):
        first = Convex(IDENTITY, box)
        second = Convex(Pose(UNTURNED, (0.3, 0.2, 1 - gap)), box)
        assert overlap(first, second) == is_one, gap
    ball = Sphere(0.5)
    assert not overlap(Convex(IDENTITY, ball), Convex(Pose(UNTURNED, (1, 0, 0)), ball))
    assert overlap(Convex(IDENTITY, ball), Convex(IDENTITY, box))  # at one place


def test_few_points_reach_nearly_as_far_as_all() -> None:
    """Also those of a long rod, whose ends are seen at small angles from its middle."""
    rng = np.random.default_rng(3)
    angles = rng.uniform(0, 2 * np.pi, 20_000)
    rod = np.stack([np.cos(angles), np.sin(angles), rng.choice([-1, 1], 20_000)], axis=1)
    for size in ((0.01, 0.01, 1.0), (0.2, 0.1, 0.3)):
        points = rod * size
        few = np.array(outer_points(map(tuple, points.tolist())))
        assert len(few) < 2_000
        ways = rng.normal(size=(200, 3)) / size
        reach = (points @ ways.T).max(axis=0)
        assert ((few @ ways.T).max(axis=0) >= 0.98 * reach).all()


def test_each_shape_is_within_its_radius_and_near_only_those_it_may_touch() -> None:
    coal = require_module("coal")
    rng = random.Random(5)
    shapes = [some_shape(rng, coal)[0] for _ in range(40)]
    for shape in shapes:
        for _ in range(20):
            x, y, z = (rng.gauss(0, 1) for _ in range(3))
            way = np.array(shape.farthest((x, y, z))) - shape.center
            assert np.linalg.norm(way) <= shape.radius + 1e-12
    wanted = {
        (i, j)
        for i, one in enumerate(shapes)
        for j, two in enumerate(shapes[:i])
        if np.linalg.norm(np.subtract(one.center, two.center)) < one.radius + two.radius
    }
    assert {(max(pair), min(pair)) for pair in near(shapes)} == wanted
