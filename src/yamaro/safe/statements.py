"""How safe mode rewrites statements: assignments call guards, `raise` and `assert` are narrowed."""

from __future__ import annotations

import ast

from .expressions import has_slice, slices
from .rewriter import Rewriter
from .syntax import OPERATORS, RAISED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from .rewriter import Handler


def _expression(self: Rewriter, node: ast.Expression) -> ast.AST:
    return ast.Expression(self.visit(node.body))


def _module(self: Rewriter, node: ast.Module) -> ast.AST:
    return ast.Module(self.visit_all(node.body), [])


def _expression_statement(self: Rewriter, node: ast.Expr) -> ast.AST:
    return ast.copy_location(ast.Expr(self.visit(node.value)), node)


def _pass(self: Rewriter, node: ast.Pass) -> ast.AST:
    return node


def _assign(self: Rewriter, node: ast.Assign) -> ast.AST:
    value = self.visit(node.value)
    if any(type(inner) is ast.Starred for target in node.targets for inner in ast.walk(target)):
        value = self.guard("spread", node.value, value)
    targets = [_target(self, target) for target in node.targets]
    return ast.copy_location(ast.Assign(targets, value), node)


def _augmented_assign(self: Rewriter, node: ast.AugAssign) -> ast.AST:
    operator = type(node.op).__name__
    if operator not in OPERATORS:
        raise self.refused(f"`{operator}`", node)
    name = self.constant(f"i{OPERATORS[operator]}", node)
    value = self.visit(node.value)
    target = node.target
    if type(target) is ast.Name:
        self.check_name(target.id, target)
        read = ast.copy_location(ast.Name(target.id, ast.Load()), target)
        changed = self.guard("change", node, name, read, value)
        return ast.copy_location(ast.Assign([_target(self, target)], changed), node)
    if type(target) is not ast.Subscript:
        raise self.refused("this kind of assignment", target)
    if has_slice(target):
        owner, key = self.visit(target.value), slices(self, target.slice)
        changed = self.guard("change_block", target, name, owner, key, value)
    else:
        owner, key = self.visit(target.value), self.visit(target.slice)
        changed = self.guard("change_item", node, name, owner, key, value)
    return ast.copy_location(ast.Expr(changed), node)


def _target(self: Rewriter, node: ast.AST) -> Any:
    """Return what is assigned to: names, items of lists and dicts, and rows of these."""
    if type(node) is ast.Name:
        self.check_name(node.id, node)
        return node
    if type(node) is ast.Starred:
        return ast.copy_location(ast.Starred(_target(self, node.value), node.ctx), node)
    if type(node) is ast.Tuple or type(node) is ast.List:
        items = [_target(self, item) for item in node.elts]
        return ast.copy_location(type(node)(items, node.ctx), node)
    if type(node) is ast.Subscript and has_slice(node):
        owner = self.guard("array_to_change", node, self.visit(node.value))
        return ast.copy_location(ast.Subscript(owner, slices(self, node.slice), node.ctx), node)
    if type(node) is ast.Subscript:
        owner = self.guard("owner", node.value, self.visit(node.value))
        key = self.guard("stored_key", node.slice, self.visit(node.slice))
        return ast.copy_location(ast.Subscript(owner, key, node.ctx), node)
    if type(node) is ast.Attribute:
        raise self.refused("an assignment to an attribute", node)
    raise self.refused("this kind of assignment", node)


def _raise(self: Rewriter, node: ast.Raise) -> ast.AST:
    made = node.exc
    hint = "write raise ValueError('what is wrong')"
    if type(made) is not ast.Call or type(made.func) is not ast.Name or node.cause is not None:
        raise self.refused("this kind of `raise`", node, hint=hint)
    if made.func.id not in RAISED or len(made.args) != 1 or made.keywords:
        raise self.refused(f"raising `{made.func.id}`", made, hint=hint)
    name = self.constant(made.func.id, made)
    error = self.guard("error", made, name, self.visit(made.args[0]))
    return ast.copy_location(ast.Raise(error, None), node)


def _assert(self: Rewriter, node: ast.Assert) -> ast.AST:
    message = node.msg and self.guard("text", node.msg, self.visit(node.msg))
    return ast.copy_location(ast.Assert(self.visit(node.test), message), node)


STATEMENTS: dict[str, Handler] = {
    "Assert": _assert,
    "Assign": _assign,
    "AugAssign": _augmented_assign,
    "Expr": _expression_statement,
    "Expression": _expression,
    "Module": _module,
    "Pass": _pass,
    "Raise": _raise,
}
"""What each allowed class of statements, and of roots of a tree, becomes."""
