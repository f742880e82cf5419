"""MJCF as YAML: words, blocks, functions for what repeats; the same robot again."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import pi
from pathlib import Path

import numpy as np
import pytest

import yamaro
from tests.tools.migrate.migrating import assert_in_style
from yamaro.codes import ADJUSTABLE
from yamaro.commands.main import main
from yamaro.files.loader import FileLoader
from yamaro.policy import Policy
from yamaro.request import read_main
from yamaro.runtime.files import Library, rules_of
from yamaro.source import Source, Span
from yamaro.tools.migrate.comparing import compare_notes
from yamaro.tools.migrate.robots import Builder, RobotMigration, migrate_lowered, migrate_robot
from yamaro.xml.reader import XmlDocument
from yamaro.xml.tree import Element, RobotNote, Text

DOG = """<!-- A small dog. -->
<mujoco model="dog">
  <compiler angle="degree" autolimits="true"/>
  <option timestep="0.004"/>
  <default>
    <default class="dog">
      <geom friction="0.6" condim="3" group="3"/>
      <default class="swing">
        <joint axis="0 1 0" damping="0.6" armature="0.01" range="-45 100"/>
      </default>
      <default class="foot">
        <geom type="sphere" size="0.02" priority="1" condim="6"/>
      </default>
    </default>
  </default>
  <worldbody>
    <body name="trunk" pos="0 0 0.4" childclass="dog">
      <freejoint/>
      <geom name="hull" type="box" size="0.2 0.1 0.05" density="500"/>
      <site name="imu" pos="0 0 0.05" size="0.01"/>
      <!-- The legs differ in their signs. -->
      <body name="FL_thigh" pos="0.2 0.1 0">
        <joint name="FL_thigh_joint" class="swing"/>
        <geom name="FL_bone" type="capsule" size="0.02 0.1" pos="0 0.01 -0.1"/>
        <body name="FL_shin" pos="0 0.02 -0.2">
          <joint name="FL_shin_joint" class="swing" range="-120 -30"/>
          <geom name="FL_foot" class="foot" pos="0 0 -0.2"/>
        </body>
      </body>
      <body name="FR_thigh" pos="0.2 -0.1 0">
        <joint name="FR_thigh_joint" class="swing"/>
        <geom name="FR_bone" type="capsule" size="0.02 0.1" pos="0 -0.01 -0.1"/>
        <body name="FR_shin" pos="0 -0.02 -0.2">
          <joint name="FR_shin_joint" class="swing" range="-120 -30"/>
          <geom name="FR_foot" class="foot" pos="0 0 -0.2"/>
        </body>
      </body>
      <body name="RL_thigh" pos="-0.2 0.1 0">
        <joint name="RL_thigh_joint" class="swing"/>
        <geom name="RL_bone" type="capsule" size="0.02 0.1" pos="0 0.01 -0.1"/>
        <body name="RL_shin" pos="0 0.02 -0.2">
          <joint name="RL_shin_joint" class="swing" range="-120 -30"/>
          <geom name="RL_foot" class="foot" pos="0 0 -0.2"/>
        </body>
      </body>
      <body name="neck" pos="0.2 0 0.05">
        <joint name="neck_joint" class="swing" range="-10 10"/>
        <geom name="head" type="sphere" size="0.05" pos="0.1 0 0"/>
      </body>
      <body name="tail" pos="-0.2 0 0.05">
        <joint name="tail_joint" class="swing"/>
        <geom name="tip" type="box" size="0.05 0.01 0.01" pos="-0.1 0 0"/>
      </body>
    </body>
  </worldbody>
  <sensor>
    <gyro name="turning" site="imu"/>
  </sensor>
  <keyframe>
    <key name="home" qpos="0 0 0.4 1 0 0 0 0 -1 0 -1 0 -1 0.1 0"/>
  </keyframe>
