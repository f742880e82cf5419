"""Principal axes against numpy, and quaternions against scipy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.later import Later
from yamaro.model.inertia import principal_axes
from yamaro.model.pose import quaternion_from_rotation, rotation_from_quaternion

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation as Judge
else:
    Judge = Later("scipy.spatial.transform", "Rotation")

moments = st.floats(0, 1e3)
parts = st.floats(-1, 1)


def rows(matrix):
    return tuple(tuple(float(part) for part in row) for row in matrix)


@settings(max_examples=examples(300))
@given(moments, moments, moments, parts, parts, parts, parts)
def test_moments_and_axes_make_the_matrix_again(a, b, c, w, x, y, z):
    turn = np.array(rotation_from_quaternion(x, y, z, w))
    matrix = turn @ np.diag([a, b, c]) @ turn.T
    matrix = (matrix + matrix.T) / 2
    found, axes = principal_axes(rows(matrix))
    size = max(a, b, c)
    again = np.array(axes) @ np.diag(found) @ np.array(axes).T
    assert np.abs(again - matrix).max() <= 4e-15 * size
    assert np.abs(np.sort(found) - np.linalg.eigvalsh(matrix)).max() <= 4e-15 * size
    assert np.abs(np.array(axes) @ np.array(axes).T - np.eye(3)).max() <= 4e-15
    assert np.linalg.det(np.array(axes)) == pytest.approx(1, abs=1e-14)


@given(st.lists(st.floats(-1e6, 1e6), min_size=6, max_size=6))
def test_moments_are_the_eigenvalues_of_any_symmetric_matrix(values):
    xx, xy, xz, yy, yz, zz = values
    matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    found, _ = principal_axes(rows(matrix))
    scale = max(1e-300, float(np.abs(matrix).max()))
    assert np.allclose(sorted(found), np.linalg.eigvalsh(matrix), rtol=0, atol=1e-12 * scale)


def test_a_diagonal_matrix_is_left_alone():
    found, axes = principal_axes(((3.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 2.0)))
    assert found == (3.0, 1.0, 2.0)
    assert axes == ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def test_axes_stay_near_their_own():
    found, axes = principal_axes(((2.0, 1e-3, 0.0), (1e-3, 1.0, 1e-3), (0.0, 1e-3, 3.0)))
    assert found == pytest.approx((2.0, 1.0, 3.0), abs=1e-5)
    assert np.abs(np.array(axes) - np.eye(3)).max() < 2e-3


@settings(max_examples=examples(300))
@given(parts, parts, parts, parts)
def test_quaternions_are_those_of_scipy(w, x, y, z):
    rotation = rotation_from_quaternion(x, y, z, w)
    found = np.array(quaternion_from_rotation(rotation))
    x, y, z, w = Judge.from_matrix(rotation).as_quat()
    assert found[0] >= 0
    judged = np.array([w, x, y, z])
    assert min(np.abs(found - judged).max(), np.abs(found + judged).max()) < 1e-14


def test_half_turns_have_quaternions():
    assert quaternion_from_rotation(((1.0, 0, 0), (0, -1.0, 0), (0, 0, -1.0))) == (0, 1, 0, 0)
    assert quaternion_from_rotation(((-1.0, 0, 0), (0, 1.0, 0), (0, 0, -1.0))) == (0, 0, 1, 0)
    assert quaternion_from_rotation(((-1.0, 0, 0), (0, -1.0, 0), (0, 0, 1.0))) == (0, 0, 0, 1)
