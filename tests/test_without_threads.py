"""Where no thread can be started, as in a browser, robots compile, and nothing runs for ever.

A browser's stack is shallow besides, so the recursion limit stays at Python's usual 1,000.
"""

from __future__ import annotations

import _thread
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from yamaro import Policy, YamaroError, build, convert
from yamaro.files.loader import MemoryLoader
from yamaro.sandbox import deadline, deep_stack
from yamaro.sandbox.deadline import TimeOver, run_within

EXAMPLES = Path(__file__).parents[1] / "examples"
RECURSION = {
    "a function": "functions:\n  Nest: {input: n, body: {Nest: $(n + 1)}}\nout: {Nest: 0}\n",
    "a file that includes itself": "out: {include: t.yaml}\n",
    "Python": "process: |\n  def f(n): return f(n + 1)\nout: {a: $(f(0))}\n",
    "a lambda": "variables:\n  f: '$(lambda g, n: g(g, n + 1))'\nout:\n  a: $(f(f, 0))\n",
}
ENDLESS = {
    "a loop": "while True: pass",
    "a loop that catches": "while True:\n  try:\n    while True: pass\n  except Exception: pass",
    "a long sum": "sum(x * x for x in range(10 ** 12))",
}
REFUSALS = ("too-deep", "limit-calls", "python-error", "unsafe-code")
can_monitor = pytest.mark.skipif(
    not hasattr(sys, "monitoring"), reason="Python can be monitored from 3.12 on"
)
pytestmark = pytest.mark.usefixtures("untraced", "no_threads")


@pytest.fixture
def no_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    def start(*_arguments: object) -> int:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(_thread, "start_new_thread", start)
    monkeypatch.setattr(deep_stack, "_idle", [])


def compile_text(text: str, policy: Policy) -> str:
    return build("/t.yaml", loader=MemoryLoader({"/t.yaml": text}), policy=policy).xml()


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*/*.yaml")), ids=lambda path: path.stem)
def test_examples_are_the_same(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if ".test" in path.name or "robot:" not in path.read_text(encoding="utf-8"):
        pytest.skip("is no robot of its own")
    without = convert(path)
    monkeypatch.undo()
    assert without == convert(path)


@pytest.mark.parametrize("text", RECURSION.values(), ids=RECURSION)
@pytest.mark.parametrize("mode", ["trusted", "safe"])
def test_recursion_without_end_is_told(text: str, mode: str) -> None:
    limit = sys.getrecursionlimit()
    with pytest.raises(YamaroError) as caught:
        compile_text(text, Policy(mode))
    assert caught.value.diagnostics[-1].code in REFUSALS
    assert sys.getrecursionlimit() == limit


@can_monitor
@pytest.mark.parametrize("code", ENDLESS.values(), ids=ENDLESS)
def test_what_takes_too_long_is_ended(code: str) -> None:
    text = "process: |\n  " + code.replace("\n", "\n  ") + "\nout: {a: 1}\n"
    with pytest.raises(YamaroError) as caught:
        compile_text(text, Policy(timeout=0.2))
    assert caught.value.diagnostics[-1].code == "limit-time"


@can_monitor
def test_what_is_done_in_time_hears_nothing_of_it() -> None:
    def work() -> int:
        return sum(range(1000))

    monitoring: Any = sys.monitoring  # type: ignore[attr-defined,unused-ignore]
    tools = [monitoring.get_tool(number) for number in range(6)]
    assert run_within(60, work) == 499500
    assert [monitoring.get_tool(number) for number in range(6)] == tools


def spin() -> None:
    while True:
        pass


@can_monitor
def test_a_deadline_within_a_deadline_is_its_own() -> None:
    def outer() -> str:
        with pytest.raises(TimeOver):
            run_within(0.05, spin)
        return "went on"

    assert run_within(60, outer) == "went on"


@can_monitor
def test_where_all_tools_are_in_use_there_is_no_deadline() -> None:
    monitoring: Any = sys.monitoring  # type: ignore[attr-defined,unused-ignore]
    taken = [number for number in range(6) if monitoring.get_tool(number) is None]
    for number in taken:
        monitoring.use_tool_id(number, "a test")
    try:
        assert run_within(1e-9, lambda: 7) == 7
    finally:
        for number in taken:
            monitoring.free_tool_id(number)


def test_a_python_that_cannot_be_monitored_runs_without_a_deadline(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delattr(sys, "monitoring", raising=False)
    work: Callable[[], int] = lambda: 7  # noqa: E731
    assert deadline.run_within(1e-9, work) == 7
