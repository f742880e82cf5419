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

The tape is compiled to a Python function without branches, which does the same operations on the
same types in the same order. So it gives the very same document as a build, or None where an
outcome is another one.

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
MOST_LINES = 60_000
"""Lines of a tape: a longer one takes more time than a build."""

Replay = Callable[..., "tuple[str, ...] | None"]


class Unrecordable(BaseException):
    """A recorded number is needed as a plain one; not an Exception, so that nothing handles it."""


class Tape:
    """What is computed of the arguments of one variant.

    Attributes:
        lines: the statements of the function, in order.
        is_broken: whether something was computed that is not on it.
    """

    def __init__(self) -> None:
        """Begin with nothing on it."""
        self.lines: list[str] = []
        self.is_broken = False
        self._variables: dict[str, str] = {}  # by expression
        self._results: dict[str, tuple[Any]] = {}
        self._objects: dict[int, tuple[str, object]] = {}  # by identity
        self._texts: list[tuple[str, str]] = []  # variable and concrete text, by the number of mark
        self._constants: dict[str, Any] = {}
        self._names: dict[int, str] = {}
        self._guards: set[str] = set()

    def refuse(self, why: str) -> Unrecordable:
        """Return what ends the recording."""
        self.is_broken = True
        return Unrecordable(why)

    # --- what statements are made of ---

    def constant(self, value: object) -> str:
        """Return the name of a value that is the same for all variants."""
        name = self._names.get(id(value))
        if name is None:
            name = self._names[id(value)] = f"c{len(self._names)}"
            self._constants[name] = value
        return name

    def expression(self, value: Any) -> str:
        """Return an expression that gives a value, recorded or not."""
        kind = type(value)
        if kind is Number:
            return value.variable  # type: ignore[no-any-return]
        if (kind is float and value - value == 0) or kind is int or kind is bool:
            text = repr(value)
            return f"({text})" if text[0] == "-" else text
        if kind is str:
            return self._text(value) if MARK.search(value) else repr(value)
        if kind in (tuple, list):
            inner = "".join(f"{self.expression(each)}, " for each in value)
            return f"({inner})" if kind is tuple else f"[{inner}]"
        if kind in OBJECTS:
            known = self._objects.get(id(value))
            if known is None:
                names = [name for name in kind.__slots__ if hasattr(value, name)]
                parts = self.expression(tuple(getattr(value, name) for name in names))
                inner = f"{self.constant(kind)}, {self.constant(names)}, {parts}"
                made = self._variable(f"{self.constant(made_again)}({inner})")
                known = self._objects[id(value)] = made, value
            return known[0]
        return self.constant(value)

    def _text(self, text: str) -> str:
        """Return an expression for a text with marks in it."""
        pieces = []
        start = 0
        for found in MARK.finditer(text):
            if found.start() > start:
                pieces.append(repr(text[start : found.start()]))
            pieces.append(self._texts[int(found[1])][0])
            start = found.end()
        if start < len(text):
            pieces.append(repr(text[start:]))
        return pieces[0] if len(pieces) == 1 else f"({' + '.join(pieces)})"

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
            names = [name for name in kind.__slots__ if hasattr(value, name)]
            parts = [self.concrete(getattr(value, name)) for name in names]
            return made_again(kind, names, parts)
        return value

    # --- statements ---

    def compute(self, text: str, value: Any) -> Any:
        """Note an expression, and return its value, recorded."""
        known = self._results.get(text)
        if known is None:
            known = self._results[text] = (self._recorded(self._variable(text), value),)
        return known[0]

    def _variable(self, text: str) -> str:
        """Return the variable that has the value of an expression."""
        variable = self._variables.get(text)
        if variable is None:
            if len(self.lines) > MOST_LINES:
                raise self.refuse("too long")
            variable = self._variables[text] = f"t{len(self.lines)}"
            self.lines.append(f" {variable} = {text}")
        return variable

    def _recorded(self, variable: str, value: Any) -> Any:
        kind = type(value)
        if kind is float or kind is int:
            return Number(self, variable, value)
        if kind is str:
            self._texts.append((variable, value))
            return f"?y{len(self._texts) - 1}?"
        if kind is tuple:
            self.require(f"len({variable}) == {len(value)}")
            each = [self.compute(f"{variable}[{at}]", part) for at, part in enumerate(value)]
            return tuple(each)
        if kind is bool or value is None:
            self.require(f"{variable} is {value}")
            return value
        raise self.refuse(f"a {kind.__name__}")

    def require(self, condition: str) -> None:
        """Note that the rest holds only where a condition does."""
        if condition not in self._guards:
            self._guards.add(condition)
            self.lines.append(f" if not {condition}: return None")

    def outcome(self, condition: str, value: bool) -> bool:
        """Note the outcome of a comparison, and return it."""
        self.require(f"({condition})" if value else f"(not ({condition}))")
        return value

    def call(self, function: Callable[..., Any], *given: Any, **named: Any) -> Any:
        """Call a function that depends on its arguments alone, and return its result, recorded."""
        result = function(*map(self.concrete, given), **named)
        words = ", ".join(
            [*map(self.expression, given), *(f"{key}={value!r}" for key, value in named.items())]
        )
        return self.compute(f"{self.constant(function)}({words})", result)

    def settle(self, function: Callable[..., Any], *given: Any) -> Any:
        """Call such a function, and return its result, which is to be the same for others."""
        result = function(*map(self.concrete, given))
        words = ", ".join(map(self.expression, given))
        self.require(f"({self.constant(function)}({words}) == {self.constant(result)})")
        return result

    def compiled(self, names: Sequence[str], text: str) -> Replay:
        """Return the function: of the arguments, in order, to a text with marks in it."""
        first, *rest = MARK.split(text)  # texts and numbers of marks in turn
        pieces = [self.constant(first)]
        for number, part in zip(rest[::2], rest[1::2], strict=True):
            pieces += (self._texts[int(number)][0], self.constant(part))
        lines = [f"def replay({', '.join(names)}):", *self.lines]
        lines.append(f" return ({', '.join(pieces)},)")
        names_of: dict[str, Any] = self._constants
        exec(compile("\n".join(lines), "<recording>", "exec"), names_of)
        return names_of["replay"]  # type: ignore[no-any-return]


