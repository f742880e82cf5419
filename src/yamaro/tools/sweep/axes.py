"""Axes of a design space: the values of an argument, and how they are written.

An axis gives a value for a number from 0 to 1, or for a count. It is written as `0.2..0.4`, `4,6`,
`log:10..500` or, in a study, `{range: [1, 2]}`.

Numbers are in the unit of their argument, as they are passed to the file. What goes through
a logarithm or a normal distribution is rounded to 12 digits, since libraries of mathematics differ
in the last ones: so all machines of a cluster agree.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ...declared_arguments import Declared
from ...diagnostics import InputFault, did_you_mean
from ...syntax.argument_section import (
    ANY,
    BOOLEAN,
    INTEGER,
    NUMBER,
    NUMERIC,
    PATH,
    TEXT,
    ArgumentEntry,
    checked,
    quantity,
)

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
        kinds = {type(value) for value in choices}
        if kinds == {bool}:
            kind = BOOLEAN
        elif kinds <= {int, float}:
            kind = INTEGER if kinds == {int} else NUMBER
        else:
            kind = TEXT if kinds == {str} else ANY
        super().__init__(name, kind, unit)
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


# --- axes as they are written -----------------------------------------------------------------


KEYS = ("range", "choices", "log", "normal", "step", "points")
_LOG, _NORMAL = "log:", "normal:"
_FORMS = "0.2..0.4, 0.2..0.4:0.05 in steps, 4,6, log:10..500 or normal:1,0.05"


def axis_of_data(declared: Declared, data: object) -> Axis:
    """Return the axis that a value in a study means.

    Args:
        declared: the argument.
        data: the value, without expressions; None for the argument's own range or choices.

    Raises:
        InputFault: it means none.
    """
    if data is None:
        return declared_axis(declared)
    if isinstance(data, str):
        return axis_of_text(declared, data)
    if isinstance(data, list):
        if len(data) != 2:
            raise _fault(
                f"a list is a range: two numbers, and '{declared.name}' has {len(data)}",
                "for a choice, write {choices: [...]}",
            )
        return _of_range(declared, data, {})
    if isinstance(data, dict):
        return _of_mapping(declared, data)
    raise _fault(f"'{declared.name}' takes a range or choices, such as {_FORMS}")


def axis_of_text(declared: Declared, text: str) -> Axis:
    """Return the axis that a text on the command line or in a study means.

    Raises:
        InputFault: it means none.
    """
    from ...options import UsageError
    from ...request import read_command_line

    text = text.strip()
    if not text:
        return declared_axis(declared)
    if text.startswith(_NORMAL):
        numbers = text.removeprefix(_NORMAL).split(",")
        return _of_normal(declared, numbers)
    is_log = text.startswith(_LOG)
    low, has_range, high = text.removeprefix(_LOG).partition("..")
    if has_range and (is_log or _is_numeric(declared, low)):
        more: dict[str, object] = {"log": True} if is_log else {}
        for mark, word in ((":", "step"), ("/", "points")):
            before, has_more, after = high.rpartition(mark)
            if has_more and (mark == ":" or after.strip().isdigit()):
                high, more[word] = before, after.strip()
                break
        return _of_range(declared, [low.strip(), high.strip()], more)
    if is_log:
        raise _fault(f"'{text}' needs a range: log:10..500")
    choices = []
    for word in words_in(text):
        try:
            values, _ = read_command_line([f"{declared.name}:={word}"])
        except UsageError as error:
            raise _fault(f"{error}") from None
        value = next(iter(values.values()))
        choices.append(word if takes_text(declared) and not isinstance(value, str) else value)
    if len(choices) < 2:
        raise _fault(
            f"'{declared.name}={text}' is a single value",
            f"{declared.name}:={text} passes it to all variants; an axis is {_FORMS}",
        )
    return _of_choices(declared, choices)


def declared_axis(declared: Declared) -> Axis:
    """Return the axis of an argument's own range or choices.

    Raises:
        InputFault: it has neither.
    """
    entry = declared.entry
    if entry is not None and entry.choices is not None:
        return _choices(entry, entry.choices)
    if entry is not None and entry.kind == BOOLEAN:
        return _choices(entry, [False, True])
    if entry is None or entry.low is None or entry.high is None:
        raise _fault(
            f"'{declared.name}' declares no range and no choices",
            f"say which values it takes: {_FORMS}",
        )
    return _between(entry, entry.low, entry.high, step=entry.step, is_log=entry.is_log, points=None)


def has_axis(declared: Declared) -> bool:
    """Return whether an argument has a range or choices."""
    entry = declared.entry
    if entry is None:
        return False
    return entry.choices is not None or (entry.low is not None and entry.high is not None)


def passed_value(declared: Declared, value: object, *, spelling: str | None = None) -> object:
    """Return a value as it is passed to the file: a number in the unit of the argument.

    Raises:
        InputFault: the argument does not take it.
    """
    entry = declared.entry
    if entry is None:
        return value
    return _in_unit(entry, checked(entry, value, spelling=spelling))


# --- ranges ---


def _of_mapping(declared: Declared, data: Mapping[str, object]) -> Axis:
    for key in data:
        if key not in KEYS:
            hint = did_you_mean(str(key), list(KEYS)) or f"the keys are {', '.join(KEYS)}"
            raise _fault(f"an axis has no key '{key}'", hint)
    forms = [key for key in ("range", "choices", "normal") if key in data]
    if isinstance(data.get("log"), list):
        forms.append("log")
    if len(forms) != 1:
        raise _fault(
            f"'{declared.name}' needs one of `range`, `choices`, `log` and `normal`",
            "{range: [0.2, 0.4]}, {choices: [4, 6]}, {log: [10, 500]} or {normal: [1, 0.05]}",
        )
    form = forms[0]
    allowed = {"range": KEYS, "log": ("log", "step", "points")}.get(form, (form,))
    for key in data:
        if key not in allowed:
            raise _fault(f"`{key}` does not go with `{form}`")
    values = data[form]
    if not isinstance(values, list):
        example = {"choices": "[4, 6]", "normal": "[1, 0.05]"}.get(form, "[0.2, 0.4]")
        raise _fault(f"`{form}` takes a list: {example}")
    if form == "choices":
        return _of_choices(declared, values)
    if form == "normal":
        return _of_normal(declared, values)
    more = {key: value for key, value in data.items() if key not in ("range", "choices")}
    return _of_range(declared, values, {**more, "log": True} if form == "log" else more)


def _of_range(declared: Declared, ends: Sequence[object], more: Mapping[str, object]) -> Axis:
    """Return the axis of two numbers, with what else is said: `step`, `points`, `log`."""
    if len(ends) != 2:
        raise _fault("a range takes two numbers: [0.2, 0.4]")
    entry = _numeric_entry(declared, ends)
    low, high = (quantity(entry, end) for end in ends)
    for end in (low, high):
        checked(entry, end, is_si=True)
    step, points = more.get("step"), more.get("points")
    if step is not None and points is not None:
        raise _fault("`step` and `points` do not go together")
    is_log = more.get("log", False)
    if not isinstance(is_log, bool):
        raise _fault("`log` takes true, or a range: {log: [10, 500]}")
    return _between(
        entry, low, high,
        step=None if step is None else quantity(entry, step),
        is_log=is_log,
        points=None if points is None else _points(points),
    )  # fmt: skip


def _between(
    entry: ArgumentEntry,
    low: float,
    high: float,
    *,
    step: float | None,
    is_log: bool,
    points: int | None,
) -> Axis:
    """Return the axis between two numbers in SI."""
    first, last = entry.in_unit(low), entry.in_unit(high)
    if not first < last:
        raise _fault(f"the range of '{entry.name}' has to rise, and {first} is not below {last}")
    if is_log and first <= 0:
        raise _fault(f"a logarithmic range begins above 0, and that of '{entry.name}' at {first}")
    if entry.kind == INTEGER and step is None and points is None:
        step = 1
    if step is None:
        if entry.kind == INTEGER:
            raise _fault(f"'{entry.name}' takes integers: write `step`, not `points`")
        return Uniform(entry.name, first, last, entry.unit_text, is_log=is_log, points=points)
    width = entry.in_unit(step)
    if width <= 0:
        raise _fault("`step` takes a number greater than 0")
    count = math.floor((last - first) / width * (1 + 1e-12)) + 1
    if count > MOST_VALUES:
        raise _fault(f"'{entry.name}' has {count:,} steps, which is too many")
    return Steps(entry.name, first, width, count, entry.unit_text, is_log=is_log)


def _of_normal(declared: Declared, numbers: Sequence[object]) -> Axis:
    if len(numbers) != 2:
        raise _fault("a normal distribution takes mean and standard deviation: [1.0, 0.05]")
    entry = _numeric_entry(declared, (1.5,))
    if entry.kind == INTEGER:
        raise _fault(f"'{entry.name}' takes integers, which have no normal distribution")
    mean, deviation = (entry.in_unit(quantity(entry, number)) for number in numbers)
    if deviation <= 0:
        raise _fault("the standard deviation is a number greater than 0")
    low, high = (
        None if end is None else float(entry.in_unit(end)) for end in (entry.low, entry.high)
    )
    if (low is not None and mean < low) or (high is not None and mean > high):
        raise _fault(f"the mean of '{entry.name}' is outside of its range, {entry.range_text()}")
    return Normal(entry.name, mean, deviation, entry.unit_text, low=low, high=high)


def _points(value: object) -> int:
    try:
        points = int(str(value))
    except ValueError:
        points = 0
    if not 2 <= points <= MOST_VALUES:
        raise _fault(f"`points` takes an integer of at least 2, not '{value}'")
    return points


# --- choices ---


def _of_choices(declared: Declared, values: Sequence[object]) -> Axis:
    if not values:
        raise _fault(f"'{declared.name}' has no choices")
    entry = declared.entry
    if entry is None:
        return Choices(declared.name, values)
    taken = []
    for value in values:
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        taken.append(checked(entry, value, spelling=str(value) if is_number else None))
    return _choices(entry, taken)


def _choices(entry: ArgumentEntry, values: Sequence[object]) -> Choices:
    return Choices(entry.name, [_in_unit(entry, value) for value in values], entry.unit_text)


def takes_text(declared: Declared) -> bool:
    """Return whether an argument takes what is written, whatever it reads like."""
    return declared.entry is not None and declared.entry.kind in (TEXT, PATH)


def words_in(text: str) -> list[str]:
    """Return the words that commas separate, except for commas in brackets and quotes."""
    words, depth, quote = [""], 0, ""
    for character in text:
        if quote:
            quote = "" if character == quote else quote
        elif character in "'\"" and not words[-1].strip():
            quote = character
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth <= 0 and not quote:
            words.append("")
        else:
            words[-1] += character
    return [word.strip() for word in words if word.strip()]


def _in_unit(entry: ArgumentEntry, value: object) -> object:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if entry.kind in NUMERIC and is_number:
        return entry.in_unit(value)  # type: ignore[arg-type]
    return value


# --- numbers ---


def _numeric_entry(declared: Declared, numbers: Sequence[object]) -> ArgumentEntry:
    """Return the entry of an argument that takes numbers.

    For a file that does not declare its arguments it is made up: whole numbers if the default is
    one, and so are the ends.
    """
    entry = declared.entry
    if entry is not None and entry.kind in NUMERIC:
        return entry
    if entry is not None and entry.kind != ANY:
        raise _fault(
            f"'{declared.name}' is of the type {entry.kind}, and has no range",
            f"write choices: {declared.name}=a,b",
        )
    made = ArgumentEntry(declared.name, declared.span)
    is_whole = type(declared.default) is int and all(
        isinstance(each, int) or (isinstance(each, str) and each.strip().lstrip("+-").isdigit())
        for each in numbers
    )
    made.kind = INTEGER if is_whole else NUMBER
    return made


def _is_numeric(declared: Declared, text: str) -> bool:
    """Return whether what is left of two dots is a number, and not the beginning of a path."""
    entry = declared.entry
    if entry is not None and entry.kind in (TEXT, PATH, BOOLEAN):
        return False
    if entry is not None and entry.kind in NUMERIC:
        return True
    try:
        quantity(ArgumentEntry(declared.name, declared.span), text.strip())
    except InputFault:
        return False
    return True


def _fault(message: str, hint: str | None = None) -> InputFault:
    return InputFault("bad-sweep", message, hint)
