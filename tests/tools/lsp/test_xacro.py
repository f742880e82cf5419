"""URDF and xacro in an editor, over the protocol: a package of several files."""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.effort import examples
from tests.tools.lsp.client import Client
from yamaro.tools.lsp import FEATURES, feature
from yamaro.tools.lsp.protocol import RequestFailed, position_at
from yamaro.tools.lsp.workspace import Workspace

TREES = {"textDocument": {"documentSymbol": {"hierarchicalDocumentSymbolSupport": True}}}
HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'
MAIN = f"""<?xml version="1.0"?>
{HEAD} name="rover">
  <xacro:arg name="mass" default="2"/>
  <xacro:arg name="tool" default="gripper"/>
  <xacro:include filename="$(find rover_parts)/urdf/leg.xacro"/>
  <xacro:include filename="tools/$(arg tool).xacro"/>
  <!-- how far the legs are apart -->
  <xacro:property name="width" value="0.4"/>
  <xacro:property name="half" value="${{width / 2}}"/>
  <material name="steel"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base"/>
  <xacro:leg prefix="left_" y="${{half}}" mass="$(arg mass)"/>
  <xacro:leg prefix="right_" y="${{-half}}"/>
  <xacro:gripper parent="left_foot"/>
  <joint name="copy" type="revolute">
    <parent link="base"/><child link="flag"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/>
    <mimic joint="left_hip"/>
  </joint>
  <link name="flag"><visual><geometry><box size="${{width}} 0.1 0.1"/></geometry>
    <material name="steel"/></visual></link>
</robot>
"""
LEG = f"""{HEAD}>
  <!-- a leg with its foot -->
  <xacro:macro name="leg" params="prefix y mass:=3 parent:=base">
    <link name="${{prefix}}foot">
      <inertial><mass value="${{mass}}"/>
        <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    </link>
    <joint name="${{prefix}}hip" type="revolute">
      <parent link="${{parent}}"/><child link="${{prefix}}foot"/>
      <origin xyz="0 ${{y}} 0"/><axis xyz="0 1 0"/>
      <limit lower="-1.5" upper="0.5" effort="10" velocity="3"/>
    </joint>
  </xacro:macro>
</robot>
"""
GRIPPER = f"""{HEAD}>
  <xacro:macro name="gripper" params="parent">
    <link name="gripper"/>
    <joint name="wrist" type="fixed"><parent link="${{parent}}"/><child link="gripper"/></joint>
  </xacro:macro>
</robot>
"""
NAMES = {
    "rover/urdf/rover.urdf.xacro": MAIN,
    "rover/urdf/tools/gripper.xacro": GRIPPER,
    "rover/package.xml": "<package><name>rover</name></package>",
    "common/deep/rover_parts/urdf/leg.xacro": LEG,
    "common/deep/rover_parts/package.xml": "<package><name>rover_parts</name></package>",
}


def write(folder: Path) -> Path:
    for name, text in NAMES.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder


@pytest.fixture
def work(tmp_path: Path) -> Path:
    return write(tmp_path)


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Client, Path]]:
    """A session for tests that change nothing, with the main file open and built."""
    folder = write(tmp_path_factory.mktemp("read"))
    with Client(folder, capabilities=TREES) as client:
        main = named(folder, "rover.urdf.xacro")
        client.open(main)
        built(client, main)
        yield client, folder
        assert client.logs == []


@pytest.fixture
def client(work: Path) -> Iterator[Client]:
    with Client(work, capabilities=TREES) as made:
        yield made
        assert made.logs == []


def named(work: Path, name: str) -> Path:
    return next(work / each for each in NAMES if each.endswith(name))


def at(path: Path, mark: str) -> dict[str, Any]:
    """Return the parameters of a request about a `|` in a stretch of a file."""
    text = path.read_text()
    offset = text.index(mark.replace("|", "")) + mark.index("|")
    place = {
        "line": text.count("\n", 0, offset),
        "character": offset - text.rfind("\n", 0, offset) - 1,
    }
    return {"textDocument": {"uri": path.as_uri()}, "position": place}


def places(client: Client, path: Path, mark: str, method: str = "definition") -> list[str]:
    context = {"context": {"includeDeclaration": True}}
    found = client.request(f"textDocument/{method}", {**at(path, mark), **context})
    return [f"{Path(each['uri']).name}:{each['range']['start']['line'] + 1}" for each in found]


def hover(client: Client, path: Path, mark: str) -> str:
    found = client.request("textDocument/hover", at(path, mark))
    return "" if found is None else str(found["contents"]["value"])


