"""MJCF against MuJoCo, and against pinocchio's reading of the URDF."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.golden import CASES
from tests.targets.mechanics import (
    Mujoco,
    PinocchioMjcf,
    PinocchioUrdf,
    differences,
    joint_differences,
    mimic_differences,
    missing_frames,
)
from tests.targets.standing import Standing, with_position_actuators

ROOT = Path(__file__).parents[2]
EXAMPLES = ("pan_tilt/pan_tilt", "leg_robot/robot", "hexapod/hexapod", "quadruped/quadruped",
            "arm/arm", "diff_drive/diff_drive", "drone/drone", "hand/hand",
            "humanoid/humanoid", "dual_arm_cell/dual_arm_cell",
            "mobile_manipulator/mobile_manipulator")  # fmt: skip


def mjcf_of(path: Path, **options: Any) -> yamaro.Build:
    return yamaro.build(path, target="mjcf", on_message=lambda line: None, **options)


def judged(path: Path, **options: Any) -> tuple[yamaro.Build, PinocchioUrdf, Mujoco]:
    """Return a robot as MJCF, as pinocchio reads its URDF, and as MuJoCo reads the MJCF."""
    require_module("pinocchio")
    require_module("mujoco")
    build = mjcf_of(path, **options)
    urdf = yamaro.build(path, on_message=lambda line: None).xml()
    is_fixed = re.search(r'<freejoint name="[^"]*_free"', build.xml()) is None
    reference = PinocchioUrdf(urdf, is_fixed=is_fixed)
    return build, reference, Mujoco(build.xml(), dict(build.assets), reference.joints)


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_move_as_their_urdf_does(name: str) -> None:
    build, reference, model = judged(ROOT / "examples" / f"{name}.yaml")
    assert max(differences(reference, model, 5).values()) < 1e-9
    assert not missing_frames(reference, model) - {"world"}
    assert not joint_differences(reference.description, model.model)
    assert not mimic_differences(reference.description, model.model)
    other = PinocchioMjcf(build.xml(), dict(build.assets), reference.joints)
    assert max(differences(reference, other, 5).values()) < 1e-9


def test_joints_of_several_numbers_move_as_in_the_urdf(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    part = "{{name: {}, joint: {{type: {}, parent: {}, axis: z, xyz: {}, rpy: {}}}, {}}}"
    link = "link: {mass: 2, geometry: box, scale: 0.1 0.2 0.3, xyz: 0.1 0.2 0.3, rpy: 1 2 3}"
    parts = [
        part.format("cart", "planar", "base", "1 2 3", "0 0 1", link),
        part.format("arm", "floating", "cart", "0.1 0.2 0.3", "1 0.5 0.2", link),
        part.format("other", "floating", "base", "1 0 1", "1 0.5 0.2", link),
        part.format("hand", "continuous", "arm", "0.3 0 0", "0 1 0", link),
    ]
    lines = ["robot: odd", "model:", f"- part: {{name: base, {link}}}"]
    path.write_text("\n".join([*lines, *(f"- part: {each}" for each in parts)]) + "\n")
    for base in ("fixed", "free"):
        _, reference, model = judged(path, base=base)
        assert max(differences(reference, model, 10).values()) < 1e-9


def test_keyframes_hold_states_in_the_order_of_the_joints(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    path = tmp_path / "robot.yaml"
    path.write_text(STATES)
    model = mujoco.MjModel.from_xml_string(mjcf_of(path).xml())
    home = model.key("home")
    assert home.qpos.tolist()[:7] == [0, 0, 0, 1, 0, 0, 0]
    at = {name: model.joint(name).qposadr[0] for name in ("a_joint", "b_joint", "c_joint")}
    assert home.qpos[at["a_joint"]] == 0.25
    assert home.qpos[at["b_joint"]] == pytest.approx(0.5 * 0.25 + 0.1, abs=1e-14)
    assert home.qpos[at["c_joint"]] == 1.5  # in the middle of limits that exclude 0
    assert home.ctrl.tolist() == [0.25, 1.5]
    assert model.key("up").qpos[at["a_joint"]] == 0.75


STATES = """
robot: stated
model:
- part: {name: base, link: {mass: 1, geometry: sphere, scale: 0.1}}
- part:
    name: a
    joint: {type: continuous, parent: base, axis: z, actuator: {kp: 5}}
    link: {mass: 1, geometry: sphere, scale: 0.1}
