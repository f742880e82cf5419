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
    from collections.abc import Iterator, Sequence

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
    return sorted(_walk(tree, places), key=lambda each: each.start)


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


def _walk(tree: ast.AST, places: _Places) -> Iterator[NameInPython]:
    """Yield the names in a syntax tree, however deep it is."""
    pending: list[tuple[ast.AST, frozenset[str]]] = [(tree, frozenset())]
    while pending:
        node, hidden = pending.pop()
        match node:
            case ast.Name(name) if name not in hidden:
                start = places.index(node.lineno, node.col_offset)
                is_assigned = not isinstance(node.ctx, ast.Load)
                yield NameInPython(python_name(name), start, is_assigned=is_assigned, owner=None)
            case ast.Attribute(ast.Name(owner), name) if owner not in hidden:
                if node.end_lineno is not None and node.end_col_offset is not None:
                    end = places.index(node.end_lineno, node.end_col_offset)
                    start = end - len(name)
                    yield NameInPython(name, start, is_assigned=False, owner=owner)
            case ast.ClassDef():
                hidden |= _stored_in(node.body)
            case ast.ListComp() | ast.SetComp() | ast.GeneratorExp() | ast.DictComp():
                targets = [each for own in node.generators for each in ast.walk(own.target)]
                hidden |= {each.id for each in targets if isinstance(each, ast.Name)}
            case ast.Lambda() | ast.FunctionDef() | ast.AsyncFunctionDef():
                own = node.args
                listed = (*own.posonlyargs, *own.args, *own.kwonlyargs, own.vararg, own.kwarg)
                inner = hidden | {each.arg for each in listed if each is not None}
                defaults = (*own.defaults, *own.kw_defaults)
                pending += [(each, hidden) for each in defaults if each is not None]
                if isinstance(node, ast.Lambda):
                    pending.append((node.body, inner))
                    continue
                keyword = "async def " if isinstance(node, ast.AsyncFunctionDef) else "def "
                if node.name not in hidden:
                    start = places.index(node.lineno, node.col_offset) + len(keyword)
                    yield NameInPython(node.name, start, is_assigned=True, owner=None)
                inner |= _stored_in(node.body)
                pending += [(each, inner) for each in node.body]
                continue
        pending += [(each, hidden) for each in ast.iter_child_nodes(node)]


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
