"""Rewrites a tree of Python syntax node by node, each by the function for its exact class."""

from __future__ import annotations

import ast

from .limits import RUN_IT, SafeLimits, SafetyError, refused
from .syntax import HELPER_NAMES, HINTS, REFUSED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

    Position = tuple[int, int, int, int]
    Handler = Callable[["Rewriter", Any], Any]

RUNTIME = b"\0the SafeRuntime of the conversion"
"""Takes the place of the runtime in code that is not bound yet. No text of a file can be bytes."""

_WEIGHTS = {
    "Attribute": 6,
    "Call": 4,
    "Dict": 4,
    "DictComp": 4,
    "JoinedStr": 3,
    "Lambda": 24,
    "List": 2,
    "ListComp": 3,
    "Set": 6,
    "SetComp": 6,
}
"""Steps of the nodes that take more memory than one step accounts for."""


class Rewriter:
    """Turns the tree of a text into a tree of code that can do no harm.

    Attributes:
        handlers: the function for each class of nodes that is allowed.
        limits: how large constants may be.
        is_statements: whether methods that change their object are allowed.
    """

    def __init__(
        self, handlers: Mapping[str, Handler], limits: SafeLimits, *, is_statements: bool
    ) -> None:
        self.handlers = handlers
        self.limits = limits
        self.is_statements = is_statements
        self.nearest: ast.AST | None = None  # with a position: the node visited, or one around it
        self.f_string: ast.AST | None = None  # the one around it: before 3.12 places in it are off

    def visit(self, node: Any) -> Any:
        """Return what a node becomes."""
        name = type(node).__name__
        handler = self.handlers.get(name) if type(node).__module__ in ("ast", "_ast") else None
        around = self.nearest
        if hasattr(node, "lineno"):
            self.nearest = node
        if handler is None:
            words = REFUSED.get(name, f"`{name}`")
            raise self.refused(words, node, hint=HINTS.get(name, RUN_IT))
        result = handler(self, node)
        self.nearest = around
        return result

    def visit_all(self, nodes: list[Any]) -> list[Any]:
        """Return what each node becomes; None stays None."""
        return [None if node is None else self.visit(node) for node in nodes]

    def refused(
        self, construct: str, node: ast.AST | None, why: str = "", hint: str = RUN_IT
    ) -> SafetyError:
        """Return the error for a construct at a node."""
        if self.f_string is not None:
            node = self.f_string
        position = position_of(node) if node is not None else None
        if position is None and self.nearest is not None:
            position = position_of(self.nearest)
        return refused(construct, why, hint, position=position)

    def guard(self, name: str, at: ast.AST, *arguments: ast.expr) -> ast.expr:
        """Return the call of a guard; errors in it are shown at the place of a node."""
        runtime = ast.copy_location(ast.Constant(RUNTIME), at)
        method = ast.copy_location(ast.Attribute(runtime, name, ast.Load()), at)
        return ast.copy_location(ast.Call(method, list(arguments), []), at)

    def constant(self, value: object, at: ast.AST) -> ast.expr:
        """Return a constant at the place of a node."""
        return ast.copy_location(ast.Constant(value), at)  # type: ignore[arg-type]

    def check_name(self, name: str, node: ast.AST) -> None:
        """Refuse names that begin with two underscores."""
        if name.startswith("__") and name not in HELPER_NAMES:
            raise self.refused("a name that begins with two underscores", node)


def weight_of(*nodes: ast.AST) -> int:
    """Return the steps it takes to evaluate nodes once."""
    return sum(
        _WEIGHTS.get(type(inner).__name__, 1)
        for node in nodes
        for inner in ast.walk(node)
        if isinstance(inner, (ast.expr, ast.comprehension))
    )


def position_of(node: ast.AST) -> Position | None:
    """Return where a node is in the text; None for a node that has no position of its own."""
    if not hasattr(node, "lineno"):
        return None
    at: Any = node
    return at.lineno, at.col_offset, at.end_lineno, at.end_col_offset