def built(client: Client, path: Path) -> None:
    """Wait until a file that was opened has been built."""
    uri = path.as_uri()
    client.wait_for(lambda: sum(each["uri"] == uri for each in client.published) > 1)


def test_hovers_have_the_values_of_the_main_file_in_all_its_files(
    read: tuple[Client, Path],
) -> None:
    client, work = read
    main, leg = named(work, "rover.urdf.xacro"), named(work, "leg.xacro")
    shown = hover(client, main, "${wid|th / 2}")
    assert "how far the legs are apart" in shown
    assert "value: `0.4`" in shown
    assert "`${width / 2}` is `0.2`" in shown
    assert "`${-half}` is `-0.2`" in hover(client, main, 'y="$|{-half}"')
    assert "value: `2`" in hover(client, main, '<xacro:arg name="ma|ss"')
    macro = hover(client, main, '<xacro:le|g prefix="left_"')
    assert all(word in macro for word in ("a leg with its foot", "`prefix`", "`mass:=3`"))
    assert "value: `left_`, `right_`" in hover(client, leg, 'params="pre|fix')
    assert "default: `3`" in hover(client, leg, '"${ma|ss}"')
    assert "value: `2`, `3`" in hover(client, leg, '"${ma|ss}"')
    foot = hover(client, leg, '<link name="${prefix}fo|ot"')
    assert "mass 2 kg" in foot
    assert "mass 3 kg" in foot
    hip = hover(client, main, '<mimic joint="left_h|ip"')
    assert "from `base` to `left_foot`" in hip
    assert "from -1.5 to 0.5 rad" in hip
    assert "rgba 0.5 0.5 0.5 1" in hover(client, main, '<material name="st|eel"/>')
    assert "the least position" in hover(client, main, 'low|er="-1"')


def test_definitions_and_references_lead_across_files(read: tuple[Client, Path]) -> None:
    client, work = read
    main, leg = named(work, "rover.urdf.xacro"), named(work, "leg.xacro")
    assert places(client, main, '<xacro:le|g prefix="left_"') == ["leg.xacro:3"]
    assert places(client, main, 'pre|fix="left_"') == ["leg.xacro:3"]
    assert places(client, main, "${ha|lf}") == ["rover.urdf.xacro:9"]
    assert places(client, main, "$(arg ma|ss)") == ["rover.urdf.xacro:3"]
    assert places(client, main, "rover_parts)/urdf/le|g.xacro") == ["leg.xacro:1"]
    assert places(client, main, '"tools/$(arg tool).xa|cro"') == ["gripper.xacro:1"]
    assert places(client, main, 'parent link="ba|se"') == ["rover.urdf.xacro:11"]
    assert places(client, main, 'parent="left_fo|ot"') == ["leg.xacro:4"]  # which a macro makes
    assert places(client, main, 'mimic joint="left_h|ip"') == ["leg.xacro:8"]
    assert places(client, main, 'material name="st|eel"/>') == ["rover.urdf.xacro:10"]
    assert places(client, leg, '"${ma|ss}"') == ["leg.xacro:3"]
    assert places(client, leg, 'child link="${prefix}fo|ot"') == ["leg.xacro:4"]
    calls = ["leg.xacro:3", "rover.urdf.xacro:12", "rover.urdf.xacro:13"]
    assert sorted(places(client, leg, 'macro name="le|g"', "references")) == calls
    width = places(client, main, 'name="wid|th"', "references")
    assert width == [f"rover.urdf.xacro:{line}" for line in (8, 9, 20)]
    assert places(client, main, "$(arg ma|ss)", "references") == [
        f"rover.urdf.xacro:{line}" for line in (3, 12)
    ]


def test_a_file_is_checked_in_the_robots_that_include_it(client: Client, work: Path) -> None:
    leg, gripper = named(work, "leg.xacro"), named(work, "gripper.xacro")
    uri = client.open(leg, LEG.replace("${y}", "${why}"))
    client.wait_for(lambda: client.codes(uri) == ["xacro-undefined"])
    found = client.diagnostics[uri][0]
    line = LEG.splitlines().index(next(each for each in LEG.splitlines() if "${y}" in each))
    column = LEG.splitlines()[line].index("y}")
    assert found["range"] == {
        "start": {"line": line, "character": column},
        "end": {"line": line, "character": column + len("why")},
    }
    steps = [each["message"] for each in found["relatedInformation"]]
    assert steps == ["called: xacro:leg"]
    client.change(uri, 2, [{"text": LEG}])
    client.wait_for(lambda: client.codes(uri) == [])
    other = client.open(gripper)  # of which the main file computes the name
    built(client, gripper)
    assert "`left_foot`" in hover(client, gripper, "${par|ent}")
    assert client.codes(other) == []


