"""Summary of a finished document in a line: contents of a robot, or size of other XML."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite

INERTIAL = ["robot", "link", "inertial"]


def summary_of(document: Iterable[bytes]) -> str:
    """Return links, joints and mass of a robot, or elements and bytes of another document."""
    from pyexpat import ParserCreate

    counter = _Counter()
    parser = ParserCreate("utf-8")
    parser.StartElementHandler = counter.start
    parser.EndElementHandler = counter.end
    size = 0
    for chunk in document:
        size += len(chunk)
        parser.Parse(chunk, False)
    if counter.root != "robot":
        amount, units = float(size), ["bytes", "kB", "MB", "GB"]
        while amount >= 1000 and len(units) > 1:
            amount /= 1000
            del units[0]
        shown = f"{amount:.3g} {units[0]}" if size >= 1000 else counted(size, "byte")
        return f"{counted(counter.elements, 'element')}, {shown}"
    parts = [counted(counter.links, "link"), counted(counter.joints, "joint")]
    if counter.mass and isfinite(counter.mass):
        parts.append(mass_text(counter.mass))
    return ", ".join(parts)


class _Counter:
    """Counts what expat reads.

    Attributes:
        root: the name of the root element.
        elements: how many there are.
        links, joints: how many of them are in the root.
        mass: of all links, in kg.
    """

    def __init__(self) -> None:
        self.root = ""
        self.elements = 0
        self.links = 0
        self.joints = 0
        self.mass = 0.0
        self._around: list[str] = []

    def start(self, name: str, attributes: dict[str, str]) -> None:
        around = self._around
        self.elements += 1
        if not around:
            self.root = name
        elif len(around) == 1:
            self.links += name == "link"
            self.joints += name == "joint"
        elif name == "mass" and around == INERTIAL:
            try:
                self.mass += float(attributes.get("value", ""))
            except ValueError:
                pass
        around.append(name)

    def end(self, name: str) -> None:
        self._around.pop()


def mass_text(mass: float) -> str:
    """Return a mass in kg with up to four digits."""
    return f"{mass:.0f} kg" if abs(mass) >= 1000 else f"{mass:.4g} kg"


def counted(count: int, noun: str) -> str:
    """Return a number of things, as in "1 link" and "2 links"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
