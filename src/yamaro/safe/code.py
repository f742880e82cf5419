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

from .limits import RUN_IT, SafeLimits, SafetyError, refused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import CodeType
    from typing import Any

    Position = tuple[int, int, int, int]


# --- syntax -----------------------------------------------------------------------------------


HELPER_NAMES = frozenset(("__find__", "__env__"))
"""What `$(find package)` and `$(env NAME)` call."""

RAISED = frozenset(("Exception", "NotImplementedError", "RuntimeError", "TypeError", "ValueError"))
"""The errors that `raise` may end a run with."""

LAZY = frozenset(("all", "any", "next"))
"""Functions that do not have to go through all of a generator expression."""

ABSTRACT = frozenset(
    (
        "AST boolop cmpop excepthandler expr expr_context mod operator pattern slice stmt "
        "type_ignore type_param unaryop"
    ).split()
)
"""Base classes of syntax nodes; no tree holds one."""

GONE = frozenset(
    "AugLoad AugStore Bytes Ellipsis ExtSlice Index NameConstant Num Param Str Suite".split()
)
"""Classes of Python 2 and early 3 that the parser does not make any more."""

REFUSED = {
    "AnnAssign": "an assignment with a type",
    "AsyncFor": "`async`",
    "AsyncFunctionDef": "`async`",
    "AsyncWith": "`async`",
    "Await": "`await`",
    "Break": "a loop",
    "ClassDef": "a class definition",
    "Continue": "a loop",
    "Del": "`del`",
    "Delete": "`del`",
    "ExceptHandler": "`except`",
    "For": "a `for` statement",
    "FunctionDef": "a function definition",
    "FunctionType": "a type comment",
    "Global": "`global`",
    "If": "an `if` statement",
    "Import": "an import",
    "ImportFrom": "an import",
    "Interactive": "an interactive statement",
    "Interpolation": "a template string",
    "Match": "a `match` statement",
    "MatchAs": "a `match` statement",
    "MatchClass": "a `match` statement",
    "MatchMapping": "a `match` statement",
    "MatchOr": "a `match` statement",
    "MatchSequence": "a `match` statement",
    "MatchSingleton": "a `match` statement",
    "MatchStar": "a `match` statement",
    "MatchValue": "a `match` statement",
    "NamedExpr": "the operator `:=`",
    "Nonlocal": "`nonlocal`",
    "ParamSpec": "a type parameter",
    "Return": "`return`",
    "TemplateStr": "a template string",
    "Try": "a `try` statement",
    "TryStar": "a `try` statement",
    "TypeAlias": "a type definition",
    "TypeIgnore": "a type comment",
    "TypeVar": "a type parameter",
    "TypeVarTuple": "a type parameter",
    "While": "a `while` loop",
    "With": "a `with` statement",
    "Yield": "`yield`",
    "YieldFrom": "`yield`",
    "match_case": "a `match` statement",
    "withitem": "a `with` statement",
}
"""Classes of nodes that are refused, with the words that name them in the message."""

HINTS = {
    "ClassDef": RUN_IT,
    "For": f"use `for:` outside of `process`, or a list in it, [… for x in …]; {RUN_IT}",
    "FunctionDef": f"write a lambda: f = lambda x: 2 * x; {RUN_IT}",
    "If": f"use `if:` outside of `process`, or a value: x = 1 if big else 2; {RUN_IT}",
    "Import": "list modules at the root of the file: import: [math]",
    "ImportFrom": "list modules at the root of the file: import: [math]",
    "NamedExpr": "declare the value as a variable first",
    "While": f"use `for:` outside of `process`; {RUN_IT}",
}

OPERATORS = {
    "Add": "add",
    "BitAnd": "bit_and",
    "BitOr": "bit_or",
    "BitXor": "bit_xor",
    "Div": "div",
    "FloorDiv": "floordiv",
    "LShift": "lshift",
    "MatMult": "matmul",
    "Mod": "mod",
    "Mult": "mul",
    "Pow": "pow",
    "RShift": "rshift",
    "Sub": "sub",
}
"""The guard of each operator."""

