"""Positions as people name them: by a state, a joint or its part, with or without a unit."""

from __future__ import annotations

import re
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Any

import pytest

import yamaro
from yamaro.model import Pose
from yamaro.model.positions import joint_named, link_named, read_positions

ARM = """
robot: arm
model:
- part: {name: base}
- part:
    name: j2
    joint:
      {type: revolute, parent: base, axis: y,
       limit: {lower: -90deg, upper: 90deg, effort: 1, velocity: 1}}
- part:
    name: j3
    joint:
      {type: prismatic, parent: j2, axis: z, xyz: 0 0 1,
       limit: {lower: 0, upper: 9cm, effort: 1, velocity: 1}}
- part:
    name: j4
    joint:
      {type: prismatic, parent: base, axis: z, mimic: j3,
       limit: {lower: 0, upper: 9cm, effort: 1, velocity: 1}}
- part: {name: plane, joint: {type: planar, parent: base, axis: z}}
- part: {name: cloud, joint: {type: floating, parent: base}}
- part: {name: tcp, joint: {type: fixed, parent: j3}}
states:
  home: {j2: -45deg, j3: 10mm}
"""


def arm(text: str = ARM) -> yamaro.Robot:
    return yamaro.build("arm.yaml", text=text).robot


def test_a_pose_is_asked_for_in_a_state_by_its_name_or_as_it_is() -> None:
    robot = arm()
    x, z = -1.01 * sin(pi / 4), 1.01 * cos(pi / 4)
    same: list[Any] = [
        "home",
        robot.states["home"],
        {"j2": "-45deg", "j3": "10mm"},
        {"j2_joint": -pi / 4, "j3": 0.01},
        {"j2": "-0.125rev", "j3_joint": "1 cm"},
        {"j2": str(-pi / 4), "j3": "0.01"},
    ]
    for positions in same:
        assert robot.pose("tcp_link", positions).position == pytest.approx((x, 0, z))
        assert robot.pose("tcp", positions).position == pytest.approx((x, 0, z))
        assert robot.poses(positions)["tcp_link"].position == pytest.approx((x, 0, z))


def test_a_center_of_mass_is_asked_for_in_a_state() -> None:
    robot = arm(
        ARM.replace("{name: tcp, ", "{name: tcp, link: {mass: 2, geometry: sphere, scale: 1}, ")
    )
    assert robot.center_of_mass("home")[0] == pytest.approx(-1.01 * sin(pi / 4))


def test_positions_of_planar_joints_have_lengths_and_an_angle() -> None:
    read = {"plane_joint": (0.1, 0.02, radians(90))}
    given: list[Any] = [("10cm", 0.02, "90deg"), "100mm 2cm 90deg", "0.1, 0.02, 0.25rev"]
    for position in given:
        assert read_positions(arm(), {"plane": position}) == {
            "plane_joint": pytest.approx(read["plane_joint"])
        }
    pose = Pose(position=(1, 2, 3))
    assert read_positions(arm(), {"cloud": pose}) == {"cloud_joint": pose}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("hoem", "the robot has no state 'hoem'; did you mean 'home'?"),
        ("elsewhere", "the robot has no state 'elsewhere'; its states are home"),
        ({"j2_jont": 1}, "the robot has no joint 'j2_jont'; did you mean 'j2_joint'?"),
        ({"plain": 1}, "the robot has no joint 'plain'; did you mean 'plane_joint'?"),
        ({"xyz": 1}, "those that move are j2_joint, j3_joint, j4_joint, plane_joint, cloud_joint"),
        ({"j2": "3mm"}, "'3mm'; that is a length, and not an angle"),
        ({"j3": "90deg"}, "'90deg'; that is an angle, and not a length"),
        ({"j3": "1kg"}, "that is a mass, and not a length"),
        ({"j2": "90degrees"}, "'degrees' is not a unit; did you mean 'deg'?"),
        ({"j2": "up"}, "give its position as one number, in radians or as 90deg, not 'up'"),
        ({"j2": None}, "give its position as one number, in radians or as 90deg, not 'None'"),
        ({"j2": [1, 2]}, "give its position as one number, in radians or as 90deg, not '[1, 2]'"),
        ({"j2": 1, "j2_joint": 2}, "two positions are given for the joint 'j2_joint'"),
        ({"tcp": 1}, "the joint 'tcp_joint' is fixed, and has no position"),
        ({"j4": 1}, "the joint 'j4_joint' mimics 'j3_joint': give the position of that one"),
        ({"plane": 1}, "give its position as x, y and an angle"),
        ({"plane": (1, 2, "3mm")}, "that is a length, and not an angle"),
        ({"cloud": 1}, "the joint 'cloud_joint' is floating: give its position as a Pose"),
    ],
)
def test_a_position_that_cannot_be_is_refused(given: Any, said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        arm().pose("tcp", given)


def test_a_robot_without_states_says_so() -> None:
    with pytest.raises(ValueError, match="the robot has no state 'home'; it has no states"):
        yamaro.Robot.from_xml('<robot name="r"><link name="a"/></robot>').pose("a", "home")


def test_an_own_name_counts_before_that_of_a_part() -> None:
    robot = yamaro.Robot.from_xml(
        '<robot name="r"><link name="a"/><link name="b"/><link name="c"/>'
        '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>'
        '<joint name="j_joint" type="continuous"><parent link="b"/><child link="c"/></joint>'
        "</robot>"
    )
    assert read_positions(robot, {"j": 1.0}) == {"j": 1.0}
    assert read_positions(robot, {"j_joint": 1.0}) == {"j_joint": 1.0}


def test_parts_are_known_by_their_names_where_naming_says_others(tmp_path: Path) -> None:
    (tmp_path / "hand.yaml").write_text(
        "robot: hand\nnaming: {joint: q_*_x, link: k_*}\nmodel:\n- part: {name: palm}\n"
        "- part: {name: finger, joint: {type: continuous, parent: palm}}\n",
        encoding="utf-8",
    )
    (tmp_path / "arm.yaml").write_text(
        "robot: arm\nnaming: {joint: j_*, link: '*'}\nmodel:\n- part: {name: base}\n"
        "- part: {name: elbow, joint: {type: continuous, parent: base}}\n"
        "- attach: {path: hand.yaml, to: elbow, prefix: left_}\n",
        encoding="utf-8",
    )
    for policy in (None, yamaro.Policy("safe")):
        robot = yamaro.build(tmp_path / "arm.yaml", policy=policy).robot
        assert joint_named(robot, "elbow").name == "j_elbow"
        assert link_named(robot, "elbow").name == "elbow"
        assert joint_named(robot, "left_finger").name == "left_q_finger_x"
        assert link_named(robot, "left_finger").name == "left_k_finger"
        with pytest.raises(ValueError, match="did you mean 'j_elbow'"):
            joint_named(robot, "elbw")
