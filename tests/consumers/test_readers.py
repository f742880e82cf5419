"""Programs that read URDF do with faulty robots what docs/checks.md says."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from tests.consumers import oracles, readers
from tests.effort import tried

RECORDED = readers.recorded()


def test_every_robot_is_on_record() -> None:
    assert list(RECORDED) == ["robot", *(robot.name for robot in readers.robots())]
    assert RECORDED["robot"] == list(readers.READERS)


@pytest.mark.slow
def test_programs_do_what_is_on_record() -> None:
    for module in ("yourdfpy", "pinocchio", "mujoco", "pydrake"):
        oracles.require_module(module)
    names = [robot.name for robot in readers.robots()]
    names = [readers.SOUND, *tried(names, str, quick=20, usual=4)]
    # In a process of its own, since each verdict is that of a fork, which threads make unsafe.
    command = [sys.executable, "-m", "tests.consumers.readers", *names]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = dict(zip(names, json.loads(done.stdout.splitlines()[-1]), strict=True))
    quick = len(readers.QUICK)  # libsdformat is the last
    assert found.pop(readers.SOUND) == [readers.READS] * quick
    assert found == {name: RECORDED[name][:quick] for name in found}
