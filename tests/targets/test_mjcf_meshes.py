"""Meshes and textures in MJCF, as MuJoCo reads them."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module

TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def binary_stl(corners: Any) -> bytes:
    facets = [b"\0" * 12 + np.asarray(each, "<f4").tobytes() + b"\0\0" for each in corners]
    return b"\0" * 80 + struct.pack("<I", len(facets)) + b"".join(facets)


def text_stl(corners: Any) -> bytes:
    lines = ["solid tetrahedron"]
    for facet in corners:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x} {y} {z}" for x, y, z in facet]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid"]).encode()


def robot_of(folder: Path, *links: str) -> yamaro.Build:
    """Return the MJCF of a robot whose links have mass and these shapes."""
    lines = ["robot: meshes", "base: fixed", "model:"]
    for index, link in enumerate(links):
        joint = "" if not index else "joint: {type: fixed, parent: part_0}, "
        inertial = "inertial: {mass: 1, inertia: 1 0 0 1 0 1}"
        lines.append(f"- part: {{name: part_{index}, {joint}link: {{{inertial}, {link}}}}}")
    path = folder / "robot.yaml"
    path.write_text("\n".join(lines) + "\n")
    return yamaro.build(path, target="mjcf", output=folder / "out" / "robot.xml")


def compiled(build: yamaro.Build, folder: Path) -> Any:
    mujoco = require_module("mujoco")
    for name, content in {**build.assets, "robot.xml": build.xml().encode()}.items():
        path = folder / "out" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return mujoco.MjModel.from_xml_path(str(folder / "out" / "robot.xml"))


def corners_of(model: Any, geom: int) -> Any:
    """Return the corners of a mesh in the world, sorted, each once."""
    mujoco = require_module("mujoco")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    mesh = model.geom_dataid[geom]
    start = model.mesh_vertadr[mesh]
    points = model.mesh_vert[start : start + model.mesh_vertnum[mesh]]
    placed = points @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    return np.unique(placed.round(5) + 0.0, axis=0)


def wanted(scale: Any = 1) -> Any:
    return np.unique((TETRAHEDRON * scale).round(5) + 0.0, axis=0)


@pytest.mark.parametrize("kind", ["stl", "text", "obj", "ply", "glb"])
@pytest.mark.parametrize("scale", [(1, 1, 1), (0.5, -2, 1)])
def test_corners_are_where_the_file_has_them(kind: str, scale: Any, tmp_path: Path) -> None:
    trimesh = require_module("trimesh")
    corners = TETRAHEDRON[FACES]
    mesh = trimesh.Trimesh(TETRAHEDRON, FACES, process=False)
    name = f"shell.{'stl' if kind == 'text' else kind}"
    content = {"stl": binary_stl, "text": text_stl}.get(kind)
    data = content(corners) if content is not None else mesh.export(file_type=kind)
    (tmp_path / name).write_bytes(data.encode() if isinstance(data, str) else data)
    size = " ".join(map(str, scale))
    shape = f"visual: {{geometry: {name}, scale: {size}}}"
    model = compiled(
        robot_of(tmp_path, f"{shape}, {shape.replace('visual', 'collision')}"), tmp_path
    )
    assert model.ngeom == 2
    for geom in range(2):
        assert np.array_equal(corners_of(model, geom), wanted(scale))


def test_a_file_is_written_once_whatever_shows_it(tmp_path: Path) -> None:
    (tmp_path / "a.stl").write_bytes(binary_stl(TETRAHEDRON[FACES]))
    (tmp_path / "copy").mkdir()
    (tmp_path / "copy" / "a.stl").write_bytes(binary_stl(TETRAHEDRON[FACES]))
    shape = "visual: {{geometry: {}, scale: {}}}"
    build = robot_of(
        tmp_path,
        shape.format("a.stl", "1 1 1"),
        shape.format("copy/a.stl", "1 1 1"),
        shape.format("a.stl", "2 1 1"),
    )
    files = [name for name in build.assets if name.startswith("assets/")]
    assert len(files) == 1
    model = compiled(build, tmp_path)
    assert model.nmesh == 2
    assert files[0].startswith("assets/a-")


def test_materials_of_a_mesh_are_parts_of_their_own(tmp_path: Path) -> None:
    (tmp_path / "two.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")
    lines = ["mtllib two.mtl"]
    lines += [f"v {x} {y} {z}" for x, y, z in [*TETRAHEDRON, *(TETRAHEDRON + 5)]]
    for offset, material in ((1, "red"), (5, "blue")):
        lines.append(f"usemtl {material}")
        lines += [f"f {a + offset} {b + offset} {c + offset}" for a, b, c in FACES]
    (tmp_path / "two.obj").write_text("\n".join(lines) + "\n")
    model = compiled(robot_of(tmp_path, "visual: {geometry: two.obj}"), tmp_path)
    assert model.ngeom == 2
    colors = {tuple(model.mat_rgba[model.geom_matid[geom]].round(2)) for geom in range(2)}
    assert colors == {(1, 0, 0, 1), (0, 0, 1, 1)}


@pytest.mark.parametrize("color", ["", "Kd 1 0 0\n"])
def test_a_material_is_lost_where_the_mesh_has_its_own(color: str, tmp_path: Path) -> None:
    (tmp_path / "own.mtl").write_text(f"newmtl own\n{color}")
    lines = ["mtllib own.mtl"] if color else []
    lines += [f"v {x} {y} {z}" for x, y, z in TETRAHEDRON]
    lines += ["usemtl own"] if color else []
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES]
    (tmp_path / "own.obj").write_text("\n".join(lines) + "\n")
    visual = "visual: {geometry: own.obj, material: {name: blue, color: 0 0 1 1}}"
    build = robot_of(tmp_path, visual)
    model = compiled(build, tmp_path)
    shown = tuple(model.mat_rgba[model.geom_matid[0]].round(2))
    assert shown == ((1, 0, 0, 1) if color else (0, 0, 1, 1))
    lost = [each.owner for each in build.losses if "bring their own" in each.what]
    assert lost == (["'own.obj' of link 'part_0_link'"] if color else [])


@pytest.mark.parametrize("ending", ["png", "jpg"])
def test_textures_of_materials_and_meshes_are_png(ending: str, tmp_path: Path) -> None:
    image = require_module("PIL.Image")
    pixels = np.zeros((4, 8, 3), np.uint8)
    pixels[:, :4] = (200, 0, 0)
    image.fromarray(pixels).save(tmp_path / f"paint.{ending}", quality=95)
    (tmp_path / "look.mtl").write_text(f"newmtl paint\nKd 1 1 1\nmap_Kd paint.{ending}\n")
    lines = ["mtllib look.mtl", "usemtl paint"]
    lines += [f"v {x} {y} {z}" for x, y, z in TETRAHEDRON]
    lines += ["vt 0.1 0.2", "vt 0.2 0.2", "vt 0.1 0.9", "vt 0.9 0.9"]
    lines += [f"f {a + 1}/{a + 1} {b + 1}/{b + 1} {c + 1}/{c + 1}" for a, b, c in FACES]
    (tmp_path / "look.obj").write_text("\n".join(lines) + "\n")
    material = f"material: {{name: painted, texture/filename=paint.{ending}: }}"
    boxed = f"visual: {{geometry: box, scale: 1 1 1, {material}}}"
    build = robot_of(tmp_path, "visual: {geometry: look.obj}", boxed)
    model = compiled(build, tmp_path)
    assert model.ntex >= 1
    assert all(model.geom_matid >= 0)
    start = model.tex_adr[0]
    shown = model.tex_data[start : start + 4 * 8 * 3].reshape(4, 8, 3)
    assert abs(shown.astype(int) - pixels).max() <= (0 if ending == "png" else 40)
    names = [name for name in build.assets if name.endswith(".png")]
    assert names
    assert all(build.assets[name].startswith(b"\x89PNG") for name in names)


def test_what_has_no_volume_is_reported_and_not_in_the_way(tmp_path: Path) -> None:
    flat = [[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]]
    (tmp_path / "flat.stl").write_bytes(binary_stl(flat))
    (tmp_path / "none.stl").write_bytes(binary_stl([]))
    shapes = [
        "visual: {geometry: flat.stl}, collision: {geometry: flat.stl}",
        "collision: {geometry: flat.stl}",
        "visual: {geometry: none.stl}",
    ]
    build = robot_of(tmp_path, *shapes)
    assert compiled(build, tmp_path).ngeom == 1
    whats = [loss.what for loss in build.losses]
    assert whats.count("flat meshes of collisions") == 2
    assert whats.count("meshes without triangles") == 1


def test_a_large_stl_becomes_an_obj(tmp_path: Path) -> None:
    count = 200_001
    random = np.random.default_rng(1).normal(size=(count, 3, 3))
    (tmp_path / "large.stl").write_bytes(binary_stl(random))
    build = robot_of(tmp_path, "visual: {geometry: large.stl}")
    assert [name[-4:] for name in build.assets if name.startswith("assets/")] == [".obj"]


def test_meshes_none_leaves_them_out(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(
        "robot: bare\nmodel:\n- part: {name: base, link: {inertial: {mass: 1, "
        "inertia: 1 0 0 1 0 1}, visual: {geometry: gone.stl}}}\n"
    )
    build = yamaro.build(path, target="mjcf", meshes="none")
    assert "mesh" not in build.xml()
    with pytest.raises(yamaro.YamaroError, match="missing-mesh"):
        yamaro.build(path, target="mjcf")
