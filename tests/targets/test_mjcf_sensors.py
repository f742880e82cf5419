"""What sensors measure in MuJoCo, against what is worked out by hand."""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, pi, radians, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yamaro
from tests.consumers.oracles import require_module

GRAVITY = 9.81
ROBOT = """
robot: sensing
base: fixed
model:
- part: {name: base, link: {geometry: box, scale: 0.1 0.1 0.1, mass: 1, collision: }}
- part:
    name: wheel
    joint: {type: continuous, parent: base, xyz: 0 0 1, axis: z}
    link:
      geometry: sphere
      radius: 0.02
      mass: 2
      sensor/name=imu: {type: imu, xyz: 0.3 0 0, rpy: 0 0 30deg}
- part:
    name: head
    joint: {type: fixed, parent: base, xyz: 0 0 2, rpy: 0 0 90deg}
    link:
      geometry: sphere
      radius: 0.02
      mass: 1
      sensor/name=near: {type: range, xyz: 0.1 0 0, range: 0 20}
      sensor/name=scan: {type: lidar, xyz: 0.1 0 0, rays: 8, angle: 360deg, range: 0.1 30}
      sensor/name=rows:
        type: lidar
        xyz: 0.1 0 0
        rays: 3
        angle: 60deg
        rows: 3
        tilt: 20deg
        range: 0 30
      sensor/name=eye: {type: camera, xyz: 0.1 0 0.05, rpy: 0 10deg 5deg, size: 640 480, fov: 70deg}
- part:
    name: tool
    joint:
      type: fixed
      parent: wheel
      xyz: 0.2 0 0
      rpy: 0 0 90deg
      sensor/name=wrist: {type: force_torque}
    link: {inertial: {mass: 0.5, xyz: 0.1 0 0, inertia: 0.01 0 0 0.01 0 0.01}}
"""


@pytest.fixture(scope="module")
def mjcf(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("sensors") / "robot.yaml"
    path.write_text(ROBOT)
    return yamaro.build(path, target="mjcf").xml()


def compiled(mjcf: str, extra: str = "") -> tuple[Any, Any]:
    """Return model and data of a robot, with more in the world."""
    mujoco = require_module("mujoco")
    model = mujoco.MjModel.from_xml_string(mjcf.replace("</worldbody>", f"{extra}</worldbody>"))
    return model, mujoco.MjData(model)


def test_gyro_and_accelerometer_of_a_spinning_robot(mjcf: str) -> None:
    mujoco = require_module("mujoco")
    model, data = compiled(mjcf)
    speed, angle = 3.0, 0.7
    data.qpos[0], data.qvel[0] = angle, speed
    mujoco.mj_forward(model, data)
    # No friction and no load but weight along the axis: the wheel keeps its speed.
    assert data.qacc[0] == pytest.approx(0, abs=1e-9)
    gyro = data.sensor("imu_angular_velocity").data
    assert gyro == pytest.approx([0, 0, speed], abs=1e-9)
    # Toward the axis, which in the turned axes of the sensor is -30° from -x; and up, for weight.
    inward = -speed * speed * 0.3
    wanted = [inward * cos(-pi / 6), inward * sin(-pi / 6), GRAVITY]
    assert data.sensor("imu_linear_acceleration").data == pytest.approx(wanted, abs=1e-9)
    half = (angle + pi / 6) / 2
    wanted = [cos(half), 0, 0, sin(half)]
    assert data.sensor("imu_orientation").data == pytest.approx(wanted, abs=1e-9)


CRANE = """\
robot: crane
base: fixed
model:
- part: {name: mast, link: {geometry: box, size: 0.1 0.1 1, mass: 1}}
- part:
    name: hook
    joint: {type: fixed, parent: mast, sensor/name=load: {type: force_torque}}
    link: {geometry: box, size: 0.1 0.1 0.1, xyz: 0.5 0 0, mass: 2}
"""


def test_force_and_torque_at_a_wrist(mjcf: str) -> None:
    mujoco = require_module("mujoco")
    model, data = compiled(mjcf)
    speed = 2.0
    data.qvel[0] = speed
    mujoco.mj_forward(model, data)
    # The tool's centre is at (0.2, 0.1) about the axis; the axes of the tool are turned by 90°.
    x, y, mass = 0.2, 0.1, 0.5
    inward = np.array([-speed * speed * x, -speed * speed * y, 0.0])
    carrying = mass * (inward + np.array([0, 0, GRAVITY]))
    turned = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])  # of the wheel's axes to the tool's
    force = turned @ carrying
    center = np.array([0.1, 0, 0])
    torque = np.cross(center, force)
    assert data.sensor("wrist_force").data == pytest.approx(force, abs=1e-9)
    assert data.sensor("wrist_torque").data == pytest.approx(torque, abs=1e-9)


def test_forces_have_the_opposite_sign_in_gazebo(tmp_path: Path) -> None:
    """A load of 2 kg, 0.5 m in front of a fixed joint, is held by 2·g N, and −g N·m about y."""
    mujoco = require_module("mujoco")
    path = tmp_path / "crane.yaml"
    path.write_text(CRANE)
    build = yamaro.build(path, target="mjcf")
    model = mujoco.MjModel.from_xml_string(build.xml())
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.sensor("load_force").data == pytest.approx([0, 0, 2 * GRAVITY], abs=1e-9)
    assert data.sensor("load_torque").data == pytest.approx([0, -GRAVITY, 0], abs=1e-9)
    told = [(loss.kind, loss.how) for loss in build.losses if loss.what == "force_torque sensors"]
    assert told == [("approximated", "the opposite: what the parent exerts on the child")]
    sdf = yamaro.build(path, target="sdf").xml()
    assert "<measure_direction>child_to_parent</measure_direction>" in sdf


