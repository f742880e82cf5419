"""The sizes of a robot on wheels that its controllers need, from its links and joints.

All is measured with the joints at 0, in the frame of the robot's root: x forward, y to the left.
"""

from __future__ import annotations

from math import dist, hypot

from ...meshes.formats import MeshFileError, MissingLibraryError
from ...model.convex import cross, dot
from ...model.pose import IDENTITY, rotate
from ...model.shapes import Capsule, Cylinder, Mesh, Sphere

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...model.joint import Joint
    from ...model.link import Collision, Visual
    from ...model.pose import Vector
    from ...model.robot import Robot
    from ..mesh_paths import MeshPaths

ALIGNED = 1e-3
"""How far the axis of a cylinder may be from that of its wheel, as a sine."""
SAME = 1e-6
"""In metres: how far sizes may differ that are to be equal."""


class Wheel:
    """A wheel.

    Attributes:
        joint: the joint that turns it.
        center: where the middle of its width is on the axis, in the root's frame, in metres.
        axis: the direction of the joint's axis there.
        radius: in metres, or None if no shape says it.
    """

    __slots__ = ("axis", "center", "joint", "radius")

    def __init__(self, robot: Robot, joint: Joint, paths: MeshPaths) -> None:
        """Measure a wheel; its collisions count, or else its visuals."""
        self.joint = joint
        pose = robot.poses().get(joint.child, IDENTITY)
        self.axis = rotate(pose.rotation, joint.axis)
        self.radius: float | None = None
        middle = 0.0
        link = robot.links.get(joint.child)
        shown = (link.collisions, link.visuals) if link is not None else ()
        for shapes in shown:
            found = [each for shape in shapes if (each := _round(shape, joint.axis, paths))]
            if found:
                self.radius, low, high = max(found)
                middle = (low + high) / 2
                break
        self.center = pose.apply(_along(joint.axis, middle))


def _along(axis: Vector, distance: float) -> Vector:
    return (axis[0] * distance, axis[1] * distance, axis[2] * distance)


def _round(
    shown: Collision | Visual, axis: Vector, paths: MeshPaths
) -> tuple[float, float, float] | None:
    """Return the radius of a shape about an axis through the origin of its link, and its ends.

    The ends are distances along the axis. A shape that is not round about the axis has none.
    """
    shape, pose = shown.shape, shown.pose
    at = dot(pose.position, axis)
    off = dist(pose.position, _along(axis, at))
    if isinstance(shape, Sphere):
        return (shape.radius, at - shape.radius, at + shape.radius) if off < SAME else None
    if isinstance(shape, (Cylinder, Capsule)):
        own = rotate(pose.rotation, (0.0, 0.0, 1.0))
        if off > SAME or hypot(*cross(own, axis)) > ALIGNED:
            return None
        half = shape.length / 2 + (shape.radius if isinstance(shape, Capsule) else 0.0)
        return shape.radius, at - half, at + half
    if isinstance(shape, Mesh):
        return _round_mesh(shape, shown, axis, paths)
    return None


def _round_mesh(
    shape: Mesh, shown: Collision | Visual, axis: Vector, paths: MeshPaths
) -> tuple[float, float, float] | None:
    """Return the same of a mesh: the farthest of its corners touches the floor."""
    from ...meshes.triangles import read_mesh

    path = paths.finder.reachable(shape.filename, shape.span or shown.span)
    if path is None:
        return None
    try:
        mesh = read_mesh(path, paths.finder.allows)
    except (MeshFileError, MissingLibraryError):
        return None
    radius, ends = 0.0, []
    for x, y, z in mesh.vertices:
        a, b, c = shape.scale
        point = shown.pose.apply((x * a, y * b, z * c))
        at = dot(point, axis)
        ends.append(at)
        radius = max(radius, dist(point, _along(axis, at)))
    return (radius, min(ends), max(ends)) if ends else None


def is_backward(wheel: Wheel) -> bool:
    """Return whether a positive velocity rolls a wheel along −x: its axis points to the right."""
    return wheel.axis[1] < 0


def radius_of(wheels: Sequence[Wheel]) -> float | None:
    """Return the radius of wheels, their mean; None if it is not known of one of them."""
    known = [wheel.radius for wheel in wheels if wheel.radius is not None]
    return sum(known) / len(known) if known and len(known) == len(wheels) else None


def separation_of(left: Sequence[Wheel], right: Sequence[Wheel]) -> float:
    """Return how far the wheels of both sides are apart along y, between their middles."""
    mean = [sum(wheel.center[1] for wheel in wheels) / len(wheels) for wheels in (left, right)]
    return abs(mean[0] - mean[1])


def base_of(front: Sequence[Vector], rear: Sequence[Vector]) -> float:
    """Return how far points are apart along x: the wheelbase."""
    mean = [sum(point[0] for point in points) / len(points) for points in (front, rear)]
    return abs(mean[0] - mean[1])


def reach_of(wheels: Sequence[Wheel]) -> float:
    """Return the mean distance of wheels from the z axis of the root."""
    return sum(hypot(wheel.center[0], wheel.center[1]) for wheel in wheels) / len(wheels)
