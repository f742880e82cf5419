"""Robots in SDFormat, as libsdformat and Drake read them."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

import yamaro
from tests.consumers import oracles, sdf_judges

FOLDER = Path(__file__).parents[3] / "examples"
EXAMPLES = [
    FOLDER / name
    for name in (
        "arm/arm.yaml",
        "diff_drive/diff_drive.yaml",
        "drone/drone.yaml",
        "dual_arm_cell/dual_arm_cell.yaml",
        "hand/hand.yaml",
        "hexapod/hexapod.yaml",
        "humanoid/humanoid.yaml",
        "leg_robot/robot.yaml",
        "mobile_manipulator/mobile_manipulator.yaml",
        "pan_tilt/pan_tilt.yaml",
        "quadruped/quadruped.yaml",
    )
]
ARM = """
robot: arm
model:
- part:
    name: base
    link: {geometry: box, scale: 0.2 0.2 0.1, mass: 4, visual: null, collision: null}
- part:
    name: upper
    joint:
      type: revolute
      parent: base
      xyz: 0 0 0.05
      axis: y
      limit: {lower: -1, upper: 2, effort: 10, velocity: 3}
      dynamics: {damping: 0.1, friction: 0.02}
    link:
      geometry: cylinder
      radius: 0.02
      length: 0.5
      mass: 1
      xyz: 0 0 0.25
      visual: {color: 1 0 0 1}
      frame/name=tip: {xyz: 0 0 0.5, rpy: 0 90deg 0}
- part:
    name: finger
    joint:
      type: prismatic
      parent: tip
      axis: z
      limit: {lower: 0, upper: 0.04, effort: 5, velocity: 0.1}
      mimic: {joint: upper, multiplier: 0.5, offset: 0.01}
    link: {geometry: sphere, radius: 0.01, mass: 0.1}
"""
URDF = """
<robot name="r">
  <link name="world"/>
  <link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="body"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
   iyz="0"/></inertial></link>
  <link name="spin"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
   iyz="0"/></inertial></link>
  <joint name="anchor" type="fixed"><parent link="world"/><child link="base"/>
    <origin xyz="0 0 1"/></joint>
  <joint name="hold" type="fixed"><parent link="base"/><child link="body"/>
    <origin xyz="0.1 0 0" rpy="0 0 0.5"/></joint>
  <joint name="spin" type="continuous"><parent link="base"/><child link="spin"/>
    <origin xyz="0 0.2 0"/><axis xyz="0 0 1"/>
    <safety_controller k_velocity="1"/></joint>
  {more}
