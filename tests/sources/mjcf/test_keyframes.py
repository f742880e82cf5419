"""What a document attaches brings its keyframes and sections along, as MuJoCo compiles them."""

from __future__ import annotations

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles

HAND = """
<mujoco model="hand">
  <option timestep="0.005"/>
  <worldbody>
    <body name="palm">
      <joint name="wrist" ref="20"/><geom name="palm" size="0.1"/>
      <body name="finger">
        <joint name="finger" type="slide"/><geom name="tip" size="0.1"/>
      </body>
    </body>
    <body name="other" pos="1 1 1"><freejoint name="free"/><geom size="0.1"/></body>
    <body name="target" mocap="true" pos="2 2 2"><geom size="0.1" contype="0"/></body>
  </worldbody>
  <custom>
    <numeric name="gain" data="1"/>
    <tuple name="ends"><element objtype="body" objname="palm"/></tuple>
    <tuple name="both"><element objtype="body" objname="palm"/>
      <element objtype="body" objname="other"/></tuple>
  </custom>
  <contact>
    <exclude name="hidden" body1="palm" body2="world"/>
    <pair name="touching" geom1="tip" geom2="palm"/>
  </contact>
  <tendon><fixed name="pull"><joint joint="wrist" coef="1"/></fixed></tendon>
  <actuator>
    <motor name="wrist" joint="wrist"/>
    <general name="slow" dyntype="integrator" joint="finger"/>
    <motor name="pull" tendon="pull"/>
  </actuator>
  <sensor>
    <actuatorfrc name="pulled" actuator="pull"/>
    <framepos name="far" objtype="body" objname="palm" reftype="body" refname="other"/>
  </sensor>
  <keyframe>
    <key name="home" time="2" qpos="0.1 0.2 1 2 3 1 0 0 0" qvel="3 4 0 0 0 0 0 0" ctrl="5 6 7"
         act="8" mpos="1 2 3" mquat="0 1 0 0"/>
    <key name="short" qpos="0.3"/>
  </keyframe>
</mujoco>
"""
ARM = """
<mujoco>
  <compiler conflict="{conflict}"/>
  <asset><model name="hand" file="hand.xml"/></asset>
  <worldbody>
    {before}
    <body name="arm" pos="0 0 1"><joint name="arm" ref="30"/><geom size="0.1"/>{inside}</body>
    <body name="ball" pos="5 5 5"><freejoint name="ball"/><geom size="0.1"/></body>
  </worldbody>
  <actuator><motor name="arm" joint="arm"/></actuator>
  <keyframe><key name="home" qpos="0.5" ctrl="1"/></keyframe>
</mujoco>
"""
WHOLE = '<frame pos="1 0 0" euler="0 0 90"><attach model="hand" prefix="{}_"/></frame>'
PART = '<attach model="hand" body="{}" prefix="p_"/>'
BALL = '<body name="round"><joint type="ball"/><geom size="0.1"/></body>'
ATTACHED = {
    "before": ("warning", WHOLE.format("p"), ""),
    "twice": ("warning", WHOLE.format("p") + WHOLE.format("q"), ""),
    "palm": ("warning", "", PART.format("palm")),
    "finger": ("warning", "", PART.format("finger")),
    "merged": ("merge", WHOLE.format("p"), ""),
    "copies": ("warning", f'<replicate count="2" sep="-">{WHOLE.format("p")}</replicate>', ""),
    "self": ("warning", f'{BALL}<frame><attach body="round" prefix="p_"/></frame>', ""),
}
KINDS = {
    "body": "nbody", "joint": "njnt", "sensor": "nsensor", "equality": "neq", "tendon": "ntendon",
    "tuple": "ntuple", "actuator": "nu", "numeric": "nnumeric", "exclude": "nexclude",
    "pair": "npair", "key": "nkey",
}  # fmt: skip
ROWS = ("time", "qpos", "qvel", "act", "ctrl", "mpos", "mquat")


@pytest.mark.parametrize("name", ATTACHED)
def test_keyframes_and_sections_are_those_of_mujoco(name: str, tmp_path) -> None:
    mujoco = oracles.require_module("mujoco")
    conflict, before, inside = ATTACHED[name]
    arm = ARM.format(conflict=conflict, before=before, inside=inside)
    (tmp_path / "hand.xml").write_text(HAND, encoding="utf-8")
    (tmp_path / "arm.xml").write_text(arm, encoding="utf-8")
    source = mujoco.MjModel.from_xml_path(str(tmp_path / "arm.xml"))
    build = yamaro.build(str(tmp_path / "arm.xml"), target="mjcf", allow=["mjcf-lost"])
    ours = mujoco.MjModel.from_xml_string(build.xml())
    for kind, count in KINDS.items():
        names = [
            [mujoco.mj_id2name(m, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), i) or ""
             for i in range(getattr(m, count))]
            for m in (source, ours)
        ]  # fmt: skip
        assert names[0] == names[1], kind
    for row in ROWS:
        theirs, mine = getattr(source, f"key_{row}"), getattr(ours, f"key_{row}")
        assert np.abs(theirs - mine).max(initial=0.0) < 1e-9, row
    assert ours.opt.timestep == source.opt.timestep


