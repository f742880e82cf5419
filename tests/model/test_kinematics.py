"""Where links and the centre of mass are for given joint positions, as pinocchio has it."""

import csv
import random
from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from tests.consumers import oracles
from tests.later import Later
from tests.model.robots import EXAMPLES, JOINTS
from yamaro import Robot, build
from yamaro.model import Pose
from yamaro.model.kinematics import base_of, joint_positions

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation
else:
    Rotation = Later("scipy.spatial.transform", "Rotation")

REPOSITORY = Path(__file__).parents[2]
CORPUS = REPOSITORY.parent / "shared" / "corpus"
TOLERANCE = 1e-12


def corpus_robots(count: int) -> Iterator[tuple[Path, "Pinocchio"]]:
    """Yield so many robots from all over the corpus; pinocchio refuses some of those there."""
    with (CORPUS / "urdf.tsv").open(encoding="utf-8", newline="") as file:
        paths = [CORPUS / "src" / row["path"] for row in csv.DictReader(file, delimiter="\t")]
    random.Random(50).shuffle(paths)
    found = 0
    for path in paths:
        try:
            judge = Pinocchio(path.read_text(encoding="utf-8"))
        except ValueError:
            continue
        yield path, judge
        found += 1
        if found == count:
            return
    pytest.fail(f"pinocchio accepts only {found} robots")


def random_positions(robot: Robot, source: random.Random) -> dict[str, float]:
    return {joint.name: source.uniform(*joint.range) for joint in robot.free_joints()}


def assert_same(poses: Mapping[str, Pose], expected: Mapping[str, Any]) -> None:
    assert set(expected) <= set(poses)
    for name, matrix in expected.items():
        np.testing.assert_allclose(poses[name].matrix(), matrix, atol=TOLERANCE, err_msg=name)


class Pinocchio:
    """Where pinocchio has the links of a robot."""

    def __init__(self, urdf: str) -> None:
        self.pin = oracles.require_module("pinocchio")
        self.model = self.pin.buildModelFromXML(urdf)
        self.data = self.model.createData()

    def _configuration(self, positions: Mapping[str, Any]) -> Any:
        q = self.pin.neutral(self.model)
        for name, position in positions.items():
            if not self.model.existJointName(name):
                continue  # a fixed joint
            joint = self.model.joints[self.model.getJointId(name)]
            if joint.nq == 2:  # continuous: pinocchio has cosine and sine
                value = [np.cos(position), np.sin(position)]
            elif joint.nq == 4:  # planar
                x, y, angle = position
                value = [x, y, np.cos(angle), np.sin(angle)]
            elif joint.nq == 7:  # floating
                turn = Rotation.from_matrix(position.rotation)
                value = [*position.position, *turn.as_quat()]
            else:
                value = [position]
            q[joint.idx_q : joint.idx_q + joint.nq] = value
        return q

    def poses(self, positions: Mapping[str, Any]) -> dict[str, Any]:
        self.pin.framesForwardKinematics(self.model, self.data, self._configuration(positions))
        frames = enumerate(self.model.frames)
        bodies = [i for i, frame in frames if frame.type == self.pin.FrameType.BODY]
        return {self.model.frames[i].name: self.data.oMf[i].homogeneous for i in bodies}

    def center_of_mass(self, positions: Mapping[str, Any]) -> Any:
        return self.pin.centerOfMass(self.model, self.data, self._configuration(positions))


def test_each_type_of_joint_moves_as_in_pinocchio() -> None:
    robot = Robot.from_xml(JOINTS)
    judge = Pinocchio(JOINTS)
    source = random.Random(1)
    for _ in range(20):
        positions: dict[str, Any] = dict(random_positions(robot, source))
        positions["drift"] = tuple(source.uniform(-3, 3) for _ in range(3))
        turn = Rotation.from_euler("xyz", [source.uniform(-3, 3) for _ in range(3)])
        rows = turn.as_matrix().tolist()
        positions["float"] = Pose(rows, (source.uniform(-3, 3), 0.5, -2.0))
        every = {**positions, **followers(positions)}
        assert_same(robot.poses(positions), judge.poses(every))


def followers(positions: dict[str, Any]) -> dict[str, float]:
    """Return the positions of the joints of JOINTS that mimic others, worked out by hand."""
    return {"follow": 0.25 - 1.5 * positions["turn"], "echo": positions["slide"]}


@pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
@pytest.mark.parametrize("count", [3, pytest.param(50, marks=pytest.mark.slow)])
def test_public_robots_move_as_in_pinocchio(count: int) -> None:
    source = random.Random(13)
    for path, judge in corpus_robots(count):
        robot = Robot.from_urdf(path)
        for _ in range(20):
            positions = random_positions(robot, source)
            expected = judge.poses(joint_positions(robot, positions))
            assert_same(robot.poses(positions), expected)
            last = list(expected)[-1]
            found = robot.pose(last, positions).matrix()
            np.testing.assert_allclose(found, expected[last], atol=TOLERANCE)


@pytest.mark.parametrize("example", EXAMPLES)
def test_examples_move_as_in_yourdfpy(example: str, tmp_path: Path) -> None:
    built = build(REPOSITORY / "examples" / example, on_message=lambda line: None)
    positions = random_positions(built.robot, random.Random(7))
    model = oracles.load_yourdfpy(built.xml(), tmp_path)
    model.update_cfg(positions)
    expected = {name: np.array(model.get_transform(name)) for name in model.link_map}
    for name, pose in built.robot.poses(positions).items():
        np.testing.assert_allclose(pose.matrix(), expected[name], atol=1e-9, err_msg=name)


@pytest.mark.parametrize("example", EXAMPLES)
def test_the_centre_of_mass_is_that_of_pinocchio(example: str) -> None:
    built = build(REPOSITORY / "examples" / example, on_message=lambda line: None)
    robot = built.robot
    positions = random_positions(robot, random.Random(3))
    pin = oracles.require_module("pinocchio")
    judge = Pinocchio(built.xml())
    expected = judge.center_of_mass(joint_positions(robot, positions))
    inertias = judge.model.inertias
    mass = pin.computeTotalMass(judge.model)
    # pinocchio has the root's mass apart, in the inertia of the universe
    root = inertias[0]
    total = mass + root.mass
    both = (mass * expected + root.mass * root.lever) / total
    assert robot.mass == pytest.approx(total)
    np.testing.assert_allclose(robot.center_of_mass(positions), both, atol=TOLERANCE)


# --- joints that follow others ----------------------------------------------------------------


def chain(*joints: str) -> str:
    links = "".join(f'<link name="l{number}"/>' for number in range(len(joints) + 1))
    return f'<robot name="r">{links}{"".join(joints)}</robot>'


def joint(number: int, content: str = "", kind: str = "revolute") -> str:
    return (
        f'<joint name="j{number}" type="{kind}"><parent link="l{number}"/>'
        f'<child link="l{number + 1}"/>{content}</joint>'
    )


def test_a_chain_of_mimics_is_followed() -> None:
    text = chain(
        joint(0, '<mimic joint="j1" multiplier="2"/>'),
        joint(1, '<mimic joint="j2" offset="1"/>'),
        joint(2, kind="continuous"),
    )
    positions = joint_positions(Robot.from_xml(text), {"j2": 0.5})
    assert positions == {"j0": 3.0, "j1": 1.5, "j2": 0.5}


def test_mimics_in_a_circle_or_of_nothing_end() -> None:
    text = chain(
        joint(0, '<mimic joint="j1" offset="0.5"/>'),
        joint(1, '<mimic joint="j0"/>'),
        joint(2, '<mimic joint="none" offset="0.1"/>'),
    )
    positions = joint_positions(Robot.from_xml(text))
    assert positions.keys() == {"j0", "j1", "j2"}
    assert positions["j2"] == 0.1


# --- odd robots -------------------------------------------------------------------------------


def test_a_loop_of_links_ends() -> None:
    text = (
        '<robot name="r"><link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>'
    )
    robot = Robot.from_xml(text)
    assert robot.poses().keys() == {"a", "b"}
    assert robot.pose("a").position == (0.0, 0.0, 0.0)


def test_a_link_that_hangs_on_a_loop_is_placed() -> None:
    text = (
        '<robot name="r"><link name="c"/><link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
        '<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>'
        '<joint name="l" type="fixed"><origin xyz="1 0 0"/><parent link="b"/><child link="c"/>'
        "</joint></robot>"
    )
    poses = Robot.from_xml(text).poses()
    assert list(poses) == ["c", "a", "b"]
    away = np.subtract(poses["c"].position, poses["b"].position)
    assert away.tolist() == [1.0, 0.0, 0.0]


