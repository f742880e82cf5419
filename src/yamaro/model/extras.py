"""What a robot has besides links and joints: sensors, actuators, surfaces, states, groups, loops.

URDF has no elements for these, so that they are read from notes beside the finished `<robot>`:
elements whose names and attributes `robot/notes.py` and the modules that make them describe. What
the robot says in elements of other programs, such as `<gazebo>`, `recognition.py` notes.
"""

from __future__ import annotations

from math import tau

from ..source import Public
from .pose import IDENTITY, Pose, rotation_from_rpy
from .schema import ACTUATOR, COLLISIONS, SENSORS, SURFACE, TEXT, WHOLE
from .values import ByName, Written, attribute_text, number_in, numbers_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Element
    from .controllers import Controller, ControllerManager, Parameters
    from .pose import Vector
    from .schema import Thing


# --- sensors ----------------------------------------------------------------------------------


LIDAR, RANGE, FORCE_TORQUE = "lidar", "range", "force_torque"
CAMERAS = ("camera", "depth_camera")
MEASURED = {
    "imu": ("angular_velocity", "linear_acceleration"),
    FORCE_TORQUE: ("force", "torque"),
    "gps": ("position_sensing",),
}
"""What the one number for a sensor's noise is about."""
_FULL_CIRCLE_TOLERANCE = 1e-9


class Lidar(Public):
    """What a lidar sees: rays in rows, about the z axis of its frame.

    Attributes:
        rays: how many rays a row has; 360 by default.
        angle: the horizontal angle that they cover, in radians; a full circle by default.
        rows: how many rows there are; 1 by default.
        tilt: the vertical angle that the rows cover, in radians; 0 by default.
        range: the least and the greatest distance, in metres; 0.1 and 10 by default.
    """

    __slots__ = ("_ends", "_tilt_ends", "angle", "range", "rays", "rows", "tilt")

    rays: int
    angle: float
    rows: int
    tilt: float
    range: tuple[float, float]

    def __init__(self, element: Element) -> None:
        _take_details(self, element, LIDAR)
        step = self.angle / self.rays if _is_circle(self.angle) else 0.0
        self._ends = (-self.angle / 2, self.angle / 2 - step)
        self._tilt_ends = (-self.tilt / 2, self.tilt / 2)
        if "ends" in element.attributes:
            self._ends = first, last = _pair(element, "ends", self._ends)
            self._tilt_ends = lowest, highest = _pair(element, "tilt_ends", self._tilt_ends)
            self.angle, self.tilt = last - first, highest - lowest
            self.angle = tau if _is_circle(self.angle + self.step) else self.angle

    @property
    def step(self) -> float:
        """Return the angle between two rays; a full circle does not repeat its first ray."""
        first, last = self._ends
        return 0.0 if self.rays == 1 else (last - first) / (self.rays - 1)

    def ends(self) -> tuple[float, float]:
        """Return the angles of the first and the last ray about z; 0 is straight ahead."""
        return (0.0, 0.0) if self.rays == 1 else self._ends

    def tilt_ends(self) -> tuple[float, float]:
        """Return the angles of the lowest and the highest row above the horizontal."""
        return (0.0, 0.0) if self.rows == 1 else self._tilt_ends


def _is_circle(angle: float) -> bool:
    return abs(angle - tau) <= _FULL_CIRCLE_TOLERANCE


class Camera(Public):
    """What a camera sees along the x axis of its frame.

    Attributes:
        size: width and height in pixels; 640 and 480 by default.
        fov: the horizontal angle of view, in radians; π/3 by default.
        clip: the least and the greatest distance seen, in metres; 0.05 and 100 by default.
    """

    __slots__ = ("clip", "fov", "size")

    size: tuple[int, int]
    fov: float
    clip: tuple[float, float]

    def __init__(self, element: Element) -> None:
        _take_details(self, element, "camera")


class Ranger(Public):
    """What a sensor of one distance sees along the x axis of its frame.

    Attributes:
        range: the least and the greatest distance, in metres; 0.02 and 4 by default.
        fov: the angle of its cone, in radians; 0 by default.
    """

    __slots__ = ("fov", "range")

    range: tuple[float, float]
    fov: float

    def __init__(self, element: Element) -> None:
        _take_details(self, element, RANGE)


