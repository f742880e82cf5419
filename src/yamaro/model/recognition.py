"""What a URDF says of sensors, surfaces, actuators and control in elements of other programs.

`<gazebo>`, `<ros2_control>` and `<transmission>` are read when a `Robot` is first asked for what
they say. What the words of YAML say wins, and nothing is there twice: a robot that was written
with these elements gives the same as the words it was made of, as far as the elements hold it.
"""

from __future__ import annotations

from math import radians

from ..xml.tree import Element, Text
from ..xml.values import Numbers
from .extras import CAMERAS, FORCE_TORQUE, LIDAR, MEASURED, RANGE
from .joint import FIXED
from .pose import IDENTITY, Pose, rotation_from_quaternion, rotation_from_rpy
from .schema import COMMANDS
from .values import (
    attribute_text,
    child_named,
    content,
    content_at,
    content_span,
    first_of,
    inside,
    number_at,
    numbers_in,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Element
    from .pose import Rotation
    from .robot import Robot

    Placed = tuple[Element, Step | None]


# --- notes ------------------------------------------------------------------------------------


class Note:
    """A note that is being made.

    Attributes:
        element: the note.
        places: where its values are written, by attribute.
    """

    __slots__ = ("element", "places")

    def __init__(self, kind: str, origin: Element, trace: Step | None, **given: str) -> None:
        """Begin a note.

        Args:
            kind: what it is about: `sensor`, `actuator`, `surface` or `ros2_control`.
            origin: the element that says it.
            trace: the calls and includes that led there.
            given: its first attributes.
        """
        self.places: dict[str, Span] = {}
        self.element = Element(kind, origin.span, dict(given), trace=trace, value_spans=self.places)

    def put(self, attribute: str, value: str | Numbers | None, origin: Element | None) -> bool:
        """Note numbers or a text that is not empty, and where; return whether it was noted."""
        if not value:
            return False
        self.element.attributes[attribute] = value
        if origin is not None:
            self.places[attribute] = content_span(origin)
        return True

    def put_number(self, attribute: str, origin: Element | None) -> bool:
        """Note the number in an element, unless it is negative; return whether it was noted."""
        text = content(origin)
        row = numbers_in(text)
        if text is None or len(row) != 1 or row[0] < 0:
            return False
        return self.put(attribute, Numbers((text,), row, row), origin)

    def put_child(self, kind: str, origin: Element, attribute: str, value: str) -> None:
        """Add a note with one attribute."""
        self.element.children.append(
            Element(kind, origin.span, {attribute: value}, trace=self.element.trace)
        )


# --- recognition ------------------------------------------------------------------------------


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
    root = robot.element
    outer: dict[str, list[Placed]] = {}
    for child in root.elements():
        trace = child.trace_within(root.trace_within(None))
        outer.setdefault(child.name, []).append((child, trace))
    gazebo, controls = outer.get("gazebo", []), outer.get("ros2_control", [])
    transmissions = outer.get("transmission", [])
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
            note: Note | None = None
            for element, trace in blocks:
                begun = note or Note("surface", element, trace, link=link, index=str(index))
                found = False
                for child in element.elements():
                    if child.name in SURFACE_TAGS:
                        found |= begun.put_number(SURFACE_TAGS[child.name], child)
                    elif child.name == "collision":
                        surface = child_named(child, "surface")
                        for attribute, path in SURFACE_PATHS.items():
                            found |= begun.put_number(attribute, inside(surface, *path))
                if found:
                    note = begun
            if note is not None:
                yield note.element


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
        if note is None:
            return
        self._add_rotor(note, child_named(transmission, "actuator"))
        if "gear" in note.attributes:
            return
        places = (joint, child_named(transmission, "actuator"), transmission)
        for tag in ("mechanical_reduction", "mechanicalReduction"):
            texts = [content_at(place, tag) for place in places]
            text = next((text for text in texts if len(numbers_in(text)) == 1), None)
            if text is not None:
                note.attributes["gear"] = text
                return

    def _add_rotor(self, note: Element, motor: Element | None) -> None:
        """Note the inertia of a rotor, its gear, and gains, as Drake reads them."""
        gains = child_named(motor, "drake:controller_gains") if motor is not None else None
        for attribute, name in (("p", "kp"), ("d", "kd")):
            text = attribute_text(gains, attribute) if gains is not None else None
            if len(numbers_in(text)) == 1 and name not in note.attributes:
                note.attributes[name] = text
        found = {}
        for tag, name in (("drake:rotor_inertia", "rotor_inertia"), ("drake:gear_ratio", "gear")):
            element = child_named(motor, tag) if motor is not None else None
            text = attribute_text(element, "value") if element is not None else None
            row = numbers_in(text)
            if len(row) == 1 and row[0] and name not in note.attributes:
                found[name] = row[0]
                note.attributes[name] = text
        if "rotor_inertia" in found:
            gear = numbers_in(str(note.attributes.get("gear", "1")))
            ratio = gear[0] if len(gear) == 1 else 1.0
            note.attributes["armature"] = Numbers.of(found["rotor_inertia"] * ratio * ratio)


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


# --- sensors for Gazebo -----------------------------------------------------------------------
# Sources: the elements and defaults of SDFormat 1.9 (sensor.sdf, lidar.sdf, camera.sdf, imu.sdf),
# of SDFormat 1.5, and the parameters of the plugins of gazebo_plugins and hector_gazebo_plugins.


TYPES = {
    **dict.fromkeys(("imu", "imu_sensor"), "imu"),
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar"), LIDAR),
    **dict.fromkeys(("camera", "wideanglecamera", "wide_angle_camera", "multicamera"), "camera"),
    **dict.fromkeys(("depth", "depth_camera", "rgbd", "rgbd_camera"), "depth_camera"),
    **dict.fromkeys(("gps", "navsat"), "gps"),
    "contact": "contact",
    "magnetometer": "magnetometer",
    "sonar": RANGE,
    "force_torque": FORCE_TORQUE,
}
"""The types of SDFormat that are known, with those of Gazebo classic, and what they are here."""
PLUGINS = {
    "gazebo_ros_ft_sensor": FORCE_TORQUE,
    "gazebo_ros_imu": "imu",
    "hector_gazebo_ros_imu": "imu",
    "hector_gazebo_ros_gps": "gps",
    "hector_gazebo_ros_magnetic": "magnetometer",
}
"""Plugins of a model that are sensors, without a `<sensor>`."""
RANGE_PLUGIN = "gazebo_ros_range"
"""The plugin that makes one distance of the rays of its sensor."""
HOMES = ("jointName", "joint_name", "bodyName", "body_name", "linkName", "link_name")
RATES = ("updateRate", "update_rate", "updateRateHZ")
TOPICS = (
    *("topicName", "topic_name", "bumperTopicName", "depthImageTopicName", "imageTopicName"),
    *("gps_topic", "gpsTopicName"),
)
FRAME_IDS = ("optical_frame_id", "frameName", "frame_name")
NOISES = ("gaussianNoise", "gaussian_noise")
DEFAULT_TOPIC = "__default_topic__"
"""SDFormat's default for a topic, which means that the simulator names it."""
QUANTITIES = {
    **dict.fromkeys(("angular_velocity", "rate"), "angular_velocity"),
    **dict.fromkeys(("linear_acceleration", "accel"), "linear_acceleration"),
    **{name: name for name in ("force", "torque", "position_sensing", "velocity_sensing")},
}
"""The elements around `<noise>` that say of what it is the noise."""
ALL = "all"
"""Means all that a sensor measures, where `<noise>` does not say more."""
OPTICAL: Rotation = ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
"""R_camera_optical: x forward and z up, to z forward and y down. Source: REP 103."""
_TOLERANCE = 0.01
"""Radians: files write π/2 with as few as three digits."""
_MOST_NESTED = 6
"""Levels of elements in a `<sensor>` that are looked at for noise."""


class GazeboSensors:
    """Reads the sensors of a robot.

    Attributes:
        notes: the notes of those found.
    """

    __slots__ = ("_poses", "_robot", "_taken", "notes")

    def __init__(self, robot: Robot, said: set[str]) -> None:
        """Begin with none.

        Args:
            robot: the robot.
            said: the names of sensors that are not to be read.
        """
        self._robot = robot
        self._taken = dict.fromkeys(said, "")
        self._poses: dict[str, Pose] | None = None
        self.notes: list[Element] = []

    def read(self, blocks: list[tuple[Element, Step | None]]) -> None:
        """Note the sensors in the `<gazebo>` elements of a robot."""
        for gazebo, trace in blocks:
            home = (attribute_text(gazebo, "reference") or "").strip()
            for child in gazebo.elements():
                if child.name == "sensor":
                    self._sensor(child, trace, home)
                elif child.name == "plugin":
                    self._plugin(child, trace)

    def add(self, sensor: Element, trace: Step | None, home: str) -> None:
        """Note a sensor of SDFormat in a link or joint, if its type is known."""
        self._sensor(sensor, trace, home)

    def add_imu(self, element: Element, trace: Step | None, link: str) -> None:
        """Note an imu in a link, unless there is one of its name."""
        name = attribute_text(element, "name") or ""
        if name and name not in self._taken:
            note = Note("sensor", element, trace, name=name, type="imu")
            self._place(note, link, IDENTITY)

    # --- a sensor ---

    def _sensor(self, element: Element, trace: Step | None, home: str) -> None:
        kind = TYPES.get(attribute_text(element, "type") or "")
        homes = self._robot.joints if kind == FORCE_TORQUE else self._robot.links
        if kind is None or home not in homes:
            return
        written = attribute_text(element, "name") or kind
        name = self._free_name(written, home)
        if name is None:
            return
        cameras = [each for each in element.elements() if each.name == "camera"]
        if attribute_text(element, "type") == "multicamera" and cameras:
            for number, camera in enumerate(cameras):
                own = f"{name}_{attribute_text(camera, 'name') or number}"
                note = Note("sensor", camera, trace, name=own, type=kind, written_name=written)
                self._read(note, element, home, camera)
            return
        note = Note("sensor", element, trace, name=name, type=kind, written_name=written)
        self._read(note, element, home, cameras[0] if cameras else None)

    def _read(self, note: Note, element: Element, home: str, camera: Element | None) -> None:
        """Note what a sensor says, and where it is."""
        kind = str(note.element.attributes["type"])
        plugins = [each for each in element.elements() if each.name == "plugin"]
        _read_rate(note, element, plugins)
        _read_topic(note, element, plugins)
        _read_noise(note, kind, element if camera is None else camera, plugins)
        if kind == FORCE_TORQUE:
            note.element.attributes["joint"] = home
            self.notes.append(note.element)
            return
        place = child_named(element, "pose")
        above = attribute_text(place, "relative_to") or attribute_text(place, "frame") or home
        frame = above if above in self._robot.links else home
        pose = _pose_in(place)
        if kind in CAMERAS:
            own = child_named(camera, "pose") if camera is not None else None
            pose = pose @ _pose_in(own)
            _read_camera(note, element if camera is None else camera, kind)
        elif kind in (LIDAR, RANGE):
            _read_rays(note, element, plugins)
        self._place(note, home, pose, frame)
        if kind in CAMERAS:
            named = [element, *([] if camera is None else [camera]), *plugins]
            # Note the link that is a camera's optical frame, if there is one.
            note.element.attributes["optical_frame"] = ""
            for place in named:
                for name in FRAME_IDS:
                    found = child_named(place, name)
                    link = content(found) or ""
                    if link in self._robot.links and self._is_optical(link, frame, pose):
                        note.put("optical_frame", link, found)
                        return
        elif kind == "contact":
            seen = first_of(element, ("gz_frame_id", "ignition_frame_id"))
            if content(seen) in self._robot.links:
                note.put("frame", content(seen), seen)

    def _place(self, note: Note, link: str, pose: Pose, frame: str | None = None) -> None:
        """Note where a sensor is; one in a frame of its name is of the link around."""
        given = note.element.attributes
        own = self._robot.frames.get(link) if link == given["name"] else None
        given["link"] = own.link if own is not None else link
        given["frame"] = frame or link
        if pose != IDENTITY:
            given["xyz"] = Numbers.exactly(*pose.position)
            given["rpy"] = Numbers.exactly(*pose.rpy)
        self._taken.setdefault(str(given["name"]), link)
        self.notes.append(note.element)

    def _free_name(self, name: str, home: str) -> str | None:
        """Return a name for a sensor, or None if words describe it.

        Two sensors may have one name in different links. The second is called by its link as well.
        """
        if self._taken.get(name) == "":
            return None
        free, number = name, 1
        while free in self._taken:
            free = f"{home}_{name}" if number == 1 else f"{home}_{name}_{number}"
            number += 1
        self._taken[free] = home
        return free

    def _is_optical(self, link: str, frame: str, pose: Pose) -> bool:
        """Return whether a link is turned like the optical frame of a camera."""
        if self._poses is None:
            self._poses = self._robot.poses()
        poses = self._poses
        rotation = (poses[frame] @ pose).inverse() @ poses[link]
        pairs = zip(rotation.rotation, OPTICAL, strict=True)
        return all(
            abs(a - b) <= _TOLERANCE for row, own in pairs for a, b in zip(row, own, strict=True)
        )

    # --- plugins ---

    def _plugin(self, element: Element, trace: Step | None) -> None:
        """Note the sensor that a plugin of the model is, if it is one."""
        kind = PLUGINS.get(_plugin_name(element))
        homes = self._robot.joints if kind == FORCE_TORQUE else self._robot.links
        where = first_of(element, HOMES)
        home = content(where) or ""
        if kind is None or home not in homes:
            return
        written = attribute_text(element, "name") or kind
        name = self._free_name(written, home)
        if name is None:
            return
        note = Note("sensor", element, trace, name=name, type=kind, written_name=written)
        _read_rate(note, element, [element])
        _read_topic(note, element, [element])
        _read_noise(note, kind, element, [element])
        if kind == FORCE_TORQUE:
            note.put("joint", home, where)
            self.notes.append(note.element)
            return
        xyz = numbers_in(content_at(element, "xyzOffset"))
        rpy = numbers_in(content_at(element, "rpyOffset"))
        rows = [row if len(row) == 3 else (0.0, 0.0, 0.0) for row in (xyz, rpy)]
        self._place(note, home, _pose_of((*rows[0], *rows[1])))


def _plugin_name(plugin: Element) -> str:
    """Return the name of a plugin's library, without what systems add to it."""
    file = (attribute_text(plugin, "filename") or "").split("/")[-1]
    return file.removeprefix("lib").removesuffix(".so")


# --- what all sensors say -----------------------------------------------------------------------


def _read_rate(note: Note, element: Element, plugins: list[Element]) -> None:
    """Note the rate: the sensor's, or else that of its plugin; 0 means as fast as can be."""
    for place in (child_named(element, "update_rate"), *(first_of(p, RATES) for p in plugins)):
        row = numbers_in(content(place))
        if len(row) == 1 and row[0] > 0:
            note.put("rate", content(place), place)
            return


def _read_topic(note: Note, element: Element, plugins: list[Element]) -> None:
    """Note the topic: the sensor's, or else that of its plugin for ROS."""
    own = first_of(element, ("topic",))
    if own is not None and content(own) != DEFAULT_TOPIC:
        note.put("topic", content(own), own)
        return
    for plugin in plugins:
        named = first_of(plugin, TOPICS)
        if named is not None:
            camera = content_at(plugin, "cameraName")
            topic = content(named) or ""
            is_whole = camera is None or "mage" not in named.name or topic.startswith("/")
            note.put("topic", topic if is_whole else f"{camera}/{topic}", named)
            return
        ros = child_named(plugin, "ros")
        for child in ros.elements() if ros is not None else ():
            source, arrow, target = (content(child) or "").partition(":=")
            if child.name in ("remapping", "argument") and arrow and source.startswith("~/"):
                space = (content_at(ros, "namespace") or "").rstrip("/")
                is_whole = not space or target.startswith("/")
                note.put("topic", target if is_whole else f"{space}/{target}", child)
                return


def _read_noise(note: Note, kind: str, element: Element, plugins: list[Element]) -> None:
    """Note the standard deviation: one for all that is measured, or one for each quantity."""
    found = list(_noises(element, ""))
    quantities: dict[str, set[str]] = {}
    for quantity, place in found:
        quantities.setdefault(quantity or ALL, set()).add(content(place) or "")
    values = set().union(*quantities.values()) if quantities else set()
    measured = MEASURED.get(kind, ())
    if len(values) == 1 and all(each in quantities for each in measured if ALL not in quantities):
        note.put("noise", values.pop(), found[0][1])
    elif quantities:
        each = {name: max(texts, key=float) for name, texts in quantities.items()}
        note.put("noises", " ".join(f"{name} {text}" for name, text in each.items()), found[0][1])
    else:
        for plugin in plugins:
            given = first_of(plugin, NOISES)
            if number_at(given, (), 0.0):
                note.put_number("noise", given)


def _noises(element: Element, quantity: str, depth: int = 0) -> Iterator[tuple[str, Element]]:
    """Yield each standard deviation in a sensor, with the quantity that it is of, or ""."""
    if depth > _MOST_NESTED:
        return
    for child in element.elements():
        quantity_of = QUANTITIES.get(child.name, quantity)
        if child.name == "noise" or element.name == "noise":  # that of an imu may hold two
            written = attribute_text(child, "type") or content_at(child, "type")
            if written == "none":
                continue
            own = child_named(child, "stddev")
            if len(numbers_in(content(own))) == 1 and own is not None:
                yield quantity_of, own
        if child.name != "plugin":
            yield from _noises(child, quantity_of, depth + 1)


# --- poses --------------------------------------------------------------------------------------


def _pose_in(element: Element | None) -> Pose:
    """Return the pose in a `<pose>` of SDFormat."""
    row = numbers_in(content(element))
    if attribute_text(element, "rotation_format") == "quat_xyzw" and len(row) == 7:
        return Pose(rotation_from_quaternion(*row[3:]), (row[0], row[1], row[2]))
    if attribute_text(element, "degrees") in ("true", "1") and len(row) == 6:
        row = (*row[:3], *map(radians, row[3:]))
    return _pose_of(row)


def _pose_of(row: tuple[float, ...]) -> Pose:
    """Return the pose of x, y, z, roll, pitch and yaw; nothing moves if these are not six."""
    if len(row) != 6 or not any(row):
        return IDENTITY
    x, y, z, roll, pitch, yaw = row
    return (
        Pose(rotation_from_rpy(roll, pitch, yaw), (x, y, z))
        if any(row[3:])
        else Pose(position=(x, y, z))
    )


# --- lidars and cameras -------------------------------------------------------------------------


def _read_rays(note: Note, element: Element, plugins: list[Element]) -> None:
    """Note the rays of a lidar; one ray alone measures one distance, as does a cone."""
    given = note.element.attributes
    sonar = child_named(element, "sonar")
    rays = child_named(element, "ray") or child_named(element, "lidar")
    distance = rays if sonar is None else sonar
    path = ("range",) if sonar is None else ()
    ends = [number_at(distance, (*path, end), 0.0) for end in ("min", "max")]
    note.put("range", Numbers.exactly(*ends), inside(distance, *path))
    rows = [_scan(rays, direction, count) for direction, count in _DIRECTIONS]
    (count, across), (height, up) = rows
    cones = [plugin for plugin in plugins if _plugin_name(plugin) == RANGE_PLUGIN]
    if sonar is not None or cones or count == height == 1:
        given["type"] = RANGE
        if cones:
            fov = number_at(cones[0], ("fov",), across[1] - across[0])
            given["fov"] = Numbers.exactly(max(fov, 0.0))
        return
    given |= {"rays": str(count), "rows": str(height)}
    for attribute, pair in (("ends", across), ("tilt_ends", up)):
        given[attribute] = Numbers.exactly(*pair)


_DIRECTIONS = (("horizontal", 640), ("vertical", 1))
"""The directions of rays, with the default number in SDFormat."""


def _scan(rays: Element | None, direction: str, default: int) -> tuple[int, tuple[float, float]]:
    """Return how many rays there are in a direction, and the first and the last angle."""
    place = inside(rays, "scan", direction)
    count = max(int(number_at(place, ("samples",), default)), 1)
    least, most = (number_at(place, (f"{end}_angle",), 0.0) for end in ("min", "max"))
    return count, (least, most)


def _read_camera(note: Note, element: Element, kind: str) -> None:
    """Note what a camera sees, with SDFormat's defaults."""
    given = note.element.attributes
    size = [number_at(element, ("image", each), n) for each, n in (("width", 320), ("height", 240))]
    given["size"] = " ".join(str(max(int(each), 1)) for each in size)
    fov = child_named(element, "horizontal_fov")
    if not note.put_number("fov", fov):
        given["fov"] = "1.047"
    own = inside(element, "depth_camera", "clip") if kind == "depth_camera" else None
    clip = own or child_named(element, "clip")
    ends = [number_at(clip, (end,), n) for end, n in (("near", 0.1), ("far", 100.0))]
    note.put("clip", Numbers.exactly(*ends), clip)
