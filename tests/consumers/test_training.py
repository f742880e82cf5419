"""Configurations for mjlab and Isaac Lab: what they say, and that the robot beside them is there.

Stand-ins take the place of the two packages, which need a GPU's libraries: `training_stubs.py`.
`bench/training.py` loads the same files in the packages themselves.
"""

from __future__ import annotations

import json
from math import isfinite, pi
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import yamaro
from tests.consumers import oracles, training_stubs
from tests.consumers.driven import ONE_JOINT, saved
from tests.consumers.test_examples import ROBOTS, name_of
from yamaro.commands.main import main
from yamaro.targets.training import LINE, Call, Code, python

Config = dict[str, Any]
mjlab_and_both = pytest.mark.parametrize("framework", ["mjlab", "isaaclab 2.3", "isaaclab 3.0"])


def written(path: Path, framework: str, **options: Any) -> Path:
    """Write the configuration of a robot with what belongs beside it; return its path."""
    target = framework.partition(" ")[0]
    folder = path.parent / f"out{len(list(path.parent.iterdir()))}"
    build = yamaro.build(path, target=target, on_message=lambda line: None, **options)
    for name, data in build.assets.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
    document = folder / "configuration.py"
    document.write_text(build.xml(), encoding="utf-8")
    return document


def loaded(path: Path, framework: str, monkeypatch: pytest.MonkeyPatch, **options: Any) -> Config:
    """Return what the configuration of a robot defines."""
    if framework == "mjlab":
        oracles.require_module("mujoco")
        training_stubs.have_mjlab(monkeypatch)
    else:
        pytest.importorskip("pxr")
        training_stubs.have_isaaclab(monkeypatch, int(framework.rpartition(" ")[2][0]))
    return training_stubs.run(written(path, framework, **options))


def groups_of(config: Config) -> list[Any]:
    """Return the configurations of actuators."""
    robot = config["ROBOT_CFG"]
    if hasattr(robot, "articulation"):
        return list(robot.articulation.actuators)
    return list(robot.actuators.values())


def by_joint(config: Config, names: list[str]) -> dict[str, Any]:
    """Return the configuration of the actuator of each joint that one drives."""
    found: dict[str, Any] = {}
    for group in groups_of(config):
        expressions = getattr(group, "target_names_expr", None) or group.joint_names_expr
        joints = training_stubs.selected(expressions, names)
        assert len(joints) == len(expressions)
        assert found.keys().isdisjoint(joints)
        found |= dict.fromkeys(joints, group)
    return found


def effort_of(group: Any) -> float:
    """Return the greatest effort, by the name that this framework has for it."""
    names = ("joint_effort_limit", "actuator_effort_limit", "effort_limit_sim", "effort_limit")
    given = [getattr(group, name, None) for name in names]
    (value,) = {each for each in given if each is not None}
    return float(value)


# --- G1, as HybridRobotics/whole_body_tracking publishes it (commit cd65172), robots/g1.py --------

ROTORS = {"5020": 0.003609725, "7520_14": 0.010177520, "7520_22": 0.025101925, "4010": 0.00425}
"""Armatures, in kg·m²."""
G1 = {
    "hip_pitch hip_yaw waist_yaw": ("7520_14", 1, 88.0, 32.0),
    "hip_roll knee": ("7520_22", 1, 139.0, 20.0),
    "ankle_pitch ankle_roll waist_roll waist_pitch": ("5020", 2, 50.0, 37.0),
    "shoulder_pitch shoulder_roll shoulder_yaw elbow wrist_roll": ("5020", 1, 25.0, 37.0),
    "wrist_pitch wrist_yaw": ("4010", 1, 5.0, 22.0),
}
"""The motor, how many drive the joint, the greatest effort and velocity, of these joints."""
GAINS = {
    ("5020", 1): (14.25062309787429, 0.907222843292423, 0.43857731392336724),
    ("5020", 2): (28.50124619574858, 1.814445686584846, 0.43857731392336724),
    ("7520_14", 1): (40.17923847137318, 2.5578897650279457, 0.5475464652142303),
    ("7520_22", 1): (99.09842777666113, 6.3088018534966395, 0.3506614663788243),
    ("4010", 1): (16.77832748089279, 1.06814150219, 0.07450087032950714),
}
"""Stiffness, damping and action scale by motor and how many, as the formulas there give them."""

