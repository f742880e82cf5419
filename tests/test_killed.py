"""Whenever a writer is killed, the file is the old one or the new one, whole."""

from __future__ import annotations

import contextlib
import os
import random
import subprocess
import sys
import time
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

import yamaro
from tests import killed_writer
from tests.effort import examples
from tests.waiting import wait_for
from yamaro.output import write_file

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="has no kill -9")

KILLS = examples(150)
MOST_TURNS = 1000


@cache
def versions() -> list[bytes]:
    return [b"".join(killed_writer.chunks_of(version)) for version in (0, 1)]


@pytest.fixture(scope="module")
def seconds(tmp_path_factory: pytest.TempPathFactory) -> float:
    """Return how long one write takes."""
    path = str(tmp_path_factory.mktemp("time") / "out.urdf")
    chunks = killed_writer.chunks_of(0)
    times = []
    for _ in range(5):
        start = time.perf_counter()
        write_file(path, chunks)
        times.append(time.perf_counter() - start)
    return sorted(times)[2]


def start_writer(way: str, path: Path) -> subprocess.Popen[bytes]:
    """Start a process that replaces a file for ever; return when it begins to."""
    source = Path(yamaro.__file__).parents[1]
    # -S: without what site-packages start, such as a tool that measures coverage.
    process = subprocess.Popen(
        [sys.executable, "-S", killed_writer.__file__, way, str(path)],
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": str(source)},
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"ready\n"
    process.stdout.close()
    return process


def kill_writer(way: str, path: Path, wait: Callable[[], object]) -> None:
    """Start a writer and kill it after waiting."""
    process = start_writer(way, path)
    wait()
    process.kill()
    assert process.wait() == -9


def wait_for_progress(path: Path, progress: float) -> None:
    """Wait until so many files are written: 1.3 is one, and a bit of the second.

    How fast it goes depends on what else the machine does, so this looks instead of sleeping.
    """
    first = path.stat().st_ino
    if progress >= 1:
        wait_for(lambda: path.stat().st_ino != first, pause=0)
    least = progress % 1 * len(versions()[0])
    with contextlib.suppress(FileNotFoundError):  # it has got its name meanwhile
        wait_for(
            lambda: any(file.stat().st_size >= least for file in left_over(path.parent)), pause=0
        )


def left_over(folder: Path) -> list[Path]:
    """Return the temporary files in a folder."""
    return [path for path in folder.iterdir() if path.name.startswith(".yamaro-")]


def test_two_versions_of_25_mb_differ_everywhere() -> None:
    old, new = versions()
    assert len(old) < len(new)
    assert len(old) == 400 << 16 > 25_000_000
    for start in range(0, len(old), 4096):
        assert old[start : start + 4096] != new[start : start + 4096]


@pytest.mark.slow
def test_a_writer_killed_at_any_moment_leaves_a_whole_file(tmp_path: Path) -> None:
    path = tmp_path / "out.urdf"
    path.write_bytes(versions()[0])
    moments = random.Random(1)
    found: list[int] = []
    shares: list[float] = []  # how much of its file each write had written that was broken off
    for _ in range(KILLS):
        moment = moments.uniform(0, 2)
        kill_writer("whole", path, lambda: wait_for_progress(path, moment))  # noqa: B023
        content = path.read_bytes()
        assert content in versions()
        found.append(versions().index(content))
        for temporary in left_over(tmp_path):
            shares.append(temporary.stat().st_size / len(versions()[0]))
            temporary.unlink()
        assert os.listdir(tmp_path) == ["out.urdf"]
    # The kills came while files were written, and not only before or behind that.
    assert set(found) == {0, 1}
    assert any(share < 1 for share in shares)


@pytest.mark.parametrize("way", ["in place", "over", "too soon"])
def test_this_would_find_a_writer_that_breaks_files(
    tmp_path: Path, seconds: float, way: str
) -> None:
    path = tmp_path / "out.urdf"
    moments = random.Random(1)
    for _ in range(MOST_TURNS):
        path.write_bytes(versions()[0])
        kill_writer(way, path, lambda: time.sleep(moments.uniform(0, 2 * seconds)))
        if path.read_bytes() not in versions():
            return
    pytest.fail("every file was whole")


# --- the command ------------------------------------------------------------------------------

LONG = """
variables: {version: 0}
out:
  for:
    iterator: i
    range: 25000
    body:
      line/version=$(version), i=$(i): $("%01000d" % i)
"""


def long_document(version: int) -> bytes:
    """Return what LONG gives, 26 MB."""
    lines = "".join(
        f'  <line version="{version}" i="{i}">{i:01000d}</line>\n' for i in range(25_000)
    )
    return f'<?xml version="1.0"?>\n<out>\n{lines}</out>\n'.encode()


def test_the_command_killed_while_it_writes_leaves_a_whole_file(
    tmp_path: Path, seconds: float
) -> None:
    source, folder = tmp_path / "long.yaml", tmp_path / "out"
    source.write_text(LONG)
    versions = [long_document(0), long_document(1)]
    folder.mkdir()
    path = folder / "out.xml"
    path.write_bytes(versions[0])
    moments = random.Random(2)
    old, broken_off, turns = 0, 0, 0
    while broken_off < 3:  # it may also be killed too late
        turns += 1
        assert turns < MOST_TURNS
        words = [str(source), "-o", str(path), f"version:={1 - old}"]
        process = subprocess.Popen([sys.executable, "-m", "yamaro", *words])
        while not left_over(folder) and process.poll() is None:
            time.sleep(0.0005)
        time.sleep(moments.uniform(0, seconds))
        process.kill()
        assert process.wait() in (-9, 0)
        content = path.read_bytes()
        assert content in versions
        old = versions.index(content)
        for temporary in left_over(folder):
            broken_off += 1
            temporary.unlink()
        assert os.listdir(folder) == ["out.xml"]


# --- what is left -----------------------------------------------------------------------------


def test_what_a_killed_writer_leaves_is_let_be(tmp_path: Path) -> None:
    """Another may be writing it: on this machine, or on one that shares the folder."""
    path = tmp_path / "out.urdf"
    path.write_bytes(versions()[0])
    for _ in range(MOST_TURNS):
        kill_writer("whole", path, lambda: wait_for_progress(path, 0.5))
        if left_over(tmp_path):
            break
    (temporary,) = left_over(tmp_path)
    before = temporary.read_bytes()
    os.utime(temporary, (0, 0))
    write_file(str(path), [b"new"])
    assert path.read_bytes() == b"new"
    assert left_over(tmp_path) == [temporary]
    assert temporary.read_bytes() == before
    assert temporary.suffix == ".tmp"
