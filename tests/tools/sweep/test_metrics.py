"""The metrics of sweeps, against formulas and other programs."""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import TYPE_CHECKING

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.later import Later
from tests.tools.sweep.robots import EXAMPLES, elbow_arm, joint, robot_of, variant_of
from yamaro.model.positions import home_positions
from yamaro.model.shapes import Box, Cylinder, Sphere
from yamaro.tools.sweep.evaluation import Evaluation
from yamaro.tools.sweep.geometry import Chain, bounding_box, reach, tips_of, workspace
from yamaro.tools.sweep.metrics import compiled, hold, lowest_point, without_sensors

if TYPE_CHECKING:
    from scipy.optimize import brentq, minimize
else:
    brentq = Later("scipy.optimize", "brentq")
    minimize = Later("scipy.optimize", "minimize")

ROBOTS = ["quadruped/quadruped.yaml", "hexapod/hexapod.yaml", "arm/arm.yaml"]


def metric(word, path, arguments=None):
    return Evaluation.parse([word], None, "")(variant_of(path, arguments))


# --- reach ---


def test_the_reach_of_an_arm_is_the_sum_of_its_lengths() -> None:
    assert reach(elbow_arm(0.5, 0.3)) == pytest.approx(0.8, rel=1e-12)


def test_an_elbow_that_cannot_be_straight_reaches_by_the_law_of_cosines() -> None:
    arm = elbow_arm(0.5, 0.3, elbow=(pi / 3, 2.8))
    assert reach(arm) == pytest.approx(sqrt(0.25 + 0.09 + 2 * 0.5 * 0.3 * cos(pi / 3)), rel=1e-12)


def test_a_joint_that_slides_reaches_from_one_of_its_ends() -> None:
    slide = joint(
        "base_slide", "tip", xyz="0 0.3 0", axis="1 0 0", limits=(-0.7, 0.4), kind="prismatic"
    )
    assert reach(robot_of(slide)) == pytest.approx(sqrt(0.3**2 + 0.7**2), rel=1e-12)


def test_joints_that_follow_others_take_part() -> None:
    # The elbow turns back by as much as the shoulder turns forth: the second link keeps its
    # direction, and the distance of (cos q + 1, sin q) is the greatest at 0, here at the limit.
    mimic = '<mimic joint="base_q" multiplier="-1"/>'
    arm = robot_of(
        joint("base_q", "upper", axis="0 1 0", limits=(0.4, 2)),
        joint("upper_r", "lower", xyz="1 0 0", axis="0 1 0", rest=mimic),
        joint("lower_end", "tip", xyz="1 0 0", kind="fixed"),
    )
    assert reach(arm) == pytest.approx(sqrt(2 + 2 * cos(0.4)), rel=1e-9)


@pytest.mark.parametrize("path", ROBOTS)
def test_scipy_and_pinocchio_find_nothing_farther(path) -> None:
    pinocchio = require_module("pinocchio")
    build = yamaro.build(EXAMPLES / path, on_message=lambda _: None)
    tip = tips_of(build.robot)[-1]
    model = pinocchio.buildModelFromXML(build.xml())
    data, frame = model.createData(), model.getFrameId(tip)
    low = np.clip(model.lowerPositionLimit, -pi, None)
    high = np.clip(model.upperPositionLimit, None, pi)

    def nearness(positions):
        pinocchio.framesForwardKinematics(model, data, positions)
        return -np.linalg.norm(data.oMf[frame].translation)

    bounds = list(zip(low, high, strict=True))
    starts = np.random.default_rng(1).uniform(low, high, (12, model.nq))
    farthest = max(-minimize(nearness, start, bounds=bounds).fun for start in starts)
    assert reach(build.robot, [tip]) == pytest.approx(farthest, rel=1e-6)


def test_a_joint_without_an_end_has_no_farthest_place() -> None:
    slide = joint("base_slide", "tip", axis="1 0 0", limits=(-1e16, 1e16), kind="prismatic")
    with pytest.raises(yamaro.YamaroError, match=r"metric-failed.*'base_slide' has no limits"):
        reach(robot_of(slide))


# --- workspace ---


