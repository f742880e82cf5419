"""`attach`: robots that are put together are what their parts are, and parsers accept them."""

from __future__ import annotations

import pytest
from lxml import etree

import yamaro
from tests.consumers.oracles import CheckUrdf, load_pinocchio, require_module
from tests.robot.written import convert_text

WAFFLE = """<robot name="waffle">
  <material name="light_black"><color rgba="0.4 0.4 0.4 1.0"/></material>
  <material name="blue"><color rgba="0.0 0.0 0.8 1.0"/></material>
  <link name="base_footprint"/>
  <joint name="base_joint" type="fixed">
    <parent link="base_footprint"/><child link="base_link"/><origin xyz="0 0 0.01"/>
  </joint>
  <link name="base_link">
    <inertial>
      <mass value="1.3"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
    <visual><geometry><box size="0.3 0.3 0.1"/></geometry><material name="light_black"/></visual>
  </link>
  <joint name="wheel_left_joint" type="continuous">
    <parent link="base_link"/><child link="wheel_left_link"/>
    <origin xyz="0 0.14 0.02" rpy="-1.57 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <link name="wheel_left_link">
    <inertial>
      <mass value="0.02"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
    <visual><geometry><sphere radius="0.03"/></geometry><material name="blue"/></visual>
  </link>
</robot>
"""
FLEET = """
robot: fleet
model:
- material/name=blue: {color/rgba=0 1 1 1: }
- link/name=floor: {visual: {geometry: {box/size=9 9 0.1: }, material/name=blue: }}
- for i in range(COUNT):
    attach: {path: waffle.urdf, to: floor, prefix: 'robot$(i)_', xyz: $(i) 0 0}
"""


def fleet(count: int) -> str:
    return convert_text(FLEET.replace("COUNT", str(count)), waffle_urdf=WAFFLE)


def test_a_urdf_with_global_materials_twice_is_accepted() -> None:
    urdf = fleet(2)
    found = CheckUrdf(urdf)
    assert found.accepts, found.output
    root = etree.fromstring(urdf.encode())
    colours = {each.get("name"): each[0].get("rgba") for each in root.findall("material")}
    assert colours["blue"] == "0 1 1 1"
    assert colours["light_black"] == "0.4 0.4 0.4 1.0"
    for number in range(2):
        used = root.find(f"link[@name='robot{number}_wheel_left_link']/visual/material")
        assert colours[used.get("name")] == "0.0 0.0 0.8 1.0"


def test_the_same_robot_ten_times_has_ten_times_its_joints_and_mass() -> None:
    one, ten = load_pinocchio(fleet(1)), load_pinocchio(fleet(10))
    assert ten.njoints - 2 == 10 * (one.njoints - 2)
    assert abs(sum(each.mass for each in ten.inertias) - 10 * 1.32) < 1e-9
    data = ten.createData()
    pinocchio = require_module("pinocchio")
    pinocchio.framesForwardKinematics(ten, data, pinocchio.neutral(ten))
    for number in range(10):
        frame = ten.getFrameId(f"robot{number}_wheel_left_link")
        x, y, z = data.oMf[frame].translation
        assert (round(x, 12), round(y, 12), round(z, 12)) == (number, 0.14, 0.03)


NESTED = """
robot: table
model:
- link/name=top:
- attach:
    to: top
    prefix: left_
    body:
    - part: {name: arm}
    - part:
        name: wrist
        joint: {type: continuous, parent: arm, xyz: 0 0 1}
        link: {frame/name=tool0: {xyz: 0 0 0.5}}
    - attach:
        to: tool0
        prefix: hand_
        body:
        - part: {name: palm}
        - part: {name: finger, joint: {type: continuous, parent: palm}}
"""


def test_prefixes_of_nested_robots_add_up_also_in_references() -> None:
    root = etree.fromstring(convert_text(NESTED).encode())
    ends = [(j[0].get("link"), j[1].get("link"), j.get("name")) for j in root.findall("joint")]
    assert ends == [
        ("top", "left_arm_link", "left_arm_link_mount"),
        ("left_arm_link", "left_wrist_link", "left_wrist_joint"),
        ("left_wrist_link", "left_tool0", "left_tool0_joint"),
        ("left_tool0", "left_hand_palm_link", "left_hand_palm_link_mount"),
        ("left_hand_palm_link", "left_hand_finger_link", "left_hand_finger_joint"),
    ]


def test_an_attached_robot_is_mirrored_with_its_mount() -> None:
    body = NESTED.split("model:\n- link/name=top:\n", 1)[1]
    body = "".join(f"    {line}\n" for line in body.splitlines())
    body = body.replace("to: top\n", "to: top\n        xyz: 0 0.3 0\n")
    head = "robot: pair\nmodel:\n- link/name=top:\n- mirror:\n    rename: {left: right}\n"
    urdf = convert_text(f"{head}    body:\n{body}")
    assert CheckUrdf(urdf).accepts
    root = etree.fromstring(urdf.encode())
    mount = root.find("joint[@name='right_arm_link_mount']")
    assert mount.find("origin").get("xyz") == "0 -0.3 0"
    finger = root.find("joint[@name='right_hand_finger_joint']")
    assert finger.find("parent").get("link") == "right_hand_palm_link"


def test_the_same_robot_twice_without_a_prefix_names_both_places_and_the_key() -> None:
    text = FLEET.replace("COUNT", "2").replace(", prefix: 'robot$(i)_'", "")
    with pytest.raises(yamaro.YamaroError) as caught:
        convert_text(text, waffle_urdf=WAFFLE)
    found = [each for each in caught.value.diagnostics if each.code != "duplicate-material"]
    assert {each.code for each in found} == {"duplicate-link", "duplicate-joint"}
    for each in found:
        assert "prefix:" in (each.hint or "")
        assert any("first defined" in note or "earlier" in note for note in each.notes)
