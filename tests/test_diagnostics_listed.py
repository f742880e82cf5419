"""The source, the files rules.md and the golden cases know the same diagnostic codes."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from functools import cache
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

from tests.golden import CASES
from tests.test_links import anchors
from tests.tools_there import TOOLS, needs
from yamaro.codes import ADJUSTABLE, help_text, help_uri, rules
from yamaro.commands.command_table import command_named
from yamaro.diagnostics import Reporter
from yamaro.severities import SEVERITIES
from yamaro.source import Source, Span

REPOSITORY = Path(__file__).parents[1]

CODE = r"[a-z0-9]+(?:[-.][a-z0-9]+)*"
GIVEN = re.compile(rf"^(?:error|warning)\[({CODE})\]", re.MULTILINE)

# Codes that depend on the machine, or on another command, so that no case or example holds them.
TESTED_ELSEWHERE = {
    "bad-evaluate": "tools/sweep/test_evaluation.py",
    "bad-metric": "tools/sweep/test_evaluation.py",
    "bad-sweep": "tools/sweep/test_study.py",
    "bad-test": "tools/test_test.py",
    "error-expected": "tools/test_test.py",
    "evaluate-failed": "tools/sweep/test_evaluation.py",
    "evaluate-result": "tools/sweep/test_evaluation.py",
    "expectation-failed": "tools/test_test.py",
    "hidden-package": "files/test_installed.py",
    "jail-broken": "test_policy.py",
    "limit-time": "test_policy.py",
    "metric-failed": "tools/sweep/test_evaluation.py",
    "missing-extra": "robot/test_part.py",
    "mujoco-refused": "tools/sweep/test_evaluation.py",
    "name-with-line-break": "test_terminal.py",
    "no-jail": "test_policy.py",
    "no-opengl": "picture/test_pictures.py",
    "output-differs": "tools/test_test.py",
    "sweep-batch": "tools/sweep/test_batch.py",
    "sweep-differs": "tools/sweep/test_running.py",
    "sweep-engine": "tools/sweep/test_engines.py",
    "unknown-package": "runtime/test_details.py",
    "unknown-metric": "tools/sweep/test_evaluation.py",
    "variant-crash": "tools/sweep/test_isolation.py",
    "variant-exit": "tools/sweep/test_isolation.py",
    "variant-timeout": "tools/sweep/test_isolation.py",
}

# Callables one of whose first two arguments is a code.
RAISERS = {
    *("Diagnostic", "Fault", "InputFault", "_bad_call", "_fault", "fail", "failure", "report"),
    *("unknown_word", "warn"),
}


def codes_of_cases() -> set[str]:
    files = CASES.glob("*/*.err")
    cases = {code for file in files for code in GIVEN.findall(file.read_bytes().decode())}
    # The examples of the sections are run, and their messages compared, as those of all documents.
    return cases | {code for code, rule in rules().items() if code in GIVEN.findall(rule.text)}


@cache
def calls_with_codes() -> list[tuple[str, str]]:
    """Return the name of what is called, and a code among the first two arguments."""
    return [
        (getattr(call.func, "attr", getattr(call.func, "id", "")), code.value)
        for file in (REPOSITORY / "src").rglob("*.py")
        for call in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call)
        for code in call.args[:2]
        if isinstance(code, ast.Constant)
        and isinstance(code.value, str)
        and re.fullmatch(CODE, code.value)
    ]


def codes_in_source(raisers: set[str] = RAISERS) -> set[str]:
    return {code for name, code in calls_with_codes() if name in raisers}


def test_every_code_has_a_golden_case_or_an_example() -> None:
    assert sorted(set(rules()) - codes_of_cases() - set(TESTED_ELSEWHERE)) == []


def test_codes_without_a_case_are_tested_where_it_says() -> None:
    for code, name in TESTED_ELSEWHERE.items():
        if name.startswith("tools/") and command_named(name.split("/")[1]) is None:
            continue  # without that tool
        text = (REPOSITORY / "tests" / name).read_text(encoding="utf-8")
        assert f'"{code}"' in text or f"[{code}]" in text


def test_every_code_of_a_golden_case_is_listed() -> None:
    assert sorted(codes_of_cases() - set(rules())) == []


def test_every_code_in_the_source_is_listed() -> None:
    assert sorted(codes_in_source() - set(rules())) == []


def test_codes_are_found_in_the_source() -> None:
    # These two stand in modules that no language change will touch.
    assert {"control-character", "undeclared-prefix"} <= codes_in_source()


# --- what is made of rules.md -----------------------------------------------------------------

HEADING = re.compile(r"^### (.*)$", re.MULTILINE)


def test_each_section_is_a_code_and_no_code_has_two() -> None:
    pages = (REPOSITORY / "src" / "yamaro").rglob("rules.md")
    headings = [found for page in pages for found in HEADING.findall(page.read_text("utf-8"))]
    assert len(headings) > 250
    assert sorted(headings) == sorted(f"`{code}`" for code in rules())


@needs(*TOOLS)
def test_pages_and_tables_are_those_of_the_rules() -> None:
    made = subprocess.run(
        [sys.executable, REPOSITORY / "scripts" / "rules.py", "--check"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert made.stdout + made.stderr == "", "run `python scripts/rules.py`"
    assert made.returncode == 0


def test_all_chapters_about_robots_are_in_the_page_of_checks() -> None:
    page = (REPOSITORY / "docs" / "checks.md").read_text(encoding="utf-8")
    chapters = {rule.chapter for rule in rules().values() if rule.page.parent.name == "check"}
    assert set(re.findall(r"^<!-- rules: (.*) -->$", page, re.MULTILINE)) == chapters


def test_the_address_of_each_code_leads_to_its_heading() -> None:
    headings = {page: anchors(page) for page in {rule.page for rule in rules().values()}}
    online = anchors(REPOSITORY / "docs" / "diagnostics.md")
    for code in rules():
        address, _, anchor = str(help_uri(code)).partition("#")
        assert anchor in headings[Path(url2pathname(urlsplit(address).path))]
        assert anchor in online
        assert help_text(code)
    assert help_uri("capsule-needs-urdf-1.1") == (
        (REPOSITORY / "src" / "yamaro" / "check" / "rules.md").as_uri() + "#capsule-needs-urdf-11"
    )
    assert help_uri("no-such-code") is None
    assert help_text("no-such-code") is None


def test_what_a_report_says_of_a_code_has_no_links_that_lead_nowhere() -> None:
    texts = [help_text(code) or "" for code in rules()]
    assert [text for text in texts if re.search(r"\]\((?!https?:)", text)] == []


def test_the_summary_of_a_check_is_one_sentence() -> None:
    for rule in rules().values():
        if rule.page.parent.name == "check":
            assert re.fullmatch(r"[A-Z`0].{9,170}\.", rule.summary), rule.code


# --- codes that can be allowed and denied -----------------------------------------------------

WARNED = re.compile(rf"^warning\[({CODE})\]", re.MULTILINE)


def test_codes_with_a_severity_can_be_allowed_and_denied() -> None:
    assert {code for code, rule in rules().items() if rule.severity} == ADJUSTABLE
    assert set(SEVERITIES.values()) == {"error", "warning", "advice"}


def test_what_is_a_warning_somewhere_can_be_denied() -> None:
    files = CASES.glob("*/*.err")
    warned = {code for file in files for code in WARNED.findall(file.read_bytes().decode())}
    migration = {"not-migrated"}  # a warning of `migrate`, which builds nothing
    assert sorted((warned | codes_in_source({"report"})) - ADJUSTABLE - migration) == []


def test_what_is_reported_has_the_severity_of_its_code() -> None:
    reporter = Reporter()
    for code in ("zero-axis", "two-parents", "odd-mass"):
        reporter.report(code, "wrong", Span(Source("a: b", name="r.yaml"), 0, 1))
    reporter.report(
        "two-parents", "other", Span(Source("a: b", name="r.yaml"), 0, 1), severity="warning"
    )
    found = [each.severity for each in reporter.diagnostics]
    assert found == ["warning", "error", "warning", "warning"]
