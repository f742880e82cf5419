"""Sensors: what MuJoCo measures at sites and with cameras."""

from __future__ import annotations

from math import atan, cos, degrees, sin, tan

from ...model.extras import CAMERAS, Camera, Lidar, Ranger
from ...model.pose import IDENTITY, Pose
from ...model.values import attribute_text
from ..elements import element, row
from ..holding import lost_of_sensor
from .model import CAMERA, SENSOR, SITE, Writing, pose_attributes

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.extras import Sensor
    from ...model.pose import Vector
    from ...xml.tree import Element
    from ..elements import Attributes

FORWARD = Pose(((0.0, 0.0, -1.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
"""T_sensor_camera: a camera of MuJoCo looks along −z, with y up; one of ours along x, with z up."""
ALONG_X = "1 0 0"
MOST_COPIES = 400
"""Rays that are copies of one: MuJoCo takes 0.5 s for these, 3 s for 1,000, minutes for 8,000."""
COPIES_BEFORE_JOINTS = (3, 16)
"""The release of MuJoCo since which a body with copies can be before joints that keyframes move."""
TOUCH_RADIUS = 1000.0
"""The radius in metres of the sphere in which touches are felt: that of the whole body."""
OPPOSITE = "the opposite: what the parent exerts on the child"
IMU_PARTS = {
    "gyro": "angular_velocity",
    "accelerometer": "linear_acceleration",
}
WORDS = {
    "imu": ("framequat", *IMU_PARTS),
    "force_torque": ("force", "torque"),
    "magnetometer": ("magnetometer",),
    "gps": ("framepos",),
    "contact": ("touch",),
    "range": ("rangefinder",),
    "lidar": ("rangefinder",),
}
"""The sensors of MuJoCo that each type is made of."""


def add_sensors(writing: Writing) -> None:
    """Append the sensors, with the sites and cameras that they measure with."""
    for sensor in writing.robot.sensors.values():
        given = _given(writing, sensor)
        if given or attribute_text(sensor.element, "of") == "mjcf":
            for each in given:
                writing.measured[attribute_text(each, "name") or ""] = sensor.name
            writing.losses += lost_of_sensor(sensor, "mjcf")
            continue
        if sensor.joint is not None:
            _force_torque(writing, sensor)
        elif sensor.frame in writing.plan.carriers:
            _in_link(writing, sensor)
        else:
            writing.losses.lose("sensors in frames that are not there", sensor)
            continue
        writing.losses += lost_of_sensor(sensor, "mjcf")


def _given(writing: Writing, sensor: Sensor) -> list[Element]:
    """Return what a block says itself that MuJoCo measures for a sensor."""
    words, plan = WORDS.get(sensor.type, ()), writing.plan
    given = [each for each in writing.blocks.in_section("sensor") if each.name in words]
    if not given:
        return []
    frame = sensor.frame
    if sensor.joint is not None:
        joint = writing.robot.joints.get(sensor.joint)
        frame = joint.child if joint is not None else None
    if frame not in plan.carriers:
        return []
    places = {sensor.name, writing.site_name(frame)}
    if sensor.joint is not None or sensor.type == "contact":  # at any site of the body
        carrier = plan.carriers[frame]
        places |= {writing.site_name(each) for each in plan.sites if plan.carriers[each] == carrier}
    return [
        each
        for each in given
        if (attribute_text(each, "site") or attribute_text(each, "objname")) in places
    ]


def _in_link(writing: Writing, sensor: Sensor) -> None:
    kind, details = sensor.type, sensor.details
    if kind in CAMERAS and isinstance(details, Camera):
        width, height = details.size
        name = writing.names.fresh(CAMERA, sensor.name)
        angle = 2 * atan(tan(details.fov / 2) * height / width)
        attributes: Attributes = {
            "name": name,
            **pose_attributes(_pose_of(writing, sensor) @ FORWARD),
            "resolution": f"{width} {height}",
            "fovy": degrees(angle),
        }
        places = {"fovy": sensor.span_of("fov"), "resolution": sensor.span_of("size")}
        _place(writing, sensor, element("camera", attributes, owner=sensor, places=places))
        if "clip" in sensor.element.attributes:
            writing.losses.lose("clip distances of cameras", sensor, field="clip")
    elif isinstance(details, Lidar):
        _lidar(writing, sensor, details)
    elif isinstance(details, Ranger):
        ray = _ray(writing, sensor)
        attributes = pose_attributes(_pose_of(writing, sensor))
        _place(writing, sensor, element("frame", attributes, children=[ray], owner=sensor))
        _rangefinder(writing, sensor, str(ray.attributes["name"]), details.range)
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
        how = "positions in the world, in metres"
        writing.losses.approximate("gps sensors", sensor, how=how)
        site = _site_of(writing, sensor)
        _add(writing, sensor, "framepos", sensor.name, {"objtype": "site", "objname": site})
    elif kind == "contact":
        # The site encloses the whole of the link.
        how = "the sum of the normal forces"
        writing.losses.approximate("contact sensors", sensor, how=how)
        site = _new_site(
            writing,
            sensor,
            f"{sensor.name}_touch",
            sensor.link or sensor.frame or "",
            {"type": "sphere", "size": TOUCH_RADIUS, "rgba": "0 0 0 0"},
        )
        _add(writing, sensor, "touch", sensor.name, {"site": site})
    else:
        writing.losses.lose(f"{kind} sensors", sensor)


def _force_torque(writing: Writing, sensor: Sensor) -> None:
    """Append the force and the torque between the ends of a joint, in the frame of its child.

    MuJoCo's are what the parent exerts on the child: of a load that a joint carries, a force
    upwards. In Gazebo, a sensor measures by default what the child exerts on the parent.
    """
    joint = writing.robot.joints.get(sensor.joint or "")
    if joint is None or joint.child not in writing.plan.carriers:
        writing.losses.lose("sensors in joints that are not there", sensor)
        return
    writing.losses.approximate("force_torque sensors", sensor, how=OPPOSITE)
    site = _new_site(writing, sensor, sensor.name, joint.child, {})
    for part in ("force", "torque"):
        name = f"{sensor.name}_{part}"
        _add(writing, sensor, part, name, {"site": site}, sensor.noises.get(part))


def _lidar(writing: Writing, sensor: Sensor, lidar: Lidar) -> None:
    """Append a site for each ray, and what measures along them."""
    attributes = pose_attributes(_pose_of(writing, sensor))
    frame = element("frame", attributes, owner=sensor)
    _place(writing, sensor, frame)
    if lidar.rays * lidar.rows > MOST_COPIES or writing.release < COPIES_BEFORE_JOINTS:
        _each_ray(writing, sensor, lidar, frame)
        return
    site = _ray(writing, sensor)
    rays, (low, high) = site, lidar.tilt_ends()
    if lidar.rows > 1:  # copies of one ray: tilted to its row, then turned in it
        step = (high - low) / (lidar.rows - 1)
        rays = _turned(sensor, rays, lidar.rows, -low, -step, "y")
    rays = _turned(sensor, rays, lidar.rays, lidar.ends()[0], lidar.step, "z")
    frame.children.append(rays)
    _rangefinder(writing, sensor, str(site.attributes["name"]), lidar.range)


def _each_ray(writing: Writing, sensor: Sensor, lidar: Lidar, frame: Element) -> None:
    """Append a site and a rangefinder for each ray, called as copies would be.

    A ray at the angle a about z in a row at b above the horizontal goes along
    (cos(a)·cos(b), sin(a)·cos(b), sin(b)).
    """
    low, high = lidar.tilt_ends()
    rise = (high - low) / (lidar.rows - 1) if lidar.rows > 1 else 0.0
    first = lidar.ends()[0]
    for ray in range(lidar.rays):
        for level in range(lidar.rows):
            a, b = first + ray * lidar.step, low + level * rise
            way = (cos(a) * cos(b), sin(a) * cos(b), sin(b))
            ending = _padded(level, lidar.rows) if lidar.rows > 1 else ""
            ending += _padded(ray, lidar.rays)
            site = _ray(writing, sensor, ending)
            site.attributes["zaxis"] = row(way)
            frame.children.append(site)
            found: Attributes = {"site": str(site.attributes["name"]), "cutoff": lidar.range[1]}
            _add(writing, sensor, "rangefinder", sensor.name + ending, found)
    if lidar.range[0]:
        writing.losses.lose("least distances of sensors", sensor, field="range")


def _padded(index: int, count: int) -> str:
    return f"_{index:0{len(str(count - 1))}}"


def _turned(
    sensor: Sensor, content: Element, count: int, first: float, step: float, axis: str
) -> Element:
    """Return copies of an element, each turned by one step more about an axis."""

    def euler(angle: float) -> Vector:
        return (0.0, angle, 0.0) if axis == "y" else (0.0, 0.0, angle)

    if count > 1:
        attributes: Attributes = {"count": count, "euler": euler(step), "sep": "_"}
        content = element("replicate", attributes, children=[content], owner=sensor)
    return element("frame", {"euler": euler(first)}, children=[content], owner=sensor)


def _ray(writing: Writing, sensor: Sensor, ending: str = "") -> Element:
    """Return a site whose z axis is the x axis of the sensor: rays go along z."""
    name = writing.names.fresh(SITE, f"{sensor.name}_ray{ending}")
    attributes: Attributes = {"name": name, "class": writing.classes.frame, "zaxis": ALONG_X}
    return element("site", attributes, owner=sensor)


def _rangefinder(writing: Writing, sensor: Sensor, site: str, ends: tuple[float, float]) -> None:
    _add(writing, sensor, "rangefinder", sensor.name, {"site": site, "cutoff": ends[1]})
    if ends[0]:
        writing.losses.lose("least distances of sensors", sensor, field="range")


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
        return writing.site_name(frame)
    return _new_site(writing, sensor, sensor.name, frame, {}, _pose_of(writing, sensor))


def _new_site(
    writing: Writing,
    sensor: Sensor,
    wanted: str,
    link: str,
    attributes: Attributes,
    pose: Pose | None = None,
) -> str:
    """Append a site at a pose in the body, by default at the origin of a link; return its name."""
    name = writing.names.fresh(SITE, wanted)
    place = pose_attributes(pose or writing.plan.poses.get(link, IDENTITY))
    whole: Attributes = {"name": name, "class": writing.classes.frame, **attributes, **place}
    writing.body_of(link).children.append(element("site", whole, owner=sensor))
    return name


def _add(
    writing: Writing,
    sensor: Sensor,
    word: str,
    wanted: str,
    attributes: Attributes,
    own_noise: float | None = None,
) -> None:
    """Append a sensor under a name that is free; its noise is by default that of all parts."""
    name = writing.names.fresh(SENSOR, wanted)
    writing.measured[name] = sensor.name
    whole: Attributes = {"name": name, **attributes, "noise": own_noise or sensor.noise or None}
    places = {"name": sensor.span_of("name"), "noise": sensor.span_of("noise")}
    writing.add("sensor", element(word, whole, owner=sensor, places=places))