</mujoco>
"""


def migration_of(path: Path, folder: Path | None = None) -> RobotMigration:
    policy = Policy()
    source = read_main(str(path), None, Library(FileLoader(policy.limits, None), rules_of(policy)))
    builder = Builder("mjcf", str(folder or path.parent))
    return migrate_robot(source, builder, policy=policy, building=policy)


@pytest.fixture
def dog(tmp_path: Path) -> Path:
    path = tmp_path / "dog.xml"
    path.write_text(DOG)
    return path


# --- what is written ------------------------------------------------------------------------------


def test_limbs_become_a_function_and_classes_another(dog: Path) -> None:
    text = migration_of(dog).text
    assert "  SwingJoint(lower, upper):\n    type: revolute\n" in text
    assert "  Leg(leg, front, left):\n" in text
    calls = re.findall(r"- Leg: \{(.*)\}", text)
    assert calls == ["leg: FL, front: 1, left: 1", "leg: FR, front: 1, left: -1",
                     "leg: RL, front: -1, left: 1"]  # fmt: skip
    assert "xyz: $(0.2 * front) $(0.1 * left) 0\n" in text
    assert "        SwingJoint: -45deg, 100deg\n" in text
    assert "      name: $(leg)_thigh\n" in text
    assert_in_style("dog.yaml", text)


def test_masses_angles_and_settings_read_well(dog: Path) -> None:
    text = migration_of(dog).text
    assert text.startswith("# A small dog.\nnaming: {link: '*'}\nbase: free\n")
    assert "\nrobot/name=dog, version=1.1:\n" in text  # which has capsules
    assert "\nstates:\n  home: {\n      FL_thigh: 0, FL_shin: -1, " in text
    assert "frame/name=imu: {xyz: 0 0 0.05, mjcf: {size: 0.01}}\n" in text
    assert "density: 1000\n" in text
    assert "# The legs differ in their signs.\n- Leg: {leg: FL" in text
    assert "priority: 1" in text
    assert "<" not in text.replace("<<", "")


def test_what_the_words_make_is_what_was_read(dog: Path) -> None:
    migration = migration_of(dog)
    assert migration.differences == []
    made = yamaro.build(str(dog.with_suffix(".yaml")), text=migration.text, target="mjcf").xml()
    own = yamaro.build(str(dog), target="mjcf").xml()
    mujoco = pytest.importorskip("mujoco")
    one, other = (mujoco.MjModel.from_xml_string(xml) for xml in (own, made))
    assert (one.nq, one.nv, one.nu, one.nsensor) == (other.nq, other.nv, other.nu, other.nsensor)
    fields = "body_mass body_inertia body_pos jnt_range dof_damping dof_armature geom_friction"
    for field in (*fields.split(), "geom_condim", "geom_priority", "key_qpos"):
        assert getattr(one, field) == pytest.approx(getattr(other, field), abs=1e-12), field


def test_limbs_that_differ_in_much_are_written_out(tmp_path: Path) -> None:
    path = tmp_path / "odd.xml"
    path.write_text(
        '<mujoco><worldbody><body name="a"><geom size="0.1"/>'
        '<body name="left" pos="1 2 3"><joint name="j"/><geom size="0.2"/></body>'
        '<body name="right"><joint name="k" axis="1 0 0"/><geom type="box" size="1 2 3"/></body>'
        "</body></worldbody></mujoco>"
    )
    migration = migration_of(path)
    assert migration.differences == []
    assert "functions" not in migration.text


def test_names_that_are_no_words_are_attributes(tmp_path: Path) -> None:
    path = tmp_path / "odd.xml"
    path.write_text(
        '<mujoco><worldbody><body name="the base"><geom size="0.1"/>'
        '<body name="an arm"><joint name="a, b"/><geom size="0.2"/></body>'
        "</body></worldbody></mujoco>"
    )
    migration = migration_of(path)
    assert migration.differences == []
    assert "link/name=an arm" in migration.text


def test_files_are_found_from_where_the_yaml_is(dog: Path, tmp_path: Path) -> None:
    (tmp_path / "assets").mkdir()
    cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
    (tmp_path / "assets" / "cube.obj").write_text(cube)
    dog.write_text(
        '<mujoco><compiler meshdir="assets"/><asset><mesh name="m" file="cube.obj"/></asset>'
        '<worldbody><body name="a"><geom type="mesh" mesh="m"/></body></worldbody></mujoco>'
    )
    other = tmp_path / "elsewhere" / "deep"
    other.mkdir(parents=True)
    assert "assets/cube.obj" in migration_of(dog).text
    moved = migration_of(dog, other)
    assert moved.differences == []
    assert "../../assets/cube.obj" in moved.text
    meshes = "".join(f'<mesh name="{each}" file="cube.obj"/>' for each in "nop")
    geoms = "".join(f'<geom type="mesh" mesh="{each}"/>' for each in "nop")
    png = 'type="2d" file="a.png"/><material name="t" texture="t"/>'
    sky = '<texture name="sky" type="skybox" file="sky.png"/>'
    text = dog.read_text().replace("</asset>", f'{meshes}<texture name="t" {png}{sky}</asset>')
    text = text.replace('meshdir="assets"', 'assetdir="assets"')
    dog.write_text(text.replace("</body>", f'{geoms}<geom size="1" material="t"/></body>'))
    shared = migration_of(dog, other)
    assert shared.differences == []
    assert shared.text.count("../../assets") == 1
    for file in ("cube.obj", "a.png", "sky.png"):
        assert f"$(meshes)/{file}" in shared.text


def test_angles_that_a_mirror_takes_from_half_a_turn_are_one_number(tmp_path: Path) -> None:
    """A principal axis of inertia at roll r in one limb is at π - r in its mirror image."""
    limb = (
        '<body name="{0}_arm" pos="0 {1} 0"><joint name="{0}_joint" range="{2}"/>'
        '<inertial pos="0 {1} 0" mass="1" diaginertia="3 2 2.5" euler="{3} 0 0"/>'
        '<geom name="{0}_a" size="0.1" pos="1 {1} 0"/><geom name="{0}_b" size="0.2"/></body>'
    )
    path = tmp_path / "twins.xml"
    limbs = limb.format("left", "0.5", "-1 2", 0.7) + limb.format("right", "-0.5", "-2 1", pi - 0.7)
    path.write_text(
        '<mujoco><compiler angle="radian"/><worldbody><body name="trunk"><freejoint/>'
        f'<geom size="0.3"/>{limbs}</body></worldbody></mujoco>'
    )
    migration = migration_of(path)
    assert migration.differences == []
    assert "rpy: $(pi / 2 - 0.870796326794897 * left) 0 0" in migration.text
    assert "- Arm: {side: left, left: 1, lower: -1, upper: 2}" in migration.text


# --- the command ----------------------------------------------------------------------------------


def test_the_command_writes_and_counts(dog: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = dog.with_suffix(".yaml")
    assert main(["migrate", str(dog), "-o", str(made)]) == 0
    assert capsys.readouterr().err == f"{dog}: identical: 10 links, 9 joints, 1 state\n"
    assert main(["migrate", str(dog), "-o", f"{dog.parent}/out/", "--safe"]) == 0
    assert (dog.parent / "out" / "dog.yaml").read_text() == made.read_text()


def test_an_argument_is_wrong_usage(dog: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["migrate", str(dog), "n:=1"]) == 2
    assert "an MJCF has no argument to set: 'n:=1'" in capsys.readouterr().err


def test_safe_mode_reads_nothing_outside(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    inner = tmp_path / "inner"
    inner.mkdir()
    (tmp_path / "secret.xml").write_text("<mujoco><worldbody/></mujoco>")
    path = inner / "a.xml"
    path.write_text('<mujoco><include file="../secret.xml"/></mujoco>')
    assert main(["migrate", str(path), "--safe"]) == 1
    assert "secret" not in capsys.readouterr().out


def test_errors_of_the_file_are_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.xml"
    path.write_text('<mujoco><worldbody><body><geom size="none"/></body></worldbody></mujoco>')
    assert main(["migrate", str(path)]) == 1
    assert f"{path}:1:" in capsys.readouterr().err


# --- words of the language ------------------------------------------------------------------------

WORDS = """
robot: cell
base: free
model:
- part:
    name: base
    link:
      geometry: box
      size: 0.4 0.3 0.1
      mass: 3
      visual:
      collision: {surface: {friction: 0.8, stiffness: 1000}}
      collision/name=pad: {xyz: 0 0 1, mjcf: {condim: 6}}
      sensor/name=eye: {type: camera, xyz: 0.1 0 0, rate: 30 Hz, fov: 90deg}
      sensor/name=inner: {type: imu, frame: tip, noise: 0.1}
      frame/name=tip: {xyz: 0 0 0.2, rpy: 0 90deg 0}
      frame/name=pin: {xyz: 0.3 0 0}
