"""Bodies, joints and masses of MJCF, compared with what MuJoCo compiles."""

from __future__ import annotations

from pathlib import Path

import pytest

import yamaro
from tests.sources.mjcf.compiled import assert_same, robot_of
from tests.targets.same_mjcf import Comparison

BODY = """
<mujoco model="arm">
  {before}
  <worldbody>
    <body name="base" pos="0.1 0.2 0.3" euler="10 20 30">
      {base}
      <geom size="0.1"/>
      <body name="upper" pos="0 0.1 0.2" {upper}>
        {joints}
        <geom type="box" size="0.1 0.2 0.3" pos="0.1 0 0" euler="30 0 45"/>
        <geom type="capsule" fromto="0 0 0 0.1 0.2 -0.3" size="0.04" mass="0.7"/>
        <site name="tip" pos="0 0 0.4" axisangle="1 1 0 30"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def written(folder: Path, **parts: str) -> Path:
    parts = {"before": "", "base": "", "upper": "", "joints": "", **parts}
    path = folder / "arm.xml"
    path.write_text(BODY.format(**parts), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "parts",
    [
        {},
        {"base": "<freejoint/>"},
        {"base": '<joint name="slide" type="slide" axis="1 0 1"/>'},
        {"joints": '<joint name="elbow" axis="0 1 1"/>'},
        {"joints": '<joint name="elbow" axis="0 1 1" pos="0.1 0.2 0.3"/>'},
        {"joints": '<joint name="a" axis="0 1 0" pos="0 0 0.1"/><joint name="b" axis="1 0 0"/>'},
        {
            "joints": '<joint name="a" type="slide" axis="0 1 0"/>'
            '<joint name="b" pos="0 0.1 0"/><joint name="c" pos="0.1 0 0" axis="0 1 1"/>'
        },
        {"upper": 'quat="0.5 0.1 -0.3 0.4"'},
        {"upper": 'axisangle="0 1 1 40"'},
        {"upper": 'xyaxes="1 1 0 0 1 1"'},
        {"upper": 'zaxis="0.3 0.2 -1"'},
        {"upper": 'zaxis="0 0 -1"'},
        {"before": '<compiler angle="radian"/>', "upper": 'euler="0.1 0.2 0.3"'},
        {"before": '<compiler eulerseq="zyx"/>'},
        {"before": '<compiler eulerseq="XYZ"/>'},
        {"before": '<compiler eulerseq="zXy"/>'},
        {"before": '<compiler boundmass="3" boundinertia="0.2"/>'},
        {"before": '<compiler balanceinertia="true"/>'},
        {"before": '<compiler settotalmass="7"/>'},
        {
            "base": '<inertial mass="2" pos="0.1 0 0" quat="1 1 0 0" diaginertia="0.1 0.2 0.25"/>',
        },
        {
            "base": '<inertial mass="2" pos="0.1 0 0" fullinertia="0.3 0.2 0.25 0.01 0.02 0.03"/>',
        },
        {
            "base": '<inertial mass="2" pos="0 0 0" diaginertia="1 1 1"/>',
            "before": '<compiler inertiafromgeom="true"/>',
        },
        {"before": '<compiler inertiagrouprange="0 0"/><default><geom group="0"/></default>'},
        {"joints": '<geom type="ellipsoid" size="0.1 0.2 0.3"/><geom type="cylinder" size="1 2"/>'},
    ],
)
def test_a_robot_has_the_masses_and_kinematics_of_the_model(parts, tmp_path) -> None:
    assert_same(written(tmp_path, **parts))


def test_classes_are_inherited_and_overridden(tmp_path) -> None:
    path = tmp_path / "arm.xml"
    path.write_text(
        """
<mujoco>
  <default>
    <geom density="500" size="0.2"/>
    <joint axis="1 0 0" damping="0.1"/>
    <default class="a">
      <geom density="700"/>
      <default class="b"><joint axis="0 1 0"/></default>
    </default>
  </default>
  <worldbody>
    <body name="root">
      <geom/>
      <body name="one" childclass="a" pos="1 0 0">
        <geom/><joint name="j1"/>
        <body name="two" pos="1 0 0">
          <geom class="b" euler="10 0 0"/><joint name="j2" class="b"/>
          <body name="three" childclass="b" pos="1 0 0">
            <geom density="3"/><joint name="j3"/><geom class="main" type="box" size="1 1 1"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
""",
        encoding="utf-8",
    )
    assert_same(path)
    damping = [joint.dynamics.damping for joint in robot_of(path).joints.values()]
    assert damping == [0.1, 0.1, 0.1]


MEASURED = """
<mujoco>
  <worldbody>
    <body name="b" euler="10 20 30">
      <freejoint/>
      {geoms}
    </body>
  </worldbody>
  <sensor>
    <framequat name="turn" objtype="body" objname="b"/>
    <framexaxis name="x" objtype="body" objname="b"/>
  </sensor>
</mujoco>
"""
BOX = '<geom type="box" size="{0}" pos="{1}" euler="{2}"/>'


@pytest.mark.parametrize(
    ("boxes", "losses"),
    [
        ([(".1 .2 .03", ".3 0 .1", "10 0 20"), (".1 .1 .1", "0 .2 0", "0 0 0")], 0),
        ([(".1 .2 .03", "0 0 .1", "0 0 0"), (".1 .1 .1", "0 0 -.2", "0 0 0")], 0),
        ([(".1 .02 .03", "0 0 .1", "0 0 0"), (".2 .1 .1", "0 0 -.1", "0 0 0")], 0),
        ([(".1 .1 .1", each, "0 0 0") for each in (".2 0 0", "0 .2 0", "0 0 .2")], 1),
    ],
)
def test_sensors_measure_along_the_axes_that_mujoco_takes(boxes, losses, tmp_path) -> None:
    source, made = tmp_path / "source.xml", tmp_path / "made.xml"
    geoms = "".join(BOX.format(*each) for each in boxes)
    source.write_text(MEASURED.format(geoms=geoms), encoding="utf-8")
    build = yamaro.build(source, target="mjcf")
    made.write_text(build.xml(), encoding="utf-8")
    assert [each.kind for each in build.losses] == ["approximated"] * losses
    if not losses:
        assert Comparison(str(source), str(made), states=3).found == {}
