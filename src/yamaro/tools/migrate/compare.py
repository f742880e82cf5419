"""Compares robots: the same elements, values and texts, in the order that means something."""

from __future__ import annotations

from ...xmltree import Element, Text, format_value

UNORDERED = frozenset(("robot", "link", "joint", "visual", "collision", "inertial"))
"""Elements in which URDF reads each name for itself: only what has one name keeps its order."""
TOLERANCE = 1e-9
"""How far numbers may differ, as a part of them."""
NEGLIGIBLE = 1e-12
"""Differences of numbers that are rounding, such as -0 and 1e-17, whatever the numbers."""


class Difference:
    """Something that two robots do not share.

    Attributes:
        path: the elements that lead to it, such as `link 'base', visual, origin`.
        message: what differs.
    """

    __slots__ = ("message", "path")

    def __init__(self, path: tuple[str, ...], message: str) -> None:
        """Hold where and what."""
        self.path = path
        self.message = message

    def __str__(self) -> str:
        return f"{', '.join(self.path)}: {self.message}"


def compare(expected: Element, actual: Element) -> list[Difference]:
    """Return in what a robot differs from the one expected; comments and white space aside."""
    differences: list[Difference] = []
    _compare(expected, actual, (), differences)
    return differences


def is_same(expected: Element, actual: Element) -> bool:
    """Tell whether two elements are the same."""
    return not compare(expected, actual)


def _compare(
    expected: Element, actual: Element, path: tuple[str, ...], out: list[Difference]
) -> None:
    path = (*path, label(expected))
    if expected.name != actual.name:
        out.append(Difference(path, f"<{actual.name}> stands in its place"))
        return
    _compare_attributes(expected, actual, path, out)
    if not same_words(_text(expected), _text(actual)):
        out.append(Difference(path, f"its text is {_text(actual)!r}, not {_text(expected)!r}"))
    first, second = expected.elements(), actual.elements()
    if expected.name not in UNORDERED:
        _compare_rows(first, second, path, out)
        return
    names = dict.fromkeys(element.name for element in (*first, *second))
    for name in names:
        of_first = [element for element in first if element.name == name]
        _compare_rows(of_first, [e for e in second if e.name == name], path, out)


def _compare_rows(
    first: list[Element], second: list[Element], path: tuple[str, ...], out: list[Difference]
) -> None:
    for one, other in zip(first, second, strict=False):
        _compare(one, other, path, out)
    missing, new = first[len(second) :], second[len(first) :]
    out += [Difference((*path, label(element)), "is missing") for element in missing]
    out += [Difference((*path, label(element)), "should not be there") for element in new]


def _compare_attributes(
    expected: Element, actual: Element, path: tuple[str, ...], out: list[Difference]
) -> None:
    first, second = values_of(expected), values_of(actual)
    for name, value in first.items():
        if name not in second:
            out.append(Difference(path, f"'{name}' is missing"))
        elif not same_words(value, second[name]):
            out.append(Difference(path, f"'{name}' is {second[name]!r}, not {value!r}"))
    new = [name for name in second if name not in first]
    out += [Difference(path, f"'{name}' should not be there") for name in new]


def values_of(element: Element) -> dict[str, str]:
    """Return the attributes as they are written."""
    return {
        name: format_value(value) for name, value in element.attributes.items() if value is not None
    }


def same_words(first: str, second: str) -> bool:
    """Tell whether two texts have the same words, numbers compared as such."""
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
