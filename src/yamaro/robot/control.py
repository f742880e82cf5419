"""Lowers `control`: a note with the joints and sensors it drives; see `control_block.py`."""

from __future__ import annotations

from fnmatch import fnmatchcase

from ..diagnostics import YamaroError, did_you_mean, failure
from ..model.schema import CONTROL
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .control_block import SENSOR_INTERFACES
from .entries import TRUTHS, entries_of, given_once, one_of
from .fields import read_value, word_of
from .notes import RobotNote, check_keys, names_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..source import Span
    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering

    Patterns = list[tuple[str, Span]]

TYPES = CONTROL.fields["type"].choices
SENSOR_TYPE = TYPES[2]
PLUGIN = "mock_components/GenericSystem"
"""The plugin in examples: it mirrors commands to states, without hardware."""


class PendingControl:
    """A control whose joints and sensors are not chosen yet.

    Attributes:
        note: its note.
        joints: patterns for joints, or None for the default.
        sensors: patterns for sensors, or None for the default.
    """

    __slots__ = ("joints", "note", "sensors")

    def __init__(self, note: RobotNote, joints: Patterns | None, sensors: Patterns | None) -> None:
        self.note = note
        self.joints = joints
        self.sensors = sensors

    @property
    def is_sensor(self) -> bool:
        """Return whether the hardware only measures."""
        return self.note.attributes.get("type") == SENSOR_TYPE


