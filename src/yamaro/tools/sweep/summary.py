"""What a sweep came to, in words: how many variants are there, and why others failed."""

from __future__ import annotations

from ...source import Public
from .rows import FAILED, OK, REJECTED
from .table import parts_of, results_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

MOST_GROUPS = 10
"""Groups of failures that are shown."""


class Group(Public):
    """Variants that failed with the same code at the same place.

    Attributes:
        code: the code.
        place: the place, or "".
        count: how many there are.
        first: the number of the first one.
        message: what was said of that.
    """

    __slots__ = ("code", "count", "first", "message", "place")

    def __init__(self, code: str, place: str, first: int, message: str) -> None:
        self.code = code
        self.place = place
        self.count = 0
        self.first = first
        self.message = message


class Summary(Public):
    """What a sweep came to.

    Attributes:
        counts: how many variants have which status.
        groups: those that failed, the largest group first.
        lacking: how many variants that are ok have no value in a column of results, by its name;
            of those that have all values nothing.
    """

    __slots__ = ("counts", "groups", "lacking")

    def __init__(self, folder: str) -> None:
        """Read the table in the folder of a sweep."""
        self.counts = {OK: 0, REJECTED: 0, FAILED: 0}
        groups: dict[tuple[str, str], Group] = {}
        values: dict[str, int] = {}
        for part in parts_of(folder):
            _count_values(part, values)
            for status in self.counts:
                self.counts[status] += part["status"].count(status)
            for index, status in enumerate(part["status"]):
                if status != FAILED:
                    continue
                code, place = part["code"][index], part["place"][index]
                group = groups.get((code, place))
                if group is None:
                    message = part["message"][index]
                    group = Group(code, place, part["id"][index], message)
                    groups[code, place] = group
                group.count += 1
        self.lacking = {
            name: self.counts[OK] - count
            for name, count in values.items()
            if count < self.counts[OK]
        }
        self.groups = sorted(groups.values(), key=lambda group: (-group.count, group.first))

    def lines(self) -> list[str]:
        """Return it as lines of text."""
        total = sum(self.counts.values())
        counts = [f"{self.counts[OK]:,} ok"]
        counts += [
            f"{self.counts[name]:,} {name}" for name in (REJECTED, FAILED) if self.counts[name]
        ]
        found = [f"{_variants(total)}: {', '.join(counts)}"]
        for group in self.groups[:MOST_GROUPS]:
            where = f" at {group.place}" if group.place else ""
            found.append(f"  {group.count:,} × {group.code}{where}")
            found.append(f"      such as {group.first}: {group.message}")
        if len(self.groups) > MOST_GROUPS:
            rest = sum(group.count for group in self.groups[MOST_GROUPS:])
            found.append(f"  {rest:,} × others, see the columns code and place of the table")
        for name, count in list(self.lacking.items())[:MOST_GROUPS]:
            found.append(f"  {count:,} ok without a value of '{name}'")
        return found


def _count_values(part: Mapping[str, list[Any]], values: dict[str, int]) -> None:
    """Add how many variants of a part that are ok have a value, to counts by result."""
    at = [index for index, status in enumerate(part["status"]) if status == OK]
    for name in results_in(list(part)):
        column = part[name]
        values[name] = values.get(name, 0) + sum(column[index] is not None for index in at)


def _variants(count: int) -> str:
    return f"{count:,} variant{'' if count == 1 else 's'}"
