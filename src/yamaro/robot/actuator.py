"""`actuator` in a joint: what drives it, with the armature and the gains that its motor gives.

All numbers are those of the joint, except for the inertia of the rotor, which a gear of ratio n
multiplies by n²: R. Featherstone, Rigid Body Dynamics Algorithms, section 9.6. A joint with nothing
but its armature A, driven with kp = A·ω² and kd = 2·ζ·A·ω, is an oscillator of the natural
frequency ω and the damping ratio ζ.
"""

from __future__ import annotations

from math import isfinite, tau

from ..diagnostics import YamaroError, failure, given_twice, unknown_word
from ..model.joint import PRISMATIC
from ..model.schema import ACTUATOR, COMMANDS, OF_MOTOR
from ..motors import MOTORS, spelled
from ..xml.tree import Element, RobotNote, Text
from ..xml.values import LiteralList, Numbers, format_value
from .extras import read_field
from .fields import empty_value, read_value, word_of
from .notes import (
    armature_of,
    chosen,
    entries_of,
    given_once,
    names_in,
    refuse_attributes,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.tree import Node
    from .lowering import Lowering

    Values = dict[str, tuple[Numbers, Span]]

MOTOR = "motor"
"""The entry with what is known of the motor: a name, or a mapping of some of the same entries."""
ALTERNATIVES = (
    (("armature",), ("rotor_inertia",)),
    (("kp", "kd"), ("frequency", "damping_ratio")),
)
"""Entries that say the same in two ways."""
LIMITS = {"effort": "stall_torque", "velocity": "no_load_speed"}
"""What a limit of a joint is taken from that it does not give itself."""


def lower_actuator(lowering: Lowering, word: Element, joint: Element, out: list[Node]) -> None:
    """Append the note of an actuator in a joint; record what is wrong."""
    try:
        out.append(_actuator(lowering, word, joint))
    except YamaroError as error:
        lowering.absorb(error)


def changed_actuator(
    lowering: Lowering, word: Element, joint: Element, before: RobotNote | None
) -> RobotNote:
    """Return the note of an actuator that an overlay gives to a joint, or changes.

    Args:
        lowering: the run.
        word: the entries that are given.
        joint: the joint.
        before: the note of the actuator that is there; its values count where none is given.

    Raises:
        YamaroError: an entry is faulty, or says what another one says.
    """
    return _actuator(lowering, word, joint, before)


def limits_of_motor(lowering: Lowering, word: Element) -> Values:
    """Return the greatest effort and velocity of what drives a joint, as far as they are known.

    An actuator with a fault has none; `lower_actuator` reports it.
    """
    try:
        values = _values(lowering, given_once(word, ACTUATOR.fields))
    except YamaroError:
        return {}
    return {name: values[source] for name, source in LIMITS.items() if source in values}


def _actuator(
    lowering: Lowering, word: Element, joint: Element, before: RobotNote | None = None
) -> RobotNote:
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
    if before is not None:
        for name in ("joint", "command", "commands", MOTOR):
            if name in before.attributes:
                note.attributes[name] = before.attributes[name]
                places[name] = before.value_span(name)
    command = keys.get("command")
    if command is not None:
        places["command"] = read_value(command)[1]
        # The commands that an actuator takes, of which the first is the usual one.
        names = names_in(command)
        if not names:
            raise empty_value(command)
        for number, (name, span) in enumerate(names):
            chosen(name, span, command, COMMANDS)
            if name in [earlier for earlier, _ in names[:number]]:
                raise failure(
                    "given-twice",
                    f"the command '{name}' is given twice",
                    span,
                    hint="remove one of the two",
                    trace=command.trace,
                )
        commands = [name for name, _ in names]
        note.attributes.pop("commands", None)
        note.attributes["command"] = commands[0]
        if len(commands) > 1:
            note.attributes["commands"] = " ".join(commands)
    values = _values(lowering, keys)
    if before is not None:
        values = {**_left_of(before, values), **values}
    known = _name_in(keys.get(MOTOR))
    if known is not None:
        note.attributes[MOTOR] = spelled(format_value(known.value))
        places[MOTOR] = known.span
    # Add the armature that the inertia of the rotor is, seen through the gear.
    if "rotor_inertia" in values:
        numbers, span = values["rotor_inertia"]
        gear = values["gear"][0].values[0] if "gear" in values else 1.0
        values["armature"] = _computed(numbers.values[0] * gear * gear, span, word), span
    armature = values["armature"][0] if "armature" in values else armature_of(joint)
    _add_gains(values, word, armature, is_velocity=note.attributes["command"] == COMMANDS[1])
    for name, (numbers, span) in values.items():
        note.attributes[name], places[name] = numbers, span
    return note


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


# --- entries of the actuator and of its motor ---------------------------------------------------


def _values(lowering: Lowering, keys: dict[str, Element]) -> Values:
    """Return the numbers that an actuator gives, and those of its motor that it does not give.

    Raises:
        YamaroError: an entry is faulty, or says what another one says.
    """
    own = _read(lowering, keys)
    motor = keys.get(MOTOR)
    if motor is None:
        return own
    refuse_attributes(motor)
    known = _name_in(motor)
    if known is not None:
        entries = _entries_of_known(lowering, motor, known)
    else:
        entries = entries_of(motor, f"{MOTOR}: {{gear: 50, armature: 0.01}}")
    motor = motor.with_children([*entries])
    for key in entries:
        if key.name in ACTUATOR.fields.keys() - {*OF_MOTOR, MOTOR}:
            raise failure(
                "misplaced-key",
                f"'{key.name}' is not a property of a motor",
                key.span,
                hint=f"write '{key.name}' in 'actuator', beside '{MOTOR}'",
                trace=motor.trace,
            )
    found = _read(lowering, given_once(motor, OF_MOTOR))
    for pair in ALTERNATIVES:
        for given, ignored in (pair, pair[::-1]):
            if not own.keys().isdisjoint(given):
                for name in ignored:
                    found.pop(name, None)
    return {**found, **own}


def _name_in(motor: Element | None) -> Text | None:
    """Return the text that names a motor; None for a mapping, a dict, or what is neither."""
    children = motor.children if motor is not None else []
    if len(children) == 1 and isinstance(children[0], Text):
        value = children[0].value
        return None if isinstance(value, (dict, list, tuple, LiteralList)) else children[0]
    return None


def _entries_of_known(lowering: Lowering, motor: Element, name: Text) -> list[Element]:
    """Return the entries of a motor of the catalogue, all of them at the place of its name."""
    word = word_of(MOTOR, name.value, name.span, owner=motor)
    known = MOTORS.get(spelled(word))
    if known is None:
        raise unknown_word(
            "unknown-motor",
            f"there is no motor '{word}' in the catalogue",
            name.span,
            spelled(word),
            MOTORS,
            hint=f"write what you know of it: {MOTOR}: {{rotor_inertia: …, gear: …}}, "
            "or a motor of the catalogue, such as xm430_w350",
            trace=motor.trace,
            near=next((each for each in MOTORS if each.startswith(spelled(word) + "_")), None),
        )
    if lowering.joint_type == PRISMATIC:
        raise failure(
            "unknown-motor",
            f"the motor '{word}' turns, and this joint slides",
            name.span,
            hint=f"write {MOTOR}: {{rotor_inertia: …, gear: …}} with the gear in radians per "
            "metre, forces and speeds",
            trace=motor.trace,
        )
    return [
        Element(each, name.span, {}, [Text(value, name.span)], motor.trace)
        for each, value in known.items()
    ]


def _read(lowering: Lowering, keys: dict[str, Element]) -> Values:
    values: Values = {}
    for name, key in keys.items():
        if name not in ("command", MOTOR):
            numbers, values_span = read_field(lowering, ACTUATOR.fields[name], key)
            assert isinstance(numbers, Numbers), "all but the command are numbers"
            values[name] = numbers, values_span
    for one, other in ALTERNATIVES:
        first = next((name for name in keys if name in one), None)
        second = next((name for name in keys if name in other), None)
        if first is not None and second is not None:
            earlier, later = sorted((first, second), key=[*keys].index)
            what = "the armature is" if first == "armature" else "the gains are"
            raise given_twice(
                f"{what} given twice: by '{earlier}', and by '{later}'",
                keys[later].span,
                keys[earlier].span,
                trace=keys[later].trace,
            )
    return values


def _left_of(before: RobotNote, given: Values) -> Values:
    """Return the numbers of an actuator that stay when others are given.

    What follows from the others is computed again; what says the same in another way gives way.
    """
    left: Values = {}
    for name in ACTUATOR.fields:
        value = before.attributes.get(name)
        if value is not None and name not in ("command", MOTOR):
            number = (
                value if isinstance(value, Numbers) else Numbers.spelled((format_value(value),))
            )
            left[name] = number, before.value_span(name)
    has_frequency = not given.keys().isdisjoint(ALTERNATIVES[1][1])
    if not given.keys().isdisjoint(ALTERNATIVES[0][0]):
        left.pop("rotor_inertia", None)
    elif "rotor_inertia" in given or ("gear" in given and "rotor_inertia" in left):
        left.pop("armature", None)
    if not given.keys().isdisjoint(ALTERNATIVES[1][0]):
        for name in ALTERNATIVES[1][1]:
            left.pop(name, None)
    elif has_frequency or "frequency" in left:
        left.pop("kp", None)
        left.pop("kd", None)
    return left


# --- what follows from them ---------------------------------------------------------------------


def _add_gains(
    values: Values, word: Element, armature: Numbers | None, *, is_velocity: bool
) -> None:
    """Add the gains that a frequency and a damping ratio mean; only that of velocity, if so."""
    if "frequency" not in values:
        if "damping_ratio" in values:
            raise failure(
                "missing-key",
                "'damping_ratio' has no meaning without 'frequency'",
                values["damping_ratio"][1],
                hint="write frequency: 10 Hz beside it, or kp and kd in place of both",
                trace=word.trace,
            )
        return
    frequency, span = values["frequency"]
    inertia = 0.0 if armature is None else armature.values[0]
    if not inertia:
        raise failure(
            "missing-key",
            "'frequency' gives the gains of an armature, and this actuator has none",
            span,
            hint="write armature: 0.01, or rotor_inertia: 1e-5 and gear: 50",
            trace=word.trace,
        )
    ratio, place = values.get("damping_ratio", (None, span))
    zeta = 1.0 if ratio is None else ratio.values[0]
    omega = tau * frequency.values[0]
    if not is_velocity:
        values["kp"] = _computed(inertia * omega * omega, span, word), span
    values["kd"] = _computed(2 * zeta * inertia * omega, span, word), place


def _computed(value: float, span: Span, word: Element) -> Numbers:
    """Return a computed number; raise YamaroError for one that is too large to be one."""
    if isfinite(value):
        return Numbers.of(value)
    raise failure(
        "bad-number",
        "the computed armature or gain is too large for a number",
        span,
        hint="check the units: inertia is in kg·m², and a frequency in Hz",
        trace=word.trace,
    )
