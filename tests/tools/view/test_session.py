"""What the page is told of a robot: places, owners of warnings, variables; and editors."""

from __future__ import annotations

import json
import sys
import textwrap
import webbrowser
from pathlib import Path
from typing import Any

import pytest

from tests.files.wheels import install
from yamaro.api import build
from yamaro.diagnostics import YamaroError
from yamaro.files.readable import Reach
from yamaro.options import Options
from yamaro.policy import SAFE, Policy
from yamaro.rebuilding import Rebuilder
from yamaro.tools.view.description import Description
from yamaro.tools.view.mesh_files import MeshFiles
from yamaro.tools.view.session import Session
from yamaro.tools.view.variables import WrongValue, read_variable_fields
from yamaro.tools.view.viewing import find_editor, open_browser


def described(folder: Path, text: str, **files: str) -> Any:
    """Return what the page is told of a robot."""
    for name, content in files.items():
        (folder / f"{name}.yaml").write_text(textwrap.dedent(content), encoding="utf-8")
    path = folder / "robot.yaml"
    path.write_text(textwrap.dedent(text), encoding="utf-8")
    made = build(path, advice=True, policy=Policy(SAFE))
    return Description(made, MeshFiles(None)).data


# --- where things were written ------------------------------------------------------------------


def test_a_link_is_traced_through_calls_and_includes(tmp_path: Path) -> None:
    data = described(
        tmp_path,
        """\
        robot: one
        model:
          link/name=base:
          include: legs.yaml
          Legs: left
        """,
        legs="""\
        functions:
          Leg:
            input: name
            body:
              part:
                name: $(name)
                joint: {type: fixed, parent: base}
                link:
                  geometry: sphere
                  scale: 0.1
                  mass: 1
                  visual:
          Legs/parent:
            input: side
            body:
              Leg: $(side)_leg
        """,
    )
    link = data["links"]["left_leg_link"]
    places = data["places"]
    assert places[link["place"]].endswith("legs.yaml:8:9")
    assert places[link["visual"][0]["place"]].endswith("legs.yaml:12:11")
    calls = [
        (each["kind"], each["name"], Path(places[each["place"]]).name) for each in link["calls"]
    ]
    assert calls[:2] == [("called", "Leg", "legs.yaml:16:7"), ("called", "Legs", "robot.yaml:5:3")]
    assert places[data["joints"]["left_leg_joint"]["place"]].endswith("legs.yaml:7:9")


def test_a_warning_is_of_the_link_in_whose_call_it_arose(tmp_path: Path) -> None:
    data = described(
        tmp_path,
        """\
        robot: one
        functions:
          Ball:
            input: name, radius
            body:
              link/name=$(name):
                visual:
                  geometry:
                    sphere/radius=$(radius):
        model:
          link/name=base:
          Ball: good, 0.1
          Ball: bad, -0.1
          joint/name=one, type=fixed:
            parent/link=base:
            child/link=good:
          joint/name=two, type=revolute:
            parent/link=base:
            child/link=bad:
            limit/effort=1, velocity=1:
        """,
    )
    owners = {each["code"]: (each.get("link"), each.get("joint")) for each in data["diagnostics"]}
    assert ("bad", None) in owners.values()
    assert (None, "two") in owners.values()
    assert "good" not in str(owners.values())


# --- variables ----------------------------------------------------------------------------------


def test_variables_with_plain_values_are_fields() -> None:
    fields = read_variable_fields(
        textwrap.dedent(
            """\
            robot: one
            variables:
              count: 3
              length: 1e-3
              is_on: true
              word: left
              quoted: '3'
              half: $(length / 2)
              sizes: [1, 2]
              empty:
              huge: .inf
              scoped/global: 7
            model:
            """
        ),
        "robot.yaml",
    )
    found = {name: (field.kind, field.default) for name, field in fields.items()}
    assert found == {
        "count": ("number", 3),
        "length": ("number", 0.001),
        "is_on": ("boolean", True),
        "word": ("text", "left"),
        "quoted": ("text", "3"),
        "scoped": ("number", 7),
    }
    assert fields["length"].span.location() == (4, 11)


