"""The comparison of two robots while it runs: its tolerance, the names, and the changes."""

from __future__ import annotations

from math import asin, hypot, sqrt

from .change import ADDED, CHANGED, REMOVED, Change

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ...source import Span
    from ...xml.tree import Element
    from ..pose import Pose, Rotation, Vector
    from ..robot import Robot
    from .matching import Matching

    SameFile = Callable[[str, Span, str, Span], bool | None]
    """Whether two files have the same content, by their names as written and where; None if one
    of them is not there."""


# --- which values are equal -------------------------------------------------------------------


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


# --- comparing --------------------------------------------------------------------------------


Place = tuple["Span | None", "Span | None"]
NOWHERE: Place = (None, None)


class Owner:
    """What a value belongs to.

    Attributes:
        of: what it is: see `Change.of`.
        name: its name in the first robot.
        new_name: its name in the second robot if that is another one.
        places: where it is written in both.
    """

    __slots__ = ("name", "new_name", "of", "places")

    def __init__(self, of: str, name: str, *, new_name: str | None, places: Place) -> None:
        self.of = of
        self.name = name
        self.new_name = new_name if new_name != name else None
        self.places = places


class Comparing:
    """One comparison of two robots.

    Attributes:
        first, second: the robots.
        matching: which link and joint is which.
        tolerance: which values are equal.
        changes: those found so far.
        equal: whether two trees are equal, by their identities, with the trees, which it keeps
            alive.
    """

    __slots__ = ("_same_file", "changes", "equal", "first", "matching", "second", "tolerance")

    def __init__(
        self,
        first: Robot,
        second: Robot,
        *,
        matching: Matching,
        tolerance: Tolerance,
        same_file: SameFile | None,
    ) -> None:
        self.first = first
        self.second = second
        self.matching = matching
        self.tolerance = tolerance
        self.changes: list[Change] = []
        self.equal: dict[tuple[int, int], tuple[bool, Element, Element]] = {}
        self._same_file = same_file

    # --- noting what differs ---

    def change(
        self,
        owner: Owner,
        what: str,
        before: object,
        after: object,
        *,
        unit: str = "",
        remark: str = "",
        places: Place | None = None,
    ) -> None:
        """Note a value that differs."""
        first, second = places or owner.places
        self.changes.append(
            Change(
                *(CHANGED, owner.of, owner.name),
                what=what,
                before=before,
                after=after,
                new_name=owner.new_name,
                unit=unit,
                remark=remark,
                first=first or owner.places[0],
                second=second or owner.places[1],
            )
        )

    def add(
        self, of: str, name: str, *, is_new: bool, value: object = None, place: Span | None = None
    ) -> None:
        """Note what is only in the second robot, or only in the first."""
        kind, before, after = (ADDED, None, value) if is_new else (REMOVED, value, None)
        first, second = (None, place) if is_new else (place, None)
        self.changes.append(
            Change(kind, of, name, before=before, after=after, first=first, second=second)
        )

    # --- comparing values ---

    def number(
        self,
        owner: Owner,
        what: str,
        values: Sequence[float | None],
        *,
        unit: str = "",
        remark: str = "",
        places: Place | None = None,
    ) -> None:
        """Compare two numbers, None for one that is left out."""
        before, after = values
        if not self.tolerance.same(before, after):
            self.change(owner, what, before, after, unit=unit, remark=remark, places=places)

    def text(
        self, owner: Owner, what: str, values: Sequence[object], *, places: Place | None = None
    ) -> None:
        """Compare two texts, or other values that are equal or not."""
        before, after = values
        if before != after:
            self.change(owner, what, before, after, places=places)

    def row(
        self,
        owner: Owner,
        what: str,
        values: Sequence[Sequence[float] | None],
        *,
        unit: str = "",
        remark: str = "",
        places: Place | None = None,
    ) -> None:
        """Compare two rows of numbers."""
        before, after = values
        if not self.tolerance.same_row(before, after):
            one, other = (None if row is None else list(row) for row in values)
            self.change(owner, what, one, other, unit=unit, remark=remark, places=places)

    def pose(self, owner: Owner, what: str, one: Pose, other: Pose, places: Place) -> None:
        """Compare two poses."""
        tolerance = self.tolerance
        if tolerance.same_pose(one, other):
            return
        before: dict[str, object] = {}
        after: dict[str, object] = {}
        remarks = []
        if not tolerance.same_row(one.position, other.position):
            before["xyz"], after["xyz"] = list(one.position), list(other.position)
            remarks.append(f"moved {length_text(distance_between(one.position, other.position))}")
        if not tolerance.same_rotation(one.rotation, other.rotation):
            before["rpy"], after["rpy"] = list(one.rpy), list(other.rpy)
            remarks.append(f"turned {angle_text(angle_between(one.rotation, other.rotation))}")
        places = (one.span or places[0], other.span or places[1])
        self.change(owner, what, before, after, remark=", ".join(remarks), places=places)

    def file(
        self, owner: Owner, what: str, names: Sequence[str], places: tuple[Span, Span]
    ) -> None:
        """Compare two files that meshes or textures name: by content, and else by name."""
        before, after = names
        same = None
        if self._same_file is not None:
            same = self._same_file(before, places[0], after, places[1])
        if before == after:
            if same is False:
                remark = "the content of the file differs"
                self.change(owner, what, before, after, remark=remark, places=places)
        elif not same or _last(before) != _last(after):
            remark = "with the same content" if same else ""
            self.change(owner, what, before, after, remark=remark, places=places)

    # --- names ---

    def link(self, name: str) -> str:
        """Return what a link of the first robot is called in the second."""
        return self.matching.links.get(name, name)

    def joint(self, name: str) -> str:
        """Return what a joint of the first robot is called in the second."""
        return self.matching.joints.get(name, name)

    def body(self, name: str) -> str:
        """Return what a link or joint of the first robot is called in the second."""
        return self.matching.links.get(name) or self.joint(name)

    def named(
        self,
        owner: Owner,
        what: str,
        values: tuple[str | None, str | None],
        rename: Callable[[str], str],
        *,
        places: Place | None = None,
    ) -> None:
        """Compare two names of links or joints, which may have been renamed."""
        before, after = values
        if (None if before is None else rename(before)) != after:
            self.change(owner, what, before, after, places=places)


def _last(name: str) -> str:
    return name.replace("\\", "/").rpartition("/")[2]


def length_text(metres: float) -> str:
    """Return a length for people: in millimetres below one metre."""
    return f"{metres:.3g} m" if metres >= 1 else f"{metres * 1000:.3g} mm"


def angle_text(radians: float) -> str:
    """Return an angle for people, in degrees."""
    return f"{radians * 57.29577951308232:.3g}°"
