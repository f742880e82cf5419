"""Inertias are those of a body, and agree with trimesh's volume integral of the same shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.later import Later
from yamaro.meshes.triangles import TriangleMesh, is_closed, read_mesh
from yamaro.model.inertia import solid_moments
from yamaro.model.shapes import Box, Capsule, Cylinder, MeshSolid, Sphere

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

sizes = st.floats(1e-4, 100)
masses = st.floats(1e-6, 1e5)
shapes = st.one_of(
    st.builds(Box, sizes, sizes, sizes),
    st.builds(Cylinder, sizes, sizes),
    st.builds(Sphere, sizes),
    st.builds(Capsule, sizes, sizes),
)
moderate = st.floats(0.1, 10)
factors = st.one_of(st.floats(0.1, 10), st.floats(-10, -0.1))
scales = st.tuples(factors, factors, factors)


def matrix(inertia):
    ixx, ixy, ixz, iyy, iyz, izz = inertia
    return numpy.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])


def assert_physical(inertia):
    """Principal moments are positive, and none is larger than the sum of the two others."""
    a, b, c = sorted(numpy.linalg.eigvalsh(matrix(inertia)))
    assert a > 0
    assert a + b >= c * (1 - 1e-9)


def ours(mesh):
    corners = [tuple(vertex) for vertex in mesh.vertices.tolist()]
    return TriangleMesh(corners, [tuple(face) for face in mesh.faces.tolist()])


def assert_agrees(shape, mesh, *, mass, tolerance):
    """Compare a shape with trimesh's integral of a mesh of it, as seen from the origin's axes."""
    mesh.density = 1.0
    expected = mesh.moment_inertia * mass / mesh.volume
    found = matrix(shape.inertia(mass))
    scale = numpy.trace(expected)
    numpy.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * scale)
    assert shape.volume() == pytest.approx(mesh.volume, rel=tolerance)
    size = float(max(mesh.extents))
    numpy.testing.assert_allclose(shape.center(), mesh.center_mass, rtol=0, atol=tolerance * size)


@given(shapes, masses)
def test_every_shape_has_a_physical_inertia(shape, mass):
    assert_physical(shape.inertia(mass))


@given(shapes, masses)
def test_inertia_is_proportional_to_mass(shape, mass):
    assert shape.inertia(2 * mass) == pytest.approx([2 * i for i in shape.inertia(mass)])


@given(moderate, moderate, moderate, masses)
def test_a_box_agrees_with_its_mesh(x, y, z, mass):
    assert_agrees(Box(x, y, z), trimesh.creation.box((x, y, z)), mass=mass, tolerance=1e-12)


@settings(max_examples=20)
@given(moderate, moderate, masses)
def test_a_cylinder_agrees_with_its_mesh(radius, length, mass):
    mesh = trimesh.creation.cylinder(radius=radius, height=length, sections=1000)
    assert_agrees(Cylinder(radius, length), mesh, mass=mass, tolerance=2e-5)


@settings(max_examples=20)
@given(moderate, masses)
def test_a_sphere_agrees_with_its_mesh(radius, mass):
    mesh = trimesh.creation.icosphere(subdivisions=4, radius=radius)
    assert_agrees(Sphere(radius), mesh, mass=mass, tolerance=5e-3)


@settings(max_examples=20)
@given(moderate, moderate, masses)
def test_a_capsule_agrees_with_its_mesh(radius, length, mass):
    mesh = trimesh.creation.capsule(height=length, radius=radius, count=[200, 200])
    mesh.apply_translation(-mesh.bounds.mean(axis=0))
    assert_agrees(Capsule(radius, length), mesh, mass=mass, tolerance=1e-3)


@given(moderate, masses)
def test_a_very_short_capsule_is_nearly_a_sphere(radius, mass):
    found = Capsule(radius, 1e-9 * radius).inertia(mass)
    assert found == pytest.approx(Sphere(radius).inertia(mass), rel=1e-6)


@given(moderate, masses)
def test_a_very_long_capsule_is_nearly_a_cylinder(radius, mass):
    found = Capsule(radius, 1e9 * radius).inertia(mass)
    assert found == pytest.approx(Cylinder(radius, 1e9 * radius).inertia(mass), rel=1e-6)


# --- meshes -----------------------------------------------------------------------------------

jitter = st.tuples(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))


def hull_of(shifts):
    """Return the convex hull of a cube's corners, each shifted, as trimesh has it."""
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    hull = trimesh.PointCloud(numpy.add(corners, shifts)).convex_hull
    assert hull.is_watertight
    assert hull.volume > 0.1
    return hull


