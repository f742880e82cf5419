"""The arrays and numbers of numpy that safe code holds: wrappers with operators that count steps.

A file never holds an object of numpy's own: these reach files, memory and other modules by their
attributes, and a product of two of them may fill the memory. All operators of the wrappers are
here, and `Arithmetic` runs them. So this holds wherever Python computes or compares on its own, in
lists within lists too.
"""

from __future__ import annotations

import operator
from math import trunc

import numpy as np

from .values import Foreign

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from .arithmetic import Arithmetic

ARRAY_STEPS = 40
"""Steps of an operation on arrays, besides those for their numbers."""

_ITEM = 12
_WRITTEN = 30  # steps to write a number of an array, and twenty times that for an array
_SHOWN = 1000  # longer arrays are shown by their ends


class Value(Foreign):
    """What arrays and numbers have in common."""

    __slots__ = ("arithmetic", "data")
    __array_ufunc__ = None  # numpy's own objects leave operators to us
    data: Any

    def __init__(self, data: Any, arithmetic: Arithmetic) -> None:
        self.data = data
        self.arithmetic = arithmetic

    def of_its_kind(self, value: Any) -> Any:
        """Return the wrapper of a value of numpy's."""
        return self.arithmetic.wrap(value)

    def __neg__(self) -> Any:
        return self._changed(operator.neg)

    def __pos__(self) -> Any:
        return self._changed(operator.pos)

    def __abs__(self) -> Any:
        return self._changed(operator.abs)

    def __invert__(self) -> Any:
        return self._changed(operator.invert)

    def _changed(self, operation: Callable[[Any], Any]) -> Any:
        self.arithmetic.charge(self.data.shape)
        return self.arithmetic.run(operation, self.data)

    def __bool__(self) -> bool:
        return bool(self.data)

    def __int__(self) -> int:
        return int(self.data)

    def __float__(self) -> float:
        return float(self.data)

    def __repr__(self) -> str:
        self._charge_text()
        return repr(self.data)

    def __str__(self) -> str:
        self._charge_text()
        return str(self.data)

    def __format__(self, spec: str) -> str:
        self._charge_text()
        return format(self.data, spec)

    def _charge_text(self) -> None:
        numbers = min(self.data.size, _SHOWN) + (20 if self.data.ndim else 0)
        self.arithmetic.guards.charge(numbers * _WRITTEN)

    def tolist(self) -> Any:
        """Return the Python number, or the lists of numbers, with the same value."""
        self.arithmetic.charge_lists(self.data.shape)
        return self.data.tolist()

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of items in each dimension."""
        return tuple(map(int, self.data.shape))

    @property
    def size(self) -> int:
        """How many numbers there are."""
        return int(self.data.size)

    @property
    def ndim(self) -> int:
        """How many dimensions there are."""
        return int(self.data.ndim)

    @property
    def T(self) -> Any:
        """The array with its axes reversed."""
        return self.arithmetic.wrap(self.data.T)

    @property
    def real(self) -> Any:
        """The real part."""
        return self.arithmetic.wrap(self.data.real)

    @property
    def imag(self) -> Any:
        """The imaginary part, which of real numbers is a new array."""
        self.arithmetic.charge(self.data.shape)
        return self.arithmetic.wrap(self.data.imag)


class Number(Value):
    """A number of numpy's: a decimal, a complex number or a truth value."""

    __slots__ = ()

    def __hash__(self) -> int:
        return hash(self.data)

    def __round__(self, ndigits: Any = None) -> Any:
        return self.arithmetic.run(round, self.data, self.arithmetic.digits(ndigits))

    def __trunc__(self) -> Any:
        return self.arithmetic.run(trunc, self.data)

    def __divmod__(self, other: Any) -> Any:
        return self.arithmetic.operate("divmod", divmod, self, other)

    def __rdivmod__(self, other: Any) -> Any:
        return self.arithmetic.operate("divmod", divmod, other, self)


class Whole(Number):
    """A whole number of numpy's."""

    __slots__ = ()

    def __index__(self) -> int:
        return operator.index(self.data)


class Array(Value):
    """An array of numpy's."""

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]

    def __index__(self) -> int:
        return operator.index(self.data)

    def __len__(self) -> int:
        return len(self.data)

    def __iter__(self) -> Iterator[Any]:
        return self._each(iter(self.data))

    def _each(self, items: Iterator[Any]) -> Iterator[Any]:
        for item in items:
            self.arithmetic.guards.charge(_ITEM)
            yield self.arithmetic.wrap(item)

    def __contains__(self, value: Any) -> bool:
        return bool(self.arithmetic.run(np.any, (self == value).data).data)

    def __divmod__(self, other: Any) -> Any:
        return self.arithmetic.operate("divmod", divmod, self, other)

    def __rdivmod__(self, other: Any) -> Any:
        return self.arithmetic.operate("divmod", divmod, other, self)

    def __getitem__(self, key: Any) -> Any:
        self.arithmetic.guards.charge(_ITEM)
        index, _ = self.arithmetic.index(key, self.data.shape)
        return self.arithmetic.wrap(self.data[index])

    def __setitem__(self, key: Any, value: Any) -> None:
        index, size = self.arithmetic.index(key, self.data.shape)
        self.arithmetic.guards.charge(ARRAY_STEPS + size)
        self.data[index] = self.arithmetic.rows(value)


# --- operators of two operands ------------------------------------------------------------------

_ARITHMETIC = "add sub mul truediv floordiv mod pow lshift rshift and or xor matmul".split()
_COMPARISONS = "eq ne lt le gt ge".split()


def _operation(name: str) -> Callable[..., Any]:
    found: Callable[..., Any] = getattr(operator, f"__{name}__")
    return found


def _forward(name: str) -> Callable[..., Any]:
    operation = _operation(name)

    def run(self: Value, other: Any) -> Any:
        return self.arithmetic.operate(name, operation, self, other)

    return run


def _reflected(name: str) -> Callable[..., Any]:
    operation = _operation(name)

    def run(self: Value, other: Any) -> Any:
        return self.arithmetic.operate(name, operation, other, self)

    return run


def _in_place(name: str) -> Callable[..., Any]:
    operation = _operation(name)

    def run(self: Array, other: Any) -> Any:
        made = self.arithmetic.operate(name, operation, self, other)
        return self if isinstance(made, Array) and made.data is self.data else made

    return run


for _name in _ARITHMETIC:
    setattr(Value, f"__{_name}__", _forward(_name))
    setattr(Value, f"__r{_name}__", _reflected(_name))
    setattr(Array, f"__i{_name}__", _in_place(f"i{_name}"))
for _name in _COMPARISONS:
    setattr(Value, f"__{_name}__", _forward(_name))
for _kind in (Array, Number, Whole):
    _kind.__module__ = "numpy"  # what writes them looks for objects of numpy
