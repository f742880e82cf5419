"""Elements of an output: each at the place of what it is made of, its numbers written one way."""

from __future__ import annotations

from ..source import Source, Span
from ..xml.tree import Element, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Protocol

    from ..diagnostics import Frame as Step
    from ..model.values import Written
    from ..xml.tree import Node, ValueSpans

    class Owner(Protocol):
        """What is written in a file, and knows the calls and includes that led there."""

        @property
        def span(self) -> Span: ...  # noqa: D102
        @property
        def trace(self) -> Step | None: ...  # noqa: D102

    Value = str | float | tuple[float, ...] | list[float] | None
    Attributes = dict[str, Value]

_AROUND = Span(Source("", name=""), 0, 0)
"""The place of an element that is given none, until it is put into one that has one."""


def element(
    name: str,
    attributes: Mapping[str, Value] | None = None,
    *,
    children: Iterable[Element] = (),
    text: str | float | None = None,
    owner: Owner | None = None,
    part: Written | None = None,
    places: ValueSpans | None = None,
) -> Element:
    """Return an element of an output.

    Args:
        name: of the element.
        attributes: by name; numbers and rows of numbers are written, those that are None left out.
        children: the elements in it.
        text: a text or number in it.
        owner: what it is made of; by default that of the element around it.
        part: the part of the owner that it is made of, if not the whole.
        places: where the values of attributes are written, if not where the element is.
    """
    given: dict[str, object] = {
        key: value
        if isinstance(value, str)
        else row(value)
        if isinstance(value, (tuple, list))
        else number(value)
        for key, value in (attributes or {}).items()
        if value is not None
    }
    span, trace = _AROUND, None
    if owner is not None:
        span, trace = written_at(owner, part)
    made = Element(name, span, given, [*children], trace=trace, value_spans=places)
    if text is not None:
        made.children.append(Text(text if isinstance(text, str) else number(text), span))
    if owner is not None:
        settle(made.children, span, trace)
    return made


def given(*pairs: tuple[str, float | str | None]) -> list[Element]:
    """Return an element with a text or number in it for each of those that have one."""
    return [element(name, text=value) for name, value in pairs if value is not None]


def settle(nodes: Iterable[Node], span: Span, trace: Step | None) -> None:
    """Give a place to elements that have none, and to those in them."""
    for node in nodes:
        if node.span is _AROUND:
            node.span = span
            if isinstance(node, Element):
                node.trace = trace
                settle(node.children, span, trace)


def written_at(owner: Owner, part: Written | None = None) -> tuple[Span, Step | None]:
    """Return where an owner is written, or a part of it, and the calls and includes to there."""
    span, trace = owner.span, owner.trace
    if isinstance(owner, Element):
        trace = owner.trace_within(None)
    if part is not None:
        span = part.span
        trace = part.element.trace_within(trace)
    return span, trace


def number(value: float) -> str:
    """Return a number as all formats write it: with 15 digits, 4 and not 4.0."""
    return format_value(value).removesuffix(".0")


def row(values: Iterable[float]) -> str:
    """Return numbers in a row."""
    return " ".join(map(number, values))


def unused(name: str, used: set[str]) -> str:
    """Return a name that is not used yet, this one or with a number, and take it."""
    found, count = name, 2
    while found in used:
        found, count = f"{name}_{count}", count + 1
    used.add(found)
    return found


class UsedNames:
    """The names that are taken, each once in its scope."""

    __slots__ = ("_taken",)

    def __init__(self) -> None:
        self._taken: dict[str, set[str]] = {}

    def reserve(self, scope: str, names: Iterable[str]) -> None:
        """Take names, so that none that is made up is one of them."""
        self._taken.setdefault(scope, set()).update(names)

    def fresh(self, scope: str, wanted: str) -> str:
        """Take a name that is still free: the one that is wanted, or that with a number."""
        return unused(wanted, self._taken.setdefault(scope, set()))
