"""Sensors of a robot: what each measures, where, how often and how exactly."""

from __future__ import annotations

from math import tau

from ..source import Public
from .pose import IDENTITY, Pose, rotation_from_rpy
from .schema import SENSORS, WHOLE
from .values import Written, attribute_text, read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..diagnostics import Frame as Step
    from ..xml.tree import Element


LIDAR, RANGE, FORCE_TORQUE = "lidar", "range", "force_torque"
CAMERAS = ("camera", "depth_camera")
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
        _take(self, element, LIDAR)
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
        _take(self, element, "camera")


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
        _take(self, element, RANGE)


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
    (x, y, z), (roll, pitch, yaw) = _row(element, "xyz"), _row(element, "rpy")
    return Pose(rotation_from_rpy(roll, pitch, yaw), (x, y, z))


def _row(element: Element, attribute: str) -> tuple[float, ...]:
    found = read_numbers(attribute_text(element, attribute) or "")
    return found if isinstance(found, tuple) else ()


def _pair(element: Element, attribute: str, default: tuple[float, float]) -> tuple[float, float]:
    row = _row(element, attribute)
    return (row[0], row[1]) if len(row) == 2 else default


def _take(details: Lidar | Camera | Ranger, element: Element, kind: str) -> None:
    """Take the values of a type of sensor from an element: whole numbers where it counts."""
    for name, field in SENSORS[kind].fields.items():
        row = _row(element, name)
        if len(row) != field.count:
            assert not isinstance(field.default, (str, type(None))), "all that it sees has defaults"
            row = field.default if isinstance(field.default, tuple) else (field.default,)
        values: list[object] = [max(int(n), 1) if field.sign == WHOLE else n for n in row]
        setattr(details, name, values[0] if field.count == 1 else tuple(values))
