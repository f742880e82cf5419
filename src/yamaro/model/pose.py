"""Poses: rotations and positions, composed, inverted and written as 4×4 matrices.

Angles are in radians, in URDF's roll, pitch and yaw. A rotation is a matrix, written as three rows,
that takes a vector given in the child's axes to the parent's.
"""

from __future__ import annotations

from math import atan2, cos, hypot, sin, sqrt

from ..source import Public

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.tree import Element

Vector = tuple[float, float, float]
Rotation = tuple[Vector, Vector, Vector]

ZERO: Vector = (0.0, 0.0, 0.0)
X_AXIS: Vector = (1.0, 0.0, 0.0)
UNTURNED: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

GIMBAL_LOCK = 1e-12
"""Cosine of the pitch below which roll and yaw turn about the same axis."""


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> Rotation:
    """Return the rotation R = Rz(yaw)·Ry(pitch)·Rx(roll), about fixed axes, as URDF defines it.

    Args:
        roll: angle about the parent's x axis, in radians.
        pitch: angle about the parent's y axis, in radians.
        yaw: angle about the parent's z axis, in radians.

    Source: http://wiki.ros.org/urdf/XML/joint, "rpy"; J. J. Craig, Introduction to Robotics,
    3rd edition, equation 2.64.
    """
    sr, cr = sin(roll), cos(roll)
    sp, cp = sin(pitch), cos(pitch)
    sy, cy = sin(yaw), cos(yaw)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def rpy_from_rotation(rotation: Rotation) -> Vector:
    """Return roll, pitch and yaw in radians, with the pitch in [−π/2, π/2].

    Where the pitch is ±π/2 only the sum or the difference of roll and yaw is determined; the yaw
    is then 0, as in tf2 and in scipy. The roll is worked out after the yaw has been taken away,
    which keeps the result accurate beside that pitch as well.

    Source: M. Day, Extracting Euler Angles from a Rotation Matrix, Insomniac Games, 2012.
    """
    (r00, r01, r02), (r10, r11, r12), (r20, _, _) = rotation
    cos_pitch = hypot(r00, r10)
    yaw = atan2(r10, r00) if cos_pitch > GIMBAL_LOCK else 0.0
    sy, cy = sin(yaw), cos(yaw)
    roll = atan2(sy * r02 - cy * r12, cy * r11 - sy * r01)
    return roll, atan2(-r20, cos_pitch), yaw


def rotate(rotation: Rotation, vector: Vector) -> Vector:
    """Return the vector turned: R·v."""
    x, y, z = vector
    (a, b, c), (d, e, f), (g, h, i) = rotation
    return (a * x + b * y + c * z, d * x + e * y + f * z, g * x + h * y + i * z)


def multiply(first: Rotation, second: Rotation) -> Rotation:
    """Return the product `first`·`second`, which turns by `second` and then by `first`."""
    (a, b, c), (d, e, f), (g, h, i) = first
    (p, q, r), (s, t, u), (v, w, x) = second
    return (
        (a * p + b * s + c * v, a * q + b * t + c * w, a * r + b * u + c * x),
        (d * p + e * s + f * v, d * q + e * t + f * w, d * r + e * u + f * x),
        (g * p + h * s + i * v, g * q + h * t + i * w, g * r + h * u + i * x),
    )


def transposed(rotation: Rotation) -> Rotation:
    """Return the rotation that turns back: Rᵀ, which is R⁻¹."""
    (a, b, c), (d, e, f), (g, h, i) = rotation
    return ((a, d, g), (b, e, h), (c, f, i))


def unit_vector(vector: Vector) -> Vector:
    """Return a vector of the same direction and length 1; the x axis for one of no length."""
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


def rotation_from_z(axis: Vector) -> Rotation:
    """Return the smallest rotation that takes the z axis to a unit vector.

    About v = z × axis by the angle between them, as R = 1 + [v] + [v]²/(1 + cos); for −z, half a
    turn about x.

    Source: T. Möller and J. F. Hughes, Efficiently Building a Matrix to Rotate One Vector to
    Another, Journal of Graphics Tools 4, 1999.
    """
    x, y, z = axis
    if z <= -1.0:
        return ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0))
    k = 1 / (1 + z)
    return ((1 - k * x * x, -k * x * y, x), (-k * x * y, 1 - k * y * y, y), (-x, -y, z))


