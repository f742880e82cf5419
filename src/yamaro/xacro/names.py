"""The names in a xacro file with their places, without running it; for editors."""

from __future__ import annotations

import ast
import re

from ..source import Span
from ..xml.tree import Element, Text
from ..xml.values import format_value
from .faults import Fault
from .places import XacroPlace, stretch
from .statements import PREFIX
from .symbol_table import ARGUMENT, BLOCK, MACRO, PROPERTY, definition_of
from .templates import Expression, Substitution, parse_template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

PARAMETER, PACKAGE = "parameter", "package"
"""Kinds of names besides those of definitions."""
TAGS = {
    "arg": ("name", "default"),
    "attribute": ("name", "value"),
    "call": ("macro",),
    "element": ("xacro:name",),
    "if": ("value",),
    "include": ("filename", "ns", "optional"),
    "insert_block": ("name",),
    "macro": ("name", "params"),
    "property": ("name", "value", "default", "scope", "lazy_eval", "remove"),
    "unless": ("value",),
}
"""xacro's own tags, and the attributes that they take."""
_OPEN = re.compile(r"\$\{(?P<expression>[^}]*)|\$\((?P<substitution>[^)]*)")
_INNER = re.compile(r"\$\([^)]*\)?|\$\{[^}]*\}?")
_WORD = re.compile(r"(?<![\w.])[^\W\d]\w*")
_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"")
_COMMAND = re.compile(r"\s*(arg|find|eval)\s+(\S.*)", re.DOTALL)


class Name:
    """A name where it is defined or used.

    Attributes:
        kind: MACRO, PROPERTY (a block too), ARGUMENT, PARAMETER or PACKAGE; what an expression
            reads is a PROPERTY, though it may be a parameter.
        name: without its namespace, and without the stars of a block.
        span: where it is written.
        element: the tag that it is in.
        is_definition: whether it is defined there.
        macro: the innermost macro that it is in, or None.
        owner: of a parameter in a call, the name of the macro that is called.
        space: the namespace that is written before it, or "".
    """

    __slots__ = ("element", "is_definition", "kind", "macro", "name", "owner", "space", "span")

    def __init__(
        self,
        kind: str,
        name: str,
        span: Span,
        element: Element,
        macro: Element | None,
        *,
        is_definition: bool = False,
        owner: str = "",
        space: str = "",
    ) -> None:
        self.kind = kind
        self.name = name
        self.span = span
        self.element = element
        self.macro = macro
        self.is_definition = is_definition
        self.owner = owner
        self.space = space

    def __repr__(self) -> str:
        return f"<{self.kind} {self.name} at {self.span.place()}>"


def walk(root: Element) -> Iterator[tuple[Element, Element | None]]:
    """Yield each element with the innermost macro that it is in; a macro is in itself."""
    pending: list[tuple[Element, Element | None]] = [(root, None)]
    while pending:
        element, macro = pending.pop()
        macro = element if element.name == "xacro:macro" else macro
        yield element, macro
        pending += [(child, macro) for child in reversed(element.elements())]