- part:
    name: b
    joint:
      type: continuous
      parent: base
      axis: z
      mimic: {joint: a_joint, multiplier: 0.5, offset: 0.1}
    link: {mass: 1, geometry: sphere, scale: 0.1}
- part:
    name: c
    joint:
      type: revolute
      parent: b
      axis: z
      limit: {lower: 1, upper: 2, effort: 8, velocity: 1}
      actuator: {kp: 32, kd: 16, gear: 4}
    link: {mass: 1, geometry: sphere, scale: 0.1}
states:
  up: {a: 0.75}
  home: {a: 0.25}
"""


@pytest.mark.parametrize("gear", ["1", "345", "-4"])
def test_gains_and_commands_are_those_of_the_joint_whatever_the_gear(
    tmp_path: Path, gear: str
) -> None:
    mujoco = require_module("mujoco")
    path = tmp_path / "robot.yaml"
    path.write_text(STATES.replace("gear: 4", f"gear: {gear}"))
    model = mujoco.MjModel.from_xml_string(mjcf_of(path, base="fixed").xml())
    data = mujoco.MjData(model)
    driven = model.actuator("c_joint")
    assert driven.ctrlrange.tolist() == [1, 2]  # the limits of the joint
    assert driven.forcerange.tolist() == [-8, 8]  # its effort
    data.qpos[model.joint("c_joint").qposadr[0]] = 1.1
    data.ctrl[driven.id] = 1.2
    mujoco.mj_forward(model, data)
    dof = model.joint("c_joint").dofadr[0]
    assert data.qfrc_actuator[dof] == pytest.approx(3.2, rel=1e-12)  # 0.1 rad, 32 N·m/rad
    data.qvel[dof] = 0.05
    mujoco.mj_forward(model, data)
    assert data.qfrc_actuator[dof] == pytest.approx(3.2 - 16 * 0.05, rel=1e-12)


@pytest.mark.parametrize("command", ["position", "velocity", "effort"])
def test_a_step_gives_the_same_response_with_gear_1_and_345(tmp_path: Path, command: str) -> None:
    mujoco = require_module("mujoco")
    responses = []
    for gear in ("1", "345"):
        path = tmp_path / "robot.yaml"
        path.write_text(STATES.replace("gear: 4", f"gear: {gear}, command: {command}"))
        model = mujoco.MjModel.from_xml_string(mjcf_of(path, base="fixed").xml())
        data = mujoco.MjData(model)
        mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
        data.ctrl[model.actuator("c_joint").id] += 0.1
        response = []
        for _ in range(200):
            mujoco.mj_step(model, data)
            response.append(float(data.qpos[model.joint("c_joint").qposadr[0]]))
        responses.append(response)
    assert responses[0] == responses[1]
    assert abs(responses[0][-1] - responses[0][0]) > 1e-3  # it moves


LINE = "stall_torque: 6, no_load_speed: 3"
"""Of a motor at a joint whose limit allows 8 N·m and 1 rad/s."""


def driven(path: Path, actuator: str, effort: float = 8) -> tuple[Any, Any, Any]:
    """Return MuJoCo, a robot whose last joint has an actuator, and its state at home."""
    mujoco = require_module("mujoco")
    text = STATES.replace("kp: 32, kd: 16, gear: 4", actuator)
    path.write_text(text.replace("effort: 8", f"effort: {effort}"))
    model = mujoco.MjModel.from_xml_string(mjcf_of(path, base="fixed").xml())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    return mujoco, model, data


@pytest.mark.parametrize("effort", [8.0, 2.5])
@pytest.mark.parametrize("speed", [-4.0, -1.5, 0.0, 0.75, 2.0, 3.0, 4.0])
@pytest.mark.parametrize("command", ["position", "velocity", "effort"])
def test_the_line_of_a_motor_bounds_its_torque_at_each_speed(
    tmp_path: Path, command: str, speed: float, effort: float
) -> None:
    actuator = f"{LINE}, command: {command}, {'kp: 1e6' if command != 'effort' else ''}"
    mujoco, model, data = driven(tmp_path / "robot.yaml", actuator, effort)
    name, joint = model.actuator("c_joint").id, model.joint("c_joint")
    model.actuator_ctrllimited[:] = False
    data.qvel[joint.dofadr[0]] = speed
    most = min(effort, 6.0)
    for sign in (1, -1):
        data.ctrl[name] = sign * 1e6
        mujoco.mj_forward(model, data)
        # T = τ·(±1 − ω/Ω), and never more than the effort.
        expected = max(-most, min(most, 6.0 * (sign - speed / 3.0)))
        assert data.qfrc_actuator[joint.dofadr[0]] == pytest.approx(expected, abs=1e-12)


def test_below_its_line_a_motor_is_a_servo_with_the_gains_of_the_joint(tmp_path: Path) -> None:
    responses = []
    for line in ("", f", {LINE}"):
        mujoco, model, data = driven(tmp_path / "robot.yaml", f"kp: 32, kd: 4{line}")
        dof = model.joint("c_joint").qposadr[0]
        data.ctrl[model.actuator("c_joint").id] += 0.1
        response = []
        for _ in range(200):
            mujoco.mj_step(model, data)
            response.append(float(data.qpos[dof]))
        responses.append(response)
    assert responses[0] == pytest.approx(responses[1], abs=1e-12)
    assert abs(responses[0][-1] - responses[0][0]) > 0.05


def test_a_motor_without_gains_holds_its_joint(tmp_path: Path) -> None:
    mujoco, model, data = driven(tmp_path / "robot.yaml", LINE)
    while data.time < 2:
        mujoco.mj_step(model, data)
    assert data.qpos == pytest.approx(model.key("home").qpos, abs=0.01)
    assert not any(data.warning[i].number for i in range(mujoco.mjtWarning.mjNWARNING))


@pytest.mark.parametrize("line", ["", f", {LINE}"])
@pytest.mark.parametrize("step", [0.002, 0.001, 0.0005])
def test_a_command_is_obeyed_after_the_delay(tmp_path: Path, line: str, step: float) -> None:
    mujoco, model, data = driven(tmp_path / "robot.yaml", f"kp: 32, kd: 4, delay: 10 ms{line}")
    model.opt.timestep = step
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    dof, name = model.joint("c_joint").dofadr[0], model.actuator("c_joint").id
    while data.time < 0.1:
        mujoco.mj_step(model, data)
    before, given = float(data.qfrc_actuator[dof]), data.time
    data.ctrl[name] += 0.1
    while abs(data.qfrc_actuator[dof] - before) < 1:
        mujoco.mj_step(model, data)
    # The force is that of the time before the step.
    assert data.time - step - given == pytest.approx(0.01, abs=step)


def test_the_scene_holds_the_robot_and_a_floor_that_it_stands_on(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    build = mjcf_of(ROOT / "examples" / "quadruped" / "quadruped.yaml", base="free")
    for name, content in {**build.assets, "quadruped.xml": build.xml().encode()}.items():
        (tmp_path / name).write_bytes(content)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "scene.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_forward(model, data)
    distances = [
        mujoco.mj_geomDistance(model, data, model.geom("floor").id, geom, 10.0, None)
        for geom in range(model.ngeom)
        if model.geom_contype[geom] and model.geom(geom).name != "floor"
    ]
    assert min(distances) == pytest.approx(0, abs=1e-9)


def test_inertia_with_products_is_the_same_in_mujoco(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    path = tmp_path / "robot.yaml"
    path.write_text(
        "robot: r\nmodel:\n- part: {name: base, link: {inertial: "
        "{mass: 2, xyz: 1 2 3, rpy: 0.1 0.2 0.3, inertia: 0.3 0.02 0.03 0.4 0.05 0.5}}}\n"
    )
    model = mujoco.MjModel.from_xml_string(mjcf_of(path).xml())
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[1])
    rotation = turn.reshape(3, 3)
    found = rotation @ np.diag(model.body_inertia[1]) @ rotation.T
    from scipy.spatial.transform import Rotation

    given = np.array([[0.3, 0.02, 0.03], [0.02, 0.4, 0.05], [0.03, 0.05, 0.5]])
    outer = Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix()
    assert np.abs(found - outer @ given @ outer.T).max() < 1e-14
    assert model.body_ipos[1].tolist() == [1, 2, 3]


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("base", ["fixed", "free"])
@pytest.mark.parametrize("seconds", [0.5, pytest.param(5.0, marks=pytest.mark.slow)])
def test_examples_hold_their_home(name: str, base: str, seconds: float, tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    urdf = yamaro.build(ROOT / "examples" / f"{name}.yaml", on_message=lambda line: None).xml()
    (tmp_path / "robot.urdf").write_text(with_position_actuators(urdf))
    build = mjcf_of(tmp_path / "robot.urdf", base=base)
    for file, content in {**build.assets, "robot.xml": build.xml().encode()}.items():
        (tmp_path / file).write_bytes(content)
    found = Standing(mujoco.MjModel.from_xml_path(str(tmp_path / "scene.xml")), seconds)
    assert found.is_finite
    assert not found.warnings
    assert found.worst < 0.05, found.joint


def test_fingers_that_weigh_almost_nothing_hold_their_home() -> None:
    mujoco = require_module("mujoco")
    inertial = (  # as of fingers in models of small humanoids
        '<inertial><mass value="2e-6"/><inertia ixx="1.1e-9" iyy="1.1e-9" izz="1.1e-9" ixy="0"'
        ' ixz="0" iyz="0"/></inertial>'
    )
    parts = ['<link name="wrist"/>']
    for number in range(9):
        mimic = '<mimic joint="j0" multiplier="0.999899"/>' if number else ""
        parent = "wrist" if number % 3 == 0 else f"l{number - 1}"
        limit = '<limit lower="0" upper="1" effort="0.292" velocity="8"/>'
        parts.append(
            f'<link name="l{number}">{inertial}</link><joint name="j{number}" type="revolute">'
            f'<parent link="{parent}"/><child link="l{number}"/><origin xyz="0.0144 0.01 0"/>'
            f'<axis xyz="0 1 0"/>{limit}{mimic}</joint>'
        )
    urdf = with_position_actuators(f'<robot name="hand">{"".join(parts)}</robot>')
    build = yamaro.build("hand.urdf", text=urdf, target="mjcf", on_message=print)
    found = Standing(mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets)), 1.0)
    assert not found.warnings
    assert found.worst < 0.05, found.joint


WRITTEN = sorted((CASES / "targets").glob("mjcf*.xml"))


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.stem)
def test_mujoco_reads_every_golden_case(path: Path) -> None:
    mujoco = require_module("mujoco")
    assert mujoco.MjModel.from_xml_path(str(path)).nkey >= 0


MOTORS = """
robot: rig
base: fixed
model:
- part: {name: base, link: {mass: 1, geometry: sphere, radius: 0.1}}
- for name, kd in [('weak', 0.1), ('strong', 2)]:
  - part:
      name: $(name)
      joint:
        parent: base
        type: continuous
        axis: y
        actuator: {kp: 40, kd: $(kd), stall_torque: 4.1, no_load_speed: 4.8}
      link: {mass: 1, geometry: sphere, radius: 0.1, pivot: 0 0 0.3}
