"""Symbols, definitions, references and renaming, as an editor sees them."""

from __future__ import annotations

import re

import pytest

from tests.tools.lsp.client import Client
from tests.waiting import wait_for

TREE = {"textDocument": {"documentSymbol": {"hierarchicalDocumentSymbolSupport": True}}}
ARM = """robot: arm
import: math
arguments:
  reach: {default: 0.85, unit: m, help: how far it reaches}
variables:
  length: 0.5
  half/global: $(length / 2)
functions:
  Arm(side, size=$(length), **Payload):
  - part:
      name: $(side)_arm
      joint: {type: fixed, parent: base, xyz: 0 0 $(size + half)}
  - Payload:
model:
- part:
    name: base
- for side in ['left', 'right']:
  - Arm:
      side: $(side)
      Payload:
      - print: $(side) $(size)
- Arm: middle, size=1
- part:
    name: tool
    joint: {type: fixed, parent: base_link}
"""


@pytest.fixture
def client(tmp_path):
    with Client(tmp_path, capabilities=TREE) as client:
        yield client


def _marks(locations):
    """Return line and column of each place, both from 1."""
    starts = [each["range"]["start"] for each in locations]
    return [(start["line"] + 1, start["character"] + 1) for start in starts]


def _names(symbols):
    return {each["name"]: _names(each.get("children", [])) for each in symbols}


def test_symbols_are_a_tree(client, tmp_path):
    uri = client.open(tmp_path / "arm.yaml", ARM)
    found = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
    names = _names(found)
    assert names["variables"] == {"length": {}, "half": {}}
    assert names["functions"] == {"Arm": {"$(side)_arm": {}, "Payload": {}}}
    assert list(names["model"]) == ["base", "Arm", "tool"]
    assert names["arguments"] == {"reach": {}}


def test_symbols_of_a_file_with_errors(client, tmp_path):
    broken = ARM.replace("    name: base\n", "    name: base\n    joint: {type: [\n")
    uri = client.open(tmp_path / "arm.yaml", broken)
    names = _names(client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}}))
    assert "Arm" in names["functions"]


@pytest.mark.parametrize(
    ("mark", "after", "wanted"),
    [
        ("$(length / 2)", 2, [(6, 3)]),
        ("size=$(length)", 8, [(6, 3)]),
        ("$(size + half)", 3, [(9, 13)]),
        ("$(size + half)", 10, [(7, 3)]),
        ("$(side)_arm", 3, [(9, 7)]),
        ("side: $(side)", 1, [(9, 7)]),
        ("side: $(side)", 9, [(17, 7)]),
        ("print: $(side)", 10, [(9, 7)]),
        ("$(side) $(size)", 11, [(9, 13)]),
        ("- Arm: middle", 3, [(9, 3)]),
        ("middle, size=1", 9, [(9, 13)]),
        ("  - Payload:", 6, [(9, 31)]),
        ("parent: base,", 9, [(16, 11)]),
        ("parent: base_link", 9, [(16, 11)]),
    ],
)
def test_definitions(client, tmp_path, mark, after, wanted):
    uri = client.open(tmp_path / "arm.yaml", ARM)
    found = client.request("textDocument/definition", client.at(uri, ARM, mark, after=after))
    assert _marks(found) == wanted


def test_definitions_of_aliases_and_files(client, tmp_path):
    (tmp_path / "leg.yaml").write_text("functions:\n  Leg/parent:\n    input: n\n    body:\n")
    text = "variables:\n  a: &a 1\n  b: *a\nmodel:\n- include: leg.yaml\n- Leg: 1\n"
    uri = client.open(tmp_path / "main.yaml", text)
    found = client.request("textDocument/definition", client.at(uri, text, "*a", after=1))
    assert _marks(found) == [(2, 6)]
    found = client.request("textDocument/definition", client.at(uri, text, "leg.yaml", after=1))
    assert found[0]["uri"].endswith("leg.yaml")
    found = client.request("textDocument/definition", client.at(uri, text, "- Leg", after=3))
    assert (found[0]["uri"][-8:], _marks(found)) == ("leg.yaml", [(2, 3)])


def test_references_of_variables_parameters_and_parts(client, tmp_path):
    uri = client.open(tmp_path / "arm.yaml", ARM)

    def references(mark, after, *, declares=True):
        parameters = client.at(uri, ARM, mark, after=after)
        parameters["context"] = {"includeDeclaration": declares}
        return _marks(client.request("textDocument/references", parameters))

    assert references("  length: 0.5", 3) == [(6, 3), (7, 18), (9, 20)]
    assert references("  length: 0.5", 3, declares=False) == [(7, 18), (9, 20)]
    assert references("(side, size", 1) == [(9, 7), (11, 15), (19, 7), (21, 18)]
    assert references("size=$", 1) == [(9, 13), (12, 53), (21, 26), (22, 16)]
    assert references("for side in", 5) == [(17, 7), (19, 15)]
    assert references("Arm(side", 1) == [(9, 3), (18, 5), (22, 3)]
    assert references("name: base", 7) == [(12, 36), (16, 11), (25, 34)]
    marks = client.request(
        "textDocument/documentHighlight", client.at(uri, ARM, "(side, size", after=1)
    )
    assert [each["kind"] for each in marks] == [3, 2, 2, 2]


