"""`yamaro args`, `yamaro FILE --help-args`, and the completion of `name:=`."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import yamaro
from yamaro.commands.main import main

ARM = """\
import: danger
process: open('ran', 'w')
arguments:
  reach: {default: 850mm, unit: m, range: [0.3, 1.3], step: 5cm, help: from the base to the flange}
  tilt: {unit: deg, range: [-90, 90deg], default: $(pi / 4)}
  gripper: {default: none, choices: [none, two_finger, vacuum]}
  legs: {type: integer, range: [3, null]}
  mass: {log: true, range: [0.1, 100], default: 1}
  tag: ""
  code: {type: text, default: 007}
  solid: true
  sides: [left, right]
  corner: {default: {x: 1}, help: "where:\\nit ends"}
  mesh: {type: path, default: null}
  any:
model:
  nothing: $(danger.value)
"""
LISTED = """\
reach:=0.85
    number from 0.3 to 1.3 m: from the base to the flange
tilt:=$(pi / 4)
    number from -90 to 90 deg
gripper:=none
    none | two_finger | vacuum
legs:=
    required, integer of at least 3
mass:=1
    number from 0.1 to 100
tag:=
    text
code:=007
    text
solid:=true
    boolean
sides:=[left, right]
    list
corner:={x: 1}
    mapping: where: it ends
mesh:=null
    path
