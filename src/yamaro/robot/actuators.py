"""Lowers `actuator`: a note of what drives a joint."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..model.schema import ACTUATOR, COMMANDS, NOT_ZERO
from ..xml.values import format_value
from .entries import chosen, given_once
from .fields import empty_value, read_value
from .notes import RobotNote, names_in, refuse_attributes
from .numbers import read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.schema import Field
    from ..source import Span
    from ..xml.tree import Element, Node
    from .lowering import Lowering


def lower_actuator(lowering: Lowering, word: Element, joint: Element, out: list[Node]) -> None:
    """Append the note of an actuator in a joint; record what is wrong."""
    try:
        out.append(_read(lowering, word, joint))
    except YamaroError as error:
        lowering.absorb(error)


def _read(lowering: Lowering, word: Element, joint: Element) -> RobotNote:
    refuse_attributes(word)
    keys = given_once(word, ACTUATOR.fields)
    _check_joint(word, joint)
    lowering.joint_type = format_value(joint.attributes.get("type"))
    note = RobotNote(
        "actuator",
        word.span,
        {"joint": format_value(joint.attributes.get("name")), "command": "position"},
        trace=lowering.trace,
    )
    places: dict[str, Span] = {}
    note.value_spans = places
    for key in keys.values():
        value, span = read_value(key)
        places[key.name] = span
        if key.name == "command":
            commands = _commands(key)
            note.attributes["command"] = commands[0]
            if len(commands) > 1:
                note.attributes["commands"] = " ".join(commands)
        else:
            field = ACTUATOR.fields[key.name]
            numbers = read_numbers(
                lowering, value, span, count=1, name=key.name, trace=key.trace, kind=field.kind
            )
            _check_number(field, key, numbers.values[0], span)
            note.attributes[key.name] = numbers.text
    return note


def _check_number(field: Field, key: Element, number: float, span: Span) -> None:
    """Raise YamaroError for a negative gain or inertia, and for a gear that does not turn."""
    if number > 0 or (number == 0) != (field.sign == NOT_ZERO):
        return
    raise failure(
        "bad-number",
        "'gear' is not 0: it is how often the motor turns for one turn of the joint"
        if field.sign == NOT_ZERO
        else f"'{key.name}' takes a number from 0, and this is {format_value(number)}",
        span,
        hint=f"write {key.name}: {field.example}",
        trace=key.trace,
    )


def _commands(key: Element) -> list[str]:
    """Return the commands that an actuator takes, of which the first is the usual one."""
    names = names_in(key)
    if not names:
        raise empty_value(key)
    for number, (name, span) in enumerate(names):
        chosen(name, span, key, COMMANDS)
        if name in [earlier for earlier, _ in names[:number]]:
            raise failure(
                "given-twice",
                f"the command '{name}' is given twice",
                span,
                hint="remove one of the two",
                trace=key.trace,
            )
    return [name for name, _ in names]


def _check_joint(word: Element, joint: Element) -> None:
    """Raise YamaroError for a joint that cannot be driven independently."""
    if joint.attributes.get("type") == "fixed":
        raise failure(
            "actuator-on-fixed",
            "this joint is fixed, so there is nothing to drive",
            word.span,
            hint="remove 'actuator', or give the joint another type",
            trace=word.trace,
        )
    if any(child.name == "mimic" for child in joint.elements()):
        raise failure(
            "actuator-on-mimic",
            "this joint follows another, which is the one to drive",
            word.span,
            hint="move 'actuator' to the joint that it follows",
            trace=word.trace,
        )
