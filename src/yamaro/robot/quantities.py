"""Numbers with units in a part: `350mm 0 1in`, `20 N*m`; which dimension each key takes.

Loaded for the first text that is not a row of plain numbers.
"""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, suggest
from ..model.joint import TURNING
from ..model.quantities import BY_JOINT, DIMENSIONS
from ..model.schema import ELEMENTS
from ..model.shapes import SIMPLE_SHAPES
from ..source import Span
from ..units import (
    ANGLE,
    LENGTH,
    NUMBER,
    UNITS,
    UnknownUnit,
    fits,
    in_python,
    meant_by,
    name_of,
    parse_quantity,
    parse_unit,
    plural_of,
    si_of,
    units_of,
)
from ..xml.values import LONGEST_ROW_REMEMBERED, Numbers, format_value, remember
from .numbers import bad_word, label_of, parse_number, place_of_word, split_row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame
    from ..units import Dimension
    from .lowering import Lowering

KINDS = {
    **{
        name: field.kind
        for thing in ELEMENTS.values()
        for name, field in thing.fields.items()
        if field.kind != "number" and name != "size"
    },
    **dict.fromkeys(("pivot", "size of a box"), "length"),
    **{f"scale of a {shape}": "length" for shape in SIMPLE_SHAPES},
    **{name: name for name in ("mass", "density", "inertia")},
}
"""The kind of the numbers of a key; those of any other key are plain numbers."""

ANY_POSITION = "position of a joint"
"""The kind of a position in a joint whose type is not known yet."""
_NAMES_IN_PYTHON = ("pi", "tau", "e")


class Wanted:
    """What the numbers of a key are.

    Attributes:
        dimensions: those that fit; None if all do, as where the joint's type is missing.
        taker: what takes them, in words.
    """

    __slots__ = ("dimensions", "taker")

    def __init__(self, lowering: Lowering, name: str, kind: str | None) -> None:
        """Find out what a key takes, in the joint that is being lowered."""
        kind = kind or KINDS.get(name, "number")
        self.taker = label_of(name)
        self.dimensions: tuple[Dimension, ...] | None
        if kind == ANY_POSITION:
            self.dimensions = (ANGLE, LENGTH)
            return
        if kind not in BY_JOINT:
            self.dimensions = (DIMENSIONS[kind],)
            return
        joint_type = lowering.joint_type
        lowering.is_bound_to_joint = True
        turning, sliding = BY_JOINT[kind]
        if joint_type is None:
            self.dimensions = None
            return
        self.taker += f" of a {joint_type} joint"
        if joint_type in TURNING:
            self.dimensions = turning
        elif joint_type == "prismatic":
            self.dimensions = sliding
        elif joint_type == "fixed":  # in place of any other, for a moment
            self.dimensions = turning + sliding
        else:
            self.dimensions = (NUMBER,)

    def takes(self, dimension: Dimension) -> bool:
        """Return whether a quantity of a dimension fits."""
        if self.dimensions is None:
            return True
        return any(fits(dimension, wanted) for wanted in self.dimensions)


def read_quantities(
    lowering: Lowering,
    text: str,
    span: Span,
    *,
    is_one: bool,
    name: str,
    kind: str | None,
    trace: Frame | None,
) -> Numbers:
    """Return the numbers in a text that is not a row of plain numbers, in SI.

    Args:
        lowering: the run.
        text: `350mm 0 1in`; or `20 N*m`, where one number is expected.
        span: where the text is written.
        is_one: whether one number is expected.
        name: what takes the numbers, for messages.
        kind: what they are, of DIMENSIONS or BY_JOINT; by default what KINDS says of the name.
        trace: the calls and includes that led here.

    Raises:
        YamaroError: a word that is not a number, or a unit that is not known or does not fit.
    """
    wanted = Wanted(lowering, name, kind)
    known = lowering.quantities.get((text, wanted.dimensions))
    if known is not None and not is_one:  # in a row, a space is a fault
        return known
    words = split_row(text)
    row = [text.strip()] if is_one and len(words) == 2 and _is_quantity(text) else words
    values: list[float] = []
    spelled: list[str] = []
    for index, word in enumerate(row):
        number = parse_number(word)
        if number is not None and number - number == 0:
            values.append(number)
            spelled.append(str(int(word, 0)) if word[1:2] in ("x", "o") else word)
            continue
        place = span if len(row) < len(words) else place_of_word(span, words, index)
        before = row[index - 1] if index else ""
        if _is_unit(word) and parse_number(before) is not None:
            raise _unit_in_row(before, word, place, name, trace)
        value = _value(wanted, word, place, name, trace)
        values.append(value)
        spelled.append(format_value(value))
    numbers = Numbers(tuple(spelled), tuple(values))
    if len(text) <= LONGEST_ROW_REMEMBERED and not is_one:
        remember(lowering.quantities, (text, wanted.dimensions), numbers)
    return numbers