def test_a_field_takes_values_of_its_kind_only() -> None:
    fields = read_variable_fields("variables: {n: 3, x: 0.5, b: false, t: a}", "robot.yaml")
    assert fields["n"].read(4.0) == 4 and isinstance(fields["n"].read(4.0), int)
    assert fields["n"].read(4.5) == 4.5
    assert isinstance(fields["x"].read(4.0), float)
    for name, value in (("n", True), ("n", "3"), ("x", float("nan")), ("x", None), ("b", 1),
                        ("b", "true"), ("t", 1), ("t", "x" * 20_000), ("t", ["a"])):  # fmt: skip
        with pytest.raises(WrongValue):
            fields[name].read(value)


ARGUMENTS = """\
arguments:
  reach: {default: 850mm, unit: m, range: [0.3, 1.3], step: 5cm, help: to the flange}
  tilt: {unit: deg, range: [-90, 90], default: 30}
  gripper: {default: none, choices: [none, vacuum]}
  wide: {default: 1in, unit: mm, choices: [1in, 50]}
  legs: {type: integer, range: [3, 12]}
  gain: {default: 1, log: true, range: [0.01, 100]}
  count: 3
  solid: true
  half: $(reach / 2)
  sides: [a]
  mesh: {type: path, default: a.stl}
variables: {other: 1}
out:
"""


def test_arguments_are_fields_in_their_units() -> None:
    fields = read_variable_fields(ARGUMENTS, "robot.yaml")
    found = {name: (field.kind, field.default, field.is_whole) for name, field in fields.items()}
    assert found == {
        "reach": ("number", 0.85, False),
        "tilt": ("number", 30, False),
        "gripper": ("choice", "none", False),
        "wide": ("choice", 25.4, False),
        "legs": ("number", None, True),
        "gain": ("number", 1, False),
        "count": ("number", 3, True),
        "solid": ("boolean", True, True),
    }
    assert fields["reach"].about() == {
        "least": 0.3, "most": 1.3, "step": 0.05, "unit": "m", "help": "to the flange",
    }  # fmt: skip
    assert fields["wide"].about() == {"choices": [25.4, 50], "unit": "mm"}
    assert fields["gain"].about() == {"least": 0.01, "most": 100, "isLog": True}
    assert fields["tilt"].about() == {"least": -90, "most": 90, "unit": "deg"}
    assert fields["reach"].span.location() == (2, 20)


def test_a_field_of_an_argument_takes_what_the_argument_takes() -> None:
    fields = read_variable_fields(ARGUMENTS, "robot.yaml")
    assert fields["tilt"].read(12.3) == 12.3
    assert fields["reach"].read("40cm") == 0.4
    assert fields["wide"].read(50) == 50
    for name, value in (("reach", 1.4), ("tilt", "1m"), ("gripper", "magnet"), ("legs", 2),
                        ("legs", 4.5), ("solid", "no"), ("count", "x" * 20_000)):  # fmt: skip
        with pytest.raises(WrongValue):
            fields[name].read(value)


def test_a_file_with_errors_has_no_fields() -> None:
    for text, name in (("variables: {n: 3", "robot.yaml"), ("<robot><xacro:arg", "robot.xacro")):
        with pytest.raises(YamaroError):
            read_variable_fields(text, name)


def test_arguments_of_xacro_are_fields() -> None:
    text = (
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="n" default="2"/>'
        '<xacro:arg name="sim" default="true"/><xacro:arg name="side" default="left"/>'
        '<xacro:arg name="path" default="$(find x)/y"/><xacro:arg name="must"/></robot>'
    )
    found = {name: field.default for name, field in read_variable_fields(text, "r.xacro").items()}
    assert found == {"n": 2, "sim": True, "side": "left"}


PNG = b"\x89PNG\r\n\x1a\n"


# --- meshes -------------------------------------------------------------------------------------


