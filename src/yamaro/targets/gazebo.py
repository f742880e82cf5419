"""The `<gazebo>` elements of a robot's sensors and surfaces, as Gazebo (gz-sim) reads them in URDF.

Source: SDFormat 1.9 and its conversion of URDF, which moves what refers to a frame into its link.
"""

from __future__ import annotations

from ..diagnostics import Reporter
from ..model.joint import FIXED
from ..model.sensors import Camera, Lidar, Ranger
from ..xml.tree import Element, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..model.extras import Surface
    from ..model.robot import Robot
    from ..model.sensors import Sensor

    Content = str | float | tuple["Tag", ...]
    Tag = tuple[str, Content]

TYPES = {"lidar": "gpu_lidar", "range": "gpu_lidar", "gps": "navsat"}
"""The types of sensors that Gazebo calls otherwise."""
CONTROL = "ros2_control"
GAUSSIAN = "noise of type gaussian"
"""Is written as `<noise type="gaussian">`; lidars and cameras have the type as an element in it."""


def with_gazebo(root: Element, robot: Robot, reporter: Reporter) -> Element:
    """Return a robot with the elements of its sensors and surfaces, before `<ros2_control>`."""
    made = [_sensor(robot, sensor) for sensor in robot.sensors.values()]
    made += _surfaces(robot, reporter)
    if not made:
        return root
    children = root.children
    end = len(children)
    while end:
        last = children[end - 1]
        if not isinstance(last, Element) or last.name != CONTROL:
            break
        end -= 1
    return root.with_children([*children[:end], *made, *children[end:]])


# --- sensors ----------------------------------------------------------------------------------


def _sensor(robot: Robot, sensor: Sensor) -> Element:
    """Return `<gazebo>` with a sensor, in the link or joint that it measures at."""
    tags: list[Tag] = [("always_on", "true")]
    if sensor.rate is not None:
        tags.append(("update_rate", sensor.rate))
    if sensor.topic is not None:
        tags.append(("topic", sensor.topic))
    if sensor.frame is not None:
        tags.append(("gz_frame_id", sensor.frame))
    tags += _details(sensor)
    block = _made(sensor, "sensor", tuple(tags))
    kind = TYPES.get(sensor.type, sensor.type)
    block.attributes = {"name": sensor.name, "type": kind}
    # A contact sensor is of the link's shapes, wherever its frame is.
    place = sensor.link if sensor.type == "contact" else sensor.frame
    gazebo = _made(sensor, "gazebo", ())
    gazebo.attributes = {"reference": sensor.joint or place or ""}
    joint = robot.joints.get(sensor.joint or "")
    if joint is not None and joint.type == FIXED:
        gazebo.children.append(_made(sensor, "preserveFixedJoint", "true"))
    gazebo.children.append(block)
    return gazebo


def _details(sensor: Sensor) -> list[Tag]:
    """Return what a sensor has of its type."""
    noise, details = _noise(sensor), sensor.details
    if isinstance(details, Lidar):
        return [("lidar", (*_lidar(details), *noise))]
    if isinstance(details, Ranger):
        scan = ("scan", (("horizontal", _rays(1, (0.0, 0.0))),))
        return [("lidar", (scan, _range(details.range), *noise))]
    if isinstance(details, Camera):
        return [("camera", (*_camera(sensor, details), *noise))]
    if sensor.type == "contact":
        return [("contact", (("collision", f"{sensor.link}_collision"),))]
    if sensor.type == "force_torque":
        directions: tuple[Tag, ...] = (
            ("frame", "child"),
            ("measure_direction", "child_to_parent"),
        )
        return [("force_torque", (*directions, *_by_axis(noise, "force", "torque")))]
    if not noise:
        return []
    if sensor.type == "imu":
        return [("imu", _by_axis(noise, "angular_velocity", "linear_acceleration"))]
    if sensor.type == "magnetometer":
        return [("magnetometer", tuple((axis, noise) for axis in "xyz"))]
    both: tuple[Tag, ...] = (("horizontal", noise), ("vertical", noise))
    return [("navsat", (("position_sensing", both),))]


