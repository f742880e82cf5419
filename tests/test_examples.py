"""The examples are the machines that they say they are.

That other programs read every example robot, with the right masses and inertias, is tested in
consumers/; here stands what is true of one example and not of the next.
"""

from __future__ import annotations

import math
import re
import shlex
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import yaml
from lxml import etree

import yamaro
from tests.consumers import oracles
from tests.example_files import EXAMPLES, PROGRAMS
from tests.later import Later
from yamaro.commands.main import main
from yamaro.model.compare import compare
from yamaro.model.robot import Robot

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

ROBOTS = Path(__file__).parent / "examples"
"""The same robots, written without `mirror`, units and the like."""
MIRROR = np.diag([1.0, -1.0, 1.0])


def example_id(path: Path) -> str:
    return path.relative_to(EXAMPLES).as_posix()


def compile_example(name: str, *arguments: str) -> str:
    return yamaro.convert(str(EXAMPLES / name / f"{name}.yaml"), *arguments)


def read(xml: str) -> etree._Element:
    return etree.fromstring(xml.encode())


def joints_of_type(root: etree._Element, type_: str) -> list[str]:
    return [joint.get("name") for joint in root.findall("joint") if joint.get("type") == type_]


def roots(root: etree._Element) -> list[str]:
    children = {joint.find("child").get("link") for joint in root.findall("joint")}
    return [link.get("name") for link in root.findall("link") if link.get("name") not in children]


def total_mass(root: etree._Element) -> float:
    return sum(float(mass.get("value")) for mass in root.iterfind("link/inertial/mass"))


def limit(root: etree._Element, joint: str) -> dict[str, float]:
    attributes = root.find(f"joint[@name='{joint}']/limit").attrib
    return {name: float(value) for name, value in attributes.items()}


class Placed:
    """Where pinocchio puts the links of a robot for given joint positions; the rest are at 0."""

    def __init__(self, urdf: str, **positions: float) -> None:
        pinocchio = oracles.require_module("pinocchio")
        self.model = oracles.load_pinocchio(urdf)
        self.data = self.model.createData()
        self.q = pinocchio.neutral(self.model)
        for name, position in positions.items():
            joint = self.model.joints[self.model.getJointId(name)]
            assert joint.nq == 1
            self.q[joint.idx_q] = position
        pinocchio.framesForwardKinematics(self.model, self.data, self.q)

    def T(self, link: str) -> Any:
        """Return the 4×4 pose of a link in the root link."""
        frame = self.model.getFrameId(link)
        assert frame < self.model.nframes, link
        return np.array(self.data.oMf[frame].homogeneous)

    def at(self, link: str) -> Any:
        return self.T(link)[:3, 3]

    def centre_of_mass(self) -> Any:
        pinocchio = oracles.require_module("pinocchio")
        return np.array(pinocchio.centerOfMass(self.model, self.data, self.q))

    def total_inertia(self) -> Any:
        """Return the 3×3 inertia of the whole robot about its centre of mass, kg·m²."""
        pinocchio = oracles.require_module("pinocchio")
        pinocchio.ccrba(self.model, self.data, self.q, np.zeros(self.model.nv))
        return np.array(self.data.Ig.inertia)


# --- all of them ------------------------------------------------------------------------------


def test_each_example_is_told_of_in_the_readme() -> None:
    told = re.findall(r"^\| \[(\w+)\]\(\1/\)", (EXAMPLES / "README.md").read_text(), re.MULTILINE)
    assert sorted(told) == sorted(path.name for path in EXAMPLES.iterdir() if path.is_dir())


