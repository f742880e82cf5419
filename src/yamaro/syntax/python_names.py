"""The names in Python text, each with its place: what is read, what is assigned.

Names that only the text itself knows are left out: parameters of a lambda, of a comprehension, and
the locals of a `def`.
"""

from __future__ import annotations

import ast

from .names import python_name
from .python import expression_without_dollars, ros_words

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from .python import PythonCode


class NameInPython:
    """A name in a text of Python.

    Attributes:
        name: the variable; for `space.name` the attribute.
        start: where it begins in the text.
        is_assigned: whether it is set here.
        owner: for an attribute of a name, that name; else None.
    """

    __slots__ = ("is_assigned", "name", "owner", "start")

    def __init__(self, name: str, start: int, *, is_assigned: bool, owner: str | None) -> None:
        self.name = name
        self.start = start
        self.is_assigned = is_assigned
        self.owner = owner


def names_in_code(code: PythonCode) -> list[NameInPython]:
    """Return the names in an expression or a block of statements, in order."""
    text = code.text
    if code.name is not None:
        start = len(text) - len(text.lstrip())
        return [NameInPython(code.name, start, is_assigned=False, owner=None)]
    words = ros_words(text) if code.opening else None
    if words is not None:
        if words[0] != "arg":
            return []
        start = text.find(words[1], text.find(words[0]) + len(words[0]))
        return [NameInPython(words[1], start, is_assigned=False, owner=None)]
    meaning = text
    if code.opening and "$(" in text:
        meaning, _ = expression_without_dollars(text)
        if len(meaning) != len(text):
            return []
    return names_in_text(meaning, is_block=not code.opening)


def names_in_text(text: str, *, is_block: bool) -> list[NameInPython]:
    """Return the names in a text of Python; none if it is not Python."""
    opening = "" if is_block else "("
    try:
        tree = ast.parse(text if is_block else f"({text}\n)", mode="exec" if is_block else "eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []
    places = _Places(opening + text, len(opening))
    return sorted(_Walk(places).run(tree), key=lambda each: each.start)


class _Places:
    """Lines and columns of `ast`, which counts bytes, as indices into the text."""

    def __init__(self, text: str, added: int) -> None:
        self._lines = text.split("\n")
        self._is_ascii = text.isascii()
        self._added = added
        self._starts = [0]
        for line in self._lines:
            self._starts.append(self._starts[-1] + len(line) + 1)

    def index(self, line: int, column: int) -> int:
        if not self._is_ascii:
            written = self._lines[line - 1].encode("utf-8", "surrogatepass")[:column]
            column = len(written.decode("utf-8", "ignore"))
        return self._starts[line - 1] + column - self._added


class _Walk:
    """One walk through a syntax tree, however deep it is."""

    def __init__(self, places: _Places) -> None:
        self._places = places
        self._found: list[NameInPython] = []
        self._pending: list[tuple[ast.AST, frozenset[str]]] = []  # with the names hidden there

    def run(self, tree: ast.AST) -> list[NameInPython]:
        self._pending.append((tree, frozenset()))
        while self._pending:
            self._visit(*self._pending.pop())
        return self._found

    def _visit(self, node: ast.AST, hidden: frozenset[str]) -> None:
        if isinstance(node, ast.Name):
            self._add_name(node, hidden)
        elif isinstance(node, (ast.Lambda, ast.FunctionDef, ast.AsyncFunctionDef)):
            self._visit_function(node, hidden)
            return
        elif isinstance(node, ast.ClassDef):
            hidden |= _stored_in(node.body)
        elif isinstance(node, (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.DictComp)):
            hidden |= frozenset(name for each in node.generators for name in _targets(each.target))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            self._add_attribute(node, node.value, hidden)
        self._visit_later(ast.iter_child_nodes(node), hidden)

    def _visit_later(self, nodes: Iterable[ast.AST], hidden: frozenset[str]) -> None:
        self._pending += [(node, hidden) for node in nodes]

    def _visit_function(
        self, node: ast.Lambda | ast.FunctionDef | ast.AsyncFunctionDef, hidden: frozenset[str]
    ) -> None:
        arguments = node.args
        own = [each.arg for each in (*arguments.posonlyargs, *arguments.args)]
        own += [each.arg for each in arguments.kwonlyargs]
        own += [each.arg for each in (arguments.vararg, arguments.kwarg) if each is not None]
        inner = hidden | frozenset(own)
        defaults = (*arguments.defaults, *arguments.kw_defaults)
        self._visit_later((each for each in defaults if each is not None), hidden)
        if isinstance(node, ast.Lambda):
            self._visit_later([node.body], inner)
            return
        start = self._places.index(node.lineno, node.col_offset)
        keyword = "async def " if isinstance(node, ast.AsyncFunctionDef) else "def "
        if node.name not in hidden:
            at = start + len(keyword)
            self._found.append(NameInPython(node.name, at, is_assigned=True, owner=None))
        self._visit_later(node.body, inner | _stored_in(node.body))

    def _add_name(self, node: ast.Name, hidden: frozenset[str]) -> None:
        if node.id in hidden:
            return
        start = self._places.index(node.lineno, node.col_offset)
        is_assigned = not isinstance(node.ctx, ast.Load)
        self._found.append(
            NameInPython(python_name(node.id), start, is_assigned=is_assigned, owner=None)
        )

    def _add_attribute(self, node: ast.Attribute, value: ast.Name, hidden: frozenset[str]) -> None:
        if value.id in hidden or node.end_lineno is None or node.end_col_offset is None:
            return
        end = self._places.index(node.end_lineno, node.end_col_offset)
        self._found.append(
            NameInPython(node.attr, end - len(node.attr), is_assigned=False, owner=value.id)
        )


def _stored_in(body: Sequence[ast.stmt]) -> frozenset[str]:
    """Return the names that statements of a function set, without those of functions in it."""
    found: set[str] = set()
    pending: list[ast.AST] = list(body)
    while pending:
        node = pending.pop()
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            found.add(node.id)
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            found.add(node.name)
            continue
        elif isinstance(node, (ast.Lambda, ast.ListComp, ast.SetComp, ast.GeneratorExp)):
            continue
        pending.extend(ast.iter_child_nodes(node))
    return frozenset(found)


def _targets(node: ast.AST) -> Iterator[str]:
    for each in ast.walk(node):
        if isinstance(each, ast.Name):
            yield each.id
