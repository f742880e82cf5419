"""Evaluates an `include`: its path, its namespace, and the variables it passes."""

from __future__ import annotations

from ..diagnostics import Frame, YamaroError, add_trace, failure
from ..namespace import MISSING, Namespace
from ..source import Span
from ..syntax.names import (
    is_identifier,
    name_hint,
)
from ..syntax.nodes import (
    Body,
    IncludeNode,
)
from ..xml.tree import Element, PartElement, with_trace
from ..xml.values import format_value
from .expressions import Values
from .markup import run_element
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..xml.tree import Node
    from .interpreter import Interpreter


def path_of(node: IncludeNode, scope: Scope, values: Values) -> str:
    """Return the path of the file to include, as written.

    Raises:
        YamaroError: it is empty, or no path at all.
    """
    text = format_value(values.written(node.path, scope)).strip()
    if not text or "\x00" in text:
        raise failure(
            "missing-file",
            "the path of this include is empty"
            if not text
            else "the path of this include contains a NUL character",
            node.path_span,
            hint="write include: other.yaml",
        )
    return text


def namespace_of(node: IncludeNode, scope: Scope, values: Values) -> str | None:
    """Return the name of the namespace that takes what the file hands back, if there is one.

    Raises:
        YamaroError: it is not a name.
    """
    if node.namespace is None or isinstance(node.namespace, str):
        return node.namespace
    name = values.joined(node.namespace, scope)
    if name and not is_identifier(name):
        raise failure(
            "bad-namespace",
            f"'{name}' cannot be the name of a namespace",
            node.namespace.span(),
            hint=name_hint(name),
        )
    return name or None


def passed_by(node: IncludeNode, scope: Scope, values: Values) -> dict[str, Any]:
    """Return the variables that are passed to the file."""
    passed = {}
    for argument in node.arguments:
        assert argument.name is not None
        assert argument.value is not None
        passed[argument.name] = values.value(argument.value, scope)
    return passed


def run_include(
    interpreter: Interpreter, node: IncludeNode, scope: Scope, out: list[Node], body: Body | None
) -> None:
    """Run a file in a context of its own, and take the names that it hands back."""
    path = path_of(node, scope, interpreter.values)
    namespace = namespace_of(node, scope, interpreter.values)
    passed = passed_by(node, scope, interpreter.values)
    try:
        source = interpreter.files.load(path, node.path_span, scope.home)
    except YamaroError as error:
        name = error.diagnostics[0].span.source.name
        if name != node.span.source.name:  # a file that cannot even be read as text
            add_trace(error, Frame("included", name, node.span, parent=interpreter.frame))
        raise
    if source.is_xml:
        from .xml_files import include_xml

        include_xml(interpreter, node, source, passed, namespace, out)
        if node.overlays:
            frame = interpreter.step("included", source.name, node.span, None)
            _overlay(interpreter, node, scope, frame, passed.get("prefix"), out)
        return
    frame = interpreter.step("included", source.name, node.span, None)
    interpreter.enter(frame, node.path_span)
    try:
        document = interpreter.files.parse(source)
        if node.arguments:
            frame.places = {each.name: each.span for each in node.arguments if each.name}
            from .yaml_main import Passed

            passed_to = Passed(node, document, frame.parent)
            interpreter.passed.setdefault((id(node), id(document)), passed_to)
        before = len(interpreter.shared_names.declared)
        inner = interpreter.begin_file(document, caller=scope.context)
        for argument in node.arguments:
            name = argument.name or ""
            inner.declare(name, passed[name], place=argument.span)
        inner.passed = frozenset(passed)
        words = interpreter.run_sections(document, inner, node)
        for model in document.model:
            interpreter.run_body(model, inner, out)
        if document.root is not None and not document.is_lone_section:
            made: list[Node] = []
            interpreter.element_depth -= 1
            run_element(interpreter, document.root, inner, made, None)
            interpreter.element_depth += 1
            for element in made:
                if isinstance(element, Element):
                    out += [_traced(interpreter, node) for node in element.children]
        out += words
    except YamaroError as error:
        add_trace(error, frame)
        raise
    except RecursionError:
        raise interpreter.too_deep(node.path_span) from None
    finally:
        interpreter.leave(frame)
    _hand_back(interpreter, inner, scope, namespace, before, node.span)
    if node.overlays:
        _overlay(interpreter, node, scope, frame, None, out)


def _overlay(
    interpreter: Interpreter,
    node: IncludeNode,
    scope: Scope,
    frame: Frame,
    prefix: object,
    out: list[Node],
) -> None:
    from .overlays import overlays_of_include

    out += overlays_of_include(interpreter, node, scope, format_value(prefix), frame)


def _traced(interpreter: Interpreter, node: Node) -> Node:
    """Return what is in a root element that is left out, with the trace of its own."""
    if not isinstance(node, Element) or not node.inherits_trace():
        return node
    if isinstance(node, PartElement):  # each is made for its place
        node.trace = interpreter.frame
        return node
    copy = with_trace(node, interpreter.frame)
    copy.children = interpreter.builder.inner(node)
    return copy


def _hand_back(
    interpreter: Interpreter,
    inner: Scope,
    scope: Scope,
    namespace: str | None,
    before: int,
    span: Span,
) -> None:
    """Bring the names of an included file to the one that included it."""
    if namespace is None:
        for key, value in inner.exported():
            interpreter.receive(scope, key, value, span, inner.place_of(key))
        return
    context = scope.context
    space = context.find(namespace) if namespace in context else None
    if not isinstance(space, Namespace):
        space = Namespace(namespace, interpreter.shared_names.find)
    scope.declare(namespace, space)
    for key, value in inner.exported():
        interpreter.warn_of_replacement(space._get(key), value, key, span)
        space._add(key, value)
    for key in dict.fromkeys(interpreter.shared_names.declared[before:]):
        space._add(key, MISSING)
