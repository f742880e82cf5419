"""Whatever a `<robot>` holds, it is read, and what it says can be asked for."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.model.robots import EXAMPLES, JOINTS
from yamaro import Robot, build

FOLDER = Path(__file__).parents[2] / "examples"
HEAD, *VALUES = re.split(r"(?<=[a-z]=)(?=\"[^\"]*\")", JOINTS)
WORDS = ["", "0", "1 2 3", "1 2", "nan", "1e999", "x", "0 0 0 0", "-1", "1e300 1e300 1e300", "base"]


@settings(max_examples=examples(200))
@given(
    st.dictionaries(
        st.integers(0, len(VALUES) - 1), st.sampled_from([*WORDS, "turn", "planar"]), max_size=6
    )
)
def test_a_robot_with_other_values_is_read(others: dict[int, str]) -> None:
    values = [
        re.sub(r"^\"[^\"]*\"", f'"{others[number]}"', value) if number in others else value
        for number, value in enumerate(VALUES)
    ]
    robot = Robot.from_xml("".join([HEAD, *values]))
    assert list(robot.poses()) == list(robot.links)
    assert set(robot.frames) <= set(robot.links)
    assert robot.differences(robot) == []


@pytest.mark.parametrize("example", EXAMPLES)
def test_nothing_in_the_examples_is_left_unread(example: str) -> None:
    built = build(FOLDER / example, on_message=lambda line: None)
    assert built.robot.findings == ()
    assert len(built.robot.all_links) == built.xml().count("<link name=")
