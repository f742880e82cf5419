"""`yamaro test`: cases, expectations and what they may do, expected errors, golden files, JUnit."""

from __future__ import annotations

import json
import os
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest

from yamaro import Robot
from yamaro.commands.check_reports import JUnitCase, JUnitFailure, junit_text
from yamaro.commands.main import main
from yamaro.model import Pose
from yamaro.tools.test.expectations import CLASSES, READABLE

EXAMPLES = Path(__file__).parents[2] / "examples"

ROBOT = """\
robot: arm
arguments:
  reach: {default: 0.5, unit: m, range: [0.2, 1.0]}
model:
- part:
    name: base
    joint: {type: fixed, parent: root_link}
    link: {geometry: box, scale: 0.1 0.1 0.1, mass: 2}
- part:
    name: arm
    joint:
      type: revolute
      parent: base
      xyz: 0 0 0.25
      axis: y
      limit: {lower: -90deg, upper: 90deg, effort: 1, velocity: 1}
    link:
      geometry: sphere
      scale: 0.1
      mass: 1
      frame/name=tool0: {xyz: 0 0 $(reach)}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the working directory, with a robot in it."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.yaml").write_text(ROBOT)
    return tmp_path


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(["test", *words])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def expecting(*expectations: str) -> str:
    lines = "".join(f"- {json.dumps(each)}\n" for each in expectations)
    return f"robot: arm.yaml\nexpect:\n{lines}"


def write(text: str, name: str = "arm.test.yaml") -> None:
    Path(name).write_text(text, encoding="utf-8")


# --- expectations ---


def test_what_is_as_expected_passes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(
        expecting(
            "robot.mass == 3",
            "robot.pose('tool0').z == approx(0.75)",
            "robot.pose('tool0', {'arm_joint': 90 * deg}).x == approx(0.5)",
            "robot.pose('tool0', base='arm_link').position == approx([0, 0, 0.5])",
            "joint('arm_joint').upper == approx(pi / 2) and link('base_link').mass == 2",
            "all(joint.lower < joint.upper for joint in robot.free_joints())",
            "sum(link.mass for link in robot.links.values()) == robot.mass",
            "{name for name in robot.frames} == {'tool0'}",
            "len(robot.links) == 4 and 'tool0' in robot.links",
            "robot.links['arm_link'].inertial.inertia[0] == approx(2 / 5 * 0.1**2, rel=0.01)",
            "robot.center_of_mass()[2] == approx(0.25 / 3)",
            "(robot.pose('tool0').inverse().apply([0, 0, 0.75])) == approx([0, 0, 0])",
            "robot.roots[0].name == 'root_link'",
        )
    )
    assert run(capsys) == (0, "arm.test.yaml: 1 passed\n", "")


def test_positions_are_named_by_states_and_parts_and_have_units(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("arm.yaml").write_text(ROBOT + "states:\n  home: {arm: -30deg}\n", encoding="utf-8")
    write(
        expecting(
            "robot.pose('tool0', 'home').x == approx(-0.25)",
            "robot.pose('tool0', robot.states['home']).x == approx(-0.25)",
            "robot.pose('arm', {'arm': '90deg'}, base='base').z == approx(0.25)",
            "robot.pose('tool0', {'arm': '90deg'}).x == approx(0.5)",
            "joint('arm').name == 'arm_joint' and link('base').name == 'base_link'",
            "robot.center_of_mass('home') == robot.center_of_mass({'arm': -30 * deg})",
        )
    )
    assert run(capsys) == (0, "arm.test.yaml: 1 passed\n", "")
    write(expecting("robot.pose('tool0', 'hoem').x > 0"))
    assert "has no state 'hoem'; did you mean 'home'?" in run(capsys)[2]
    write(expecting("robot.pose('tool0', {'amr': 1}).x > 0"))
    assert "has no joint 'amr'; did you mean 'arm_joint'?" in run(capsys)[2]


def test_what_is_not_is_shown_with_the_values_of_its_parts(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write("robot: arm.yaml\nexpect:\n- robot.mass * 2 < 4 and robot.pose('tool0').z > 1\n")
    status, out, err = run(capsys)
    assert (status, out) == (1, "arm.test.yaml: 1 failed\n")
    assert (
        err
        == """\
FAILED arm.test.yaml: arm
error[expectation-failed]: this expectation is not met
 --> arm.test.yaml:3:3
  |
