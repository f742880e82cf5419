"""URDF as pinocchio reads it; mimics, actuators and sensors, which it has no place for, as text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

from .facts import Array, Body, Facts, Joint, ball, box, cylinder, moved, plain

KINDS = {
    **dict.fromkeys(
        ("camera", "depth", "depth_camera", "rgbd_camera", "multicamera", "wideanglecamera",
         "wide_angle_camera", "thermal_camera", "rgbd"), "camera"),
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar"), "lidar"),
    "imu": "imu", "contact": "contact", "force_torque": "force_torque",
    "altimeter": "altimeter", "magnetometer": "magnetometer",
    "gps": "gps", "navsat": "gps", "sonar": "sonar",
}  # fmt: skip
"""The kinds of sensors, by the types of Gazebo."""


def read(path: Path) -> Facts:
    """Return what is in a URDF."""
    import pinocchio as pin

    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    free = [number for number, joint in enumerate(model.joints) if number and joint.nq == 7]
    names = [
        plain(name) if number and number not in free[:1] else ""
        for number, name in enumerate(model.names)
    ]  # a base that moves freely is the base
    facts = Facts("urdf")
    for name, inertia in zip(names, model.inertias, strict=True):
        facts.bodies[name] = Body(inertia.mass, inertia.lever.copy(), inertia.inertia.copy())
    for frame in model.frames:
        is_world = bool(free) and not frame.parentJoint
        if frame.type == pin.FrameType.BODY and not is_world:
            moves = names[frame.parentJoint]
            facts.frames[plain(frame.name)] = moves, frame.placement.homogeneous.copy()
            facts.root = facts.root or plain(frame.name)
    for number in range(1, model.njoints):
        if names[number]:
            facts.joints[names[number]] = _joint(model, number)

    def place(positions: Mapping[str, float]) -> dict[str, Array]:
        q = pin.neutral(model)
        for name, joint in zip(names, model.joints, strict=True):
            angle = positions.get(name, 0.0)
            if name and joint.nq == 2:
                q[joint.idx_q : joint.idx_q + 2] = np.cos(angle), np.sin(angle)
            elif name and joint.nq == 1:
                q[joint.idx_q] = angle
        pin.forwardKinematics(model, data, q)
        return {name: at.homogeneous.copy() for name, at in zip(names, data.oMi, strict=True)}

    facts.place = place
    geometry = pin.buildGeomFromUrdf(
        model, str(path), pin.GeometryType.COLLISION, package_dirs=[str(path.parent)]
    )
    for each in geometry.geometryObjects:
        points = _points(each.geometry)
        facts.bodies[names[each.parentJoint]].touch(moved(points, each.placement.homogeneous))
    _text(facts, etree.parse(str(path)).getroot())
    return facts


def _joint(model: Any, number: int) -> Joint:
    joint = model.joints[number]
    at, v = joint.idx_q, joint.idx_v
    kind = "prismatic" if "P" in joint.shortname().removeprefix("JointModel")[:1] else "revolute"
    found = Joint(kind, effort=float(model.upperEffortLimit[v]))
    found.velocity = float(model.upperVelocityLimit[v])
    found.damping, found.friction = float(model.damping[v]), float(model.upperDryFrictionLimit[v])
    if joint.nq == 1:
        found.lower = float(model.lowerPositionLimit[at])
        found.upper = float(model.upperPositionLimit[at])
    return found


def _points(shape: Any) -> Array:
    kind = type(shape).__name__
    if kind == "Box":
        return box(*shape.halfSide)
    if kind == "Sphere":
        return ball(shape.radius)
    if kind == "Cylinder":
        return cylinder(shape.radius, shape.halfLength)
    if kind == "Capsule":
        return ball(shape.radius, half=shape.halfLength)
    points = shape.vertices() if hasattr(shape, "vertices") else shape.points()
    return np.array(points).reshape(-1, 3)


def _text(facts: Facts, robot: Any) -> None:
    for joint in robot.iterfind("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            numbers = float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0))
            facts.mimics[plain(joint.get("name"))] = (plain(mimic.get("joint")), *numbers)
    for joint in robot.iterfind("transmission/joint"):
        ways = [(each.text or "").strip() for each in joint.iterfind("hardwareInterface")]
        # One with the interface of states alone can only be read.
        if not ways or not all(way.endswith("JointStateInterface") for way in ways):
            facts.drives[plain(joint.get("name"))] = None
    for joint in robot.iterfind("ros2_control/joint"):
        if joint.find("command_interface") is not None:
            facts.drives[plain(joint.get("name"))] = None
    facts.drives = {name: gain for name, gain in facts.drives.items() if name in facts.joints}
    children = {
        plain(joint.get("name")): plain(joint.find("child").get("link"))
        for joint in robot.iterfind("joint")
    }
    for reference, sensor in _sensors(robot):
        name = children.get(reference, reference)
        if name in facts.frames:
            facts.sensors.append((sensor, facts.frames[name][0]))


def _sensors(robot: Any) -> Iterator[tuple[str, str]]:
    for gazebo in robot.iterfind("gazebo"):
        for sensor in gazebo.iterfind("sensor"):
            kind = sensor.get("type", "")
            yield plain(gazebo.get("reference") or ""), KINDS.get(kind, kind)
