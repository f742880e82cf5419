"""Boxes, cylinders, spheres and capsules: found again with noise, and around all corners."""

from __future__ import annotations

from math import dist, hypot, pi
from pathlib import Path
from random import Random

import pytest

from tests.fitting.solids import box, noisy
from yamaro.fitting.fit import Placed, Wanted, fitted, packed, unpacked
from yamaro.meshes.triangles import TriangleMesh, read_mesh
from yamaro.model.pose import Pose, rotate, rotation_from_rpy, transposed

ANGLE = Path(__file__).parents[1] / "cases" / "fitting" / "_meshes" / "angle.obj"
KINDS = ("box", "cylinder", "sphere", "capsule")
NOISE = 0.01


def sizes_of(kind: str, random: Random) -> list[float]:
    scale = 10 ** random.uniform(-2, 1)
    if kind == "box":
        return [random.uniform(0.2, 1) * scale for _ in range(3)]
    radius = random.uniform(0.1, 0.5) * scale
    return [radius] if kind == "sphere" else [radius, random.uniform(0.4, 2) * scale]


def beyond(piece: Placed, point: tuple[float, float, float]) -> float:
    """Return how far a point is outside of a shape, by the shape's definition."""
    x, y, z = (a - b for a, b in zip(point, piece.xyz, strict=True))
    x, y, z = rotate(transposed(rotation_from_rpy(*piece.rpy)), (x, y, z))
    size = piece.shape.size
    match piece.shape.kind:
        case "box":
            return max(abs(x) - size[0] / 2, abs(y) - size[1] / 2, abs(z) - size[2] / 2)
        case "sphere":
            return hypot(x, y, z) - size[0]
        case "cylinder":
            return max(hypot(x, y) - size[0], abs(z) - size[1] / 2)
        case _:
            return hypot(x, y, max(abs(z) - size[1] / 2, 0)) - size[0]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [1, 2])
def test_a_noisy_shape_comes_back_within_2_percent(kind: str, seed: int) -> None:
    size = sizes_of(kind, Random(seed * 7 + len(kind)))
    mesh, pose = noisy(kind, size, seed, NOISE)
    (piece,) = fitted(mesh, Wanted("fit", kind=kind)).pieces
    assert isinstance(piece, Placed)
    found = piece.shape.size
    if kind == "box":
        found, size = tuple(sorted(found)), sorted(size)
    assert found == pytest.approx(size, rel=0.02)
    assert dist(piece.xyz, pose.position) < 0.02 * max(size)
    if kind in ("cylinder", "capsule"):
        axis = Pose(rotation_from_rpy(*piece.rpy)).apply((0, 0, 1))
        wanted = rotate(pose.rotation, (0, 0, 1))
        assert abs(sum(a * b for a, b in zip(axis, wanted, strict=True))) > 0.999
    (best,) = fitted(mesh, Wanted("fit", kind="best")).pieces
    assert isinstance(best, Placed)
    assert best.shape.kind == kind


@pytest.mark.parametrize("kind", [*KINDS, "best"])
def test_what_covers_contains_every_corner_as_it_is_written(kind: str) -> None:
    mesh, _ = noisy("cylinder", [0.07, 0.31], 5, 0.05)
    fit = fitted(mesh, Wanted("fit", kind=kind, covers=True))
    (piece,) = unpacked(packed(fit)).pieces
    assert isinstance(piece, Placed)
    assert max(beyond(piece, vertex) for vertex in mesh.vertices) <= 0
    around = {
        "box": 0.14 * 0.14 * 0.31,
        "cylinder": pi * 0.07**2 * 0.31,
        "sphere": 4 / 3 * pi * hypot(0.07, 0.155) ** 3,
        "capsule": pi * 0.07**2 * (0.31 + 4 / 3 * 0.07),
        "best": pi * 0.07**2 * 0.31,
    }
    assert piece.shape.volume() < 1.35 * around[kind]  # the corners are off by 3.5 mm


