"""Loops: closed at `home`, read beside a URDF, and judged by pinocchio, MuJoCo and Drake."""

from __future__ import annotations

import re
import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import yamaro
from tests.fenced import read_blocks
from yamaro.commands.main import main

pin = pytest.importorskip("pinocchio")
mujoco = pytest.importorskip("mujoco")

PAGE = Path(__file__).parents[2] / "docs" / "loops.md"
BLOCKS = read_blocks(PAGE.read_text(encoding="utf-8"))
FOUR_BAR = next(each.text for each in BLOCKS if each.language == "yaml")
DELTA = """\
robot: delta
base: fixed
functions:
  Arm(number):
  - part:
      name: upper_$(number)
      joint:
        type: revolute
        parent: base
        xyz: $(0.1 * cos(120 * deg * number)) $(0.1 * sin(120 * deg * number)) 0
        rpy: 0 0 $(120 * deg * number)
        axis: y
        limit: {lower: -30deg, upper: 60deg, effort: 20, velocity: 5}
        actuator: {command: position, kp: 100, kd: 1}
      link: {geometry: box, scale: 0.2 0.02 0.02, xyz: 0.1 0 0, mass: 0.2}
  - part:
      name: swing_$(number)
      joint: {type: continuous, parent: upper_$(number), xyz: 0.2 0 0, axis: y}
      link: {geometry: sphere, scale: 0.01, mass: 0.01}
  - part:
      name: rod_$(number)
      joint: {type: continuous, parent: swing_$(number), axis: x}
      link:
        {geometry: box, scale: 0.01 0.01 0.4, xyz: 0 0 -0.2, mass: 0.05,
         frame/name=rod_end_$(number): {xyz: 0 0 -0.4}}
  - loop: {name: ball_$(number), type: ball, between: ['rod_end_$(number)', 'corner_$(number)']}
model:
- part: {name: base, link: {geometry: cylinder, radius: 0.15, length: 0.02, mass: 2}}
- for axis in ['x', 'y']:
  - part:
      name: platform_$(axis)
      joint: {type: prismatic, parent: "$('base' if axis == 'x' else 'platform_x')", axis: $(axis),
              limit: {lower: -0.3, upper: 0.3, effort: 0, velocity: 5}}
      link: {geometry: sphere, scale: 0.01, mass: 0.01}
- part:
    name: platform
    joint: {type: prismatic, parent: platform_y, axis: z, xyz: 0 0 -0.34,
            limit: {lower: -0.3, upper: 0.3, effort: 0, velocity: 5}}
    link:
      geometry: cylinder
      radius: 0.05
      length: 0.01
      mass: 0.1
      for number in range(3):
        frame/name=corner_$(number):
          xyz: $(0.05 * cos(120 * deg * number)) $(0.05 * sin(120 * deg * number)) 0
- for number in range(3):
  - Arm: $(number)
states: {home: {swing_0: 38deg, swing_1: 38deg, swing_2: 38deg}}
"""
GRIPPER = """\
robot: gripper
base: fixed
functions:
  Finger(side, s):
  - part:
      name: $(side)_driver
      joint:
        type: revolute
        parent: base
        xyz: $(0.03 * s) 0 0
        axis: 0 $(s) 0
        limit: {lower: -0.2, upper: 0.5, effort: 5, velocity: 2}
        if side == 'right':
          mimic: left_driver
        else:
          actuator: {command: position, kp: 10, kd: 1}
      link: {geometry: sphere, scale: 0.01, mass: 0.02}
  - part:
      name: $(side)_coupler
      joint: {type: continuous, parent: $(side)_driver, xyz: $(0.03 * s) 0 0.03, axis: 0 $(s) 0}
      link: {geometry: sphere, scale: 0.01, mass: 0.02,
             frame/name=$(side)_pin: {xyz: $(-0.01 * s) 0 0.03}}
  - part:
      name: $(side)_spring
      joint: {type: continuous, parent: base, xyz: $(0.013 * s) 0 0.02, axis: 0 $(s) 0}
      link: {geometry: sphere, scale: 0.01, mass: 0.02,
             frame/name=$(side)_end: {xyz: $(0.0372 * s) 0 0.04}}
  - loop: {name: $(side)_hinge, type: revolute, between: ['$(side)_end', '$(side)_pin'], axis: y}
model:
- part: {name: base, link: {geometry: box, scale: 0.1 0.05 0.02, mass: 0.5}}
- Finger: left, 1
- Finger: right, -1
"""
ANKLE = """\
robot: ankle
base: fixed
functions:
  Motor(side, y):
  - part:
      name: $(side)_crank
      joint:
        type: revolute
        parent: shank
        xyz: -0.05 $(y) -0.2
        axis: y
        limit: {lower: -0.5, upper: 0.5, effort: 30, velocity: 10}
        actuator: {command: position, kp: 100, kd: 1}
      link: {geometry: sphere, scale: 0.01, mass: 0.02}
  - part:
      name: $(side)_yoke
      joint: {type: continuous, parent: $(side)_crank, xyz: -0.04 0 0, axis: y}
      link: {geometry: sphere, scale: 0.005, mass: 0.01}
  - part:
      name: $(side)_rod
      joint: {type: continuous, parent: $(side)_yoke, axis: x}
      link: {geometry: sphere, scale: 0.005, mass: 0.01,
             frame/name=$(side)_rod_end: {xyz: 0 0 -0.201}}
  - loop: {name: $(side)_ball, type: ball, between: ['$(side)_rod_end', '$(side)_corner']}
model:
- part: {name: shank, link: {geometry: box, scale: 0.05 0.05 0.4, xyz: 0 0 -0.2, mass: 2}}
- part:
    name: pitch
    joint: {type: revolute, parent: shank, xyz: 0 0 -0.4, axis: y,
            limit: {lower: -1, upper: 1, effort: 0, velocity: 9}}
    link: {geometry: sphere, scale: 0.01, mass: 0.05}
- part:
    name: foot
    joint: {type: revolute, parent: pitch, axis: x,
            limit: {lower: -1, upper: 1, effort: 0, velocity: 9}}
    link:
      geometry: box
      scale: 0.2 0.08 0.02
      mass: 0.5
      frame/name=left_corner: {xyz: -0.09 0.04 0}
      frame/name=right_corner: {xyz: -0.09 -0.04 0}
- Motor: left, 0.04
- Motor: right, -0.04
"""
ROBOTS = {"four_bar": FOUR_BAR, "delta": DELTA, "gripper": GRIPPER, "ankle": ANKLE}
CLOSED = 1e-9
"""In metres."""


