"""Shapes of USD that are seen: meshes in the place of simple shapes, colours and textures."""

from __future__ import annotations

from collections import Counter
from math import pi, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles
from tests.targets.usd.test_usd import stage_of

OBJ = """mtllib q.mtl
v 0 0 0
v 0.1 0 0
v 0 0.2 0
v 0 0 0.3
vt 0 0
vt 1 0
vt 0 1
usemtl image
f 1/1 3/3 2/2
f 1/1 2/2 4/3
usemtl green
f 1/1 4/2 3/3
f 2/1 3/2 4/3
"""
MTL = "newmtl image\nmap_Kd red.png\nnewmtl green\nKd 0 1 0\n"
PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 0
0 1 0 0 0 255
3 0 1 2
"""


@pytest.fixture(autouse=True)
def _judge() -> None:
    oracles.require_module("pxr")


def robot(link: str) -> str:
    inertial = (
        "mass: 1" if link.startswith("geometry") else "inertial: {mass: 1, inertia: 1 0 0 1 0 1}"
    )
    part = f"{{name: base, link: {{{inertial}, {link}}}}}"
    return f"robot: seen\nbase: free\nmodel:\n- part: {part}\n"


def meshes(stage: Any, name: str) -> list[Any]:
    """Return the meshes in a shape."""
    return [
        prim
        for prim in stage.GetPrimAtPath(f"/seen/base_link/{name}").GetFilteredChildren(_instances())
        if prim.GetTypeName() == "Mesh"
    ]


def _instances() -> Any:
    from pxr import Usd

    return Usd.TraverseInstanceProxies()


def look(prim: Any) -> Any:
    """Return the shader of what a prim is shown in."""
    from pxr import UsdShade

    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    return UsdShade.Shader(material.ComputeSurfaceSource()[0])


def source(shader: Any, name: str) -> Any:
    """Return the shader that an input of another comes from."""
    from pxr import UsdShade

    return UsdShade.Shader(shader.GetInput(name).GetConnectedSources()[0][0].source)


@pytest.mark.parametrize(
    ("shape", "volume"),
    [
        ("geometry: box, size: 0.2 0.3 0.4", 0.2 * 0.3 * 0.4),
        ("geometry: cylinder, radius: 0.1, length: 0.5", 32 / 2 * sin(2 * pi / 32) * 0.1**2 * 0.5),
        ("geometry: sphere, radius: 0.1", None),
        ("geometry: capsule, radius: 0.1, length: 0.5", None),
    ],
)
def test_a_simple_shape_that_is_seen_is_a_closed_mesh(
    shape: str, volume: float | None, tmp_path: Path
) -> None:
    from pxr import UsdGeom

    stage, _ = stage_of(robot(f"{shape}, visual: "), tmp_path)
    (prim,) = meshes(stage, "base_link_visual")
    mesh = UsdGeom.Mesh(prim)
    matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim))
    points = np.array(mesh.GetPointsAttr().Get(), dtype=float) @ matrix[:3, :3]
    counts = mesh.GetFaceVertexCountsAttr().Get()
    indices = iter(mesh.GetFaceVertexIndicesAttr().Get())
    faces = [[next(indices) for _ in range(count)] for count in counts]
    edges = Counter(
        (a, b) for face in faces for a, b in zip(face, [*face[1:], face[0]], strict=True)
    )
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    found = sum(
        np.linalg.det(points[[face[0], *face[i : i + 2]]]) / 6
        for face in faces
        for i in range(1, len(face) - 1)
    )
    if volume is not None:
        assert found == pytest.approx(volume, rel=1e-6)
        assert np.abs(points).max(axis=0).tolist() == pytest.approx(
            [0.1, 0.15, 0.2] if "box" in shape else [0.1, 0.1, 0.25], rel=1e-6
        )
        return
    half = 0.25 if "capsule" in shape else 0.0
    nearest = points.copy()
    nearest[:, :2] = 0
    nearest[:, 2] = np.clip(points[:, 2], -half, half)
    assert np.linalg.norm(points - nearest, axis=1) == pytest.approx(0.1, rel=1e-6)
    exact = 4 / 3 * pi * 0.1**3 + pi * 0.1**2 * 2 * half
    assert 0.97 * exact < found < exact
    normals = np.array(mesh.GetNormalsAttr().Get())
    assert normals == pytest.approx((points - nearest) / 0.1, abs=1e-6)


def test_simple_shapes_are_instances_of_one_mesh(tmp_path: Path) -> None:
    text = robot("visual: {geometry: sphere, radius: 1}").replace(
        "visual:", "visual/name=a: {geometry: sphere, radius: 2}, visual:"
    )
    stage, _ = stage_of(text, tmp_path)
    names = ("a", "base_link_visual")
    first, second = (stage.GetPrimAtPath(f"/seen/base_link/{name}") for name in names)
    assert first.IsInstanceable()
    assert first.GetPrototype() == second.GetPrototype()
    scales = [each.GetAttribute("xformOp:scale").Get() for each in (first, second)]
    assert scales == [(2, 2, 2), (1, 1, 1)]


def test_what_has_no_colour_is_grey(tmp_path: Path) -> None:
    stage, _ = stage_of(robot("geometry: box, size: 1 1 1, visual: "), tmp_path)
    (prim,) = meshes(stage, "base_link_visual")
    assert look(prim).GetInput("diffuseColor").Get() == (0.5, 0.5, 0.5)


def test_a_mesh_keeps_its_own_texture_and_colours(tmp_path: Path) -> None:
    for module in ("trimesh", "PIL"):
        oracles.require_module(module)
    from PIL import Image
    from pxr import UsdGeom

    Image.new("RGB", (4, 4), (255, 0, 0)).save(tmp_path / "red.png")
    (tmp_path / "q.obj").write_text(OBJ)
    (tmp_path / "q.mtl").write_text(MTL)
    shapes = "geometry: q.obj, visual: , visual/name=blue: {geometry: q.obj, color: 0 0 1 1}"
    stage, build = stage_of(robot(f"{shapes}, collision: "), tmp_path)
    seen = meshes(stage, "base_link_visual")
    images = [each for each in seen if look(each).GetInput("diffuseColor").HasConnectedSource()]
    (painted,), (plain,) = images, [each for each in seen if each not in images]
    assert look(plain).GetInput("diffuseColor").Get() == (0, 1, 0)
    texture = source(look(painted), "diffuseColor")
    path = texture.GetInput("file").Get().path.removeprefix("./")
    assert build.assets[path].startswith(b"\x89PNG")
    assert source(texture, "st").GetInput("varname").Get() == "st"
    where = UsdGeom.PrimvarsAPI(painted).GetPrimvar("st").Get()
    points = UsdGeom.Mesh(painted).GetPointsAttr().Get()
    found: dict[Any, list[list[float]]] = {tuple(uv): [] for uv in where}
    for point, uv in zip(points, where, strict=True):
        found[tuple(uv)].append(sorted(np.array(point, float).round(6).tolist()))
    assert {uv: sorted(each) for uv, each in found.items()} == {
        (0, 0): [[0, 0, 0]],
        (1, 0): [[0, 0, 0.1]],
        (0, 1): [[0, 0, 0.2], [0, 0, 0.3]],
    }
    for each in meshes(stage, "blue"):
        assert look(each).GetInput("diffuseColor").Get() == (0, 0, 1)
    assert not [loss for loss in build.losses if "texture" in loss.what]
    hidden = UsdGeom.Imageable(meshes(stage, "base_link_collision")[0])
    assert hidden.ComputeVisibility() == "invisible"  # where the visual is
    assert hidden.ComputePurpose() == "guide"


def test_a_mesh_keeps_the_colours_of_its_corners(tmp_path: Path) -> None:
    oracles.require_module("trimesh")
    from pxr import UsdGeom

    (tmp_path / "t.ply").write_text(PLY)
    text = robot("visual: {geometry: t.ply}")
    stage, _ = stage_of(text, tmp_path)
    (prim,) = meshes(stage, "base_link_visual")
    reader = source(look(prim), "diffuseColor")
    assert reader.GetInput("varname").Get() == "displayColor"
    mesh = UsdGeom.Mesh(prim)
    colors = mesh.GetDisplayColorPrimvar()
    assert colors.GetInterpolation() == "vertex"
    pairs = zip(mesh.GetPointsAttr().Get(), colors.Get(), strict=True)
    assert {(tuple(point), tuple(color)) for point, color in pairs} == {
        ((0, 0, 0), (1, 0, 0)),
        ((1, 0, 0), (0, 1, 0)),
        ((0, 1, 0), (0, 0, 1)),
    }


@pytest.mark.parametrize(
    "shape", ["box, size: 1 2 3", "sphere, radius: 1", "cylinder, radius: 1, length: 2"]
)
def test_a_texture_is_put_on_a_simple_shape(shape: str, tmp_path: Path) -> None:
    oracles.require_module("PIL")
    from PIL import Image
    from pxr import UsdGeom

    Image.new("RGB", (2, 2)).save(tmp_path / "wood.png")
    material = "{name: wood, texture: wood.png, color: 1 0.5 0 1}"
    text = robot(f"geometry: {shape}, visual: {{material: {material}}}")
    stage, build = stage_of(text, tmp_path)
    (prim,) = meshes(stage, "base_link_visual")
    texture = source(look(prim), "diffuseColor")
    assert texture.GetInput("scale").Get() == (1, 0.5, 0, 1)
    assert texture.GetInput("sourceColorSpace").Get() == "sRGB"
    where = UsdGeom.PrimvarsAPI(prim).GetPrimvar("st")
    assert where.GetInterpolation() == "faceVarying"
    found = np.array(where.Get())
    assert len(found) == len(UsdGeom.Mesh(prim).GetFaceVertexIndicesAttr().Get())
    assert found.min(axis=0) == pytest.approx([0, 0], abs=1e-6)
    assert found.max(axis=0) == pytest.approx([1, 1], abs=1e-6)
    assert not [loss for loss in build.losses if "texture" in loss.what]


def test_textures_that_cannot_be_shown_are_reported(tmp_path: Path) -> None:
    stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    (tmp_path / "s.stl").write_text(f"{stl}endloop\nendfacet\nendsolid s\n")
    text = robot(
        "visual/name=a: {geometry: s.stl, material: {name: wood, texture: wood.png}}, "
        "visual/name=b: {geometry: box, size: 1 1 1, material: {name: oak, texture: none.png}}"
    )
    oracles.require_module("PIL")
    from PIL import Image

    Image.new("RGB", (2, 2)).save(tmp_path / "wood.png")
    _, build = stage_of(text, tmp_path)
    assert {loss.what for loss in build.losses if "texture" in loss.what} == {
        "textures of meshes without coordinates for them",
        "textures that are not found or cannot be read",
    }
    assert not build.assets, "the texture that is lost is not beside the document either"


def test_friction_of_a_mesh_is_bound_where_physics_looks_for_it(tmp_path: Path) -> None:
    """Newton takes no material from an instance that its mesh is in."""
    from pxr import UsdShade

    (tmp_path / "q.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n")
    surface = "collision: {geometry: q.obj, surface: {friction: 0.7}}"
    other = "collision/name=b: {geometry: q.obj}"
    text = robot(f"inertia: {{ixx: 1, iyy: 1, izz: 1}}, {surface}, {other}")
    stage, _ = stage_of(text, tmp_path)

    def bound(name: str) -> Any:
        (prim,) = meshes(stage, name)
        return UsdShade.MaterialBindingAPI(prim).GetDirectBinding("physics").GetMaterial()

    assert bound("base_link_collision").GetPrim().GetAttribute("physics:staticFriction").Get() == (
        pytest.approx(0.7)
    )
    assert not bound("b")


def test_meshes_stay_away_if_asked(tmp_path: Path) -> None:
    (tmp_path / "q.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    text = robot("visual: {geometry: q.obj}")
    stage, build = stage_of(text, tmp_path, meshes="none")
    assert not stage.GetPrimAtPath("/seen/base_link/base_link_visual")
    assert isinstance(build, yamaro.Build)
