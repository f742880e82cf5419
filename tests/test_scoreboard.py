"""The scoreboard's readers find the same robot in all formats, and each column notices a loss."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from tests.later import Later

NEEDED = ("pinocchio", "mujoco", "pydrake", "pxr")
pytestmark = [
    pytest.mark.skipif(sys.platform == "win32", reason="without pinocchio"),
    pytest.mark.skipif(not all(map(find_spec, NEEDED)), reason=f"needs {', '.join(NEEDED)}"),
]
compared: Any = Later("bench.scoreboard.judging", "compared")
apart: Any = Later("bench.scoreboard.__main__", "apart")
shortened: Any = Later("bench.scoreboard.__main__", "shortened")
READERS: Mapping[str, Any] = {
    "urdf": Later("bench.scoreboard.read_urdf", "read"),
    "mjcf": Later("bench.scoreboard.read_mjcf", "read"),
    "sdf": Later("bench.scoreboard.read_sdf", "read"),
    "usd": Later("bench.scoreboard.read_usd", "read"),
}

ROBOTS = {
    "urdf": """<robot name="small">
<link name="base">
  <inertial><origin xyz="0 0 0.1"/><mass value="1"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/></inertial>
  <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
</link>
<link name="arm">
  <inertial><origin xyz="0.1 0 0"/><mass value="2"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.025"/></inertial>
  <collision><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision>
</link>
<link name="jaw">
  <inertial><mass value="0.5"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
  <collision><geometry><sphere radius="0.02"/></geometry></collision>
</link>
<link name="tool"/>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="arm"/>
  <origin xyz="0 0 0.3" rpy="0 0 0.5"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="2" effort="10" velocity="3"/><dynamics damping="0.1" friction="0.2"/>
</joint>
<joint name="grip" type="prismatic"><parent link="arm"/><child link="jaw"/>
  <origin xyz="0.2 0 0"/><axis xyz="1 0 0"/><limit lower="0" upper="0.05" effort="5" velocity="1"/>
  <mimic joint="shoulder" multiplier="0.5" offset="0.01"/></joint>
<joint name="hold" type="fixed"><parent link="arm"/><child link="tool"/>
  <origin xyz="0.4 0 0"/></joint>
<gazebo reference="arm"><sensor name="turns" type="imu"/></gazebo>
<ros2_control name="all" type="system"><joint name="shoulder">
  <command_interface name="effort"/></joint></ros2_control>
</robot>""",
    "mjcf": """<mujoco><compiler angle="radian"/><worldbody>
<body name="base">
  <inertial pos="0 0 0.1" mass="1" diaginertia="0.02 0.03 0.04"/>
  <geom type="box" size="0.1 0.1 0.1"/>
  <body name="arm" pos="0 0 0.3" quat="0.96891242171 0 0 0.24740395925">
    <inertial pos="0.1 0 0" mass="2" diaginertia="0.01 0.02 0.025"/>
    <joint name="shoulder" axis="0 1 0" range="-1 2" damping="0.1" frictionloss="0.2"
      actuatorfrcrange="-10 10"/>
    <geom type="cylinder" size="0.05 0.2"/>
    <site name="tool" pos="0.4 0 0"/><site name="middle"/>
    <body name="jaw" pos="0.2 0 0">
      <inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.001"/>
      <joint name="grip" type="slide" axis="1 0 0" range="0 0.05" actuatorfrcrange="-5 5"/>
      <geom type="sphere" size="0.02"/>
    </body>
  </body>
</body></worldbody>
<equality><joint joint1="grip" joint2="shoulder" polycoef="0.01 0.5 0 0 0"/></equality>
<actuator><motor joint="shoulder"/></actuator>
<sensor><gyro site="middle"/></sensor>
</mujoco>""",
    "sdf": """<sdf version="1.11"><model name="small">
<link name="base">
  <inertial><pose>0 0 0.1 0 0 0</pose><mass>1</mass>
    <inertia><ixx>0.02</ixx><iyy>0.03</iyy><izz>0.04</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
</link>
<link name="arm"><pose>0 0 0.3 0 0 0.5</pose>
  <inertial><pose>0.1 0 0 0 0 0</pose><mass>2</mass>
    <inertia><ixx>0.01</ixx><iyy>0.02</iyy><izz>0.025</izz></inertia></inertial>
  <collision name="c"><geometry><cylinder><radius>0.05</radius><length>0.4</length></cylinder>
    </geometry></collision>
  <sensor name="turns" type="imu"/>
</link>
<link name="jaw"><pose relative_to="arm">0.2 0 0 0 0 0</pose>
  <inertial><mass>0.5</mass>
    <inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.02</radius></sphere></geometry></collision>
</link>
<frame name="tool" attached_to="arm"><pose>0.4 0 0 0 0 0</pose></frame>
<joint name="shoulder" type="revolute"><parent>base</parent><child>arm</child>
  <axis><xyz>0 1 0</xyz>
    <limit><lower>-1</lower><upper>2</upper><effort>10</effort><velocity>3</velocity></limit>
    <dynamics><damping>0.1</damping><friction>0.2</friction></dynamics></axis></joint>
