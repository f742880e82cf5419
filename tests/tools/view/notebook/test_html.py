"""The HTML that a notebook shows: what is in it, and what must never be."""

from __future__ import annotations

import base64
import gzip
import json
import re
import struct
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import pytest

import yamaro
from tests.tools.view.notebook.conftest import Frames, html_of
from yamaro.tools.view import notebook as page

PageOf = Callable[[Any], str]
SAFE = yamaro.Policy("safe")


def stl(*corners: float) -> bytes:
    """Return triangles as a binary STL."""
    triangles = [
        struct.pack("<12fH", 0, 0, 1, 0, 0, 0, corner, 0, 0, 0, corner, 0, 0) for corner in corners
    ]
    return b"".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(triangles)


def unpacked(text: str) -> bytes:
    return gzip.decompress(base64.b64decode(text))


def files_in(shown: str) -> list[bytes]:
    """Return the files that a page holds."""
    told = re.search(r'<script id="robot-files"[^>]*>(.*?)</script>', shown, re.DOTALL)
    assert told is not None
    return [unpacked(file["data"]) for file in json.loads(told[1]).values()]


def robot_in(shown: str) -> Any:
    told = re.search(r'<script id="robot-data"[^>]*>(.*?)</script>', shown, re.DOTALL)
    assert told is not None
    return json.loads(unpacked(told[1]))


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """A robot with a mesh beside it, and one that lies where it may not read."""
    (tmp_path / "secret.stl").write_bytes(stl(2))
    folder = tmp_path / "robot"
    folder.mkdir()
    (folder / "own.stl").write_bytes(stl(1))
    path = folder / "robot.urdf"
    path.write_text(
        '<robot name="r"><link name="l">'
        '<visual><geometry><mesh filename="own.stl"/></geometry></visual>'
        '<visual><geometry><mesh filename="../secret.stl"/></geometry></visual>'
        '<visual><geometry><mesh filename="link.stl"/></geometry></visual></link></robot>',
        encoding="utf-8",
    )
    return path


@pytest.mark.skipif(sys.platform == "win32", reason="needs links")
def test_only_files_that_the_robot_may_read_are_in_the_page(robot: Path, page_of: PageOf) -> None:
    (robot.parent / "link.stl").symlink_to(robot.parents[1] / "secret.stl")
    of_file = page_of(yamaro.Robot.from_urdf(robot))
    of_trusted = page_of(yamaro.build(robot))
    assert files_in(of_file) == [stl(1)]
    assert files_in(of_trusted) == [stl(1), stl(2), stl(2)]  # its file is trusted
    visual = robot_in(of_file)["links"]["l"]["visual"]
    assert [each["mesh"].get("fault", "") for each in visual] == [
        "",
        "it is outside of the folders that this robot may read",
        "it is outside of the folders that this robot may read",
    ]


@pytest.mark.skipif(sys.platform == "win32", reason="needs links")
def test_a_file_that_becomes_a_link_after_the_build_is_not_read(
    robot: Path, page_of: PageOf
) -> None:
    text = robot.read_text(encoding="utf-8").replace("../secret.stl", "own.stl")
    robot.write_text(text.replace("link.stl", "own.stl"), encoding="utf-8")
    build = yamaro.build(robot, policy=SAFE)
    assert files_in(page_of(build)) == files_in(page_of(build.robot)) == [stl(1)]
    (robot.parent / "own.stl").unlink()
    (robot.parent / "own.stl").symlink_to(robot.parents[1] / "secret.stl")
    assert files_in(page_of(build)) == []


def test_the_page_names_no_folder_of_this_machine(robot: Path, page_of: PageOf) -> None:
    shown = page_of(yamaro.build(robot))
    assert str(robot.parent) not in shown
    assert str(robot.parent) not in json.dumps(robot_in(shown))


def test_the_same_robot_gives_the_same_html(robot: Path) -> None:
    build = yamaro.build(robot)
    assert html_of(build) == html_of(build) == html_of(build.robot)


def test_meshes_that_are_too_large_are_left_out(
    robot: Path, page_of: PageOf, monkeypatch: pytest.MonkeyPatch
) -> None:
    random = Random(1)
    large = stl(*(random.random() for _ in range(1000)))
    (robot.parents[1] / "secret.stl").write_bytes(large)
    build = yamaro.build(robot)
    assert files_in(page_of(build)) == [stl(1), large]
    usual = len(page_of(build))
    monkeypatch.setattr(page, "MOST_CHARACTERS", usual - 4000)
    shown = page_of(build)
    assert files_in(shown) == [stl(1)]
    fault = robot_in(shown)["links"]["l"]["visual"][1]["mesh"]["fault"]
    assert "too large" in fault


def test_a_robot_that_is_too_large_is_a_line_of_text(
    robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page, "MOST_CHARACTERS", 1000)
    shown = html_of(yamaro.build(robot))
    assert Frames(shown).tags == ["p"]
    assert "'r'" in shown.replace("&#x27;", "'")
    assert "1 link, 0 moving joints" in shown
    assert "yamaro view" in shown


def test_another_document_is_text(tmp_path: Path) -> None:
    path = tmp_path / "launch.yaml"
    path.write_text("launch:\n  node/name=</pre><script>:\n", encoding="utf-8")
    build = yamaro.build(path)
    shown = html_of(build)
    assert Frames(shown).tags == ["pre"]
    assert "node name=&quot;&amp;lt;/pre" in shown
    assert "&lt;launch&gt;" in shown


def test_a_long_document_is_cut(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "MOST_TEXT", 30)
    path = tmp_path / "launch.yaml"
    path.write_text("launch:\n  node:\n", encoding="utf-8")
    build = yamaro.build(path)
    left = len(build.xml()) - 30
    assert f"{left} more characters are not shown" in html_of(build)


def test_a_robot_whose_tree_stayed_in_a_jail_is_text(robot: Path) -> None:
    robot.write_text('<robot name="r"><link name="l"/></robot>', encoding="utf-8")
    build = yamaro.build(robot, policy=SAFE, has_root=False)
    shown = html_of(build)
    assert Frames(shown).tags in (["iframe"], ["pre"])  # the latter where there is a jail


def test_a_build_in_another_format_shows_the_robot(robot: Path, page_of: PageOf) -> None:
    build = yamaro.build(robot, target="sdf")
    assert robot_in(page_of(build))["urdf"].count("<link ") == 1


def test_no_exception_leaves_it(robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(name: str) -> str:
        raise MemoryError(f"<b>{name}</b>")

    monkeypatch.setattr(page, "_static", fail)
    for result in (yamaro.build(robot), yamaro.Robot.from_urdf(robot)):
        shown = html_of(result)
        assert Frames(shown).tags == ["p"]
        assert "MemoryError" in shown
