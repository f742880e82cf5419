"""Which classes of Python's syntax safe mode refuses, and the words of its messages.

What is in none of these tables and has no rewriting (`code.HANDLERS`) is refused too, so a new
version of Python brings nothing in.
"""

from __future__ import annotations

from .limits import RUN_IT

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
