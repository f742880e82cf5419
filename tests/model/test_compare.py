"""In what two robots differ, as the comparison after a migration tells it."""

from __future__ import annotations

import pytest

from tests.same_robot import is_same_robot
from yamaro import Robot
from yamaro.model.compare import compare, count_defaults
from yamaro.source import Source
from yamaro.xml.reader import read_xml
from yamaro.xml.tree import Element


def tree(xml: str) -> Element:
    return read_xml(Source(xml, name="robot.urdf", path="")).root


def differences(expected: str, actual: str) -> list[str]:
    return [str(one) for one in compare(tree(expected), tree(actual))]


SAME = {
    "the order of attributes": ('<a b="1" c="2"/>', '<a c="2" b="1"/>'),
    "white space": ("<a> <b/>\n</a>", "<a><b/></a>"),
    "white space in values": ('<a b="1  2 "/>', '<a b="1 2"/>'),
    "white space in texts": ("<a>\n  x y\n</a>", "<a>x  y</a>"),
    "texts parted by comments": ("<a>x <!-- c -->y</a>", "<a>x y</a>"),
    "comments": ("<a><!-- c --><b/></a>", "<a><b/></a>"),
    "the spelling of numbers": ('<a b="1.0 1e-3"/>', '<a b="1 0.001"/>'),
    "one part in 10⁹": ('<a b="1000000000"/>', '<a b="1000000001"/>'),
    "rounding": ('<a b="0"/>', '<a b="-1e-17"/>'),
    "joints among links": ("<robot><link/><joint/></robot>", "<robot><joint/><link/></robot>"),
    "parent and child": ("<joint><child/><parent/></joint>", "<joint><parent/><child/></joint>"),
    "the pose of a section": (
        "<visual><geometry/><b/></visual>",
        "<visual><b/><geometry/></visual>",
    ),
}

DIFFERENT = {
    "another root": ("<a/>", "<b/>", ["a: <b> is in its place"]),
    "a value": ('<a b="1"/>', '<a b="2"/>', ["a: 'b' is '2', not '1'"]),
    "a little more than rounding": (
        '<a b="1000000000"/>',
        '<a b="1000000002"/>',
        ["a: 'b' is '1000000002', not '1000000000'"],
    ),
    "a little beside 0": ('<a b="0"/>', '<a b="1e-11"/>', ["a: 'b' is '1e-11', not '0'"]),
    "a number and a word": ('<a b="1"/>', '<a b="one"/>', ["a: 'b' is 'one', not '1'"]),
    "nothing and zero": ('<a b=""/>', '<a b="0"/>', ["a: 'b' is '0', not ''"]),
    "a count of numbers": ('<a b="1 2"/>', '<a b="1"/>', ["a: 'b' is '1', not '1 2'"]),
    "letter case": ('<a b="x"/>', '<a b="X"/>', ["a: 'b' is 'X', not 'x'"]),
    "a missing attribute": ('<a b="1"/>', "<a/>", ["a: 'b' is missing"]),
    "a new attribute": ("<a/>", '<a b="1"/>', ["a: 'b' should not be there"]),
    "a text": ("<a>x</a>", "<a>y</a>", ["a: its text is 'y', not 'x'"]),
    "a text and none": ("<a>x</a>", "<a/>", ["a: its text is '', not 'x'"]),
    "texts that elements part": (
        "<a>x<b/>y</a>",
        "<a>xy<b/></a>",
        ["a: its text is 'xy ', not 'x y'"],
    ),
    "a missing element": ("<a><b/><c/></a>", "<a><b/></a>", ["a, c: is missing"]),
    "a new element": ("<a><b/></a>", "<a><b/><c/></a>", ["a, c: should not be there"]),
    "the order of elements": (
        "<gazebo><b/><c/></gazebo>",
        "<gazebo><c/><b/></gazebo>",
        ["gazebo, b: <c> is in its place", "gazebo, c: <b> is in its place"],
    ),
    "the order of links": (
        '<robot><link name="a"/><link name="b"/></robot>',
        '<robot><link name="b"/><link name="a"/></robot>',
        ["robot, link 'a': 'name' is 'b', not 'a'", "robot, link 'b': 'name' is 'a', not 'b'"],
    ),
    "a joint too few": (
        '<robot name="r"><link/><joint name="j"/></robot>',
        '<robot name="r"><link/></robot>',
        ["robot 'r', joint 'j': is missing"],
    ),
    "deep down": (
        '<robot><gazebo reference="a"><b><c d="1"/></b></gazebo></robot>',
        '<robot><gazebo reference="a"><b><c d="2"/></b></gazebo></robot>',
        ["robot, gazebo 'a', b, c: 'd' is '2', not '1'"],
    ),
}


@pytest.mark.parametrize(("first", "second"), SAME.values(), ids=SAME)
def test_what_means_nothing_makes_no_difference(first: str, second: str) -> None:
    assert differences(first, second) == []
    assert differences(second, first) == []
    assert is_same_robot(first.encode(), second.encode())


@pytest.mark.parametrize(("expected", "actual", "told"), DIFFERENT.values(), ids=DIFFERENT)
def test_all_else_does(expected: str, actual: str, told: list[str]) -> None:
    assert differences(expected, actual) == told
    assert differences(actual, expected) != []
    assert not is_same_robot(expected.encode(), actual.encode())


