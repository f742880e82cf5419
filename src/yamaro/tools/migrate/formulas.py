"""What expressions of a robot compute: the inertia of a solid, whole numbers of degrees.

Two formulas are the same if they give the same for several random values of what they read. Equal
names, and equal subscripts of names, are one unknown each. An angle such as `$(pi / 2)` is written
in degrees, `90deg`, only if the output has the same 15 digits.
"""

from __future__ import annotations

import ast
import math
import re
from math import isclose, isfinite

from ...model.shapes import SIMPLE_SHAPES
from ...units import parse_quantity
from ...xml.values import format_number
from .document import words_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from random import Random

    from ...model.shapes import Solid

SIZES = {kind: len(shape.sizes) for kind, shape in SIMPLE_SHAPES.items() if shape.since == "1.0"}
"""The solids whose inertia a formula gives, and how many numbers each takes."""
SAMPLES = 5
TOLERANCE = 1e-9
"""How far inertias may differ, as a part of them."""
NEGLIGIBLE = 1e-12
"""Differences that are rounding, as a part of the largest moment, where both are numbers."""
_ARGUMENT = re.compile(r"\$\(arg (\w+)\)")
_NESTED = re.compile(r"\$\{(\w+)\}")
LEAST, MOST = 0.5, 2.0
"""Between these are the random values."""


class NotComputed(Exception):
    """A text has no number that could be computed from others."""


class Sample:
    """One random value for each name that expressions read.

    Attributes:
        values: those that were read, or are given.
    """

    def __init__(self, random: Random, values: dict[str, float] | None = None) -> None:
        """Begin with the values given."""
        self._random = random
        self.values = dict(values or {})

    def number(self, text: str) -> float:
        """Return the value of a word: a number, or `$(…)` or `${…}`, at most with a sign.

        Raises:
            NotComputed: it is neither, or no formula.
        """
        text = _ARGUMENT.sub(r"${\1}", text.strip())
        sign = -1.0 if text.startswith("-$") else 1.0
        bare = text.lstrip("-") if sign < 0 else text
        if (bare[:2], bare[-1:]) in (("$(", ")"), ("${", "}")):
            return sign * self.evaluate(bare[2:-1])
        try:
            number = float(text)
        except ValueError:
            raise NotComputed from None
        if not isfinite(number):
            raise NotComputed
        return number

    def evaluate(self, python: str) -> float:
        """Return the value of an expression.

        Raises:
            NotComputed: it is not a formula, or has no finite value.
        """
        python = _NESTED.sub(r"(\1)", python)
        try:
            value = self._value(ast.parse(python.strip(), mode="eval").body)
        except (SyntaxError, ValueError, ArithmeticError, RecursionError):
            raise NotComputed from None
        if not isfinite(value):
            raise NotComputed
        return value

    def _value(self, node: ast.AST) -> float:
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return float(node.value)  # type: ignore[arg-type]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
            value = self._value(node.operand)
            return -value if isinstance(node.op, ast.USub) else value
        if isinstance(node, ast.BinOp):
            left, right = self._value(node.left), self._value(node.right)
            match node.op:
                case ast.Add():
                    return left + right
                case ast.Sub():
                    return left - right
                case ast.Mult():
                    return left * right
                case ast.Div():
                    return left / right
                case ast.Pow():
                    return _power(left, right)
            raise NotComputed
        if (
            isinstance(node, ast.Call)
            and ast.unparse(node.func) in ("pow", "math.pow")
            and len(node.args) == 2
            and not node.keywords
        ):
            base, exponent = map(self._value, node.args)
            return _power(base, exponent)
        if not _is_unknown(node):
            raise NotComputed
        key = ast.dump(node)
        if key not in self.values:
            self.values[key] = self._random.uniform(LEAST, MOST)
        return self.values[key]


def samples() -> list[Sample]:
    """Return samples, which are the same each time."""
    from random import Random

    return [Sample(Random(seed)) for seed in range(SAMPLES)]