hulls = st.builds(hull_of, st.lists(jitter, min_size=8, max_size=8))


@given(hulls, scales, masses, st.tuples(moderate, moderate, moderate))
def test_any_mesh_agrees_with_trimesh_scaled_and_mirrored(hull, scale, mass, offset):
    hull = hull.copy()
    hull.apply_translation(offset)
    mesh = ours(hull)
    assert is_closed(mesh)
    shape = MeshSolid(solid_moments(mesh).scaled(scale))
    # trimesh turns the triangles of a mirrored mesh itself, so that its volume stays positive.
    stretched = hull.copy()
    stretched.apply_transform(numpy.diag([*scale, 1.0]))
    assert stretched.volume > 0
    assert_agrees(shape, stretched, mass=mass, tolerance=1e-7)
    assert_physical(shape.inertia(mass))


@given(moderate, moderate, moderate, masses)
def test_a_mesh_of_a_box_has_the_inertia_of_the_box(x, y, z, mass):
    shape = MeshSolid(solid_moments(ours(trimesh.creation.box((x, y, z)))))
    expected = Box(x, y, z).inertia(mass)
    assert shape.inertia(mass) == pytest.approx(expected, rel=1e-12)


@given(st.tuples(moderate, moderate, moderate))
def test_moving_a_mesh_moves_only_its_center(offset):
    box = trimesh.creation.box((1, 2, 3))
    moved = box.copy()
    moved.apply_translation(offset)
    still, away = (MeshSolid(solid_moments(ours(mesh))) for mesh in (box, moved))
    assert away.center() == pytest.approx(offset, rel=1e-12)
    assert away.inertia(1.0) == pytest.approx(still.inertia(1.0), rel=1e-9, abs=1e-9)


@given(hulls)
def test_an_inside_out_mesh_is_the_same_body(hull):
    mesh = ours(hull)
    turned = TriangleMesh(mesh.vertices, [(k, j, i) for i, j, k in mesh.triangles])
    first, second = solid_moments(mesh), solid_moments(turned)
    assert second.volume == pytest.approx(first.volume)
    assert second.second == pytest.approx(first.second)
    assert is_closed(turned)


@given(hulls, st.integers(0, 1000))
def test_a_mesh_without_one_of_its_triangles_is_not_closed(hull, pick):
    mesh = ours(hull)
    triangles = list(mesh.triangles)
    del triangles[pick % len(triangles)]
    assert not is_closed(TriangleMesh(mesh.vertices, triangles))


@settings(max_examples=25)
@given(hull=hulls, file_type=st.sampled_from(["stl", "stl_ascii", "obj", "ply", "glb"]))
def test_every_format_is_read_as_trimesh_reads_it(hull, file_type, tmp_path_factory):
    ending = "stl" if file_type == "stl_ascii" else file_type
    path = tmp_path_factory.mktemp("mesh") / f"hull.{ending}"
    data = hull.export(file_type=file_type)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    expected = trimesh.load_mesh(path)
    mesh = read_mesh(str(path))
    assert is_closed(mesh)
    assert_agrees(MeshSolid(solid_moments(mesh)), expected, mass=1.0, tolerance=1e-6)
