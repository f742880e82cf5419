"""What one of MJCF and SDF is read with, and the other has as well: balls, springs, …"""

from __future__ import annotations

from math import degrees, pi
from pathlib import Path

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles
from tests.targets.same_mjcf import Comparison

MJCF = """<mujoco model="pendulum">
  <worldbody>
    <body name="stand">
      <geom type="box" size="0.1 0.1 0.05"/>
      <body name="upper" pos="0 0 0.05" euler="10 20 30">
        <joint name="shoulder" type="ball" pos="0 0.02 0.01"{more}/>
        <geom type="box" size="0.02 0.03 0.2" pos="0 0 0.2"/>
        <body name="fore" pos="0 0 0.4">
          <joint name="elbow" axis="0 1 0" stiffness="3" springref="20" range="-40 50"/>
          <geom type="box" size="0.02 0.01 0.2" pos="0 0.1 0.2"/>
          <site name="tip" pos="0 0 0.4"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>"""


def written(folder: Path, source: str, target: str, name: str) -> yamaro.Build:
    (folder / source).with_name(name).write_text(
        (build := yamaro.build(folder / source, target=target, base="fixed")).xml()
    )
    return build


def test_balls_and_springs_of_mjcf_come_back_from_sdf(tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    (tmp_path / "first.xml").write_text(MJCF.format(more=""))
    build = written(tmp_path, "first.xml", "sdf", "made.sdf")
    assert [each.what for each in build.losses] == []
    written(tmp_path, "made.sdf", "mjcf", "second.xml")
    comparison = Comparison(str(tmp_path / "first.xml"), str(tmp_path / "second.xml"))
    assert comparison.found == {}
    assert comparison.first.model.jnt_type.tolist() == [1, 3]
    assert comparison.fields.keys().isdisjoint(("joint pos", "joint stiffness", "joint range"))


def test_what_sdf_has_not_of_a_ball_is_reported(tmp_path: Path) -> None:
    (tmp_path / "first.xml").write_text(MJCF.format(more=' stiffness="2"'))
    build = written(tmp_path, "first.xml", "sdf", "made.sdf")
    assert [(each.what, each.span.location()[0]) for each in build.losses] == [
        ("MJCF's ball joints", 6)
    ]


def test_losses_are_reported_where_urdf_is_written_without_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "first.xml").write_text(MJCF.format(more=""))
    (tmp_path / "more.yaml").write_text(
        "base: fixed\nrobot: two\nmodel:\n"
        "- part: {name: table, link: {geometry: box, scale: 1 1 1, mass: 1}}\n"
        "- part:\n    name: own\n    joint: {type: continuous, parent: table, axis: z,\n"
        "      actuator: {command: effort}}\n    link: {geometry: box, scale: 1 1 1, mass: 1}\n"
        "- attach: {path: first.xml, to: table}\n"
    )
    from yamaro.commands.main import main

    for source, options in (
        ("first.xml", []),
        ("first.xml", ["--to", "urdf"]),
        ("more.yaml", []),
        ("more.yaml", ["--safe"]),
    ):
        assert main([str(tmp_path / source), "-o", str(tmp_path / "out.urdf"), *options]) == 0
        said = capsys.readouterr().err
        assert "MJCF's ball joints are lost in URDF" in said
        assert "MJCF's values of 'stiffness' are lost in URDF" in said
        assert "actuators" not in said  # YAML's own, of which URDF was known
    main(["check", str(tmp_path / "first.xml")])
    assert "lost" not in capsys.readouterr().err


HAND = """<mujoco model="hand">
  <compiler angle="radian"/>
  <worldbody>
    <body name="palm">
      <geom type="box" size="0.1 0.1 0.05"/>
      <body name="one" pos="0 0.1 0.1">
        <joint name="first" axis="1 0 0" range="-1 1" armature="0.02" stiffness="3"/>
        <geom type="box" size="0.02 0.02 0.1" pos="0 0 0.1"/>
      </body>
      <body name="two" pos="0 -0.1 0.1">
        <joint name="second" axis="1 0 0" range="-1 1" armature="0.03"/>
        <geom type="box" size="0.02 0.02 0.1" pos="0 0 0.1"/>
      </body>
      <body name="idle" pos="0 0 0.2">
        <joint name="third" axis="1 0 0" range="-1 1" armature="0.04"/>
        <geom type="box" size="0.02 0.02 0.1" pos="0 0 0.1"/>
      </body>
    </body>
  </worldbody>
  <equality>
    <joint name="pair" joint1="first" joint2="second" polycoef="0.1 -2" solref="0.005 1"/>
  </equality>
  <actuator><position joint="first" kp="3"/><position joint="second" kp="3"/></actuator>
</mujoco>"""


