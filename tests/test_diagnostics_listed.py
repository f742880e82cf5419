"""The source, docs/diagnostics.md and the golden cases know the same diagnostic codes."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[1]
LISTING = REPOSITORY / "docs" / "diagnostics.md"

CODE = r"[a-z0-9]+(?:[-.][a-z0-9]+)*"
# A code has a heading of its own, or the first cell of a row in a table.
LISTED = re.compile(rf"^(?:#{{2,4}} |\| *)`({CODE})`", re.MULTILINE)
GIVEN = re.compile(rf"^(?:error|warning)\[({CODE})\]", re.MULTILINE)

# Codes that depend on the machine, so that no golden case can hold them.
TESTED_ELSEWHERE = {
    "jail-broken": "test_policy.py",
    "limit-time": "test_policy.py",
    "missing-extra": "test_part.py",
    "no-jail": "test_policy.py",
    "unknown-package": "test_check.py",
    "xml-encoding": "test_xmlreader.py",
    "xml-entity": "test_xmlreader.py",
    "xml-syntax": "test_xmlreader.py",
}
# Those of xacro files, which no case of tests/cases is.
TESTED_ELSEWHERE |= dict.fromkeys(
    """
    xacro-expression xacro-python xacro-undefined xacro-unsafe xacro-cycle
    xacro-substitution xacro-condition xacro-name xacro-property xacro-scope
    xacro-missing-attribute xacro-unknown-attribute xacro-unknown-macro
    xacro-unknown-parameter xacro-missing-parameter xacro-missing-block xacro-unused-block
    xacro-unknown-block xacro-yaml xacro-fatal xacro-message xacro-deprecated
    xacro-redefined xacro-no-files xacro-ignored xacro-lost xacro-prefix
    """.split(),
    "test_xacro.py",
)

# Callables whose first argument is a code.
RAISERS = {"Diagnostic", "InputFault", "_bad_call", "failure", "warn"}


def codes_listed() -> list[str]:
    return LISTED.findall(LISTING.read_text(encoding="utf-8"))


def codes_of_cases() -> set[str]:
    files = (REPOSITORY / "tests" / "cases").glob("*/*.err")
    return {code for file in files for code in GIVEN.findall(file.read_bytes().decode())}


def codes_in_source() -> set[str]:
    return {
        call.args[0].value
        for file in (REPOSITORY / "src").rglob("*.py")
        for call in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call)
        and getattr(call.func, "attr", getattr(call.func, "id", "")) in RAISERS
        and call.args
        and isinstance(call.args[0], ast.Constant)
        and isinstance(call.args[0].value, str)
        and re.fullmatch(CODE, call.args[0].value)
    }


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