def made_again(kind: type, names: Sequence[str], parts: Sequence[Any]) -> Any:
    """Return an object of a kind with these attributes."""
    made: Any = object.__new__(kind)
    for name, part in zip(names, parts, strict=True):
        setattr(made, name, part)
    return made


# --- numbers --------------------------------------------------------------------------------------


OURS = __name__.partition(".")[0] + "."
PLAIN = (int, float)
_BINARY = {
    "add": "+", "sub": "-", "mul": "*", "truediv": "/", "floordiv": "//", "mod": "%", "pow": "**",
}  # fmt: skip
_COMPARISONS = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!="}


class Number:
    """A number that writes what is computed with it to a tape.

    Attributes:
        tape: the tape.
        variable: its name there.
        value: what it is for the variant that is recorded.
    """

    __slots__ = ("tape", "value", "variable")
    __array_ufunc__ = None  # so that numpy leaves operations to it

    def __init__(self, tape: Tape, variable: str, value: float) -> None:
        self.tape = tape
        self.variable = variable
        self.value = value

    @property  # type: ignore[misc]
    def __class__(self) -> type:
        """Return what `isinstance` takes it for."""
        return type(self.value)

    def __getattr__(self, name: str) -> Any:
        """Refuse all that is not written here."""
        raise self.tape.refuse(name)

    def _made(self, text: str, value: Any) -> Any:
        return self.tape.compute(text, value)

    def __bool__(self) -> bool:
        return self.tape.outcome(f"{self.variable} != 0", self.value != 0)

    def __neg__(self) -> Any:
        return self._made(f"-{self.variable}", -self.value)

    def __pos__(self) -> Any:
        return self

    def __abs__(self) -> Any:
        return self.tape.call(abs, self)

    def __round__(self, digits: int | None = None) -> Any:
        return self.tape.call(round, self, *(() if digits is None else (digits,)))

    def __int__(self) -> int:
        found = int(self.value)
        self.tape.require(f"int({self.variable}) == {found}")
        return found

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
        return hash(self.variable)

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


def _binary(name: str, sign: str) -> None:
    operate = getattr(operator, name)

    def forward(self: Number, other: Any) -> Any:
        if not isinstance(other, PLAIN):
            return NotImplemented
        return _operation(self.tape, self, sign, other)

    def backward(self: Number, other: Any) -> Any:
        if not isinstance(other, PLAIN):
            return NotImplemented
        return _operation(self.tape, other, sign, self)

    def _operation(tape: Tape, left: Any, sign: str, right: Any) -> Any:
        left, right = _plain(left), _plain(right)
        value = operate(tape.concrete(left), tape.concrete(right))
        found = tape.compute(f"{tape.expression(left)} {sign} {tape.expression(right)}", value)
        if sign == "**":  # which of negative numbers is complex, of whole ones no longer whole
            tape.require(f"type({found.variable}) is {type(value).__name__}")
        return found

    setattr(Number, f"__{name}__", forward)
    setattr(Number, f"__r{name}__", backward)


def _comparison(name: str, sign: str) -> None:
    compare = getattr(operator, name)

    def compared(self: Number, other: Any) -> Any:
        if not isinstance(other, PLAIN):
            return NotImplemented
        tape, other = self.tape, _plain(other)
        text = f"{self.variable} {sign} {tape.expression(other)}"
        return tape.outcome(text, compare(self.value, tape.concrete(other)))

    setattr(Number, f"__{name}__", compared)


def _plain(value: Any) -> Any:
    """Return a number of another library, such as numpy's, as one of Python's."""
    kind = type(value)
    if kind in (Number, float, int, bool):
        return value
    return float(value) if isinstance(value, float) else int(value)


for _name, _sign in _BINARY.items():
    _binary(_name, _sign)
for _name, _sign in _COMPARISONS.items():
    _comparison(_name, _sign)

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
        return any(is_recorded(getattr(value, name, None)) for name in kind.__slots__)
    return False


# --- recording ------------------------------------------------------------------------------------


def record(
    arguments: dict[str, Any], names: Sequence[str], build: Callable[[dict[str, Any]], str]
) -> Replay | None:
    """Return the document of a build as a function of some of its arguments.

    Args:
        arguments: the values of the arguments.
        names: those that the function takes, in this order; they are numbers.
        build: builds with arguments, and returns the document.

    Returns:
        The function: its result is the document in pieces, of which every second one is text that
        was computed, or None for what takes another way. None if there is no such function.
    """
    from .replacing import replaced

    parameters = [f"a{at}" for at in range(len(names))]
    loaded = -1
    while loaded != len(sys.modules):  # again, if there are modules in which nothing was replaced
        loaded = len(sys.modules)
        tape = Tape()
        given = {
            name: Number(tape, parameter, arguments[name])
            for name, parameter in zip(names, parameters, strict=True)
        }
        text = None
        try:
            with replaced(tape):
                text = build({**arguments, **given})
        except (Unrecordable, Exception):
            continue
    return None if text is None or tape.is_broken else tape.compiled(parameters, text)