def test_a_chain_of_five_thousand_links_is_followed() -> None:
    step = '<origin xyz="1 0 0"/>'
    text = chain(*(joint(number, step, kind="fixed") for number in range(5000)))
    robot = Robot.from_xml(text)
    assert robot.poses()["l5000"].position == (5000.0, 0.0, 0.0)
    assert robot.pose("l5000").position == (5000.0, 0.0, 0.0)


def test_a_planar_joint_moves_in_the_plane_across_its_axis() -> None:
    text = chain(joint(0, '<axis xyz="1 0 0"/>', kind="planar"))
    robot = Robot.from_xml(text)
    pose = robot.pose("l1", {"j0": (0.5, 0.25, pi / 2)})
    np.testing.assert_allclose(pose.position, [0, 0.25, -0.5], atol=1e-15)
    expected = Rotation.from_euler("x", 90, degrees=True).as_matrix()
    np.testing.assert_allclose(pose.rotation, expected, atol=1e-15)


# --- what may be given ------------------------------------------------------------------------

GIVEN = chain(
    joint(0, kind="continuous"),
    joint(1, kind="fixed"),
    joint(2, '<mimic joint="j0"/>'),
    joint(3, kind="planar"),
    joint(4, kind="floating"),
)


@pytest.mark.parametrize(
    ("positions", "message"),
    [
        ({"j9": 1.0}, "the robot has no joint 'j9'"),
        ({"j1": 1.0}, "joint 'j1' is fixed, and has no position"),
        ({"j2": 1.0}, "joint 'j2' mimics 'j0': give the position of that one"),
        ({"j0": (1.0, 2.0)}, "joint 'j0' is continuous: give its position as one number"),
        ({"j0": "x"}, "joint 'j0' is continuous: give its position as one number"),
        ({"j3": 1.0}, "joint 'j3' is planar: give its position as x, y and an angle"),
        ({"j3": (1.0, 2.0)}, "joint 'j3' is planar: give its position as x, y and an angle"),
        ({"j4": 1.0}, "joint 'j4' is floating: give its position as a Pose"),
    ],
)
def test_a_position_that_no_joint_can_have_is_refused(
    positions: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        Robot.from_xml(GIVEN).pose("l1", positions)


def test_numbers_of_numpy_are_positions() -> None:
    robot = Robot.from_xml(GIVEN)
    given: dict[str, Any] = {"j0": np.float32(0.5), "j3": np.array([1, 2, 0])}
    plain: dict[str, Any] = {"j0": 0.5, "j3": (1.0, 2.0, 0.0)}
    assert robot.pose("l4", given) == robot.pose("l4", plain)


def test_an_unknown_link_is_named_with_the_one_that_may_be_meant() -> None:
    robot = Robot.from_xml('<robot name="r"><link name="tool0"/></robot>')
    with pytest.raises(ValueError, match=r"no link or frame 'tol0'; did you mean 'tool0'\?"):
        robot.pose("tol0")


def test_a_robot_without_mass_has_no_centre_of_mass() -> None:
    with pytest.raises(ValueError, match="the robot 'r' has no mass"):
        Robot.from_xml('<robot name="r"><link name="a"/></robot>').center_of_mass()


# --- poses that are shown ---------------------------------------------------------------------


def test_a_joint_rests_at_zero_or_in_the_middle_of_limits_without_it() -> None:
    text = chain(
        joint(0, '<limit lower="-1" upper="3" effort="1" velocity="1"/>'),
        joint(1, '<limit lower="1" upper="3" effort="1" velocity="1"/>'),
        joint(2, kind="continuous"),
    )
    rests = {name: each.rest for name, each in Robot.from_xml(text).joints.items()}
    assert rests == {"j0": 0.0, "j1": 2.0, "j2": 0.0}


def test_a_joint_without_limits_may_turn_once() -> None:
    robot = Robot.from_xml(chain(joint(0), joint(1, kind="prismatic")))
    assert robot.joints["j0"].range == (-pi, pi)
    assert robot.joints["j1"].range == (-0.5, 0.5)


# --- the base ---------------------------------------------------------------------------------


def tree(*joints: str, mass: float = 1.0, root: str = "base", types: str = "revolute") -> Robot:
    """Return a robot of links 'name' on links 'parent', each written as `parent>name[:type]`.

    `*` before the name makes a mimic joint; every link has the mass.
    """
    inertial = f'<inertial><mass value="{mass}"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
    links, parts = [root], []
    for each in joints:
        ends, _, kind = each.partition(":")
        parent, _, child = ends.partition(">")
        mimic = '<mimic joint="leader"/>' if child.startswith("*") else ""
        child = child.removeprefix("*")
        links.append(child)
        parts.append(
            f'<joint name="{child}_joint" type="{kind or types}"><parent link="{parent}"/>'
            f'<child link="{child}"/>{mimic}<limit lower="-1" upper="1"/></joint>'
        )
    body = "".join(f'<link name="{each}">{inertial if mass else ""}</link>' for each in links)
    return Robot.from_xml(f'<robot name="r">{body}{"".join(parts)}</robot>')


def in_a_row(start: str, name: str, length: int) -> list[str]:
    """Return joints in a row, the first of which is on a link."""
    names = [start, *(f"{name}{index}" for index in range(length))]
    return [f"{parent}>{child}" for parent, child in pairwise(names)]


def legs(start: str, count: int, length: int = 3) -> list[str]:
    return [joint for index in range(count) for joint in in_a_row(start, f"leg{index}_", length)]


FOUR_FINGERS = legs("palm", 4, 2)


@pytest.mark.parametrize(
    ("robot", "base"),
    [
        (tree("base>wheel:continuous"), "free"),
        (tree("root>base:fixed", "base>wheel:continuous", root="root"), "free"),
        (tree("world>base:fixed", "base>wheel:continuous", root="world"), "fixed"),
        (tree("base>wheel:continuous", mass=0), "fixed"),
        (tree("base>body:floating", "body>wheel:continuous"), "fixed"),
        (tree(*in_a_row("base", "arm", 6)), "fixed"),
        (tree(*legs("base", 4)), "free"),
        (tree(*legs("base", 6, 1)), "free"),
        (tree("root>base:fixed", *legs("base", 4), root="root"), "free"),
        (tree(*legs("base", 3)), "fixed"),
        (tree(*legs("base", 2), "base>waist", *in_a_row("waist", "left", 7),
              *in_a_row("waist", "right", 7)), "free"),
        (tree(*in_a_row("base", "arm", 6), "arm5>palm:fixed", *FOUR_FINGERS), "fixed"),
        (tree(*in_a_row("base", "left", 6), "left5>left_finger1", "left5>left_finger2",
              *in_a_row("base", "right", 6), "right5>right_finger1", "right5>right_finger2"),
         "fixed"),
        (tree("base>leader", "base>*second", "base>*third", "base>*fourth"), "fixed"),
    ],
)  # fmt: skip
def test_a_base_is_assumed_by_wheels_and_limbs(robot: Robot, base: str) -> None:
    found, reason = base_of(robot)
    assert found == base
    assert bool(reason) == (robot.roots[0].name != "world")
    for asked in ("fixed", "free"):
        assert base_of(robot, asked) == (asked, "")


WHEEL = """<robot name="r">
  <link name="base"><inertial><mass value="1"/></inertial></link><link name="wheel"/>
  <joint name="j" type="revolute"><parent link="base"/><child link="wheel"/>
  <limit lower="{lower}" upper="1e16" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.mark.parametrize(("lower", "base"), [("-1e16", "free"), ("0", "fixed")])
def test_limits_that_mean_none_are_those_of_a_wheel(lower: str, base: str) -> None:
    assert base_of(Robot.from_xml(WHEEL.format(lower=lower)))[0] == base


def test_branches_that_a_loop_joins_are_one_limb() -> None:
    body = "link: {geometry: sphere, radius: 1, mass: 1}"
    limit = "limit: {upper: 1, effort: 1, velocity: 1}"
    text = f"robot: r\nmodel:\n- part: {{name: base, {body}}}\n"
    for name in "abcd":
        joint = f"joint: {{type: revolute, parent: base, axis: y, {limit}}}"
        text += f"- part: {{name: {name}, {joint}, {body}}}\n"
    assert base_of(build("r.yaml", text=text).robot)[0] == "free"
    text += "- loop: {name: l, type: ball, between: [a, b]}\n"
    assert base_of(build("r.yaml", text=text, allow=["lost-in-urdf"]).robot)[0] == "fixed"
