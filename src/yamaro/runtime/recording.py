"""Runs a program so that places hold which variables were read there, for `yamaro why`.

The spans of values that hold `$(…)` are replaced with a `RecordedSpan` each time they are run. The
finished tree keeps these spans, so that each value in it can report what its expressions read.
"""

from __future__ import annotations

from ..diagnostics import YamaroError
from ..namespace import MISSING, Namespace
from ..source import Reading, RecordedSpan, Span
from ..syntax.nodes import (
    DictValue,
    DynamicNode,
    ElementNode,
    FunctionNode,
    ListContent,
    ListValue,
    PartNode,
    ProcessNode,
    TextContent,
    VariablesNode,
)
from ..syntax.python import Template
from ..xml.tree import Element, Text
from .expressions import print_text
from .markup import run_dynamic, run_element, run_part, run_static
from .python_errors import names_in
from .statements import HANDLERS, run_process, run_variables

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import Any

    from ..syntax.nodes import Body, Value
    from ..xacro.noted import Noted as XacroNoted
    from ..xml.tree import Node
    from .interpreter import Handlers, Interpreter
    from .scope import Scope

LONGEST_VALUE = 2000
"""Characters of a variable's value that are recorded."""
MOST_VALUES = 20
"""Values of one variable that are noted where it is set."""


class Noted:
    """The values that names have where they are declared, in the order of the run."""

    __slots__ = ("_interpreter", "_of_xacro", "_values")

    def __init__(self, interpreter: Interpreter) -> None:
        """Begin with nothing noted."""
        self._of_xacro: list[XacroNoted] = []
        self._interpreter = interpreter
        self._values: dict[tuple[str, str, int], list[Reading]] = {}

    def take(self, scope: Scope, names: Iterable[str], span: Span) -> None:
        """Note the values of names that were declared just now, at a place."""
        for name in names:
            noted = self._values.setdefault((name, span.source.path, span.start), [])
            if len(noted) < MOST_VALUES:
                value = scope.find(name)
                if value is MISSING or callable(value) or isinstance(value, Namespace):
                    continue
                text = _text_of(self._interpreter, value, span)
                place = scope.place_of(name)
                if place is not None and place.source is span.source and place.start == span.start:
                    place = None  # it has the value of its declaration
                noted.append(Reading(name, text, span, place))

    def take_parameters(self, scope: Scope, node: FunctionNode) -> None:
        """Note the values of the parameters of a function that was called just now."""
        for parameter in node.parameters:
            self.take(scope, [parameter.name], parameter.span)

    def of_xacro(self) -> XacroNoted:
        """Return what notes the values of names and expressions in a xacro file."""
        from ..xacro.noted import Noted as XacroNoted

        noted = XacroNoted()
        self._of_xacro.append(noted)
        return noted

    def readings(self) -> list[Reading]:
        """Return all of them: the name, the value, and where it is declared."""
        own = [each for noted in self._values.values() for each in noted]
        return [*own, *(each for noted in self._of_xacro for each in noted.readings())]