def _is_quantity(text: str) -> bool:
    """Return whether a text is one number with a unit, known or not, on one line."""
    if "\n" in text.strip():
        return False
    try:
        return parse_quantity(text)[1] is not None
    except (UnknownUnit, OverflowError):
        return True
    except ValueError:
        return False


def _is_unit(word: str) -> bool:
    try:
        parse_unit(word)
    except ValueError:
        return False
    return True


def _value(wanted: Wanted, word: str, place: Span, name: str, trace: Frame | None) -> float:
    """Return the value of a number with a unit."""
    is_plain = parse_number(word) is not None or word[:2] in ("0x", "0o")
    try:
        value, dimension = parse_quantity("" if is_plain else word)
    except UnknownUnit as fault:
        raise _unknown_unit(wanted, word, fault, place, trace) from None
    except OverflowError:
        raise failure(
            "bad-number",
            f"'{word}' in {label_of(name)} is too large for a number",
            place,
            trace=trace,
        ) from None
    except ValueError:
        error = bad_word(word, place, name, trace)
        once = in_python(word[: (word + word).find(word, 1)])
        if once is not None:  # `reach * 2`, where `reach` is a text
            hint = f"a text with a unit was multiplied: to compute with it, declare $({once})"
            error.diagnostics[0].hint = hint
        raise error from None
    assert dimension is not None, "all that is plain has been read"
    if not wanted.takes(dimension):
        raise _wrong_dimension(wanted, word, dimension, place, trace)
    return value


# --- errors -----------------------------------------------------------------------------------


def _unit_in_row(
    number: str, unit: str, place: Span, name: str, trace: Frame | None
) -> YamaroError:
    from ..fixes import replacement

    is_there = place.written().split() == [number, unit]
    return failure(
        "unit-in-row",
        f"the unit '{unit}' in {label_of(name)} is apart from its number",
        place,
        hint=f"write {number}{unit}",
        trace=trace,
        fix=replacement(place, f"{number}{unit}", is_safe=True) if is_there else None,
    )


def _unknown_unit(
    wanted: Wanted, word: str, fault: UnknownUnit, place: Span, trace: Frame | None
) -> YamaroError:
    fitting = [unit for each in wanted.dimensions or () for unit in units_of(each)]
    from ..fixes import respelling

    meant = meant_by(fault.unit)
    if fault.unit in _NAMES_IN_PYTHON:
        number = word[: fault.start].strip()
        hint = f"an expression is written as $(…): $({number} * {fault.unit})"
    elif meant is not None:
        hint = f"write {meant}"
    else:
        meant = suggest(fault.unit, fitting) or suggest(fault.unit, UNITS)
        hint = (
            (f"did you mean '{meant}'?" if meant else None)
            or _units_hint(wanted.dimensions or ())
            or f"units are {', '.join(UNITS)}"
        )
    return failure(
        "unknown-unit",
        f"'{fault.unit}' is not a unit",
        _within(place, word, fault.start, fault.start + len(fault.unit)),
        hint=hint,
        trace=trace,
        fix=respelling(place, fault.unit, meant, is_safe=True),
    )


def _wrong_dimension(
    wanted: Wanted, word: str, dimension: Dimension, place: Span, trace: Frame | None
) -> YamaroError:
    unit = word.lstrip("+-.0123456789")
    if unit[:1] in ("e", "E") and unit[1:2] in tuple("+-0123456789"):
        unit = unit[2:].lstrip("0123456789")
    unit = unit.strip()
    dimensions = wanted.dimensions or ()
    takes = " or ".join(dict.fromkeys(map(_plural, dimensions)))
    is_named = not name_of(dimension).startswith("in ")
    what = f"is {name_of(dimension)};" if is_named else "does not fit:"
    hint = _units_hint(dimensions) or "leave the unit out"
    if wanted.taker == "the scale of a mesh" and NUMBER in dimensions:
        hint = f"write {word} alone, for x, y and z"
    return failure(
        "unit-dimension",
        f"'{unit}' {what} {wanted.taker} takes {takes}",
        _within(place, word, len(word) - len(unit), len(word)),
        hint=hint,
        trace=trace,
    )


def _units_hint(dimensions: tuple[Dimension, ...]) -> str | None:
    """Return which units fit, or None where none does."""
    units = [unit for each in dimensions if each != NUMBER for unit in _units_for(each)]
    if len(units) == 1:
        return f"write it in {units[0]}"
    return f"units are {', '.join(units)}" if units else None


def _units_for(dimension: Dimension) -> list[str]:
    """Return the units of the table that fit, and the one of SI if it is not among them."""
    listed = units_of(dimension)
    if any(UNITS[unit].is_si for unit in listed):
        return listed
    return [*listed, si_of(dimension)]


def _plural(dimension: Dimension) -> str:
    return "plain numbers" if dimension == NUMBER else plural_of(dimension)


def _within(place: Span, word: str, start: int, end: int) -> Span:
    """Return the place of `word[start:end]`, if `word` is what is written at the place."""
    if place.written() != word:
        return place
    return Span(place.source, place.start + start, place.start + end)
