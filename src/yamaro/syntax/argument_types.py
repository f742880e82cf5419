"""The types of arguments: reads a value as an argument's type, and checks it.

Numbers without a unit are in the argument's `unit`, those that an expression gives are in SI; what
comes out is in SI.
"""

from __future__ import annotations

from ..diagnostics import InputFault, did_you_mean
from ..units import UnknownUnit, fits, name_of, parse_quantity, plural_of, units_of
from ..xml.values import format_value, is_number, plain_value
from ..yaml.nodes import type_plain

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..units import Dimension, Unit
    from .nodes import Value

NUMBER, INTEGER, TEXT, BOOLEAN = "number", "integer", "text", "boolean"
LIST, MAPPING, PATH = "list", "mapping", "path"
TYPES = (NUMBER, INTEGER, TEXT, BOOLEAN, LIST, MAPPING, PATH)
ANY = "any"
"""The type of an argument that takes whatever is passed; it cannot be written."""
NUMERIC = (NUMBER, INTEGER)

_WANTED = {
    NUMBER: "a number",
    INTEGER: "an integer",
    TEXT: "a text",
    BOOLEAN: "true or false",
    LIST: "a list",
    MAPPING: "a mapping",
    PATH: "a path",
}
_EXAMPLES = {
    LIST: "write [a, b], or one item per line after a dash",
    MAPPING: "write {name: value}",
    BOOLEAN: "write true or false",
}
LONGEST_SHOWN = 40
"""Characters of a value that a message shows."""
MOST_SHOWN = 8
"""Choices that a message lists."""


class ArgumentEntry:
    """An argument that a file declares.

    Attributes:
        name: as expressions know it.
        kind: one of `TYPES`, or `ANY`.
        default: the value without an argument; None if the argument is required.
        is_null_allowed: whether the argument may be null, because its default is.
        unit: the unit of numbers without one; None for SI.
        unit_text: the unit as it is written.
        choices: the values allowed, in SI, or None for any.
        low: the least number, in SI, or None.
        high: the greatest one.
        step: by how much a slider changes the number, in SI, or None.
        is_log: whether a slider is logarithmic.
        help: what the argument is for.
    """

    __slots__ = (
        "choices", "default", "help", "high", "is_log", "is_null_allowed", "kind", "low", "name",
        "span", "step", "unit", "unit_text",
    )  # fmt: skip

    def __init__(self, name: str, span: Span) -> None:
        """Declare a required argument of any value."""
        self.name = name
        self.span = span
        self.kind = ANY
        self.default: Value | None = None
        self.is_null_allowed = False
        self.unit: Unit | None = None
        self.unit_text = ""
        self.choices: list[object] | None = None
        self.low: float | None = None
        self.high: float | None = None
        self.step: float | None = None
        self.is_log = False
        self.help = ""

    def in_unit(self, number: float) -> float:
        """Return a number in SI as one in the argument's unit, to 15 digits."""
        if self.unit is None or self.unit.is_si:
            return number
        value = float(f"{self.unit.from_si(number):.15g}")
        return int(value) if value.is_integer() and abs(value) < 1e15 else value

    def range_text(self) -> str:
        """Return the range in words: "from 0.3 to 1.3 m"."""
        unit = f" {self.unit_text}" if self.unit_text else ""
        low = "" if self.low is None else format_value(self.in_unit(self.low))
        high = "" if self.high is None else format_value(self.in_unit(self.high))
        if not high:
            return f"of at least {low}{unit}" if low else ""
        return f"from {low} to {high}{unit}" if low else f"of at most {high}{unit}"

    def choice_texts(self) -> list[str]:
        """Return the choices as they are written on the command line."""
        return [self.value_text(choice) for choice in self.choices or ()]

    def value_text(self, value: object) -> str:
        """Return a plain value in SI as it is written on the command line, in the unit."""
        if value is None:
            return "null"
        if self.kind in NUMERIC and isinstance(value, (int, float)):
            return format_value(self.in_unit(value))
        if isinstance(value, (list, tuple)):
            return f"[{', '.join(map(self.value_text, value))}]"
        if isinstance(value, dict):
            pairs = (f"{format_value(key)}: {self.value_text(each)}" for key, each in value.items())
            return f"{{{', '.join(pairs)}}}"
        return format_value(value)