- part:
    name: arm
    joint:
      type: revolute
      parent: base
      axis: y
      limit: {lower: -90deg, upper: 90deg, effort: 10, velocity: 180deg/s}
      actuator: {kp: 50, kd: 2, delay: 5 ms, motor: {rotor_inertia: 3e-6, gear: 100}}
      sensor/name=wrist: {type: force_torque}
      mjcf: {solreflimit: 0.02 1}
    link:
      geometry: sphere
      radius: 0.1
      mass: 1
      collision:
      frame/name=end: {xyz: 0.3 0 0}
- loop: {name: bar, type: revolute, between: [end, pin], axis: y}
- mjcf:
    option/cone=elliptic:
states: {home: {arm: 45deg}, up: {arm: 0}}
groups: {arm: {chain: [base_link, end]}, hand: {links: [arm_link], parent: end, end_effector: true}}
collisions: {samples: 100, keep: [[base_link, arm_link]]}
"""


def test_all_words_come_out_as_words(tmp_path: Path) -> None:
    policy = Policy()
    builder = Builder("mjcf", str(tmp_path))
    robot = builder.build("cell", WORDS, policy)
    nothing = XmlDocument(robot.root, [], [])
    migration = migrate_lowered(
        robot, nothing, builder, home=str(tmp_path), stem="made", policy=policy
    )
    assert migration.differences == []
    assert migration.counts == {"actuator": 1, "sensor": 3, "state": 2, "loop": 1}
    for line in (
        "sensor/name=eye: {type: camera, xyz: 0.1 0 0, rate: 30 Hz, fov: 90deg}",
        "sensor/name=inner: {type: imu, frame: tip, noise: 0.1}",
        "actuator: {kp: 50, kd: 2, rotor_inertia: 3e-6, gear: 100, delay: 5 ms}",
        "limit: {lower: -90deg, upper: 90deg, effort: 10, velocity: 180deg/s}",
        "- loop: {name: bar, type: revolute, between: [end, pin], axis: 0 1 0}",
        "home: {arm: 45deg}",
        "frame/name=tip: {xyz: 0 0 0.2, rpy: 0 90deg 0}",
    ):
        assert line in migration.text, line


# --- the comparison -------------------------------------------------------------------------------

SPAN = Span(Source("", name="a.yaml", path=""), 0, 0)


def note(kind: str, *children: Element, **values: str) -> RobotNote:
    return RobotNote(kind, SPAN, dict(values), [*children])


def setting(name: str, value: str) -> Element:
    return Element(name, SPAN, {}, [Text(value, SPAN)])


def told(first: Sequence[Element], second: Sequence[Element]) -> list[str]:
    ends = [Element("parent", SPAN, {"link": "l"}), Element("child", SPAN, {"link": "tip"})]
    joint = Element("joint", SPAN, {"name": "tip_joint", "type": "fixed"}, [*ends])
    root = Element("robot", SPAN, {"name": "a"}, [joint])
    return [str(each) for each in compare_notes((root, first), (root, second))]


def test_notes_are_compared_by_what_they_are_about() -> None:
    drive = note("actuator", joint="j", command="position", kp="1")
    assert told([drive], [note("actuator", joint="j", command="position", kp="2")]) == [
        "actuator of joint 'j': 'kp' is '2', not '1'"
    ]
    assert told([drive], []) == ["actuator of joint 'j': is missing"]
    assert told([], [drive]) == ["actuator of joint 'j': should not be there"]
    other = note("actuator", joint="k", command="position")
    assert told([drive, other], [other, drive]) == ["actuators: are in another order"]
    rows = [Element("position", SPAN, {"joint": name}) for name in "jk"]
    said = note("raw-block", Element("actuator", SPAN, {}, [*rows]), format="mjcf")
    assert told([drive, other], [other, drive, said]) == []


def test_the_order_of_sensors_and_states_is_compared() -> None:
    one, other = note("sensor", name="a", type="imu"), note("sensor", name="b", type="imu")
    assert told([one, other], [other, one]) == ["sensors: are in another order"]
    own = [note("sensor", name=name, type="imu", of="mjcf") for name in "ab"]
    assert told(own, [other, one]) == []  # their block has their order


def test_blocks_of_one_thing_are_compared_as_one() -> None:
    whole = note("raw-block", setting("a", "1"), setting("b", "2"), format="mjcf", link="l")
    halves = [
        note("raw-block", setting("b", "2"), format="mjcf", link="l"),
        note("raw-block", setting("a", "1"), format="mjcf", link="l"),
    ]
    assert told([whole], halves) == []
    assert "mjcf of link 'l', b: is missing" in told([whole], halves[1:])


def test_a_block_about_a_site_is_one_of_its_frame() -> None:
    site = Element("site", SPAN, {"name": "tip", "size": "0.1"})
    about = note("raw-block", site, format="mjcf", link="l")
    own = note("raw-block", setting("size", "0.1"), format="mjcf", link="tip")
    assert told([about], [own]) == []
    assert told([about], [note("raw-block", setting("size", "1"), format="mjcf", link="tip")]) == [
        "mjcf of link 'tip', size: its text is '1', not '0.1'"
    ]


# --- SDF ------------------------------------------------------------------------------------------

CART = """<sdf version="1.9">
  <model name="cart">
    <link name="base">
      <inertial><mass>2</mass></inertial>
      <visual name="hull">
        <geometry><box><size>1 0.5 0.2</size></box></geometry>
        <transparency>0.5</transparency>
      </visual>
      <collision name="hull">
        <geometry><box><size>1 0.5 0.2</size></box></geometry>
        <surface><contact><collide_bitmask>3</collide_bitmask></contact></surface>
      </collision>
      <sensor name="gauge" type="air_pressure"><update_rate>5</update_rate></sensor>
    </link>
    <link name="wheel">
      <pose relative_to="axle"/>
      <inertial><mass>1</mass></inertial>
      <visual name="tire">
        <geometry><sphere><radius>0.1</radius></sphere></geometry>
        <transparency>0.5</transparency>
      </visual>
    </link>
    <joint name="axle" type="revolute">
      <pose relative_to="base">0 0.3 0 0 0 0</pose>
      <parent>base</parent>
      <child>wheel</child>
      <axis><xyz>0 1 0</xyz><dynamics><damping>0.1</damping></dynamics></axis>
    </joint>
    <plugin name="drive" filename="drive.so"><wheel>axle</wheel></plugin>
  </model>