class XacroNames:
    """The names of a file.

    Attributes:
        found: in the order of the file, as far as its tags go.
        computed: where a `${…}` or `$(…)` is written.
    """

    def __init__(self, root: Element) -> None:
        """Look through the elements of a file."""
        self.found: list[Name] = []
        self.computed: list[Span] = []
        for element, macro in walk(root):
            if element.name.startswith(PREFIX):
                self._take_tag(element, macro)
            for attribute, value in element.attributes.items():
                text = format_value(value)
                if "$" in text:
                    self._take_text(XacroPlace(element, attribute, None), text, element, macro)
            for child in element.children:
                if isinstance(child, Text) and "$" in format_value(child.value):
                    text = format_value(child.value)
                    self._take_text(XacroPlace(child, "", None), text, element, macro)

    # --- tags -------------------------------------------------------------------------------

    def _take_tag(self, element: Element, macro: Element | None) -> None:
        defined = definition_of(element)
        given = element.attributes
        if defined is not None:
            span = _last(element.value_span("name"), defined.name)
            kind = PROPERTY if defined.kind == BLOCK else defined.kind
            if "name" in given:
                self.found.append(
                    Name(kind, defined.name, span, element, macro, is_definition=True)
                )
            if defined.kind == MACRO:
                text = format_value(element.attributes.get("params", ""))
                whole = element.value_span("params")
                for each in defined.parameters():
                    name = each.name.lstrip("*")
                    if name:
                        start = each.start + len(each.name) - len(name)
                        span = stretch(whole, text, start, start + len(name))
                        self.found.append(
                            Name(PARAMETER, name, span, element, element, is_definition=True)
                        )
            return
        tag = element.name[len(PREFIX) :]
        if tag == "insert_block" and "name" in given:
            name = format_value(given["name"])
            self.found.append(Name(PROPERTY, name, element.value_span("name"), element, macro))
        elif tag == "call" and "macro" in given:
            name = format_value(given["macro"])
            self._take_call(name, element.value_span("macro"), element, macro)
        elif tag not in TAGS:
            self._take_call(tag, element.span, element, macro)

    def _take_call(self, name: str, span: Span, element: Element, macro: Element | None) -> None:
        space, _, own = name.rpartition(".")
        self.found.append(Name(MACRO, own, _last(span, own), element, macro, space=space))
        for attribute in element.attributes:
            if not attribute.startswith("xmlns") and (element.name, attribute) != _CALLED:
                place = element.name_span(attribute)
                self.found.append(Name(PARAMETER, attribute, place, element, macro, owner=own))

    # --- what is computed -------------------------------------------------------------------

    def _take_text(
        self, place: XacroPlace, text: str, element: Element, macro: Element | None
    ) -> None:
        try:
            pending = [*reversed(parse_template(text).parts)]
        except Fault:  # it is being written
            for found in _OPEN.finditer(text):
                kind = found.lastgroup or ""
                span = place.span(found.start(), found.end())
                self._take_computed(place, kind, found[kind], found.start(), span, element, macro)
            return
        while pending:
            part = pending.pop()
            if isinstance(part, (Expression, Substitution)):
                kind = "expression" if isinstance(part, Expression) else "substitution"
                span = place.span(part.start, part.end)
                self._take_computed(place, kind, part.text, part.start, span, element, macro)
                pending += reversed(part.inner.parts) if part.inner is not None else ()

    def _take_computed(
        self,
        place: XacroPlace,
        kind: str,
        text: str,
        start: int,
        span: Span,
        element: Element,
        macro: Element | None,
    ) -> None:
        """Take the names in what is between the brackets that begin at an offset of a text."""
        self.computed.append(span)
        if kind == "expression":
            for name, space, at, is_argument in _names_in(text):
                own = ARGUMENT if is_argument else PROPERTY
                where = place.span(start + 2 + at, start + 2 + at + len(name))
                self.found.append(Name(own, name, where, element, macro, space=space))
            return
        command = _COMMAND.match(text)
        if command is None:
            return
        after = start + 2 + command.start(2)
        if command[1] == "eval":
            for name, _, at, _ in _names_in(command[2]):
                where = place.span(after + at, after + at + len(name))
                self.found.append(Name(ARGUMENT, name, where, element, macro))
            return
        name = command[2].strip()
        own = ARGUMENT if command[1] == "arg" else PACKAGE
        self.found.append(Name(own, name, place.span(after, after + len(name)), element, macro))


_CALLED = ("xacro:call", "macro")


def _last(span: Span, name: str) -> Span:
    """Return the end of a place that a name is in, such as the tag `xacro:name`."""
    written = span.written()
    if name and written.endswith(name):
        return Span(span.source, span.end - len(name), span.end)
    return span


def _names_in(code: str) -> Iterator[tuple[str, str, int, bool]]:
    """Yield the names that Python reads: the name, its namespace, its offset, if it is an argument.

    Code that is not Python yet is taken for words.
    """
    plain = _INNER.sub(lambda found: "0" * len(found[0]), code)
    try:
        tree = ast.parse(f"({plain})", mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        plain = _QUOTED.sub(lambda found: " " * len(found[0]), plain)
        for found in _WORD.finditer(plain):
            yield found[0], "", found.start(), False
        return
    lines = f"({plain})".split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)

    def offset(line: int, column: int) -> int:
        before = lines[line - 1].encode()[:column].decode(errors="replace")
        return starts[line - 1] + len(before) - 1  # of the bracket that is put before it

    nodes = list(ast.walk(tree))
    bound = {each.id for each in nodes if isinstance(each, ast.Name) and _is_store(each)}
    bound |= {each.arg for each in nodes if isinstance(each, ast.arg)}
    for node in nodes:
        if isinstance(node, ast.Name) and node.id not in bound:
            yield node.id, "", offset(node.lineno, node.col_offset), False
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            end = offset(node.end_lineno or node.lineno, node.end_col_offset or 0)
            yield node.attr, node.value.id, end - len(node.attr), False
        elif isinstance(node, ast.Call) and node.args and _is_argument(node.func):
            first = node.args[0]
            if isinstance(first, ast.Constant) and isinstance(first.value, str):
                yield first.value, "", offset(first.lineno, first.col_offset) + 1, True


def _is_store(node: ast.Name) -> bool:
    return isinstance(node.ctx, ast.Store)


def _is_argument(function: ast.expr) -> bool:
    """Return whether a function gives arguments: `xacro.arg`, and `arg` in `$(eval …)`."""
    if isinstance(function, ast.Attribute):
        return function.attr == "arg"
    return isinstance(function, ast.Name) and function.id == "arg"
