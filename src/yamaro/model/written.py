"""What all that is read of a robot has: the element, its place, and what is written in it."""

from __future__ import annotations

from ..diagnostics import INHERITED
from .values import attribute_text, child_named, number_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Element
    from .joint import Joint
    from .link import Link


class Written:
    """Something of a robot that is written in a file.

    Attributes:
        element: the element it was read from.
    """

    __slots__ = ("element",)

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
        return owner.trace if self.element.trace is INHERITED else self.element.trace


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
