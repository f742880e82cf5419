"""Actuators: the armature and the gains that a motor gives, and the limits that a joint has of it.

The expected numbers are computed here from the definitions: the inertia of a rotor behind a gear,
and the gains of an oscillator. What the joint does with them is seen in MuJoCo.
"""

from __future__ import annotations

from math import exp, pi, sqrt
from pathlib import Path

import pytest

import yamaro
from tests.consumers.oracles import require_module
from yamaro.model.extras import Actuator
from yamaro.result import Build

ROBOT = """
robot: arm
base: fixed
variables:
  hip: {{rotor_inertia: 3.4e-6, gear: 353, stall_torque: 4.1 N*m, no_load_speed: 46 rpm}}
model:
- part: {{name: base, link: {{geometry: sphere, radius: 0.1, mass: 1}}}}
- part:
    name: arm
    joint:
      type: {type}
      parent: base
      axis: z
      {limit}
      actuator: {{{actuator}}}
    link: {{geometry: sphere, radius: 0.1, mass: {mass}}}
"""
LIMIT = "limit: {lower: -1, upper: 1, effort: 3, velocity: 2}"


def built(
    actuator: str,
    *,
    type: str = "revolute",
    limit: str = LIMIT,
    mass: str = "1",
    target: str = "urdf",
) -> Build:
    """Return the arm with an actuator; it is written without a warning."""
    text = ROBOT.format(actuator=actuator, type=type, limit=limit, mass=mass)
    build = yamaro.build("arm.yaml", text=text, target=target)
    assert [each.code for each in build.warnings if "lost" not in each.code] == []
    return build


def actuator_of(actuator: str, *, type: str = "revolute") -> Actuator:
    """Return the actuator of the arm."""
    return built(actuator, type=type).robot.actuators["arm_joint"]


@pytest.mark.parametrize(
    ("written", "armature"),
    [
        ("rotor_inertia: 3.4e-6, gear: 353", 3.4e-6 * 353**2),
        ("rotor_inertia: 34 g*mm^2, gear: -10", 3.4e-8 * 100),
        ("rotor_inertia: 0.02", 0.02),
        ("motor: {rotor_inertia: 3.4e-6, gear: 353}", 3.4e-6 * 353**2),
        ("motor: $(hip)", 3.4e-6 * 353**2),
        ("motor: $(hip), gear: 10", 3.4e-6 * 100),
        ("motor: $(hip), rotor_inertia: 1e-5", 1e-5 * 353**2),
        ("motor: $(hip), armature: 0.3", 0.3),
        ("motor: {armature: 0.3, gear: 7}, rotor_inertia: 1e-5", 1e-5 * 49),
        ("motor: {armature: 0.3, gear: 7}", 0.3),
    ],
)
def test_the_armature_is_the_inertia_of_the_rotor_times_the_square_of_the_gear(
    written: str, armature: float
) -> None:
    assert actuator_of(written).armature == pytest.approx(armature, rel=1e-14)


@pytest.mark.parametrize(
    ("written", "armature", "hertz", "zeta"),
    [
        ("armature: 0.01, frequency: 10 Hz, damping_ratio: 2", 0.01, 10, 2),
        ("armature: 0.01, frequency: 10", 0.01, 10, 1),
        ("rotor_inertia: 1e-5, gear: 20, frequency: 4 Hz, damping_ratio: 0", 0.004, 4, 0),
        ("motor: {armature: 0.2, frequency: 3, damping_ratio: 0.7}", 0.2, 3, 0.7),
        ("motor: {armature: 0.2, frequency: 3, damping_ratio: 0.7}, frequency: 5", 0.2, 5, 0.7),
        ("motor: {armature: 0.2, frequency: 3}, damping_ratio: 0.5", 0.2, 3, 0.5),
    ],
)
def test_gains_are_those_of_an_oscillator_with_the_armature(
    written: str, armature: float, hertz: float, zeta: float
) -> None:
    omega = 2 * pi * hertz
    found = actuator_of(written)
    assert found.kp == pytest.approx(armature * omega**2, rel=1e-14)
    assert found.kd == pytest.approx(2 * zeta * armature * omega, rel=1e-14)


def test_gains_in_the_actuator_take_the_place_of_those_of_its_motor() -> None:
    found = actuator_of("motor: {armature: 0.2, frequency: 3, damping_ratio: 0.7}, kp: 5")
    assert (found.kp, found.kd, found.frequency) == (5, None, None)


def test_a_velocity_actuator_has_the_velocity_gain_of_a_frequency() -> None:
    found = actuator_of("command: velocity, armature: 0.01, frequency: 2, damping_ratio: 0.5")
    assert found.kp is None
    assert found.kd == pytest.approx(2 * 0.5 * 0.01 * 4 * pi, rel=1e-14)


def test_a_joint_that_slides_has_newtons_and_kilograms() -> None:
    found = actuator_of(
        "rotor_inertia: 1e-5, gear: 600, stall_torque: 30 N, no_load_speed: 50 mm/s",
        type="prismatic",
    )
    assert found.armature == pytest.approx(3.6, rel=1e-14)
    assert (found.stall_torque, found.no_load_speed) == (30, 0.05)


