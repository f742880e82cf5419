"""Transforms: a rotation and a position, composed, inverted and written as 4×4 matrices."""

from __future__ import annotations

from math import cos, hypot, sin

from ...model.rotations import ZERO, Rotation, Vector, multiply, rotate

X_AXIS: Vector = (1.0, 0.0, 0.0)


class Transform:
    """T_parent_child: takes a point given in the child's frame to the parent's, in metres."""

    __slots__ = ("position", "rotation")

    def __init__(self, rotation: Rotation, position: Vector) -> None:
        """Hold the child's axes, as columns, and its origin, both in the parent's frame."""
        self.rotation = rotation
        self.position = position

    def __matmul__(self, other: Transform) -> Transform:
        """Return T_parent_grandchild, of T_parent_child and T_child_grandchild."""
        return Transform(multiply(self.rotation, other.rotation), self.apply(other.position))

    def apply(self, point: Vector) -> Vector:
        """Return a point given in the child's frame as it is in the parent's."""
        x, y, z = rotate(self.rotation, point)
        px, py, pz = self.position
        return (x + px, y + py, z + pz)

    def matrix(self) -> list[list[float]]:
        """Return the homogeneous 4×4 matrix, as rows."""
        rows = [[*row, p] for row, p in zip(self.rotation, self.position, strict=True)]
        return [*rows, [0.0, 0.0, 0.0, 1.0]]


UNTURNED: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
IDENTITY = Transform(UNTURNED, ZERO)


def unit_vector(vector: Vector) -> Vector:
    """Return a vector of the same direction and length 1; that of x for one of no length."""
    length = hypot(*vector)
    if not length:
        return X_AXIS
    x, y, z = vector
    return (x / length, y / length, z / length)


def rotation_about(axis: Vector, angle: float) -> Rotation:
    """Return the rotation by an angle in radians about a unit vector.

    Source: J. J. Craig, Introduction to Robotics, 3rd edition, equation 2.80.
    """
    x, y, z = axis
    c, s = cos(angle), sin(angle)
    v = 1 - c
    return (
        (x * x * v + c, x * y * v - z * s, x * z * v + y * s),
        (x * y * v + z * s, y * y * v + c, y * z * v - x * s),
        (x * z * v - y * s, y * z * v + x * s, z * z * v + c),
    )


def rotation_from_quaternion(x: float, y: float, z: float, w: float) -> Rotation:
    """Return the rotation of a quaternion, whatever its length; of none, no rotation.

    Source: J. J. Craig, Introduction to Robotics, 3rd edition, equation 2.91 (Euler parameters).
    """
    length = hypot(x, y, z, w)
    if not length:
        return UNTURNED
    x, y, z, w = x / length, y / length, z / length, w / length
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
