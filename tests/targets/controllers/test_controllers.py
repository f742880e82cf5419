"""The file of controllers: as ROS and PyYAML read it, its wheels by construction, its values."""

# ruff: noqa: E501 - the lines of robots

from __future__ import annotations

import io
import struct
from math import cos, isnan, sin, tau
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML

import yamaro
from tests.effort import examples
from yamaro.sandbox import jail
from yamaro.targets.parameters import yaml_of

Json = dict[str, Any]
in_jail = pytest.mark.skipif(jail.check_available() is not None, reason="there is no jail here")


def controllers_of(path: Path, **options: Any) -> Json:
    """Return the file that is written for a robot, as PyYAML reads it."""
    build = yamaro.build(path, target="controllers", **options)
    read: Json = yaml.safe_load(build.xml())
    return read


def parameters(document: Json, name: str) -> Json:
    found: Json = document[name]["ros__parameters"]
    return found


# --- YAML -------------------------------------------------------------------------------------


SCALARS = st.one_of(
    st.booleans(),
    st.integers(),
    st.floats(allow_nan=False).map(lambda number: float(f"{number:.12g}")),
    st.text(),
    st.sampled_from(
        ["on", "No", "y", "1e3", ".5", "0x1F", "12:30:00", "~", "null", "=", "- a", ""]
    ),
)
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(SCALARS) | st.dictionaries(st.text(), inner), max_leaves=8
)


@settings(max_examples=examples(300))
@given(st.dictionaries(st.text(), VALUES))
def test_yaml_1_1_and_1_2_read_the_values_that_were_written(document: Json) -> None:
    text = yaml_of(document)
    assert same(yaml.safe_load(text), document)
    assert same(YAML(typ="safe", pure=True).load(io.StringIO(text)), document)


def same(one: object, other: object) -> bool:
    """Return whether values are equal, and of the same types, as ROS has them."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(same, one, other))
    return type(one) is type(other) and one == other


@pytest.mark.parametrize(
    ("number", "text"),
    [(1.0, "1.0"), (1e-05, "1.0e-05"), (2.5e22, "2.5e+22"), (float("inf"), ".inf")],
)
def test_doubles_have_a_point(number: float, text: str) -> None:
    assert yaml_of({"a": number}) == f"a: {text}\n"


def test_not_a_number_is_written() -> None:
    assert isnan(yaml.safe_load(yaml_of({"a": float("nan")}))["a"])


# --- which controllers ------------------------------------------------------------------------


ARM = """robot: panda
model:
- part: {name: base, link: {geometry: sphere, radius: 0.05, mass: 1}}
- for i in range(1, 8):
  - part:
      name: panda_joint$(i) panda_link$(i)
      joint:
        type: revolute
        parent: $('base' if i == 1 else f'panda_link{i - 1}')
        limit: {lower: -2, upper: 2, effort: 87, velocity: 2}
      link: {geometry: sphere, radius: 0.05, mass: 1}
- part: {name: panda_hand_joint panda_hand, joint: {type: fixed, parent: panda_link7}}
- for i in [1, 2]:
  - part:
      name: panda_finger_joint$(i) panda_finger$(i)
      joint:
      - {type: prismatic, parent: panda_hand, limit: {lower: 0, upper: 0.04, effort: 20, velocity: 0.1}}
      - if i == 2:
        - mimic: panda_finger_joint1
      link: {geometry: sphere, radius: 0.01, mass: 0.1}
groups:
  panda_arm: {chain: [base, panda_link7]}
  panda_hand: {links: [panda_finger1, panda_finger2], parent: panda_link7, end_effector: true}
