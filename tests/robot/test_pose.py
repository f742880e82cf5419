"""Poses that are computed: what is only rounding counts as 0."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from yamaro import build
from yamaro.robot.pose import NO_POSE, compose_poses, pose_at

TINY = 9e-13  # a picometre is 1e-12


def test_a_frame_that_is_not_moved_has_no_pose() -> None:
    assert pose_at((0.0, 0.0, 0.0)) is NO_POSE


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_less_than_a_picometre_is_rounding(axis: int, sign: float) -> None:
    position = [1.0, 1.0, 1.0]
    position[axis] = sign * TINY
    pose = pose_at((position[0], position[1], position[2]))
    expected = [1.0, 1.0, 1.0]
    expected[axis] = 0.0
    assert list(pose.xyz.values) == expected
    assert [float(word) for word in pose.xyz.words] == expected
    # Nothing of it comes back when poses are put together.
    moved = compose_poses(pose, pose_at((0.0, 0.0, 0.0)))
    assert list(moved.xyz.values) == expected


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("value", [1e-12, 2e-12, -2e-12, 1e-9, 0.5])
def test_a_picometre_and_more_is_a_place(axis: int, value: float) -> None:
    position = [0.0, 0.0, 0.0]
    position[axis] = value
    pose = pose_at((position[0], position[1], position[2]))
    assert list(pose.xyz.values) == position


def test_rounding_in_all_three_is_no_move() -> None:
    pose = pose_at((TINY, -TINY, TINY))
    assert pose.xyz.is_zero() and pose.rpy.is_zero()


@pytest.mark.parametrize("seed", range(5))
def test_a_quaternion_turns_as_its_product_does(seed: int) -> None:
    random = Random(seed)
    w, x, y, z = quat = [random.gauss(0, 1) for _ in range(4)]
    text = " ".join(map(repr, quat))
    robot = build(
        "r.yaml",
        text="model:\n- part: {name: a, link: {}}\n- part: {name: b, link: {}, "
        f"joint: {{type: fixed, parent: a, quat: {text}}}}}\n",
    ).robot
    turned = robot.joints["b_joint"].origin.apply((1.0, 2.0, 3.0))
    # v' = v + 2·u × (u × v + w·v), of a unit quaternion (w, u)
    axis, size = np.array([x, y, z]), np.linalg.norm(quat)
    axis, w = axis / size, float(w / size)
    v = np.array([1.0, 2.0, 3.0])
    assert turned == pytest.approx(v + 2 * np.cross(axis, np.cross(axis, v) + w * v), abs=1e-11)