def _lidar(lidar: Lidar) -> tuple[Tag, ...]:
    rows: tuple[Tag, ...] = ()
    if lidar.rows > 1:
        rows = (("vertical", _rays(lidar.rows, lidar.tilt_ends())),)
    return (
        ("scan", (("horizontal", _rays(lidar.rays, lidar.ends())), *rows)),
        _range(lidar.range),
    )


def _rays(count: int, ends: tuple[float, float]) -> tuple[Tag, ...]:
    """Return samples from the first to the last angle, which Gazebo both includes."""
    return (
        ("samples", float(count)),
        ("resolution", 1.0),
        ("min_angle", ends[0]),
        ("max_angle", ends[1]),
    )


def _range(ends: tuple[float, float]) -> Tag:
    return ("range", (("min", ends[0]), ("max", ends[1])))


def _camera(sensor: Sensor, camera: Camera) -> tuple[Tag, ...]:
    width, height = camera.size
    pixels = "R_FLOAT32" if sensor.type == "depth_camera" else "R8G8B8"
    image: tuple[Tag, ...] = (
        ("width", float(width)),
        ("height", float(height)),
        ("format", pixels),
    )
    return (
        ("horizontal_fov", camera.fov),
        ("image", image),
        ("clip", (("near", camera.clip[0]), ("far", camera.clip[1]))),
        ("optical_frame_id", sensor.optical_frame or ""),
    )


def _noise(sensor: Sensor) -> tuple[Tag, ...]:
    if sensor.noise is None:
        return ()
    values: tuple[Tag, ...] = (("mean", 0.0), ("stddev", sensor.noise))
    if sensor.details is not None:
        return (("noise", (("type", "gaussian"), *values)),)
    return ((GAUSSIAN, values),)


def _by_axis(noise: tuple[Tag, ...], *names: str) -> tuple[Tag, ...]:
    if not noise:
        return ()
    return tuple((name, tuple((axis, noise) for axis in "xyz")) for name in names)


# --- surfaces ---------------------------------------------------------------------------------


def _surfaces(robot: Robot, reporter: Reporter) -> list[Element]:
    """Return `<gazebo>` with the surface of each link: URDF has one for all of its collisions."""
    first: dict[str, Surface] = {}
    for surface in robot.surfaces:
        known = first.setdefault(surface.link, surface)
        if known.values() != surface.values():
            reporter.warn(
                "several-surfaces",
                f"the collisions of the link '{surface.link}' have several surfaces, and Gazebo "
                "reads one for a link",
                surface.span,
                hint="give them the same surface, or move the collision to a link of its own",
                notes=(f"the one that is written is at {known.span.place()}",),
                trace=surface.trace,
            )
    made = []
    for link, surface in first.items():
        gazebo = _made(surface, "gazebo", _surface(surface))
        gazebo.attributes = {"reference": link}
        made.append(gazebo)
    return made


def _surface(surface: Surface) -> tuple[Tag, ...]:
    contact = _given(("kp", surface.stiffness), ("kd", surface.damping))
    if surface.restitution is None:
        return (*_given(("mu1", surface.friction), ("mu2", surface.friction2)), *contact)
    # Restitution has no short form, and the short forms go astray beside the long one.
    friction = _given(("mu", surface.friction), ("mu2", surface.friction2))
    bounce: Tag = ("restitution_coefficient", surface.restitution)
    whole: tuple[Tag, ...] = (
        ("friction", (("ode", friction),)),
        ("bounce", (bounce,)),
        ("contact", (("ode", contact),)),
    )
    return (("collision", (("surface", whole),)),)


def _given(*tags: tuple[str, float | None]) -> tuple[Tag, ...]:
    return tuple((name, value) for name, value in tags if value is not None)


# --- elements ---------------------------------------------------------------------------------


def _made(owner: Sensor | Surface, name: str, content: Content) -> Element:
    """Return an element at the place of a sensor or surface."""
    element = Element(name, owner.span, {}, trace=owner.trace)
    if name == GAUSSIAN:
        element.name, element.attributes = "noise", {"type": "gaussian"}
    if isinstance(content, tuple):
        element.children = [_made(owner, *tag) for tag in content]
    else:
        text = content if isinstance(content, str) else format_value(content)
        number = text.removesuffix(".0") if isinstance(content, float) else text
        element.children = [Text(number, owner.span)]
    return element