@pytest.mark.parametrize("kind", KINDS)
def test_a_shape_reaches_no_farther_along_its_axes_than_the_mesh(kind: str) -> None:
    mesh = read_mesh(str(ANGLE))  # along its diagonal nothing says where a shape ends
    (piece,) = fitted(mesh, Wanted("fit", kind=kind)).pieces
    assert isinstance(piece, Placed)
    if kind == "sphere":
        assert piece.shape.size[0] <= hypot(0.4, 0.4, 0.1) / 2
        return
    local = Pose(rotation_from_rpy(*piece.rpy), piece.xyz).inverse()
    reach = [abs(local.apply(vertex)[2]) for vertex in mesh.vertices]
    size = piece.shape.size
    half = size[2] / 2 if kind == "box" else size[1] / 2 + (size[0] if kind == "capsule" else 0)
    assert half <= max(reach) + 1e-5


@pytest.mark.parametrize(("lost", "closes"), [(0.2, False), (0.6, False), (0.2, True)])
def test_a_capsule_with_its_end_cut_off_is_whole_again_only_where_the_mesh_shows_it(
    lost: float, closes: bool
) -> None:
    radius, length = 0.06, 0.08
    mesh, pose = noisy("capsule", [radius, length], 7, NOISE)
    local = [pose.inverse().apply(point) for point in mesh.vertices]
    end = length / 2 + (1 - lost) * radius
    if closes:
        mesh.vertices = [pose.apply((x, y, min(z, end))) for x, y, z in local]
    else:
        mesh.triangles = [
            each for each in mesh.triangles if max(local[corner][2] for corner in each) < end
        ]
    (piece,) = fitted(mesh, Wanted("fit", kind="capsule")).pieces
    assert isinstance(piece, Placed)
    if lost < 0.5 and not closes:
        assert piece.shape.size == pytest.approx((radius, length), rel=0.02)
        assert dist(piece.xyz, pose.position) < 0.02 * length
    else:
        inside = Pose(rotation_from_rpy(*piece.rpy), piece.xyz).inverse()
        used = {mesh.vertices[corner] for each in mesh.triangles for corner in each}
        heights = [inside.apply(point)[2] for point in used]
        half = piece.shape.size[1] / 2 + piece.shape.size[0]
        assert -half == pytest.approx(min(heights), abs=0.02 * radius)
        assert half == pytest.approx(max(heights), abs=0.02 * radius)


def test_the_best_around_a_screw_of_half_a_millimetre_has_the_least_volume() -> None:
    radius, length = 2.5e-5, 5e-4
    mesh, _ = noisy("cylinder", [radius, length], 4, 0.0)
    (piece,) = fitted(mesh, Wanted("fit", kind="best", covers=True)).pieces
    assert isinstance(piece, Placed)
    assert piece.shape.volume() < 1.2 * pi * radius**2 * length


def test_a_shape_is_the_same_from_the_cache_and_along_the_axes_of_its_mesh() -> None:
    mesh, _ = noisy("capsule", [0.05, 0.3], 3, 0.0)
    local = mesh.vertices
    one, other = (packed(fitted(mesh, Wanted("fit", kind="capsule"))) for _ in range(2))
    assert one == other == packed(unpacked(one))
    straight, pose = noisy("box", [0.4, 0.3, 0.2], 3, 0.0)
    straight.vertices = [pose.inverse().apply(point) for point in straight.vertices]
    (piece,) = fitted(straight, Wanted("fit", kind="box")).pieces
    assert isinstance(piece, Placed)
    assert (piece.xyz, piece.rpy) == ((0, 0, 0), (0, 0, 0))
    assert piece.shape.size == (0.4, 0.3, 0.2)
    assert local is mesh.vertices


def test_what_is_inside_of_a_housing_does_not_move_its_fit_or_count_as_distance() -> None:
    points, faces = box([1, 0.6, 0.4])
    inner, more = box([0.3, 0.2, 0.2])
    places = [(x + 0.3, y + 0.1, z) for x, y, z in inner]
    start = len(points)
    faces += [(i + start, j + start, k + start) for i, j, k in more]
    fit = fitted(TriangleMesh([*points, *places], faces), Wanted("fit", kind="box"))
    (piece,) = fit.pieces
    assert isinstance(piece, Placed)
    assert piece.shape.size == pytest.approx((1, 0.6, 0.4), abs=1e-4)
    assert fit.distance < 1e-4


def test_a_ball_of_triangles_is_a_sphere() -> None:
    mesh, _ = noisy("sphere", [0.3], 2, 0.0)
    (piece,) = fitted(mesh, Wanted("fit", kind="best")).pieces
    assert isinstance(piece, Placed)
    assert piece.shape.kind == "sphere"
