"""Variables that a build does not take: those of included files, and computed ones."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.tools.view.conftest import Page
from tests.tools.view.test_page import Start
from yamaro import Policy
from yamaro.options import Options
from yamaro.policy import JAIL
from yamaro.rebuilding import Rebuilder
from yamaro.tools.view.session import Session

MAIN = """\
robot: table
variables:
  leg_length: 0.7
  legs: 4
  depth/child: 0.03
  half: $(leg_length / 2)
model:
- link/name=base:
- for i in range(legs):
  - include: {path: parts/leg.yaml, length: $(leg_length), radius: 0.02, index: $(i)}
"""
LEG = """\
variables:
  length: 1
  radius: 1
  index: 0
  depth: 0.5
  mass: 2
  density: $(mass / length)
functions:
  Unused: {input: x, body: {variables: {inner: 1}}}
model:
- include: {path: foot.yaml, size: $(radius), height: $(length)}
"""
FOOT = """\
arguments:
  size: {default: 1, unit: m}
  height: 1
  pads: 3
"""


@pytest.fixture
def table(tmp_path: Path) -> Path:
    folder = tmp_path / "parts"
    folder.mkdir()
    (folder / "leg.yaml").write_text(LEG)
    (folder / "foot.yaml").write_text(FOOT)
    path = tmp_path / "table.yaml"
    path.write_text(MAIN)
    return path


def session_of(path: Path, mode: str = "trusted", *command_line: str) -> Session:
    rebuilder = Rebuilder(
        str(path),
        Options(
            policy=Policy(mode),
            command_line=list(command_line),
            on_message=lambda line: None,
        ),
    )
    session = Session(rebuilder, editor=None)
    session.build()
    return session


def files_of(session: Session) -> dict[str, dict[str, Any]]:
    """Return the variables by file and name."""
    return {
        each["file"]: {row["name"]: row for row in each["variables"]}
        for each in json.loads(session.included())["files"]
    }


@pytest.mark.parametrize("mode", ["trusted", pytest.param(JAIL, marks=pytest.mark.slow), "safe"])
def test_all_variables_in_the_roots_of_files_have_their_values(table: Path, mode: str) -> None:
    files = files_of(session_of(table, mode))
    values = {
        file: {name: row["values"] for name, row in rows.items()} for file, rows in files.items()
    }
    assert values == {
        "table.yaml": {"half": ["0.35"]},
        "parts/leg.yaml": {
            "length": ["0.7"],
            "radius": ["0.02"],
            "index": ["0", "1", "2", "3"],
            "depth": ["0.03"],
            "mass": ["2"],
            "density": ["2.85714285714286"],
        },
        "parts/foot.yaml": {"size": ["0.02"], "height": ["0.7"], "pads": ["3"]},
    }


def test_only_what_follows_a_variable_of_the_main_file_can_be_set(table: Path) -> None:
    files = files_of(session_of(table))
    follows = {
        (file, name): row["follows"]
        for file, rows in files.items()
        for name, row in rows.items()
        if "follows" in row
    }
    assert follows == {
        ("parts/leg.yaml", "length"): "leg_length",
        ("parts/leg.yaml", "depth"): "depth",  # through its scope
        ("parts/foot.yaml", "height"): "leg_length",  # through both includes
    }


def test_the_others_say_why_they_cannot_be_set(table: Path) -> None:
    files = files_of(session_of(table))
    leg = files["parts/leg.yaml"]
    line = MAIN.splitlines().index("- for i in range(legs):") + 2
    assert leg["radius"]["why"] == leg["index"]["why"] == f"set at table.yaml:{line}"
    assert leg["mass"]["why"] == "private to leg.yaml: the file that includes it can pass mass: …"
    assert leg["density"]["why"] == "computed: $(mass / length)"
    assert files["table.yaml"]["half"]["why"] == (
        "computed: $(leg_length / 2); half:=… on the command line replaces that"
    )
    assert leg["mass"]["text"].endswith("leg.yaml:6:3")


def test_a_value_that_follows_changes_with_the_variable(table: Path) -> None:
    session = session_of(table)
    session.set_variables({"leg_length": 0.5})
    session.build()
    files = files_of(session)
    assert files["parts/leg.yaml"]["length"]["values"] == ["0.5"]
    assert files["parts/leg.yaml"]["density"]["values"] == ["4.0"]


def test_a_file_with_arguments_takes_no_other_names(table: Path) -> None:
    text = "robot: table\narguments: {n: 1}\nvariables: {m: 2}\nmodel:\n- link/name=base:\n"
    table.write_text(text)
    row = files_of(session_of(table))["table.yaml"]["m"]
    assert row["why"] == (
        "table.yaml declares arguments, and a build takes no other names: declare it there"
    )


def test_a_place_of_a_variable_opens_until_the_robot_changes(table: Path) -> None:
    session = session_of(table)
    answer = json.loads(session.included())
    row = answer["files"][1]["variables"][0]
    place = session.place(row["place"], version=answer["version"], is_fault=False)
    assert place == (str(table.parent / "parts" / "leg.yaml"), 2, 3)
    session.build()
    assert session.place(row["place"], version=answer["version"], is_fault=False) is None


def test_there_is_nothing_more_of_a_file_that_is_all_fields(tmp_path: Path) -> None:
    path = tmp_path / "plain.yaml"
    path.write_text("robot: r\nvariables: {a: 1}\nmodel:\n- link/name=base:\n")
    session = session_of(path)
    assert json.loads(session.state())["hasMore"] is False
    path.write_text("robot: r\nvariables: {a: 1, b: $(a)}\nmodel:\n- link/name=base:\n")
    session.rebuild()
    session.build()
    assert json.loads(session.state())["hasMore"] is True


def test_the_arguments_of_xacro_files_that_are_included_can_be_set(tmp_path: Path) -> None:
    names = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    (tmp_path / "part.xacro").write_text(
        f'<robot {names}><xacro:arg name="length" default="0.5"/>'
        '<link name="l$(arg length)"/></robot>'
    )
    path = tmp_path / "main.xacro"
    path.write_text(f'<robot name="r" {names}><xacro:include filename="part.xacro"/></robot>')
    session = session_of(path)
    (field,) = json.loads(session.state())["variables"]
    assert (field["name"], field["value"]) == ("length", 0.5)
    assert field["file"] == str(tmp_path / "part.xacro")
    session.set_variables({"length": 0.75})
    turn = session.build()
    assert turn.build is not None and list(turn.build.robot.links) == ["l0.75"]
    assert session.place_of_variable("length") == (str(tmp_path / "part.xacro"), 1, 53)


def test_the_page_shows_them_by_file_and_sets_what_follows(
    page: Page, view: Start, table: Path
) -> None:
    page.show(view(table))
    assert page.text("#included-files") == ""
    page.press("#included > summary")
    groups = (
        "[...document.querySelectorAll('#included-files summary')].map(e => e.innerText.trim())"
    )
    page.wait_for(f"{groups}.length === 3")
    assert page.run(groups) == ["table.yaml 1", "leg.yaml 6", "foot.yaml 3"]
    page.run("document.querySelectorAll('.file-group').forEach((e) => { e.open = true; })")
    leg = "#included-files details:nth-of-type(2)"
    assert page.text(f"{leg} [data-included=mass] .fixed") == "2"
    assert "private to leg.yaml" in page.text(f"{leg} [data-included=mass] .why")
    assert page.text(f"{leg} [data-included=index] .fixed") == "4 values"
    page.press(f"{leg} [data-included=length] input.number")
    page.run("document.activeElement.select()")
    page.after(lambda: page.type("0.9"))
    assert page.text("#assignments") == "leg_length:=0.9"
    assert (
        page.run("document.querySelector('[data-variable=leg_length] input.number').value") == "0.9"
    )
    density = f"document.querySelector('{leg} [data-included=density] .fixed').innerText"
    page.wait_for(f"{density}.startsWith('2.22')")  # 2 / 0.9
