"""Texts as YAML scalars that are read as these texts and no others."""

from __future__ import annotations

from ...yaml.nodes import type_plain
from .document import Quoted

_INDICATORS = frozenset("-?:,[]{}#&*!|>'\"%@`")
_OPENING = frozenset("-?:")
_NULLS = frozenset(("", "~", "null", "Null", "NULL"))
_FLOW = frozenset(",[]{}")


def scalar_of(text: str, *, in_flow: bool) -> str:
    """Return a text as a YAML scalar that is read as this text and none other."""
    if is_plain(text, in_flow=in_flow) and not _is_typed(text):
        return str(text)
    if text.isprintable():
        if "'" in text and '"' not in text and "\\" not in text:
            return f'"{text}"'
        return "'" + text.replace("'", "''") + "'"
    return '"' + "".join(map(_escaped, text)) + '"'


def is_plain(text: str, *, in_flow: bool) -> bool:
    """Return whether a text can be a scalar without quotes."""
    if text in _NULLS or not text.isprintable() or text != text.strip():
        return False
    first = text[0]
    if first in _INDICATORS and (first not in _OPENING or len(text) < 2 or text[1] in " ,[]{}"):
        return False
    if ": " in text or " #" in text or text.endswith(":"):
        return False
    if text.startswith(("---", "...")):
        return False
    if not in_flow:
        return True
    return _FLOW.isdisjoint(text) and not (first == "?" or first == ":")


def _is_typed(text: str) -> bool:
    return isinstance(text, Quoted) and not isinstance(type_plain(text), str)


_SHORT_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def _escaped(char: str) -> str:
    if char in _SHORT_ESCAPES:
        return _SHORT_ESCAPES[char]
    if char.isprintable():
        return char
    code = ord(char)
    if code < 0x100:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
