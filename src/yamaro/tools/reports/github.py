"""Findings as commands of GitHub's workflows, which show them in the changed files.

Source: GitHub's documentation, "Workflow commands for GitHub Actions", setting an error message.
"""

from __future__ import annotations

from .findings import each_once, message_of, path_of, region_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...diagnostics import Diagnostic
    from .findings import Checked


def github_report(files: Sequence[Checked]) -> str:
    """Return a line for each finding."""
    return "".join(_line(each) + "\n" for _, each in each_once(files))


def _line(diagnostic: Diagnostic) -> str:
    line, column, end_line, end_column = region_of(diagnostic.span)
    properties = {"file": path_of(diagnostic.span), "line": line, "endLine": end_line}
    if line == end_line:  # GitHub takes columns within one line only
        properties |= {"col": column, "endColumn": end_column}
    properties["title"] = diagnostic.code
    listed = ",".join(f"{name}={_property(str(value))}" for name, value in properties.items())
    return f"::{diagnostic.severity} {listed}::{_data(message_of(diagnostic))}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
