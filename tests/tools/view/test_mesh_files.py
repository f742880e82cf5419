"""What the page may fetch: by bytes, within bounds, and only where the robot may read."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.hostile.hostile_meshes import HARMLESS, HOSTILE, TEXTURED_MTL, TEXTURED_OBJ, TEXTURES
from yamaro.confined import Reader
from yamaro.files.readable import Reach
from yamaro.policy import Policy
from yamaro.tools.view.mesh_files import Library, MeshFiles

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs FIFOs and links")
PNG = b"\x89PNG\r\n\x1a\n"


def told_of(path: Path) -> dict[str, Any]:
    """Return what the page is told of a mesh, looked up in a jail where there is one."""
    reach = Reach([str(path.parent)])
    library = Library(Reader(Policy("safe"), readable=reach.roots, name="robot"), reach)
    library.look_up([str(path)])
    return MeshFiles(reach, library).add(str(path)) or {}


@pytest.mark.parametrize("name", [*HOSTILE, *HARMLESS])
def test_a_hostile_mesh_brings_nothing(name: str, tmp_path: Path) -> None:
    folder = tmp_path / "robot"
    folder.mkdir()
    os.mkfifo(folder / "fifo")
    (folder / "link").symlink_to("/etc/passwd")
    path = folder / f"mesh.{name.rpartition('.')[2]}"
    path.write_bytes(HOSTILE[name][0] if name in HOSTILE else HARMLESS[name])
    told = told_of(path)
    assert told.get("companions", {}) == {}


@pytest.mark.parametrize("name", ["EPS", "EPS with a preview", "an icon", "nothing"])
def test_a_texture_of_another_format_is_not_given(name: str, tmp_path: Path) -> None:
    (tmp_path / "mesh.obj").write_bytes(TEXTURED_OBJ)
    (tmp_path / "m.mtl").write_bytes(TEXTURED_MTL)
    (tmp_path / "wood.png").write_bytes(TEXTURES[name])
    assert list(told_of(tmp_path / "mesh.obj")["companions"]) == ["m.mtl"]
    (tmp_path / "wood.png").write_bytes(PNG)
    assert list(told_of(tmp_path / "mesh.obj")["companions"]) == ["m.mtl", "wood.png"]


@pytest.mark.parametrize("target", ["fifo", "/dev/zero", "/", "nowhere"])
@pytest.mark.parametrize("name", ["mesh.obj", "m.mtl", "wood.png"])
def test_what_is_no_regular_file_is_not_waited_for(name: str, target: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "fifo")
    files = {"mesh.obj": TEXTURED_OBJ, "m.mtl": TEXTURED_MTL, "wood.png": PNG}
    for each, data in files.items():
        (tmp_path / each).write_bytes(data)
    (tmp_path / name).unlink()
    (tmp_path / name).symlink_to(target)
    assert name not in told_of(tmp_path / "mesh.obj").get("companions", {})


def test_a_mesh_is_looked_up_again_only_if_it_has_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "mesh.obj"
    path.write_bytes(TEXTURED_OBJ)
    reads: list[str] = []
    usual = Library._read_together

    def read(self: Library, paths: Any) -> Any:
        reads.extend(paths)
        return usual(self, paths)

    monkeypatch.setattr(Library, "_read_together", read)
    library = Library(None, None)
    for _ in range(3):
        library.look_up([str(path)])
        assert MeshFiles(None, library).add(str(path)) is not None
    assert reads == [str(path)]
    path.write_bytes(TEXTURED_OBJ + b"# changed\n")
    library.look_up([str(path)])
    assert reads == [str(path)] * 2