any:=null
"""
XACRO = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{}</robot>'


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("danger.py").write_text("open('ran', 'w')")
    return tmp_path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(list(words))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def schema(capsys: pytest.CaptureFixture[str], text: str, name: str = "robot.yaml") -> Any:
    Path(name).write_text(text)
    status, out, err = outcome(capsys, "args", name, "--json")
    assert (status, err) == (0, "")
    found = json.loads(out)
    Draft202012Validator.check_schema(found)
    return found


@pytest.mark.parametrize("words", [["args", "robot.yaml"], ["robot.yaml", "--help-args"]])
def test_arguments_are_listed_without_running_the_file(
    capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    Path("robot.yaml").write_text(ARM)
    assert outcome(capsys, *words) == (0, LISTED, "")
    assert not os.path.exists("ran")


def test_the_schema_has_types_ranges_choices_and_units(capsys: pytest.CaptureFixture[str]) -> None:
    found = schema(capsys, ARM)
    assert found["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert (found["type"], found["required"]) == ("object", ["legs"])
    assert found["additionalProperties"] is False
    assert found["properties"] == {
        "reach": {
            "description": "from the base to the flange", "type": "number", "minimum": 0.3,
            "maximum": 1.3, "x-step": 0.05, "x-unit": "m", "default": 0.85,
        },
        "tilt": {"type": "number", "minimum": -90, "maximum": 90, "x-unit": "deg",
                 "x-default": "$(pi / 4)"},
        "gripper": {"type": "string", "enum": ["none", "two_finger", "vacuum"], "default": "none"},
        "legs": {"type": "integer", "minimum": 3},
        "mass": {"type": "number", "minimum": 0.1, "maximum": 100, "x-log": True, "default": 1},
        "tag": {"type": "string", "default": ""},
        "code": {"type": "string", "default": "007"},
        "solid": {"type": "boolean", "default": True},
        "sides": {"type": "array", "default": ["left", "right"]},
        "corner": {"description": "where:\nit ends", "type": "object", "default": {"x": 1}},
        "mesh": {"type": ["string", "null"], "format": "path", "default": None},
        "any": {"default": None},
    }  # fmt: skip


@pytest.mark.parametrize(
    ("values", "is_valid"),
    [
        ({"legs": 4}, True),
        ({"legs": 4, "gripper": "vacuum", "tilt": 45, "mesh": None}, True),
        ({}, False),
        ({"legs": 2}, False),
        ({"legs": 4, "gripper": "magnet"}, False),
        ({"legs": 4, "tilt": 91}, False),
        ({"legs": 4, "solid": "yes"}, False),
        ({"legs": 4, "arms": 2}, False),
    ],
)
def test_the_schema_takes_what_a_build_takes(
    capsys: pytest.CaptureFixture[str], values: dict[str, Any], is_valid: bool
) -> None:
    lines = ARM.partition("arguments:")[2].partition("model:")[0]
    text = f"arguments:{lines}out: $(legs)\n"
    found = schema(capsys, text)
    assert Draft202012Validator(found).is_valid(values) is is_valid
    words = [f"{name}:={json.dumps(value)}" for name, value in values.items()]
    assert (outcome(capsys, "robot.yaml", *words)[0] == 0) is is_valid


def test_units_of_a_schema_are_those_of_the_file(capsys: pytest.CaptureFixture[str]) -> None:
    text = "arguments: {w: {unit: mm, default: 5cm, choices: [50, 1in], step: 0.5}}\nout:\n"
    assert schema(capsys, text)["properties"]["w"] == {
        "type": "number", "enum": [50, 25.4], "x-step": 0.5, "x-unit": "mm", "default": 50,
    }  # fmt: skip


def test_without_the_section_the_variables_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    text = "variables:\n  length/global: 1.0\n  half: $(length / 2)\n- sides\n"
    Path("bad.yaml").write_text(text)
    assert outcome(capsys, "args", "bad.yaml")[0] == 1
    text = "- variables: {length/global: 1.0, half: $(length / 2)}\n- variables: {sides: [a,  b]}\n"
    found = schema(capsys, text)
    assert found["properties"] == {
        "length": {"default": 1.0}, "half": {"x-default": "$(length / 2)"},
        "sides": {"x-default": "[a, b]"},
    }  # fmt: skip
    assert found["additionalProperties"] is True
    assert "required" not in found
    status, out, err = outcome(capsys, "args", "robot.yaml")
    assert (status, out, err) == (0, "length:=1.0\nhalf:=$(length / 2)\nsides:=[a, b]\n", "")


def test_an_empty_section_lists_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    found = schema(capsys, "arguments:\nvariables: {a: 1}\n")
    assert (found["properties"], found["additionalProperties"]) == ({}, False)
    assert outcome(capsys, "args", "robot.yaml") == (0, "", "")


def test_arguments_of_xacro_are_those_of_its_includes_too(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    (folder / "parts").mkdir()
    (folder / "robot.xacro").write_text(
        XACRO.format(
            '<xacro:arg name="name" default="ur5"/><xacro:arg name="must"/>'
            '<xacro:include filename="parts/$(arg name).xacro"/>'
            '<xacro:include filename="$(find own)/more.xacro"/>'
            '<xacro:include filename="missing.xacro"/><xacro:include filename="${x}.xacro"/>'
            '<xacro:if value="$(arg must)"><xacro:arg name="late" default="${1 + 1}"/></xacro:if>'
        )
    )
    (folder / "parts" / "ur5.xacro").write_text(
        XACRO.format(
            '<xacro:arg name="name" default="other"/><xacro:arg name="side" default="left"/>'
            '<xacro:include filename="../robot.xacro"/>'
        )
    )
    (folder / "parts" / "more.xacro").write_text(
        XACRO.format('<xacro:arg name="more" default=""/>')
    )
    package = ("--package", "own:=parts")
    status, out, err = outcome(capsys, "args", "robot.xacro", *package)
    assert (status, err) == (0, "")
    assert out == (
        "name:=ur5\nmust:=\nlate:=${1 + 1}\nside:=left\nmore:=\n"
        "# not read, as its name is computed: ${x}.xacro\n"
    )
    status, out, err = outcome(capsys, "args", "robot.xacro", "--json", *package)
    found = json.loads(out)
    assert found["required"] == ["must"]
    assert found["properties"]["name"] == {"default": "ur5"}
    assert found["properties"]["late"] == {"x-default": "${1 + 1}"}


def test_a_file_can_be_named_by_its_package(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    (folder / "own").mkdir()
    (folder / "own" / "package.xml").write_text("<package><name>own</name></package>")
    (folder / "own" / "robot.yaml").write_text("robot: r\narguments: {size: {default: 1}}")
    for words in (("--package", "own:=own"), ("--package", "own:=own", "--safe")):
        status, out, err = outcome(capsys, "args", "package://own/robot.yaml", *words[:2])
        assert (status, out.split()[0], err) == (0, "size:=1", "")
        assert outcome(capsys, "package://own/robot.yaml", "-q", *words)[0] == 0
    status, out, err = outcome(capsys, "package://owm/robot.yaml", "--package", "own:=own")
    assert status == 2
    assert "there is no package 'owm'" in err
    assert yamaro.build("package://own/robot.yaml", packages={"own": "own"}).robot.name == "r"
    with pytest.raises(yamaro.UsageError, match="there is no package 'other'"):
        yamaro.build("package://other/robot.yaml")


def test_an_include_outside_of_what_may_be_read_is_passed_over(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    (folder / "inside").mkdir()
    (folder / "secret.xacro").write_text(XACRO.format('<xacro:arg name="secret" default="1"/>'))
    (folder / "inside" / "robot.xacro").write_text(
        XACRO.format('<xacro:include filename="../secret.xacro"/>')
    )
    assert outcome(capsys, "args", "inside/robot.xacro") == (0, "", "")
    assert outcome(capsys, "args", "inside/robot.xacro", "--trust") == (0, "secret:=1\n", "")


def test_a_urdf_has_no_arguments(capsys: pytest.CaptureFixture[str]) -> None:
    assert schema(capsys, '<robot name="r"/>', "robot.urdf")["properties"] == {}


def test_errors_of_the_section_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text("arguments: {a: {type: float}, b: {default: 2, range: [0, 1]}}")
    status, out, err = outcome(capsys, "args", "robot.yaml")
    assert (status, out) == (1, "")
    assert "error[bad-argument]" in err
    assert "error[argument-range]" in err


def test_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text("arguments: {a: 1}")
    for line in ("args", "args missing.yaml", "args robot.yaml a:=2",
                 "robot.yaml --help-args --deps", "tree robot.yaml --json"):  # fmt: skip
        assert outcome(capsys, *line.split())[0] == 2, line


def test_arguments_complete_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.yaml").write_text(ARM)
    status, out, err = outcome(capsys, "completion", "variables", "robot.yaml")
    assert (status, err) == (0, "")
    lines = out.splitlines()
    assert lines[0] == "reach:=\t0.85, number from 0.3 to 1.3 m: from the base to the flange"
    assert lines[2] == "gripper:=\tnone, none | two_finger | vacuum"
    assert lines[3] == "legs:=\trequired, integer of at least 3"
    assert lines[5] == "tag:=\ttext"
    Path("robot.xacro").write_text(XACRO.format('<xacro:arg name="side" default="left"/>'))
    assert outcome(capsys, "completion", "variables", "robot.xacro")[1] == "side:=\tleft\n"