def commands(path: Path) -> list[str]:
    """Return the commands that the comment at the head of a file shows."""
    return re.findall(r"^#   (yamaro [^\n&]*)", path.read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize(
    ("path", "command"),
    [(path, command) for path in PROGRAMS for command in commands(path)],
    ids=lambda value: example_id(value) if isinstance(value, Path) else value,
)
def test_commands_at_the_head_of_a_file_work(
    path: Path,
    command: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    shutil.copytree(EXAMPLES, tmp_path / "there")  # some include files of others
    monkeypatch.chdir(tmp_path / "there" / path.parent.name)
    words = shlex.split(command)[1:]
    assert main(["--strict", *words]) == 0
    assert capsys.readouterr().err == ""
    output = Path(words[words.index("-o") + 1])
    assert len(read(output.read_text(encoding="utf-8"))) > 0


def repeats_a_key(node: yaml.Node | None) -> bool:
    if isinstance(node, yaml.MappingNode):
        keys = [key.value for key, _ in node.value]
        return len(set(keys)) < len(keys) or any(repeats_a_key(value) for _, value in node.value)
    return isinstance(node, yaml.SequenceNode) and any(map(repeats_a_key, node.value))


def test_both_forms_are_shown_each_throughout_a_folder() -> None:
    repeating = {
        path.parent.name for path in PROGRAMS if repeats_a_key(yaml.compose(path.read_bytes()))
    }
    listing = {
        path.parent.name
        for path in PROGRAMS
        if re.search(r"^(model|functions):\n(\s*#.*\n)*\s*- ", path.read_text(), re.MULTILINE)
    }
    assert repeating == {"diff_drive", "hexapod", "leg_robot", "pan_tilt"}
    assert listing == {path.parent.name for path in PROGRAMS} - repeating


def without_half_turns(xml: str) -> str:
    """Return a robot whose cylinders have the same end up: a mirror turns them by 180°."""
    root = read(xml)
    for section in root.iterfind("link/*"):
        if section.tag == "inertial" or section.find("geometry/cylinder") is not None:
            origin = section.find("origin")
            if origin.get("rpy") == "-1.5707963267949 0 0":
                origin.set("rpy", "1.5707963267949 0 0")
    return etree.tostring(root, encoding="unicode")


@pytest.mark.parametrize("name", ["diff_drive", "hexapod", "quadruped"])
def test_the_words_for_robots_make_the_robot_that_was_written_without_them(name: str) -> None:
    expected = (ROBOTS / f"{name}.urdf").read_text(encoding="utf-8")
    actual = without_half_turns(compile_example(name))
    differences = compare(Robot.from_xml(expected).element, Robot.from_xml(actual).element)
    assert [str(difference) for difference in differences] == []


# --- leg_robot --------------------------------------------------------------------------------


def test_leg_robot_is_one_tree_of_three_parts_with_one_sensor(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main([str(EXAMPLES / "leg_robot" / "robot.yaml")]) == 0
    captured = capsys.readouterr()
    root = read(captured.out)
    assert root.get("name") == "robot"
    assert roots(root) == ["root_link"]
    names = [link.get("name") for link in root.findall("link")]
    assert names == ["root_link", "base_link", "left_leg_link", "right_leg_link"]
    (sensor,) = root.iter("sensor")
    assert sensor.attrib == {"name": "imu_sensor", "type": "imu"}
    assert sensor.getparent().get("reference") == "left_leg_link"
    assert "base height: 0.5\n" in captured.err
    assert "Leg index from leg.yaml: 42\n" in captured.err


# --- pan_tilt ---------------------------------------------------------------------------------


def test_pan_tilt_stands_on_the_ground_and_turns() -> None:
    urdf = compile_example("pan_tilt")
    root = read(urdf)
    assert joints_of_type(root, "revolute") == ["pan_joint", "tilt_joint"]
    foot = root.find("link[@name='base_link']/visual/origin").get("xyz")
    assert foot == "0 0 0.01"  # a cylinder of 0.02 m, so from 0 to 0.02
    # A quarter turn of the pan takes the camera's forwards, x, to the left, y.
    turned = Placed(urdf, pan_joint=math.pi / 2).T("tilt_link")
    np.testing.assert_allclose(turned[:3, 0], [0, 1, 0], atol=1e-12)


# --- hexapod ----------------------------------------------------------------------------------

HEXAPOD_LEGS = [
    f"{side}_{end}" for side in ("left", "right") for end in ("front", "middle", "rear")
]


def test_hexapod_has_six_legs_of_three_joints() -> None:
    root = read(compile_example("hexapod"))
    expected = [
        f"{leg}_{part}_joint" for leg in HEXAPOD_LEGS for part in ("coxa", "femur", "tibia")
    ]
    assert joints_of_type(root, "revolute") == expected
    assert len(expected) == 18
    assert roots(root) == ["root_link"]
    # Body, and six times coxa, femur (two servos), tibia and foot.
    assert total_mass(root) == pytest.approx(1.1 + 6 * (0.07 + 0.11 + 0.045 + 0.008))
    assert "leg.yaml" in (EXAMPLES / "hexapod" / "hexapod.yaml").read_text()
    assert (EXAMPLES / "hexapod" / "hexapod.yaml").read_text().count("include:") == 1


@pytest.mark.parametrize("tibia", [0.133, 0.2])
def test_hexapod_stands_on_all_feet(tibia: float) -> None:
    placed = Placed(compile_example("hexapod", f"tibia_length:={tibia}"))
    feet = np.array([placed.at(f"{leg}_foot_link") for leg in HEXAPOD_LEGS])
    np.testing.assert_allclose(feet[:, 2], 0.009, atol=1e-12)  # the foot's radius
    np.testing.assert_allclose(feet[:3] @ MIRROR, feet[3:], atol=1e-12)
    # The middle foot stands a coxa and a femur beside the hip, at half the body's width and 3 cm.
    np.testing.assert_allclose(feet[1][:2], [0, 0.06 + 0.03 + 0.052 + 0.066], atol=1e-12)


def test_hexapod_lifts_a_leg_by_a_positive_angle() -> None:
    urdf = compile_example("hexapod")
    lifted = Placed(urdf, left_middle_femur_joint=0.5).at("left_middle_foot_link")
    assert lifted[2] > Placed(urdf).at("left_middle_foot_link")[2] + 0.02


def test_hexapod_carries_what_the_command_line_says() -> None:
    bare, laden = read(compile_example("hexapod")), read(compile_example("hexapod", "payload:=0.5"))
    assert total_mass(laden) - total_mass(bare) == pytest.approx(0.5)
    assert bare.find("link[@name='payload_link']") is None
    assert laden.find("joint[@name='payload_joint']/parent").get("link") == "base_link"


# --- arm --------------------------------------------------------------------------------------

# The manufacturer's Denavit-Hartenberg table of the UR5: a, d (m), alpha (rad).
UR5 = [
    (0.0, 0.089159, math.pi / 2),
    (-0.425, 0.0, 0.0),
    (-0.39225, 0.0, 0.0),
    (0.0, 0.10915, math.pi / 2),
    (0.0, 0.09465, -math.pi / 2),
    (0.0, 0.0823, 0.0),
]
ARM_JOINTS = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]


def ur5_flange(angles: list[float]) -> Any:
    """Return the flange's 4×4 pose from the table; ROS's base is turned half about z."""
    pose = np.diag([-1.0, -1.0, 1.0, 1.0])
    for theta, (a, d, alpha) in zip(angles, UR5, strict=True):
        c, s, ca, sa = math.cos(theta), math.sin(theta), math.cos(alpha), math.sin(alpha)
        pose = pose @ np.array(
            [
                [c, -s * ca, s * sa, a * c],
                [s, c * ca, -c * sa, a * s],
                [0, sa, ca, d],
                [0, 0, 0, 1],
            ]
        )
    return pose


@pytest.mark.parametrize(
    "angles",
    [
        [0.0] * 6,
        [0.3, -1.2, 1.4, -1.7, -1.5, 0.4],
        [-2.0, -0.4, -1.1, 0.9, 2.2, -3.0],
    ],
)
def test_arm_moves_its_flange_as_a_ur5_does(angles: list[float]) -> None:
    positions = {f"{name}_joint": angle for name, angle in zip(ARM_JOINTS, angles, strict=True)}
    actual = Placed(compile_example("arm"), **positions).T("tool0")
    np.testing.assert_allclose(actual, ur5_flange(angles), atol=1e-9)


def test_arm_has_six_axes_and_a_gripper_of_which_one_finger_follows() -> None:
    root = read(compile_example("arm", "stroke:=0.1"))
    assert joints_of_type(root, "revolute") == [f"{name}_joint" for name in ARM_JOINTS]
    assert joints_of_type(root, "prismatic") == ["left_finger_joint", "right_finger_joint"]
    (mimic,) = root.iter("mimic")
    assert mimic.get("joint") == "left_finger_joint"
    assert mimic.getparent().get("name") == "right_finger_joint"
    assert root.find("joint[@name='gripper_joint']/parent").get("link") == "tool0"
    assert limit(root, "left_finger_joint") == {
        "lower": 0,
        "upper": 0.05,
        "effort": 60,
        "velocity": 0.15,
    }
    assert limit(root, "elbow_joint")["upper"] == pytest.approx(math.pi)
    # 21.99 kg with the base: the links of a UR5 as in its manual's table, gripper and fingers.
    arm = [4.0, 3.7, 8.393, 2.275, 1.219, 1.219, 0.1879]
    assert total_mass(root) == pytest.approx(sum(arm) + 0.78 + 2 * 0.06)


def test_arm_opens_its_gripper_by_the_stroke() -> None:
    urdf = compile_example("arm", "stroke:=0.1")
    placed = Placed(urdf, left_finger_joint=0.05, right_finger_joint=0.05)
    gap = np.linalg.norm(placed.at("left_finger_link") - placed.at("right_finger_link"))
    assert gap == pytest.approx(0.1)


def test_arm_goes_bare_or_by_another_name() -> None:
    bare = read(compile_example("arm", "tool:=none"))
    assert [link.get("name") for link in bare.findall("link")][-1] == "tool0"
    named = read(compile_example("arm", "prefix:=left_"))
    names = [element.get("name") for tag in ("link", "joint") for element in named.findall(tag)]
    assert names[0] == "root_link"
    assert all(name.startswith("left_") for name in names[1:])


def test_arm_refuses_a_tool_that_it_does_not_know() -> None:
    with pytest.raises(yamaro.YamaroError, match="'spoon'"):
        compile_example("arm", "tool:=spoon")


# --- diff_drive -------------------------------------------------------------------------------


def test_diff_drive_stands_on_wheels_and_caster() -> None:
    urdf = compile_example("diff_drive")
    root = read(urdf)
    assert roots(root) == ["base_footprint"]
    assert joints_of_type(root, "continuous") == ["left_wheel_joint", "right_wheel_joint"]
    placed = Placed(urdf)
    left, right = placed.at("left_wheel_link"), placed.at("right_wheel_link")
    cylinder = root.find("link[@name='left_wheel_link']/collision/geometry/cylinder")
    assert left[2] == right[2] == pytest.approx(float(cylinder.get("radius")))
    ball = root.find("link[@name='caster_link']/collision")
    below = placed.at("caster_link")[2] + oracles.floats(ball.find("origin").get("xyz"))[2]
    assert below == pytest.approx(float(ball.find("geometry/sphere").get("radius")))
    # What the plugin counts with is what stands there.
    plugin = root.find("gazebo/plugin[@name='gz::sim::systems::DiffDrive']")
    assert float(plugin.findtext("wheel_separation")) == pytest.approx(left[1] - right[1])
    assert float(plugin.findtext("wheel_radius")) == pytest.approx(left[2])
    assert plugin.findtext("left_joint") == "left_wheel_joint"


def test_diff_drive_falls_over_neither_way() -> None:
    placed = Placed(compile_example("diff_drive"))
    x, y, _ = placed.centre_of_mass()
    assert placed.at("caster_link")[0] < x < placed.at("left_wheel_link")[0]
    assert y == pytest.approx(0, abs=1e-12)


def test_diff_drive_senses() -> None:
    root = read(compile_example("diff_drive", "lidar_samples:=720"))
    sensors = {sensor.get("name"): sensor for sensor in root.iter("sensor")}
    assert [sensor.get("type") for sensor in sensors.values()] == ["gpu_lidar", "camera"]
    scan = sensors["lidar"].find("lidar/scan/horizontal")
    assert scan.findtext("samples") == "720"
    # 720 beams, half a degree from one to the next, and the last as far from the first.
    span = float(scan.findtext("max_angle")) - float(scan.findtext("min_angle"))
    assert span == pytest.approx(math.radians(359.5))
    # Optical frames: z is forwards, x to the right, y down.
    frame = sensors["camera"].findtext("gz_frame_id")
    axes = Placed(compile_example("diff_drive")).T(frame)[:3, :3]
    np.testing.assert_allclose(axes, [[0, 0, 1], [-1, 0, 0], [0, -1, 0]], atol=1e-12)
    without = read(compile_example("diff_drive", "camera:=false"))
    assert [sensor.get("name") for sensor in without.iter("sensor")] == ["lidar"]


def test_diff_drive_is_driven_by_the_plugin_or_by_ros2_control() -> None:
    plugin = read(compile_example("diff_drive"))
    assert plugin.find("ros2_control") is None
    root = read(compile_example("diff_drive", "control:=ros2_control"))
    assert root.find("gazebo/plugin[@name='gz::sim::systems::DiffDrive']") is None
    # The file that the controllers are started with names the same joints.
    path = root.findtext("gazebo/plugin/parameters")
    controllers = yaml.safe_load(Path(path).read_text())
    parameters = controllers["diff_drive_controller"]["ros__parameters"]
    joints = parameters["left_wheel_names"] + parameters["right_wheel_names"]
    assert [joint.get("name") for joint in root.findall("ros2_control/joint")] == joints
    assert set(joints) == set(joints_of_type(root, "continuous"))
    for joint in root.findall("ros2_control/joint"):
        top = float(joint.findtext("command_interface[@name='velocity']/param[@name='max']"))
        assert top * parameters["wheel_radius"] == pytest.approx(
            parameters["linear.x.max_velocity"]
        )
        states = [state.get("name") for state in joint.findall("state_interface")]
        assert states == ["position", "velocity"]
    with pytest.raises(yamaro.YamaroError, match="'wishes'"):
        compile_example("diff_drive", "control:=wishes")


# --- quadruped --------------------------------------------------------------------------------

QUADRUPED_LEGS = ["front_left", "front_right", "rear_left", "rear_right"]


def test_quadruped_has_four_legs_of_three_joints() -> None:
    root = read(compile_example("quadruped"))
    expected = [
        f"{leg}_{part}_joint" for leg in QUADRUPED_LEGS for part in ("hip", "thigh", "calf")
    ]
    assert joints_of_type(root, "revolute") == expected
    assert roots(root) == ["root_link"]
    assert total_mass(root) == pytest.approx(5.204 + 4 * (0.68 + 1.009 + 0.196 + 0.06))


@pytest.mark.parametrize("angles", [(0.0, 0.0, 0.0), (0.3, 0.9, -1.8), (-0.4, 0.2, -1.1)])
def test_quadruped_is_the_mirror_image_of_itself(angles: tuple[float, float, float]) -> None:
    hip, thigh, calf = angles
    positions = {}
    for leg in QUADRUPED_LEGS:
        # The mirror turns a roll round, and leaves what pitches.
        positions[f"{leg}_hip_joint"] = hip if leg.endswith("left") else -hip
        positions[f"{leg}_thigh_joint"] = thigh
        positions[f"{leg}_calf_joint"] = calf
    placed = Placed(compile_example("quadruped"), **positions)
    for end in ("front", "rear"):
        for part in ("hip", "thigh", "calf", "foot"):
            left, right = (placed.T(f"{end}_{side}_{part}_link") for side in ("left", "right"))
            np.testing.assert_allclose(MIRROR @ left[:3, 3], right[:3, 3], atol=1e-12)
            np.testing.assert_allclose(MIRROR @ left[:3, :3] @ MIRROR, right[:3, :3], atol=1e-12)
    # Masses too: the centre lies in the middle, and nothing makes it wobble sideways.
    assert placed.centre_of_mass()[1] == pytest.approx(0, abs=1e-12)
    inertia = placed.total_inertia()
    np.testing.assert_allclose(MIRROR @ inertia @ MIRROR, inertia, atol=1e-12)


def test_quadruped_folds_its_legs_as_far_on_both_sides() -> None:
    root = read(compile_example("quadruped"))
    for end in ("front", "rear"):
        left, right = (limit(root, f"{end}_{side}_hip_joint") for side in ("left", "right"))
        assert (left["lower"], left["upper"]) == (-right["upper"], -right["lower"])
        assert left["upper"] > -left["lower"]  # a left leg rolls outwards about +x


def test_quadruped_puts_its_feet_where_two_bones_reach() -> None:
    lengths = 0.25, 0.2
    urdf = compile_example("quadruped", f"thigh_length:={lengths[0]}", f"calf_length:={lengths[1]}")
    thigh, calf = 0.8, -1.5
    placed = Placed(urdf, front_left_thigh_joint=thigh, front_left_calf_joint=calf)
    hip, foot = placed.at("front_left_thigh_link"), placed.at("front_left_foot_link")
    # A pitch takes what hangs down backwards.
    x = -lengths[0] * math.sin(thigh) - lengths[1] * math.sin(thigh + calf)
    z = -lengths[0] * math.cos(thigh) - lengths[1] * math.cos(thigh + calf)
    np.testing.assert_allclose(foot - hip, [x, 0, z], atol=1e-12)


# --- drone, hand and humanoid -----------------------------------------------------------------


def stand(name: str, folder: Path, state: str = "home") -> tuple[Any, Any]:
    """Return MuJoCo's model of an example on a floor, and its data two seconds after a state."""
    mujoco = oracles.require_module("mujoco")
    path = EXAMPLES / name / f"{name}.yaml"
    build = yamaro.build(path, target="mjcf", on_message=lambda line: None)
    for file, content in {**build.assets, f"{name}.xml": build.xml().encode()}.items():
        (folder / file).write_bytes(content)
    model = mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(state).id)
    while data.time < 2:
        mujoco.mj_step(model, data)
    return model, data


@pytest.mark.parametrize(
    ("name", "legs"), [("drone", 4), ("humanoid", 2), ("mobile_manipulator", 4)]
)
def test_an_example_with_a_free_base_stands_on_its_feet(
    name: str, legs: int, tmp_path: Path
) -> None:
    model, data = stand(name, tmp_path)
    start = model.key("home").qpos
    assert np.abs(data.qpos[:3] - start[:3]).max() < 0.02
    assert np.abs(data.qpos[7:] - start[7:]).max() < 0.04
    assert data.qpos[3] > 0.999  # cosine of half of the angle by which it leans
    floor = model.geom("floor").id
    on_floor = {
        int(model.geom_bodyid[geom])
        for contact in data.contact
        if floor in contact.geom
        for geom in contact.geom
        if geom != floor
    }
    assert len(on_floor) == legs


@pytest.mark.parametrize("rotors", [4, 6, 8])
def test_drone_has_rotors_around_it_that_turn_in_alternate_directions(rotors: int) -> None:
    urdf = compile_example("drone", f"rotors:={rotors}", "arm_length:=0.4")
    root = read(urdf)
    placed = Placed(urdf)
    places = np.array([placed.at(f"rotor_{i}_link") for i in range(rotors)])
    np.testing.assert_allclose(np.hypot(places[:, 0], places[:, 1]), 0.4, rtol=1e-12)
    np.testing.assert_allclose(places[:, :2].sum(axis=0), 0, atol=1e-12)
    turns = [each.text for each in root.iter("turningDirection")]
    assert turns == ["ccw", "cw"] * (rotors // 2)
    lowest = placed.at("foot_0_link")[2]
    cylinder = root.find("link[@name='foot_0_link']/collision")
    middle = oracles.floats(cylinder.find("origin").get("xyz"))[2]
    length = float(cylinder.find("geometry/cylinder").get("length"))
    assert lowest + middle - length / 2 == pytest.approx(0)  # on the ground


def test_hand_closes_its_fingers_until_the_tips_meet() -> None:
    urdf = compile_example("hand")
    root = read(urdf)
    assert len(list(root.iter("mimic"))) == 6
    fingers = ("thumb", "index", "ring")

    def gap(motor: float) -> float:
        follow = {"proximal": motor, "middle": 0.8 * motor, "distal": 0.5 * motor}
        offsets = {"proximal": 0.0, "middle": math.pi / 6, "distal": math.radians(25)}
        positions = {
            f"{finger}_{name}_joint": angle + offsets[name]
            for finger in fingers
            for name, angle in follow.items()
        }
        placed = Placed(urdf, **positions)
        tips = [placed.at(f"{finger}_tip_link") for finger in fingers]
        return min(float(np.linalg.norm(tips[i] - tips[i - 1])) for i in range(3)) - 2 * 0.008

    assert 0 <= gap(0) < 0.002
    assert gap(math.radians(-40)) > 0.08


@pytest.mark.parametrize("state", ["open", "closed"])
def test_hand_holds_its_states(state: str, tmp_path: Path) -> None:
    model, data = stand("hand", tmp_path, state)
    assert np.abs(data.qpos - model.key(state).qpos).max() < 0.01


@pytest.mark.parametrize("crouch", [0.0, 0.5, 1.2])
def test_humanoid_puts_its_soles_on_the_ground_at_home(crouch: float) -> None:
    path = EXAMPLES / "humanoid" / "humanoid.yaml"
    build = yamaro.build(path, command_line=[f"crouch:={crouch}", "shin_length:=0.33"])
    home = build.robot.states["home"].positions
    placed = Placed(build.xml(), **home)
    for side, y in (("left", 0.08), ("right", -0.08)):
        sole = placed.T(f"{side}_sole")
        np.testing.assert_allclose(sole[:3, 3], [0, y, 0], atol=1e-12)
        np.testing.assert_allclose(sole[:3, :3], np.eye(3), atol=1e-12)
    # Between the heels, 75 mm behind the ankles, and the tips of the toes.
    assert -0.075 < placed.centre_of_mass()[0] < 0.135


def test_humanoid_has_groups_and_states_for_both_sides() -> None:
    path = EXAMPLES / "humanoid" / "humanoid.yaml"
    robot = yamaro.build(path).robot
    assert set(robot.groups) == {"left_leg", "left_arm", "right_leg", "right_arm", "body"}
    home = robot.states["home"].positions
    assert home["left_shoulder_roll_joint"] == -home["right_shoulder_roll_joint"] != 0
    assert home["left_shin_joint"] == home["right_shin_joint"] != 0


# --- dual_arm_cell and mobile_manipulator -----------------------------------------------------


def test_the_arms_of_the_cell_are_those_of_the_other_example() -> None:
    urdf = compile_example("dual_arm_cell", "spacing:=1.0")
    placed = Placed(urdf)
    alone = Placed(compile_example("arm")).at("tool0")
    for side, y in (("left", 0.5), ("right", -0.5)):
        base = placed.at(f"{side}_base_link")
        np.testing.assert_allclose(base, [-0.32, y, 0.74], atol=1e-12)
        np.testing.assert_allclose(placed.at(f"{side}_tool0"), base + alone, atol=1e-12)
    names = [each.get("name") for each in read(urdf).findall("ros2_control")]
    assert names == ["left_arm", "right_arm"]


def test_the_cell_holds_its_home(tmp_path: Path) -> None:
    model, data = stand("dual_arm_cell", tmp_path)
    assert model.nu == 14
    assert np.abs(data.qpos - model.key("home").qpos).max() < 0.02


def test_mobile_manipulator_does_not_tip_over_with_its_arm_stretched_out() -> None:
    urdf = compile_example("mobile_manipulator")
    placed = Placed(urdf)  # with all joints at 0 the arm points forward
    front, rear = placed.at("front_left_wheel_link"), placed.at("rear_right_wheel_link")
    assert front[2] == rear[2] == pytest.approx(0.11)
    x, y, _ = placed.centre_of_mass()
    assert rear[0] < x < front[0]
    assert rear[1] < y < front[1]
    (wheels,) = [
        each for each in read(urdf).findall("ros2_control") if each.get("name") == "wheels"
    ]
    assert {each.get("name") for each in wheels.iterfind("joint/command_interface")} == {"velocity"}
    assert len(wheels.findall("joint")) == 4


# --- world ------------------------------------------------------------------------------------

# The elements of SDF 1.11 that the world uses, from the specification at sdformat.org: what an
# element may hold, ? at most once, * any number, + at least once, and else exactly once; @ is an
# attribute. An element with a number holds that many numbers.
SDF: dict[str, str | int] = {
    "sdf": "@version world*",
    "world": "@name audio? wind? include* gravity? magnetic_field? atmosphere? gui? physics+ "
    "scene? light* frame* model* actor* plugin* road* spherical_coordinates? joint* "
    "state* population*",
    "physics": "@name? @default? @type max_step_size? real_time_factor? real_time_update_rate? "
    "max_contacts? dart? simbody? bullet? ode?",
    "plugin": "@name @filename any*",
    "gravity": 3,
    "scene": "ambient? background? sky? shadows? fog? grid? origin_visual?",
    "light": "@name @type pose? cast_shadows? intensity? diffuse? specular? attenuation? "
    "direction spot? light_on? visualize?",
    "direction": 3,
    "model": "@name @canonical_link? @placement_frame? static? self_collide? allow_auto_disable? "
    "enable_wind? frame* pose? link* joint* plugin* gripper* include* model*",
    "link": "@name gravity? enable_wind? self_collide? kinematic? must_be_base_link? pose? "
    "velocity_decay? inertial? collision* visual* sensor* projector* light* battery* "
    "audio_sink* audio_source* particle_emitter*",
    "inertial": "@auto? mass? density? pose? inertia? auto_inertia_params? fluid_added_mass?",
    "inertia": "ixx? ixy? ixz? iyy? iyz? izz?",
    "collision": "@name laser_retro? max_contacts? pose? geometry surface? density?",
    "visual": "@name cast_shadows? laser_retro? transparency? visibility_flags? meta? pose? "
    "geometry material? plugin*",
    "geometry": "empty? box? capsule? cylinder? ellipsoid? heightmap? image? mesh? plane? "
    "polyline* sphere?",
    "box": "size",
    "box/size": 3,
    "plane": "normal size",
    "plane/size": 2,
    "normal": 3,
    "surface": "bounce? friction? contact? soft_contact?",
    "friction": "torsional? ode? bullet?",
    "friction/ode": "mu? mu2? fdir1? slip1? slip2?",
    "material": "script? shader? render_order? lighting? ambient? diffuse? specular? emissive? "
    "double_sided? pbr?",
    "include": "@merge? uri name? static? pose? plugin* placement_frame?",
    "pose": 6,
    "ambient": 4,
    "diffuse": 4,
    "specular": 4,
    "background": 4,
}
for _element in "ixx iyy izz mass mu mu2 max_step_size real_time_factor".split():
    SDF[_element] = 1
SDF_BOOLEANS = {"static", "shadows", "cast_shadows"}
SDF_TEXTS = {"uri", "name"}


def sdf_faults(element: etree._Element) -> list[str]:
    """Return what the table does not allow, in the element and in all below it."""
    parent = element.getparent()
    within = "" if parent is None else f"{parent.tag}/{element.tag}"
    rule = SDF.get(within, SDF.get(element.tag))
    text = (element.text or "").strip()
    if element.tag in SDF_BOOLEANS:
        return [] if text in ("true", "false") else [f"{within}: {text}"]
    if element.tag in SDF_TEXTS:
        return [] if text else [f"{within} is empty"]
    if rule is None:
        return [f"{within} is unknown"]
    if isinstance(rule, int):
        words = text.split()
        good = len(words) == rule and all(math.isfinite(float(word)) for word in words)
        return [] if good else [f"{within}: {text}"]
    return _sdf_structure_faults(element, rule)


def _sdf_structure_faults(element: etree._Element, rule: str) -> list[str]:
    faults = []
    found = [f"@{name}" for name in element.attrib] + [child.tag for child in element]
    allowed = {word.rstrip("?*+"): word for word in rule.split()}
    if "any" in allowed:
        found = [name for name in found if name.startswith("@")]
    faults += [f"{name} in {element.tag}" for name in found if name not in allowed]
    for name, word in allowed.items():
        least, most = {"?": (0, 1), "*": (0, 1e9), "+": (1, 1e9)}.get(word[-1], (1, 1))
        if not least <= found.count(name) <= most:
            faults.append(f"{found.count(name)} × {name} in {element.tag}")
    if "any" not in allowed:
        faults += [fault for child in element for fault in sdf_faults(child)]
    return faults


WORLDS = [(), ("boxes:=0",), ("boxes:=12", "spacing:=1.2", "robot_file:=robot.urdf")]


@pytest.mark.parametrize("arguments", WORLDS, ids=" ".join)
def test_world_holds_what_sdf_allows(arguments: tuple[str, ...]) -> None:
    root = read(compile_example("world", *arguments))
    assert root.attrib == {"version": "1.11"}
    assert sdf_faults(root) == []


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("<gravity>", "<mass>1</mass><gravity>"),
        ('<world name="slalom">', "<world>"),
        ("<pose>0 0 10 0 0 0</pose>", "<pose>0 0 10</pose>"),
        ("<shadows>true</shadows>", "<shadows>yes</shadows>"),
        ("<normal>0 0 1</normal>", ""),
    ],
)
def test_the_table_of_sdf_tells_bad_from_good(right: str, wrong: str) -> None:
    sdf = compile_example("world")
    assert right in sdf
    assert sdf_faults(read(sdf.replace(right, wrong, 1))) != []


