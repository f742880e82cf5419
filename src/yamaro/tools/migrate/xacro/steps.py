"""Python texts of loops: conditions that count, and what they become as ranges."""

from __future__ import annotations

import ast

from ....xacro.templates import guess_value

_COMPARED: dict[type[ast.cmpop], str] = {
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Eq: "==",
    ast.NotEq: "!=",
}
_MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
_NEW_LISTS = ("list", "sorted", "split", "copy")
"""Functions and methods whose list nobody else has."""


class NoLoop(Exception):
    """A macro is not a loop, or not for certain."""


def require(holds: bool) -> None:
    """Raise NoLoop unless a condition holds."""
    if not holds:
        raise NoLoop


def parsed_python(python: str) -> ast.expr:
    """Return the tree of an expression; raise NoLoop if it is not one."""
    try:
        return ast.parse(python, mode="eval").body
    except (SyntaxError, ValueError):
        raise NoLoop from None


def source_of(python: str, node: ast.expr) -> str:
    """Return the text of a node of an expression."""
    return ast.get_source_segment(python, node) or ast.unparse(node)


def step_of(python: str, name: str) -> int:
    """Return what an expression adds to a name; 0 if it does anything else."""
    match parsed_python(python) if python else None:
        case ast.BinOp(ast.Name(own), ast.Add() | ast.Sub() as op, ast.Constant(int(step))):
            pass
        case ast.BinOp(ast.Constant(int(step)), ast.Add() as op, ast.Name(own)):
            pass
        case _:
            return 0
    return 0 if own != name else step if isinstance(op, ast.Add) else -step


def comparison_in(condition: ast.expr, steps: dict[str, int]) -> tuple[str, str, ast.expr | None]:
    """Return which counted name is compared, how, and with what; None is for zero."""
    match condition:
        case ast.Name(name):
            found: tuple[str, str, ast.expr | None] = name, "!=", None
        case ast.Compare(ast.Name(name), [op], [bound]) if steps.get(name):
            found = name, _COMPARED.get(type(op), ""), bound
        case ast.Compare(bound, [op], [ast.Name(name)]):
            found = name, _MIRRORED.get(_COMPARED.get(type(op), ""), ""), bound
        case _:
            raise NoLoop
    require(bool(steps.get(found[0]) and found[1]))
    return found


def moved_bound(source: str, bound: ast.expr, amount: int) -> str:
    """Return a bound plus or minus one."""
    match bound:
        case ast.Constant(int(value)):
            return str(value + amount)
        case ast.BinOp(_, ast.Sub() | ast.Add() as op, ast.Constant(1)):
            if isinstance(op, ast.Sub) == (amount == 1):
                return source.rpartition("-" if amount == 1 else "+")[0].strip()
    return f"{source} {'+' if amount == 1 else '-'} 1"


def range_of(name: str, stop: str, step: int, is_backwards: bool) -> str:
    """Return what counts from a name to `stop`, which is left out; or the other way round."""
    pieces = [name, stop] if step == 1 else [name, stop, str(step)]
    if is_backwards and step not in (1, -1):
        return f"reversed(range({', '.join(pieces)}))"
    if is_backwards:
        first = moved_bound(stop, parsed_python(stop), -step)
        pieces = [first, f"{name} + 1"] if step == -1 else [first, f"{name} - 1", "-1"]
    return f"range({', '.join(pieces)})"


def is_whole(text: str) -> bool:
    """Return whether a text is a whole number."""
    return not isinstance(guess_value(text), float)


def is_new_list(node: ast.expr) -> bool:
    """Return whether an expression makes a list of its own."""
    match node:
        case ast.List() | ast.ListComp() | ast.Subscript(_, ast.Slice()):
            return True
        case ast.Call(ast.Name(name) | ast.Attribute(_, name)):
            return name in _NEW_LISTS
        case ast.BinOp(left, ast.Add() | ast.Mult(), right):
            return is_new_list(left) or is_new_list(right)
    return False
