"""The part of numpy that safe code may import: functions, and the methods of arrays.

Each call is checked first, and its cost counted. What is in no table of `numpy_functions.py` is
refused: numpy reads and writes files, loads libraries, calls functions that it is given, and shows
memory that nobody has filled. The rules, for people who write robots, are in docs/safety.md.
"""

from __future__ import annotations

import numpy as np

from .arithmetic import DIMENSIONS, Arithmetic
from .arrays import Array, Number, Whole
from .limits import RUN_IT, refused
from .methods import CHANGING, DATA, READING
from .numpy_functions import (
    FUNCTIONS,
    LINEAR_ALGEBRA,
    METHODS,
    METHODS_OF_NUMBERS,
    METHODS_THAT_CHANGE,
    each_number,
)
from .values import Module, a_type, function

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from .guards import Guards
    from .numpy_functions import Check, Given, Table


CONSTANTS = {
    "e": np.e,
    "euler_gamma": np.euler_gamma,
    "inf": np.inf,
    "nan": np.nan,
    "newaxis": None,
    "pi": np.pi,
}
TYPES = ("bool_", "complex128", "float64", "int64")

_CALL = 30  # steps, besides those of the table
_DTYPES = ("bool", "int", "float", "complex", *TYPES)
_TEXTS = frozenset(("fro", "nuc", "xy", "ij", "left", "right"))  # codespell:ignore fro
_LISTS = frozenset((list, tuple))
_OPERANDS = frozenset(
    (
        "A a a1 a2 a_max a_min ar arr b condition fill_value fp left m max min object p q right "
        "rtol atol start step stop v values weights x x1 x2 xi xp y"
    ).split()
)
"""Arguments that are numbers or arrays."""
_ROWS = frozenset(("arrays", "tup"))
"""Arguments that are lists of these."""


class Numpy(Arithmetic):
    """The stand-in for numpy in one conversion.

    Attributes:
        module: the names that a file sees.
    """

    def __init__(self, guards: Guards) -> None:
        super().__init__(guards)
        self._types: list[tuple[Any, str]] = [
            (named, kind.__name__)
            for named, kind in guards.types
            if kind.__name__ in ("bool", "int", "float")
        ]
        members: dict[str, Any] = {**CONSTANTS}
        for name in TYPES:
            members[name] = self._function(np, name, "x", each_number(), f"<class 'numpy.{name}'>")
            self._types.append((members[name], name))
        members |= self._functions(np, FUNCTIONS)
        members["linalg"] = Module("numpy.linalg", self._functions(np.linalg, LINEAR_ALGEBRA))
        self.module = Module("numpy", members)

    def _functions(self, module: Any, table: Table) -> dict[str, Any]:
        """Return the functions of a table, except those that the installed numpy lacks."""
        return {
            name: self._function(module, name, parameters, check, f"<function {name}>")
            for name, (parameters, check) in table.items()
            if hasattr(module, name)
        }

    def _function(
        self, module: Any, name: str, parameters: str, check: Check, shown: str
    ) -> Callable[..., Any]:
        call = getattr(module, name)
        return function(self.call, shown, call, name, _split(parameters), check, {})

    def call(
        self,
        call: Callable[..., Any],
        name: str,
        parameters: tuple[list[str], frozenset[str]],
        check: Check,
        given: Given,
        /,
        *args: Any,
        **named: Any,
    ) -> Any:
        """Call a function of numpy's with arguments that it may be given.

        Args:
            call: the function.
            name: the name it has in numpy.
            parameters: those that may be given in order, and all of them.
            check: counts what it costs.
            given: arguments in front of the others.
            args: in order.
            named: by name.
        """
        given = dict(given)
        in_order, known = parameters
        free = in_order[len(given) :]
        if in_order[-1] == "xi":
            args = (args,)
        elif len(args) > len(free):
            raise refused(f"calling `{name}` with so many arguments", "the rest is not checked")
        for parameter, value in zip(free, args, strict=False):
            given[parameter] = self._argument(parameter, value)
        count = len(given)
        for parameter, value in named.items():
            if parameter in given:
                raise TypeError(f"{name}() got multiple values for argument '{parameter}'")
            if parameter not in known:
                raise refused(f"the argument `{parameter}` of `{name}`")
            given[parameter] = self._argument(parameter, value)
        self.guards.charge(_CALL)
        check(self, given)
        ordered = list(given.values())[:count]
        if in_order[-1] == "xi":
            ordered = ordered[0]
        return self.run(call, *ordered, **{name: given[name] for name in list(given)[count:]})

    # --- arguments ---

    def _argument(self, parameter: str, value: Any) -> Any:
        if parameter == "object":
            return self.rows(value)
        if parameter == "xi":
            return list(map(self.operand, value))
        if parameter in _OPERANDS:
            return None if value is None else self.operand(value)
        if parameter in _ROWS:
            is_list = type(value) in _LISTS
            return list(map(self.operand, value)) if is_list else self.operand(value)
        if parameter == "dtype":
            return self.dtype(value)
        if parameter == "decimals":
            return self.digits(value)
        return _setting(value)

    def dtype(self, value: Any) -> Any:
        """Return the type of numbers that a file asks for.

        Raises:
            SafetyError: it is not one of the few allowed.
        """
        if value is None:
            return None
        for named, name in self._types:
            if value is named:
                return np.dtype(name.rstrip("_"))
        if type(value) is str and value in _DTYPES:
            return np.dtype(value.rstrip("_"))
        raise refused("this `dtype`", hint="write float, int, bool, or numpy.complex128")