class Sensor(Written):
    """A sensor in a link or in a joint.

    Attributes:
        name: its name.
        written_name: what a file calls it; `name` differs if several sensors are called so.
        type: `imu`, `lidar`, `camera`, `depth_camera`, `gps`, `contact`, `magnetometer`, `range`,
            or in a joint `force_torque`.
        link: the name of the link that it is in, or None.
        joint: the name of the joint that it is in, or None.
        frame: the name of the frame that it measures in; None in a joint.
        rate: in Hz, or None.
        pose: T_frame_sensor; nothing but what a file written for Gazebo says of a sensor that has
            no frame of its own.
        noise: the standard deviation, in the unit of what is measured, or None.
        noises: the standard deviation of each quantity, such as `angular_velocity`, where one
            number does not say it; `noise` is None then.
        topic: the name of its topic, or None.
        details: what a lidar, a camera or a range sensor sees; else None.
        trace: the calls and includes that led to it, innermost first.
    """

    __slots__ = (
        "details", "frame", "joint", "link", "name", "noise", "noises", "pose", "rate", "topic",
        "trace", "type", "written_name",
    )  # fmt: skip
    _internal = frozenset(("written_name",))

    def __init__(self, element: Element, trace: Step | None) -> None:
        self.element = element
        self.trace = trace
        self.name = attribute_text(element, "name") or ""
        self.written_name = attribute_text(element, "written_name") or self.name
        self.type = attribute_text(element, "type") or ""
        self.link = attribute_text(element, "link")
        self.joint = attribute_text(element, "joint")
        self.frame = attribute_text(element, "frame")
        self.rate = self.number("rate")
        self.pose = _pose(element)
        self.noise = self.number("noise")
        words = (attribute_text(element, "noises") or "").split()
        self.noises: Mapping[str, float] = dict(zip(words[::2], map(float, words[1::2])))  # noqa: B905
        self.topic = attribute_text(element, "topic")
        self.details = _details(element, self.type)

    @property
    def optical_frame(self) -> str | None:
        """Return the frame of a camera in which z points forward (REP 103), or None."""
        found = attribute_text(self.element, "optical_frame")
        if found is None and self.type in CAMERAS:
            return f"{self.name}_optical"
        return found or None

    def __repr__(self) -> str:
        return f"<Sensor '{self.name}' of type {self.type} at {self.span.place()}>"


def _details(element: Element, kind: str) -> Lidar | Camera | Ranger | None:
    if kind == LIDAR:
        return Lidar(element)
    if kind in CAMERAS:
        return Camera(element)
    return Ranger(element) if kind == RANGE else None


def _pose(element: Element) -> Pose:
    """Return the pose that a note of a file has."""
    if "xyz" not in element.attributes:
        return IDENTITY
    (x, y, z), (roll, pitch, yaw) = numbers_of(element, "xyz"), numbers_of(element, "rpy")
    return Pose(rotation_from_rpy(roll, pitch, yaw), (x, y, z))


def _pair(element: Element, attribute: str, default: tuple[float, float]) -> tuple[float, float]:
    row = numbers_of(element, attribute)
    return (row[0], row[1]) if len(row) == 2 else default


def _take_details(details: Lidar | Camera | Ranger, element: Element, kind: str) -> None:
    """Take the values of a type of sensor from an element: whole numbers where it counts."""
    for name, field in SENSORS[kind].fields.items():
        row = numbers_of(element, name)
        if len(row) != field.count:
            assert not isinstance(field.default, (str, type(None))), "all that it sees has defaults"
            row = field.default if isinstance(field.default, tuple) else (field.default,)
        values: list[object] = [max(int(n), 1) if field.sign == WHOLE else n for n in row]
        setattr(details, name, values[0] if field.count == 1 else tuple(values))


# --- actuators, surfaces, states, … -----------------------------------------------------------


class Noted(Written):
    """Something of a robot that is not an element of URDF.

    Attributes:
        trace: the calls and includes that led to it, innermost first.
    """

    __slots__ = ("trace",)

    def __init__(self, element: Element) -> None:
        self.element = element
        self.trace = element.trace_within(None)

    def _take(self, thing: Thing) -> None:
        """Take the values of a thing's fields from the attributes."""
        for name, field in thing.fields.items():
            found = (self.written(name) or None) if field.count == TEXT else self.number(name)
            setattr(self, name, field.default if found is None else found)

    def _text(self, attribute: str) -> str:
        return attribute_text(self.element, attribute) or ""

    def _named(self, kind: str, attribute: str) -> tuple[str, ...]:
        """Return an attribute of all children of a kind."""
        found = (
            attribute_text(each, attribute) for each in self.element.elements() if each.name == kind
        )
        return tuple(text for text in found if text is not None)


