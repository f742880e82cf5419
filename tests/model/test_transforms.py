"""Rotations against values known by hand."""

from __future__ import annotations

from math import cos, pi, sin

import pytest

from yamaro.model.pose import (
    multiply,
    rotate,
    rotation_from_rpy,
    rpy_from_rotation,
)

QUARTER = pi / 2


@pytest.mark.parametrize(
    ("rpy", "vector", "turned"),
    [
        ((QUARTER, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, QUARTER, 0), (0, 0, 1), (1, 0, 0)),
        ((0, 0, QUARTER), (1, 0, 0), (0, 1, 0)),
        ((QUARTER, 0, QUARTER), (0, 0, 1), (1, 0, 0)),  # roll to -y, then yaw to x
        ((0, QUARTER, QUARTER), (1, 0, 0), (0, 0, -1)),  # pitch to -z, which yaw leaves
    ],
)
def test_rpy_turns_about_fixed_axes_roll_first(rpy, vector, turned):
    assert rotate(rotation_from_rpy(*rpy), vector) == pytest.approx(turned, abs=1e-15)


def test_zero_angles_give_exactly_the_identity():
    identity = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    assert rotation_from_rpy(0.0, 0.0, 0.0) == identity
    assert rpy_from_rotation(identity) == (0.0, 0.0, 0.0)


def test_the_matrix_of_the_textbook():
    # Craig, Introduction to Robotics, equation 2.64.
    g, b, a = 0.3, -0.7, 1.9
    expected = (
        (
            cos(a) * cos(b),
            cos(a) * sin(b) * sin(g) - sin(a) * cos(g),
            cos(a) * sin(b) * cos(g) + sin(a) * sin(g),
        ),
        (
            sin(a) * cos(b),
            sin(a) * sin(b) * sin(g) + cos(a) * cos(g),
            sin(a) * sin(b) * cos(g) - cos(a) * sin(g),
        ),
        (-sin(b), cos(b) * sin(g), cos(b) * cos(g)),
    )
    for row, expected_row in zip(rotation_from_rpy(g, b, a), expected, strict=True):
        assert row == pytest.approx(expected_row, abs=1e-15)


@pytest.mark.parametrize("pitch", [QUARTER, -QUARTER])
@pytest.mark.parametrize(("roll", "yaw"), [(0.0, 0.0), (0.4, 0.0), (0.4, 0.9), (-2.0, 3.0)])
def test_at_gimbal_lock_the_yaw_is_zero_and_the_rotation_is_kept(roll, pitch, yaw):
    rotation = rotation_from_rpy(roll, pitch, yaw)
    angles = rpy_from_rotation(rotation)
    assert angles[1] == pytest.approx(pitch, abs=1e-12)
    assert angles[2] == 0.0
    for row, expected in zip(rotation_from_rpy(*angles), rotation, strict=True):
        assert row == pytest.approx(expected, abs=1e-12)


def test_at_gimbal_lock_only_the_difference_of_roll_and_yaw_counts():
    # Rz(y)·Ry(π/2)·Rx(r) depends on r − y; with −π/2 on r + y.
    up = rpy_from_rotation(rotation_from_rpy(0.9, QUARTER, 0.4))
    down = rpy_from_rotation(rotation_from_rpy(0.9, -QUARTER, 0.4))
    assert up[0] == pytest.approx(0.5, abs=1e-12)
    assert down[0] == pytest.approx(1.3, abs=1e-12)


def test_two_quarter_turns_compose_to_a_half_turn():
    half = multiply(rotation_from_rpy(0, 0, QUARTER), rotation_from_rpy(0, 0, QUARTER))
    assert rpy_from_rotation(half) == pytest.approx((0, 0, pi), abs=1e-15)


def test_composing_rotations_is_not_adding_angles():
    first, second = (QUARTER, 0.0, 0.0), (0.0, 0.0, QUARTER)
    composed = multiply(rotation_from_rpy(*first), rotation_from_rpy(*second))
    # Rx(90°)·Rz(90°) takes x to z and y to -x.
    assert rotate(composed, (1, 0, 0)) == pytest.approx((0, 0, 1), abs=1e-15)
    assert rotate(composed, (0, 1, 0)) == pytest.approx((-1, 0, 0), abs=1e-15)
