"""What a robot has besides links and joints, as the model gives it, in a jail too."""

from __future__ import annotations

from math import isclose, pi
from pathlib import Path

import pytest

import yamaro
from yamaro.model import Camera, Lidar, Ranger, Robot

ROBOT = """
robot: lamp
model:
- part:
    name: base
    link:
      geometry: box
      scale: 0.2 0.2 0.1
      mass: 4
      collision: {surface: {friction: 0.8, stiffness: 100 N/mm}}
      sensor/name=imu: {type: imu, rate: 200, noise: 0.01, topic: up}
      sensor/name=scan: {type: lidar, xyz: 0 0 0.08, rays: 16, range: 0.2 12}
      sensor/name=eye: {type: camera, size: 64 48}
      sensor/name=near: {type: range}
- part:
    name: rod
    joint:
      type: revolute
      parent: base
      limit: {lower: -1.5, upper: 1.5, effort: 10, velocity: 3}
      actuator: {command: velocity, kp: 50, armature: 0.01}
      sensor/name=wrist: {type: force_torque}
    link: {mass: 0.4, geometry: sphere, scale: 0.1, frame/name=tip: {xyz: 0 0 0.5}}
- attach:
    to: tip
    prefix: a_
    body:
      part: {name: hook, link: {geometry: sphere, scale: 0.1, mass: 1}}
- loop: {name: bar, type: revolute, between: [tip, base], axis: 0 1 0}
control:
  plugin: p
  params: {port: 3}
  state: home
states: {home: {rod: 0.3}, away: {rod: -1}}
groups:
  arm: {chain: [base, tip], parent: base, end_effector: true}
  all: {links: [rod], joints: [rod], groups: [arm]}
collisions: {samples: 100, keep: [[base, rod]]}
base: free
"""
MODES = [None, "jail"]


@pytest.fixture(params=MODES, ids=str)
def robot(request: pytest.FixtureRequest, tmp_path: Path) -> Robot:
    path = tmp_path / "lamp.yaml"
    path.write_text(ROBOT)
    policy = yamaro.Policy(request.param) if request.param else None
    return yamaro.build(path, policy=policy, allow=["lost-in-urdf"]).robot


def line_of(text: str) -> int:
    return ROBOT[: ROBOT.index(text)].count("\n") + 1


def test_sensors(robot: Robot) -> None:
    imu, wrist = robot.sensors["imu"], robot.sensors["wrist"]
    assert list(robot.sensors) == ["imu", "scan", "eye", "near", "wrist"]
    assert (imu.type, imu.link, imu.joint, imu.frame) == ("imu", "base_link", None, "imu")
    assert (imu.rate, imu.noise, imu.topic, imu.details) == (200, 0.01, "up", None)
    assert (wrist.type, wrist.link, wrist.joint, wrist.frame) == (
        "force_torque",
        None,
        "rod_joint",
        None,
    )
    assert imu.span.place().split(":")[-2] == str(line_of("sensor/name=imu"))
    assert imu.span_of("rate").written() == "200"


def test_details_of_sensors(robot: Robot) -> None:
    scan = robot.sensors["scan"].details
    eye = robot.sensors["eye"].details
    near = robot.sensors["near"].details
    assert isinstance(scan, Lidar)
    assert (scan.rays, scan.rows, scan.range) == (16, 1, (0.2, 12))
    assert isinstance(eye, Camera)
    assert (eye.size, eye.clip) == ((64, 48), (0.05, 100))
    assert isinstance(near, Ranger)
    assert near.range == (0.02, 4)


def test_a_camera_has_an_optical_frame(robot: Robot) -> None:
    assert robot.sensors["eye"].optical_frame == "eye_optical"
    assert "eye_optical" in robot.links
    assert robot.sensors["imu"].optical_frame is None


@pytest.mark.parametrize(
    ("rays", "angle", "first", "last"),
    [
        (16, f"{2 * pi}", -pi, pi - 2 * pi / 16),  # does not repeat its first ray
        (3, f"{pi / 2}", -pi / 4, pi / 4),
        (1, f"{pi / 2}", 0, 0),
    ],
)
def test_ends_of_rays(rays: int, angle: str, first: float, last: float) -> None:
    text = f"""
robot: r
model:
- part: {{name: a, link: {{sensor/name=s: {{type: lidar, rays: {rays}, angle: {angle}}}}}}}
"""
    details = yamaro.build("-", text=text).robot.sensors["s"].details
    assert isinstance(details, Lidar)
    ends = details.ends()
    assert isclose(ends[0], first, abs_tol=1e-12)
    assert isclose(ends[1], last, abs_tol=1e-12)
    assert isclose(ends[0] + (rays - 1) * details.step, ends[1], abs_tol=1e-12)


def test_actuators_and_surfaces(robot: Robot) -> None:
    actuator = robot.actuators["rod_joint"]
    assert (actuator.command, actuator.kp, actuator.kd) == ("velocity", 50, None)
    assert (actuator.armature, actuator.gear) == (0.01, 1)
    (surface,) = robot.surfaces
    assert (surface.link, surface.index) == ("base_link", 0)
    assert surface.values() == (0.8, 0.8, None, 100_000, None)
    assert surface.span_of("stiffness").written() == "100 N/mm"


def test_sections(robot: Robot) -> None:
    assert {name: state.positions for name, state in robot.states.items()} == {
        "home": {"rod_joint": 0.3},
        "away": {"rod_joint": -1},
    }
    assert robot.states["home"].span_of("rod_joint").written() == "0.3"
    arm, everything = robot.groups["arm"], robot.groups["all"]
    assert (arm.chains, arm.parent, arm.is_end_effector) == (
        (("base_link", "tip"),),
        "base_link",
        True,
    )
    assert (everything.links, everything.joints, everything.groups) == (
        ("rod_link",),
        ("rod_joint",),
        ("arm",),
    )
    settings = robot.collision_settings
    assert settings is not None
    assert (settings.samples, settings.seed) == (100, 1)
    assert settings.keep == (("base_link", "rod_link"),)
    loop = robot.loops["bar"]
    assert (loop.type, loop.between, loop.axis) == ("revolute", ("tip", "base_link"), (0, 1, 0))
    (control,) = robot.controls
    assert (control.plugin, control.params, control.state) == ("p", {"port": "3"}, "home")
    assert (control.joints, control.sensors) == (("rod_joint",), ("imu", "wrist"))
    assert robot.base is not None
    assert robot.base.type == "free"


def test_states_of_an_attached_robot_are_merged_and_the_outer_value_wins(tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(
        """
robot: arm
model:
- part: {name: root}
- for name in ['one', 'two']:
  - part: {name: $(name), joint: {type: continuous, parent: root}}
states: {home: {one: 1, two: 2}}
base: fixed
"""
    )
    main = tmp_path / "main.yaml"
    main.write_text(
        """
robot: main
model:
- part: {name: base}
- attach: {path: arm.yaml, to: base, prefix: a_}
states: {home: {a_one_joint: 5}}
"""
    )
    robot = yamaro.build(main).robot
    assert robot.states["home"].positions == {"a_one_joint": 5, "a_two_joint": 2}
    assert robot.base is None, "that of the attached robot is its own"


def test_a_robot_from_urdf_has_none() -> None:
    robot = Robot.from_xml('<robot name="r"><link name="a"/></robot>')
    assert not robot.sensors
    assert not robot.states
    assert robot.base is None
    assert robot.collision_settings is None
