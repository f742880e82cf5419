"""A file of MJCF that is attached several times: each copy is a model of its own in MuJoCo."""

from __future__ import annotations

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles

LEG = """
<mujoco model="leg">
  <option gravity="0 0 -9.8" timestep="{step}"/>
  <worldbody>
    <light name="lamp" mode="targetbody" target="hip" pos="0 0 2"/>
    <body name="hip" pos="0 0 0.7">
      <freejoint name="float"/>
      <geom name="hip" type="box" size="0.1 0.1 0.1" solref="0.03 1"/>
      <body name="knee" pos="0 0 -0.2">
        <joint name="knee" axis="0 1 0" range="-60 60"/>
        <geom name="shank" type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" condim="6"/>
        <site name="foot" pos="0 0 -0.3" size="0.02"/>
      </body>
    </body>
  </worldbody>
  <contact>
    <exclude name="near" body1="hip" body2="knee"/>
    <pair name="fold" geom1="shank" geom2="hip"/>
  </contact>
  <actuator><position name="knee" joint="knee" kp="40" ctrlrange="-1 1"/></actuator>
  <sensor>
    <distance name="gap" geom1="shank" geom2="hip"/>
    <framepos name="foot" objtype="site" objname="foot"/>
    <actuatorfrc name="effort" actuator="knee"/>
  </sensor>
  <keyframe>
    <key name="home" qpos="0 0 0.7 1 0 0 0 0.4" ctrl="0.3" time="1.5"/>
    <key name="fast" qvel="0 0 0 0 0 0 1"/>
  </keyframe>
</mujoco>
"""
ROBOT = """
robot: two_legs
base: fixed
model:
- part: {name: beam, link: {geometry: box, size: 1 0.1 0.1, mass: 5, collision}}
- attach: {path: leg.xml, to: beam, xyz: 0.3 0 -0.3, prefix: left_}
- attach: {path: other.xml, to: beam, xyz: -0.3 0 -0.3, prefix: right_}
"""


@pytest.fixture
def compiled(tmp_path):
    """Return what MuJoCo compiles of the two copies, and of the file."""
    mujoco = oracles.require_module("mujoco")
    for name, step in (("leg.xml", "0.003"), ("other.xml", "0.004")):
        (tmp_path / name).write_text(LEG.format(step=step), encoding="utf-8")
    (tmp_path / "robot.yaml").write_text(ROBOT, encoding="utf-8")
    lines: list[str] = []
    build = yamaro.build(str(tmp_path / "robot.yaml"), target="mjcf", on_message=lines.append)
    both = mujoco.MjModel.from_xml_string(build.xml())
    return both, mujoco.MjModel.from_xml_path(str(tmp_path / "leg.xml")), build


@pytest.mark.parametrize(("prefix", "x"), [("left_", 0.3), ("right_", -0.3)])
def test_each_copy_is_the_model_with_names_of_its_own(compiled, prefix: str, x: float) -> None:
    both, leg, _ = compiled
    for name in ("hip", "knee"):
        mine, source = both.body(prefix + name), leg.body(name)
        assert mine.mass == pytest.approx(source.mass, rel=1e-9)
        assert mine.inertia == pytest.approx(source.inertia, rel=1e-9)
    assert both.body(f"{prefix}hip").pos == pytest.approx([x, 0, -0.3])
    geoms = [i for i in range(both.ngeom) if both.geom_bodyid[i] == both.body(f"{prefix}hip").id]
    (hip,) = geoms
    assert both.geom_solref[hip] == pytest.approx([0.03, 1])
    (shank,) = np.flatnonzero(both.geom_bodyid == both.body(f"{prefix}knee").id)
    assert both.geom_condim[shank] == 6
    driver = both.actuator(f"{prefix}knee")
    assert driver.trnid[0] == both.joint(f"{prefix}knee").id
    assert driver.gainprm[0] == 40
    assert both.sensor(f"{prefix}foot").objid[0] == both.site(f"{prefix}foot").id
    assert both.sensor(f"{prefix}effort").objid[0] == driver.id
    hip_and_shank = {hip, shank}
    gap = both.sensor(f"{prefix}gap")
    assert {gap.objid[0], gap.refid[0]} == hip_and_shank
    pair = both.pair(f"{prefix}fold")
    assert {pair.geom1[0], pair.geom2[0]} == hip_and_shank
    assert both.light(f"{prefix}lamp").targetbodyid[0] == both.body(f"{prefix}hip").id


