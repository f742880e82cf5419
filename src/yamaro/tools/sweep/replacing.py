"""What is replaced while a variant is recorded, so that recorded numbers pass.

- The functions of `math` and of Python that take plain numbers, or compare numbers to find one of
  them. They become one operation each.
- Functions of Yamaro that make texts of numbers and look at these texts, and those that take
  another way for nearly every variant, such as the search for principal axes.

Modules have them under the names that they have imported, so these names are set to others and
back.
"""

from __future__ import annotations

import builtins
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from ... import units
from ...model import convex, inertia, pose
from ...robot import numbers
from ...runtime import modules, predefined
from ...targets import elements
from ...targets import inertia as moments
from ...targets.mjcf import scene
from ...xml import forms, values
from .recording import MARK, OURS, PLAIN, Number, Tape, is_recorded

METHODS = ((convex.Convex, "farthest"), (units.Unit, "to_si"), (units.Unit, "from_si"))
"""The methods that become one operation each."""
FUNCTIONS: tuple[Callable[..., Any], ...] = (
    values.format_number, values.format_value, elements.number, numbers.format_component,
    numbers.negated, moments.written_moments, moments.balanced, pose.quaternion_from_rotation,
)  # fmt: skip
"""The functions of Yamaro that become one operation each."""
LEFT_ALONE = (values, forms)
"""Modules that compare types with `float`."""


@contextmanager
def replaced(tape: Tape) -> Iterator[None]:
    """Replace functions for a while: what they do with recorded numbers goes to a tape."""
    own, built_in = _of_yamaro(tape), _of_python(tape)
    mathematics = ModuleType("math")
    for name, value in vars(math).items():
        is_function = callable(value) and not isinstance(value, type)
        setattr(mathematics, name, one_operation(tape, value) if is_function else value)
        if is_function:
            own[id(value)] = getattr(mathematics, name)
    own[id(math)] = mathematics
    undone: list[tuple[dict[str, Any], str, Any]] = []
    missing = object()

    def put(names: dict[str, Any], name: str, value: Any) -> None:
        undone.append((names, name, names.get(name, missing)))
        names[name] = value

    def put_all(names: dict[str, Any], new: dict[int, Any]) -> None:
        for name, value in [*names.items()]:
            if id(value) in new:
                put(names, name, new[id(value)])

    def import_recording(name: str, *given: Any) -> Any:
        return mathematics if name == "math" else __import__(name, *given)

    modules_before = _modules()
    for module in modules_before:
        names = vars(module)
        for table in _tables(names):
            put_all(table, own)
        for name, value in built_in.items() if module not in LEFT_ALONE else ():
            if name not in names:
                put(names, name, value)
    put_all(
        predefined.CONSTANTS, {id(getattr(builtins, name)): built_in[name] for name in built_in}
    )
    put(vars(modules), "__import__", import_recording)
    methods = [(kind, name, vars(kind)[name]) for kind, name in METHODS]
    for kind, name, method in methods:
        setattr(kind, name, one_operation(tape, method))
    try:
        yield
    finally:
        for kind, name, method in methods:
            setattr(kind, name, method)
        for names, name, value in reversed(undone):
            if value is missing:
                del names[name]
            else:
                names[name] = value
        old = {id(new): value for names, name, value in undone for new in (own.get(id(value)),)}
        for module in _modules():  # those loaded meanwhile have imported what is replaced
            if module not in modules_before:
                for table in _tables(vars(module)):
                    for name, value in [*table.items()]:
                        if id(value) in old:
                            table[name] = old[id(value)]


def _modules() -> list[ModuleType]:
    """Return the modules of Yamaro, except for those that record."""
    apart = (__name__, Tape.__module__, f"{__package__}.columns")
    return [
        each for name, each in [*sys.modules.items()] if name.startswith(OURS) and name not in apart
    ]


