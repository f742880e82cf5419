"""What one of MJCF and SDF is read with, and the other has as well: balls, springs, …"""

from __future__ import annotations

from math import degrees
from pathlib import Path

import pytest

import yamaro
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

    written(tmp_path, "first.xml", "sdf", "made.sdf")
    written(tmp_path, "made.sdf", "mjcf", "second.xml")
    again = mujoco.MjModel.from_xml_path(str(tmp_path / "second.xml"))
    assert again.eq_data[0][:5] == pytest.approx(model.eq_data[0][:5])
    assert again.joint("first").stiffness == pytest.approx(3.0)
