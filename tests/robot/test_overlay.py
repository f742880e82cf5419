"""Overlays, on robots of every format that is read, judged by pinocchio and by formulas."""

import random
from math import radians, tau
from pathlib import Path

import numpy as np
import pytest

from tests.consumers import oracles
from yamaro import Robot, UsageError, YamaroError, build
from yamaro.policy import JAIL, SAFE, Policy
from yamaro.sandbox import jail
from yamaro.source import OverlaidSpan

ARM = """\
<robot name="arm">
  <link name="base"/>
  <link name="upper"/>
  <link name="lower"/>
  <link name="tip"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0.1 0 0.3" rpy="0.2 -0.4 1.1"/>
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0.6 0.8"/>
    <limit lower="-1" upper="1" effort="30" velocity="3"/>
  </joint>
  <joint name="slide" type="prismatic">
    <origin xyz="0.4 0.1 0" rpy="1 0 0"/>
    <parent link="upper"/>
    <child link="lower"/>
    <axis xyz="1 2 0"/>
    <limit lower="-1" upper="1" effort="30" velocity="3"/>
  </joint>
  <joint name="wrist" type="revolute">
    <origin xyz="0 0 0.2"/>
    <parent link="lower"/>
    <child link="tip"/>
    <axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="30" velocity="3"/>
    <mimic joint="shoulder" multiplier="-2" offset="0.5"/>
  </joint>
</robot>
"""


def tip_pose(urdf: str, positions: dict[str, float]) -> np.ndarray:
    """Return T_base_tip as pinocchio has it; joints that follow others are given as well."""
    pin = oracles.require_module("pinocchio")
    model = pin.buildModelFromXML(urdf)
    data = model.createData()
    configuration = pin.neutral(model)
    for name, position in positions.items():
        configuration[model.joints[model.getJointId(name)].idx_q] = position
    pin.framesForwardKinematics(model, data, configuration)
    return np.array(data.oMf[model.getFrameId("tip")].homogeneous)


def test_a_zero_moves_where_joints_read_0_and_none_of_their_poses(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM, encoding="utf-8")
    zeros = {"shoulder": 0.3, "slide": -0.2, "wrist": 0.7}
    overlay = {"joints": {name: {"zero": zero} for name, zero in zeros.items()}}
    built = build(path, overlay=overlay)
    mimic = built.robot.joints["wrist"].mimic
    assert mimic is not None
    draws = random.Random(7)
    for _ in range(20):
        here = {name: draws.uniform(-1, 1) for name in ("shoulder", "slide")}
        here["wrist"] = -2 * here["shoulder"] + 0.5
        counted = {name: here[name] - zero for name, zero in zeros.items()}
        follows = mimic.multiplier * counted["shoulder"] + mimic.offset
        assert follows == pytest.approx(counted["wrist"], abs=1e-12)
        expected = tip_pose(ARM, here)
        np.testing.assert_allclose(tip_pose(built.xml(), counted), expected, atol=1e-12)


def test_the_calibration_of_universal_robots_gives_what_the_maker_s_xacro_gives(
    tmp_path: Path,
) -> None:
    links = ("shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3")
    joint = """
  <joint name="{0}_joint" type="revolute">
    <origin xyz="${{k['{0}']['x']}} ${{k['{0}']['y']}} ${{k['{0}']['z']}}"
            rpy="${{k['{0}']['roll']}} ${{k['{0}']['pitch']}} ${{k['{0}']['yaw']}}"/>
    <parent link="{1}_link"/> <child link="{0}_link"/> <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="9" velocity="2"/>
  </joint>"""
    joints = [
        joint.format(link, "_".join(("base", *links)[n : n + 1])) for n, link in enumerate(links)
    ]
    (tmp_path / "ur.xacro").write_text(
        '<robot name="ur" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <xacro:arg name="calibration" default="default.yaml"/>\n'
        '  <xacro:property name="file" value="$(arg calibration)"/>\n'
        '  <xacro:property name="k" value="${xacro.load_yaml(file)[\'kinematics\']}"/>'
        + "".join(f'\n  <link name="{link}_link"/>' for link in ("base", *links))
        + "".join(joints)
        + "\n</robot>\n",
        encoding="utf-8",
    )
    draws = random.Random(5)
    for name in ("default", "unit"):
        rows = ["kinematics:"]
        for link in links:
            rows.append(f"  {link}:")
            pose = ("x", "y", "z", "roll", "pitch", "yaw")
            rows += [f"    {each}: {draws.uniform(-2, 2)!r}" for each in pose]
        rows.append("  hash: calib_12788084448423163542")
        (tmp_path / f"{name}.yaml").write_text("\n".join(rows), encoding="utf-8")
    calibration = tmp_path / "unit.yaml"
    makers = build(tmp_path / "ur.xacro", command_line=[f"calibration:={calibration}"])
    default = tmp_path / "default.yaml"
    ours = build(
        tmp_path / "ur.xacro", command_line=[f"calibration:={default}"], overlay=calibration
    )
    assert ours.xml() == makers.xml()


