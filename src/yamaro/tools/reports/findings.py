"""What was found in several files, and where each finding is as reports name it."""

from __future__ import annotations

import os
from urllib.parse import quote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ...diagnostics import Diagnostic
    from ...source import Span


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
