"""Sensors, surfaces, actuators and control that a URDF describes in elements of other programs."""

from __future__ import annotations

import os
import shutil
import subprocess
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest

import yamaro
from tests.golden import CASES
from yamaro.model import Camera, Lidar, Ranger, Robot

if TYPE_CHECKING:
    from yamaro.model import Sensor

IGN = shutil.which("ign")


def robot_with(more: str) -> Robot:
    """Return a robot of a base, an arm on a turning joint and a frame `eye_link`, and more."""
    shape = "<collision><geometry><sphere radius='1'/></geometry></collision>"
    return Robot.from_xml(
        f"""<robot name="r">
  <link name="base"><inertial><mass value="1"/></inertial>{shape}{shape}</link>
  <link name="arm">{shape}</link>
  <link name="eye_link"/>
  <link name="eye_optical"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="arm"/></joint>
  <joint name="eye_joint" type="fixed"><parent link="arm"/><child link="eye_link"/></joint>
  <joint name="eye_optical_joint" type="fixed">
    <parent link="eye_link"/><child link="eye_optical"/><origin rpy="-1.5708 0 -1.5708"/>
  </joint>
  {more}
</robot>"""
    )


def sensor_in(body: str, home: str = "eye_link") -> Sensor:
    (sensor,) = robot_with(f'<gazebo reference="{home}">{body}</gazebo>').sensors.values()
    return sensor


# --- sensors ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "kind"),
    [
        ("imu", "imu"),
        ("imu_sensor", "imu"),
        ("gps", "gps"),
        ("navsat", "gps"),
        ("magnetometer", "magnetometer"),
        ("contact", "contact"),
        ("ray", "lidar"),
        ("gpu_ray", "lidar"),
        ("lidar", "lidar"),
        ("gpu_lidar", "lidar"),
        ("camera", "camera"),
        ("wideanglecamera", "camera"),
        ("depth", "depth_camera"),
        ("depth_camera", "depth_camera"),
        ("rgbd_camera", "depth_camera"),
        ("sonar", "range"),
    ],
)
def test_types_of_gazebo_and_of_gazebo_classic(written: str, kind: str) -> None:
    sensor = sensor_in(f'<sensor name="s" type="{written}"/>')
    assert (sensor.name, sensor.type, sensor.link, sensor.frame, sensor.joint) == (
        *("s", kind),
        *("eye_link", "eye_link", None),
    )


@pytest.mark.parametrize("written", ["altimeter", "thermal_camera", "custom", ""])
def test_other_types_are_left_alone(written: str) -> None:
    robot = robot_with(f'<gazebo reference="arm"><sensor name="s" type="{written}"/></gazebo>')
    assert not robot.sensors


@pytest.mark.parametrize("home", ["nowhere", "turn", ""])
def test_a_sensor_whose_link_is_not_there_is_left_alone(home: str) -> None:
    robot = robot_with(f'<gazebo reference="{home}"><sensor name="s" type="imu"/></gazebo>')
    assert not robot.sensors


def test_rate_topic_pose_and_noise() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="imu">
             <always_on>1</always_on><update_rate> 200 </update_rate><topic>up</topic>
             <pose>0.1 0.2 0.3 0 0 1.5707963267948966</pose>
             <imu>
               <angular_velocity>
                 <x><noise type="gaussian"><mean>0</mean><stddev>0.01</stddev></noise></x>
                 <y><noise type="gaussian"><mean>0</mean><stddev>0.01</stddev></noise></y>
                 <z><noise type="gaussian"><mean>0</mean><stddev>0.01</stddev></noise></z>
               </angular_velocity>
               <linear_acceleration>
                 <x><noise type="gaussian"><mean>0</mean><stddev>0.01</stddev></noise></x>
               </linear_acceleration>
             </imu>
           </sensor>""",
        "base",
    )
    assert (sensor.rate, sensor.topic, sensor.noise, dict(sensor.noises)) == (200, "up", 0.01, {})
    assert sensor.pose.position == (0.1, 0.2, 0.3)
    assert sensor.pose.apply((1, 0, 0)) == pytest.approx((0.1, 1.2, 0.3))
    assert sensor.span.written() == "sensor"
    assert sensor.span_of("rate").written().strip() == "200"
    assert sensor.span_of("topic").written() == "up"


def test_noise_that_differs_has_a_number_for_each_quantity() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="imu"><imu><noise><type>gaussian</type>
             <rate><mean>0</mean><stddev>2e-4</stddev><bias_mean>1</bias_mean></rate>
             <accel><mean>0</mean><stddev>0.017</stddev></accel>
           </noise></imu></sensor>"""
    )
    assert sensor.noise is None
    assert sensor.noises == {"angular_velocity": 2e-4, "linear_acceleration": 0.017}


