"""YAML as the main file: its variables, its sections, its model or root element."""

from __future__ import annotations

from ..diagnostics import InputFault, failure
from ..source import Source, Span
from ..syntax.nodes import Document
from ..xml.tree import Element
from .interpreter import Interpreter
from .markup import run_element
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..xml.tree import Node


def run_yaml_main(
    interpreter: Interpreter,
    source: Source,
    *,
    stem: str,
    variables: dict[str, object],
    places: Mapping[str, Span] | None = None,
) -> Element:
    """Run the main file and return the root element.

    Args:
        interpreter: the conversion.
        source: the file.
        stem: the robot's name if the file gives none.
        variables: what is passed in.
        places: where each of them is set.

    Raises:
        YamaroError: the input has errors.
    """
    interpreter.places = places = places or {}
    interpreter.is_yaml = True
    try:
        document = interpreter.files.parse(source)
        scope = interpreter.begin_file(document, caller=None)
        for name, value in variables.items():
            scope.declare(name, _admitted(interpreter, name, value, source), place=places.get(name))
        scope.passed = frozenset(variables)
        return _run_root(interpreter, document, scope, stem)
    finally:
        interpreter.messages.close()
        interpreter.files.close()


def _admitted(interpreter: Interpreter, name: str, value: object, source: Source) -> object:
    """Return the value of a variable that is passed in, if it may come in."""
    if interpreter.safety is None:
        return value
    try:
        return interpreter.safety.admit(value)
    except InputFault as fault:
        message = f"the value of the variable '{name}': {fault.message}"
        raise failure(fault.code, message, Span(source, 0, 0), hint=fault.hint) from None


def _run_root(interpreter: Interpreter, document: Document, scope: Scope, stem: str) -> Element:
    interpreter.is_robot = document.root is None or document.root.name == "robot"
    words = interpreter.run_sections(document, scope)
    if document.root is not None:
        out: list[Node] = []
        interpreter.root_content = document.root.content
        interpreter.element_depth -= 1
        run_element(interpreter, document.root, scope, out, None)
        interpreter.element_depth += 1
        root = out[0] if out else None
        assert isinstance(root, Element), "a root element has a fixed name"
        is_named = "name" in root.attributes or root.verbatim
        if root.name == "robot" and not is_named:
            root.attributes = {"name": stem, **root.attributes}
        root.children += words
        return root
    start = document.model_span or Span(document.source, 0, 0)
    root = Element("robot", start, attributes={"name": stem})
    for body in document.model:
        interpreter.run_body(body, scope, root.children)
    if document.robot_name is not None:
        content = document.robot_name
        root.span = content.span
        name = interpreter.values.written(content.value, scope)
        root.attributes["name"] = stem if name is None else name
    root.children += words
    return root
