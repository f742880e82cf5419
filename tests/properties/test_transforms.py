"""Transforms obey the axioms of a group, and agree with scipy's Rotation."""

from __future__ import annotations

from math import pi

import numpy
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from yamaro.robot.transforms import (
    IDENTITY,
    ZERO,
    Transform,
    compose,
    multiply,
    rotation_from_rpy,
    rpy_from_rotation,
    transform_from_pose,
)

angles = st.one_of(
    st.floats(-2 * pi, 2 * pi),
    st.sampled_from([0.0, pi / 2, -pi / 2, pi, -pi, pi / 2 + 1e-9, pi / 2 - 1e-13, 1e-15]),
)
rpys = st.tuples(angles, angles, angles)
lengths = st.floats(-10, 10)
vectors = st.tuples(lengths, lengths, lengths)
transforms = st.builds(transform_from_pose, vectors, rpys)

NEUTRAL = Transform(IDENTITY, ZERO)


def assert_same(first, second, *, tolerance=1e-12):
    numpy.testing.assert_allclose(first.rotation, second.rotation, rtol=0, atol=tolerance)
    numpy.testing.assert_allclose(
        first.translation, second.translation, rtol=0, atol=100 * tolerance
    )


@given(rpys)
def test_the_rotation_of_rpy_is_scipys_extrinsic_xyz(rpy):
    expected = Rotation.from_euler("xyz", rpy).as_matrix()
    numpy.testing.assert_allclose(rotation_from_rpy(*rpy), expected, rtol=0, atol=1e-14)


@given(rpys)
def test_rpy_gives_its_rotation_back(rpy):
    rotation = rotation_from_rpy(*rpy)
    roll, pitch, yaw = rpy_from_rotation(rotation)
    assert abs(pitch) <= pi / 2
    assert abs(roll) <= pi
    assert abs(yaw) <= pi
    again = rotation_from_rpy(roll, pitch, yaw)
    numpy.testing.assert_allclose(again, rotation, rtol=0, atol=2e-12)


@given(st.tuples(st.floats(-pi, pi), st.floats(-1.5, 1.5), st.floats(-pi, pi)))
def test_angles_off_the_gimbal_come_back(rpy):
    found = rpy_from_rotation(rotation_from_rpy(*rpy))
    for angle, expected in zip(found, rpy, strict=True):
        # π and -π are the same angle.
        assert abs((angle - expected + pi) % (2 * pi) - pi) < 1e-12


@given(rpys, rpys)
def test_rotations_compose_as_scipys(first, second):
    expected = (Rotation.from_euler("xyz", first) * Rotation.from_euler("xyz", second)).as_matrix()
    product = multiply(rotation_from_rpy(*first), rotation_from_rpy(*second))
    again = rotation_from_rpy(*rpy_from_rotation(product))
    numpy.testing.assert_allclose(product, expected, rtol=0, atol=1e-14)
    numpy.testing.assert_allclose(again, expected, rtol=0, atol=2e-12)


@given(transforms, transforms, transforms)
def test_composition_is_associative(T_a_b, T_b_c, T_c_d):
    assert_same(compose(compose(T_a_b, T_b_c), T_c_d), compose(T_a_b, compose(T_b_c, T_c_d)))


@given(transforms)
def test_the_identity_is_neutral(T_a_b):
    assert_same(compose(T_a_b, NEUTRAL), T_a_b)
    assert_same(compose(NEUTRAL, T_a_b), T_a_b)


@given(transforms)
def test_the_inverse_undoes(T_a_b):
    assert_same(compose(T_a_b, T_a_b.inverse()), NEUTRAL)
    assert_same(compose(T_a_b.inverse(), T_a_b), NEUTRAL)


@given(transforms, transforms, vectors)
def test_a_composed_transform_applies_one_after_the_other(T_a_b, T_b_c, point):
    expected = T_a_b.apply(T_b_c.apply(point))
    assert compose(T_a_b, T_b_c).apply(point) == pytest.approx(expected, abs=1e-10)


@given(vectors, rpys, vectors)
def test_the_pivot_lands_on_xyz(xyz, rpy, pivot):
    found = transform_from_pose(xyz, rpy, pivot=pivot).apply(pivot)
    assert found == pytest.approx(xyz, abs=1e-12)
