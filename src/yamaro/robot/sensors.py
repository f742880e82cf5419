"""Lowers `sensor`: a note of what it is, and in a link the frame that it looks from."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
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
    from ..xml.tree import Node
    from .lowering import Lowering

COMMON_KEYS = ("type", "rate", "noise", "topic")
NUMBERS = {"rays": 1, "rows": 1, "angle": 1, "tilt": 1, "range": 2, "size": 2, "fov": 1, "clip": 2}
"""How many numbers each key takes: counts, radians, metres, pixels, radians, metres."""
KINDS = {
    "rate": "rate",
    **dict.fromkeys(("angle", "tilt", "fov"), "angle"),
    **dict.fromkeys(("range", "clip"), "length"),
}
"""What the numbers of a key are; those of the others take no unit."""
LINK_SENSORS: dict[str, tuple[str, ...]] = {
    "imu": (),
    "lidar": ("rays", "angle", "range", "rows", "tilt"),
    "camera": ("size", "fov", "clip"),
    "depth_camera": ("size", "fov", "clip"),
    "gps": (),
    "contact": (),
    "magnetometer": (),
    "range": ("range", "fov"),
}
"""The types of sensors in a link, each with the keys of its own."""
JOINT_SENSORS: dict[str, tuple[str, ...]] = {"force_torque": ()}
"""The types of sensors in a joint."""
CAMERAS = ("camera", "depth_camera")
OPTICAL = "_optical"
"""What follows a camera's name in the name of its optical frame."""
_EXAMPLES = {
    "rate": "30",
    "noise": "0.01",
    "rays": "720",
    "rows": "16",
    "angle": "6.28",
    "tilt": "0.5",
    "range": "0.1 12",
    "size": "640 480",
    "fov": "1.05",
    "clip": "0.05 100",
}
WHOLE = ("rays", "rows", "size")
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
    lowering: Lowering, word: Element, types: dict[str, tuple[str, ...]]
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
    for key_name, key in keys.items():
        text = _value(lowering, key_name, key)
        if text is not None:
            note.attributes[key_name] = text
        if key_name not in POSE_ROWS:
            places[key_name] = read_value(key)[1]
    return note, keys


def _kind(word: Element, keys: dict[str, Element], types: dict[str, tuple[str, ...]]) -> str:
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


def _check_keys(keys: dict[str, Element], kind: str, types: dict[str, tuple[str, ...]]) -> None:
    own = types[kind]
    known = (*COMMON_KEYS, *POSE_ROWS, "frame", *own)
    for name, key in keys.items():
        if name in known:
            continue
        others = [other for other, others_own in types.items() if name in others_own]
        from ..suggestions import meant_word

        hint, fix = (None, None) if others else meant_word(name, known, key.span)
        raise failure(
            "sensor-key" if others else "unknown-key",
            f"'{name}' is for {' and '.join(others)}, and this is {kind}"
            if others
            else f"'{name}' is not an entry of a sensor",
            key.span,
            hint=f"{kind} takes {', '.join(own or COMMON_KEYS[1:])}"
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


def _value(lowering: Lowering, name: str, key: Element) -> str | None:
    """Return the value of a key as text; None for those that are read elsewhere."""
    if name in (*POSE_ROWS, "type", "frame"):
        return None
    value, span = read_value(key)
    if name == "topic":
        return word_of(name, value, span, owner=key)
    count = NUMBERS.get(name, 1)
    kind = KINDS.get(name, "number")
    numbers = read_numbers(
        lowering, value, span, count=count, name=name, trace=key.trace, kind=kind
    )
    for number in numbers.values:
        if number < 0 or (name in WHOLE and (number < 1 or number != int(number))):
            raise failure(
                "bad-number",
                f"'{name}' takes {'whole ' if name in WHOLE else ''}numbers "
                f"{'from 1' if name in WHOLE else 'from 0'}, and this is {format_value(number)}",
                span,
                hint=f"write {name}: {_EXAMPLES[name]}",
                trace=key.trace,
            )
    return numbers.text
