"""Blocks for MJCF, merged into what is written, against MuJoCo's reading of the same by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import yamaro
from tests.consumers.oracles import require_module

if TYPE_CHECKING:
    from pathlib import Path

BY_HAND = """\
<mujoco model="robot">
  <compiler angle="radian"/>
  <option timestep="0.001" integrator="RK4"><flag energy="enable"/></option>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 0.1"/>
    <body name="base_link" pos="0 0 1">
      <freejoint name="float"/>
      <inertial pos="0 0 0.1" mass="2" diaginertia="0.02 0.03 0.04"/>
      <geom name="shell" type="box" size="0.1 0.1 0.2" contype="2" condim="4" group="0"/>
      <geom name="egg" type="ellipsoid" size="0.1 0.2 0.3" mass="0"/>
      <geom name="foot" type="sphere" size="0.05" friction="0.9 0.01 0.001" group="3"/>
      <site name="tool" pos="0.1 0 0" type="box" size="0.01 0.02 0.03"/>
      <body name="arm_link" pos="0 0 0.5">
        <joint name="slide" type="slide" pos="0 0 0.2" axis="1 0 0" stiffness="30"
               springref="0.1"/>
        <joint name="arm_joint" axis="0 1 0" pos="0 0 0.2" ref="0.3" range="-1 1" armature="0.02"
               damping="0.5"/>
        <inertial pos="0 0.1 0.2" mass="1" diaginertia="0.01 0.01 0.01"/>
        <body name="hand_link" pos="0 0 0.4" quat="0 1 0 0" gravcomp="0.5">
          <joint name="hand_joint" pos="0 0.1 0" axis="0 0 1" range="-2 2"/>
          <inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.001"/>
        </body>
      </body>
    </body>
  </worldbody>
  <contact><exclude body1="base_link" body2="hand_link"/></contact>
  <tendon><fixed name="pull"><joint joint="slide" coef="2"/></fixed></tendon>
  <equality><joint joint1="hand_joint" joint2="arm_joint" solref="0.05 1"/></equality>
  <actuator>
    <motor name="pusher" joint="slide" gear="20" ctrlrange="-1 1"/>
    <position name="arm" joint="arm_joint" kp="40" kv="2" ctrlrange="-0.5 0.5" forcerange="-9 9"/>
    <general name="puller" tendon="pull" biastype="affine" gainprm="3" biasprm="0 -1 -2"/>
  </actuator>
  <sensor>
    <accelerometer name="acc" site="tool"/>
    <jointpos name="angle" joint="arm_joint"/>
  </sensor>
  <keyframe><key name="home" qpos="0 0 2 1 0 0 0 0.1 0.2 0.3" ctrl="0.1 0.2 0"/></keyframe>
</mujoco>
"""
IN_YAML = """\
robot: robot
base: free
model:
- part:
    name: base
    link:
      inertial: {mass: 2, xyz: 0 0 0.1, inertia: 0.02 0 0 0.03 0 0.04}
      visual/name=shell: {geometry: box, scale: 0.2 0.2 0.4}
      collision/name=shell: {geometry: box, scale: 0.2 0.2 0.4}
      collision/name=foot: {geometry: sphere, radius: 0.05}
      frame/name=tool: {xyz: 0.1 0 0}
      sensor/name=imu: {type: imu, frame: tool}
      mjcf:
        pos: 0 0 1
        freejoint/name=float:
        geom/name=shell, contype=2, condim=4, group=0:
        geom/name=egg, type=ellipsoid, size=0.1 0.2 0.3, mass=0:
        <geom/name=foot, friction=0.9 0.01 0.001>:
        site/name=tool, type=box, size=0.01 0.02 0.03:
- part:
    name: slider
    joint/name=slide:
      type: prismatic
      parent: base
      axis: x
      xyz: 0 0 0.7
      limit: {lower: -1e16, upper: 1e16, effort: 20, velocity: 1e16}
      actuator: {command: effort}
      mjcf:
        pos: 0 0 0.2
        stiffness: 30
        springref: 0.1
        actuatorfrclimited: false
        motor/name=pusher, gear=20, ctrlrange=-1 1:
- part:
    name: swing
    joint/name=arm_joint:
      type: revolute
      parent: slider
      axis: y
      rpy: 0 -0.3 0
      limit: {lower: -1, upper: 1, effort: 9, velocity: 1e16}
      dynamics: {damping: 0.5}
      actuator: {kp: 40, kd: 2}
      mjcf:
        pos: 0 0 0.2
        ref: 0.3
        armature: 0.02
        actuatorfrclimited: false
        position/name=arm, ctrlrange=-0.5 0.5:
