"""Records a build as a function of its arguments, so that other variants need no build.

The variants of a batch differ in a few hundred numbers, and what computes these hardly ever depends
on the values. So one variant is built with recorded numbers in place of its arguments. A recorded
number behaves as the number that it has, and writes each operation on it to a tape. Whatever turns
it into something else is handled as follows:

- A comparison has the outcome that it has for this variant. The tape notes the outcome; it holds
  for other variants with the same outcomes.
- A text that is made of it is a mark, such as `?y17?`. Marks are found again in the document, and
  where texts are read as numbers.
- Where numbers have to be numbers, as in C, recording ends with `Unrecordable`.

The steps of a tape are the same operations on the same types in the same order. So they give the
very same document as a build, or none where an outcome is another one; see `columns.py`.

While a variant is recorded, functions are replaced in the whole process; see `replacing.py`.
That is why only the process of a worker, which builds one variant at a time, records.
"""

from __future__ import annotations

import math
import operator
import re
import sys
from collections.abc import Callable, Sequence
from typing import Any

from ...model.convex import Convex
from ...model.pose import Pose
from ...model.shapes import Box, Capsule, Cylinder, Sphere

MARK = re.compile(r"\?y(\d+)\?")
MOST_STEPS = 60_000
"""Steps of a tape: a longer one takes more time than a build."""


class Unrecordable(BaseException):
    """A recorded number is needed as a plain one; not an Exception, so that nothing handles it."""


class Constant:
    """What is the same for all variants."""

    __slots__ = ("value",)

    def __init__(self, value: object) -> None:
        self.value = value


class Part:
    """A value with others in it: a text, a tuple, a list, or an object with these attributes."""

    __slots__ = ("kind", "names", "parts")

    def __init__(self, kind: type, parts: Sequence[Operand], names: Sequence[str] = ()) -> None:
        self.kind = kind
        self.parts = parts
        self.names = names


Operand = int | Constant | Part
"""An operand of a step; a number is that of the column with its values."""


class Step:
    """An operation.

    Attributes:
        function: what is called.
        operands: what it is called with.
        kind: the type of its results, which are the next column; None for a condition.
        expected: of a condition, the result that it has to have; of tuples, their length.
    """

    __slots__ = ("expected", "function", "kind", "operands")

    def __init__(
        self,
        function: Callable[..., Any],
        operands: Sequence[Operand],
        kind: type | None,
        expected: object = None,
    ) -> None:
        self.function = function
        self.operands = operands
        self.kind = kind
        self.expected = expected


class Recording:
    """The document of a build as a function of some arguments.

    Attributes:
        width: how many arguments there are, which are the first columns.
        steps: what is computed of them.
        pieces: the document; every second piece is an operand, and a text that was computed.
        witnesses: what has shown that two shapes overlap or not, by their operands.
    """

    __slots__ = ("pieces", "steps", "width", "witnesses")

    def __init__(self, width: int, steps: Sequence[Step], pieces: Sequence[Any]) -> None:
        self.width = width
        self.steps = steps
        self.pieces = pieces
        self.witnesses: dict[tuple[int, int], list[Any]] = {}


