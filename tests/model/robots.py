"""Robots that the tests of the model share."""

EXAMPLES = [
    "arm/arm.yaml",
    "diff_drive/diff_drive.yaml",
    "hexapod/hexapod.yaml",
    "leg_robot/robot.yaml",
    "pan_tilt/pan_tilt.yaml",
    "quadruped/quadruped.yaml",
]

JOINTS = """<?xml version="1.0"?>
<robot name="joints">
  <link name="base"/>
  <link name="turned"/>
  <link name="spun"/>
  <link name="slid"/>
  <link name="held"/>
  <link name="follower"/>
  <link name="echo"/>
  <link name="drifted"/>
  <link name="floated"/>
  <joint name="turn" type="revolute">
    <origin xyz="0.1 0.2 0.3" rpy="0.4 -0.5 0.6"/>
    <parent link="base"/><child link="turned"/>
    <axis xyz="0.6 0 0.8"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="spin" type="continuous">
    <origin xyz="0 0 0.5" rpy="0 1.2 0"/>
    <parent link="turned"/><child link="spun"/>
    <axis xyz="0 -1 0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <origin xyz="0.3 0 0" rpy="0 0 -0.7"/>
    <parent link="spun"/><child link="slid"/>
    <axis xyz="0 0.6 0.8"/>
    <limit lower="0" upper="0.4" effort="1" velocity="1"/>
  </joint>
  <joint name="hold" type="fixed">
    <origin xyz="0 0 0.1" rpy="3.14159 0 1.5"/>
    <parent link="slid"/><child link="held"/>
  </joint>
  <joint name="follow" type="revolute">
    <origin xyz="0 0.2 0"/>
    <parent link="held"/><child link="follower"/>
    <limit lower="-4" upper="4" effort="1" velocity="1"/>
    <mimic joint="turn" multiplier="-1.5" offset="0.25"/>
  </joint>
  <joint name="echo" type="prismatic">
    <origin xyz="0 0.2 0" rpy="0.3 0 0"/>
    <parent link="base"/><child link="echo"/>
    <axis xyz="0 0 1"/>
    <limit lower="-4" upper="4" effort="1" velocity="1"/>
    <mimic joint="slide"/>
  </joint>
  <joint name="drift" type="planar">
    <origin xyz="1 0 0" rpy="0 0 0.5"/>
    <parent link="base"/><child link="drifted"/>
    <axis xyz="0 0 1"/>
  </joint>
  <joint name="float" type="floating">
    <origin xyz="0 1 0" rpy="0 0.5 0"/>
    <parent link="base"/><child link="floated"/>
  </joint>
</robot>
"""