3 | - robot.mass * 2 < 4 and robot.pose('tool0').z > 1
  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
  = note: robot.mass * 2 < 4 = False
  = note: robot.mass * 2 = 6
  = note: robot.mass = 3
  = note: robot.pose('tool0').z > 1 = False
  = note: robot.pose('tool0').z = 0.75

"""
    )


@pytest.mark.parametrize(
    ("expectation", "found"),
    [
        ("robot.mas > 1", "a Robot has no attribute 'mas'; did you mean 'mass'?"),
        ("link('arm_lnk').mass > 1", "did you mean 'arm_link'?"),
        ("robot.pose('tool0')[2] > 0.3", "write .position[2], or .z"),
        ("robt.mass > 1", "did you mean 'robot'?"),
        ("robot.joints['arm'].upper > 0", "did you mean 'arm_joint'?"),
        ("robot.links['bse_link'].mass > 0", "did you mean 'base_link'?"),
        ("robot.states['home']", "there is no key 'home'"),
        ("robot.mass > ", "this is not a Python expression"),
        ("robot.mass = 3", "compare with =="),
        ("robot.element", "a Robot has no attribute 'element'"),
        ("robot.from_urdf('/etc/passwd')", "a Robot has no attribute 'from_urdf'"),
        ("robot.span.source.text", "has no attribute 'span'"),
        ("robot.__class__", "begins with two underscores"),
        ("robot._notes", "is not allowed in safe mode"),
        ("open('made', 'w')", "is not allowed in safe mode"),
        ("[x for x in robot]", "cannot be iterated over"),
        ("robot.pose('tool0', {'tool0_joint': 1}).z > 0", "is fixed, and has no position"),
        ("robot.pose.__func__", "begins with two underscores"),
        ("'{0.element}'.format(robot)", "is not allowed in safe mode"),
        ("f'{robot}' == ''", "is not met"),
        ("9**9**9 > 1", "bits"),
        ("sum(1 for a in range(10**5) for b in range(10**5)) > 1", "--limit"),
    ],
)
def test_an_expectation_that_cannot_be_evaluated_is_a_diagnostic(
    folder: Path, capsys: pytest.CaptureFixture[str], expectation: str, found: str
) -> None:
    write(expecting(expectation))
    for trust in ((), ("--trust",)):
        status, _, err = run(capsys, *trust)
        assert status == 1
        assert found in err, err
        assert "arm.test.yaml:3" in err and "Traceback" not in err
        assert "--trust" not in err
    assert not Path("made").exists()


def test_no_attribute_leads_to_the_files_of_a_robot() -> None:
    for kind in CLASSES:
        assert not READABLE[kind] & {"element", "span", "trace", "findings"}
        assert not [name for name in READABLE[kind] if name.startswith("_")]


def test_poses_have_coordinates_by_name() -> None:
    pose = Pose(position=(1.0, 2.0, 3.0))
    assert (pose.x, pose.y, pose.z) == pose.position


def test_a_pose_in_the_frame_of_another_link_is_that_of_scipy() -> None:
    import numpy as np

    from tests.model.robots import JOINTS

    robot = Robot.from_xml(JOINTS)
    given = {"turn": 0.3, "slide": 0.2}
    base, tip = (np.array(robot.pose(name, given).matrix()) for name in ("spun", "held"))
    expected = np.linalg.inv(base) @ tip
    np.testing.assert_allclose(
        robot.pose("held", given, base="spun").matrix(), expected, atol=1e-12
    )


# --- cases ---


def test_variables_are_those_of_the_file_and_of_the_case(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(
        "robot: arm.yaml\nset: {reach: 0.3}\ncases:\n"
        "- expect: robot.pose('tool0').z == approx(0.55)\n"
        "- name: long\n  set: {reach: 900mm}\n  expect: [robot.pose('tool0').z == approx(1.15)]\n"
    )
    assert run(capsys) == (0, "arm.test.yaml: 2 passed\n", "")
    assert run(capsys, "-k", "long")[1] == "arm.test.yaml: 1 passed\n"
    status, _, err = run(capsys, "--only", "nothing")
    assert status == 2 and "no case has 'nothing' in its name" in err


def test_an_expected_error_passes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(
        "robot: arm.yaml\nset: {reach: 2}\ncases:\n"
        "- error: argument-range\n"
        "- error: {code: argument-range, at: 'arm.test.yaml:2', message: reach}\n"
        "- error: [argument-range]\n"
    )
    assert run(capsys) == (0, "arm.test.yaml: 3 passed\n", "")


@pytest.mark.parametrize(
    ("case", "found"),
    [
        ("error: argument-range", "the error 'argument-range' is expected, but the robot has no"),
        ("set: {reach: 2}\nerror: no-link", "but the robot has other errors: argument-range"),
        (
            "set: {reach: 2}\nerror: {code: argument-range, at: arm.yaml}",
            "but the robot has it elsewhere: arm.test.yaml:2:7",
        ),
        (
            "set: {reach: 2}\nerror: {code: argument-range, message: far}",
            "but the robot has it with another message",
        ),
        ("set: {reach: 2}", "error[argument-range]"),
        ("warnings: [no-link]", "the warnings are none, not no-link"),
        ("set: {rech: 2}", "error[unknown-argument]"),
    ],
)
def test_what_fails_otherwise(
    folder: Path, capsys: pytest.CaptureFixture[str], case: str, found: str
) -> None:
    write(f"robot: arm.yaml\n{case}\n")
    status, _, err = run(capsys)
    assert status == 1 and found in err
    is_compared = "but the robot" in found or "the warnings are" in found
    assert ("error-expected" in err) == is_compared


def test_warnings_are_compared_with_the_advice_of_check(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("arm.yaml").write_text(ROBOT.replace("velocity: 1}", "velocity: 0}"))
    main(["check", "arm.yaml"])
    err = capsys.readouterr().err
    code = err.partition("warning[")[2].partition("]")[0]
    assert code
    write("robot: arm.yaml\nwarnings: []\n")
    assert run(capsys)[0] == 1
    write(f"robot: arm.yaml\nwarnings: [{code}]\n")
    assert run(capsys)[0] == 0


def test_a_robot_with_errors_fails_with_its_diagnostics(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write("robot: broken.yaml\nexpect: robot.mass > 1\n")
    status, out, err = run(capsys)
    assert status == 1 and "missing-file" in err and "arm.test.yaml:1:8" in err
    Path("broken.yaml").write_text("robot: b\nmodel:\n- link/name=a:\n  - mas: $(1 / 0)\n")
    status, out, err = run(capsys)
    assert (status, out) == (1, "arm.test.yaml: 1 failed\n")
    assert "broken.yaml:4" in err and "division by zero" in err


def test_urdf_xacro_and_other_xml_are_tested_too(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["arm.yaml", "-o", "arm.urdf"])
    Path("arm.xacro").write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="n" default="a"/><link name="$(arg n)"/></robot>'
    )
    Path("world.yaml").write_text("world:\n- light/name=sun:\n")
    write("robot: arm.urdf\nexpect: robot.mass == 3\n", "a.test.yaml")
    write("robot: arm.xacro\nset: {n: b}\nexpect: \"'b' in robot.links\"\n", "b.test.yaml")
    write("robot: world.yaml\nexpect: robot.mass == 3\n", "c.test.yaml")
    capsys.readouterr()
    status, out, err = run(capsys)
    assert status == 1
    assert out.splitlines()[:2] == ["a.test.yaml: 1 passed", "b.test.yaml: 1 passed"]
    assert "name 'robot' is not defined" in err


# --- test files with errors ---


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", "empty"),
        ("- robot: arm.yaml\n", "[bad-test]: a test file has keys such as"),
        ("robto: arm.yaml\n", "did you mean 'robot'?"),
        ("expect: robot.mass > 1\n", "[missing-key]: a test file needs the key `robot`"),
        ("robot: arm.yaml\ncases:\n- expct: 1\n", "did you mean 'expect'?"),
        ("robot: arm.yaml\ncases: {a: 1}\n", "`cases` takes a list"),
        ("robot: arm.yaml\ncases: []\nexpect: x\n", "`expect` belongs to one of the `cases`"),
        ("robot: arm.yaml\nexpect:\n- a: b\n", "an expectation is a Python expression"),
        ("robot: arm.yaml\nset: 3\n", "`set` takes names with values"),
        ("robot: arm.yaml\nurdf: ../x.urdf\n", "is not below the folder of the test file"),
        ("robot: arm.yaml\nurdf: /x.urdf\n", "is not below the folder of the test file"),
        ("robot: arm.yaml\nerror: {at: x}\n", "an expected error needs a `code`"),
        ("robot: arm.yaml\nerror: a\nexpect: x\n", "has no output to expect anything of"),
        ("robot: arm.yaml\nrobot: b.yaml\n", "`robot` is given twice"),
        ("robot: [a]\n", "`robot` takes a text"),
        ("robot: arm.yaml\n  x: {\n", "arm.test.yaml"),
    ],
)
def test_a_faulty_test_file_is_a_diagnostic(
    folder: Path, capsys: pytest.CaptureFixture[str], text: str, found: str
) -> None:
    write(text)
    status, out, err = run(capsys)
    assert (status, out) == (1, "arm.test.yaml: 1 test file with errors\n")
    assert found in err and "arm.test.yaml" in err


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ((), "there is no test file (*.test.yaml) in '.'"),
        (("none",), "cannot read 'none'"),
        (("x:=1",), "a test file sets variables itself"),
        (("--strict",), "'--strict' cannot be used with 'yamaro test'"),
    ],
)
def test_wrong_usage(
    folder: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], found: str
) -> None:
    status, _, err = run(capsys, *words)
    assert status == 2 and found in err


def test_test_files_are_found_in_folders(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for inner in ("a", "a/b", "build", ".hidden"):
        (folder / inner).mkdir()
        write("robot: ../arm.yaml\n", f"{inner}/x.test.yaml")
    (folder / "a" / "b" / "x.test.yaml").write_text("robot: ../../arm.yaml\n")
    write("robot: arm.yaml\n", "y.test.yml")
    write("robot: arm.yaml\n", "other.yaml")
    lines = [os.path.join("a", "b", "x.test.yaml"), os.path.join("a", "x.test.yaml"), "y.test.yml"]
    out = run(capsys)[1].splitlines()
    assert sorted(out) == sorted([*(f"{line}: 1 passed" for line in lines), "3 passed"])
    assert run(capsys, "other.yaml")[1] == "other.yaml: 1 passed\n"
    assert run(capsys, "a", "a/x.test.yaml")[1].splitlines()[-1] == "2 passed"


# --- trust ---


def test_robots_are_not_trusted_by_default(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("arm.yaml").write_text("process: |\n  open('made', 'w').close()\n" + ROBOT)
    write("robot: arm.yaml\n")
    assert run(capsys)[0] == 1
    assert not Path("made").exists()
    assert run(capsys, "--trust")[0] == 0
    assert Path("made").exists()


# --- golden files ---


def test_golden_files_are_written_and_compared_by_meaning(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write("robot: arm.yaml\nurdf: golden/arm.urdf\n")
    status, _, err = run(capsys)
    assert status == 1 and "error[output-differs]: the file 'golden/arm.urdf' does not exist" in err
    golden = Path("golden") / "arm.urdf"
    assert run(capsys, "--accept") == (0, "arm.test.yaml: 1 passed\n", f"wrote {golden}\n")
    assert Robot.from_urdf(golden).mass == 3
    assert run(capsys)[0] == 0
    text = golden.read_text()
    golden.write_text(text.replace("0.25", "0.250").replace("<robot", "<!-- kept -->\n<robot"))
    assert run(capsys, "--accept")[2] == ""  # nothing differs, nothing is written
    assert "kept" in golden.read_text()
    Path("arm.yaml").write_text(ROBOT.replace("mass: 1", "mass: 1.5"))
    status, _, err = run(capsys)
    assert status == 1
    assert "the output differs from 'golden/arm.urdf'" in err
    assert "~ arm_link  mass 1 → 1.5 kg (+50 %, the inertia in proportion)" in err
    assert run(capsys, "--accept", "-q") == (0, "", "")
    assert Robot.from_urdf(golden).mass == 3.5


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("away/arm.urdf", "links lead out"),
        ("away/new.urdf", "links lead out"),
        ("link.urdf", "links lead out"),
        ("dangling.urdf", "links lead out"),
        (".bashrc", "hidden part"),
        ("sub/.git/config", "hidden part"),
        ("arm.yaml", "one of the input files"),
        ("arm.test.yaml", "one of the input files"),
        ("hard.urdf", "one of the input files"),
        ("package.xml", "something else than a <robot>"),
        ("notes.txt", "something else than a <robot>"),
    ],
)
def test_accepting_writes_golden_files_below_the_folder_only(
    name: str, reason: str, folder: Path, tmp_path_factory: pytest.TempPathFactory,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    away = tmp_path_factory.mktemp("away")
    (away / "arm.urdf").write_text("<robot name='theirs'/>")
    os.symlink(away, "away")
    os.symlink(away / "arm.urdf", "link.urdf")
    os.symlink(away / "nowhere", "dangling.urdf")
    os.link("arm.yaml", "hard.urdf")
    Path("package.xml").write_text("<package/>")
    Path("notes.txt").write_text("notes")
    write(f"robot: arm.yaml\nurdf: {name}\n")
    before = {path: path.read_text() for path in folder.rglob("*") if path.is_file()}
    status, _, err = run(capsys, "--accept")
    assert status == 1
    assert f"'{name}' cannot be written: " in err
    assert reason in err
    assert {path: path.read_text() for path in folder.rglob("*") if path.is_file()} == before
    assert [path.name for path in away.iterdir()] == ["arm.urdf"]
    assert (away / "arm.urdf").read_text() == "<robot name='theirs'/>"


def test_golden_files_of_other_xml(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("world.yaml").write_text("world:\n- light/name=sun:\n")
    write("robot: world.yaml\nxml: world.xml\n")
    assert run(capsys, "--accept")[0] == 0
    assert run(capsys)[0] == 0
    Path("world.yaml").write_text("world:\n- light/name=moon:\n")
    status, _, err = run(capsys)
    assert status == 1 and "'name' is 'moon', not 'sun'" in err


# --- results for programs ---


def test_results_as_json(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write("robot: arm.yaml\ncases:\n- name: a\n  expect: robot.mass > 5\n- name: b\n")
    status, out, _ = run(capsys, "--json")
    data: dict[str, Any] = json.loads(out)
    assert status == 1 and (data["passed"], data["failed"]) == (1, 1)
    (file,) = data["files"]
    first, second = file["cases"]
    assert (first["name"], first["line"], first["passed"]) == ("a", 3, False)
    assert second["passed"] and second["failures"] == []
    (failure,) = first["failures"]
    assert failure["code"] == "expectation-failed" and failure["notes"] == ["robot.mass = 3"]
    assert (failure["file"], failure["line"], failure["column"]) == ("arm.test.yaml", 4, 11)


def test_results_in_the_format_of_junit(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write('robot: arm.yaml\ncases:\n- name: a <b> & "c"\n  expect: robot.mass > 5\n- name: b\n')
    write("robt: arm.yaml\n", "bad.test.yaml")
    assert run(capsys, "--junit", "out.xml")[0] == 1
    root = ET.parse("out.xml").getroot()
    assert root.tag == "testsuites" and root.get("tests") == "3" and root.get("failures") == "2"
    first, second = root.findall("testsuite")
    assert (first.get("name"), first.get("tests")) == ("arm.test.yaml", "2")
    case, other = first.findall("testcase")
    assert case.get("name") == 'a <b> & "c"' and case.get("classname") == "arm.test.yaml"
    failure = case.find("failure")
    assert failure is not None and failure.get("type") == "expectation-failed"
    assert "robot.mass = 3" in (failure.text or "")
    assert other.find("failure") is None
    assert second.find("testcase/failure") is not None


def test_junit_holds_what_xml_cannot() -> None:
    case = JUnitCase("a\x00b", group="g", failures=[JUnitFailure("k", "m\x1b[31m", "t\x08\nu")])
    root = ET.fromstring(junit_text("x", [("s", [case])]).encode())
    failure = root.find("testsuite/testcase/failure")
    assert failure is not None and failure.text is not None
    assert "\n" in failure.text and "\x08" not in failure.text


# --- the examples ---


def test_the_examples_pass_their_tests(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(EXAMPLES)
    status, out, err = run(capsys)
    assert (status, err) == (0, "")
    assert "hexapod.test.yaml: 3 passed" in out


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("robot: arm.yaml\nset: 3\n", "bad-test"),
        ("robot: arm.yaml\nexpect: false\n", "expectation-failed"),
        ("robot: arm.yaml\nerror: no-link\n", "error-expected"),
        ("robot: arm.yaml\nurdf: none.urdf\n", "output-differs"),
    ],
)
def test_the_codes_of_tests(
    folder: Path, capsys: pytest.CaptureFixture[str], text: str, code: str
) -> None:
    write(text)
    assert f"error[{code}]" in run(capsys)[2]
