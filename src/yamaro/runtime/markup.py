"""Runs elements, texts, comments, parts, and keys that are computed."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure
from ..namespace import MISSING
from ..source import Span
from ..syntax.keys import NAME_RULE, attribute_twice, name_fault
from ..syntax.names import (
    STATEMENTS,
    is_function_name,
)
from ..syntax.nodes import (
    Body,
    CommentNode,
    Content,
    DynamicNode,
    ElementNode,
    ListContent,
    PartNode,
    TextContent,
    TextNode,
)
from ..syntax.python import Template
from ..xml.forms import filled
from ..xml.tree import Comment, Element, PartElement, Text, unshared
from ..xml.values import LiteralList, format_value, is_comment_text
from .calls import (
    call,
)
from .expressions import ALWAYS_WRITABLE, SHORT, Values
from .interpreter import Interpreter
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..syntax.forms import EvaluatedForm
    from ..xml.tree import Node


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


def run_element(
    interpreter: Interpreter, node: ElementNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run an element, and append it to `out`; nothing if its name is empty."""
    form = node.form
    if form is not None and interpreter.shares:
        values = evaluate_holes(form, scope, interpreter.values)
        trace = interpreter.trace()
        inner = interpreter.inner_trace(trace)
        out.append(
            interpreter.builder.element(form, values, interpreter.part_depth > 0, trace, inner)
        )
        return
    name = node.name
    if not isinstance(name, str):
        name = _name(interpreter, name, scope, node.span, "element")
        if not name:
            return
    attributes: dict[str, object] = {}
    value_spans: dict[str, Span] | None = None
    if node.attributes:
        value_spans = {}
        for attribute in node.attributes:
            key, value = attribute.name, attribute.value
            if not isinstance(key, str):
                key = _name(interpreter, key, scope, attribute.name_span, "attribute")
                if not key:
                    continue
            written = interpreter.values.written(value, scope)
            if written is None:
                continue
            if key in attributes:
                raise attribute_twice(key, attribute.name_span)
            attributes[key] = written
            value_spans[key] = attribute.span
    element = Element(
        name,
        node.span,
        attributes=attributes,
        trace=interpreter.trace(),
        value_spans=value_spans,
        verbatim=node.verbatim,
        body=body,
    )
    if node.content is not None:
        _fill(interpreter, element, node.content, scope)
    out.append(element)


def run_static(
    interpreter: Interpreter, element: Element, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add an element that the parser has made."""
    if not interpreter.shares:
        element = unshared(element, interpreter.frame)
    elif interpreter.frame is interpreter.holder:
        element = interpreter.builder.emitted(element)
    else:
        inner = interpreter.inner_trace(interpreter.frame)
        element = interpreter.builder.traced(element, interpreter.frame, inner)
    out.append(element)


def run_ready(
    interpreter: Interpreter, node: Text | Comment, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add a text or comment that the parser has made."""
    out.append(node)


def _fill(interpreter: Interpreter, element: Element, content: Content, scope: Scope) -> None:
    """Give an element its content."""
    if isinstance(content, Body):
        interpreter.element_depth += 1
        around, interpreter.filled = interpreter.filled, element
        if interpreter.is_inside or content is interpreter.root_content:
            interpreter.run_body(content, scope, element.children)
        else:
            interpreter.run_inside(content, scope, element.children)
        interpreter.filled = around
        interpreter.element_depth -= 1
    elif isinstance(content, TextContent):
        value = interpreter.values.written(content.value, scope)
        if value is not None or interpreter.part_depth:  # in a part, None leaves the key out
            element.children.append(Text(value, content.span))
    elif isinstance(content, ListContent):
        if not interpreter.part_depth:
            raise failure(
                "list-as-text",
                f"a list of plain values cannot be the content of <{element.name}>",
                content.span,
                hint="write the values as a text, 0 0 1, or elements as `- name: value`",
            )
        items = interpreter.values.spelled_list(content.value, scope)
        element.children.append(Text(LiteralList(items), content.span))


def _name(interpreter: Interpreter, template: Template, scope: Scope, span: Span, what: str) -> str:
    """Return an evaluated name; an empty one drops what it would have named."""
    name = interpreter.values.joined(template, scope)
    fault = name_fault(name, what) if name else None
    if fault is not None:
        raise failure(
            "bad-name",
            fault,
            span,
            hint=NAME_RULE,
        )
    return name


def run_text(
    interpreter: Interpreter, node: TextNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add a text, unless it is None."""
    value = interpreter.values.written(node.value, scope)
    if value is not None:
        out.append(Text(value, node.span))


def run_comment(
    interpreter: Interpreter, node: CommentNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add a comment.

    Raises:
        YamaroError: XML cannot hold it.
    """
    text = format_value(interpreter.values.written(node.value, scope))
    if not is_comment_text(text):
        raise failure(
            "bad-comment",
            "an XML comment cannot contain '--' or end with '-'",
            node.span,
            hint="use a single dash, or another character",
        )
    out.append(Comment(text, node.span))


def run_part(
    interpreter: Interpreter, node: PartNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Add a part, which is lowered later."""
    interpreter.has_parts = True
    if node.form is not None and interpreter.shares:
        values = evaluate_holes(node.form, scope, interpreter.values)
        out.append(interpreter.builder.part(node.form, values, interpreter.trace()))
        return
    part = PartElement("part", node.span, trace=interpreter.trace(), body=body)
    interpreter.part_depth += 1
    interpreter.run_inside(node.body, scope, part.children)
    interpreter.part_depth -= 1
    out.append(part)


def run_dynamic(
    interpreter: Interpreter, node: DynamicNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run a bare key that holds `$(…)`: what its text names decides what it is."""
    text = interpreter.values.joined(node.key, scope)
    if not text:
        return
    if is_function_name(text):
        arguments = interpreter.files.late.call(node, text)
        call(interpreter, text, arguments, node.span, scope, out)
        return
    if text in STATEMENTS:
        raise failure(
            "computed-statement",
            f"this key results in '{text}', but a statement cannot be computed",
            node.span,
            hint="write the statement itself, inside an `if`; "
            f"for an XML element of that name, write <{text}>:",
        )
    if node.faults:
        raise YamaroError(fault.copy() for fault in node.faults)
    fault = name_fault(text, "element")
    if fault is not None:
        raise failure(
            "bad-name",
            fault,
            node.span,
            hint="write attributes after the $(…): $(name)/attribute=value"
            if "/" in text
            else NAME_RULE,
        )
    element = Element(text, node.span, trace=interpreter.trace(), body=body)
    _fill(interpreter, element, node.content, scope)
    out.append(element)
