"""Which texts are names in XML."""

from __future__ import annotations

# XML 1.0 (fifth edition), productions 4 and 4a, without the ASCII range.
_NAME_STARTS = (
    (0xC0, 0xD6),
    (0xD8, 0xF6),
    (0xF8, 0x2FF),
    (0x370, 0x37D),
    (0x37F, 0x1FFF),
    (0x200C, 0x200D),
    (0x2070, 0x218F),
    (0x2C00, 0x2FEF),
    (0x3001, 0xD7FF),
    (0xF900, 0xFDCF),
    (0xFDF0, 0xFFFD),
    (0x10000, 0xEFFFF),
)
_NAME_PARTS = (*_NAME_STARTS, (0xB7, 0xB7), (0x300, 0x36F), (0x203F, 0x2040))


def bad_name_character(name: str) -> str | None:
    """Return the first character that keeps `name` from being an XML name, or None if it is one.

    The name may have one prefix (`gz:plugin`). An empty name gives an empty string.
    """
    if not name:
        return ""
    if name.isidentifier() and name.isascii():
        return None
    for index, char in enumerate(name):
        if char.isascii():
            is_start = char.isalpha() or char in "_:"
            is_part = is_start or char.isdigit() or char in "-."
        else:
            is_start = _is_in(char, _NAME_STARTS)
            is_part = is_start or _is_in(char, _NAME_PARTS)
        if not (is_part if index and name[index - 1] != ":" else is_start):
            return char
    if name[0] == ":" or name[-1] == ":" or name.count(":") > 1:
        return ":"
    return None


def _is_in(char: str, ranges: tuple[tuple[int, int], ...]) -> bool:
    code = ord(char)
    return any(low <= code <= high for low, high in ranges)