class Actuator(Noted):
    """What drives a joint.

    Attributes:
        joint: the name of the joint.
        command: `position`, `velocity` or `effort`: the first of those that it takes.
        kp: the gain of position, in N·m/rad or N/m, or None; that of velocity if a velocity
            actuator has no `kd`.
        kd: the gain of velocity, in N·m·s/rad or N·s/m, or None.
        frequency: of the joint with its armature alone, in Hz, which gives the gains; or None.
        damping_ratio: with that frequency; 1 by default.
        armature: the inertia of the rotor seen at the joint, in kg·m² or kg, or None.
        rotor_inertia: the inertia of the rotor itself, in kg·m², or None.
        gear: turns of the motor for one of the joint, or radians for a metre; 1 by default.
        stall_torque: the greatest torque or force at the joint, in N·m or N, or None.
        no_load_speed: the speed of the joint at which none is left, in rad/s or m/s, or None.
        delay: how long after a command it is obeyed, in s, or None.
        motor: the name of its motor in the catalogue, or None.
        commands: all commands that it takes; files may say others than these three.
    """

    __slots__ = (*ACTUATOR.fields, "commands", "joint")

    command: str
    kp: float | None
    kd: float | None
    frequency: float | None
    damping_ratio: float
    armature: float | None
    rotor_inertia: float | None
    gear: float
    stall_torque: float | None
    no_load_speed: float | None
    delay: float | None
    motor: str | None

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.joint = self._text("joint")
        self._take(ACTUATOR)
        self.commands = tuple(self._text("commands").split()) or (self.command,)


class Surface(Noted):
    """How a collision touches others; None for what is not given.

    Attributes:
        link: the name of the link.
        index: which of the link's collisions it is, from 0.
        friction: the coefficient of friction.
        friction2: that in the second direction; `friction` unless it is given.
        restitution: how much of its speed a body keeps when it bounces, from 0 to 1.
        stiffness: in N/m.
        damping: in N·s/m.
    """

    __slots__ = (*SURFACE.fields, "index", "link")

    friction: float | None
    friction2: float | None
    restitution: float | None
    stiffness: float | None
    damping: float | None

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.link = self._text("link")
        self.index = int(self.number("index") or 0)
        self._take(SURFACE)
        if self.friction2 is None:
            self.friction2 = self.friction

    _internal = frozenset(("values",))

    def values(self) -> tuple[float | None, ...]:
        """Return friction, friction2, restitution, stiffness and damping."""
        return tuple([getattr(self, name) for name in SURFACE.fields])


class Fitted(Noted):
    """Shapes of a link that were worked out from a mesh.

    Attributes:
        link: the name of the link.
        section: `collision` or `visual`.
        index: the number of the first of the link's collisions or visuals that it is, from 0.
        count: how many there are.
        word: `fit`, `decompose`, `spheres` or `triangles`.
        kind: with `fit` which shape was asked for, else "".
        made: which shape it is: `box` …, `hull`; or `pieces`, `spheres` or `mesh`,
            or `kept` where the mesh has few enough triangles.
        wanted: how many pieces, spheres or triangles were asked for; 0 with `fit`.
        covers: whether they contain the mesh.
        distance: the greatest distance between their surface and that of the mesh, in metres.
        excess: how much more volume they have, as a part of that of the mesh; None if the mesh is
            not closed.
        size: the longest side of the box around the mesh, in metres.
        mesh: the mesh file, as it is written.
        scale: the factors of the mesh.
        pose: T_link_mesh.
    """

    __slots__ = (
        "count", "covers", "distance", "excess", "index", "kind", "link", "made", "mesh", "pose",
        "scale",
        "section", "size", "wanted", "word",
    )  # fmt: skip

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.link = self._text("link")
        self.section = self._text("section")
        self.index = int(self.number("index") or 0)
        self.count = int(self.number("count") or 0)
        self.word = self._text("word")
        self.kind = self._text("kind")
        self.made = self._text("made")
        self.wanted = int(self.number("wanted") or 0)
        self.covers = self._text("cover") == "true"
        self.distance = float(self.number("distance") or 0.0)
        self.excess = self.number("excess")
        self.size = float(self.number("size") or 0.0)
        self.mesh = self._text("filename")
        row = numbers_of(element, "scale")
        self.scale: Vector = (row[0], row[1], row[2]) if len(row) == 3 else (1.0, 1.0, 1.0)
        x, y, z = numbers_of(element, "xyz") or (0.0, 0.0, 0.0)
        rpy = numbers_of(element, "rpy") or (0.0, 0.0, 0.0)
        self.pose = Pose(rotation_from_rpy(*rpy), (x, y, z))

    _internal = frozenset(("asked", "quality"))

    @property
    def asked(self) -> str:
        """Return what was asked for as it is written, such as `fit: capsule`."""
        return f"{self.word}: {self.kind or self.wanted}{', cover: true' if self.covers else ''}"

    def quality(self) -> str:
        """Return how good it is: `at most 3.1 mm from the mesh, 1.2 % of its size; …`."""
        part = self.distance / self.size if self.size else 0.0
        text = (
            f"at most {1000 * self.distance:.3g} mm from the mesh, {100 * part:.2g} % of its size"
        )
        if self.excess is None:
            return f"{text}; the mesh is not closed, so it has no volume"
        more = "more" if self.excess >= 0 else "less"
        return f"{text}; {100 * abs(self.excess):.3g} % {more} volume"


