"""How safe mode rewrites expressions: what could reach further or take long calls a guard."""

from __future__ import annotations

import ast

from .rewriter import Rewriter, position_of, weight_of
from .syntax import LAZY, OPERATORS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from .rewriter import Handler


def _constant(self: Rewriter, node: ast.Constant) -> ast.AST:
    value = node.value
    kind = type(value)
    if kind is bytes:
        raise self.refused("a text of bytes", node)
    if kind is type(...):
        raise self.refused("`...`", node)
    if kind is int and value.bit_length() > self.limits.integer:  # type: ignore[union-attr]
        raise self.limits.passed(
            "integer", "this whole number is too large", position=position_of(node)
        )
    if kind not in (int, float, complex, str, bool, type(None)):
        raise self.refused(f"a constant of the type `{kind.__name__}`", node)
    return node


def _name(self: Rewriter, node: ast.Name) -> ast.AST:
    self.check_name(node.id, node)
    return node


def _attribute(self: Rewriter, node: ast.Attribute) -> ast.AST:
    owner = self.visit(node.value)
    if node.attr.startswith("_"):
        marks = "two underscores" if node.attr.startswith("__") else "an underscore"
        raise self.refused(f"an attribute that begins with {marks}", node)
    guard = "attribute_to_change" if self.is_statements else "attribute"
    return self.guard(guard, node, owner, self.constant(node.attr, node))


def _subscript(self: Rewriter, node: ast.Subscript) -> ast.AST:
    owner = self.visit(node.value)
    if type(node.slice) is ast.Slice:
        piece = node.slice
        bounds = [
            self.constant(None, node) if bound is None else self.visit(bound)
            for bound in (piece.lower, piece.upper, piece.step)
        ]
        return self.guard("piece", node, owner, *bounds)
    if has_slice(node):
        array = self.guard("block", node, owner)
        return ast.copy_location(ast.Subscript(array, slices(self, node.slice), node.ctx), node)
    index = self.visit(node.slice)
    if not _is_small(node.slice):
        return self.guard("item", node, owner, index)
    return ast.copy_location(ast.Subscript(owner, index, ast.Load()), node)


def _slice_within(self: Rewriter, node: ast.Slice) -> ast.AST:
    raise self.refused("a slice in several dimensions", node)


def has_slice(node: ast.Subscript) -> bool:
    """Return whether the index is a slice, or several of which one is."""
    parts = node.slice.elts if type(node.slice) is ast.Tuple else [node.slice]
    return any(type(part) is ast.Slice for part in parts)


def slices(self: Rewriter, node: ast.expr) -> ast.expr:
    """Return the index of an array, which may have a slice for each dimension.

    Only arrays may be given such an index; a dict could keep a slice as a key.
    """
    if type(node) is ast.Tuple:
        parts = [slices(self, part) for part in node.elts]
        return ast.copy_location(ast.Tuple(parts, node.ctx), node)
    if type(node) is not ast.Slice:
        return self.visit(node)  # type: ignore[no-any-return]
    bounds = self.visit_all([node.lower, node.upper, node.step])
    return ast.copy_location(ast.Slice(*bounds), node)


def _call(self: Rewriter, node: ast.Call) -> ast.AST:
    is_lazy = type(node.func) is ast.Name and node.func.id in LAZY and len(node.args) >= 1
    function = self.visit(node.func)
    arguments = [self.visit(argument) for argument in node.args]
    if is_lazy and type(node.args[0]) is ast.GeneratorExp:
        function = self.guard("lazy", node.func, function)
        arguments[0] = _generator(self, node.args[0])
    elif type(node.func) is not ast.Attribute:  # what that guard gives may be called
        function = self.guard("called", node.func, function)
    keywords = []
    for keyword in node.keywords:
        if keyword.arg is not None:
            self.check_name(keyword.arg, keyword)
            value = self.visit(keyword.value)
        else:
            value = self.guard("mapping", keyword.value, self.visit(keyword.value))
        keywords.append(ast.copy_location(ast.keyword(keyword.arg, value), keyword))
    return ast.copy_location(ast.Call(function, arguments, keywords), node)


def _starred(self: Rewriter, node: ast.Starred) -> ast.AST:
    value = self.guard("spread", node.value, self.visit(node.value))
    return ast.copy_location(ast.Starred(value, node.ctx), node)


def _binary(self: Rewriter, node: ast.BinOp) -> ast.AST:
    operator = type(node.op).__name__
    if operator not in OPERATORS:
        raise self.refused(f"`{operator}`", node)
    left, right = self.visit(node.left), self.visit(node.right)
    if operator == "Div" or _is_harmless(operator, node.left, node.right):
        return ast.copy_location(ast.BinOp(left, node.op, right), node)
    return self.guard(OPERATORS[operator], node, left, right)


