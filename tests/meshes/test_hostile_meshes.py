"""Meshes of strangers: tests/hostile/hostile_meshes.py has them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.counting import calls_of
from tests.hostile.hostile_meshes import (
    HARMLESS,
    HOSTILE,
    OK_DAE,
    TEXTURED_MTL,
    TEXTURED_OBJ,
    TEXTURES,
    gltf,
    textured_gltf,
)
from yamaro.files.readable import Reach
from yamaro.meshes.formats import MeshFileError
from yamaro.meshes.library import read_bodies
from yamaro.meshes.surfaces import MeshSurfaces, read_packed, unpacked
from yamaro.meshes.triangles import read_mesh

posix = pytest.mark.skipif(sys.platform == "win32", reason="needs FIFOs and links")
pytestmark = posix


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with what hostile meshes refer to, and a secret beside it."""
    inner = tmp_path / "robot"
    inner.mkdir()
    os.mkfifo(inner / "fifo")
    (inner / "link").symlink_to("/etc/passwd")
    return inner


def surfaces(path: Path) -> MeshSurfaces:
    return unpacked(read_packed(str(path), Reach([str(path.parent)]).allows))


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_mesh_is_refused_before_it_grows(name: str, folder: Path) -> None:
    data, reason = HOSTILE[name]
    path = folder / f"mesh.{name.rpartition('.')[2]}"
    path.write_bytes(data)
    with pytest.raises(MeshFileError) as drawn:
        surfaces(path)
    assert reason in str(drawn.value)
    with pytest.raises(MeshFileError):
        read_mesh(str(path), Reach([str(folder)]).allows)


@pytest.mark.parametrize("name", HARMLESS)
def test_what_a_mesh_names_elsewhere_is_not_read(name: str, folder: Path) -> None:
    path = folder / f"mesh.{name.rpartition('.')[2]}"
    path.write_bytes(HARMLESS[name])
    (surface,) = surfaces(path)
    assert len(surface.triangles) == 1 and surface.texture is None
    assert len(read_mesh(str(path), Reach([str(folder)]).allows).triangles) == 1


@pytest.mark.parametrize(("name", "data"), [("a.dae", OK_DAE.encode()), ("a.gltf", gltf())])
def test_a_mesh_near_the_hostile_ones_is_read(name: str, data: bytes, folder: Path) -> None:
    (folder / name).write_bytes(data)
    (surface,) = surfaces(folder / name)
    assert len(surface.triangles) == 1


def test_bodies_in_a_chain_are_placed_in_linear_time() -> None:
    def calls(count: int) -> int:
        nodes = [{"mesh": 0, "children": [i + 1]} for i in range(count)] + [{"mesh": 0}]
        document = json.loads(gltf())
        document |= {"nodes": nodes, "scenes": [{"nodes": [0]}]}
        data = json.dumps(document).encode()
        assert len(read_bodies(data, "gltf", "x.gltf", None)) == count + 1
        return calls_of(lambda: read_bodies(data, "gltf", "x.gltf", None))

    few, many = calls(20), calls(200)
    assert many < 11 * few


@pytest.mark.parametrize("name", TEXTURES)
@pytest.mark.parametrize("kind", ["obj", "gltf"])
def test_a_hostile_texture_is_left_out(name: str, kind: str, folder: Path) -> None:
    path = folder / f"mesh.{kind}"
    path.write_bytes(TEXTURED_OBJ if kind == "obj" else textured_gltf(TEXTURES[name]))
    (folder / "m.mtl").write_bytes(TEXTURED_MTL)
    (folder / "wood.png").write_bytes(TEXTURES[name])
    try:
        found = surfaces(path)
    except MeshFileError:  # it is broken within
        return
    (surface,) = found
    assert surface.texture is None
    assert found.refused[0].startswith("the texture 'wood.png' " if kind == "obj" else "a texture ")


@pytest.mark.parametrize("name", ["EPS", "EPS with a preview"])
@pytest.mark.parametrize("kind", ["obj", "gltf"])
def test_an_eps_named_png_started_ghostscript(name: str, kind: str, folder: Path) -> None:
    """Pillow hands EPS to the program `gs`, which is any that is found under that name."""
    tools = folder / "bin"
    tools.mkdir()
    (tools / "gs").write_text(f"#!/bin/sh\ntouch '{folder}/gs-ran'\nexit 1\n")
    (tools / "gs").chmod(0o755)
    (folder / "mesh").write_bytes(TEXTURED_OBJ if kind == "obj" else textured_gltf(TEXTURES[name]))
    (folder / "m.mtl").write_bytes(TEXTURED_MTL)
    (folder / "wood.png").write_bytes(TEXTURES[name])
    code = (
        "import sys; from yamaro.meshes.surfaces import *;"
        "print(len(unpacked(read_packed(sys.argv[1], None))))"
    )
    environ = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}
    done = subprocess.run(
        [sys.executable, "-c", code, str(folder / "mesh")],
        env=environ, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.stdout == "1\n", done.stderr
    assert done.stderr == ""  # and no library has logged
    assert not (folder / "gs-ran").exists()


@pytest.mark.parametrize("target", ["/dev/zero", "fifo", "/", "nowhere"])
@pytest.mark.parametrize("name", ["mesh.obj", "m.mtl", "wood.png"])
def test_what_is_no_regular_file_is_not_waited_for(name: str, target: str, folder: Path) -> None:
    files = {"mesh.obj": TEXTURED_OBJ, "m.mtl": TEXTURED_MTL, "wood.png": b""}
    for each, data in files.items():
        (folder / each).write_bytes(data)
    (folder / name).unlink()
    (folder / name).symlink_to(target)
    path = str(folder / "mesh.obj")
    if name == "mesh.obj":
        with pytest.raises(MeshFileError):
            unpacked(read_packed(path, None))
    else:
        (surface,) = unpacked(read_packed(path, None))
        assert surface.texture is None
