"""The arrays and numbers of numpy that safe code holds: wrappers with operators that count steps.

A file never holds an object of numpy's own: these reach files, memory and other modules by their
attributes, and a product of two of them may fill the memory. All operators of the wrappers are
here, and `Arithmetic` runs them. So this holds wherever Python computes or compares on its own, in
lists within lists too.
"""

from __future__ import annotations

import operator
import sys
import warnings
from math import trunc

import numpy as np

from .limits import SafetyError, refused
from .values import NUMBERS, Foreign, a_type

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from .guards import Guards

ARRAY_STEPS = 40
"""Steps of an operation on arrays, besides those for their numbers."""

_ITEM = 12
_WRITTEN = 30  # steps to write a number of an array, and twenty times that for an array
_SHOWN = 1000  # longer arrays are shown by their ends


class Value(Foreign):
    """Base of arrays and of numbers."""

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
        """The number of elements."""
        return int(self.data.size)

    @property
    def ndim(self) -> int:
        """The number of dimensions."""
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


# --- arithmetic -------------------------------------------------------------------------------


DIMENSIONS = 4
"""The most that an array may have."""

_OPERATION = 25  # steps of an operation of two numbers, measured against those of Python's own
_LIST = 10  # steps of a list that becomes a row of an array
_KINDS = "biufc"
_LEAST, _MOST = -(1 << 63), (1 << 64) - 1
_LEAVES = NUMBERS - {int}
_LISTS = frozenset((list, tuple, range))
_WRAPPERS = frozenset((Array, Number, Whole))
_OPERANDS = NUMBERS | _LISTS | _WRAPPERS
_OTHERS: dict[type, Any] = {str: "", type(None): None}
_BAD_INDEX = "only integers, slices (`:`), None and integer or boolean arrays are valid indices"
_OWN_FOLDER = __file__.rpartition("safe")[0]


def extent(shape: tuple[int, ...]) -> int:
    """Return how many numbers an array holds, or what is computed from it may.

    An array of no rows of a million numbers holds none, and the sum of its rows a million.
    """
    size = 1
    for count in shape:
        size *= count or 1
    return size


