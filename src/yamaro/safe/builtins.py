"""The functions of Python that safe code may call, each bounded, and stand-ins for the others."""

from __future__ import annotations

import builtins
from itertools import islice

from .limits import RUN_IT, refused
from .values import (
    CONTAINERS,
    DICT_VIEWS,
    ITERABLES,
    LIST_ITERATOR,
    NUMBERS,
    SCALARS,
    SEQUENCES,
    WHOLE,
    Foreign,
    Function,
    OrderedSet,
    a_type,
    function,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, NoReturn

    from .guards import Guards

BARE = (callable, chr, len, ord)
"""Functions written in C that need no guard: they take no time and make nothing large."""

TYPES: dict[str, type | tuple[type, ...]] = {
    "bool": bool,
    "dict": dict,
    "float": float,
    "int": int,
    "list": list,
    "set": OrderedSet,
    "str": str,
    "tuple": tuple,
}
"""What `isinstance` may ask for."""

_HINTS = {
    "env": "give the value as an argument: yamaro FILE name:=value",
    "format": "write an f-string: f'{x:.3f}'",
    "frozenset": "write set(…)",
    "hash": RUN_IT,
    "input": "give the value as an argument: yamaro FILE name:=value",
    "iter": "write list(…)",
    "open": f"load_yaml(path) reads YAML files; {RUN_IT}",
    "type": "ask with isinstance(x, str)",
}
_REQUIRED: Any = object()


def permitted(guards: Guards, say: Callable[[str], None]) -> dict[str, Any]:
    """Return what Python's builtins are in safe code, by name.

    Args:
        guards: count the steps.
        say: takes what `print` prints.
    """
    names: dict[str, Any] = {}
    for name in dir(builtins):
        value = getattr(builtins, name)
        if callable(value) and not name.startswith("_"):
            names[name] = refusal(name)
    for name, call in _CALLS.items():
        shown = f"<class '{name}'>" if name in TYPES else f"<built-in function {name}>"
        names[name] = function(call, shown, guards)
    names.update((bare.__name__, bare) for bare in BARE)
    names["print"] = function(_print, "<built-in function print>", guards, say)
    guards.types = [(names[name], kind) for name, kind in TYPES.items()]
    shown = "<built-in function isinstance>"
    names["isinstance"] = function(_is_instance, shown, guards.types)
    return names


def refusal(name: str) -> Function:
    """Return a stand-in for a function that is not allowed: calling it is an error."""
    return function(_refuse, f"<built-in function {name}>", name)


def _refuse(name: str, /, *_: Any, **__: Any) -> NoReturn:
    words = "the environment" if name == "env" else f"the function `{name}`"
    raise refused(words, hint=_HINTS.get(name, RUN_IT))


# --- numbers ------------------------------------------------------------------------------------


def _int(guards: Guards, value: Any = 0, /, *base: Any, **named: Any) -> int:
    if type(value) is str:
        if len(value) > 64:
            guards.check_integer(len(value.strip()) * 3)
            guards.charge(len(value))
        number = int(value, *base, **named)
        guards.check_integer(number.bit_length())
        return number
    _check_number(guards, value, "int")
    return int(value, *base, **named)


def _float(guards: Guards, value: Any = 0.0, /) -> float:
    if type(value) is str:
        if len(value) > 64:
            guards.charge(len(value))
        return float(value)
    _check_number(guards, value, "float")
    return float(value)


def _check_number(guards: Guards, value: Any, name: str) -> None:
    kind = type(value)
    if kind not in SCALARS and kind not in ITERABLES and kind not in guards.foreign:
        raise refused(f"`{name}` of {a_type(value)}")


def _abs(guards: Guards, number: Any, /) -> Any:
    guards.charge_bits(number)
    return abs(number)


def _divmod(guards: Guards, a: Any, b: Any, /) -> Any:
    guards.charge_bits(a)
    return divmod(a, b)


def _bool(_: Guards, value: Any = False, /) -> bool:
    return bool(value)


def _round(guards: Guards, number: Any, ndigits: Any = None) -> Any:
    ndigits = guards.plain(ndigits)
    if type(number) in WHOLE and type(ndigits) is int and ndigits < -guards.limits.integer:
        raise guards.limits.passed("integer", "so many digits cannot be rounded off")
    guards.charge_bits(number)
    return round(number, ndigits)


def _pow(guards: Guards, base: Any, exp: Any, mod: Any = None) -> Any:
    if mod is None:
        return guards.pow(base, exp)
    if type(base) in WHOLE and type(exp) in WHOLE and type(mod) in WHOLE:
        words = max(base.bit_length(), mod.bit_length()) // 30 + 1
        guards.charge((exp.bit_length() + 8) * words * words >> 3)
    return pow(base, exp, mod)


def _whole_text(make: Callable[[Any], str]) -> Callable[[Guards, Any], str]:
    def run(guards: Guards, number: Any, /) -> str:
        written = make(number)
        guards.check_text(len(written))
        return written

    return run


def _sum(guards: Guards, values: Any, /, start: Any = 0) -> Any:
    items = guards.items(values)
    items = list(items) if type(items) not in SEQUENCES else items
    known = NUMBERS | guards.foreign.keys()
    if type(start) in known and all(type(item) in known for item in items):
        return sum(items, start)
    if type(start) is str:
        raise TypeError("sum() can't sum strings [use ''.join(seq) instead]")
    total = start
    for item in items:
        total = guards.add(total, item)
    return total


def _extreme(choose: Callable[..., Any]) -> Callable[..., Any]:
    def run(
        guards: Guards, first: Any, /, *rest: Any, key: Any = None, default: Any = _REQUIRED
    ) -> Any:
        named = {} if default is _REQUIRED else {"default": default}
        if rest:
            if type(first) is float and len(rest) == 1 and key is None and not named:
                return choose(first, guards.measured(rest[0]))
            items = (first, *rest)
            guards.charge(len(items))
            if named:
                return choose(*items, **named)  # raises Python's own error
        else:
            items = tuple(guards.items(first))
        if key is None:
            for item in items:
                guards.measured(item)
            return choose(items, **named)
        call = guards.called(key)
        return choose(items, key=lambda item: guards.measured(call(item)), **named)

    return run


# --- collections --------------------------------------------------------------------------------


def _list(guards: Guards, values: Any = (), /) -> list[Any]:
    return _sized(guards, list(guards.items(values)))


def _tuple(guards: Guards, values: Any = (), /) -> tuple[Any, ...]:
    made = tuple(guards.items(values))
    guards.check_sequence(len(made))
    return made


def _sized(guards: Guards, made: list[Any]) -> list[Any]:
    guards.check_sequence(len(made))
    return made


def _set(guards: Guards, values: Any = (), /) -> OrderedSet:
    return guards.set_of(list(guards.items(values)))


def _range(guards: Guards, /, *bounds: Any) -> range:
    made = range(*bounds)
    if made:
        size = (made[-1] - made[0]) // made.step + 1  # len() takes no more than 63 bits
        if size > guards.limits.sequence:
            guards.check_sequence(size)
    return made


def _sorted(guards: Guards, values: Any, /, *, key: Any = None, reverse: Any = False) -> list[Any]:
    return guards.sort(values, key=key, reverse=reverse)


def _reversed(guards: Guards, values: Any, /) -> Any:
    kind = type(values)
    if kind in guards.foreign:
        values = list(guards.items(values))
    elif kind not in (list, tuple, str, range, dict) and kind not in DICT_VIEWS:
        if kind in SCALARS or kind is OrderedSet or kind is LIST_ITERATOR:
            return reversed(values)  # raises Python's own error
        raise refused(f"`reversed` of {a_type(values)}")
    return iter(_sized(guards, list(guards.items(values))[::-1]))


def _enumerate(guards: Guards, iterable: Any, start: Any = 0) -> Any:
    items = guards.items(iterable)
    guards.check_table(len(items))
    return iter(list(enumerate(items, start)))


def _zip(guards: Guards, /, *collections: Any, strict: Any = False) -> Any:
    sources = [guards.each(values, 4) for values in collections]
    return iter(guards.list_of(zip(*sources, strict=bool(strict))))


def _map(guards: Guards, call: Any, first: Any, /, *others: Any) -> Any:
    sources = [guards.each(values, 2) for values in (first, *others)]
    return iter(guards.list_of(map(guards.called(call), *sources)))


def _filter(guards: Guards, call: Any, values: Any, /) -> Any:
    source = guards.each(values, 2)
    kept = filter(None if call is None else guards.called(call), source)
    return iter(guards.list_of(kept))


def _all(guards: Guards, values: Any, /) -> bool:
    return all(guards.each(values, 1))


def _any(guards: Guards, values: Any, /) -> bool:
    return any(guards.each(values, 1))


def _next(guards: Guards, values: Any, /, *default: Any) -> Any:
    if type(values) in SCALARS or type(values) in CONTAINERS:
        return next(values, *default)  # raises Python's own error
    return next(guards.each(values, 1), *default)


# --- texts --------------------------------------------------------------------------------------


def _str(guards: Guards, value: Any = "", /) -> str:
    return guards.text(value)


def _repr(guards: Guards, value: Any, /) -> str:
    return guards.representation(value)


def _ascii(guards: Guards, value: Any, /) -> str:
    written = guards.formatted(value, "a", "")
    guards.check_text(len(written))
    return written


def _format(guards: Guards, value: Any, spec: Any = "", /) -> str:
    if type(spec) is not str:
        raise TypeError(f"format() argument 2 must be str, not {type(spec).__name__}")
    return guards.formatted(value, "", spec)


def _print(
    guards: Guards,
    say: Callable[[str], None],
    /,
    *values: Any,
    sep: Any = " ",
    end: Any = "\n",
    file: Any = None,
    flush: Any = False,
) -> None:
    if file is not None:
        raise refused("printing to a file", hint="printed text goes to standard error")
    between, after = " " if sep is None else sep, "\n" if end is None else end
    if type(between) is not str or type(after) is not str:
        raise TypeError("sep and end must be None or a string")
    texts = [guards.text(value) for value in values]
    size = sum(map(len, texts)) + len(between) * len(texts) + len(after)
    guards.check_text(size)
    say(between.join(texts) + after)


# --- types --------------------------------------------------------------------------------------


def _is_instance(kinds: list[tuple[Any, type]], value: Any, wanted: Any, /) -> bool:
    asked = wanted if type(wanted) is tuple else (wanted,)
    found = [kind for item in islice(asked, 20) for named, kind in kinds if named is item]
    if isinstance(value, Foreign):
        value = value.data
    if found and len(found) == len(asked):  # tuples in tuples could take forever
        return isinstance(value, tuple(found))
    raise refused("this use of `isinstance`", hint=f"it may ask for {', '.join(TYPES)}")


def _dict(guards: Guards, pairs: Any = (), /, **named: Any) -> dict[Any, Any]:
    return guards.new_dict(pairs, **named)


_CALLS: dict[str, Callable[..., Any]] = {
    "abs": _abs,
    "all": _all,
    "any": _any,
    "ascii": _ascii,
    "bin": _whole_text(bin),
    "bool": _bool,
    "dict": _dict,
    "divmod": _divmod,
    "enumerate": _enumerate,
    "filter": _filter,
    "float": _float,
    "format": _format,
    "hex": _whole_text(hex),
    "int": _int,
    "list": _list,
    "map": _map,
    "max": _extreme(max),
    "min": _extreme(min),
    "next": _next,
    "oct": _whole_text(oct),
    "pow": _pow,
    "range": _range,
    "repr": _repr,
    "reversed": _reversed,
    "round": _round,
    "set": _set,
    "sorted": _sorted,
    "str": _str,
    "sum": _sum,
    "tuple": _tuple,
    "zip": _zip,
}
for _name, _call in _CALLS.items():
    _call.__name__ = _call.__qualname__ = _name  # as messages about arguments show it