def lower_control(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append the note of a `control`; record what is wrong."""
    try:
        control = _read(lowering, word)
    except YamaroError as error:
        lowering.absorb(error)
        return
    lowering.controls.append(control)
    out.append(control.note)


def _read(lowering: Lowering, word: RobotWord) -> PendingControl:
    entries = entries_of(word, f"control: {{plugin: {PLUGIN}}}")
    keys = given_once(word.with_children([*entries]), CONTROL.fields)
    if "plugin" not in keys:
        raise failure(
            "missing-key",
            "`control` needs an entry `plugin`",
            word.span,
            hint=f"write plugin: {PLUGIN}",
            trace=word.trace,
        )
    note = RobotNote("ros2_control", word.span, {}, trace=lowering.trace)
    places: dict[str, Span] = {}
    note.value_spans = places
    for name, key in keys.items():
        if name == "params":
            note.children.append(_params(key))
        elif name == "gpio":
            note.children += [
                _gpio(lowering, pin) for pin in entries_of(key, "gpio: {lamp: {command: on}}")
            ]
        elif name not in ("joints", "sensors"):
            note.attributes[name] = _word(key)
            places[name] = read_value(key)[1]
    patterns = (names_in(keys[name]) if name in keys else None for name in ("joints", "sensors"))
    return PendingControl(note, *patterns)


def _word(key: Element) -> str:
    if key.name == "type":
        return one_of(key, TYPES)
    if key.name == "transmissions":
        return one_of(key, TRUTHS)
    return word_of(key.name, *read_value(key), owner=key)


def _params(key: Element) -> Element:
    """Return the parameters of a driver; one may be empty, such as a prefix."""
    params = key.with_children([])
    entries = entries_of(key, "params: {port: 3}")
    given_once(key.with_children([*entries]), tuple(child.name for child in entries))
    for child in entries:
        text = ""
        if child.children:
            value, span = read_value(child)
            is_empty = isinstance(value, str) and not value.strip()
            text = "" if is_empty else word_of(child.name, value, span, owner=key)
        params.children.append(child.with_children([Text(text, child.span)]))
    return params


def _gpio(lowering: Lowering, pin: Element) -> RobotNote:
    """Return a note of a pin, with its lists of commands and states."""
    pin = pin.with_children([*entries_of(pin, f"{pin.name}: {{command: on, state: on}}")])
    check_keys(pin, ("command", "state"))
    note = RobotNote("gpio", pin.span, {"name": pin.name}, trace=lowering.trace)
    for kind in ("command", "state"):
        for key in pin.elements():
            if key.name == kind:
                for name, span in names_in(key):
                    note.children.append(RobotNote(f"{kind}_interface", span, {"name": name}))
    return note


# --- joints and sensors -------------------------------------------------------------------------


def choose_members(
    lowering: Lowering, elements: Sequence[Element], controls: Sequence[PendingControl]
) -> None:
    """Put the joints and sensors that each control drives into its note, before any prefix.

    Each is in one control: ros2_control refuses an interface that is there twice. Those that are
    named come first; what is left goes to the controls that name none.

    Args:
        lowering: the run.
        elements: the elements and notes of the robot.
        controls: the controls.
    """
    members = _Members(lowering, elements, {id(control.note) for control in controls})
    for control in sorted(controls, key=lambda each: each.joints is None):
        for name in members.joints_of(control):
            control.note.children.append(RobotNote("joint", control.note.span, {"joint": name}))
    for control in sorted(controls, key=lambda each: (each.sensors is None, not each.is_sensor)):
        for name in members.sensors_of(control):
            control.note.children.append(RobotNote("sensor", control.note.span, {"name": name}))


class _Members:
    """The joints and sensors of a robot that a control may have, and those that have one."""

    __slots__ = ("_driven", "_joints", "_lowering", "_parts", "_sensors", "_taken")

    def __init__(self, lowering: Lowering, elements: Sequence[Element], pending: set[int]) -> None:
        self._lowering = lowering
        self._parts = {joint: part for part, joint in lowering.part_joints.items()}
        self._joints = _joints(elements)
        notes = [each for each in elements if isinstance(each, RobotNote)]
        self._driven = {each.attributes["joint"] for each in notes if each.name == "actuator"}
        self._sensors = {
            format_value(each.attributes["name"]): format_value(each.attributes["type"])
            for each in notes
            if each.name == "sensor"
        }
        self._taken: set[str] = set()
        for each in elements:
            if each.name == "ros2_control" and id(each) not in pending:
                for child in each.elements():
                    if child.name in ("joint", "sensor"):
                        key = "joint" if "joint" in child.attributes else "name"
                        self._taken.add(format_value(child.attributes.get(key)))

    def joints_of(self, control: PendingControl) -> list[str]:
        """Return the joints that a control drives, in order; record patterns that name none."""
        if control.joints is None:
            if control.is_sensor:
                return []
            chosen = {name for name in self._joints if name in self._driven} - self._taken
            if not chosen:
                self._refuse(control, None, bool(self._driven))
        else:
            chosen = set()
            for pattern in control.joints:
                names = {name for name in self._joints if self._is_meant(name, pattern[0])}
                if not names - self._taken:
                    self._refuse(control, pattern, bool(names))
                chosen |= names - self._taken
        self._taken |= chosen
        return [name for name in self._joints if name in chosen]

    def _is_meant(self, joint: str, pattern: str) -> bool:
        part = self._parts.get(joint)
        return _matches(joint, pattern) or (part is not None and _matches(part, pattern))

    def sensors_of(self, control: PendingControl) -> list[str]:
        """Return the sensors that a control reads, in order; record patterns that name none."""
        known = [name for name, kind in self._sensors.items() if kind in SENSOR_INTERFACES]
        chosen = set(known) - self._taken
        if control.sensors is not None:
            for pattern in control.sensors:
                if not any(_matches(name, pattern[0]) for name in chosen):
                    self._refuse_sensor(control, pattern, known)
            patterns = [pattern for pattern, _ in control.sensors]
            chosen = {name for name in chosen if any(_matches(name, each) for each in patterns)}
        self._taken |= chosen
        return [name for name in known if name in chosen]

    # --- messages ---

    def _refuse(
        self, control: PendingControl, pattern: tuple[str, Span] | None, is_taken: bool
    ) -> None:
        note = control.note
        if pattern is None:
            reason = "other controls have all joints with an actuator"
            message = f"this `control` has no joints: {reason if is_taken else _UNDRIVEN}"
            hint = "write joints: '*' for all joints, or give them an `actuator`"
            hint = "remove it, or name its joints: joints: 'left_*'" if is_taken else hint
        elif is_taken:
            message = f"another control has the joints that '{pattern[0]}' means"
            hint = "ros2_control takes each joint in one block; name other joints"
        else:
            message = f"no joint that can be driven is named as '{pattern[0]}' says"
            near = did_you_mean(pattern[0], (*self._joints, *self._parts.values()))
            hint = near or f"the joints are {', '.join(self._joints[:6]) or 'none'}"
        self._lowering.absorb(
            failure(
                "control-joints",
                message,
                note.span if pattern is None else pattern[1],
                hint=hint,
                trace=note.trace,
            )
        )

    def _refuse_sensor(
        self, control: PendingControl, pattern: tuple[str, Span], known: list[str]
    ) -> None:
        word, span = pattern
        if any(_matches(name, word) for name in known):
            message, hint = f"another control has the sensor '{word}'", "name each in one control"
        elif word in self._sensors:
            message = f"'{word}' is a sensor of the type {self._sensors[word]}"
            hint = f"ros2_control reads {' and '.join(SENSOR_INTERFACES)}"
        else:
            message = f"there is no sensor '{word}' in the robot"
            hint = did_you_mean(word, known) or f"its sensors are {', '.join(known) or 'none'}"
        self._lowering.absorb(
            failure("unknown-sensor", message, span, hint=hint, trace=control.note.trace)
        )


_UNDRIVEN = "no joint has an actuator"


def _matches(name: str, patterns: str) -> bool:
    return any(fnmatchcase(name, word) for word in patterns.replace(",", " ").split())


def _joints(elements: Sequence[Element]) -> list[str]:
    """Return the names of the joints that can be driven: neither fixed nor following another."""
    return [
        format_value(joint.attributes.get("name"))
        for joint in elements
        if joint.name == "joint"
        and type(joint) is Element
        and joint.attributes.get("type") not in ("fixed", "floating", "planar")
        and not any(child.name == "mimic" for child in joint.elements())
    ]
