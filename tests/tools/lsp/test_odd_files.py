"""Files as they are while people work: empty, endless, deleted, changed elsewhere, open twice."""

from __future__ import annotations

import sys
from contextlib import suppress

import pytest

from tests.tools.lsp.client import Client
from tests.tools.lsp.test_protocol import ROBOT
from tests.waiting import wait_for
from yamaro.syntax.python_names import names_in_text
from yamaro.tools.lsp import FEATURES

FAULTY = ROBOT.replace("parent: base", "parent: bse")
MAIN = "robot: r\nmodel:\n- include: leg.yaml\n- part:\n    name: base\n- Leg: left\n"
LEG = """functions:
  Leg(side)/parent:
  - part:
      name: $(side)
      joint: {type: fixed, parent: base}
"""
WRONG_LEG = LEG.replace("parent: base", "parent: bose")
ENDLESS = """robot: r
model:
- for i in range(100000):
  - for j in range(100000):
    - if i < 0:
      - part: {name: a}
"""
CREATED, CHANGED, DELETED = 1, 2, 3


def _tell(client, uri, kind):
    client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri, "type": kind}]})


def test_an_empty_file_has_an_answer_to_everything(tmp_path):
    start = {"line": 0, "character": 0}
    with Client(tmp_path) as client:
        uri = client.open(tmp_path / "r.yaml", "")
        for method in FEATURES:
            if "ename" not in method:
                parameters = {
                    "textDocument": {"uri": uri},
                    "position": start,
                    "range": {"start": start, "end": start},
                    "context": {},
                }
                client.request(method, parameters)
        assert client.logs == []


def test_the_files_of_a_program_may_change_in_other_buffers_and_on_the_disk(tmp_path):
    (tmp_path / "leg.yaml").write_text(LEG)
    (tmp_path / "r.yaml").write_text(MAIN)
    with Client(tmp_path) as client:
        main = client.open(tmp_path / "r.yaml")
        leg = client.open(tmp_path / "leg.yaml")
        client.change(leg, 2, [{"text": LEG.replace("Leg(", "Lag(")}])
        client.wait_for_codes(main, ["undefined-function"])
        client.change(leg, 3, [{"text": WRONG_LEG}])
        client.wait_for_codes(leg, ["unknown-parent"])
        assert client.codes(main) == []
        client.notify("textDocument/didClose", {"textDocument": {"uri": leg}})
        client.wait_for_codes(leg, [])
        (tmp_path / "leg.yaml").write_text(WRONG_LEG)
        _tell(client, leg, CHANGED)
        client.wait_for_codes(leg, ["unknown-parent"])
        (tmp_path / "leg.yaml").unlink()
        _tell(client, leg, DELETED)
        client.wait_for_codes(main, ["missing-file"])
        (tmp_path / "leg.yaml").write_text(LEG)
        _tell(client, leg, CREATED)
        client.wait_for_codes(main, [])
        assert client.logs == []


def test_a_file_may_be_deleted_while_it_is_open(tmp_path):
    path = tmp_path / "r.yaml"
    path.write_text(FAULTY)
    with Client(tmp_path) as client:
        uri = client.open(path)
        client.wait_for_codes(uri, ["unknown-parent"])
        path.unlink()
        _tell(client, uri, DELETED)
        client.change(uri, 2, [{"text": ROBOT}])
        client.wait_for_codes(uri, [])
        client.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
        client.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
        assert client.close() == 0
        assert client.logs == []


def test_two_editors_have_a_file_open(tmp_path):
    path = tmp_path / "r.yaml"
    path.write_text(FAULTY)
    with Client(tmp_path) as one, Client(tmp_path) as other:
        uri = one.open(path)
        other.open(path)
        one.wait_for_codes(uri, ["unknown-parent"])
        other.wait_for_codes(uri, ["unknown-parent"])
        one.change(uri, 2, [{"text": ROBOT}])
        one.wait_for_codes(uri, [])
        path.write_text(ROBOT)  # the other editor has its own text until it reads the file again
        other.change(uri, 2, [{"text": FAULTY.replace("bse", "bas")}])
        other.wait_for(lambda: "bas" in str(other.diagnostics[uri]))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc")
def test_a_build_that_runs_ends_with_the_server(tmp_path):
    from pathlib import Path

    def children():
        found = []
        for task in Path(f"/proc/{client.process.pid}/task").iterdir():
            with suppress(FileNotFoundError):  # a thread that has ended meanwhile
                found += (task / "children").read_text().split()
        return found

    with Client(tmp_path, options={"timeout": 600_000}) as client:
        client.open(tmp_path / "r.yaml", ENDLESS)
        running = wait_for(children)
        assert client.close() == 0
    wait_for(lambda: not any(Path(f"/proc/{each}").exists() for each in running))


@pytest.mark.parametrize("uri", ["file:///c%3A/a%20b/r.yaml", "untitled:Untitled-1"])
def test_uris_stay_as_the_editor_spells_them(tmp_path, uri):
    document = {"uri": uri, "languageId": "yamaro", "version": 1, "text": ROBOT}
    with Client(tmp_path) as client:
        client.notify("textDocument/didOpen", {"textDocument": document})
        place = client.at(uri, ROBOT, "$(length)", after=3)
        found = client.request("textDocument/definition", place)
        assert [each["uri"] for each in found] == [uri]
        edit = client.request("textDocument/rename", {**place, "newName": "reach"})
        assert list(edit["changes"]) == [uri]


@pytest.mark.parametrize("text", ["+".join(["x"] * 20_000), "-" * 20_000 + "x"])
def test_names_are_found_however_deep_an_expression_is(text):
    found = {each.name for each in names_in_text(text, is_block=False)}
    assert found <= {"x"}  # Python may refuse to parse it


def test_names_are_found_in_an_expression_of_a_thousand_terms():
    found = names_in_text("+".join(["x"] * 1_000), is_block=False)
    assert [each.start for each in found] == list(range(0, 2_000, 2))
