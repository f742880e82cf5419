"""Findings as JUnit XML: a suite for each file, a failed case for each code in it.

Source: the schema of Jenkins' xUnit plugin, junit-10.xsd, which GitLab and others read too.
"""

from __future__ import annotations

from ...rendering import render_all
from ...xml.values import is_xml_character
from .findings import relative

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...diagnostics import Diagnostic
    from .findings import Checked


def junit_report(files: Sequence[Checked]) -> str:
    """Return what was found as a JUnit document."""
    suites = [_suite(each) for each in files]
    tests = sum(count for _, count, _ in suites)
    failures = sum(count for _, _, count in suites)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']
    lines.append(f'<testsuites name="yamaro check" tests="{tests}" failures="{failures}">')
    lines += [line for text, _, _ in suites for line in text]
    return "\n".join([*lines, "</testsuites>", ""])


def _suite(checked: Checked) -> tuple[list[str], int, int]:
    """Return the lines of a file's suite, the number of its cases and of those that failed."""
    name = _escaped(relative(checked.path) or checked.name)
    codes: dict[str, list[Diagnostic]] = {}
    for diagnostic in checked.diagnostics:
        codes.setdefault(diagnostic.code, []).append(diagnostic)
    failed = 0 if checked.is_fine else len(codes)
    count = failed or 1
    lines = [f'  <testsuite name="{name}" tests="{count}" failures="{failed}" errors="0">']
    if not failed:
        lines.append(f'    <testcase classname="{name}" name="check"/>')
    for code, found in codes.items() if failed else ():
        lines.append(f'    <testcase classname="{name}" name="{_escaped(code)}">')
        lines.append(f'      <failure type="{_escaped(code)}" message="{_summary(found)}">')
        lines.append(_escaped("\n\n".join(render_all(found))) + "</failure>")
        lines.append("    </testcase>")
    return [*lines, "  </testsuite>"], count, failed


def _summary(found: Sequence[Diagnostic]) -> str:
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return _escaped(found[0].message + more)


def _escaped(text: str) -> str:
    """Return text for XML; a character that XML forbids becomes a question mark."""
    clean = "".join(char if is_xml_character(char) else "?" for char in text)
    for char, name in (("&", "amp"), ("<", "lt"), (">", "gt"), ('"', "quot")):
        clean = clean.replace(char, f"&{name};")
    return clean