def test_world_has_a_slalom_of_boxes() -> None:
    root = read(compile_example("world", "boxes:=4", "spacing:=2", "swing:=0.5"))
    boxes = [model for model in root.iter("model") if model.get("name").startswith("box_")]
    poses = [oracles.floats(box.findtext("pose")) for box in boxes]
    assert [pose[0] for pose in poses] == [2, 4, 6, 8]
    assert [pose[1] for pose in poses] == [0.5, -0.5, 0.5, -0.5]
    for box, pose in zip(boxes, poses, strict=True):
        size = oracles.floats(box.findtext("link/collision/geometry/box/size"))
        assert pose[2] == pytest.approx(size[2] / 2)  # stands on the ground
        solid = trimesh.creation.box(size)
        solid.density = float(box.findtext("link/inertial/mass")) / solid.volume
        inertia = box.find("link/inertial/inertia")
        given = [float(inertia.findtext(key)) for key in ("ixx", "iyy", "izz")]
        np.testing.assert_allclose(given, np.diag(solid.moment_inertia), rtol=1e-9)


def test_world_includes_models_as_sdf_does() -> None:
    root = read(compile_example("world", "robot_file:=my_robot.urdf"))
    uris = {include.findtext("name"): include.findtext("uri") for include in root.iter("include")}
    assert list(uris) == ["finish", "robot"]
    assert uris["robot"] == "my_robot.urdf"
    without = read(compile_example("world"))
    assert [include.findtext("name") for include in without.iter("include")] == ["finish"]
