"""SDFormat as Drake reads it with its libsdformat; what Drake has no place for, as text."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

from .facts import NONE, Array, Body, Facts, Joint, ball, box, cylinder, moved, of_rpy, plain
from .read_urdf import KINDS

UNLIMITED = 1e16
"""libsdformat writes this for no limit."""


def read(path: Path) -> Facts:
    """Return what is in an SDF file."""
    return _Reading(path).facts


class _Reading:
    """The facts of one file."""

    def __init__(self, path: Path) -> None:
        from pydrake.common import configure_logging
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import DiscreteContactApproximation, MultibodyPlant
        from pydrake.multibody.tree import BodyIndex, FrameIndex

        configure_logging()
        logging.getLogger("drake").setLevel(logging.ERROR)
        self.plant = MultibodyPlant(0.001)
        self.plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
        Parser(self.plant).AddModels(str(path))
        self.plant.Finalize()
        self.context = self.plant.CreateDefaultContext()
        self.path, self.facts = path, Facts("sdf")
        self.links = [self.plant.get_body(BodyIndex(n)) for n in range(1, self.plant.num_bodies())]
        self.joints = [self.plant.get_joint(n) for n in self.plant.GetJointIndices()]
        self.frames = [self.plant.get_frame(FrameIndex(n)) for n in range(self.plant.num_frames())]
        self.first: dict[str, Any] = {}
        self._bodies()
        for model in etree.parse(str(path)).getroot().iter("model"):
            self._text(model)
        self.facts.place = self.place

    def place(self, positions: Mapping[str, float]) -> dict[str, Array]:
        self._set(positions)
        return {name: self._pose(link.body_frame()) for name, link in self.first.items()}

    def _set(self, positions: Mapping[str, float]) -> None:
        q = self.plant.GetPositions(self.context).copy()
        for joint in self.joints:
            if joint.num_positions() == 1:
                q[joint.position_start()] = positions.get(plain(joint.name()), 0.0)
        self.plant.SetPositions(self.context, q)

    def _pose(self, frame: Any) -> Array:
        return np.array(frame.CalcPoseInWorld(self.context).GetAsMatrix4())

    def _bodies(self) -> None:
        facts = self.facts
        above = {joint.child_body().index(): joint for joint in self.joints}
        moves: dict[Any, str] = {}

        def moving(link: Any) -> str:
            joint = above.get(link.index())
            if joint is None or joint.num_positions() > 1:
                return ""
            if joint.num_positions() == 0:
                return moving(joint.parent_body())
            return plain(joint.name())

        self._set({})
        for link in self.links:
            name = moves[link.index()] = moving(link)
            self.first.setdefault(name, link)
            body = facts.bodies.setdefault(name, Body())
            inner = np.linalg.inv(self._pose(self.first[name].body_frame())) @ self._pose(
                link.body_frame()
            )
            facts.frames.setdefault(plain(link.name()), (name, inner))
            facts.root = facts.root or plain(link.name())
            mass = link.CalcSpatialInertiaInBodyFrame(self.context)
            turn = inner[:3, :3]
            center = np.array(mass.get_com())
            about = mass.Shift(center).CalcRotationalInertia().CopyToFullMatrix3()
            body.add(mass.get_mass(), moved(center[None], inner)[0], turn @ about @ turn.T)
        for frame in self.frames:
            if frame.body().index() in moves:
                name = moves[frame.body().index()]
                inner = np.linalg.inv(self._pose(self.first[name].body_frame()))
                facts.frames.setdefault(plain(frame.name()), (name, inner @ self._pose(frame)))

    def _text(self, model: Any) -> None:
        facts = self.facts
        for joint in model.iterfind("joint"):
            name, kind = plain(joint.get("name")), joint.get("type")
            if kind in ("revolute", "continuous", "prismatic"):
                facts.joints[name] = _joint(joint, kind)
            mimic = joint.find("axis/mimic")
            if mimic is not None:
                reference = _number(mimic, "reference", 0.0)
                gear = _number(mimic, "multiplier", 1.0)
                offset = _number(mimic, "offset", 0.0) - gear * reference
                facts.mimics[name] = plain(mimic.get("joint")), gear, offset
            for sensor in joint.iterfind("sensor"):
                self._sensor(sensor, plain(joint.findtext("child").strip()))
        for link in model.iterfind("link"):
            moves, inner = facts.frames[plain(link.get("name"))]
            for sensor in link.iterfind("sensor"):
                self._sensor(sensor, plain(link.get("name")))
            for shape in link.iterfind("collision"):
                at = of_rpy(_numbers(shape, "pose") or [0.0] * 6)
                points = moved(self._points(shape.find("geometry")), inner @ at)
                facts.bodies[moves].touch(points)
        for plugin in model.iterfind("plugin"):
            for name in plugin.iterfind("joint_name"):
                if "Publisher" not in plugin.get("name", "") and name.text:
                    facts.drives[plain(name.text.strip())] = None
            for joint in plugin.iterfind(".//ros2_control/joint"):
                facts.drives[plain(joint.get("name"))] = None

    def _sensor(self, sensor: Any, link: str) -> None:
        kind = sensor.get("type", "")
        moves = self.facts.frames[link][0] if link in self.facts.frames else ""
        self.facts.sensors.append((KINDS.get(kind, kind), moves))

    def _points(self, geometry: Any) -> Array:
        shape = geometry[0]
        if shape.tag == "box":
            return box(*(each / 2 for each in _numbers(shape, "size")))
        if shape.tag == "sphere":
            return ball(_number(shape, "radius", 0.0))
        if shape.tag == "cylinder":
            return cylinder(_number(shape, "radius", 0.0), _number(shape, "length", 0.0) / 2)
        if shape.tag == "capsule":
            return ball(_number(shape, "radius", 0.0), half=_number(shape, "length", 0.0) / 2)
        if shape.tag == "ellipsoid":
            return ball(*_numbers(shape, "radii"))
        if shape.tag != "mesh":
            return NONE
        import coal

        uri = (shape.findtext("uri") or "").strip().removeprefix("file://")
        scale = np.array(_numbers(shape, "scale") or [1.0] * 3)
        mesh = coal.MeshLoader().load(str(self.path.parent / uri), scale)
        return np.array(mesh.vertices()).reshape(-1, 3)


def _joint(joint: Any, kind: str) -> Joint:
    found = Joint("prismatic" if kind == "prismatic" else "revolute")
    axis = joint.find("axis")
    limit, dynamics = axis.find("limit"), axis.find("dynamics")
    if limit is not None and kind != "continuous":
        found.lower = _number(limit, "lower", -UNLIMITED)
        found.upper = _number(limit, "upper", UNLIMITED)
        found.lower = -math.inf if found.lower <= -UNLIMITED else found.lower
        found.upper = math.inf if found.upper >= UNLIMITED else found.upper
    if limit is not None:
        found.effort, found.velocity = (
            _number(limit, each, math.nan) for each in ("effort", "velocity")
        )
    if dynamics is not None:
        found.damping = _number(dynamics, "damping", 0.0)
        found.friction = _number(dynamics, "friction", 0.0)
    return found


def _number(element: Any, name: str, default: float) -> float:
    text = element.findtext(name)
    return default if text is None else float(text)


def _numbers(element: Any, name: str) -> list[float]:
    return [float(each) for each in (element.findtext(name) or "").split()]
