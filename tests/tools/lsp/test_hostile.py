"""Opening hostile files in an editor runs nothing of them outside of the jail."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.effort import tried
from tests.hostile.escape_payloads import Payload, read_payloads
from tests.hostile.hostile_inputs import HUGE, HostileInput, read_inputs
from tests.tools.lsp.client import Client

WATCHED = """
import os, sys
server, log = os.getpid(), os.open(sys.argv[1], os.O_WRONLY | os.O_CREAT | os.O_APPEND)
def watch(event, arguments):
    first = arguments[0] if arguments else None
    here = os.getpid() == server
    if event == "exec":  # code objects of a file of the user's, in this process
        name = getattr(first, "co_filename", "")
        seen = here and name.startswith("<yamaro") and "/yamaro/tools/lsp/usual.yaml" not in name
    elif event == "open":
        flags = arguments[2] if len(arguments) > 2 and isinstance(arguments[2], int) else 0
        seen = bool(flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)) and first != os.devnull
        seen = seen and not isinstance(first, int)
    else:
        seen = event in ("os.system", "subprocess.Popen", "os.exec", "os.posix_spawn",
                         "socket.connect", "os.remove", "os.rename", "os.mkdir")
    if seen:
        os.write(log, f"{here} {event} {arguments!r}\\n".encode(errors="replace"))
sys.addaudithook(watch)
sys.argv = ["yamaro", "lsp"]
from yamaro.commands.main import main
sys.exit(main())
"""
UNMEASURED = {"COVERAGE_PROCESS_CONFIG": None, "COVERAGE_PROCESS_START": None}
"""Coverage would write files, and take as long as ten of these tests."""
CHUNKS = 2


class Case(NamedTuple):
    """Files to write into a folder and to open."""

    name: str
    write: Callable[[Path], object]


def _cases() -> list[Case]:
    """Return some of the hostile files and attacks, which the command meets in other tests."""
    given = [each for each in read_inputs() if each.files]
    files = tried(given, lambda each: each.name, quick=12, usual=4)
    inputs = [Case(each.name, partial(_write_input, each)) for each in files]
    payloads = tried(read_payloads(), lambda each: each.name, quick=36, usual=12)
    attacks = [Case(each.name, partial(_write_attack, each)) for each in payloads]
    return inputs + attacks


def _write_input(given: HostileInput, folder: Path) -> None:
    for file in given.files:
        file.write(folder)


def _write_attack(attack: Payload, folder: Path) -> None:
    """Write a file that runs an attack on safe mode, in an expression or in `process`."""
    if attack.mode == "exec":
        code = "\n".join(f"    {line}" for line in attack.text.split("\n"))
        text = f"root:\n- process: |\n{code}\n"
    else:
        text = f"root:\n- print: {json.dumps(f'$({attack.text})')}\n"
    (folder / "robot.yaml").write_text(text, encoding="utf-8", errors="surrogatepass")


CASES = _cases()


def _times(client: Client, uri: str) -> int:
    return sum(each["uri"] == uri for each in client.published)


def _open(client: Client, path: Path) -> None:
    """Open a file as an editor does, and wait until it was built."""
    uri = client.open(path, path.read_bytes().decode("utf-8", "replace"))
    document = {"textDocument": {"uri": uri}}
    client.request("textDocument/documentSymbol", document)
    client.request("textDocument/semanticTokens/full", document)
    client.wait_for(lambda: _times(client, uri) > 1)
    client.notify("textDocument/didClose", document)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the jail needs Linux")
@pytest.mark.slow
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_opening_hostile_files_runs_nothing(tmp_path, monkeypatch, chunk):
    log = tmp_path / "log"
    log.touch()
    monkeypatch.chdir(tmp_path)  # sockets have short names
    with Client(
        None,
        options={"timeout": 300},
        env=UNMEASURED,
        command=(sys.executable, "-B", "-c", WATCHED, str(log)),
    ) as client:
        for number, each in enumerate(CASES[chunk::CHUNKS]):
            folder = tmp_path / str(number)
            folder.mkdir()
            each.write(folder)
            for path in sorted(folder.rglob("*")):
                if path.suffix in (".yaml", ".yml", ".xacro", ".urdf") and _is_text(path):
                    _open(client, path)
        assert client.close() == 0
    assert log.read_text() == ""


def _is_text(path: Path) -> bool:
    """Return whether an editor would open a file."""
    return path.is_file() and path.stat().st_size < HUGE and os.access(path, os.R_OK)
