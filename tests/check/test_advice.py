"""The advice of `yamaro check`: what is legal, and most likely not meant."""

from __future__ import annotations

from pathlib import Path

import pytest

from yamaro.commands.main import main

ROBOT = """\
robot:
- part: {{name: a, link: {{geometry: sphere, scale: 1, mass: 1}}}}
- part:
    name: b
    joint: {{type: revolute, parent: a, {joint}}}
    link: {{geometry: sphere, scale: 1, mass: 1}}
"""
LIMIT = "limit: {lower: -1, upper: 1, effort: 1, velocity: 1}"
ELEMENTS = """\
robot:
- link/name=a:
- link/name=b:
- joint/name=j, type=revolute:
    parent/link=a:
    child/link=b:
    axis/xyz=0 0 1:
    limit/lower=-90, upper=1, effort=1, velocity=1:
"""
XML = """\
<robot name="r"{namespace}>
<link name="a"/><link name="b"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/>{joint}</joint>
</robot>
"""
IN_DEGREES = '<axis xyz="0 0 1"/><limit lower="-90" upper="{upper}" effort="1" velocity="1"/>'


@pytest.fixture
def checked(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """Return what `yamaro check` prints of a file with that name and text."""

    def check(name: str, text: str) -> str:
        (tmp_path / name).write_text(text)
        main(["check", str(tmp_path / name)])
        output = capsys.readouterr()
        return output.out + output.err

    return check


@pytest.mark.parametrize(
    ("name", "text", "hints"),
    [
        (
            "part.yaml",
            ROBOT.format(
                joint="axis: z, limit: {lower: -90, upper: $(40 * 2), effort: 1, velocity: 1}"
            ),
            ["for degrees write `-90deg`", "for degrees write `80deg`"],
        ),
        (
            "elements.yaml",
            ELEMENTS,
            ["for degrees write `$(radians(-90))`"],
        ),
        (
            "robot.urdf",
            XML.format(joint=IN_DEGREES.format(upper=1), namespace=""),
            ["-90 degrees are -1.5708"],
        ),
        (
            "robot.urdf.xacro",
            XML.format(
                joint=IN_DEGREES.format(upper="${40 * 2}"),
                namespace=' xmlns:xacro="http://ros.org/wiki/xacro"',
            ),
            ["for degrees write `${radians(-90)}`", "for degrees write `${radians(80)}`"],
        ),
    ],
)
def test_a_limit_of_many_turns_shows_how_degrees_are_written_there(
    checked, name: str, text: str, hints: list[str]
) -> None:
    output = checked(name, text)
    assert [line.partition("; ")[2] for line in output.splitlines() if "in radians;" in line] == (
        hints
    )