</robot>
"""


def sdf_of(text: str, tmp_path: Path, ending: str = "yaml", **given: Any) -> yamaro.Build:
    path = tmp_path / f"robot.{ending}"
    path.write_text(text)
    return yamaro.build(path, target="sdf", **given)


def told(build: yamaro.Build) -> set[tuple[str, str, str]]:
    return {(loss.kind, loss.what, loss.owner) for loss in build.losses}


def check(build: yamaro.Build, tmp_path: Path) -> None:
    """Ask libsdformat, and the descriptions of its elements."""
    path = tmp_path / "robot.sdf"
    path.write_text(build.xml())
    assert sdf_judges.complaint_of_description(build.xml()) == ""
    if shutil.which("ign") is None:
        oracles.missing("SDFormat")
    assert sdf_judges.complaint_of_libsdformat(path) == ""


def model_of(build: yamaro.Build) -> ElementTree.Element:
    model = ElementTree.fromstring(build.xml()).find("model")
    assert model is not None
    return model


def test_poses_are_those_of_the_description(tmp_path: Path) -> None:
    build = sdf_of(ARM, tmp_path)
    model = model_of(build)
    frame = model.find("frame[@name='tip']")
    assert frame is not None
    assert frame.attrib["attached_to"] == "upper_link"
    assert frame.findtext("pose") == "0 0 0.5 0 1.5707963267949 0"
    joint = model.find("joint[@name='finger_joint']")
    assert joint is not None
    pose = joint.find("pose")
    assert pose is not None
    assert pose.attrib == {"relative_to": "tip"}
    assert joint.findtext("parent") == "upper_link"
    assert told(build) == set()


def test_a_mimic_is_written_since_1_11_and_lost_before(tmp_path: Path) -> None:
    mimic = model_of(sdf_of(ARM, tmp_path)).find("joint[@name='finger_joint']/axis/mimic")
    assert mimic is not None
    assert mimic.attrib == {"joint": "upper_joint"}
    assert (mimic.findtext("multiplier"), mimic.findtext("offset")) == ("0.5", "0.01")
    build = sdf_of(ARM, tmp_path, sdf_version="1.9")
    assert told(build) == {("lost", "mimic joints", "joint 'finger_joint'")}
    check(build, tmp_path)


def test_links_without_mass_are_frames_and_their_shapes_stay(tmp_path: Path) -> None:
    build = sdf_of(URDF.replace("{more}", ""), tmp_path, "urdf", sdf_version="1.9")
    check(build, tmp_path)
    model = model_of(build)
    assert [link.attrib["name"] for link in model.findall("link")] == ["body", "spin"]
    base = model.find("frame[@name='base']")
    assert base is not None
    assert base.attrib["attached_to"] == "body"
    pose = model.find("link[@name='body']/visual/pose")
    assert pose is not None
    assert pose.attrib == {"relative_to": "base"}
    assert model.findtext("joint[@name='anchor']/parent") == "world"
    assert model.findtext("joint[@name='anchor']/child") == "body"
    assert told(build) == {
        ("renamed", "joints named like a link", "joint 'spin'"),
        ("lost", "soft limits", "joint 'spin'"),
    }
    assert model.findtext("joint[@name='spin_joint']/child") == "spin"


def test_what_is_written_for_gazebo_is_taken_over(tmp_path: Path) -> None:
    more = """
    <gazebo><plugin name="p" filename="libp.so"><a>1</a></plugin><odd/></gazebo>
    <gazebo reference="base"><mu1>0.3</mu1><material>Gazebo/Red</material>
      <sensor name="s" type="imu"><pose>1 0 0 0 0 0</pose><update_rate>5</update_rate></sensor>
    </gazebo>
    <gazebo reference="spin"><selfCollide>1</selfCollide><turnGravityOff>true</turnGravityOff>
    </gazebo>
    """
    build = sdf_of(URDF.replace("{more}", more), tmp_path, "urdf", sdf_version="1.9")
    check(build, tmp_path)
    model = model_of(build)
    assert model.findtext("plugin[@name='p']/a") == "1"
    sensor = model.find("link[@name='body']/sensor[@name='s']/pose")
    assert sensor is not None
    assert (sensor.text, sensor.attrib) == ("1 0 0 0 0 0", {"relative_to": "base"})
    assert model.findtext("link[@name='spin']/self_collide") == "true"
    assert model.findtext("link[@name='spin']/gravity") == "false"
    assert {what for _, what, _ in told(build)} >= {
        "Gazebo's <odd> elements",
        "Gazebo's <material> elements",
    }


def test_a_plugin_that_is_a_sensor_has_its_pose(tmp_path: Path) -> None:
    more = """
    <gazebo><plugin name="imu" filename="libgazebo_ros_imu.so">
      <bodyName>body</bodyName><xyzOffset>0.1 0 0.2</xyzOffset><rpyOffset>0 0 0.5</rpyOffset>
    </plugin></gazebo>
    """
    build = sdf_of(URDF.replace("{more}", more), tmp_path, "urdf", sdf_version="1.9")
    check(build, tmp_path)
    sensor = model_of(build).find("link[@name='body']/sensor[@type='imu']")
    assert sensor is not None
    assert sensor.findtext("pose") == "0.1 0 0.2 0 0 0.5"


def test_the_cone_of_a_range_sensor_is_one_ray(tmp_path: Path) -> None:
    text = ARM.replace("mass: 4,", "mass: 4, sensor/name=near: {type: range, fov: 20deg},")
    cone = ("approximated", "cones of range sensors", "sensor 'near'")
    assert told(sdf_of(text, tmp_path)) == {cone}


def test_a_base_is_fixed_where_that_is_asked(tmp_path: Path) -> None:
    free = model_of(sdf_of(ARM, tmp_path, base="free"))
    assert free.find("joint[@name='base_link_world']") is None
    fixed = model_of(sdf_of(ARM, tmp_path, base="fixed"))
    joint = fixed.find("joint[@name='base_link_world']")
    assert joint is not None
    assert joint.findtext("parent") == "world"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_drake_and_pinocchio_agree_on_the_examples(path: Path, tmp_path: Path) -> None:
    oracles.require_module("pinocchio")
    oracles.require_module("pydrake")
    build = yamaro.build(path, meshes="none", on_message=lambda line: None)
    urdf, sdf = tmp_path / "robot.urdf", tmp_path / "robot.sdf"
    urdf.write_text(build.xml())
    made = yamaro.build(path, target="sdf", meshes="none", on_message=lambda line: None)
    sdf.write_text(made.xml())
    assert sdf_judges.disagreement(urdf, sdf, build.robot, made.losses, positions=20) == ""


def test_drake_reads_actuators_and_joints_that_follow(tmp_path: Path) -> None:
    oracles.require_module("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import DiscreteContactApproximation, MultibodyPlant

    # The armature, the gains and the effort of each joint.
    rows = {
        "servo": ("kp: 30, kd: 2, armature: 0.2", 0.2, (30, 2), 5),
        "geared": ("kp: 4, kd: 1, rotor_inertia: 1e-5, gear: -30", 1e-5 * 900, (4, 1), 5),
        "speed": ("command: velocity, kp: 3, stall_torque: 4 N*m", 0, (0, 3), 4),
        "torque": ("command: effort, armature: 0.1, stall_torque: 9 N*m", 0.1, (0, 0), 5),
    }
    text = "robot: r\nbase: fixed\nmodel:\n- part:\n    name: base\n"
    text += "    link: {geometry: sphere, radius: 0.1, mass: 1}\n"
    for name, (actuator, *_) in rows.items():
        text += f"""
