"""Whether an inertia is that of a solid, also where expressions give the numbers.

Two formulas are the same if they give the same for several random values of what they read. Equal
names, and equal subscripts of names, are one unknown each.
"""

from __future__ import annotations

import re
from math import isclose, isfinite

from ...model.shapes import SIMPLE_SHAPES

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Callable, Sequence
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
        import ast

        python = _NESTED.sub(r"(\1)", python)
        try:
            value = self._value(ast.parse(python.strip(), mode="eval").body)
        except (SyntaxError, ValueError, ArithmeticError, RecursionError):
            raise NotComputed from None
        if not isfinite(value):
            raise NotComputed
        return value

    def _value(self, node: ast.AST) -> float:
        import ast

        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return float(node.value)  # type: ignore[arg-type]
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.UAdd, ast.USub)):
            value = self._value(node.operand)
            return -value if isinstance(node.op, ast.USub) else value
        if isinstance(node, ast.BinOp):
            return self._operation(node)
        if _is_power(node):
            assert isinstance(node, ast.Call)
            base, exponent = map(self._value, node.args)
            return _power(base, exponent)
        if not _is_unknown(node):
            raise NotComputed
        key = ast.dump(node)
        if key not in self.values:
            self.values[key] = self._random.uniform(LEAST, MOST)
        return self.values[key]

    def _operation(self, node: ast.BinOp) -> float:
        import ast

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


def samples() -> list[Sample]:
    """Return samples, which are the same each time."""
    from random import Random

    return [Sample(Random(seed)) for seed in range(SAMPLES)]


def key_of(name: str) -> str:
    """Return what a name is called in the values of a sample."""
    import ast

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
    if len(sizes) != SIZES.get(kind):
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


def _is_power(node: ast.AST) -> bool:
    """Return whether a node is `pow(a, b)` or `math.pow(a, b)`."""
    import ast

    return (
        isinstance(node, ast.Call)
        and ast.unparse(node.func) in ("pow", "math.pow")
        and len(node.args) == 2
        and not node.keywords
    )


def _is_unknown(node: ast.AST) -> bool:
    """Return whether a node is a name, or what a mapping or list of a name has at a fixed place."""
    import ast

    while isinstance(node, (ast.Attribute, ast.Subscript)):
        if isinstance(node, ast.Subscript) and not isinstance(node.slice, ast.Constant):
            return False
        node = node.value
    return isinstance(node, ast.Name)
