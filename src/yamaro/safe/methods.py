"""The attributes of values that safe code may read, by the exact type of the value.

What is in no table is refused: `str.format` reaches any attribute of its arguments, others
make texts of any length.
"""

from __future__ import annotations

from ..yaml.nodes import FlexiDict
from .values import OrderedSet

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from .guards import Guards

    Method = Callable[..., Any]


def _plain(kind: type, names: str) -> dict[str, Method]:
    """Return methods whose result is no larger than what they are given."""
    return {name: _counted(getattr(kind, name)) for name in names.split() if hasattr(kind, name)}


def _counted(method: Method) -> Method:
    def run(guards: Guards, owner: Any, /, *args: Any, **named: Any) -> Any:
        guards.charge_sizes(owner, *args)
        result = method(owner, *args, **named)
        guards.check_size(result)
        return result

    return run


# --- texts --------------------------------------------------------------------------------------


def _searching(name: str) -> Method:
    """Return a method that looks for a piece of text, from the end in quadratic time."""
    method = getattr(str, name)
    is_backwards = name[0] == "r"

    def run(guards: Guards, owner: str, /, *args: Any, **named: Any) -> Any:
        guards.charge_sizes(*args, *named.values())
        piece = args[0] if args else named.get("sep")
        size = len(piece) if type(piece) is str else 1
        if len(owner) > 64:
            guards.charge(len(owner) * (size if is_backwards else 8) >> 3)
        result = method(owner, *args, **named)
        if type(result) is list:
            guards.check_sequence(len(result))
        return result

    return run


def _stripping(name: str) -> Method:
    method = getattr(str, name)

    def run(guards: Guards, owner: str, /, *args: Any) -> str:
        marks = len(args[0]) if args and type(args[0]) is str else 8
        if len(owner) > 64:
            guards.charge(len(owner) * marks >> 3)
        return str(method(owner, *args))

    return run


def _padding(name: str) -> Method:
    method = getattr(str, name)

    def run(guards: Guards, owner: str, /, *args: Any) -> str:
        width = guards.plain(args[0]) if args else None
        if type(width) is int:
            guards.check_text(max(width, len(owner)))
        return str(method(owner, *args))

    return run


def _join(guards: Guards, owner: str, items: Any, /) -> str:
    texts = list(guards.items(items))
    lengths = [len(text) for text in texts if type(text) is str]
    guards.check_text(sum(lengths) + len(owner) * max(len(texts) - 1, 0))
    return owner.join(texts)


def _replace(guards: Guards, owner: str, old: Any, new: Any, /, count: Any = -1) -> str:
    count = guards.plain(count)
    if type(old) is str and type(new) is str and type(count) in (int, bool):
        guards.charge_sizes(owner, old, new)
        if len(owner) > 64:
            guards.charge(len(owner))
        times = owner.count(old)
        times = min(times, count) if count >= 0 else times
        guards.check_text(len(owner) + times * (len(new) - len(old)))
    return owner.replace(old, new, count)


# --- lists, dicts and sets ------------------------------------------------------------------------


def _comparing(kind: type, name: str) -> Method:
    """Return a method that compares each item with its argument."""
    method = getattr(kind, name)

    def run(guards: Guards, owner: Any, /, *args: Any) -> Any:
        guards.expanded(owner)
        for value in args:
            guards.measured(value)
        return method(owner, *args)

    return run


def _append(guards: Guards, owner: list[Any], item: Any, /) -> None:
    if len(owner) >= guards.limits.sequence:
        guards.check_sequence(len(owner) + 1)
    owner.append(item)


def _extend(guards: Guards, owner: list[Any], items: Any, /) -> None:
    items = guards.items(items)
    if len(owner) + len(items) > guards.limits.sequence:
        guards.check_sequence(len(owner) + len(items))
    owner.extend(items)


def _insert(guards: Guards, owner: list[Any], index: Any, item: Any, /) -> None:
    if len(owner) >= guards.limits.sequence:
        guards.check_sequence(len(owner) + 1)
    guards.charge(len(owner) >> 3)
    owner.insert(index, item)


def _pop_item(guards: Guards, owner: list[Any], /, *index: Any) -> Any:
    guards.charge(len(owner) >> 3 if index else 0)
    return owner.pop(*index)


def _sort(guards: Guards, owner: list[Any], /, *, key: Any = None, reverse: Any = False) -> None:
    owner[:] = guards.sort(owner, key=key, reverse=reverse)


def _get(guards: Guards, owner: dict[Any, Any], key: Any, default: Any = None, /) -> Any:
    return owner.get(guards.key(key, len(owner)), default)


def _copy_dict(guards: Guards, owner: dict[Any, Any], /) -> dict[Any, Any]:
    guards.check_table(len(owner))
    return owner.copy()


def _set_default(guards: Guards, owner: dict[Any, Any], key: Any, default: Any = None, /) -> Any:
    if len(owner) >= guards.limits.sequence:
        guards.check_sequence(len(owner) + 1)
    return owner.setdefault(guards.key(key, len(owner)), default)


