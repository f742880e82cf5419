"""A deadline ends what takes too long, and leaves no trace where it was not reached, or just so."""

from __future__ import annotations

import _thread
import subprocess
import sys
import time
from collections.abc import Iterator

import pytest

from tests.waiting import PATIENCE, wait_for
from yamaro.sandbox import deadline
from yamaro.sandbox.deadline import TimeOver, run_within

pytestmark = pytest.mark.usefixtures("untraced")


def work_for(seconds: float) -> None:
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        pass


def wait_for_threads_to_end(count: int) -> None:
    """Wait until there are at most this many threads."""
    wait_for(lambda: _thread._count() <= count)


def spin(seconds: float, catches: int = 0) -> int:
    """Compute without end under a deadline that is caught so many times; return how often."""

    def work() -> int:
        times = 0
        while True:
            try:
                while True:
                    pass
            except TimeOver:
                times += 1
                if times > catches:
                    return times

    return run_within(seconds, work)


def test_what_takes_too_long_is_ended() -> None:
    with pytest.raises(TimeOver):
        run_within(0.05, lambda: work_for(PATIENCE))


def test_what_catches_the_end_of_its_time_is_ended_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(deadline, "AGAIN_AFTER", 0.02)
    threads = _thread._count()
    assert spin(0.1, catches=2) == 3
    wait_for_threads_to_end(threads)


def test_work_that_is_done_in_time_is_left_alone() -> None:
    before = _thread._count()
    for seconds in (None, 60.0, 1e12):
        assert run_within(seconds, lambda: 7) == 7
    wait_for_threads_to_end(before)


def test_nothing_is_heard_of_a_deadline_after_the_work() -> None:
    assert run_within(0.02, lambda: 7) == 7
    work_for(0.1)


def test_a_time_that_is_over_when_the_work_was_just_done_stops_nothing() -> None:
    watch = deadline._Watch()
    watch.end()
    watch._ended.acquire()  # as if it had not come to that yet
    watch._run(0.001)
    work_for(0.01)


def test_a_deadline_that_comes_up_while_it_is_ended_is_ended_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    end, ends = deadline._Watch.end, list[int]()

    def end_at_the_second_try(self: deadline._Watch) -> None:
        ends.append(1)
        if len(ends) == 1:
            raise TimeOver
        end(self)

    monkeypatch.setattr(deadline._Watch, "end", end_at_the_second_try)
    threads = _thread._count()
    assert run_within(60, lambda: 7) == 7
    wait_for_threads_to_end(threads)


@pytest.fixture
def frequent_switches() -> Iterator[None]:
    """Let other threads have their turn every tenth of a millisecond."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-4)
    yield
    sys.setswitchinterval(before)


@pytest.mark.usefixtures("frequent_switches")
def test_what_ends_just_in_time_hears_nothing_of_it_later() -> None:
    """The end of the time and that of the work are moved across each other."""
    outcomes = set()
    for turn in range(300):
        is_over = False
        try:
            run_within(0.002, lambda: work_for(turn * 2e-5))  # noqa: B023
        except TimeOver:
            is_over = True
        work_for(0.0005)  # here nothing may come up
        outcomes.add(is_over)
    assert outcomes == {False, True}


TRACED = """
import sys
from yamaro.sandbox import deadline
from yamaro.sandbox.deadline import TimeOver, run_within
def work_for_ever():
    while True: pass
run_within(60, int)
try:
    run_within(0.01, work_for_ever)
except TimeOver:
    pass
calls = []
def trace(frame, event, argument):
    calls.append(event)
    return trace
sys.settrace(trace)
(lambda: 1)()
sys.settrace(None)
print(calls)
"""


def test_a_debugger_or_a_coverage_tool_may_trace_afterwards() -> None:
    """In Python 3.11 a look-out for exceptions that never come would make the process stand still.

    It does so from the first function that is called under a tracer.
    """
    process = subprocess.run(
        [sys.executable, "-S", "-c", f"import sys; sys.path[:] = {sys.path!r}\n{TRACED}"],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    assert process.returncode == 0, process.stderr
    assert process.stdout.startswith("['call', 'line', 'return'")
