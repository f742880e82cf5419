"""The runtime of safe code: its guards, names and modules, for one conversion.

code = runtime.bind(compile_safe(text, filename, "eval"))
eval(code, scope, scope)          # with runtime.names() among the names of the scope's file
"""

from __future__ import annotations

import math

from ..syntax.names import FACTORS
from .builtins import BARE, permitted, refusal
from .code import RUNTIME
from .guards import Guards
from .limits import RUN_IT, SafeLimits, SafetyError, refused
from .values import (
    CONTAINERS,
    LIST_ITERATOR,
    NUMBERS,
    SCALARS,
    WHOLE,
    Foreign,
    Function,
    Module,
    _leaves,
    a_type,
    function,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import CodeType
    from typing import Any

    from .guards import Guards


# --- modules ----------------------------------------------------------------------------------


MATHEMATICS = (
    "acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh degrees e erf erfc exp "
    "exp2 expm1 fabs floor fma fmod frexp gamma hypot inf isclose isfinite isinf isnan ldexp "
    "lgamma log log10 log1p log2 modf nan nextafter pi pow radians remainder sin sinh sqrt tan "
    "tanh tau trunc ulp"
).split()
"""What is taken from `math` as it is: it computes with decimals, or makes nothing larger."""

STATISTICS = (
    "fmean geometric_mean harmonic_mean mean median median_high median_low mode pstdev pvariance "
    "stdev variance"
).split()
"""What is taken from `statistics`; each takes a collection of numbers first."""


def mathematics(guards: Guards) -> Module:
    """Return the stand-in for `math`, without functions that the running Python lacks."""
    members = {name: getattr(math, name) for name in MATHEMATICS if hasattr(math, name)}
    for name, call in _CALLS.items():
        if hasattr(math, name):
            members[name] = function(call, f"<built-in function {name}>", guards)
    return Module("math", members)


def statistics(guards: Guards) -> Module:
    """Return the stand-in for `statistics`."""
    import statistics as module

    members = {}
    for name in STATISTICS:
        call = getattr(module, name)
        members[name] = function(_of_numbers, f"<function {name}>", guards, call)
    return Module("statistics", members)


def arrays(guards: Guards) -> Module:
    """Return the stand-in for `numpy`.

    Raises:
        SafetyError: it is not installed.
    """
    try:
        from .numpy import numpy_of
    except ModuleNotFoundError as error:
        if error.name != "numpy":
            raise
        raise SafetyError(
            "unknown-module",
            "the Python module 'numpy' is not found",
            "is it installed?",
        ) from None
    return numpy_of(guards).module


MODULES: dict[str, Callable[[Guards], Module]] = {
    "math": mathematics,
    "numpy": arrays,
    "statistics": statistics,
}


def module(guards: Guards, name: str) -> Module:
    """Return the stand-in for a module.

    Raises:
        SafetyError: it is not allowed.
    """
    if name not in MODULES:
        known = ", ".join(sorted(MODULES))
        raise refused(f"the module `{name}`", hint=f"safe mode supports {known}; {RUN_IT}")
    return MODULES[name](guards)


def _of_numbers(
    guards: Guards, call: Callable[..., Any], data: Any, /, *args: Any, **named: Any
) -> Any:
    """Return a function of the numbers in a collection, and of others."""
    numbers = _numbers(guards, data, 20)
    rest = [_statistical(guards, value) for value in args]
    others = {name: _statistical(guards, value) for name, value in named.items()}
    guards.keys(numbers)
    stand_in = next((item for item in numbers if isinstance(item, Foreign)), None)
    result = call(_bare(numbers), *rest, **others)
    return result if stand_in is None else stand_in.of_its_kind(result)


def _statistical(guards: Guards, value: Any) -> Any:
    """Return an argument of a function of numbers: a number, or a collection of them."""
    if type(value) in NUMBERS or value is None:
        return value
    if isinstance(value, Foreign) and not hasattr(type(value), "__iter__"):
        return value.data
    return _bare(_numbers(guards, value, 20))


def _bare(numbers: list[Any]) -> list[Any]:
    """Return numbers as the library has them, which looks at their types."""
    return [item.data if isinstance(item, Foreign) else item for item in numbers]


def _numbers(guards: Guards, values: Any, cost: int = 2) -> list[Any]:
    """Return the numbers in a collection, having counted what computing with them costs."""
    items = list(guards.items(values))
    guards.charge(len(items) * cost)
    for item in items:
        kind = type(item)
        if kind is int and item.bit_length() > 64:
            guards.charge(item.bit_length() * cost >> 2)
        if kind not in NUMBERS and (kind not in guards.foreign or hasattr(kind, "__iter__")):
            raise TypeError(f"a number is needed here, and this is {a_type(item)}")
    return items


def _product(guards: Guards, values: Any, /, *, start: Any = 1) -> Any:
    total = start
    for item in _numbers(guards, values):
        total = guards.mul(total, item)
    return total


def _factorial(guards: Guards, number: Any, /) -> int:
    number = guards.plain(number)
    if type(number) in WHOLE and number > 1:
        bits = min(number, 1 << 32) * max(int(number).bit_length() - 2, 1)
        guards.check_integer(bits)
        guards.charge(bits >> 3)
    return math.factorial(number)


def _combinations(guards: Guards, number: Any, chosen: Any, /) -> int:
    number, chosen = guards.plain(number), guards.plain(chosen)
    is_whole = type(number) in WHOLE and type(chosen) in WHOLE
    _check_choice(guards, number, min(chosen, number - chosen) if is_whole else chosen)
    return math.comb(number, chosen)


def _permutations(guards: Guards, number: Any, chosen: Any = None, /) -> int:
    number, chosen = guards.plain(number), guards.plain(chosen)
    if type(number) in WHOLE and type(chosen) in WHOLE and chosen > number:
        return math.perm(number, chosen)  # none
    _check_choice(guards, number, number if chosen is None else chosen)
    return math.perm(number, chosen)


def _check_choice(guards: Guards, number: Any, chosen: Any) -> None:
    if type(number) in WHOLE and type(chosen) in WHOLE and chosen > 0 and number > 0:
        bits = chosen * int(number).bit_length()
        guards.check_integer(bits)
        guards.charge(bits >> 3)


def _with_whole_numbers(name: str) -> Callable[..., Any]:
    call = getattr(math, name)

    def run(guards: Guards, /, *numbers: Any) -> Any:
        guards.charge(sum(n.bit_length() for n in numbers if type(n) in WHOLE) >> 2)
        return call(*numbers)

    return run


def _least_common_multiple(guards: Guards, /, *values: Any) -> int:
    numbers = list(map(guards.plain, values))
    bits = sum(n.bit_length() for n in numbers if type(n) in WHOLE)
    guards.check_integer(bits)
    guards.charge(bits >> 2)
    return math.lcm(*numbers)


def _exact_sum(guards: Guards, values: Any, /) -> float:
    return math.fsum(_numbers(guards, values))


def _distance(guards: Guards, p: Any, q: Any, /) -> float:
    return math.dist(_numbers(guards, p), _numbers(guards, q))


def _sum_of_products(guards: Guards, p: Any, q: Any, /) -> Any:
    rows: Function = Function(getattr(math, "sumprod"))  # noqa: B009 - newer than our oldest Python
    return rows(_numbers(guards, p), _numbers(guards, q))


_CALLS: dict[str, Callable[..., Any]] = {
    "comb": _combinations,
    "dist": _distance,
    "factorial": _factorial,
    "fsum": _exact_sum,
    "gcd": _with_whole_numbers("gcd"),
    "isqrt": _with_whole_numbers("isqrt"),
    "lcm": _least_common_multiple,
    "perm": _permutations,
    "prod": _product,
    "sumprod": _sum_of_products,
}


# --- runtime ----------------------------------------------------------------------------------


HELPER_STEPS = 1000
"""What a call of a helper such as `load_yaml` counts."""

PREDEFINED = (
    "pi tau e sin cos tan asin acos atan atan2 sqrt hypot radians degrees floor ceil fabs log exp"
).split()


class SafeRuntime(Guards):
    """Runs the code that `compile_safe` makes; one for each conversion."""

    def __init__(
        self, limits: SafeLimits | None = None, *, say: Callable[[str], None] | None = None
    ) -> None:
        """Begin with no steps taken.

        Args:
            limits: the usual ones if left out.
            say: takes what `print` prints; else it is discarded.
        """
        super().__init__(limits or SafeLimits())
        self._modules: dict[str, Module] = {}
        self._names = permitted(self, say or _say_nothing)
        self.lazy_functions = tuple(self._names[name] for name in ("all", "any", "next"))
        self._own = list(BARE)
        self.own = frozenset(map(id, self._own))
        mathematics = self.module("math").members
        self._names.update({name: mathematics[name] for name in PREDEFINED})
        self._names.update({"true": True, "false": False, "null": None, **FACTORS})
        self._names["env"] = self._names["__env__"] = refusal("env")
        self._names["cwd"] = refusal("cwd")

    def bind(self, code: CodeType) -> CodeType:
        """Return code of `compile_safe` with the guards in it."""
        constants = tuple(self._bound(constant) for constant in code.co_consts)
        return code.replace(co_consts=constants)

    def _bound(self, constant: Any) -> Any:
        if constant == RUNTIME:
            return self
        return self.bind(constant) if hasattr(constant, "co_consts") else constant

    def names(self, helpers: Mapping[str, Any] = {}) -> dict[str, Any]:
        """Return the names that code sees when no variable hides them: never Python's own builtins.

        Args:
            helpers: the functions of a file, which keep to their own rules of what may be read, and
                texts. What its key `find` is given is called by `$(find package)` too.
        """
        names = dict(self._names)
        for name, value in helpers.items():
            names[name] = self.helper(value, name) if callable(value) else self.admit(value)
        if "find" in names:
            names["__find__"] = names["find"]
        return names

    def helper(self, call: Callable[..., Any], name: str) -> Any:
        """Return one of Yamaro's functions as one that code may call, with plain arguments."""
        return function(self._help, f"<function {name}>", call)

    def _help(self, call: Callable[..., Any], /, *args: Any, **named: Any) -> Any:
        self.charge(HELPER_STEPS)
        for value in (*args, *named.values()):
            if type(value) not in SCALARS:
                raise TypeError("a text or a number is needed here")
        return self.admit(call(*args, **named))

    def module(self, name: str) -> Module:
        """Return the stand-in for a module in safe mode.

        Raises:
            SafetyError: it is not allowed.
        """
        if name not in self._modules:
            found = self._modules[name] = module(self, name)
            functions = [value for value in found.members.values() if type(value) is type(len)]
            if functions:
                self._own = [*getattr(self, "_own", ()), *functions]
                self.own = frozenset(map(id, self._own))
        return self._modules[name]

    def check_written(self, value: Any) -> None:
        """Refuse a value that is to be written, but is or holds something that has no text."""
        for item in _leaves(value) if type(value) in CONTAINERS else (value,):
            kind = type(item)
            if kind is LIST_ITERATOR:
                raise refused("the text of an iterator", hint="write list(…) around it")
            if kind is Function or id(item) in self.own:
                raise refused("the text of a function", hint="call it: name(…)")
            if kind is Module:
                raise refused("the text of a module", hint="write a name in it: math.pi")

    def refusal_of_module(self, name: str, why: str) -> SafetyError:
        """Return the error for a module that is not allowed."""
        return refused(f"the module `{name}`", why)


def _say_nothing(text: str) -> None:
    pass