def _is_harmless(operator: str, left: ast.expr, right: ast.expr) -> bool:
    """Return whether an operation can neither grow nor take long, as a constant in it shows.

    A sum or product with a decimal is neither a text nor a list nor a whole number.
    """
    if operator in ("Add", "Sub", "Mult", "Pow"):
        return _is_decimal(left) or _is_decimal(right)
    return operator in ("FloorDiv", "Mod") and _is_number(left)


def _is_number(node: ast.expr) -> bool:
    return type(node) is ast.Constant and type(node.value) in (int, float, complex)


def _is_decimal(node: ast.expr) -> bool:
    return type(node) is ast.Constant and type(node.value) in (float, complex)


def _is_small(node: ast.expr) -> bool:
    """Return whether a node is a constant, or a signed one, that is cheap to compare and hash."""
    if type(node) is ast.UnaryOp:
        node = node.operand
    if type(node) is not ast.Constant:
        return False
    return type(node.value) is str or (type(node.value) is int and node.value < 1 << 31)


def _unary(self: Rewriter, node: ast.UnaryOp) -> ast.AST:
    guard = {ast.USub: "neg", ast.Invert: "invert"}.get(type(node.op))
    if guard is not None and type(node.operand) is not ast.Constant:
        return self.guard(guard, node, self.visit(node.operand))
    return ast.copy_location(ast.UnaryOp(node.op, self.visit(node.operand)), node)


def _boolean(self: Rewriter, node: ast.BoolOp) -> ast.AST:
    return ast.copy_location(ast.BoolOp(node.op, self.visit_all(node.values)), node)


def _conditional(self: Rewriter, node: ast.IfExp) -> ast.AST:
    parts = self.visit(node.test), self.visit(node.body), self.visit(node.orelse)
    return ast.copy_location(ast.IfExp(*parts), node)


def _compare(self: Rewriter, node: ast.Compare) -> ast.AST:
    """Measure one side of each comparison: it goes no further than the smaller of the two."""
    sides = [node.left, *node.comparators]
    values = self.visit_all(sides)
    guards: list[str] = [""] * len(sides)
    for index, operator in enumerate(node.ops):
        left, right = sides[index], sides[index + 1]
        if type(operator) in (ast.In, ast.NotIn):
            guards[index] = guards[index] or ("" if _is_small(left) else "hashed")
            guards[index + 1] = "searched"
        elif type(operator) not in (ast.Is, ast.IsNot):
            if not (_is_small(left) or _is_small(right) or guards[index]):
                guards[index + 1] = "measured"
    for index, guard in enumerate(guards):
        if guard:
            values[index] = self.guard(guard, sides[index], values[index])
    return ast.copy_location(ast.Compare(values[0], node.ops, values[1:]), node)


def _list(self: Rewriter, node: ast.List) -> ast.AST:
    made = ast.copy_location(ast.List(self.visit_all(node.elts), node.ctx), node)
    return self.guard("display", node, made) if _has_star(node.elts) else made


def _tuple(self: Rewriter, node: ast.Tuple) -> ast.AST:
    made = ast.copy_location(ast.Tuple(self.visit_all(node.elts), node.ctx), node)
    return self.guard("display", node, made) if _has_star(node.elts) else made


def _set(self: Rewriter, node: ast.Set) -> ast.AST:
    items = ast.copy_location(ast.List(self.visit_all(node.elts), ast.Load()), node)
    return self.guard("set_of", node, items)


def _has_star(nodes: list[ast.expr]) -> bool:
    return any(type(node) is ast.Starred for node in nodes)


def _dict(self: Rewriter, node: ast.Dict) -> ast.AST:
    keys: list[ast.expr | None] = []
    values = []
    for key, value in zip(node.keys, node.values, strict=True):
        if key is None:
            keys.append(None)
            values.append(self.guard("mapping", value, self.visit(value)))
            continue
        made = self.visit(key)
        keys.append(made if _is_small(key) else self.guard("key", key, made))
        values.append(self.visit(value))
    whole = ast.copy_location(ast.Dict(keys, values), node)
    return self.guard("display", node, whole) if None in keys else whole


# --- texts with values in them -----------------------------------------------------------------


def _joined(self: Rewriter, node: ast.JoinedStr) -> ast.AST:
    outer = self.f_string
    self.f_string = outer or node
    parts = [self.visit(part) for part in node.values]
    self.f_string = outer
    return self.guard("join", node, *parts)


