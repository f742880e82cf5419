"""When the system fails, or a signal ends the command, the old output is whole and nothing is left.

What the command says then is one line. tests/test_output.py has the writer alone,
tests/test_killed.py what `kill -9` leaves.
"""

from __future__ import annotations

import errno
import json
import os
import random
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.test_killed import LONG, left_over, long_document
from tests.waiting import PATIENCE
from yamaro import result
from yamaro.commands.main import main
from yamaro.output import write_file

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="has other system calls")

OLD = "<old/>\n"
SOURCE = "new:\n  for: {iterator: i, range: 20, body: {note/i=$(i): }}\n"
NEW = (
    '<?xml version="1.0"?>\n<new>\n'
    + "".join(f'  <note i="{i}"/>\n' for i in range(20))
    + "</new>\n"
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a folder with a file whose output comes in many chunks, and an old output."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(result, "PIECES_IN_CHUNK", 5)
    Path("file.yaml").write_text(SOURCE)
    Path("out.urdf").write_text(OLD)
    Path("out.urdf").chmod(0o640)
    return tmp_path


class FailingSystem:
    """The system calls for a temporary file, of which one fails.

    Attributes:
        called: how often each was called.
    """

    def __init__(self, patch: pytest.MonkeyPatch, call: str, fault: int, *, turn: int = 1) -> None:
        """Let `call` fail with the error number `fault` when it is called for the `turn`th time."""
        self.called: dict[str, int] = {}
        self._call, self._fault, self._turn = call, fault, turn
        self._descriptors: set[int] = set()
        for name in ("open", "fchmod", "write", "fsync", "close", "replace", "unlink"):
            patch.setattr(os, name, self._wrapped(name, getattr(os, name)))

    def _wrapped(self, name: str, real: Any) -> Any:
        def call(first: Any, *others: Any) -> Any:
            if first not in self._descriptors and ".yamaro-" not in str(first):
                return real(first, *others)
            self.called[name] = self.called.get(name, 0) + 1
            fails = name == self._call and self.called[name] == self._turn
            if fails and name != "close":
                return self._fail(real, first, *others)
            result = real(first, *others)
            if name == "open":
                self._descriptors.add(result)
            elif name == "close":
                self._descriptors.discard(first)
            return self._fail() if fails else result

        return call

    def _fail(self, *call: Any) -> Any:
        raise OSError(self._fault, os.strerror(self._fault))


class FillingSystem(FailingSystem):
    """A system whose disk takes only a part of what it is given, and then no more."""

    def _fail(self, *call: Any) -> Any:
        real, descriptor, data = call
        self._turn += 1
        if len(data) > 1:
            return real(descriptor, data[: len(data) // 2])
        return super()._fail()


def outcome(capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    """Run the command; return exit status, standard output and standard error."""
    status = main(["file.yaml", "-o", "out.urdf"])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def assert_old_file_is_whole(folder: Path) -> None:
    assert sorted(os.listdir(folder)) == ["file.yaml", "out.urdf"]
    assert (folder / "out.urdf").read_text() == OLD
    assert stat.S_IMODE((folder / "out.urdf").stat().st_mode) == 0o640


# --- each call in turn ------------------------------------------------------------------------

FAULTS = [errno.ENOSPC, errno.EIO, errno.EACCES, errno.EROFS, errno.EDQUOT]


@pytest.mark.parametrize("fault", FAULTS, ids=errno.errorcode.__getitem__)
@pytest.mark.parametrize("call", ["open", "fchmod", "write", "fsync", "close", "replace"])
def test_a_failing_call_is_told_in_one_line(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    call: str,
    fault: int,
) -> None:
    with monkeypatch.context() as patch:
        system = FailingSystem(patch, call, fault)
        expected = f"yamaro: error: cannot write 'out.urdf': {os.strerror(fault)}\n"
        assert outcome(capsys) == (1, "", expected)
    assert system.called[call] == 1
    assert ("replace" in system.called) == (call == "replace")
    assert_old_file_is_whole(folder)
    assert outcome(capsys) == (0, "", "")  # nothing stands in the way of the next
    assert Path("out.urdf").read_text() == NEW


def test_every_write_may_fail(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for turn in range(1, 100):
        with monkeypatch.context() as patch:
            system = FailingSystem(patch, "write", errno.ENOSPC, turn=turn)
            status, out, err = outcome(capsys)
        if status == 0:
            break
        assert (status, out) == (1, "")
        assert err == "yamaro: error: cannot write 'out.urdf': No space left on device\n"
        assert_old_file_is_whole(folder)
    assert system.called["write"] == turn - 1 > 4
    assert Path("out.urdf").read_text() == NEW


@pytest.mark.parametrize("turn", [1, 3])
def test_a_disk_that_takes_less_and_less_is_full(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, turn: int
) -> None:
    with monkeypatch.context() as patch:
        system = FillingSystem(patch, "write", errno.ENOSPC, turn=turn)
        expected = "yamaro: error: cannot write 'out.urdf': No space left on device\n"
        assert outcome(capsys) == (1, "", expected)
    assert system.called["write"] > turn + 3
    assert_old_file_is_whole(folder)


def test_a_write_that_takes_nothing_is_not_tried_for_ever(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        system = FailingSystem(patch, "write", 0)
        monkeypatch.setattr(system, "_fail", lambda *call: 0)
        expected = "yamaro: error: cannot write 'out.urdf': Input/output error\n"
        assert outcome(capsys) == (1, "", expected)
    assert_old_file_is_whole(folder)


def test_a_temporary_file_that_cannot_be_removed_does_not_hide_the_reason(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        FailingSystem(patch, "fsync", errno.EDQUOT)
        system = FailingSystem(patch, "unlink", errno.EROFS)
        expected = f"yamaro: error: cannot write 'out.urdf': {os.strerror(errno.EDQUOT)}\n"
        assert outcome(capsys) == (1, "", expected)
    assert system.called["unlink"] == 1
    assert Path("out.urdf").read_text() == OLD
    (temporary,) = left_over(folder)
    temporary.unlink()


def test_a_mode_that_is_right_is_not_set(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file system without modes, such as those of Windows, may refuse to set any."""
    before = os.umask(0o027)
    try:
        with monkeypatch.context() as patch:
            system = FailingSystem(patch, "fchmod", errno.EPERM)
            assert outcome(capsys) == (0, "", "")
    finally:
        os.umask(before)
    assert "fchmod" not in system.called
    assert Path("out.urdf").read_text() == NEW
    assert stat.S_IMODE(Path("out.urdf").stat().st_mode) == 0o640


@pytest.mark.parametrize("fault", [MemoryError(), RecursionError(), ValueError("x")], ids=repr)
def test_content_that_fails_to_come_leaves_the_old_file(folder: Path, fault: Exception) -> None:
    def chunks() -> Iterator[bytes]:
        yield b"<robot"
        assert len(left_over(folder)) == 1
        raise fault

    with pytest.raises(type(fault)):
        write_file("out.urdf", chunks())
    assert_old_file_is_whole(folder)


@pytest.mark.parametrize("call", ["makedirs", "stat"])
def test_a_folder_that_cannot_be_made_or_looked_at_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, call: str
) -> None:
    real = getattr(os, call)

    def fail(path: Any, *others: Any, **options: Any) -> Any:
        if "deep" in str(path):
            raise OSError(errno.EACCES, os.strerror(errno.EACCES))
        return real(path, *others, **options)

    monkeypatch.setattr(os, call, fail)
    assert main(["file.yaml", "-o", "deep/out.urdf"]) == 1
    assert capsys.readouterr() == (
        "",
        "yamaro: error: cannot write 'deep/out.urdf': Permission denied\n",
    )
    assert_old_file_is_whole(folder)


# --- limits and disks of the system's own -----------------------------------------------------

# Runs the command, and then tells what there is in the folder.
TOLD = """
import io, json, os, sys
from contextlib import redirect_stderr
from yamaro.commands.main import main

def tell(*words):
    said = io.StringIO()
    with redirect_stderr(said):
        status = main(words)
    return status, said.getvalue()

def tell_folder(name):
    return {n: open(f"{name}/{n}").read() for n in os.listdir(name)}
"""


def told(*command: str) -> Any:
    """Return the JSON that a script behind TOLD prints, or skip where it says that it cannot."""
    finished = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=True)
    result = json.loads(finished.stdout)
    if isinstance(result, str):
        pytest.skip(result)
    return result


LIMITED = (
    TOLD
    + """
import resource
before = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, (300, before[1]))
outcome = tell("file.yaml", "-o", "out.urdf")
resource.setrlimit(resource.RLIMIT_FSIZE, before)
print(json.dumps(outcome))
"""
)


def test_a_limit_on_the_size_of_files_is_told(folder: Path) -> None:
    assert len(NEW) > 300
    line = "yamaro: error: cannot write 'out.urdf': File too large\n"
    assert told(sys.executable, "-c", LIMITED) == [1, line]
    assert_old_file_is_whole(folder)


MOUNTED = (
    TOLD
    + """
import subprocess
state, folder = sys.argv[1:]
def mount(*words):
    if subprocess.run(["mount", *words, folder], capture_output=True).returncode:
        print(json.dumps("mounting is not permitted here"))
        sys.exit()
mount("-t", "tmpfs", "-o", "size=64k", "tmpfs")
out = folder + "/out.urdf"
with open(out, "w") as file:
    file.write("old" * 5000)
if state == "read-only":
    mount("-o", "remount,ro")
outcome = tell("file.yaml", "-o", out)
print(json.dumps([*outcome, tell_folder(folder)]))
"""
)


@pytest.mark.skipif(not shutil.which("unshare"), reason="needs unshare")
@pytest.mark.parametrize(
    ("state", "reason"),
    [("full", "No space left on device"), ("read-only", "Read-only file system")],
)
def test_a_disk_that_is_full_or_read_only_is_told(folder: Path, state: str, reason: str) -> None:
    Path("file.yaml").write_text(LONG)  # 26 MB
    Path("disk").mkdir()
    spaces = ["unshare", "--mount", "--user", "--map-root-user"]
    if subprocess.run([*spaces, "true"], capture_output=True).returncode:
        pytest.skip("name spaces are not permitted here")
    out = f"{folder}/disk/out.urdf"
    expected = [1, f"yamaro: error: cannot write '{out}': {reason}\n", {"out.urdf": "old" * 5000}]
    assert told(*spaces, sys.executable, "-c", MOUNTED, state, f"{folder}/disk") == expected


UNPRIVILEGED = (
    TOLD
    + """
os.chdir(sys.argv[1])
tell("file.yaml", "-o", "free/out.urdf")  # what is imported may be out of reach later
if os.geteuid() == 0:
    try:
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)
    except OSError:
        print(json.dumps("nobody else is known here"))
        sys.exit()
if not os.access("closed/out.urdf", os.W_OK):
    print(json.dumps("others may not look at temporary files here"))
    sys.exit()
outcomes = tell("file.yaml", "-o", "closed/out.urdf"), tell("file.yaml", "-o", "closed/new.urdf")
print(json.dumps([outcomes, tell_folder("closed")]))
"""
)


def test_a_folder_that_may_not_be_written_to_is_told() -> None:
    """The file in it may be written to, but could not be replaced in one step."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        (folder / "file.yaml").write_text(SOURCE)
        for inner in ("free", "closed"):
            (folder / inner).mkdir()
        (folder / "closed" / "out.urdf").write_text(OLD)
        (folder / "closed" / "out.urdf").chmod(0o666)
        (folder / "closed").chmod(0o555)
        try:
            outcomes, files = told(sys.executable, "-c", UNPRIVILEGED, name)
        finally:
            (folder / "closed").chmod(0o755)
    line = "yamaro: error: cannot write 'closed/{}.urdf': Permission denied\n"
    assert outcomes == [[1, line.format("out")], [1, line.format("new")]]
    assert files == {"out.urdf": OLD}


# --- signals ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("number", "status"),
    [
        (signal.SIGINT, 130),
        (signal.SIGTERM, -signal.SIGTERM),  # 143 in a shell
        (signal.SIGHUP, -signal.SIGHUP),
    ],
    ids=["SIGINT", "SIGTERM", "SIGHUP"],
)
def test_a_signal_at_any_moment_of_writing_leaves_a_whole_file_and_nothing_else(
    tmp_path: Path, number: int, status: int
) -> None:
    source, folder = tmp_path / "long.yaml", tmp_path / "out"
    source.write_text(LONG)
    folder.mkdir()
    path = folder / "out.xml"
    new = long_document(1)
    moments = random.Random(number)
    ended, turns = 0, 0
    while ended < 3:  # a signal may also come too late
        turns += 1
        assert turns < 100
        path.write_text(OLD)
        words = [str(source), "-o", str(path), "version:=1"]
        process = subprocess.Popen(
            [sys.executable, "-m", "yamaro", *words], stderr=subprocess.PIPE, text=True
        )
        while not left_over(folder) and process.poll() is None:
            time.sleep(0.0005)
        time.sleep(moments.uniform(0, 0.02))
        process.send_signal(number)
        _, said = process.communicate(timeout=PATIENCE)
        assert process.returncode in (status, 0)
        assert said == ""
        is_ended = process.returncode != 0
        assert path.read_bytes() in ([OLD.encode(), new] if is_ended else [new])
        assert os.listdir(folder) == ["out.xml"]
        ended += is_ended


def test_a_hang_up_that_is_to_be_ignored_is_ignored(tmp_path: Path) -> None:
    """As under `nohup`."""
    (tmp_path / "long.yaml").write_text(LONG)
    (tmp_path / "out").mkdir()
    path = tmp_path / "out" / "out.xml"
    command = 'trap "" HUP; exec "$0" -m yamaro long.yaml -o out/out.xml'
    process = subprocess.Popen(["sh", "-c", command, sys.executable], cwd=tmp_path)
    while not left_over(path.parent) and process.poll() is None:
        time.sleep(0.0005)
    process.send_signal(signal.SIGHUP)
    assert process.wait(PATIENCE) == 0
    assert path.read_bytes() == long_document(0)


def test_yamaro_is_found_by_the_processes_of_these_tests() -> None:
    code = "import yamaro; print(yamaro.__file__)"
    finished = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert finished.stdout.strip() == yamaro.__file__
