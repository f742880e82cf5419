"""Findings as JUnit XML: a suite for each file, a failed case for each code in it."""

from __future__ import annotations

from ...rendering import render_all
from ..junit import Case, Failure, junit_text
from .findings import relative

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...diagnostics import Diagnostic
    from .findings import Checked


def junit_report(files: Sequence[Checked]) -> str:
    """Return what was found as a JUnit document."""
    return junit_text("yamaro check", map(_suite, files))


def _suite(checked: Checked) -> tuple[str, list[Case]]:
    """Return the name of a file's suite, and its cases."""
    name = relative(checked.path) or checked.name
    if checked.is_fine:
        return name, [Case("check", group=name)]
    codes: dict[str, list[Diagnostic]] = {}
    for diagnostic in checked.diagnostics:
        codes.setdefault(diagnostic.code, []).append(diagnostic)
    return name, [
        Case(code, group=name, failures=[_failure(code, found)]) for code, found in codes.items()
    ]


def _failure(code: str, found: Sequence[Diagnostic]) -> Failure:
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return Failure(code, found[0].message + more, "\n\n".join(render_all(found)))
