"""Findings as JSON."""

from __future__ import annotations

import json

from .findings import each_once, path_of, region_of, relative

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any

    from ...diagnostics import Diagnostic, Frame
    from ...fixes import Fix
    from ...source import Span
    from .findings import Checked

VERSION = 1
"""Of the format; it changes when a key gets another meaning or goes."""


def json_report(files: Sequence[Checked]) -> str:
    """Return what was found as a JSON document, described in docs/check-in-ci.md."""
    document = {
        "version": VERSION,
        "files": [{"file": relative(each.path) or each.name, "ok": each.is_fine} for each in files],
        "diagnostics": [_diagnostic(each) for _, each in each_once(files)],
        "accepted": [_diagnostic(each) for _, each in each_once(files, are_accepted=True)],
    }
    text = json.dumps(document, ensure_ascii=False, indent=2)
    return text.replace("##", "#\\u0023") + "\n"  # runners of CI obey ##[…] in a log


def _diagnostic(diagnostic: Diagnostic) -> dict[str, Any]:
    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "hint": diagnostic.hint,
        "notes": list(diagnostic.notes),
        **_place(diagnostic.span),
        "trace": [
            {"kind": step.kind, "name": step.name, **_place(step.span)}
            for step in steps_of(diagnostic.trace)
        ],
        "fix": None if diagnostic.fix is None else _fix(diagnostic.fix),
    }


def _fix(fix: Fix) -> dict[str, Any]:
    edits = [{**_place(edit.span), "text": edit.text} for edit in fix.edits]
    return {"title": fix.title, "safe": fix.is_safe, "edits": edits}


def _place(span: Span) -> dict[str, Any]:
    line, column, end_line, end_column = region_of(span)
    return {
        "file": path_of(span),
        "line": line,
        "column": column,
        "end_line": end_line,
        "end_column": end_column,
    }


def steps_of(trace: Frame | None) -> Iterator[Frame]:
    """Give the calls and includes that led to a place, innermost first, up to a hundred."""
    count = 0
    while trace is not None and count < 100:
        yield trace
        trace, count = trace.parent, count + 1