def code_of_the_example() -> dict[str, Any]:
    """Return what the example that the page names defines."""
    return runpy.run_path(str(PAGE.parents[1] / "examples" / "pinocchio_loops.py"))


@pytest.mark.parametrize("name", ROBOTS)
def test_loops_are_closed_at_home_and_in_100_poses(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, urdf = tmp_path / "robot.yaml", tmp_path / "robot.urdf"
    source.write_text(ROBOTS[name])
    assert main([str(source), "-q", "-o", str(urdf)]) == 0, capsys.readouterr().err
    page = code_of_the_example()
    model = pin.buildModelFromUrdf(str(urdf))
    beside = tmp_path / "robot.loops.yaml"
    constraints = page["read_loops"](model, str(beside))
    given = yaml.safe_load(beside.read_text())
    home = positions_in(model, given["home"])
    assert np.abs(page["gap"](model, constraints, home)).max() < CLOSED
    robot = yamaro.build(str(source)).robot
    driven = {a.joint for a in robot.actuators.values()}
    driven |= {
        j.name
        for j in robot.joints.values()
        if j.mimic and j.mimic.joint in driven and name == "gripper"
    }
    passive = [
        model.joints[model.getJointId(joint)].idx_v
        for joint in given["home"]
        if joint not in driven
    ]
    judges = [of_mujoco(source, robot), of_drake(urdf, robot)]
    random = np.random.default_rng(1)
    for number in range(101):
        q = home.copy()
        if number:
            share = random.uniform(0.1, 0.9, len(driven))
            if name == "gripper":
                share[:] = share[0]
            for joint, part in zip(sorted(driven), share, strict=True):
                lower, upper = robot.joints[joint].lower, robot.joints[joint].upper
                assert lower is not None and upper is not None
                q[model.joints[model.getJointId(joint)].idx_q] = lower + part * (upper - lower)
            q = page["close"](model, constraints, q, passive)
        assert np.abs(page["gap"](model, constraints, q)).max() < CLOSED, number
        values = values_of(model, q)
        for judge in judges:
            assert judge(values) < CLOSED, number


def positions_in(model: Any, values: dict[str, float]) -> Any:
    q = pin.neutral(model)
    for name, value in values.items():
        joint = model.joints[model.getJointId(name)]
        row = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]
        q[joint.idx_q : joint.idx_q + joint.nq] = row
    return q


