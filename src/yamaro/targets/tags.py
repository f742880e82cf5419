"""Elements of an output: each at the place of what it is made of."""

from __future__ import annotations

from ..xml.tree import Element, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Node


class Tag:
    """An element that is not made yet.

    Attributes:
        name: of the element.
        content: text, a number, or elements.
        attributes: by name; those that are None are left out.
        span: the place of what it is made of, or None for that of what is around it.
        trace: the calls and includes that led to that place.
        places: where the values of attributes are written, if not at `span`.
    """

    __slots__ = ("attributes", "content", "name", "places", "span", "trace")

    def __init__(
        self,
        name: str,
        content: str | float | Iterable[Tag | Element] = (),
        /,
        *,
        span: Span | None = None,
        trace: Step | None = None,
        **attributes: str | float | None,
    ) -> None:
        self.name = name
        self.content = content
        self.attributes = attributes
        self.span = span
        self.trace = trace
        self.places: Mapping[str, Span] | None = None

    def made(self, span: Span, trace: Step | None) -> Element:
        """Return the element.

        Args:
            span: the place of what is around it.
            trace: the calls and includes that led to that.
        """
        if self.span is not None:
            span, trace = self.span, self.trace
        attributes: dict[str, object] = {
            name: text_of(value) for name, value in self.attributes.items() if value is not None
        }
        element = Element(self.name, span, attributes, trace=trace, value_spans=self.places)
        element.children = self._children(span, trace)
        return element

    def _children(self, span: Span, trace: Step | None) -> list[Node]:
        content = self.content
        if isinstance(content, (str, float, int)):
            return [Text(text_of(content), span)]
        return [each if isinstance(each, Element) else each.made(span, trace) for each in content]


def text_of(value: str | float) -> str:
    """Return a number as it is written where it stands alone: 4 and not 4.0."""
    return value if isinstance(value, str) else format_value(value).removesuffix(".0")


def row_of(numbers: Iterable[float]) -> str:
    """Return several numbers as they are written in a row.

    The schema of SDFormat wants a point in a number with an exponent: 1.0e-05.
    """
    texts = map(text_of, numbers)
    return " ".join(
        text.replace("e", ".0e") if "e" in text and "." not in text else text for text in texts
    )


def unused(name: str, used: set[str]) -> str:
    """Return a name that is not used yet, this one or with a number, and take it."""
    found, number = name, 2
    while found in used:
        found, number = f"{name}_{number}", number + 1
    used.add(found)
    return found


def given(*pairs: tuple[str, float | str | None]) -> list[Tag]:
    """Return the elements of those that have a value."""
    return [Tag(name, value) for name, value in pairs if value is not None]
