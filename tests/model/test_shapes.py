"""Volumes and inertias worked by hand, and the readers of mesh files."""

from __future__ import annotations

import struct
from math import pi
from typing import TYPE_CHECKING

import pytest

from tests.later import Later
from yamaro.meshes.formats import MeshFileError, MissingLibraryError, mesh_ending
from yamaro.meshes.triangles import TriangleMesh, is_closed, read_mesh
from yamaro.model.inertia import solid_moments
from yamaro.model.shapes import Box, Capsule, Cylinder, MeshSolid, Sphere

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

CUBE = TriangleMesh(
    [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)],
    # Corner 4x + 2y + z; counterclockwise as seen from outside.
    [
        *((0, 1, 3), (0, 3, 2)),  # x = 0
        *((4, 6, 7), (4, 7, 5)),  # x = 1
        *((0, 4, 5), (0, 5, 1)),  # y = 0
        *((2, 3, 7), (2, 7, 6)),  # y = 1
        *((0, 2, 6), (0, 6, 4)),  # z = 0
        *((1, 5, 7), (1, 7, 3)),  # z = 1
    ],
)


def test_a_box():
    # 12 kg, 1 × 2 × 3 m: m/12·(y² + z²) = 13, 10, 5.
    assert Box(1, 2, 3).inertia(12) == pytest.approx((13, 0, 0, 10, 0, 5))
    assert Box(1, 2, 3).volume() == 6


def test_a_cylinder():
    # 12 kg, r = 1, l = 3: 3·1 + 9 = 12 across, 12/2 = 6 along.
    assert Cylinder(1, 3).inertia(12) == pytest.approx((12, 0, 0, 12, 0, 6))
    assert Cylinder(1, 3).volume() == pytest.approx(3 * pi)


def test_a_sphere():
    assert Sphere(0.5).inertia(10) == pytest.approx((1, 0, 0, 1, 0, 1))
    assert Sphere(3).volume() == pytest.approx(36 * pi)


def test_a_capsule():
    # r = 1, l = 4, density 3/π: the cylinder has 12 kg, each half sphere 2 kg.
    # Along: 12/2 + 2/5·4 = 7.6. Across: 12/12·(3 + 16) + 4·(2/5 + 16/4 + 3/8·4) = 42.6.
    capsule = Capsule(1, 4)
    assert capsule.volume() * 3 / pi == pytest.approx(16)
    assert capsule.inertia(16) == pytest.approx((42.6, 0, 0, 42.6, 0, 7.6))


def test_products_of_inertia_of_simple_shapes_are_exactly_zero():
    for shape in (Box(1, 2, 3), Cylinder(1, 2), Sphere(1), Capsule(1, 2)):
        _, ixy, ixz, _, iyz, _ = shape.inertia(1.7)
        assert (ixy, ixz, iyz) == (0, 0, 0)
        assert shape.center() == (0, 0, 0)


def test_the_unit_cube_as_a_mesh():
    moments = solid_moments(CUBE)
    # ∫x = 1/2, ∫x² = 1/3, ∫xy = 1/4 over [0, 1]³.
    assert moments.volume == pytest.approx(1)
    assert moments.first == pytest.approx((1 / 2,) * 3)
    assert moments.second == pytest.approx((1 / 3, 1 / 4, 1 / 4, 1 / 3, 1 / 4, 1 / 3))
    cube = MeshSolid(moments)
    assert cube.center() == pytest.approx((1 / 2,) * 3)
    assert cube.inertia(6) == pytest.approx((1, 0, 0, 1, 0, 1))
    assert cube.inertia(6)[1] == 0


