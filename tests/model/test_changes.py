"""What changed from one robot to another: one change, one line; and what moved because of it."""

# ruff: noqa: E501 - the lines of URDF

from __future__ import annotations

import csv
import random
from math import pi
from pathlib import Path

import numpy as np
import pytest

from tests.consumers import oracles
from tests.model.robots import EXAMPLES, JOINTS
from tests.model.test_kinematics import Pinocchio
from yamaro import Robot, build
from yamaro.model.changes.change import Change, Changes
from yamaro.model.changes.context import angle_between
from yamaro.model.pose import rotation_from_rpy

REPOSITORY = Path(__file__).parents[2]
CORPUS = REPOSITORY.parent / "shared" / "corpus"

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base">
    <inertial><mass value="5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.2"/></inertial>
    <visual><geometry><box size="0.4 0.4 0.1"/></geometry><material name="grey"/></visual>
    <collision><geometry><box size="0.4 0.4 0.1"/></geometry></collision>
  </link>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.2"/>
      <mass value="1.5"/>
      <inertia ixx="0.02" ixy="0" ixz="0.001" iyy="0.03" iyz="0" izz="0.01"/>
    </inertial>
    <visual>
      <origin xyz="0 0 0.2" rpy="0 0 0.1"/>
      <geometry><mesh filename="upper.stl"/></geometry>
      <material name=""><color rgba="1 0 0 1"/></material>
    </visual>
    <collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.05" length="0.4"/></geometry></collision>
  </link>
  <link name="lower">
    <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <visual><geometry><sphere radius="0.05"/></geometry></visual>
  </link>
  <link name="hand"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0 0.05"/>
    <parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1.2" effort="20" velocity="2"/>
    <dynamics damping="0.1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <origin xyz="0 0 0.4" rpy="0.3 0.2 0"/>
    <parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="10" velocity="2"/>
  </joint>
  <joint name="wrist" type="continuous">
    <origin xyz="0 0 0.3"/>
    <parent link="lower"/><child link="hand"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="mount" type="fixed">
    <origin xyz="0 0.02 0.1"/>
    <parent link="hand"/><child link="tool"/>
  </joint>
  <transmission name="elbow_transmission">
    <type>SimpleTransmission</type>
    <joint name="elbow"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
  </transmission>
  <gazebo reference="hand"><mu1>0.8</mu1></gazebo>
