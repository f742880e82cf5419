"""What links and joints of SDF hold, and what is kept of them for SDF."""

from __future__ import annotations

from math import pi
from pathlib import Path
from xml.etree import ElementTree

import pytest

import yamaro
from yamaro import Build, YamaroError
from yamaro.model import Robot
from yamaro.model.extras import Camera

BOX = "<geometry><box><size>1 2 3</size></box></geometry>"


def built(folder: Path, model: str, *, version: str = "1.11", target: str = "urdf") -> Build:
    path = folder / "robot.sdf"
    path.write_text(f'<sdf version="{version}"><model name="robot">{model}</model></sdf>')
    return yamaro.build(path, target=target)


def robot_of(folder: Path, model: str, **options: str) -> Robot:
    return built(folder, model, **options).robot


def test_inertia_follows_from_collisions_and_their_densities(tmp_path: Path) -> None:
    """A ball of 1000 kg/m³ with r = 0.1, and a box of 500 kg/m³ at x = 1."""
    robot = robot_of(
        tmp_path,
        '<link name="a"><inertial auto="true"/>'
        '<collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry>'
        '</collision><collision name="box"><density>500</density><pose>1 0 0 0 0 0</pose>'
        "<geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>",
    )
    ball, box = 1000 * 4 / 3 * pi * 0.1**3, 500 * 0.2**3
    inertial = robot.links["a"].inertial
    assert inertial is not None
    assert inertial.mass == pytest.approx(ball + box)
    assert inertial.pose.position == pytest.approx((box / (ball + box), 0, 0))
    own = 2 / 5 * ball * 0.1**2 + box / 12 * 2 * 0.2**2
    steiner = ball * box / (ball + box)
    moments = (own, 0, 0, own + steiner, 0, own + steiner)
    assert inertial.inertia == pytest.approx(moments, abs=1e-12)


@pytest.mark.parametrize(
    ("shape", "volume", "across", "along", "height"),
    [
        ("<cone><radius>0.2</radius><length>0.4</length></cone>",
         pi * 0.2**2 * 0.4 / 3, 3 / 80 * (4 * 0.2**2 + 0.4**2), 3 / 10 * 0.2**2, -0.1),
        ("<ellipsoid><radii>0.1 0.1 0.3</radii></ellipsoid>",
         4 / 3 * pi * 0.1 * 0.1 * 0.3, (0.1**2 + 0.3**2) / 5, 2 * 0.1**2 / 5, 0.0),
    ],
)  # fmt: skip
def test_inertia_of_shapes_that_urdf_has_not(
    shape: str, volume: float, across: float, along: float, height: float, tmp_path: Path
) -> None:
    """Moments of a cone about its centre of mass, a quarter up: 3/80·m·(4r² + h²), 3/10·m·r²."""
    robot = robot_of(
        tmp_path,
        '<link name="a"><inertial auto="true"><density>2</density></inertial>'
        f'<collision name="c"><geometry>{shape}</geometry></collision></link>',
    )
    inertial = robot.links["a"].inertial
    assert inertial is not None
    mass = 2 * volume
    assert inertial.mass == pytest.approx(mass)
    assert inertial.pose.position == pytest.approx((0, 0, height))
    assert inertial.inertia == pytest.approx(
        (mass * across, 0, 0, mass * across, 0, mass * along), abs=1e-12
    )


def test_a_mass_that_is_given_scales_what_follows_from_collisions(tmp_path: Path) -> None:
    robot = robot_of(
        tmp_path,
        '<link name="a"><inertial auto="true"><mass>3</mass></inertial>'
        f'<collision name="c">{BOX}</collision></link>',
    )
    inertial = robot.links["a"].inertial
    assert inertial is not None
    assert inertial.mass == 3
    assert inertial.inertia == pytest.approx((3 / 12 * 13, 0, 0, 3 / 12 * 10, 0, 3 / 12 * 5))


def test_surfaces_are_read_and_the_rest_of_them_is_kept(tmp_path: Path) -> None:
    model = (
        f'<link name="a"><collision name="c">{BOX}<surface><friction><ode><mu>0.4</mu>'
        "<slip1>0.1</slip1></ode></friction><contact><ode><kp>1000</kp><kd>2</kd></ode></contact>"
        "<bounce><restitution_coefficient>0.3</restitution_coefficient></bounce></surface>"
        "<max_contacts>4</max_contacts></collision></link>"
    )
    (surface,) = robot_of(tmp_path, model).surfaces
    assert surface.values() == (0.4, 1.0, 0.3, 1000, 2)
    text = built(tmp_path, model, target="sdf").xml()
    for each in ("<mu>0.4</mu>", "<slip1>0.1</slip1>", "<max_contacts>4</max_contacts>"):
        assert text.count(each) == 1
    assert text.count("<ode>") == 2


