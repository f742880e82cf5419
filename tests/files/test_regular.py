"""Files that somebody else has named are opened if they are regular, and nothing is waited for."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from yamaro.files.packages import PackageFinder, manifest_name
from yamaro.files.regular import _Unblocked, open_regular, read_start
from yamaro.meshes.formats import MeshFileError
from yamaro.meshes.triangles import mesh_extent, read_mesh

posix = pytest.mark.skipif(sys.platform == "win32", reason="needs FIFOs")


def test_the_start_of_a_file_is_read(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"12345")
    assert read_start(str(tmp_path / "a"), 3) == b"123"
    with open_regular(str(tmp_path / "a")) as file:
        assert file.read() == b"12345"


@posix
@pytest.mark.parametrize("name", ["fifo", "link", "/dev/zero", "/dev/null", "."])
def test_what_is_no_regular_file_is_not_opened(name: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "link").symlink_to("fifo")
    with pytest.raises(OSError, match=r"regular|folder"):
        open_regular(str(tmp_path / name))


@posix
def test_a_fifo_named_package_xml_hung_the_search_for_packages(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    os.mkfifo(tmp_path / "robot" / "package.xml")
    assert manifest_name(str(tmp_path / "robot")) is None
    assert PackageFinder({}).find("robot", str(tmp_path / "robot")) is None


@posix
@pytest.mark.parametrize("target", ["fifo", "/dev/zero"])
def test_a_fifo_in_place_of_a_mesh_hung_its_reader(target: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "fifo")
    for ending in ("stl", "obj", "glb"):
        (tmp_path / f"a.{ending}").symlink_to(target)
        with pytest.raises(MeshFileError, match="regular"):
            read_mesh(str(tmp_path / f"a.{ending}"))
    assert mesh_extent(str(tmp_path / "a.stl"), (1, 1, 1)) is None


def test_comments_without_an_end_took_quadratic_time_in_a_manifest(tmp_path: Path) -> None:
    comments = "<!-- -->" * 100_000
    (tmp_path / "package.xml").write_text(f"<package>{comments}<name>arm</name>{comments}<!--")
    assert manifest_name(str(tmp_path)) == "arm"


def test_a_file_whose_reading_would_wait_is_refused() -> None:
    read, write = os.pipe()  # as /proc/kmsg is when it has nothing to say
    os.set_blocking(read, False)
    try:
        file = _Unblocked(read, "rb")
        for work in (file.readall, lambda: file.readinto(bytearray(4))):
            with pytest.raises(OSError, match="not a regular file"):
                work()
        file.close()
    finally:
        os.close(write)