def test_a_package_that_comes_to_the_folder_is_found(client: Client, work: Path) -> None:
    manifest = work / "common/deep/rover_parts/package.xml"
    text = manifest.read_text()
    manifest.unlink()
    uri = client.open(named(work, "rover.urdf.xacro"))
    client.wait_for(lambda: client.codes(uri) == ["unknown-package"])
    manifest.write_text(text)
    changes = [{"uri": manifest.as_uri(), "type": 1}]
    client.notify("workspace/didChangeWatchedFiles", {"changes": changes})
    client.wait_for(lambda: client.codes(uri) == ["massless-moving"])


def test_a_file_of_macros_that_nothing_includes_is_no_broken_robot(
    client: Client, tmp_path: Path
) -> None:
    text = LEG.replace('"leg"', '"arm"')
    uri = client.open(tmp_path / "arm.xacro", text)
    plain = client.open(tmp_path / "plain.urdf", '<robot name="r"><lnik name="a"/></robot>')
    client.wait_for(lambda: "no-link" in client.codes(plain))
    assert client.codes(uri) == []


def test_arguments_are_taken_from_the_settings(work: Path) -> None:
    main = named(work, "rover.urdf.xacro")
    options = {"arguments": {"rover.urdf.xacro": ["mass:=7"]}}
    with Client(work, options=options) as client:
        client.open(main)
        built(client, main)
        assert "value: `7`" in hover(client, main, '<xacro:arg name="ma|ss"')


def test_a_robot_that_needs_an_argument_is_known_nevertheless(
    client: Client, tmp_path: Path
) -> None:
    text = MAIN.replace('name="rover"', 'name="$(arg called)"').replace(
        '<link name="base"/>', '<link name="base"/><xacro:arg name="called" default="mars"/>'
    )
    path = tmp_path / "rover/urdf/late.urdf.xacro"
    path.write_text(text)
    uri = client.open(path)
    client.wait_for(lambda: client.codes(uri) == ["xacro-undefined", "massless-moving"])
    assert "the setting 'arguments'" in client.diagnostics[uri][0]["message"]
    assert "`0.2`" in hover(client, path, 'name="ha|lf"')
    found = client.request("yamaro/main", {"textDocument": {"uri": uri}})
    assert found["words"][0] == "called:=mars"


def test_the_outline_has_macros_properties_links_and_joints(read: tuple[Client, Path]) -> None:
    client, work = read
    uri = named(work, "leg.xacro").as_uri()
    symbols = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})

    def shape(symbols: list[Any]) -> list[Any]:
        return [
            (each["name"], each["range"]["end"]["line"] + 1, *shape(each.get("children", [])))
            for each in symbols
        ]

    assert shape(symbols) == [("leg", 13, ("${prefix}foot", 7), ("${prefix}hip", 12))]


def test_half_written_xml_keeps_what_is_known(client: Client, work: Path) -> None:
    main = named(work, "rover.urdf.xacro")
    uri = client.open(main)
    built(client, main)
    for version, (old, new) in enumerate(
        (
            ('<link name="base"/>', '<link name="base"'),
            ('<parent link="base"/>', "<parent li"),
            ("<mimic", '<mimic joint="'),
            ("  </joint>", ""),
            ("</robot>", ""),
            ("how far the legs", "how -- far"),
            ('"0.4"', '"0.4 & ${wid"'),
        ),
        start=2,
    ):
        text = MAIN.replace(old, new)
        client.change(uri, version, [{"text": text}])
        client.wait_for(lambda: "xml-syntax" in client.codes(uri))
        place = client.at(uri, text, "${-half}", after=4)
        found = client.request("textDocument/hover", place)
        assert "value: `0.2`" in found["contents"]["value"], new
        found = client.request("textDocument/definition", place)
        assert [each["range"]["start"]["line"] for each in found] == [8], new
        symbols = client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
        assert {"width", "half", "base", "flag"} <= set(names_in(symbols)), new


def names_in(symbols: list[Any]) -> list[str]:
    return [
        name for each in symbols for name in (each["name"], *names_in(each.get("children", [])))
    ]