def test_a_mesh_brings_the_files_it_names(tmp_path: Path) -> None:
    (tmp_path / "textures").mkdir()
    for name in ("textures/wood grain.png", "plain.png", "data.bin", "secret.txt", "bump.jpg"):
        (tmp_path / name).write_bytes(PNG if name.endswith(("png", "jpg")) else b"x")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\r\nmtllib /etc/passwd\r\n")
    (tmp_path / "a.mtl").write_text("map_Kd textures/wood grain.png\nmap_Ka -s 1 1 1 plain.png\n")
    (tmp_path / "a.dae").write_text(
        "<COLLADA><image><init_from>textures/wood%20grain.png</init_from></image>"
        "<image><init_from><ref>secret.txt</ref></init_from></image></COLLADA>"
    )
    (tmp_path / "a.gltf").write_text(
        '{"asset": {}, "buffers": [{"uri": "data.bin"}, {"uri": "data:,x"}],'
        ' "images": [{"uri": "bump.jpg"}, {"bufferView": 0}]}'
    )
    files = MeshFiles(Reach([str(tmp_path)]))

    def brought(name: str) -> dict[str, str]:
        told = files.add(str(tmp_path / name))
        assert told is not None
        companions: Any = told["companions"]
        return {name: Path(files.paths[key]).name for name, key in companions.items()}

    assert brought("a.obj") == {
        "a.mtl": "a.mtl",
        "textures/wood grain.png": "wood grain.png",
        "plain.png": "plain.png",
    }
    assert brought("a.dae") == {"textures/wood%20grain.png": "wood grain.png"}
    assert brought("a.gltf") == {"data.bin": "data.bin", "bump.jpg": "bump.jpg"}
    assert "fault" in (files.add(str(tmp_path / "secret.txt")) or {})


@pytest.mark.parametrize(
    "content", [b"", b"[", b"[]", b'{"buffers": 3}', b'{"images": [3]}', b"[" * 9**5]
)
def test_broken_gltf_names_nothing(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.gltf").write_bytes(content)
    told = MeshFiles(None).add(str(tmp_path / "a.gltf"))
    assert told is not None and told["companions"] == {}


def test_a_key_changes_with_the_content(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    path.write_bytes(b"one")
    before = MeshFiles(None).add(str(path))
    path.write_bytes(b"other")
    assert MeshFiles(None).add(str(path)) != before


# --- editors ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("code", ["code", "-g", "/r.yaml:12:3"]),
        ("/opt/bin/code --wait", ["/opt/bin/code", "--wait", "-g", "/r.yaml:12:3"]),
        ("subl", ["subl", "/r.yaml:12:3"]),
        ("emacsclient", ["emacsclient", "-n", "+12:3", "/r.yaml"]),
        ("kate", ["kate", "--line", "12", "--column", "3", "/r.yaml"]),
        ("my-editor", ["my-editor", "/r.yaml"]),
        ("my-editor -l{line} {file}", ["my-editor", "-l12", "/r.yaml"]),
    ],
)
def test_an_editor_is_told_the_place_in_its_own_way(command: str, words: list[str]) -> None:
    editor = find_editor(command, {})
    assert editor is not None and editor.words("/r.yaml", 12, 3) == words


def test_the_environment_names_an_editor_and_those_in_the_terminal_are_passed_over(
    tmp_path: Path,
) -> None:
    empty = str(tmp_path)

    def name_of(**environ: str) -> str | None:
        editor = find_editor(None, {"PATH": empty, **environ})
        return editor.name if editor is not None else None

    assert name_of(VISUAL="code --wait", EDITOR="vim") == "code"
    assert name_of(VISUAL="vim", EDITOR="gvim") == "gvim"
    assert name_of(EDITOR="vim") is None
    assert name_of(EDITOR="emacs -nw") is None
    assert name_of(EDITOR="'") is None
    codium = tmp_path / "codium"
    codium.write_text("#!/bin/sh\n")
    codium.chmod(0o755)
    assert name_of(EDITOR="nano") == "codium"


# --- sessions -----------------------------------------------------------------------------------


def session_of(path: Path, *command_line: str) -> Session:
    rebuilder = Rebuilder(
        str(path),
        Options(
            policy=Policy(SAFE),
            command_line=command_line,
            on_message=print,
        ),
    )
    session = Session(rebuilder, editor=None)
    session.build()
    return session


def state_of(session: Session) -> Any:
    return json.loads(session.state())


@pytest.mark.parametrize(
    ("name", "text"),
    [
        (
            "robot.yaml",
            "robot: one\nvariables: {n: 2, word: left, on: true}\nmodel:\n  link/name=l_$(n):\n",
        ),
        (
            "robot.urdf.xacro",
            """<robot name="one" xmlns:xacro="http://www.ros.org/wiki/xacro">
            <xacro:arg name="n" default="2"/><xacro:arg name="word" default="left"/>
            <xacro:arg name="on" default="true"/><link name="l_$(arg n)"/></robot>""",
        ),
    ],
)
def test_what_the_command_line_sets_is_what_a_field_goes_back_to(
    tmp_path: Path, name: str, text: str
) -> None:
    path = tmp_path / name
    path.write_text(text)
    session = session_of(path, "n:=5", "on:=false")
    fields = {each["name"]: each for each in state_of(session)["variables"]}
    assert [fields["n"]["value"], fields["n"]["default"]] == [5, 5]
    assert [fields["on"]["value"], fields["word"]["value"]] == [False, "left"]
    session.set_variables({"n": 7})
    session.build()
    state = state_of(session)
    assert list(state["robot"]["links"]) == ["l_7"]
    assert [each["value"] for each in state["variables"] if each["name"] == "n"] == [7]
    session.set_variables({"n": None})
    session.build()
    assert list(state_of(session)["robot"]["links"]) == ["l_5"]


