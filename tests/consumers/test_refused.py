"""What urdfdom refuses is an error, and an error is what two of three programs refuse."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.check.test_check import BadRobot, bad_robots, found, read
from tests.consumers import oracles
from tests.consumers.sdf_judges import DESCRIPTIONS, complaint_of_libsdformat
from yamaro.check.robot import check
from yamaro.diagnostics import ERROR, Reporter
from yamaro.model.schema import VERSIONS
from yamaro.model.sdf_schema import CAMERA, NOISE, SURFACE

ROBOTS = [robot for group in ("tree", "joints", "links") for robot in bad_robots(group)]
WARNINGS = (
    "no link",  # files that print or compute are files too
    "no link but a material",
)
"""What urdfdom refuses, and is a warning."""
ERRORS = (
    "cycle off the root",  # urdfdom and pinocchio drop the links in it without a word
    "cycle with a tail",
)
"""What one program alone refuses, and is an error."""


def is_error(robot: BadRobot) -> bool:
    """Tell whether Yamaro refuses the robot where YAML made it."""
    root = read(robot.text)
    root.span.source.is_xml = False
    reporter = Reporter()
    check(root, reporter=reporter)
    return any(diagnostic.severity == ERROR for diagnostic in reporter.diagnostics)


def urdfdom_refuses(text: str, folder: Path) -> bool:
    path = folder / "robot.urdf"
    path.write_text(text, encoding="utf-8")
    return oracles.run_check_urdf(path).returncode != 0


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: robot.name)
def test_what_urdfdom_refuses_is_an_error(robot: BadRobot, tmp_path: Path) -> None:
    version = ElementTree.fromstring(robot.text).get("version", "1.0")
    if version in VERSIONS[1:]:
        sound = f'<robot name="r" version="{version}"><link name="a"/></robot>'
        if urdfdom_refuses(sound, tmp_path):
            pytest.skip(f"this urdfdom does not know version {version} of URDF")
    if urdfdom_refuses(robot.text, tmp_path):
        assert is_error(robot) != (robot.name in WARNINGS)


def refuses(read_robot: Callable[[], object]) -> bool:
    try:
        read_robot()
    except Exception as error:
        # The robots are about one fault each, and few have the masses that MuJoCo wants.
        return "mass and inertia of moving bodies" not in str(error)
    return False


@pytest.mark.parametrize(
    "robot", [r for r in ROBOTS if is_error(r) and r.name not in ERRORS], ids=lambda r: r.name
)
def test_an_error_is_what_two_of_three_programs_refuse(robot: BadRobot, tmp_path: Path) -> None:
    # A mass that moves, as MuJoCo wants it; it stands where none of the faults is.
    text = robot.text.replace(
        '<link name="b"/>',
        '<link name="b"><inertial><mass value="1"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>',
    )
    # pinocchio reads with urdfdom: what that reports and leaves out is missing in both.
    count = 0 if oracles.CheckUrdf(text).accepts else 2
    if not count:
        count += refuses(lambda: oracles.load_pinocchio(text))
    count += refuses(lambda: oracles.load_mujoco(text))
    assert count >= 2


# --- libsdformat --------------------------------------------------------------------------------

SOLID = """<link name="a"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><geometry><box size="1 1 1"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision></link>"""
"""A link that libsdformat keeps: it leaves out those without mass, with what is said of them."""


@pytest.mark.parametrize(
    "robot",
    [
        robot
        for robot in bad_robots("gazebo")
        if "libsdformat rejects" in found(robot.text, advice=True)[0].message
    ],
    ids=lambda robot: robot.name,
)
def test_libsdformat_refuses_what_is_said_to_be_refused(robot: BadRobot, tmp_path: Path) -> None:
    oracles.require_program("ign")
    path = tmp_path / "robot.urdf"
    path.write_text(robot.text.replace('<link name="a"/>', SOLID), encoding="utf-8")
    assert complaint_of_libsdformat(path)


def test_libsdformat_takes_the_values_that_are_fine(tmp_path: Path) -> None:
    oracles.require_program("ign")
    robot = next(r for r in bad_robots("fine") if r.name == "values that libsdformat takes")
    path = tmp_path / "robot.urdf"
    path.write_text(robot.text.replace('<link name="a"/>', SOLID), encoding="utf-8")
    assert complaint_of_libsdformat(path) == ""


def test_libsdformat_has_the_least_and_greatest_values_of_the_table() -> None:
    """Compare the table with the descriptions of SDFormat, where both bound a value."""
    folder = DESCRIPTIONS
    if not folder.is_dir():
        oracles.missing("the descriptions of SDFormat")
    compared = 0
    for name, table in (("camera", CAMERA), ("noise", NOISE), ("surface", SURFACE)):
        root = ElementTree.parse(folder / f"{name}.sdf").getroot()
        pending = [(root, table)]
        while pending:
            described, inner = pending.pop()
            for child in described.findall("element"):
                rule = inner.get(child.get("name", ""))
                if isinstance(rule, dict):
                    pending.append((child, rule))
                elif rule is not None and rule.kind in ("number", "integer"):
                    least = float(child.get("min", "-inf"))
                    most = float(child.get("max", "inf"))
                    assert rule.least >= least or rule.above >= least, child.get("name")
                    assert rule.most <= most, child.get("name")
                    compared += "min" in child.attrib
    assert compared >= 10
