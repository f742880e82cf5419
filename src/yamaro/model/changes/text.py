"""Changes as text for people: one line for each, and what follows from it."""

from __future__ import annotations

from ...terminal import BLUE, BOLD, DIM, RED, YELLOW, painted, printable, shortened
from .change import ADDED, CHANGED, REMOVED, RENAMED
from .context import angle_text, distance_between, length_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ...source import Span
    from ..robot import Robot
    from .change import Change, Changes, Moved

    Name = Callable[[Span], str]


# --- values -----------------------------------------------------------------------------------


DIGITS = (6, 9, 12, 17)
MOMENTS = ("ixx", "iyy", "izz")
FILES = ("mesh", "texture")
"""How the values are called that name files."""
NONE = "none"
ARROW = " → "


def values_text(change: Change) -> str:
    """Return what a value was and is: `1.2 → 1.57 rad`."""
    before, after = change.before, change.after
    if change.what == "inertia" and isinstance(before, dict) and isinstance(after, dict):
        text = _inertia_text(before, after)
    elif isinstance(before, dict) and isinstance(after, dict):
        text = _dicts_text(before, after)
    elif folders := _folders_of(change):
        text = f"in {_pair_text(*folders)}"
    else:
        text = _pair_text(before, after)
    if change.unit and after is not None:
        text += f" {change.unit}"
    elif change.unit:
        text = text.replace(ARROW, f" {change.unit}{ARROW}")
    percent = ""
    if change.what == "mass" and isinstance(before, float) and isinstance(after, float):
        percent = f"{100 * (after / before - 1):+.3g} %" if before > 0 else ""
    remarks = [part for part in (percent, change.remark) if part]
    return f"{text} ({', '.join(remarks)})" if remarks else text


def _inertia_text(before: dict[str, object], after: dict[str, object]) -> str:
    """Return the moments of inertia; if all of them differ, the products by name alone."""
    moments = [name for name in MOMENTS if name in before]
    products = [name for name in before if name not in MOMENTS]
    if len(moments) < len(MOMENTS) or not products:
        return _dicts_text(before, after)
    text = _dicts_text(*({name: each[name] for name in MOMENTS} for each in (before, after)))
    return f"{text}, and {', '.join(products)}"


def _folders_of(change: Change) -> tuple[str, str] | None:
    """Return the folders of two files that have the same name in different folders, or None."""
    before, after = change.before, change.after
    if not change.what.endswith(FILES) or before == after:
        return None
    if not isinstance(before, str) or not isinstance(after, str):
        return None
    (folder, slash, name), (other, also, new_name) = before.rpartition("/"), after.rpartition("/")
    return (folder + slash, other + also) if name == new_name and slash and also else None


def _dicts_text(before: dict[str, object], after: dict[str, object]) -> str:
    pairs = [
        f"{name} {_pair_text(before.get(name), after.get(name))}"
        for name in dict.fromkeys((*before, *after))
    ]
    return ", ".join(pairs)


def _pair_text(before: object, after: object) -> str:
    """Return both values, with more digits if they look the same."""
    for digits in DIGITS:
        one, other = value_text(before, digits), value_text(after, digits)
        if one != other:
            break
    return one if one == other else f"{one}{ARROW}{other}"


def value_text(value: object, digits: int = DIGITS[0]) -> str:
    """Return one value as text."""
    if value is None:
        return NONE
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        text = f"{value:.{digits}g}"
        return "0" if text == "-0" else text
    if isinstance(value, (list, tuple)):
        return " ".join(value_text(item, digits) for item in value) or NONE
    if isinstance(value, dict):
        return ", ".join(f"{name} {value_text(item, digits)}" for name, item in value.items())
    return " ".join(str(value).split()) or '""'


# --- text -------------------------------------------------------------------------------------


