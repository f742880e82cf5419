"""Where links are for given joint positions, as pinocchio and yourdfpy have it."""

import random
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.consumers import oracles
from tests.scene.robots import JOINTS, robot_at, robot_of
from yamaro import build
from yamaro.tools.scene.kinematics import joint_positions, link_poses
from yamaro.tools.scene.robot import Robot

REPOSITORY = Path(__file__).parents[2]
EXAMPLES = [
    "arm/arm.yaml",
    "diff_drive/diff_drive.yaml",
    "hexapod/hexapod.yaml",
    "leg_robot/robot.yaml",
    "pan_tilt/pan_tilt.yaml",
    "quadruped/quadruped.yaml",
]
CORPUS = REPOSITORY.parent / "shared" / "corpus" / "src"
OTHERS = [
    "AndrejOrsula+panda_ign_moveit2/panda_description/urdf/panda.urdf",
    "Gepetto+example-robot-data/robots/talos_data/robots/talos_reduced.urdf",
    "DoosanRobotics+doosan-robot/dsr_description/urdf/m0609.urdf",
]


def random_positions(robot: Robot, seed: int) -> dict[str, float]:
    source = random.Random(seed)
    return {joint.name: source.uniform(*joint.range) for joint in robot.free_joints()}


def assert_same(poses: dict[str, Any], expected: dict[str, Any]) -> None:
    assert poses.keys() == expected.keys()
    for name, pose in poses.items():
        np.testing.assert_allclose(pose, expected[name], atol=1e-9, err_msg=name)


def matrices(robot: Robot, positions: dict[str, float]) -> dict[str, Any]:
    return {name: np.array(p.matrix()) for name, p in link_poses(robot, positions).items()}


def pinocchio_poses(urdf: str, positions: dict[str, float]) -> dict[str, Any]:
    """Return where pinocchio has each link; planar and floating joints are at their origins."""
    pin = oracles.require_module("pinocchio")
    model = pin.buildModelFromXML(urdf)
    data = model.createData()
    q = pin.neutral(model)
    for name, position in positions.items():
        joint = model.joints[model.getJointId(name)]
        is_circle = joint.nq == 2  # continuous: pinocchio has cosine and sine
        value = [np.cos(position), np.sin(position)] if is_circle else [position]
        q[joint.idx_q : joint.idx_q + joint.nq] = value
    pin.framesForwardKinematics(model, data, q)
    bodies = [i for i, frame in enumerate(model.frames) if frame.type == pin.FrameType.BODY]
    return {model.frames[i].name: data.oMf[i].homogeneous for i in bodies}


def yourdfpy_poses(urdf: str, positions: dict[str, float], folder: Path) -> dict[str, Any]:
    """Return where yourdfpy has each link, relative to the root."""
    model = oracles.load_yourdfpy(urdf, folder)
    model.update_cfg(positions)
    return {name: np.array(model.get_transform(name)) for name in model.link_map}


def test_each_type_of_joint_moves_as_in_pinocchio(tmp_path: Path) -> None:
    robot = robot_of(JOINTS, tmp_path)
    for seed in range(5):
        positions = random_positions(robot, seed)
        every = {**positions, **followers(positions)}
        assert_same(matrices(robot, positions), pinocchio_poses(JOINTS, every))


def followers(positions: dict[str, float]) -> dict[str, float]:
    """Return the positions of the joints of JOINTS that mimic others, worked out by hand."""
    return {"follow": 0.25 - 1.5 * positions["turn"], "echo": positions["slide"]}


@pytest.mark.parametrize("example", EXAMPLES)
def test_examples_move_as_in_yourdfpy(example: str, tmp_path: Path) -> None:
    path = REPOSITORY / "examples" / example
    urdf = build(path, on_message=lambda line: None).xml()
    robot = robot_at(path)
    positions = random_positions(robot, seed=7)
    assert_same(matrices(robot, positions), yourdfpy_poses(urdf, positions, tmp_path))


@pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
@pytest.mark.parametrize("name", OTHERS)
def test_robots_of_others_move_as_in_pinocchio(name: str) -> None:
    robot = robot_at(CORPUS / name)
    positions = random_positions(robot, seed=3)
    every = joint_positions(robot, positions)
    moving = {name: every[name] for name, joint in robot.joints.items() if joint.kind != "fixed"}
    urdf = (CORPUS / name).read_text(encoding="utf-8")
    assert_same(matrices(robot, positions), pinocchio_poses(urdf, moving))


def chain(*joints: str) -> str:
    links = "".join(f'<link name="l{number}"/>' for number in range(len(joints) + 1))
    return f'<robot name="r">{links}{"".join(joints)}</robot>'


def joint(number: int, content: str = "", kind: str = "revolute") -> str:
    return (
        f'<joint name="j{number}" type="{kind}"><parent link="l{number}"/>'
        f'<child link="l{number + 1}"/>{content}</joint>'
    )


def test_a_joint_stands_at_zero_or_in_the_middle_of_limits_without_it(tmp_path: Path) -> None:
    text = chain(
        joint(0, '<limit lower="-1" upper="3" effort="1" velocity="1"/>'),
        joint(1, '<limit lower="1" upper="3" effort="1" velocity="1"/>'),
        joint(2, kind="continuous"),
    )
    assert joint_positions(robot_of(text, tmp_path)) == {"j0": 0.0, "j1": 2.0, "j2": 0.0}


def test_a_chain_of_mimics_is_followed(tmp_path: Path) -> None:
    text = chain(
        joint(0, '<mimic joint="j1" multiplier="2"/>'),
        joint(1, '<mimic joint="j2" offset="1"/>'),
        joint(2, kind="continuous"),
    )
    positions = joint_positions(robot_of(text, tmp_path), {"j2": 0.5})
    assert positions == {"j0": 3.0, "j1": 1.5, "j2": 0.5}


def test_mimics_in_a_circle_or_of_nothing_end(tmp_path: Path) -> None:
    text = chain(
        joint(0, '<mimic joint="j1" offset="0.5"/>'),
        joint(1, '<mimic joint="j0"/>'),
        joint(2, '<mimic joint="none" offset="0.1"/>'),
    )
    positions = joint_positions(robot_of(text, tmp_path))
    assert positions.keys() == {"j0", "j1", "j2"}
    assert positions["j2"] == 0.1


def test_a_loop_of_links_ends(tmp_path: Path) -> None:
    text = (
        '<robot name="r"><link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>'
    )
    assert link_poses(robot_of(text, tmp_path)).keys() == {"a", "b"}


def test_a_chain_of_five_thousand_links_is_followed(tmp_path: Path) -> None:
    step = '<origin xyz="1 0 0"/>'
    text = chain(*(joint(number, step, kind="fixed") for number in range(5000)))
    poses = link_poses(robot_of(text, tmp_path))
    assert poses["l5000"].position == (5000.0, 0.0, 0.0)


def test_a_joint_without_limits_may_turn_once(tmp_path: Path) -> None:
    robot = robot_of(chain(joint(0), joint(1, kind="prismatic")), tmp_path)
    assert robot.joints["j0"].range == (-pi, pi)
    assert robot.joints["j1"].range == (-0.5, 0.5)