class Tape:
    """What is computed of the arguments of one variant.

    Attributes:
        is_broken: whether something was computed that is not on it.
    """

    def __init__(self, width: int) -> None:
        """Begin with some arguments, which are the first columns, and no steps."""
        self.is_broken = False
        self._width = self._columns = width
        self._steps: list[Step] = []
        self._results: dict[object, tuple[Any]] = {}  # by function and operands
        self._operands: dict[object, tuple[Operand, object]] = {}  # by what they are made of
        self._texts: list[tuple[int, str]] = []  # column and concrete text, by the number of mark

    def refuse(self, why: str) -> Unrecordable:
        """Return what ends the recording."""
        self.is_broken = True
        return Unrecordable(why)

    def operand(self, value: Any) -> Operand:
        """Return an operand that has a value, recorded or not; the same for the same value."""
        kind = type(value)
        if kind is Number:
            return value.column  # type: ignore[no-any-return]
        if kind is str:
            first, *rest = MARK.split(value)
            if not rest:
                return self._only((str, value), value)
            pieces: list[Operand] = [self.operand(first)] if first else []
            for number, text in zip(rest[::2], rest[1::2], strict=True):
                pieces.append(self._texts[int(number)][0])
                if text:
                    pieces.append(self.operand(text))
            return pieces[0] if len(pieces) == 1 else self._part(str, pieces)
        if kind in (tuple, list):
            return self._part(kind, [*map(self.operand, value)])
        if kind in OBJECTS:
            found = self._operands.get(id(value))
            if found is None:
                names = _attributes(value)
                parts = [self.operand(getattr(value, name)) for name in names]
                found = self._operands[id(value)] = self._part(kind, parts, names), value
            return found[0]
        is_number = kind in (float, int, bool)
        return self._only((kind, repr(value)) if is_number else id(value), value)

    def _only(self, key: object, value: object) -> Operand:
        """Return the only constant that has a value."""
        found = self._operands.get(key)
        if found is None:
            found = self._operands[key] = Constant(value), value
        return found[0]

    def _part(self, kind: type, parts: Sequence[Operand], names: Sequence[str] = ()) -> Operand:
        key = (kind, *map(_identity, parts))
        found = self._operands.get(key)
        if found is None:
            found = self._operands[key] = Part(kind, parts, names), None
        return found[0]

    def concrete(self, value: Any) -> Any:
        """Return a value as it is for the variant that is recorded."""
        kind = type(value)
        if kind is Number:
            return value.value
        if kind is str:
            return MARK.sub(lambda found: self._texts[int(found[1])][1], value)
        if kind in (tuple, list):
            return kind(map(self.concrete, value))
        if kind in OBJECTS:
            names = _attributes(value)
            parts = [self.concrete(getattr(value, name)) for name in names]
            return made_again(kind, names, parts)
        return value

    # --- steps ---

    def compute(self, function: Callable[..., Any], given: Sequence[Any], value: Any) -> Any:
        """Note that a function of something is a value, and return that, recorded."""
        operands = [*map(self.operand, given)]
        key = (function, *map(_identity, operands))
        known = self._results.get(key)
        if known is None:
            known = self._results[key] = (self._recorded(function, operands, value),)
        return known[0]

    def _recorded(
        self, function: Callable[..., Any], operands: Sequence[Operand], value: Any
    ) -> Any:
        kind = type(value)
        if kind is bool or value is None:
            self._note(Step(function, operands, None, value))
            return value
        if kind not in (float, int, str, tuple):
            raise self.refuse(f"a {kind.__name__}")
        self._note(Step(function, operands, kind, len(value) if kind is tuple else None))
        column = self._columns
        self._columns += 1
        if kind is str:
            self._texts.append((column, value))
            return f"?y{len(self._texts) - 1}?"
        if kind is tuple:
            whole = Number(self, column, 0.0)
            return tuple(
                self.compute(operator.getitem, (whole, at), part) for at, part in enumerate(value)
            )
        return Number(self, column, value)

    def _note(self, step: Step) -> None:
        if len(self._steps) > MOST_STEPS:
            raise self.refuse("too long")
        self._steps.append(step)

    def call(self, function: Callable[..., Any], *given: Any) -> Any:
        """Call a function that depends on its arguments alone, and return its result, recorded."""
        return self.compute(function, given, function(*map(self.concrete, given)))

    def settle(self, function: Callable[..., Any], *given: Any) -> Any:
        """Call such a function, and return its result, which is to be the same for others."""
        operands = [*map(self.operand, given)]
        key = (function, None, *map(_identity, operands))
        known = self._results.get(key)
        if known is None:
            known = self._results[key] = (function(*map(self.concrete, given)),)
            self._note(Step(function, operands, None, *known))
        return known[0]

    def recording(self, text: str) -> Recording:
        """Return what was recorded, with a text with marks in it as the document."""
        pieces: list[Any] = MARK.split(text)  # texts and numbers of marks in turn
        pieces[1::2] = [self._texts[int(number)][0] for number in pieces[1::2]]
        return Recording(self._width, self._steps, pieces)


def _identity(operand: Operand) -> object:
    """Return what is another one for other operands."""
    return operand if type(operand) is int else (id(operand),)


def _attributes(value: object) -> list[str]:
    """Return the attributes that an object has, except for the element that it was read from."""
    slots = (getattr(kind, "__slots__", ()) for kind in type(value).__mro__)
    names = (name for each in slots for name in each if name != "element")
    return [name for name in names if hasattr(value, name)]


def made_again(kind: type, names: Sequence[str], parts: Sequence[Any]) -> Any:
    """Return an object of a kind with these attributes."""
    made: Any = object.__new__(kind)
    for name, part in zip(names, parts, strict=True):
        setattr(made, name, part)
    return made


# --- numbers --------------------------------------------------------------------------------------


OURS = __name__.partition(".")[0] + "."
PLAIN = (int, float)
_BINARY = ("add", "sub", "mul", "truediv", "floordiv", "mod", "pow")
_COMPARISONS = ("lt", "le", "gt", "ge", "eq", "ne")


