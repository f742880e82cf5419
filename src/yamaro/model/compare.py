"""Compares robots: the same elements, values and texts, in the order that means something."""

from __future__ import annotations

from ..source import Public
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .values import values_of

UNORDERED = frozenset(("robot", "link", "joint", "visual", "collision", "inertial", "material"))
"""Elements in which URDF reads each name for itself: only what has one name keeps its order."""
TOLERANCE = 1e-9
"""How far numbers may differ, as a part of them."""
NEGLIGIBLE = 1e-12
"""Differences of numbers that are rounding, such as -0 and 1e-17, whatever the numbers."""
POSE = ("xyz", "rpy")
ZEROS = "0 0 0"


class Difference(Public):
    """Something that two robots do not share.

    Attributes:
        path: the elements that lead to it, such as `link 'base', visual, origin`.
        message: what differs.
    """

    __slots__ = ("message", "path")

    def __init__(self, path: tuple[str, ...], message: str) -> None:
        self.path = path
        self.message = message

    def __str__(self) -> str:
        return f"{', '.join(self.path)}: {self.message}"

    def __repr__(self) -> str:
        return f"<Difference {self}>"


def compare(
    expected: Element, actual: Element, *, exact: bool = False, around: tuple[str, ...] = ()
) -> list[Difference]:
    """Return the differences between two robots, except for comments and white space.

    Args:
        expected: the robot, or an element of it.
        actual: what is compared with it.
        exact: whether a missing `<origin>`, or a missing `xyz` or `rpy` in one, differs from zeros,
            and a declared prefix of XML that no name has is a difference, and a material of the
            robot that repeats an earlier one.
        around: the names of the elements that an element of a robot is in.
    """
    return _compared(expected, actual, exact=exact, around=around).differences


def count_defaults(expected: Element, actual: Element) -> int:
    """Return how many origins, and values of origins, only the second robot writes out."""
    return _compared(expected, actual, exact=False).defaults


def _compared(
    expected: Element, actual: Element, *, exact: bool, around: tuple[str, ...] = ()
) -> _Comparison:
    prefixes = None if exact else prefixes_in(expected) | prefixes_in(actual)
    comparison = _Comparison(exact, prefixes, around)
    comparison.compare(expected, actual, ())
    return comparison


class _Comparison:
    """Compares two trees, and collects what differs."""

    def __init__(self, exact: bool, prefixes: set[str] | None, around: tuple[str, ...]) -> None:
        self._exact = exact
        self._prefixes = prefixes
        self._around = list(around)
        self.differences: list[Difference] = []
        self.defaults = 0

    def compare(self, expected: Element, actual: Element, path: tuple[str, ...]) -> None:
        """Note the differences between two elements and what is in them."""
        path = (*path, label(expected))
        if expected.name != actual.name:
            self._note(path, f"<{actual.name}> is in its place")
            return
        first, second = values_of(expected), values_of(actual)
        children, others = expected.elements(), actual.elements()
        if not self._exact and expected.name == "origin" and self._is_posed():
            zeros = dict.fromkeys(POSE, ZEROS)
            self.defaults += sum(name in second and name not in first for name in POSE)
            first, second = zeros | first, zeros | second
        self._around.append(expected.name)
        for name, value in first.items():
            if name not in second:
                if is_used(name, self._prefixes):
                    self._note(path, f"'{name}' is missing")
            elif not same_words(value, second[name]):
                self._note(path, f"'{name}' is {second[name]!r}, not {value!r}")
        for name in second:
            if name not in first and is_used(name, self._prefixes):
                self._note(path, f"'{name}' should not be there")
        if not same_words(_text(expected), _text(actual)):
            self._note(path, f"its text is {_text(actual)!r}, not {_text(expected)!r}")
        if not self._exact and self._is_posed():
            children, others = self._with_origins(expected, children, others)
        if not self._exact and self._around == ["robot"]:
            children, others = without_repeated(children), without_repeated(others)
        self._compare_children(expected.name, children, others, path)
        self._around.pop()

    def _is_posed(self) -> bool:
        """Return whether the innermost open element has a pose, which is zero by default."""
        match self._around:
            case ["robot", "joint"] | ["robot", "link", "visual" | "collision" | "inertial"]:
                return True
        return False

    def _with_origins(
        self, owner: Element, first: list[Element], second: list[Element]
    ) -> tuple[list[Element], list[Element]]:
        """Return the children of two elements, each with an origin."""
        has_first, has_second = (any(e.name == "origin" for e in row) for row in (first, second))
        if has_first == has_second:
            return first, second
        default = Element("origin", owner.span, dict.fromkeys(POSE, ZEROS))
        if has_second:
            self.defaults += 1
            return [default, *first], second
        return first, [default, *second]

    def _compare_children(
        self, name: str, first: list[Element], second: list[Element], path: tuple[str, ...]
    ) -> None:
        if name not in UNORDERED:
            self._compare_rows(first, second, path)
            return
        for own in dict.fromkeys(element.name for element in (*first, *second)):
            of_first = [element for element in first if element.name == own]
            self._compare_rows(of_first, [e for e in second if e.name == own], path)

    def _compare_rows(
        self, first: list[Element], second: list[Element], path: tuple[str, ...]
    ) -> None:
        for one, other in zip(first, second, strict=False):
            self.compare(one, other, path)
        for element in first[len(second) :]:
            self._note((*path, label(element)), "is missing")
        for element in second[len(first) :]:
            self._note((*path, label(element)), "should not be there")

    def _note(self, path: tuple[str, ...], message: str) -> None:
        self.differences.append(Difference(path, message))


def without_repeated(children: list[Element]) -> list[Element]:
    """Return the children of a robot without materials that repeat an earlier one of their name."""
    first: dict[str, Element] = {}
    kept = []
    for child in children:
        if child.name == "material":
            earlier = first.setdefault(values_of(child).get("name", ""), child)
            if earlier is not child and not compare(earlier, child):
                continue
        kept.append(child)
    return kept


def prefixes_in(root: Element) -> set[str]:
    """Return the prefixes of XML that names in a document have."""
    prefixes: set[str] = set()
    for element in root.iter():
        names = [name for name in element.attributes if not name.startswith("xmlns:")]
        prefixes.update(name.partition(":")[0] for name in (element.name, *names) if ":" in name)
    return prefixes


def is_used(attribute: str, prefixes: set[str] | None) -> bool:
    """Return whether an attribute does more than declare a prefix of XML that no name has.

    If it is not known which prefixes names have, it does.
    """
    if prefixes is None or not attribute.startswith("xmlns:"):
        return True
    return attribute.removeprefix("xmlns:") in prefixes


def same_words(first: str, second: str) -> bool:
    """Return whether two texts have the same words, numbers compared as such."""
    if first == second:
        return True
    words, others = first.split(), second.split()
    return len(words) == len(others) and all(map(_same_word, words, others))


def _same_word(first: str, second: str) -> bool:
    if first == second:
        return True
    try:
        one, other = float(first), float(second)
    except ValueError:
        return False
    return one == other or abs(one - other) <= max(TOLERANCE * abs(one), NEGLIGIBLE)


def label(element: Element) -> str:
    """Return how a person would call an element: its tag and its name."""
    name = element.attributes.get("name", element.attributes.get("reference"))
    return element.name if name is None else f"{element.name} '{format_value(name)}'"


def _text(element: Element) -> str:
    pieces = []
    for child in element.children:
        if isinstance(child, Text):
            pieces.append(format_value(child.value))
        elif isinstance(child, Element):
            pieces.append(" ")
    return "".join(pieces)
