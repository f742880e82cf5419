"""Tests of how output is written: whole or not at all."""

from __future__ import annotations

import errno
import io
import os
import signal
import stat
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import pytest

from tests.waiting import PATIENCE
from yamaro import output
from yamaro.output import is_input, write_all, write_file, write_files
from yamaro.streams import Streams

OLD = b"<robot name='old'/>\n"
NEW = b"<robot name='new'/>\n"


def entries(folder: Path) -> list[str]:
    return sorted(os.listdir(folder))


def test_file_is_written_and_folders_are_made(tmp_path: Path) -> None:
    target = tmp_path / "build" / "urdf" / "robot.urdf"
    write_file(str(target), [NEW])
    assert target.read_bytes() == NEW
    assert entries(target.parent) == ["robot.urdf"]


def test_new_file_gets_the_mode_of_the_umask(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        write_file(str(tmp_path / "a"), [NEW])
    finally:
        os.umask(before)
    assert stat.S_IMODE(os.stat(tmp_path / "a").st_mode) == 0o640


@pytest.mark.parametrize("mode", [0o600, 0o644, 0o666, 0o755])
def test_mode_of_an_old_file_is_kept(tmp_path: Path, mode: int) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    target.chmod(mode)
    write_file(str(target), [NEW])
    assert target.read_bytes() == NEW
    assert stat.S_IMODE(target.stat().st_mode) == mode


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may give files away")
def test_owner_of_an_old_file_is_kept(tmp_path: Path) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    os.chown(target, 12345, 23456)
    target.chmod(0o664)
    write_file(str(target), [NEW])
    result = target.stat()
    assert (result.st_uid, result.st_gid, stat.S_IMODE(result.st_mode)) == (12345, 23456, 0o664)


@pytest.mark.skipif(sys.platform != "linux", reason="Python knows them on Linux only")
def test_extended_attributes_of_an_old_file_are_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.urdf"
    path.write_bytes(OLD)
    try:
        os.setxattr(path, "user.origin", b"the lab\0")
        os.setxattr(path, "user.tag", b"")
    except OSError:
        pytest.skip("this file system has none")
    write_file(str(path), [NEW])
    assert path.read_bytes() == NEW
    assert sorted(os.listxattr(path)) == ["user.origin", "user.tag"]
    assert os.getxattr(path, "user.origin") == b"the lab\0"

    link = tmp_path / "link.urdf"
    link.symlink_to(path)
    write_file(str(link), [OLD])
    assert os.getxattr(path, "user.origin") == b"the lab\0"

    set_attribute = os.setxattr

    def refuse(target: int, name: str, value: bytes) -> None:
        if name == "user.origin":
            raise PermissionError
        set_attribute(target, name, value)

    monkeypatch.setattr(os, "setxattr", refuse)
    write_file(str(path), [NEW])  # what cannot be kept is no reason not to write
    assert os.listxattr(path) == ["user.tag"]


def test_a_reader_of_the_old_file_keeps_the_old_text(tmp_path: Path) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    with open(target, "rb") as reader:
        write_file(str(target), [NEW])
        assert reader.read() == OLD
    assert target.read_bytes() == NEW


def test_link_stays_and_its_target_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    target = tmp_path / "real" / "a"
    target.write_bytes(OLD)
    link = tmp_path / "link"
    link.symlink_to(Path("real") / "a")
    write_file(str(link), [NEW])
    assert link.is_symlink()
    assert target.read_bytes() == NEW
    assert entries(tmp_path / "real") == ["a"]


def test_dangling_link_makes_its_target(tmp_path: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to(tmp_path / "new" / "a")
    write_file(str(link), [NEW])
    assert link.is_symlink()
    assert (tmp_path / "new" / "a").read_bytes() == NEW


def test_link_loop_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to(tmp_path / "b")
    (tmp_path / "b").symlink_to(tmp_path / "a")
    with pytest.raises(OSError, match="symbolic links"):
        write_file(str(tmp_path / "a"), [NEW])


@pytest.mark.parametrize("name", ["folder", "folder/", "missing/"])
def test_folder_is_no_place_to_write_to(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(IsADirectoryError):
        write_file(f"{tmp_path}/{name}", [NEW])
    assert entries(tmp_path) == ["folder"]


def test_file_in_the_way_of_a_folder_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(OLD)
    with pytest.raises(NotADirectoryError):
        write_file(str(tmp_path / "a" / "b"), [NEW])
    assert (tmp_path / "a").read_bytes() == OLD


def refuse(path: str, flags: int) -> int:
    assert flags == os.O_WRONLY, "it is only asked whether the file may be written to"
    raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)


def test_read_only_file_is_not_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    target.chmod(0o444)
    if os.geteuid() == 0:  # root may write anything
        monkeypatch.setattr(os, "access", lambda path, mode: False)
        monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(PermissionError):
        write_file(str(target), [NEW])
    assert target.read_bytes() == OLD


def test_an_interrupt_waits_until_all_of_several_files_are_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace = os.replace

    def interrupted(source: str, target: str) -> None:
        replace(source, target)
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(os, "replace", interrupted)
    paths = [tmp_path / name for name in "abc"]
    for path in paths:
        path.write_bytes(OLD)
    with pytest.raises(KeyboardInterrupt):
        write_files({str(path): NEW for path in paths})
    assert [path.read_bytes() for path in sorted(tmp_path.iterdir())] == [NEW] * 3
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="needs signals")
def test_a_termination_waits_until_all_of_several_files_are_written(tmp_path: Path) -> None:
    code = (
        "import os, signal\n"
        "from yamaro.output import write_files\n"
        "replace = os.replace\n"
        "def terminated(*words):\n"
        "    replace(*words)\n"
        "    os.kill(os.getpid(), signal.SIGTERM)\n"
        "os.replace = terminated\n"
        "write_files({'a': b'new', 'b': b'new'})\n"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=False)
    assert done.returncode == -signal.SIGTERM
    assert [path.read_bytes() for path in sorted(tmp_path.iterdir())] == [b"new"] * 2


def test_devices_and_pipes_are_written_to_directly(tmp_path: Path) -> None:
    write_file(os.devnull, [NEW])
    assert stat.S_ISCHR(os.stat(os.devnull).st_mode)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    received: list[bytes] = []
    reader = threading.Thread(target=lambda: received.append(pipe.read_bytes()))
    reader.start()
    write_file(str(pipe), [NEW])
    reader.join(PATIENCE)
    assert received == [NEW]
    assert stat.S_ISFIFO(os.stat(pipe).st_mode)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_full_device_is_an_error() -> None:
    with pytest.raises(OSError, match="No space left") as caught:
        write_file("/dev/full", [NEW])
    assert caught.value.errno == errno.ENOSPC


@pytest.mark.parametrize("call", ["write", "fsync", "replace", "close", "fchmod"])
@pytest.mark.parametrize("fault", [OSError(errno.ENOSPC, "full"), KeyboardInterrupt()])
def test_a_failing_step_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: str, fault: BaseException
) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    target.chmod(0o600)
    real_close = os.close

    def fail(*arguments: Any) -> None:
        if call == "close":
            real_close(arguments[0])
        raise fault

    with monkeypatch.context() as patch:
        patch.setattr(os, call, fail)
        with pytest.raises(type(fault)):
            write_file(str(target), [NEW])
    assert target.read_bytes() == OLD
    assert entries(tmp_path) == ["a"]
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


