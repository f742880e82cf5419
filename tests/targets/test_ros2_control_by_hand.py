"""Blocks for ros2_control that people wrote by hand, made again from `actuator` and `control`."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from lxml import etree

import yamaro
from tests.targets.ros2_control_rules import faults_of

CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
pytestmark = pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")


class Example(NamedTuple):
    """A robot, what says in YAML how it is driven, and in what the two blocks differ."""

    path: str
    commands: dict[str, str]
    sensors: dict[str, dict[str, str]]
    sections: str
    only_by_hand: dict[str, str]
    only_made: dict[str, str]


UR = "expected/UniversalRobots+Universal_Robots_ROS2_Description/urdf/"
PANDA = "src/AndrejOrsula+panda_ign_moveit2/panda_description/urdf/panda.urdf"
TURTLE = (
    "expected/ROBOTIS-GIT+turtlebot3_manipulation/turtlebot3_manipulation_description/urdf/"
    "turtlebot3_manipulation.urdf.xacro.urdf"
)
VELOCITY_STARTS = "a state in YAML holds positions; a joint starts at rest"
LIMITS = "by hand there are no limits, although the URDF has them"
EXAMPLES = {
    "UR5e": Example(
        f"{UR}ur_mocked.urdf.xacro#ur_type=ur5e.urdf",
        {"*": "position velocity"},
        {"wrist_3_joint": {"tcp_fts_sensor": "force_torque"}},
        """
control:
  name: ur
  plugin: mock_components/GenericSystem
  params: {mock_sensor_commands: 'False', state_following_offset: '0.0', calculate_dynamics: 'true'}
  state: start
states:
  start:
    {shoulder_pan_joint: 0.0, shoulder_lift_joint: -1.57, elbow_joint: 0.0, wrist_1_joint: -1.57,
     wrist_2_joint: 0.0, wrist_3_joint: 0.0}
""",
        {
            "joint state_interface velocity initial_value": VELOCITY_STARTS,
            "joint state_interface effort": "effort is a state of joints that are driven by effort",
            "joint state_interface effort initial_value": VELOCITY_STARTS,
            "sensor tcp_pose": "a pose is not a sensor in YAML",
        },
        {
            "joint command_interface position min": LIMITS,
            "joint command_interface position max": LIMITS,
            "joint command_interface velocity min": LIMITS,
            "joint command_interface velocity max": LIMITS,
        },
    ),
    "Panda": Example(
        PANDA,
        {"*": "effort"},
        {},
        """
control:
- name: panda_arm_system
  plugin: ign_ros2_control/IgnitionSystem
  joints: panda_joint?
  state: start
- {name: panda_gripper_system, plugin: ign_ros2_control/IgnitionSystem, state: start}
states:
  start:
    {panda_joint1: 0.0, panda_joint2: -0.7853981633974483, panda_joint3: 0.0,
     panda_joint4: -2.356194490192345, panda_joint5: 0.0, panda_joint6: 1.5707963267948966,
     panda_joint7: 0.7853981633974483, panda_finger_joint1: 0.0, panda_finger_joint2: 0.0}
""",
        {"joint param initial_position": "an older spelling of initial_value"},
        {
            "joint state_interface position initial_value": "the newer spelling",
            "joint command_interface effort min": LIMITS,
            "joint command_interface effort max": LIMITS,
        },
    ),
    "TurtleBot3 with OpenManipulator": Example(
        TURTLE,
        {"*": "position", "wheel_*": "velocity"},
        {"imu_link": {"imu": "imu"}},
        """
control:
  name: TurtleBot3ManipulationSystem
  plugin: turtlebot3_manipulation_hardware/TurtleBot3ManipulationSystemHardware
  params:
    opencr_id: 200
    opencr_usb_port: /dev/ttyACM0
    opencr_baud_rate: 1000000
    dxl_joints_profile_acceleration: 100
    dxl_joints_profile_velocity: 500
    dxl_gripper_profile_acceleration: 20
    dxl_gripper_profile_velocity: 200
  state: start
states:
  start:
    {wheel_left_joint: 0.0, wheel_right_joint: 0.0, joint1: 0.0, joint2: 0.0, joint3: 0.0,
     joint4: 0.0, gripper_left_joint: 0.0}
