"""A deadline that was not reached, or just so, leaves no trace; see also tests/test_policy.py."""

from __future__ import annotations

import _thread
import subprocess
import sys
import time
from collections.abc import Iterator

import pytest

from yamaro.runtime.deadline import TimeOver, run_within

pytestmark = pytest.mark.usefixtures("untraced")


def work_for(seconds: float) -> None:
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        pass


def test_work_that_is_done_in_time_is_left_alone() -> None:
    before = _thread._count()
    for seconds in (None, 60.0, 1e12):
        assert run_within(seconds, lambda: 7) == 7
    deadline_for_threads = time.perf_counter() + 10
    while _thread._count() > before and time.perf_counter() < deadline_for_threads:
        time.sleep(0.001)
    assert _thread._count() == before


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
from yamaro.runtime.deadline import TimeOver, run_within
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
        timeout=60,
    )
    assert process.returncode == 0, process.stderr
    assert process.stdout.startswith("['call', 'line', 'return'")