def test_noise_of_one_quantity_is_not_that_of_the_other() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="imu"><imu><angular_velocity><x>
             <noise type="gaussian"><stddev>0.5</stddev></noise>
           </x></angular_velocity></imu></sensor>"""
    )
    assert (sensor.noise, sensor.noises) == (None, {"angular_velocity": 0.5})


def test_noise_of_all_beside_that_of_one_quantity() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="imu"><imu><noise><stddev>0.1</stddev>
             <accel><stddev>0.2</stddev></accel></noise></imu></sensor>"""
    )
    assert sensor.noises == {"all": 0.1, "linear_acceleration": 0.2}


def test_no_noise() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="ray"><ray><noise><type>none</type><stddev>1</stddev></noise></ray>
           </sensor>"""
    )
    assert (sensor.noise, sensor.noises) == (None, {})


@pytest.mark.parametrize(
    ("plugin", "topic"),
    [
        ("<topicName>scan</topicName>", "scan"),
        ("<bumperTopicName>hit</bumperTopicName>", "hit"),
        ("<cameraName>left</cameraName><imageTopicName>image</imageTopicName>", "left/image"),
        ("<cameraName>left</cameraName><imageTopicName>/image</imageTopicName>", "/image"),
        ("<ros><remapping>~/out:=scan</remapping></ros>", "scan"),
        ("<ros><namespace>/a</namespace><remapping>~/out:=scan</remapping></ros>", "/a/scan"),
    ],
)
def test_topic_and_rate_of_a_plugin(plugin: str, topic: str) -> None:
    sensor = sensor_in(
        f"""<sensor name="s" type="camera"><update_rate>0</update_rate>
              <plugin name="p" filename="lib.so"><updateRate>15</updateRate>{plugin}</plugin>
            </sensor>"""
    )
    assert (sensor.topic, sensor.rate) == (topic, 15)


def test_rays() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="gpu_ray"><ray>
             <scan>
               <horizontal><samples>5</samples><min_angle>-1</min_angle><max_angle>3</max_angle>
               </horizontal>
               <vertical><samples>3</samples><min_angle>-0.2</min_angle><max_angle>0</max_angle>
               </vertical>
             </scan>
             <range><min>0.2</min><max>30</max></range>
           </ray></sensor>"""
    )
    details = sensor.details
    assert isinstance(details, Lidar)
    assert (details.rays, details.rows, details.range) == (5, 3, (0.2, 30))
    assert (details.angle, details.step, details.ends()) == (4, 1, (-1, 3))
    assert (details.tilt, details.tilt_ends()) == (0.2, (-0.2, 0))


def test_a_ray_that_a_file_repeats_is_there_twice() -> None:
    body = f"<samples>9</samples><min_angle>{-pi}</min_angle><max_angle>{pi}</max_angle>"
    scan = f"<scan><horizontal>{body}</horizontal></scan>"
    details = sensor_in(f'<sensor name="s" type="ray"><ray>{scan}</ray></sensor>').details
    assert isinstance(details, Lidar)
    assert details.step == pytest.approx(pi / 4)
    assert details.ends() == (-pi, pi)


