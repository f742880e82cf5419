"""MJCF of random trees of links, against pinocchio's reading of the URDF."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import yamaro
from tests.consumers.oracles import require_module
from tests.effort import examples
from tests.targets.mechanics import (
    Mujoco,
    PinocchioMjcf,
    PinocchioUrdf,
    differences,
    joint_differences,
    mimic_differences,
    missing_frames,
)

KINDS = ("revolute", "continuous", "prismatic", "fixed", "fixed", "floating", "frame")


def random_urdf(seed: int) -> str:
    """Return a robot of up to 20 links with random joints, poses, axes and inertias."""
    random = np.random.default_rng(seed)

    def row(size: int, scale: float = 1.0) -> str:
        return " ".join(repr(float(each)) for each in random.uniform(-scale, scale, size))

    def origin() -> str:
        return f'<origin xyz="{row(3)}" rpy="{row(3, 4)}"/>'

    def inertial() -> str:
        root = random.uniform(-1, 1, (3, 4))
        spread = root @ root.T  # the integral of x·xᵀ, of which every body has one
        i = np.trace(spread) * np.eye(3) - spread
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        numbers = zip(names, i[np.triu_indices(3)].tolist(), strict=True)
        inertia = " ".join(f'{name}="{value!r}"' for name, value in numbers)
        mass = float(random.uniform(0.1, 5))
        return f'<inertial>{origin()}<mass value="{mass!r}"/><inertia {inertia}/></inertial>'

    parts = ['<robot name="tree">', f'<link name="l0">{inertial()}</link>']
    single: list[str] = []
    for index in range(1, int(random.integers(2, 21))):
        kind = str(random.choice(KINDS))
        parent = f"l{random.integers(0, index)}"
        is_frame = kind == "frame"
        parts.append(f'<link name="l{index}">{"" if is_frame else inertial()}</link>')
        low, high, effort = random.uniform(0.1, 3, 3).tolist()
        word = "fixed" if is_frame else kind
        parts.append(
            f'<joint name="j{index}" type="{word}"><parent link="{parent}"/>'
            f'<child link="l{index}"/>{origin()}<axis xyz="{row(3)}"/>'
            f'<limit lower="{-low!r}" upper="{high!r}" effort="{effort!r}" velocity="1"/>'
            f'<dynamics damping="{random.integers(0, 3)}" friction="{random.integers(0, 2)}"/>'
        )
        if kind in ("revolute", "continuous", "prismatic"):
            if single and random.random() < 0.2:
                leader = random.choice(single)
                parts.append(f'<mimic joint="{leader}" multiplier="{row(1)}" offset="{row(1)}"/>')
            single.append(f"j{index}")
        parts.append("</joint>")
    return "\n".join([*parts, "</robot>"])


@pytest.mark.parametrize("base", ["fixed", "free"])
@settings(max_examples=examples(25), suppress_health_check=[HealthCheck.too_slow])
@given(seed=st.integers(0, 2**32 - 1))
def test_random_trees_move_as_their_urdf_does(base: str, seed: int) -> None:
    require_module("pinocchio")
    require_module("mujoco")
    urdf = random_urdf(seed)
    build = yamaro.build("tree.urdf", text=urdf, target="mjcf", base=base)
    reference = PinocchioUrdf(urdf, is_fixed=base == "fixed")
    model = Mujoco(build.xml(), {}, reference.joints)
    assert max(differences(reference, model, 3, seed).values()) < 1e-9
    assert not missing_frames(reference, model)
    assert not joint_differences(reference.description, model.model)
    assert not mimic_differences(reference.description, model.model)
    if "floating" not in reference.description.moving().values():
        other = PinocchioMjcf(build.xml(), {}, reference.joints)
        assert max(differences(reference, other, 2, seed).values()) < 1e-9


def test_a_loop_is_closed_by_equalities(tmp_path) -> None:
    mujoco = require_module("mujoco")
    path = tmp_path / "robot.yaml"
    path.write_text(LOOP)
    build = yamaro.build(path, target="mjcf")
    model = mujoco.MjModel.from_xml_string(build.xml())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_forward(model, data)
    # A parallelogram is closed at home, and its sides stay parallel when it is turned.
    assert abs(data.efc_pos[: data.ne]).max() < 1e-12
    data.qvel[model.joint("left_joint").dofadr[0]] = 0.5
    for _ in range(1000):
        mujoco.mj_step(model, data)
    left, right = (data.joint(f"{side}_joint").qpos[0] for side in ("left", "right"))
    assert abs(left) > 0.05
    assert right == pytest.approx(left, abs=5e-3)
    assert np.abs(data.site("tip").xpos - data.site("pin").xpos).max() < 1e-3


LOOP = """
robot: parallelogram
base: fixed
model:
- part: {name: base, link: {mass: 1, geometry: box, scale: 1 0.1 0.1}}
- part:
    name: left
    joint: {type: continuous, parent: base, axis: y}
    link: {mass: 1, geometry: box, scale: 0.1 0.1 1, xyz: 0 0 -0.5}
- part:
    name: right
    joint: {type: continuous, parent: base, xyz: 1 0 0, axis: y}
    link: {mass: 1, geometry: box, scale: 0.1 0.1 1, xyz: 0 0 -0.5, frame/name=pin: {xyz: 0 0 -1}}
- part:
    name: bar
    joint: {type: continuous, parent: left, xyz: 0 0 -1, axis: y}
    link:
      mass: 1
      geometry: box
      scale: 1 0.1 0.1
      xyz: 0.5 0 0
      frame/name=tip: {xyz: 1 0 0, rpy: 0 0 90deg}
- loop: {name: closing, type: revolute, between: [tip, pin], axis: x}
"""
