"""SDF that is written as URDF: pinocchio reads that, and Drake reads the SDF."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.sources.sdf.same_sdf import Loaded
from tests.sources.sdf.test_same import MODELS

pytest.importorskip("pydrake")
pinocchio = pytest.importorskip("pinocchio")

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
    drake = Loaded(source, None, [])
    model = pinocchio.buildModelFromUrdf(str(urdf))
    data = model.createData()
    moving = [each for each in drake.joints if drake.joints[each].num_velocities() == 1]
    for each in [each for each in moving if each not in set(model.names)]:
        joint = drake.joints.pop(each)
        drake.joints[joint.name()] = joint
    joints = [each for each in drake.joints if each in set(model.names)]
    assert len(joints) == model.njoints - 1
    random = np.random.default_rng(5)
    frames = [each for each in drake.frames if model.existFrame(each)]
    assert frames, "Drake names frames of nested models otherwise"
    if "nested" not in name:
        assert set(frames) == set(drake.frames)
    for _ in range(20):
        q = pinocchio.neutral(model)
        positions = np.zeros(drake.plant.num_positions())
        for body in drake.plant.GetFloatingBaseBodies():
            positions[drake.plant.get_body(body).floating_positions_start()] = 1.0
        for each in joints:
            joint = model.joints[model.getJointId(each)]
            angle = random.uniform(-1, 1)
            q[joint.idx_q : joint.idx_q + joint.nq] = (
                angle if joint.nq == 1 else (np.cos(angle), np.sin(angle))
            )
            positions[drake.joints[each].position_start()] = angle
        drake.plant.SetPositions(drake.context, positions[:, None])
        pinocchio.framesForwardKinematics(model, data, q)
        root = model.frames[1].name
        origin = np.linalg.inv(_in_pinocchio(model, data, root))
        for each in frames:
            mine = origin @ _in_pinocchio(model, data, each)
            base = drake.pose(drake.frames[root]) if root != "world" else np.eye(4)
            theirs = np.linalg.inv(base) @ drake.pose(drake.frames[each])
            assert mine == pytest.approx(theirs, abs=1e-9)
        mass = pinocchio.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        order = [model.joints[model.getJointId(each)].idx_v for each in joints]
        assert mass[np.ix_(order, order)] == pytest.approx(drake.mass_matrix(joints), rel=1e-9)


def _in_pinocchio(model: Any, data: Any, name: str) -> Any:
    return data.oMf[model.getFrameId(name, pinocchio.FrameType.BODY)].homogeneous
