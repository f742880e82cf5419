"""Builds elements of fixed shape, once for values that come again.

It keeps what it has built, inner elements included, and gives out the very same element when the
same values come again, so that a loop that makes a thousand equal links makes one.
"""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame
from ..namespace import MISSING
from ..xml.forms import Form, filled, key_of
from ..xml.tree import Element, Memo, PartElement, Text, unshared, with_trace
from ..xml.values import format_value
from .scope import Scope
from .values import ALWAYS_WRITABLE, SHORT, Values

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..syntax.forms import EvaluatedForm
    from ..xml.tree import Node

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
    """Builds the elements of one conversion; those that are in several places have a memo."""

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
            copy.memo = Memo()
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
        built = self._built(form, in_part)
        elements = built.elements
        key = None if elements is None else key_of(values)
        if elements is None or key is None:
            return self._make(form, values, trace, inner, in_part)
        if trace is not INHERITED:
            key = (trace, inner, key)
        found = elements.get(key)
        if found is not None:
            built.new_in_a_row = 0
            found.memo = found.memo or Memo()
            return found
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
            found.memo = found.memo or Memo()
            return found
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

    def _built(self, form: Form, in_part: bool) -> BuiltLately:
        table = self._in_parts if in_part else self._outside
        built = table.get(form)
        if built is None:
            built = table[form] = BuiltLately()
        return built

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


def evaluate_holes(form: EvaluatedForm, scope: Scope, values: Values) -> tuple[Any, ...]:
    """Return the value of each of a form's holes, sure that it can be written.

    Raises:
        YamaroError: an expression failed, or what it gives cannot be made a text.
    """
    evaluator = values.evaluator
    evaluate, get = evaluator.evaluate, scope.get
    longest = evaluator.limits.text
    letters = form.letters
    results: list[Any] = []
    for python, is_piece in form.holes:
        name = python.name
        value = MISSING if name is None else get(name, MISSING)
        if value is MISSING:
            value = evaluate(python, scope)
        kind = type(value)
        if kind not in ALWAYS_WRITABLE and (kind is not int or not -SHORT < value < SHORT):
            text = evaluator.text(format_value, value, python.span())
            if is_piece:
                value = text
                letters += len(text)
        elif kind is str:
            letters += len(value)
            if len(value) > longest:
                raise evaluator.too_long(value, python.span())
        results.append(value)
    given = tuple(results)
    if letters > longest:
        for pieces, span in form.joined:
            joined = filled(pieces, given)
            if len(joined) > longest:
                raise evaluator.too_long(joined, span)
    return given