- part:
    name: arm
    joint/name=arm_fixed: {type: fixed, parent: swing, xyz: 0 0 -0.2}
    link: {inertial: {mass: 1, xyz: 0 0.1 0.2, inertia: 0.01 0 0 0.01 0 0.01}}
- part:
    name: turn
    joint/name=hand_joint:
      type: revolute
      parent: arm
      axis: z
      xyz: 0 -0.1 0.4
      rpy: 180deg 0 0
      limit: {lower: -2, upper: 2, effort: 1e16, velocity: 1e16}
      mjcf: {pos: 0 0.1 0}
- part:
    name: hand
    joint/name=hand_fixed: {type: fixed, parent: turn, xyz: 0 -0.1 0}
    link:
      inertial: {mass: 0.5, inertia: 0.001 0 0 0.001 0 0.001}
      mjcf: {gravcomp: 0.5}
- mjcf:
    option/timestep=0.001, integrator=RK4:
      flag/energy=enable:
    worldbody:
      geom/name=floor, type=plane, size=1 1 0.1:
    contact:
      exclude/body1=base_link, body2=hand_link:
    tendon:
      fixed/name=pull:
        joint/joint=slide, coef=2:
    equality:
      joint/joint1=hand_joint, joint2=arm_joint, solref=0.05 1:
    actuator:
      general/name=puller, tendon=pull, biastype=affine, gainprm=3, biasprm=0 -1 -2:
    sensor:
      accelerometer/name=acc, site=tool:
      jointpos/name=angle, joint=arm_joint:
    keyframe:
      key/name=home, qpos=0 0 2 1 0 0 0 0.1 0.2 0.3, ctrl=0.1 0.2 0:
states:
  home: {slide: 0.1, arm_joint: 0.2}
"""


def made(tmp_path: Path, text: str) -> tuple[yamaro.Build, Path]:
    """Return what is built, and where its MJCF is."""
    source, out = tmp_path / "robot.yaml", tmp_path / "made" / "robot.xml"
    source.write_text(text)
    build = yamaro.build(source, target="mjcf", output=out)
    out.parent.mkdir(exist_ok=True)
    out.write_text(build.xml())
    for name, data in build.assets.items():
        (out.parent / name).parent.mkdir(exist_ok=True)
        (out.parent / name).write_bytes(data)
    return build, out


def test_what_a_block_says_is_merged_into_what_is_written(tmp_path: Path) -> None:
    require_module("mujoco")
    from tests.targets.same_mjcf import Comparison

    by_hand = tmp_path / "by_hand.xml"
    by_hand.write_text(BY_HAND)
    build, out = made(tmp_path, IN_YAML)
    comparison = Comparison(str(by_hand), str(out))
    assert comparison.found == {}
    assert comparison.fields == {}
    assert [each.what for each in build.losses] == []


BALL = """\
robot: robot
base: fixed
model:
- part: {name: base, link: {geometry: sphere, scale: 0.1, mass: 1}}
- part: {name: first, joint: {type: continuous, parent: base, axis: x, xyz: 0 0 0.2}}
- part: {name: second, joint: {type: continuous, parent: first, axis: y, rpy: 0 0 0.3}}
- part:
    name: third
    joint: {type: continuous, parent: second, axis: z, xyz: 0.1 0 0, rpy: 0.2 0 0}
    link: {geometry: box, scale: 0.1 0.2 0.3, mass: 1}
