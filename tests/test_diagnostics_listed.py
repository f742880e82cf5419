"""The source, docs/diagnostics.md and the golden cases know the same diagnostic codes."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from tests.golden import CASES
from yamaro.codes import ADJUSTABLE, help_text, help_uri

REPOSITORY = Path(__file__).parents[1]
LISTING = REPOSITORY / "docs" / "diagnostics.md"

CODE = r"[a-z0-9]+(?:[-.][a-z0-9]+)*"
# A code has a heading of its own, or the first cell of a row in a table.
LISTED = re.compile(rf"^(?:#{{2,4}} |\| *)`({CODE})`", re.MULTILINE)
GIVEN = re.compile(rf"^(?:error|warning)\[({CODE})\]", re.MULTILINE)

# Codes that depend on the machine, or on another command, so that no golden case can hold them.
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
    "not-migrated": "tools/migrate/test_migrate_command.py",
    "not-urdf": "runtime/test_xml_main.py",
    "output-differs": "tools/test_test.py",
    "sweep-differs": "tools/sweep/test_running.py",
    "sweep-engine": "tools/sweep/test_engines.py",
    "unknown-metric": "tools/sweep/test_evaluation.py",
    "unknown-package": "check/test_check.py",
    "variant-crash": "tools/sweep/test_isolation.py",
    "variant-exit": "tools/sweep/test_isolation.py",
    "variant-timeout": "tools/sweep/test_isolation.py",
}

# Callables one of whose first two arguments is a code.
RAISERS = {"Diagnostic", "Fault", "InputFault", "_bad_call", "_fault", "error", "failure", "warn"}


def codes_listed() -> list[str]:
    return LISTED.findall(LISTING.read_text(encoding="utf-8"))


def codes_of_cases() -> set[str]:
    files = CASES.glob("*/*.err")
    return {code for file in files for code in GIVEN.findall(file.read_bytes().decode())}


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


listing = pytest.mark.skipif(not LISTING.exists(), reason="docs/diagnostics.md is not written yet")


@listing
def test_every_listed_code_has_a_golden_case() -> None:
    assert sorted(set(codes_listed()) - codes_of_cases() - set(TESTED_ELSEWHERE)) == []


def test_codes_without_a_case_are_tested_where_it_says() -> None:
    for code, name in TESTED_ELSEWHERE.items():
        assert f'"{code}"' in (REPOSITORY / "tests" / name).read_text(encoding="utf-8")


@listing
def test_every_code_of_a_golden_case_is_listed() -> None:
    assert sorted(codes_of_cases() - set(codes_listed())) == []


@listing
def test_every_code_in_the_source_is_listed() -> None:
    assert sorted(codes_in_source() - set(codes_listed())) == []


@listing
def test_no_code_is_listed_twice() -> None:
    assert sorted(codes_listed()) == sorted(set(codes_listed()))


def test_codes_are_found_in_the_source() -> None:
    # These two stand in modules that no language change will touch.
    assert {"control-character", "undeclared-prefix"} <= codes_in_source()


def test_the_address_of_each_code_leads_to_its_heading() -> None:
    codes = codes_listed()
    assert len(codes) > 250
    for code in codes:
        address, _, heading = str(help_uri(code)).partition("#")
        assert heading == code
        page = Path(url2pathname(urlsplit(address).path))
        assert f"\n### `{heading}`\n" in page.read_text(encoding="utf-8")
        assert help_text(code)
    assert help_uri("no-such-code") is None
    assert help_text("no-such-code") is None


def test_what_a_report_says_of_a_code_has_no_links_that_lead_nowhere() -> None:
    texts = [help_text(code) or "" for code in codes_listed()]
    assert [text for text in texts if re.search(r"\]\((?!https?:)", text)] == []


# --- codes that can be allowed and denied -----------------------------------------------------

WARNED = re.compile(rf"^warning\[({CODE})\]", re.MULTILINE)
SEVERITY = re.compile(rf"^### `({CODE})`\n\n\*Severity: ", re.MULTILINE)


def test_the_page_shows_which_codes_can_be_allowed_and_denied() -> None:
    assert sorted(SEVERITY.findall(LISTING.read_text(encoding="utf-8"))) == sorted(ADJUSTABLE)


def test_what_is_a_warning_somewhere_can_be_denied() -> None:
    files = CASES.glob("*/*.err")
    warned = {code for file in files for code in WARNED.findall(file.read_bytes().decode())}
    migration = {"not-migrated"}  # a warning of `migrate`, which builds nothing
    assert sorted((warned | codes_in_source({"warn"})) - ADJUSTABLE - migration) == []


def test_what_the_check_refuses_can_be_allowed() -> None:
    assert sorted(codes_in_source({"error"}) - ADJUSTABLE) == []
