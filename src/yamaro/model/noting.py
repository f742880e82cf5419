"""Notes of what URDF says in elements of other programs, such as `<gazebo>`.

A note has the form that the words of YAML give: see `extras.py`. So one reader serves both.
"""

from __future__ import annotations

from ..xml.tree import Element, Text
from ..xml.values import format_value
from .values import attribute_text, child_named, read_numbers

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame as Step
    from ..source import Span


class Note:
    """A note that is being made.

    Attributes:
        element: the note.
        places: where its values are written, by attribute.
    """

    __slots__ = ("element", "places")

    def __init__(self, kind: str, origin: Element, trace: Step | None, **given: str) -> None:
        """Begin a note.

        Args:
            kind: what it is about: `sensor`, `actuator`, `surface` or `ros2_control`.
            origin: the element that says it.
            trace: the calls and includes that led there.
            given: its first attributes.
        """
        self.places: dict[str, Span] = {}
        self.element = Element(kind, origin.span, dict(given), trace=trace, value_spans=self.places)

    def put(self, attribute: str, text: str | None, origin: Element | None) -> bool:
        """Note a text that is not empty, and where it is written; return whether it was noted."""
        if not text:
            return False
        self.element.attributes[attribute] = text
        if origin is not None:
            self.places[attribute] = content_span(origin)
        return True

    def put_number(self, attribute: str, origin: Element | None) -> bool:
        """Note the number in an element, unless it is negative; return whether it was noted."""
        text = content(origin)
        row = numbers_in(text)
        return len(row) == 1 and row[0] >= 0 and self.put(attribute, text, origin)

    def put_child(self, kind: str, origin: Element, attribute: str, value: str) -> None:
        """Add a note with one attribute."""
        self.element.children.append(
            Element(kind, origin.span, {attribute: value}, trace=self.element.trace)
        )


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
