"""What `mirror` does with names, meshes, other XML and the statements around it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from lxml import etree

import yamaro
from tests.robot.written import convert_text
from yamaro.robot.naming import WordRenaming
from yamaro.sandbox import jail

HEAD = "robot: pair\nmodel:\n- link/name=base:\n- mirror:\n    rename: {left: right}\n"
ARM = (
    "{name: left_arm, joint: {type: revolute, parent: base, axis: x, xyz: 0 1 0, "
    "limit: {lower: -1, upper: 2, effort: 1, velocity: 1}}}"
)


def mirrored(body: str, keys: str = "", after: str = "") -> Any:
    """Return the root of a robot with these lines in the body of a `mirror`."""
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    return etree.fromstring(convert_text(f"{HEAD}{keys}    body:\n{lines}{after}").encode())


@pytest.mark.parametrize(
    ("name", "renamed"),
    [
        ("left_leg", "right_leg"),
        ("leg_left", "leg_right"),
        ("LeftLeg", "RightLeg"),
        ("legLeft", "legRight"),
        ("LEFT_LEG", "RIGHT_LEG"),
        ("left2", "right2"),
        ("left", "right"),
        ("left_left", "right_right"),
        ("leftover", "leftover"),
        ("cleft", "cleft"),
        ("right_leg", "right_leg"),
        ("camera/left/eye", "camera/right/eye"),
    ],
)
def test_whole_words_are_renamed_in_their_case(name: str, renamed: str) -> None:
    assert WordRenaming({"left": "right"}).apply(name) == renamed


def test_words_can_be_swapped() -> None:
    swap = WordRenaming({"left": "right", "right": "left"})
    assert swap.apply("left_to_right") == "right_to_left"
    assert swap.apply(swap.apply("LeftOfRight_left")) == "LeftOfRight_left"


MESH = """- part:
    name: left_arm
    joint: {type: fixed, parent: base}
    link: {visual: {geometry: l_arm.stl, scale: 0.001 0.001 0.001}}
"""


@pytest.mark.parametrize(
    ("meshes", "file", "scale"),
    [
        ("scale", "l_arm.stl", [0.001, -0.001, 0.001]),
        ("same", "l_arm.stl", [0.001] * 3),
        ("{l_arm.stl: r_arm.stl}", "r_arm.stl", [0.001] * 3),
    ],
)
def test_meshes_are_scaled_kept_or_replaced(meshes: str, file: str, scale: list[float]) -> None:
    root = mirrored(MESH, f"    meshes: {meshes}\n")
    mesh = root.find("link[@name='right_arm_link']/visual/geometry/mesh")
    assert mesh.get("filename").endswith(file)
    assert [float(each) for each in mesh.get("scale").split()] == scale


OTHER_XML = f"""- part: {ARM}
- transmission/name=left_drive:
    type: simple
    joint/name=left_arm_joint: {{hardwareInterface: effort}}
    actuator/name=left_motor: {{mechanicalReduction: 50}}
- gazebo/reference=left_arm_link: {{mu1: 0.8}}
- gazebo:
    plugin/name=clock, filename=libclock.so:
- <ros2_control/name=left_system,type=system>:
    joint/name=left_arm_joint:
      command_interface/name=position:
      - param/name=min: -1
      - param/name=max: 2
      state_interface/name=position:
        param/name=initial_value: 0.5