def values_of(model: Any, q: Any) -> dict[str, float]:
    """Return the positions of the joints by name, angles as one number."""
    values = {}
    for name, joint in zip(list(model.names)[1:], list(model.joints)[1:], strict=True):
        row = q[joint.idx_q : joint.idx_q + joint.nq]
        values[name] = float(row[0] if joint.nq == 1 else np.arctan2(row[1], row[0]))
    return values


def of_mujoco(source: Path, robot: yamaro.Robot) -> Any:
    """Return how far the sites of the equalities in the MJCF are apart, for given positions."""
    build = yamaro.build(str(source), target="mjcf")
    model = mujoco.MjModel.from_xml_string(build.xml())
    data = mujoco.MjData(model)
    pairs = [
        (model.eq_obj1id[i], model.eq_obj2id[i])
        for i in range(model.neq)
        if model.eq_objtype[i] == mujoco.mjtObj.mjOBJ_SITE
    ]
    assert len(pairs) >= len(robot.loops)

    def gap(values: dict[str, float]) -> float:
        for name, value in values.items():
            data.joint(name).qpos[0] = value
        mujoco.mj_kinematics(model, data)
        return float(max(np.abs(data.site_xpos[a] - data.site_xpos[b]).max() for a, b in pairs))

    gap_at_home = gap(
        {model.joint(i).name: float(model.key("home").qpos[i]) for i in range(model.njnt)}
    )
    assert gap_at_home < CLOSED
    return gap


