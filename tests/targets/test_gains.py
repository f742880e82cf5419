"""Gains that are chosen for actuators without any: each joint follows, as MuJoCo moves it."""

from __future__ import annotations

from math import degrees
from typing import Any

import pytest

import yamaro
from tests.consumers import oracles

FLANGE = """
robot: arm
base: fixed
model:
- part: {{name: base, link: {{geometry: box, size: 0.2 0.2 0.2, mass: 5, visual: }}}}
- part:
    name: upper
    joint:
      type: revolute
      parent: base
      xyz: 0 0 0.2
      axis: x
      limit: {{lower: -3, upper: 3, effort: 1, velocity: 3}}
      actuator: {{command: position}}
    link:
      {{geometry: cylinder, radius: 0.05, length: 0.5, xyz: 0.25 0 0, rpy: 0 90deg 0, mass: 4}}
- part:
    name: flange
    joint:
      actuator: {{command: position}}
      type: {type}
      parent: upper
      xyz: 0.5 0 0
      axis: {axis}
      {limit}
    link: {{geometry: cylinder, radius: {radius}, length: 0.04, rpy: {rpy}, mass: {mass}, visual: }}
"""
WRIST = {"type": "revolute", "axis": "x", "rpy": "0 90deg 0", "radius": 0.04, "mass": 0.2}
UPRIGHT = {"type": "revolute", "axis": "z", "rpy": "0 0 0", "radius": 0.2, "mass": 3}
LIMITED = "limit: {{lower: -3, upper: 3, effort: {}, velocity: 4}}"
JOINTS = {
    "wrist": {**WRIST, "limit": LIMITED.format(28)},
    "weak": {**WRIST, "limit": LIMITED.format(0.5)},
    "light": {**WRIST, "limit": LIMITED.format(28), "radius": 0.02, "mass": 0.02},
    "turntable": {**UPRIGHT, "limit": LIMITED.format(10)},
    "endless": {**WRIST, "limit": "limit: {effort: 28, velocity: 4}", "type": "continuous"},
    "without limits": {**WRIST, "limit": "", "type": "continuous"},
}


def compiled(joint: dict[str, Any]) -> tuple[Any, Any]:
    mujoco = oracles.require_module("mujoco")
    text = FLANGE.format(**joint)
    build = yamaro.build("flange.yaml", text=text, target="mjcf", on_message=lambda line: None)
    model = mujoco.MjModel.from_xml_string(build.xml())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def moved(joint: dict[str, Any], step: float, seconds: float) -> list[float]:
    """Return where a flange is in each step of time after its target has moved."""
    mujoco = oracles.require_module("mujoco")
    model, data = compiled(joint)
    data.ctrl[1] = step
    found = []
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
        found.append(float(data.qpos[1]))
    return found


@pytest.mark.parametrize("name", JOINTS)
def test_a_joint_whose_weight_is_on_its_axis_follows_its_target(name: str) -> None:
    way = moved(JOINTS[name], 1.0, 0.5)
    assert all(abs(position - 1) < 0.02 for position in way[-100:])
    assert max(way) < 1.1


@pytest.mark.parametrize("name", JOINTS)
def test_a_joint_whose_weight_is_on_its_axis_stays_while_the_arm_turns(name: str) -> None:
    mujoco = oracles.require_module("mujoco")
    model, data = compiled(JOINTS[name])
    data.ctrl[0] = 1.5
    worst = 0.0
    for _ in range(1000):
        mujoco.mj_step(model, data)
        worst = max(worst, abs(float(data.qpos[1])))
    assert data.qpos[0] == pytest.approx(1.5, abs=0.05)
    assert worst < 0.1


def test_a_tenth_of_the_effort_limit_moves_a_joint_by_at_most_a_tenth_of_a_radian() -> None:
    mujoco = oracles.require_module("mujoco")
    model, data = compiled(JOINTS["turntable"])
    data.qfrc_applied[1] = 1.0
    for _ in range(1000):
        mujoco.mj_step(model, data)
    assert 0 < abs(float(data.qpos[1])) < 0.1


def test_usd_has_the_gains_of_mujoco() -> None:
    oracles.require_module("pxr")
    from pxr import Sdf, Usd

    model, _ = compiled(JOINTS["wrist"])
    text = FLANGE.format(**JOINTS["wrist"])
    build = yamaro.build("flange.yaml", text=text, target="usd", on_message=lambda line: None)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(build.xml())
    stage = Usd.Stage.Open(layer)
    joint = stage.GetPrimAtPath("/arm/joints/flange_joint")
    stiffness = joint.GetAttribute("drive:angular:physics:stiffness").Get()
    assert degrees(stiffness) == pytest.approx(model.actuator_gainprm[1][0], rel=1e-6)
