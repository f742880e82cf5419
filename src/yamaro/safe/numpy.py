"""The part of numpy that safe code may import: functions, and the methods of arrays.

Each call is checked first, and its cost counted. What is in no table of `numpy_functions.py` is
refused: numpy reads and writes files, loads libraries, calls functions that it is given, and shows
memory that nobody has filled. The rules, for people who write robots, are in docs/safety.md.
"""

from __future__ import annotations

from math import ceil

import numpy as np

from .arrays import DIMENSIONS, Arithmetic, Array, Number, Whole, broadcast, extent
from .limits import RUN_IT, refused
from .methods import CHANGING, DATA, READING
from .values import Module, a_type, function

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from .arrays import Arithmetic
    from .guards import Guards

    Given = dict[str, Any]
    Check = Callable[[Arithmetic, Given], None]
    Table = dict[str, tuple[str, Check]]


# --- numpy functions --------------------------------------------------------------------------


def _shape(value: Any) -> tuple[int, ...]:
    return getattr(value, "shape", ())


def _shape_asked(value: Any) -> tuple[int, ...]:
    """Return the shape that an argument asks for, if there is one.

    Raises:
        TypeError: it is not whole numbers; some functions of numpy's would take decimals.
    """
    sizes = value if type(value) in (list, tuple) else () if value is None else (value,)
    if not all(type(size) in (int, bool) for size in sizes):
        raise TypeError("sizes have to be whole numbers")
    return tuple(map(abs, sizes))


def each_number(weight: int = 1) -> Check:
    """Return the check of functions of each number of their arguments."""

    def check(numpy: Arithmetic, given: Given) -> None:
        numpy.charge(broadcast(*map(_shape, given.values())), weight)

    return check


def _sorting(numpy: Arithmetic, given: Given) -> None:
    shape = _first(given)
    numpy.charge(shape, 20 + extent(shape).bit_length() >> 2)


def _first(given: Given) -> tuple[int, ...]:
    return _shape(next(iter(given.values()), None))


def _quantiles(numpy: Arithmetic, given: Given) -> None:
    _sorting(numpy, given)
    rows = 1 if given.get("axis") is None else extent(_first(given))
    numpy.charge((rows, extent(_shape(given.get("q")))))


def _averaging(numpy: Arithmetic, given: Given) -> None:
    for shape in map(_shape, given.values()):  # weights of one axis go along that axis
        numpy.charge(shape, 2)


def _crossing(numpy: Arithmetic, given: Given) -> None:
    a, b = (_shape(given.get(name)) for name in ("a", "b"))
    if given.get("axis") is not None and len(a) != len(b):
        raise refused("an `axis` of arrays of unlike dimensions")
    numpy.charge(broadcast(a, b), 4)


def _triangle(numpy: Arithmetic, given: Given) -> None:
    shape = _first(given)
    numpy.charge(shape * 2 if len(shape) == 1 else shape, 2)


def _new(numpy: Arithmetic, given: Given) -> None:
    numpy.charge(_shape_asked(given.get("shape")))


def _square(numpy: Arithmetic, given: Given) -> None:
    rows = given.get("N", given.get("n"))
    columns = given.get("M")
    if rows is not None:  # else numpy reports that it is missing
        numpy.charge(_shape_asked([rows, rows if columns is None else columns]))


def _steps(numpy: Arithmetic, given: Given) -> None:
    start, stop, step = (given.get(name) for name in ("start", "stop", "step"))
    if stop is None:
        start, stop = 0, start
    if stop is None:
        return  # numpy reports what is missing
    start = 0 if start is None else start
    count = (float(stop) - float(start)) / (1.0 if step is None else float(step))
    if count > 0:
        numpy.charge((ceil(min(count, 1e18)),))


def _spaced(numpy: Arithmetic, given: Given) -> None:
    ends = broadcast(_shape(given.get("start")), _shape(given.get("stop")))
    numpy.charge((*ends, *_shape_asked(given.get("num", 50))), 4)


def _grid(numpy: Arithmetic, given: Given) -> None:
    vectors = given.get("xi", [])
    sizes = tuple(extent(_shape(vector)) for vector in vectors)
    numpy.charge((len(sizes), *sizes))


def _joining(numpy: Arithmetic, given: Given) -> None:
    parts = given.get("arrays", given.get("tup"))
    if isinstance(parts, list):
        numpy.charge((sum(extent(_shape(part)) for part in parts),))
        numpy.charge((len(parts),), 10)
    else:  # an array: its rows are joined
        numpy.charge(_shape(parts))
        numpy.charge(_shape(parts)[:1], 10)


def _appending(numpy: Arithmetic, given: Given) -> None:
    numpy.charge((sum(extent(_shape(given.get(name))) for name in ("arr", "values")),))


def _repeating(numpy: Arithmetic, given: Given) -> None:
    times = given.get("repeats")
    if type(times) is not int:
        raise refused("a list of numbers of times", hint="repeat them with a list: [… for x in …]")
    numpy.charge((*_first(given), abs(times)))