def broadcast(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape to which arrays of these shapes are broadcast, if they fit together."""
    result: list[int] = []
    for shape in shapes:
        missing = len(shape) - len(result)
        if missing > 0:
            result[:0] = [1] * missing
        for at in range(1, len(shape) + 1):
            if shape[-at] > result[-at]:
                result[-at] = shape[-at]
    return tuple(result)


class _Warnings:
    """Takes numpy's warnings, and issues them where they would come from without --safe."""

    def write(self, text: str) -> None:
        """Issue a warning at the innermost place outside Yamaro: the file's, or numpy's own."""
        frame, level = sys._getframe(1), 2
        while frame.f_back is not None and frame.f_code.co_filename.startswith(_OWN_FOLDER):
            frame, level = frame.f_back, level + 1
        words = text.strip().removeprefix("Warning: ")
        warnings.warn(words, RuntimeWarning, stacklevel=level)


_warnings = _Warnings()


class Arithmetic:
    """Lets numpy compute for one conversion.

    Attributes:
        guards: count the steps.
    """

    def __init__(self, guards: Guards) -> None:
        self.guards = guards
        self._modes: dict[str, Any] = {
            kind: "log" for kind, mode in np.geterr().items() if mode == "warn"
        }
        guards.foreign |= {Array: _size, Number: _one, Whole: _one}

    # --- in ---

    def operand(self, value: Any) -> Any:
        """Return what numpy is given for a value: a number, or an array of numbers.

        Raises:
            SafetyError: it is anything else.
        """
        kind = type(value)
        if kind in _WRAPPERS:
            return value.data
        if kind in _LEAVES:
            return value
        if kind is int:
            if not _LEAST <= value <= _MOST:
                raise refused(
                    "a whole number of more than 64 bits in numpy",
                    hint="a decimal number, such as 1e30, is allowed",
                )
            return value
        if kind in _LISTS:
            return self.array(value) if value else []  # numpy decides what type nothing has
        raise refused(f"{a_type(value)} in numpy", "it takes numbers, and lists of numbers")

    def array(self, values: Any) -> Any:
        """Return numpy's array of the numbers in lists in lists.

        Raises:
            SafetyError: there is something else in them, or too much.
        """
        return self._checked(np.array(self.rows(values)))

    def rows(self, values: Any) -> Any:
        """Return lists in lists with numpy's own objects in place of ours; see `array`."""
        return self._rows(values, 0, [self.guards.limits.sequence])

    def _rows(self, value: Any, depth: int, room: list[int]) -> Any:
        if type(value) not in _LISTS:
            made = self.operand(value)
            if type(made) is np.ndarray:
                self._take(room, extent(made.shape))
            return made
        if depth == DIMENSIONS:
            raise _too_many_dimensions()
        self._take(room, len(value))
        self.guards.charge(_LIST + len(value) * 2)
        return [
            item
            if type(item) is float or (type(item) is int and _LEAST <= item <= _MOST)
            else self._rows(item, depth + 1, room)
            for item in value
        ]

    def _take(self, room: list[int], size: int) -> None:
        room[0] -= size
        if room[0] < 0:
            raise self.guards.limits.passed("sequence", "too many numbers are put into an array")

    def digits(self, value: Any) -> Any:
        """Return how many digits to round to: numpy computes powers of ten one by one."""
        value = _bound(value)
        if value is not None and abs(value) > self.guards.limits.width:
            raise self.guards.limits.passed("width", "this rounds to too many digits")
        return value

    # --- out ---

    def admit(self, value: Any) -> Any:
        """Return the wrapper of an object of numpy's from outside; an array is copied."""
        return self.wrap(value.copy() if type(value) is np.ndarray else value)

    def wrap(self, value: Any) -> Any:
        """Return what safe code gets for a value of numpy's.

        Raises:
            SafetyError: it is not plain data, or too much of it.
        """
        kind = type(value)
        if kind in NUMBERS or kind is str or value is None:
            return value
        if kind is np.ndarray:
            return Array(self._checked(value), self)
        if isinstance(value, np.generic) and value.dtype.kind in _KINDS:
            return (Whole if value.dtype.kind in "iu" else Number)(value, self)
        if kind is tuple or kind is list:
            return kind(map(self.wrap, value))
        raise refused(f"a value of the type `{kind.__name__}`", "only plain data can be used")

    def _checked(self, made: Any) -> Any:
        if made.dtype.kind not in _KINDS:
            raise refused(f"an array of the type `{made.dtype}`", "only numbers are allowed")
        if made.ndim > DIMENSIONS:
            raise _too_many_dimensions()
        self._check_size(extent(made.shape))
        return made

    # --- how much ---

    def _check_size(self, size: int) -> None:
        if size > self.guards.limits.sequence:
            raise self.guards.limits.passed("sequence", f"this makes {size:,} numbers")

    def charge(self, shape: tuple[int, ...], weight: int = 1) -> None:
        """Count an operation whose result has a shape.

        Raises:
            SafetyError: that is too much.
        """
        size = extent(shape)
        self._check_size(size)
        self.guards.charge(ARRAY_STEPS + size * weight)

    def charge_work(self, operations: int) -> None:
        """Count multiplications that numpy does on its own, sixteen of which are a step."""
        self.guards.charge(operations >> 4)

    def charge_product(self, a: tuple[int, ...], b: tuple[int, ...], *, is_dot: bool) -> None:
        """Count the product of two arrays of these shapes."""
        last = b[-1:] if len(b) > 1 else ()
        if not a or not b:
            shape = a or b
        elif is_dot:
            shape = (*a[:-1], *b[:-2], *last)
        else:
            shape = (*broadcast(a[:-2], b[:-2]), *a[-2:-1], *last)
        self.charge(shape)
        self.charge_work(extent(shape) * (a[-1] if a and b else 1))

    def charge_lists(self, shape: tuple[int, ...]) -> None:
        """Count an array of a shape as lists in lists, which take more than their numbers."""
        self.charge(shape, 2)
        self.guards.charge(extent(shape[:-1]) * _LIST)

    # --- work ---

    def run(self, call: Callable[..., Any], /, *args: Any, **named: Any) -> Any:
        """Call a function of numpy's, with the warnings it gives without --safe."""
        with np.errstate(call=_warnings, **self._modes):  # type: ignore[arg-type, unused-ignore]
            result = call(*args, **named)
        return self.wrap(result)

    def operate(self, name: str, operation: Callable[..., Any], a: Any, b: Any) -> Any:
        """Return the result of an operator, at least one of whose operands is a wrapper."""
        mine, other = (a, b) if type(a) in _WRAPPERS else (b, a)
        kind = type(other)
        if name == "mul" and kind in (str, list, tuple) and type(mine) is not Array:
            times = operator.index(mine)  # Python's own error for numbers that are not whole
            return self.guards.mul(other, times)
        if kind not in _OPERANDS:
            if name not in ("eq", "ne"):
                if type(mine) is Array:  # Python would take one number for a count: 'a' * array
                    words = f"{name}: '{type(a).__name__}' and '{type(b).__name__}'"
                    raise TypeError(f"unsupported operand types for {words}")
                return NotImplemented
            if type(mine) is Array:
                raise refused(f"comparing an array with {a_type(other)}")
            # They differ, but it depends on numpy's version whose type the answer has.
            return self.wrap(operation(mine.data, _OTHERS.get(kind, {})))
        x, y = self.operand(a), self.operand(b)
        left = getattr(x, "shape", ())
        right = getattr(y, "shape", ())
        if not left and not right:
            self.guards.charge(_OPERATION)
        elif name in ("matmul", "imatmul"):
            self.charge_product(left, right, is_dot=False)
        else:
            self.charge(broadcast(left, right), 4 if name in ("pow", "ipow") else 1)
        return self.run(operation, x, y)

    # --- items ---

    def index(self, key: Any, shape: tuple[int, ...]) -> tuple[Any, int]:
        """Return the index for numpy, and how many numbers it selects at most."""
        parts = key if type(key) is tuple else (key,)
        if len(parts) > 2 * DIMENSIONS:
            raise _too_many_dimensions()
        made: list[Any] = []
        size, axis, arrays = 1, 0, []
        for part in parts:
            taken = self._index_part(part)
            made.append(taken)
            if taken is None:
                continue
            length = shape[axis] if axis < len(shape) else 1
            if type(taken) is slice:
                size *= len(range(*taken.indices(length))) or 1
            elif type(taken) is np.ndarray:
                is_mask = taken.dtype.kind == "b"
                arrays.append((int(np.count_nonzero(taken)),) if is_mask else taken.shape)
                self.guards.charge(taken.size)
                axis += taken.ndim - 1 if is_mask else 0
            axis += 1
        size *= extent(shape[axis:]) * extent(broadcast(*arrays))
        self._check_size(size)
        if arrays:
            self.guards.charge(size)
        return (tuple(made) if type(key) is tuple else made[0]), size

    def _index_part(self, part: Any) -> Any:
        kind = type(part)
        if kind is int or part is None:
            return part
        if kind is Whole:
            return int(part.data)
        if kind is slice:
            return slice(*map(_bound, (part.start, part.stop, part.step)))
        if kind is Array:
            return part.data
        if kind in _LISTS:
            made = self.array(part)
            return made if made.size else made.astype(int)
        if kind is bool or kind is Number:
            raise refused("a truth value as an index" if kind is bool else "such an index")
        raise IndexError(_BAD_INDEX)


def _bound(value: Any) -> Any:
    """Return a bound of a slice as Python's own number."""
    return value if value is None or type(value) is int else operator.index(value)


def _too_many_dimensions() -> SafetyError:
    return refused(f"an array of more than {DIMENSIONS} dimensions")


def _size(array: Array) -> int:
    return extent(array.data.shape)


def _one(_: Any) -> int:
    return 1
