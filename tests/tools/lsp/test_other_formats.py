"""MJCF and SDF in an editor: what is wrong with them, their names, and the files they name."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.tools.lsp.client import Client

TREES = {"textDocument": {"documentSymbol": {"hierarchicalDocumentSymbolSupport": True}}}
ASSETS = '<mujoco><asset><material name="red" rgba="1 0 0 1"/></asset></mujoco>'
ARM = """<mujoco model="arm">
  <compiler angle="radian"/>
  <include file="assets.xml"/>
  <default><default class="bend"><joint range="-1 1"/></default></default>
  <worldbody>
    <body name="base">
      <geom type="box" size="0.1 0.1 0.05" material="red"/>
      <body name="upper" pos="0 0 0.05">
        <joint name="shoulder" class="bend" axis="0 1 0"/>
        <geom type="box" size="0.02 0.02 0.2"/>
      </body>
    </body>
  </worldbody>
  <actuator><position name="drive" joint="shoulder" kp="20"/></actuator>
</mujoco>
"""
PENDULUM = """<sdf version="1.9">
  <model name="pendulum">
    <link name="stand"/>
    <link name="rod"><pose relative_to="swing"/></link>
    <joint name="swing" type="revolute">
      <parent>stand</parent>
      <child>rods</child>
      <axis><xyz>0 1 0</xyz></axis>
    </joint>
  </model>
</sdf>
"""


@pytest.fixture
def client(tmp_path: Path) -> Iterator[Client]:
    (tmp_path / "assets.xml").write_text(ASSETS)
    (tmp_path / "arm.xml").write_text(ARM)
    (tmp_path / "pendulum.sdf").write_text(PENDULUM)
    (tmp_path / "package.xml").write_text("<package><name>arm</name></pack>")
    with Client(tmp_path, capabilities=TREES, options={"timeout": 60_000}) as made:
        yield made


def at(path: Path, text: str) -> dict[str, Any]:
    """Return the parameters of a request about a `|` in a stretch of a file."""
    whole = path.read_text()
    offset = whole.index(text.replace("|", "")) + text.index("|")
    line = whole.count("\n", 0, offset)
    place = {"line": line, "character": offset - whole.rfind("\n", 0, offset) - 1}
    return {"textDocument": {"uri": path.as_uri()}, "position": place}


def definitions(client: Client, path: Path, text: str) -> list[tuple[str, int]]:
    found = client.request("textDocument/definition", at(path, text))
    return [(Path(each["uri"]).name, each["range"]["start"]["line"] + 1) for each in found]


def outline(symbols: list[Any]) -> list[Any]:
    return [(each["detail"], each["name"], *outline(each.get("children", []))) for each in symbols]


def test_mjcf_has_an_outline_definitions_and_hovers(client: Client, tmp_path: Path) -> None:
    path = tmp_path / "arm.xml"
    uri = client.open(path)
    symbols = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
    assert outline(symbols) == [
        ("default", "bend"),
        ("body", "base", ("body", "upper", ("joint", "shoulder"))),
        ("position", "drive"),
    ]
    assert definitions(client, path, 'file="ass|ets.xml"') == [("assets.xml", 1)]
    assert definitions(client, path, 'joint="should|er"') == [("arm.xml", 9)]
    assert definitions(client, path, '"shoulder" class="be|nd"') == [("arm.xml", 4)]
    assert definitions(client, path, 'material="re|d"') == [("assets.xml", 1)]
    client.wait_for(lambda: "root-inertia" in client.codes(uri))
    hover = client.request("textDocument/hover", at(path, 'joint="should|er"'))
    assert "joint `shoulder`, revolute, from `base`" in hover["contents"]["value"]
    hover = client.request("textDocument/hover", at(path, '"shoulder" class="be|nd"'))
    assert '<joint range="-1 1">' in hover["contents"]["value"]


def test_faults_of_sdf_are_at_their_lines(client: Client, tmp_path: Path) -> None:
    path = tmp_path / "pendulum.sdf"
    uri = client.open(path)
    client.wait_for(lambda: client.codes(uri) == ["sdf-frame"])
    assert client.diagnostics[uri][0]["range"]["start"] == {"line": 6, "character": 13}
    assert definitions(client, path, "<parent>sta|nd") == [("pendulum.sdf", 3)]
    assert definitions(client, path, 'relative_to="swi|ng"') == [("pendulum.sdf", 5)]


def test_a_file_that_mjcf_includes_is_checked_in_it_and_other_xml_is_left_alone(
    client: Client, tmp_path: Path
) -> None:
    package = client.open(tmp_path / "package.xml")
    assets = client.open(tmp_path / "assets.xml", ASSETS.replace('"red"', '"green"'))
    arm = (tmp_path / "arm.xml").as_uri()
    client.wait_for(lambda: "unknown-mjcf-name" in client.codes(arm))
    assert client.codes(package) == client.codes(assets) == []
