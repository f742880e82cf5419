"""What parsers of URDF refuse is an error, and nothing is an error that all of them read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.check.test_check import BadRobot, bad_robots, read
from tests.consumers import oracles
from yamaro.check.robot import check
from yamaro.diagnostics import ERROR, Reporter
from yamaro.model.urdf_schema import VERSIONS

ROBOTS = [robot for group in ("tree", "joints", "links") for robot in bad_robots(group)]
READ_BY_ALL = (
    "empty link name",  # by itself; as a parent or child urdfdom takes it for a missing name
    "empty joint name",
    "mimic missing joint",  # these are refused by ros2_control
    "mimic of a link",
    "mimic in a circle",
)


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
        assert is_error(robot)


def refuses(read_robot: Callable[[], object]) -> bool:
    try:
        read_robot()
    except Exception as error:
        # The robots are about one fault each, and few have the masses that MuJoCo wants.
        return "mass and inertia of moving bodies" not in str(error)
    return False


@pytest.mark.parametrize(
    "robot", [r for r in ROBOTS if is_error(r) and r.name not in READ_BY_ALL], ids=lambda r: r.name
)
def test_an_error_is_what_some_parser_refuses(robot: BadRobot, tmp_path: Path) -> None:
    # A mass that moves, as MuJoCo wants it; it stands where none of the faults is.
    text = robot.text.replace(
        '<link name="b"/>',
        '<link name="b"><inertial><mass value="1"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>',
    )
    assert (
        not oracles.CheckUrdf(text).accepts
        or refuses(lambda: oracles.load_yourdfpy(text, tmp_path))
        or refuses(lambda: oracles.load_pinocchio(text))
        or refuses(lambda: oracles.load_mujoco(text))
    )