def _tiling(numpy: Arithmetic, given: Given) -> None:
    numpy.charge((*_first(given), *_shape_asked(given.get("reps"))))


def _diagonal(numpy: Arithmetic, given: Given) -> None:
    shape = _first(given)
    if len(shape) == 1:
        shape = (shape[0] + sum(_shape_asked(given.get("k"))),) * 2
    numpy.charge(shape)


def _dot(numpy: Arithmetic, given: Given) -> None:
    a, b = (_shape(given.get(name)) for name in ("a", "b"))
    numpy.charge_product(a, b, is_dot=True)


def _matmul(numpy: Arithmetic, given: Given) -> None:
    a, b = (_shape(given.get(name)) for name in ("x1", "x2"))
    numpy.charge_product(a, b, is_dot=False)


def _inner(numpy: Arithmetic, given: Given) -> None:
    a, b = (_shape(given.get(name)) for name in ("a", "b"))
    numpy.charge_product(a, (*b[:-2], *b[-1:], *b[-2:-1]), is_dot=True)


def _all_pairs(numpy: Arithmetic, given: Given) -> None:
    numpy.charge(tuple(extent(_shape(value)) for value in given.values()))


def _polynomial(numpy: Arithmetic, given: Given) -> None:
    factors, values = _first(given), _shape(given.get("x"))
    if len(factors) > 1:
        raise refused("a table of factors", hint="give them as one list")
    numpy.charge(values)
    numpy.charge(factors, extent(values) + 20)


def _searching(numpy: Arithmetic, given: Given) -> None:
    for shape in map(_shape, given.values()):
        numpy.charge(shape, 4)


def _linear(weight: int) -> Check:
    """Return the check of a function that takes a matrix's size times its rows."""

    def check(numpy: Arithmetic, given: Given) -> None:
        for shape in map(_shape, given.values()):
            numpy.charge(shape, 4)
            numpy.charge_work((extent(shape) * max(_first(given)[-1:] or (1,)) + 100) * weight)

    return check


def _norm(numpy: Arithmetic, given: Given) -> None:
    each_number(4)(numpy, given)
    if given.get("ord") in (2, -2, "nuc"):  # singular values, along any two axes
        shape = _first(given)
        numpy.charge_work(extent(shape) * max(shape or (1,)) * 10)


def _solving(numpy: Arithmetic, given: Given) -> None:
    _linear(1)(numpy, given)
    a, b = (_shape(given.get(name)) for name in ("a", "b"))
    rows = max(extent(a[-2:]), extent(b[-2:]))
    for stacks in (b[:-2], b[:-1] if len(b) == len(a) - 1 else ()):  # of matrices, or of vectors
        numpy.charge((*broadcast(a[:-2], stacks), rows))


def _power_of_matrix(numpy: Arithmetic, given: Given) -> None:
    exponent = given.get("n")
    _linear(exponent.bit_length() + 1 if type(exponent) is int else 1)(numpy, given)


# --- the tables -----------------------------------------------------------------------------------

_ELEMENTWISE = (
    "abs absolute acos acosh arccos arccosh arcsin arcsinh arctan arctanh asin asinh atan atanh "
    "cbrt ceil conj conjugate cos cosh deg2rad degrees exp exp2 expm1 fabs floor isfinite isinf "
    "isnan log log10 log1p log2 logical_not negative positive rad2deg radians reciprocal rint sign "
    "signbit sin sinh sqrt square tan tanh trunc"
).split()
_OF_TWO = (
    "add arctan2 atan2 copysign divide equal float_power floor_divide fmax fmin fmod greater "
    "greater_equal heaviside hypot less less_equal logical_and logical_or logical_xor maximum "
    "minimum mod multiply not_equal pow power remainder subtract true_divide"
).split()
_REDUCTIONS: Table = {
    **{
        name: ("a axis | keepdims", each_number())
        for name in "all any argmax argmin max min".split()
    },
    **{name: ("a axis | dtype keepdims", each_number()) for name in "mean prod sum".split()},
    **{name: ("a axis | ddof dtype keepdims", each_number(4)) for name in "std var".split()},
    **{name: ("a axis | dtype", each_number()) for name in "cumprod cumsum".split()},
}
_RESHAPING: Table = {
    "argsort": ("a axis", _sorting),
    "diagonal": ("a offset axis1 axis2", each_number()),
    "dot": ("a b", _dot),
    "nonzero": ("a", each_number(4)),
    "ravel": ("a", each_number()),
    "repeat": ("a repeats axis", _repeating),
    "round": ("a decimals", each_number(2)),
    "squeeze": ("a axis", each_number()),
    "swapaxes": ("a axis1 axis2", each_number()),
    "trace": ("a offset axis1 axis2", each_number()),
}

