"""What a text means: a number, a truth value, or a text in quotes."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_TRUTHS = {"true": True, "True": True, "false": False, "False": False}


def guess_value(value: Any) -> Any:
    """Return what a property or parameter is when its value is this text; else, it stays as it is.

    Quotes around all of the text are taken off, and keep it a text. Python takes `1_000` for a
    number; here, it is a text.
    """
    if not isinstance(value, str):
        return value
    if len(value) > 1 and value[0] == value[-1] == "'":
        return value[1:-1]
    if "_" in value or not value:
        return value
    if value in _TRUTHS:
        return _TRUTHS[value]
    try:
        return int(value)
    except ValueError:
        pass
    try:
        return float(value)
    except ValueError:
        return value


def truth(value: Any) -> bool:
    """Return whether a condition holds.

    Raises:
        ValueError: it is a text that is neither a truth value nor a whole number.
    """
    if not isinstance(value, str):
        return bool(value)
    known = _TRUTHS.get(value)
    return bool(int(value)) if known is None else known


def is_property_name(name: str) -> bool:
    """Return whether an expression can use a name."""
    from keyword import iskeyword
    from unicodedata import normalize

    if not name.isidentifier() or iskeyword(name):
        return False
    return name.isascii() or normalize("NFKC", name) == name
