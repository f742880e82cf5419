"""Lowers `sensor`: a note of what it is, and in a link the frame that it looks from."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..model.schema import JOINT_SENSORS, LINK_SENSORS, TEXT, WHOLE
from ..model.schema import SENSOR as ANY_SENSOR
from ..model.sensors import CAMERAS
from ..xml.tree import Element
from ..xml.values import format_value
from .entries import given_once
from .fields import read_value, sort_fields, word_of
from .frames import frame_elements, name_of_word
from .notes import RobotNote
from .numbers import Numbers, read_numbers
from .places import POSE_ROWS, SENSOR
from .pose import ZERO_ROW, Pose, read_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..model.schema import Field, Thing
    from ..xml.tree import Node
    from .lowering import Lowering

OPTICAL = "_optical"
"""What follows a camera's name in the name of its optical frame."""
OPTICAL_RPY = "-1.5707963267949 0 -1.5707963267949"
"""From a camera's frame, x forward, to its optical frame, z forward and y down. Source: REP 103."""


def lower_link_sensor(
    lowering: Lowering, word: Element, link: str, out: list[Node], *, is_empty: bool
) -> None:
    """Append a sensor in a link, and the frame of its name; record what is wrong.

    Args:
        lowering: the run.
        word: the `sensor` key.
        link: the name of the link.
        out: where the elements and the note go.
        is_empty: whether the link holds nothing but sensors, so that it can be the frame itself.
    """
    try:
        note, keys = _read(lowering, word, LINK_SENSORS)
        note.attributes["link"] = link
        name = str(note.attributes["name"])
        frame = keys.get("frame")
        if frame is not None:
            _refuse_pose(keys, "'frame' names a frame that is there")
            note.attributes["frame"] = word_of("frame", *read_value(frame), owner=word)
            lowering.references.append((note, "frame"))
        elif is_empty and not any(key in keys for key in POSE_ROWS):
            note.attributes["frame"] = link
        else:
            pose = read_pose(lowering, sort_fields(lowering, word, SENSOR))
            note.attributes["frame"] = name
            out += frame_elements(lowering, word, name, link, pose)
        if note.attributes["type"] in CAMERAS:
            out += _optical_frame(lowering, word, name, str(note.attributes["frame"]))
    except YamaroError as error:
        lowering.absorb(error)
        return
    out.append(note)


def lower_joint_sensor(lowering: Lowering, word: Element, joint: str, out: list[Node]) -> None:
    """Append the note of a sensor in a joint; record what is wrong."""
    try:
        note, keys = _read(lowering, word, JOINT_SENSORS)
        _refuse_pose(keys, "a sensor in a joint measures at the joint")
    except YamaroError as error:
        lowering.absorb(error)
        return
    note.attributes["joint"] = joint
    out.append(note)


def _optical_frame(lowering: Lowering, word: Element, name: str, frame: str) -> list[Node]:
    turned = Element("frame", word.span, {"name": f"{name}{OPTICAL}"}, trace=word.trace)
    turned.value_spans = {"name": word.value_span("name")}
    words = tuple(OPTICAL_RPY.split())
    pose = Pose(ZERO_ROW, Numbers(words, tuple(map(float, words))), None, {})
    return frame_elements(lowering, turned, f"{name}{OPTICAL}", frame, pose)


# --- its keys ---------------------------------------------------------------------------------


def _read(
    lowering: Lowering, word: Element, types: Mapping[str, Thing]
) -> tuple[RobotNote, dict[str, Element]]:
    """Return the note of a sensor, and its keys.

    Raises:
        YamaroError: a key or the type is unknown, or a value is faulty.
    """
    name = name_of_word(word, "imu")
    keys = given_once(word)
    kind = _kind(word, keys, types)
    _check_keys(keys, kind, types)
    note = RobotNote(
        "sensor",
        word.span,
        {"name": name, "type": kind},
        trace=lowering.trace,
    )
    note.value_spans = places = {"name": word.value_span("name")}
    fields = {**ANY_SENSOR.fields, **types[kind].fields}
    del fields["type"]
    for key_name, key in keys.items():
        field = fields.get(key_name)
        if field is not None:
            note.attributes[key_name] = _value(lowering, field, key)
        if key_name not in POSE_ROWS:
            places[key_name] = read_value(key)[1]
    return note, keys


def _kind(word: Element, keys: dict[str, Element], types: Mapping[str, Thing]) -> str:
    key = keys.get("type")
    if key is None:
        raise failure(
            "missing-type",
            "this sensor has no 'type'",
            word.span,
            hint=f"its types are {', '.join(types)}; <sensor/…>: is an XML element",
            trace=word.trace,
        )
    value, span = read_value(key)
    kind = word_of("type", value, span, owner=word)
    if kind in types:
        return kind
    other = JOINT_SENSORS if types is LINK_SENSORS else LINK_SENSORS
    home = "joint" if other is JOINT_SENSORS else "link"
    from ..suggestions import meant_word

    hint, fix = (None, None) if kind in other else meant_word(kind, types, span)
    raise failure(
        "unknown-sensor-type",
        f"'{kind}' is a sensor of a {home}"
        if kind in other
        else f"'{kind}' is not a type of sensor",
        span,
        hint=f"move the sensor into the {home} of a part"
        if kind in other
        else hint or f"the types are {', '.join(types)}",
        trace=word.trace,
        fix=fix,
    )


def _check_keys(keys: dict[str, Element], kind: str, types: Mapping[str, Thing]) -> None:
    own, common = types[kind].fields, ANY_SENSOR.fields
    known = (*common, *POSE_ROWS, "frame", *own)
    for name, key in keys.items():
        if name in known:
            continue
        others = [other for other, thing in types.items() if name in thing.fields]
        from ..suggestions import meant_word

        hint, fix = (None, None) if others else meant_word(name, known, key.span)
        raise failure(
            "sensor-key" if others else "unknown-key",
            f"'{name}' is for {' and '.join(others)}, and this is {kind}"
            if others
            else f"'{name}' is not an entry of a sensor",
            key.span,
            hint=f"{kind} takes {', '.join(own or [*common][1:])}"
            if others
            else hint or f"{kind} takes {', '.join(known)}",
            trace=key.trace,
            fix=fix,
        )


def _refuse_pose(keys: dict[str, Element], reason: str) -> None:
    for name in POSE_ROWS:
        if name in keys:
            raise failure(
                "misplaced-key",
                f"{reason}, so '{name}' has no meaning",
                keys[name].span,
                hint=f"remove '{name}'",
                trace=keys[name].trace,
            )


def _value(lowering: Lowering, field: Field, key: Element) -> str:
    """Return the value of a field as text."""
    value, span = read_value(key)
    if field.count == TEXT:
        return word_of(field.name, value, span, owner=key)
    numbers = read_numbers(
        lowering,
        value,
        span,
        count=field.count,
        name=field.name,
        trace=key.trace,
        kind=field.kind,
    )
    is_whole = field.sign == WHOLE
    for number in numbers.values:
        if number < 0 or (is_whole and (number < 1 or number != int(number))):
            raise failure(
                "bad-number",
                f"'{field.name}' takes {'whole ' if is_whole else ''}numbers "
                f"{'from 1' if is_whole else 'from 0'}, and this is {format_value(number)}",
                span,
                hint=f"write {field.name}: {field.example}",
                trace=key.trace,
            )
    return numbers.text