"""


def test_joints_through_links_without_mass_are_joints_of_one_body(tmp_path: Path) -> None:
    require_module("mujoco")
    require_module("pinocchio")
    from tests.targets.mechanics import Mujoco, PinocchioUrdf, differences

    build, out = made(tmp_path, BALL)
    reference = PinocchioUrdf(yamaro.build(tmp_path / "robot.yaml").xml(), is_fixed=True)
    model = Mujoco(out.read_text(), {}, reference.joints)
    found = differences(reference, model, 10)
    assert {"mass matrix", "efforts"} <= found.keys()
    assert max(found.values()) < 1e-9
    assert [(each.kind, each.owner) for each in build.losses] == [
        ("approximated", "link 'first_link'"),
        ("approximated", "link 'second_link'"),
    ]


SCENE = """\
<mujoco model="scene">
  <compiler angle="degree"/>
  <default>
    <geom friction="0.7 0.1 0.1" condim="4"/>
    <tendon width="0.01" rgba="1 0 0 1"/>
    <default class="leg"><joint damping="1" range="-40 50"/><position kp="20"/></default>
  </default>
  <asset><model name="finger" file="finger.xml"/></asset>
  <worldbody>
    <geom name="floor" type="plane" size="2 2 0.1"/>
    <camera name="front" pos="2 0 1" xyaxes="0 1 0 -0.5 0 1"/>
    <body name="target" mocap="true" pos="0.5 0 0.5"><geom size="0.02" contype="0"/></body>
    <body name="cart" pos="0 0 0.3">
      <joint name="x" type="slide" axis="1 0 0" pos="0.1 0.2 0"/>
      <joint name="turn" axis="0 0 1" pos="0 0.1 0" ref="20"/>
      <geom type="box" size="0.2 0.1 0.05" friction="0.9"/>
      <frame pos="0.1 0 0.1" euler="0 90 0">
        <body name="upper"><joint name="hip" class="leg" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
          <body name="lower" pos="0 0 -0.3"><joint name="knee" class="leg" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
            <site name="upper" pos="0 0 -0.3"/>
          </body>
        </body>
      </frame>
      <body name="empty" pos="0 0 0.2"><camera name="eye"/></body>
      <body name="head" pos="0 0 0.1"><joint name="neck" type="ball" damping="0.1"/>
        <geom size="0.05" pos="0 0 0.05"/></body>
      <replicate count="3" euler="0 0 60" sep="-">
        <frame pos="0.2 0 0"><attach model="finger" body="tip" prefix="f_"/></frame>
      </replicate>
    </body>
    <body name="ball" pos="1 0 1"><freejoint name="float"/><geom size="0.1"/></body>
  </worldbody>
  <tendon>
    <fixed name="both"><joint joint="hip" coef="1"/><joint joint="knee" coef="-1"/></fixed>
    <spatial name="string"><site site="upper"/><site site="f_pad-1"/></spatial>
  </tendon>
  <actuator>
    <position name="b" class="leg" joint="knee" ctrlrange="-30 30"/>
    <general name="c" joint="hip" gainprm="3" biastype="affine" biasprm="1 -2 -3"/>
    <motor name="a" tendon="both" gear="2"/>
    <motor joint="x" gear="40" ctrlrange="-1 1"/>
  </actuator>
  <sensor><accelerometer site="upper" name="acc"/><framepos objtype="body" objname="head"/>
    <jointpos joint="turn"/></sensor>
  <keyframe><key name="home" qpos="0.1 0.2 0.3 0.4 1 0 0 0 0 0 0 1 0 1 1 0 0 0"/></keyframe>
</mujoco>
"""
FINGER = """\
<mujoco model="finger">
  <worldbody>
    <body name="tip"><joint name="bend" axis="0 1 0"/>
      <geom type="box" size="0.02 0.02 0.05" mass="0.1"/><site name="pad" pos="0 0 0.05"/></body>
  </worldbody>
</mujoco>
"""


def test_mjcf_that_is_read_is_written_as_the_same_model(tmp_path: Path) -> None:
    require_module("mujoco")
    from tests.targets.same_mjcf import Comparison

    (tmp_path / "finger.xml").write_text(FINGER)
    for name, text in {"by_hand": BY_HAND, "scene": SCENE}.items():
        source, out = tmp_path / f"{name}.xml", tmp_path / f"{name}_made.xml"
        source.write_text(text)
        out.write_text(yamaro.build(source, target="mjcf").xml())
        comparison = Comparison(str(source), str(out))
        assert comparison.found == {}
        unlike = comparison.fields.keys() - {"body quat", "joint pos", "joint range"}
        assert not unlike, comparison.fields
        actuators = [each for each in comparison.first.names["actuator"] if each]
        assert [each for each in comparison.second.names["actuator"] if each in actuators] == (
            actuators
        )


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ('gear="20"', 'gear="20.0001"', "qfrc_actuator"),
        ('mass="0.5"', 'mass="0.5000001"', "mass matrix"),
        ('springref="0.1"', 'springref="0.1001"', "qfrc_passive"),
        ('name="tool" pos="0.1 0 0"', 'name="tool" pos="0.1 0 0.001"', "site poses"),
        ('name="angle" joint="arm_joint"', 'name="angle" joint="slide"', "sensors"),
    ],
)
def test_models_that_differ_a_little_are_told_apart(
    tmp_path: Path, old: str, new: str, what: str
) -> None:
    require_module("mujoco")
    from tests.targets.same_mjcf import Comparison

    first, second = tmp_path / "first.xml", tmp_path / "second.xml"
    first.write_text(BY_HAND)
    assert old in BY_HAND
    second.write_text(BY_HAND.replace(old, new))
    assert what in Comparison(str(first), str(second)).found


def test_sensors_of_joints_are_told_where_urdf_is_written(tmp_path: Path) -> None:
    source = tmp_path / "by_hand.xml"
    source.write_text(BY_HAND)
    losses = yamaro.build(source, target="urdf").losses
    places = {line: number for number, line in enumerate(BY_HAND.splitlines(), start=1)}
    (sensor,) = [number for line, number in places.items() if "<jointpos" in line]
    assert sensor in {each.span.location()[0] for each in losses}