def test_what_the_main_document_decides_is_reported(tmp_path) -> None:
    (tmp_path / "hand.xml").write_text(HAND, encoding="utf-8")
    arm = ARM.format(conflict="warning", before=WHOLE.format("p") + WHOLE.format("q"), inside="")
    (tmp_path / "arm.xml").write_text(arm, encoding="utf-8")
    build = yamaro.build(str(tmp_path / "arm.xml"), target="mjcf", on_message=lambda line: None)
    (lost,) = [each for each in build.warnings if each.code == "mjcf-lost"]
    assert "timestep of <option>" in lost.message
    assert lost.span.source.name.endswith("hand.xml")


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ('<key name="a" qpos="1 2 3"/>', "'qpos' has 3 numbers, and the model has 1"),
        ('<key name="a"/><key name="a"/>', "two keyframes named 'a'"),
    ],
)
def test_keyframes_that_mujoco_refuses_are_errors(key: str, message: str, tmp_path) -> None:
    body = '<body name="b"><joint name="j"/><geom size="1"/></body>'
    text = f"<mujoco><worldbody>{body}</worldbody><keyframe>{key}</keyframe></mujoco>"
    (tmp_path / "robot.xml").write_text(text, encoding="utf-8")
    with pytest.raises(yamaro.YamaroError) as error:
        yamaro.build(str(tmp_path / "robot.xml"), target="mjcf")
    assert error.value.diagnostics[0].code == "bad-mjcf"
    assert message in error.value.diagnostics[0].message


BOX = "geometry: box, scale: 0.1 0.1 0.1, mass: 1"
PARTLY = """
<mujoco model="leg"><worldbody>
  <body name="hip"><freejoint/><geom size="0.1"/>
    <body name="foot"><joint type="ball"/><geom size="0.1"/>
      <body name="toe"><joint name="toe" ref="20"/><geom size="0.1"/></body></body></body>
  <body name="goal" mocap="true" pos="2 2 2"><geom size="0.1" contype="0"/></body>
</worldbody>
<actuator><motor joint="toe"/><general dyntype="integrator" joint="toe"/></actuator>
<keyframe>
  <key name="home" time="2" qpos="0 0 7 0 1 0 0  0 1 0 0  0.5" ctrl="3 4" act="5" mpos="1 2 3"/>
  <key qpos="0 0 8 0 1 0 0  0 0 1 0  0.6"/>
</keyframe></mujoco>
"""


def test_keyframes_of_an_included_robot_find_their_joints_among_others(tmp_path) -> None:
    mujoco = oracles.require_module("mujoco")
    (tmp_path / "leg.xml").write_text(PARTLY, encoding="utf-8")
    part = "{name: arm, joint: {type: continuous, parent: hip, axis: x}, link: {mass: 1}}"
    (tmp_path / "robot.yaml").write_text(
        f"robot: r\nmodel:\n- include: leg.xml\n- part: {part.replace('mass: 1', BOX)}\n",
        encoding="utf-8",
    )
    build = yamaro.build(tmp_path / "robot.yaml", target="mjcf")
    model = mujoco.MjModel.from_xml_string(build.xml())
    order = [model.joint(i).name for i in range(model.njnt)]
    arm = model.joint("arm_joint").qposadr[0]
    assert order.index("toe") + 1 == order.index("arm_joint") == 3
    assert arm == 12
    home, other = model.key("home"), model.key(1)
    assert home.qpos == pytest.approx([0, 0, 7, 0, 1, 0, 0, 0, 1, 0, 0, 0.5, 0])
    assert (home.ctrl.tolist(), home.act.tolist(), home.time[0]) == ([3, 4], [5], 2)
    assert home.mpos.tolist() == [1, 2, 3]
    assert other.qpos == pytest.approx([0, 0, 8, 0, 1, 0, 0, 0, 0, 1, 0, 0.6, 0])
    alone = yamaro.build(tmp_path / "leg.xml", target="mjcf").xml()
    assert mujoco.MjModel.from_xml_string(alone).key("home").ctrl.tolist() == [3, 4]
    (tmp_path / "held.yaml").write_text(
        "robot: r\nmodel:\n- part: {name: beam, link}\n- attach: {path: leg.xml, to: beam}\n"
    )
    build = yamaro.build(tmp_path / "held.yaml", target="mjcf", on_message=lambda line: None)
    assert "'mocap' of bodies that are not in the world" in {each.what for each in build.losses}
