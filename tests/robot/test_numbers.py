"""Numbers of parts: what is read in lowering is handed on as numbers, not as text."""

from __future__ import annotations

from copy import copy

import pytest

import yamaro
from yamaro.model import values
from yamaro.xml.values import Numbers, format_value

ROBOT = """\
robot: r
base: fixed
model:
  - link/name=base:
  - part:
      name: arm
      joint:
        type: revolute
        parent: base
        xyz: 0.10 0 $(1/3)
        rpy: 0 0 30deg
        axis: 0 0.6 0.8
        limit: {lower: -1.50, upper: $(pi / 2), effort: 10 N*m, velocity: 2}
        dynamics: {damping: 0.7}
      link:
        mass: 1.2
        geometry: cylinder
        scale: 0.1 $(0.1 + 0.2)
        visual: {color: 0.8 0.1 0.1 1, xyz: 0 0 0.05}
        collision:
"""


def robot_in(folder, **options):
    file = folder / "r.yaml"
    file.write_text(ROBOT, encoding="utf-8")
    return yamaro.build(file, **options).robot


@pytest.mark.parametrize("format", ["urdf", "mjcf", "sdf", "usd"])
def test_no_number_that_lowering_wrote_is_read_from_text(format, tmp_path, monkeypatch):
    read = []
    read_numbers = values.read_numbers

    def note(text):
        read.append(text)
        return read_numbers(text)

    monkeypatch.setattr(values, "read_numbers", note)
    robot = robot_in(tmp_path, target=format)
    assert robot.joints["arm_joint"].limit.upper == 1.5707963267949
    assert robot.links["arm_link"].visuals[0].shape.length == 0.3
    assert read == []


def test_the_spelling_of_a_number_stays(tmp_path):
    joint = robot_in(tmp_path).joints["arm_joint"]
    assert joint.limit.written("lower") == "-1.50"
    assert joint.limit.lower == -1.5
    assert joint.origin.element.attributes["xyz"] == "0.10 0 0.333333333333333"


def test_numbers_are_those_of_their_text():
    third = Numbers.of(1 / 3, 0.5)
    assert third.values == (1 / 3, 0.5)
    assert third.written == (0.333333333333333, 0.5)
    assert format_value(third) == str(third) == third == "0.333333333333333 0.5"
    assert [each.written for each in third.one_by_one()] == [(0.333333333333333,), (0.5,)]
    assert Numbers.exactly(1 / 3).written == (1 / 3,)
    assert copy(third) == third
    assert hash(third) == hash(third.text)
    assert third != Numbers.of(1 / 3)
