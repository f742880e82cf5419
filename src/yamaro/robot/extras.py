"""Words in a part that URDF has no elements for: `sensor`, `surface`, `frame`."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, unknown_word
from ..model.extras import CAMERAS, MEASURED
from ..model.schema import (
    JOINT_SENSORS,
    LINK_SENSORS,
    NOT_ZERO,
    PART,
    POSITIVE,
    SURFACE,
    TEXT,
    WHOLE,
)
from ..model.schema import SENSOR as ANY_SENSOR
from ..xml.tree import Element, RawBlock, RobotNote, Text
from ..xml.values import Numbers, format_value
from .fields import FRAME, POSE_ROWS, SENSOR, other_word, read_value, sort_fields, word_of
from .notes import check_keys, given_once, refuse_attributes, with_entries
from .numbers import read_numbers
from .pose import ZERO_ROW, Pose, origin_element, read_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..model.schema import Field, Thing
    from ..source import Span
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
        note, keys = _sensor(lowering, word, LINK_SENSORS)
        note.attributes["link"] = link
        name = str(note.attributes["name"])
        frame = keys.get("frame")
        if frame is not None:
            note.attributes["frame"] = word_of("frame", *read_value(frame), owner=word)
            lowering.references.append((note, "frame"))
            if any(key in keys for key in POSE_ROWS):
                pose = read_pose(lowering, sort_fields(lowering, word, SENSOR))
                note.attributes |= {"xyz": pose.xyz, "rpy": pose.rpy}
                if note.attributes["type"] in CAMERAS:
                    note.attributes["optical_frame"] = ""
                out.append(note)
                return
        elif is_empty and not any(key in keys for key in POSE_ROWS):
            note.attributes["frame"] = link
        else:
            pose = read_pose(lowering, sort_fields(lowering, word, SENSOR))
            note.attributes["frame"] = name
            out += frame_elements(lowering, word, name, link, pose)
        if note.attributes["type"] in CAMERAS:
            around = str(note.attributes["frame"])
            turned = Element("frame", word.span, {"name": f"{name}{OPTICAL}"}, trace=word.trace)
            turned.value_spans = {"name": word.value_span("name")}
            pose = Pose(ZERO_ROW, Numbers.spelled(tuple(OPTICAL_RPY.split())), None, {})
            out += frame_elements(lowering, turned, f"{name}{OPTICAL}", around, pose)
    except YamaroError as error:
        lowering.absorb(error)
        return
    out.append(note)


def lower_joint_sensor(lowering: Lowering, word: Element, joint: str, out: list[Node]) -> None:
    """Append the note of a sensor in a joint; record what is wrong."""
    try:
        note, keys = _sensor(lowering, word, JOINT_SENSORS)
        for name in POSE_ROWS:
            if name in keys:
                raise failure(
                    "misplaced-key",
                    f"a sensor in a joint measures at the joint, so '{name}' has no meaning",
                    keys[name].span,
                    hint=f"remove '{name}'",
                    trace=keys[name].trace,
                )
    except YamaroError as error:
        lowering.absorb(error)
        return
    note.attributes["joint"] = joint
    out.append(note)


# --- the keys of a sensor ---------------------------------------------------------------------


def _sensor(
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
    note = RobotNote("sensor", word.span, {"name": name, "type": kind}, trace=lowering.trace)
    note.value_spans = places = {"name": word.value_span("name")}
    fields = {**ANY_SENSOR.fields, **types[kind].fields}
    del fields["type"]
    for key_name, key in keys.items():
        field = fields.get(key_name)
        if key_name == "noise" and key.elements():
            note.attributes["noises"] = _noises(lowering, key, kind)
            places["noises"] = key.span
            continue
        if field is not None:
            note.attributes[key_name] = read_field(lowering, field, key, noun="numbers")[0]
        if key_name not in POSE_ROWS:
            places[key_name] = read_value(key)[1]
    return note, keys


def _noises(lowering: Lowering, key: Element, kind: str) -> str:
    """Return the noise of each quantity that a sensor measures.

    Raises:
        YamaroError: it does not measure one, or a value is faulty.
    """
    measured = MEASURED.get(kind)
    if measured is None:
        raise failure(
            "bad-number",
            f"a sensor of the type {kind} has one noise",
            key.span,
            hint="write noise: 0.01",
            trace=key.trace,
        )
    field = ANY_SENSOR.fields["noise"]
    rows = [
        f"{each.name} {format_value(read_field(lowering, field, each)[0])}"
        for each in given_once(key, measured).values()
    ]
    return " ".join(rows)


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
    if kind in other:
        raise failure(
            "unknown-sensor-type",
            f"'{kind}' is a sensor of a {home}",
            span,
            hint=f"move the sensor into the {home} of a part",
            trace=word.trace,
        )
    raise unknown_word(
        "unknown-sensor-type",
        f"'{kind}' is not a type of sensor",
        span,
        kind,
        types,
        hint=f"the types are {', '.join(types)}",
        trace=word.trace,
    )


def _check_keys(keys: dict[str, Element], kind: str, types: Mapping[str, Thing]) -> None:
    own, common = types[kind].fields, ANY_SENSOR.fields
    known = (*common, *POSE_ROWS, "frame", *own)
    found = []
    for name, key in keys.items():
        if name in known:
            continue
        others = [other for other, thing in types.items() if name in thing.fields]
        error = (
            failure(
                "sensor-key",
                f"'{name}' is for {' and '.join(others)}, and this is {kind}",
                key.span,
                hint=f"{kind} takes {', '.join(own or [*common][1:])}",
                trace=key.trace,
            )
            if others
            else unknown_word(
                "unknown-key",
                f"'{name}' is not an entry of a sensor",
                key.span,
                name,
                known,
                hint=f"{kind} takes {', '.join(known)}",
                trace=key.trace,
                near=other_word(name, known),
            )
        )
        found += error.diagnostics
    if found:
        raise YamaroError(found)


def read_field(
    lowering: Lowering, field: Field, key: Element, *, noun: str = "a number"
) -> tuple[str | Numbers, Span]:
    """Return the value of a field, and where it is written.

    Raises:
        YamaroError: it is faulty, or a number that makes no sense there.
    """
    value, span = read_value(key)
    name, sign = field.name, field.sign
    if field.count == TEXT:
        return word_of(name, value, span, owner=key), span
    numbers = read_numbers(
        lowering, value, span, count=field.count, name=name, trace=key.trace, kind=field.kind
    )
    for number in numbers.values:
        if sign == NOT_ZERO:
            is_sound = number != 0
        elif sign == POSITIVE:
            is_sound = number > 0
        elif sign == WHOLE:
            is_sound = number >= 1 and number == int(number)
        else:
            is_sound = number >= 0 and (sign != PART or number <= 1)
        if not is_sound:
            wanted = "whole numbers from 1" if sign == WHOLE else f"{noun} from 0"
            wanted = f"{noun} {PART}" if sign == PART else wanted
            wanted = f"{noun} above 0" if sign == POSITIVE else wanted
            given = int(number) if sign == WHOLE and number == int(number) else number
            raise failure(
                "bad-number",
                f"'{name}' is not 0: it is how often the motor turns for one turn of the joint"
                if sign == NOT_ZERO
                else f"'{name}' takes {wanted}, and this is {format_value(given)}",
                span,
                hint=f"write {name}: {field.example}",
                trace=key.trace,
            )
    return numbers, span


# --- `surface` --------------------------------------------------------------------------------


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
            refuse_attributes(word)
            keys = given_once(word, SURFACE.fields)
            note = RobotNote(
                "surface", word.span, {"link": link, "index": str(number)}, trace=lowering.trace
            )
            places: dict[str, Span] = {}
            note.value_spans = places
            for name, key in keys.items():
                try:
                    found = read_field(lowering, SURFACE.fields[name], key)
                except YamaroError as error:
                    lowering.absorb(error)
                    continue
                note.attributes[name], places[name] = found
            out.append(note)
        except YamaroError as error:
            lowering.absorb(error)


# --- `frame` ----------------------------------------------------------------------------------


def lower_frame(lowering: Lowering, word: Element, link: str, out: list[Node]) -> None:
    """Append the joint and the empty link that are a frame in URDF; record what is wrong."""
    blocks = [child for child in word.children if isinstance(child, RawBlock)]
    if blocks:
        word = word.with_children([each for each in word.children if each not in blocks])
    try:
        name = name_of_word(word, "tool0")
        if any(isinstance(each, Text) and isinstance(each.value, dict) for each in word.children):
            word = with_entries(word)
        check_keys(word, FRAME.keys)
        fields = sort_fields(lowering, word, FRAME)
        pose = read_pose(lowering, fields)
    except YamaroError as error:
        lowering.absorb(error)
        return
    joint, frame = frame_elements(lowering, word, name, link, pose)
    out += [joint, frame.with_children([*blocks])]


def frame_elements(
    lowering: Lowering, word: Element, name: str, link: str, pose: Pose
) -> list[Element]:
    """Return a fixed joint and the empty link on it: what a frame is in URDF."""
    span = word.value_span("name")
    trace = lowering.trace
    children: list[Node] = [
        Element("parent", word.span, {"link": link}, trace=trace),
        Element("child", span, {"link": name}, trace=trace),
    ]
    origin = origin_element(pose, word)
    if origin is not None:
        children.append(origin)
    spans = {"name": span}
    joint = Element(
        "joint",
        word.span,
        {"name": f"{name}_joint", "type": "fixed"},
        children,
        trace,
        spans,
    )
    return [joint, Element("link", word.span, {"name": name}, [], trace, spans)]


def name_of_word(word: Element, example: str) -> str:
    """Return the name in `frame/name=tool0`, the only attribute that such a key has.

    Raises:
        YamaroError: there is no name, or another attribute.
    """
    for attribute in word.attributes:
        if attribute != "name":
            raise failure(
                "unknown-key",
                f"`{word.name}` takes its name as an attribute, and '{attribute}' as an entry",
                word.name_span(attribute),
                hint=f"write {word.name}/name={example}: {{{attribute}: …}}, or <{word.name}/…>: "
                "for an XML element",
                trace=word.trace,
            )
    name = format_value(word.attributes.get("name")).strip()
    if not name:
        entry = next((key for key in word.elements() if key.name == "name"), word)
        example = entry.text().strip() or example
        raise failure(
            "missing-name",
            f"this {word.name} has no name",
            word.span,
            hint=f"write {word.name}/name={example}:, or <{word.name}>: for an XML element",
            trace=word.trace,
        )
    return name