MARKS = {ADDED: "+", REMOVED: "-", CHANGED: "~", RENAMED: ">"}
STYLES = {ADDED: BLUE, REMOVED: RED, CHANGED: YELLOW, RENAMED: YELLOW}
HEADINGS = {
    "robot": "robot",
    "link": "links",
    "joint": "joints",
    "material": "materials",
    "sensor": "sensors",
    "actuator": "actuators",
    "surface": "surfaces",
    "state": "states",
    "group": "groups",
    "controller": "controllers",
    "loop": "loops",
    "collisions": "collisions",
    "element": "other elements",
}
"""The kinds of things in the order in which they are shown."""
MOST_NAMES = 4
"""Names to show in a row; of more of them, one less."""
LEAST_MOVED = 1e-7
"""Metres that a centre of mass moves if it moves at all."""


class Line:
    """One line.

    Attributes:
        changes: those that it shows: one, or the same one of several things.
        text: what it says after the names.
        moved: what the changes move.
        below: further lines that belong to it.
    """

    __slots__ = ("below", "changes", "moved", "text")

    def __init__(self, change: Change, text: str) -> None:
        self.changes = [change]
        self.text = text
        self.moved = [] if change.moved is None else [change.moved]
        self.below: list[str] = []

    @property
    def change(self) -> Change:
        """Return the first change."""
        return self.changes[0]

    @property
    def names(self) -> list[str]:
        """Return the names of what changed."""
        return list(dict.fromkeys(change.name for change in self.changes))

    def key(self) -> str:
        """Return what is equal for the same change of something else."""
        if self.change.what != "inertia":
            return self.text
        return f"{self.text} {self.change.before!r} {self.change.after!r}"  # some is not shown

    def take(self, other: Line) -> None:
        """Add the same change of something else."""
        self.changes += other.changes
        self.moved += other.moved


