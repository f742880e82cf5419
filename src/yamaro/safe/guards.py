"""The guards that safe code calls in place of look-ups, calls, loops, texts and statements.

Each does what Python does, after it has checked by exact types that the result will not be too
large, and has counted what it costs. They are in the order of the language's reference; those of
operators are in `operators.py`.
"""

from __future__ import annotations

import operator
from itertools import islice
from math import log2

from ..diagnostics import did_you_mean
from ..namespace import Namespace
from ..yaml.nodes import FlexiDict
from .limits import RUN_IT, refused
from .methods import CHANGING, DATA, READING
from .values import (
    CONTAINERS,
    ITERABLES,
    LIST_ITERATOR,
    SCALARS,
    SEQUENCES,
    SET_LIKE,
    WHOLE,
    Function,
    Meter,
    Module,
    OrderedSet,
    a_type,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from typing import Any

    from .numpy import Numpy


# --- operators --------------------------------------------------------------------------------


class OperatorGuards(Meter):
    """The guards of operators."""

    # --- arithmetic ---

    def add(self, a: Any, b: Any) -> Any:
        """Return `a + b`."""
        result = a + b
        kind = type(result)
        if kind is float:
            return result
        if kind is int:
            if result.bit_length() > self.many_bits:
                self.check_bits(result.bit_length())
        else:
            self.check_size(result)
        return result

    def sub(self, a: Any, b: Any) -> Any:
        """Return `a - b`."""
        if type(a) in SET_LIKE:
            return self._combine(operator.sub, a, b)
        result = a - b
        if type(result) is int and result.bit_length() > self.many_bits:
            self.check_bits(result.bit_length())
        return result

    def neg(self, a: Any) -> Any:
        """Return `-a`."""
        result = -a
        if type(result) is int and result.bit_length() > self.many_bits:
            self.check_bits(result.bit_length())
        return result

    def invert(self, a: Any) -> Any:
        """Return `~a`."""
        self.charge_bits(a)
        return ~a

    def mul(self, a: Any, b: Any) -> Any:
        """Return `a * b`."""
        kind, other = type(a), type(b)
        if kind is float or other is float:
            return a * b
        if kind in WHOLE and other in WHOLE:
            self.check_bits(a.bit_length() + b.bit_length() - 1)
            return self._whole(a * b)
        if other in WHOLE:
            self.check_size(a, b)
        elif kind in WHOLE:
            self.check_size(b, a)
        return a * b

    def check_bits(self, bits: int) -> None:
        """Check and count a number of at least `bits` bits."""
        if bits > self.many_bits:
            self.check_integer(bits)
            self.charge(bits >> 5)

    def _whole(self, number: int) -> int:
        """Check a number of which only about the size was known before."""
        if number.bit_length() > self.limits.integer:
            self.check_integer(number.bit_length())
        return number

    def check_size(self, value: Any, times: int = 1) -> None:
        """Refuse a text or sequence that is too long, or would be if it were repeated."""
        kind = type(value)
        if kind is str:
            self.check_text(len(value) * max(times, 0))
        elif kind in SEQUENCES:
            self.check_sequence(len(value) * max(times, 0))

    def div(self, a: Any, b: Any) -> Any:
        """Return `a / b`, which is always a decimal number."""
        return a / b

    def floordiv(self, a: Any, b: Any) -> Any:
        """Return `a // b`."""
        self.charge_bits(a)
        return a // b

    def mod(self, a: Any, b: Any) -> Any:
        """Return `a % b`, unless that would be the formatting of a text."""
        if type(a) is str:
            raise refused("formatting a text with `%`", hint="write an f-string: f'{x:.3f}'")
        self.charge_bits(a)
        return a % b

    def matmul(self, a: Any, b: Any) -> Any:
        """Return `a @ b`, which only arrays have."""
        return a @ b

    def pow(self, a: Any, b: Any) -> Any:
        """Return `a ** b`."""
        if type(a) in WHOLE and type(b) in WHOLE and b > 0:
            self.check_bits((a.bit_length() - 1) * b)
            return self._whole(a**b)
        return a**b

    def lshift(self, a: Any, b: Any) -> Any:
        """Return `a << b`."""
        if type(a) in WHOLE and type(b) in WHOLE and b > 0 and a:
            self.check_bits(a.bit_length() + b)
        return a << b

    def rshift(self, a: Any, b: Any) -> Any:
        """Return `a >> b`."""
        self.charge_bits(a)
        return a >> b

    def bit_and(self, a: Any, b: Any) -> Any:
        """Return `a & b`."""
        return self._combine(operator.and_, a, b)

    def bit_or(self, a: Any, b: Any) -> Any:
        """Return `a | b`."""
        return self._combine(operator.or_, a, b)

    def bit_xor(self, a: Any, b: Any) -> Any:
        """Return `a ^ b`."""
        return self._combine(operator.xor, a, b)

    def _combine(self, operate: Callable[[Any, Any], Any], a: Any, b: Any) -> Any:
        """Return the result of an operator that sets and dicts have too."""
        if type(a) in WHOLE:
            self.charge_bits(a, b)
            return operate(a, b)
        for value in (a, b):
            if type(value) in CONTAINERS:
                self.keys(value if type(value) is not OrderedSet else set.__iter__(value))
                self.charge(len(value))
        result = operate(a, b)
        if type(result) is set:
            result = OrderedSet(result)
        if type(result) in CONTAINERS:
            self.check_table(len(result))
        return result

    # --- comparisons ---

    def hashed(self, value: Any) -> Any:
        """Return the left side of an `in`: it may be hashed, and compared with each item."""
        return self.measured(value)

    def searched(self, value: Any) -> Any:
        """Return the right side of an `in`, having counted what searching it costs."""
        kind = type(value)
        if kind is str:
            self.charge(len(value))
        elif kind is range:
            self.charge(len(value) >> 2)
        elif kind in SEQUENCES or kind is FlexiDict or kind is LIST_ITERATOR:
            self.charge(operator.length_hint(value))
            if kind is not LIST_ITERATOR:
                self.expanded(value)
        elif kind in CONTAINERS:
            self.charge(len(value) >> 4)
            if kind is type({}.values()) or kind is type({}.items()):
                self.expanded(value)
        return value


# --- guards -----------------------------------------------------------------------------------


_MANY = 60  # more names are not listed in a message
_GENERATOR = type(_ for _ in ())
_ERRORS = {
    kind.__name__: kind
    for kind in (Exception, NotImplementedError, RuntimeError, TypeError, ValueError)
}


class Guards(OperatorGuards):
    """The guards of one conversion, with the count of its steps.

    Attributes:
        calls: how many lambdas are running, one within the other.
        own: the identities of the functions written in C that may be called.
        lazy_functions: the permitted `any`, `all` and `next`.
        types: the permitted functions that are types in Python, with these types.
        numpy: the stand-in for numpy, once it is imported.
    """

    calls = 0
    _owner_size = 0
    own: frozenset[int] = frozenset()
    lazy_functions: tuple[Function, ...] = ()
    types: Sequence[tuple[Any, Any]] = ()
    numpy: Numpy | None = None

    # --- collections ---

    def item(self, owner: Any, index: Any) -> Any:
        """Return `owner[index]`."""
        kind = type(owner)
        if kind is dict:
            self.key(index, len(owner))
        elif kind is FlexiDict:
            self.charge(len(owner))
            self.measured(index)
        elif kind in self.foreign and not hasattr(kind, "__getitem__"):
            raise refused(f"an item of {a_type(owner)}")
        return owner[index]

    def piece(self, owner: Any, start: Any, stop: Any, step: Any) -> Any:
        """Return `owner[start:stop:step]`."""
        piece = owner[slice(start, stop, step)]
        self.check_size(piece)
        return piece

    def block(self, owner: Any) -> Any:
        """Return an array, slices of which are about to be read or assigned in a tuple."""
        if type(owner) in self.foreign:
            return owner
        raise refused("a slice in several dimensions", f"{a_type(owner)} has but one")

    def array_to_change(self, owner: Any) -> Any:
        """Return an array, a slice of which is about to be assigned."""
        if type(owner) in self.foreign:
            return owner
        raise refused("an assignment to a slice", f"this is {a_type(owner)}, and not an array")

    def display(self, made: Any) -> Any:
        """Return a list, tuple or dict into which others were unpacked."""
        (self.check_table if type(made) is dict else self.check_sequence)(len(made))
        return made

    def spread(self, value: Any) -> Any:
        """Return what is unpacked by `*`, having counted its items."""
        return self.items(value)

    def mapping(self, value: Any) -> Any:
        """Return what is unpacked by `**`."""
        if type(value) is not dict:
            raise TypeError(f"argument after ** must be a mapping, not {type(value).__name__}")
        self.check_sequence(len(value))
        self.keys(value)
        return value

    def set_of(self, items: list[Any]) -> OrderedSet:
        """Return the set of items."""
        self.check_table(len(items))
        self.keys(items)
        return OrderedSet(items)

    def dict_of(self, pairs: list[tuple[Any, Any]]) -> dict[Any, Any]:
        """Return the dict of pairs."""
        self.check_table(len(pairs))
        self.keys([key for key, _ in pairs])
        return dict(pairs)

    def list_of(self, items: Iterator[Any]) -> list[Any]:
        """Return the list of what a generator gives, which counts its own steps."""
        made = list(islice(items, self.limits.sequence + 1))
        if len(made) > self.limits.sequence:
            self.check_sequence(len(made))
        return made

    # --- attributes and calls ---

    def attribute(self, owner: Any, name: str) -> Any:
        """Return `owner.name`, for reading."""
        kind = type(owner)
        if kind is Module:
            try:
                return owner.members[name]
            except KeyError:
                hint: str | None = did_you_mean(name, owner.members)
                if hint is None:
                    known = len(owner.members)
                    hint = RUN_IT
                    if known <= _MANY:
                        hint = f"`{owner.name}` has {', '.join(sorted(owner.members))}"
                raise refused(f"`{owner.name}.{name}`", hint=hint) from None
        if kind is Namespace:
            return getattr(owner, name)
        method = READING.get(kind, {}).get(name)
        if method is not None:
            bound = Function(method, self, owner)
            bound.shown = f"<method {name} of {a_type(owner)}>"
            return bound
        if name in DATA.get(kind, ()):
            return getattr(owner, name)
        return self._no_attribute(owner, name)

    def attribute_to_change(self, owner: Any, name: str) -> Any:
        """Return `owner.name` in a process block, where methods may change their object."""
        method = CHANGING.get(type(owner), {}).get(name)
        if method is not None:
            return Function(method, self, owner)
        return self.attribute(owner, name)

    def _no_attribute(self, owner: Any, name: str) -> Any:
        kind = type(owner)
        if name in CHANGING.get(kind, {}):
            raise refused(
                f"the method `{name}`",
                f"it changes {a_type(owner)}",
                f"call `{name}` in a `process` statement",
            )
        if kind is Function or id(owner) in self.own:
            raise refused("an attribute of a function", hint="write a lambda: lambda x: x.upper()")
        if kind in self.foreign and hasattr(owner.data, name):
            known = (*READING.get(kind, ()), *DATA.get(kind, ()))
            hint = did_you_mean(name, known) or RUN_IT
            raise refused(f"the attribute `{name}` of {a_type(owner)}", hint=hint)
        if kind in self.foreign:
            return getattr(owner.data, name)  # raises Python's own error
        if kind not in SCALARS and (kind not in ITERABLES or kind is LIST_ITERATOR):
            raise refused(f"an attribute of {a_type(owner)}")
        if hasattr(kind, name):
            hint = "write an f-string: f'{x:.3f}'" if name[:6] == "format" else RUN_IT
            raise refused(f"the method `{name}` of {a_type(owner)}", hint=hint)
        return getattr(owner, name)  # raises Python's own error

    def called(self, value: Any) -> Any:
        """Return what is about to be called."""
        kind = type(value)
        if kind is Function or id(value) in self.own:
            return value
        is_value = kind in SCALARS or kind in ITERABLES or kind in self.foreign
        if is_value or kind is Module or kind is Namespace:
            return value  # the call raises Python's own error
        raise refused(f"calling {a_type(value)}")

    def lazy(self, value: Any) -> Any:
        """Return what is about to be called with a generator expression first.

        Only `any`, `all` and `next` get the generator; others get what it gives.
        """
        if any(value is function for function in self.lazy_functions):
            return value
        call = self.called(value)
        return lambda items, *args, **named: call(self.iterator_of(items), *args, **named)

    def function(self, made: Callable[..., Any], weight: int) -> Function:
        """Return a lambda that counts its steps and how deep it calls itself."""
        function = Function(self._run, made, weight)
        function.shown = "<function <lambda>>"
        return function

    def _run(self, made: Callable[..., Any], weight: int, /, *args: Any, **named: Any) -> Any:
        self.steps += weight
        if self.steps > self._most_steps:
            raise self.out_of_steps()
        if self.calls >= self.limits.calls:
            raise self.limits.passed("calls", "this function calls itself too deeply")
        self.calls += 1
        try:
            return made(*args, **named)
        finally:
            self.calls -= 1

    # --- loops ---

    def each(self, source: Any, weight: int) -> Iterator[Any]:
        """Return an iterator that counts the steps of each turn."""
        return self._count(self._iterate(source), weight)

    def _count(self, items: Iterator[Any], weight: int) -> Iterator[Any]:
        most = self._most_steps
        for item in items:
            self.steps += weight
            if self.steps > most:
                raise self.out_of_steps()
            yield item

    def _iterate(self, source: Any) -> Iterator[Any]:
        kind = type(source)
        if kind in ITERABLES or kind in SCALARS or kind in self.foreign:
            return iter(source)
        if kind is Function or kind is Module or kind is Namespace or id(source) in self.own:
            raise TypeError(f"{a_type(source)} cannot be iterated over")
        if kind is _GENERATOR:
            return source  # type: ignore[no-any-return]
        raise refused(f"iterating over {a_type(source)}")

    def items(self, source: Any) -> Any:
        """Return a collection, or else a list of what an iterator gives, having counted it."""
        kind = type(source)
        if kind in ITERABLES and kind is not LIST_ITERATOR:
            size = len(source)
            if size:
                self.charge(size)
            return source
        return self.list_of(self.each(source, 1))

    def iterator_of(self, items: Iterator[Any]) -> Iterator[Any]:
        """Return what a generator expression gives, for callers that go through all of it."""
        return iter(self.list_of(items))

    # --- texts ---

    def join(self, *parts: str) -> str:
        """Return the parts of an f-string as one text."""
        self.check_text(sum(map(len, parts)))
        return "".join(parts)

    def formatted(self, value: Any, conversion: str, spec: str) -> str:
        """Return a value as an f-string shows it."""
        if conversion:
            value = self.representation(value) if conversion != "s" else self.text(value)
            if conversion == "a":
                value = value.encode("ascii", "backslashreplace").decode("ascii")
        kind = type(value)
        if not spec and kind not in self.foreign:  # for which it is not always what `str` gives
            return self.text(value)
        if kind in SCALARS or kind in self.foreign:
            if spec:
                if spec[-1] == "n":
                    raise refused(
                        "the format `n`",
                        "its result depends on the language of the machine",
                        "write the format `d` or `g`",
                    )
                self.check_text(len(spec))
                digits = 0
                for char in spec:
                    # Digits of any script count.
                    digits = digits * 10 + int(char) if char.isdecimal() else 0
                    if digits > self.limits.width:
                        raise self.limits.passed(
                            "width", f"the format '{spec[:40]}' makes long texts"
                        )
            if kind is int:
                self.check_bits(value.bit_length())
            elif kind is str:
                self.check_text(len(value))
            written = format(value, spec)
            self.check_text(len(written))
            return written
        if kind in CONTAINERS or kind in (Function, Module, Namespace, range):
            name = "set" if kind is OrderedSet else kind.__name__
            raise TypeError(f"unsupported format string passed to {name}.__format__")
        raise refused(f"formatting {a_type(value)}")

    # --- coming in ---

    def admit_foreign(self, value: Any) -> Any:
        """Return the wrapper of an object of numpy's, which the caller may go on changing.

        Raises:
            SafetyError: it is not plain data.
        """
        from .numpy import numpy_of

        return numpy_of(self).admit(value)

    # --- statements ---

    def owner(self, value: Any) -> Any:
        """Return a list or dict, an item of which is about to be assigned."""
        kind = type(value)
        self._owner_size = 0
        if kind is dict:
            self._owner_size = len(value)
            if len(value) >= self.limits.sequence:
                self.check_sequence(len(value) + 1)
        elif kind is list or kind in self.foreign:
            pass  # the item is there already
        elif kind not in SCALARS and kind not in ITERABLES:
            raise refused(f"an assignment to an item of {a_type(value)}")
        return value

    def stored_key(self, key: Any) -> Any:
        """Return the key of that item."""
        return self.key(key, self._owner_size)

    def change(self, name: str, value: Any, other: Any) -> Any:
        """Return what a variable is after `value += other`, or another such operator."""
        kind = type(value)
        if kind in self.foreign:
            value = _IN_PLACE[name](value, other)
        elif kind is list and name == "iadd" and type(other) not in self.foreign:
            items = self.items(other)
            self.check_sequence(len(value) + len(items))
            value += items
        elif kind is list and name == "imul" and type(other) in WHOLE:
            self.check_size(value, other)
            value *= other
        elif kind is dict and name == "ibit_or" and type(other) is dict:
            CHANGING[dict]["update"](self, value, other)
        elif kind is OrderedSet and type(other) is OrderedSet and name in _OF_SETS:
            self.keys(set.__iter__(other), len(value))
            self.check_sequence(len(value) + len(other))
            value = _IN_PLACE[name](value, other)
        else:
            value = getattr(self, name[1:])(value, other)
        return value

    def change_item(self, name: str, owner: Any, key: Any, other: Any) -> None:
        """Do `owner[key] += other`, or another such operator."""
        self.owner(owner)[key] = self.change(name, self.item(owner, key), other)

    def change_block(self, name: str, owner: Any, key: Any, other: Any) -> None:
        """Do the same with a slice in the key, which only arrays may have."""
        if type(owner) not in self.foreign:
            raise refused("this kind of assignment", f"this is {a_type(owner)}, and not an array")
        owner[key] = self.change(name, owner[key], other)

    def error(self, name: str, message: Any) -> Exception:
        """Return the exception that `raise` is to raise."""
        return _ERRORS[name](self.text(message))

    # --- what methods and functions share ---

    def sort(self, values: Any, /, *, key: Any = None, reverse: Any = False) -> list[Any]:
        """Return what Python's `sorted` does."""
        items = list(self.items(values))
        if key is None:
            self.check_sortable(items, len(items))
            return sorted(items, reverse=reverse)
        keys = list(map(self.called(key), items))
        self.check_sortable(keys, len(keys))
        order = sorted(range(len(items)), key=keys.__getitem__, reverse=reverse)
        return [items[index] for index in order]

    def new_dict(self, pairs: Any = (), /, **named: Any) -> dict[Any, Any]:
        """Return what Python's `dict` does."""
        if type(pairs) is dict:
            self.check_table(len(pairs))
            self.keys(pairs)
            return dict(pairs, **named)
        checked: list[Any] = []
        for pair in self.items(pairs):
            checked.append(tuple(self.items(pair)) if type(pair) in ITERABLES else pair)
            if type(checked[-1]) is not tuple or len(checked[-1]) != 2:
                break  # dict says what is wrong with it
        else:
            self.check_table(len(checked))
            self.keys([key for key, _ in checked])
        return dict(checked, **named)

    def check_sortable(self, values: Iterable[Any], count: int) -> None:
        """Count what it costs to sort values."""
        size = sum(
            self.expanded(value) if type(value) in CONTAINERS else 1 + self._long(value)
            for value in values
        )
        self.charge(int(size * log2(count + 2)))

    def _long(self, value: Any) -> int:
        return len(value) >> 9 if type(value) is str else 0


_IN_PLACE: dict[str, Callable[[Any, Any], Any]] = {
    "iadd": operator.iadd,
    "ibit_and": operator.iand,
    "ibit_or": operator.ior,
    "ibit_xor": operator.ixor,
    "idiv": operator.itruediv,
    "ifloordiv": operator.ifloordiv,
    "ilshift": operator.ilshift,
    "imatmul": operator.imatmul,
    "imod": operator.imod,
    "imul": operator.imul,
    "ipow": operator.ipow,
    "irshift": operator.irshift,
    "isub": operator.isub,
}
_OF_SETS = frozenset(("ibit_and", "ibit_or", "ibit_xor", "isub"))