@pytest.mark.parametrize(
    ("typed", "offered", "not_offered"),
    [
        ("<xacro:le|", {"leg"}, {"link", "xacro:leg"}),
        ("<|", {"xacro:leg", "link", "joint", "xacro:property"}, {"inertia"}),
        ("<link name='a'><in|", {"inertial", "visual"}, {"joint"}),
        ('<xacro:leg prefix="a" |', {"y", "mass", "parent"}, {"prefix", "name"}),
        ('<box size="${wi|', {"width", "half", "pi", "radians"}, {"prefix"}),
        ('<box size="${math.|', {"cos"}, {"width"}),
        ('<box size="$(arg |', {"mass", "tool"}, {"width"}),
        ('<box size="$(|', {"arg", "find"}, {"mass"}),
        ('<xacro:include filename="$(find |', {"rover", "rover_parts"}, set()),
        ('<xacro:include filename="too|', {"tools"}, set()),
        ('<parent link="|', {"base", "flag", "left_foot"}, {"left_hip"}),
        ('<mimic joint="|', {"copy", "left_hip"}, {"base"}),
        ('<material name="|', {"steel"}, {"base"}),
        ('<joint name="j" type="|', {"revolute", "prismatic"}, {"base"}),
        ('<xacro:property name="n" scope="|', {"parent", "global"}, set()),
        ("<link name='a'></|", {"link"}, {"robot"}),
        ("<!-- <|", set(), {"link"}),
    ],
)
def test_completion_knows_where_it_is(
    completing: Client, typed: str, offered: set[str], not_offered: set[str]
) -> None:
    client, uri = completing, next(each for each in completing.diagnostics if "rover.urdf" in each)
    text = MAIN.replace('  <link name="flag">', f'  {typed.replace("|", "")}\n  <link name="flag">')
    client.change(uri, 2, [{"text": text}])
    place = client.at(uri, text, typed.replace("|", "") + "\n", after=typed.index("|"))
    found = client.request("textDocument/completion", place)["items"]
    labels = {each["label"] for each in found}
    assert offered <= labels
    assert not labels & not_offered


@pytest.fixture(scope="module")
def completing(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    folder = write(tmp_path_factory.mktemp("completing"))
    with Client(folder) as client:
        client.open(named(folder, "rover.urdf.xacro"))
        built(client, named(folder, "rover.urdf.xacro"))
        yield client
        assert client.logs == []


def test_a_call_is_completed_with_what_it_needs(work: Path) -> None:
    snippets = {"textDocument": {"completion": {"completionItem": {"snippetSupport": True}}}}
    main = named(work, "rover.urdf.xacro")
    with Client(work, capabilities=snippets) as client:
        text = MAIN.replace("</robot>", "<xacro:le\n</robot>")
        uri = client.open(main, text)
        place = client.at(uri, text, "<xacro:le\n", after=len("<xacro:le"))
        found = client.request("textDocument/completion", place)["items"]
        item = next(each for each in found if each["label"] == "leg")
        assert item["textEdit"]["newText"] == 'leg prefix="$1" y="$2"/>$0'
        assert item["documentation"]["value"] == "a leg with its foot"


def test_commands_are_told_the_main_file_with_arguments_and_packages(work: Path) -> None:
    main, leg = named(work, "rover.urdf.xacro"), named(work, "leg.xacro")
    with Client(work, options={"arguments": {"rover.urdf.xacro": ["mass:=7"]}}) as client:
        uri = client.open(leg)
        built(client, leg)
        found = client.request("yamaro/main", {"textDocument": {"uri": uri}})
    folder = work / "common/deep/rover_parts"
    assert found == {
        "main": str(main),
        "words": ["mass:=7", "--package", f"rover_parts:={folder}"],
    }


PIECES = (
    *(
        "",
        "<",
        ">",
        '"',
        "'",
        "/",
        "&",
        "</robot>",
        "<!--",
        "-->",
        "]]>",
        '<link name="',
        "${",
        "$(",
    ),
    *("}", "\0", "<xacro:", "xacro:call", "${a.b(", "$(arg ", "$(eval 1", "^|", "*", "\n", "🤖"),
    "(" * 300,
)


def test_every_feature_answers_anywhere_in_damaged_xacro(work: Path) -> None:
    chooser = random.Random(7)
    path = named(work, "rover.urdf.xacro")
    for _ in range(examples(200)):
        text = chooser.choice((MAIN, LEG))
        for _ in range(chooser.randrange(1, 4)):
            start = chooser.randrange(len(text))
            gone = chooser.choice((0, 0, 1, 5, 40))
            text = text[:start] + chooser.choice(PIECES) + text[start + gone :]
        workspace = Workspace()
        opened = workspace.add(path.as_uri(), 1, text).text
        for method in FEATURES:
            place = position_at(opened.source, chooser.randrange(len(text) + 1), "utf-16")
            parameters = {
                "textDocument": {"uri": path.as_uri()},
                "position": place,
                "range": {"start": {"line": 0, "character": 0}, "end": place},
                "context": {},
                "newName": "other",
            }
            with suppress(RequestFailed):
                json.dumps(feature(method)(workspace, parameters))