def of_drake(urdf: Path, robot: yamaro.Robot) -> Any:
    """Return how far the frames of the loops are apart in Drake's tree, for given positions."""
    pytest.importorskip("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(1e-3)
    text = re.sub(r"<mimic [^>]*>", "", urdf.read_text())  # all joints are set here
    Parser(plant).AddModelsFromString(text, "urdf")
    plant.WeldFrames(
        plant.world_frame(),
        plant.GetFrameByName("base_link" if "base_link" in robot.links else "shank_link"),
    )
    plant.Finalize()
    context = plant.CreateDefaultContext()

    def gap(values: dict[str, float]) -> float:
        q = np.zeros(plant.num_positions())
        for name, value in values.items():
            q[plant.GetJointByName(name).position_start()] = value
        plant.SetPositions(context, q)
        gaps = []
        for loop in robot.loops.values():
            one, other = (
                plant.GetFrameByName(each).CalcPoseInWorld(context) for each in loop.between
            )
            gaps.append(np.abs(one.translation() - other.translation()).max())
        return float(max(gaps))

    return gap


def test_mimics_of_a_parallelogram_keep_it_closed(tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(FOUR_BAR)
    assert main([str(tmp_path / "robot.yaml"), "-q", "-o", str(tmp_path / "robot.urdf")]) == 0
    text = (tmp_path / "robot.urdf").read_text()
    assert text.count("<mimic") == 2
    model = pin.buildModelFromXML(text, mimic=True)
    assert model.nv == 1
    page = code_of_the_example()
    plain = pin.buildModelFromXML(text)
    constraints = page["read_loops"](plain, str(tmp_path / "robot.loops.yaml"))
    robot = yamaro.build(str(tmp_path / "robot.yaml")).robot
    for crank in np.linspace(np.radians(-150), np.radians(-30), 100):
        values = {"crank_joint": crank, "coupler_joint": -crank, "rocker_joint": crank + np.pi}
        assert np.abs(page["gap"](plain, constraints, positions_in(plain, values))).max() < CLOSED
        given = {
            name: joint.mimic.multiplier * crank + joint.mimic.offset
            for name, joint in robot.joints.items()
            if joint.mimic
        }
        assert given == pytest.approx({name: values[name] for name in given}, abs=1e-12)


@pytest.mark.parametrize("name", ["delta", "gripper", "ankle"])
def test_relations_that_are_not_linear_are_no_mimics(name: str) -> None:
    build = yamaro.build("-", text=ROBOTS[name])
    assert build.xml().count("<mimic") == (1 if name == "gripper" else 0)
    [(file, data)] = build.assets.items()
    assert file == f"{name}.loops.yaml"
    assert not any(loop["exact"] for loop in yaml.safe_load(data)["loops"])


@pytest.mark.parametrize("name", ["delta", "gripper", "ankle"])
def test_home_is_closed_and_says_how(name: str) -> None:
    build = yamaro.build("-", text=ROBOTS[name])
    found = [each for each in build.warnings if each.code == "closed-loop"]
    assert len(found) == len(build.robot.loops)
    hint = found[0].hint or ""
    assert "to say so, write states: {home: {" in hint
    written = yaml.safe_load(hint.partition("write ")[2])["states"]
    text, _, states = ROBOTS[name].partition("states: ")
    said = yaml.safe_load(states)["home"] if states else {}
    both = {f"{key}_joint": value for key, value in said.items()} | written["home"]
    again = yamaro.build("-", text=text + yaml.safe_dump({"states": {"home": both}}, width=9999))
    assert not [each for each in again.warnings if each.code in ("closed-loop", "open-loop")]


def test_what_is_open_by_a_tenth_of_the_robot_stays_open() -> None:
    text = FOUR_BAR.replace("{crank: -90deg, coupler: 90deg, rocker: 90deg}", "{crank: -90deg}")
    build = yamaro.build("-", text=text, target="mjcf")
    assert [each.code for each in build.warnings if "loop" in each.code] == ["open-loop"]
    assert build.robot.states["home"].positions == {"crank_joint": pytest.approx(-np.pi / 2)}


def test_without_a_file_beside_it_a_loop_is_an_error(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    source = tmp_path / "robot.yaml"
    source.write_text(ANKLE)
    assert main([str(source)]) == 1
    assert "error[lost-in-urdf]: URDF cannot hold the loop 'left_ball'" in capsys.readouterr().err
    assert main([str(source), "--allow", "lost-in-urdf"]) == 0
    with pytest.raises(yamaro.YamaroError, match="lost-in-urdf"):
        yamaro.convert(str(source))
    assert main(["tree", str(source)]) == 0
    source.write_text(FOUR_BAR)
    assert main([str(source)]) == 0, "its joints follow exactly"


def test_a_file_of_the_users_is_not_replaced(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    source, beside = tmp_path / "robot.yaml", tmp_path / "robot.loops.yaml"
    source.write_text(ANKLE)
    beside.write_text("mine: 1\n")
    for more in ([], ["--to", "urdf"]):
        assert main([str(source), "-q", "-o", str(tmp_path / "robot.urdf"), *more]) != 0
        assert "robot.loops.yaml" in capsys.readouterr().err
        assert beside.read_text() == "mine: 1\n"
        assert not (tmp_path / "robot.urdf").exists()


def test_a_picture_has_nothing_beside_it(tmp_path: Path) -> None:
    pytest.importorskip("vtk")
    source = tmp_path / "robot.yaml"
    source.write_text(ANKLE)
    words = ["picture", str(source), "-q", "--size", "60x40", "-o", str(tmp_path / "a.png")]
    assert main(words) == 0
    assert {each.name for each in tmp_path.iterdir()} == {"robot.yaml", "a.png"}


@pytest.mark.parametrize("mode", ["--safe", "--jail"])
def test_a_confined_build_has_the_file_too(mode: str, tmp_path: Path) -> None:
    source = tmp_path / "robot.yaml"
    source.write_text(ANKLE)
    trusted = yamaro.build(str(source), output=str(tmp_path / "a.urdf")).assets
    assert main([str(source), "-q", mode, "-o", str(tmp_path / "a.urdf")]) == 0
    assert (tmp_path / "a.loops.yaml").read_bytes() == trusted["a.loops.yaml"]
