"""Tests the judges themselves: each must accept a good robot and tell a bad one."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.consumers import oracles

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"><inertial><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="tip"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="tip"><inertial><mass value="0.5"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
</robot>
"""

# mass 3 kg; about the centre, kg·m². Box: m/12·(y²+z²). Cylinder: m/12·(3r²+l²), m·r²/2.
# Sphere: 2/5·m·r².
KNOWN = [
    ("box", [1.0, 2.0, 3.0], [3 / 12 * 13, 3 / 12 * 10, 3 / 12 * 5]),
    ("cylinder", [0.5, 2.0], [3 / 12 * (3 * 0.25 + 4)] * 2 + [3 * 0.25 / 2]),
    ("sphere", [0.5], [2 / 5 * 3 * 0.25] * 3),
]


def test_check_urdf_tells_good_from_bad() -> None:
    assert oracles.CheckUrdf(ARM).accepts
    assert not oracles.CheckUrdf(ARM.replace('child link="tip"', 'child link="top"')).accepts
    # Here it exits 0 and only prints.
    assert not oracles.CheckUrdf(ARM.replace('mass value="2"', 'mass value="heavy"')).accepts


def test_yourdfpy_reads_links_and_joints() -> None:
    robot = oracles.load_yourdfpy(ARM, Path.cwd())
    assert robot.validate()
    assert list(robot.link_map) == ["base", "tip"]
    assert list(robot.joint_map) == ["elbow"]


def test_pinocchio_and_mujoco_count_the_root_mass() -> None:
    pinocchio = oracles.require_module("pinocchio")
    assert pinocchio.computeTotalMass(oracles.load_pinocchio(ARM)) == pytest.approx(2.5)
    assert sum(oracles.load_mujoco(ARM).body_mass) == pytest.approx(2.5)


@pytest.mark.parametrize("inertia", [oracles.pinocchio_inertia, oracles.mujoco_inertia])
@pytest.mark.parametrize(("shape", "size", "expected"), KNOWN)
def test_inertia_of_shapes_agrees_with_the_formulas(inertia, shape, size, expected) -> None:
    np.testing.assert_allclose(inertia(shape, size, 3.0), np.diag(expected), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("inertia", [oracles.pinocchio_inertia, oracles.mujoco_inertia])
def test_inertia_of_a_capsule_agrees_with_the_integral(inertia) -> None:
    radius, length, mass = 0.3, 1.0, 2.0
    # Discs along z: ∫ ρ·π·r(z)²·(r(z)²/4 + z²) dz about x, ∫ ρ·π·r(z)⁴/2 dz about z.
    half = length / 2
    edges = np.linspace(-half - radius, half + radius, 400_001)
    z = (edges[:-1] + edges[1:]) / 2
    step = edges[1] - edges[0]
    beyond = np.maximum(np.abs(z) - half, 0)
    r2 = radius**2 - beyond**2
    density = mass / np.sum(math.pi * r2 * step)
    about_x = np.sum(density * math.pi * r2 * (r2 / 4 + z**2) * step)
    about_z = np.sum(density * math.pi * r2**2 / 2 * step)
    actual = inertia("capsule", [radius, length], mass)
    np.testing.assert_allclose(actual, np.diag([about_x, about_x, about_z]), rtol=1e-6, atol=1e-9)
