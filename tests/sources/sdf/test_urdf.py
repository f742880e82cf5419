"""SDF that is written as URDF: pinocchio reads that, and Drake reads the SDF."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import pytest

import yamaro
from tests.sources.sdf.same_sdf import Loaded, faults_of_urdf
from tests.sources.sdf.test_same import MODELS

pytestmark = pytest.mark.skipif(
    not (find_spec("pydrake") and find_spec("pinocchio")), reason="needs Drake and pinocchio"
)

HELD = [
    "at the link", "beside the link", "along its axis", "a slider beside the link",
    "relative to the parent", "an axis of another frame", "quaternions and degrees",
    "held in the world", "a joint the other way", "a nested model",
    "a nested model placed by a frame",
]  # fmt: skip
"""Models that URDF can hold."""


@pytest.mark.parametrize("name", HELD)
def test_a_model_moves_the_same_as_urdf(name: str, tmp_path: Path) -> None:
    source, urdf = tmp_path / "robot.sdf", tmp_path / "robot.urdf"
    source.write_text(f'<sdf version="1.11"><model name="robot">{MODELS[name]}</model></sdf>')
    urdf.write_text(yamaro.build(source).xml())
    assert faults_of_urdf(Loaded(source, None, []), urdf) == []
