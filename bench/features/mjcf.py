"""The features of a robot in MJCF.

Source: https://mujoco.readthedocs.io/en/stable/XMLreference.html.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from lxml import etree

from .feature import Key

COMMANDS = {"motor": "effort", "ff": "effort", "pos": "position", "vel": "velocity"}
KINDS = {"hinge": "revolute", "slide": "prismatic", "free": "floating", "ball": "ball"}


def read(text: str, own: Mapping[str, str]) -> Iterator[Key]:
    """Yield the features of an MJCF, with the names in the robot.

    Args:
        text: the document.
        own: the names in the robot of what is called differently in it.
    """
    root = etree.fromstring(text.encode())
    materials = {each.get("name"): each for each in root.iterfind("asset/material")}
    for name in materials:
        yield ("material", "shape", own.get(name, name))
    yield ("link", "world")
    for body in root.iterfind("worldbody//body"):
        yield from _body(body, own)
    for site in root.iterfind("worldbody//site"):
        yield ("link", own.get(site.get("name", ""), site.get("name", "")))
    for geom in root.iterfind("worldbody//geom"):
        yield from _geom(geom, materials)
        called = geom.get("name", "")
        yield ("shape name", own.get(called, called))
    for equality in root.iterfind("equality/joint"):
        offset, factor, *_ = map(float, equality.get("polycoef", "").split())
        yield ("mimic", equality.get("joint1"), equality.get("joint2"), factor, offset)
    for actuator in root.iterfind("actuator/*"):
        yield ("actuated", actuator.get("joint"))
        given = actuator.get("input") if actuator.tag == "dcmotor" else actuator.tag
        command = COMMANDS.get(given, given)
        yield ("command", actuator.get("joint"), command)
    yield from _sensors(root, own)


def _body(body: etree._Element, own: Mapping[str, str]) -> Iterator[Key]:
    name = own.get(body.get("name", ""), body.get("name", ""))
    yield ("link", name)
    inertial = body.find("inertial")
    if inertial is not None:
        yield ("mass", name, float(inertial.get("mass")))
        if float(inertial.get("mass")) == 0:
            yield ("inertia without mass", name)
    joints = [each for each in body if each.tag in ("joint", "freejoint")]
    if not joints:
        yield ("fixed", name)
    several: dict[str, list[etree._Element]] = {}
    for joint in joints:
        called = joint.get("name", "")
        several.setdefault(own.get(called, called), []).append(joint)
    for called, found in several.items():
        yield from _joint(called, found)


def _joint(name: str, found: list[etree._Element]) -> Iterator[Key]:
    joint = found[0]
    dynamics = [joint.get(each) for each in ("damping", "frictionloss")]
    if (len(found) > 1 or joint.get("type") == "free") and any(dynamics):
        yield ("dynamics", name)
    if len(found) > 1:
        yield ("joint", name, "planar" if len(found) == 3 else "floating")
    elif joint.tag == "freejoint":
        yield ("joint", name, "floating")
    else:
        kind = KINDS[joint.get("type", "hinge")]
        limits = joint.get("range")
        if kind == "revolute" and limits is None:
            yield ("joint", name, "continuous")
        yield ("joint", name, kind)
        if limits is not None:
            yield ("range", name, *map(float, limits.split()))
    effort = joint.get("actuatorfrcrange")
    if effort is not None:
        yield ("effort", name, float(effort.split()[1]))
    for key, attribute in (("damping", "damping"), ("friction", "frictionloss")):
        if joint.get(attribute) is not None:
            yield (key, name, float(joint.get(attribute)))


def _geom(geom: etree._Element, materials: Mapping[str, etree._Element]) -> Iterator[Key]:
    kind = "visual" if geom.get("class", "").endswith("_visual") else "collision"
    shape = geom.get("type", "sphere")
    size = [float(each) for each in geom.get("size", "").split()]
    if shape == "box":
        size = [2 * each for each in size]
    elif shape in ("cylinder", "capsule"):
        size = [size[0], 2 * size[1]]
    yield (kind, shape, *size)
    friction = geom.get("friction")
    if friction is not None:
        for name in ("mu", "mu2"):
            yield ("gazebo", name, float(friction.split()[0]))
    look = materials.get(geom.get("material"))
    rgba = geom.get("rgba") or (look.get("rgba") if look is not None else None)
    if rgba is None and look is not None:
        rgba = "1 1 1 1"
    if rgba is not None:
        yield ("color", "shape", *map(float, rgba.split()))


IN_SENSORS = {
    "rangefinder": {"samples", "min_angle", "max_angle", "max", "pose"},
    "camera": {"horizontal_fov", "width", "height", "pose"},
}
"""What the elements of MJCF hold of Gazebo's sensors."""


def _sensors(root: etree._Element, own: Mapping[str, str]) -> Iterator[Key]:
    for each in (*root.iterfind("sensor/*"), *root.iterfind("worldbody//camera")):
        part = each.get("name", "")
        inner = IN_SENSORS.get(each.tag, {"pose"})
        while part:
            name = own.get(part, part)
            yield ("sensor", name)
            for key in (*inner, "always_on"):
                yield ("in sensor", name, key)
                yield ("in sensor", name, key)  # a lidar has its rays in two directions
            if each.get("noise") is not None:
                yield ("in sensor", name, "stddev")
            part = part.rpartition("_")[0] if name == part else ""