@pytest.mark.parametrize(
    ("body", "fov"),
    [
        ("<ray><scan><horizontal><samples>1</samples></horizontal></scan>{range}</ray>", 0),
        (
            (
                "<ray><scan><horizontal><samples>5</samples></horizontal></scan>{range}</ray>"
                '<plugin name="p" filename="libgazebo_ros_range.so"><fov>0.5</fov></plugin>'
            ),
            0.5,
        ),
    ],
)
def test_one_distance(body: str, fov: float) -> None:
    ends = "<range><min>0.02</min><max>4</max></range>"
    sensor = sensor_in(f'<sensor name="s" type="ray">{body.format(range=ends)}</sensor>')
    assert isinstance(sensor.details, Ranger)
    assert (sensor.type, sensor.details.range, sensor.details.fov) == ("range", (0.02, 4), fov)


def test_a_camera_and_its_optical_frame() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="camera"><pose>1 0 0 0 0 0</pose><camera name="head">
             <pose>0 1 0 0 0 0</pose>
             <horizontal_fov>1.2</horizontal_fov>
             <image><width>800</width><height>600</height></image>
             <clip><near>0.02</near><far>300</far></clip>
             <noise><type>gaussian</type><stddev>0.007</stddev></noise>
           </camera>
           <plugin name="p" filename="libgazebo_ros_camera.so">
             <frameName>eye_optical</frameName>
           </plugin></sensor>"""
    )
    assert isinstance(sensor.details, Camera)
    assert (sensor.details.size, sensor.details.fov, sensor.details.clip) == (
        *((800, 600), 1.2),
        (0.02, 300),
    )
    assert (sensor.noise, sensor.optical_frame) == (0.007, "eye_optical")
    assert sensor.pose.position == (1, 1, 0)


def test_a_frame_that_is_not_turned_like_an_optical_one_is_none() -> None:
    sensor = sensor_in(
        """<sensor name="s" type="camera">
             <plugin name="p" filename="lib.so"><frameName>eye_link</frameName></plugin>
           </sensor>"""
    )
    assert sensor.optical_frame is None


def test_the_cameras_of_a_multicamera() -> None:
    robot = robot_with(
        """<gazebo reference="eye_link"><sensor name="stereo" type="multicamera">
             <camera name="left"><horizontal_fov>1</horizontal_fov></camera>
             <camera name="right"><pose>0 -0.07 0 0 0 0</pose></camera>
           </sensor></gazebo>"""
    )
    assert list(robot.sensors) == ["stereo_left", "stereo_right"]
    assert robot.sensors["stereo_right"].pose.position == (0, -0.07, 0)


def test_force_and_torque_in_a_joint() -> None:
    sensor = sensor_in('<sensor name="s" type="force_torque"/>', "turn")
    assert (sensor.joint, sensor.link, sensor.frame) == ("turn", None, None)


@pytest.mark.parametrize(
    ("plugin", "kind", "home"),
    [
        ("libgazebo_ros_ft_sensor.so", "force_torque", "<jointName>turn</jointName>"),
        ("libhector_gazebo_ros_imu.so", "imu", "<bodyName>arm</bodyName>"),
        ("libgazebo_ros_imu.so", "imu", "<bodyName>arm</bodyName>"),
        ("libhector_gazebo_ros_gps.so", "gps", "<bodyName>arm</bodyName>"),
    ],
)
def test_plugins_that_are_sensors(plugin: str, kind: str, home: str) -> None:
    robot = robot_with(
        f"""<gazebo><plugin name="p" filename="{plugin}">{home}<topicName>t</topicName>
              <updateRate>50</updateRate><gaussianNoise>0.1</gaussianNoise></plugin></gazebo>"""
    )
    (sensor,) = robot.sensors.values()
    assert (sensor.name, sensor.type, sensor.joint or sensor.link) == (
        *("p", kind),
        "turn" if kind == "force_torque" else "arm",
    )
    assert (sensor.topic, sensor.rate, sensor.noise) == ("t", 50, 0.1)


def test_sensors_of_one_name() -> None:
    block = '<gazebo reference="{}"><sensor name="bump" type="contact"/></gazebo>'
    robot = robot_with("".join(map(block.format, ("base", "arm", "arm"))))
    assert list(robot.sensors) == ["bump", "arm_bump", "arm_bump_2"]


# --- surfaces -----------------------------------------------------------------------------------

SURFACES = [
    ("<mu1>0.2</mu1><mu2>0.3</mu2><kp>1e6</kp><kd>10</kd>", (0.2, 0.3, None, 1e6, 10)),
    ('<mu1 value="0.2"/>', (0.2, 0.2, None, None, None)),
    (
        (
            "<collision><surface><friction><ode><mu>1</mu><mu2>0.5</mu2></ode></friction>"
            "<bounce><restitution_coefficient>0.5</restitution_coefficient></bounce>"
            "<contact><ode><kp>1000</kp><kd>3</kd></ode></contact></surface></collision>"
        ),
        (1, 0.5, 0.5, 1000, 3),
    ),
    ("<mu1>wet</mu1><selfCollide>true</selfCollide><kp>-1</kp>", None),
]


@pytest.mark.parametrize(("body", "values"), SURFACES)
def test_surfaces_are_of_all_collisions(body: str, values: tuple[float | None, ...] | None) -> None:
    robot = robot_with(f'<gazebo reference="base">{body}</gazebo>')
    expected = [] if values is None else [("base", 0, values), ("base", 1, values)]
    assert [(each.link, each.index, each.values()) for each in robot.surfaces] == expected


def test_the_last_value_of_a_surface_wins() -> None:
    robot = robot_with(
        """<gazebo reference="arm"><mu1>1</mu1></gazebo>
           <gazebo reference="arm"><mu1>2</mu1><kd>3</kd></gazebo>"""
    )
    (surface,) = robot.surfaces
    assert surface.values() == (2, 2, None, None, 3)


@pytest.mark.skipif(IGN is None, reason="SDFormat is not installed")
@pytest.mark.parametrize(("body", "values"), SURFACES[:3])
def test_sdformat_reads_the_same_surface(
    body: str, values: tuple[float | None, ...], tmp_path: Path
) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(
        f"""<robot name="r"><link name="base">
              <inertial><mass value="1"/>
                <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
              <collision><geometry><sphere radius="1"/></geometry></collision>
            </link><gazebo reference="base">{body}</gazebo></robot>"""
    )
    environment = {**os.environ, "HOME": str(tmp_path)}
    done = subprocess.run(
        [str(IGN), "sdf", "-p", path], capture_output=True, text=True, env=environment, check=True
    )
    surface = ElementTree.fromstring(done.stdout).find(".//collision/surface")
    paths = ("friction/ode/mu", "friction/ode/mu2", "bounce/restitution_coefficient")
    texts = [surface.findtext(p) for p in (*paths, "contact/ode/kp", "contact/ode/kd")]  # type: ignore[union-attr]
    (found,) = Robot.from_urdf(path).surfaces
    own = found.number("friction2")
    assert [None if text is None else float(text) for text in texts] == [
        *(found.friction, own, found.restitution, found.stiffness, found.damping)
    ]
    assert found.values() == values


# --- actuators and control ------------------------------------------------------------------------

CONTROL = """<ros2_control name="hand" type="actuator">
  <hardware><plugin>p/Driver</plugin><param name="port"> 3 </param></hardware>
  <joint name="turn">
    <command_interface name="effort"/><command_interface name="position"/>
    <state_interface name="position"/>
  </joint>
  <sensor name="tilt">
    <state_interface name="orientation.x"/><param name="frame_id">eye_link</param>
  </sensor>
  <transmission name="t"><plugin>transmission_interface/SimpleTransmission</plugin>
    <joint name="turn" role="j"><mechanical_reduction>50</mechanical_reduction></joint>
  </transmission>
