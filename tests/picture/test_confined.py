"""Meshes are read in a jail, and drawing ends in time."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING

import pytest

from tests.later import Later
from tests.picture.drawing import needs_drawing
from tests.waiting import PATIENCE
from yamaro.confined import Reader
from yamaro.diagnostics import YamaroError
from yamaro.meshes.surfaces import read_packed
from yamaro.picture import meshes
from yamaro.picture.meshes import read_meshes
from yamaro.policy import Policy
from yamaro.sandbox.jail import check_available

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

pytestmark = needs_drawing
needs_jail = pytest.mark.skipif(check_available() is not None, reason="needs a jail")


@pytest.fixture
def boxes(tmp_path: Path) -> list[str]:
    paths = [tmp_path / f"{name}.stl" for name in "abc"]
    for path in paths:
        trimesh.creation.box().export(path)
    return [str(path) for path in paths]


def reader_of(folder: Path, **options: float) -> Reader:
    return Reader(Policy("safe"), readable=[str(folder)], name="robot", **options)


def end_reading_of(name: str, how: Callable[[], object], monkeypatch: pytest.MonkeyPatch) -> None:
    usual = read_packed

    def read(path: str, allows: Callable[[str], bool] | None) -> bytes:
        if path.endswith(name):
            how()
        return usual(path, allows)

    monkeypatch.setattr(meshes, "read_packed", read)


@needs_jail
def test_a_mesh_that_ends_its_reader_does_not_take_the_others_along(
    boxes: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    end_reading_of("b.stl", lambda: os._exit(1), monkeypatch)
    found = read_meshes(boxes, lambda path: True, reader_of(tmp_path))
    assert [isinstance(found[path], list) for path in boxes] == [True, False, True]
    assert "reading it was ended" in str(found[boxes[1]])


@needs_jail
def test_a_mesh_that_takes_too_much_memory_is_named(
    boxes: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    end_reading_of("c.stl", lambda: bytearray(1 << 40), monkeypatch)
    found = read_meshes(boxes, lambda path: True, reader_of(tmp_path))
    assert "too much memory" in str(found[boxes[2]])
    assert isinstance(found[boxes[0]], list)


@needs_jail
def test_a_reader_reads_only_where_the_robot_may(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    trimesh.creation.box().export(tmp_path / "secret.stl")
    path = str(tmp_path / "secret.stl")
    found = read_meshes([path], lambda path: True, reader_of(tmp_path / "robot"))
    assert "ermission denied" in str(found[path])


@needs_jail
def test_reading_that_does_not_end_is_ended(
    boxes: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def hang() -> None:
        while True:
            pass

    end_reading_of("a.stl", hang, monkeypatch)
    with pytest.raises(YamaroError, match="timed out"):
        read_meshes(boxes, lambda path: True, reader_of(tmp_path, until=monotonic() + 0.5))


@needs_jail
@pytest.mark.parametrize("answer", [b"", b"x", b"\0" * 8, b"\xff" * 100])
def test_an_answer_that_makes_no_sense_is_refused(answer: bytes, boxes: list[str]) -> None:
    class Liar(Reader):
        def run(self, work: Callable[[], bytes]) -> bytes:
            return answer

    liar = Liar(Policy("safe"), readable=[], name="robot")
    found = read_meshes(boxes, lambda path: True, liar)
    assert not any(isinstance(each, list) for each in found.values())


def test_where_there_is_no_jail_meshes_are_read_without(
    boxes: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yamaro.sandbox.jail.check_available", lambda: "not here")
    found = read_meshes(boxes, lambda path: True, reader_of(tmp_path))
    assert all(isinstance(each, list) for each in found.values())


@pytest.mark.slow
def test_drawing_was_not_bound_by_the_time_out(tmp_path: Path) -> None:
    source = tmp_path / "robot.urdf"
    source.write_text('<robot name="r"><link name="a"><visual><geometry><sphere radius="1"/>'
                      "</geometry></visual></link></robot>")  # fmt: skip
    output = tmp_path / "film.gif"
    output.write_bytes(b"before")
    film = ["--turn", "--seconds", "100", "--frames-per-second", "25", "--timeout", "6"]
    done = subprocess.run(
        [sys.executable, "-m", "yamaro", "picture", str(source), "-o", str(output), *film],
        capture_output=True, text=True, timeout=PATIENCE, check=False,
    )  # fmt: skip
    assert done.returncode in (1, -15)
    assert "error[limit-time]" in done.stderr
    assert output.read_bytes() == b"before"