def test_what_is_attached_does_not_move_freely_or_stand_elsewhere(compiled) -> None:
    both, _, _ = compiled
    assert (both.njnt, both.nu, both.nsensor) == (2, 2, 6)
    assert all(both.joint(i).type == 3 for i in range(both.njnt))  # hinges


def test_an_attached_robot_does_not_decide_for_the_whole(compiled) -> None:
    both, _, build = compiled
    assert both.opt.timestep == 0.003  # of the first
    assert both.opt.integrator == 3  # as without what is attached: mjINT_IMPLICITFAST
    lost = {(each.what, each.owner) for each in build.losses}
    assert ("settings of attached robots", "'timestep' of <option>") in lost
    assert not any("keyframe" in what for what, _ in lost)
    assert [both.key(i).name for i in range(both.nkey)] == ["home", "fast"]


def test_keyframes_of_one_name_are_one_with_the_numbers_of_each_copy(compiled) -> None:
    both, _, _ = compiled
    home, fast = both.key("home"), both.key("fast")
    assert home.qpos == pytest.approx([0.4, 0.4])
    assert (home.ctrl, home.time) == (pytest.approx([0.3, 0.3]), 1.5)
    assert fast.qvel == pytest.approx([1, 1])  # without the six of the free base


def test_attached_documents_are_merged_as_mujoco_does(tmp_path) -> None:
    mujoco = oracles.require_module("mujoco")
    inner = '<site name="world"/><body name="b"><geom size="1"/><site name="tip"/></body>'
    option = 'timestep="{0}" iterations="{1}" ls_tolerance="{0}" sdf_initpoints="{1}"'
    (tmp_path / "inner.xml").write_text(
        f'<mujoco model="inner"><option {option.format("0.003", 70)}/>'
        f"<worldbody>{inner}</worldbody>"
        '<tendon><spatial><site site="world"/><site site="tip"/></spatial></tendon></mujoco>'
    )
    (tmp_path / "outer.xml").write_text(
        f'<mujoco><compiler conflict="merge"/><option {option.format("0.004", 60)}/>'
        '<asset><model name="m" file="inner.xml"/></asset>'
        '<worldbody><attach model="m" prefix="in_"/></worldbody></mujoco>'
    )
    made = yamaro.build(tmp_path / "outer.xml", target="mjcf").xml()
    ours = mujoco.MjModel.from_xml_string(made)
    source = mujoco.MjModel.from_xml_path(str(tmp_path / "outer.xml"))
    assert ours.site("in_world").id == source.site("in_world").id
    for name in ("timestep", "iterations", "ls_tolerance", "sdf_initpoints"):
        assert getattr(ours.opt, name) == getattr(source.opt, name)


def test_copies_of_copies_are_called_as_in_mujoco(tmp_path) -> None:
    mujoco = oracles.require_module("mujoco")
    (tmp_path / "leg.xml").write_text(
        '<mujoco model="leg"><worldbody><body name="hip"><joint name="j"/><geom size="0.1"/>'
        "</body></worldbody></mujoco>"
    )
    path = tmp_path / "many.xml"
    path.write_text(
        '<mujoco><asset><model name="m" file="leg.xml"/></asset><worldbody>'
        '<replicate count="2" offset="3 0 0" sep="_"><frame pos="0 0 1">'
        '<replicate count="3" offset="0 1 0" sep="-"><attach model="m" body="hip" prefix="a"/>'
        "</replicate></frame></replicate></worldbody></mujoco>"
    )
    ours = mujoco.MjModel.from_xml_string(yamaro.build(path, target="mjcf").xml())
    source = mujoco.MjModel.from_xml_path(str(path))
    for model in (ours, source):
        assert model.nbody == 7
    for index in range(1, 7):
        name = source.body(index).name
        assert ours.body(index).name == name
        assert ours.body(index).pos == pytest.approx(source.body(index).pos)
