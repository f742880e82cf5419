"""Axes: how they are written, which values they give, and how often."""

from __future__ import annotations

import json
import math
from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.effort import examples
from tests.later import Later
from yamaro.declared_arguments import Declared, declared_of
from yamaro.diagnostics import InputFault
from yamaro.source import Source
from yamaro.tools.sweep.axes import Axis, axis_of_data, axis_of_text
from yamaro.tools.sweep.plan import axis_of

if TYPE_CHECKING:
    from scipy import stats
else:
    stats = Later("scipy.stats")

ROBOT = """\
arguments:
  reach: {default: 0.85, unit: m, range: [0.3, 1.3]}
  tilt: {default: 0, unit: deg, range: [-30, 30], step: 15}
  gripper: {default: none, choices: [none, two_finger, vacuum]}
  legs: {type: integer, range: [3, 12], default: 4}
  gain: {default: 1, range: [0.01, 100], log: true}
  teeth: {type: integer, range: [1, 1000], log: true, default: 10}
  mass: {default: 1 kg, unit: kg}
  solid: true
  tag: {type: text, default: a}
  any:
model: {}
"""


def declared(name: str) -> Declared:
    from yamaro.syntax.argument_section import arguments_of

    entries = arguments_of(Source(ROBOT, name="robot.yaml")) or []
    return next(declared_of(entry) for entry in entries if entry.name == name)


def axis(name: str, written: object) -> Axis:
    return axis_of_data(declared(name), written)


def grid(made: Axis) -> list[object]:
    assert made.count is not None
    return [made.at(index) for index in range(made.count)]


def samples(made: Axis, count: int = 10_000) -> list[Any]:
    """Return the values for numbers in the middle of as many strata."""
    return [made.value((index + 0.5) / count) for index in range(count)]


@pytest.mark.parametrize(
    ("name", "written", "values"),
    [
        ("reach", "0.4..0.8:0.1", [0.4, 0.5, 0.6, 0.7, 0.8]),
        ("reach", "40cm..80cm:20cm", [0.4, 0.6, 0.8]),
        ("reach", "0.4..0.8/3", [0.4, 0.6, 0.8]),
        ("reach", {"range": [0.4, 0.8], "points": 2}, [0.4, 0.8]),
        ("reach", {"range": [0.4, "80cm"], "step": "30cm"}, [0.4, 0.7]),
        ("reach", "0.4,60cm,1", [0.4, 0.6, 1]),
        ("tilt", None, [-30, -15, 0, 15, 30]),
        ("tilt", "0rad..0.5235987755982988rad/2", [0.0, 30.0]),
        ("gripper", None, ["none", "two_finger", "vacuum"]),
        ("gripper", "vacuum,none", ["vacuum", "none"]),
        ("legs", "4..6", [4, 5, 6]),
        ("legs", [4, 8], [4, 5, 6, 7, 8]),
        ("legs", "4..8:2", [4, 6, 8]),
        ("legs", None, list(range(3, 13))),
        ("gain", "log:0.1..10/3", [0.1, 1.0, 10.0]),
        ("solid", None, [False, True]),
        ("tag", "007,true,b", ["007", "true", "b"]),
        ("tag", "'a, b',c", ["a, b", "c"]),
        ("tag", "../a,../b", ["../a", "../b"]),
        ("any", "4,x,[1, 2]", [4, "x", [1, 2]]),
        ("any", {"choices": [{"a": 1}, None]}, [{"a": 1}, None]),
    ],
)
def test_an_axis_gives_the_values_that_are_written(
    name: str, written: object, values: list[object]
) -> None:
    assert grid(axis(name, written)) == values


@pytest.mark.parametrize(
    ("name", "written", "message"),
    [
        ("reach", "0.8..0.4", "has to rise"),
        ("reach", "0.4..2", "takes a number from 0.3 to 1.3 m, not 2"),
        ("reach", "0.4kg..0.8", "is a mass"),
        ("reach", "0.4..0.8:0", "greater than 0"),
        ("reach", "0.4..0.8/1", "at least 2"),
        ("reach", {"range": [0.4, 0.8], "step": 0.1, "points": 3}, "do not go together"),
        ("reach", {"rnage": [0.4, 0.8]}, "no key 'rnage'"),
        ("reach", {"range": [0.4, 0.8], "choices": [1]}, "needs one of"),
        ("reach", {"choices": [0.4, 0.8], "step": 1}, "does not go with"),
        ("reach", [0.4, 0.6, 0.8], "a list is a range"),
        ("reach", "0.4", "is a single value"),
        ("reach", True, "takes a range or choices"),
        ("tilt", "log:-1..1", "above 0"),
        ("gripper", "vacuum,suction", "takes none, two_finger or vacuum"),
        ("gripper", [0.4, 0.8], "has no range"),
        ("legs", "normal:4,1", "no normal distribution"),
        ("reach", "normal:2,1", "outside of its range"),
        ("reach", "normal:1,0", "greater than 0"),
        ("reach", "normal:1", "mean and standard deviation"),
        ("mass", None, "no range and no choices"),
        ("legs", {"range": [4, 8], "points": 3}, "takes integers"),
    ],
)
def test_what_is_wrong_with_an_axis_is_said(name: str, written: object, message: str) -> None:
    with pytest.raises(InputFault, match=message):
        axis(name, written)


