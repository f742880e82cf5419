"""The features of a robot in SDF. Source: http://sdformat.org/spec."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from lxml import etree

from .feature import Key, plain

SENSORS = frozenset(
    """
    air_pressure air_speed altimeter boundingbox boundingbox_camera camera contact custom depth
    depth_camera force_torque gps gpu_lidar gpu_ray imu lidar logical_camera magnetometer
    multicamera navsat ray rgbd rgbd_camera rfid rfidtag segmentation segmentation_camera sonar
    thermal thermal_camera wideanglecamera wide_angle_camera wireless_receiver wireless_transmitter
    """.split()
)
"""The types of sensors that libsdformat knows; it refuses a file with others. Source: Sensor.cc."""


def read(text: str, own: Mapping[str, str]) -> Iterator[Key]:
    """Yield the features of an SDF, with the names in the robot.

    Args:
        text: the document.
        own: the names in the robot of what is called differently in it.
    """
    model = etree.fromstring(text.encode()).find("model")
    assert model is not None
    for each in model:
        name = own.get(each.get("name", ""), each.get("name", ""))
        if each.tag == "link":
            yield ("link", name)
            yield from _link(each, name, own)
        elif each.tag == "frame":
            yield ("link", name)
        elif each.tag == "joint":
            yield from _joint(each, name, own)
        elif each.tag == "plugin":
            yield ("plugin", each.get("filename", ""))
        else:
            yield _gazebo(each)
    yield ("link", "world")  # is always there


def _link(link: etree._Element, name: str, own: Mapping[str, str]) -> Iterator[Key]:
    mass = link.findtext("inertial/mass")
    if mass is not None:
        yield ("mass", name, float(mass))
    for each in link:
        if each.tag in ("visual", "collision"):
            yield from _shape(each)
            called = each.get("name", "")
            yield ("shape name", own.get(called, called))
        elif each.tag == "sensor":
            yield from _sensor(each, own)
        elif each.tag not in ("inertial", "pose"):
            yield _gazebo(each)


def _sensor(sensor: etree._Element, own: Mapping[str, str]) -> Iterator[Key]:
    name = own.get(sensor.get("name", ""), sensor.get("name", ""))
    if sensor.get("type") in SENSORS:
        yield ("sensor", name)
    for inner in sensor.iterdescendants():
        if inner.tag == "plugin":
            yield ("plugin", inner.get("filename", ""))
        elif not any(each.tag == "plugin" for each in inner.iterancestors()):
            yield ("in sensor", name, inner.tag)


def _shape(node: etree._Element) -> Iterator[Key]:
    for inner in (node, *node.iterfind("surface//ode")):
        yield from map(_gazebo, (each for each in inner if each.text and each.text.strip()))
    for inner in node.iterdescendants():
        if inner.tag == "plugin":
            yield ("plugin", inner.get("filename", ""))
        else:
            yield ("in shape", inner.tag)
    (shape,) = node.find("geometry")
    yield (node.tag, shape.tag, *_sizes(shape))
    is_mesh = "mesh" if shape.tag == "mesh" else "shape"
    diffuse = node.findtext("material/diffuse")
    if diffuse is not None:
        yield ("color", is_mesh, *map(float, diffuse.split()))
    texture = node.findtext("material/pbr/metal/albedo_map")
    if texture is not None:
        yield ("texture", is_mesh, texture.rpartition("/")[2])


def _gazebo(node: etree._Element) -> Key:
    return ("gazebo", node.tag, plain((node.text or "").strip().lower()))


def _sizes(shape: etree._Element) -> tuple[object, ...]:
    def number(name: str) -> float:
        return float(shape.findtext(name) or "nan")

    if shape.tag == "box":
        return tuple(map(float, (shape.findtext("size") or "").split()))
    if shape.tag == "mesh":
        scale = tuple(map(float, (shape.findtext("scale") or "1 1 1").split()))
        return ((shape.findtext("uri") or "").rpartition("/")[2], *scale)
    if shape.tag == "sphere":
        return (number("radius"),)
    return (number("radius"), number("length"))


def _joint(joint: etree._Element, name: str, own: Mapping[str, str]) -> Iterator[Key]:
    kind = joint.get("type")
    child = joint.findtext("child") or ""
    yield ("fixed", own.get(child, child)) if kind == "fixed" else ("joint", name, kind)
    for each in joint.findall("sensor"):
        yield from _sensor(each, own)
    for inner in joint.iterfind("physics//*"):
        yield _gazebo(inner)
    axis = joint.find("axis")
    if axis is None:
        return
    limit = axis.find("limit")
    if limit is not None and kind in ("revolute", "prismatic"):
        lower, upper = limit.findtext("lower"), limit.findtext("upper")
        if lower is not None and upper is not None:
            yield ("range", name, float(lower), float(upper))
    for each in ("effort", "velocity"):
        value = axis.findtext(f"limit/{each}")
        if value is not None:
            yield (each, name, float(value))
    for each in ("damping", "friction"):
        value = axis.findtext(f"dynamics/{each}")
        if value is not None and float(value):
            yield (each, name, float(value))
    if kind != "fixed":
        yield from _drive(joint, name, axis.findtext("limit/effort"))
    mimic = axis.find("mimic")
    if mimic is not None:
        leader = mimic.get("joint", "")
        factor, offset = mimic.findtext("multiplier"), mimic.findtext("offset")
        yield ("mimic", name, own.get(leader, leader), float(factor or 1), float(offset or 0))


def _drive(joint: etree._Element, name: str, effort: str | None) -> Iterator[Key]:
    """Yield what Drake commands of a joint: a servo with gains, else an effort if it is not 0.

    Source: https://drake.mit.edu/doxygen_cxx/group__multibody__parsing.html.
    """
    gains = joint.find("{*}controller_gains")
    if gains is not None:
        yield ("actuated", name)
        yield ("command", name, "position" if float(gains.get("p", "0")) else "velocity")
    elif effort is None or float(effort):
        yield ("actuated", name)
        yield ("command", name, "effort")
