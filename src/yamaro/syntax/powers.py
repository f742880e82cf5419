"""Compiles Python in which `**` and `<<` make no numbers that fill the memory.

`10**10**10` is a mistake, or a bomb. Python works on it for days, and nothing can stop it
meanwhile. So where a text holds an operator that can do that, a call takes its place that looks at
how large the result would be. All else is compiled as it is, `x**2` among it, unless a limit is set
that is lower than the usual one.
"""

from __future__ import annotations

import operator

from ..diagnostics import InputFault
from ..policy import Limits

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType
    from typing import Any

_OPERATORS = ("Pow", "LShift")
_USUAL = Limits()


def compile_bounded(text: str, filename: str, mode: str, limits: Limits) -> CodeType:
    """Return what Python's `compile` does, with powers and shifts that keep to the limits."""
    if limits.integer >= _USUAL.integer and not _may_be_large(text):
        return compile(text, filename, mode, dont_inherit=True)
    from _ast import PyCF_ONLY_AST

    tree = compile(text, filename, mode, PyCF_ONLY_AST, dont_inherit=True)
    code = compile(_rewritten(tree), filename, mode, dont_inherit=True)
    return _bound(code, {_mark(name): _Bounded(name, limits) for name in _FUNCTIONS})


def _may_be_large(text: str) -> bool:
    """Return whether there is a `<<`, or a `**` whose exponent is not one small number."""
    if "<<" in text:
        return True
    at = text.find("**")
    while at >= 0:
        end = at + 2
        while text[end : end + 1] == " ":
            end += 1
        start = end
        while text[end : end + 1].isdigit():
            end += 1
        if not 0 < end - start <= 2 or text[end:].lstrip(" ")[:2] == "**":
            return True
        if text[end : end + 1] not in ("", " ", ")", "+", "-", "*", "/", ",", "]", "\n", "."):
            return True
        at = text.find("**", end)
    return False


def _rewritten(node: Any) -> Any:
    """Return a syntax tree with calls in place of the operators that can make large numbers."""
    from _ast import AST

    pending = [node]
    while pending:
        parent = pending.pop()
        for field in parent._fields:
            value = getattr(parent, field, None)
            items = value if isinstance(value, list) else [value]
            for index, item in enumerate(items):
                if not isinstance(item, AST):
                    continue
                made = _call_in_place_of(item)
                if made is not None:
                    item = made
                    if items is value:
                        items[index] = item
                    else:
                        setattr(parent, field, item)
                pending.append(item)
    return node


def _call_in_place_of(node: Any) -> Any:
    """Return what `a ** b`, or `a **= b` for a name, becomes; None for any other node."""
    from _ast import Assign, Attribute, AugAssign, BinOp, Call, Constant, Load, Name

    name = type(getattr(node, "op", None)).__name__
    if name not in _OPERATORS:
        return None
    place = {
        field: getattr(node, field)
        for field in ("lineno", "col_offset", "end_lineno", "end_col_offset")
    }

    def function(name: str) -> Any:
        return Attribute(Constant(_mark(name), None, **place), "call", Load(), **place)

    if type(node) is BinOp:
        return Call(function(name), [node.left, node.right], [], **place)
    if type(node) is AugAssign and type(node.target) is Name:
        read = Name(node.target.id, Load(), **place)
        changed = Call(function(f"{name}="), [read, node.value], [], **place)
        return Assign([node.target], changed, None, **place)
    return None


def _mark(name: str) -> bytes:
    """Return the placeholder of a function in code, until that is put there."""
    return b"\0" + name.encode()


def _bound(code: CodeType, functions: dict[bytes, _Bounded]) -> CodeType:
    """Return code with the functions where their marks stand."""
    constants = tuple(
        _bound(constant, functions)
        if isinstance(constant, type(code))
        else functions.get(constant, constant)
        if type(constant) is bytes
        else constant
        for constant in code.co_consts
    )
    return code.replace(co_consts=constants)


class _Bounded:
    """An operator that looks at how large its result would be."""

    __slots__ = ("_limits", "_measure", "_operate")

    def __init__(self, name: str, limits: Limits) -> None:
        self._operate = _FUNCTIONS[name]
        self._measure = _bits_of_power if name.startswith("Pow") else _bits_of_shift
        self._limits = limits

    def call(self, a: Any, b: Any) -> Any:
        """Return the result of the operator.

        Raises:
            InputFault: it would have too many bits.
        """
        if isinstance(a, int) and isinstance(b, int):
            bits = self._measure(a, b)
            if bits > self._limits.integer:
                raise _too_large(bits, self._limits)
        result = self._operate(a, b)
        if isinstance(result, int) and result.bit_length() > self._limits.integer:
            raise _too_large(result.bit_length(), self._limits)
        return result


_FUNCTIONS: dict[str, Callable[[Any, Any], Any]] = {
    "Pow": operator.pow,
    "Pow=": operator.ipow,
    "LShift": operator.lshift,
    "LShift=": operator.ilshift,
}


def _bits_of_power(base: int, exponent: int) -> int:
    """Return about how many bits a power has, and never more than it has."""
    return (abs(base).bit_length() - 1) * exponent


def _bits_of_shift(number: int, places: int) -> int:
    return number.bit_length() + places if number else 0


def _too_large(bits: int, limits: Limits) -> InputFault:
    shown = f"{bits:,}" if bits < 10**15 else "over a million thousand million"
    return InputFault(
        "limit-integer",
        f"this makes a whole number of {shown} bits; the limit is {limits.integer:,}",
        limits.hint("integer"),
    )