G1_ROBOT = """
robot: g1
base: free
variables:
  motors:
    m5020: {armature: 0.003609725}
    m5020x2: {armature: $(2 * 0.003609725)}
    m7520_14: {armature: 0.010177520}
    m7520_22: {armature: 0.025101925}
    m4010: {armature: 0.00425}
functions:
- Joint(name, motor, effort, velocity):
  - part:
      name: $(name)
      joint:
        type: revolute
        parent: pelvis
        axis: y
        limit: {lower: -1, upper: 1, effort: $(effort), velocity: $(velocity)}
        actuator: {motor: '$(motors[motor])', frequency: 10 Hz, damping_ratio: 2}
      link: {geometry: sphere, radius: 0.05, mass: 1}
model:
- part: {name: pelvis, link: {geometry: sphere, radius: 0.1, mass: 10}}
"""


def g1_joints() -> dict[str, tuple[str, int, float, float]]:
    """Return the motor, how many, and the limits of each of the 29 joints."""
    found: dict[str, tuple[str, int, float, float]] = {}
    for names, data in G1.items():
        for name in names.split():
            sides = [name] if name.startswith("waist") else [f"left_{name}", f"right_{name}"]
            found |= dict.fromkeys((f"{each}_joint" for each in sides), data)
    return found


@mjlab_and_both
def test_one_table_of_motors_gives_the_published_gains_of_g1(
    framework: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    joints = g1_joints()
    assert len(joints) == 29
    text = G1_ROBOT
    for name, (motor, count, effort, velocity) in joints.items():
        kind = f"m{motor}x{count}" if count > 1 else f"m{motor}"
        text += f"- Joint: {name.removesuffix('_joint')}, {kind}, {effort}, {velocity}\n"
    config = loaded(saved(tmp_path, text), framework, monkeypatch)
    groups = by_joint(config, list(joints))
    assert groups.keys() == joints.keys()
    assert len(groups_of(config)) == len(G1)
    scales = training_stubs.valued(config["ACTION_SCALE"], list(joints))
    for name, (motor, count, effort, velocity) in joints.items():
        group = groups[name]
        stiffness, damping, scale = GAINS[motor, count]
        assert group.stiffness == pytest.approx(stiffness, rel=1e-9)
        assert group.damping == pytest.approx(damping, rel=1e-9)
        assert group.armature == pytest.approx(ROTORS[motor] * count, rel=1e-9)
        assert effort_of(group) == effort
        assert scales[name] == pytest.approx(scale, rel=1e-9)
        if framework == "isaaclab 3.0":
            assert group.joint_velocity_limit == velocity
        elif framework == "isaaclab 2.3":
            assert group.velocity_limit_sim == velocity


# --- what each robot has -------------------------------------------------------------------------


def in_mujoco(path: Path) -> tuple[dict[str, Config], list[str], list[float]]:
    """Return what MuJoCo finds in the MJCF of a robot.

    That is for each joint of one number what resists it, its gains and where it starts; the joints
    in the order of their actuators; and the pose of a free root, or nothing.
    """
    mujoco = oracles.require_module("mujoco")
    build = yamaro.build(path, target="mjcf", on_message=lambda line: None, meshes="none")
    robot = build.robot
    model = mujoco.MjModel.from_xml_string(build.xml())
    found: dict[str, Config] = {}
    base: list[float] = []
    for i in range(model.njnt):
        joint = model.joint(i)
        start = model.key("home").qpos[joint.qposadr[0] :]
        if int(joint.type[0]) == int(mujoco.mjtJoint.mjJNT_FREE):
            base = [float(each) for each in start[:7]]
            continue
        dof = joint.dofadr[0]
        found[joint.name] = {
            "home": float(start[0]),
            "armature": float(model.dof_armature[dof]),
            "friction": float(model.dof_frictionloss[dof]),
            "damping": float(model.dof_damping[dof]),
        }
    driven = []
    for i in range(model.nu):
        actuator = model.actuator(i)
        name = model.joint(actuator.trnid[0]).name
        driven.append(name)
        kinds = (actuator.gainprm[0], -actuator.biasprm[1], -actuator.biasprm[2])
        found[name] |= dict(zip(("gain", "kp", "kv"), map(float, kinds), strict=True))
        found[name]["effort"] = float(actuator.forcerange[1])
        found[name]["says_damping"] = robot.actuators[name].kd is not None and bool(kinds[1])
    return found, driven, base


@pytest.mark.parametrize("path", ROBOTS, ids=name_of)
def test_mjlab_gets_of_an_example_what_mujoco_finds_in_its_mjcf(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    oracles.require_module("mujoco")
    training_stubs.have_mjlab(monkeypatch)
    expected, driven, base = in_mujoco(path)
    build = yamaro.build(path, target="mjlab", on_message=lambda line: None, meshes="none")
    config = configured(build, tmp_path)
    assert config["robot_cfg"]().sort_actuators
    groups = by_joint(config, list(expected))
    assert sorted(groups) == sorted(driven)
    for name, group in groups.items():
        own = expected[name]
        resists = (group.armature, group.frictionloss, group.viscous_damping)
        assert [each or 0.0 for each in resists] == pytest.approx(
            [own["armature"], own["friction"], own["damping"]], rel=1e-12
        )
        assert getattr(group, "stiffness", 0.0) == pytest.approx(own["kp"], rel=1e-12)
        if own["says_damping"]:  # else MuJoCo chooses one for the inertia at 0
            assert group.damping == pytest.approx(own["kv"], rel=1e-12)
        if group.effort_limit is not None and isfinite(group.effort_limit):
            assert group.effort_limit == pytest.approx(own["effort"], rel=1e-12)
    start = config["ROBOT_CFG"].init_state
    homes = training_stubs.started(start.joint_pos, expected)
    assert homes == {name: pytest.approx(own["home"]) for name, own in expected.items()}
    assert [*start.pos, *start.rot] == pytest.approx(base or [0, 0, 0, 1, 0, 0, 0])
    model = config["get_spec"]().compile()
    assert [model.nu, model.nkey, model.njnt] == [0, 0, len(expected) + bool(base)]
    assert {model.joint(i).name for i in range(model.njnt)} >= expected.keys()


@pytest.mark.parametrize("path", ROBOTS, ids=name_of)
def test_isaac_lab_gets_of_an_example_what_mujoco_finds_in_its_mjcf(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pxr = pytest.importorskip("pxr.Usd")
    training_stubs.have_isaaclab(monkeypatch, 3)
    expected, driven, base = in_mujoco(path)
    interface = yamaro.build(path, target="interface", on_message=lambda line: None)
    listing = json.loads(interface.xml())["consumers"]["isaac"]
    names = {each["name"]: each["yamaro"] for each in listing["joints"]}
    build = yamaro.build(path, target="isaaclab", on_message=lambda line: None, meshes="none")
    config = configured(build, tmp_path)
    groups = by_joint(config, list(names))
    assert sorted(names[each] for each in groups) == sorted(driven)
    for name, group in groups.items():
        own = expected[names[name]]
        resists = (group.armature, group.friction, group.viscous_friction)
        assert [each or 0.0 for each in resists] == pytest.approx(
            [own["armature"], own["friction"], own["damping"]], rel=1e-12
        )
        assert group.dynamic_friction == group.friction
        assert group.stiffness == pytest.approx(own["kp"], rel=1e-12)
        if own["says_damping"]:
            assert group.damping == pytest.approx(own["kv"], rel=1e-12)
        assert not any(getattr(group, each) for each in training_stubs.OLD_LIMITS)
        if own["effort"]:
            assert effort_of(group) == pytest.approx(own["effort"], rel=1e-12)
    start = config["ROBOT_CFG"].init_state
    given = {name: value for name, value in start.joint_pos.items() if name != ".*"}
    homes = {names[name]: value for name, value in training_stubs.valued(given, names).items()}
    for own_name in names.values():
        if own_name in expected:
            home = homes.get(own_name, 0.0)
            assert home == pytest.approx(expected[own_name]["home"], abs=2e-6)
    if base:  # the root in USD may be another link of the same body, above that of MJCF
        assert start.pos[2] >= base[2]
    stage = pxr.Stage.Open(config["ROBOT_CFG"].spawn.usd_path)
    prims = {each.GetName() for each in stage.Traverse()}
    assert {name.partition(":")[0] for name in names} <= prims


# --- kinds of actuators --------------------------------------------------------------------------


def configured(build, folder: Path):
    """Return what the file of a configuration defines, saved with its assets and run."""
    (folder / "assets").mkdir()
    for name, data in build.assets.items():
        (folder / name).write_bytes(data)
    text = build.xml()
    assert max(map(len, text.splitlines())) <= LINE
    (folder / "robot.py").write_text(text, encoding="utf-8")
    return training_stubs.run(folder / "robot.py")


@pytest.mark.parametrize(
    ("actuator", "mjlab", "isaac", "values"),
    [
        ("{kp: 7, kd: 1}", "BuiltinPosition", "Implicit", {"stiffness": 7, "damping": 1}),
        ("{command: velocity, kd: 3}", "BuiltinVelocity", "Implicit", {"damping": 3}),
        ("{command: effort}", "BuiltinMotor", "Implicit", {}),
        (
            "{kp: 7, kd: 1, stall_torque: 4, no_load_speed: 9}",
            *("DcMotor", "DCMotor"),
            {"stiffness": 7, "damping": 1, "saturation_effort": 4, "effort_limit": 4},
        ),
        (
            "{command: effort, stall_torque: 40, no_load_speed: 9}",
            *("DcMotor", "DCMotor"),
            {"stiffness": 0, "damping": 0, "saturation_effort": 40, "effort_limit": 5},
        ),
        (
            "{kp: 7, kd: 1, delay: 20 ms}",
            *("BuiltinPosition", "DelayedPD"),
            {"stiffness": 7, "damping": 1},
        ),
    ],
)
def test_kinds_of_actuators(
    actuator: str,
    mjlab: str,
    isaac: str,
    values: Config,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    path = saved(tmp_path, ONE_JOINT.format(actuator=actuator))
    for framework, kind in (("mjlab", f"{mjlab}Actuator"), ("isaaclab 2.3", isaac)):
        config = loaded(path, framework, monkeypatch)
        (group,) = groups_of(config)
        assert type(group).__name__.removesuffix("Cfg").removesuffix("Actuator") in kind
        for name, value in values.items():
            assert getattr(group, name) == value
        if "no_load_speed" in actuator:
            assert group.velocity_limit == 9
        else:
            assert effort_of(group) == 5
        if "delay" in actuator:
            low, high = ("min", "max") if framework != "mjlab" else ("delay_min", "delay_max")
            ends = [f"{low}_delay", f"{high}_delay"]
            if framework == "mjlab":
                ends = ["delay_min_lag", "delay_max_lag"]
            assert [getattr(group, each) for each in ends] == [4, 4]
            finer = config["robot_cfg"](timestep=0.002)
            (group,) = groups_of({"ROBOT_CFG": finer})
            assert [getattr(group, each) for each in ends] == [10, 10]


def test_isaac_lab_alone_drives_the_joints_that_take_efforts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Isaac Lab 3.0 on Newton has the actuators of the USD as well, which would act twice."""
    pytest.importorskip("pxr")
    path = saved(tmp_path, ONE_JOINT.format(actuator="{command: effort}"))
    assert 'NewtonActuator "' in yamaro.build(path, target="usd").xml()
    usd = Path(loaded(path, "isaaclab 3.0", monkeypatch)["ROBOT_CFG"].spawn.usd_path)
    text = usd.read_text(encoding="utf-8")
    assert "NewtonActuator" not in text
    assert 'PhysicsRevoluteJoint "arm_joint"' in text


def test_a_motor_with_a_line_bounds_efforts_as_that_of_mujoco_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`DcMotorActuator.control_law` of mjlab 1.6 and `DCMotor` of Isaac Lab have this formula."""
    mujoco = oracles.require_module("mujoco")
    actuator = "{kp: 700, kd: 2, stall_torque: 8, no_load_speed: 9}"
    path = saved(tmp_path, ONE_JOINT.format(actuator=actuator))
    model = mujoco.MjModel.from_xml_string(yamaro.build(path, target="mjcf").xml())
    data = mujoco.MjData(model)
    (group,) = groups_of(loaded(path, "mjlab", monkeypatch))
    for target in (-1.0, -0.002, 0.0, 0.003, 1.0):
        for speed in (-20.0, -8.0, -1.0, 0.0, 2.0, 6.0, 12.0):
            mujoco.mj_resetData(model, data)
            data.ctrl[0], data.qvel[0] = target, speed
            mujoco.mj_forward(model, data)
            wanted = group.stiffness * target - group.damping * speed
            low, high = (
                group.saturation_effort * (end - speed / group.velocity_limit) for end in (-1, 1)
            )
            low, high = max(low, -group.effort_limit), min(high, group.effort_limit)
            found = min(max(wanted, low), high)
            if -group.effort_limit <= min(low, high) and max(low, high) <= group.effort_limit:
                assert data.actuator_force[0] == pytest.approx(found, rel=1e-9, abs=1e-9)


# --- names, bases, and what is not there ---------------------------------------------------------


@mjlab_and_both
def test_expressions_select_one_joint_each(
    framework: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = ["arm", "arm_2", "xarm", "a.m", "a+m", "(arm", "arm$", "ä"]
    parts = "".join(
        f"""
- part:
    name: p{index}
    joint/name="{name}":
      {{type: continuous, parent: base, axis: z, actuator: {{kp: {index + 1}}}}}
    link: {{geometry: sphere, radius: 0.1, mass: 1}}"""
        for index, name in enumerate(names)
    )
    states = "".join(f"    {json.dumps(name)}: {index + 1}\n" for index, name in enumerate(names))
    text = f"""
robot: names
base: fixed
states:
  home:
{states}model:
- part: {{name: base, link: {{geometry: box, size: 1 1 1, mass: 1}}}}{parts}
"""
    path = saved(tmp_path, text)
    config = loaded(path, framework, monkeypatch)
    known = names
    if framework != "mjlab":
        listing = json.loads(yamaro.build(path, target="interface").xml())["consumers"]["isaac"]
        own = {each["yamaro"]: each["name"] for each in listing["joints"]}
        known = [own[name] for name in names]
    groups = by_joint(config, known)
    assert [groups[name].stiffness for name in known] == [1, 2, 3, 4, 5, 6, 7, 8]
    start = config["ROBOT_CFG"].init_state.joint_pos
    read = training_stubs.started if framework == "mjlab" else training_stubs.valued
    found = read(start, known)
    assert [found[name] for name in known] == [1, 2, 3, 4, 5, 6, 7, 8]


def test_a_robot_without_joints_starts_without_any(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    part = "part: {name: box, link: {geometry: box, size: 1 1 1, mass: 1, collision: }}"
    text = f"robot: box\nbase: free\nmodel:\n- {part}\n"
    path = saved(tmp_path, text)
    start = loaded(path, "isaaclab 3.0", monkeypatch)["ROBOT_CFG"].init_state
    assert (start.joint_pos, start.joint_vel) == ({}, {})
    assert start.pos == (0.0, 0.0, 0.5)
    config = loaded(path, "mjlab", monkeypatch)
    assert config["ROBOT_CFG"].init_state.pos == (0.0, 0.0, 0.5)
    assert config["ACTION_SCALE"] == {}


@pytest.mark.parametrize(
    ("framework", "rot"),
    [("mjlab", (0.5**0.5, 0, 0, 0.5**0.5)), ("isaaclab 3.0", (0, 0, 0.5**0.5, 0.5**0.5))],
)
def test_a_base_that_is_turned(
    framework: str, rot: tuple[float, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = """
robot: turned
model:
- link/name=world:
- part:
    name: body
    joint: {type: floating, parent: world, xyz: 1 2 3, rpy: 0 0 90deg}
    link: {geometry: box, size: 1 1 1, mass: 1}
- part:
    name: wheel
    joint: {type: continuous, parent: body, axis: z, actuator: {kp: 1}}
    link: {geometry: sphere, radius: 0.1, mass: 1}
"""
    path = saved(tmp_path, text)
    start = loaded(path, framework, monkeypatch)["ROBOT_CFG"].init_state
    assert start.pos == pytest.approx((1, 2, 3))
    assert start.rot == pytest.approx(rot)
    if framework != "mjlab":
        older = loaded(path, "isaaclab 2.3", monkeypatch)["ROBOT_CFG"].init_state
        assert older.rot == pytest.approx((0.5**0.5, 0, 0, 0.5**0.5))


def test_a_position_at_a_limit_is_inside_of_it_in_single_precision(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    numpy = pytest.importorskip("numpy")
    limits = [(-2.0, 1.3), (0.1, 0.7), (-0.9, -0.3), (0.0, 2.9)]
    for lower, upper in limits:
        for home in (lower, upper):
            text = ONE_JOINT.format(actuator="{kp: 1}").replace(
                "lower: -1, upper: 1", f"lower: {lower}, upper: {upper}"
            )
            text = text.replace("model:", f"states: {{home: {{arm_joint: {home}}}}}\nmodel:", 1)
            start = loaded(saved(tmp_path, text), "isaaclab 3.0", monkeypatch)["ROBOT_CFG"]
            given = numpy.float32(start.init_state.joint_pos.get("arm_joint", 0.0))
            low, high = (
                numpy.float32(numpy.float32(end * 180 / pi) * numpy.float32(pi / 180))
                for end in (lower, upper)
            )
            assert low <= given <= high
            assert float(given) == pytest.approx(home, abs=5e-6)


@pytest.mark.parametrize("framework", ["mjlab", "isaaclab 3.0"])
def test_models_find_their_meshes_and_textures(
    framework: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    image = pytest.importorskip("PIL.Image")
    image.new("RGB", (2, 2), (255, 0, 0)).save(tmp_path / "red.png")
    trimesh = pytest.importorskip("trimesh")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    look = "{geometry: box, size: 1 1 1, material: {name: red, texture: red.png}}"
    link = f"{{geometry: box.stl, mass: 1, collision: , visual: {look}}}"
    path = saved(tmp_path, f"robot: one\nbase: free\nmodel:\n- part: {{name: one, link: {link}}}\n")
    config = loaded(path, framework, monkeypatch)
    if framework == "mjlab":
        model = config["get_spec"]().compile()
        assert [model.nmesh, model.ntex] == [1, 1]
        return
    from pxr import UsdUtils

    usd = config["ROBOT_CFG"].spawn.usd_path
    _, files, missing = UsdUtils.ComputeAllDependencies(usd)
    assert {Path(each).suffix for each in files} == {".png"}
    assert missing == []


def test_isaac_lab_needs_what_usd_needs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    import sys

    for name in [each for each in sys.modules if each.startswith("yamaro.targets.usd")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delitem(sys.modules, "yamaro.targets.isaaclab.writer", raising=False)
    monkeypatch.setitem(sys.modules, "pxr", None)
    path = saved(tmp_path, ONE_JOINT.format(actuator="{kp: 1}"))
    with pytest.raises(yamaro.YamaroError) as raised:
        yamaro.build(path, target="isaaclab")
    (error,) = raised.value.diagnostics
    assert error.code == "missing-extra"
    assert error.hint == "pip install 'yamaro[usd]'"


# --- files ---------------------------------------------------------------------------------------


def test_the_command_writes_a_module_and_the_robot_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    oracles.require_module("mujoco")
    training_stubs.have_mjlab(monkeypatch)
    monkeypatch.chdir(tmp_path)
    text = ONE_JOINT.format(actuator="{kp: 1}").replace("robot: kinds", "robot: 2f-85")
    path = saved(tmp_path, text)
    for _ in range(2):
        assert main([str(path), "--to", "mjlab,mjcf", "-o", "out/", "-q"]) == 0
    files = {str(each.relative_to("out")) for each in Path("out").rglob("*") if each.is_file()}
    (model,) = (each for each in files if each.startswith("assets"))
    assert files == {"robot_2f_85_mjlab.py", "2f-85.xml", "scene.xml", model}
    monkeypatch.syspath_prepend(str(tmp_path / "out"))
    module = __import__("robot_2f_85_mjlab")
    assert module.get_spec().compile().njnt == 1
    assert main([str(path), "--to", "mjlab"]) == 2
    assert "mjlab needs files beside the document: -o FILE" in capsys.readouterr().err


values = st.recursive(
    st.one_of(st.floats(allow_nan=False), st.integers(), st.text()),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.lists(inner, max_size=3).map(tuple),
        st.dictionaries(st.text(max_size=5), inner, max_size=3),
    ),
    max_leaves=12,
)


@given(values)
def test_python_gives_values_back(value: object) -> None:
    found = eval(python(value, "", "    "), {"float": float})
    assert _rounded(found) == _rounded(value)


def _rounded(value: object) -> object:
    """Return a value with numbers of 15 digits, as they are written."""
    if isinstance(value, float):
        return float(f"{value:.15g}")
    if isinstance(value, dict):
        return {key: _rounded(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return type(value)(map(_rounded, value))
    return value


def test_python_writes_calls_with_comments_above_them() -> None:
    call = Call("Group", {"names": ("a",), "lag": Code("2 * x"), "**": Call("more", {"b": 1.0})})
    assert python(call) == 'Group(names=("a",), lag=2 * x, **more(b=1.0))'
    call.comment = "As it is."
    assert python([call]).splitlines() == [
        "[",
        "    # As it is.",
        '    Group(names=("a",), lag=2 * x, **more(b=1.0)),',
        "]",
    ]