control: {plugin: mock_components/GenericSystem, joints: '*'}
"""


def test_an_arm_with_a_gripper_has_the_controllers_that_its_vendor_publishes(
    tmp_path: Path,
) -> None:
    # Values of panda_moveit_config/config/ros2_controllers.yaml of moveit_resources.
    path = tmp_path / "panda.yaml"
    own = "panda_arm_controller: {type: joint_trajectory, group: panda_arm, "
    own += "allow_nonzero_velocity_at_trajectory_end: true}"
    path.write_text(f"{ARM}controllers: {{distro: humble, {own}}}\n")
    found = controllers_of(path)
    assert parameters(found, "controller_manager") == {
        "update_rate": 100,
        "joint_state_broadcaster": {"type": "joint_state_broadcaster/JointStateBroadcaster"},
        "panda_arm_controller": {"type": "joint_trajectory_controller/JointTrajectoryController"},
        "panda_hand_controller": {"type": "position_controllers/GripperActionController"},
    }
    assert parameters(found, "panda_arm_controller") == {
        "command_interfaces": ["position"],
        "state_interfaces": ["position", "velocity"],
        "joints": [f"panda_joint{i}" for i in range(1, 8)],
        "allow_nonzero_velocity_at_trajectory_end": True,
    }
    assert parameters(found, "panda_hand_controller") == {"joint": "panda_finger_joint1"}


def test_the_usual_controllers_follow_from_a_urdf(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf"
    urdf = yamaro.build(written(tmp_path / "arm.yaml", ARM)).xml()
    sensor = "".join(
        f'<state_interface name="{what}.{axis}"/>' for what in ("force", "torque") for axis in "xyz"
    )
    sensor = f'<sensor name="load">{sensor}<param name="frame_id">panda_hand</param></sensor>'
    path.write_text(urdf.replace("</ros2_control>", f"{sensor}</ros2_control>"))
    found = controllers_of(path)
    trajectory = parameters(found, "joint_trajectory_controller")
    assert trajectory["joints"] == [
        *(f"panda_joint{i}" for i in range(1, 8)),
        "panda_finger_joint1",
    ]
    assert parameters(found, "load_broadcaster") == {
        "sensor_name": "load",
        "frame_id": "panda_hand",
    }


def written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


def test_commands_of_the_hardware_alone_are_forwarded(tmp_path: Path) -> None:
    # As gz_ros2_control has `position_pid`, which no trajectory controller takes.
    urdf = yamaro.build(written(tmp_path / "arm.yaml", ARM)).xml()
    urdf = urdf.replace(
        'command_interface name="position"', 'command_interface name="position_pid"'
    )
    found = controllers_of(written(tmp_path / "arm.urdf", urdf))
    own = parameters(found, "forward_position_pid_controller")
    assert own["interface_name"] == "position_pid"
    assert len(own["joints"]) == 8


def test_joints_of_a_chain_are_in_its_order(tmp_path: Path) -> None:
    parts = ARM.replace("range(1, 8)", "range(7, 0, -1)").replace("1 else", "7 else")
    parts = parts.replace("{i - 1}", "{i + 1}").replace("panda_link7", "panda_link1")
    found = controllers_of(written(tmp_path / "arm.yaml", parts))
    joints = parameters(found, "panda_arm_controller")["joints"]
    assert joints == [f"panda_joint{i}" for i in range(7, 0, -1)]


def test_of_groups_that_overlap_the_smallest_have_the_joints(tmp_path: Path) -> None:
    groups = "groups:\n  whole: {chain: [base, panda_link7]}\n  wrist: {chain: [panda_link5, panda_link7]}\n"
    text = ARM.partition("groups:")[0] + groups + "control: {plugin: a/B, joints: 'panda_joint*'}\n"
    found = controllers_of(written(tmp_path / "arm.yaml", text))
    assert parameters(found, "wrist_controller")["joints"] == ["panda_joint6", "panda_joint7"]
    assert parameters(found, "whole_controller")["joints"] == [
        f"panda_joint{i}" for i in range(1, 6)
    ]


def test_a_robot_has_its_controllers_as_they_are_given(tmp_path: Path) -> None:
    own = "arm: {type: joint_trajectory, group: panda_arm, action_monitor_rate: 20}"
    text = f"{ARM}controllers: {{update_rate: 500 Hz, lock_memory: true, {own}}}\n"
    robot = yamaro.build(written(tmp_path / "arm.yaml", text)).robot
    assert robot.controller_manager is not None
    assert robot.controller_manager.distro == "jazzy"
    assert robot.controller_manager.parameters == {"update_rate": 500, "lock_memory": True}
    arm = robot.controllers["arm"]
    assert (arm.type, arm.group, arm.joints) == ("joint_trajectory", "panda_arm", ())
    assert arm.parameters == {"action_monitor_rate": 20.0}
    assert arm.span.place().endswith("arm.yaml:25:55")


def test_a_parameter_that_changes_is_a_difference(tmp_path: Path) -> None:
    text = f"{ARM}controllers: {{arm: {{type: joint_trajectory, cmd_timeout: 1}}}}\n"
    robots = [
        yamaro.build(written(tmp_path / name, each)).robot
        for name, each in (("a.yaml", text), ("b.yaml", text.replace("timeout: 1", "timeout: 2")))
    ]
    (change,) = robots[0].changes(robots[1])
    assert (change.of, change.name, change.what) == ("controller", "arm", "cmd_timeout")
    assert (change.before, change.after) == (1.0, 2.0)


@in_jail
def test_a_jailed_build_gives_the_same_file(tmp_path: Path) -> None:
    path = written(tmp_path / "arm.yaml", ARM)
    assert controllers_of(path, policy=yamaro.Policy("jail")) == controllers_of(path)


# --- wheels -----------------------------------------------------------------------------------


def rover(wheel: str, *, root: str = "", sides: str = "[('left', 0.3), ('right', -0.3)]") -> str:
    return f"""robot: rover
