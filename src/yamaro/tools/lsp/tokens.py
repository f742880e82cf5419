"""Semantic tokens: what the words of a file are, for colours that a grammar cannot know."""

from __future__ import annotations

from .names import ARGUMENT, BLOCK_NAME, CALLED, IMPORTED, ITERATOR, NAMESPACE, PARAMETER
from .positions import width
from .token_types import TYPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Span
    from .texts import Text
    from .wire import Json
    from .workspace import Workspace

_VARIABLE, _PARAMETER, _FUNCTION, _NAMESPACE, _CLASS = range(len(TYPES))
_DECLARES = 1
_KINDS = {
    PARAMETER: _PARAMETER,
    BLOCK_NAME: _PARAMETER,
    ITERATOR: _PARAMETER,
    ARGUMENT: _PARAMETER,
    NAMESPACE: _NAMESPACE,
    IMPORTED: _NAMESPACE,
}


def answer(workspace: Workspace, parameters: Json) -> Json:
    """Return the tokens of a file, each relative to the one before."""
    text = workspace.text_at(parameters)
    data: list[int] = []
    last_line = last_column = 0
    for span, kind, modifiers in _tokens(text) if text.is_yaml else ():
        start = workspace.position(text, span.start)
        line, column = start["line"], start["character"]
        written = text.text[span.start : span.end]
        if "\n" in written or not written:
            continue
        if line != last_line:
            last_column = 0
        length = width(written, workspace.encoding)
        data += [line - last_line, column - last_column, length, kind, modifiers]
        last_line, last_column = line, column
    return {"data": data}


def _tokens(text: Text) -> list[tuple[Span, int, int]]:
    """Return the tokens in order; none overlaps another."""
    names = text.names
    parameters = {
        each.name for each in names.declarations if each.kind in (PARAMETER, ITERATOR, ARGUMENT)
    }
    found: dict[int, tuple[Span, int, int]] = {}
    for declared in names.declarations:
        kind = _FUNCTION if declared.kind in CALLED else _KINDS.get(declared.kind, _VARIABLE)
        found[declared.span.start] = (declared.span, kind, _DECLARES)
    for use in names.uses:
        kind = _FUNCTION if use.is_called else _VARIABLE
        if use.name in parameters and not use.is_called:
            kind = _PARAMETER
        found.setdefault(use.span.start, (use.span, kind, 0))
    for part in text.parts.named:
        if part.name is not None:
            found.setdefault(part.span.start, (part.span, _CLASS, _DECLARES))
    for reference in text.parts.references:
        if not reference.is_computed:
            found.setdefault(reference.span.start, (reference.span, _CLASS, 0))
    kept = []
    end = 0
    for _, token in sorted(found.items(), key=lambda item: item[0]):
        if token[0].start >= end:
            kept.append(token)
            end = token[0].end
    return kept
