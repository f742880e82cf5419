"""Numbers in a part: reading rows of them in every form, with each number's spelling kept."""

from __future__ import annotations

from math import isfinite

from ..diagnostics import YamaroError, failure
from ..model.schema import ELEMENTS, MOMENTS
from ..model.shapes import SIMPLE_SHAPES
from ..source import Span
from ..xml.values import (
    LONGEST_ROW_REMEMBERED,
    LiteralList,
    Numbers,
    format_number,
    format_value,
    is_number,
    plain_value,
    remember,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame
    from .fields import Record
    from .lowering import Lowering

NEGLIGIBLE = 1e-12
"""Components of a pose below this, in metres or radians, become 0."""

DECIMALS = 13
"""Decimals of a computed component of a pose: with π/2 cut to 15 digits, 0.75 stays 0.75."""

MAX_SHOWN = 40
"""Characters of a value shown in a message."""


def format_component(value: float) -> str:
    """Return a computed component of a pose as text, without the digits that are only rounding."""
    return "0" if abs(value) < NEGLIGIBLE else format_number(round(value, DECIMALS))


def negated(word: str) -> str:
    """Return a number with the other sign, in its spelling; a zero as it is."""
    if float(word) == 0:
        return word
    if word.startswith("-"):
        return word[1:]
    return "-" + word.removeprefix("+")


def read_numbers(
    lowering: Lowering,
    value: object,
    span: Span,
    *,
    count: int,
    name: str,
    trace: Frame | None,
    kind: str | None = None,
) -> Numbers:
    """Return `count` numbers in SI from a text, a list, or what an expression gave.

    Args:
        lowering: the run.
        value: `1.0 0 0`, `1.0, 0, 0`, `1.0 0 350mm`, a number, or a list, tuple or array of
            numbers.
        span: where the value is written.
        count: how many numbers it takes.
        name: what takes them, for messages: a key, or what `layout_of` knows.
        trace: the calls and includes that led here.
        kind: what the numbers are: a word of the tables in `quantities.py`, which also say it for
            the keys of parts; by default plain numbers, which take no unit.

    Raises:
        YamaroError: a word, NaN, an infinity, a wrong count, or a unit that does not fit.
    """
    if type(value) is str:
        numbers = _numbers_of(lowering, value)
        if numbers is None and name == "axis":
            numbers = _axis(value)
        if numbers is None:
            from .quantities import read_quantities

            numbers = read_quantities(
                lowering, value, span, is_one=count == 1, name=name, kind=kind, trace=trace
            )
    else:
        numbers = _read_object(lowering, value, span, name=name, kind=kind, trace=trace)
    if len(numbers.words) != count:
        raise _wrong_count(span, numbers.words, count=count, name=name, trace=trace)
    return numbers


def read_attribute(
    lowering: Lowering,
    record: Record,
    attribute: str,
    *,
    count: int,
    name: str,
    kind: str | None = None,
) -> Numbers:
    """Return the numbers that an attribute has; see `read_numbers`.

    Where it is written is only found out where it matters, which spares most runs the search.
    """
    value = record.values[attribute]
    numbers = _numbers_of(lowering, value) if type(value) is str else None
    if numbers is not None and len(numbers.words) == count:
        return numbers
    span, trace = record.span(attribute), record.key.trace
    return read_numbers(lowering, value, span, count=count, name=name, trace=trace, kind=kind)


def _numbers_of(lowering: Lowering, text: str) -> Numbers | None:
    """Return the numbers in a text, or None where a word is not a finite number."""
    numbers = lowering.numbers.get(text)
    if numbers is None:
        numbers = _read(text)
        if numbers is not None and len(text) <= LONGEST_ROW_REMEMBERED:
            remember(lowering.numbers, text, numbers)
    return numbers


def _read(text: str) -> Numbers | None:
    words = split_row(text)
    if text.isascii() and "_" not in text:  # as nearly always: Python reads the rest alike
        try:
            values = tuple(map(float, words))
        except ValueError:
            pass
        else:
            return Numbers(tuple(words), values, values) if all(map(isfinite, values)) else None
    read = [value for word in words if (value := parse_number(word)) is not None]
    if len(read) < len(words) or not all(map(isfinite, read)):
        return None
    spelled = [str(int(word, 0)) if word[1:2] in ("x", "o") else word for word in words]
    return Numbers(tuple(spelled), tuple(read), tuple(read))


def _axis(text: str) -> Numbers | None:
    """Return the axis that a word names, `z` or `-y`, or None."""
    sign, name = ("-", text[1:]) if text[:1] == "-" else ("", text)
    if name not in ("x", "y", "z"):
        return None
    words = tuple(f"{sign}1" if axis == name else "0" for axis in "xyz")
    return Numbers.spelled(words)


def split_row(text: str) -> list[str]:
    """Return the words of a row of numbers."""
    return text.replace(",", " ").split()


def parse_number(word: str) -> float | None:
    """Return the value of a number as YAML 1.2 spells it, or None for a word."""
    if not word.isascii() or "_" in word:
        return None
    try:
        return float(word)
    except ValueError:
        pass
    try:
        if word[:2] in ("0x", "0o"):
            return float(int(word, 0))
    except (ValueError, OverflowError):
        return None
    if word.lstrip("+-").lower() in (".inf", ".nan"):
        return float("nan")
    return None


def _read_object(
    lowering: Lowering,
    value: object,
    span: Span,
    *,
    name: str,
    kind: str | None,
    trace: Frame | None,
) -> Numbers:
    if type(value) is float and value - value == 0:
        return Numbers((format_number(value),), (value,))
    plain = plain_value(value)
    items = plain if isinstance(plain, (list, tuple, range)) else (plain,)
    is_literal = isinstance(value, LiteralList)
    words: list[str] = []
    values: list[float] = []
    for item in items:
        if type(item) is str:
            place = _item_place(item, span) if is_literal else span
            numbers = _numbers_of(lowering, item)
            if numbers is None:
                from .quantities import read_quantities

                numbers = read_quantities(
                    lowering, item, place, is_one=True, name=name, kind=kind, trace=trace
                )
            if not numbers.words:
                raise bad_word(item, place, name, trace)
            words += numbers.words
            values += numbers.values
            continue
        number = _as_float(item)
        if number is None or number - number != 0:
            raise _bad_item(item, number, span, name, trace)
        plain = plain_value(item)
        words.append(format_value(plain) if is_number(plain) else format_number(number))
        values.append(number)
    return Numbers(tuple(words), tuple(values))


def _as_float(item: object) -> float | None:
    """Return a number of any type as a float; None for all else, booleans included."""
    plain = plain_value(item)
    if isinstance(plain, bool) or not hasattr(plain, "__float__"):
        return None
    try:
        return float(plain)
    except OverflowError:
        return float("inf")
    except (TypeError, ValueError):
        return None


# --- errors -----------------------------------------------------------------------------------


def layout_of(name: str) -> str:
    """Return what the numbers of a key are, for hints: "x y z, in metres"; "" for others."""
    origin = ELEMENTS["origin"].fields
    xyz, rpy, rgba = origin["xyz"], origin["rpy"], ELEMENTS["color"].fields["rgba"]
    kind = name.removeprefix("scale of a ")
    if name != kind and kind in SIMPLE_SHAPES:
        sizes = SIMPLE_SHAPES[kind].sizes
        return f"{' '.join(sizes) if len(sizes) > 1 else f'its {sizes[0]}'}, in metres"
    return {
        "xyz": f"{xyz.parts}, in metres",
        "rpy": f"{rpy.parts}, in radians",
        "quat": "w x y z, a quaternion",
        "pivot": f"{xyz.parts}, in metres",
        "axis": ELEMENTS["axis"].fields["xyz"].parts,
        "rgba": f"{rgba.parts}, each from 0 to 1",
        "inertia": f"{' '.join(MOMENTS)}, in kg·m²",
        "size of a box": f"{ELEMENTS['box'].fields['size'].parts}, in metres",
        "scale of a mesh": "a factor for x, y and z, or one for all",
    }.get(name, "")


def _shown(item: object) -> str:
    text = "None" if item is None else format_value(item)
    return text if len(text) <= MAX_SHOWN else text[: MAX_SHOWN - 1] + "…"


def bad_word(word: str, span: Span, name: str, trace: Frame | None) -> YamaroError:
    """Return the error of a word that is not a finite number."""
    value = parse_number(word)
    if value is not None and value - value != 0:
        return _not_finite(word, span, name, trace)
    return failure(
        "bad-number",
        f"'{word}' in {label_of(name)} is not a number",
        span,
        hint=_word_hint(word, name, span),
        trace=trace,
    )


def _bad_item(
    item: object, number: float | None, span: Span, name: str, trace: Frame | None
) -> YamaroError:
    """Return the error of what an expression or a list gave that is neither a text nor a number."""
    if number is not None:
        return _not_finite(_shown(item), span, name, trace)
    is_list = isinstance(item, (list, tuple))
    word = "a list within a list" if is_list else f"'{_shown(item)}'"
    return failure(
        "bad-number",
        f"{word} in {label_of(name)} is not a number",
        span,
        hint=_general_hint(name),
        trace=trace,
    )


def _not_finite(word: str, span: Span, name: str, trace: Frame | None) -> YamaroError:
    return failure(
        "bad-number",
        f"'{word}' in {label_of(name)} is not a finite number",
        span,
        hint="URDF parsers reject NaN and infinities; write a number",
        trace=trace,
    )


def _general_hint(name: str) -> str:
    return f"{label_of(name)} takes {layout_of(name) or 'a number, such as 1.0'}"


def _word_hint(word: str, name: str, span: Span) -> str:
    if name == "rgba":
        return "write red green blue alpha, each from 0 to 1: 0.8 0.1 0.1 1"
    if name == "axis":
        return "write x, y, z, -x, -y or -z, or three numbers"
    is_computed = word not in span.written()
    is_name = word.isidentifier() and word.lower() not in ("none", "true", "false", "null")
    if is_name and not is_computed:
        return f"to use a variable or an expression, write $({word})"
    if word.endswith("°") and parse_number(word[:-1]) is not None:
        return f"write {word[:-1]}deg"
    if any(sign in word for sign in "*/()") or word.strip("0123456789.+-") == "":
        return f"write an expression in $(…): $({word})"
    return _general_hint(name)


def label_of(name: str) -> str:
    """Return what takes numbers as messages call it."""
    return f"the {name}" if " " in name else f"'{name}'"


def _wrong_count(
    span: Span, words: tuple[str, ...], *, count: int, name: str, trace: Frame | None
) -> YamaroError:
    given = len(words)
    plural = "number" if count == 1 else "numbers"
    verb = "is" if given == 1 else "are"
    layout = layout_of(name)
    hint = f"write {layout}" if layout else None
    if name == "rgba" and given == 3:
        hint = f"add the opacity: {' '.join(words)} 1"
    return failure(
        "wrong-count",
        f"{label_of(name)} takes {count} {plural}, but {given or 'none'} {verb} given",
        span,
        hint=hint,
        trace=trace,
    )


def place_of_word(span: Span, words: list[str], index: int) -> Span:
    """Return where word number `index` stands, if the span covers the words as they are written."""
    written = span.written()
    # The first line of a block scalar is its header: `|-`.
    at = max(written.find("\n"), 0) if written[:1] in ("|", ">") else 0
    for number, word in enumerate(words):
        while at < len(written) and written[at] in " \t\r\n,'\"":
            at += 1
        if not written.startswith(word, at):
            return span
        if number == index:
            return Span(span.source, span.start + at, span.start + at + len(word))
        at += len(word)
    return span


def _item_place(item: str, span: Span) -> Span:
    """Return where an item of a list stands, if it occurs in the list just once."""
    written = span.written()
    if not item or written.count(item) != 1:
        return span
    start = span.start + written.index(item)
    return Span(span.source, start, start + len(item))