def checked(
    entry: ArgumentEntry, value: object, *, spelling: str | None = None, is_si: bool = False
) -> object:
    """Return a value as the argument has it, in SI.

    Args:
        entry: the argument.
        value: what is passed.
        spelling: how it is written, if it is a scalar that was written for this argument.
        is_si: a number without a unit is in SI, since an expression gave it.

    Raises:
        InputFault: the argument does not take it.
    """
    value = plain_value(value)
    if value is None and entry.is_null_allowed:
        return None
    read = _READERS.get(entry.kind)
    if read is not None:
        value = read(entry, value, spelling, is_si)
    _check_range(entry, value)
    _check_choice(entry, value)
    return value


def quantity(entry: ArgumentEntry, value: object, *, is_si: bool = False) -> float:
    """Return a number, or a text that reads as one, in SI.

    Raises:
        InputFault: it is neither, or its unit does not fit the argument.
    """
    number, dimension = _number_of(entry, value)
    unit = entry.unit
    if dimension is not None:
        if unit is not None and not fits(dimension, unit.dimension):
            raise InputFault(
                "unit-dimension",
                f"'{_shown(value)}' is {name_of(dimension)}; '{entry.name}' takes "
                f"{plural_of(unit.dimension)}",
                f"write it in {entry.unit_text}",
            )
        return number
    if unit is None or is_si:
        return number
    try:
        return unit.to_si(number)
    except OverflowError:
        raise _wrong_type(entry, value) from None


def same_value(one: object, other: object) -> bool:
    """Return whether two values are the same choice; numbers are compared to 15 digits."""
    if isinstance(one, bool) or isinstance(other, bool):
        return one is other
    if is_number(one) and is_number(other):
        return _rounded(one) == _rounded(other)
    return type(one) is type(other) and one == other


def _number_of(entry: ArgumentEntry, value: object) -> tuple[float, Dimension | None]:
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        if isinstance(value, float) and value - value != 0:
            raise _wrong_type(entry, value, "a finite number")
        return value, None
    if not isinstance(value, str):
        raise _wrong_type(entry, value)
    try:
        return parse_quantity(value)
    except UnknownUnit as fault:
        wanted = units_of(entry.unit.dimension) if entry.unit is not None else None
        raise unknown_unit(fault.unit, wanted) from None
    except (ValueError, OverflowError):
        raise _wrong_type(entry, value) from None


def unknown_unit(word: str, wanted: list[str] | None = None) -> InputFault:
    """Return the fault of a unit that is not known; `wanted` are those that would fit."""
    from ..units import UNITS

    hint = did_you_mean(word, wanted or UNITS) or did_you_mean(word, UNITS)
    listed = ", ".join(wanted or UNITS)
    return InputFault("unknown-unit", f"'{word}' is not a unit", hint or f"units are {listed}")


# --- one reader for each type -----------------------------------------------------------------


