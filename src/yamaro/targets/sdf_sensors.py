"""What SDFormat says of sensors and of surfaces, in SDF and in the `<gazebo>` elements of URDF.

Source: the specification of SDFormat 1.9 and 1.11, http://sdformat.org/spec.
"""

from __future__ import annotations

from ..model.extras import Camera, Lidar, Ranger
from .tags import Tag, given

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..model.extras import Sensor, Surface

TYPES = {"lidar": "gpu_lidar", "range": "gpu_lidar", "gps": "navsat"}
"""The types of sensors that Gazebo calls otherwise."""


def type_of(sensor: Sensor) -> str:
    """Return the type of a sensor in SDFormat."""
    return TYPES.get(sensor.type, sensor.type)


def times_of(sensor: Sensor) -> list[Tag]:
    """Return how often a sensor measures, and where it says what it has measured."""
    return [
        Tag("always_on", "true"),
        *given(("update_rate", sensor.rate), ("topic", sensor.topic)),
    ]


def details_of(sensor: Sensor, collisions: Sequence[str], *, has_optical: bool = True) -> list[Tag]:
    """Return what a sensor has of its type.

    Args:
        sensor: the sensor.
        collisions: the names of the shapes that a contact sensor feels.
        has_optical: whether the optical frame of a camera is named, which SDFormat 1.9 has not.
    """
    noise, details = _noise(sensor), sensor.details
    if isinstance(details, Lidar):
        return [Tag("lidar", [*_lidar(details), *noise])]
    if isinstance(details, Ranger):
        scan = Tag("scan", [Tag("horizontal", _rays(1, (0.0, 0.0)))])
        return [Tag("lidar", [scan, _range(details.range), *noise])]
    if isinstance(details, Camera):
        optical = [Tag("optical_frame_id", sensor.optical_frame or "")] if has_optical else []
        return [Tag("camera", [*_camera(sensor, details), *optical, *noise])]
    if sensor.type == "contact":
        return [Tag("contact", [Tag("collision", name) for name in collisions])]
    if sensor.type == "force_torque":
        directions = [Tag("frame", "child"), Tag("measure_direction", "child_to_parent")]
        return [Tag("force_torque", [*directions, *_by_axis(noise, "force", "torque")])]
    if not noise:
        return []
    if sensor.type == "imu":
        return [Tag("imu", _by_axis(noise, "angular_velocity", "linear_acceleration"))]
    if sensor.type == "magnetometer":
        return [Tag("magnetometer", [Tag(axis, noise) for axis in "xyz"])]
    both = [Tag("horizontal", noise), Tag("vertical", noise)]
    return [Tag("navsat", [Tag("position_sensing", both)])]


def _lidar(lidar: Lidar) -> list[Tag]:
    rows = [Tag("vertical", _rays(lidar.rows, lidar.tilt_ends()))] if lidar.rows > 1 else []
    scan = Tag("scan", [Tag("horizontal", _rays(lidar.rays, lidar.ends())), *rows])
    return [scan, _range(lidar.range)]


def _rays(count: int, ends: tuple[float, float]) -> list[Tag]:
    """Return samples from the first to the last angle, which Gazebo both includes."""
    first, last = ends
    return given(("samples", count), ("resolution", 1), ("min_angle", first), ("max_angle", last))


def _range(ends: tuple[float, float]) -> Tag:
    return Tag("range", given(("min", ends[0]), ("max", ends[1])))


def _camera(sensor: Sensor, camera: Camera) -> list[Tag]:
    width, height = camera.size
    pixels = "R_FLOAT32" if sensor.type == "depth_camera" else "R8G8B8"
    return [
        Tag("horizontal_fov", camera.fov),
        Tag("image", given(("width", width), ("height", height), ("format", pixels))),
        Tag("clip", given(("near", camera.clip[0]), ("far", camera.clip[1]))),
    ]


def _noise(sensor: Sensor) -> list[Tag]:
    """Return the noise of a sensor: lidars and cameras have its type as an element in it."""
    if sensor.noise is None:
        return []
    values = given(("mean", 0.0), ("stddev", sensor.noise))
    if sensor.details is not None:
        return [Tag("noise", [Tag("type", "gaussian"), *values])]
    return [Tag("noise", values, type="gaussian")]


def _by_axis(noise: list[Tag], *names: str) -> list[Tag]:
    if not noise:
        return []
    return [Tag(name, [Tag(axis, noise) for axis in "xyz"]) for name in names]


def surface_of(surface: Surface | None, more: Iterable[tuple[str, Tag]] = ()) -> Tag:
    """Return the surface of a collision.

    Args:
        surface: what is known of it.
        more: what else is in it for ODE, each with `friction` or `contact`.
    """
    friction, bounce, contact = [], [], []
    if surface is not None:
        friction = given(("mu", surface.friction), ("mu2", surface.friction2))
        bounce = given(("restitution_coefficient", surface.restitution))
        contact = given(("kp", surface.stiffness), ("kd", surface.damping))
    friction += [tag for section, tag in more if section == "friction"]
    contact += [tag for section, tag in more if section == "contact"]
    parts = []
    if friction:
        parts.append(Tag("friction", [Tag("ode", friction)]))
    if bounce:
        parts.append(Tag("bounce", bounce))
    if contact:
        parts.append(Tag("contact", [Tag("ode", contact)]))
    if surface is None:
        return Tag("surface", parts)
    return Tag("surface", parts, span=surface.span, trace=surface.trace)