def test_what_is_no_robot_is_told(tmp_path: Path) -> None:
    path = tmp_path / "world.yaml"
    path.write_text("<sdf>:\n  world/name=empty:\n")
    fault = state_of(session_of(path))["fault"]
    assert fault["fault"] == "the page shows robots, and this is a <sdf>"


def test_a_texture_that_is_not_an_image_is_a_warning(tmp_path: Path) -> None:
    for name in ("wood.png", "inner.png"):
        (tmp_path / name).write_bytes(b"not an image")
    (tmp_path / "a.mtl").write_text("newmtl m\nmap_Kd inner.png\n")
    (tmp_path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    path = tmp_path / "robot.urdf"
    path.write_text(
        '<robot name="one"><link name="a"><visual><geometry><mesh filename="a.obj"/></geometry>\n'
        '<material name="own"><texture filename="wood.png"/></material></visual></link></robot>'
    )
    robot = state_of(session_of(path))["robot"]
    found = [each for each in robot["diagnostics"] if each["code"] == "bad-mesh"]
    mesh, texture = (each["message"] for each in found)
    named = "the texture 'inner.png', which has no format that is read"
    assert mesh == f"the mesh 'a.obj' is shown without {named}"
    assert texture.startswith("the texture 'wood.png' cannot be shown: ")
    places = [robot["places"][each["place"]] for each in found]
    assert [place.rpartition("robot.urdf")[2].split(":")[1] for place in places] == ["1", "2"]


def test_meshes_of_python_packages_are_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    site = tmp_path / "site-packages"
    install(site, "rover", {"rover/wheel.obj": mesh}, entry_points="rover = rover")
    monkeypatch.setattr(sys, "path", [*sys.path, str(site)])
    (tmp_path / "home").mkdir()
    path = tmp_path / "home" / "robot.urdf"
    path.write_text(
        '<robot name="one"><link name="a"><visual><geometry>'
        '<mesh filename="package://rover/wheel.obj"/></geometry></visual></link></robot>'
    )
    session = session_of(path)
    robot = state_of(session)["robot"]
    assert robot["diagnostics"] == []
    (visual,) = robot["links"]["a"]["visual"]
    found = session.open_file(visual["mesh"]["key"])
    assert found is not None
    with found[0] as file:
        assert file.read().decode() == mesh


def test_textures_of_materials_are_given(tmp_path: Path) -> None:
    (tmp_path / "wood.png").write_bytes(PNG)
    path = tmp_path / "robot.urdf"
    path.write_text(
        '<robot name="one"><material name="wood"><texture filename="wood.png"/></material>'
        '<material name="gone"><texture filename="gone.png"/></material><link name="a"><visual>'
        '<geometry><box size="1 1 1"/></geometry>'
        '<material name="own"><texture filename="wood.png"/></material></visual></link></robot>'
    )
    session = session_of(path)
    robot = state_of(session)["robot"]
    assert list(robot["textures"]) == ["wood"]
    own = robot["links"]["a"]["visual"][0]["texture"]
    assert own == robot["textures"]["wood"] and own["ending"] == ".png"
    found = session.open_file(own["key"])
    assert found is not None and found[1] == "image/png"
    with found[0] as file:
        assert file.read() == PNG


@pytest.mark.parametrize("outcome", [True, False, webbrowser.Error("none")])
def test_where_no_browser_opens_the_address_is_left(
    monkeypatch: pytest.MonkeyPatch, outcome: object
) -> None:
    def open_page(url: str) -> object:
        if isinstance(outcome, Exception):
            raise outcome
        return outcome

    monkeypatch.setattr(webbrowser, "open", open_page)
    said: list[str] = []
    open_browser("http://127.0.0.1:1/", said.append)
    assert (said == []) is (outcome is True)
