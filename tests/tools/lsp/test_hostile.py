"""Opening hostile files in an editor runs nothing of them outside of the jail."""

from __future__ import annotations

import os
import sys

import pytest

from tests.hostile.hostile_inputs import read_inputs
from tests.tools.lsp.client import Client

WATCHED = """
import os, sys
server, log = os.getpid(), os.open(sys.argv[1], os.O_WRONLY | os.O_CREAT | os.O_APPEND)
def watch(event, arguments):
    first = arguments[0] if arguments else None
    here = os.getpid() == server
    if event == "exec":  # code objects of a file of the user's, in this process
        seen = here and getattr(first, "co_filename", "").startswith("<yamaro")
    elif event == "open":
        flags = arguments[2] if len(arguments) > 2 and isinstance(arguments[2], int) else 0
        seen = bool(flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)) and first != os.devnull
        seen = seen and not isinstance(first, int)
    else:
        seen = event in ("os.system", "subprocess.Popen", "os.exec", "os.posix_spawn",
                         "socket.connect", "os.remove", "os.rename", "os.mkdir")
    if seen and "/.coverage." not in str(first):  # written where coverage is measured
        os.write(log, f"{here} {event} {arguments!r}\\n".encode(errors="replace"))
sys.addaudithook(watch)
sys.argv = ["yamaro", "lsp"]
from yamaro.commands.main import main
sys.exit(main())
"""
INPUTS = [each for each in read_inputs() if each.files]
CHUNKS = 6


def _times(client: Client, uri: str) -> int:
    return sum(each["uri"] == uri for each in client.published)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the jail needs Linux")
@pytest.mark.slow
@pytest.mark.parametrize("chunk", range(CHUNKS))
def test_opening_hostile_files_runs_nothing(tmp_path, chunk):
    log = tmp_path / "log"
    log.touch()
    with Client(
        None,
        options={"timeout": 300},
        command=(sys.executable, "-B", "-c", WATCHED, str(log)),
    ) as client:
        for number, each in enumerate(INPUTS[chunk::CHUNKS]):
            folder = tmp_path / str(number)
            folder.mkdir()
            for file in each.files:
                if file.kind in ("", "cr", "crlf") and len(file.content) < 200_000:
                    file.write(folder)
            for path in sorted(folder.rglob("*")):
                if path.suffix in (".yaml", ".yml", ".xacro", ".urdf") and path.is_file():
                    text = path.read_bytes().decode("utf-8", "replace")
                    uri = client.open(path, text)
                    document = {"textDocument": {"uri": uri}}
                    client.request("textDocument/documentSymbol", document)
                    client.request("textDocument/semanticTokens/full", document)
                    client.wait_for(lambda uri=uri: _times(client, uri) > 1)  # it was built
                    client.notify("textDocument/didClose", document)
        assert client.close() == 0
    assert log.read_text() == ""
    assert os.path.exists(log)
