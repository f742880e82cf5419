"""Values as text: how numbers and other values are spelled in XML, what is escaped, what is a name.

Number formatting, value formatting and escaping happen here and nowhere else.
"""

from __future__ import annotations

from ..diagnostics import Frame, InputFault, failure
from ..source import Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any, TypeVar

    Key = TypeVar("Key")
    Value = TypeVar("Value")

MOST_REMEMBERED = 4096
"""How much of a kind is remembered at a time; what is forgotten is only worked out again."""
LONGEST_ROW_REMEMBERED = 24
"""Characters of a row of numbers worth remembering: longer ones are computed, and seldom equal."""


class LiteralList(list[object]):
    """A list written as a YAML list under an element: numbers for `part`, an error elsewhere."""

    __slots__ = ()


class Numbers:
    """A row of numbers as an attribute has it: computed, and as it is written.

    It is equal to its text, and never changes: who changes an attribute gives it another value, so
    that numbers and text cannot part.

    Attributes:
        words: the words that the numbers are written as.
        values: the numbers, as exact as they were computed.
        text: the row as it is written.
        written: the numbers as who reads the text gets them.
    """

    __slots__ = ("text", "values", "words", "written")

    written: tuple[float, ...]

    def __init__(
        self,
        words: tuple[str, ...],
        values: tuple[float, ...],
        written: tuple[float, ...] | None = None,
    ) -> None:
        """Hold as many words as values; `written` are those of the words, if they are known."""
        self.words = words
        self.values = values
        self.text = " ".join(words)
        if written is not None:
            self.written = written

    @classmethod
    def spelled(cls, words: tuple[str, ...]) -> Numbers:
        """Return the numbers of words, each of which is a finite number."""
        values = floats(words)
        return cls(words, values, values)

    @classmethod
    def exactly(cls, *values: float) -> Numbers:
        """Return numbers with all their digits."""
        return cls(tuple(map(repr, values)), values, values)

    @classmethod
    def of(cls, *values: float) -> Numbers:
        """Return computed numbers, which are written with 15 digits."""
        return cls(tuple(map(format_number, values)), values)

    if not TYPE_CHECKING:  # a type checker would accept any name

        def __getattr__(self, name: str) -> object:
            """Read the words when their numbers are first asked for."""
            if name != "written":
                raise AttributeError(name)
            self.written = floats(self.words)
            return self.written

    def one_by_one(self) -> list[Numbers]:
        """Return each of the numbers as a row of its own."""
        rows = zip(self.words, self.values, self.written, strict=True)
        return [Numbers((word,), (value,), (written,)) for word, value, written in rows]

    def is_zero(self) -> bool:
        """Return whether all the numbers are exactly 0."""
        return not any(self.values)

    def __eq__(self, other: object) -> bool:
        return self.text == (other.text if type(other) is Numbers else other)

    def __hash__(self) -> int:
        return hash(self.text)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<Numbers '{self.text}'>"


def floats(words: Iterable[str]) -> tuple[float, ...]:
    """Return the numbers that words are; raise ValueError if one of them is not a number."""
    return tuple(map(float, words))


def remember(known: dict[Key, Value], key: Key, value: Value) -> None:
    """Keep what has been worked out for when it comes again, in bounded memory."""
    if len(known) >= MOST_REMEMBERED:
        known.clear()
    known[key] = value


# --- values to text ---------------------------------------------------------------------------


DIGITS = "0123456789"


def format_number(value: float) -> str:
    """Return a float as `repr` of the value rounded to 15 significant digits; no minus zero."""
    text = f"{value:.15g}"
    if "e" not in text and text[-1] in DIGITS:
        # `repr` says the same: what has 15 digits comes through a float unchanged
        return text if "." in text else f"{text}.0" if value else "0.0"
    rounded = float(text)
    if rounded - rounded != 0:  # the largest floats have no room to be rounded up
        rounded = value
    return repr(rounded) if rounded else "0.0"


def format_value(value: Any) -> str:
    """Return the text a value has in XML: language rule "number to text"."""
    kind = type(value)
    if kind is str:
        return value  # type: ignore[no-any-return]
    if kind is float:
        return format_number(value)
    if kind is bool:
        return "true" if value else "false"
    if kind is int:
        return str(value)
    if value is None:
        return ""
    if type(value) is Numbers:
        return value.text
    plain = plain_value(value)
    if type(plain) in (str, float, bool, int):
        return format_value(plain)
    if isinstance(plain, (list, tuple)):
        items = [plain_value(item) for item in plain]
        if all(is_number(item) for item in items):
            return " ".join(format_value(item) for item in items)
    _refuse_without_text(plain)
    return str(value)


def _refuse_without_text(value: Any) -> None:
    """Raise InputFault for objects such as functions and iterators: their texts vary by chance."""
    kind: Any = type(value)
    if kind.__str__ is not object.__str__:
        return
    if callable(value):
        raise InputFault(
            "no-text", "a function cannot be converted to text", "to call it, write name(…)"
        )
    if hasattr(kind, "__next__"):
        raise InputFault(
            "no-text", "an iterator cannot be converted to text", "write list(…) around it"
        )
    if kind.__repr__ is object.__repr__:
        hint = f"give the class {kind.__name__} a __str__, or write one of its attributes"
        raise InputFault(
            "no-text", f"an object of the class {kind.__name__} cannot be converted to text", hint
        )


def plain_value(value: Any) -> Any:
    """Return a numpy scalar or array as the equal Python value, all else unchanged."""
    if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, float):
        return float(value)
    if isinstance(value, int) and not isinstance(value, bool):
        return int(value)
    if isinstance(value, str):
        return str(value)
    return value


def is_number(value: object) -> bool:
    """Return whether a value is an int or a float (booleans are not numbers here)."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


# --- escaping -----------------------------------------------------------------------------------

_TEXT_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"}
_ATTRIBUTE_ESCAPES = {
    "&": "&amp;",
    "<": "&lt;",
    ">": "&gt;",
    '"': "&quot;",
    "\t": "&#9;",
    "\n": "&#10;",
    "\r": "&#13;",
}
_TEXT_TABLE = str.maketrans(_TEXT_ESCAPES)
_ATTRIBUTE_TABLE = str.maketrans(_ATTRIBUTE_ESCAPES)


def escaped_text(text: str) -> str:
    """Return what is written for a text between tags."""
    return text.translate(_TEXT_TABLE)


def escaped_attribute(text: str) -> str:
    """Return what is written for the value of an attribute."""
    return text.translate(_ATTRIBUTE_TABLE)


def is_comment_text(text: str) -> bool:
    """Return whether a comment can hold the text (production 15, Comment)."""
    return "--" not in text and not text.endswith("-")


def is_xml_character(char: str) -> bool:
    """Return whether XML 1.0 allows the character (production 2, Char)."""
    code = ord(char)
    return (
        code in (0x9, 0xA, 0xD)
        or 0x20 <= code <= 0xD7FF
        or 0xE000 <= code <= 0xFFFD
        or code >= 0x10000
    )


def check_characters(text: str, span: Span, *, trace: Frame | None = None) -> None:
    """Raise YamaroError if the text holds a character that XML forbids."""
    if text.isprintable():
        return
    for char in text:
        if not is_xml_character(char):
            raise failure(
                "control-character",
                f"the character U+{ord(char):04X} is not allowed in XML",
                span,
                hint="remove it; XML allows only tab, line breaks and printable characters",
                trace=trace,
            )


# --- names ------------------------------------------------------------------------------------

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
