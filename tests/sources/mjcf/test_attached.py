"""A file of MJCF that is attached several times: each copy is a model of its own in MuJoCo."""

from __future__ import annotations

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles

LEG = """
<mujoco model="leg">
  <option gravity="0 0 -9.8"/>
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
  <actuator><position name="knee" joint="knee" kp="40" ctrlrange="-1 1"/></actuator>
  <sensor>
    <framepos name="foot" objtype="site" objname="foot"/>
    <actuatorfrc name="effort" actuator="knee"/>
  </sensor>
  <keyframe><key name="home" qpos="0 0 0.7 1 0 0 0 0.4"/></keyframe>
</mujoco>
"""
ROBOT = """
robot: two_legs
base: fixed
model:
- part: {name: beam, link: {geometry: box, size: 1 0.1 0.1, mass: 5, collision}}
- attach: {path: leg.xml, to: beam, xyz: 0.3 0 -0.3, prefix: left_}
- attach: {path: leg.xml, to: beam, xyz: -0.3 0 -0.3, prefix: right_}
"""


@pytest.fixture
def compiled(tmp_path):
    """Return what MuJoCo compiles of the two copies, and of the file."""
    mujoco = oracles.require_module("mujoco")
    (tmp_path / "leg.xml").write_text(LEG, encoding="utf-8")
    (tmp_path / "robot.yaml").write_text(ROBOT, encoding="utf-8")
    build = yamaro.build(str(tmp_path / "robot.yaml"), target="mjcf")
    both = mujoco.MjModel.from_xml_string(build.xml())
    return both, mujoco.MjModel.from_xml_path(str(tmp_path / "leg.xml"))


@pytest.mark.parametrize(("prefix", "x"), [("left_", 0.3), ("right_", -0.3)])
def test_each_copy_is_the_model_with_names_of_its_own(compiled, prefix: str, x: float) -> None:
    both, leg = compiled
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
    assert both.light(f"{prefix}lamp").targetbodyid[0] == both.body(f"{prefix}hip").id


def test_what_is_attached_does_not_move_freely_or_stand_elsewhere(compiled) -> None:
    both, _ = compiled
    assert (both.njnt, both.nu, both.nsensor) == (2, 2, 4)
    assert all(both.joint(i).type == 3 for i in range(both.njnt))  # hinges
