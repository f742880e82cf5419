"""When two numbers, vectors, rotations or texts count as equal."""

from __future__ import annotations

from math import asin, hypot, sqrt

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..pose import Pose, Rotation, Vector

DEFAULT = 1e-9
"""How far numbers may differ, as a part of the larger one; rotations in radians."""
ROUNDING = 1e-12
"""Differences that are rounding, such as -0 and 1e-17, whatever the numbers."""


class Tolerance:
    """Says which values are equal.

    Attributes:
        part: how far numbers may differ, as a part of the larger one; rotations in radians.
    """

    __slots__ = ("part",)

    def __init__(self, part: float = DEFAULT) -> None:
        self.part = part

    def same(self, one: float | None, other: float | None) -> bool:
        """Return whether two numbers are equal; None is equal to None alone."""
        if one is None or other is None:
            return one is other
        return one == other or abs(one - other) <= self._room(max(abs(one), abs(other)))

    def same_row(self, one: Sequence[float] | None, other: Sequence[float] | None) -> bool:
        """Return whether two vectors are equal, measured by the longer one."""
        if one is None or other is None:
            return one is other
        if len(one) != len(other):
            return False
        room = self._room(max(hypot(*one), hypot(*other)))
        return all(a == b or abs(a - b) <= room for a, b in zip(one, other, strict=True))

    def same_rotation(self, one: Rotation, other: Rotation) -> bool:
        """Return whether two rotations are equal, however they are written."""
        return angle_between(one, other) <= max(self.part, ROUNDING)

    def same_pose(self, one: Pose, other: Pose) -> bool:
        """Return whether two poses are equal."""
        return self.same_row(one.position, other.position) and self.same_rotation(
            one.rotation, other.rotation
        )

    def same_text(self, one: str, other: str) -> bool:
        """Return whether two texts have the same words, numbers compared as such."""
        if one == other:
            return True
        words, others = one.split(), other.split()
        return len(words) == len(others) and all(map(self._same_word, words, others))

    def _same_word(self, one: str, other: str) -> bool:
        if one == other:
            return True
        try:
            return self.same(float(one), float(other))
        except ValueError:
            return False

    def _room(self, size: float) -> float:
        return max(self.part * size, ROUNDING)


def angle_between(one: Rotation, other: Rotation) -> float:
    """Return the angle of the rotation from one to the other, in radians, exact for small ones.

    From the Frobenius norm of the difference, which is 2·√2·sin(angle/2).

    Source: D. Q. Huynh, Metrics for 3D Rotations, Journal of Mathematical Imaging and Vision 35,
    2009, equations 22 and 31.
    """
    rows = zip(one, other, strict=True)
    squares = sum((a - b) * (a - b) for row, twin in rows for a, b in zip(row, twin, strict=True))
    return 2 * asin(min(sqrt(squares / 8), 1.0))


def distance_between(one: Vector, other: Vector) -> float:
    """Return the distance of two points in metres."""
    return hypot(*(a - b for a, b in zip(one, other, strict=True)))
