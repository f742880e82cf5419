"""Diagnostics in the editor: what a file says unrun, at each change, and what builds say of it."""

from __future__ import annotations

import re

from ...allowances import is_accepted
from ...codes import help_uri
from ...diagnostics import ERROR, Diagnostic
from ...fixes import Edit, Fix
from ...policy import NO_JAIL, UNSAFE
from ...rendering import trace_lines
from ...source import Source, Span
from .builds import Move

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .builds import Result
    from .protocol import Json
    from .workspace import Text, Workspace

_ERROR, _WARNING, _INFORMATION = 1, 2, 3
_UNNECESSARY, _DEPRECATED = 1, 2
_TAGS = {
    "unused-geometry": _UNNECESSARY,
    "ignored-limit": _UNNECESSARY,
    "unused-allow": _UNNECESSARY,
    "unread-variable": _UNNECESSARY,
    "xacro-deprecated": _DEPRECATED,
}
_PLACED = re.compile(r"(.*) at (.+):(\d+):(\d+)$", re.DOTALL)
MOST = 500
"""Diagnostics of one file that are sent."""


def diagnostics_of(workspace: Workspace, path: str) -> list[Diagnostic]:
    """Return all that is to be said of a file now: what it says unrun, and what builds said."""
    text = workspace.text_of(path)
    opened = path in workspace.open
    found = list(text.findings) if text is not None and opened else []
    is_faulty = any(each.severity == ERROR for each in found)
    for result in workspace.results.values():
        for diagnostic in settled(result):
            if home_of(diagnostic, result) != path:
                continue
            if is_faulty and result.main == path:
                continue  # it was built of another text
            moved = _moved(diagnostic, text)
            if moved is not None:
                found.append(moved)
    once: dict[tuple[object, ...], Diagnostic] = {}
    for each in found:  # errors that may be accepted are so in builds
        if each.severity == ERROR or not is_accepted(each.code, each.span, each.trace):
            once.setdefault((each.code, each.message, each.span.start, each.span.end), each)
    return sorted(once.values(), key=lambda each: each.span.start)[:MOST]


def settled(result: Result) -> list[Diagnostic]:
    """Return the diagnostics of a build; code that needs trust is one remark and no error.

    A xacro file that only defines macros is not a robot, so nothing is missing in it.
    """
    kept = [each for each in result.diagnostics if each.code not in (UNSAFE, NO_JAIL)]
    root = result.root
    if root is not None and "<xacro:" in root.span.source.text:
        is_robot = any(each.name == "link" for each in root.elements())
        if not is_robot:
            kept = [each for each in kept if each.span.start != root.span.start]
    refused = [each for each in result.diagnostics if each.code in (UNSAFE, NO_JAIL)]
    if refused:
        first = refused[0].copy()
        first.code = NEEDS_TRUST
        first.message = f"this file needs trust to be built: {first.message}"
        first.hint = "the setting 'trust' of your editor can be 'jail'; names and keys are checked"
        kept.append(first)
    return kept


NEEDS_TRUST = UNSAFE
"""The code of the remark on a file that safe mode refuses."""


def home_of(diagnostic: Diagnostic, result: Result) -> str:
    """Return the file to show a diagnostic in: the main file for what is at no place of a file."""
    return diagnostic.span.source.path or result.main


def _moved(diagnostic: Diagnostic, text: Text | None) -> Diagnostic | None:
    """Return a diagnostic of an earlier text at its place in the text of now; None if it is gone.

    Nothing is known of the stretch that has changed since.
    """
    span = diagnostic.span
    if text is None or not span.source.path or span.source.text == text.text:
        return diagnostic
    if span.source.path != text.path:
        return diagnostic
    shift = Move(span.source.text, text.text).shift(span.start, span.end)
    if shift is None:
        return None
    copy = diagnostic.copy()
    copy.span = Span(text.source, span.start + shift, span.end + shift)
    copy.fix = None
    edits = []
    for edit in diagnostic.fix.edits if diagnostic.fix is not None else ():
        moved = Span(text.source, edit.span.start + shift, edit.span.end + shift)
        if moved.written() != edit.span.written():
            return copy  # there is something else now
        edits.append(Edit(moved, edit.text))
    if diagnostic.fix is not None:
        copy.fix = Fix(diagnostic.fix.title, edits, is_safe=diagnostic.fix.is_safe)
    return copy


class Publisher:
    """Knows what the editor shows, so that what is gone is cleared there."""

    def __init__(self, workspace: Workspace) -> None:
        """Begin with nothing shown."""
        self._workspace = workspace
        self._shown: set[str] = set()

    def message(self, path: str) -> Json | None:
        """Return the notification with the diagnostics of a file; None if nothing is to be sent."""
        workspace = self._workspace
        found = diagnostics_of(workspace, path)
        opened = workspace.open.get(path)
        if not found and opened is None and path not in self._shown:
            return None
        (self._shown.add if found else self._shown.discard)(path)
        parameters: Json = {
            "uri": workspace.uri(path),
            "diagnostics": [diagnostic_json(workspace, each, path) for each in found],
        }
        if opened is not None and opened.version is not None:
            parameters["version"] = opened.version
        return {"method": "textDocument/publishDiagnostics", "params": parameters}

    def shown(self) -> list[str]:
        """Return the files that the editor shows diagnostics of."""
        return sorted(self._shown)


def diagnostic_json(workspace: Workspace, diagnostic: Diagnostic, path: str) -> Json:
    """Return a diagnostic as the protocol has it."""
    span = diagnostic.span
    if not span.source.path:
        span = Span(Source("", name=path, path=path), 0, 0)
    severity = _ERROR if diagnostic.severity == ERROR else _WARNING
    if diagnostic.code == NEEDS_TRUST and diagnostic.message.startswith("this file needs trust"):
        severity = _INFORMATION
    lines = [diagnostic.message]
    if diagnostic.hint:
        lines.append(f"hint: {diagnostic.hint}")
    lines += [f"note: {note}" for note in diagnostic.notes[:20] if not _PLACED.match(note)]
    result: Json = {
        "range": workspace.range(span),
        "severity": severity,
        "code": diagnostic.code,
        "source": "yamaro",
        "message": "\n".join(lines),
    }
    described = help_uri(diagnostic.code)
    if described is not None:
        result["codeDescription"] = {"href": described}
    related = []
    for note in diagnostic.notes[:20]:
        place = _PLACED.match(note)
        if place is not None:
            position = {"line": int(place[3]) - 1, "character": int(place[4]) - 1}
            path = place[2]
            if path == diagnostic.span.source.name:
                path = diagnostic.span.source.path
            related.append(
                {
                    "location": {
                        "uri": workspace.uri(path),
                        "range": {"start": position, "end": position},
                    },
                    "message": place[1],
                }
            )
    frame = diagnostic.trace
    lines = trace_lines(diagnostic.trace)
    while frame is not None and len(related) < min(len(lines) + 20, 40):
        if frame.span.source.path:
            location = workspace.location(frame.span)
            related.append({"location": location, "message": f"{frame.kind}: {frame.name}"})
        frame = frame.parent
    if related:
        result["relatedInformation"] = related
    tag = _TAGS.get(diagnostic.code)
    if tag is not None:
        result["tags"] = [tag]
    return result