SYMBOLS = frozenset(
    (
        "And Or Not Invert UAdd USub Eq NotEq Lt LtE Gt GtE Is IsNot In NotIn Load Store "
        "alias arg arguments comprehension keyword"
    ).split()
)
"""Classes that are allowed where a handler meets them, and are not rewritten on their own."""


# --- rewriter ---------------------------------------------------------------------------------


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

    For each class of nodes that is allowed, a method `visit_…` returns what a node becomes; a class
    without one is refused.

    Attributes:
        limits: how large constants may be.
        is_statements: whether methods that change their object are allowed.
    """

    def __init__(self, limits: SafeLimits, *, is_statements: bool) -> None:
        self.limits = limits
        self.is_statements = is_statements
        self.nearest: ast.AST | None = None  # with a position: the node visited, or one around it
        self.f_string: ast.AST | None = None  # the one around it: before 3.12 places in it are off

    def visit(self, node: Any) -> Any:
        """Return what a node becomes."""
        name = type(node).__name__
        visitor = None
        if type(node).__module__ in ("ast", "_ast"):
            visitor = getattr(self, f"visit_{name}", None)
        around = self.nearest
        if hasattr(node, "lineno"):
            self.nearest = node
        if visitor is None:
            words = REFUSED.get(name, f"`{name}`")
            raise self.refused(words, node, hint=HINTS.get(name, RUN_IT))
        result = visitor(node)
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

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
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

    def visit_Name(self, node: ast.Name) -> ast.AST:
        self.check_name(node.id, node)
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        owner = self.visit(node.value)
        if node.attr.startswith("_"):
            marks = "two underscores" if node.attr.startswith("__") else "an underscore"
            raise self.refused(f"an attribute that begins with {marks}", node)
        guard = "attribute_to_change" if self.is_statements else "attribute"
        return self.guard(guard, node, owner, self.constant(node.attr, node))

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
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
            return ast.copy_location(ast.Subscript(array, self.slices(node.slice), node.ctx), node)
        index = self.visit(node.slice)
        if not _is_small(node.slice):
            return self.guard("item", node, owner, index)
        return ast.copy_location(ast.Subscript(owner, index, ast.Load()), node)

    def visit_Slice(self, node: ast.Slice) -> ast.AST:
        raise self.refused("a slice in several dimensions", node)

    def slices(self, node: ast.expr) -> ast.expr:
        """Return the index of an array, which may have a slice for each dimension.

        Only arrays may be given such an index; a dict could keep a slice as a key.
        """
        if type(node) is ast.Tuple:
            parts = [self.slices(part) for part in node.elts]
            return ast.copy_location(ast.Tuple(parts, node.ctx), node)
        if type(node) is not ast.Slice:
            return self.visit(node)  # type: ignore[no-any-return]
        bounds = self.visit_all([node.lower, node.upper, node.step])
        return ast.copy_location(ast.Slice(*bounds), node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        is_lazy = type(node.func) is ast.Name and node.func.id in LAZY and len(node.args) >= 1
        function = self.visit(node.func)
        arguments = [self.visit(argument) for argument in node.args]
        if is_lazy and type(node.args[0]) is ast.GeneratorExp:
            function = self.guard("lazy", node.func, function)
            arguments[0] = self._generator(node.args[0])
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

    def visit_Starred(self, node: ast.Starred) -> ast.AST:
        value = self.guard("spread", node.value, self.visit(node.value))
        return ast.copy_location(ast.Starred(value, node.ctx), node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        operator = type(node.op).__name__
        if operator not in OPERATORS:
            raise self.refused(f"`{operator}`", node)
        left, right = self.visit(node.left), self.visit(node.right)
        if operator == "Div" or _is_harmless(operator, node.left, node.right):
            return ast.copy_location(ast.BinOp(left, node.op, right), node)
        return self.guard(OPERATORS[operator], node, left, right)

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        guard = {ast.USub: "neg", ast.Invert: "invert"}.get(type(node.op))
        if guard is not None and type(node.operand) is not ast.Constant:
            return self.guard(guard, node, self.visit(node.operand))
        return ast.copy_location(ast.UnaryOp(node.op, self.visit(node.operand)), node)

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        return ast.copy_location(ast.BoolOp(node.op, self.visit_all(node.values)), node)

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        parts = self.visit(node.test), self.visit(node.body), self.visit(node.orelse)
        return ast.copy_location(ast.IfExp(*parts), node)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
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

    def visit_List(self, node: ast.List) -> ast.AST:
        made = ast.copy_location(ast.List(self.visit_all(node.elts), node.ctx), node)
        return self.guard("display", node, made) if _has_star(node.elts) else made

    def visit_Tuple(self, node: ast.Tuple) -> ast.AST:
        made = ast.copy_location(ast.Tuple(self.visit_all(node.elts), node.ctx), node)
        return self.guard("display", node, made) if _has_star(node.elts) else made

    def visit_Set(self, node: ast.Set) -> ast.AST:
        items = ast.copy_location(ast.List(self.visit_all(node.elts), ast.Load()), node)
        return self.guard("set_of", node, items)

    def visit_Dict(self, node: ast.Dict) -> ast.AST:
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

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.AST:
        outer = self.f_string
        self.f_string = outer or node
        parts = [self.visit(part) for part in node.values]
        self.f_string = outer
        return self.guard("join", node, *parts)

    def visit_FormattedValue(self, node: ast.FormattedValue) -> ast.AST:
        at = self.f_string or node
        value = self.visit(node.value)
        conversion = "" if node.conversion < 0 else chr(node.conversion)
        spec = self.constant("", at) if node.format_spec is None else self.visit(node.format_spec)
        return self.guard("formatted", at, value, self.constant(conversion, at), spec)

    def _generator(self, node: Any, element: ast.expr | None = None) -> ast.expr:
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
            loops.append(ast.comprehension(self._loop_target(loop.target), each, ifs, 0))
        return ast.copy_location(ast.GeneratorExp(made, loops), node)

    def _loop_target(self, node: ast.expr) -> Any:
        if type(node) is ast.Name:
            self.check_name(node.id, node)
            return node
        if type(node) is ast.Tuple or type(node) is ast.List:
            items = [self._loop_target(item) for item in node.elts]
            return ast.copy_location(type(node)(items, node.ctx), node)
        raise self.refused("this kind of variable in a comprehension", node)

    def visit_ListComp(self, node: ast.ListComp) -> ast.AST:
        return self.guard("list_of", node, self._generator(node))

    def visit_SetComp(self, node: ast.SetComp) -> ast.AST:
        items = self.guard("list_of", node, self._generator(node))
        return self.guard("set_of", node, items)

    def visit_GeneratorExp(self, node: ast.GeneratorExp) -> ast.AST:
        return self.guard("iterator_of", node, self._generator(node))

    def visit_DictComp(self, node: ast.DictComp) -> ast.AST:
        if node.value is None:  # {**d for d in dicts}, from Python 3.15 on
            raise self.refused("unpacking in a comprehension", node)
        pair = ast.Tuple([self.visit(node.key), self.visit(node.value)], ast.Load())
        pairs = self._generator(node, ast.copy_location(pair, node.key))
        return self.guard("dict_of", node, self.guard("list_of", node, pairs))

    def visit_Lambda(self, node: ast.Lambda) -> ast.AST:
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

    def visit_Expression(self, node: ast.Expression) -> ast.AST:
        return ast.Expression(self.visit(node.body))

    def visit_Module(self, node: ast.Module) -> ast.AST:
        return ast.Module(self.visit_all(node.body), [])

    def visit_Expr(self, node: ast.Expr) -> ast.AST:
        return ast.copy_location(ast.Expr(self.visit(node.value)), node)

    def visit_Pass(self, node: ast.Pass) -> ast.AST:
        return node

    def visit_Assign(self, node: ast.Assign) -> ast.AST:
        value = self.visit(node.value)
        if any(type(inner) is ast.Starred for target in node.targets for inner in ast.walk(target)):
            value = self.guard("spread", node.value, value)
        targets = [self._target(target) for target in node.targets]
        return ast.copy_location(ast.Assign(targets, value), node)

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
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
            return ast.copy_location(ast.Assign([self._target(target)], changed), node)
        if type(target) is not ast.Subscript:
            raise self.refused("this kind of assignment", target)
        if has_slice(target):
            owner, key = self.visit(target.value), self.slices(target.slice)
            changed = self.guard("change_block", target, name, owner, key, value)
        else:
            owner, key = self.visit(target.value), self.visit(target.slice)
            changed = self.guard("change_item", node, name, owner, key, value)
        return ast.copy_location(ast.Expr(changed), node)

    def _target(self, node: ast.AST) -> Any:
        """Return what is assigned to: names, items of lists and dicts, and rows of these."""
        if type(node) is ast.Name:
            self.check_name(node.id, node)
            return node
        if type(node) is ast.Starred:
            return ast.copy_location(ast.Starred(self._target(node.value), node.ctx), node)
        if type(node) is ast.Tuple or type(node) is ast.List:
            items = [self._target(item) for item in node.elts]
            return ast.copy_location(type(node)(items, node.ctx), node)
        if type(node) is ast.Subscript and has_slice(node):
            owner = self.guard("array_to_change", node, self.visit(node.value))
            return ast.copy_location(ast.Subscript(owner, self.slices(node.slice), node.ctx), node)
        if type(node) is ast.Subscript:
            owner = self.guard("owner", node.value, self.visit(node.value))
            key = self.guard("stored_key", node.slice, self.visit(node.slice))
            return ast.copy_location(ast.Subscript(owner, key, node.ctx), node)
        if type(node) is ast.Attribute:
            raise self.refused("an assignment to an attribute", node)
        raise self.refused("this kind of assignment", node)

    def visit_Raise(self, node: ast.Raise) -> ast.AST:
        made = node.exc
        hint = "write raise ValueError('what is wrong')"
        if type(made) is not ast.Call or type(made.func) is not ast.Name or node.cause is not None:
            raise self.refused("this kind of `raise`", node, hint=hint)
        if made.func.id not in RAISED or len(made.args) != 1 or made.keywords:
            raise self.refused(f"raising `{made.func.id}`", made, hint=hint)
        name = self.constant(made.func.id, made)
        error = self.guard("error", made, name, self.visit(made.args[0]))
        return ast.copy_location(ast.Raise(error, None), node)

    def visit_Assert(self, node: ast.Assert) -> ast.AST:
        message = node.msg and self.guard("text", node.msg, self.visit(node.msg))
        return ast.copy_location(ast.Assert(self.visit(node.test), message), node)


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


# --- what expressions are ----------------------------------------------------------------------


def has_slice(node: ast.Subscript) -> bool:
    """Return whether the index is a slice, or several of which one is."""
    parts = node.slice.elts if type(node.slice) is ast.Tuple else [node.slice]
    return any(type(part) is ast.Slice for part in parts)


def _is_harmless(operator: str, left: ast.expr, right: ast.expr) -> bool:
    """Return whether an operation can neither grow nor take long, as a constant in it shows.

    A sum or product with a decimal is neither a text nor a list nor a whole number.
    """
    if operator in ("Add", "Sub", "Mult", "Pow"):
        return _is_decimal(left) or _is_decimal(right)
    is_number = type(left) is ast.Constant and type(left.value) in (int, float, complex)
    return operator in ("FloorDiv", "Mod") and is_number


def _is_decimal(node: ast.expr) -> bool:
    return type(node) is ast.Constant and type(node.value) in (float, complex)


def _is_small(node: ast.expr) -> bool:
    """Return whether a node is a constant, or a signed one, that is cheap to compare and hash."""
    if type(node) is ast.UnaryOp:
        node = node.operand
    if type(node) is not ast.Constant:
        return False
    return type(node.value) is str or (type(node.value) is int and node.value < 1 << 31)


def _has_star(nodes: list[ast.expr]) -> bool:
    return any(type(node) is ast.Starred for node in nodes)


# --- compiling ----------------------------------------------------------------------------------


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
    # How many nodes the tree has, and how deep it is, before anything recurses over it.
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
    rewritten = Rewriter(limits, is_statements=mode == "exec").visit(tree)
    return compile(rewritten, filename, mode, dont_inherit=True)


def classify(node_class: type) -> str:
    """Return whether a class of syntax nodes is "allowed", "refused", "abstract" or "unknown"."""
    name = node_class.__name__
    if hasattr(Rewriter, f"visit_{name}") or name in SYMBOLS or name in OPERATORS:
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
