"""Axes of a design space: which values an argument takes, by a number from 0 to 1 or by a count.

Numbers are in the unit of their argument, as they are passed to the file. What goes through
a logarithm or a normal distribution is rounded to 12 digits, since libraries of mathematics differ
in the last ones: so all machines of a cluster agree.
"""

from __future__ import annotations

import math

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

NUMBER, INTEGER, BOOLEAN, TEXT, ANY = "number", "integer", "boolean", "text", "any"
"""The types of the values of an axis, and of columns."""
MOST_VALUES = 1 << 40
"""The most values that one axis may have."""


class Axis:
    """The values that one argument takes.

    Attributes:
        name: the argument.
        kind: the type of the values.
        unit: the unit of numbers, as it is written, or "".
    """

    __slots__ = ("kind", "name", "unit")

    def __init__(self, name: str, kind: str, unit: str = "") -> None:
        self.name = name
        self.kind = kind
        self.unit = unit

    @property
    def count(self) -> int | None:
        """Return how many values there are; None if they are not counted."""
        return None

    def value(self, part: float) -> object:
        """Return the value for a number from 0 to 1, 1 excluded."""
        count = self.count
        assert count is not None
        return self.at(min(int(part * count), count - 1))

    def at(self, index: int) -> object:
        """Return the value of an index, for an axis whose values are counted."""
        raise NotImplementedError

    def described(self) -> dict[str, object]:
        """Return what decides about the values, for `study.json`."""
        slots = {name for kind in type(self).__mro__ for name in getattr(kind, "__slots__", ())}
        own = {name: getattr(self, name) for name in sorted(slots) if getattr(self, name) != ""}
        return {"form": type(self).__name__.lower(), **own}


class Choices(Axis):
    """One of a list of values."""

    __slots__ = ("choices",)

    def __init__(self, name: str, choices: Sequence[object], unit: str = "") -> None:
        super().__init__(name, _kind_of(choices), unit)
        self.choices = list(choices)

    @property
    def count(self) -> int:
        """Return how many values there are."""
        return len(self.choices)

    def at(self, index: int) -> object:
        """Return the value of an index."""
        return self.choices[index]


class Steps(Axis):
    """Numbers at equal distances; with `is_log` small ones are as frequent as large ones.

    Attributes:
        low: the first.
        step: the distance.
        steps: how many there are.
        is_log: whether orders of magnitude are equally frequent, which does not concern grids.
    """

    __slots__ = ("is_log", "low", "step", "steps")

    def __init__(
        self, name: str, low: float, step: float, steps: int, unit: str = "", *, is_log: bool
    ) -> None:
        is_whole = isinstance(low, int) and isinstance(step, int)
        super().__init__(name, INTEGER if is_whole else NUMBER, unit)
        self.low = low
        self.step = step
        self.steps = steps
        self.is_log = is_log

    @property
    def count(self) -> int:
        """Return how many values there are."""
        return self.steps

    def at(self, index: int) -> object:
        """Return the value of an index."""
        value = self.low + index * self.step
        return rounded(value, 15) if isinstance(value, float) else value

    def value(self, part: float) -> object:
        """Return the value for a number from 0 to 1."""
        if not self.is_log:
            return super().value(part)
        if self.kind == INTEGER and self.step == 1:  # each has the room up to the next one
            exact = _log_between(self.low, self.low + self.steps, part)
            index = int(rounded(exact, 12)) - int(self.low)
        else:
            exact = _log_between(self.low, self.low + (self.steps - 1) * self.step, part)
            index = round(rounded((exact - self.low) / self.step, 12))
        return self.at(min(max(index, 0), self.steps - 1))


class Uniform(Axis):
    """Numbers between two, all equally frequent, or with `is_log` all orders of magnitude.

    Attributes:
        low: the least.
        high: the greatest.
        is_log: whether orders of magnitude are equally frequent.
        points: how many values a grid takes, or None.
    """

    __slots__ = ("high", "is_log", "low", "points")

    def __init__(
        self,
        name: str,
        low: float,
        high: float,
        unit: str = "",
        *,
        is_log: bool = False,
        points: int | None = None,
    ) -> None:
        super().__init__(name, NUMBER, unit)
        self.low = float(low)
        self.high = float(high)
        self.is_log = is_log
        self.points = points

    @property
    def count(self) -> int | None:
        """Return how many values a grid takes."""
        return self.points

    def at(self, index: int) -> object:
        """Return the value of an index, from the least to the greatest number."""
        assert self.points is not None
        return self.value(index / (self.points - 1) if self.points > 1 else 0.0)

    def value(self, part: float) -> object:
        """Return the value for a number from 0 to 1."""
        if self.is_log:
            value = rounded(_log_between(self.low, self.high, part), 12)
        else:
            value = rounded(self.low + part * (self.high - self.low), 15)
        return min(max(value, self.low), self.high)


class Normal(Axis):
    """Numbers of a normal distribution, within the range of the argument if it has one.

    Attributes:
        mean: its mean.
        deviation: its standard deviation.
        low: the least number, or None.
        high: the greatest number, or None.
    """

    __slots__ = ("_above", "_below", "deviation", "high", "low", "mean")

    def __init__(
        self,
        name: str,
        mean: float,
        deviation: float,
        unit: str = "",
        *,
        low: float | None = None,
        high: float | None = None,
    ) -> None:
        super().__init__(name, NUMBER, unit)
        self.mean = float(mean)
        self.deviation = float(deviation)
        self.low = low
        self.high = high
        self._below = 0.0 if low is None else self._share_below(low)
        self._above = 1.0 if high is None else self._share_below(high)

    def _share_below(self, value: float) -> float:
        return 0.5 * math.erfc((self.mean - value) / self.deviation / math.sqrt(2.0))

    def value(self, part: float) -> object:
        """Return the value for a number from 0 to 1."""
        from statistics import NormalDist

        share = self._below + part * (self._above - self._below)
        share = min(max(share, 2.0**-54), 1.0 - 2.0**-53)
        value = rounded(NormalDist(self.mean, self.deviation).inv_cdf(share), 12)
        if self.low is not None:
            value = max(value, self.low)
        return value if self.high is None else min(value, self.high)

    def described(self) -> dict[str, object]:
        """Return what decides about the values."""
        own = super().described()
        return {name: value for name, value in own.items() if name[0] != "_"}


def rounded(value: float, digits: int) -> float:
    """Return a number rounded to some significant digits."""
    return float(f"{value:.{digits}g}")


def _log_between(low: float, high: float, part: float) -> float:
    return math.exp(math.log(low) + part * (math.log(high) - math.log(low)))


def _kind_of(values: Sequence[object]) -> str:
    """Return the type of the values of a list."""
    kinds = {type(value) for value in values}
    if kinds == {bool}:
        return BOOLEAN
    if kinds == {int}:
        return INTEGER
    if kinds <= {int, float}:
        return NUMBER
    return TEXT if kinds == {str} else ANY
