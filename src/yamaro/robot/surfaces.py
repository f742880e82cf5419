"""Lowers `surface`: a note of how a collision touches others."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
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

KEYS = {
    "friction": "number",
    "friction2": "number",
    "restitution": "number",
    "stiffness": "contact stiffness",
    "damping": "contact damping",
}
"""The keys, each with what its number is; friction in two directions."""
_EXAMPLES = {"restitution": "0.5", "stiffness": "100000", "damping": "10"}


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
    keys = given_once(word, tuple(KEYS))
    note = RobotNote(
        "surface", word.span, {"link": link, "index": str(number)}, trace=lowering.trace
    )
    places: dict[str, Span] = {}
    note.value_spans = places
    for key in keys.values():
        value, span = read_value(key)
        row = read_numbers(
            lowering,
            value,
            span,
            count=1,
            name=key.name,
            trace=word.trace,
            kind=KEYS[key.name],
        )
        most = 1.0 if key.name == "restitution" else None
        if row.values[0] < 0 or (most is not None and row.values[0] > most):
            raise failure(
                "bad-number",
                f"'{key.name}' takes a number {'from 0 to 1' if most else 'from 0'}, "
                f"and this is {format_value(row.values[0])}",
                span,
                hint=f"write {key.name}: {_EXAMPLES.get(key.name, '0.8')}",
                trace=word.trace,
            )
        note.attributes[key.name] = row.text
        places[key.name] = span
    return note
