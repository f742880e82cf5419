"""`control`: a note with the joints and sensors that it drives, and the `<ros2_control>` of it.

Source: ros2_control, "Hardware components" of its manual, and what component_parser.cpp reads.
"""

from __future__ import annotations

from fnmatch import fnmatchcase

from ..diagnostics import YamaroError, did_you_mean, failure
from ..model.schema import CONTROL
from ..xml.tree import Element, RobotNote, Text
from ..xml.values import format_value
from .fields import read_value, word_of
from .notes import check_keys, entries_of, given_once, names_in, one_of, place_of
from .numbers import negated

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..source import Span
    from ..xml.tree import Node, RobotWord
    from .controllers import PendingController
    from .lowering import Lowering

    Patterns = list[tuple[str, Span]]

SENSOR_TYPE = CONTROL.fields["type"].choices[2]
DRAKE = "https://drake.mit.edu"
"""The namespace of Drake's elements."""
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
            # The parameters of a driver; one may be empty, such as a prefix.
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
            note.children.append(params)
        elif name == "gpio":
            note.children += [
                _gpio(lowering, pin) for pin in entries_of(key, "gpio: {lamp: {command: on}}")
            ]
        elif name not in ("joints", "sensors"):
            choices = CONTROL.fields[name].choices
            given = one_of(key, choices) if choices else word_of(name, *read_value(key), owner=key)
            note.attributes[name] = given
            places[name] = read_value(key)[1]
    patterns = (names_in(keys[name]) if name in keys else None for name in ("joints", "sensors"))
    return PendingControl(note, *patterns)


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
    lowering: Lowering,
    elements: Sequence[Element],
    controls: Sequence[PendingControl | PendingController],
) -> None:
    """Put the joints and sensors that each control drives into its note, before any prefix.

    After them the controllers choose among these joints.

    Each is in one control: ros2_control refuses an interface that is there twice. Those that are
    named come first; what is left goes to the controls that name none.

    Args:
        lowering: the run.
        elements: the elements and notes of the robot.
        controls: the controls, and the controllers.
    """
    hardware = [each for each in controls if isinstance(each, PendingControl)]
    members = _Members(lowering, elements, {id(control.note) for control in hardware})
    for control in sorted(hardware, key=lambda each: each.joints is None):
        for name in members.joints_of(control):
            control.note.children.append(RobotNote("joint", control.note.span, {"joint": name}))
    for control in sorted(hardware, key=lambda each: (each.sensors is None, not each.is_sensor)):
        for name in members.sensors_of(control):
            control.note.children.append(RobotNote("sensor", control.note.span, {"name": name}))
    others = [each for each in controls if not isinstance(each, PendingControl)]
    if others:
        from .controllers import choose_joints

        choose_joints(lowering, elements, others)


class _Members:
    """The joints and sensors of a robot that a control may have, and those that have one."""

    __slots__ = ("_driven", "_joints", "_lowering", "_parts", "_sensors", "_taken")

    def __init__(self, lowering: Lowering, elements: Sequence[Element], pending: set[int]) -> None:
        self._lowering = lowering
        self._parts = {joint: part for part, joint in lowering.part_joints.items()}
        self._joints = drivable_joints(elements)
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
                names = {
                    name
                    for name in self._joints
                    if any(matches(own, pattern[0]) for own in (name, self._parts.get(name, name)))
                }
                if not names - self._taken:
                    self._refuse(control, pattern, bool(names))
                chosen |= names - self._taken
        self._taken |= chosen
        return [name for name in self._joints if name in chosen]

    def sensors_of(self, control: PendingControl) -> list[str]:
        """Return the sensors that a control reads, in order; record patterns that name none."""
        known = [name for name, kind in self._sensors.items() if kind in SENSOR_INTERFACES]
        chosen = set(known) - self._taken
        if control.sensors is not None:
            for pattern in control.sensors:
                if not any(matches(name, pattern[0]) for name in chosen):
                    self._refuse_sensor(control, pattern, known)
            patterns = [pattern for pattern, _ in control.sensors]
            chosen = {name for name in chosen if any(matches(name, each) for each in patterns)}
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
        if any(matches(name, word) for name in known):
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


def matches(name: str, patterns: str) -> bool:
    """Return whether a name is one that patterns such as `left_*` mean."""
    return any(fnmatchcase(name, word) for word in patterns.replace(",", " ").split())


def drivable_joints(elements: Sequence[Element]) -> list[str]:
    """Return the names of the joints that can be driven: neither fixed nor following another."""
    return [
        format_value(joint.attributes.get("name"))
        for joint in elements
        if joint.name == "joint"
        and type(joint) is Element
        and joint.attributes.get("type") not in ("fixed", "floating", "planar")
        and not any(child.name == "mimic" for child in joint.elements())
    ]


# --- the `<ros2_control>` elements ------------------------------------------------------------