def test_the_armature_alone_swings_with_the_frequency_and_damping_ratio() -> None:
    mujoco = require_module("mujoco")
    # A link of next to no mass: all the inertia is the armature.
    zeta, hertz = 0.2, 2.0
    build = built(
        f"rotor_inertia: 1e-4, gear: 30, frequency: {hertz} Hz, damping_ratio: {zeta}",
        mass="1e-9",
        limit="limit: {lower: -1, upper: 1, effort: 1000, velocity: 100}",
        target="mjcf",
    )
    model = mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets))
    model.opt.timestep, model.opt.integrator = 1e-5, mujoco.mjtIntegrator.mjINT_RK4
    data = mujoco.MjData(model)
    data.qpos[0] = 0.1
    damped = 2 * pi * hertz * sqrt(1 - zeta**2)
    while data.time < 2 * pi / damped:
        mujoco.mj_step(model, data)
    decrement = 2 * pi * zeta / sqrt(1 - zeta**2)  # after one period
    assert data.qpos[0] == pytest.approx(0.1 * exp(-decrement), rel=1e-3)


# --- limits -------------------------------------------------------------------------------------


def limit_of(actuator: str, limit: str, *, type: str = "revolute") -> tuple[float | None, ...]:
    """Return lower, upper, effort and velocity of the arm."""
    joint = built(actuator, type=type, limit=limit).robot.joints["arm_joint"]
    assert joint.limit is not None
    return joint.lower, joint.upper, joint.limit.effort, joint.limit.velocity


SPEED = 46 * 2 * pi / 60


@pytest.mark.parametrize(
    ("limit", "expected"),
    [
        ("limit: {lower: -1, upper: 1}", (-1, 1, 4.1, SPEED)),
        ("limit: {lower: -1, upper: 1, effort: 3}", (-1, 1, 3, SPEED)),
        ("limit: {lower: -1, upper: 1, velocity: 2}", (-1, 1, 4.1, 2)),
        (LIMIT, (-1, 1, 3, 2)),
    ],
)
def test_a_limit_takes_from_the_motor_what_it_does_not_say(
    limit: str, expected: tuple[float, ...]
) -> None:
    found = limit_of("motor: $(hip)", limit)
    assert found == pytest.approx(expected, rel=1e-14)


def test_a_continuous_joint_has_the_limits_of_its_motor_if_both_are_known() -> None:
    known = limit_of("motor: $(hip)", "", type="continuous")
    assert known[2:] == pytest.approx((4.1, SPEED), rel=1e-14)
    one = built("stall_torque: 4", type="continuous", limit="")
    assert one.robot.joints["arm_joint"].limit is None


def test_what_a_motor_does_not_say_is_assumed_with_a_warning() -> None:
    text = ROBOT.format(actuator="stall_torque: 4", type="revolute", limit="", mass="1")
    build = yamaro.build("arm.yaml", text=text)
    [warning] = build.warnings
    assert "assumed lower=-3.14159265358979 upper=3.14159265358979 velocity=10" in warning.message
    limit = build.robot.joints["arm_joint"].limit
    assert limit is not None
    assert (limit.effort, limit.velocity) == (4, 10)


def test_the_place_of_a_limit_is_that_of_the_motor() -> None:
    build = built("motor: $(hip)", limit="limit: {lower: -1, upper: 1}")
    joint = build.robot.joints["arm_joint"]
    assert joint.limit is not None
    effort, upper = joint.limit.span_of("effort"), joint.limit.span_of("upper")
    assert effort.source.text[effort.start : effort.end] == "$(hip)"
    assert upper.source.text[upper.start : upper.end] == "1"


# --- where robots are put together --------------------------------------------------------------


def test_attached_and_mirrored_actuators_have_the_motor_of_the_original(tmp_path: Path) -> None:
    (tmp_path / "leg.yaml").write_text(
        """
model:
- part: {name: hip, link: {geometry: sphere, radius: 0.1, mass: 1}}
- part:
    name: left_knee
    joint:
      type: revolute
      parent: hip
      axis: y
      limit: {lower: -1, upper: 1}
      actuator:
        motor: {rotor_inertia: 1e-5, gear: 30, stall_torque: 4, no_load_speed: 5}
        delay: 2 ms
    link: {geometry: sphere, radius: 0.1, mass: 1}
"""
    )
    path = tmp_path / "robot.yaml"
    path.write_text(
        """
robot: r
base: fixed
model:
- part: {name: base, link: {geometry: sphere, radius: 0.1, mass: 1}}
- mirror:
    rename: {left: right}
    body:
    - attach: {path: leg.yaml, to: base, prefix: left_}
"""
    )
    actuators = yamaro.build(path).robot.actuators
    assert len(actuators) == 2
    for name, actuator in actuators.items():
        assert name == actuator.joint
        assert actuator.armature == pytest.approx(1e-5 * 900, rel=1e-14)
        assert (actuator.gear, actuator.delay, actuator.no_load_speed) == (30, 0.002, 5)


def test_diff_reports_the_numbers_of_a_motor() -> None:
    one = built("rotor_inertia: 1e-5, gear: 30, delay: 1 ms").robot
    other = built("rotor_inertia: 1e-5, gear: 40, delay: 2 ms").robot
    changed = {change.what for change in one.changes(other)}
    assert {"gear", "armature", "delay"} <= {word for what in changed for word in what.split()}
