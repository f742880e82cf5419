"""Sensors, surfaces and actuators that a URDF describes for Gazebo and ROS, in MuJoCo."""

from __future__ import annotations

from importlib.util import find_spec
from math import cos, pi, sin
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import yamaro
from tests.later import Later

pytestmark = pytest.mark.skipif(not find_spec("mujoco"), reason="needs MuJoCo")
if TYPE_CHECKING:
    import mujoco
else:
    mujoco = Later("mujoco")

SOLID = """<inertial><mass value="1"/>
  <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"""
ROBOT = f"""<robot name="r">
  <link name="base">{SOLID}
    <collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <link name="arm">{SOLID}</link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
    <origin xyz="0 0 1"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="2" velocity="3"/>
  </joint>
  <gazebo reference="base"><mu1>0.3</mu1>
    <sensor name="scan" type="ray"><pose>0 0 0.5 0 0 {pi / 2}</pose><ray>
      <scan><horizontal><samples>5</samples>
        <min_angle>-1</min_angle><max_angle>3</max_angle></horizontal></scan>
      <range><min>0.1</min><max>5</max></range></ray>
    </sensor>
  </gazebo>
  <gazebo reference="arm">
    <sensor name="eye" type="camera"><pose>1 0 0 0 0 0</pose>
      <camera><image><width>64</width><height>48</height></image></camera></sensor>
    <sensor name="tilt" type="imu"><pose>0 2 0 0 0 0</pose><imu><noise><type>gaussian</type>
      <rate><stddev>0.1</stddev></rate><accel><stddev>0.2</stddev></accel></noise></imu></sensor>
  </gazebo>
  <transmission name="t"><type>SimpleTransmission</type>
    <joint name="turn"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
    <actuator name="m"><mechanicalReduction>50</mechanicalReduction></actuator>
  </transmission>
</robot>"""


@pytest.fixture
def model(tmp_path: Path) -> object:
    (tmp_path / "r.urdf").write_text(ROBOT)
    build = yamaro.build(tmp_path / "r.urdf", target="mjcf")
    return mujoco.MjModel.from_xml_string(build.xml())


def test_rays_are_where_the_file_has_them(model: object) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    names = [model.site(index).name for index in range(model.nsite)]  # type: ignore[attr-defined]
    rays = [name for name in names if name.startswith("scan_ray")]
    assert len(rays) == 5
    for number, name in enumerate(sorted(rays)):
        angle = pi / 2 - 1 + number  # turned by the pose, then from -1 to 3 in steps of 1
        direction = data.site(name).xmat.reshape(3, 3)[:, 2]
        assert list(data.site(name).xpos) == pytest.approx([0, 0, 0.5], abs=1e-9)
        assert list(direction) == pytest.approx([cos(angle), sin(angle), 0], abs=1e-9)


def test_poses_in_links(model: object) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert list(data.site("tilt").xpos) == pytest.approx([0, 2, 1], abs=1e-9)
    assert list(data.camera("eye").xpos) == pytest.approx([1, 0, 1], abs=1e-9)
    assert list(-data.camera("eye").xmat.reshape(3, 3)[:, 2]) == pytest.approx([1, 0, 0], abs=1e-9)


def test_noise_friction_and_a_control_that_is_the_joint_s(model: object) -> None:
    sensor = model.sensor  # type: ignore[attr-defined]
    assert sensor("tilt_angular_velocity").noise[0] == 0.1
    assert sensor("tilt_linear_acceleration").noise[0] == 0.2
    assert model.geom("base_collision").friction[0] == 0.3  # type: ignore[attr-defined]
    assert model.actuator("turn").gear[0] == 1  # type: ignore[attr-defined]
