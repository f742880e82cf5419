"""YAML as the main file: its variables, its sections, its model or root element."""

from __future__ import annotations

import builtins

from ..diagnostics import Frame, InputFault, Reporter, failure
from ..source import Source, Span
from ..syntax.nodes import Document
from ..xml.tree import Element
from .interpreter import Interpreter
from .markup import run_element
from .predefined import CONSTANTS
from .scope import Scope

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ..syntax.nodes import IncludeNode
    from ..xml.tree import Node
    from .files import Files


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
            if interpreter.safety is not None:
                try:
                    value = interpreter.safety.admit(value)
                except InputFault as fault:
                    message = f"the value of the variable '{name}': {fault.message}"
                    start = Span(source, 0, 0)
                    raise failure(fault.code, message, start, hint=fault.hint) from None
            scope.declare(name, value, place=places.get(name))
        scope.passed = frozenset(variables)
        return _run_root(interpreter, document, scope, stem)
    finally:
        interpreter.messages.close()
        interpreter.files.close()


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


# --- variables that are passed to a file which has no use for them ----------------------------


_ALWAYS_KNOWN = frozenset((*dir(builtins), *CONSTANTS, "load_yaml", "file_dir"))
_READS_ANY = frozenset(("globals", "locals", "vars", "eval", "exec", "dir", "__import__"))
"""Functions of Python through which variables are read, or made, by names that are computed."""
PREFIX_HINT = (
    "'prefix' renames the elements of a URDF; in a YAML file, use it explicitly: name: $(prefix)arm"
)


class Passed:
    """The variables that one `include` has passed to a file."""

    __slots__ = ("document", "frame", "node")

    def __init__(self, node: IncludeNode, document: Document, frame: Frame | None) -> None:
        self.node = node
        self.document = document
        self.frame = frame


def warn_of_unread(places: Mapping[str, Span], files: Files, reporter: Reporter) -> None:
    """Warn of variables passed to the program that nothing in it declares or reads.

    Args:
        places: where each of them is set.
        files: the files of the program.
        reporter: takes the warnings.
    """
    read = files.names_read()
    unread = [name for name in places if name not in read]
    if not unread or not _READS_ANY.isdisjoint(read):
        return  # as nearly always, and then no file is looked through for what it declares
    tables = [each.symbols for each in files.documents]
    if any(each.is_open for each in tables):
        return
    known = {each.name for table in tables for each in table.declared_by_statements()}
    for table in tables:
        for include in table.includes:
            known |= {argument.name or "" for argument in include.node.arguments}
    for name in unread:
        if name not in known:
            from ..diagnostics import meant

            span = places[name]
            hint, fix = meant(name, _variables(known), span)
            reporter.report(
                "unknown-variable",
                f"nothing in the program declares or reads the variable '{name}'",
                span,
                hint=hint,
                fix=fix,
            )


def warn_of_unread_includes(includes: Iterable[Passed], files: Files, reporter: Reporter) -> None:
    """Warn of variables passed to included files that nothing in those declares or reads."""
    from ..syntax.leaves import is_computed

    for passed in includes:
        document, path = passed.document, passed.node.path
        if not isinstance(path, str) and is_computed(path):
            continue  # what one of the files has no use for may be meant for another one
        read = document.names_read | files.late.names_read
        unread = [each for each in passed.node.arguments if (each.name or "") not in read]
        if not unread or not _READS_ANY.isdisjoint(read) or document.symbols.is_open:
            continue
        known = {each.name for each in document.symbols.declared_by_statements()}
        for argument in unread:
            name = argument.name or ""
            if name in known:
                continue
            from ..diagnostics import meant

            hint, fix = meant(name, _variables(known | read - _ALWAYS_KNOWN), argument.span)
            if hint is None and name == "prefix":
                hint = PREFIX_HINT
            reporter.report(
                "unknown-variable",
                f"nothing in '{document.source.name}' declares or reads the variable '{name}'",
                argument.span,
                hint=hint,
                trace=passed.frame,
                fix=fix,
            )


def _variables(names: Iterable[str]) -> list[str]:
    """Return the names of variables, without those of functions and blocks."""
    return [name for name in names if name and not name[0].isupper()]
