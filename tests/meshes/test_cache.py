"""The cache of converted meshes: what it saves, and that it never harms a build."""

from __future__ import annotations

import io
import os
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.meshes import triangle
from yamaro.meshes import cache
from yamaro.meshes.cache import MeshCache, cache_folder
from yamaro.policy import JAIL, SAFE, Policy
from yamaro.targets import mesh_contents

MATERIAL = b"newmtl red\nKd 1 0 0\nmap_Kd skin.jpg\n"
OBJ = b"mtllib body.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1/1 2/1 3/1\n"
ROBOT = """robot: r
base: fixed
model:
- part:
    name: a
    link: {inertial: {mass: 1, inertia: 1 0 0 1 0 1}, visual: {geometry: body.obj, scale: 1 1 1}}
- part:
    name: b
    joint: {type: fixed, parent: a}
    link: {visual: {geometry: plain.stl, scale: 1 1 1}}
"""


def jpeg(color: tuple[int, int, int]) -> bytes:
    image = require_module("PIL.Image").new("RGB", (8, 8), color)
    data = io.BytesIO()
    image.save(data, "JPEG")
    return data.getvalue()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of the cache, which is not there yet."""
    require_module("trimesh")
    found = tmp_path / "cache" / "inner"
    monkeypatch.setenv(cache.VARIABLE, str(found))
    return found


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    (tmp_path / "body.obj").write_bytes(OBJ)
    (tmp_path / "body.mtl").write_bytes(MATERIAL)
    (tmp_path / "skin.jpg").write_bytes(jpeg((200, 0, 0)))
    (tmp_path / "plain.stl").write_text(triangle.STL)
    return path


@pytest.fixture
def conversions(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return what was converted, and not found in the cache."""
    done: list[str] = []
    kept = mesh_contents.MeshContents.kept

    def counted(self: Any, path: str, work: str, convert: Any) -> bytes:
        def convert_counted() -> bytes:
            done.append(f"{work} {os.path.basename(path)}")
            data: bytes = convert()
            return data

        return kept(self, path, work, convert_counted)

    monkeypatch.setattr(mesh_contents.MeshContents, "kept", counted)
    return done


def written(path: Path, **options: Any) -> tuple[str, dict[str, bytes]]:
    build = yamaro.build(path, target="mjcf", on_message=print, **options)
    return build.xml(), build.assets