</sdf>
"""


def test_sdf_becomes_parts_with_blocks_at_their_shapes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "cart.sdf"
    path.write_text(CART)
    made = tmp_path / "cart.yaml"
    assert main(["migrate", str(path), "-o", str(made)]) == 0
    assert capsys.readouterr().err.startswith(f"{path}: identical: 2 links, 1 joint")
    text = made.read_text()
    assert "sdf: {transparency: 0.5}" in text
    assert "collide_bitmask: 3" in text
    assert "plugin/name=drive, filename=drive.so: {wheel: axle}" in text
    assert "dynamics: {damping: 0.1}" in text
    own, again = (
        yamaro.build(str(each), target="sdf", allow=ADJUSTABLE, on_message=print).xml()
        for each in (path, made)
    )
    assert again == own


def test_words_in_names_of_files_are_parameters(tmp_path: Path) -> None:
    limb = (
        '<body name="{0}_leg"><joint name="{0}_hip" range="-1 1"/>'
        '<geom name="{0}_thigh" size="0.1" density="2"/><geom name="{0}_shin" size="0.2"/>'
        '<site name="{1}"/><site name="{2}_sole"/><site name="{2}_toe" pos="1 2 3"/></body>'
    )
    limbs = [("fl", "FL", "left"), ("fr", "FR", "right")]
    path = tmp_path / "twins.xml"
    path.write_text(
        '<mujoco><worldbody><body name="trunk"><freejoint/><geom size="0.3"/>'
        + "".join(limb.format(*each) for each in limbs)
        + "</body></worldbody></mujoco>"
    )
    migration = migration_of(path)
    assert migration.differences == []
    assert "frame/name=$(side.upper()):" in migration.text
    assert "frame/name=$(side_2)_toe: {xyz: 1 2 3}" in migration.text
    assert "- Leg: {side: fl, side_2: left}" in migration.text


def test_a_site_of_the_name_of_its_body_stays_apart_from_it(tmp_path: Path) -> None:
    path = tmp_path / "one.xml"
    path.write_text(
        '<mujoco><worldbody><body name="arm"><geom size="0.1"/><freejoint/>'
        '<site name="arm" size="0.3" group="2"/></body></worldbody></mujoco>'
    )
    migration = migration_of(path)
    assert migration.differences == []
    made = yamaro.build(str(tmp_path / "one.yaml"), text=migration.text, target="mjcf").xml()
    assert made == yamaro.build(str(path), target="mjcf").xml()


def test_a_site_of_the_world_with_the_name_of_a_body_keeps_its_settings(tmp_path: Path) -> None:
    path = tmp_path / "one.xml"
    path.write_text(
        '<mujoco><worldbody><site name="arm" size="0.3"/><geom size="0.1"/>'
        '<body name="arm"><joint type="ball"/><geom size="0.1"/></body></worldbody></mujoco>'
    )
    migration = migration_of(path)
    assert migration.differences == []
    assert "mjcf: {name: arm, size: 0.3}" in migration.text


def test_bodies_that_mujoco_makes_of_a_flex_come_after_those_before_it(tmp_path: Path) -> None:
    path = tmp_path / "cloth.xml"
    path.write_text(
        """<mujoco><worldbody>
        <body name="hand" pos="0 0 1"><joint name="lift" type="slide"/><geom size="0.1"/></body>
        <flexcomp name="cloth" type="grid" dim="2" count="3 3 1" spacing="0.1 0.1 0.1"/>
        </worldbody></mujoco>"""
    )
    assert main(["migrate", str(path), "-o", str(tmp_path / "cloth.yaml"), "-q"]) == 0
    document = yamaro.build(str(tmp_path / "cloth.yaml"), target="mjcf").xml()
    judge = pytest.importorskip("mujoco").MjModel
    models = [judge.from_xml_path(str(path)), judge.from_xml_string(document)]
    first, second = ([model.body(i).name for i in range(model.nbody)] for model in models)
    assert first == second
    assert first[1] == "hand" and len(first) == 11


def test_quaternions_stay_where_angles_would_be_long(tmp_path: Path) -> None:
    path = tmp_path / "one.xml"
    (tmp_path / "a.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    )
    path.write_text(
        '<mujoco><asset><mesh name="a" file="a.obj" scale="0.001 0.001 0.001"/></asset>'
        '<worldbody><body name="arm"><geom type="mesh" mesh="a" mass="1"/>'
        '<site name="odd" quat="0.9 0.1 -0.2 0.3"/><site name="turned" quat="0 0 1 0"/>'
        '<body name="hand" pos="0 0 1" quat="0.7 0.7 0.1 0"><joint name="j"/><geom size="0.1"/>'
        '<site name="plain" euler="0 90 0"/></body></body></worldbody></mujoco>'
    )
    migration = migration_of(path)
    assert migration.differences == []
    for line in (
        "frame/name=odd: {quat: 0.9 0.1 -0.2 0.3}",
        "frame/name=turned: {rpy: 0 180deg 0}",
        "frame/name=plain: {rpy: 0 90deg 0}",
        "quat: 0.7 0.7 0.1 0",
        "scale: 1mm",
    ):
        assert line in migration.text


HAND = """<mujoco model="hand">
  <compiler angle="radian"/>
  <default>
    <!-- Tendons are stiff. -->
    <default class="flexor">
      <joint axis="0 1 0" damping="0.05" armature="0.0002" range="0 1.5708"/>
      <general biastype="affine" gainprm="35" biasprm="0 -35 -0.65" ctrlrange="-2 2"
        forcerange="-18 18"/>
    </default>
  </default>
  <worldbody>
    <body name="wall">
      <inertial pos="0 0 0" mass="0" diaginertia="0 0 0"/>
      <body name="palm" pos="0 0 0.1">
        <geom type="box" size="0.04 0.02 0.04" contype="0" conaffinity="0" friction="0.3"/>
        <geom type="box" size="0.03 0.02 0.03" group="3" rgba="1 0 0 1"/>
        <geom type="sphere" size="0.02" pos="0 0 0.04" euler="0 2.5 0"/>
        <site name="imu"/>
        <camera name="eye" pos="0.01 0.02 0.03" euler="0 -1.5 0" resolution="640 480"/>
        FINGERS
        <body name="thumb" pos="0.03 0 0">
          <joint name="T3" class="flexor"/>
          <geom type="box" size="0.02 0.01 0.01" group="3"/>
          <body name="tip" pos="0.03 0 0">
            <joint name="T2" class="flexor"/>
            <geom type="sphere" size="0.015" group="3"/>
            <body name="nail" pos="0.01 0 0">
              <joint name="T1" class="flexor" range="0 0.1"/>
              <geom type="cylinder" size="0.01 0.001" group="3"/>
            </body>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <general name="m" class="flexor" joint="MFJ2"/>
    <general name="f" class="flexor" joint="FFJ2"/>
    <general name="r" class="flexor" joint="RFJ2"/>
  </actuator>
  <sensor>
    <gyro name="turning" site="imu" noise="0.01"/>
    <accelerometer name="falling" site="imu" noise="0.2"/>
  </sensor>