</ros2_control>"""


def test_ros2_control() -> None:
    robot = robot_with(CONTROL)
    (control,) = robot.controls
    assert (control.name, control.type, control.plugin) == ("hand", "actuator", "p/Driver")
    assert (control.joints, control.sensors, control.params) == (
        *(("turn",), ("tilt",)),
        {"port": "3"},
    )
    assert (control.has_transmissions, control.state) == (True, None)
    actuator = robot.actuators["turn"]
    assert (actuator.command, actuator.commands) == ("effort", ("effort", "position"))
    assert actuator.gear == 50
    assert (robot.sensors["tilt"].type, robot.sensors["tilt"].frame) == ("imu", "eye_link")


@pytest.mark.parametrize(
    ("body", "command", "gear"),
    [
        (
            (
                "<type>transmission_interface/SimpleTransmission</type><joint name='turn'>"
                "<hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface>"
                "</joint><actuator name='m'><mechanicalReduction>-6</mechanicalReduction>"
                "</actuator>"
            ),
            *("velocity", -6),
        ),
        (  # older files name the interface in the actuator
            (
                "<type>SimpleTransmission</type><joint name='turn'/><actuator name='m'>"
                "<hardwareInterface>EffortJointInterface</hardwareInterface></actuator>"
            ),
            *("effort", 1),
        ),
        (
            (
                "<type>transmission_interface/DifferentialTransmission</type><joint name='turn'>"
                "<hardwareInterface>PosVelJointInterface</hardwareInterface>"
                "<mechanicalReduction>3</mechanicalReduction></joint>"
            ),
            *("position", 1),
        ),
    ],
)
def test_transmissions(body: str, command: str, gear: float) -> None:
    robot = robot_with(f'<transmission name="t">{body}</transmission>')
    (actuator,) = robot.actuators.values()
    assert (actuator.joint, actuator.command, actuator.gear) == ("turn", command, gear)


def test_the_rotor_that_drake_reads_is_the_armature() -> None:
    robot = robot_with(
        """<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
             <joint name="turn">
               <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
             </joint>
             <actuator name="m"><drake:rotor_inertia value="2e-5"/><drake:gear_ratio value="30"/>
             </actuator></transmission>"""
    )
    actuator = robot.actuators["turn"]
    assert (actuator.command, actuator.rotor_inertia, actuator.gear) == ("effort", 2e-5, 30)
    assert actuator.armature == pytest.approx(2e-5 * 900, rel=1e-14)


def test_transmissions_of_the_pr2_command_efforts() -> None:
    robot = robot_with(
        """<transmission name="t" type="pr2_mechanism_model/SimpleTransmission">
             <actuator name="m"/><joint name="turn"/>
             <mechanicalReduction>79.24</mechanicalReduction></transmission>"""
    )
    assert (robot.actuators["turn"].command, robot.actuators["turn"].gear) == ("effort", 79.24)


@pytest.mark.parametrize("joint", ["eye_joint", "nowhere"])
def test_fixed_and_unknown_joints_have_no_actuator(joint: str) -> None:
    robot = robot_with(CONTROL.replace('joint name="turn"', f'joint name="{joint}"'))
    assert not robot.actuators


def test_ros2_control_wins_over_a_transmission() -> None:
    robot = robot_with(
        """<transmission name="t"><type>SimpleTransmission</type><joint name="turn">
             <hardwareInterface>EffortJointInterface</hardwareInterface></joint></transmission>
           <ros2_control name="c" type="system"><joint name="turn">
             <command_interface name="velocity"/></joint></ros2_control>"""
    )
    assert robot.actuators["turn"].command == "velocity"


# --- words and files ------------------------------------------------------------------------------

WORDS = """
robot: r
model:
- part:
    name: base
    link:
      mass: 1
      geometry: box
      scale: 1 1 1
      collision: {surface: {friction: 0.5}}
      sensor/name=imu: {type: imu, rate: 100}
