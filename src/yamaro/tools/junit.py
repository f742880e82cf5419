"""Writes results in the format of JUnit, which CI systems read.

Source: https://github.com/testmoapp/junitxml, a description of what is in common use.
"""

from __future__ import annotations

import re

from ..terminal import printable
from ..xml.values import escaped_attribute, escaped_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


class Failure:
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


class Case:
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
        failures: Sequence[Failure] = (),
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


def junit_text(name: str, suites: Iterable[tuple[str, Sequence[Case]]]) -> str:
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


def _counts(name: str, cases: Sequence[Case]) -> str:
    failed = sum(bool(case.failures) for case in cases)
    seconds = sum(case.seconds or 0.0 for case in cases)
    counts = {"name": name, "tests": len(cases), "failures": failed, "errors": 0, "skipped": 0}
    return _attributes({**counts, "time": f"{seconds:.3f}"})


def _case(case: Case) -> list[str]:
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
    lines.append(f"      <failure {opening}>{_text(text)}</failure>")
    return [*lines, "    </testcase>"]


def _attributes(values: dict[str, object]) -> str:
    return " ".join(
        f'{name}="{escaped_attribute(printable(str(value)))}"' for name, value in values.items()
    )


def _text(text: str) -> str:
    return escaped_text("\n".join(map(printable, text.split("\n"))))