def test_a_sensor_has_a_frame_where_it_is_and_its_details_are_kept(tmp_path: Path) -> None:
    model = (
        '<link name="a"><sensor name="eye" type="camera"><pose>0 0 1 0 0 0</pose><update_rate>30'
        "</update_rate><camera name='lens'><horizontal_fov>1.2</horizontal_fov><image><width>64"
        "</width><height>48</height><format>L8</format></image><clip><near>0.2</near><far>9</far>"
        "</clip></camera></sensor>"
        '<sensor name="imu" type="imu"><imu><angular_velocity><x><noise type="gaussian"><mean>0'
        "</mean><stddev>0.01</stddev><bias_stddev>0.5</bias_stddev></noise></x></angular_velocity>"
        "</imu></sensor></link>"
    )
    robot = robot_of(tmp_path, model)
    eye, imu = robot.sensors["eye"], robot.sensors["imu"]
    assert (eye.type, eye.rate, eye.frame, eye.optical_frame) == (
        "camera",
        30,
        "eye",
        "eye_optical",
    )
    assert isinstance(eye.details, Camera)
    assert (eye.details.size, eye.details.fov, eye.details.clip) == ((64, 48), 1.2, (0.2, 9))
    assert robot.poses()["eye"].position == (0, 0, 1)
    assert (imu.type, imu.frame) == ("imu", "a")
    text = built(tmp_path, model, target="sdf").xml()
    for each in ("<format>L8</format>", "<bias_stddev>0.5</bias_stddev>", 'camera name="lens"'):
        assert text.count(each) == 1


def test_sensors_of_one_name_in_two_links_keep_it_in_sdf(tmp_path: Path) -> None:
    sensor = '<sensor name="imu" type="imu"/>'
    model = f'<link name="a">{sensor}</link><link name="b"><pose>1 0 0 0 0 0</pose>{sensor}</link>'
    assert set(robot_of(tmp_path, model).sensors) == {"imu", "b_imu"}
    assert built(tmp_path, model, target="sdf").xml().count('<sensor name="imu"') == 2


def test_colours_are_materials_and_what_else_is_said_of_looks_is_kept(tmp_path: Path) -> None:
    model = (
        f'<link name="a"><visual name="v">{BOX}<material><diffuse>1 0 0</diffuse><specular>.1 .1 .1'
        f" 1</specular></material><transparency>0.5</transparency></visual><visual name='w'>{BOX}"
        "<material><script><name>Gazebo/Blue</name></script></material></visual></link>"
    )
    robot = robot_of(tmp_path, model)
    first, second = (each.material for each in robot.links["a"].visuals)
    assert first is not None
    assert second is not None
    assert (first.color, second.color) == ((1, 0, 0, 1), (0, 0, 1, 1))
    text = built(tmp_path, model, target="sdf").xml()
    for each in ("<specular>", "<transparency>0.5</transparency>", "Gazebo/Blue"):
        assert text.count(each) == 1


def test_axes_of_version_1_4_are_in_the_frame_of_the_model(tmp_path: Path) -> None:
    model = (
        '<link name="a"/><link name="b"><pose>0 0 1 0 0 1.5707963267948966</pose></link>'
        '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>'
        "</axis></joint>"
    )
    old, new = (robot_of(tmp_path, model, version=version) for version in ("1.4", "1.5"))
    assert old.joints["j"].axis == pytest.approx((0, -1, 0), abs=1e-12)
    assert new.joints["j"].axis == (1, 0, 0)


def test_the_one_noise_of_an_imu_before_1_6_is_that_of_each_axis(tmp_path: Path) -> None:
    """As 1_5.convert of libsdformat says: of `rate` for the rates, of `accel` for the others."""
    noise = "<rate><stddev>0.02</stddev></rate><accel><stddev>0.5</stddev></accel>"
    model = f"""<link name="a"><sensor name="i" type="imu"><imu><noise><type>gaussian</type>
        {noise}</noise></imu></sensor></link>"""
    build = built(tmp_path, model, version="1.5", target="sdf")
    root = ElementTree.fromstring(build.xml())
    for name, deviation in (("angular_velocity", "0.02"), ("linear_acceleration", "0.5")):
        found = root.findall(f".//imu/{name}/*/noise[@type='gaussian']/stddev")
        assert [each.text for each in found] == [deviation] * 3


def test_a_noise_of_another_type_and_attributes_of_other_programs_are_kept(tmp_path: Path) -> None:
    build = built(
        tmp_path,
        '<link name="a"><sensor name="m" type="magnetometer"><magnetometer><x>'
        '<noise type="gaussian_quantized"><stddev>0.1</stddev></noise></x></magnetometer></sensor>'
        '<visual name="v"><geometry><box><size my:mark="yes">1 2 3</size></box></geometry></visual>'
        "</link>",
        target="sdf",
    )
    assert 'type="gaussian_quantized"' in build.xml()
    assert 'my:mark="yes">1 2 3</size>' in build.xml()


