"""A robot without links is written in each format, and read by those who read that format."""

from __future__ import annotations

from pathlib import Path

import pytest

import yamaro
from tests.consumers import oracles
from tests.consumers.sdf_judges import complaint_of_libsdformat

TEXTS = {
    "nothing": "model: {print: hello}\n",
    "only the world": "model: {link/name=world: }\n",
    "a material": "model: {material/name=red: {color/rgba=1 0 0 1: }}\n",
    "static for Gazebo": "model: {gazebo: {static: true}}\n",
}


def built(text: str, format: str, sdf_version: str | None = None) -> yamaro.Build:
    return yamaro.build(
        "-", text=text, target=format, on_message=lambda line: None, sdf_version=sdf_version
    )


@pytest.mark.parametrize("format", ["urdf", "mjcf", "sdf", "usd", "srdf"])
def test_a_warning_says_in_each_format_that_there_is_no_link(format: str) -> None:
    codes = [warning.code for warning in built(TEXTS["nothing"], format).warnings]
    assert codes == ["no-link"]


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_libsdformat_reads_it(text: str, tmp_path: Path) -> None:
    oracles.require_program("ign")
    path = tmp_path / "robot.sdf"
    path.write_text(built(text, "sdf", sdf_version="1.9").xml(), encoding="utf-8")
    assert complaint_of_libsdformat(path) == ""


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_mujoco_reads_it(text: str) -> None:
    mujoco = oracles.require_module("mujoco")
    model = mujoco.MjModel.from_xml_string(built(text, "mjcf").xml())
    assert (model.nbody, model.nq) == (1, 0)  # the world


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_openusd_reads_it(text: str, tmp_path: Path) -> None:
    usd = oracles.require_module("pxr.Usd")
    path = tmp_path / "robot.usda"
    path.write_text(built(text, "usd").xml(), encoding="utf-8")
    assert usd.Stage.Open(str(path)).GetDefaultPrim().IsValid()