def numpy_of(guards: Guards) -> Numpy:
    """Return the stand-in for numpy in one conversion."""
    if guards.numpy is None:
        guards.numpy = Numpy(guards)
    return guards.numpy


def _split(parameters: str) -> tuple[list[str], frozenset[str]]:
    """Return the parameters that may be given in order, and all that may be given."""
    in_order, _, others = parameters.partition(" | ")
    return in_order.split(), frozenset(in_order.split() + others.split())


def _setting(value: Any, depth: int = 0) -> Any:
    """Return an argument that is not an array: an axis, a shape, a truth value."""
    kind = type(value)
    if value is None or kind is bool or kind is float:
        return value
    if kind is int and value.bit_length() < 64:
        return value
    if kind is Whole:
        return int(value.data)
    if kind is Number:
        return value.data
    if kind in _LISTS and depth == 0 and len(value) <= 2 * DIMENSIONS:
        return kind(_setting(item, 1) for item in value)
    if kind is str and value in _TEXTS:
        return value
    raise refused(f"{a_type(value)} as this argument", hint=RUN_IT)


# --- methods of arrays and numbers ------------------------------------------------------------


def _method(name: str, parameters: str, check: Check) -> Callable[..., Any]:
    split = _split(parameters)

    def call(data: Any, /, *args: Any, **named: Any) -> Any:
        return getattr(data, name)(*args, **named)

    def run(guards: Guards, owner: Any, /, *args: Any, **named: Any) -> Any:
        numpy: Numpy = owner.arithmetic
        return numpy.call(call, name, split, check, {"a": owner.data}, *args, **named)

    return run


def _of_axes(name: str) -> Callable[..., Any]:
    """Return a method that takes its numbers one by one, or as one tuple."""

    def run(guards: Guards, owner: Any, /, *numbers: Any) -> Any:
        numpy: Numpy = owner.arithmetic
        numpy.charge(owner.data.shape)
        asked = (_setting(numbers[0]),) if len(numbers) == 1 else _setting(numbers)
        return numpy.run(getattr(owner.data, name), *asked)

    return run


def _methods(table: Table) -> dict[str, Callable[..., Any]]:
    return {
        name: _method(name, parameters, check)
        for name, (parameters, check) in table.items()
        if hasattr(np.ndarray, name) or table is METHODS_OF_NUMBERS
    }


READING[Array] = _methods(METHODS) | {name: _of_axes(name) for name in ("reshape", "transpose")}
READING[Number] = READING[Whole] = READING[Array] | _methods(METHODS_OF_NUMBERS)
CHANGING[Array] = _methods(METHODS_THAT_CHANGE)
for _kind in (Array, Number, Whole):
    DATA[_kind] = frozenset(("T", "imag", "ndim", "real", "shape", "size"))
