"""Angles that are whole numbers of degrees: `$(pi / 2)` and `1.5707963267948966` as `90deg`.

An angle is written in degrees only if the output has the same 15 digits.
"""

from __future__ import annotations

import math

from ...units import parse_quantity
from ...xml.values import format_number
from .document import words_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Mapping

MOST = 720
"""Degrees that an angle may have to be written so."""
TURNING = ("revolute", "continuous")
ANGLES = frozenset(("lower", "upper", "soft_lower_limit", "soft_upper_limit"))
"""Attributes in a turning joint that are angles; `velocity` is one per second."""
_FUNCTIONS = {"radians": math.radians, "float": float, "str": float}
"""Functions of a number; `str` is what migration writes around the digits of a long one."""


class Degrees:
    """Writes angles of one robot.

    Attributes:
        constants: the numbers that names have everywhere, `pi` among them if nothing else has it.
    """

    __slots__ = ("constants",)

    def __init__(self, constants: Mapping[str, float]) -> None:
        self.constants = constants

    def row(self, text: str) -> str:
        """Return numbers, those in degrees that are whole numbers of them."""
        return " ".join(self.number(word) for word in words_of(text))

    def number(self, word: str, unit: str = "deg") -> str:
        """Return a number with a unit of degrees, or as it is."""
        value = self.value(word)
        if value is None or not math.isfinite(value):
            return word
        whole = round(math.degrees(value)) if abs(value) < math.radians(MOST + 1) else 0
        if not 0 < abs(whole) <= MOST:
            return word
        meant, _ = parse_quantity(f"{whole}{unit}")
        return f"{whole}{unit}" if format_number(meant) == format_number(value) else word

    def of_attribute(self, name: str, text: str, kind: str) -> str:
        """Return the value of an attribute such as `upper`, in a joint of a kind."""
        if kind not in TURNING:
            return text
        if name in ANGLES:
            return self.number(text)
        return self.number(text, "deg/s") if name == "velocity" else text

    def value(self, word: str) -> float | None:
        """Return the number that a word always gives, or None."""
        sign = -1.0 if word.startswith("-$(") else 1.0
        bare = word.removeprefix("-") if sign < 0 else word
        if bare.startswith("$(") and bare.endswith(")"):
            value = self._evaluated(bare[2:-1])
            return None if value is None else sign * value
        try:
            return float(word)
        except ValueError:
            return None

    def _evaluated(self, python: str) -> float | None:
        import ast

        try:
            return self._of(ast.parse(python.strip(), mode="eval").body)
        except (SyntaxError, ValueError, ArithmeticError):
            return None

    def _of(self, node: ast.expr) -> float | None:
        """Return the number that a piece of Python gives, None if it is not always the same."""
        import ast

        match node:
            case ast.Constant(bool()):
                return None
            case ast.Constant(int() | float() as value):
                return value
            case ast.Name(name):
                return self.constants.get(name)
            case ast.UnaryOp(ast.USub() | ast.UAdd() as operator, operand):
                own = self._of(operand)
                return -own if own is not None and isinstance(operator, ast.USub) else own
            case ast.Call(ast.Name(name), [argument], []) if name in _FUNCTIONS:
                given = self._of(argument)
                return None if given is None else _FUNCTIONS[name](given)
            case ast.BinOp(left, operator, right):
                one, other = self._of(left), self._of(right)
                return None if one is None or other is None else _joined(one, operator, other)
        return None


def _joined(one: float, operator: object, other: float) -> float | None:
    match type(operator).__name__:
        case "Add":
            return one + other
        case "Sub":
            return one - other
        case "Mult":
            return one * other
        case "Div":
            return one / other
    return None
