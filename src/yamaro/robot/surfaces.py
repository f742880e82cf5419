"""Lowers `surface`: a note of how a collision touches others."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..model.schema import PART, SURFACE
from ..xml.values import format_value
from .entries import given_once
from .fields import read_value
from .notes import RobotNote, refuse_attributes
from .numbers import read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.tree import Element, Node
    from .lowering import Lowering


def lower_surfaces(
    lowering: Lowering, surfaces: list[tuple[Element, int]], link: str, out: list[Node]
) -> None:
    """Append a note for each collision of a link that has a surface; record what is wrong."""
    numbers: set[int] = set()
    for word, number in surfaces:
        try:
            if number in numbers:
                raise failure(
                    "given-twice",
                    "'surface' is given twice in this collision",
                    word.span,
                    hint="remove one of the two",
                    trace=word.trace,
                )
            numbers.add(number)
            out.append(_read(lowering, word, link, number))
        except YamaroError as error:
            lowering.absorb(error)


def _read(lowering: Lowering, word: Element, link: str, number: int) -> RobotNote:
    refuse_attributes(word)
    keys = given_once(word, SURFACE.fields)
    note = RobotNote(
        "surface", word.span, {"link": link, "index": str(number)}, trace=lowering.trace
    )
    places: dict[str, Span] = {}
    note.value_spans = places
    for key in keys.values():
        field = SURFACE.fields[key.name]
        value, span = read_value(key)
        row = read_numbers(
            lowering,
            value,
            span,
            count=1,
            name=key.name,
            trace=word.trace,
            kind=field.kind,
        )
        if row.values[0] < 0 or (field.sign == PART and row.values[0] > 1):
            raise failure(
                "bad-number",
                f"'{key.name}' takes a number {PART if field.sign == PART else 'from 0'}, "
                f"and this is {format_value(row.values[0])}",
                span,
                hint=f"write {key.name}: {field.example}",
                trace=word.trace,
            )
        note.attributes[key.name] = row.text
        places[key.name] = span
    return note
