"""Compares the output of a robot with a golden file by meaning, or writes that file."""

from __future__ import annotations

import os

from ...diagnostics import Diagnostic, YamaroError, failure
from ...files.regular import open_regular
from ...output import is_input, leads_out, write_file

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...result import Build
    from ...source import Span

MOST_LINES = 12
"""Lines of differences to show."""


def compare_with_golden(
    build: Build, golden: tuple[str, Span], *, folder: str, accepts: bool
) -> tuple[list[Diagnostic], str]:
    """Return how the output differs from the golden file, and the file if it was written.

    Args:
        build: the robot.
        golden: the path of the file below the folder, and where that is written.
        folder: that of the test file.
        accepts: write the file if it differs or is missing.
    """
    name, span = golden
    path = os.path.join(folder, name)
    try:
        with open_regular(path) as file:
            old = file.read().decode("utf-8", "replace")
    except FileNotFoundError:
        old = None
    except OSError as error:
        reason = error.strerror or str(error)
        return [Diagnostic("output-differs", f"'{name}' cannot be read: {reason}", span)], ""
    lines = None if old is None else _differences(old, build, name)
    if lines is not None and not lines:
        return [], ""
    if accepts:
        _check_replaceable(path, old, build, golden, folder)
        _write(path, build, name, span)
        return [], os.path.normpath(os.path.join(os.path.dirname(span.source.name), name))
    if lines is None:
        message, notes = f"the file '{name}' does not exist", []
    else:
        message, notes = f"the output differs from '{name}'", lines
    hint = "if the output is right, --accept writes the file"
    return failure("output-differs", message, span, hint=hint, notes=notes).diagnostics, ""


def _check_replaceable(
    path: str, old: str | None, build: Build, golden: tuple[str, Span], folder: str
) -> None:
    """Raise YamaroError unless a file that a test names may be written.

    That are files below the folder of the test, not hidden ones, and in the place of another file
    only where that holds what is compared with: XML with the same root, and nothing that was read.
    """
    name, span = golden
    reason = ""
    if leads_out(path, folder):
        reason = "links lead out of the folder of the test file there"
    elif any(part.startswith(".") for part in os.path.normpath(name).split(os.sep)):
        reason = "its path has a hidden part"
    elif is_input(path, [*build.files, *build.meshes, span.source.path]):
        reason = "it is one of the input files"
    elif old is not None and old.strip() and _root_of(old) != build.root_name:
        reason = f"it holds something else than a <{build.root_name}>"
    if reason:
        message = f"'{name}' cannot be written: {reason}"
        raise failure("output-differs", message, span, hint="remove it, or choose another name")


def _root_of(text: str) -> str:
    """Return the name of the root of XML, or "" for other text."""
    from ...source import Source
    from ...xml.reader import read_xml

    try:
        return read_xml(Source(text, name="")).root.name
    except YamaroError:
        return ""


def _write(path: str, build: Build, name: str, span: Span) -> None:
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        write_file(path, build.encoded())
    except OSError as error:
        reason = error.strerror or str(error)
        raise failure("output-differs", f"'{name}' cannot be written: {reason}", span) from None


def _differences(old: str, build: Build, name: str) -> list[str]:
    """Return in what the output differs by meaning, a line for each change."""
    from ...model.robot import Robot

    if build.root_name != "robot":
        return _differences_of_xml(old, build, name)
    try:
        before = Robot.from_xml(old, name=name)
    except YamaroError as error:
        return [f"{name}: {error.diagnostics[0].message}"]
    changes = before.changes(build.robot, has_extras=False)
    if not changes:
        return []
    from ..diff.text import DiffText

    robots = (before, build.robot)
    mains = (name, "")
    text = DiffText(changes, robots, name=_name_of, mains=mains).render((name, "the output"))
    return _first(text.rstrip("\n").split("\n")[2:])


def _differences_of_xml(old: str, build: Build, name: str) -> list[str]:
    from ...model.compare import compare
    from ...source import Source
    from ...xml.reader import read_xml

    try:
        before = read_xml(Source(old, name=name)).root
        after = read_xml(Source(build.xml(), name="output")).root
    except YamaroError as error:
        return [f"{name}: {error.diagnostics[0].message}"]
    return _first([str(difference) for difference in compare(before, after)])


def _first(lines: list[str]) -> list[str]:
    if len(lines) <= MOST_LINES:
        return lines
    return [*lines[: MOST_LINES - 1], f"and {len(lines) - MOST_LINES + 1} more lines"]


def _name_of(span: Span) -> str:
    return span.source.name
