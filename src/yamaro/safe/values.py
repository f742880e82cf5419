"""The values that safe code meets, and the cost of handling them.

Code in safe mode never holds an object whose operators, iteration or text run code of a file, nor a
generator, a code object, a frame or a module. What it holds is of the exact types listed here; all
else is refused where it would come in (`Meter.admit`).
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from operator import index

from ..namespace import Namespace
from ..yaml.nodes import FlexiDict
from .limits import SafeLimits, SafetyError, refused

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from typing import Any

WORDS_OF_TYPES = {
    "Array": "an array",
    "Module": "a module",
    "Namespace": "a namespace",
    "Number": "a number of numpy",
    "OrderedSet": "a set",
    "Whole": "a number of numpy",
    "builtin_function_or_method": "a function",
    "Function": "a function",
    "list_iterator": "an iterator",
    "NoneType": "nothing (null)",
    "float": "a number",
    "int": "a number",
    "str": "a text",
}


class Function(partial):  # type: ignore[type-arg]
    """A function that safe code may call: a permitted one, a lambda, or a method with its object.

    A `partial` calls as fast as Python can. Its own attributes are out of reach, since each
    attribute is looked up by exact type.
    """

    __slots__ = ("shown",)
    shown: str

    def __repr__(self) -> str:
        return self.shown


def function(call: Callable[..., Any], shown: str, *bound: Any) -> Function:
    """Return a permitted function that Python would show as `shown`."""
    made = Function(call, *bound)
    made.shown = shown
    return made


class Module:
    """The stand-in for a Python module: a few of its functions and numbers, by name."""

    __slots__ = ("members", "name")

    def __init__(self, name: str, members: dict[str, Any]) -> None:
        self.name = name
        self.members = members

    def __repr__(self) -> str:
        return f"<module '{self.name}'>"


class Foreign:
    """A value of a library that is not Python's own, wrapped: its operators count their steps.

    Attributes:
        data: the value itself, which no code of a file gets hold of.
    """

    __slots__ = ()
    data: Any

    def of_its_kind(self, value: Any) -> Any:
        """Return the wrapper of a value of the same library."""
        raise NotImplementedError


class OrderedSet(set):  # type: ignore[type-arg]
    """A set whose order is the same in every run.

    Python orders texts by hashes that change from run to run. Sets of numbers keep Python's order.
    """

    __slots__ = ()

    def __iter__(self) -> Iterator[Any]:
        items = list(super().__iter__())
        if all(_has_fixed_hash(item) for item in items):
            return iter(items)
        keyed = sorted(((_order(item), item) for item in items), key=lambda pair: pair[0])
        for (key, item), (following, _) in pairwise(keyed):
            if key == following and item == item:
                raise refused("a set of functions", "its order is chance", "write a list: […]")
        return iter([item for _, item in keyed])

    def __repr__(self) -> str:
        return f"{{{', '.join(map(repr, self))}}}" if self else "set()"

    __str__ = __repr__

    def __reduce__(self) -> Any:
        return (OrderedSet, (list(self),))


def _has_fixed_hash(item: Any) -> bool:
    if type(item) is tuple:
        return all(map(_is_number, item))
    return _is_number(item)


def _is_number(item: Any) -> bool:
    """Return whether a value is a number other than nan, whose hash differs from run to run."""
    return (type(item) in NUMBERS or isinstance(item, Foreign)) and bool(item == item)


def _order(item: Any) -> tuple[str, Any]:
    """Return a key by which any hashable values can be sorted."""
    kind = type(item)
    if kind in (str, int, float, bool):
        return ("1" if kind is str else "0", item) if item == item else ("", 0)
    return (f"2{kind.__name__}", repr(item))


NUMBERS = frozenset((int, float, bool, complex))
WHOLE = frozenset((int, bool))
SCALARS = frozenset((int, float, bool, complex, str, type(None)))
DICT_VIEWS = frozenset((type({}.keys()), type({}.values()), type({}.items())))
SET_LIKE = frozenset((OrderedSet, type({}.keys()), type({}.items())))
LIST_ITERATOR: type = type(iter([]))
SEQUENCES = frozenset((list, tuple))
CONTAINERS = frozenset((list, tuple, dict, OrderedSet, FlexiDict)) | DICT_VIEWS
ITERABLES = CONTAINERS | {str, range, LIST_ITERATOR}
OPAQUE = frozenset((Function, Module, Namespace, range, LIST_ITERATOR))
TAME = frozenset((str, bool, type(None)))
"""Types whose hashes nobody can choose, or of which there are too few to do harm."""

_LONG = 16  # shorter texts cost nothing beyond the step that makes them
MANY_BITS = 512  # whole numbers with fewer do neither
_TAME_INTEGER = 1 << 31


def a_type(value: Any) -> str:
    """Return what a value is, in words for a message."""
    name = type(value).__name__
    return WORDS_OF_TYPES.get(name) or f"{'an' if name[:1] in 'aeiou' else 'a'} {name}"


class Meter:
    """Counts the steps of one conversion, and measures values before they are worked on.

    Attributes:
        steps: taken so far.
        limits: how many may be taken, and how large values may be.
        foreign: further exact types that are let in, such as the wrappers of numpy's, each
            with a function that returns the size of a value.
        many_bits: of a whole number that is worth counting.
    """

    def __init__(self, limits: SafeLimits) -> None:
        self.limits = limits
        self.steps = 0
        self.foreign: dict[type, Callable[[Any], int]] = {}
        self._most_steps = limits.steps
        self.many_bits = min(MANY_BITS, limits.integer)

    # --- steps ---

    def charge(self, steps: int) -> None:
        """Count steps.

        Raises:
            SafetyError: there were too many.
        """
        self.steps += steps
        if self.steps > self._most_steps:
            raise self.out_of_steps()

    def out_of_steps(self) -> SafetyError:
        """Return the error for too many steps."""
        return self.limits.passed("steps", "the expressions of this file take too many steps")

    def charge_sizes(self, *values: Any) -> None:
        """Count what it costs to go through the given texts and collections once."""
        for value in values:
            kind = type(value)
            if kind in SCALARS and kind is not str:
                continue
            if kind in ITERABLES and kind is not LIST_ITERATOR:
                size = len(value)
                if kind is not str:
                    self.charge(size)
                elif size > _LONG:
                    self.charge(size >> 3)

    def charge_bits(self, *values: Any) -> None:
        """Count what it costs to compute with large whole numbers, and to keep the result."""
        for value in values:
            if type(value) is int and value.bit_length() > self.many_bits:
                self.charge(value.bit_length() >> 5)

    def plain(self, value: Any) -> Any:
        """Return a number from another library as Python's own, where Python would take it so.

        Python takes such a number for a size, and its own type is what the guards look at.
        """
        is_whole = type(value) in self.foreign and hasattr(type(value), "__index__")
        return index(value) if is_whole else value

    # --- sizes ---

    def check_text(self, size: int) -> None:
        """Count a text that is about to be made.

        Raises:
            SafetyError: it is too long.
        """
        if size > _LONG:
            if size > self.limits.text:
                raise self.limits.passed("text", f"this text has {size:,} characters")
            self.charge(size >> 3)

    def check_sequence(self, size: int) -> None:
        """Count a collection that is about to be made.

        Raises:
            SafetyError: it has too many items.
        """
        if size > self.limits.sequence:
            raise self.limits.passed("sequence", f"this makes {size:,} items")
        self.charge(size)

    def check_table(self, size: int) -> None:
        """Count a dict or set that is about to be made; an item takes as much as four of a list.

        Raises:
            SafetyError: it has too many items.
        """
        self.check_sequence(size)
        self.charge(size * 3)

    def check_integer(self, bits: int) -> None:
        """Check a whole number that is about to be computed.

        Raises:
            SafetyError: it has too many bits.
        """
        if bits > self.limits.integer:
            raise self.limits.passed(
                "integer",
                f"this whole number has {bits:,} bits",
                "a decimal number, such as 10.0, has no such limit",
            )

    def expanded(self, value: Any) -> int:
        """Return the items in a collection, with those in lists within lists each time they occur.

        `[[[0] * 1000] * 1000] * 1000` takes 24 kB and has a thousand million items.

        Raises:
            SafetyError: there are too many, or they are nested too deep.
        """
        count = 0
        most, deepest = self.limits.sequence, self.limits.depth
        stack: list[Iterator[Any]] = [_parts(value)]
        while stack:
            for item in stack[-1]:
                kind = type(item)
                if kind in CONTAINERS:
                    count += 1
                    stack.append(_parts(item))
                    break
                count += 1 if kind in SCALARS and kind is not str else self._size_of_leaf(item)
                if count > most:
                    raise self._too_many(count)
            else:
                stack.pop()
            if count > most:
                raise self._too_many(count)
            if len(stack) > deepest:
                raise self.limits.passed(
                    "depth",
                    "lists are nested too deep here",
                    "a list cannot contain itself",
                )
        self.charge(count)
        return count

    def _too_many(self, count: int) -> SafetyError:
        return self.limits.passed(
            "sequence", f"with the lists in it, this value has more than {count - 1:,} items"
        )

    def _size_of_leaf(self, value: Any) -> int:
        kind = type(value)
        if kind is str:
            return 1 + (len(value) >> 6)
        if kind in self.foreign:
            return self.foreign[kind](value)
        return 1

    def measured(self, value: Any) -> Any:
        """Return a value that is about to be compared or hashed, having counted what that costs."""
        kind = type(value)
        if kind is str:
            if len(value) > 4096:
                self.charge(len(value) >> 9)
        elif kind in CONTAINERS:
            self.expanded(value)
        return value

    # --- keys of dicts, items of sets ---

    def key(self, value: Any, owner_size: int = 0) -> Any:
        """Return a value that is about to be hashed.

        A file can choose numbers whose hashes collide, so that each look-up goes through all that
        is there. Therefore values whose hashes can be chosen count as if they did.
        """
        if type(value) is tuple:
            self.expanded(value)
        if owner_size > 64 and not _is_tame(value):
            self.charge(owner_size >> 2)
        return value

    def keys(self, values: Iterable[Any], owner_size: int = 0) -> None:
        """Count what it costs to put values into a set, or as keys into a dict."""
        wild = 0
        for value in values:
            if type(value) is tuple:
                self.expanded(value)
            if not _is_tame(value):
                wild += 1
        if wild + owner_size > 64:
            self.charge(wild * (wild + owner_size) >> 2)

    # --- coming in, going out ---

    def admit(self, value: Any) -> Any:
        """Return a value from outside, having checked that it is plain data.

        Raises:
            SafetyError: it is or holds anything else.
        """
        kind = type(value)
        if kind in SCALARS or kind in OPAQUE:
            return value
        if kind is set or kind is frozenset:
            return OrderedSet(value)
        if kind.__module__ == "numpy" and kind not in self.foreign:
            return self.admit_foreign(value)
        if kind not in CONTAINERS and kind not in self.foreign:
            raise _not_plain(value)
        if kind in CONTAINERS:
            self.expanded(value)
            for item in _leaves(value):
                if type(item) not in SCALARS:
                    if type(item).__module__ == "numpy" and type(item) not in self.foreign:
                        raise _not_plain(item)  # a list cannot be changed on its way in
                    self.admit(item)
        return value

    def admit_foreign(self, value: Any) -> Any:
        """Return the wrapper of an object of numpy's.

        Raises:
            SafetyError: it is not plain data.
        """
        raise _not_plain(value)

    def text(self, value: Any) -> str:
        """Return what `str` gives.

        Raises:
            SafetyError: it would be too long, or differ from run to run.
        """
        kind = type(value)
        if kind is str:
            return value  # type: ignore[no-any-return]
        if kind in self.foreign:  # the text of these is not what `repr` gives
            written = str(value)
            self.check_text(len(written))
            return written
        return self.representation(value)

    def representation(self, value: Any) -> str:
        """Return what `repr` gives; see `text`."""
        kind = type(value)
        if kind is float or kind is bool or value is None:
            return repr(value)
        if kind is int:
            bits = value.bit_length()
            if bits > 64:
                self.check_integer(bits)
                self.charge(bits >> 3)
            return repr(value)
        if kind is LIST_ITERATOR:
            raise refused("the text of an iterator", hint="write list(…) around it")
        if kind in CONTAINERS:
            self.expanded(value)
            self.check_text(sum(map(_least_length, _leaves(value))))
        elif kind is str:
            self.check_text(len(value))
        written = repr(value)
        self.check_text(len(written))
        return written


def _not_plain(value: Any) -> SafetyError:
    return refused(f"a value of the type `{type(value).__name__}`", "only plain data can be used")


def _is_tame(value: Any) -> bool:
    """Return whether a file cannot choose the hash of a value: of few whole numbers, or a text."""
    kind = type(value)
    if kind is int:
        return bool(-_TAME_INTEGER < value < _TAME_INTEGER)
    if kind is tuple:
        return len(value) <= 3 and all(type(part) is not tuple and _is_tame(part) for part in value)
    return kind in TAME


def _parts(value: Any) -> Iterator[Any]:
    """Give the items of a collection; of a dict its keys and values."""
    kind = type(value)
    if kind is dict:
        return (part for pair in value.items() for part in pair)
    if kind is OrderedSet:
        return set.__iter__(value)
    return iter(value)


def _leaves(value: Any) -> Iterator[Any]:
    """Yield all items of nested collections that are not collections; the size has been checked."""
    stack = [_parts(value)]
    while stack:
        for item in stack[-1]:
            if type(item) in CONTAINERS:
                stack.append(_parts(item))
                break
            yield item
        else:
            stack.pop()


def _least_length(value: Any) -> int:
    return len(value) + 4 if type(value) is str else 3