def _tables(names: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the dicts in which a module may have functions."""
    inner = [each for name, each in names.items() if type(each) is dict and name[:2] != "__"]
    return [names, *(each for each in inner if each is not names)]


def one_operation(tape: Tape, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that does the same, as one operation on recorded numbers."""

    def replacement(*given: Any, **named: Any) -> Any:
        if not named and any(map(is_recorded, given)):
            return tape.call(function, *given)
        return function(*given, **named)

    return replacement


def _of_yamaro(tape: Tape) -> dict[int, Any]:
    """Return what replaces functions of Yamaro, by their identities."""
    axes, plain, quantity = inertia.principal_axes, values.plain_value, units.parse_quantity
    overlaps, number = convex.overlapping, _float_for(tape)

    def principal_axes(matrix: Any) -> Any:
        (_, xy, xz), (_, _, yz), _ = matrix
        if not is_recorded(matrix) or not (xy or xz or yz):
            return axes(matrix)
        return tape.call(axes, matrix)

    def plain_value(value: Any) -> Any:
        return value if type(value) is Number else plain(value)

    def floats(words: Sequence[str]) -> tuple[Any, ...]:
        return tuple(map(number, words))

    def parse_quantity(text: str) -> Any:
        if not is_recorded(text):
            return quantity(text)
        _, dimension = quantity(tape.concrete(text))
        return tape.call(_value_of, text), dimension

    def _value_of(text: str) -> float:
        return quantity(text)[0]

    def overlapping(shapes: Any, *given: Any) -> Any:
        if not is_recorded(shapes):
            return overlaps(shapes, *given)
        return tape.settle(overlaps, shapes, *given)

    return {
        **{id(each): one_operation(tape, each) for each in FUNCTIONS},
        id(axes): principal_axes,
        id(plain): plain_value,
        id(quantity): parse_quantity,
        id(values.floats): floats,
        id(overlaps): overlapping,
        id(scene.scene): lambda *given: b"",  # which is not in a batch
    }


def _of_python(tape: Tape) -> dict[str, Any]:
    """Return what replaces built-in functions, by their names."""

    def sum_of(given: Any, *start: Any) -> Any:
        each = [*given]  # floats are summed in another way than objects
        is_flat = all(isinstance(part, PLAIN) for part in each)
        if is_flat and not start and any(map(is_recorded, each)):
            return tape.call(sum, each)
        return sum(each, *start)

    def one_of(function: Callable[..., Any]) -> Callable[..., Any]:
        def found_of(*given: Any, **named: Any) -> Any:
            if not given or named.get("key") is not None:
                return function(*given, **named)
            each = [*given[0]] if len(given) == 1 else [*given]
            kinds = {type(tape.concrete(part)) for part in each}
            if kinds == {float} and is_recorded(each):  # else the result may be of either kind
                return tape.call(function, each)
            return function(each, **named)

        return found_of

    def sorted_of(given: Any, **named: Any) -> list[Any]:
        return sorted(given, **named) if named else [*in_order(given)]

    def row(each: Any) -> tuple[Any, ...]:
        return tuple(sorted(each))

    in_order = one_of(row)
    return {
        "float": _float_for(tape), "max": one_of(max), "min": one_of(min), "sorted": sorted_of,
        "sum": sum_of,
    }  # fmt: skip


def _float_for(tape: Tape) -> type:
    """Return what replaces `float` where it is called."""

    class Kind(type):
        def __call__(cls, *given: Any) -> Any:
            if given and type(given[0]) is Number:
                number = given[0]
                return number if type(number.value) is float else tape.call(float, number)
            if given and type(given[0]) is str and MARK.search(given[0]):
                return tape.call(float, given[0])
            return float(*given)

        def __instancecheck__(cls, value: object) -> bool:
            return isinstance(value, float)

        def __eq__(cls, other: object) -> bool:
            return cls is other or other is float

        def __hash__(cls) -> int:
            return hash(float)

    class Float(metaclass=Kind):
        fromhex = float.fromhex

    return Float
