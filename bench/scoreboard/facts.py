"""What a reader finds in a robot, in one form for all formats.

A body is all that fixed joints hold together, under the name of the joint that moves it ("" for the
base): formats and tools differ in which of its links they keep. Units are SI and radians.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
NONE = np.zeros((0, 3))


@dataclass
class Body:
    """The mass of a body, and where it touches, in a frame that moves with it."""

    mass: float = 0.0
    center: Array = field(default_factory=lambda: np.zeros(3))
    inertia: Array = field(default_factory=lambda: np.zeros((3, 3)))
    """3×3, about the center of mass."""
    points: Array = field(default_factory=lambda: NONE)
    """n×3, on its collision shapes."""

    def add(self, mass: float, center: Array, inertia: Array) -> None:
        """Add the mass of a link, with its inertia about its own center."""
        total = self.mass + mass
        if total > 0:
            middle = (self.mass * self.center + mass * center) / total
            self.inertia = (
                self.inertia
                + inertia
                + self.mass * _shifted(self.center - middle)
                + mass * _shifted(center - middle)
            )
            self.mass, self.center = total, middle

    def touch(self, points: Array) -> None:
        """Add the points of a collision shape."""
        self.points = np.vstack((self.points, points))


@dataclass
class Joint:
    """The values of a joint; None for what it does not say."""

    kind: str  # revolute or prismatic
    lower: float = -math.inf
    upper: float = math.inf
    effort: float | None = None
    velocity: float | None = None
    damping: float = 0.0
    friction: float = 0.0
    armature: float = 0.0


@dataclass
class Facts:
    """A robot as a reader finds it; names are `plain`."""

    format: str
    bodies: dict[str, Body] = field(default_factory=dict)
    frames: dict[str, tuple[str, Array]] = field(default_factory=dict)
    """Of each link the joint that moves it, and its 4×4 pose in the frame of that body."""
    joints: dict[str, Joint] = field(default_factory=dict)
    place: Callable[[Mapping[str, float]], dict[str, Array]] = lambda q: {}
    """The 4×4 poses of the bodies at positions of the joints."""
    mimics: dict[str, tuple[str, float, float]] = field(default_factory=dict)
    """Of each following joint its leader, multiplier and offset."""
    drives: dict[str, float | None] = field(default_factory=dict)
    """Of each joint that an actuator moves, its gain on positions, if it has one."""
    sensors: list[tuple[str, str]] = field(default_factory=list)
    """Of each sensor its kind and the joint that moves it."""
    root: str = ""
    """The first link."""
    scene: set[str] = field(default_factory=set)
    """Frames of the world around the robot."""

    def poses(self, positions: Mapping[str, float]) -> dict[str, Array]:
        """Return the poses of the links in a fixed frame of the reader."""
        placed = self.place(positions)
        return {
            name: placed[body] @ pose
            for name, (body, pose) in self.frames.items()
            if body in placed
        }


def matched(result: Facts, source: Facts) -> Facts:
    """Return a result with its joints called as those of the source that move the same links.

    A tool that gives joints other names has lost the names, and nothing else.
    """
    first: dict[str, str] = {}
    for link, (joint, _) in source.frames.items():
        first.setdefault(joint, link)
    names = {}
    for joint in source.joints:
        other, _ = result.frames.get(first.get(joint, ""), ("", None))
        if joint not in result.joints and other and other not in source.joints:
            names[other] = joint
    back = {new: old for old, new in names.items()}

    def new(name: str) -> str:
        return names.get(name, name)

    def place(positions: Mapping[str, float]) -> dict[str, Array]:
        placed = result.place({back.get(name, name): each for name, each in positions.items()})
        return {new(name): each for name, each in placed.items()}

    return Facts(
        result.format,
        {new(name): each for name, each in result.bodies.items()},
        {link: (new(joint), at) for link, (joint, at) in result.frames.items()},
        {new(name): each for name, each in result.joints.items()},
        place,
        {new(name): (new(each[0]), *each[1:]) for name, each in result.mimics.items()},
        {new(name): each for name, each in result.drives.items()},
        [(kind, new(name)) for kind, name in result.sensors],
        result.root,
    )


def plain(name: str) -> str:
    """Return a name as USD can spell it."""
    return re.sub(r"\W", "_", name.rpartition("::")[2])


def pose(rotation: Any, position: Any) -> Array:
    """Return a 4×4 pose of a rotation matrix and a position."""
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = np.asarray(rotation).reshape(3, 3), position
    return found


def moved(points: Array, transform: Array) -> Array:
    """Return n×3 points moved by a 4×4 transform."""
    result: Array = points @ transform[:3, :3].T + transform[:3, 3]
    return result


def turned(about: Any, angle: float) -> Array:
    """Return the 4×4 rotation about a unit axis."""
    x, y, z = about
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return pose(
        np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross, (0,) * 3
    )


def of_rpy(numbers: Iterable[float]) -> Array:
    """Return the 4×4 pose of x y z roll pitch yaw, as URDF and SDF have it."""
    x, y, z, roll, pitch, yaw = numbers
    rotation = turned((0, 0, 1), yaw) @ turned((0, 1, 0), pitch) @ turned((1, 0, 0), roll)
    rotation[:3, 3] = x, y, z
    return rotation


def box(x: float, y: float, z: float) -> Array:
    """Return the corners of a box of these half lengths."""
    return np.array([(a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])


def ball(x: float, y: float | None = None, z: float | None = None, half: float = 0.0) -> Array:
    """Return points on an ellipsoid of these radii; `half` makes it a capsule along z."""
    up, round_ = np.meshgrid(np.linspace(0, math.pi, 33), np.linspace(0, 2 * math.pi, 65))
    unit = np.stack(
        (np.sin(up) * np.cos(round_), np.sin(up) * np.sin(round_), np.cos(up)), axis=-1
    ).reshape(-1, 3)
    points: Array = unit * (x, x if y is None else y, x if z is None else z)
    points[:, 2] += np.where(unit[:, 2] >= 0, half, -half)
    return points


def cylinder(radius: float, half: float) -> Array:
    """Return points on the edges of a cylinder along z."""
    angle = np.linspace(0, 2 * math.pi, 65)
    ring = np.stack((radius * np.cos(angle), radius * np.sin(angle), 0 * angle), axis=-1)
    end = np.array((0, 0, half))
    return np.vstack((ring + end, ring - end))


def _shifted(arm: Array) -> Array:
    """Return the inertia of a unit mass at the end of an arm."""
    result: Array = arm @ arm * np.eye(3) - np.outer(arm, arm)
    return result