def wall(x: float, y: float, turn: float) -> str:
    """Return a large thin box whose middle is at a place, and whose normal is at an angle."""
    return (
        f'<geom name="wall" type="box" size="0.5 40 40" pos="{x} {y} 2" '
        f'quat="{cos(turn / 2)!r} 0 0 {sin(turn / 2)!r}"/>'
    )


def test_a_range_sensor_measures_the_distance_to_a_box(mjcf: str) -> None:
    mujoco = require_module("mujoco")
    # The head looks along y, from (0, 0.1, 2); the near face of the box is at y = 4.5.
    model, data = compiled(mjcf, wall(0, 5, pi / 2))
    mujoco.mj_forward(model, data)
    assert data.sensor("near").data[0] == pytest.approx(4.4, abs=1e-9)


def test_each_ray_of_a_lidar_is_where_it_should_be(mjcf: str) -> None:
    mujoco = require_module("mujoco")
    model, data = compiled(mjcf, wall(0, 5, pi / 2))
    mujoco.mj_forward(model, data)
    for index in range(8):
        around = -pi + index * pi / 4  # from where the head looks
        found = data.sensor(f"scan_{index}").data[0]
        forward = cos(around)
        wanted = 4.4 / forward if forward > 1e-6 else -1
        assert found == pytest.approx(wanted, abs=1e-9), index
    for ray, around in enumerate((-30, 0, 30)):
        for line, up in enumerate((-10, 0, 10)):
            found = data.sensor(f"rows_{line}_{ray}").data[0]
            wanted = 4.4 / (cos(radians(around)) * cos(radians(up)))
            assert found == pytest.approx(wanted, abs=1e-9), (ray, line)


def test_a_lidar_of_many_rays_has_a_site_for_each(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    path = tmp_path / "robot.yaml"
    path.write_text(
        "robot: many\nbase: fixed\nmodel:\n- part:\n    name: base\n    link: {geometry: sphere, "
        "radius: 0.1, mass: 1, sensor/name=scan: {type: lidar, xyz: 0 0 1, rpy: 0 0 90deg, "
        "rays: 512, angle: 90deg, rows: 16, tilt: 30deg, range: 0 30}}\n"
    )
    model = mujoco.MjModel.from_xml_string(yamaro.build(path, target="mjcf").xml())
    assert (model.nsite, model.nsensor) == (512 * 16 + 1, 512 * 16)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for ray, level in ((0, 0), (511, 15), (100, 3)):
        around = radians(90 - 45 + 90 * ray / 511)
        up = radians(-15 + 30 * level / 15)
        found = data.site(f"scan_ray_{level:02}_{ray:03}").xmat.reshape(3, 3)[:, 2]
        wanted = [cos(around) * cos(up), sin(around) * cos(up), sin(up)]
        assert found == pytest.approx(wanted, abs=1e-12)


def test_left_and_up_are_the_same_for_rays(mjcf: str) -> None:
    mujoco = require_module("mujoco")
    model, data = compiled(mjcf)
    mujoco.mj_forward(model, data)

    def ray(name: str) -> Any:
        return data.site(name).xmat.reshape(3, 3)[:, 2]

    # 45° to the left of y is toward -x; the last row looks up.
    assert ray("scan_ray_5") == pytest.approx([-(0.5**0.5), 0.5**0.5, 0], abs=1e-12)
    up = radians(10)
    assert ray("rows_ray_2_1") == pytest.approx([0, cos(up), sin(up)], abs=1e-12)


def test_a_camera_shows_a_point_where_it_should_be(mjcf: str) -> None:
    mujoco = require_module("mujoco")
    model, data = compiled(mjcf)
    mujoco.mj_forward(model, data)
    camera = model.camera("eye")
    width, height = model.cam_resolution[camera.id]
    assert (width, height) == (640, 480)
    focal = width / 2 / tan(radians(70) / 2)  # pixels
    assert camera.fovy[0] == pytest.approx(degrees(2 * atan2(height / 2, focal)), abs=1e-9)
    # A point in the axes of the camera's frame: 4 m ahead, 1 m to the left, 0.5 m up.
    pitch, yaw = radians(10), radians(5)
    ahead, left, up = 4.0, 1.0, 0.5
    x = cos(yaw) * (cos(pitch) * ahead + sin(pitch) * up) - sin(yaw) * left
    y = sin(yaw) * (cos(pitch) * ahead + sin(pitch) * up) + cos(yaw) * left
    z = -sin(pitch) * ahead + cos(pitch) * up
    point = np.array([-y, x + 0.1, z + 2.05])  # the head is turned by 90°
    turn = data.camera("eye").xmat.reshape(3, 3)
    right, above, behind = turn.T @ (point - data.camera("eye").xpos)
    assert -behind == pytest.approx(ahead, abs=1e-9)
    assert hypot(right + left, above - up) < 1e-9
    column = width / 2 + focal * right / -behind
    row = height / 2 - focal * above / -behind
    assert (column, row) == pytest.approx((320 - focal / 4, 240 - focal / 8), abs=1e-6)