</robot>
"""


def changed(*replacements: tuple[str, str], text: str = ARM) -> str:
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    return text


def between(one: str, other: str, **options: object) -> Changes:
    return Robot.from_xml(one).changes(Robot.from_xml(other), **options)  # type: ignore[arg-type]


def shown(change: Change) -> str:
    name = change.name + (f">{change.new_name}" if change.new_name else "")
    text = f"{change.kind} {change.of} {name}"
    if change.what:
        text += f" {change.what}"
    if change.kind == "changed":
        text += f": {change.before!r} to {change.after!r}"
    return text


# --- nothing ---


@pytest.mark.parametrize("example", EXAMPLES)
def test_a_robot_does_not_differ_from_itself(example: str) -> None:
    path = REPOSITORY / "examples" / example
    changes = build(path).robot.changes(build(path).robot)
    assert [shown(change) for change in changes.changes] == []
    assert changes.motion.is_same and not changes


@pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
def test_no_robot_of_the_corpus_differs_from_itself() -> None:
    with (CORPUS / "urdf.tsv").open(encoding="utf-8", newline="") as file:
        paths = [CORPUS / "src" / row["path"] for row in csv.DictReader(file, delimiter="\t")]
    for path in paths:
        changes = Robot.from_urdf(path).changes(Robot.from_urdf(path))
        assert not changes and changes.motion.is_same, path


@pytest.mark.parametrize(
    "replacements",
    [
        pytest.param([('xyz="0 0 0.4"', 'xyz="0.0 0 4e-1"')], id="spelling of numbers"),
        pytest.param([(' rpy="0 0 0.1"', f' rpy="{pi} {pi} {0.1 + pi}"')], id="twin of rpy"),
        pytest.param([('<axis xyz="0 0 1"/>', '<axis xyz="0 0 5"/>')], id="length of an axis"),
        pytest.param(
            [('<parent link="hand"/><child link="tool"/>', '<child link="tool"/><parent link="hand"/>')],
            id="order in a joint",
        ),
        pytest.param(
            [
                ('  <link name="tool"/>\n', ""),
                ('  <link name="base">', '  <link name="tool"/><link name="base">'),
            ],
            id="order of links",
        ),
        pytest.param([("<robot name", "<!-- said --><robot name")], id="comments"),
        pytest.param([('damping="0.1"', 'damping="0.1" friction="0"')], id="a default"),
        pytest.param(
            [('<child link="tool"/>', '<child link="tool"/><axis xyz="1 1 0"/>')],
            id="the axis of a fixed joint",
        ),
        pytest.param(
            [
                ('<origin xyz="0 0 0.2"/>\n      <mass', '<origin xyz="0 0 0.2" rpy="0 1.5707963267948966 0"/>\n      <mass'),
                ('ixx="0.02" ixy="0" ixz="0.001" iyy="0.03" iyz="0" izz="0.01"', 'ixx="0.01" ixy="0" ixz="-0.001" iyy="0.03" iyz="0" izz="0.02"'),
            ],
            id="inertia along other axes",
        ),
    ],
)  # fmt: skip
def test_what_means_the_same_is_no_change(replacements: list[tuple[str, str]]) -> None:
    other = changed(*replacements)
    assert other != ARM
    changes = between(ARM, other)
    assert [shown(change) for change in changes.changes] == []
    assert changes.motion.is_same


# --- one change, one line ---

PLANTED = {
    "mass": (
        [('<mass value="5"/>', '<mass value="5.2"/>')],
        ["changed link base mass: 5.0 to 5.2"],
        True,
    ),
    "limit": (
        [('upper="1.2"', 'upper="1.57"')],
        ["changed joint shoulder limit.upper: 1.2 to 1.57"],
        True,
    ),
    "sign of an axis": (
        [('<axis xyz="0 0 1"/>', '<axis xyz="0 0 -1"/>')],
        ["changed joint wrist axis: [0.0, 0.0, 1.0] to [0.0, 0.0, -1.0]"],
        False,
    ),
    "origin of a joint": (
        [('xyz="0 0 0.4"', 'xyz="0 0 0.41"')],
        ["changed joint elbow origin: {'xyz': [0.0, 0.0, 0.4]} to {'xyz': [0.0, 0.0, 0.41]}"],
        False,
    ),
    "renamed link": (
        [('"lower"', '"forearm"')],
        ["renamed link lower>forearm"],
        True,
    ),
    "renamed joint": (
        [('"elbow"', '"elbow_pitch"')],
        ["renamed joint elbow>elbow_pitch"],
        True,
    ),
    "colour": (
        [('rgba="1 0 0 1"', 'rgba="0 0 1 1"')],
        ["changed link upper visual.color: [1.0, 0.0, 0.0, 1.0] to [0.0, 0.0, 1.0, 1.0]"],
        True,
    ),
    "colour of a material": (
        [('rgba="0.5 0.5 0.5 1"', 'rgba="0.5 0.5 0.6 1"')],
        ["changed material grey color: [0.5, 0.5, 0.5, 1.0] to [0.5, 0.5, 0.6, 1.0]"],
        True,
    ),
    "geometry": (
        [("<sphere", "<sphere"), ('radius="0.05"/></geometry></visual>', 'radius="0.06"/></geometry></visual>')],
        ["changed link lower visual.radius: 0.05 to 0.06"],
        True,
    ),
    "another shape": (
        [('<cylinder radius="0.05" length="0.4"/>', '<box size="0.1 0.1 0.4"/>')],
        ["changed link upper collision.geometry: 'cylinder 0.05 0.4' to 'box 0.1 0.1 0.4'"],
        True,
    ),
    "mesh file": (
        [("upper.stl", "upper_v2.stl")],
        ["changed link upper visual.mesh: 'upper.stl' to 'upper_v2.stl'"],
        True,
    ),
    "type of a joint": (
        [('type="continuous"', 'type="fixed"')],
        ["changed joint wrist type: 'continuous' to 'fixed'"],
        False,
    ),
    "added link": (
        [('<link name="tool"/>', '<link name="tool"/><link name="camera"/>'), ("</robot>", '<joint name="camera_mount" type="fixed"><parent link="hand"/><child link="camera"/></joint></robot>')],
        ["added link camera", "added joint camera_mount"],
        True,
    ),
    "damping": (
        [('damping="0.1"', 'damping="0.2"')],
        ["changed joint shoulder dynamics.damping: 0.1 to 0.2"],
        True,
    ),
    "parent": (
        [('<parent link="hand"/><child link="tool"/>', '<parent link="lower"/><child link="tool"/>')],
        ["changed joint mount parent: 'hand' to 'lower'"],
        False,
    ),
    "mimic": (
        [('<child link="hand"/>', '<child link="hand"/><mimic joint="elbow" multiplier="-1"/>')],
        ["changed joint wrist mimic.joint: None to 'elbow'"],
        False,
    ),
    "text for a simulator": (
        [("<mu1>0.8</mu1>", "<mu1>0.9</mu1>")],
        ["changed element gazebo hand mu1: '0.8' to '0.9'"],
        True,
    ),
    "removed transmission": (
        [(ARM[ARM.index("  <transmission"):ARM.index("  <gazebo")], "")],
        ["removed element transmission elbow_transmission"],
        True,
    ),
    "centre of mass": (
        [('<origin xyz="0 0 0.2"/>\n      <mass', '<origin xyz="0 0.01 0.2"/>\n      <mass')],
        ["changed link upper center_of_mass: [0.0, 0.0, 0.2] to [0.0, 0.01, 0.2]"],
        True,
    ),
    "inertia": (
        [('iyy="0.03"', 'iyy="0.031"')],
        ["changed link upper inertia: {'iyy': 0.03} to {'iyy': 0.031}"],
        True,
    ),
    "name of the robot": (
        [('<robot name="arm">', '<robot name="arm2">')],
        ["changed robot arm name: 'arm' to 'arm2'"],
        True,
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", PLANTED)
def test_one_planted_change_is_found_and_nothing_else(kind: str) -> None:
    replacements, expected, moves_the_same = PLANTED[kind]
    changes = between(ARM, changed(*replacements))
    assert [shown(change) for change in changes.changes] == expected
    assert changes.motion.is_same == moves_the_same


@pytest.mark.parametrize("kind", PLANTED)
def test_the_way_back_is_the_mirror_image(kind: str) -> None:
    other = changed(*PLANTED[kind][0])
    assert_mirrored(between(ARM, other), between(other, ARM))


def test_several_changes_at_once_are_mirrored_too() -> None:
    together = ("mass", "origin of a joint", "renamed joint", "mesh file", "mimic", "another shape")
    other = changed(*(pair for kind in together for pair in PLANTED[kind][0]))
    changes = between(ARM, other)
    assert len(changes) == len(together)
    assert_mirrored(changes, between(other, ARM))


def test_shapes_in_another_order_have_the_number_that_they_have_in_each_robot() -> None:
    shape = '<visual><origin xyz="{0} 0 0"/><geometry><sphere radius="{1}"/></geometry></visual>'
    one, other = (
        f'<robot name="r"><link name="a">{"".join(shape.format(*each) for each in row)}</link></robot>'
        for row in (((1, 0.1), (2, 0.2), (3, 0.3)), ((3, 0.3), (1, 0.1), (2, 0.25)))
    )
    there, back = between(one, other), between(other, one)
    assert [shown(c) for c in there.changes] == ["changed link a visual[2→3].radius: 0.2 to 0.25"]
    assert [shown(c) for c in back.changes] == ["changed link a visual[3→2].radius: 0.25 to 0.2"]


def test_a_link_moved_by_a_joint_that_only_one_robot_has_is_moved_either_way() -> None:
    """The camera is a root of its own in one robot, and on the base in the other."""
    joint = (
        '<joint name="stand" type="fixed"><origin xyz="0 0 1"/>'
        '<parent link="base"/><child link="camera"/></joint></robot>'
    )
    one = changed(('<link name="base">', '<link name="camera"/><link name="base">'))
    other = changed(("</robot>", joint), text=one)
    there, back = between(one, other), between(other, one)
    assert_mirrored(there, back)
    for changes, kind in ((there, "added"), (back, "removed")):
        (change,) = changes.changes
        assert (change.kind, change.of, change.name) == (kind, "joint", "stand")
        assert change.moved is not None and change.moved.distance == pytest.approx(1)
        assert changes.motion.reference == there.motion.reference


def test_ranges_that_do_not_overlap_are_compared_in_the_same_positions_either_way() -> None:
    one = changed(('lower="-2" upper="2"', 'lower="0" upper="0.5"'))
    other = changed(
        ('lower="-2" upper="2"', 'lower="-1.5" upper="-1"'),
        ('<axis xyz="0 0 1"/>', '<axis xyz="0 0.1 1"/>'),
    )
    there, back = between(one, other), between(other, one)
    assert_mirrored(there, back)
    assert there.motion.reason == back.motion.reason != ""


@pytest.mark.parametrize("lost", ["base", "upper"])
def test_what_was_renamed_is_found_in_a_part_of_a_robot(lost: str) -> None:
    """As in a file of a gripper, whose first joint is on a link that other files have."""
    end = ARM.index("</link>", ARM.index(f'<link name="{lost}"')) + len("</link>")
    part = ARM[: ARM.index(f'<link name="{lost}"')] + ARM[end:]
    found = [
        shown(change)
        for old, new in (('"shoulder"', '"waist"'), ('"elbow"', '"knee"'), ('"lower"', '"shin"'))
        for change in between(part, changed((old, new), text=part)).changes
    ]
    assert found == [
        "renamed joint shoulder>waist",
        "renamed joint elbow>knee",
        "renamed link lower>shin",
    ]


def assert_mirrored(there: Changes, back: Changes) -> None:
    swapped = {"added": "removed", "removed": "added"}
    mirrored = []
    for change in there.changes:
        kind = swapped.get(change.kind, change.kind)
        name = change.new_name or change.name
        new = change.name if change.new_name else None
        if change.of == "robot":
            name, new = back.changes[0].name, None
        mirrored.append((kind, change.of, name, new, change.what, change.after, change.before))
    found = [(c.kind, c.of, c.name, c.new_name, c.what, c.before, c.after) for c in back.changes]
    assert sorted(map(repr, found)) == sorted(map(repr, mirrored))
    assert there.motion.is_same == back.motion.is_same
    moved = {new for c in there.changes if c.moved for new in c.moved.links}
    names = there.links
    assert {names.get(name, name) for name in moved} == {
        name for c in back.changes if c.moved for name in c.moved.links
    }


# --- what moved because of what ---


def test_one_moved_joint_is_one_change_with_the_links_below_it() -> None:
    changes = between(ARM, changed(('xyz="0 0 0.4"', 'xyz="0 0 0.41"')))
    (change,) = changes.changes
    moved = change.moved
    assert moved is not None and moved.is_at_zero
    assert moved.links == ["lower", "hand", "tool"]
    assert moved.distance == pytest.approx(0.01)
    assert change.remark == "moved 10 mm"


def test_a_turned_axis_moves_links_only_off_zero() -> None:
    changes = between(ARM, changed(('<axis xyz="0 0 1"/>', '<axis xyz="0 0 -1"/>')))
    (change,) = changes.changes
    assert change.moved is not None and not change.moved.is_at_zero
    assert changes.motion.opposite == ("wrist",)
    assert change.remark == "the opposite direction"


def test_each_link_is_put_down_to_the_nearest_changed_joint() -> None:
    changes = between(
        ARM, changed(('xyz="0 0 0.05"', 'xyz="0 0 0.06"'), ('xyz="0 0 0.3"', 'xyz="0 0 0.33"'))
    )
    moved = {change.name: change.moved.links for change in changes.changes if change.moved}
    assert moved == {"shoulder": ["upper", "lower"], "wrist": ["hand", "tool"]}


def test_a_link_that_is_where_it_was_has_not_moved() -> None:
    changes = between(
        ARM, changed(('xyz="0 0 0.3"', 'xyz="0 0 0.4"'), ('xyz="0 0.02 0.1"', 'xyz="0 0.02 0"'))
    )
    moved = [link for change in changes.changes if change.moved for link in change.moved.links]
    assert moved == ["hand"]
    assert not changes.motion.is_same


def test_a_changed_limit_leaves_the_motion_the_same_and_is_named() -> None:
    motion = between(ARM, changed(('upper="1.2"', 'upper="1.57"'))).motion
    assert motion.is_same and motion.ranges == ("shoulder",)


def test_a_new_root_does_not_move_the_robot() -> None:
    other = changed(
        ('<link name="base">', '<link name="world"/><link name="base">'),
        (
            "</robot>",
            '<joint name="stand" type="fixed"><origin xyz="0 0 1"/><parent link="world"/><child link="base"/></joint></robot>',
        ),
    )
    changes = between(ARM, other)
    assert [shown(change) for change in changes.changes] == [
        "added link world",
        "added joint stand",
    ]
    assert changes.motion.is_same and changes.motion.reference == "base"
    assert changes.center[0] == pytest.approx(changes.center[1])
    assert between(other, ARM).motion.is_same


# --- renames ---


def test_a_prefix_on_all_names_is_renames_alone() -> None:
    names = ["base", "upper", "lower", "hand", "tool", "shoulder", "elbow", "wrist", "mount"]
    other = changed(*((f'"{name}"', f'"left_{name}"') for name in names))
    changes = between(ARM, other)
    assert {(c.kind, c.name, c.new_name) for c in changes.changes} == {
        ("renamed", name, f"left_{name}") for name in names
    }
    assert changes.motion.is_same


def test_the_robots_are_not_changed_by_comparing_them() -> None:
    one = Robot.from_xml(ARM)
    text = '<gazebo><plugin name="p"><jointName>elbow_pitch</jointName></plugin></gazebo></robot>'
    other = Robot.from_xml(changed(('"elbow"', '"elbow_pitch"'), ("</robot>", text)))
    twin = Robot.from_xml(changed(('"elbow"', '"elbow_pitch"'), ("</robot>", text)))
    assert one.changes(other)
    assert not other.changes(twin)
    assert not other.differences(twin)


def test_wheels_of_one_content_are_matched_in_their_order() -> None:
    wheel = (
        '<link name="{0}"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>'
        '<joint name="{0}_joint" type="fixed"><parent link="base"/><child link="{0}"/></joint>'
    )
    robots = [
        '<robot name="r"><link name="base"/>' + "".join(map(wheel.format, names)) + "</robot>"
        for names in (("a", "b"), ("c", "d"))
    ]
    found = {c.name: c.new_name for c in between(*robots).changes}
    assert found == {"a": "c", "b": "d", "a_joint": "c_joint", "b_joint": "d_joint"}


def test_a_word_before_all_names_is_a_rename_though_all_masses_differ() -> None:
    other = changed(
        *[(f'"{name}"', f'"my_{name}"') for name in ("base", "upper", "lower", "hand", "tool")],
        *[(f'"{name}"', f'"my_{name}"') for name in ("shoulder", "elbow", "wrist")],
        ('<mass value="5"/>', '<mass value="6"/>'),
        ('<mass value="1.5"/>', '<mass value="1.6"/>'),
        ('<mass value="1"/>', '<mass value="1.1"/>'),
        ('size="0.1 0.1 0.1"', 'size="0.1 0.1 0.2"'),
    )
    for one, two, kept in ((ARM, other, "base"), (other, ARM, "my_base")):
        changes = between(one, two)
        assert not [each for each in changes if each.kind in ("added", "removed")]
        assert changes.links[kept] in ("base", "my_base")
        assert changes.joints["shoulder" if one is ARM else "my_shoulder"]
        assert changes.motion.is_same
        assert {each.what for each in changes if each.of == "link" and each.kind == "changed"} >= {
            "mass"
        }


def test_a_word_before_two_names_is_no_rename() -> None:
    one = '<robot name="r"><link name="base"/><link name="arm"/></robot>'
    two = '<robot name="r"><link name="my_base"><visual/></link><link name="my_arm"/></robot>'
    assert "my_base" not in between(one, two).links.values()


def test_a_link_with_other_content_is_not_taken_for_a_renamed_one() -> None:
    other = changed(
        ('<link name="tool"/>', '<link name="lamp"><visual><geometry><sphere radius="1"/></geometry></visual></link>'),
        ('<child link="tool"/>', '<child link="lamp"/>'),
        ('"mount"', '"lamp_mount"'),
    )  # fmt: skip
    kinds = sorted((c.kind, c.of, c.name) for c in between(ARM, other).changes)
    assert kinds == [
        ("added", "joint", "lamp_mount"),
        ("added", "link", "lamp"),
        ("removed", "joint", "mount"),
        ("removed", "link", "tool"),
    ]


def test_shapes_of_other_names_are_not_taken_for_one_another() -> None:
    robots = [
        '<robot name="r"><link name="a">'
        f'<visual name="{name}"><geometry><sphere radius="{radius}"/></geometry></visual>'
        "</link></robot>"
        for name, radius in (("lamp", 1), ("plate", 2), ("light", 1))
    ]
    assert [shown(c) for c in between(robots[0], robots[1]).changes] == [
        "changed link a visual: 'sphere 1' to None",
        "changed link a visual: None to 'sphere 2'",
    ]
    assert [shown(c) for c in between(robots[0], robots[2]).changes] == [
        "changed link a visual.name: 'lamp' to 'light'"
    ]


def test_an_element_that_is_added_has_the_name_of_the_second_robot() -> None:
    other = changed(('"tool"', '"tip"'), ("</robot>", '<gazebo reference="tip"/></robot>'))
    assert [shown(c) for c in between(ARM, other).changes] == [
        "renamed link tool>tip",
        "added element gazebo tip",
    ]


# --- files, tolerance, what URDF has no elements for ---


def test_a_mesh_of_the_same_name_and_other_content_differs() -> None:
    changes = between(ARM, ARM, same_file=lambda *_: False)
    assert [shown(c) for c in changes.changes] == [
        "changed link upper visual.mesh: 'upper.stl' to 'upper.stl'"
    ]
    assert not between(ARM, ARM, same_file=lambda *_: True)
    assert not between(ARM, ARM, same_file=lambda *_: None)


def test_a_mesh_that_only_lies_elsewhere_is_the_same() -> None:
    other = changed(("upper.stl", "../meshes/upper.stl"))
    assert not between(ARM, other, same_file=lambda *_: True)
    assert len(between(ARM, other, same_file=lambda *_: None)) == 1


def test_differences_below_the_tolerance_do_not_count() -> None:
    other = changed(('value="5"', 'value="5.001"'), ('rpy="0.3 0.2 0"', 'rpy="0.3001 0.2 0"'))
    assert len(between(ARM, other)) == 2
    assert not between(ARM, other, tolerance=1e-3)


def test_sensors_actuators_and_states_are_compared(tmp_path: Path) -> None:
    text = """\
