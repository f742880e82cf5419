"""Transforms obey the axioms of a group, and agree with scipy's Rotation."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy
from hypothesis import given
from hypothesis import strategies as st

from tests.later import Later
from tests.robot.part_builder import lower_text
from yamaro.model.pose import (
    multiply,
    rotation_from_rpy,
    rpy_from_rotation,
)
from yamaro.robot.pose import Pose, compose_poses
from yamaro.source import Source, Span
from yamaro.xml.values import Numbers

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation
else:
    Rotation = Later("scipy.spatial.transform", "Rotation")

angles = st.one_of(
    st.floats(-2 * pi, 2 * pi),
    st.sampled_from([0.0, pi / 2, -pi / 2, pi, -pi, pi / 2 + 1e-9, pi / 2 - 1e-13, 1e-15]),
)
rpys = st.tuples(angles, angles, angles)
lengths = st.floats(-10, 10)
vectors = st.tuples(lengths, lengths, lengths)


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


# --- poses: what a part's link and sections come out as ---------------------------------------

places = st.fixed_dictionaries({}, optional={"xyz": vectors, "rpy": rpys, "pivot": vectors})


def matrix_of(place):
    """Return the 4×4 matrix of xyz, rpy and pivot, by scipy."""
    turn = Rotation.from_euler("xyz", place.get("rpy", (0, 0, 0))).as_matrix()
    matrix = numpy.eye(4)
    matrix[:3, :3] = turn
    matrix[:3, 3] = numpy.array(place.get("xyz", (0, 0, 0))) - turn @ place.get("pivot", (0, 0, 0))
    return matrix


def written_matrix(link, section):
    """Return the 4×4 matrix of the origin that a section comes out with, and its attributes."""

    def keys(place):
        return "".join(f"{key}: {' '.join(map(repr, value))}, " for key, value in place.items())

    body = f"geometry: box, scale: 1 1 1, {keys(link)}collision: {{{keys(section)}}}"
    origin = lower_text(f"part: {{name: a, link: {{{body}}}}}").find("link/collision/origin")
    texts = {key: str(value) for key, value in origin.attributes.items()}
    numbers = {key: tuple(map(float, text.split())) for key, text in texts.items()}
    return matrix_of(numbers), origin.attributes


@given(places, places)
def test_a_section_stands_in_its_link_as_scipy_has_it(link, section):
    found, _ = written_matrix(link, section)
    numpy.testing.assert_allclose(found, matrix_of(link) @ matrix_of(section), rtol=0, atol=1e-9)


@given(places)
def test_no_pose_is_neutral_on_both_sides(place):
    assert written_matrix(place, {})[1] == written_matrix({}, place)[1]


@given(vectors, rpys)
def test_the_inverse_undoes(xyz, rpy):
    back = numpy.linalg.inv(matrix_of({"xyz": xyz, "rpy": rpy}))
    inverse = {
        "xyz": tuple(back[:3, 3].tolist()),
        "rpy": rpy_from_rotation(back[:3, :3].tolist()),
    }
    found, _ = written_matrix({"xyz": xyz, "rpy": rpy}, inverse)
    numpy.testing.assert_allclose(found, numpy.eye(4), rtol=0, atol=1e-9)


def pose_of(xyz, rpy):
    span = Span(Source("x", name="x"), 0, 1)
    position, angles = (Numbers(tuple(map(repr, values)), values) for values in (xyz, rpy))
    return Pose(position, angles, span, None, rotation_from_rpy(*rpy))


poses = st.builds(pose_of, vectors, rpys)


@given(poses, poses, poses)
def test_composition_is_associative(first, second, third):
    left = compose_poses(compose_poses(first, second), third)
    right = compose_poses(first, compose_poses(second, third))
    assert left.rotation is not None
    assert right.rotation is not None
    numpy.testing.assert_allclose(left.rotation, right.rotation, rtol=0, atol=1e-12)
    numpy.testing.assert_allclose(left.xyz.values, right.xyz.values, rtol=0, atol=1e-10)


@given(vectors, rpys, vectors)
def test_the_pivot_lands_on_xyz(xyz, rpy, pivot):
    found, _ = written_matrix({"xyz": xyz, "rpy": rpy, "pivot": pivot}, {})
    numpy.testing.assert_allclose((found @ [*pivot, 1])[:3], xyz, rtol=0, atol=1e-9)