def test_short_writes_are_continued(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real_write = os.write
    monkeypatch.setattr(os, "write", lambda fd, data: real_write(fd, data[:3]))
    write_file(str(tmp_path / "a"), [NEW] * 5)
    assert (tmp_path / "a").read_bytes() == NEW * 5


def test_a_pipe_that_does_not_block_is_waited_for() -> None:
    read_end, write_end = os.pipe()
    os.set_blocking(write_end, False)
    content = os.urandom(300_000)
    received: list[bytes] = []

    def read() -> None:
        while chunk := os.read(read_end, 65536):
            received.append(chunk)

    reader = threading.Thread(target=read)
    reader.start()
    write_all(write_end, [content])
    os.close(write_end)
    reader.join(PATIENCE)
    os.close(read_end)
    assert b"".join(received) == content


# A program that stops in the middle of writing and says so; the parent then sends a signal.
STUCK = """
import os, sys, time
from yamaro import output
def fsync(descriptor):
    print("writing", flush=True)
    time.sleep(600)
os.fsync = fsync
output.write_file(sys.argv[1], [b"new"])
"""


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_signal_while_writing_removes_the_temporary_file(tmp_path: Path, number: int) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    process = subprocess.Popen(
        [sys.executable, "-c", STUCK, str(target)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"writing\n"
    assert len(entries(tmp_path)) == 2
    process.send_signal(number)
    assert process.wait(PATIENCE) == -number
    process.stdout.close()
    assert target.read_bytes() == OLD
    assert entries(tmp_path) == ["a"]


def test_kill_while_writing_leaves_the_old_file_whole(tmp_path: Path) -> None:
    target = tmp_path / "a"
    target.write_bytes(OLD)
    process = subprocess.Popen([sys.executable, "-c", STUCK, str(target)], stdout=subprocess.PIPE)
    assert process.stdout is not None
    process.stdout.readline()
    process.kill()
    process.wait(PATIENCE)
    process.stdout.close()
    assert target.read_bytes() == OLD
    write_file(str(target), [NEW])
    assert target.read_bytes() == NEW


def test_signals_that_others_treat_are_left_to_them(tmp_path: Path) -> None:
    seen: list[int] = []
    before = signal.signal(signal.SIGTERM, lambda number, frame: seen.append(number))
    try:
        write_file(str(tmp_path / "a"), [NEW])
        os.kill(os.getpid(), signal.SIGTERM)
        assert seen == [signal.SIGTERM]
    finally:
        signal.signal(signal.SIGTERM, before)


def test_writing_works_outside_the_main_thread(tmp_path: Path) -> None:
    thread = threading.Thread(target=write_file, args=(str(tmp_path / "a"), [NEW]))
    thread.start()
    thread.join()
    assert (tmp_path / "a").read_bytes() == NEW


def test_writers_at_the_same_time_leave_one_whole_file(tmp_path: Path) -> None:
    target = str(tmp_path / "a")
    contents = [bytes([65 + n]) * 200_000 for n in range(4)]

    def rewrite(content: bytes) -> None:
        for _ in range(5):
            write_file(target, [content])

    threads = [threading.Thread(target=rewrite, args=(content,)) for content in contents]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert Path(target).read_bytes() in contents
    assert entries(tmp_path) == ["a"]


def test_an_input_is_recognised_under_any_name(tmp_path: Path) -> None:
    source = tmp_path / "robot.yaml"
    source.write_bytes(OLD)
    (tmp_path / "link").symlink_to(source)
    os.link(source, tmp_path / "hard")
    (tmp_path / "other").write_bytes(OLD)
    inputs = [str(tmp_path / "missing"), str(source)]
    for name in ("robot.yaml", "link", "hard", "../" + tmp_path.name + "/robot.yaml"):
        assert is_input(f"{tmp_path}/{name}", inputs), name
    for name in ("other", "new"):
        assert not is_input(f"{tmp_path}/{name}", inputs), name
    assert not is_input(os.devnull, [os.devnull])


def test_standard_output_has_all_its_names() -> None:
    assert {"-", "/dev/stdout"} <= output.STANDARD_OUTPUT


# --- standard streams -------------------------------------------------------------------------


def test_result_goes_to_streams_with_and_without_bytes(monkeypatch: pytest.MonkeyPatch) -> None:
    text_stream = io.StringIO()
    monkeypatch.setattr(sys, "stdout", text_stream)
    Streams(quiet=False).write_result(["é".encode()])
    assert text_stream.getvalue() == "é"
    byte_stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", byte_stream)
    Streams(quiet=False).write_result(["é".encode()])
    assert byte_stream.buffer.getvalue() == "é".encode()


def test_diverted_prints_go_to_standard_error_or_nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    out, err = io.StringIO(), io.StringIO()
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "stderr", err)
    for quiet in (False, True):
        streams = Streams(quiet=quiet)
        streams.divert()
        print("stray", quiet)
        print("error", quiet, file=sys.stderr)
        streams.say(f"said {quiet}")
        streams.restore()
        assert sys.stdout is out
        assert sys.stderr is err
    assert out.getvalue() == ""
    assert err.getvalue() == "stray False\nerror False\nsaid False\nsaid True\n"


def test_what_the_encoding_lacks_is_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stderr", stream)
    Streams(quiet=False).say("a…\udcff")
    assert stream.buffer.getvalue() == b"a\\u2026\\udcff\n"


def test_streams_that_are_missing_or_closed_do_no_harm(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    monkeypatch.setattr(sys, "stderr", None)
    streams = Streams(quiet=False)
    streams.divert()
    streams.say("unheard")
    streams.restore()
    assert not streams.is_terminal()
    assert streams.result_encoding() == "utf-8"
    with pytest.raises(OSError, match="Bad file descriptor"):
        streams.write_result([NEW])
    closed = io.StringIO()
    closed.close()
    monkeypatch.setattr(sys, "stderr", closed)
    streams = Streams(quiet=False)
    streams.say("unheard")
    assert not streams.is_terminal()
