"""Moments of links without mass are moved to links with mass, and the robot moves as before."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers import oracles

URDF = """\
<robot name="foot">
  <link name="base"><inertial><mass value="3"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="hip" type="revolute"><parent link="base"/><child link="leg"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="leg"><inertial><origin xyz="0.1 0 -0.2" rpy="0 0 0.3"/><mass value="2"/>
    <inertia ixx="0.3" ixy="0" ixz="0.01" iyy="0.2" iyz="0" izz="0.25"/></inertial></link>
  <joint name="ankle" type="fixed"><parent link="leg"/><child link="foot"/>
    <origin xyz="0 0 -0.4" rpy="0.5 0.2 0"/></joint>
  <link name="foot"><inertial><origin xyz="0 0 0" rpy="0.7 0 0"/><mass value="0"/>
    <inertia ixx="0.1" ixy="0.02" ixz="0" iyy="0.15" iyz="0" izz="0.12"/></inertial></link>
</robot>
"""


@pytest.mark.parametrize("format", ["mjcf", "sdf", "usd"])
def test_it_is_reported(tmp_path: Path, format: str) -> None:
    oracles.require_module("pxr")
    found = [each for each in built(tmp_path, format).losses if "without mass" in each.what]
    assert [(each.kind, each.what, each.owner) for each in found] == [
        ("approximated", "inertias of links without mass", "link 'foot'")
    ]


def test_the_mass_matrix_is_the_same(tmp_path: Path) -> None:
    mujoco, pinocchio = (oracles.require_module(name) for name in ("mujoco", "pinocchio"))
    import numpy as np

    model = mujoco.MjModel.from_xml_string(built(tmp_path, "mjcf").xml())
    assert model.body("leg").mass == 2
    data = mujoco.MjData(model)
    data.qpos[-1] = 0.4
    mujoco.mj_forward(model, data)
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    reference = pinocchio.buildModelFromXML(URDF, pinocchio.JointModelFreeFlyer())
    q = pinocchio.neutral(reference)
    q[-1] = 0.4
    expected = pinocchio.crba(reference, reference.createData(), q)
    assert full[-1, -1] == pytest.approx(expected[-1, -1], rel=1e-12)
    turning = np.triu(expected[3:6, 3:6])  # of the whole robot about its root
    assert np.triu(full[3:6, 3:6]) == pytest.approx(turning, abs=1e-12)


def built(tmp_path: Path, format: str) -> Any:
    path = tmp_path / "foot.urdf"
    path.write_text(URDF)
    return yamaro.build(path, target=format, base="free")
