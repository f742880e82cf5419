"""What else of MJCF is read, and what is wrong in it; MuJoCo says what is right."""

from __future__ import annotations

from math import atan, degrees, pi, radians
from pathlib import Path

import pytest

import yamaro
from tests.consumers import oracles
from tests.sources.mjcf.compiled import assert_same, robot_of
from yamaro import Robot, YamaroError
from yamaro.model.extras import Camera, Ranger

MESHES = """
<mujoco>
  <compiler {compiler}/>
  <asset>
    <mesh name="m" vertex="{vertex}" scale="{scale}" {mesh}/>
  </asset>
  <worldbody>
    <body name="b" pos="0 0 1">
      <joint name="j"/>
      <geom {geom} mesh="m" pos="0.1 0.2 0.3" euler="10 20 30"/>
      {more}
    </body>
  </worldbody>
</mujoco>
"""
VERTEX = "0 0 0  1 0 0  0 0.7 0  0 0 0.4  0.5 0.5 0.5  0.2 0.9 0.1"
SHAPES = "sphere capsule cylinder ellipsoid box".split()


def saved(folder: Path, text: str, name: str = "robot.xml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def meshes(folder: Path, **parts: str) -> Path:
    usual = {
        "compiler": "", "vertex": VERTEX, "scale": "1 1 1", "mesh": "", "geom": 'type="mesh"',
        "more": "",
    }  # fmt: skip
    return saved(folder, MESHES.format(**{**usual, **parts}))


@pytest.mark.parametrize("inertia", ["legacy", "exact", "convex", "shell"])
@pytest.mark.parametrize(
    "parts",
    [
        {},
        {"scale": "0.1 0.2 -0.3"},
        {"mesh": 'refpos="0.1 0.2 0.3" refquat="0.5 0.1 0.2 0.3"', "scale": "2 2 2"},
        {"geom": 'type="mesh" mass="3"'},
        {"geom": 'type="mesh" density="7"', "more": '<geom size="0.1"/>'},
    ],
)
def test_a_mesh_has_the_mass_that_mujoco_gives_it(inertia: str, parts, tmp_path) -> None:
    mesh = f'inertia="{inertia}" {parts.get("mesh", "")}'
    assert_same(meshes(tmp_path, **{**parts, "mesh": mesh}))


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("compiler", ["", 'fitaabb="true"'])
def test_shapes_are_fitted_to_a_mesh(shape: str, compiler: str, tmp_path) -> None:
    geom = f'type="{shape}" fitscale="1.5"'
    assert_same(meshes(tmp_path, compiler=compiler, geom=geom))


@pytest.mark.parametrize("shape", SHAPES)
def test_shells_have_their_mass_on_the_surface(shape: str, tmp_path) -> None:
    text = f"""
<mujoco><worldbody><body name="b">
  <geom type="{shape}" size="0.1 0.2 0.3" shellinertia="true"/>
  <geom type="{shape}" size="0.2 0.1 0.3" shellinertia="true" pos="0 1 0" euler="10 20 0"/>
</body></worldbody></mujoco>"""
    assert_same(saved(tmp_path, text))


def test_frames_and_copies_are_resolved(tmp_path) -> None:
    text = """
<mujoco>
  <compiler eulerseq="zyx"/>
  <worldbody>
    <frame name="f" pos="1 2 3" euler="10 20 30">
      <replicate count="3" offset="0.1 0.2 0" euler="0 0 20" sep="-">
        <body name="leg" pos="0 0 1">
          <joint name="knee" axis="1 0 0" pos="0 0 0.1"/>
          <geom type="box" size="0.1 0.2 0.3"/>
          <replicate count="2" offset="0 0 0.1" euler="0 10 0">
            <body name="toe" pos="1 0 0"><joint name="toe"/><geom size="0.1"/></body>
            <site name="tip"/>
          </replicate>
        </body>
      </replicate>
    </frame>
  </worldbody>
  <sensor><jointpos name="knee" joint="knee"/></sensor>
</mujoco>"""
    path = saved(tmp_path, text)
    assert_same(path)
    assert "toe1-2" in robot_of(path).links


def test_models_are_attached(tmp_path) -> None:
    saved(
        tmp_path,
        """
<mujoco model="hand">
  <compiler angle="radian"/>
  <default><geom density="300"/><joint range="-1 1"/></default>
  <worldbody>
    <body name="palm" pos="0.1 0 0" euler="0 0 0.3">
      <geom size="0.1"/>
      <body name="finger" pos="0 0.1 0"><joint name="finger"/><geom size="0.05"/></body>
    </body>
  </worldbody>
  <actuator><position name="close" joint="finger" kp="3"/></actuator>
</mujoco>""",
        "hand.xml",
    )
    path = saved(
        tmp_path,
        """
<mujoco model="arm">
  <asset><model name="hand" file="hand.xml"/></asset>
  <worldbody>
    <body name="base">
      <geom size="0.2"/>
      <frame pos="0 0 1" euler="90 0 0"><attach model="hand" prefix="left_"/></frame>
      <attach model="hand" body="finger" prefix="right_"/>
    </body>
  </worldbody>
</mujoco>""",
    )
    assert_same(path)
    robot = Robot.from_mjcf(path)
    assert [*robot.actuators] == ["left_finger", "right_finger"]
    assert robot.joints["left_finger"].upper == 1.0


def test_references_of_joints_are_part_of_their_origins(tmp_path) -> None:
    text = """
<mujoco><worldbody><body name="b"><geom size="0.1"/>
  <body name="c" pos="0 0 1" euler="10 0 0">
    <joint name="j" axis="0 1 1" ref="30" range="-90 90"/>
    <joint name="k" axis="1 0 0" type="slide" ref="0.2"/>
    <geom size="0.1"/>
  </body>
</body></worldbody></mujoco>"""
    path = saved(tmp_path, text)
    assert_same(path)
    assert robot_of(path).joints["j"].upper == pytest.approx(pi / 2, rel=1e-12)


ARM = """
<mujoco model="arm">
  <default>
    <joint armature="0.02" damping="0.5" frictionloss="0.1" range="-90 45"/>
    <position kp="100" kv="5" forcerange="-7 7"/>
    <default class="other"><position kp="50"/></default>
  </default>
  <worldbody>
    <body name="base"><geom size="0.1"/>
      <body name="a" pos="0 0 1"><joint name="a"/><geom size="0.1"/>
        <site name="imu" pos="0 0 0.1"/>
        <body name="b" pos="0 0 1"><joint name="b"/><geom size="0.1"/>
          <body name="c" pos="0 0 1"><joint name="c"/><geom size="0.1"/></body>
        </body>
      </body>
    </body>
  </worldbody>
  <equality><joint joint1="c" joint2="b" polycoef="0.1 -2 0 0 0"/></equality>
  <actuator>
    <position name="servo" joint="a" class="other" ctrlrange="-1 1"/>
    <motor name="torque" joint="b" gear="3" ctrlrange="-1 1"/>
  </actuator>
  <sensor>
    <gyro name="w" site="imu" noise="0.1"/>
    <accelerometer name="v" site="imu" noise="0.2"/>
    <force name="f" site="imu"/>
    <torque name="t" site="imu"/>
  </sensor>
  <keyframe><key name="home" qpos="0.1 0.2 0.3" ctrl="0.1 0"/></keyframe>
</mujoco>
"""


def test_of_two_coupled_joints_the_one_that_nothing_drives_follows(tmp_path) -> None:
    """q₁ = a + b·q₂ is also q₂ = −a/b + q₁/b."""
    turned = ARM.replace(
        'joint1="c" joint2="b" polycoef="0.1', 'joint1="b" joint2="c" polycoef="0.2'
    )
    robot = Robot.from_mjcf(saved(tmp_path, turned))
    assert robot.joints["b"].mimic is None
    mimic = robot.joints["c"].mimic
    assert mimic is not None
    assert (mimic.joint, mimic.multiplier) == ("b", -0.5)
    assert mimic.offset == pytest.approx(0.1)
    written = yamaro.build(tmp_path / "robot.xml", target="mjcf", on_message=print).xml()
    assert written.count("polycoef") == 1


def test_actuators_sensors_and_states_are_those_of_the_model(tmp_path) -> None:
    robot = Robot.from_mjcf(saved(tmp_path, ARM))
    servo, torque = robot.actuators["a"], robot.actuators["b"]
    assert (servo.command, servo.kp, servo.kd, servo.armature) == ("position", 50.0, 5.0, 0.02)
    assert torque.command == "effort"
    limit = robot.joints["a"].limit
    assert limit is not None
    assert (limit.lower, limit.upper) == pytest.approx((radians(-90), radians(45)), rel=1e-12)
    assert limit.effort == 7.0
    effort = robot.joints["b"].limit
    assert effort is not None
    assert effort.effort == 21.0  # the force times the gear
    mimic = robot.joints["c"].mimic
    assert mimic is not None
    assert (mimic.joint, mimic.multiplier, mimic.offset) == ("b", -2.0, 0.1)
    assert robot.sensors["imu"].noises == {"angular_velocity": 0.1, "linear_acceleration": 0.2}
    assert robot.sensors["imu_2"].type == "force_torque"
    assert robot.sensors["imu_2"].joint == "a"
    assert robot.states["home"].positions == {"a": 0.1, "b": 0.2}  # c follows b


def test_what_urdf_cannot_hold_is_reported_where_it_is_written(tmp_path) -> None:
    text = ARM.replace("</worldbody>", "</worldbody><option gravity='0 0 -1'/>")
    build = yamaro.build(str(saved(tmp_path, text)), target="urdf", on_message=lambda line: None)
    losses = {loss.what: loss.span.location()[0] for loss in build.losses}
    assert losses["MJCF's <option> elements"] == text[: text.index("<option")].count("\n") + 1
    assert not any("sensor" in what and "MJCF" in what for what in losses)


def test_other_formats_are_not_mjcf(tmp_path) -> None:
    path = saved(tmp_path, '<robot name="r"><link name="a"/></robot>')
    with pytest.raises(YamaroError, match="this is not MJCF"):
        Robot.from_mjcf(path)
    with pytest.raises(FileNotFoundError):
        Robot.from_mjcf(tmp_path / "nothing.xml")


BODY = '<mujoco><worldbody><body name="b">{}</body></worldbody>{}</mujoco>'


@pytest.mark.parametrize(
    ("inner", "after", "message"),
    [
        ('<geom size="x"/>', "", "'size' takes numbers, and 'x' is not one"),
        ('<geom size="1" solref="0.1 b"/>', "", "'solref' takes numbers, and 'b' is not one"),
        ('<geom size="1"/><joint stiffness="x"/>', "", "'stiffness' takes numbers"),
        ('<geom size="1"/><joint springref="x"/>', "", "'springref' takes numbers"),
        (
            '<geom size="1"/><joint name="j" armature="x"/>',
            '<actuator><motor joint="j"/></actuator>',
            "'armature' takes numbers, and 'x' is not one",
        ),
        ('<geom size="1"/><joint ref="1 2"/>', "", "'ref' takes 1 number, not 2"),
        ('<geom size="1e200"/>', "", "too large"),
        ('<geom size="1" type="bax"/>', "", "'bax' is none of them"),
        ('<geom type="mesh" mesh="m"/>', "", "there is no mesh 'm'"),
        ('<geom size="1" material="m"/>', "", "there is no material 'm'"),
        ('<geom size="1" fromto="0 0 0 0 0 1"/>', "", "takes no 'fromto'"),
        ('<geom size="1" quat="0 0 0 0"/>', "", "a quaternion has no length"),
        ('<geom size="1"/><joint axis="0 0 0"/>', "", "'axis' has no direction"),
        ('<geom size="1"/><joint range="1 -1"/>', "", "the first number of 'range' is less"),
        ('<inertial pos="0 0 0"/>', "", "has no mass"),
        ('<geom size="1"/><body name="b"/>', "", "two bodies named 'b'"),
        ('<geom size="1"/><body><freejoint/></body>', "", "child of the world"),
        ('<geom size="1"/>', '<actuator><motor joint="j"/></actuator>', "there is no joint 'j'"),
        ('<geom size="1"/>', "<compiler eulerseq='xy'/>", "not a sequence of three axes"),
        ('<replicate count="0"><geom size="1"/></replicate>', "", "whole number from 1"),
        (
            '<replicate count="1e9"><geom size="1"/></replicate>',
            "",
            "copies more than 200,000 elements",
        ),
        ('<attach model="m" prefix="p"/>', "", "there is no model 'm'"),
        ('<geom size="1"/>', "<default><default/></default>", "needs a name"),
        ("<gem/>", "", "MJCF has no <gem> in <body>"),
    ],
)
def test_faults_are_errors_at_their_place(inner: str, after: str, message: str, tmp_path) -> None:
    with pytest.raises(YamaroError) as found:
        yamaro.build(str(saved(tmp_path, BODY.format(inner, after))))
    first = found.value.diagnostics[0]
    assert message in first.message
    assert first.span.source.name.endswith("robot.xml")
    assert first.hint


def test_files_that_include_one_another_end(tmp_path) -> None:
    saved(tmp_path, '<mujocoinclude><include file="robot.xml"/></mujocoinclude>', "b.xml")
    path = saved(tmp_path, '<mujoco><include file="b.xml"/></mujoco>')
    with pytest.raises(YamaroError, match="a second time"):
        yamaro.build(str(path))


def test_models_that_attach_themselves_end(tmp_path) -> None:
    text = """
<mujoco model="m"><asset><model name="m" file="robot.xml"/></asset>
<worldbody><body name="b"><geom size="1"/><attach model="m" prefix="p_"/></body></worldbody>
</mujoco>"""
    with pytest.raises(YamaroError) as found:
        yamaro.build(str(saved(tmp_path, text)))
    assert found.value.diagnostics[0].code in ("too-deep", "limit-files")


def test_safe_mode_reads_nothing_outside_of_the_folder(tmp_path) -> None:
    (tmp_path / "inner").mkdir()
    saved(tmp_path, "<mujocoinclude/>", "secret.xml")
    text = '<mujoco><include file="../secret.xml"/></mujoco>'
    path = saved(tmp_path / "inner", text)
    with pytest.raises(YamaroError) as found:
        yamaro.build(str(path), policy=yamaro.Policy("safe"))
    assert found.value.diagnostics[0].code == "path-outside"


def test_copies_can_attach_models(tmp_path) -> None:
    hand = """
<mujoco model="hand"><worldbody>
  <body name="palm"><joint name="wrist"/><geom size="0.1"/></body>
</worldbody>
<sensor><jointpos name="angle" joint="wrist"/></sensor></mujoco>"""
    saved(tmp_path, hand, "hand.xml")
    text = """
<mujoco><asset><model file="hand.xml"/></asset><worldbody><body name="base"><geom size="0.2"/>
  <replicate count="2" offset="1 0 0" sep="-">
    <body name="arm"><joint name="arm"/><geom size="0.1"/>
      <attach model="hand" prefix="my_"/></body>
  </replicate>
</body></worldbody></mujoco>"""
    path = saved(tmp_path, text)
    assert_same(path)
    assert [*robot_of(path).joints] == ["arm-0", "my_wrist-0", "arm-1", "my_wrist-1"]


def test_cameras_and_distances_look_along_x(tmp_path) -> None:
    text = """
<mujoco><worldbody><body name="b"><geom size="0.1"/>
  <camera name="eye" pos="1 2 3" xyaxes="0 -1 0 0 0 1" fovy="90" resolution="640 320"/>
  <camera name="view" pos="1 2 3" mode="trackcom"/>
  <site name="front" zaxis="1 0 0"/>
</body></worldbody>
<sensor><rangefinder name="far" site="front" cutoff="7"/></sensor></mujoco>"""
    path = saved(tmp_path, text)
    robot = Robot.from_mjcf(path)
    assert [*robot.sensors] == ["eye", "far"]
    eye, far = robot.sensors["eye"], robot.sensors["far"]
    assert isinstance(eye.details, Camera)
    assert isinstance(far.details, Ranger)
    assert far.frame is not None
    # It looks along −z, which is the negative cross product of x and y: (1, 0, 0).
    assert eye.pose.apply((1, 0, 0)) == pytest.approx((2, 2, 3), abs=1e-12)
    assert eye.pose.apply((0, 0, 1)) == pytest.approx((1, 2, 4), abs=1e-12)
    assert eye.details.fov == pytest.approx(2 * atan(2), rel=1e-12)
    assert eye.details.size == (640, 320)
    frame = robot.poses({})[far.frame]
    assert (frame @ far.pose).apply((1, 0, 0)) == pytest.approx((1, 0, 0), abs=1e-12)
    assert far.details.range == (0.0, 7.0)


LENSES = {
    "metres": 'focal="0.005 0.005"',
    "pixels": 'focal="1 1" focalpixel="500 500"',
    "of a class": 'class="lens"',
    "oblong pixels": 'focal="0.005 0.006"',
    "off the middle": 'focal="0.005 0.005" principalpixel="10 0"',
}


def test_cameras_with_a_focal_length_see_what_they_see_in_mujoco(tmp_path) -> None:
    mujoco = oracles.require_module("mujoco")
    lens = 'resolution="640 480" sensorsize="0.0064 0.0048"'
    cameras = "".join(f'<camera name="{name}" {lens} {LENSES[name]}/>' for name in LENSES)
    text = (
        '<mujoco><default><default class="lens"><camera focal="0.007 0.007"/></default></default>'
        f'<worldbody><body name="b"><geom size="0.1"/>{cameras}</body></worldbody></mujoco>'
    )
    path = saved(tmp_path, text)
    assert_same(path)
    source = mujoco.MjModel.from_xml_path(str(path))
    robot = Robot.from_mjcf(path)
    for name in LENSES:
        camera, details = source.camera(name), robot.sensors[name].details
        assert isinstance(details, Camera)
        across = source.cam_sensorsize[camera.id][0] / 2 / source.cam_intrinsic[camera.id][0]
        assert details.fov == pytest.approx(2 * atan(across), rel=1e-6)  # of floats of 32 bits
        if name != "oblong pixels":  # one angle then says what is seen upwards as well
            up = 2 * atan(across * 480 / 640)
            assert camera.fovy[0] == pytest.approx(degrees(up), rel=1e-6)
    lost = yamaro.build(path, target="sdf", on_message=lambda line: None).losses
    assert {each.owner for each in lost} == {
        "'oblong pixels' in link 'b'", "'off the middle' in link 'b'"
    }  # fmt: skip


LOOP = """
<mujoco><worldbody><body name="base"><geom size="0.1"/>
  <body name="a" pos="0 0 0.3" euler="10 0 0"><joint name="a" axis="0 1 0"/><geom size="0.1"/>
    <site name="s" pos="0.1 0 0"/></body>
  <body name="b" pos="0.3 0 0" euler="0 20 0"><joint name="b" axis="0 1 0" ref="30"/>
    <geom size="0.1"/><site name="t" pos="0 0.2 0"/></body>
</body></worldbody>
<equality>{}</equality></mujoco>"""


@pytest.mark.parametrize(
    ("equality", "kind"),
    [
        ('<connect name="l" body1="a" body2="b" anchor="0.1 0.2 0.3"/>', "ball"),
        ('<weld name="l" body1="a" body2="b"/>', "fixed"),
        ('<weld name="l" body1="a" body2="b" relpose="0.1 0.2 0.3 1 0.2 0 0"/>', "fixed"),
        ('<connect name="l" site1="s" site2="t"/>', "ball"),
    ],
)
def test_loops_hold_where_mujoco_holds_them(equality: str, kind: str, tmp_path) -> None:
    import mujoco
    import numpy as np

    path = saved(tmp_path, LOOP.format(equality))
    robot = Robot.from_mjcf(path)
    loop = robot.loops["l"]
    assert loop.type == kind
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    data.qpos[:] = [0.3, -0.4]
    mujoco.mj_forward(model, data)
    gap = data.efc_pos[:3]
    poses = robot.poses({"a": 0.3, "b": -0.4})
    one, other = (np.array(poses[name].matrix()) for name in loop.between)
    assert np.linalg.norm(one[:3, 3] - other[:3, 3]) == pytest.approx(np.linalg.norm(gap), rel=1e-9)


def test_urdf_reports_loops_and_is_written(tmp_path) -> None:
    path = saved(tmp_path, LOOP.format('<weld name="l" body1="a" body2="b"/>'))
    build = yamaro.build(str(path), target="urdf", on_message=lambda line: None)
    assert "loops" in [loss.what for loss in build.losses]


def test_dashes_in_comments_are_taken_as_mujoco_takes_them() -> None:
    mujoco = pytest.importorskip("mujoco")
    text = (
        '\n<?xml version="1.0"?><!-- one -- two --->\n<mujoco><!-- a --- b -- > c -->'
        '<worldbody><body name="arm"><geom size="0.1"/></body></worldbody></mujoco>'
    )
    assert mujoco.MjModel.from_xml_string(text).nbody == 2
    build = yamaro.build("arm.xml", text=text)
    assert [*build.robot.links] == ["arm"]
    assert build.robot.links["arm"].span.place().startswith("arm.xml:3:")
    with pytest.raises(yamaro.YamaroError, match="xml-syntax"):
        yamaro.build(
            "arm.urdf", text='<robot name="r"><!-- <mujoco> -- --><link name="a"/></robot>'
        )
