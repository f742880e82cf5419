"""Tests of the drawing of kinematic trees."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.counting import calls_of
from tests.waiting import PATIENCE
from yamaro import Robot
from yamaro.commands.main import main
from yamaro.model.reading import read_robot
from yamaro.tools.tree.text import render_tree


def robot(body: str) -> Robot:
    return Robot.from_xml(f"<robot name='arm'>{body}</robot>")


def link(name: str, mass: object = None) -> str:
    inertial = "" if mass is None else f"<inertial><mass value='{mass}'/></inertial>"
    return f"<link name='{name}'>{inertial}</link>"


def joint(parent: str, child: str, kind: str = "fixed", inner: str = "", name: str = "") -> str:
    ends = f"<parent link='{parent}'/><child link='{child}'/>"
    return f"<joint name='{name or child + '_joint'}' type='{kind}'>{ends}{inner}</joint>"


ARM = (
    link("base", 2)
    + link("upper", 1.5)
    + joint(
        "base", "upper", "revolute", "<axis xyz='0 0 1'/><limit lower='-1.5707963' upper='1.57'/>"
    )
    + link("slide", 0.25)
    + joint("upper", "slide", "prismatic", "<axis xyz='0 -1 0'/><limit upper='0.3'/>")
    + link("wheel", 0.5)
    + joint("base", "wheel", "continuous", "<axis xyz='0 1 1'/>")
    + link("camera")
    + joint("base", "camera")
)


def test_an_arm_is_drawn_with_joints_limits_and_masses() -> None:
    assert render_tree(robot(ARM)) == (
        "base            2 kg\n"
        "├─ upper      1.5 kg  upper_joint   revolute    z        -1.57 … 1.57 rad\n"
        "│  └─ slide  0.25 kg  slide_joint   prismatic   -y       0 … 0.3 m\n"
        "├─ wheel      0.5 kg  wheel_joint   continuous  (0 1 1)\n"
        "└─ camera             camera_joint  fixed\n"
        "\n"
        "arm: 5 links, 4 joints (3 movable), 3 degrees of freedom, 4.25 kg\n"
    )


def test_ascii_drawing_has_the_same_shape() -> None:
    text = render_tree(robot(ARM), ascii=True)
    assert text.isascii()
    assert text.splitlines()[1].startswith("|- upper ")
    assert text.splitlines()[2].startswith("|  `- slide ")
    drawn = render_tree(robot(ARM))
    plain = drawn.replace("├─", "|-").replace("└─", "`-").replace("│", "|")
    assert "".join(plain.replace("…", "..").split()) == "".join(text.split())


def test_colour_adds_escapes_and_nothing_else() -> None:
    text = render_tree(robot(ARM), color=True)
    assert "\033[" in text
    stripped = text
    for code in ("0", "1", "2", "36", "1;31"):
        stripped = stripped.replace(f"\033[{code}m", "")
    assert stripped == render_tree(robot(ARM))


def test_children_come_in_the_order_of_the_joints() -> None:
    body = "".join(map(link, ("a", "b", "c"))) + joint("a", "c") + joint("a", "b")
    drawn = [line.split()[1] for line in render_tree(robot(body)).splitlines()[1:3]]
    assert drawn == ["c", "b"]


def test_mimic_joints_move_but_are_not_free() -> None:
    body = link("hand") + link("left") + link("right")
    body += joint("hand", "left", "prismatic", "<limit lower='0' upper='0.04'/>")
    body += joint("hand", "right", "prismatic", "<mimic joint='left_joint'/>")
    text = render_tree(robot(body))
    assert "mimics left_joint" in text
    assert text.endswith(
        "arm: 3 links, 2 joints (2 movable, 1 mimic), 1 degree of freedom, no mass\n"
    )


@pytest.mark.parametrize(
    ("kind", "freedom"),
    # nv of the model that pinocchio 3 builds from a URDF with one joint of the type
    [("revolute", 1), ("continuous", 1), ("prismatic", 1), ("planar", 3), ("floating", 6)],
)
def test_degrees_of_freedom_follow_the_joint_type(kind: str, freedom: int) -> None:
    text = render_tree(robot(link("a") + link("b") + joint("a", "b", kind)))
    assert f" (1 movable), {freedom} degree" in text


def test_fixed_joints_do_not_move() -> None:
    text = render_tree(robot(link("a") + link("b") + joint("a", "b")))
    assert "1 joint (0 movable), 0 degrees of freedom" in text


@pytest.mark.parametrize(
    ("axis", "shown"),
    [
        ("1 0 0", " x"),
        ("0 0 -1", " -z"),
        ("0 2.5 0", " y"),
        ("0.6  0 0.8", "(0.6 0 0.8)"),
        ("a b c", "(a b c)"),
        ("0 0 0", "(0 0 0)"),
    ],
)
def test_axes_along_a_direction_have_its_name(axis: str, shown: str) -> None:
    body = link("a") + link("b") + joint("a", "b", "continuous", f"<axis xyz='{axis}'/>")
    assert shown in render_tree(robot(body)).splitlines()[1]


@pytest.mark.parametrize(
    ("limit", "shown"),
    [
        ("lower='-1' upper='1'", "x  -1 … 1 rad"),
        ("upper='2'", "x  0 … 2 rad"),
        ("lower='a' upper='1'", "x"),
        ("effort='1' velocity='1'", "x"),
    ],
)
def test_limits_are_a_range(limit: str, shown: str) -> None:
    body = link("a") + link("b") + joint("a", "b", "revolute", f"<limit {limit}/><dynamics/>")
    assert render_tree(robot(body)).splitlines()[1].endswith(f"revolute  {shown}")


def test_continuous_joints_have_no_range() -> None:
    body = link("a") + link("b")
    body += joint("a", "b", "continuous", "<limit lower='-1' upper='1' effort='1'/>")
    assert render_tree(robot(body)).splitlines()[1].endswith("continuous  x")


def test_axis_defaults_to_x() -> None:
    text = render_tree(robot(link("a") + link("b") + joint("a", "b", "continuous")))
    assert text.splitlines()[1].endswith("continuous  x")


@pytest.mark.parametrize(
    ("mass", "shown"),
    [(1.5, "1.5 kg"), (1e-3, "0.001 kg"), (1234.5, "1234 kg"), (50000, "50000 kg"), ("2", "2 kg")],
)
def test_masses_are_shown_in_kilograms(mass: object, shown: str) -> None:
    text = render_tree(robot(link("a", mass)))
    assert (
        text == f"a  {shown}\n\narm: 1 link, 0 joints (0 movable), 0 degrees of freedom, {shown}\n"
    )


def test_mass_that_is_no_number_does_not_count() -> None:
    assert "no mass" in render_tree(robot(link("a", "heavy")))


def test_robot_without_links_is_only_a_summary() -> None:
    expected = "arm: 0 links, 0 joints (0 movable), 0 degrees of freedom, no mass\n"
    assert render_tree(robot("")) == expected


def test_second_root_is_remarked() -> None:
    lines = render_tree(robot(link("a") + link("b"))).splitlines()
    assert lines[0] == "a"
    assert lines[1] == "b  <- another root"


def test_link_with_two_parents_is_drawn_once() -> None:
    body = "".join(map(link, "abcd"))
    body += joint("a", "b") + joint("a", "c") + joint("b", "d") + joint("c", "d", name="second")
    text = render_tree(robot(body))
    assert text.count("<- shown above: not a tree") == 1
    assert next(line for line in text.splitlines() if "second" in line).endswith("not a tree")


def test_loop_is_drawn_once_around() -> None:
    body = link("root") + link("a") + link("b") + joint("a", "b") + joint("b", "a")
    lines = render_tree(robot(body)).splitlines()
    assert lines[1].endswith("<- part of a loop")
    assert lines[2].startswith("└─ b")
    assert lines[3].startswith("   └─ a")
    assert lines[3].endswith("<- shown above: not a tree")


def test_links_that_do_not_exist_are_remarked() -> None:
    lines = render_tree(robot(link("a") + joint("a", "ghost") + joint("phantom", "c"))).splitlines()
    assert lines[1].startswith("└─ ghost")
    assert lines[1].endswith("<- no such link")
    assert lines[2] == "phantom" + lines[2][len("phantom") :]
    assert lines[2].endswith("<- no such link")


def test_joint_that_connects_nothing_is_told() -> None:
    text = render_tree(robot(link("a") + "<joint name='loose' type='fixed'/>"))
    assert "joint 'loose' connects nothing\n" in text


def test_what_is_no_link_and_no_joint_is_not_drawn() -> None:
    body = link("a") + "<gazebo reference='a'><link name='x'/></gazebo><transmission name='t'/>"
    assert render_tree(robot(body)).startswith("a\n\narm: 1 link")


def test_long_chain_is_drawn_without_recursion_in_linear_size_and_work() -> None:
    def chain(length: int) -> Robot:
        links = "".join(link(f"l{n}", 1) for n in range(length))
        return robot(links + "".join(joint(f"l{n}", f"l{n + 1}") for n in range(length - 1)))

    long = chain(5000)
    text = render_tree(long)
    short = chain(500)
    assert calls_of(lambda: render_tree(long)) < 11 * calls_of(lambda: render_tree(short))
    lines = text.splitlines()
    assert len(lines) == 5000 + 2
    assert lines[4999].split()[:3] == ["⋯", "4999", "l4999"]
    assert max(map(len, lines)) < 160
    assert lines[-1].endswith("5000 kg")


def test_wide_names_are_aligned_by_terminal_cells() -> None:
    body = link("a") + link("手") + link("bb") + joint("a", "手", name="j1")
    text = render_tree(robot(body + joint("a", "bb", name="j2")))
    _, first, second = text.splitlines()[:3]
    assert first.index("j1") + 1 == second.index("j2")  # the wide sign takes two cells


def test_names_cannot_steer_the_terminal() -> None:
    root = robot(link("a")).element
    root.attributes["name"] = "x\033[2J\ny"
    assert "x\\x1b[2J\\x0ay: 1 link" in render_tree(read_robot(root))


# --- the command ------------------------------------------------------------------------------

ROBOT = """\
robot: arm
model:
  link/name=base:
  link/name=tool:
  joint/name=tool_joint, type=fixed:
    parent/link=base:
    child/link=tool:
