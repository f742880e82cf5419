"""Results of tests as JSON and in the format of JUnit."""

from __future__ import annotations

from ...rendering import render_all
from ..junit import Case, Failure, junit_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...diagnostics import Diagnostic
    from .runner import FileResult


def results_data(results: Sequence[FileResult]) -> dict[str, object]:
    """Return the results as plain data; docs/test-a-robot.md describes it."""
    cases = [each for result in results for each in result.cases]
    return {
        "version": 1,
        "passed": sum(not each.failures for each in cases),
        "failed": sum(bool(each.failures) for each in cases),
        "files": [
            {
                "file": result.path,
                "errors": [_diagnostic(each) for each in result.errors],
                "cases": [
                    {
                        "name": each.case.name,
                        "line": each.case.span.location()[0],
                        "passed": not each.failures,
                        "seconds": round(each.seconds, 6),
                        "failures": [_diagnostic(failure) for failure in each.failures],
                    }
                    for each in result.cases
                ],
            }
            for result in results
        ],
    }


def _diagnostic(diagnostic: Diagnostic) -> dict[str, object]:
    line, column = diagnostic.span.location()
    return {
        "code": diagnostic.code,
        "message": diagnostic.message,
        "file": diagnostic.span.source.name,
        "line": line,
        "column": column,
        "hint": diagnostic.hint,
        "notes": list(diagnostic.notes),
    }


def junit_of(results: Sequence[FileResult]) -> str:
    """Return the results in the format of JUnit: a suite for each file."""
    suites = []
    for result in results:
        cases = [
            Case(
                each.case.name,
                group=result.path,
                failures=list(map(_failure, each.failures)),
                seconds=each.seconds,
                file=result.path,
                line=each.case.span.location()[0],
            )
            for each in result.cases
        ]
        if result.errors:
            failures = list(map(_failure, result.errors))
            cases.append(Case("the test file", group=result.path, failures=failures))
        suites.append((result.path, cases))
    return junit_text("yamaro test", suites)


def _failure(diagnostic: Diagnostic) -> Failure:
    text = "\n".join(render_all([diagnostic]))
    return Failure(diagnostic.code, diagnostic.message, text)