@pytest.mark.parametrize(("upper", "lower"), [(0.5, 0.5), (0.5, 0.3), (1.0, 0.2)])
def test_an_arm_that_turns_freely_fills_a_hollow_ball(upper, lower) -> None:
    ball = 4 / 3 * pi * ((upper + lower) ** 3 - abs(upper - lower) ** 3)
    assert workspace(elbow_arm(upper, lower), "tip") == pytest.approx(ball, rel=0.02)


def test_a_quarter_of_the_yaw_is_half_of_the_ball_if_the_shoulder_turns_over() -> None:
    arm = elbow_arm(0.5, 0.3, yaw=(-pi / 2, 0))
    assert workspace(arm, "tip") == pytest.approx(2 / 3 * pi * (0.8**3 - 0.2**3), rel=0.02)


def test_a_gantry_fills_a_box() -> None:
    slides = [
        joint(f"{parent}_s", child, axis=axis, limits=(0, length), kind="prismatic")
        for parent, child, axis, length in [
            ("base", "a", "1 0 0", 2.0), ("a", "b", "0 1 0", 0.5), ("b", "tip", "0 0 1", 0.3)
        ]
    ]  # fmt: skip
    assert workspace(robot_of(*slides), "tip") == pytest.approx(0.3, rel=0.02)


def test_what_stays_in_a_plane_or_on_a_sphere_has_no_volume() -> None:
    planar = robot_of(
        joint("base_a", "a"),
        joint("a_b", "b", xyz="0.5 0 0"),
        joint("b_c", "c", xyz="0.4 0 0"),
        joint("c_end", "tip", xyz="0.3 0 0", kind="fixed"),
    )
    assert workspace(planar, "tip") == 0
    assert workspace(elbow_arm(), "lower") == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("limits", "tolerance"),
    [
        ({"yaw": (-1, 2), "shoulder": (-2, 0.3), "elbow": (0.2, 2.5)}, 0.03),
        ({"yaw": (-0.2, 0.2), "shoulder": (-0.3, 0.1), "elbow": (-0.5, -0.2)}, 0.03),
        ({"yaw": (-pi / 4, pi / 4), "shoulder": (-pi / 2, pi / 2), "elbow": (0, 0.7)}, 0.07),
    ],
)
def test_inverse_kinematics_agrees_on_the_volume(limits, tolerance) -> None:
    points = np.random.default_rng(1).uniform(-0.8, 0.8, (1_000_000, 3))
    share = _is_reached(points, 0.5, 0.3, **limits).mean()
    volume = workspace(elbow_arm(0.5, 0.3, **limits), "tip")
    assert volume == pytest.approx(share * 1.6**3, rel=tolerance)


def _is_reached(points, upper, lower, *, yaw, shoulder, elbow):
    """Return which points the elbow arm gets to: J. J. Craig, section 4.4, for both elbows."""
    x, y, z = points.T
    radius = np.hypot(x, y)
    cosine = (radius**2 + z**2 - upper**2 - lower**2) / (2 * upper * lower)
    reached = np.zeros(len(points), bool)
    for turn, side in ((0.0, 1), (pi, -1)):
        q1 = (np.arctan2(y, x) + turn + pi) % (2 * pi) - pi
        for sign in (1, -1):
            q3 = sign * np.arccos(np.clip(cosine, -1, 1))
            q2 = np.arctan2(-z, side * radius)
            q2 -= np.arctan2(lower * np.sin(q3), upper + lower * np.cos(q3))
            q2 = (q2 + pi) % (2 * pi) - pi
            inside = abs(cosine) <= 1
            for angle, (low, high) in ((q1, yaw), (q2, shoulder), (q3, elbow)):
                inside &= (angle >= low) & (angle <= high)
            reached |= inside
    return reached


# --- mass and extent ---


@pytest.mark.parametrize("path", ROBOTS)
def test_mujoco_agrees_on_the_mass(path) -> None:
    mujoco = require_module("mujoco")
    variant = variant_of(path)
    model = mujoco.MjModel.from_xml_string(variant.build.xml(), variant.build.assets)
    mass = Evaluation.parse(["mass"], None, "")(variant)["mass"]
    assert mass == pytest.approx(model.body_mass.sum(), rel=1e-12)