class State(Noted):
    """A named position of some of the robot's joints.

    Attributes:
        name: its name.
        positions: in radians or metres, by the joints' names.
    """

    __slots__ = ("_places", "name", "positions")

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.name = self._text("name")
        self.positions: dict[str, float] = {}
        self._places: dict[str, Span] = {}
        self.merge(element)

    _internal = frozenset(("merge",))

    def merge(self, element: Element) -> None:
        """Take the positions of another note of the same state; they win."""
        for child in element.elements():
            name, position = attribute_text(child, "joint"), number_in(child, "value")
            if name is not None and position is not None:
                self.positions[name] = position
                self._places[name] = child.value_span("value")

    def __repr__(self) -> str:
        return f"<State '{self.name}': {self.positions}>"

    def span_of(self, attribute: str) -> Span:
        """Return where the position of a joint is written, or else the state."""
        return self._places.get(attribute, self.span)


class Group(Noted):
    """A named group of links and joints.

    Attributes:
        name: its name.
        chains: the first and the last link of each chain.
        links, joints, groups: the names of its members.
        parent: the link that an end effector is mounted on, or None.
        is_end_effector: whether it is an end effector.
        kinematics: what is said of the solver for its chain: `solver` and its parameters.
    """

    __slots__ = (
        "chains", "groups", "is_end_effector", "joints", "kinematics", "links", "name", "parent",
    )  # fmt: skip

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.name = self._text("name")
        bases, tips = self._named("chain", "base_link"), self._named("chain", "tip_link")
        self.chains = tuple(zip(bases, tips))  # noqa: B905 - what a jail gives may be wrong
        self.links = self._named("link", "link")
        self.joints = self._named("joint", "joint")
        self.groups = self._named("robot-group", "name")
        self.parent = attribute_text(element, "parent_link")
        self.is_end_effector = self._text("end_effector") == "true"
        self.kinematics: Parameters = {}
        if any(each.name == "parameter" for each in element.elements()):
            from .controllers import parameters_in

            self.kinematics = parameters_in(element)


class CollisionSettings(Noted):
    """How the pairs of links that never collide are found.

    Attributes:
        samples: how many random positions are tried; 10,000 by default.
        seed: of the random positions; 1 by default.
        keep: the pairs of links that are checked in any case.
    """

    __slots__ = ("keep", "samples", "seed")

    samples: int
    seed: int
    keep: tuple[tuple[str, str], ...]

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self._take(COLLISIONS)
        self.samples, self.seed = int(self.samples), int(self.seed)
        pairs = zip(self._named("keep", "link_1"), self._named("keep", "link_2"))  # noqa: B905
        self.keep = tuple(pairs)


class Loop(Noted):
    """A joint that closes a loop of links.

    Attributes:
        name: its name.
        type: `fixed`, `ball` or `revolute`.
        between: the two frames or links that it joins.
        axis: of a revolute one, in the first frame; else None.
    """

    __slots__ = ("axis", "between", "name", "type")

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.name = self._text("name")
        self.type = self._text("type")
        self.between = (self._text("frame_1"), self._text("frame_2"))
        row = numbers_of(element, "axis")
        self.axis: Vector | None = (row[0], row[1], row[2]) if len(row) == 3 else None


