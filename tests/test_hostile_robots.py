"""Bad robots, written in YAML: the command tells each fault, and where in the YAML it was made."""

from __future__ import annotations

import os
import struct
from pathlib import Path

import pytest

from tests.check.test_check import FAULTY, BadRobot, bad_robots, read
from tests.hostile.hostile_inputs import OLD_OUTPUT, read_inputs
from tests.test_hostile import PLACE
from yamaro.commands.main import main
from yamaro.xml.tree import Element, Text

NAMED_AFTER_THE_FILE = "no robot name"  # in YAML a robot has a name in any case
# In YAML, what xacro left is told of where it is read.
ODD = [one for one in bad_robots("advice") if one.codes != ["leftover-expression"]]


class YamlWriter:
    """Writes elements as YAML; tells where in it stands what stood at an offset of the URDF.

    Keys are in angle brackets, so that each name is an element's, and in double quotes.
    """

    def __init__(self, urdf: str) -> None:
        self.urdf = urdf
        self.text = ""
        self.places: dict[int, tuple[int, int]] = {}
        root = read(urdf)
        self.write(root, "")

    def write(self, element: Element, margin: str) -> None:
        self.text += f"{margin}- " if margin else ""
        self.note(element.span.start)
        self.text += f'"<{element.name}'
        separator = "/"
        for name, value in element.attributes.items():
            self.text += separator
            span = element.value_span(name)
            self.note(self.urdf.rindex(name, 0, span.start))
            if not value:
                self.note(span.start)  # of an empty value the attribute is shown
            self.text += f"{name}='"
            if value:
                self.note(span.start)
            self.text += escaped(str(value)) + "'"
            separator = ", "
        self.text += '>":'
        texts = [child for child in element.children if isinstance(child, Text)]
        self.text += f' "{texts[0].value}"\n' if texts else "\n"
        for child in element.elements():
            self.write(child, margin + "    " if margin else "  ")

    def note(self, offset: int) -> None:
        lines = self.text.split("\n")
        self.places[offset] = (len(lines), len(lines[-1]) + 1)


def escaped(value: str) -> str:
    return value.replace("\n", "\\n").replace("\t", "\\t").replace("${", "$${")


def found_places(messages: str) -> list[tuple[int, int]]:
    return [(int(line), int(column)) for _, line, column in PLACE.findall(messages)]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out.urdf").write_bytes(OLD_OUTPUT)
    (tmp_path / "a.stl").write_text("solid a\nendsolid a\n")
    return tmp_path


