"""Where the text of files comes from, and what is told when it does not."""

from __future__ import annotations

import os
import socket
import sys
from pathlib import Path

import pytest

from yamaro.diagnostics import YamaroError
from yamaro.runtime.loader import FileLoader, LoadError, MemoryLoader, decode

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
    assert reason(tmp_path / "missing") == "there is no such file"
    assert reason(tmp_path / "file" / "below") == "a part of the path is no folder"
    assert reason(tmp_path) == "it is a folder"
    assert "null" in reason(tmp_path / "a\0b")


@posix
def test_what_is_no_regular_file_is_refused_without_waiting(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    os.mkfifo(tmp_path / "pipe")
    assert reason(tmp_path / "pipe") == "it is no regular file"
    assert reason(Path("/dev/null")) == "it is no regular file"
    monkeypatch.chdir(tmp_path)  # the name of a socket may only be short
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket")
        assert reason(tmp_path / "socket") == "no such device or address"


@posix
@pytest.mark.skipif(hasattr(os, "geteuid") and os.geteuid() == 0, reason="root may read anything")
def test_a_file_that_may_not_be_read_says_so(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("")
    (tmp_path / "a").chmod(0)
    assert reason(tmp_path / "a") == "reading it is not permitted"


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
    with pytest.raises(LoadError, match="there is no such file"):
        loader.read("/r/b.yaml")


def test_a_byte_order_mark_is_dropped() -> None:
    assert decode(b"\xef\xbb\xbfa: 1", name="t", path="/t").text == "a: 1"


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_utf_16_is_recognised(encoding: str) -> None:
    with pytest.raises(YamaroError) as caught:
        decode("model:\n".encode(encoding), name="t", path="/t")
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.message) == (
        "not-utf-8",
        "the file is written in UTF-16",
    )
    assert diagnostic.span.source.text == "model:\n"


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
