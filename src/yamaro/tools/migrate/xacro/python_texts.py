"""Texts of Python, changed where they are: edits, negations, parentheses."""

from __future__ import annotations

from ....xml.values import is_number
from ....yaml.nodes import type_plain

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast

_OPPOSITES = {"==": "!=", "!=": "==", "in": "not in", "not in": "in"}


def ends_in_minus(pieces: list[str]) -> bool:
    """Return whether the pieces of a text end in a sign for the number that follows."""
    return "".join(pieces).split(" ")[-1:] == ["-"]


def minus(python: str) -> str:
    """Return an expression with the other sign."""
    import ast

    tree = ast.parse(python, mode="eval").body
    is_whole = isinstance(tree, (ast.Name, ast.Call, ast.Attribute, ast.Subscript, ast.Constant))
    return f"-{python}" if is_whole else f"-({python})"


def negated(condition: str) -> str:
    """Return the condition that is true where this one is false."""
    import ast

    try:
        tree = ast.parse(condition, mode="eval").body
    except (SyntaxError, ValueError):
        return f"not ({condition})"
    if isinstance(tree, ast.UnaryOp) and isinstance(tree.op, ast.Not):
        operand = without_parentheses(condition.removeprefix("not").strip())
        return operand if _is_truth_value(tree.operand) else f"bool({operand})"
    if isinstance(tree, ast.Compare) and len(tree.ops) == 1:
        left = ast.get_source_segment(condition, tree.left) or ""
        right = ast.get_source_segment(condition, tree.comparators[0]) or ""
        between = condition.removeprefix(left).removesuffix(right)
        opposite = _OPPOSITES.get(" ".join(between.split()))
        if left + between + right == condition and opposite is not None:
            return f"{left} {opposite} {right}"
    if isinstance(tree, (ast.Name, ast.Call, ast.Attribute, ast.Subscript, ast.Constant)):
        return f"not {condition}"
    return f"not ({condition})"


def _is_truth_value(node: ast.expr) -> bool:
    """Return whether an expression gives True or False, and no text, which is not a condition."""
    import ast

    if isinstance(node, ast.BoolOp):
        return all(map(_is_truth_value, node.values))
    is_not = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    return is_not or isinstance(node, ast.Compare)


def without_parentheses(python: str) -> str:
    """Return an expression without parentheses around the whole."""
    import ast

    while python.startswith("(") and python.endswith(")"):
        inner = python[1:-1].strip()
        try:
            same = ast.dump(ast.parse(inner, mode="eval")) == ast.dump(
                ast.parse(python, mode="eval")
            )
        except (SyntaxError, ValueError):
            return python
        if not same:
            return python
        python = inner
    return python


class Edits:
    """Changes of a text at the places of its syntax."""

    def __init__(self, text: str) -> None:
        self._data = text.encode()
        self._starts = [0]
        for line in text.split("\n"):
            self._starts.append(self._starts[-1] + len(line.encode()) + 1)
        self._edits: list[tuple[int, int, str]] = []

    def replace(self, node: ast.expr, new: str) -> None:
        """Put a text in the place of a node."""
        self._edits.append((self._start(node), self._end(node), new))

    def replace_after(self, inner: ast.expr, node: ast.expr, new: str) -> None:
        """Put a text in the place of what follows `inner` in a node."""
        self._edits.append((self._end(inner), self._end(node), new))

    def insert_before(self, node: ast.expr, new: str) -> None:
        """Put a text in front of a node."""
        self._edits.append((self._start(node), self._start(node), new))

    def insert_after(self, node: ast.expr, new: str) -> None:
        """Put a text behind a node."""
        self._edits.append((self._end(node), self._end(node), new))

    def text(self) -> str:
        """Return the text with all changes."""
        data = self._data
        for start, end, new in sorted(self._edits, reverse=True):
            if data[start:end] != new.encode():
                data = data[:start] + new.encode() + data[end:]
        return data.decode()

    def _start(self, node: ast.expr) -> int:
        return self._starts[node.lineno - 1] + node.col_offset

    def _end(self, node: ast.expr) -> int:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return self._starts[node.end_lineno - 1] + node.end_col_offset


def is_plain_number(python: str) -> bool:
    """Return whether Python is a number that YAML reads as the same one."""
    value = type_plain(python)
    return is_number(value) and repr(value) == python