def test_equalities_and_armatures_of_mjcf_are_in_usd_and_sdf(tmp_path: Path) -> None:
    mujoco = pytest.importorskip("mujoco")
    usd = pytest.importorskip("pxr.Usd")
    (tmp_path / "first.xml").write_text(HAND)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "first.xml"))
    build = written(tmp_path, "first.xml", "usd", "made.usda")
    assert not {"details of MJCF's <joint>", "MJCF's values of 'armature'"} & {
        each.what for each in build.losses
    }
    stage = usd.Stage.Open(str(tmp_path / "made.usda"))
    joints = stage.GetPrimAtPath("/hand/joints")
    for name in ("first", "second", "third"):
        found = joints.GetChild(name).GetAttribute("newton:armature").Get()
        assert found == pytest.approx(model.dof_armature[model.joint(name).dofadr[0]])
    follower = joints.GetChild("first")
    assert follower.GetRelationship("newton:mimicJoint").GetTargets()[0].name == "second"
    offset, multiplier = model.eq_data[0][:2]
    assert follower.GetAttribute("newton:mimicCoef0").Get() == pytest.approx(degrees(offset))
    assert follower.GetAttribute("newton:mimicCoef1").Get() == pytest.approx(multiplier)
    assert list(follower.GetAttribute("mjc:solref").Get()) == list(model.eq_solref[0])

    from yamaro.commands.main import main

    source, made = str(tmp_path / "first.xml"), str(tmp_path / "hand.yaml")
    assert main(["migrate", "-q", source, "-o", made]) == 0
    written(tmp_path, "hand.yaml", "usd", "again.usda")
    stage = usd.Stage.Open(str(tmp_path / "again.usda"))
    third = stage.GetPrimAtPath("/hand/joints/third")
    assert third.GetAttribute("newton:armature").Get() == pytest.approx(0.04)

    written(tmp_path, "first.xml", "sdf", "made.sdf")
    written(tmp_path, "made.sdf", "mjcf", "second.xml")
    again = mujoco.MjModel.from_xml_path(str(tmp_path / "second.xml"))
    assert again.eq_data[0][:5] == pytest.approx(model.eq_data[0][:5])
    assert again.joint("first").stiffness == pytest.approx(3.0)


SDF = """<sdf version="1.10"><model name="m">
  <link name="a">{inertial}</link>
  <link name="b"><pose>0 0.2 1 0.1 0.2 0.3</pose>{inertial}</link>
  <joint name="j" type="{kind}"><parent>a</parent><child>b</child>
    <pose>0.1 0 -0.3 0.4 0.5 0.6</pose>
    <axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>2</upper>{more}</limit></axis>
    {axis2}
  </joint></model></sdf>"""
INERTIAL = (
    "<inertial><pose>0 0.1 0.2 0 0 0</pose><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.12</iyy>"
    "<izz>0.15</izz><ixy>0.01</ixy></inertia></inertial>"
)
SECOND = "<axis2><xyz>0 1 0</xyz></axis2>"
PITCH = 0.05


@pytest.mark.parametrize("kind", ["universal", "screw"])
def test_joints_of_two_axes_and_screws_move_as_in_drake(kind: str, tmp_path) -> None:
    mujoco = oracles.require_module("mujoco")
    pinocchio = oracles.require_module("pinocchio")
    plants = oracles.require_module("pydrake.multibody.plant")
    parsing = oracles.require_module("pydrake.multibody.parsing")
    more = SECOND if kind == "universal" else f"<screw_thread_pitch>{PITCH}</screw_thread_pitch>"
    text = SDF.format(kind=kind, inertial=INERTIAL, axis2=more, more="")
    (tmp_path / "made.sdf").write_text(text)
    build = written(tmp_path, "made.sdf", "mjcf", "made.xml")
    found = [(each.kind, each.what) for each in build.losses]
    assert found == ([("approximated", "SDF's screw joints")] if kind == "screw" else [])
    urdf = written(tmp_path, "made.sdf", "urdf", "made.urdf")
    assert [(each.kind, each.what) for each in urdf.losses if each.what != "free bases"] == found
    chain = pinocchio.buildModelFromXML(urdf.xml())
    at, b = chain.createData(), chain.getFrameId("b")
    plant = plants.MultibodyPlant(0.0)
    parsing.Parser(plant).AddModels(str(tmp_path / "made.sdf"))
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("a"))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "made.xml"))
    data, random = mujoco.MjData(model), np.random.default_rng(1)
    assert model.joint(0).range.tolist() == [-1, 2]
    turns = np.eye(2) if kind == "universal" else np.array([[1], [PITCH / (2 * pi)]])
    for _ in range(5):
        q = random.uniform(-1, 1, plant.num_positions())
        plant.SetPositions(context, q)
        data.qpos[:] = turns @ q
        mujoco.mj_forward(model, data)
        ends = [plant.GetFrameByName(name) for name in "ab"]
        pose = plant.CalcRelativeTransform(context, *ends)
        assert np.abs(pose.translation() - data.body("b").xpos).max() < 1e-12
        turn = data.body("b").xmat.reshape(3, 3)
        assert np.abs(pose.rotation().matrix() - turn).max() < 1e-12
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        assert np.abs(turns.T @ mass @ turns - plant.CalcMassMatrix(context)).max() < 1e-12
        position = pinocchio.integrate(chain, pinocchio.neutral(chain), turns @ q)
        pinocchio.framesForwardKinematics(chain, at, position)
        assert np.abs(pose.GetAsMatrix4() - at.oMf[b].homogeneous).max() < 1e-12
        mass = pinocchio.crba(chain, at, position)
        assert np.abs(turns.T @ mass @ turns - plant.CalcMassMatrix(context)).max() < 1e-12
    if kind == "screw":  # the equality holds the slide where the thread has it
        data.qpos[:] = turns @ q
        mujoco.mj_forward(model, data)
        mimic = urdf.robot.joints["j_slide"].mimic
        assert mimic is not None
        assert mimic.joint == "j_axis"
        assert mimic.multiplier == pytest.approx(PITCH / (2 * pi))
        assert np.abs(data.efc_pos[: data.ne]).max() < 1e-12


def test_what_mjcf_has_not_of_an_axis_is_reported(tmp_path) -> None:
    speed = "<velocity>3</velocity>"
    text = SDF.format(kind="universal", inertial=INERTIAL, axis2=SECOND, more=speed)
    (tmp_path / "made.sdf").write_text(text)
    build = written(tmp_path, "made.sdf", "mjcf", "made.xml")
    assert [each.what for each in build.losses] == ["details of SDF's <axis>"]
