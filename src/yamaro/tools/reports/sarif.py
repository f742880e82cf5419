"""Findings as SARIF 2.1.0, which GitHub's code scanning and many editors read.

Source: the OASIS standard "Static Analysis Results Interchange Format (SARIF) Version 2.1.0".
"""

from __future__ import annotations

import hashlib
import json
import re

from ...allowances import allowing
from ...codes import HOME, help_text
from ...diagnostics import ACCEPTED, WARNING
from .data import steps_of
from .findings import each_once, file_uri, message_of, region_of, relative, uri_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from ...diagnostics import Diagnostic
    from ...fixes import Fix
    from ...source import Span
    from .findings import Checked

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
ROOT = "%SRCROOT%"
"""Means the working directory, in which relative paths start."""


def sarif_report(files: Sequence[Checked], version: str) -> str:
    """Return what was found as a SARIF document."""
    found = [*each_once(files), *each_once(files, are_accepted=True)]
    codes = list(dict.fromkeys(diagnostic.code for _, diagnostic in found))
    prints = _Fingerprints()
    driver = {
        "name": "Yamaro",
        "semanticVersion": version,
        "version": version,
        "informationUri": HOME,
        "rules": [_rule(code) for code in codes],
    }
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {ROOT: {"description": {"text": "the working directory"}}},
        "artifacts": [_artifact(each.path) for each in files if each.path],
        "results": [
            _result(checked, diagnostic, codes.index(diagnostic.code), prints)
            for checked, diagnostic in found
        ],
    }
    document = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    text = json.dumps(document, ensure_ascii=False, indent=2)
    return text.replace("##", "#\\u0023") + "\n"  # runners of CI obey ##[…] in a log


def _rule(code: str) -> dict[str, Any]:
    words = code.replace("-", " ")
    name = "".join(word.capitalize() for word in re.split(r"[-.]", code))
    help = {"text": f"docs/diagnostics.md of Yamaro describes '{code}', and how to fix it."}
    described = help_text(code)
    if described is not None:
        # The page itself is on this machine, and not where the report is read: no `helpUri`.
        help["markdown"] = described
    return {
        "id": code,
        "name": name,
        "shortDescription": {"text": f"{words[:1].upper()}{words[1:]}."},
        "fullDescription": {"text": f"The diagnostic '{code}' of Yamaro."},
        "help": help,
    }


def _artifact(path: str) -> dict[str, Any]:
    return {"location": file_uri(relative(path))}


def _result(
    checked: Checked, diagnostic: Diagnostic, index: int, prints: _Fingerprints
) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": diagnostic.code,
        "ruleIndex": index,
        "level": WARNING if diagnostic.severity == ACCEPTED else diagnostic.severity,
        "message": {"text": message_of(diagnostic)},
        "locations": [_location(diagnostic.span) or _whole(checked)],
        "partialFingerprints": {"yamaro/v1": prints.of(diagnostic)},
    }
    if diagnostic.severity == ACCEPTED:
        comments = allowing(diagnostic.code, diagnostic.span, diagnostic.trace)
        result["suppressions"] = [
            {"kind": "inSource", "location": _location(each.span)} for each in comments
        ]
    flow = [_location(step.span, step.name) for step in steps_of(diagnostic.trace)]
    steps = [location for location in reversed(flow) if location is not None]
    if steps:
        steps.append(result["locations"][0])
        locations = [{"location": each} for each in steps]
        result["codeFlows"] = [{"threadFlows": [{"locations": locations}]}]
    if diagnostic.fix is not None and (fix := _fix(diagnostic.fix)):
        result["fixes"] = [fix]
    return result


def _whole(checked: Checked) -> dict[str, Any]:
    """Return a file as a whole as the place of what is in no file, such as `name:=value`."""
    place = file_uri(relative(checked.path) if checked.path else "stdin")
    return {"physicalLocation": {"artifactLocation": place}}


def _location(span: Span, name: str | None = None) -> dict[str, Any] | None:
    place = uri_of(span)
    if place is None:
        return None
    location: dict[str, Any] = {
        "physicalLocation": {"artifactLocation": place, "region": _region(span)}
    }
    if name is not None:
        location["message"] = {"text": f"in {name}"}
    return location


def _region(span: Span) -> dict[str, int]:
    line, column, end_line, end_column = region_of(span)
    return {
        "startLine": line,
        "startColumn": column,
        "endLine": end_line,
        "endColumn": end_column,
    }


def _fix(fix: Fix) -> dict[str, Any] | None:
    changes: dict[str, Any] = {}
    for edit in fix.edits:
        place = uri_of(edit.span)
        if place is None:
            return None
        change = changes.setdefault(place["uri"], {"artifactLocation": place, "replacements": []})
        replacement: dict[str, Any] = {"deletedRegion": _region(edit.span)}
        if edit.text:
            replacement["insertedContent"] = {"text": edit.text}
        change["replacements"].append(replacement)
    return {"description": {"text": fix.title}, "artifactChanges": list(changes.values())}


class _Fingerprints:
    """Makes fingerprints that stay when lines are added above; equal ones are counted."""

    def __init__(self) -> None:
        self._times: dict[str, int] = {}

    def of(self, diagnostic: Diagnostic) -> str:
        """Return a hash of code, message without numbers, and the text of the line."""
        span = diagnostic.span
        line = span.source.line_text(span.location()[0]).strip()
        message = re.sub(r"\d+", "0", diagnostic.message)
        text = "\n".join((diagnostic.code, message, line))
        digest = hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]
        self._times[digest] = times = self._times.get(digest, 0) + 1
        return f"{digest}:{times}"