FUNCTIONS: Table = {
    **{name: ("x", each_number()) for name in _ELEMENTWISE},
    **{name: ("x1 x2", each_number()) for name in _OF_TWO},
    **_REDUCTIONS,
    **_RESHAPING,
    "allclose": ("a b rtol atol equal_nan", each_number(4)),
    "amax": ("a axis | keepdims", each_number()),
    "amin": ("a axis | keepdims", each_number()),
    "append": ("arr values axis", _appending),
    "arange": ("start stop step dtype", _steps),
    "argwhere": ("a", each_number(4)),
    "around": ("a decimals", each_number(2)),
    "array": ("object dtype | ndmin", each_number()),
    "array_equal": ("a1 a2", each_number()),
    "asarray": ("object dtype", each_number()),
    "atleast_1d": ("a", each_number()),
    "atleast_2d": ("a", each_number()),
    "atleast_3d": ("a", each_number()),
    "average": ("a axis weights", _averaging),
    "clip": ("a a_min a_max", each_number()),
    "column_stack": ("tup", _joining),
    "concatenate": ("arrays axis | dtype", _joining),
    "copy": ("a", each_number()),
    "count_nonzero": ("a axis | keepdims", each_number()),
    "cross": ("a b | axis", _crossing),
    "diag": ("v k", _diagonal),
    "diff": ("a | axis", each_number()),
    "dstack": ("tup", _joining),
    "expand_dims": ("a axis", each_number()),
    "eye": ("N M k dtype", _square),
    "flatnonzero": ("a", each_number(2)),
    "flip": ("m axis", each_number()),
    "fliplr": ("m", each_number()),
    "flipud": ("m", each_number()),
    "full": ("shape fill_value dtype", _new),
    "full_like": ("a fill_value dtype", each_number()),
    "geomspace": ("start stop num endpoint | dtype", _spaced),
    "hstack": ("tup", _joining),
    "identity": ("n dtype", _square),
    "inner": ("a b", _inner),
    "interp": ("x xp fp left right", _searching),
    "isclose": ("a b rtol atol equal_nan", each_number(4)),
    "kron": ("a b", _all_pairs),
    "linspace": ("start stop num endpoint | dtype retstep", _spaced),
    "logspace": ("start stop num endpoint base | dtype", _spaced),
    "matmul": ("x1 x2", _matmul),
    "median": ("a axis | keepdims", _sorting),
    "meshgrid": ("xi | indexing", _grid),
    "moveaxis": ("a source destination", each_number()),
    "ndim": ("a", each_number()),
    "ones": ("shape dtype", _new),
    "ones_like": ("a dtype", each_number()),
    "outer": ("a b", _all_pairs),
    "percentile": ("a q axis | keepdims", _quantiles),
    "polyval": ("p x", _polynomial),
    "ptp": ("a axis | keepdims", each_number(2)),
    "quantile": ("a q axis | keepdims", _quantiles),
    "reshape": ("a shape", each_number()),
    "roll": ("a shift axis", each_number()),
    "rot90": ("m k axes", each_number()),
    "searchsorted": ("a v side", _searching),
    "shape": ("a", each_number()),
    "size": ("a axis", each_number()),
    "sort": ("a axis", _sorting),
    "stack": ("arrays axis", _joining),
    "tile": ("A reps", _tiling),
    "transpose": ("a axes", each_number()),
    "tril": ("m k", _triangle),
    "triu": ("m k", _triangle),
    "unique": ("ar", _sorting),
    "vdot": ("a b", each_number()),
    "vstack": ("tup", _joining),
    "where": ("condition x y", each_number(4)),
    "zeros": ("shape dtype", _new),
    "zeros_like": ("a dtype", each_number()),
}
"""Functions with their arguments (those after `|` by name only), and what they cost."""

LINEAR_ALGEBRA: Table = {
    "cholesky": ("a", _linear(1)),
    "cond": ("x p", _linear(10)),
    "det": ("a", _linear(1)),
    "eigvals": ("a", _linear(20)),
    "eigvalsh": ("a", _linear(10)),
    "inv": ("a", _linear(2)),
    "matrix_power": ("a n", _power_of_matrix),
    "matrix_rank": ("a", _linear(10)),
    "norm": ("x ord axis keepdims", _norm),
    "pinv": ("a", _linear(20)),
    "solve": ("a b", _solving),
}

METHODS: Table = {
    **_REDUCTIONS,
    **_RESHAPING,
    "astype": ("a dtype", each_number()),
    "clip": ("a min max", each_number()),
    "conj": ("a", each_number()),
    "conjugate": ("a", each_number()),
    "copy": ("a", each_number()),
    "flatten": ("a", each_number()),
    "item": ("a index", each_number(0)),
    "ptp": ("a axis | keepdims", each_number(2)),
    "tolist": ("a", lambda numpy, given: numpy.charge_lists(_first(given))),
}

METHODS_OF_NUMBERS: Table = {
    name: ("a", each_number(0)) for name in "as_integer_ratio bit_count hex is_integer".split()
}
METHODS_THAT_CHANGE: Table = {"fill": ("a values", each_number()), "sort": ("a axis", _sorting)}


# --- numpy ------------------------------------------------------------------------------------


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
