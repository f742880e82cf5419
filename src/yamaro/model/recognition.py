"""What a URDF says of sensors, surfaces, actuators and control in elements of other programs.

`<gazebo>`, `<ros2_control>` and `<transmission>` are read when a `Robot` is first asked for what
they say. What the words of YAML say wins, and nothing is there twice: a robot that was written
with these elements gives the same as the words it was made of, as far as the elements hold it.
"""

from __future__ import annotations

from ..diagnostics import INHERITED
from ..xml.tree import Element, Text
from .gazebo_sensors import GazeboSensors
from .joint import FIXED
from .noting import Note, content, content_at, inside, numbers_in
from .values import attribute_text, child_named

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from ..diagnostics import Frame as Step
    from .robot import Robot

    Placed = tuple[Element, Step | None]

SURFACE_TAGS = {"mu1": "friction", "mu2": "friction2", "kp": "stiffness", "kd": "damping"}
"""The short forms of Gazebo, and what they are in a surface."""
SURFACE_PATHS = {
    "friction": ("friction", "ode", "mu"),
    "friction2": ("friction", "ode", "mu2"),
    "restitution": ("bounce", "restitution_coefficient"),
    "stiffness": ("contact", "ode", "kp"),
    "damping": ("contact", "ode", "kd"),
}
"""Where a `<surface>` of SDFormat says the same."""
COMMANDS = ("position", "velocity", "effort")
"""The commands of an actuator; the first of them that is written is the one it has."""
INTERFACES = {
    "PositionJointInterface": "position",
    "PosVelJointInterface": "position",
    "PosVelAccJointInterface": "position",
    "VelocityJointInterface": "velocity",
    "EffortJointInterface": "effort",
}
"""The hardware interfaces of ros_control that command a joint. Source: hardware_interface."""
EFFORT_TRANSMISSIONS = "pr2_mechanism_model/"
"""The transmissions of this package command efforts, and name no interface."""
SIMPLE = "SimpleTransmission"
IMU_INTERFACES = ("orientation.", "angular_velocity.", "linear_acceleration.")


def recognized(robot: Robot, notes: Sequence[Element]) -> list[Element]:
    """Return notes of what the elements of a robot say and the notes do not.

    Args:
        robot: the robot.
        notes: what words say of it.
    """
    found: list[Element] = []
    outer = list(_outermost(robot))
    gazebo = [(each, trace) for each, trace in outer if each.name == "gazebo"]
    controls = [(each, trace) for each, trace in outer if each.name == "ros2_control"]
    transmissions = [(each, trace) for each, trace in outer if each.name == "transmission"]
    if gazebo or controls:
        sensors = GazeboSensors(robot, _said(notes, "sensor", "name"))
        sensors.read(gazebo)
        for control in controls:
            _read_imus(robot, sensors, *control)
        found += sensors.notes
    if gazebo:
        found += _surfaces(robot, gazebo, _said(notes, "surface", "link"))
    if controls or transmissions:
        found += _Actuators(robot, _said(notes, "actuator", "joint")).read(controls, transmissions)
    named = {attribute_text(n, "name") or robot.name for n in notes if n.name == "ros2_control"}
    found += [_control(*each) for each in controls if attribute_text(each[0], "name") not in named]
    return found


def _outermost(robot: Robot) -> Iterator[Placed]:
    """Yield the elements directly under a robot, each with the calls that led to it."""
    root = robot.element
    above = None if root.trace is INHERITED else root.trace
    for child in root.children:
        if isinstance(child, Element):
            yield child, above if child.trace is INHERITED else child.trace


def _said(notes: Iterable[Element], kind: str, attribute: str) -> set[str]:
    """Return an attribute of all notes of a kind."""
    return {attribute_text(note, attribute) or "" for note in notes if note.name == kind}


# --- surfaces ---------------------------------------------------------------------------------


def _surfaces(robot: Robot, gazebo: list[Placed], said: set[str]) -> Iterator[Element]:
    """Yield the surfaces that `<gazebo>` gives to all collisions of a link; the last one wins."""
    by_link: dict[str, list[Placed]] = {}
    for element, trace in gazebo:
        link = attribute_text(element, "reference") or ""
        if link in robot.links and link not in said:
            by_link.setdefault(link, []).append((element, trace))
    for link, blocks in by_link.items():
        for index in range(len(robot.links[link].collisions)):
            note = _surface(blocks, link, index)
            if note is not None:
                yield note


def _surface(blocks: list[Placed], link: str, index: int) -> Element | None:
    note: Note | None = None
    for element, trace in blocks:
        begun = note or Note("surface", element, trace, link=link, index=str(index))
        if _read_surface(begun, element):
            note = begun
    return note.element if note is not None else None


def _read_surface(note: Note, gazebo: Element) -> bool:
    """Note the surface in a `<gazebo>`; return whether there is one."""
    found = False
    for child in gazebo.elements():
        if child.name in SURFACE_TAGS:
            found |= note.put_number(SURFACE_TAGS[child.name], child)
        elif child.name == "collision":
            surface = child_named(child, "surface")
            for attribute, path in SURFACE_PATHS.items():
                found |= note.put_number(attribute, inside(surface, *path))
    return found