"""


def test_torque_speed_lines_give_the_torques_of_older_mujoco_with_gains_in_volts() -> None:
    mujoco = require_module("mujoco")
    newest = mjcf_of(Path("-"), text=MOTORS).xml()
    model = mujoco.MjModel.from_xml_string(newest)
    data = mujoco.MjData(model)
    older = ElementTree.fromstring(mjcf_of(Path("-"), text=MOTORS, mujoco_version="3.7").xml())
    random = np.random.default_rng(1)
    for _ in range(50):
        data.qpos, data.qvel, data.ctrl = random.normal(0, (0.3, 4, 0.3), (model.nu, 3)).T
        mujoco.mj_forward(model, data)
        for index, motor in enumerate(older.iter("dcmotor")):
            # https://mujoco.readthedocs.io/en/3.7.0/_static/dcmotor.pdf, sections 1.1 and 2.5
            volts, stall, speed = map(float, motor.attrib["nominal"].split())
            kp, _, kd, _, _, most = map(float, motor.attrib["controller"].split())
            constant = volts / speed
            resistance = constant * volts / stall
            drive = kp * (data.ctrl[index] - data.qpos[index]) - kd * data.qvel[index]
            drive = min(max(drive, -most), most)
            torque = constant / resistance * (drive - constant * data.qvel[index])
            limit = float(motor.attrib["saturation"].split()[0])
            expected = min(max(torque, -limit), limit)
            assert data.actuator_force[index] == pytest.approx(expected, abs=1e-12)
