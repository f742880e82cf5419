"""The characters that YAML forbids, and those that only some of its readers allow."""

from __future__ import annotations

from ..diagnostics import failure
from ..source import Source, Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

_NULS_OF_A_TEXT = 4
_MARK = "\ufeff"
_OTHER_BREAKS = {"\x85": "\\N", "\u2028": "\\L", "\u2029": "\\P"}


def refuse_characters(source: Source) -> None:
    """Raise YamaroError if the text holds a character that YAML forbids."""
    text = source.text
    if text.isascii():
        # The control characters are the only ASCII that YAML forbids, and libyaml names them.
        for char in "\x00\x7f":
            if char in text:
                _refuse_character(source, text.index(char))
        return
    if _MARK in text:
        from ..fixes import Edit, Fix

        at = text.index(_MARK)
        place = Span(source, at, at + 1)
        raise failure(
            "misplaced-bom",
            "a byte order mark (U+FEFF) is inside the text",
            place,
            hint="delete this invisible character; it often comes from pasting files together",
            fix=Fix("delete the byte order mark", [Edit(place, "")], is_safe=True),
        )
    places = [text.find(char) for char in "\ufffe\uffff\x00\x7f"]
    try:
        text.encode()
    except UnicodeEncodeError as error:  # a lone surrogate
        places.append(error.start)
    found = [at for at in places if at >= 0]
    if found:
        _refuse_character(source, min(found))
    breaks = [at for char in _OTHER_BREAKS if (at := text.find(char)) >= 0]
    if breaks:
        _refuse_break(source, min(breaks))


def _refuse_break(source: Source, at: int) -> NoReturn:
    """Refuse what ends a line, a comment too, for YAML 1.1 but not for YAML 1.2 and editors."""
    char = source.text[at]
    raise failure(
        "control-character",
        f"the character U+{ord(char):04X} ends a line for some YAML parsers",
        Span(source, at, at + 1),
        hint=f'delete this invisible character; in a text write "{_OTHER_BREAKS[char]}" for it',
    )


def _refuse_character(source: Source, at: int) -> NoReturn:
    raise failure(
        "control-character",
        f"the character U+{ord(source.text[at]):04X} is not allowed in a YAML file",
        Span(source, at, at + 1),
        hint="delete this invisible character"
        if not is_binary(source.text)
        else "this file contains many of them and is probably not a text file",
    )


def is_binary(text: str) -> bool:
    """Return whether what should be a text has too many NULs to be one."""
    return text.count("\x00") >= _NULS_OF_A_TEXT


def first_control_character(text: str) -> int:
    """Return where the first control character is that libyaml refuses, or the text's length."""
    for at, char in enumerate(text):
        if char < " " and char not in "\t\n\r":
            return at
        if "\x7f" <= char <= "\x9f" and char != "\x85":
            return at
    return len(text)