@pytest.mark.parametrize("path", [*ROBOTS, "diff_drive/diff_drive.yaml"])
def test_corners_of_the_shapes_touch_the_box_and_stay_in_it(path) -> None:
    trimesh = require_module("trimesh")
    robot = (build := variant_of(path).build).robot
    poses = robot.poses(home_positions(robot))
    points = []
    for link, visual in robot.visuals():
        match visual.shape:
            case Box() as shape:
                mesh = trimesh.creation.box(shape.size)
            case Cylinder() as shape:
                mesh = trimesh.creation.cylinder(shape.radius, shape.length, sections=720)
            case Sphere() as shape:
                mesh = trimesh.creation.icosphere(subdivisions=5, radius=shape.radius)
            case _:
                raise AssertionError(visual.shape)
        points.append(mesh.apply_transform((poses[link.name] @ visual.pose).matrix()).vertices)
    size = np.ptp(np.concatenate(points), axis=0)
    assert bounding_box(robot, build.finder) == pytest.approx(tuple(size), rel=1e-3)


def test_a_mesh_takes_the_room_of_its_corners(tmp_path) -> None:
    trimesh = require_module("trimesh")
    box = trimesh.creation.box((0.2, 0.4, 0.6))
    box.apply_translation((0.05, 0, 0))
    box.export(tmp_path / "box.stl")
    (tmp_path / "robot.urdf").write_text(
        '<robot name="r"><link name="a"><visual><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/>'
        '<geometry><mesh filename="box.stl" scale="2 1 1"/></geometry></visual></link></robot>'
    )
    build = yamaro.build(tmp_path / "robot.urdf")
    assert bounding_box(build.robot, build.finder) == pytest.approx((0.4, 0.4, 0.6))