class DiffText:
    """Writes the changes between two robots as text."""

    def __init__(
        self,
        changes: Changes,
        robots: tuple[Robot, Robot],
        *,
        name: Name,
        mains: tuple[str, str],
    ) -> None:
        """Prepare.

        Args:
            changes: what changed.
            robots: the two robots.
            name: gives the name of the file that a place is in.
            mains: the names of the main files, which are not repeated in each line.
        """
        self._changes = changes
        self._first, self._second = robots
        self._name = name
        self._mains = mains
        self._removed = self._names(REMOVED, "link")
        self._added = self._names(ADDED, "link")
        self._renamed = {
            change.name: change.new_name
            for change in changes.changes
            if change.kind == RENAMED and change.of == "joint"
        }

    def _names(self, kind: str, of: str) -> dict[str, Change]:
        return {c.name: c for c in self._changes.changes if c.kind == kind and c.of == of}

    def render(self, labels: tuple[str, str], *, color: bool = False) -> str:
        """Return the text, which is empty if nothing changed."""
        if not self._changes.changes:
            return ""
        heads = (f"--- {printable(labels[0])}", f"+++ {printable(labels[1])}")
        lines = [_painted(head, BOLD, color) for head in heads]
        for of, heading in HEADINGS.items():
            groups = self._groups([c for c in self._changes.changes if c.of == of])
            if groups:
                lines.append(_painted(heading, BOLD, color))
                for group in groups:
                    lines += self._lines_of(group, color)
        lines += self.totals()
        return "\n".join(line.replace("\n", " ") for line in lines) + "\n"

    def _lines_of(self, rows: list[Line], color: bool) -> list[str]:
        """Return the lines about one thing, or about several that changed in the same way."""
        change = rows[0].change
        mark = _painted(MARKS[change.kind], STYLES[change.kind], color)
        names = _several([printable(name) for name in rows[0].names])
        lines = []
        begin = f"  {mark} {names}"
        if len(rows) > 1:
            lines.append(begin)
            begin = "     "
        for row in rows:
            places = {self._where_written(change) for change in row.changes}
            place = places.pop() if len(places) == 1 else ""
            parts = [begin + ("  " if begin.strip() and row.text else " ") + shortened(row.text)]
            if place:
                parts.append(_painted(f"({printable(place)})", DIM, color))
            lines.append("  ".join(parts).rstrip())
            if row.moved:
                lines.append(f"        {_moved_text(row.moved)}")
            lines += [f"        {line}" for line in row.below]
        return lines

    # --- rows ---

    def _groups(self, changes: Sequence[Change]) -> list[list[Line]]:
        """Return the lines of changes of one kind of thing, those of one thing together.

        Things that changed in the same way share their lines.
        """
        things: dict[tuple[str, str], list[Line]] = {}
        for change in changes:
            row: Line | None
            if change.kind == CHANGED:
                values = values_text(change)
                row = Line(change, f"{change.what} {values}" if change.what else values)
            elif change.kind == RENAMED:
                text = self._renamed_text(change)
                row = Line(change, text) if text else None
            elif change.of == "link":
                row = self._one_sided_link(change)
            elif change.of == "joint":
                row = self._one_sided_joint(change)
            else:
                value = change.after if change.kind == ADDED else change.before
                row = Line(change, "" if value is None else value_text(value))
            if row is not None:
                things.setdefault((change.kind, change.name), []).append(row)
        groups: list[list[Line]] = []
        known: dict[tuple[str, ...], list[Line]] = {}
        for (kind, _), rows in things.items():
            rows = _joined(rows)
            if kind == CHANGED:
                group = known.setdefault(tuple(row.key() for row in rows), rows)
                if group is not rows:
                    for row, other in zip(group, rows, strict=True):
                        row.take(other)
                    continue
            groups.append(rows)
        return groups

    def _renamed_text(self, change: Change) -> str:
        """Return the new name, of a link with its joint's; "" for a joint renamed with its link."""
        if change.of == "joint":
            child = self._first.joints[change.name].child
            if self._changes.links.get(child, child) != child:
                return ""
        text = f"{ARROW.strip()} {change.new_name}"
        if change.of == "link":
            joint = self._first.parent_joint(change.name)
            new = None if joint is None else self._renamed.get(joint.name)
            if joint is not None and new is not None:
                text += f", with its joint {joint.name}{ARROW}{new}"
        return text

    def _one_sided_link(self, change: Change) -> Line | None:
        """Return the line of a link that only one robot has; None for one below another such."""
        robot, others = (
            (self._second, self._added) if change.kind == ADDED else (self._first, self._removed)
        )
        joint = robot.parent_joint(change.name)
        if joint is not None and joint.parent in others:
            return None
        facts = change.after if change.kind == ADDED else change.before
        assert isinstance(facts, dict)
        parts = []
        if "mass" in facts:
            parts.append(f"{value_text(facts['mass'], 4)} kg")
        if joint is not None:
            parts.append(f"on {joint.parent} by {joint.name} ({joint.type})")
        row = Line(change, ", ".join(parts))
        found: dict[str, None] = {}
        pending = [change.name]
        while pending:
            joints = robot.joints_below(pending.pop())
            children = [j.child for j in joints if j.child in others and j.child not in found]
            found.update(dict.fromkeys(children))
            pending += reversed(children)
        found.pop(change.name, None)
        below = list(found)
        if below:
            count = f"{len(below)} links" if len(below) > 1 else "the link"
            row.below.append(f"and {count} below it: {_several(list(map(printable, below)))}")
        return row

    def _one_sided_joint(self, change: Change) -> Line | None:
        """Return the line of a joint that only one robot has; None if its link is such too."""
        robot, others = (
            (self._second, self._added) if change.kind == ADDED else (self._first, self._removed)
        )
        joint = robot.joints[change.name]
        above = robot.parent_joint(joint.child)
        if joint.child in others and above is not None and above.name == joint.name:
            return None
        return Line(change, f"{joint.type}, {joint.parent}{ARROW}{joint.child}")

    # --- what follows ---

    def totals(self) -> list[str]:
        """Return the lines about the robot as a whole."""
        lines = []
        before, after = self._changes.mass
        if value_text(before) != value_text(after):
            lines.append(f"total mass: {value_text(before)}{ARROW}{value_text(after)} kg")
        one, other = self._changes.center
        if one is not None and other is not None:
            distance = distance_between(one, other)
            if distance > LEAST_MOVED:
                lines.append(f"centre of mass: moved {length_text(distance)}")
        return [*lines, motion_text(self._changes)]

    def _where_written(self, change: Change) -> str:
        """Return where a change is written: lines of the files compared, or of other files."""
        places = []
        for span, main in zip((change.first, change.second), self._mains, strict=True):
            if span is not None:
                name = self._name(span)
                places.append(("" if name == main else name, span.location()[0]))
        if not places:
            return ""
        (name, line), (new, new_line) = places[0], places[-1]
        lines = f"{line}" if line == new_line else f"{line}{ARROW}{new_line}"
        if name == new:
            return f"{new}:{lines}" if new else f"line {lines}"
        return f"{name or 'line'}:{line}{ARROW}{new or 'line'}:{new_line}".replace("line:", "line ")