def _formatted(self: Rewriter, node: ast.FormattedValue) -> ast.AST:
    at = self.f_string or node
    value = self.visit(node.value)
    conversion = "" if node.conversion < 0 else chr(node.conversion)
    spec = self.constant("", at) if node.format_spec is None else self.visit(node.format_spec)
    return self.guard("formatted", at, value, self.constant(conversion, at), spec)


# --- comprehensions and lambdas ----------------------------------------------------------------


def _generator(self: Rewriter, node: Any, element: ast.expr | None = None) -> ast.expr:
    """Return a generator expression that counts its steps, for a guard to run to its end."""
    parts = [node.elt] if hasattr(node, "elt") else [node.key, node.value]
    if _has_star([part for part in parts if part is not None]) or None in parts:
        raise self.refused("unpacking in a comprehension", node)
    made = element or self.visit(parts[0])
    loops = []
    for index, loop in enumerate(node.generators):
        if loop.is_async:
            raise self.refused("`async`", node)
        inner = node.generators[index + 1 :]
        weight = weight_of(*loop.ifs, *parts) if not inner else 1 + weight_of(*loop.ifs)
        source = self.visit(loop.iter)
        each = self.guard("each", loop.iter, source, self.constant(1 + weight, loop.iter))
        ifs = self.visit_all(loop.ifs)
        loops.append(ast.comprehension(_loop_target(self, loop.target), each, ifs, 0))
    return ast.copy_location(ast.GeneratorExp(made, loops), node)


def _loop_target(self: Rewriter, node: ast.expr) -> Any:
    if type(node) is ast.Name:
        self.check_name(node.id, node)
        return node
    if type(node) is ast.Tuple or type(node) is ast.List:
        items = [_loop_target(self, item) for item in node.elts]
        return ast.copy_location(type(node)(items, node.ctx), node)
    raise self.refused("this kind of variable in a comprehension", node)


def _list_comprehension(self: Rewriter, node: ast.ListComp) -> ast.AST:
    return self.guard("list_of", node, _generator(self, node))


def _set_comprehension(self: Rewriter, node: ast.SetComp) -> ast.AST:
    items = self.guard("list_of", node, _generator(self, node))
    return self.guard("set_of", node, items)


def _generator_expression(self: Rewriter, node: ast.GeneratorExp) -> ast.AST:
    return self.guard("iterator_of", node, _generator(self, node))


def _dict_comprehension(self: Rewriter, node: ast.DictComp) -> ast.AST:
    if node.value is None:  # {**d for d in dicts}, from Python 3.15 on
        raise self.refused("unpacking in a comprehension", node)
    pair = ast.Tuple([self.visit(node.key), self.visit(node.value)], ast.Load())
    pairs = _generator(self, node, ast.copy_location(pair, node.key))
    return self.guard("dict_of", node, self.guard("list_of", node, pairs))


def _lambda(self: Rewriter, node: ast.Lambda) -> ast.AST:
    signature = node.args
    named = [*signature.posonlyargs, *signature.args, *signature.kwonlyargs]
    for argument in (*named, signature.vararg, signature.kwarg):
        if argument is not None:
            self.check_name(argument.arg, argument)
    arguments = ast.arguments(
        posonlyargs=signature.posonlyargs,
        args=signature.args,
        vararg=signature.vararg,
        kwonlyargs=signature.kwonlyargs,
        kw_defaults=self.visit_all(signature.kw_defaults),
        kwarg=signature.kwarg,
        defaults=self.visit_all(signature.defaults),
    )
    made = ast.copy_location(ast.Lambda(arguments, self.visit(node.body)), node)
    weight = self.constant(2 + weight_of(node.body), node)
    return self.guard("function", node, made, weight)


EXPRESSIONS: dict[str, Handler] = {
    "Attribute": _attribute,
    "BinOp": _binary,
    "BoolOp": _boolean,
    "Call": _call,
    "Compare": _compare,
    "Constant": _constant,
    "Dict": _dict,
    "DictComp": _dict_comprehension,
    "FormattedValue": _formatted,
    "GeneratorExp": _generator_expression,
    "IfExp": _conditional,
    "JoinedStr": _joined,
    "Lambda": _lambda,
    "List": _list,
    "ListComp": _list_comprehension,
    "Name": _name,
    "Set": _set,
    "SetComp": _set_comprehension,
    "Slice": _slice_within,
    "Starred": _starred,
    "Subscript": _subscript,
    "Tuple": _tuple,
    "UnaryOp": _unary,
}
"""What each allowed class of nodes in expressions becomes."""
