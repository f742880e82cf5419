"""Sensors as the words of the model have them.

MJCF has them whole in blocks beside that, so the notes say which format they come from.
"""

from __future__ import annotations

from math import atan, isclose, radians, tan

from ...model import making
from ...model.making import Place
from ...model.pose import IDENTITY, Pose
from ...xml.tree import SAID, Element
from .blocks import NAME
from .compiler import number, numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.making import Value
    from ...source import Span
    from .building import Builder
    from .classes import Given
    from .tree import Placed, Thing

T_CAMERA_SENSOR = Pose(((0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0)))
"""A camera of MuJoCo looks along −z, with y up; one of the model along x, with z up."""
T_SITE_SENSOR = Pose(((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)))
"""MuJoCo measures distances along z, the model along x."""
MOST_RANGE = 100.0
"""In m: the greatest distance of a sensor that has none."""
_OF_CAMERA = frozenset(
    """pos quat euler axisangle xyaxes zaxis fovy resolution mode projection sensorsize focal
    focalpixel""".split()
)
"""What a camera of the model holds; not that its centre is off, or its pixels are not square."""
IMU = {"accelerometer": "linear_acceleration", "gyro": "angular_velocity"}
WRENCH = ("force", "torque")
RANGE = "range"
ALONE = {"touch": "contact", "magnetometer": "magnetometer", "rangefinder": RANGE}
"""The sensors that alone are one of the model."""


def add_camera(builder: Builder, link: str, thing: Placed, element: Element) -> None:
    """Note a camera that stands still in its body and has a size: others only show the scene.

    Args:
        builder: the robot.
        link: the link of the body.
        thing: the camera.
        element: what is kept of it.
    """
    given = thing.given
    size = numbers(given, "resolution", 2) or [1.0, 1.0]
    is_still = thing.text("mode") in (None, "fixed") and thing.text("projection") != "orthographic"
    if min(size) <= 1 or not is_still or not thing.name:
        return
    tangents = _half_angles(given, size)
    if tangents is None:
        return
    across, up = tangents
    pose = thing.context.compiler.pose(given)
    pose = (pose if thing.pose is IDENTITY else thing.pose @ pose) @ T_CAMERA_SENSOR
    values: dict[str, Value] = {
        "type": "camera",
        "link": link,
        "frame": link,
        **_pose(pose),
        "fov": 2 * atan(across),
        "size": (size[0], size[1]),
        "optical_frame": "",
    }
    lens = next((each for each in ("focalpixel", "focal", "fovy") if each in given), "fovy")
    places = {"fov": thing.where(lens), "size": thing.where("resolution")}
    is_square = isclose(across * size[1], up * size[0], rel_tol=1e-9)
    parts = [(thing, element)] if is_square and given.keys() <= _OF_CAMERA else []
    _add(builder, thing, thing.name, parts, values, places)


def _half_angles(given: Given, size: Sequence[float]) -> tuple[float, float] | None:
    """Return the tangents of half the angles that a camera sees across and up.

    MuJoCo takes half the size of the sensor over the focal length, and that in pixels before that
    in metres. None if the camera has no focal length, for which MuJoCo takes half a turn.
    """
    sensor = numbers(given, "sensorsize", 2)
    if sensor is None or min(sensor) <= 0:
        up = tan(radians(number(given, "fovy", 45.0)) / 2)
        return (up * size[0] / size[1], up) if up > 0 else None
    metres = numbers(given, "focal", 2) or [0.0, 0.0]
    pixels = numbers(given, "focalpixel", 2) or [0.0, 0.0]
    lengths = [pixels[i] * sensor[i] / size[i] if pixels[i] else metres[i] for i in (0, 1)]
    if min(lengths) <= 0:
        return None
    return sensor[0] / 2 / lengths[0], sensor[1] / 2 / lengths[1]


def _pose(pose: Pose) -> dict[str, Value]:
    return {"xyz": pose.position, "rpy": pose.rpy}


def add_sensors(builder: Builder, things: Mapping[int, tuple[Thing, Element]]) -> None:
    """Note the sensors that the model has.

    Args:
        builder: the robot.
        things: the sensors, each with what is kept of it.
    """
    at_sites: dict[str, dict[str, tuple[Thing, Element]]] = {}
    for thing, element in things.values():
        site = thing.text("site")
        if site in builder.sites and thing.kind in (*IMU, *WRENCH, *ALONE):
            at_sites.setdefault(site, {}).setdefault(thing.kind, (thing, element))
    for site, found in at_sites.items():
        link, frame = builder.sites[site]
        if IMU.keys() <= found.keys():
            parts = [found[kind] for kind in IMU]
            noise = {IMU[t.kind]: number(t.given, "noise", 0.0) for t, _ in parts}
            values: dict[str, Value] = {"type": "imu", "link": link, "frame": frame}
            same = noise["angular_velocity"]
            if same == noise["linear_acceleration"]:
                values |= {"noise": same} if same else {}
            else:
                values["noises"] = " ".join(f"{name} {value!r}" for name, value in noise.items())
            _add(builder, parts[0][0], site, parts, values)
        joint = builder.above.get(link)
        if all(kind in found for kind in WRENCH) and joint is not None:
            parts = [found[kind] for kind in WRENCH]
            wrench: dict[str, Value] = {"type": "force_torque", "joint": joint}
            _add(builder, parts[0][0], site, parts, wrench)
        for kind, word in ALONE.items():
            if kind in found:
                thing = found[kind][0]
                values = {"type": word, "link": link, "frame": frame}
                if word == RANGE:
                    values |= _pose(T_SITE_SENSOR)
                    values["range"] = (0.0, number(thing.given, "cutoff", 0.0) or MOST_RANGE)
                _add(builder, thing, thing.name or site, [found[kind]], values)


def _add(
    builder: Builder,
    thing: Thing,
    wanted: str,
    parts: Sequence[tuple[Thing, Element]],
    values: Mapping[str, Value],
    places: Mapping[str, Span] | None = None,
) -> None:
    """Note a sensor; what is kept of its parts then says nothing more."""
    name = builder.fresh("sensor", wanted)
    place = Place(thing.span, {"name": thing.name_span, **(places or {})})
    builder.rest.append(making.note("sensor", place, {"name": name, **values, "of": NAME}))
    for _, element in parts:
        element.body = SAID