def key_of(name: str) -> str:
    """Return what a name is called in the values of a sample."""
    return ast.dump(ast.parse(name, mode="eval").body)


def solid(kind: str, sizes: Sequence[float]) -> Solid:
    """Return a solid of a kind that SIZES has."""
    return SIMPLE_SHAPES[kind](*sizes)


def is_inertia_of(kind: str, sizes: Sequence[str], mass: str, moments: Sequence[str]) -> bool:
    """Return whether moments of inertia are those of a solid, for all values of expressions.

    Args:
        kind: of the solid.
        sizes: its sizes, each as a word.
        mass: its mass.
        moments: ixx, ixy, ixz, iyy, iyz, izz.
    """
    shape = SIMPLE_SHAPES.get(kind)
    if shape is None or len(sizes) != len(shape.sizes):
        return False

    def is_equal(sample: Sample) -> bool:
        own_mass, own_sizes = sample.number(mass), [sample.number(size) for size in sizes]
        given = [sample.number(moment) for moment in moments]
        if own_mass <= 0 or min(own_sizes) <= 0:
            return False
        computed = solid(kind, own_sizes).inertia(own_mass)
        negligible = 0.0 if sample.values else NEGLIGIBLE * max(computed)
        return all(
            isclose(one, other, rel_tol=TOLERANCE, abs_tol=negligible)
            for one, other in zip(given, computed, strict=True)
        )

    return holds(is_equal)


def are_equal(first: Sequence[str], second: Sequence[str]) -> bool:
    """Return whether two rows of words mean the same numbers."""
    if len(first) != len(second):
        return False
    return first == second or holds(
        lambda sample: all(
            isclose(sample.number(one), sample.number(other), rel_tol=TOLERANCE)
            for one, other in zip(first, second, strict=True)
        )
    )


def holds(is_true: Callable[[Sample], bool]) -> bool:
    """Return whether something is true of all samples; not so if it cannot be computed."""
    try:
        return all(map(is_true, samples()))
    except NotComputed:
        return False


def _power(base: float, exponent: float) -> float:
    value = base**exponent
    if isinstance(value, complex):
        raise NotComputed
    return float(value)


def _is_unknown(node: ast.AST) -> bool:
    """Return whether a node is a name, or what a mapping or list of a name has at a fixed place."""
    while isinstance(node, (ast.Attribute, ast.Subscript)):
        if isinstance(node, ast.Subscript) and not isinstance(node.slice, ast.Constant):
            return False
        node = node.value
    return isinstance(node, ast.Name)


# --- angles in degrees ------------------------------------------------------------------------


MOST_DEGREES = 720
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

    __slots__ = ("constants", "decimals")

    def __init__(self, constants: Mapping[str, float], decimals: int = 0) -> None:
        """Take what names have for numbers, and how many decimals degrees may have."""
        self.constants = constants
        self.decimals = decimals

    def row(self, text: str) -> str:
        """Return numbers, those in degrees that are whole numbers of them."""
        return " ".join(self.number(word) for word in words_of(text))

    def number(self, word: str, unit: str = "deg") -> str:
        """Return a number with a unit of degrees, or as it is."""
        value = self.value(word)
        if value is None or not math.isfinite(value):
            return word
        whole = 0.0
        if abs(value) < math.radians(MOST_DEGREES + 1):
            whole = round(math.degrees(value), self.decimals)
        if not 0 < abs(whole) <= MOST_DEGREES:
            return word
        text = format_number(whole).removesuffix(".0")
        meant, _ = parse_quantity(f"{text}{unit}")
        return f"{text}{unit}" if format_number(meant) == format_number(value) else word

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
            try:
                value = self._of(ast.parse(bare[2:-1].strip(), mode="eval").body)
            except (SyntaxError, ValueError, ArithmeticError):
                return None
            return None if value is None else sign * value
        try:
            return float(word)
        except ValueError:
            return None

    def _of(self, node: ast.expr) -> float | None:
        """Return the number that a piece of Python gives, None if it is not always the same."""
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