<joint name="grip" type="prismatic"><parent>arm</parent><child>jaw</child>
  <axis><xyz>1 0 0</xyz>
    <limit><lower>0</lower><upper>0.05</upper><effort>5</effort><velocity>1</velocity></limit>
    <mimic joint="shoulder"><multiplier>0.5</multiplier><offset>0.01</offset>
      <reference>0</reference></mimic></axis></joint>
<plugin filename="gz-sim-joint-controller-system" name="gz::sim::systems::JointController">
  <joint_name>shoulder</joint_name></plugin>
</model></sdf>""",
    "usd": """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass = 1
    point3f physics:centerOfMass = (0, 0, 0.1)
    float3 physics:diagonalInertia = (0.02, 0.03, 0.04)
    def Cube "c" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double size = 0.2
    }
}
def Xform "arm" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    double3 xformOp:translate = (0, 0, 0.3)
    quatd xformOp:orient = (0.96891242171, 0, 0, 0.24740395925)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
    float physics:mass = 2
    point3f physics:centerOfMass = (0.1, 0, 0)
    float3 physics:diagonalInertia = (0.01, 0.02, 0.025)
    def Cylinder "c" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double radius = 0.05
        double height = 0.4
        uniform token axis = "Z"
    }
    def Xform "tool"
    {
        double3 xformOp:translate = (0.4, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def IsaacImuSensor "turns"
    {
    }
}
def Xform "jaw" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass = 0.5
    float3 physics:diagonalInertia = (0.001, 0.001, 0.001)
    def Sphere "c" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double radius = 0.02
    }
}
def PhysicsRevoluteJoint "shoulder" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
{
    uniform token physics:axis = "Y"
    rel physics:body0 = </base>
    rel physics:body1 = </arm>
    point3f physics:localPos0 = (0, 0, 0.3)
    quatf physics:localRot0 = (0.96891242171, 0, 0, 0.24740395925)
    float physics:lowerLimit = -57.29577951
    float physics:upperLimit = 114.59155903
    float drive:angular:physics:maxForce = 10
    float drive:angular:physics:damping = 1
    float newton:velocityLimit = 171.88733854
    float newton:damping = 0.00174532925
    float newton:friction = 0.2
}
def PhysicsPrismaticJoint "grip" (prepend apiSchemas = ["PhysicsDriveAPI:linear"])
{
    uniform token physics:axis = "X"
    rel physics:body0 = </arm>
    rel physics:body1 = </jaw>
    point3f physics:localPos0 = (0.2, 0, 0)
    float physics:lowerLimit = 0
    float physics:upperLimit = 0.05
    float drive:linear:physics:maxForce = 5
    float newton:velocityLimit = 1
    rel newton:mimicJoint = </shoulder>
    float newton:mimicCoef0 = 0.01
    float newton:mimicCoef1 = 0.5
}
""",
}
"""One robot, written by hand in each format."""

LOSSES = {
    "names": {
        "urdf": ("shoulder", "elbow"),
        "mjcf": ("shoulder", "elbow"),
        "sdf": ("shoulder", "elbow"),
        "usd": ("shoulder", "elbow"),
    },
    "mass": {
        "urdf": ('value="2"', 'value="2.01"'),
        "mjcf": ('mass="2"', 'mass="2.01"'),
        "sdf": ("<mass>2<", "<mass>2.01<"),
        "usd": ("mass = 2", "mass = 2.01"),
    },
    "inertia": {
        "urdf": ('iyy="0.02"', 'iyy="0.021"'),
        "mjcf": ("0.01 0.02 0.025", "0.01 0.021 0.025"),
        "sdf": ("<iyy>0.02<", "<iyy>0.021<"),
        "usd": ("(0.01, 0.02, 0.025)", "(0.01, 0.021, 0.025)"),
    },
    "frames": {
        "urdf": ('xyz="0.4 0 0"', 'xyz="0.401 0 0"'),
        "mjcf": ('pos="0.4 0 0"', 'pos="0.401 0 0"'),
        "sdf": ("<pose>0.4 ", "<pose>0.401 "),
        "usd": ("translate = (0.4,", "translate = (0.401,"),
    },
    "limits": {
        "urdf": ('effort="10"', 'effort="11"'),
        "mjcf": ("-10 10", "-11 11"),
        "sdf": ("<effort>10<", "<effort>11<"),
        "usd": ("maxForce = 10", "maxForce = 11"),
    },
    "dynamics": {
        "urdf": ('damping="0.1"', 'damping="0.2"'),
        "mjcf": ('damping="0.1"', 'damping="0.2"'),
        "sdf": ("<damping>0.1<", "<damping>0.2<"),
        "usd": ("newton:damping", "other:damping"),
    },
    "actuators": {
        "urdf": ('<command_interface name="effort"/>', ""),
        "mjcf": ('<motor joint="shoulder"/>', ""),
        "sdf": ("<joint_name>shoulder</joint_name>", ""),
        "usd": ("physics:damping = 1", "physics:damping = 0"),
    },
    "sensors": {
        "urdf": ('type="imu"', 'type="contact"'),
        "mjcf": ("<gyro ", "<touch "),
        "sdf": ('type="imu"', 'type="contact"'),
        "usd": ("IsaacImuSensor", "IsaacContactSensor"),
    },
    "mimics": {
        "urdf": ('multiplier="0.5"', 'multiplier="0.6"'),
        "mjcf": ("0.01 0.5", "0.01 0.6"),
        "sdf": ("<multiplier>0.5<", "<multiplier>0.6<"),
        "usd": ("mimicCoef1 = 0.5", "mimicCoef1 = 0.6"),
    },
    "shapes": {
        "urdf": ('radius="0.05"', 'radius="0.06"'),
        "mjcf": ('"0.05 0.2"', '"0.06 0.2"'),
        "sdf": ("<radius>0.05<", "<radius>0.06<"),
        "usd": ("radius = 0.05", "radius = 0.06"),
    },
}
"""A text to replace, by the column that has to notice it and the format."""
ENDINGS = {"urdf": ".urdf", "mjcf": ".xml", "sdf": ".sdf", "usd": ".usda"}


def read(format: str, text: str, folder: Path) -> Any:
    path = folder / f"robot{len(list(folder.iterdir()))}{ENDINGS[format]}"
    path.write_text(text, encoding="utf-8")
    return READERS[format](path)


def lost(shares: Mapping[str, Any]) -> set[str]:
    return {name for name, share in shares.items() if share.kept < share.of}


@pytest.mark.parametrize("source", ["urdf", "mjcf"])
@pytest.mark.parametrize("format", READERS)
def test_one_robot_is_the_same_in_all_formats(source: str, format: str, tmp_path: Path) -> None:
    facts = read(source, ROBOTS[source], tmp_path)
    shares = compared(facts, read(format, ROBOTS[format], tmp_path))
    if source == "mjcf" != format:
        assert shares.pop("frames").lost == "middle"  # a site that only the MJCF has
    assert {*shares, "frames"} == {*LOSSES}
    assert not lost(shares), shares


@pytest.mark.parametrize("format", READERS)
@pytest.mark.parametrize("column", LOSSES)
def test_a_column_notices_what_is_lost(column: str, format: str, tmp_path: Path) -> None:
    facts = read("urdf", ROBOTS["urdf"], tmp_path)
    old, new = LOSSES[column][format]
    assert old in ROBOTS[format]
    shares = compared(facts, read(format, ROBOTS[format].replace(old, new), tmp_path))
    assert lost(shares) == {column}, shares
    assert shares[column].lost


def test_an_equation_between_joints_may_be_solved_for_the_other(tmp_path: Path) -> None:
    facts = read("urdf", ROBOTS["urdf"], tmp_path)
    turned = 'joint1="shoulder" joint2="grip" polycoef="-0.02 2 0 0 0"'
    text = ROBOTS["mjcf"].replace(
        'joint1="grip" joint2="shoulder" polycoef="0.01 0.5 0 0 0"', turned
    )
    assert "mimics" not in lost(compared(facts, read("mjcf", text, tmp_path)))
    text = text.replace("-0.02 2", "-0.02 2.1")
    assert "mimics" in lost(compared(facts, read("mjcf", text, tmp_path)))


def test_a_gain_counts_where_both_formats_have_one(tmp_path: Path) -> None:
    position = ROBOTS["mjcf"].replace(
        '<motor joint="shoulder"/>', '<position joint="shoulder" kp="9"/>'
    )
    facts = read("mjcf", position, tmp_path)
    assert "actuators" not in lost(compared(facts, read("mjcf", position, tmp_path)))
    other = position.replace('kp="9"', 'kp="10"')
    assert "actuators" in lost(compared(facts, read("mjcf", other, tmp_path)))
    assert "actuators" not in lost(compared(facts, read("urdf", ROBOTS["urdf"], tmp_path)))


def test_what_a_reader_refuses_is_a_message(tmp_path: Path) -> None:
    facts = read("urdf", ROBOTS["urdf"], tmp_path)
    for format, ending in ENDINGS.items():
        path = tmp_path / f"broken{ending}"
        path.write_text("<nothing/>", encoding="utf-8")
        answer = apart(facts, format, path)
        assert answer["message"] and "shares" not in answer


def test_a_message_names_no_folder_of_this_machine(tmp_path: Path) -> None:
    text = f"cannot open {tmp_path}/meshes/a.stl\nnor /usr/lib/some/b.dae"
    assert shortened(text, tmp_path) == "cannot open meshes/a.stl nor …/b.dae"