def _pop_key(guards: Guards, owner: dict[Any, Any], key: Any, /, *default: Any) -> Any:
    return owner.pop(guards.key(key, len(owner)), *default)


def _update(guards: Guards, owner: dict[Any, Any], other: Any = (), /, **named: Any) -> None:
    changes = guards.new_dict(other, **named)
    guards.keys(changes, len(owner))
    if len(owner) + len(changes) > guards.limits.sequence:
        guards.check_sequence(len(owner | changes))
    owner.update(changes)


def _combining(name: str) -> Method:
    """Return a method of sets that takes any number of collections."""
    method = getattr(set, name)

    def run(guards: Guards, owner: set[Any], /, *others: Any) -> Any:
        sets = [guards.items(other) for other in others]
        for values in sets:
            guards.keys(values, len(owner))
        added = sum(map(len, sets)) if name in ("symmetric_difference", "union") else 0
        guards.check_table(len(owner) + added)
        result = method(owner, *sets)
        return OrderedSet(result) if type(result) is set else result

    return run


def _add(guards: Guards, owner: set[Any], item: Any, /) -> None:
    if len(owner) >= guards.limits.sequence:
        guards.check_sequence(len(owner) + 1)
    owner.add(guards.key(item, len(owner)))


def _remove(name: str) -> Method:
    method = getattr(set, name)

    def run(guards: Guards, owner: set[Any], item: Any, /) -> Any:
        return method(owner, guards.key(item, len(owner)))

    return run


def _update_set(guards: Guards, owner: set[Any], /, *others: Any) -> None:
    for other in others:
        values = guards.items(other)
        guards.keys(values, len(owner))
        guards.check_table(len(owner) + len(values))
        owner.update(values)


def _view(name: str) -> Method:
    method = getattr(dict, name)
    return lambda _, owner, /: method(owner)


def _keys_of_pairs(guards: Guards, owner: FlexiDict, /) -> list[Any]:
    guards.charge(len(owner))
    guards.keys([key for key, _ in owner.pairs])
    return owner.keys()


# --- the tables -----------------------------------------------------------------------------------

READING: dict[type, dict[str, Method]] = {
    str: {
        **_plain(
            str,
            "capitalize casefold endswith isalnum isalpha isascii isdecimal isdigit isidentifier "
            "islower isnumeric isprintable isspace istitle isupper lower removeprefix removesuffix "
            "splitlines startswith swapcase title upper",
        ),
        **{
            name: _searching(name)
            for name in ("count find index partition rfind rindex rpartition rsplit split".split())
        },
        **{name: _stripping(name) for name in ("lstrip", "rstrip", "strip")},
        **{name: _padding(name) for name in ("center", "ljust", "rjust", "zfill")},
        "join": _join,
        "replace": _replace,
    },
    int: _plain(int, "as_integer_ratio bit_count bit_length conjugate is_integer"),
    bool: _plain(bool, "as_integer_ratio bit_count bit_length conjugate is_integer"),
    float: _plain(float, "as_integer_ratio conjugate hex is_integer"),
    complex: _plain(complex, "conjugate"),
    list: {
        **_plain(list, "copy"),
        **{name: _comparing(list, name) for name in ("count", "index")},
    },
    tuple: {name: _comparing(tuple, name) for name in ("count", "index")},
    dict: {
        "copy": _copy_dict,
        **{name: _view(name) for name in ("items", "keys", "values")},
        "get": _get,
    },
    range: _plain(range, "count index"),
    OrderedSet: {
        name: _combining(name)
        for name in (
            "copy difference intersection isdisjoint issubset issuperset "
            "symmetric_difference union".split()
        )
    },
    FlexiDict: {"keys": _keys_of_pairs},
}
"""Methods that change nothing."""

CHANGING: dict[type, dict[str, Method]] = {
    list: {
        "append": _append,
        "clear": _counted(list.clear),
        "extend": _extend,
        "insert": _insert,
        "pop": _pop_item,
        "remove": _comparing(list, "remove"),
        "reverse": _counted(list.reverse),
        "sort": _sort,
    },
    dict: {
        "clear": _counted(dict.clear),
        "pop": _pop_key,
        "popitem": lambda _, owner, /: owner.popitem(),
        "setdefault": _set_default,
        "update": _update,
    },
    OrderedSet: {
        "add": _add,
        "clear": _counted(set.clear),
        "discard": _remove("discard"),
        "remove": _remove("remove"),
        "update": _update_set,
    },
}
"""Methods that change their object, for `process` blocks."""

for _methods in (*READING.values(), *CHANGING.values()):
    for _name, _method in _methods.items():
        _method.__name__ = _method.__qualname__ = _name  # as messages about arguments show it

DATA: dict[type, frozenset[str]] = {
    int: frozenset(("denominator", "imag", "numerator", "real")),
    bool: frozenset(("denominator", "imag", "numerator", "real")),
    float: frozenset(("imag", "real")),
    complex: frozenset(("imag", "real")),
    range: frozenset(("start", "step", "stop")),
}
"""Attributes that are plain values."""