def test_a_tetrahedron_has_products_of_inertia():
    # Corners at 0, x, y, z: ∫xy dV = 1/120, V = 1/6, centre 1/4: about it 1/120 − 1/96 = −1/480.
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    mesh = TriangleMesh(corners, [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    shape = MeshSolid(solid_moments(mesh))
    assert shape.volume() == pytest.approx(1 / 6)
    # Density 1: ixy = −∫xy = 1/480; ∫x² about the centre = 1/60 − 1/96 = 1/160, ixx = 2/160.
    assert shape.inertia(1 / 6) == pytest.approx(
        (1 / 80, 1 / 480, 1 / 480, 1 / 80, 1 / 480, 1 / 80)
    )


def test_scaling_stretches_and_mirrors_a_mesh():
    shape = MeshSolid(solid_moments(CUBE).scaled((-1.0, 2.0, 3.0)))
    assert shape.volume() == pytest.approx(6)
    assert shape.center() == pytest.approx((-0.5, 1.0, 1.5))
    assert shape.inertia(12) == pytest.approx(Box(1, 2, 3).inertia(12))


def test_a_mesh_far_from_the_origin_keeps_its_digits():
    far = TriangleMesh([(x + 1e4, y, z) for x, y, z in CUBE.vertices], CUBE.triangles)
    assert MeshSolid(solid_moments(far)).inertia(6) == pytest.approx((1, 0, 0, 1, 0, 1), rel=1e-6)


def test_a_closed_surface_has_every_edge_both_ways():
    assert is_closed(CUBE)
    assert not is_closed(TriangleMesh(CUBE.vertices, CUBE.triangles[1:]))
    one_turned = [(0, 3, 1), *CUBE.triangles[1:]]
    assert not is_closed(TriangleMesh(CUBE.vertices, one_turned))


def test_a_triangle_without_area_does_not_open_a_surface():
    assert is_closed(TriangleMesh(CUBE.vertices, [*CUBE.triangles, (0, 0, 5)]))


# --- reading ----------------------------------------------------------------------------------


def write_obj(path, mesh=CUBE, *, faces=None):
    lines = [f"v {x} {y} {z}" for x, y, z in mesh.vertices]
    lines += faces or [f"f {i + 1} {j + 1} {k + 1}" for i, j, k in mesh.triangles]
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def binary_stl(mesh=CUBE, *, header=b"made by hand"):
    facets = [
        struct.pack("<12fH", 0, 0, 0, *(c for index in face for c in mesh.vertices[index]), 0)
        for face in mesh.triangles
    ]
    return header.ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def assert_is_unit_cube(mesh):
    assert is_closed(mesh)
    assert len(mesh.vertices) == 8
    assert solid_moments(mesh).first == pytest.approx((0.5, 0.5, 0.5))


def test_the_ending_of_a_file():
    assert mesh_ending("package://arm.v2/meshes/Base.STL") == "stl"
    assert mesh_ending("C:\\meshes\\a.Dae") == "dae"
    assert mesh_ending("package://arm.stl/base") == ""
    assert mesh_ending("box") == ""


def test_reading_a_binary_stl(tmp_path):
    path = tmp_path / "cube.stl"
    path.write_bytes(binary_stl())
    assert_is_unit_cube(read_mesh(str(path)))


def test_a_binary_stl_whose_header_says_solid(tmp_path):
    path = tmp_path / "cube.STL"
    path.write_bytes(binary_stl(header=b"solid made by a careless program"))
    assert_is_unit_cube(read_mesh(str(path)))


def test_reading_an_ascii_stl(tmp_path):
    lines = ["solid cube"]
    for face in CUBE.triangles:
        corners = ["vertex {:e} {:e} {:e}".format(*CUBE.vertices[index]) for index in face]
        lines += ["facet normal 0 0 0", "outer loop", *corners, "endloop", "endfacet"]
    path = tmp_path / "cube.stl"
    path.write_text("\n".join([*lines, "endsolid cube"]))
    assert_is_unit_cube(read_mesh(str(path)))


def test_reading_an_obj_with_polygons_slashes_and_negative_numbers(tmp_path):
    quads = ["f 1 2 4 3", "f 5/1/1 7/1/1 8/1/1 6/1/1", "f 1//1 5//1 6//1 2//1"]
    quads += ["f -6 -5 -1 -2", "f 1 3 \\\n7 5", "f 2 6 8 4 # the top"]
    assert_is_unit_cube(read_mesh(write_obj(tmp_path / "cube.obj", faces=quads)))


def test_corners_that_differ_by_rounding_are_the_same(tmp_path):
    corners: list[tuple[float, float, float]] = []
    triangles = []
    for number, face in enumerate(CUBE.triangles):
        shift = 1e-9 * (number % 3)
        first = len(corners)
        triangles.append((first, first + 1, first + 2))
        for index in face:
            x, y, z = CUBE.vertices[index]
            corners.append((x + shift, y + shift, z + shift))
    mesh = read_mesh(write_obj(tmp_path / "cube.obj", TriangleMesh(corners, triangles)))
    assert is_closed(mesh)
    assert solid_moments(mesh).volume == pytest.approx(1)


def test_a_collada_file_in_inches_with_a_moved_node(tmp_path):
    box = trimesh.creation.box((1, 1, 1))
    path = tmp_path / "box.dae"
    text = trimesh.exchange.dae.export_collada(box).decode()
    assert "<unit" not in text
    text = text.replace("<asset>", '<asset><unit name="inch" meter="0.0254"/>')
    start = text.index("<instance_geometry")
    text = text[:start] + "<translate>10 0 0</translate>" + text[start:]
    path.write_text(text)
    moments = solid_moments(read_mesh(str(path)))
    assert moments.volume == pytest.approx(0.0254**3, rel=1e-6)
    assert moments.center() == pytest.approx((0.254, 0, 0), abs=1e-9)


def test_a_gltf_scene_puts_every_body_at_its_place(tmp_path):
    scene = trimesh.Scene()
    for x in (-2.0, 3.0):
        move = trimesh.transformations.translation_matrix((x, 0, 0))
        scene.add_geometry(trimesh.creation.box((1, 1, 1)), transform=move)
    path = tmp_path / "two.glb"
    path.write_bytes(scene.export(file_type="glb"))
    moments = solid_moments(read_mesh(str(path)))
    assert moments.volume == pytest.approx(2)
    assert moments.center() == pytest.approx((0.5, 0, 0))


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.stl", b"", "it is not a valid STL file, or it is cut off"),
        ("a.stl", binary_stl()[:-1], "it is not a valid STL file, or it is cut off"),
        ("a.stl", b"solid empty\nendsolid", "it has no triangles"),
        ("a.stl", b"solid a\nvertex 0 zero 0", "a vertex of the ASCII STL is not three numbers"),
        ("a.stl", b"solid a\nvertex 0 0", "a vertex of the ASCII STL is not three numbers"),
        ("a.stl", b"solid a\nvertex 0 0 0", "the ASCII STL has a facet without three vertices"),
        ("a.obj", b"v 0 0", "a line of the OBJ file cannot be read"),
        ("a.obj", b"v 0 0 0\nf 1 2 3", "a line of the OBJ file cannot be read"),
        ("a.obj", b"v 0 0 0\nf 0 0 0", "a line of the OBJ file cannot be read"),
        ("a.obj", b"v 0 0 nan\nf 1 1 1", "a coordinate is not a finite number"),
        ("a.obj", b"# nothing", "it has no triangles"),
        ("a.step", b"ISO-10303-21;", "no reader for '.step' files"),
    ],
)
def test_a_faulty_mesh_file_says_why(tmp_path, name, content, reason):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(MeshFileError) as caught:
        read_mesh(str(path))
    assert str(caught.value) == reason


def test_a_file_that_is_not_what_its_ending_says(tmp_path):
    path = tmp_path / "a.glb"
    path.write_bytes(b"this is no glTF")
    with pytest.raises(MeshFileError, match="it is not a valid glTF file"):
        read_mesh(str(path))


def test_a_directory_is_no_mesh(tmp_path):
    path = tmp_path / "a.stl"
    path.mkdir()
    with pytest.raises(MeshFileError, match="folder"):
        read_mesh(str(path))


def test_a_missing_library_is_named(tmp_path, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "trimesh", None)
    path = tmp_path / "a.ply"
    path.write_bytes(b"ply\nformat ascii 1.0\nend_header\n")
    with pytest.raises(MissingLibraryError, match="trimesh"):
        read_mesh(str(path))