"""


def test_what_refers_to_the_body_is_mirrored_and_what_does_not_is_not_repeated() -> None:
    root = mirrored(OTHER_XML)
    drive = root.find("transmission[@name='right_drive']")
    assert drive.find("joint").get("name") == "right_arm_joint"
    assert drive.find("actuator").get("name") == "right_motor"
    assert root.find("gazebo[@reference='right_arm_link']/mu1").text == "0.8"
    assert len(root.findall("gazebo/plugin")) == 1


def test_ranges_of_a_reversed_joint_are_swapped_in_ros2_control_too() -> None:
    root = mirrored(OTHER_XML)
    limit = root.find("joint[@name='right_arm_joint']/limit")
    assert (limit.get("lower"), limit.get("upper")) == ("-2", "1")
    joint = root.find("ros2_control[@name='right_system']/joint[@name='right_arm_joint']")
    params = {each.get("name"): each.text for each in joint.iter("param")}
    assert params == {"min": "-2", "max": "1", "initial_value": "-0.5"}


def test_calibration_and_soft_limits_of_a_reversed_joint() -> None:
    more = (
        "axis: x, calibration: {rising: 0.3}, "
        "safety_controller: {soft_lower_limit: -0.5, soft_upper_limit: 1, k_velocity: 9}"
    )
    arm = ARM.replace("axis: x", more)
    joint = mirrored(f"- part: {arm}").find("joint[@name='right_arm_joint']")
    assert joint.find("calibration").get("rising") == "-0.3"
    safety = joint.find("safety_controller")
    assert float(safety.get("soft_lower_limit")) == -1
    assert float(safety.get("soft_upper_limit")) == 0.5


def test_the_plane_of_another_link_over_a_rigid_chain() -> None:
    text = (
        "robot: pair\nmodel:\n- link/name=base:\n"
        "- part: {name: plate, joint: {type: fixed, parent: base, xyz: 0 0.3 0}}\n"
        "- part: {name: mount, joint: {type: fixed, parent: plate, xyz: 0 0.2 1}}\n"
        "- mirror:\n    rename: {left: right}\n    of: base\n    body:\n"
        "    - part: {name: left_arm, joint: {type: fixed, parent: mount, xyz: 0 0.1 0}}\n"
    )
    root = etree.fromstring(convert_text(text).encode())
    origin = root.find("joint[@name='right_arm_joint']/origin")
    # In base the arm is at y = 0.6, so its image is at −0.6: −1.1 from the mount at 0.5.
    x, y, z = map(float, origin.get("xyz").split())
    assert (x, round(y, 12), z) == (0, -1.1, 0)


def test_the_plane_of_another_link_where_the_parent_has_an_image_elsewhere() -> None:
    text = (
        "robot: pair\nmodel:\n- link/name=base:\n"
        "- part: {name: left_mount, joint: {type: fixed, parent: base, xyz: 0 0.3 0}}\n"
        "- part: {name: right_mount, joint: {type: fixed, parent: base, xyz: 0 -0.2 0}}\n"
        "- mirror:\n    rename: {left: right}\n    of: base\n    body:\n"
        "    - part: {name: left_arm, joint: {type: fixed, parent: left_mount, xyz: 0 0.1 0}}\n"
    )
    root = etree.fromstring(convert_text(text).encode())
    joint = root.find("joint[@name='right_arm_joint']")
    assert joint.find("parent").get("link") == "right_mount_link"
    # In base the arm is at y = 0.4, so its image is at −0.4: −0.2 from the other mount.
    assert round(float(joint.find("origin").get("xyz").split()[1]), 12) == -0.2


def test_parts_of_mirrored_names_can_be_parents() -> None:
    tip = "- part: {name: tip, joint: {type: fixed, parent: right_arm}}\n"
    root = mirrored(f"- part: {ARM}", after=tip)
    assert root.find("joint[@name='tip_joint']/parent").get("link") == "right_arm_link"


@pytest.mark.parametrize(
    "wrapped",
    [
        f"- for i in range(1):\n    part: {ARM}",
        f"- if 1 < 2:\n    part: {ARM}",
        f"- functions:\n    Arm():\n      part: {ARM}\n- Arm:",
        f"- attach: {{to: base, xyz: 0 0 0, body: {{part: {{name: left_plate}}}}}}\n- part: {ARM}",
    ],
    ids=["for", "if", "function", "attach"],
)
def test_statements_in_the_body_are_transparent(wrapped: str) -> None:
    root = mirrored(wrapped)
    origin = root.find("joint[@name='right_arm_joint']/origin")
    assert origin.get("xyz") == "0 -1 0"


def test_a_mirror_in_a_function_is_made_for_each_call() -> None:
    text = (
        "robot: pair\nfunctions:\n  Pair(name):\n    mirror:\n      rename: {left: right}\n"
        "      body:\n        part: {name: 'left_$(name)', joint: {type: fixed, parent: base}}\n"
        "model:\n- link/name=base:\n- Pair: arm\n- Pair: leg\n"
    )
    root = etree.fromstring(convert_text(text).encode())
    names = [each.get("name") for each in root.findall("link")]
    assert names == [
        "base",
        *("left_arm_link", "right_arm_link", "left_leg_link", "right_leg_link"),
    ]


def test_safe_mode_gives_the_same() -> None:
    body = "".join(f"    {line}\n" for line in OTHER_XML.splitlines())
    text = f"{HEAD}    body:\n{body}"
    loader = yamaro.MemoryLoader({"/robots/robot.yaml": text})
    safe = yamaro.load("/robots/robot.yaml", loader=loader, policy=yamaro.Policy("safe")).convert()
    assert safe == convert_text(text)


STATES = """
robot: pair
model:
- link/name=base:
- mirror:
    rename: {left: right}
    body:
      attach: {path: hand.yaml, to: base, xyz: 0 1 0, prefix: left_}
control: {name: c, plugin: mock, state: open}
"""
HAND = """
robot: hand
model:
- part: {name: palm}
- part: {name: finger, joint: {type: continuous, parent: palm, axis: x, actuator: {}}}
states: {open: {finger: 0.5}}
"""


def test_states_of_a_reversed_joint_are_negated() -> None:
    root = etree.fromstring(convert_text(STATES, hand_yaml=HAND).encode())
    values = {
        joint.get("name"): joint.findtext(".//param[@name='initial_value']")
        for joint in root.iterfind("ros2_control/joint")
    }
    assert values == {"left_finger_joint": "0.5", "right_finger_joint": "-0.5"}


def test_a_sensor_whose_name_stays_is_an_error() -> None:
    arm = (
        "- part:\n    name: left_arm\n    joint: {type: fixed, parent: base}\n    link:\n"
        "      sensor/name=left_imu: {type: imu, xyz: 0 0.1 0}\n"
        "      SENSOR: {type: imu, frame: left_imu}\n"
    )
    assert mirrored(arm.replace("SENSOR", "sensor/name=left_eye")) is not None
    with pytest.raises(yamaro.YamaroError) as caught:
        mirrored(arm.replace("SENSOR", "sensor/name=eye"))
    assert [each.code for each in caught.value.diagnostics] == ["mirror-name"]


@pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")
def test_a_jail_gives_the_same(tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(STATES)
    (tmp_path / "hand.yaml").write_text(HAND)
    confined = yamaro.build(tmp_path / "robot.yaml", policy=yamaro.Policy("jail")).xml()
    assert confined == yamaro.build(tmp_path / "robot.yaml").xml()