def _renamed(client, uri, text, mark, after, new):
    """Return the text after a renaming, or the reason for none."""
    parameters = {**client.at(uri, text, mark, after=after), "newName": new}
    answer = client.ask("textDocument/rename", parameters)
    if "error" in answer:
        return answer["error"]["message"]
    lines = text.split("\n")
    for edit in sorted(
        answer["result"]["changes"][uri],
        key=lambda edit: (edit["range"]["start"]["line"], edit["range"]["start"]["character"]),
        reverse=True,
    ):
        start, end = edit["range"]["start"], edit["range"]["end"]
        line = lines[start["line"]]
        changed = line[: start["character"]] + edit["newText"] + line[end["character"] :]
        lines[start["line"]] = changed
    return "\n".join(lines)


def test_renaming_a_variable_a_parameter_a_function_and_a_part(client, tmp_path):
    uri = client.open(tmp_path / "arm.yaml", ARM)
    length = _renamed(client, uri, ARM, "  length: 0.5", 3, "reach_of_arm")
    assert length == ARM.replace("length", "reach_of_arm")
    size = _renamed(client, uri, ARM, "size + half", 1, "extent")
    assert size == ARM.replace("size", "extent")
    function = _renamed(client, uri, ARM, "- Arm: middle", 3, "Limb")
    assert function == ARM.replace("Arm", "Limb")
    part = _renamed(client, uri, ARM, "name: base", 7, "body")
    assert part == ARM.replace("base", "body")
    part = _renamed(client, uri, ARM, "parent: base_link", 9, "body_link")
    assert part == ARM.replace("base", "body")
    iterator = _renamed(client, uri, ARM, "for side", 5, "hand")
    assert iterator == ARM.replace("for side", "for hand").replace("side: $(side)", "side: $(hand)")


@pytest.mark.parametrize(
    ("mark", "after", "new", "reason"),
    [
        ("import: math", 9, "x", "from Python"),
        ("  length: 0.5", 3, "for", "not a name of a variable"),
        ("  length: 0.5", 3, "half", "declared already"),
        ("Arm(side", 1, "limb", "write a capital"),
        ("$(side)_arm", 9, "x", "computed"),
        ("type: fixed", 2, "x", "there is no variable"),
        ("name: base", 7, "tool", "named already"),
    ],
)
def test_what_cannot_be_renamed_says_why(client, tmp_path, mark, after, new, reason):
    uri = client.open(tmp_path / "arm.yaml", ARM)
    assert reason in _renamed(client, uri, ARM, mark, after, new)


def test_an_argument_is_renamed_unless_the_settings_pass_it(client, tmp_path):
    uri = client.open(tmp_path / "arm.yaml", ARM)
    assert _renamed(client, uri, ARM, "reach:", 1, "extent") == re.sub(r"\breach\b", "extent", ARM)
    options = {"arguments": {"arm.yaml": ["reach:=1"]}}
    (tmp_path / "other").mkdir()
    with Client(tmp_path / "other", options=options) as passing:
        uri = passing.open(tmp_path / "other" / "arm.yaml", ARM)
        reason = _renamed(passing, uri, ARM, "reach:", 1, "extent")
        assert "'reach' is passed by the settings" in reason


def test_names_that_process_sets_and_computed_ones_are_not_renamed(client, tmp_path):
    text = "variables:\n  a: 1\nprocess: a = a + 1\nlaunch:\n  x: $(a)\n"
    uri = client.open(tmp_path / "a.yaml", text)
    assert "assigned in `process`" in _renamed(client, uri, text, "  a: 1", 2, "b")
    text = "variables:\n  a: 1\n  $('b' + 'c'): 2\nlaunch:\n  x: $(a)\n"
    uri = client.open(tmp_path / "b.yaml", text)
    assert "computed" in _renamed(client, uri, text, "  a: 1", 2, "b")


def test_a_variable_is_renamed_in_all_files_of_the_program(client, tmp_path):
    leg = "variables:\n  length: 1\nmodel:\n- part:\n    name: foot $(length)\n"
    main = "robot: r\nmodel:\n- include:\n    path: leg.yaml\n    length: 2\n"
    (tmp_path / "leg.yaml").write_text(leg)
    (tmp_path / "main.yaml").write_text(main)
    uri = client.open(tmp_path / "main.yaml", main)
    parameters = {**client.at(uri, main, "length: 2", after=1), "newName": "size"}
    changes = client.request("textDocument/rename", parameters)["changes"]
    assert {name[-9:]: len(edits) for name, edits in changes.items()} == {
        "main.yaml": 1,
        "/leg.yaml": 2,
    }


def test_an_included_file_is_seen_as_a_part_of_its_program(client, tmp_path):
    (tmp_path / "main.yaml").write_text(
        "robot: r\nvariables:\n  length/child: 2\nmodel:\n- include: leg.yaml\n"
    )
    leg = "model:\n- part:\n    name: foot\n    link:\n      xyz: 0 0 $(length)\n"
    main = {"uri": (tmp_path / "main.yaml").as_uri(), "type": 1}
    client.notify("workspace/didChangeWatchedFiles", {"changes": [main]})  # it is new
    uri = client.open(tmp_path / "leg.yaml", leg)
    place = client.at(uri, leg, "length", after=1)
    found = wait_for(lambda: client.request("textDocument/definition", place))  # it looks around
    assert found[0]["uri"].endswith("main.yaml")
    client.change(uri, 2, [{"text": leg.replace("(length)", "(lenght)")}])
    client.wait_for_codes(uri, ["undefined-name"])
    assert "length" in client.diagnostics[uri][0]["message"]
    client.change(uri, 3, [{"text": leg}])
    client.wait_for_codes(uri, [])
