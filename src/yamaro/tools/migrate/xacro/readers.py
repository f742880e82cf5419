"""Which files read a name, other than as a parameter or property of a macro of their own."""

from __future__ import annotations

import re

from ....xacro.faults import Fault
from ....xacro.templates import Expression, Substitution, parse_template
from ....xml.tree import Element
from ....xml.values import format_value
from .arguments import is_argument

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container

    from .program import XacroProgram

_WORD = re.compile(r"[^\W\d]\w*")
_ARGUMENT = re.compile(r"\$\(\s*(?:arg|eval)\b|\barg\s*\(")


class Readers:
    """Finds the files that read a name of another file.

    Attributes:
        files: the files that read a name or call a macro (`xacro:name`), by that.
    """

    def __init__(self, program: XacroProgram) -> None:
        """Look at all macros, and at what is outside of macros in each file."""
        self.files: dict[str, set[str]] = {}
        macros = list(program.definitions.values())
        inside = {id(macro.element) for macro in macros}
        for macro in macros:
            without = inside - {id(macro.element)}
            own = {each.name.lstrip("*") for each in macro.parameters}
            own |= _defined_in(macro.element)
            self._add(program, macro.element, macro.file, own, without)
        for path, root in program.roots.items():
            self._add(program, root, path, set(), inside)

    def _add(
        self,
        program: XacroProgram,
        element: Element,
        path: str,
        own: set[str],
        without: Container[int],
    ) -> None:
        """Note what is read in an element and is not its own."""
        names = program.forwarded_in(element, without)
        arguments: set[str] = set()  # which no parameter hides
        for inner in element.iter(without):
            names |= _read_in(inner)
            for value in (*inner.attributes.values(), inner.text()):
                text = format_value(value)
                if _ARGUMENT.search(text):
                    arguments.update(_WORD.findall(text))
        for name in (names - own) | (arguments & program.arguments.keys()):
            self.files.setdefault(name, set()).add(path)


def _read_in(element: Element) -> set[str]:
    """Return the names that an element alone reads."""
    names: set[str] = set()
    if element.name.startswith("xacro:"):
        names.add(f"xacro:{element.name.removeprefix('xacro:').rpartition('.')[2]}")
    if element.name in ("xacro:insert_block", "xacro:call"):
        given = element.attributes.get("name", element.attributes.get("macro"))
        prefix = "xacro:" if element.name == "xacro:call" else ""
        names.add(f"{prefix}{format_value(given)}")
    for text in (*map(format_value, element.attributes.values()), element.text()):
        if "$" in text:
            names |= _names_in(text)
    return names


def _names_in(text: str) -> set[str]:
    """Return the names that a text reads, and more where that is not known."""
    try:
        parts = parse_template(text).parts
    except Fault:
        return set(_WORD.findall(text))
    names: set[str] = set()
    for part in parts:
        if isinstance(part, Expression):
            names |= _names_of(part.text)
        elif isinstance(part, Substitution) and ("$" in part.text or part.text[:4] != "find"):
            names |= set(_WORD.findall(part.text))
    return names


def _names_of(expression: str) -> set[str]:
    import ast

    if "$" in expression or _ARGUMENT.search(expression):
        return set(_WORD.findall(expression))
    try:
        tree = ast.parse(expression.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return set(_WORD.findall(expression))
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    in_namespaces = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    return names | in_namespaces


def _defined_in(macro: Element) -> set[str]:
    """Return the properties that a macro always has of its own."""
    names: set[str] = set()
    for element in macro.elements():
        name = format_value(element.attributes.get("name"))
        text = format_value(element.attributes.get("value"))
        if (
            element.name == "xacro:property"
            and "value" in element.attributes
            and "scope" not in element.attributes
            and not is_argument(text, name)
            and name not in _names_in(text)
        ):
            names.add(name)
    return names