"""


def test_tree_shows_the_robot_and_no_xml(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT)
    status, (out, err) = main(["tree", str(path), "-q"]), capsys.readouterr()
    assert (status, err) == (0, "")
    assert out.splitlines()[1] == "└─ tool  tool_joint  fixed"
    assert out.splitlines()[-1].startswith("arm: 2 links, 1 joint (0 movable)")


def test_tree_is_drawn_in_ascii_where_the_encoding_asks_for_it(tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(ROBOT)
    result = subprocess.run(
        [sys.executable, "-m", "yamaro", "tree", tmp_path / "robot.yaml", "-q"],
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    assert result.stdout.splitlines()[1] == b"`- tool  tool_joint  fixed"


def test_tree_of_other_xml_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "world.yaml"
    path.write_text("sdf/version='1.11':\n  world/name=w:\n")
    status, (out, err) = main(["tree", str(path)]), capsys.readouterr()
    assert (status, out) == (2, "")
    assert "'yamaro tree' shows robots, and this is a <sdf>" in err


def test_the_tree_of_a_urdf_is_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(f'<robot name="r">{link("a")}{link("b")}{joint("a", "b")}</robot>')
    assert main(["tree", str(path)]) == 0
    assert "2 links, 1 joint" in capsys.readouterr().out
