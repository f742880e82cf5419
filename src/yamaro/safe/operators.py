"""The guards that safe code calls in place of operators: arithmetic and comparisons.

Each does what Python does, after it has checked by exact types that the result will not be too
large, and has counted what it costs.
"""

from __future__ import annotations

import operator

from ..yaml.nodes import FlexiDict
from .limits import refused
from .values import CONTAINERS, LIST_ITERATOR, SEQUENCES, SET_LIKE, WHOLE, Meter, OrderedSet

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any


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
