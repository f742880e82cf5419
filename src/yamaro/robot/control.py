"""Lowers `control`: a note with the joints and sensors it drives, and the `<ros2_control>` of it.

Source: https://control.ros.org, "ros2_control in URDF", and its schema ros2_control.xsd.
"""

from __future__ import annotations

from fnmatch import fnmatchcase

from ..diagnostics import YamaroError, failure
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .fields import read_value, word_of
from .mirror_image import negated
from .notes import RobotNote, check_keys, names_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..xml.tree import Node, RobotWord
    from .lowering import Lowering

KEYS = (
    *("name", "type", "plugin", "joints", "sensors"),
    *("params", "gpio", "transmissions", "state"),
)
TYPES = ("system", "actuator", "sensor")
_SENSOR_INTERFACES = {
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


def lower_control(lowering: Lowering, word: RobotWord, out: list[Node]) -> None:
    """Append the note of a `control`; record what is wrong."""
    try:
        check_keys(word, KEYS)
        note = RobotNote("ros2_control", word.span, {}, trace=lowering.trace)
        for key in word.elements():
            if key.name in ("params", "gpio"):
                note.children.append(key.with_children(list(key.children)))
            else:
                value, span = read_value(key)
                words = value if isinstance(value, list) else [value]
                text = " ".join(format_value(each) for each in words)
                note.attributes[key.name] = word_of(key.name, text, span, owner=word)
        if "plugin" not in note.attributes:
            raise failure(
                "missing-key",
                "`control` needs an entry `plugin`",
                word.span,
                hint="write plugin: mock_components/GenericSystem",
                trace=word.trace,
            )
    except YamaroError as error:
        lowering.absorb(error)
        return
    lowering.controls.append(note)
    out.append(note)


def choose_members(lowering: Lowering, robot: Element, controls: Sequence[RobotNote]) -> None:
    """Put the joints and sensors that each control drives into its note, before any prefix."""
    notes = [node for node in robot.elements() if isinstance(node, RobotNote)]
    driven = {note.attributes["joint"] for note in notes if note.name == "actuator"}
    for control in controls:
        pattern = control.attributes.pop("joints", None)
        names = _joints(robot)
        if pattern is None:
            chosen = [name for name in names if name in driven]
        else:
            parts = {joint: part for part, joint in lowering.part_joints.items()}
            wanted = str(pattern)
            chosen = [n for n in names if _matches(n, wanted) or _matches(parts.get(n), wanted)]
        if not chosen and control.attributes.get("type") != "sensor":
            lowering.absorb(_no_joints(control, pattern, names))
        for name in chosen:
            control.children.append(RobotNote("joint", control.span, {"joint": name}))
        sensors = str(control.attributes.pop("sensors", "*"))
        for note in notes:
            own_name = note.attributes.get("name")
            has_interfaces = note.attributes.get("type") in _SENSOR_INTERFACES
            if note.name == "sensor" and has_interfaces and _matches(str(own_name), sensors):
                control.children.append(RobotNote("sensor", control.span, {"name": own_name}))


def _matches(name: str | None, patterns: str) -> bool:
    words = patterns.replace(",", " ").split()
    return name is not None and any(fnmatchcase(name, word) for word in words)


def _joints(robot: Element) -> list[str]:
    """Return the names of the joints that can be driven: neither fixed nor following another."""
    return [
        format_value(joint.attributes.get("name"))
        for joint in robot.elements()
        if joint.name == "joint"
        and type(joint) is Element
        and joint.attributes.get("type") not in ("fixed", "floating", "planar")
        and not any(child.name == "mimic" for child in joint.elements())
    ]


def _no_joints(control: RobotNote, pattern: object, names: list[str]) -> YamaroError:
    return failure(
        "control-joints",
        "this `control` has no joints: no joint has an actuator"
        if pattern is None
        else f"no joint that can be driven is named as '{pattern}' says",
        control.span,
        hint="write joints: '*' for all joints, or give them an `actuator`"
        if pattern is None
        else f"the joints are {', '.join(names[:6]) or 'none'}",
        trace=control.trace,
    )


# --- the element ------------------------------------------------------------------------------


class ControlWriter:
    """Makes `<ros2_control>` elements of a finished robot's notes."""

    __slots__ = ("_actuators", "_joints", "_name", "_sensors", "_states")

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

    def element(self, control: RobotNote) -> Element:
        """Return the element of a control.

        Raises:
            YamaroError: it begins in a state that does not exist.
        """
        given = control.attributes
        made = _Maker(control)
        initial = self._initial(control)
        hardware = made.element("hardware", {})
        hardware.children.append(made.text("plugin", str(given["plugin"])))
        own = {"name": given.get("name", self._name), "type": given.get("type", "system")}
        block = made.element("ros2_control", own)
        block.children.append(hardware)
        for child in control.elements():
            if child.name == "params":
                hardware.children += [
                    made.param(key.name, key.text().strip()) for key in child.elements()
                ]
        for child in control.elements():
            if child.name == "joint":
                name = str(child.attributes["joint"])
                block.children.append(self._joint(made, name, initial.get(name)))
            elif child.name == "sensor":
                block.children.append(self._sensor(made, str(child.attributes["name"])))
        for child in control.elements():
            if child.name == "gpio":
                block.children += [_gpio(made, pin) for pin in child.elements()]
        if given.get("transmissions") == "true":
            for child in control.elements():
                if child.name == "joint":
                    block.children.append(self._transmission(made, str(child.attributes["joint"])))
        return block

    def _initial(self, control: RobotNote) -> dict[str, str]:
        name = control.attributes.get("state")
        if name is None:
            return {}
        if name not in self._states:
            raise failure(
                "unknown-state",
                f"there is no state '{name}'",
                control.span,
                hint=f"the states are {', '.join(self._states)}"
                if self._states
                else f"add a section states: {{{name}: {{…}}}}",
                trace=control.trace,
            )
        return self._states[str(name)]

    def _joint(self, made: _Maker, name: str, initial: str | None) -> Element:
        actuator = self._actuators.get(name)
        command = "position" if actuator is None else str(actuator.attributes["command"])
        joint = made.element("joint", {"name": name})
        interface = made.element("command_interface", {"name": command})
        for which, value in zip(("min", "max"), self._range(name, command), strict=True):
            if value is not None:
                interface.children.append(made.param(which, value))
        position = made.element("state_interface", {"name": "position"})
        if initial is not None:
            position.children.append(made.param("initial_value", initial))
        velocity = made.element("state_interface", {"name": "velocity"})
        joint.children += [interface, position, velocity]
        if command == "effort":
            joint.children.append(made.element("state_interface", {"name": "effort"}))
        return joint

    def _range(self, name: str, command: str) -> tuple[str | None, str | None]:
        """Return the least and the greatest command, which the joint's limit gives."""
        joint = self._joints[name]
        limit = next((child for child in joint.elements() if child.name == "limit"), None)
        if limit is None:
            return None, None
        if command == "position":
            if joint.attributes.get("type") == "continuous":
                return None, None
            return _number(limit, "lower", "0"), _number(limit, "upper", "0")
        most = _number(limit, command, None)
        return (None, None) if most is None else (negated(most), most)

    def _sensor(self, made: _Maker, name: str) -> Element:
        note = self._sensors[name]
        sensor = made.element("sensor", {"name": name})
        for interface in _SENSOR_INTERFACES[str(note.attributes["type"])]:
            sensor.children.append(made.element("state_interface", {"name": interface}))
        frame = note.attributes.get("frame")
        if frame is not None:
            sensor.children.append(made.param("frame_id", str(frame)))
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


States = dict[str, dict[str, str]]
"""The value of each joint in each state."""


class _Maker:
    """Makes elements at the place of a control."""

    __slots__ = ("_owner",)

    def __init__(self, owner: RobotNote) -> None:
        self._owner = owner

    def element(self, name: str, attributes: dict[str, object]) -> Element:
        return Element(name, self._owner.span, attributes, trace=self._owner.trace)

    def text(self, name: str, text: str) -> Element:
        made = self.element(name, {})
        made.children.append(Text(text, self._owner.span))
        return made

    def param(self, name: str, text: str) -> Element:
        made = self.text("param", text)
        made.attributes["name"] = name
        return made


def _gpio(made: _Maker, pin: Element) -> Element:
    """Return a `<gpio>` of its lists of commands and states."""
    gpio = made.element("gpio", {"name": pin.name})
    for kind in ("command", "state"):
        for key in pin.elements():
            if key.name == kind:
                for name, _ in names_in(key):
                    gpio.children.append(made.element(f"{kind}_interface", {"name": name}))
    return gpio


def _number(limit: Element, name: str, default: str | None) -> str | None:
    value = limit.attributes.get(name)
    return default if value is None else format_value(value).strip()