@pytest.mark.parametrize(
    "robot", [one for one in FAULTY if one.name != NAMED_AFTER_THE_FILE], ids=lambda one: one.name
)
def test_the_fault_of_a_bad_robot_is_told_where_the_yaml_made_it(
    robot: BadRobot, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    yaml = YamlWriter(robot.text)
    (folder / "robot.yaml").write_text(yaml.text, encoding="utf-8")
    status = main(["robot.yaml", "--strict", "-o", "out.urdf"])
    written = capsys.readouterr()
    codes = [line[6:].partition("]")[0] for line in written.err.splitlines() if line[:5] == "error"]
    assert (status, sorted(codes)) == (1, sorted(robot.codes)), yaml.text + written.err
    expected = [yaml.places[start] for start, _ in robot.places]
    assert sorted(found_places(written.err)) == sorted(expected), yaml.text + written.err
    assert (folder / "out.urdf").read_bytes() == OLD_OUTPUT
    assert written.out == ""


@pytest.mark.parametrize("robot", ODD, ids=lambda one: one.name)
def test_an_odd_robot_is_compiled_and_yamaro_check_tells_where(
    robot: BadRobot, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    yaml = YamlWriter(robot.text)
    (folder / "robot.yaml").write_text(yaml.text, encoding="utf-8")
    assert main(["robot.yaml", "--strict", "-o", "out.urdf"]) == 0
    assert (capsys.readouterr().err, (folder / "out.urdf").read_bytes() == OLD_OUTPUT) == (
        "",
        False,
    )
    assert main(["check", "robot.yaml"]) == 1
    messages = capsys.readouterr().err
    for (start, _), code in zip(robot.places, robot.codes, strict=True):
        line, column = yaml.places[start]
        assert f"warning[{code}]: " in messages
        assert f"robot.yaml:{line}:{column}\n" in messages


# Each row of the table of research: what it asks for, and the robots with that fault.
ROWS = {
    "duplicate link": "duplicate link",
    "duplicate joint": "duplicate joint",
    "missing parent": "unknown parent",
    "missing child": "unknown child",
    "link with two parents": "two parents",
    "cycle": "cycle of all links",
    "cycle off the root": "cycle off the root",
    "self joint": "self joint",
    "two roots": "two roots",
    "no link": "no link",
    "no robot name": "no robot name",
    "revolute without limit": "revolute without limit",
    "prismatic without limit": "prismatic without limit",
    "limit without effort": "limit without effort",
    "lower > upper": "lower above upper",
    "axis 0 0 0": "axis zero",
    "axis not unit": "axis too long",
    "xyz with 2 parts": "origin with two numbers",
    "xyz with 4 parts": "origin with four numbers",
    "xyz text": "origin with a word",
    "xyz 1,5": "origin with a decimal comma",
    "xyz NaN": "origin with NaN",
    "xyz inf": "origin with inf",
    "xyz 1e400": "origin with 1e400",
    "mass < 0": "mass negative",
    "mass < 0 on a moving link": "mass bad on a moving link",
    "mass 0": "mass zero",
    "mass NaN": "mass NaN",
    "mass inf": "mass infinite",
    "mass 1e400": "mass 1e400",
    "mass text": "mass a word",
    "inertia negative": "inertia negative",
    "inertia zero": "inertia zero",
    "inertia breaks A+B≥C": "inertia breaks the triangle inequality",
    "inertia off-diagonal": "inertia with off-diagonals too large",
    "box 0": "box zero",
    "box negative": "box negative",
    "sphere < 0": "sphere negative",
    "cylinder without length": "cylinder without length",
    "two geometries": "two geometries",
    "mesh missing": "robots: a mesh that is not there",
    "package unknown": "robots: a mesh in a package that is not there",
    "material undefined": "material undefined",
    "rgba 3 parts": "rgba with three numbers",
    "rgba 255": "rgba 255",
    "mimic missing": "mimic missing joint",
    "mimic itself": "mimic itself",
    "name empty": "empty link name",
    "name with space": "link name with space",
    "name with /": "link name with a slash",
    "name with newline": "link name with newline",
    "root link with inertia": "root with inertia",
    "chain of 5 000 links": "robots: a chain of five thousand links",
    "gimbal rpy": "gimbal lock",
    "degrees as radians": "rpy in degrees",
    "mesh in mm": "large-mesh",
    "density outlier": "heavier than osmium",
}


def test_each_row_of_the_table_of_research_has_its_robot() -> None:
    names = {robot.name for robot in FAULTY + ODD} | {str(one) for one in read_inputs()}
    names.add("large-mesh")  # needs a file: the next test
    assert sorted(set(ROWS.values()) - names) == []
    assert len(ROWS) >= 56


def test_a_mesh_in_millimetres_is_told_where_the_yaml_names_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    corners = ((0, 0, 0), (1000, 0, 0), (0, 1000, 0), (0, 0, 1000))
    faces = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
    triangles = [
        struct.pack("<12fH", 0, 0, 0, *(x for index in face for x in corners[index]), 0)
        for face in faces
    ]
    (folder / "arm.stl").write_bytes(bytes(80) + struct.pack("<I", 4) + b"".join(triangles))
    line = "  part: {name: a, link: {geometry: arm.stl, visual: }}"
    (folder / "robot.yaml").write_text(f"robot: r\nmodel:\n{line}\n")
    assert main(["check", "robot.yaml"]) == 1
    messages = capsys.readouterr().err
    assert messages.startswith("warning[large-mesh]: ")
    assert f" --> robot.yaml:3:{line.index('arm.stl') + 1}\n" in messages


def test_a_mesh_too_large_to_be_looked_through_gets_no_advice(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = "  part: {name: a, link: {geometry: arm.stl, visual: }}"
    (folder / "robot.yaml").write_text(f"robot: r\nmodel:\n{line}\n")
    count = 2**32 - 1
    (folder / "arm.stl").write_bytes(bytes(80) + struct.pack("<I", count))
    os.truncate(folder / "arm.stl", 84 + 50 * count)  # 200 GB, of which nothing lies on the disk
    assert main(["check", "robot.yaml"]) == 0
    assert capsys.readouterr().out == "robot.yaml: ok\n"
