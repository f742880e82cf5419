"""Types plain scalars by the YAML 1.2 core schema."""

from __future__ import annotations

_CONSTANTS: dict[str, bool | None] = {
    "": None,
    "~": None,
    "null": None,
    "Null": None,
    "NULL": None,
    "true": True,
    "True": True,
    "TRUE": True,
    "false": False,
    "False": False,
    "FALSE": False,
}
_SPECIAL_FLOATS = {
    sign + spelling: float(sign + "inf")
    for sign in ("", "+", "-")
    for spelling in (".inf", ".Inf", ".INF")
} | dict.fromkeys((".nan", ".NaN", ".NAN"), float("nan"))
_FLOAT_CHARACTERS = frozenset("0123456789.eE+-")
_NUMBER_STARTS = frozenset("0123456789.+-")
MAX_DIGITS = 4300


def is_null(text: str) -> bool:
    """Return whether a plain scalar is null."""
    return text in ("", "~", "null", "Null", "NULL")


def type_plain(text: str) -> object:
    """Return the value of a plain scalar: None, bool, int, float, or the text itself.

    Raises:
        OverflowError: the text is an integer of more digits than Python reads.
    """
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if text[0] not in _NUMBER_STARTS:
        return text
    return _type_number(text)


def _type_number(text: str) -> object:
    digits = text[1:] if text[0] in "+-" else text
    if digits.isdigit() and digits.isascii():
        if len(digits) > MAX_DIGITS:
            raise OverflowError(text)
        return int(text)
    if text.startswith(("0x", "0o")):
        return _type_based(text)
    if _FLOAT_CHARACTERS.issuperset(text):
        try:
            return float(text)
        except ValueError:
            return text
    return _SPECIAL_FLOATS.get(text, text)


def _type_based(text: str) -> object:
    digits = text[2:]
    base, allowed = (16, "0123456789abcdefABCDEF") if text[1] == "x" else (8, "01234567")
    if digits and all(digit in allowed for digit in digits):
        return int(digits, base)
    return text
