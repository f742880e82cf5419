"""Findings of several files as programs read them: `yamaro check --format`.

Sources: the OASIS standard "Static Analysis Results Interchange Format (SARIF) Version 2.1.0";
https://github.com/testmoapp/junitxml, a description of JUnit's format as it is in common use;
GitHub's documentation, "Workflow commands for GitHub Actions", setting an error message.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any
from urllib.parse import quote

from ..allowances import allowing
from ..codes import HOME, help_text, rules
from ..diagnostics import ACCEPTED, WARNING, Diagnostic, Frame
from ..fixes import Fix
from ..rendering import render_all
from ..source import Span
from ..terminal import printable
from ..xml.values import escaped_attribute, escaped_text


class Checked:
    """A file that was checked.

    Attributes:
        name: what it is called in messages.
        path: its absolute path; "" for standard input.
        diagnostics: what was found, in the files that it includes too.
        accepted: what was found and is accepted by comments in the files.
        is_fine: whether nothing was found but warnings that are allowed.
    """

    __slots__ = ("accepted", "diagnostics", "is_fine", "name", "path")

    def __init__(
        self,
        name: str,
        path: str,
        diagnostics: Sequence[Diagnostic],
        *,
        is_fine: bool,
        accepted: Sequence[Diagnostic] = (),
    ) -> None:
        self.name = name
        self.path = path
        self.diagnostics = diagnostics
        self.accepted = accepted
        self.is_fine = is_fine


def each_once(
    files: Sequence[Checked], *, are_accepted: bool = False
) -> Iterator[tuple[Checked, Diagnostic]]:
    """Give each finding once, with the first file that led to it; several may include a file.

    With `are_accepted` those are given that comments accept, in place of the others.
    """
    seen: set[object] = set()
    for checked in files:
        for diagnostic in checked.accepted if are_accepted else checked.diagnostics:
            key = (diagnostic.code, diagnostic.message, diagnostic.span.key())
            if key not in seen:
                seen.add(key)
                yield checked, diagnostic


def path_of(span: Span) -> str:
    """Return the path of a span's file, relative to the working directory if it is in it."""
    path = span.source.path
    if not path:
        return span.source.name
    return relative(path)


def relative(path: str) -> str:
    """Return a path relative to the working directory if it is in it, with slashes."""
    folder = os.path.join(os.getcwd(), "")
    inside = path[len(folder) :] if path.startswith(folder) else path
    return inside.replace(os.sep, "/")


def uri_of(span: Span) -> dict[str, str] | None:
    """Return a span's file as an artifact location of SARIF, or None for what is in no file."""
    return file_uri(relative(span.source.path)) if span.source.path else None


def file_uri(path: str) -> dict[str, str]:
    """Return a path, as `relative` gives it, as an artifact location of SARIF."""
    if path.startswith("/") or path[1:2] == ":":
        return {"uri": "file:///" + quote(path.lstrip("/"), safe="/:")}
    return {"uri": quote(path), "uriBaseId": "%SRCROOT%"}


def region_of(span: Span) -> tuple[int, int, int, int]:
    """Return line, column, end line and end column, from 1; the end is exclusive."""
    line, column = span.location()
    end_line, end_column = span.source.location(max(span.end, span.start))
    return line, column, end_line, end_column


def message_of(diagnostic: Diagnostic) -> str:
    """Return message, hint and notes in one text."""
    lines = [diagnostic.message]
    if diagnostic.hint:
        lines.append(f"hint: {diagnostic.hint}")
    lines += [f"note: {note}" for note in diagnostic.notes]
    return "\n".join(lines)


# --- JSON -------------------------------------------------------------------------------------


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
    fix = None
    if diagnostic.fix is not None:
        edits = [{**_place(edit.span), "text": edit.text} for edit in diagnostic.fix.edits]
        fix = {"title": diagnostic.fix.title, "safe": diagnostic.fix.is_safe, "edits": edits}
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
        "fix": fix,
    }


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


# --- the format of JUnit, which CI systems read -----------------------------------------------


class JUnitFailure:
    """Why a case failed.

    Attributes:
        kind: a short name of the reason, such as the code of a diagnostic.
        message: the reason in a line.
        text: all that there is to say, in several lines.
    """

    __slots__ = ("kind", "message", "text")

    def __init__(self, kind: str, message: str, text: str = "") -> None:
        self.kind = kind
        self.message = message
        self.text = text


class JUnitCase:
    """One case of a suite, which passed if it has no failures.

    Attributes:
        name: its name.
        group: what it belongs to, such as a file; `classname` in JUnit.
        failures: why it failed.
        seconds: how long it took, or None.
        file, line: where it is written, or "" and 0.
    """

    __slots__ = ("failures", "file", "group", "line", "name", "seconds")

    def __init__(
        self,
        name: str,
        *,
        group: str,
        failures: Sequence[JUnitFailure] = (),
        seconds: float | None = None,
        file: str = "",
        line: int = 0,
    ) -> None:
        self.name = name
        self.group = group
        self.failures = list(failures)
        self.seconds = seconds
        self.file = file
        self.line = line


def junit_text(name: str, suites: Iterable[tuple[str, Sequence[JUnitCase]]]) -> str:
    """Return results as a document of JUnit.

    Args:
        name: what was run, such as `yamaro test`.
        suites: the name of each suite, such as a file, with its cases.
    """
    listed = [(suite, list(cases)) for suite, cases in suites]
    every = [case for _, cases in listed for case in cases]
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']
    lines.append(f"<testsuites {_counts(name, every)}>")
    for suite, cases in listed:
        lines.append(f"  <testsuite {_counts(suite, cases)}>")
        for case in cases:
            lines += _case(case)
        lines.append("  </testsuite>")
    text = "\n".join([*lines, "</testsuites>"]) + "\n"
    # Runners of CI obey lines that begin with :: in a log, and ##[.
    return re.sub(r"^(\s*:):", r"\1&#58;", text.replace("##", "#&#35;"), flags=re.MULTILINE)