- part:
    name: rod
    joint:
      type: revolute
      parent: base
      limit: {lower: -1, upper: 1, effort: 1, velocity: 1}
      actuator: {command: effort}
    link: {mass: 1, geometry: sphere, scale: 1, collision: }
- gazebo/reference=base_link: {mu1: 9, "<sensor/name=imu, type=imu>": {update_rate: 1}}
- gazebo/reference=rod_link: {mu1: 7, "<sensor/name=hit, type=contact>": }
- ros2_control/name=more, type=system:
    hardware: {plugin: other}
- transmission/name=t:
    type: SimpleTransmission
    joint/name=rod_joint: {hardwareInterface: PositionJointInterface}
control: {plugin: own}
"""


@pytest.mark.parametrize("gazebo", [False, True])
@pytest.mark.parametrize("mode", [None, "jail"])
def test_words_win_over_elements(mode: str | None, gazebo: bool) -> None:
    policy = yamaro.Policy(mode) if mode else None
    robot = yamaro.build("-", text=WORDS, gazebo=gazebo, policy=policy).robot
    assert {name: sensor.rate for name, sensor in robot.sensors.items()} == {
        "imu": 100,
        "hit": None,
    }
    assert [(each.link, each.friction) for each in robot.surfaces] == [
        ("base_link", 0.5),
        ("rod_link", 7),
    ]
    assert [each.command for each in robot.actuators.values()] == ["effort"]
    assert [each.plugin for each in robot.controls] == ["own", "other"]


def test_elements_of_a_file_are_not_written_again() -> None:
    text = yamaro.build("-", text=WORDS, gazebo=True).xml()
    assert text.count("<gazebo") == 4
    assert text.count('<sensor name="hit"') == 1


def test_elements_know_their_places_and_calls() -> None:
    text = """
