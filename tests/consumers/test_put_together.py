"""Other people's parsers accept a robot that includes another one several times."""

from __future__ import annotations

import pytest

from tests.consumers.oracles import CheckUrdf, load_yourdfpy
from tests.golden import CASES
from yamaro import build

INCLUDE = CASES / "include"
NAMES = ["same-robot-twice", "material-of-another-look-in-a-urdf", "materials-of-included-files"]


@pytest.mark.parametrize("name", NAMES)
def test_urdfdom_accepts_it(name: str) -> None:
    urdf = CheckUrdf(build(INCLUDE / f"{name}.yaml").xml())
    assert urdf.accepts, urdf.output


@pytest.mark.parametrize("name", NAMES)
def test_yourdfpy_reads_all_of_it(name: str) -> None:
    xml = build(INCLUDE / f"{name}.yaml").xml()
    robot = load_yourdfpy(xml, INCLUDE)
    assert len(robot.link_map) == xml.count("<link name=")
    looks = {each.name: tuple(each.color.rgba) for each in robot.robot.materials}
    assert len(looks) == len(robot.robot.materials) > 0
