"""Poses: a rotation and a position, composed, inverted and written as 4×4 matrices."""

from __future__ import annotations

from .rotations import UNTURNED, ZERO, multiply, rotate, rpy_from_rotation, transposed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.tree import Element
    from .rotations import Rotation, Vector


class Pose:
    """T_parent_child: takes a point given in the child's frame to the parent's.

    Attributes:
        rotation: the child's axes as columns of a 3×3 matrix, which is given as three rows.
        position: the child's origin in the parent's frame, in metres.
        element: the `<origin>` that it was read from, or None for a pose that was computed.
    """

    __slots__ = ("element", "position", "rotation")

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
