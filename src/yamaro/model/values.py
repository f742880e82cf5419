"""Values of elements: attributes and contents as text and numbers; children by name."""

from __future__ import annotations

from math import inf, isfinite, nan

from ..source import Public
from ..xml.tree import Element, Text
from ..xml.values import LONGEST_ROW_REMEMBERED, Numbers, format_value, remember

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Container, Mapping, Sequence
    from typing import Any, NoReturn

    from ..diagnostics import Frame as Step
    from ..source import Span
    from .joint import Joint
    from .link import Link


class ByName(dict[str, "Any"]):
    """What a robot has of a kind, by name: the KeyError of another name suggests one.

    Attributes:
        kind: what it has, such as `joint`.
        patterns: what those of parts are called, such as `*_joint`.
    """

    __slots__ = ("kind", "patterns")

    def __init__(
        self, kind: str, things: Mapping[str, Any] | None = None, patterns: Sequence[str] = ()
    ) -> None:
        super().__init__(things or {})
        self.kind = kind
        self.patterns = patterns

    def __missing__(self, name: object) -> NoReturn:
        from .positions import meant_name

        near = meant_name(name, self, self.patterns) if isinstance(name, str) else None
        hint = "" if near is None else f"; did you mean '{near}'?"
        raise KeyError(f"the robot has no {self.kind} {name!r}{hint}")


WORD, NOT_FINITE, SPACING, TOO_LARGE = "word", "not finite", "spacing", "too large"


class NumberFault:
    """Why a text is not a row of numbers: the item at fault, and what is wrong with it."""

    __slots__ = ("item", "kind")

    def __init__(self, item: str, kind: str) -> None:
        """Name the item as spelled; `kind` is WORD, NOT_FINITE, SPACING or TOO_LARGE."""
        self.item = item
        self.kind = kind


def read_numbers(text: str) -> tuple[float, ...] | NumberFault:
    """Return the numbers of a text, spelled as C++ and Python both read them, or the fault.

    Spacing is judged as urdfdom does: it splits at spaces alone, and a lone number must be the end
    of its text.
    """
    try:
        numbers = tuple(map(float, text.split()))
    except ValueError:
        numbers = (nan,)
    if not text.isascii() or "_" in text or not all(map(isfinite, numbers)):
        for item in text.split():
            kind = _fault_of(item)
            if kind is not None:
                return NumberFault(item, kind)
    if (numbers and not text.isprintable()) or (len(numbers) == 1 and text[-1] == " "):
        return NumberFault(text, SPACING)
    return numbers


def _fault_of(item: str) -> str | None:
    """Return what is wrong with a number, if anything is."""
    if "_" in item or not item.isascii():
        return WORD
    try:
        return None if isfinite(float(item)) else NOT_FINITE
    except ValueError:
        return WORD


def attribute_text(element: Element | None, attribute: str) -> str | None:
    """Return an attribute as it will be written, or None if it will not be."""
    if element is None:
        return None
    value = element.attributes.get(attribute)
    if value is None or type(value) is str:
        return value
    return value.text if type(value) is Numbers else format_value(value)


def values_of(element: Element) -> dict[str, str]:
    """Return the attributes as they are written."""
    return {
        name: format_value(value) for name, value in element.attributes.items() if value is not None
    }


def numbers_of(element: Element | None, attribute: str) -> tuple[float, ...]:
    """Return the numbers of an attribute; none if it is left out or is not a row of numbers.

    Those that were computed are known, with no need to read what they are written as.
    """
    value = element.attributes.get(attribute) if element is not None else None
    if type(value) is Numbers:
        return value.written
    found = read_numbers(format_value(value)) if value is not None else ()
    return found if isinstance(found, tuple) else ()


def number_in(element: Element | None, attribute: str) -> float | None:
    """Return the number in an attribute, or None if it is left out or is not one number."""
    found = numbers_of(element, attribute)
    return found[0] if len(found) == 1 else None


class NumberReader:
    """Reads the numbers in attributes, equal texts once, unless they are long.

    Long texts contain computed numbers, which are seldom equal.
    """

    __slots__ = ("_known", "_largest")

    def __init__(self, largest: float = inf) -> None:
        """Begin with nothing read; numbers beyond `largest` are faults."""
        self._known: dict[str, tuple[float, ...] | NumberFault] = {}
        self._largest = largest

    def read(self, text: str) -> tuple[float, ...] | NumberFault:
        """Return the numbers in a text, or what is wrong with it; see `read_numbers`."""
        found = self._known.get(text)
        if found is None:
            found = read_numbers(text)
            if self._largest < inf and isinstance(found, tuple):
                if any(abs(number) > self._largest for number in found):
                    found = NumberFault(text, TOO_LARGE)
            if len(text) <= LONGEST_ROW_REMEMBERED:
                remember(self._known, text, found)
        return found

    def of(self, value: object) -> tuple[float, ...] | NumberFault:
        """Return the numbers that an attribute's value is or says, or what is wrong with it."""
        if type(value) is Numbers and self._largest == inf:
            return value.written
        return self.read(value if type(value) is str else format_value(value))

    def is_row(self, value: object, count: int) -> bool:
        """Return whether a value is a row of computed numbers, which need no reading."""
        return type(value) is Numbers and self._largest == inf and len(value.words) == count

    def row(self, element: Element | None, attribute: str, count: int) -> tuple[float, ...]:
        """Return an attribute's numbers, or () if they are left out, faulty or not `count`."""
        value = element.attributes.get(attribute) if element is not None else None
        found = self.of(value) if value is not None else ()
        return found if isinstance(found, tuple) and len(found) == count else ()

    def number(self, element: Element | None, attribute: str) -> float | None:
        """Return the number in an attribute, or None if it is left out or is not one number."""
        found = self.row(element, attribute, 1)
        return found[0] if found else None