def test_a_calibration_of_lerobot_gives_half_of_the_range_to_both_sides(tmp_path: Path) -> None:
    text = ARM.replace("shoulder", "shoulder_pan").replace("slide", "2").replace("wrist", "gripper")
    text = text.replace("prismatic", "revolute")
    (tmp_path / "so101.urdf").write_text(text, encoding="utf-8")
    entry = (
        '"{}": {{"id": {}, "drive_mode": 0, "homing_offset": {}, "range_min": {}, "range_max": {}}}'
    )
    rows = [
        ("shoulder_pan", 1, -1365, 746, 3477),
        ("elbow", 2, 5, 822, 3211),
        ("gripper", 6, 9, 2032, 3288),
    ]
    calibration = tmp_path / "unit.json"
    calibration.write_text(
        "{" + ", ".join(entry.format(*row) for row in rows) + "}", encoding="utf-8"
    )
    robot = build(tmp_path / "so101.urdf", overlay=calibration).robot
    ranges = {name: joint.range for name, joint in robot.joints.items()}
    # LeRobot: degrees = (steps - middle) * 360 / (4096 - 1); the gripper is closed at its lower
    # end.
    half = {"shoulder_pan": (3477 - 746) / 2 * tau / 4095, "2": (3211 - 822) / 2 * tau / 4095}
    for name, bound in half.items():
        assert ranges[name] == pytest.approx((-bound, bound), abs=1e-14)
    assert ranges["gripper"] == pytest.approx((-1, -1 + (3288 - 2032) * tau / 4095), abs=1e-14)


SOURCES = {
    "arm.urdf": """\
<robot name="arm">
  <link name="base"/>
  <link name="rod"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="9" velocity="2"/></joint>
</robot>""",
    "arm.urdf.xacro": """\
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="high" value="${2 / 2}"/>
  <link name="base"/>
  <link name="rod"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="${high}" effort="9" velocity="2"/></joint>
</robot>""",
    "arm.yaml": """\
robot: arm
model:
- link/name=base:
- part:
    name: rod rod
    joint/name=elbow:
      type: revolute
      parent: base
      axis: y
      limit: {lower: -1, upper: 1, effort: 9, velocity: 2}
    link: {inertial: {mass: 1, inertia: 1 0 0 1 0 1}}
""",
    "arm.mjcf.xml": """\
<mujoco model="arm">
  <compiler angle="radian"/>
  <worldbody>
    <body name="base">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="rod">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="elbow" axis="0 1 0" range="-1 1" damping="3" armature="0.5"
               actuatorfrcrange="-9 9"/>
      </body>
    </body>
  </worldbody>
  <actuator><position name="elbow" joint="elbow" kp="10" kv="3"/></actuator>
</mujoco>""",
    "arm.sdf": """\
<sdf version="1.9">
  <model name="arm">
    <link name="base"><inertial><mass>1</mass></inertial></link>
    <link name="rod"><inertial><mass>1</mass></inertial></link>
    <joint name="elbow" type="revolute"><parent>base</parent><child>rod</child>
      <axis><xyz>0 1 0</xyz>
        <limit><lower>-1</lower><upper>1</upper><effort>9</effort><velocity>2</velocity></limit>
      </axis></joint>
  </model>
</sdf>""",
}
UNIT = """\
overlay:
  joints:
    elbow:
      xyz: [0, 0, 12mm]
      rpy: 0 0 3deg
      limit: {upper: 50deg, effort: 7 N*m}
      dynamics: {friction: 0.3}
      actuator: {kp: 40}
  links:
    rod: {mass: 1200 g, inertial: {xyz: 0 1cm 0, inertia: 2 0 0 2 0 3}}
"""


