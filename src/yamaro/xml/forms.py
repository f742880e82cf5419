"""Elements of fixed shape: a form with holes, in place of values that are not known yet."""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame
from .tree import Element, PartElement, Text, unshared, with_trace
from .values import format_number, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..source import Span
    from .tree import Node

FormText = str | int | tuple[str | int, ...]
"""A text as it is written, the number of the hole whose value it is, or pieces to be joined."""

Piece = tuple["Node | None", "Form | None", int, int, FormText, "Any"]
"""A piece of a form's content: a node as it is; an inner form, with where its holes begin and end
among those of the whole; or a text with its span."""


class Form:
    """The shape of one element or part.

    Attributes:
        name: the element's name, or "part".
        span: the place of its key.
        verbatim: whether it is written in angle brackets.
        body: identity of the mapping that its key is in.
        attributes: the name and the text of each attribute.
        value_spans: where the attributes' values are written.
        content: what it holds.
        text: the text that is all there is in it, with its span; None if there is more, or else.
    """

    __slots__ = (
        "attributes",
        "body",
        "content",
        "name",
        "span",
        "text",
        "value_spans",
        "verbatim",
    )

    def __init__(self, name: str, span: Span, *, body: object, verbatim: bool = False) -> None:
        """Begin with nothing in it; see the class."""
        self.name = name
        self.span = span
        self.verbatim = verbatim
        self.body = body
        self.attributes: list[tuple[str, FormText]] = []
        self.value_spans: dict[str, Span] = {}
        self.content: list[Piece] = []
        self.text: tuple[FormText, Span] | None = None


def filled(text: FormText, values: tuple[Any, ...]) -> Any:
    """Return the value of a text: of its one expression, or its pieces joined."""
    kind = type(text)
    if kind is str:
        return text
    if kind is int:
        return values[text]  # type: ignore[index]
    words = []
    for piece in text:  # type: ignore[union-attr]
        if type(piece) is str:
            words.append(piece)
            continue
        value = values[piece]  # type: ignore[index]
        kind = type(value)
        if kind is str:
            words.append(value)
        elif kind is float:
            words.append(format_number(value))
        else:
            words.append("None" if value is None else format_value(value))
    return "".join(words)


_PLAIN = frozenset((str, int, float, bool, type(None)))
"""Types of values that are equal for good once they are equal."""


def key_of(values: tuple[Any, ...]) -> object:
    """Return a key that distinguishes values by all that is visible of them, or None.

    In Python 1, 1.0 and True are equal, and so are 0.0 and -0.0.
    """
    if len(values) == 1:
        value = values[0]
        kind = type(value)
        if kind is str:
            return value
        if kind not in _PLAIN:
            return None
        return (value, kind) if value else (kind, str(value))
    kinds = tuple(map(type, values))
    if not _PLAIN.issuperset(kinds):
        return None
    if 0.0 in values:
        zeros = [str(value) for value in values if type(value) is float and not value]
        if zeros:
            return values, kinds, tuple(zeros)
    return values, kinds


# --- elements of forms, built once for values that come again ---------------------------------


MAX_KNOWN = 64
"""How many elements of one form are kept, and after how many new ones in a row none is any more."""


class BuiltLately:
    """The elements of one form that were built lately, by the values in them."""

    __slots__ = ("elements", "new_in_a_row")

    def __init__(self) -> None:
        """Start with no element."""
        self.elements: dict[object, Element] | None = {}  # None once it is given up
        self.new_in_a_row = 0