def run_recorded_element(
    interpreter: Interpreter, node: ElementNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run an element, and record what the expressions in its attributes and its text read."""
    spans = [_recorded(interpreter, each.value, each.span, scope) for each in node.attributes]
    content, text_span = node.content, None
    if isinstance(content, (TextContent, ListContent)):
        text_span = _recorded(interpreter, content.value, content.span, scope)
    count = len(out)
    run_element(interpreter, node, scope, out, body)
    element = out[-1] if len(out) > count else None
    if not isinstance(element, Element):
        return
    element.span = RecordedSpan(element.span)
    replaced = {span.start: span for span in spans if span is not None}
    if isinstance(element.value_spans, dict):
        for name, place in element.value_spans.items():
            element.value_spans[name] = replaced.get(place.start, place)
    if text_span is not None:
        _place_text(element, text_span)


def run_recorded_static(
    interpreter: Interpreter, element: Element, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add an element of the parser, whose text can then note further places."""
    run_static(interpreter, element, scope, out, body)
    copy = out[-1]
    assert isinstance(copy, Element), "an element was added"
    copy.span = RecordedSpan(copy.span)
    if interpreter.part_depth:
        _mark_texts(copy)


def _mark_texts(element: Element) -> None:
    for index, child in enumerate(element.children):
        if isinstance(child, Text):
            element.children[index] = Text(child.value, RecordedSpan(child.span))
        elif isinstance(child, Element):
            _mark_texts(child)


def run_recorded_dynamic(
    interpreter: Interpreter, node: DynamicNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run a computed key, and record what the text of its element read."""
    content = node.content
    span = None
    if isinstance(content, (TextContent, ListContent)):
        span = _recorded(interpreter, content.value, content.span, scope)
    count = len(out)
    run_dynamic(interpreter, node, scope, out, body)
    element = out[-1] if len(out) == count + 1 else None
    if span is not None and isinstance(element, Element) and element.span is node.span:
        _place_text(element, span)


def _place_text(element: Element, span: Span) -> None:
    element.children = [
        Text(child.value, span) if isinstance(child, Text) else child for child in element.children
    ]


def run_recorded_part(
    interpreter: Interpreter, node: PartNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run a part, and record at its joint and link where its name is written."""
    run_part(interpreter, node, scope, out, body)
    part = out[-1]
    assert isinstance(part, Element), "a part was run"
    inner = part.elements()
    places = [
        child.span
        for element in inner
        if element.name == "name"
        for child in element.children
        if isinstance(child, Text)
    ]
    if not places:
        return
    for element in (part, *inner):
        if element is part or element.name in ("name", "joint", "link"):
            element.span = RecordedSpan(element.span, name_span=places[-1])


def run_recorded_variables(
    interpreter: Interpreter, node: VariablesNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Declare variables, and note their values."""
    run_variables(interpreter, node, scope, out, body)
    assert interpreter.noted is not None
    for entry in node.entries:
        if isinstance(entry.name, str):
            interpreter.noted.take(scope, [entry.name], entry.span)


def run_recorded_process(
    interpreter: Interpreter, node: ProcessNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run Python, and note what the names in it mean behind it."""
    run_process(interpreter, node, scope, out, body)
    assert interpreter.noted is not None
    interpreter.noted.take(scope, dict.fromkeys(node.code.code.co_names), node.span)


def _recorded(
    interpreter: Interpreter, value: str | Value, span: Span, scope: Scope
) -> RecordedSpan | None:
    """Return a span with what the expressions of a value read; None if it holds none."""
    names: dict[str, None] = {}
    for template in _templates(value):
        for part in template.parts:
            if not isinstance(part, str):
                found = [part.name] if part.name is not None else names_in(part.text)
                names.update(dict.fromkeys(found))
    readings = [_reading(interpreter, name, scope, span) for name in names]
    if not names:
        return None
    return RecordedSpan(span, tuple(each for each in readings if each is not None))


def _templates(value: str | Value) -> Iterator[Template]:
    if isinstance(value, Template):
        yield value
    elif isinstance(value, ListValue):
        for item in value.items:
            yield from _templates(item)
    elif isinstance(value, DictValue):
        for key, item in value.pairs:
            yield from _templates(key)
            yield from _templates(item)


def _reading(interpreter: Interpreter, name: str, scope: Scope, span: Span) -> Reading | None:
    """Return the variable of a name; None for what is imported, predefined or Python's own."""
    value = scope.find(name)
    if value is MISSING or callable(value) or isinstance(value, Namespace):
        return None
    place = scope.place_of(name)
    if place is None and scope.home.names.get(name, MISSING) is value:
        return None
    return Reading(name, _text_of(interpreter, value, span), place)


def _text_of(interpreter: Interpreter, value: Any, span: Span) -> str:
    """Return a value as `print` shows it, with quotes around a text."""
    if value is None:
        return "null"
    if type(value) is str:
        return _cut(repr(value))
    if type(value) is bool:
        return str(value).lower()
    try:
        return _cut(interpreter.evaluator.text(print_text, value, span))
    except YamaroError:
        return f"a value of type {type(value).__name__}"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_VALUE else f"{text[:LONGEST_VALUE]}…"


RECORDING_HANDLERS: Handlers = {
    **HANDLERS,
    ElementNode: run_recorded_element,
    DynamicNode: run_recorded_dynamic,
    Element: run_recorded_static,
    PartNode: run_recorded_part,
    ProcessNode: run_recorded_process,
    VariablesNode: run_recorded_variables,
}
"""`HANDLERS`, with those in place of which this module records."""