- part:
    name: {name}
    joint:
      type: revolute
      parent: base
      axis: z
      limit: {{lower: -1, upper: 1, effort: 5, velocity: 2}}
      actuator: {{{actuator}}}
    link: {{geometry: sphere, radius: 0.1, mass: 1}}
"""
    text += """
- part:
    name: follower
    joint: {type: revolute, parent: base, axis: z, limit: {lower: -1, upper: 1},
            mimic: {joint: servo_joint, multiplier: -0.5, offset: 0.1}}
    link: {geometry: sphere, radius: 0.1, mass: 1}
"""
    for version, lost in (("1.11", set[str]()), ("1.9", {"mimic joints"})):
        build = yamaro.build("r.yaml", text=text, target="sdf", sdf_version=version)
        assert {loss.what for loss in build.losses} == lost
        plant = MultibodyPlant(0.001)
        plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
        Parser(plant).AddModelsFromString(build.xml(), "sdf")
        plant.Finalize()
        for name, (_, armature, gains, effort) in rows.items():
            driven = plant.GetJointActuatorByName(f"{name}_joint")
            assert driven.default_reflected_inertia() == pytest.approx(armature, rel=1e-14)
            assert driven.effort_limit() == effort
            assert driven.has_controller() == any(gains)
            if driven.has_controller():
                found = driven.get_controller_gains()
                assert (found.p, found.d) == gains
        assert plant.num_constraints() == 1