def test_a_robot_without_shapes_takes_no_room(tmp_path) -> None:
    (tmp_path / "robot.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    build = yamaro.build(tmp_path / "robot.urdf")
    with pytest.raises(yamaro.YamaroError, match=r"metric-failed.*no shapes"):
        bounding_box(build.robot, build.finder)


# --- stability ---

TOWER = """
robot: tower
base: free
arguments: {lean: 0, kp: 500}
model:
- part:
    name: base
    link: {geometry: box, size: 0.2 0.2 0.05, mass: 0.3, visual: , collision: }
- part:
    name: mast
    joint:
      type: revolute
      parent: base
      xyz: 0 0 25mm
      axis: y
      limit: {lower: -90deg, upper: 90deg, effort: 100, velocity: 3}
      actuator: {kp: $(kp), kd: 10}
    link: {geometry: box, size: 0.02 0.02 0.6, pivot: 0 0 -0.3, mass: 1, visual: , collision: }
states: {home: {mast: $(lean)}}
"""


def held(tmp_path, base="free", **arguments):
    (tmp_path / "tower.yaml").write_text(TOWER.replace("base: free", f"base: {base}"))
    build = yamaro.build(tmp_path / "tower.yaml", variables=arguments, target=["mjcf"])
    return hold(build, 2.0)


@pytest.mark.parametrize("lean", [0.3, 0.5])
def test_a_tower_falls_if_its_centre_of_mass_is_outside_of_its_base(tmp_path, lean) -> None:
    # The centre of mass is 0.3·sin(lean)/1.3 from the middle of a base 0.1 to each side; leaning
    # by 0.45 it is at the border.
    centre = 0.3 * np.sin(lean) / 1.3
    result = held(tmp_path, lean=lean)
    assert result.is_stable == (centre < 0.1)
    assert (result.tilt > np.radians(45)) == (centre > 0.1)


@pytest.mark.parametrize("line", ["", ", stall_torque: 90, no_load_speed: 20"])
def test_a_weak_motor_lets_the_mast_sag(tmp_path, monkeypatch, line) -> None:
    # The weight m·g·l/2·sin(q) turns the spring kp until both are equal, on the way there by at
    # most twice as much, as a spring without damping would.
    monkeypatch.setitem(globals(), "TOWER", TOWER.replace("kd: 10", f"kd: 10{line}"))
    result = held(tmp_path, base="fixed", lean=0.8, kp=3)
    assert not result.is_stable
    assert result.sag > 0.1
    stiff = held(tmp_path, base="fixed", lean=0.8, kp=500)
    sag = brentq(lambda x: 500 * x - 9.81 * 0.3 * np.sin(0.8 + x), 0, 1) / pi
    assert stiff.is_stable
    assert sag <= stiff.sag <= 2 * sag


def test_stable_says_how_long_and_how_upright() -> None:
    found = metric("stable(0.5)", "hexapod/hexapod.yaml")
    assert list(found) == ["stable", "stable_time", "stable_tilt", "stable_sag"]
    assert found["stable"] is True
    assert found["stable_time"] == pytest.approx(0.5)


SENSED = """<mujoco>
  <worldbody>
    <site name="ground"/>
    <body name="a"><freejoint/><geom size="1"/><site name="ray"/><site name="held"/><site name="x"/>
      <body name="b"><joint name="j"/><geom size="1"/><site name="deep"/></body></body>
  </worldbody>
  <equality><connect site1="held" site2="ground"/></equality>
  <actuator><motor name="deep" joint="j"/></actuator>
  <sensor><rangefinder site="ray"/><gyro site="held"/><jointpos joint="j"/>
    <gyro site="deep"/></sensor>
</mujoco>"""


def test_stable_leaves_out_sensors_and_the_sites_that_only_they_name() -> None:
    mujoco = require_module("mujoco")
    model = mujoco.MjModel.from_xml_string(without_sensors(SENSED))
    assert (model.nsensor, model.neq, model.nu, model.njnt) == (0, 1, 1, 2)
    assert {model.site(index).name for index in range(model.nsite)} == {
        "ground",
        "held",
        "x",
        "deep",
    }


def test_a_lidar_changes_nothing_for_stable(tmp_path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(
        "robot: r\nbase: free\nmodel:\n- part: {name: base, link: {geometry: box, size: 1 1 1, "
        "mass: 2, collision: , sensor/name=scan: {type: lidar, xyz: 0 0 0.6}}}\n"
    )
    build = yamaro.build(path, target="mjcf", on_message=lambda line: None)
    assert compiled(build).nsensor == 360
    assert compiled(build, has_floor=True, has_sensors=False).nsite == 1  # its frame
    assert hold(build, 0.1).is_stable


@pytest.mark.parametrize(
    "geom",
    [
        'type="box" size="0.1 0.2 0.3"', 'type="sphere" size="0.1"',
        'type="capsule" size="0.1 0.2"', 'type="cylinder" size="0.1 0.2"',
        'type="ellipsoid" size="0.1 0.2 0.3"', 'type="mesh" mesh="m"',
    ],
)  # fmt: skip
def test_a_geom_touches_a_plane_at_its_lowest_point(geom) -> None:
    mujoco = require_module("mujoco")
    text = f"""<mujoco>
      <asset><mesh name="m" vertex="0 0 0 .3 0 0 0 .2 0 0 0 .1"/></asset><worldbody>
      <geom name="floor" type="plane" size="1 1 1"/>
      <body pos="0 0 3"><freejoint/><geom name="g" {geom} euler="20 50 10" mass="1"/></body>
    </worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    lowest = lowest_point(model, data, 1)
    data.qpos[2] -= lowest + 1e-3  # a millimetre into the floor
    mujoco.mj_forward(model, data)
    assert min(contact.dist for contact in data.contact) == pytest.approx(-1e-3, abs=1e-5)


def test_tips_are_where_no_joint_leads_on() -> None:
    assert tips_of(elbow_arm()) == ["tip"]
    assert len(Chain(elbow_arm(), "tip").variables) == 3


def test_a_free_robot_that_collides_with_nothing_falls(tmp_path) -> None:
    (tmp_path / "ghost.yaml").write_text(
        "robot: ghost\nbase: free\nmodel:\n- part: {name: a, link: {geometry: box, size: 1 1 1,\n"
        "    mass: 1, xyz: 0 0 1, visual: }}\n"
    )
    result = hold(yamaro.build(tmp_path / "ghost.yaml", target=["mjcf"]), 2.0)
    # Half of the height of 1 m is lost after √(2·0.5/9.81) s.
    assert result.time == pytest.approx(sqrt(1 / 9.81), abs=0.02)
