"""Statements in their short heads: `if length > 1:`, `for i in range(6):` and `Leg(side, y=0):`."""

from __future__ import annotations

from ...syntax.names import STATEMENTS, is_identifier
from ...yaml.brackets import find_close
from .document import WIDTH, Body, Entry, Row, joined, spaced
from .scalars import is_plain

_IN_HEADS = frozenset(("condition", "iterator", "range", "in", "input", "body"))
"""Keys that have another meaning, or are an error, directly below a short head."""


def with_short_head(
    entry: Entry, width: int, *, is_function: bool = False, following: Entry | None = None
) -> Entry:
    """Return a statement with a short head, or the entry itself where it cannot have one.

    A head that YAML would want in quotes stays in the long form, as does one that is too wide.

    Args:
        entry: a key with its value.
        width: how many characters the line has before the key.
        is_function: whether the entry is a function that is defined.
        following: the entry after it.
    """
    statement = entry.value
    if not isinstance(statement, Body) or statement.remark:
        return entry
    *parts, inner = statement.entries or [Entry("")]
    if inner.key != "body" or inner.comment or inner.ending or isinstance(inner.value, str):
        return entry
    head = _signature(entry.key, parts) if is_function else _head(entry.key, parts)
    if not head or not is_plain(head, in_flow=False) or width + len(head) + 1 > WIDTH:
        return entry
    content = Body(inner.value or ())
    if any(own.key in _IN_HEADS for own in content):
        return entry
    if inner.value is not None:
        content.remark = inner.value.remark
        content.opening = spaced(statement.opening, inner.value.opening)
    is_last = following is None or following.key not in ("elif", "else")
    content.in_braces = entry.key == "if" and is_last and _is_brief(content)
    comments = [part.comment for part in parts]
    short = Entry(head, content or None, joined(entry.comment, *comments))
    short.ending = spaced(entry.ending, *(part.ending for part in parts))
    return short


def _is_brief(content: Body) -> bool:
    """Return whether a body is one short element or call, which may be on the line of the head."""
    entries = content.entries
    if len(entries) != 1 or not is_identifier(entries[0].key) or entries[0].key in STATEMENTS:
        return False
    value = entries[0].value
    return value.in_braces if isinstance(value, Body) else value is not None


def _head(word: str, parts: list[Entry]) -> str:
    """Return the short head of a condition or a loop, or an empty text if it has none."""
    keys = [part.key for part in parts]
    texts = [part.value for part in parts if isinstance(part.value, str) and "$" not in part.value]
    if len(texts) < len(parts) or not all(texts):
        return ""
    if word in ("if", "elif") and keys == ["condition"]:
        return f"{word} {texts[0]}"
    if word == "for" and keys == ["iterator", "in"]:
        return f"for {texts[0]} in {texts[1]}"
    return ""


def _signature(name: str, parts: list[Entry]) -> str:
    """Return the name of a function with its parameters, or an empty text if that cannot be."""
    name, slash, scope = name.partition("/")
    if not parts:
        return f"{name}(){slash}{scope}"
    if [part.key for part in parts] != ["input"] or not isinstance(parts[0].value, Row):
        return ""
    head = f"{name}({parts[0].value})"
    is_closed = find_close(head, len(name) + 1) == len(head) - 1  # not inside of quotes
    return f"{head}{slash}{scope}" if is_closed else ""
