"""What values and numbers of things are called in messages."""

from __future__ import annotations

from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


def count(number: int, noun: str) -> str:
    """Return a number of things, in words for a message."""
    return f"{'no' if number == 0 else number} {noun}{'' if number == 1 else 's'}"


def a_kind_of(value: Any) -> str:
    """Return what a value is, in words for a message."""
    if value is None:
        return "empty (null)"
    if isinstance(value, bool):
        return f"the boolean {'true' if value else 'false'}"
    if isinstance(value, (int, float)):
        return f"the number {format_value(value)}"
    if isinstance(value, str):
        return f"the text '{value[:40]}'"
    if callable(value):  # in safe mode, functions and types have types of their own
        return "a function"
    name = type(value).__name__
    if name in ("ndarray", "Array"):  # numpy's, and its substitute in safe mode
        return "an array"
    return f"{'an' if name[0] in 'AEIOUaeiou' else 'a'} {name}"
