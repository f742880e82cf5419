"""How finished sources use a name: only as a text, or also as a number or truth value."""

from __future__ import annotations

import ast

from ..document import Body, Row, pieces_of
from .tidying import entries_in, stem_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

VALUE, CONDITION, OTHER = "value", "condition", "other"
_BARE = {"condition": CONDITION, "in": OTHER, "range": OTHER, "process": OTHER}
"""Entries whose texts are Python without `$()`."""
_OF_TEXTS = frozenset(("str", "len", "find", "env", "load_yaml", "print"))
"""Functions that take a text as it is."""


class _Expression:
    """A piece of Python in the sources.

    Attributes:
        tree: of it; None if it cannot be read.
        words: the names in it.
        kind: whether it gives a value, is a condition, or something else.
        target: the variable or parameter that is given its value, or "".
    """

    __slots__ = ("kind", "parents", "target", "tree", "words")

    def __init__(self, text: str, kind: str, target: str) -> None:
        self.kind = kind
        self.target = target
        self.parents: dict[ast.AST, ast.AST] = {}
        self.tree: ast.expr | None = None
        try:
            self.tree = ast.parse(f"({text.strip()}\n)", mode="eval").body
        except (SyntaxError, ValueError):
            self.words = {word for word in text.replace("(", " ").split() if word.isidentifier()}
            return
        self.words = {node.id for node in ast.walk(self.tree) if isinstance(node, ast.Name)}
        for node in ast.walk(self.tree):
            for child in ast.iter_child_nodes(node):
                self.parents[child] = node


class Uses:
    """Knows the expressions in the sources of a robot."""

    def __init__(self, files: Iterable[Body]) -> None:
        """Read all that is evaluated."""
        self._expressions = [own for sections in files for own in _expressions_in(sections)]

    def is_text(self, name: str) -> bool:
        """Return whether a name, and all that is given its value, is used only as a text."""
        names = self._aliases(name)
        for own in self._expressions:
            if not own.words & names:
                continue
            if own.tree is None:
                return False
            for node in ast.walk(own.tree):
                if isinstance(node, ast.Name) and node.id in names:
                    if not _is_as_text(node, own, names):
                        return False
        return True

    def is_counted(self, name: str) -> bool:
        """Return whether a name, or what is given its value, is a bound of a `range`."""
        names = self._aliases(name)
        return any(
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id == "range"
            and any(isinstance(own, ast.Name) and own.id in names for own in node.args)
            for expression in self._expressions
            if expression.tree is not None and expression.words & names
            for node in ast.walk(expression.tree)
        )

    def _aliases(self, name: str) -> set[str]:
        """Return a name, and those that may be given its value as it is."""
        names = {name}
        count = 0
        while len(names) > count:
            count = len(names)
            for own in self._expressions:
                if own.target and own.tree is not None and _results(own.tree) & names:
                    names.add(own.target)
        return names


def _results(node: ast.expr) -> set[str]:
    """Return the names whose values an expression may give."""
    match node:
        case ast.Name(name):
            return {name}
        case ast.IfExp(_, one, other):
            return _results(one) | _results(other)
        case ast.BoolOp(_, values):
            return set().union(*map(_results, values))
    return set()


def _is_as_text(node: ast.expr, expression: _Expression, names: set[str]) -> bool:
    """Return whether a text and the number of that spelling mean the same in a place."""
    parent = expression.parents.get(node)
    match parent:
        case None:
            return expression.kind == VALUE
        case ast.Compare(left, operators, others):
            rest = [side for side in (left, *others) if side is not node]
            return all(
                isinstance(own, (ast.Eq, ast.NotEq, ast.In, ast.NotIn)) for own in operators
            ) and all(_is_of_texts(side, names) for side in rest)
        case ast.IfExp(test, _, _):
            return node is not test and _is_as_text(parent, expression, names)
        case ast.Call(ast.Name(function), arguments):
            return function in _OF_TEXTS and node in arguments
        case ast.Attribute():
            call = expression.parents.get(parent)
            return isinstance(call, ast.Call) and call.func is parent
        case ast.BinOp(left, ast.Add(), right):
            return any(_is_surely_text(side) for side in (left, right))
        case ast.BinOp(left, ast.Mod(), _):
            return _is_surely_text(left)
        case ast.Subscript(_, index):
            return index is node
        case ast.FormattedValue():
            return True
    return False


def _is_of_texts(node: ast.expr, names: set[str]) -> bool:
    """Return whether an expression is a text, or several of them."""
    if isinstance(node, (ast.List, ast.Tuple, ast.Set)):
        return all(_is_of_texts(item, names) for item in node.elts)
    return _is_surely_text(node) or (isinstance(node, ast.Name) and node.id in names)


def _is_surely_text(node: ast.expr) -> bool:
    match node:
        case ast.Constant(value):
            return isinstance(value, str)
        case ast.JoinedStr() | ast.Call(ast.Name("str" | "find" | "env")):
            return True
        case ast.BinOp(left, ast.Add(), right):
            return _is_surely_text(left) or _is_surely_text(right)
        case ast.Call(ast.Attribute(value, "lower" | "upper" | "strip" | "replace")):
            return True
    return False


def _expressions_in(sections: Body) -> Iterator[_Expression]:
    for entry in entries_in(sections):
        if "$(" in entry.key:
            for text in _pieces(entry.key):
                yield _Expression(text, VALUE, "")
        if isinstance(entry.value, Row):
            for piece in entry.value.pieces:
                name, _, default = piece.partition("=")
                yield from _of_value(default, name.strip())
        elif isinstance(entry.value, str):
            if entry.key in _BARE:
                yield _Expression(entry.value, _BARE[entry.key], "")
            else:
                yield from _of_value(entry.value, stem_of(entry))


def _of_value(value: str, target: str) -> Iterator[_Expression]:
    pieces = list(pieces_of(value))
    is_alone = len([piece for piece, _ in pieces if piece]) == 1
    for text in _pieces(value):
        yield _Expression(text, VALUE, target if is_alone else "")


def _pieces(text: str) -> list[str]:
    """Return the Python in a text, without what ROS writes in `$(…)`."""
    found = [piece[2:-1] for piece, is_expression in pieces_of(text) if is_expression]
    return [piece for piece in found if piece.split(" ")[0] not in ("find", "env", "arg")]
