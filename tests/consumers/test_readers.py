"""Programs that read URDF do with faulty robots what docs/checks.md says."""

from __future__ import annotations

import pytest

from tests.check.test_check import BadRobot
from tests.consumers import readers
from tests.effort import tried

RECORDED = readers.recorded()
QUICK = [name for name in readers.READERS if name != "libsdformat"]
"""Programs that take milliseconds."""
SOUND = '<robot name="r"><link name="a"/></robot>'


def test_every_robot_is_on_record() -> None:
    assert list(RECORDED) == ["robot", *(robot.name for robot in readers.robots())]
    assert RECORDED["robot"] == list(readers.READERS)


def test_every_program_reads_a_sound_robot_without_a_word() -> None:
    assert readers.judged(SOUND) == [readers.READS] * len(readers.READERS)


@pytest.mark.parametrize(
    "robot",
    tried(readers.robots(), lambda robot: robot.name, quick=20, usual=4),
    ids=lambda robot: robot.name,
)
def test_programs_do_what_is_on_record(robot: BadRobot) -> None:
    verdicts = dict(zip(readers.READERS, RECORDED[robot.name], strict=True))
    assert readers.judged(robot.text, QUICK) == [verdicts[name] for name in QUICK]
