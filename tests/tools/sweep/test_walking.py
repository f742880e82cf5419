"""The study of the example: its walk costs what a simulation step by step says."""

from __future__ import annotations

import importlib.util
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.tools.sweep.robots import EXAMPLES, variant_of
from yamaro.tools.sweep.metrics import compiled

STUDY = EXAMPLES / "quadruped" / "study"


@pytest.fixture(scope="module")
def walk() -> Any:
    require_module("mujoco")
    spec = importlib.util.spec_from_file_location("walk", STUDY / "walk.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def scene_of(**lengths: float) -> Any:
    return compiled(variant_of("quadruped/quadruped.yaml", lengths).build, has_floor=True)


def test_the_cost_is_that_of_a_simulation_step_by_step(walk) -> None:
    mujoco = require_module("mujoco")
    legs = walk.Legs(scene_of(thigh_length=0.2, calf_length=0.16))
    found = walk.Walk(legs, 2.15)

    model = legs.model
    dt, first = model.opt.timestep, round(walk.START / model.opt.timestep)
    data = mujoco.MjData(model)
    mujoco.mj_setState(model, data, walk._standing(legs), mujoco.mjtState.mjSTATE_FULLPHYSICS)
    count = first + round(round(walk.MEASURED * 2.15) / 2.15 / dt)
    work = heat = 0.0
    start = None
    for number, asked in enumerate(legs.commands(2.15, np.arange(count) * dt)):
        if number == first:
            start = data.qpos[:2].copy()
        data.ctrl[legs.motors] = asked
        speeds = data.qvel[legs.speeds].copy()
        mujoco.mj_step(model, data)
        if start is not None:
            torques = data.actuator_force[legs.motors]
            work += np.maximum(torques * speeds, 0).sum() * dt
            heat += walk.LOSS * (torques**2).sum() * dt
    way = model.body_mass.sum() * 9.81 * np.hypot(*(data.qpos[:2] - start))
    assert found.is_good
    assert found.work == pytest.approx(work / way, rel=0.01)
    assert found.heat == pytest.approx(heat / way, rel=0.01)


def test_longer_legs_need_less_work_and_lose_more_heat(walk) -> None:
    short, long = (
        walk.score(scene_of(thigh_length=length, calf_length=length)) for length in (0.13, 0.25)
    )
    assert short["walks"] and long["walks"]
    assert short["work"] > 1.2 * long["work"]
    assert short["heat"] < long["heat"] / 2
    assert short["cost_of_transport"] < long["cost_of_transport"]
    assert short["frequency"] > long["frequency"]


def test_the_study_runs(tmp_path) -> None:
    require_module("mujoco")
    sweep = yamaro.sweep(
        STUDY / "study.yaml", tmp_path / "runs", samples=2, chunk=2, engine="local:1"
    )
    columns = sweep.columns()
    assert set(columns["status"]) <= {"ok", "rejected"}
    costs = [cost for cost in columns["cost_of_transport"] if cost is not None]
    assert len(costs) == columns["status"].count("ok") > 0
    assert all(0.5 < cost < 5 for cost in costs)