def _counts(name: str, cases: Sequence[JUnitCase]) -> str:
    failed = sum(bool(case.failures) for case in cases)
    seconds = sum(case.seconds or 0.0 for case in cases)
    counts = {"name": name, "tests": len(cases), "failures": failed, "errors": 0, "skipped": 0}
    return _attributes({**counts, "time": f"{seconds:.3f}"})


def _case(case: JUnitCase) -> list[str]:
    attributes: dict[str, object] = {"name": case.name, "classname": case.group}
    if case.file:
        attributes["file"] = case.file
    if case.line:
        attributes["line"] = case.line
    if case.seconds is not None:
        attributes["time"] = f"{case.seconds:.3f}"
    head = f"    <testcase {_attributes(attributes)}"
    if not case.failures:
        return [f"{head}/>"]
    lines = [f"{head}>"]
    first = case.failures[0]  # some readers take no more than one
    text = "\n\n".join(failure.text or failure.message for failure in case.failures)
    opening = _attributes({"message": first.message, "type": first.kind})
    shown = escaped_text("\n".join(map(printable, text.split("\n"))))
    lines.append(f"      <failure {opening}>{shown}</failure>")
    return [*lines, "    </testcase>"]


def _attributes(values: dict[str, object]) -> str:
    return " ".join(
        f'{name}="{escaped_attribute(printable(str(value)))}"' for name, value in values.items()
    )


# --- commands of GitHub's workflows, which show findings in the changed files -----------------


def github_report(files: Sequence[Checked]) -> str:
    """Return a line for each finding."""
    lines = []
    for _, diagnostic in each_once(files):
        line, column, end_line, end_column = region_of(diagnostic.span)
        properties = {"file": path_of(diagnostic.span), "line": line, "endLine": end_line}
        if line == end_line:  # GitHub takes columns within one line only
            properties |= {"col": column, "endColumn": end_column}
        properties["title"] = diagnostic.code
        values = {
            name: _data(str(value)).replace(":", "%3A").replace(",", "%2C")
            for name, value in properties.items()
        }
        listed = ",".join(f"{name}={value}" for name, value in values.items())
        lines.append(f"::{diagnostic.severity} {listed}::{_data(message_of(diagnostic))}\n")
    return "".join(lines)


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


# --- JUnit: a suite for each file, a failed case for each code in it --------------------------


def junit_report(files: Sequence[Checked]) -> str:
    """Return what was found as a JUnit document."""
    return junit_text("yamaro check", map(_suite, files))


def _suite(checked: Checked) -> tuple[str, list[JUnitCase]]:
    """Return the name of a file's suite, and its cases."""
    name = relative(checked.path) or checked.name
    if checked.is_fine:
        return name, [JUnitCase("check", group=name)]
    codes: dict[str, list[Diagnostic]] = {}
    for diagnostic in checked.diagnostics:
        codes.setdefault(diagnostic.code, []).append(diagnostic)
    cases = []
    for code, found in codes.items():
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        text = "\n\n".join(render_all(found))
        failure = JUnitFailure(code, found[0].message + more, text)
        cases.append(JUnitCase(code, group=name, failures=[failure]))
    return name, cases


# --- SARIF 2.1.0, which GitHub's code scanning and many editors read --------------------------


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
        "artifacts": [{"location": file_uri(relative(each.path))} for each in files if each.path],
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
    short = f"{words[:1].upper()}{words[1:]}."
    help = {"text": f"docs/diagnostics.md of Yamaro describes '{code}', and how to fix it."}
    described = help_text(code)
    if described is not None:
        # The page itself is on this machine, and not where the report is read: no `helpUri`.
        help["markdown"] = described
    return {
        "id": code,
        "name": name,
        "shortDescription": {"text": short},
        "fullDescription": {"text": rules()[code].summary if described else short},
        "help": help,
    }


def _result(
    checked: Checked, diagnostic: Diagnostic, index: int, prints: _Fingerprints
) -> dict[str, Any]:
    location = _location(diagnostic.span)
    if location is None:  # in no file, such as `name:=value`: the file as a whole
        uri = file_uri(relative(checked.path) if checked.path else "stdin")
        location = {"physicalLocation": {"artifactLocation": uri}}
    result: dict[str, Any] = {
        "ruleId": diagnostic.code,
        "ruleIndex": index,
        "level": WARNING if diagnostic.severity == ACCEPTED else diagnostic.severity,
        "message": {"text": message_of(diagnostic)},
        "locations": [location],
        "partialFingerprints": {"yamaro/v1": prints.of(diagnostic)},
    }
    if diagnostic.severity == ACCEPTED:
        comments = allowing(diagnostic.code, diagnostic.span, diagnostic.trace)
        result["suppressions"] = [
            {"kind": "inSource", "location": _location(each.span)} for each in comments
        ]
    flow = [_location(step.span, step.name) for step in steps_of(diagnostic.trace)]
    steps = [step for step in reversed(flow) if step is not None]
    if steps:
        steps.append(location)
        locations = [{"location": each} for each in steps]
        result["codeFlows"] = [{"threadFlows": [{"locations": locations}]}]
    if diagnostic.fix is not None and (fix := _replacements(diagnostic.fix)):
        result["fixes"] = [fix]
    return result


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


def _replacements(fix: Fix) -> dict[str, Any] | None:
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
