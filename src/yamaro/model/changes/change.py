"""`Change`: one thing that differs between two robots; `Changes`: all of them, and what follows."""

from __future__ import annotations

from ...source import Public

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Span
    from ..pose import Vector
    from .motion import Motion

ADDED, REMOVED, CHANGED, RENAMED = "added", "removed", "changed", "renamed"


class Moved(Public):
    """The links that are elsewhere because of one changed joint.

    Attributes:
        links: their names in the first robot, in its order.
        link: the one that moved the furthest.
        distance: how far, in metres: with all joints at zero, or if that is nothing, at most in
            the other positions that were tried.
        angle: how much that link turned, in radians.
        is_at_zero: whether both are those with all joints at zero.
    """

    __slots__ = ("angle", "distance", "is_at_zero", "link", "links")

    def __init__(
        self, links: list[str], *, link: str, distance: float, angle: float, is_at_zero: bool
    ) -> None:
        self.links = links
        self.link = link
        self.distance = distance
        self.angle = angle
        self.is_at_zero = is_at_zero


class Change(Public):
    """Something that differs between two robots.

    Attributes:
        kind: `added`, `removed`, `changed` or `renamed`.
        of: what it is about: `robot`, `link`, `joint`, `material`, `sensor`, `actuator`,
            `surface`, `state`, `group`, `loop`, `collisions`, or `element` for other XML.
        name: its name in the first robot; of what is added, in the second.
        new_name: its name in the second robot if that is another one, else None.
        what: which value of it, such as `limit.upper`; "" for the whole.
        before, after: the value in both robots: a number, a text, a list or a dict of them; None
            where there is none.
        unit: of a number, or "".
        remark: what else there is to say, such as how far an origin moved; or "".
        first, second: the places in the files; None on the side that has none.
        moved: the links that are elsewhere because of it, or None.
    """

    __slots__ = (
        "after", "before", "first", "kind", "moved", "name", "new_name", "of", "remark", "second",
        "unit", "what",
    )  # fmt: skip

    def __init__(
        self,
        kind: str,
        of: str,
        name: str,
        *,
        what: str = "",
        before: object = None,
        after: object = None,
        new_name: str | None = None,
        unit: str = "",
        remark: str = "",
        first: Span | None = None,
        second: Span | None = None,
    ) -> None:
        self.kind = kind
        self.of = of
        self.name = name
        self.new_name = new_name
        self.what = what
        self.before = before
        self.after = after
        self.unit = unit
        self.remark = remark
        self.first = first
        self.second = second
        self.moved: Moved | None = None

    def key(self) -> tuple[object, ...]:
        """Return all but the places and what follows, as a value to compare."""
        return (
            *(self.kind, self.of, self.name, self.new_name, self.what),
            *(repr(self.before), repr(self.after), self.unit, self.remark),
        )

    def __repr__(self) -> str:
        what = f" {self.what}" if self.what else ""
        new = f" to '{self.new_name}'" if self.new_name is not None else ""
        values = f": {self.before!r} to {self.after!r}" if self.kind == CHANGED else ""
        return f"<{self.kind} {self.of} '{self.name}'{new}{what}{values}>"


class Changes(Public):
    """What changed from one robot to another.

    Attributes:
        changes: in the order of the first robot; what is added comes after that of its kind.
        motion: whether the links that both have move the same.
        mass: of all links, before and after, in kg.
        center: the centre of mass at zero, before and after, in metres in the frame of the
            reference link of `motion`; None for a robot without mass.
        links, joints: the names in the first robot, with those in the second.
        skipped: what was not compared, because one of the robots is in a format that cannot hold
            it: phrases such as "2 sensors".
    """

    __slots__ = ("center", "changes", "joints", "links", "mass", "motion", "skipped")

    def __init__(
        self,
        changes: list[Change],
        *,
        motion: Motion,
        mass: tuple[float, float],
        center: tuple[Vector | None, Vector | None],
        links: dict[str, str],
        joints: dict[str, str],
        skipped: list[str],
    ) -> None:
        self.changes = changes
        self.motion = motion
        self.mass = mass
        self.center = center
        self.links = links
        self.joints = joints
        self.skipped = skipped

    def __bool__(self) -> bool:
        """Return whether anything changed."""
        return bool(self.changes)

    def __iter__(self):  # type: ignore[no-untyped-def]
        return iter(self.changes)

    def __len__(self) -> int:
        return len(self.changes)