@pytest.mark.parametrize("name", SOURCES)
def test_an_overlay_changes_robots_of_every_format(name: str, tmp_path: Path) -> None:
    path, unit = tmp_path / name, tmp_path / "unit.yaml"
    path.write_text(SOURCES[name], encoding="utf-8")
    unit.write_text(UNIT, encoding="utf-8")
    built = build(path, overlay=unit, target="mjcf")
    robot = built.robot
    elbow, rod = robot.joints["elbow"], robot.links["rod"]
    assert tuple(elbow.origin.position) == pytest.approx((0, 0, 0.012), abs=0)
    assert elbow.origin.rpy == pytest.approx((0, 0, radians(3)), abs=1e-13)
    assert elbow.limit is not None and rod.inertial is not None and elbow.dynamics is not None
    assert elbow.limit.upper == pytest.approx(radians(50), abs=1e-14)
    assert (elbow.limit.lower, elbow.limit.effort, elbow.dynamics.friction) == (-1, 7, 0.3)
    assert robot.actuators["elbow"].kp == 40
    assert (rod.inertial.mass, rod.inertial.pose.position) == (1.2, (0, 0.01, 0))
    assert tuple(rod.inertial.inertia) == (2, 0, 0, 2, 0, 3)
    assert str(unit) in built.files
    mujoco = oracles.require_module("mujoco")
    model = mujoco.MjModel.from_xml_string(built.xml())
    joint = model.joint("elbow")
    assert joint.range == pytest.approx((-1, radians(50)), abs=1e-12)
    assert joint.frictionloss[0] == 0.3
    assert model.body("rod").mass[0] == pytest.approx(1.2)
    assert sorted(model.body("rod").inertia) == pytest.approx([2, 2, 3])
    assert model.actuator("elbow").gainprm[0] == 40
    assert model.jnt_actfrcrange[joint.id] == pytest.approx((-7, 7))


def test_overlays_are_paths_or_mappings_and_the_last_counts(tmp_path: Path) -> None:
    path, unit = tmp_path / "arm.urdf", tmp_path / "unit.yaml"
    path.write_text(SOURCES["arm.urdf"], encoding="utf-8")
    unit.write_text(UNIT, encoding="utf-8")

    def mass(*overlays: object) -> float:
        built = build(path, overlay=list(overlays))  # type: ignore[arg-type]
        inertial = built.robot.links["rod"].inertial
        assert inertial is not None
        return inertial.mass

    heavy = {"links": {"rod": {"mass": 5}}}
    inertial = Robot.from_urdf(path, overlay=heavy).links["rod"].inertial
    assert inertial is not None and inertial.mass == 5
    assert [mass(unit), mass(unit, heavy), mass(heavy, unit), mass()] == [1.2, 5, 1.2, 1]
    advised = build(path, overlay=[str(unit), heavy], advice=True).warnings
    again = [each for each in advised if each.code == "overlay-again"]
    assert [each.span.source.name for each in again] == ["<keyword argument>"]
    with pytest.raises(UsageError, match="an overlay is a path or a mapping"):
        build(path, overlay=[3])  # type: ignore[list-item]
    with pytest.raises(YamaroError, match="<keyword argument>"):
        build(path, overlay={"links": {"rood": {"mass": 5}}})


def test_who_names_an_overlay_lets_an_untrusted_file_have_it(tmp_path: Path) -> None:
    folder, unit = tmp_path / "robots", tmp_path / "units" / "unit.yaml"
    folder.mkdir()
    unit.parent.mkdir()
    unit.write_text(UNIT, encoding="utf-8")
    (folder / "arm.urdf").write_text(SOURCES["arm.urdf"], encoding="utf-8")
    cell = folder / "cell.yaml"
    include = "robot: cell\nmodel:\n- include: {{path: arm.urdf, overlay: {}}}\n"
    cell.write_text(include.format("''"), encoding="utf-8")
    policy = Policy(SAFE)
    assert "1.2" in build(cell, overlay=unit, policy=policy).xml()
    cell.write_text(include.format("../units/unit.yaml"), encoding="utf-8")
    with pytest.raises(YamaroError) as refused:
        build(cell, policy=policy)
    assert [each.code for each in refused.value.diagnostics] == ["path-outside"]


@pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")
def test_places_of_changed_values_are_both_there_out_of_a_jail(tmp_path: Path) -> None:
    path, unit = tmp_path / "arm.urdf", tmp_path / "unit.yaml"
    path.write_text(SOURCES["arm.urdf"], encoding="utf-8")
    unit.write_text(UNIT, encoding="utf-8")
    places = []
    for policy in (Policy(), Policy(JAIL)):
        root = build(path, overlay=unit, policy=policy).root
        assert root is not None
        span = next(each for each in root.iter() if each.name == "limit").value_span("upper")
        assert isinstance(span, OverlaidSpan) and span.replaced is not None
        places.append((span.place(), span.replaced.place(), span.note))
    assert places[0] == places[1]
    assert places[0][:2] == (f"{unit}:6:22", f"{path}:6:30")


def test_a_name_that_lacks_the_ending_of_its_kind_gets_that_suggestion(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM.replace('"wrist"', '"wrist_joint"').replace('"tip"', '"tip_link"'))
    overlay = {"joints": {"wrist": {"axis": "y"}}, "links": {"tip": {"mass": 1}}}
    with pytest.raises(YamaroError) as caught:
        Robot.from_urdf(path, overlay=overlay)
    hints = [each.hint for each in caught.value.diagnostics]
    assert hints == ["did you mean 'wrist_joint'?", "did you mean 'tip_link'?"]