def child_named(element: Element, name: str) -> Element | None:
    """Return the first child element of that name; parsers of URDF read no other."""
    for child in element.children:
        if isinstance(child, Element) and child.name == name:
            return child
    return None


class Written(Public):
    """Something of a robot that is written in a file.

    Attributes:
        element: the element it was read from.
    """

    __slots__ = ("element",)
    _internal = frozenset(("element", "inner", "number", "read_rest", "trace_in", "written"))

    element: Element

    @property
    def span(self) -> Span:
        """Return where it is written: the key or tag that made it."""
        return self.element.span

    def span_of(self, attribute: str) -> Span:
        """Return where the value of an attribute is written, or else the whole."""
        return self.element.value_span(attribute)

    def written(self, attribute: str) -> str | None:
        """Return an attribute as it is written in URDF, or None if it is not."""
        return attribute_text(self.element, attribute)

    def number(self, attribute: str) -> float | None:
        """Return the number in an attribute, or None if it is left out or is not one number."""
        return number_in(self.element, attribute)

    def inner(self, name: str) -> Element | None:
        """Return the first element of a name inside; parsers of URDF read no other."""
        return child_named(self.element, name)

    def trace_in(self, owner: Link | Joint) -> Step | None:
        """Return the calls and includes that led to it, as part of a link or joint."""
        return self.element.trace_within(owner.trace)


class ReadLater(Written):
    """Something whose values are read, all at once, when one of them is first used.

    The slots of a subclass that are empty have not been read.

    Attributes:
        read_rest: reads the values, and fills the slots.
    """

    __slots__ = ("read_rest",)

    read_rest: Callable[[Any], None]

    if not TYPE_CHECKING:  # a type checker would accept any name

        def __getattr__(self, name: str) -> object:
            """Return a value that has not been read before."""
            if name in type(self).__slots__:
                self.read_rest(self)
            return object.__getattribute__(self, name)


# --- what elements say ------------------------------------------------------------------------


def content(element: Element | None) -> str | None:
    """Return what an element says: its attribute `value`, or else its text; None without either.

    Source: SDFormat, parser_urdf.cc, GetKeyValueAsString.
    """
    if element is None:
        return None
    value = attribute_text(element, "value")
    return (element.text() if value is None else value).strip() or None


def content_span(element: Element) -> Span:
    """Return where what an element says is written, or else the element."""
    if "value" in element.attributes:
        return element.value_span("value")
    texts = (c.span for c in element.children if isinstance(c, Text) and format_value(c.value))
    return next(texts, element.span)


def content_at(element: Element | None, *names: str) -> str | None:
    """Return what the element at a path of names says, or None."""
    return content(inside(element, *names))


def inside(element: Element | None, *names: str) -> Element | None:
    """Return the first element at a path of names, or None."""
    for name in names:
        if element is None:
            return None
        element = child_named(element, name)
    return element


def first_of(element: Element, names: tuple[str, ...]) -> Element | None:
    """Return the child of the first name that has a content."""
    for name in names:
        child = child_named(element, name)
        if content(child) is not None:
            return child
    return None


def numbers_in(text: str | None) -> tuple[float, ...]:
    """Return the numbers of a text; none if it is not a row of numbers."""
    found = read_numbers(" ".join(text.split())) if text is not None else ()
    return found if isinstance(found, tuple) else ()


def number_at(element: Element | None, names: tuple[str, ...], default: float) -> float:
    """Return the number at a path of names, or the default."""
    row = numbers_in(content_at(element, *names))
    return row[0] if len(row) == 1 else default


def shape_name(link: str, kind: str, index: int, taken: Container[str]) -> str:
    """Return what a shape without a name is called where a block is about it.

    Args:
        link: the name of the link.
        kind: `visual` or `collision`.
        index: its place among those of its kind in the link.
        taken: the names of the link's other shapes.
    """
    name = f"{link}_{kind}" if index == 0 else f"{link}_{kind}_{index + 1}"
    while name in taken:
        name += "_"
    return name