def _read_number(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    return quantity(entry, value, is_si=is_si)


def _read_integer(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    try:
        number, dimension = _number_of(entry, value)
    except InputFault as fault:
        raise (_wrong_type(entry, value) if fault.code == "unknown-unit" else fault) from None
    if dimension is not None or number != int(number):
        raise _wrong_type(entry, value)
    return int(number)


def _read_text(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if isinstance(value, str):
        return value
    if spelling is not None:
        return spelling
    if not isinstance(value, (bool, int, float)):
        raise _wrong_type(entry, value)
    try:
        return format_value(value)
    except ValueError:  # an integer of thousands of digits
        raise _wrong_type(entry, value) from None


def _read_boolean(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if not isinstance(value, bool):
        raise _wrong_type(entry, value)
    return value


def _read_list(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if not isinstance(value, (list, tuple)):
        raise _wrong_type(entry, value)
    return value


def _read_mapping(entry: ArgumentEntry, value: object, spelling: str | None, is_si: bool) -> object:
    if not isinstance(value, dict):
        raise _wrong_type(entry, value)
    return value


_READERS = {
    NUMBER: _read_number,
    INTEGER: _read_integer,
    TEXT: _read_text,
    BOOLEAN: _read_boolean,
    LIST: _read_list,
    MAPPING: _read_mapping,
    PATH: _read_text,
}


# --- ranges and choices -----------------------------------------------------------------------


def _check_range(entry: ArgumentEntry, value: object) -> None:
    if entry.low is None and entry.high is None:
        return
    assert isinstance(value, (int, float)), "only numbers have a range"
    number = _rounded(value)
    is_below = entry.low is not None and number < _rounded(entry.low)
    is_above = entry.high is not None and number > _rounded(entry.high)
    if is_below or is_above:
        raise InputFault(
            "argument-range",
            f"'{entry.name}' takes {_wanted(entry)}, not {_in_words(entry, value)}",
        )


def _check_choice(entry: ArgumentEntry, value: object) -> None:
    if entry.choices is None or any(same_value(value, choice) for choice in entry.choices):
        return
    texts = entry.choice_texts()
    raise InputFault(
        "argument-choice",
        f"'{entry.name}' takes {_one_of(texts)}, not {_in_words(entry, value)}",
        did_you_mean(value, texts) if isinstance(value, str) else None,
    )


def _one_of(texts: list[str]) -> str:
    if len(texts) > MOST_SHOWN:
        return f"one of {', '.join(texts[:MOST_SHOWN])}, …"
    return f"{', '.join(texts[:-1])} or {texts[-1]}" if len(texts) > 1 else texts[0]


def _rounded(number: object) -> float:
    """Return a number to 15 digits, as it is written; so 0.1 + 0.2 is 0.3."""
    if isinstance(number, float):
        return float(f"{number:.15g}")
    assert isinstance(number, int)
    return number


# --- words ------------------------------------------------------------------------------------


def _wrong_type(entry: ArgumentEntry, value: object, wanted: str | None = None) -> InputFault:
    hint = _EXAMPLES.get(entry.kind)
    if entry.kind in NUMERIC and isinstance(value, str) and is_number(_typed(value)):
        hint = None
    if entry.kind == BOOLEAN and isinstance(value, str) and value.lower() in ("yes", "no"):
        hint = f"YAML 1.2 reads '{value}' as a text; write {str(value.lower() == 'yes').lower()}"
    return InputFault(
        "argument-type",
        f"'{entry.name}' takes {wanted or _wanted(entry)}, not {in_words(value)}",
        hint,
    )


def _typed(text: str) -> object:
    try:
        return type_plain(text)
    except OverflowError:
        return text


def _wanted(entry: ArgumentEntry) -> str:
    """Return what an argument takes, in words."""
    words = _WANTED.get(entry.kind, "a value")
    bounds = entry.range_text()
    if bounds:
        return f"{words} {bounds}"
    return f"{words} in {entry.unit_text}" if entry.unit_text else words


def _in_words(entry: ArgumentEntry, value: object) -> str:
    """Return a value that has been read, in the argument's unit, in words."""
    if entry.kind == NUMBER and isinstance(value, (int, float)):
        return in_words(entry.in_unit(value))
    return in_words(value)


def in_words(value: object) -> str:
    """Return a value, or what it is, in words for a message."""
    if value is None:
        return "null"
    if isinstance(value, (bool, int, float, str)):
        text = _shown(value)
        return f"'{text}'" if isinstance(value, str) else text
    if isinstance(value, (list, tuple)):
        return "a list"
    if isinstance(value, dict):
        return "a mapping"
    return f"a value of the type {type(value).__name__}"


def _shown(value: object) -> str:
    try:
        text = format_value(value)
    except ValueError:  # an integer of thousands of digits
        return "a huge integer"
    return text if len(text) <= LONGEST_SHOWN else text[: LONGEST_SHOWN - 1] + "…"
