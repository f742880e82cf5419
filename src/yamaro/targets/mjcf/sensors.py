"""Sensors: what MuJoCo measures at sites and with cameras."""

from __future__ import annotations

from math import atan, cos, degrees, sin, tan

from ...model.extras import CAMERAS, Camera, Lidar, Ranger
from ...model.pose import IDENTITY, Pose
from ..output import APPROXIMATED, LOST
from ..shared_losses import lost_of_sensor
from .names import CAMERA, SENSOR, SITE
from .writing import Writing, made, number, pose_attributes, row

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Sensor
    from ...source import Span
    from ...xml.tree import Element

FORWARD = Pose(((0.0, 0.0, -1.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
"""T_sensor_camera: a camera of MuJoCo looks along −z, with y up; one of ours along x, with z up."""
ALONG_X = "1 0 0"
MOST_COPIES = 400
"""Rays that are copies of one: MuJoCo takes 0.5 s for these, 3 s for 1,000, minutes for 8,000."""
TOUCH_RADIUS = 1000.0
"""The radius in metres of the sphere in which touches are felt: that of the whole body."""
OPPOSITE = "the opposite: what the parent exerts on the child"
IMU_PARTS = {
    "gyro": "angular_velocity",
    "accelerometer": "linear_acceleration",
}


def add_sensors(writing: Writing) -> None:
    """Append the sensors, with the sites and cameras that they measure with."""
    for sensor in writing.robot.sensors.values():
        if sensor.joint is not None:
            _force_torque(writing, sensor)
        elif sensor.frame in writing.plan.carriers:
            _in_link(writing, sensor)
        else:
            _lose(writing, sensor, LOST, "sensors in frames that are not there")
            continue
        writing.losses += lost_of_sensor(sensor, "mjcf")


def _in_link(writing: Writing, sensor: Sensor) -> None:
    kind, details = sensor.type, sensor.details
    if kind in CAMERAS and isinstance(details, Camera):
        _camera(writing, sensor, details)
    elif isinstance(details, Lidar):
        _lidar(writing, sensor, details)
    elif isinstance(details, Ranger):
        _ranger(writing, sensor, details)
    elif kind == "imu":
        site = _site_of(writing, sensor)
        name = f"{sensor.name}_orientation"
        _add(writing, sensor, "framequat", name, {"objtype": "site", "objname": site})
        for word, part in IMU_PARTS.items():
            name = f"{sensor.name}_{part}"
            _add(writing, sensor, word, name, {"site": site}, sensor.noises.get(part))
    elif kind == "magnetometer":
        _add(writing, sensor, kind, sensor.name, {"site": _site_of(writing, sensor)})
    elif kind == "gps":
        _lose(writing, sensor, APPROXIMATED, "gps sensors", "positions in the world, in metres")
        site = _site_of(writing, sensor)
        _add(writing, sensor, "framepos", sensor.name, {"objtype": "site", "objname": site})
    elif kind == "contact":
        _contact(writing, sensor)
    else:
        _lose(writing, sensor, LOST, f"{kind} sensors")


def _contact(writing: Writing, sensor: Sensor) -> None:
    """Append the sum of the forces that touch a link: its site encloses the whole of it."""
    _lose(writing, sensor, APPROXIMATED, "contact sensors", "the sum of the normal forces")
    site = _new_site(
        writing,
        sensor,
        f"{sensor.name}_touch",
        sensor.link or sensor.frame or "",
        {"type": "sphere", "size": number(TOUCH_RADIUS), "rgba": "0 0 0 0"},
    )
    _add(writing, sensor, "touch", sensor.name, {"site": site})


def _force_torque(writing: Writing, sensor: Sensor) -> None:
    """Append the force and the torque between the ends of a joint, in the frame of its child.

    MuJoCo's are what the parent exerts on the child: of a load that a joint carries, a force
    upwards. In Gazebo, a sensor measures by default what the child exerts on the parent.
    """
    joint = writing.robot.joints.get(sensor.joint or "")
    if joint is None or joint.child not in writing.plan.carriers:
        _lose(writing, sensor, LOST, "sensors in joints that are not there")
        return
    _lose(writing, sensor, APPROXIMATED, "force_torque sensors", OPPOSITE)
    site = _new_site(writing, sensor, sensor.name, joint.child, {})
    for part in ("force", "torque"):
        name = f"{sensor.name}_{part}"
        _add(writing, sensor, part, name, {"site": site}, sensor.noises.get(part))


def _camera(writing: Writing, sensor: Sensor, camera: Camera) -> None:
    width, height = camera.size
    name = writing.names.fresh(CAMERA, sensor.name)
    angle = 2 * atan(tan(camera.fov / 2) * height / width)
    attributes = {
        "name": name,
        **pose_attributes(_pose_of(writing, sensor) @ FORWARD),
        "resolution": f"{width} {height}",
        "fovy": number(degrees(angle)),
    }
    places = {"fovy": sensor.span_of("fov"), "resolution": sensor.span_of("size")}
    _place(writing, sensor, made("camera", sensor, attributes, sensor.trace, places))
    _lose(writing, sensor, LOST, "clip distances of cameras", attribute="clip")


def _lidar(writing: Writing, sensor: Sensor, lidar: Lidar) -> None:
    """Append a site for each ray, and what measures along them."""
    attributes = pose_attributes(_pose_of(writing, sensor))
    frame = made("frame", sensor, attributes, sensor.trace)
    _place(writing, sensor, frame)
    if lidar.rays * lidar.rows > MOST_COPIES:
        _each_ray(writing, sensor, lidar, frame)
        return
    site = _ray(writing, sensor)
    frame.children.append(_rays(sensor, site, lidar))
    _rangefinder(writing, sensor, str(site.attributes["name"]), lidar.range)


def _each_ray(writing: Writing, sensor: Sensor, lidar: Lidar, frame: Element) -> None:
    """Append a site and a rangefinder for each ray, called as copies would be.

    A ray at the angle a about z in a row at b above the horizontal goes along
    (cos(a)·cos(b), sin(a)·cos(b), sin(b)).
    """
    low, high = lidar.tilt_ends()
    rise = (high - low) / (lidar.rows - 1) if lidar.rows > 1 else 0.0
    first, cutoff = lidar.ends()[0], number(lidar.range[1])
    for ray in range(lidar.rays):
        for level in range(lidar.rows):
            a, b = first + ray * lidar.step, low + level * rise
            way = (cos(a) * cos(b), sin(a) * cos(b), sin(b))
            ending = _padded(level, lidar.rows) if lidar.rows > 1 else ""
            ending += _padded(ray, lidar.rays)
            site = _ray(writing, sensor, ending)
            site.attributes["zaxis"] = row(way)
            frame.children.append(site)
            found: dict[str, str | None] = {"site": str(site.attributes["name"]), "cutoff": cutoff}
            _add(writing, sensor, "rangefinder", sensor.name + ending, found)
    if lidar.range[0]:
        _lose(writing, sensor, LOST, "least distances of sensors", attribute="range")


def _padded(index: int, count: int) -> str:
    return f"_{index:0{len(str(count - 1))}}"


def _rays(sensor: Sensor, site: Element, lidar: Lidar) -> Element:
    """Return the site of one ray, copied to all rays: tilted to its row, then turned in it."""
    low, high = lidar.tilt_ends()
    if lidar.rows > 1:
        step = (high - low) / (lidar.rows - 1)
        site = _turned(sensor, site, lidar.rows, -low, -step, "y")
    return _turned(sensor, site, lidar.rays, lidar.ends()[0], lidar.step, "z")


def _turned(
    sensor: Sensor, content: Element, count: int, first: float, step: float, axis: str
) -> Element:
    """Return copies of an element, each turned by one step more about an axis."""

    def euler(angle: float) -> str:
        return row((0.0, angle, 0.0) if axis == "y" else (0.0, 0.0, angle))

    start = made("frame", sensor, {"euler": euler(first)}, sensor.trace)
    if count == 1:
        start.children.append(content)
        return start
    attributes = {"count": str(count), "euler": euler(step), "sep": "_"}
    copies = made("replicate", sensor, attributes, sensor.trace)
    copies.children.append(content)
    start.children.append(copies)
    return start


def _ranger(writing: Writing, sensor: Sensor, ranger: Ranger) -> None:
    site = _ray(writing, sensor)
    frame = made("frame", sensor, pose_attributes(_pose_of(writing, sensor)), sensor.trace)
    frame.children.append(site)
    _place(writing, sensor, frame)
    _rangefinder(writing, sensor, str(site.attributes["name"]), ranger.range)


def _ray(writing: Writing, sensor: Sensor, ending: str = "") -> Element:
    """Return a site whose z axis is the x axis of the sensor: rays go along z."""
    name = writing.names.fresh(SITE, f"{sensor.name}_ray{ending}")
    default = writing.classes.frame
    attributes = {"name": name, "class": default, "zaxis": ALONG_X}
    return made("site", sensor, attributes, sensor.trace)


def _rangefinder(writing: Writing, sensor: Sensor, site: str, ends: tuple[float, float]) -> None:
    cutoff = number(ends[1])
    _add(writing, sensor, "rangefinder", sensor.name, {"site": site, "cutoff": cutoff})
    if ends[0]:
        _lose(writing, sensor, LOST, "least distances of sensors", attribute="range")


# --- what they share ----------------------------------------------------------------------------


def _pose_of(writing: Writing, sensor: Sensor) -> Pose:
    """Return T_body_sensor."""
    assert sensor.frame is not None
    pose = writing.plan.poses[sensor.frame]
    return pose if sensor.pose == IDENTITY else pose @ sensor.pose


def _place(writing: Writing, sensor: Sensor, element: Element) -> None:
    assert sensor.frame is not None
    writing.body_of(sensor.frame).children.append(element)


def _site_of(writing: Writing, sensor: Sensor) -> str:
    """Return the site that a sensor measures at: that of its frame, or a new one in a body."""
    frame = sensor.frame
    assert frame is not None
    if frame in writing.plan.sites and sensor.pose == IDENTITY:
        return frame
    return _new_site(writing, sensor, sensor.name, frame, {}, _pose_of(writing, sensor))


def _new_site(
    writing: Writing,
    sensor: Sensor,
    wanted: str,
    link: str,
    attributes: dict[str, str | None],
    pose: Pose | None = None,
) -> str:
    """Append a site at a pose in the body, by default at the origin of a link; return its name."""
    name = writing.names.fresh(SITE, wanted)
    place = pose_attributes(pose or writing.plan.poses.get(link, IDENTITY))
    whole = {"name": name, "class": writing.classes.frame, **attributes, **place}
    writing.body_of(link).children.append(made("site", sensor, whole, sensor.trace))
    return name


def _add(
    writing: Writing,
    sensor: Sensor,
    word: str,
    wanted: str,
    attributes: dict[str, str | None],
    own_noise: float | None = None,
) -> None:
    """Append a sensor under a name that is free; its noise is by default that of all parts."""
    name = writing.names.fresh(SENSOR, wanted)
    deviation = own_noise or sensor.noise
    noise = number(deviation) if deviation else None
    whole = {"name": name, **attributes, "noise": noise}
    places = {"name": sensor.span_of("name"), "noise": sensor.span_of("noise")}
    writing.add("sensor", made(word, sensor, whole, sensor.trace, places))


def _lose(
    writing: Writing, sensor: Sensor, kind: str, what: str, how: str = "", *, attribute: str = ""
) -> None:
    span: Span = sensor.span_of(attribute) if attribute else sensor.span
    owner = f"sensor '{sensor.name}'"
    writing.lose(kind, what, owner, span, trace=sensor.trace, how=how)
