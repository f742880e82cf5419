"""Compiles the Python of a file for safe mode: without side effects, deterministic, bounded.

Python text becomes a syntax tree; each node's exact class is looked up in a list of what is
allowed, and whatever could reach further, or take long, becomes a call of a guard. What is on no
list is refused, so a new version of Python brings nothing in. Guards are methods of the
`SafeRuntime` of the conversion, which `SafeRuntime.bind` puts into the code as a constant: no name
leads to it.

The rules, for people who write robots, are in docs/safety.md.
"""

from __future__ import annotations

import ast

from .expressions import EXPRESSIONS
from .limits import SafeLimits
from .rewriter import Rewriter, position_of
from .statements import STATEMENTS
from .syntax import ABSTRACT, GONE, OPERATORS, REFUSED, SYMBOLS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import CodeType

    from .rewriter import Handler, Position

HANDLERS: dict[str, Handler] = EXPRESSIONS | STATEMENTS
"""What each allowed class of nodes becomes; whatever is in no table is refused."""


def compile_safe(text: str, filename: str, mode: str, limits: SafeLimits | None = None) -> CodeType:
    """Return the code of an expression or of statements, to be bound to a runtime and run.

    Args:
        text: what `compile` would get.
        filename: the same.
        mode: "eval" or "exec".
        limits: how long and deep the text may be; the usual ones if left out.

    Raises:
        SafetyError: it holds what is not allowed; the position is that in `text`.
        SyntaxError: it is not Python.
    """
    limits = limits or SafeLimits()
    _check_text(text, limits, brackets_added=1 if mode == "eval" else 0)
    tree = compile(text, filename, mode, ast.PyCF_ONLY_AST, dont_inherit=True)
    assert isinstance(tree, (ast.Expression, ast.Module))
    _check_size(tree, limits)
    rewritten = Rewriter(HANDLERS, limits, is_statements=mode == "exec").visit(tree)
    return compile(rewritten, filename, mode, dont_inherit=True)


def classify(node_class: type) -> str:
    """Return whether a class of syntax nodes is "allowed", "refused", "abstract" or "unknown"."""
    name = node_class.__name__
    if name in HANDLERS or name in SYMBOLS or name in OPERATORS:
        return "allowed"
    if name in REFUSED:
        return "refused"
    return "abstract" if name in ABSTRACT or name in GONE else "unknown"


# --- how much text ----------------------------------------------------------------------------


def _check_text(text: str, limits: SafeLimits, *, brackets_added: int) -> None:
    """Check what Python's own parser might stumble over; around an expression we put brackets."""
    size = len(text) - 3 * brackets_added  # "(" and "\n)"
    if size > limits.characters:
        raise limits.passed(
            "characters",
            f"this Python text has {size:,} characters",
            "split it into several variables",
        )
    depth = 0
    for index, char in enumerate(text):
        if char in "([{":
            depth += 1
            if depth > limits.brackets + brackets_added:
                raise limits.passed(
                    "brackets",
                    "too many brackets are open here",
                    position=_position_in(text, index),
                )
        elif char in ")]}" and depth:
            depth -= 1


def _position_in(text: str, index: int) -> Position:
    line = text.count("\n", 0, index) + 1
    start = text.rfind("\n", 0, index) + 1
    column = len(text[start:index].encode("utf-8", "surrogatepass"))
    return line, column, line, column + 1


def _check_size(tree: ast.AST, limits: SafeLimits) -> None:
    """Check how many nodes a tree has, and how deep it is, before anything recurses over it."""
    hint = "split it into several variables"
    count = depth = 0
    position: Position | None = None
    level: list[ast.AST] = [tree]
    while level:
        count += len(level)
        depth += 1
        position = next(filter(None, map(position_of, level)), position)
        if count > limits.nodes:
            raise limits.passed("nodes", "this Python text has too many parts", hint)
        if depth > limits.depth:
            raise limits.passed("depth", "this is nested too deep", hint, position)
        level = [child for node in level for child in ast.iter_child_nodes(node)]