# --- actuators --------------------------------------------------------------------------------


class _Actuators:
    """Reads which joints are driven, and how."""

    __slots__ = ("_notes", "_robot", "_said")

    def __init__(self, robot: Robot, said: set[str]) -> None:
        self._robot = robot
        self._said = said
        self._notes: dict[str, Element] = {}

    def read(self, controls: list[Placed], transmissions: list[Placed]) -> list[Element]:
        """Return a note for each joint; `<ros2_control>` wins over `<transmission>`."""
        for control, trace in controls:
            for joint in control.elements():
                if joint.name == "joint":
                    names = [
                        attribute_text(each, "name") or ""
                        for each in joint.elements()
                        if each.name == "command_interface"
                    ]
                    self._add(joint, trace, names)
            for inner in control.elements():
                if inner.name == "transmission":
                    self._add_gear(inner)
        for transmission, trace in transmissions:
            for joint in transmission.elements():
                if joint.name == "joint":
                    self._add(joint, trace, _interfaces(transmission, joint))
            self._add_gear(transmission)
        return list(self._notes.values())

    def _add(self, origin: Element, trace: Step | None, commands: list[str]) -> None:
        name = attribute_text(origin, "name") or ""
        joint = self._robot.joints.get(name)
        known = [command for command in commands if command in COMMANDS]
        if not known or joint is None or joint.type == FIXED or joint.mimic is not None:
            return
        if name in self._said or name in self._notes:
            return
        note = Note("actuator", origin, trace, joint=name, command=known[0])
        note.put("commands", " ".join(dict.fromkeys(filter(None, commands))), None)
        self._notes[name] = note.element

    def _add_gear(self, transmission: Element) -> None:
        """Note how often a motor turns for one turn of its joint."""
        if SIMPLE not in _type_of(transmission):
            return
        joint = child_named(transmission, "joint")
        note = self._notes.get(attribute_text(joint, "name") or "")
        if note is None or "gear" in note.attributes:
            return
        places = (joint, child_named(transmission, "actuator"), transmission)
        for tag in ("mechanical_reduction", "mechanicalReduction"):
            texts = [content_at(place, tag) for place in places]
            text = next((text for text in texts if len(numbers_in(text)) == 1), None)
            if text is not None:
                note.attributes["gear"] = text
                return


def _type_of(transmission: Element) -> str:
    written = attribute_text(transmission, "type") or content_at(transmission, "type")
    return written or content_at(transmission, "plugin") or ""


def _interfaces(transmission: Element, joint: Element) -> list[str]:
    """Return the commands that a transmission of ros_control takes for a joint.

    Older files name the interface in the actuator.
    """
    actuators = [each for each in transmission.elements() if each.name == "actuator"]
    for place in (joint, *actuators):
        texts = [content(each) for each in place.elements() if each.name == "hardwareInterface"]
        found = [INTERFACES.get((text or "").split("/")[-1]) for text in texts]
        commands = [command for command in found if command is not None]
        if commands:
            return commands
    return ["effort"] if _type_of(transmission).startswith(EFFORT_TRANSMISSIONS) else []


# --- control ----------------------------------------------------------------------------------


def _control(element: Element, trace: Step | None) -> Element:
    """Return the note of a `<ros2_control>`."""
    note = Note("ros2_control", element, trace)
    for attribute in ("name", "type"):
        note.put(attribute, attribute_text(element, attribute), None)
        note.places[attribute] = element.value_span(attribute)
    hardware = child_named(element, "hardware")
    plugin = inside(hardware, "plugin") or inside(hardware, "classType")
    note.put("plugin", content(plugin), plugin)
    params = Element("params", element.span, {}, trace=trace)
    for child in hardware.elements() if hardware is not None else ():
        if child.name == "param":
            name, text = attribute_text(child, "name") or "", content(child) or ""
            params.children.append(Element(name, child.span, {}, [Text(text, child.span)]))
    note.element.children.append(params)
    for child in element.elements():
        name = attribute_text(child, "name") or ""
        if child.name == "joint":
            note.put_child("joint", child, "joint", name)
        elif child.name == "sensor":
            note.put_child("sensor", child, "name", name)
        elif child.name == "transmission":
            note.put("transmissions", "true", child)
    return note.element


def _read_imus(robot: Robot, sensors: GazeboSensors, control: Element, trace: Step | None) -> None:
    """Note the imus of a `<ros2_control>` whose link is named, unless Gazebo has them as well."""
    for sensor in control.elements():
        if sensor.name != "sensor":
            continue
        interfaces = [
            attribute_text(each, "name") or ""
            for each in sensor.elements()
            if each.name == "state_interface"
        ]
        frames = [
            content(each) or ""
            for each in sensor.elements()
            if each.name == "param" and attribute_text(each, "name") == "frame_id"
        ]
        is_imu = bool(interfaces) and all(each.startswith(IMU_INTERFACES) for each in interfaces)
        if is_imu and frames and frames[0] in robot.links:
            sensors.add_imu(sensor, trace, frames[0])