def rotation_from_quaternion(x: float, y: float, z: float, w: float) -> Rotation:
    """Return the rotation of a quaternion of any length; no rotation for one of length 0.

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


def quaternion_from_rotation(rotation: Rotation) -> tuple[float, float, float, float]:
    """Return the unit quaternion w, x, y, z of a rotation; of the two of them that with w ≥ 0.

    Source: J. Diebel, Representing Attitude: Euler Angles, Unit Quaternions, and Rotation Vectors,
    2006, "Rotation Matrix to Unit Quaternion": the largest part comes from the diagonal, and the
    others are divided by it.
    """
    (a, b, c), (d, e, f), (g, h, i) = rotation
    parts = (1 + a + e + i, 1 + a - e - i, 1 - a + e - i, 1 - a - e + i)
    largest = parts.index(max(parts))
    size = parts[largest]  # four times the square of that part
    w, x, y, z = (
        (size, h - f, c - g, d - b),
        (h - f, size, b + d, c + g),
        (c - g, b + d, size, f + h),
        (d - b, c + g, f + h, size),
    )[largest]
    length = sqrt(w * w + x * x + y * y + z * z)
    if w < 0:
        length = -length
    return (w / length, x / length, y / length, z / length)


class Pose(Public):
    """T_parent_child: takes a point given in the child's frame to the parent's.

    Attributes:
        rotation: the child's axes as columns of a 3×3 matrix, which is given as three rows.
        position: the child's origin in the parent's frame, in metres.
        element: the `<origin>` that it was read from, or None for a pose that was computed.
    """

    __slots__ = ("element", "position", "rotation")
    _internal = frozenset(("element",))

    def __init__(
        self, rotation: Rotation = UNTURNED, position: Vector = ZERO, element: Element | None = None
    ) -> None:
        """Create a pose; by default the one that changes nothing."""
        self.rotation = rotation
        self.position = position
        self.element = element

    @property
    def span(self) -> Span | None:
        """Return where the pose is written; None if it was computed, or is a default."""
        return self.element.span if self.element is not None else None

    @property
    def x(self) -> float:
        """Return the x coordinate of the position, in metres."""
        return self.position[0]

    @property
    def y(self) -> float:
        """Return the y coordinate of the position, in metres."""
        return self.position[1]

    @property
    def z(self) -> float:
        """Return the z coordinate of the position, in metres."""
        return self.position[2]

    @property
    def rpy(self) -> Vector:
        """Return roll, pitch and yaw in radians, as URDF defines them; see `rpy_from_rotation`."""
        return rpy_from_rotation(self.rotation)

    def __matmul__(self, other: Pose) -> Pose:
        """Return T_parent_grandchild, of T_parent_child and T_child_grandchild."""
        return Pose(multiply(self.rotation, other.rotation), self.apply(other.position))

    def inverse(self) -> Pose:
        """Return T_child_parent."""
        rotation = transposed(self.rotation)
        x, y, z = rotate(rotation, self.position)
        return Pose(rotation, (-x, -y, -z))

    def apply(self, point: Vector) -> Vector:
        """Return a point given in the child's frame as it is in the parent's, in metres."""
        x, y, z = rotate(self.rotation, point)
        px, py, pz = self.position
        return (x + px, y + py, z + pz)

    def matrix(self) -> list[list[float]]:
        """Return the homogeneous 4×4 matrix, as rows."""
        rows = [[*row, p] for row, p in zip(self.rotation, self.position, strict=True)]
        return [*rows, [0.0, 0.0, 0.0, 1.0]]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pose):
            return NotImplemented
        return self.rotation == other.rotation and self.position == other.position

    def __hash__(self) -> int:
        return hash((self.rotation, self.position))

    def __repr__(self) -> str:
        return f"Pose(rotation={self.rotation!r}, position={self.position!r})"


IDENTITY = Pose()