class Builder:
    """Builds the elements of one conversion; those that are in several places have a memo.

    It keeps what it has built, inner elements included, and gives out the very same element when
    the same values come again, so that a loop that makes a thousand equal links makes one.
    """

    __slots__ = ("_emitted", "_in_parts", "_outside", "_traced")

    def __init__(self) -> None:
        """Start with nothing built."""
        self._emitted: dict[int, Element | None] = {}
        self._traced: dict[tuple[int, Frame | None, Frame | None], Element] = {}
        self._in_parts: dict[Form, BuiltLately] = {}
        self._outside: dict[Form, BuiltLately] = {}

    def emitted(self, element: Element) -> Element:
        """Return an element that the parser made, or a copy for all places after the first.

        The element itself is that of other conversions as well, and can have no memo.
        """
        identity = id(element)
        if identity not in self._emitted:
            self._emitted[identity] = None
            return element
        copy = self._emitted[identity]
        if copy is None:
            copy = self._emitted[identity] = element.with_children(element.children)
            copy.share()
        return copy

    def element(
        self,
        form: Form,
        values: tuple[Any, ...],
        in_part: bool,
        trace: Frame | None = INHERITED,
        inner: Frame | None = INHERITED,
    ) -> Element:
        """Return an element of a form with these values, one for each of its holes.

        It may be in other places as well, which are reached the same way if it has a trace. `inner`
        is the trace of all that is in it.
        """
        table = self._in_parts if in_part else self._outside
        built = table.get(form)
        if built is None:
            built = table[form] = BuiltLately()
        elements = built.elements
        key = None if elements is None else key_of(values)
        if elements is None or key is None:
            return self._make(form, values, trace, inner, in_part)
        if trace is not INHERITED:
            key = (trace, inner, key)
        found = elements.get(key)
        if found is not None:
            built.new_in_a_row = 0
            return found.share()
        built.new_in_a_row += 1
        if built.new_in_a_row > MAX_KNOWN:
            built.elements = None
        elif len(elements) >= MAX_KNOWN:
            elements.clear()
        found = elements[key] = self._make(form, values, trace, inner, in_part)
        return found

    def traced(
        self, element: Element, trace: Frame | None, inner: Frame | None = INHERITED
    ) -> Element:
        """Return an element that the parser made with a trace, the same for the same trace.

        `inner` is the trace of all that is in it.
        """
        key = (id(element), trace, inner)
        found = self._traced.get(key)
        if found is not None:
            return found.share()
        if inner is not INHERITED:
            found = unshared(element, trace)
        else:
            found = with_trace(element, trace)
            found.children = self.inner(element)
        self._traced[key] = found
        return found

    def inner(self, element: Element) -> list[Node]:
        """Return what is in an element that the parser made, for another one with that in it."""
        return [
            self.emitted(child) if isinstance(child, Element) else child
            for child in element.children
        ]

    def _make(
        self,
        form: Form,
        values: tuple[Any, ...],
        trace: Frame | None,
        inner: Frame | None,
        in_part: bool,
    ) -> Element:
        if form.text is not None:
            text, span = form.text
            value = filled(text, values)
            children: list[Node] = [] if value is None and not in_part else [Text(value, span)]
            return Element(
                form.name, form.span, {}, children, trace, None, form.verbatim, form.body
            )
        attributes: dict[str, object] = {}
        for name, text in form.attributes:
            value = filled(text, values)
            if value is not None:
                attributes[name] = value
        return Element(
            form.name,
            form.span,
            attributes,
            self._children(form, values, inner, in_part),
            trace,
            form.value_spans,
            form.verbatim,
            form.body,
        )

    def _children(
        self, form: Form, values: tuple[Any, ...], trace: Frame | None, in_part: bool
    ) -> list[Node]:
        children: list[Node] = []
        for node, inner, first, end, text, span in form.content:
            if inner is not None:
                children.append(self.element(inner, values[first:end], in_part, trace, trace))
            elif isinstance(node, Element):
                children.append(
                    self.emitted(node) if trace is INHERITED else self.traced(node, trace, trace)
                )
            elif node is not None:
                children.append(node)
            else:
                value = filled(text, values)
                if value is not None or in_part:  # in a part, None leaves the key out
                    children.append(Text(value, span))
        return children

    def part(self, form: Form, values: tuple[Any, ...], trace: Frame | None) -> PartElement:
        """Return a part of a form with these values."""
        return PartElement.of_form(form, values, trace, self._fill_part)

    def _fill_part(self, form: Form, values: tuple[Any, ...]) -> list[Node]:
        return self._children(form, values, INHERITED, True)
