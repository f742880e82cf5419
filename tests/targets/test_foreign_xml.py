"""XML of other programs in a robot is a loss, unless the model of the robot has it."""

from __future__ import annotations

from yamaro import Robot
from yamaro.targets.foreign_xml import foreign_losses

URDF = """\
<robot name="r" xmlns:drake="d">
  <link name="base" type="x">
    <visual><geometry><box size="1 1 1"/></geometry><meshScale a="1"/></visual>
    <collision concave="yes"><geometry><box size="1 1 1" fuzz="2"/></geometry></collision>
  </link>
  <link name="tip"/>
  <joint name="j" type="continuous">
    <parent link="base"/><child link="tip"/><compliance/>
  </joint>
  <material name="m"><color rgba="1 1 1 1"/></material>
  <transmission name="t"/>
  <ros2_control name="c" type="system"/>
  <mujoco><compiler/></mujoco>
  <gazebo><plugin name="p" filename="f"/></gazebo>
  <gazebo reference="base">
    <mu1>0.5</mu1>
    <turnGravityOff>true</turnGravityOff>
    <sensor name="imu" type="imu"><plugin name="q" filename="f"/></sensor>
    <sensor name="odd" type="altimeter"/>
  </gazebo>
  <gazebo reference="j"><preserveFixedJoint>true</preserveFixedJoint></gazebo>
</robot>
"""


def test_each_element_that_is_not_urdf_is_a_loss_at_its_place() -> None:
    losses = foreign_losses(Robot.from_xml(URDF))
    assert [(each.what, each.owner, each.span.location()[0]) for each in losses] == [
        ("<meshScale> elements", "link 'base'", 3),
        ("attributes 'concave' of <collision>", "link 'base'", 4),
        ("attributes 'fuzz' of <box>", "link 'base'", 4),
        ("<compliance> elements", "joint 'j'", 8),
        ("transmissions that give no actuator", "'t'", 11),
        ("<mujoco> elements", "the robot", 13),
        ("Gazebo's <plugin> elements", "the robot", 14),
        ("Gazebo's <turnGravityOff> elements", "'base'", 17),
        ("Gazebo's <plugin> elements", "'base'", 18),
        ("Gazebo's <sensor> elements", "'base'", 19),
    ]
    assert {each.kind for each in losses} == {"lost"}


def test_what_a_writer_takes_itself_is_not_a_loss() -> None:
    losses = foreign_losses(Robot.from_xml(URDF), taken=("gazebo", "mujoco"))
    assert [each.what for each in losses][-2:] == [
        "<compliance> elements",
        "transmissions that give no actuator",
    ]


def test_a_robot_without_it_has_no_losses() -> None:
    text = '<robot name="r"><link name="a"><inertial><mass value="1"/></inertial></link></robot>'
    assert foreign_losses(Robot.from_xml(text)) == []