def test_a_mesh_is_converted_once(
    robot: Path, folder: Path, conversions: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    first = written(robot)
    assert conversions == ["mjcf visual body.obj", "mjcf stl plain.stl"]
    conversions.clear()
    monkeypatch.setitem(sys.modules, "trimesh", None)  # is not even imported
    assert written(robot) == first
    assert conversions == []


@pytest.mark.parametrize("name", ["body.obj", "body.mtl", "skin.jpg"])
def test_a_change_of_a_file_that_takes_part_is_seen(
    name: str, robot: Path, folder: Path, conversions: list[str]
) -> None:
    first = written(robot)
    conversions.clear()
    changed = {
        "body.obj": OBJ.replace(b"v 0 1 0", b"v 0 2 0"),
        "body.mtl": MATERIAL.replace(b"map_Kd skin.jpg", b""),
        "skin.jpg": jpeg((0, 0, 200)),
    }
    (robot.parent / name).write_bytes(changed[name])
    second = written(robot)
    assert conversions == ["mjcf visual body.obj"]
    assert second[1] != first[1]


def test_a_file_that_was_missing_is_seen_when_it_is_there(robot: Path, folder: Path) -> None:
    first = written(robot)
    (robot.parent / "skin.jpg").unlink()
    assert written(robot)[1] != first[1]
    (robot.parent / "skin.jpg").write_bytes(jpeg((200, 0, 0)))
    assert written(robot) == first


def test_usd_reads_converted_meshes(
    robot: Path, folder: Path, conversions: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    require_module("pxr")
    first = yamaro.build(robot, target="usd", on_message=print).xml()
    assert conversions == ["surfaces body.obj", "surfaces plain.stl"]
    conversions.clear()
    monkeypatch.setitem(sys.modules, "trimesh", None)
    assert yamaro.build(robot, target="usd", on_message=print).xml() == first
    assert conversions == []


@pytest.mark.parametrize("mode", [SAFE, JAIL])
def test_a_file_that_is_not_trusted_writes_nothing(mode: str, robot: Path, folder: Path) -> None:
    trusted = written(robot)
    for path in folder.iterdir():
        path.unlink()
    folder.rmdir()
    try:
        found = written(robot, policy=Policy(mode))
    except yamaro.YamaroError as error:
        if "no-jail" not in str(error):
            raise
        pytest.skip("there is no jail")
    assert found == trusted
    assert not folder.exists()


def test_it_is_turned_off(
    robot: Path, folder: Path, conversions: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(cache.VARIABLE, "off")
    assert written(robot) == written(robot)
    assert len(conversions) == 4
    assert not folder.exists()


def test_a_folder_that_cannot_be_written_does_no_harm(robot: Path, folder: Path) -> None:
    first = written(robot)
    for path in folder.iterdir():
        path.unlink()
    folder.rmdir()
    folder.write_text("a file of that name")
    assert written(robot) == first
    assert folder.read_text() == "a file of that name"


def test_a_broken_entry_is_replaced(robot: Path, folder: Path, conversions: list[str]) -> None:
    first = written(robot)
    entries = sorted(folder.iterdir())
    whole = {path: path.read_bytes() for path in entries}
    for break_it in (
        lambda data: b"",
        lambda data: data[:-1],
        lambda data: data[:60] + bytes([data[60] ^ 1]) + data[61:],
        lambda data: data + b"more",
        lambda data: b"something else",
    ):
        conversions.clear()
        for path in entries:
            path.write_bytes(break_it(whole[path]))
        assert written(robot) == first
        assert len(conversions) == 2
        assert {path: path.read_bytes() for path in entries} == whole
    entries[0].unlink()
    entries[0].mkdir()
    assert written(robot) == first


def test_writers_and_readers_share_it(tmp_path: Path) -> None:
    """Each entry is seen whole or not at all, whoever writes it."""
    content = {b"%d" % key: b"%d" % key * 100_000 for key in range(4)}
    seen: set[tuple[bytes, bytes | None]] = set()

    def work() -> None:
        own = MeshCache(str(tmp_path / "shared"))
        for _ in range(30):
            for key, data in content.items():
                own.put(key, data)
                seen.add((key, own.get(key)))

    threads = [threading.Thread(target=work) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert seen == set(content.items())
    assert len(list((tmp_path / "shared").iterdir())) == len(content)  # and nothing unfinished


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "MOST_BYTES", 10_000)
    monkeypatch.setattr(cache, "_KEPT", 5_000)
    monkeypatch.setattr(cache, "LARGEST_ENTRY", 4_000)


@pytest.mark.usefixtures("small")
def test_it_does_not_grow_without_end(tmp_path: Path) -> None:
    def put(name: str, size: int, age: float) -> None:
        MeshCache(str(tmp_path)).put(name.encode(), b"x" * size)
        then = time.time() - age
        os.utime(MeshCache(str(tmp_path))._path(name.encode()), (then, then))

    def kept() -> list[str]:
        names = ("old", "middle", "new", "newest", "large")
        return [each for each in names if MeshCache(str(tmp_path)).get(each.encode()) is not None]

    put("old", 3_000, 300)
    put("middle", 3_000, 200)
    put("new", 3_000, 100)
    assert kept() == ["old", "middle", "new"]
    for age, name in ((300, "middle"), (200, "old"), (100, "new")):
        then = time.time() - age
        os.utime(MeshCache(str(tmp_path))._path(name.encode()), (then, then))
    put("newest", 3_000, 0)
    assert kept() == ["newest"]  # with another one it would be more than 5,000 bytes
    MeshCache(str(tmp_path)).put(b"large", b"x" * 5_000)
    assert "large" not in kept()


def test_what_was_not_finished_is_removed_in_the_end(tmp_path: Path) -> None:
    old, new = tmp_path / "a.mesh.1-2.tmp", tmp_path / "b.mesh.3-4.tmp"
    foreign = tmp_path / "notes.txt"
    for path in (old, new, foreign):
        path.write_bytes(b"x")
    os.utime(old, (0, 0))
    os.utime(foreign, (0, 0))
    MeshCache(str(tmp_path)).put(b"key", b"content")
    assert not old.exists()
    assert new.exists()
    assert foreign.exists()


@pytest.mark.parametrize(
    ("platform", "environ", "folder"),
    [
        ("linux", {"XDG_CACHE_HOME": "/c"}, "/c/yamaro/meshes"),
        ("linux", {"XDG_CACHE_HOME": "relative"}, "~/.cache/yamaro/meshes"),
        ("linux", {}, "~/.cache/yamaro/meshes"),
        ("darwin", {}, "~/Library/Caches/yamaro/meshes"),
        ("win32", {"LOCALAPPDATA": "/local"}, "/local/yamaro/Cache/meshes"),
        ("win32", {}, None),
        ("linux", {"YAMARO_CACHE": "/mine"}, "/mine"),
        ("linux", {"YAMARO_CACHE": "off"}, None),
        ("linux", {"YAMARO_CACHE": ""}, None),
        ("linux", {"YAMARO_CACHE": "relative"}, None),
    ],
)
def test_the_folder_is_that_of_the_platform(
    platform: str, environ: dict[str, str], folder: str | None
) -> None:
    wanted = None if folder is None else os.path.expanduser(folder)
    assert cache_folder(environ, platform) == wanted
