"""Where the text of files comes from, and what is told when it does not."""

from __future__ import annotations

import os
import socket
import sys
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest

import yamaro
from yamaro.diagnostics import YamaroError
from yamaro.files import loader
from yamaro.files.loader import FileLoader, LoadError, MemoryLoader, decode
from yamaro.files.readable import Reach
from yamaro.policy import Limits

posix = pytest.mark.skipif(sys.platform == "win32", reason="has no such files")


def reason(path: Path) -> str:
    with pytest.raises(LoadError) as caught:
        FileLoader().read(str(path))
    return str(caught.value)


def test_a_file_is_read_as_bytes(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_bytes(b"\xff\r\n")
    assert FileLoader().read(str(tmp_path / "a.yaml")) == b"\xff\r\n"


def test_each_reason_has_its_words(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert reason(tmp_path / "missing") == "the file does not exist"
    assert reason(tmp_path / "file" / "below") == "a part of the path is not a folder"
    assert reason(tmp_path) == "it is a folder"
    assert "null" in reason(tmp_path / "a\0b")


@posix
def test_what_is_no_regular_file_is_refused_without_waiting(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    os.mkfifo(tmp_path / "pipe")
    assert reason(tmp_path / "pipe") == "it is not a regular file"
    assert reason(Path("/dev/null")) == "it is not a regular file"
    monkeypatch.chdir(tmp_path)  # the name of a socket may only be short
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket")
        assert reason(tmp_path / "socket") == "no such device or address"


@posix
def test_a_link_is_what_it_leads_to(tmp_path: Path) -> None:
    for name, target in (("zero", "/dev/zero"), ("a", "b"), ("b", "a"), ("away", "nowhere")):
        (tmp_path / name).symlink_to(target)
    assert reason(tmp_path / "zero") == "it is not a regular file"
    assert reason(tmp_path / "a") == "too many levels of symbolic links"
    assert reason(tmp_path / "away") == "the file does not exist"
    assert reason(tmp_path / ("n" * 300)) == "file name too long"


@posix
@pytest.mark.skipif(hasattr(os, "geteuid") and os.geteuid() == 0, reason="root may read anything")
def test_a_file_that_may_not_be_read_says_so(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("")
    (tmp_path / "a").chmod(0)
    assert reason(tmp_path / "a") == "reading it is not permitted"


def test_what_is_not_permitted_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def refuse(*_: object) -> int:
        raise PermissionError

    monkeypatch.setattr(loader.os, "open", refuse)  # type: ignore[attr-defined]
    assert reason(tmp_path / "a") == "reading it is not permitted"


# --- faults while a file is read --------------------------------------------------------------

# The memory of this process: a regular file for whoever asks, and an error for who reads its start.
FAULTY = Path("/proc/self/mem")
faulty = pytest.mark.skipif(not FAULTY.exists(), reason="needs /proc")


def between_looking_and_reading(monkeypatch: pytest.MonkeyPatch, act: Callable[[], object]) -> None:
    """Let something happen when a file is open, and it was asked what it is."""
    real = os.fstat

    def fstat(descriptor: int) -> os.stat_result:
        result = real(descriptor)
        act()
        return result

    monkeypatch.setattr(loader.os, "fstat", fstat)  # type: ignore[attr-defined]


@faulty
def test_an_error_in_the_midst_of_reading_is_told() -> None:
    assert reason(FAULTY) == "input/output error"
    with pytest.raises(yamaro.UsageError, match="cannot read '/proc/self/mem': input/output error"):
        yamaro.build(str(FAULTY))


@faulty
@pytest.mark.parametrize(
    ("text", "place"),
    [("out: {include: /proc/self/mem}", 16), ("out: {a: $(load_yaml('/proc/self/mem'))}", 12)],
)
def test_an_error_in_the_midst_of_reading_is_told_where_the_file_is_named(
    tmp_path: Path, text: str, place: int
) -> None:
    path = tmp_path / "main.yaml"
    path.write_text(text)
    with pytest.raises(YamaroError) as caught:
        yamaro.build(str(path))
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.code == "missing-file"
    assert diagnostic.message.endswith(": input/output error")
    assert diagnostic.span.place() == f"{path}:1:{place}"


@faulty
def test_what_cannot_be_read_leaves_no_file_open(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "large").write_bytes(b"x" * 101)

    def open_files() -> int:
        return len(os.listdir("/proc/self/fd"))

    before = open_files()
    for path in (FAULTY, tmp_path, tmp_path / "pipe", tmp_path / "large", tmp_path / "missing"):
        with pytest.raises(LoadError):
            FileLoader(Limits(file=100)).read(str(path))
    assert open_files() == before


@posix
def test_a_file_that_is_deleted_or_replaced_while_it_is_read_is_read_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, other = tmp_path / "a", tmp_path / "b"
    path.write_bytes(b"old" * 100_000)
    with monkeypatch.context() as patch:
        other.write_bytes(b"new")
        between_looking_and_reading(patch, lambda: os.replace(other, path))
        assert FileLoader().read(str(path)) == b"old" * 100_000
    with monkeypatch.context() as patch:
        between_looking_and_reading(patch, path.unlink)
        assert FileLoader().read(str(path)) == b"new"
    assert reason(path) == "the file does not exist"


@posix
def test_a_file_that_is_replaced_by_a_link_to_elsewhere_is_not_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    inside, outside = tmp_path / "in", tmp_path / "out"
    inside.mkdir()
    outside.write_text("secret")
    path = inside / "a"
    path.write_text("public")
    reach = Reach([str(inside)])
    assert FileLoader(reach=reach).read(str(path)) == b"public"
    check = reach.check

    def check_and_replace(asked: str) -> None:
        check(asked)
        path.unlink()
        path.symlink_to(outside)

    monkeypatch.setattr(Reach, "check", lambda _reach, asked: check_and_replace(asked))
    with pytest.raises(LoadError, match=r"^it was replaced by another file meanwhile$"):
        FileLoader(reach=reach).read(str(path))


def test_a_file_may_have_as_many_bytes_as_the_limit_says(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"x" * 100)
    assert FileLoader(Limits(file=100)).read(str(path)) == b"x" * 100
    with pytest.raises(LoadError, match=r"^it has more than 99 bytes$") as caught:
        FileLoader(Limits(file=99)).read(str(path))
    assert caught.value.code == "limit-file"


def test_a_file_that_grows_while_it_is_read_ends_at_the_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"x" * 10)

    def grow() -> None:
        with open(path, "ab") as file:
            file.write(b"x" * 1_000_000)

    between_looking_and_reading(monkeypatch, grow)
    with pytest.raises(LoadError) as caught:
        FileLoader(Limits(file=1000)).read(str(path))
    assert caught.value.code == "limit-file"


@posix
@pytest.mark.parametrize(
    ("text", "place"),
    [
        (None, "huge.yaml:1:1"),
        ("out: {include: huge.yaml}", "main.yaml:1:16"),
        ("out: {a: $(load_yaml('huge.yaml'))}", "main.yaml:1:12"),
    ],
    ids=["main", "included", "loaded"],
)
def test_a_file_of_a_gigabyte_is_refused_without_reading_it_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str | None, place: str
) -> None:
    monkeypatch.chdir(tmp_path)
    with open("huge.yaml", "wb") as file:
        file.truncate(1 << 30)  # takes no room on the disk
    if text is not None:
        Path("main.yaml").write_text(text)
    tracemalloc.start()
    try:
        with pytest.raises(YamaroError) as caught:
            yamaro.build("huge.yaml" if text is None else "main.yaml")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.span.place()) == ("limit-file", place)
    assert peak < 2 * Limits().file


@pytest.mark.parametrize(
    ("text", "code", "place"),
    [
        ("import: gone\nout:\n", "python-error", "main.yaml:1:9"),
        (
            "robot: r\nmodel:\n  part: {name: p, link: {geometry: gone.stl, mass: 1, visual: }}\n",
            "bad-mesh",
            "main.yaml:3:36",
        ),
    ],
    ids=["module", "mesh"],
)
def test_what_vanishes_before_it_is_opened_is_told_where_it_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, code: str, place: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("main.yaml").write_text(text)
    real = os.path.isfile
    monkeypatch.setattr(os.path, "isfile", lambda path: "gone" in str(path) or real(path))
    with pytest.raises(YamaroError) as caught:
        yamaro.build("main.yaml")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.span.place()) == (code, place)
    assert "No such file or directory" in diagnostic.message


