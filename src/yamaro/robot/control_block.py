"""Makes the `<ros2_control>` elements of a finished robot.

Source: ros2_control, "Hardware components" of its manual, and what component_parser.cpp reads.
"""

from __future__ import annotations

from ..diagnostics import did_you_mean, failure
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .mirror_image import negated

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..source import Span
    from .notes import RobotNote

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

    __slots__ = ("_actuators", "_joints", "_name", "_places", "_sensors", "_states")

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
                    made.param(key.name, key.text().strip(), _text_span(key))
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
                block.children.append(self._sensor(made, str(child.attributes["name"])))
        block.children += [_gpio(made, pin) for pin in control.elements() if pin.name == "gpio"]
        if given.get("transmissions") == "true":
            for child in control.elements():
                if child.name == "joint":
                    block.children.append(self._transmission(made, str(child.attributes["joint"])))
        return block

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

    def _sensor(self, made: _Maker, name: str) -> Element:
        note = self._sensors[name]
        sensor = made.element("sensor", {"name": name})
        for interface in SENSOR_INTERFACES[str(note.attributes["type"])]:
            sensor.children.append(made.element("state_interface", {"name": interface}))
        frame = note.attributes.get("frame")
        if frame is not None:
            has_place = note.value_spans is not None and note.value_spans.get("frame") is not None
            place = note.value_span("frame" if has_place else "name")  # by default the sensor's
            sensor.children.append(made.param("frame_id", str(frame), place))
        return sensor

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


def _gpio(made: _Maker, pin: Element) -> Element:
    """Return the `<gpio>` of a note; its commands come before its states."""
    gpio = made.element("gpio", {"name": pin.attributes["name"]})
    gpio.children += [made.element(each.name, dict(each.attributes)) for each in pin.elements()]
    return gpio


def _text_span(key: Element) -> Span:
    return next((each.span for each in key.children if isinstance(each, Text)), key.span)


def _number(limit: Element, name: str, default: str | None) -> _Placed | None:
    value = limit.attributes.get(name)
    text = default if value is None else format_value(value).strip()
    return None if text is None else (text, limit.value_span(name))
