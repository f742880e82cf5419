"""The garbage collector looks seldom while a conversion runs, and as before afterwards."""

from __future__ import annotations

import gc
import threading
from collections.abc import Iterator

import pytest

import yamaro
from yamaro.sandbox.process import THRESHOLD, RareCollection

FILES = yamaro.MemoryLoader(
    {
        "/t.yaml": "launch: {a: $(look()), b: $(then())}\n",
        "/faulty.yaml": "launch: {a: $(look()), b: $(1 / 0)}\n",
    }
)


@pytest.fixture(autouse=True)
def thresholds() -> Iterator[tuple[int, int, int]]:
    before = gc.get_threshold()
    yield before
    gc.set_threshold(*before)
    gc.enable()


def build(path: str = "/t.yaml", then: object = lambda: None) -> list[int]:
    """Build a file, and return the thresholds seen while it ran."""
    seen: list[int] = []
    variables = {"look": lambda: seen.append(gc.get_threshold()[0]), "then": then}
    yamaro.build(path, variables=variables, loader=FILES)
    return seen


def test_it_looks_seldom_while_a_conversion_runs(thresholds: tuple[int, int, int]) -> None:
    assert build() == [THRESHOLD]
    assert gc.get_threshold() == thresholds


def test_errors_give_the_thresholds_back(thresholds: tuple[int, int, int]) -> None:
    with pytest.raises(yamaro.YamaroError):
        build("/faulty.yaml")
    with pytest.raises(yamaro.UsageError):
        build("/nowhere.yaml")
    assert gc.get_threshold() == thresholds


def test_conversions_may_nest(thresholds: tuple[int, int, int]) -> None:
    inner: list[int] = []
    outer = build(then=lambda: inner.extend(build()))
    assert outer + inner == [THRESHOLD] * 2
    assert gc.get_threshold() == thresholds


def test_the_first_thread_to_end_leaves_the_other_alone(thresholds: tuple[int, int, int]) -> None:
    entered, ended = threading.Event(), threading.Event()
    during: list[int] = []

    def work() -> None:
        with RareCollection():
            entered.set()
            ended.wait(60)
            during.append(gc.get_threshold()[0])

    with RareCollection():
        thread = threading.Thread(target=work)
        thread.start()
        entered.wait(60)
    ended.set()
    thread.join()
    assert during == [THRESHOLD]
    assert gc.get_threshold() == thresholds


def test_older_objects_are_looked_at_as_before() -> None:
    gc.set_threshold(123, 4, 5)
    with RareCollection():
        assert gc.get_threshold() == (THRESHOLD, 4, 5)


def test_own_thresholds_are_given_back_or_let_be() -> None:
    gc.set_threshold(1, 4, 5)
    assert (build(), gc.get_threshold()) == ([THRESHOLD], (1, 4, 5))
    gc.set_threshold(123, 4, 5)
    assert (build(), gc.get_threshold()) == ([THRESHOLD], (123, 4, 5))
    gc.set_threshold(THRESHOLD + 1, 4, 5)
    assert (build(), gc.get_threshold()) == ([THRESHOLD + 1], (THRESHOLD + 1, 4, 5))
    gc.set_threshold(0)
    assert (build(), gc.get_threshold()[0]) == ([0], 0)


def test_thresholds_that_a_file_sets_stay() -> None:
    build(then=lambda: gc.set_threshold(321))
    assert gc.get_threshold()[0] == 321


def test_a_collector_that_is_switched_off_stays_off() -> None:
    gc.disable()
    build()
    assert not gc.isenabled()