def test_a_file_without_arguments_takes_whole_numbers_where_the_default_is_one() -> None:
    made = declared("any")
    made.entry, made.default = None, 4
    assert grid(axis_of_text(made, "3..5")) == [3, 4, 5]
    made.default = 0.5
    assert axis_of_text(made, "3..5").count is None


@pytest.mark.parametrize("written", ["4..8", "4..8:2", "4,6"])
def test_counted_values_are_equally_frequent(written: str) -> None:
    made = axis("legs", written)
    counts = Counter(samples(made))
    assert set(counts) == set(grid(made))
    assert max(counts.values()) - min(counts.values()) <= 1


def test_numbers_of_a_range_are_uniform() -> None:
    found = np.array(samples(axis("reach", None)))
    assert stats.kstest(found, stats.uniform(0.3, 1.0).cdf).statistic < 1e-3
    assert found.min() >= 0.3
    assert found.max() <= 1.3


@pytest.mark.parametrize("written", [None, {"log": [0.01, 100]}, "log:0.01..100"])
def test_orders_of_magnitude_are_equally_frequent_with_log(written: object) -> None:
    found = np.array(samples(axis("gain", written)))
    assert stats.kstest(np.log10(found), stats.uniform(-2, 4).cdf).statistic < 1e-3


def test_whole_numbers_with_log_have_the_room_up_to_the_next_one() -> None:
    counts = Counter(samples(axis("teeth", None), 100_000))
    assert set(counts) <= set(range(1, 1001))
    for number in (1, 2, 9, 100):
        share = math.log((number + 1) / number) / math.log(1001)
        assert counts[number] == pytest.approx(100_000 * share, abs=2)


def test_a_normal_distribution_is_that_of_scipy() -> None:
    found = np.array(samples(axis("mass", {"normal": ["1 kg", "50 g"]})))
    expected = stats.norm(1.0, 0.05).ppf((np.arange(10_000) + 0.5) / 10_000)
    assert found == pytest.approx(expected, rel=1e-11)


def test_a_normal_distribution_keeps_to_the_range_of_its_argument() -> None:
    found = np.array(samples(axis("reach", "normal:0.4,0.2")))
    within = stats.truncnorm((0.3 - 0.4) / 0.2, (1.3 - 0.4) / 0.2, 0.4, 0.2)
    assert found == pytest.approx(within.ppf((np.arange(10_000) + 0.5) / 10_000), rel=1e-9)


@pytest.mark.parametrize("part", [0.0, 1 - 2**-53])
@pytest.mark.parametrize(
    ("name", "written"),
    [("mass", "normal:1,0.1"), ("gain", None), ("teeth", None), ("reach", None), ("legs", None)],
)
def test_the_ends_of_the_interval_give_values(name: str, written: object, part: float) -> None:
    value = axis(name, written).value(part)
    assert isinstance(value, (int, float))
    assert math.isfinite(value)


WRITTEN = [
    ("reach", None), ("reach", "0.4..0.8:0.1"), ("tilt", None), ("gripper", None),
    ("teeth", None), ("mass", "normal:1,0.1"), ("reach", "normal:0.4,0.2"), ("any", "4,x"),
]  # fmt: skip


@settings(max_examples=examples(20), deadline=None)
@given(st.sampled_from(WRITTEN), st.floats(0, 1, exclude_max=True))
def test_an_axis_is_the_same_after_it_was_written_down(
    written: tuple[str, object], part: float
) -> None:
    made = axis(*written)
    again = axis_of(made.name, json.loads(json.dumps(made.described())))
    assert (again.value(part), again.kind, again.unit) == (made.value(part), made.kind, made.unit)