""",
        {
            "joint state_interface velocity initial_value": VELOCITY_STARTS,
            "joint command_interface velocity min": "the URDF has no limits of the wheels",
            "joint command_interface velocity max": "the URDF has no limits of the wheels",
            "gripper_right_joint": "it follows the left one: ros2_control refuses the block",
            "sensor state_interface initial_value": "what sensors measure has no start in YAML",
            "sensor battery": "a battery is not a sensor in YAML",
        },
        {"sensor param frame_id": "the broadcaster of an imu reads it"},
    ),
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_differences_are_those_that_are_known(name: str) -> None:
    example = EXAMPLES[name]
    robot = etree.parse(CORPUS / example.path).getroot()
    made = etree.fromstring(yamaro.build("-", text=in_yaml(robot, example)).xml().encode())
    assert faults_of(made) == []
    by_hand, again = set(facts(robot)), set(facts(made))
    assert len(by_hand & again) > 20
    assert kinds(by_hand - again, example.only_by_hand) == set(example.only_by_hand)
    assert kinds(again - by_hand, example.only_made) == set(example.only_made)


# --- the robot in YAML ------------------------------------------------------------------------


def in_yaml(robot: etree._Element, example: Example) -> str:
    """Return the joints of a robot as parts, with actuators, sensors and sections."""
    lines = ["robot: r", "naming: {joint: '*', link: '*'}", "model:"]
    children = {child.get("link") for child in robot.iterfind("joint/child")}
    roots = [
        each.get("name") for each in robot.iterfind("link") if each.get("name") not in children
    ]
    lines += [f"- link/name={root}:" for root in roots]
    for joint in robot.iterfind("joint"):
        link = joint.find("child").get("link")
        part = {
            "name": f"{joint.get('name')} {link}",
            "joint": joint_of(joint, example),
            "link": {"mass": 1, "geometry": "sphere", "scale": 0.1} if link != "imu_link" else None,
        }
        sensors = example.sensors.get(link, {})
        if sensors:
            part["link"] = {f"sensor/name={n}": {"type": kind} for n, kind in sensors.items()}
        lines.append(f"- part: {json.dumps(part)}")
    return "\n".join(lines) + example.sections


def joint_of(joint: etree._Element, example: Example) -> dict[str, object]:
    kind = joint.get("type")
    made: dict[str, object] = {"type": kind, "parent": joint.find("parent").get("link")}
    limit, mimic = joint.find("limit"), joint.find("mimic")
    if limit is not None:
        made["limit"] = dict(limit.attrib)
    if mimic is not None:
        made["mimic"] = dict(mimic.attrib)
    elif kind != "fixed":
        name = joint.get("name")
        pattern = next((p for p in example.commands if p != "*" and name.startswith(p[:-1])), "*")
        made["actuator"] = {"command": example.commands[pattern]}
    sensors = example.sensors.get(joint.get("name"), {})
    return made | {f"sensor/name={n}": {"type": kind} for n, kind in sensors.items()}


# --- what blocks say --------------------------------------------------------------------------


def facts(robot: etree._Element) -> Iterator[tuple[str, ...]]:
    """Yield what the blocks of a robot say, one fact after the other, without its order."""
    for block in robot.iterfind("ros2_control"):
        own = block.get("name")
        yield own, "type", block.get("type")
        yield own, "plugin", block.findtext("hardware/plugin").strip()
        for param in block.iterfind("hardware/param"):
            yield own, "hardware param", param.get("name"), param.text
        for owner in block:
            if owner.tag not in ("joint", "sensor", "gpio"):
                continue
            name = owner.get("name")
            yield own, owner.tag, name
            for each in owner:
                if not isinstance(each.tag, str):
                    continue
                words = (owner.tag, name, each.tag, each.get("name"))
                yield (own, *words) if each.tag != "param" else (own, *words, value(each))
                for param in each.iterfind("param"):
                    yield (own, *words, param.get("name"), value(param))


def value(param: etree._Element) -> str:
    try:
        return f"{float(param.text):.9g}"
    except ValueError:
        return str(param.text)


def kinds(facts: set[tuple[str, ...]], known: dict[str, str]) -> set[str]:
    """Return the kinds of facts: those of `known`, and others as they are."""
    found = set()
    for fact in facts:
        texts = {
            fact[2],
            " ".join(fact[1:3]),
            *(" ".join((fact[1], *fact[3:n])) for n in (4, 5, 6)),
        }
        if len(fact) > 5:
            texts.add(" ".join((fact[1], fact[3], fact[5])))
        found.add(max(texts & set(known), key=len, default=" ".join(fact)))
    return found