</mujoco>
"""
FINGER = """<body name="{low}fknuckle" pos="{x} 0 0.05">
          <joint name="{high}FJ2" class="flexor"/>
          <geom type="capsule" size="0.008 0.02" pos="0 0 0.02" group="3"/>
          <geom type="sphere" size="0.01" contype="0" conaffinity="0" rgba="0 0 1 1"/>
          <body name="{low}fdistal" pos="0 0 0.04">
            <joint name="{high}FJ1" class="flexor" range="0 1.2"/>
            <geom type="capsule" size="0.008 0.015" pos="0 0 0.015" group="3"/>
          </body>
        </body>"""


def test_a_hand_reads_as_its_maker_would_write_it(tmp_path: Path) -> None:
    fingers = [("f", 0.033), ("m", 0.011), ("r", -0.011)]
    inner = [FINGER.format(low=low, high=low.upper(), x=x) for low, x in fingers]
    path = tmp_path / "hand.xml"
    path.write_text(HAND.replace("FINGERS", "\n".join(inner)))
    migration = migration_of(path)
    assert migration.differences == [] and migration.lost_comments == 0
    text = migration.text
    assert "  # Tendons are stiff.\n  FlexorJoint(" in text
    assert "  Finger(finger, xyz, knuckle_name):\n" in text
    assert "name: $(finger.upper())J2 $(finger)knuckle\n" in text
    assert "- Finger: {finger: mf, xyz: 0.011 0 0.05, knuckle_name: m}\n" in text
    assert "color: 0 0 1 1" in text and "_color" not in text
    assert "noise: {linear_acceleration: 0.2, angular_velocity: 0.01}" in text
    assert "inertial/mass=0, diaginertia=0 0 0, pos=0 0 0:" in text
    # Only a geom that is seen and collides gets a name; friction of one that is seen means nothing.
    assert re.findall(r"(?:visual|collision)/name=(\w+)", text) == ["palm_geom_2"] * 2
    assert "friction" not in text and "actuatorfrclimited" not in text
    assert_in_style("hand.yaml", text)
    pytest.importorskip("mujoco")
    from tests.targets.same_mjcf import Comparison

    made = tmp_path / "made.xml"
    made.write_text(yamaro.build(str(path.with_suffix(".yaml")), text=text, target="mjcf").xml())
    assert Comparison(str(path), str(made)).found == {}


KEYS = """<mujoco model="arm"><worldbody><body name="base"><geom size="0.1"/>
  <body name="upper"><joint name="a" range="-1 1"/><geom size="0.1"/>
    <body name="fore"><joint name="b" type="ball"/><geom size="0.1"/></body>
    <body name="slider"><joint name="c" type="slide"/><geom size="0.1"/></body></body></body>
  </worldbody>
  <actuator><position name="pa" joint="a" kp="3"/><position joint="c" kp="3"/></actuator>
  <keyframe>
    <key name="home" qpos="0.01 1 0 0 0 0.2"/>
    <key name="held" qpos="0.01 1 0 0 0 0.2" ctrl="0.01 0.2"/>
    <key name="fast" time="2" qpos="0 0.8 0.6 0 0 0.2" qvel="1 2 3 4 5" ctrl="0.1 0"/>
  </keyframe></mujoco>"""


def test_keyframes_are_those_of_a_robot_that_is_attached_twice(tmp_path: Path) -> None:
    mujoco = pytest.importorskip("mujoco")
    path = tmp_path / "arm.xml"
    path.write_text(KEYS)
    migration = migration_of(path)
    assert migration.differences == []
    (tmp_path / "arm.yaml").write_text(migration.text)
    (tmp_path / "pair.yaml").write_text(
        "robot: pair\nbase: fixed\nmodel:\n- link/name=table:\n"
        "- attach: {path: arm.yaml, to: table, prefix: l_}\n"
        "- attach: {path: arm.yaml, to: table, prefix: r_}\n"
    )
    build = yamaro.build(tmp_path / "pair.yaml", target="mjcf")
    assert not [each.what for each in build.losses if "key" in each.what]
    pair, arm = (mujoco.MjModel.from_xml_string(each) for each in (build.xml(), KEYS))
    names = [pair.actuator(at).name for at in range(pair.nu)]
    for key in ("home", "held", "fast"):
        own, both = arm.key(key), pair.key(key)
        np.testing.assert_allclose(both.qpos, np.tile(own.qpos, 2), atol=1e-12)
        np.testing.assert_allclose(both.qvel, np.tile(own.qvel, 2), atol=1e-12)
        for side in ("l_", "r_"):
            mine = [name.startswith(side) for name in names]
            np.testing.assert_allclose(both.ctrl[mine], own.ctrl, atol=1e-12)
