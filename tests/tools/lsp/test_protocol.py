"""The protocol itself: start and end, broken messages, edits, columns."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.tools.lsp.client import UTF_32, Client
from tests.waiting import PATIENCE
from yamaro.codes import help_uri

ROBOT = """robot: rover
variables:
  length: 0.5
model:
- part:
    name: base
    link: {visual: {geometry: box, size: 1 1 1}}
- part:
    name: arm
    joint: {type: fixed, parent: base, xyz: 0 0 $(length)}
"""


def test_a_session_begins_and_ends(tmp_path):
    with Client(tmp_path) as client:
        assert client.server["serverInfo"]["name"] == "yamaro"
        assert client.server["capabilities"]["positionEncoding"] == "utf-16"
        assert client.close() == 0


def test_exit_without_shutdown_is_a_failure(tmp_path):
    with Client(tmp_path) as client:
        client.notify("exit", None)
        assert client.wait() == 1


def test_the_end_of_the_input_ends_the_server(tmp_path):
    with Client(tmp_path) as client:
        assert client.process.stdin is not None
        client.process.stdin.close()
        assert client.process.wait(timeout=PATIENCE) == 1
        client.process.stdin = subprocess.PIPE  # type: ignore[assignment]
        for stream in (client.process.stdout, client.process.stderr):
            assert stream is not None
            stream.close()


def test_requests_before_initialize_are_refused():
    message = b'{"jsonrpc":"2.0","id":1,"method":"textDocument/hover","params":{}}'
    data = b"Content-Length: %d\r\n\r\n%b" % (len(message), message)
    done = subprocess.run(
        [sys.executable, "-m", "yamaro", "lsp"],
        input=data,
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    assert b'"code":-32002' in done.stdout
    assert done.stderr == b""
    assert done.returncode == 1


def test_a_broken_message_does_not_end_the_session(tmp_path):
    with Client(tmp_path) as client:
        for broken in (b"{", b"[]", b"3", b'{"jsonrpc":"2.0","id":7,"method":"no/such"}'):
            client.send_bytes(b"Content-Length: %d\r\n\r\n%b" % (len(broken), broken))
        client.send({"id": 99, "method": "textDocument/definition", "params": {"textDocument": 3}})
        answer = client.ask("textDocument/definition", None)
        assert answer["error"]["code"] == -32602
        assert client.close() == 0


def test_nothing_but_the_option_for_editors_is_taken(tmp_path):
    for extra, word in (("robot.yaml", "unexpected argument"), ("--strict", "cannot be used")):
        done = subprocess.run(
            [sys.executable, "-m", "yamaro", "lsp", extra],
            input=b"",
            capture_output=True,
            check=False,
        )
        assert done.returncode == 2
        assert word in done.stderr.decode()
    with Client(command=(sys.executable, "-m", "yamaro", "lsp", "--stdio")) as client:
        assert client.close() == 0


def test_an_error_appears_at_the_change_and_goes_with_it(tmp_path):
    path = tmp_path / "rover.yaml"
    with Client(tmp_path) as client:
        uri = client.open(path, ROBOT)
        client.wait_for_codes(uri, [])
        broken = ROBOT.replace("$(length)", "$(length +)")
        client.change(uri, 2, [{"text": broken}])
        client.wait_for_codes(uri, ["python-syntax"])
        assert client.versions[uri] == 2
        (found,) = client.diagnostics[uri]
        assert found["codeDescription"] == {"href": help_uri("python-syntax")}
        client.change(uri, 3, [{"text": ROBOT}])
        client.wait_for(lambda: client.versions[uri] == 3 and client.codes(uri) == [])


def test_what_only_a_build_can_find_comes_after_a_pause(tmp_path):
    path = tmp_path / "rover.yaml"
    with Client(tmp_path) as client:
        uri = client.open(path, ROBOT.replace("parent: base", "parent: bse"))
        client.wait_for_codes(uri, ["unknown-parent"])
        found = client.diagnostics[uri][0]
        assert found["range"] == {
            "start": {"line": 9, "character": 33},
            "end": {"line": 9, "character": 36},
        }
        assert "did you mean 'base_link'" in found["message"]
        client.change(uri, 2, [{"text": ROBOT}])
        client.wait_for_codes(uri, [])


def test_an_edit_moves_what_a_build_has_found(tmp_path):
    path = tmp_path / "rover.yaml"
    with Client(tmp_path, options={"pause": 3_000_000}) as client:
        uri = client.open(path, ROBOT.replace("parent: base", "parent: bse"))
        client.wait_for_codes(uri, ["unknown-parent"])
        start = {"line": 0, "character": 0}
        client.change(uri, 2, [{"range": {"start": start, "end": start}, "text": "# one\n\n"}])
        client.wait_for(lambda: client.versions[uri] == 2)
        assert client.diagnostics[uri][0]["range"]["start"] == {"line": 11, "character": 33}


@pytest.mark.parametrize("capabilities", [{}, UTF_32])
def test_columns_are_counted_as_agreed(tmp_path, capabilities):
    text = "launch:\n  a: $('🤖🤖' + lenght)\n"
    path = tmp_path / "a.yaml"
    with Client(tmp_path, capabilities=capabilities) as client:
        uri = client.open(path, text)
        client.wait_for_codes(uri, ["undefined-name"])
        start = client.diagnostics[uri][0]["range"]["start"]
        line = text.splitlines()[1]
        before = line[: line.index("lenght")]
        wanted = len(before) if capabilities else len(before.encode("utf-16-le")) // 2
        assert start == {"line": 1, "character": wanted}
        # and back again: an edit behind the two signs
        edit = {
            "range": {
                "start": {"line": 1, "character": wanted},
                "end": {"line": 1, "character": wanted + len("lenght")},
            },
            "text": "'x'",
        }
        client.change(uri, 2, [edit])
        client.wait_for_codes(uri, [])


def test_lines_may_end_in_carriage_returns(tmp_path):
    path = tmp_path / "rover.yaml"
    text = ROBOT.replace("parent: base", "parent: bse").replace("\n", "\r\n")
    with Client(tmp_path) as client:
        uri = client.open(path, text)
        client.wait_for_codes(uri, ["unknown-parent"])
        assert client.diagnostics[uri][0]["range"]["start"] == {"line": 9, "character": 33}
        place = {"line": 9, "character": 36}
        end = {"line": 9, "character": 33}
        client.change(uri, 2, [{"range": {"start": end, "end": place}, "text": "base"}])
        client.wait_for_codes(uri, [])


def test_names_of_files_may_hold_spaces_and_signs(tmp_path):
    folder = tmp_path / "a b ü"
    folder.mkdir()
    path = folder / "my robot%.yaml"
    with Client(folder) as client:
        uri = client.open(path, ROBOT.replace("parent: base", "parent: bse"))
        assert "%20" in uri
        client.wait_for_codes(uri, ["unknown-parent"])


def test_a_file_that_is_closed_leaves_nothing_behind(tmp_path):
    path = tmp_path / "rover.yaml"
    path.write_text(ROBOT)
    with Client(tmp_path) as client:
        uri = client.open(path, ROBOT.replace("parent: base", "parent: bse"))
        client.wait_for_codes(uri, ["unknown-parent"])
        client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
        client.wait_for_codes(uri, [])


def test_files_are_found_by_their_uris():
    from yamaro.tools.lsp.protocol import path_of, uri_of

    for path in ("/a/b.yaml", "/a b/ü%25.yaml", "/x/🤖.yaml"):
        assert path_of(uri_of(path)) == path
        assert uri_of(path) == Path(path).as_uri()
    assert path_of("file://localhost/a/b") == "/a/b"
    assert path_of("untitled:Untitled-1") == "untitled:Untitled-1"
