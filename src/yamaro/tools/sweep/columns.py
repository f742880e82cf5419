"""Computes what was recorded for many variants at once.

Each number of a recording is a column: a row of its values for the variants. Where NumPy gives what
Python gives to the last digit, a step is one operation on whole columns; else the function is
called for each variant. Variants for which a step has another outcome, another type, or an error
drop out.

Which shapes overlap takes a search for each pair of them and each variant. What shows it of one
variant, such as a direction in which two shapes are apart, mostly shows it of others as well, so it
is tried first; see `witness`.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Sequence
from itertools import repeat
from typing import Any

from ...model.convex import SHRUNK, Convex, cross, dot, minus, overlapping, witness
from ...model.pose import Vector, rotate
from ...model.shapes import Box, Capsule, Cylinder
from .plan import import_extra
from .recording import Constant, Operand, Part, Recording, made_again

EXACT = 2**53
"""Whole numbers up to here are floating-point numbers too."""
MARGIN = 1e-9
"""By which part of their size shapes have to be apart, or overlap, for it to be certain."""


class Columns:
    """The values of a recording for many variants.

    Attributes:
        good: which variants the recording holds for.
        texts: the texts of the document that were computed, in order: the values of each.
    """

    def __init__(self, recording: Recording, arguments: Sequence[Sequence[float]]) -> None:
        """Compute them.

        Args:
            recording: what was recorded.
            arguments: the values of each of its arguments.
        """
        self._numpy = import_extra("numpy")
        self._count = len(arguments[0])
        self._columns: list[Any] = [self._column(each, type(each[0])) for each in arguments]
        self._lists: dict[int, list[Any]] = {}
        self._views: dict[int, Any] = {}
        self._witnesses = recording.witnesses
        self.good = self._numpy.ones(self._count, bool)
        last = _last_uses(recording)
        with self._numpy.errstate(all="ignore"):
            for at, step in enumerate(recording.steps):
                found = self._results(step.function, step.operands, step.kind, step.expected)
                if step.kind is not None:
                    self._columns.append(found)
                else:
                    self.good &= found
                for column in last.get(at, ()):
                    self._columns[column] = None
                    self._lists.pop(column, None)
                    self._views.pop(column, None)
                if not self.good.any():
                    break
        self._pieces = recording.pieces
        self.texts: list[Sequence[str]] = []
        if self.good.any():
            self.texts = [self._rows(each) for each in self._pieces[1::2]]
        del self._columns, self._lists, self._views

    def pieces(self, row: int) -> list[str]:
        """Return the document of a variant in pieces; every second one was computed."""
        pieces = [*self._pieces]
        pieces[1::2] = [each[row] for each in self.texts]
        return pieces

    # --- steps ---

    def _results(
        self,
        function: Callable[..., Any],
        operands: Sequence[Operand],
        kind: type | None,
        expected: Any,
    ) -> Any:
        """Return a column of results; of a condition, for which variants it holds."""
        if function is operator.getitem and type(operands[0]) is int:
            whole = self._columns[operands[0]]
            if type(whole) is tuple:  # of columns
                return whole[self._view(operands[1])]
        if function is overlapping:
            shapes, owners, may = operands
            return self._overlapping(shapes, owners, may, expected)
        whole_columns = _FUNCTIONS.get(function)
        if whole_columns is not None and all(map(self._is_numeric, operands)):
            found = whole_columns(self, *map(self._view, operands))
            if found is not None:
                return found == expected if kind is None else found
        rows = self._called(function, [self._rows(each) for each in operands])
        if kind is None:
            wanted = type(expected)
            return [type(each) is wanted and each == expected for each in rows]
        if kind is tuple:
            self.drop([type(each) is not tuple or len(each) != expected for each in rows])
            return rows
        return self._column(rows, kind)

    def _called(self, function: Callable[..., Any], rows: Sequence[Iterable[Any]]) -> list[Any]:
        """Return the results of a function, and None for variants that drop out by an error."""
        try:
            return [*map(function, *rows)]
        except Exception:
            found = []
            for at, given in enumerate(zip(*rows, strict=True)):
                try:
                    found.append(function(*given) if self.good[at] else None)
                except Exception:  # the build says what is wrong
                    self.good[at] = False
                    found.append(None)
            return found

    def _column(self, rows: Sequence[Any], kind: type) -> Any:
        """Return a column of values of a kind; variants that have another one drop out."""
        if {*map(type, rows)} != {kind}:
            self.drop([type(each) is not kind for each in rows])
            rows = [each if type(each) is kind else kind() for each in rows]
        return self._numpy.array(rows) if kind is float else list(rows)

    def drop(self, which: Any) -> None:
        """Let some variants drop out."""
        self.good &= ~self._numpy.asarray(which)

    # --- operands ---

    def _rows(self, operand: Operand) -> Any:
        """Return the values of an operand for one variant after another."""
        if type(operand) is Constant:
            return [operand.value] * self._count
        if type(operand) is int:
            column = self._columns[operand]
            if type(column) is list:
                return column
            key = operand
        else:
            key = -id(operand)
        found = self._lists.get(key)
        if found is None:
            found = self._lists[key] = self._listed(operand)
        return found

    def _listed(self, operand: Any) -> list[Any]:
        if type(operand) is int:
            column = self._columns[operand]
            if type(column) is tuple:
                return [*zip(*(each.tolist() for each in column), strict=True)]
            return column.tolist()  # type: ignore[no-any-return]
        rows: Iterable[tuple[Any, ...]] = zip(*map(self._rows, operand.parts), strict=True)
        if not operand.parts:
            rows = repeat((), self._count)
        if operand.kind is str:
            return [*map("".join, rows)]
        if operand.names:
            return [made_again(operand.kind, operand.names, row) for row in rows]
        return [*map(operand.kind, rows)]

    def _is_numeric(self, operand: Operand) -> bool:
        """Return whether an operand has floating-point numbers only, or such that are equal."""
        if type(operand) is int:
            return isinstance(self._columns[operand], self._numpy.ndarray)
        if type(operand) is Part:
            return operand.kind is not str and all(map(self._is_numeric, operand.parts))
        value: Any = operand.value  # type: ignore[union-attr]
        return type(value) is float or value is None or (type(value) is int and abs(value) <= EXACT)

    def _view(self, operand: Operand) -> Any:
        """Return an operand with columns in place of numbers."""
        if type(operand) is int:
            return self._columns[operand]
        if type(operand) is Constant:
            return operand.value
        found = self._views.get(-id(operand))
        if found is None:
            parts = tuple(map(self._view, operand.parts))  # type: ignore[union-attr]
            names = operand.names  # type: ignore[union-attr]
            found = made_again(operand.kind, names, parts) if names else parts  # type: ignore
            self._views[-id(operand)] = found
        return found

    def _one(self, operand: Any, at: int) -> Any:
        """Return the value that an operand has for one variant."""
        if type(operand) is Constant:
            return operand.value
        if type(operand) is Part:
            parts = tuple(self._one(each, at) for each in operand.parts)
            return made_again(operand.kind, operand.names, parts) if operand.names else parts
        column = self._columns[operand]
        if type(column) is list:
            return column[at]
        is_tuple = type(column) is tuple
        return tuple(float(each[at]) for each in column) if is_tuple else float(column[at])

    def whole(self, value: Any) -> Any:
        """Return a column, of a column or of a number that is the same for all."""
        return self._numpy.broadcast_to(value, self._count)

    # --- what overlaps ---

    def _overlapping(self, shapes: Any, owners: Any, may: Any, expected: Any) -> Any:
        """Return for which variants those pairs of shapes overlap that are expected."""
        convex, names = self._view(shapes), self._view(owners)
        wanted = {(names[one], names[other]): (one, other) for one, other in expected}
        holds = self.good.copy()
        for other in range(len(names)):
            for one in range(other):
                pair = names[one], names[other]
                is_decided = (one, other) > wanted.get(pair, (other, other))
                if is_decided or not may.value(*pair):
                    continue
                x, y, z = minus(convex[one].center, convex[other].center)
                reach = convex[one].radius + convex[other].radius
                near = self.whole(x * x + y * y + z * z < reach * reach) & holds
                found = self._overlap(shapes.parts[one], shapes.parts[other], near)
                holds &= found if wanted.get(pair) == (one, other) else ~found
        return holds

    def _overlap(self, one: Part, other: Part, left: Any) -> Any:
        """Return for which of some variants two shapes overlap."""
        numpy = self._numpy
        first, second = self._view(one), self._view(other)
        known = self._witnesses.setdefault((id(one), id(other)), [])
        found = numpy.zeros(self._count, bool)
        at = 0
        while left.any():
            if at < len(known):
                overlaps, ways = known[at]
                at += 1
            else:
                row = int(left.argmax())
                overlaps, ways = witness(self._one(one, row), self._one(other, row))
                found[row] = overlaps
                left[row] = False
                if not ways:
                    continue
                known.append((overlaps, ways))
                at += 1
            shown = left & self.whole(_show(numpy, first, second, overlaps, ways))
            left &= ~shown
            if overlaps:
                found |= shown
        return found


def _last_uses(recording: Recording) -> dict[int, list[int]]:
    """Return which columns are used for the last time by which step."""
    last: dict[int, int] = {}
    parts: dict[int, frozenset[int]] = {}

    def columns_in(operand: Operand) -> frozenset[int]:
        if type(operand) is int:
            return frozenset((operand,))
        if type(operand) is Constant:
            return frozenset()
        found = parts.get(id(operand))
        if found is None:
            inner = map(columns_in, operand.parts)  # type: ignore[union-attr]
            found = parts[id(operand)] = frozenset().union(*inner)
        return found

    for at, step in enumerate(recording.steps):
        for operand in step.operands:
            last.update(dict.fromkeys(columns_in(operand), at))
    for operand in recording.pieces[1::2]:
        for column in columns_in(operand):
            last.pop(column, None)
    found: dict[int, list[int]] = {}
    for column, at in last.items():
        found.setdefault(at, []).append(column)
    return found


# --- functions of whole columns -------------------------------------------------------------------


def _divided(columns: Columns, left: Any, right: Any) -> Any:
    columns.drop(columns.whole(right == 0))
    return left / right


def _folded(compare: Callable[[Any, Any], Any]) -> Callable[..., Any]:
    def folded(columns: Columns, given: Any, *none: Any) -> Any:
        numpy = import_extra("numpy")
        found = given[0]
        for each in given[1:]:
            found = numpy.where(compare(each, found), each, found)
        return found

    return folded


def _plain(function: Callable[..., Any]) -> Callable[..., Any]:
    return lambda columns, *given: function(*given)


def _finite(columns: Columns, given: Any) -> Any:
    return import_extra("numpy").isfinite(given)


def _farthest(columns: Columns, convex: Convex, way: Vector) -> Any:
    found = farthest(import_extra("numpy"), convex, way)
    return None if found is None else tuple(map(columns.whole, found))


_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    operator.truediv: _divided,
    max: _folded(operator.gt),
    min: _folded(operator.lt),
    math.isfinite: _finite,
    Convex.farthest: _farthest,
    **{
        each: _plain(each)
        for each in (
            abs, operator.add, operator.sub, operator.mul, operator.neg, operator.lt, operator.le,
            operator.gt, operator.ge, operator.eq, operator.ne,
        )
    },
}  # fmt: skip
"""Functions of floating-point numbers for which NumPy gives the same results."""


def farthest(numpy: Any, convex: Any, way: Any) -> Any:
    """Return what `Convex.farthest` returns of shapes with columns, or None."""
    x, y, z = rotate(convex._axes, way)
    shape = convex._shape
    kind = type(shape)
    if shape is None:
        reach = [dot(point, (x, y, z)) for point in convex.points]
        local: Any = convex.points[0]
        best = reach[0]
        for point, each in zip(convex.points[1:], reach[1:], strict=True):
            is_more = each > best
            best = numpy.where(is_more, each, best)
            local = tuple(numpy.where(is_more, *pair) for pair in zip(point, local, strict=True))
    elif kind is Box:
        local = tuple(
            numpy.where(part >= 0, size / 2, -(size / 2))
            for size, part in ((shape.x, x), (shape.y, y), (shape.z, z))
        )
    else:
        half = shape.length / 2 if kind in (Cylinder, Capsule) else 0.0
        end = numpy.where(z >= 0, half, -half)
        across = (x, y) if kind is Cylinder else (x, y, z)
        length = _hypot(numpy, across)
        part = numpy.where(length > 0, shape.radius / length, 0.0)
        local = (x * part, y * part, end if kind is Cylinder else z * part + end)
    return convex._pose.apply(local)


def _hypot(numpy: Any, parts: Sequence[Any]) -> Any:
    """Return the length of vectors, with the digits of Python."""
    rows = numpy.broadcast_arrays(*parts)
    if not rows[0].ndim:
        return numpy.float64(math.hypot(*map(float, rows)))
    return numpy.array([*map(math.hypot, *(each.tolist() for each in rows))])


def _show(numpy: Any, first: Any, second: Any, overlaps: bool, ways: Sequence[Vector]) -> Any:
    """Return for which variants some ways show that shapes overlap, or that they do not."""
    points = []
    for x, y, z in ways:
        one, other = _shrunk(numpy, first, (x, y, z)), _shrunk(numpy, second, (-x, -y, -z))
        points.append(minus(one, other))
    size = first.radius + second.radius
    if not overlaps:
        return dot(points[0], ways[0]) < -MARGIN * size * math.hypot(*ways[0])
    a, b, c, d = points
    least = MARGIN * size**3
    volumes = (_volume(b, c, d), -_volume(a, c, d), _volume(a, b, d), -_volume(a, b, c))
    positive = [each > least for each in volumes]
    negative = [each < -least for each in volumes]
    return numpy.logical_and.reduce(numpy.broadcast_arrays(*positive)) | (
        numpy.logical_and.reduce(numpy.broadcast_arrays(*negative))
    )


def _volume(a: Vector, b: Vector, c: Vector) -> Any:
    """Return six times the volume between the origin and three points."""
    return dot(a, cross(b, c))


def _shrunk(numpy: Any, convex: Any, way: Vector) -> Any:
    """Return what `Convex.shrunk` returns of shapes with columns."""
    pairs = zip(farthest(numpy, convex, way), convex.center, strict=True)
    return tuple(center + (point - center) * SHRUNK for point, center in pairs)