class Control(Noted):
    """A piece of hardware that drives joints, as ros2_control knows it.

    Attributes:
        name: its name; None for the robot's.
        type: `system`, `actuator` or `sensor`.
        plugin: the class of the driver.
        joints, sensors: the names of those that it drives and reads.
        params: the parameters of the hardware.
        state: the name of the state that it starts in, or None.
        has_transmissions: whether each joint has a transmission.
    """

    __slots__ = (
        "has_transmissions", "joints", "name", "params", "plugin", "sensors", "state", "type",
    )  # fmt: skip

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.name = attribute_text(element, "name")
        self.type = self._text("type") or "system"
        self.plugin = self._text("plugin")
        self.joints = self._named("joint", "joint")
        self.sensors = self._named("sensor", "name")
        self.params: dict[str, str] = {}
        for child in element.elements():
            if child.name == "params":
                self.params.update({key.name: key.text().strip() for key in child.elements()})
        self.state = attribute_text(element, "state")
        self.has_transmissions = self._text("transmissions") == "true"


class Base(Noted):
    """How the robot is placed in the world.

    Attributes:
        type: `fixed` or `free`.
    """

    __slots__ = ("type",)

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.type = self._text("type")


class RawXml(Noted):
    """XML that is written in a file for one output format.

    Attributes:
        format: the output format.
        link: the name of the link that it is for, or None.
        joint: the name of the joint that it is for; None as well for the robot as a whole.
    """

    __slots__ = ("format", "joint", "link")

    def __init__(self, element: Element) -> None:
        super().__init__(element)
        self.format = self._text("format")
        self.link = attribute_text(element, "link")
        self.joint = attribute_text(element, "joint")

    @property
    def elements(self) -> list[Element]:
        """Return the elements, in the order written."""
        return self.element.elements()


class Extras:
    """What the notes of a robot say; see the properties of `Robot`."""

    __slots__ = (
        "actuators", "base", "collision_settings", "controller_manager", "controllers", "controls",
        "fits", "groups", "loops", "raw", "sensors", "states", "surfaces",
    )  # fmt: skip

    def __init__(self, notes: Sequence[Element] = ()) -> None:
        """Read the notes."""
        sensors = [Sensor(each, each.trace_within(None)) for each in _of(notes, "sensor")]
        self.sensors: Mapping[str, Sensor] = ByName("sensor", {each.name: each for each in sensors})
        actuators = map(Actuator, _of(notes, "actuator"))
        self.actuators: Mapping[str, Actuator] = ByName(
            "actuator", {each.joint: each for each in actuators}, ["*_joint"]
        )
        self.surfaces = tuple(map(Surface, _of(notes, "surface")))
        self.fits = tuple(map(Fitted, _of(notes, "fit")))
        self.states: dict[str, State] = ByName("state")
        for note in _of(notes, "state"):
            known = self.states.get(attribute_text(note, "name") or "")
            if known is not None:
                known.merge(note)
                continue
            state = State(note)
            self.states[state.name] = state
        groups = map(Group, _of(notes, "robot-group"))
        self.groups: Mapping[str, Group] = ByName("group", {each.name: each for each in groups})
        loops = map(Loop, _of(notes, "robot-loop"))
        self.loops: Mapping[str, Loop] = ByName("loop", {each.name: each for each in loops})
        self.raw = tuple(map(RawXml, _of(notes, "raw-block")))
        self.controls = tuple(map(Control, _of(notes, "ros2_control")))
        self.controllers: Mapping[str, Controller] = {}
        self.controller_manager: ControllerManager | None = None
        if any(each.name in ("robot-controller", "controller-manager") for each in notes):
            from .controllers import Controller, ControllerManager

            controllers = map(Controller, _of(notes, "robot-controller"))
            self.controllers = ByName("controller", {each.name: each for each in controllers})
            managers = [ControllerManager(each) for each in _of(notes, "controller-manager")]
            managers.sort(key=lambda each: each.trace is not None)  # that of the main file wins
            self.controller_manager = managers[0] if managers else None
        settings = [CollisionSettings(each) for each in _of(notes, "collisions")]
        self.collision_settings = settings[-1] if settings else None
        bases = [Base(each) for each in _of(notes, "base")]
        own = [base for base in bases if base.trace is None]  # those of the main file
        self.base = own[-1] if own else None


def _of(notes: Iterable[Element], kind: str) -> list[Element]:
    return [note for note in notes if note.name == kind]