class Number:
    """A number that writes what is computed with it to a tape.

    Attributes:
        tape: the tape.
        column: the number of its column.
        value: what it is for the variant that is recorded.
    """

    __slots__ = ("column", "tape", "value")
    __array_ufunc__ = None  # so that numpy leaves operations to it

    def __init__(self, tape: Tape, column: int, value: float) -> None:
        self.tape = tape
        self.column = column
        self.value = value

    @property  # type: ignore[misc]
    def __class__(self) -> type:
        """Return what `isinstance` takes it for."""
        return type(self.value)

    def __getattr__(self, name: str) -> Any:
        """Refuse all that is not written here."""
        raise self.tape.refuse(name)

    def __bool__(self) -> bool:
        return self.tape.call(operator.ne, self, 0)  # type: ignore[no-any-return]

    def __neg__(self) -> Any:
        return self.tape.call(operator.neg, self)

    def __pos__(self) -> Any:
        return self

    def __abs__(self) -> Any:
        return self.tape.call(abs, self)

    def __round__(self, digits: int | None = None) -> Any:
        return self.tape.call(round, self, *(() if digits is None else (digits,)))

    def __int__(self) -> int:
        return self.tape.settle(int, self)  # type: ignore[no-any-return]

    def __index__(self) -> int:
        if type(self.value) is float:
            raise TypeError("'float' object cannot be interpreted as an integer")
        return int(self)

    def __floor__(self) -> Any:
        return self.tape.call(math.floor, self)

    def __ceil__(self) -> Any:
        return self.tape.call(math.ceil, self)

    def __trunc__(self) -> int:
        return int(self)

    def __divmod__(self, other: Any) -> Any:
        return self.tape.call(divmod, self, other)

    def __float__(self) -> float:
        raise self.tape.refuse("float")

    def __complex__(self) -> complex:
        raise self.tape.refuse("complex")

    def __hash__(self) -> int:
        """Return the same for the same number, to remember by it what was made of it.

        Other numbers may be equal to it. That makes no difference to Yamaro, but it does to a dict
        of the user's.
        """
        if not str(sys._getframe(1).f_globals.get("__name__")).startswith(OURS):
            raise self.tape.refuse("hash")
        return hash(("column", self.column))

    def __array__(self, *given: Any, **named: Any) -> Any:
        raise self.tape.refuse("array")

    def __str__(self) -> str:
        return self.tape.call(str, self)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return self.tape.call(repr, self)  # type: ignore[no-any-return]

    def __format__(self, form: str) -> str:
        return self.tape.call(format, self, form)  # type: ignore[no-any-return]

    def __copy__(self) -> Number:
        return self

    def __deepcopy__(self, memo: Any) -> Number:
        return self

    def is_integer(self) -> bool:
        """Return whether it is a whole number."""
        return self.tape.call(_is_integer, self)  # type: ignore[no-any-return]


def _is_integer(value: float) -> bool:
    return float(value).is_integer()


def _binary(name: str) -> None:
    operate = getattr(operator, name)

    def forward(self: Number, other: Any) -> Any:
        if not isinstance(other, PLAIN):
            return NotImplemented
        return self.tape.call(operate, self, _plain(other))

    def backward(self: Number, other: Any) -> Any:
        if not isinstance(other, PLAIN):
            return NotImplemented
        return self.tape.call(operate, _plain(other), self)

    setattr(Number, f"__{name}__", forward)
    if name not in _COMPARISONS:
        setattr(Number, f"__r{name}__", backward)


def _plain(value: Any) -> Any:
    """Return a number of another library, such as numpy's, as one of Python's."""
    kind = type(value)
    if kind in (Number, float, int, bool):
        return value
    return float(value) if isinstance(value, float) else int(value)


for _name in (*_BINARY, *_COMPARISONS):
    _binary(_name)

OBJECTS = frozenset((Convex, Pose, Box, Capsule, Cylinder, Sphere))
"""The kinds of objects that functions get, with numbers in them."""


def is_recorded(value: Any) -> bool:
    """Return whether a recorded number is in a value."""
    kind = type(value)
    if kind is Number:
        return True
    if kind is str:
        return MARK.search(value) is not None
    if kind in (tuple, list):
        return any(map(is_recorded, value))
    if kind in OBJECTS:
        return any(is_recorded(getattr(value, name)) for name in _attributes(value))
    return False


# --- recording ------------------------------------------------------------------------------------


def record(
    arguments: dict[str, Any], names: Sequence[str], build: Callable[[dict[str, Any]], str]
) -> Recording | None:
    """Return the document of a build as a function of some of its arguments.

    Args:
        arguments: the values of the arguments.
        names: those that the function takes, in this order; they are numbers.
        build: builds with arguments, and returns the document.

    Returns:
        The function; None if there is none.
    """
    from .replacing import replaced

    loaded = -1
    while loaded != len(sys.modules):  # again, if there are modules in which nothing was replaced
        loaded = len(sys.modules)
        tape = Tape(len(names))
        given = {name: Number(tape, at, arguments[name]) for at, name in enumerate(names)}
        text = None
        try:
            with replaced(tape):
                text = build({**arguments, **given})
        except (Unrecordable, Exception):
            continue
    return None if text is None or tape.is_broken else tape.recording(text)