SENSOR_INTERFACES = {
    "imu": (
        *(f"orientation.{axis}" for axis in "xyzw"),
        *(f"angular_velocity.{axis}" for axis in "xyz"),
        *(f"linear_acceleration.{axis}" for axis in "xyz"),
    ),
    "force_torque": (
        *(f"force.{axis}" for axis in "xyz"),
        *(f"torque.{axis}" for axis in "xyz"),
    ),
}
"""The state interfaces of the sensors that ros2_control has a semantic component for."""


class ControlWriter:
    """Makes `<ros2_control>` elements of a finished robot's notes."""

    __slots__ = ("_actuators", "_geared", "_joints", "_name", "_places", "_sensors", "_states")

    def __init__(self, robot: Element, notes: Sequence[RobotNote], states: States) -> None:
        """Take a lowered robot with its notes, and the merged states."""
        self._name = format_value(robot.attributes.get("name"))
        self._joints = {
            format_value(each.attributes.get("name")): each
            for each in robot.elements()
            if each.name == "joint"
        }
        self._actuators = {n.attributes["joint"]: n for n in notes if n.name == "actuator"}
        self._sensors = {n.attributes["name"]: n for n in notes if n.name == "sensor"}
        self._states = states
        self._geared = {
            format_value(joint.attributes.get("name"))
            for each in robot.elements()
            if each.name == "transmission"
            for joint in each.elements()
            if joint.name == "joint"
        }
        self._places = {
            format_value(each.attributes.get("name")): each.span
            for each in robot.elements()
            if each.name == "ros2_control"
        }

    def element(self, control: RobotNote) -> Element:
        """Return the element of a control.

        Raises:
            YamaroError: it begins in a state that does not exist, or has the name of another.
        """
        given = control.attributes
        name = str(given.get("name", self._name))
        self._refuse_name_of_another(control, name)
        made = _Maker(control)
        initial = self._initial(control)
        hardware = made.element("hardware", {})
        plugin = made.text("plugin", str(given["plugin"]), control.value_span("plugin"))
        hardware.children.append(plugin)
        kind = given.get("type", "system")
        block = made.element("ros2_control", {"name": name, "type": kind})
        block.value_spans = control.value_spans
        block.children.append(hardware)
        for child in control.elements():
            if child.name == "params":
                hardware.children += [
                    made.param(key.name, key.text().strip(), place_of(key))
                    for key in child.elements()
                ]
        for child in control.elements():
            if child.name == "joint":
                joint = str(child.attributes["joint"])
                commands = kind != "sensor"
                block.children.append(
                    self._joint(made, joint, initial.get(joint), commands=commands)
                )
            elif child.name == "sensor":
                name = str(child.attributes["name"])
                note = self._sensors[name]
                sensor = made.element("sensor", {"name": name})
                for interface in SENSOR_INTERFACES[str(note.attributes["type"])]:
                    sensor.children.append(made.element("state_interface", {"name": interface}))
                frame = note.attributes.get("frame")
                if frame is not None:
                    spans = note.value_spans or {}  # by default it is the sensor's
                    place = note.value_span("frame" if spans.get("frame") is not None else "name")
                    sensor.children.append(made.param("frame_id", str(frame), place))
                block.children.append(sensor)
        for child in control.elements():
            if child.name == "gpio":  # whose commands come before its states
                gpio = made.element("gpio", {"name": child.attributes["name"]})
                gpio.children += [
                    made.element(e.name, dict(e.attributes)) for e in child.elements()
                ]
                block.children.append(gpio)
        if given.get("transmissions") == "true":
            for child in control.elements():
                if child.name == "joint":
                    block.children.append(self._transmission(made, str(child.attributes["joint"])))
        return block

    def for_drake(self, control: RobotNote) -> list[Element]:
        """Return the transmissions that Drake reads, of joints whose armature or gains are given.

        A joint that the file has a transmission for is left out: Drake would drive it twice.
        Drake multiplies the inertia of a rotor by the square of its gear ratio, and warns of a
        `mechanicalReduction`. It takes both gains of a servo or none. Source:
        "drake:rotor_inertia", "drake:gear_ratio" and "drake:controller_gains" in its page on
        parsing, https://drake.mit.edu/doxygen_cxx/group__multibody__parsing.html.
        """
        found: list[Element] = []
        made = _Maker(control)
        if control.attributes.get("transmissions") != "true":
            return found
        for child in control.elements():
            name = str(child.attributes.get("joint", ""))
            given = self._actuators[name].attributes if name in self._actuators else {}
            values: list[Element] = []
            if "armature" in given:
                gear = given.get("gear", "1")
                inertia = given.get("rotor_inertia")
                if inertia is None:
                    ratio = float(str(gear))
                    inertia = float(str(given["armature"])) / (ratio * ratio)
                values.append(made.element("drake:rotor_inertia", {"value": inertia}))
                values.append(made.element("drake:gear_ratio", {"value": gear}))
            if given.get("command") == "position" and "kp" in given and "kd" in given:
                gains = {"p": given["kp"], "d": given["kd"]}
                values.append(made.element("drake:controller_gains", gains))
            if child.name != "joint" or not values or name in self._geared:
                continue
            joint = made.element("joint", {"name": name})
            interface = f"{str(given['command']).capitalize()}JointInterface"
            joint.children.append(made.text("hardwareInterface", f"hardware_interface/{interface}"))
            actuator = made.element("actuator", {"name": f"{name}_motor"})
            actuator.children += values
            transmission = made.element("transmission", {"name": f"{name}_transmission"})
            transmission.children += [
                made.text("type", "transmission_interface/SimpleTransmission"),
                joint,
                actuator,
            ]
            found.append(transmission)
        return found

    def _refuse_name_of_another(self, control: RobotNote, name: str) -> None:
        """Raise YamaroError if another block has the same name: ros2_control has each once."""
        place = control.value_span("name")
        other = self._places.get(name)
        if other is None:
            self._places[name] = place
            return
        raise failure(
            "duplicate-name",
            f"there are two controls named '{name}'",
            place,
            hint="give each a `name`; the default is the robot's"
            if "name" not in control.attributes
            else "give one of them another `name`",
            notes=[f"the other one is at {other.place()}"],
            trace=control.trace,
        )

    def _initial(self, control: RobotNote) -> dict[str, _Placed]:
        name = control.attributes.get("state")
        if name is None:
            return {}
        if name not in self._states:
            raise failure(
                "unknown-state",
                f"there is no state '{name}'",
                control.value_span("state"),
                hint=did_you_mean(str(name), self._states)
                or f"the states are {', '.join(self._states)}"
                if self._states
                else f"add a section states: {{{name}: {{…}}}}",
                trace=control.trace,
            )
        return self._states[str(name)]

    def _joint(
        self, made: _Maker, name: str, initial: _Placed | None, *, commands: bool
    ) -> Element:
        actuator = self._actuators.get(name)
        given = {"command": "position"} if actuator is None else actuator.attributes
        names = str(given.get("commands", given["command"])).split()
        joint = made.element("joint", {"name": name})
        for command in names if commands else ():
            interface = made.element("command_interface", {"name": command})
            for which, end in zip(("min", "max"), self._range(name, command), strict=True):
                if end is not None:
                    interface.children.append(made.param(which, *end))
            joint.children.append(interface)
        position = made.element("state_interface", {"name": "position"})
        if initial is not None:
            position.children.append(made.param("initial_value", *initial))
        velocity = made.element("state_interface", {"name": "velocity"})
        joint.children += [position, velocity]
        if "effort" in names:
            joint.children.append(made.element("state_interface", {"name": "effort"}))
        return joint

    def _range(self, name: str, command: str) -> tuple[_Placed | None, _Placed | None]:
        """Return the least and the greatest command, which the joint's limit gives, with places."""
        joint = self._joints[name]
        limit = next((child for child in joint.elements() if child.name == "limit"), None)
        if limit is None:
            return None, None
        if command == "position":
            if joint.attributes.get("type") == "continuous":
                return None, None
            return _number(limit, "lower", "0"), _number(limit, "upper", "0")
        most = _number(limit, command, None)
        return (None, None) if most is None else ((negated(most[0]), most[1]), most)

    def _transmission(self, made: _Maker, name: str) -> Element:
        actuator = self._actuators.get(name)
        gear = "1" if actuator is None else str(actuator.attributes.get("gear", "1"))
        transmission = made.element("transmission", {"name": f"{name}_transmission"})
        joint = made.element("joint", {"name": name, "role": name})
        joint.children.append(made.text("mechanical_reduction", gear))
        transmission.children += [
            made.text("plugin", "transmission_interface/SimpleTransmission"),
            made.element("actuator", {"name": f"{name}_motor", "role": f"{name}_motor"}),
            joint,
        ]
        return transmission


_Placed = tuple[str, "Span"]
"""A value, and where it is written."""
States = dict[str, dict[str, _Placed]]
"""The value of each joint in each state."""


class _Maker:
    """Makes elements at the place of a control."""

    __slots__ = ("_owner",)

    def __init__(self, owner: RobotNote) -> None:
        self._owner = owner

    def element(self, name: str, attributes: dict[str, object]) -> Element:
        return Element(name, self._owner.span, attributes, trace=self._owner.trace)

    def text(self, name: str, text: str, span: Span | None = None) -> Element:
        """Return an element with a text that is written at `span`, or follows from the control."""
        made = self.element(name, {})
        made.children.append(Text(text, span or self._owner.span))
        return made

    def param(self, name: str, text: str, span: Span | None = None) -> Element:
        made = self.text("param", text, span)
        made.attributes["name"] = name
        return made


def _number(limit: Element, name: str, default: str | None) -> _Placed | None:
    value = limit.attributes.get(name)
    text = default if value is None else format_value(value).strip()
    return None if text is None else (text, limit.value_span(name))