robot: lamp
model:
- link/name=base_link:
- part:
    name: arm
    joint:
      type: revolute
      parent: base_link
      axis: z
      limit: {lower: -1, upper: 1, effort: 1, velocity: 1}
      actuator: {command: position, kp: 50}
    link:
      geometry: box
      scale: 1 1 1
      mass: 1
      visual: {color: 1 0 0 1}
      collision: {surface: {friction: 0.8}}
      sensor/name=imu: {type: imu, rate: 100 Hz}
states: {home: {arm: 0.5}}
"""
    new = changed(
        *(("kp: 50", "kp: 60"), ("friction: 0.8", "friction: 0.7"), ("100 Hz", "200 Hz")),
        *(("arm: 0.5", "arm: 0.6"), ("color: 1 0 0 1", "color: 0 0 1 1")),
        text=text,
    )
    robots = []
    for name, each in (("a", text), ("b", new)):
        path = tmp_path / f"{name}.yaml"
        path.write_text(each)
        robots.append(build(path).robot)
    assert [shown(c) for c in robots[0].changes(robots[1]).changes] == [
        "changed link arm_link visual.color: [1.0, 0.0, 0.0, 1.0] to [0.0, 0.0, 1.0, 1.0]",
        "changed sensor imu rate: 100.0 to 200.0",
        "changed actuator arm_joint kp: 50.0 to 60.0",
        "changed surface arm_link/collision[1] friction: 0.8 to 0.7",
        "changed surface arm_link/collision[1] friction2: 0.8 to 0.7",
        "changed state home arm_joint: 0.5 to 0.6",
    ]
    urdf = Robot.from_xml(build(tmp_path / "a.yaml").xml())
    changes = robots[0].changes(urdf, has_extras=False)
    assert not changes
    assert changes.skipped == ["1 sensor", "1 actuator", "1 surface", "1 state"]


def test_every_change_has_the_places_of_both_sides() -> None:
    changes = between(ARM, "\n\n" + changed(('upper="1.2"', 'upper="1.57"'))[22:])
    (change,) = changes.changes
    assert change.first is not None and change.second is not None
    assert (change.first.written(), change.second.written()) == ("1.2", "1.57")


# --- pinocchio as the judge of the motion ---


def followers(text: str, given: dict[str, float]) -> dict[str, float]:
    """Return the positions of joints that mimic others, which pinocchio moves on their own."""
    return {
        joint.name: joint.mimic.multiplier * given[joint.mimic.joint] + joint.mimic.offset
        for joint in Robot.from_xml(text).joints.values()
        if joint.mimic is not None
    }


def judged_same(one: str, other: str, names: dict[str, str]) -> bool:
    """Return whether pinocchio has all links at the same poses at 20 random positions."""
    first, second = Pinocchio(one), Pinocchio(other)
    robot = Robot.from_xml(one)
    source = random.Random(7)
    for number in range(20):
        given = {j.name: source.uniform(*j.range) if number else 0.0 for j in robot.free_joints()}
        new = {names.get(name, name): at for name, at in given.items()}
        mine = first.poses(given | followers(one, given))
        theirs = second.poses(new | followers(other, new))
        for link in mine.keys() & theirs.keys():
            if not np.allclose(mine[link], theirs[link], atol=1e-9):
                return False
    return True


@pytest.mark.parametrize("kind", sorted(set(PLANTED) - {"type of a joint", "mimic"}))
def test_pinocchio_agrees_whether_the_robots_move_the_same(kind: str) -> None:
    oracles.require_module("pinocchio")
    replacements, _, moves_the_same = PLANTED[kind]
    other = changed(*replacements)
    names = {"elbow": "elbow_pitch"} if kind == "renamed joint" else {}
    assert judged_same(ARM, other, names) == moves_the_same


@pytest.mark.parametrize("seed", range(12))
def test_pinocchio_agrees_about_random_changes_of_joints(seed: int) -> None:
    source = random.Random(seed)
    text = JOINTS[: JOINTS.index('  <joint name="drift"')] + "</robot>"
    text = text.replace('  <link name="drifted"/>\n', "").replace('  <link name="floated"/>\n', "")
    choices = [
        ('rpy="0.4 -0.5 0.6"', 'rpy="0.4 -0.5 0.61"'),
        ('rpy="0.4 -0.5 0.6"', f'rpy="{0.4 + pi} {pi + 0.5} {0.6 + pi}"'),
        ('xyz="0.6 0 0.8"', 'xyz="0.8 0 0.6"'),
        ('xyz="0.6 0 0.8"', 'xyz="3 0 4"'),
        ('multiplier="-1.5"', 'multiplier="-1.4"'),
        ('offset="0.25"', 'offset="0.5"'),
        ('lower="-1"', 'lower="-0.5"'),
        ('xyz="0 -1 0"', 'xyz="0 1 0"'),
    ]
    other = changed(*source.sample(choices, 1 + seed % 2), text=text)
    motion = between(text, other).motion
    assert motion.is_same == judged_same(text, other, {}), motion.reason


@pytest.mark.parametrize("angle", [1e-10, 1e-6, 0.3, 3.0, pi])
def test_the_angle_between_rotations_is_exact_for_small_and_large_ones(angle: float) -> None:
    one, step = rotation_from_rpy(0.3, -0.4, 0.5), rotation_from_rpy(angle, 0, 0)
    turned = tuple(tuple(row) for row in (np.array(one) @ np.array(step)).tolist())
    assert angle_between(one, turned) == pytest.approx(angle, rel=1e-5, abs=1e-15)  # type: ignore[arg-type]
