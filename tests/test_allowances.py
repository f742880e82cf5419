"""Comments accept findings where they are: `# yamaro: allow CODE`, in XML `<!-- … -->`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.golden import case_id, find_cases
from tests.test_fixes import applied, findings
from yamaro.allowances import acceptance, allowances_of
from yamaro.api import build, load
from yamaro.commands.main import main
from yamaro.diagnostics import WARNING, YamaroError
from yamaro.policy import Policy
from yamaro.source import Source

ARM = """\
robot: arm
model:
- part: {name: base, link: {mass: 1, geometry: sphere, scale: 0.1}}%s
- part:
    name: elbow
    joint: {type: revolute, parent: base, axis: z, limit: {upper: 1, effort: 0, velocity: 1}}%s
    link: {mass: 1, geometry: sphere, scale: 0.1}
"""
ACCEPTED = ARM % ("  # yamaro: allow root-inertia", "  # yamaro: allow zero-limit, unused-allow")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    return tmp_path


def codes(text: str, **options: object) -> list[str]:
    Path("arm.yaml").write_text(text, encoding="utf-8")
    made = build("arm.yaml", advice=True, on_message=lambda line: None, **options)  # type: ignore[arg-type]
    return [each.code for each in made.warnings]


def test_without_comments_all_is_found() -> None:
    assert sorted(codes(ARM % ("", ""))) == ["root-inertia", "zero-limit"]


@pytest.mark.parametrize("trust", ["--trust", "--jail", "--safe"])
def test_what_is_accepted_is_found_nowhere(trust: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.yaml").write_text(ACCEPTED, encoding="utf-8")
    assert main(["check", trust, "arm.yaml"]) == 0
    assert capsys.readouterr() == ("arm.yaml: ok\n", "")
    assert main(["check", trust, "--strict", "arm.yaml"]) == 0
    assert main(["check", trust, "--deny", "zero-limit", "arm.yaml"]) == 0
    assert main([trust, "--strict", "--deny", "zero-limit", "arm.yaml"]) == 0
    assert "zero-limit" not in capsys.readouterr().err


@pytest.mark.parametrize("policy", [None, Policy("safe")])
def test_a_build_has_what_is_accepted(policy: Policy | None) -> None:
    Path("arm.yaml").write_text(ACCEPTED, encoding="utf-8")
    program = load("arm.yaml", policy=policy)
    for _ in range(2):  # what was read of the comments is kept
        made = program.build(advice=True)
        assert made.warnings == []
        assert sorted(each.code for each in made.accepted) == ["root-inertia", "zero-limit"]


def test_an_error_has_what_is_accepted_beside_it() -> None:
    text = ACCEPTED.replace("model:\n", "model:\n- link/name=alone:\n")
    Path("arm.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(YamaroError) as caught:
        build("arm.yaml", advice=True)
    assert "zero-limit" in [each.code for each in caught.value.accepted]
    assert "zero-limit" not in [each.code for each in caught.value.diagnostics]


@pytest.mark.parametrize(
    "head",
    [
        "# yamaro: allow root-inertia zero-limit\n",
        "#yamaro:allow root-inertia,zero-limit\n",
        "\ufeff# yamaro: allow root-inertia: KDL is not used\n# yamaro: allow zero-limit\n",
        "# the arm\n\n# yamaro: allow root-inertia, zero-limit (not built yet)\n---\n",
        "%YAML 1.2\n# yamaro: allow root-inertia, zero-limit\n---\n",
    ],
)
def test_the_head_of_a_file_accepts_for_all_of_it(head: str) -> None:
    assert codes(head + ARM % ("", "")) == []


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_end_in_any_way(end: str) -> None:
    text = ACCEPTED.replace("\n", end)
    assert codes(text) == []


def test_text_is_no_comment() -> None:
    text = "variables:\n  note: '# yamaro: allow zero-limit'\n  long: |\n    # yamaro: allow no\n"
    assert allowances_of(Source(text, name="a")) == []
    xml = "<a><![CDATA[<!-- yamaro: allow no -->]]><a b='<!-- yamaro: allow no -->'/></a>"
    source = Source(xml, name="a")
    source.is_xml = True
    assert [list(each.codes) for each in allowances_of(source)] == []


def test_a_comment_of_a_format_that_is_not_written_is_not_unused() -> None:
    text = ACCEPTED + "groups: {all: {links: [base]}}  # yamaro: allow lost-in-mjcf, lost-in-sdf\n"
    assert codes(text) == []
    found = codes(text, target="mjcf", base="fixed")
    assert "unused-allow" not in found
    without = text.replace("lost-in-mjcf, lost-in-sdf", "approximated-in-mjcf, lost-in-sdf")
    assert codes(without, target="mjcf", base="fixed").count("unused-allow") == 1


@pytest.mark.parametrize("trust", ["--trust", "--jail"])
def test_each_comment_that_accepts_a_loss_of_one_kind_is_used(
    trust: str, capsys: pytest.CaptureFixture[str]
) -> None:
    joint = "joint: {type: continuous, parent: %s, axis: y, limit: {effort: 1, velocity: 2}}  # %s"
    link = "    link: {mass: 1, geometry: sphere, scale: 0.1}\n"
    text = f"robot: arm\nbase: free\nmodel:\n- part:\n    name: a\n{link}"
    for name, parent in (("b", "a"), ("c", "b")):
        text += f"- part:\n    name: {name}\n    "
        text += joint % (parent, "yamaro: allow lost-in-mjcf") + "\n" + link
    Path("arm.yaml").write_text(text, encoding="utf-8")
    assert main(["check", trust, "--strict", "arm.yaml", "--to", "mjcf"]) == 0
    assert capsys.readouterr() == ("arm.yaml: ok\n", "")


def test_the_fix_of_one_that_accepts_nothing_removes_it() -> None:
    text = "# yamaro: allow odd-mass\n" + ARM % (
        "  # yamaro: allow gimbal-rpy, root-inertia, no-range",
        "   # yamaro: allow bad-mass",
    )
    for _ in range(4):
        Path("arm.yaml").write_text(text, encoding="utf-8")
        unused = [each for each in build("arm.yaml", advice=True).warnings if each.fix is not None]
        assert {each.code for each in unused} == {"unused-allow"}
        text = applied(text, unused[0].fix.edits)  # type: ignore[union-attr]
    assert text == ARM % ("  # yamaro: allow root-inertia", "")


def test_reports_hold_what_is_accepted(capsys: pytest.CaptureFixture[str]) -> None:
    Path("arm.yaml").write_text(ACCEPTED, encoding="utf-8")
    assert main(["check", "--format", "json", "arm.yaml"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["diagnostics"] == []
    assert [(each["code"], each["line"]) for each in report["accepted"]] == [
        ("root-inertia", 3),
        ("zero-limit", 6),
    ]
    assert main(["check", "--format", "sarif", "arm.yaml"]) == 0
    results = json.loads(capsys.readouterr().out)["runs"][0]["results"]
    suppressions = [each["suppressions"] for each in results]
    assert [each[0]["kind"] for each in suppressions] == ["inSource", "inSource"]
    places = [each[0]["location"]["physicalLocation"]["region"] for each in suppressions]
    assert [each["startLine"] for each in places] == [3, 6]


def test_an_srdf_accepts_what_is_found_against_its_robot(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("arm.urdf").write_text('<robot name="arm"><link name="a"/></robot>', encoding="utf-8")
    text = '<robot name="arm">\n<group name="g"><link name="b"/></group>%s\n</robot>\n'
    comment = " <!-- yamaro: allow unknown-reference -->"
    Path("arm.srdf").write_text(text % "", encoding="utf-8")
    assert main(["check", "arm.urdf", "arm.srdf"]) == 1
    assert "unknown-reference" in capsys.readouterr().err
    Path("arm.srdf").write_text(text % comment, encoding="utf-8")
    assert main(["check", "arm.urdf", "arm.srdf"]) == 0


WITH_WARNINGS = [
    case
    for case in find_cases()
    if case.with_suffix(".err").exists()
    and "warning[" in case.with_suffix(".err").read_text(encoding="utf-8")
]


@pytest.mark.parametrize("case", WITH_WARNINGS, ids=case_id)
def test_what_an_editor_writes_to_accept_a_finding_accepts_it(
    case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(case.parent)
    before = findings(case)
    for diagnostic in before:
        fix = acceptance(diagnostic) if diagnostic.severity == WARNING else None
        if fix is None or diagnostic.span.source.path != str(case):
            continue
        after = findings(case, applied(diagnostic.span.source.text, fix.edits))
        same = (diagnostic.code, diagnostic.message)
        was = [(each.code, each.message) for each in before].count(same)
        assert [(each.code, each.message) for each in after].count(same) < was, fix
        assert {each.code for each in after} <= {each.code for each in before}


@pytest.mark.parametrize(
    ("comment", "accepts"),
    [
        ("# yamaro: allow zero-limit", True),
        ("#yamaro: allow zero-limit", True),
        ("## yamaro: allow zero-limit", True),
        ("# the elbow  # yamaro: allow zero-limit", True),
        ("# `# yamaro: allow zero-limit` would accept it", False),
        ("# write '# yamaro: allow zero-limit' to accept it", False),
        ("# see yamaro: allow zero-limit", False),
        ("# (#yamaro: allow zero-limit)", False),
    ],
)
def test_a_comment_that_mentions_one_in_its_text_accepts_nothing(
    comment: str, accepts: bool
) -> None:
    accepted = ["root-inertia"] if accepts else ["root-inertia", "zero-limit"]
    assert sorted(codes(ARM % ("", f"  {comment}"))) == accepted
    source = Source(f"<r>\n<a/> <!-- use <b/> {comment} -->\n</r>", name="r.urdf")
    assert not allowances_of(source)