# --- folders, memory, bytes -------------------------------------------------------------------


def test_neighbours_are_the_files_of_the_folder(tmp_path: Path) -> None:
    for name in ("a.yaml", "b.yaml"):
        (tmp_path / name).write_text("")
    assert sorted(FileLoader().neighbours(str(tmp_path / "x"))) == ["a.yaml", "b.yaml"]
    assert FileLoader().neighbours(str(tmp_path / "none" / "x")) == []
    loader = MemoryLoader({"/r/a.yaml": "", "/r/b.yaml": "", "/s/c.yaml": ""})
    assert loader.neighbours("/r/x") == ["a.yaml", "b.yaml"]


def test_memory_stands_in_for_the_disk() -> None:
    loader = MemoryLoader({"/r/é.yaml": "é"})
    assert loader.read("/r/é.yaml") == "é".encode()
    with pytest.raises(LoadError, match="the file does not exist"):
        loader.read("/r/b.yaml")


def test_a_byte_order_mark_is_dropped() -> None:
    assert decode(b"\xef\xbb\xbfa: 1", name="t", path="/t").text == "a: 1"


@pytest.mark.parametrize(
    ("data", "name", "text"),
    [
        ("model:\n".encode("utf-16"), "UTF-16", "model:\n"),
        ("model:\n".encode("utf-16-le"), "UTF-16", "model:\n"),
        ("model:\n".encode("utf-16-be"), "UTF-16", "model:\n"),
        ("\ufeffmodel:\n".encode("utf-32-le"), "UTF-32", "model:\n"),
        ("\ufeffmodel:\n".encode("utf-32-be"), "UTF-32", "model:\n"),
        ("ab".encode("utf-16") + b"c", "UTF-16", "ab\ufffd"),  # is cut off
        ("\ufeffa".encode("utf-32-le") + b"b", "UTF-32", "a\ufffd"),
    ],
)
def test_other_encodings_are_recognised(data: bytes, name: str, text: str) -> None:
    with pytest.raises(YamaroError) as caught:
        decode(data, name="t", path="/t")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.message, diagnostic.hint) == (
        "not-utf-8",
        f"the file is in {name}",
        "save it as UTF-8",
    )
    source = diagnostic.span.source
    assert (source.text, source.name, source.path) == (text, "t", "/t")
    assert diagnostic.span.written() == text[0]


@pytest.mark.parametrize(
    ("data", "place", "hint"),
    [
        (b"ab\xe9c", "t:1:3", "save the file as UTF-8; in Latin-1 this byte is 'é'"),
        ("é\nß".encode() + b"\x81", "t:2:2", "save the file as UTF-8"),
        (b"\xef\xbb\xbfab\xff", "t:1:3", "save the file as UTF-8; in Latin-1 this byte is 'ÿ'"),
    ],
)
def test_a_byte_that_is_no_utf_8_is_shown_where_it_stands(
    data: bytes, place: str, hint: str
) -> None:
    with pytest.raises(YamaroError) as caught:
        decode(data, name="t", path="/t")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.span.place(), diagnostic.hint) == (place, hint)
    assert diagnostic.span.written() == "\ufffd"  # what stands for it in the text
    assert diagnostic.span.source.path == "/t"