robot: r
functions:
  Bump(link)/parent:
  - gazebo/reference=$(link): {"<sensor/name=hit, type=contact>": }
model:
- part: {name: base, link: {mass: 1, geometry: sphere, scale: 1}}
- Bump: {link: base_link}
"""
    (sensor,) = yamaro.build("-", text=text).robot.sensors.values()
    assert sensor.span.place().split(":")[-2] == "5"
    assert sensor.trace is not None
    assert sensor.trace.span.place().split(":")[-2] == "8"


def _values(sensor: Sensor) -> tuple[object, ...]:
    details = sensor.details
    numbers: list[float] = []
    if isinstance(details, Lidar):
        numbers = [details.rays, details.rows, details.angle, details.step, *details.range]
        numbers += [*details.ends(), *details.tilt_ends()]
    elif isinstance(details, Camera):
        numbers = [*details.size, details.fov, *details.clip]
    elif isinstance(details, Ranger):
        numbers = [*details.range]
    place = (sensor.link, sensor.joint, sensor.frame, sensor.optical_frame)
    said = (sensor.name, sensor.type, sensor.rate, sensor.noise, dict(sensor.noises), sensor.topic)
    return (*place, *said, sensor.pose, [round(number, 12) for number in numbers])


@pytest.mark.parametrize("name", ["gazebo", "control"])
def test_what_words_say_is_read_from_the_file_that_is_written(name: str, tmp_path: Path) -> None:
    build = yamaro.build(CASES / "sensors" / f"{name}.yaml", gazebo=True)
    path = tmp_path / "robot.urdf"
    path.write_text(build.xml())
    words = build.robot
    again = yamaro.build("-", text=f"robot: r\nmodel:\n- include: {{path: {path}}}\n").robot
    for robot in (Robot.from_xml(build.xml()), Robot.from_urdf(path), again):
        assert list(map(_values, robot.sensors.values())) == list(
            map(_values, words.sensors.values())
        )
        assert [(s.link, s.index, s.values()) for s in robot.surfaces] == [
            (s.link, s.index, s.values()) for s in words.surfaces
        ]
        assert [(a.joint, a.command, a.commands) for a in robot.actuators.values()] == [
            (a.joint, a.command, a.commands) for a in words.actuators.values()
        ]
        assert [
            (c.name or "r", c.type, c.plugin, c.joints, c.sensors, c.params, c.has_transmissions)
            for c in robot.controls
        ] == [
            (
                *(c.name or words.name, c.type, c.plugin, c.joints, c.sensors),
                *(c.params, c.has_transmissions),
            )
            for c in words.controls
        ]


def test_nothing_is_read_before_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    from yamaro.model import recognition

    read: list[Robot] = []

    def recognized(robot: Robot, _notes: object) -> list[object]:
        read.append(robot)
        return []

    monkeypatch.setattr(recognition, "recognized", recognized)
    robot = robot_with(CONTROL)
    assert robot.links
    assert robot.poses()
    assert not read
    assert not robot.sensors
    assert not robot.controls
    assert read == [robot]