def test_a_mimic_with_a_reference_is_one_offset(tmp_path: Path) -> None:
    joint = (
        '<joint name="{0}" type="revolute"><parent>a</parent><child>{1}</child><axis><xyz>1 0 0'
        "</xyz>{2}</axis></joint>"
    )
    mimic = (
        '<mimic joint="j"><multiplier>2</multiplier><offset>0.5</offset><reference>0.1</reference>'
        "</mimic>"
    )
    robot = robot_of(
        tmp_path,
        '<link name="a"/><link name="b"/><link name="c"/>'
        + joint.format("j", "b", "")
        + joint.format("k", "c", mimic),
    )
    follower = robot.joints["k"].mimic
    assert follower is not None
    assert (follower.joint, follower.multiplier) == ("j", 2)
    assert follower.offset == pytest.approx(0.5 - 2 * 0.1)


def test_a_joint_that_closes_a_loop_is_a_loop(tmp_path: Path) -> None:
    joint = '<joint name="{}" type="{}"><parent>{}</parent><child>{}</child>{}</joint>'
    axis = "<axis><xyz>0 1 0</xyz></axis>"
    robot = robot_of(
        tmp_path,
        '<link name="a"/><link name="b"><pose>1 0 0 0 0 0</pose></link><link name="c"><pose>1 0 1 '
        "0 0 0</pose></link>"
        + joint.format("ab", "revolute", "a", "b", axis)
        + joint.format("bc", "revolute", "b", "c", axis)
        + joint.format("ac", "revolute", "a", "c", axis),
        target="mjcf",
    )
    assert set(robot.joints) >= {"ab", "bc"}
    loop = robot.loops["ac"]
    poses = robot.poses()
    assert loop.type == "revolute"
    assert [poses[each].position for each in loop.between] == [(1, 0, 1), (1, 0, 1)]


def test_what_is_kept_is_reported_when_another_format_is_written(tmp_path: Path) -> None:
    model = (
        '<link name="a"><visual name="v"><geometry><plane/></geometry></visual></link>'
        '<plugin name="p" filename="lib.so"/>'
    )
    build = built(tmp_path, model, target="mjcf")
    assert {each.what for each in build.losses} >= {
        "SDF's <visual> elements",
        "SDF's <plugin> elements",
    }


def test_what_a_link_without_mass_says_of_itself_is_not_said_of_its_body(tmp_path: Path) -> None:
    """SDF has it as a frame of the link that it is fixed to."""
    model = """<link name="a"/><link name="b"><gravity>false</gravity>
        <inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz></inertia></inertial>
        </link><joint name="j" type="fixed"><parent>a</parent><child>b</child></joint>"""
    build = built(tmp_path, model, target="sdf")
    assert "gravity" not in build.xml()
    assert [each.code for each in build.warnings] == ["lost-in-sdf"]
    assert "<gravity> of links that are frames" in build.warnings[0].message


def test_names_in_what_is_kept_change_with_the_prefix_of_an_attached_robot(tmp_path: Path) -> None:
    built(
        tmp_path,
        '<pose>9 9 9 0 0 0</pose><link name="a"/><plugin name="p" filename="l.so"><link_name>a'
        "</link_name></plugin>",
    )
    path = tmp_path / "two.yaml"
    path.write_text(
        "robot: two\nmodel:\n- part: {link/name=table: {geometry: sphere, radius: 1, mass: 1}}\n"
        "- attach: {path: robot.sdf, to: table, prefix: left_}\n"
    )
    text = yamaro.build(path, target="sdf").xml()
    assert "<link_name>left_a</link_name>" in text
    assert "9 9 9" not in text


@pytest.mark.parametrize(
    ("model", "code", "place"),
    [
        ('<link name="a"/><joint name="j" type="hinge"><parent>a</parent><child>a</child></joint>',
         "bad-sdf", "a"),
        (
            f'<link name="a"><visual name="v">{BOX.replace("1 2 3", "1 -2 3")}</visual></link>',
            "bad-sdf",
            "1 -2 3",
        ),
        ('<link name="a"/><frame name="f" attached_to="b"/>', "sdf-frame", "b"),
        ('<link name="a"><pose rotation_format="rpy">0 0 0 0 0 0</pose></link>', "bad-sdf", "rpy"),
        ('<link name="__a__"/>', "bad-sdf", "__a__"),
    ],
)  # fmt: skip
def test_faults_are_at_their_place(model: str, code: str, place: str, tmp_path: Path) -> None:
    with pytest.raises(YamaroError) as error:
        built(tmp_path, model)
    first = error.value.diagnostics[0]
    assert first.code == code
    assert place in first.span.written() or "self" in first.message or "itself" in first.message