def motion_text(changes: Changes) -> str:
    """Return whether the robots move the same, as a line."""
    motion = changes.motion
    if motion.is_same:
        ranges = f", but the limits of {_several(list(motion.ranges))} differ"
        return "moves the same: yes" + (ranges if motion.ranges else "")
    opposite = ""
    if motion.opposite:
        opposite = f"; the same with the opposite sign of {_several(list(motion.opposite))}"
    return f"moves the same: no, {motion.reason}{opposite}"


def summary_text(changes: Changes) -> str:
    """Return how much changed, on a line: `links: 1 added, 2 changed; joints: 3 changed`."""
    parts = []
    for of, heading in HEADINGS.items():
        counts = [
            f"{len(names)} {kind}"
            for kind in (ADDED, REMOVED, RENAMED, CHANGED)
            if (names := {c.name for c in changes.changes if c.of == of and c.kind == kind})
        ]
        if counts:
            parts.append(f"{heading}: {', '.join(counts)}")
    return "; ".join([*parts, motion_text(changes)]) + "\n" if parts else ""


def _joined(rows: list[Line]) -> list[Line]:
    """Return the rows in which equal values of one thing are joined: those of both its shapes."""
    known: dict[tuple[object, ...], Line] = {}
    kept = []
    for row in rows:
        if row.change.kind == CHANGED and row.change.what:
            key = (tuple(row.names), values_text(row.change))
            if key in known:
                first = known[key]
                values = first.text.removesuffix(key[1]).strip()
                first.text = f"{values}, {row.change.what} {key[1]}"
                continue
            known[key] = row
        kept.append(row)
    return kept


def _moved_text(moved: list[Moved]) -> str:
    """Return which links some changes move, and how far the furthest one."""
    worst = max(moved, key=lambda each: (each.distance, each.angle))
    parts = []
    if worst.distance > LEAST_MOVED:
        parts.append(f"by {length_text(worst.distance)}")
    if worst.angle > LEAST_MOVED:
        parts.append(f"turned {angle_text(worst.angle)}")
    how = " and ".join(parts) + ("" if worst.is_at_zero else " when the joints move")
    links = list(dict.fromkeys([worst.link, *(name for each in moved for name in each.links)]))
    if len(links) == 1:
        return f"moves {printable(worst.link)} {how}"
    return f"moves {len(links)} links, the furthest {how}: {_several(list(map(printable, links)))}"


def _several(names: list[str]) -> str:
    """Return names in a row, the first ones of many."""
    if len(names) <= MOST_NAMES:
        return ", ".join(names)
    shown = names[: MOST_NAMES - 1]
    return f"{', '.join(shown)} and {len(names) - len(shown)} more"


def _painted(text: str, style: str, color: bool) -> str:
    return painted(text, style) if color else text