def robot(joint: str = "", section: str = "") -> str:
    return (
        f'<robot name="r"><joint name="j">{joint}</joint>'
        f'<link name="l"><visual>{section}</visual></link></robot>'
    )


ZEROS = '<origin xyz="0 0 0" rpy="0 0 0"/>'


@pytest.mark.parametrize(
    ("left_out", "defaults"),
    [("", 1), ("<origin/>", 2), ('<origin xyz="0 0 0"/>', 1), ('<origin rpy="0 0 0.0"/>', 1)],
)
def test_a_pose_that_is_left_out_is_zeros(left_out: str, defaults: int) -> None:
    for short, whole in (
        (robot(joint=left_out), robot(joint=ZEROS)),
        (robot(section=left_out), robot(section=ZEROS)),
    ):
        assert differences(short, whole) == differences(whole, short) == []
        assert count_defaults(tree(short), tree(whole)) == defaults
        assert count_defaults(tree(whole), tree(short)) == 0
        assert compare(tree(short), tree(whole), exact=True)
        assert is_same_robot(short.encode(), whole.encode())
        assert not is_same_robot(short.encode(), whole.encode(), exact=True)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (robot(), robot(joint='<origin xyz="0 0 1" rpy="0 0 0"/>')),
        (robot(), robot(joint='<origin xyz="0 0 0" rpy="0 0 0" scale="1"/>')),
        (robot(), robot(joint="<origin><a/></origin>")),
        (robot(), robot(joint=ZEROS + ZEROS)),
        (robot(joint='<origin xyz=""/>'), robot(joint=ZEROS)),
        (robot(joint='<origin xyz="0 0 0" rpyt="1"/>'), robot(joint=ZEROS)),
        (robot(joint="<limit/>"), robot(joint='<limit lower="0"/>')),
        (robot(joint='<origin xyz="0 0"/>'), robot(joint=ZEROS)),
        ("<robot><link/></robot>", f"<robot><link>{ZEROS}</link></robot>"),
        ("<robot><sensor/></robot>", f"<robot><sensor>{ZEROS}</sensor></robot>"),
        (
            "<robot><gazebo><joint/></gazebo></robot>",
            f"<robot><gazebo><joint>{ZEROS}</joint></gazebo></robot>",
        ),
        ("<sdf><joint/></sdf>", f"<sdf><joint>{ZEROS}</joint></sdf>"),
        ("<joint/>", f"<joint>{ZEROS}</joint>"),
        ("<robot><visual/></robot>", f"<robot><visual>{ZEROS}</visual></robot>"),
    ],
)
def test_nothing_but_a_pose_of_zeros_may_be_left_out(first: str, second: str) -> None:
    assert differences(first, second) != []
    assert differences(second, first) != []
    assert not is_same_robot(first.encode(), second.encode())
    assert not is_same_robot(second.encode(), first.encode())


def test_robots_tell_their_differences() -> None:
    robot = Robot.from_xml('<robot name="r"><link name="a"/><link name="b"/></robot>')
    other = Robot.from_xml('<robot name="r"><link name="a"/><link name="c"/></robot>')
    assert robot.differences(robot) == []
    assert [str(found) for found in robot.differences(other)] == [
        "robot 'r', link 'b': 'name' is 'c', not 'b'"
    ]


def test_a_joint_by_itself_is_compared_as_in_its_robot() -> None:
    joint, other = tree("<joint/>"), tree(f"<joint>{ZEROS}</joint>")
    assert compare(joint, other) != []
    assert compare(joint, other, around=("robot",)) == []


def test_a_prefix_that_no_name_has_makes_no_difference() -> None:
    declared = '<robot xmlns:sensor="http://playerstage.sourceforge.net/gazebo"><a/></robot>'
    assert differences(declared, "<robot><a/></robot>") == []
    assert differences("<robot><a/></robot>", declared) == []
    used = '<robot xmlns:s="uri"><s:a/></robot>'
    assert differences(used, used.replace("uri", "other")) != []
    in_attribute = '<robot xmlns:s="uri"><a s:b="1"/></robot>'
    assert differences(in_attribute, in_attribute.replace("uri", "other")) != []


RED = '<material name="red"><color rgba="1 0 0 1"/></material>'


@pytest.mark.parametrize(
    ("second", "is_same"),
    [
        (RED, True),
        (RED.replace("1 0 0 1", "1.0 0 0 1.0"), True),
        (RED.replace("1 0 0 1", "0 0 1 1"), False),
        (RED.replace("red", "blue"), False),
    ],
)
def test_only_a_material_that_repeats_another_may_be_left_out(second: str, is_same: bool) -> None:
    twice, once = (f'<robot name="r">{own}<link name="a"/></robot>' for own in (RED + second, RED))
    for expected, actual in ((twice, once), (once, twice)):
        assert (differences(expected, actual) == []) is is_same
        assert is_same_robot(expected.encode(), actual.encode()) is is_same
        assert compare(tree(expected), tree(actual), exact=True)
        assert not is_same_robot(expected.encode(), actual.encode(), exact=True)
