"""Positions of the protocol and offsets of spans: lines from 0, columns in the agreed encoding."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Source
    from .wire import Json

UTF_16, UTF_32 = "utf-16", "utf-32"
"""The encodings that columns may be counted in; UTF-32 counts characters, as spans do."""


def agreed_encoding(offered: Json) -> str:
    """Return the encoding to use with an editor that offers some, or nothing."""
    return UTF_32 if isinstance(offered, list) and UTF_32 in offered else UTF_16


def offset_at(source: Source, position: Json, encoding: str) -> int:
    """Return the offset of a position; one behind the end of a line means its end.

    Raises:
        KeyError, TypeError: it is not a position.
    """
    line, character = int(position["line"]), int(position["character"])
    starts = source.line_starts()
    if line < 0 or character < 0:
        return 0
    if line >= len(starts):
        return len(source.text)
    start = starts[line]
    text = source.line_text(line + 1)
    if encoding == UTF_16 and not text.isascii():
        character = _characters(text, character)
    return start + min(character, len(text))


def _characters(text: str, units: int) -> int:
    """Return how many characters of a text the first `units` of UTF-16 are."""
    for index, char in enumerate(text):
        if units <= 0:
            return index
        units -= 2 if char > "\uffff" else 1
    return len(text)


def position_at(source: Source, offset: int, encoding: str) -> Json:
    """Return the position of an offset."""
    offset = max(0, min(offset, len(source.text)))
    line, column = source.location(offset)
    text = source.line_text(line)
    column = min(column - 1, len(text))
    if encoding == UTF_16 and not text.isascii():
        column = width(text[:column], encoding)
    return {"line": line - 1, "character": column}


def width(text: str, encoding: str) -> int:
    """Return how many columns a text has."""
    if encoding == UTF_32 or text.isascii():
        return len(text)
    return len(text) + sum(char > "\uffff" for char in text)


def range_of(source: Source, start: int, end: int, encoding: str) -> Json:
    """Return the range of a stretch."""
    return {
        "start": position_at(source, start, encoding),
        "end": position_at(source, end, encoding),
    }