model:
- part: {{name: root}}
- part: {{name: base, joint: {{type: fixed, parent: root{root}}}, link: {{geometry: box, size: 1 0.4 0.2, mass: 5}}}}
- for side, y in {sides}:
  - part:
      name: $(side)_wheel
      joint: {{type: continuous, parent: base, xyz: 0 $(y) 0, axis: y, actuator: {{command: velocity}}}}
      link: {{{wheel}, inertial: {{mass: 1, inertia: 1 0 0 1 0 1}}}}
control: {{plugin: mock_components/GenericSystem}}
controllers: {{wheels: {{type: diff_drive, joints: '*'}}}}
"""


ACROSS = "rpy: 90deg 0 0"
OUTWARD = "xyz: 0 $(0.05 if y > 0 else -0.05) 0"


@pytest.mark.parametrize(
    ("wheel", "radius", "separation"),
    [
        (f"geometry: cylinder, radius: 0.1, length: 0.04, {ACROSS}, collision: ", 0.1, 0.6),
        (f"geometry: cylinder, radius: 0.1, length: 0.04, {ACROSS}, visual: ", 0.1, 0.6),
        (f"geometry: cylinder, radius: 0.1, length: 0.04, {ACROSS}, {OUTWARD}, visual: ", 0.1, 0.7),
        (f"geometry: sphere, radius: 0.2, {OUTWARD}, collision: ", 0.2, 0.7),
        (f"geometry: capsule, radius: 0.02, length: 0.1, {ACROSS}, collision: ", 0.02, 0.6),
        ("geometry: wheel.stl, scale: 0.001 0.001 0.001, collision: ", 0.15, 0.64),
    ],
)
def test_wheels_have_the_sizes_that_they_were_made_with(
    tmp_path: Path, wheel: str, radius: float, separation: float
) -> None:
    (tmp_path / "wheel.stl").write_bytes(disc(radius=150, start=-10, end=50))
    if "stl" in wheel:  # the middle of both is 20 mm further out: the right one is turned about
        wheel = wheel.replace("collision: ", "rpy: $(0 if y > 0 else pi) 0 0, collision: ")
    path = written(tmp_path / "rover.yaml", rover(wheel))
    found = parameters(controllers_of(path, allow=["capsule-needs-urdf-1.1"]), "wheels")
    assert found["wheel_radius"] == pytest.approx(radius, rel=1e-6)
    assert found["wheel_separation"] == pytest.approx(separation, rel=1e-6)
    assert found["left_wheel_names"] == ["left_wheel_joint"]
    assert found["right_wheel_names"] == ["right_wheel_joint"]
    assert found["base_frame_id"] == "root_link"


def disc(*, radius: float, start: float, end: float, sides: int = 360) -> bytes:
    """Return the running surface of a wheel about y as STL."""

    def corner(i: int, y: float) -> tuple[float, float, float]:
        return radius * cos(tau * i / sides), y, radius * sin(tau * i / sides)

    triangles = []
    for i in range(sides):
        a, b, c, d = corner(i, start), corner(i + 1, start), corner(i + 1, end), corner(i, end)
        triangles += [(a, b, c), (a, c, d)]
    data = b"".join(struct.pack("<12fH", 0, 0, 0, *p, *q, *r, 0) for p, q, r in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + data


def test_several_wheels_a_side_count_by_their_mean(tmp_path: Path) -> None:
    wheel = f"geometry: cylinder, radius: 0.1, length: 0.04, {ACROSS}, collision: "
    sides = "[('a', 0.3), ('b', 0.32), ('c', -0.3), ('d', -0.32)]"
    found = parameters(
        controllers_of(written(tmp_path / "r.yaml", rover(wheel, sides=sides))), "wheels"
    )
    assert found["left_wheel_names"] == ["a_wheel_joint", "b_wheel_joint"]
    assert found["wheel_separation"] == pytest.approx(0.62)


def test_sides_and_forward_are_those_of_the_root(tmp_path: Path) -> None:
    wheel = f"geometry: cylinder, radius: 0.1, length: 0.04, {ACROSS}, collision: "
    path = written(tmp_path / "rover.yaml", rover(wheel, root=", rpy: 0 0 180deg"))
    build = yamaro.build(path, target="controllers")
    found = parameters(yaml.safe_load(build.xml()), "wheels")
    assert found["left_wheel_names"] == ["right_wheel_joint"]
    assert [each.code for each in build.warnings].count("wheel-axis") == 2


def test_what_is_given_is_not_computed(tmp_path: Path) -> None:
    text = rover("geometry: box, size: 1 1 1, collision: ")
    text = text.replace("joints: '*'", "joints: '*', wheel_radius: 2in, wheel_separation: 1")
    found = parameters(controllers_of(written(tmp_path / "rover.yaml", text)), "wheels")
    assert found["wheel_radius"] == pytest.approx(0.0508)
    assert found["wheel_separation"] == 1.0
