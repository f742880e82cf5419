"""Runs the tests on mutants: pytest collects once, and each mutant gets a fork of that process.

A first fork runs all tests without a mutant, and coverage.py tells which test ran which line. So
a mutant has to stand only the tests that ran the changed lines: those first that found the last
mutants of the same function, then the fast ones. The first that fails kills it, and so does one
that takes far longer than it did, or that kills the process.
"""

from __future__ import annotations

import gc
import json
import os
import random
import resource
import select
import signal
import struct
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from _pytest.runner import runtestprotocol
from _pytest.warnings import catch_warnings_for_item

from tests.mutation.mutants import Mutant, make_mutants, path_of

MEMORY = 6 << 30
CASES = "tests/test_cases.py::"
MOST_CASES = 400
"""Of the golden cases that run a line, so many are tried, drawn by chance."""
NUMBER = struct.Struct("<i")
ALL_PASSED = -1
NOT_APPLIED = -2
EXAMPLES = 12
"""How many examples a property test may take."""


class Timing:
    """How long tests may take.

    Attributes:
        longest: Tests that take longer, in seconds, are left out.
        factor, constant: A test that takes so many times and so many seconds longer is ended.
        file: So long may all tests of a file take, without a mutant.
    """

    longest = 0.6
    factor = 8.0
    constant = 2.0
    file = 1200.0


class Verdict:
    """What came of one mutant."""

    def __init__(self, mutant: Mutant, by: str | None, seconds: float, tests: int) -> None:
        self.mutant = mutant
        self.by = by
        """The test that killed it; empty: it survived; None: it could not be tried."""
        self.seconds = seconds
        self.tests = tests


class Baseline:
    """What the tests do without a mutant."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._lines: dict[str, dict[int, list[str]]] = {}

    def add(self, seconds: dict[str, float], lines: dict[str, dict[str, list[str]]]) -> None:
        """Add what the tests of a file do."""
        self.seconds |= seconds
        for module, of_module in lines.items():
            own = self._lines.setdefault(module, {})
            for line, tests in of_module.items():
                own.setdefault(int(line), []).extend(tests)

    def tests_of(self, mutant: Mutant) -> list[str]:
        """Return the tests that run one of the lines of a mutant, the fast ones first.

        And those in the test file of its module, which may run them where coverage.py cannot see.
        """
        lines = self._lines.get(mutant.module, {})
        found = {test for line in mutant.lines for test in lines.get(line, ())}
        own = f"/test_{mutant.module.rpartition('/')[2]}.py::"
        found.update(test for test in self.seconds if own in test)
        found &= self.seconds.keys()
        cases = sorted(test for test in found if test.startswith(CASES))
        if len(cases) > MOST_CASES:
            found.difference_update(cases)
            found.update(random.Random(mutant.change).sample(cases, MOST_CASES))
        return sorted(found, key=lambda test: self.seconds[test])


class MutationRun:
    """A plugin of pytest that, in place of running the tests, runs them on mutants."""

    def __init__(
        self,
        modules: list[str],
        choose: Callable[[list[Mutant]], list[Mutant]],
        tell: Callable[[str, int, list[Verdict], float], None],
        store: Path | None,
    ) -> None:
        """Take what to do.

        Args:
            modules: whose mutants are tried.
            choose: returns those to try, of all mutants of a module.
            tell: is told the verdicts of each module.
            store: a file that keeps which test runs which line from one run to the next.
        """
        self._modules = modules
        self._choose = choose
        self._tell = tell
        self._store = store
        self._items: dict[str, Any] = {}
        self._killers: dict[str, list[str]] = {}

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self._items = {item.nodeid: item for item in session.items}
        _lighten(session)
        baseline = self._baseline()
        gc.collect()
        gc.freeze()
        for module in self._modules:
            mutants = make_mutants(module)
            chosen = self._choose(mutants)
            began = time.monotonic()
            verdicts = [self._judge(mutant, baseline) for mutant in chosen]
            self._tell(module, len(mutants), verdicts, time.monotonic() - began)
        return True

    # --- without a mutant -----------------------------------------------------------------------

    def _baseline(self) -> Baseline:
        """Run all tests without a mutant, each file in a fork, unless the store tells of it."""
        files: dict[str, list[str]] = {}
        for name in self._items:
            files.setdefault(name.partition("::")[0], []).append(name)
        baseline = Baseline()
        known: dict[str, Any] = {}
        if self._store is not None and self._store.exists():
            known = json.loads(self._store.read_text())
        for file, names in files.items():
            of = {"names": names, "modules": self._modules}
            if {**known.get(file, {}), **of} != known.get(file):
                known[file] = {**of, **self._measure(file, names)}
            baseline.add(known[file]["seconds"], known[file]["lines"])
        if self._store is not None:
            self._store.write_text(json.dumps(known))
        return baseline

    def _measure(self, file: str, names: list[str]) -> dict[str, Any]:
        """Return how long the tests of a file take, and which lines they run."""
        try:
            seconds = _in_fork(lambda: self._run_plainly(names))
            return {
                "seconds": seconds,
                "lines": _in_fork(lambda: self._run_with_coverage(list(seconds))),
            }
        except TimeoutError:
            print(f"left out, for it takes too long: {file}", file=sys.stderr)
            return {"seconds": {}, "lines": {}}

    def _run_with_coverage(self, names: list[str]) -> dict[str, dict[int, list[str]]]:
        from coverage import Coverage

        files = {module: str(path_of(module)) for module in self._modules}
        coverage = Coverage(data_file=None, config_file=False, include=list(files.values()))
        coverage.set_option("run:disable_warnings", ["no-data-collected"])
        coverage.start()
        for index, name in enumerate(names):
            coverage.switch_context(str(index))
            self._passes(name, None)
        coverage.stop()
        data = coverage.get_data()
        lines: dict[str, dict[int, list[str]]] = {}
        for module, file in files.items():
            contexts = data.contexts_by_lineno(file)
            lines[module] = {
                line: [names[int(context)] for context in found if context]
                for line, found in contexts.items()
            }
        return lines

    def _run_plainly(self, names: list[str]) -> dict[str, float]:
        seconds = {}
        for name in names:
            began = time.process_time()
            is_good = self._passes(name, None)
            taken = time.process_time() - began
            if not is_good:
                print(f"left out, for it fails without a mutant: {name}", file=sys.stderr)
            elif taken > Timing.longest:
                print(f"left out, for it takes {taken:.1f} s: {name}", file=sys.stderr)
            else:
                seconds[name] = taken
        return seconds

    def _passes(self, name: str, following: str | None) -> bool:
        item = self._items[name]
        next_item = self._items[following] if following else None
        with catch_warnings_for_item(item.config, item.ihook, "runtest", item):
            reports = runtestprotocol(item, log=False, nextitem=next_item)
        return all(report.outcome != "failed" for report in reports)

    # --- with one -------------------------------------------------------------------------------

    def _judge(self, mutant: Mutant, baseline: Baseline) -> Verdict:
        began = time.monotonic()
        tests = baseline.tests_of(mutant)
        killers = self._killers.setdefault(mutant.function, [])
        first = [test for test in killers if test in tests]
        tests = first + [test for test in tests if test not in first]
        by = self._run_in_fork(mutant, tests, baseline.seconds)
        if by is not None and by in tests:
            if by in killers:
                killers.remove(by)
            killers.insert(0, by)
            del killers[20:]
        return Verdict(mutant, by, time.monotonic() - began, len(tests))

    def _run_in_fork(
        self, mutant: Mutant, tests: list[str], seconds: dict[str, float]
    ) -> str | None:
        """Return which test fails with a mutant; None if it could not be tried."""
        if not tests:
            return ""
        reading, writing = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(reading)
            self._be_mutant(mutant, tests, writing)
        os.close(writing)
        try:
            return self._watch(child, reading, tests, seconds)
        finally:
            os.close(reading)

    def _be_mutant(self, mutant: Mutant, tests: list[str], writing: int) -> None:
        """Run tests until one fails; say before each which it is."""
        status = 1
        try:
            os.setpgid(0, 0)
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            _silence()
            try:
                mutant.apply()
            except ValueError:
                os.write(writing, NUMBER.pack(NOT_APPLIED))
                return
            for index, test in enumerate(tests):
                os.write(writing, NUMBER.pack(index))
                following = tests[index + 1] if index + 1 < len(tests) else None
                if not self._passes(test, following):
                    break
            else:
                os.write(writing, NUMBER.pack(ALL_PASSED))
                status = 0
        except BaseException:
            pass
        finally:
            os._exit(status)

    def _watch(
        self, child: int, reading: int, tests: list[str], seconds: dict[str, float]
    ) -> str | None:
        running = 0
        by: str | None
        while True:
            allowed = Timing.constant + Timing.factor * seconds[tests[running]]
            if not select.select([reading], [], [], allowed)[0]:
                by = f"time-out in {tests[running]}"
                break
            said = os.read(reading, NUMBER.size)
            if not said:
                by = tests[running]
                break
            (running,) = NUMBER.unpack(said)
            if running in (ALL_PASSED, NOT_APPLIED):
                by = "" if running == ALL_PASSED else None
                break
        _end(child)
        return by


def _end(child: int) -> None:
    """End a process, and all that it has started."""
    for end in (os.killpg, os.kill):
        try:
            end(child, signal.SIGKILL)
        except ProcessLookupError:
            pass
    os.waitpid(child, 0)


def _in_fork(work: Any) -> Any:
    """Return what a function returns in a fork of this process."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            os.setpgid(0, 0)
            os.close(reading)
            text = json.dumps(work())
            with os.fdopen(writing, "w") as pipe:
                pipe.write(text)
            status = 0
        except BaseException as error:
            print(f"{type(error).__name__} without a mutant: {error}", file=sys.stderr)
        finally:
            os._exit(status)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        is_there = select.select([pipe], [], [], Timing.file)[0]
        text = pipe.read() if is_there else ""
    _end(child)
    if not text:
        raise TimeoutError
    return json.loads(text)


def _silence() -> None:
    nowhere = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):
        os.dup2(nowhere, descriptor)


def _lighten(session: pytest.Session) -> None:
    """Let properties take few examples, cases run once, and what is safe run in this process."""
    from hypothesis import settings

    items: list[Any] = list(session.items)
    for item in items:
        inner: Any = getattr(item.obj, "__func__", item.obj)
        given = getattr(inner, "_hypothesis_internal_use_settings", None)
        if given is not None and given.max_examples > EXAMPLES:
            inner._hypothesis_internal_use_settings = settings(given, max_examples=EXAMPLES)
        if item.module.__name__.endswith("safe.test_code"):
            _attack_here(item.module)
    _run_cases_once(items)
    _run_safe_files_here()


def _run_cases_once(items: list[Any]) -> None:
    """Let what compiles a golden case again repeat what came out at first."""
    item = next(item for item in items if "compile_case" in item.fixturenames)
    definition = item._fixtureinfo.name2fixturedefs["compile_case"][-1]
    make = definition.func

    def compile_case(monkeypatch: Any, capsys: Any) -> Any:
        compile_really = make(monkeypatch, capsys)
        results: dict[object, Any] = {}

        def compile_once(case: Path, options: dict[str, str]) -> Any:
            key = (case, *options.items())
            if key not in results:
                results[key] = compile_really(case, options)
            return results[key]

        return compile_once

    definition.func = compile_case


def _run_safe_files_here() -> None:
    """Let safe mode do without the jail, where no mutant would be noticed."""
    from yamaro import confined
    from yamaro.policy import JAIL

    has_jail = confined.has_jail
    confined.has_jail = lambda policy, name: policy.mode == JAIL and has_jail(policy, name)


def _attack_here(module: ModuleType) -> None:
    from tests.hostile import escape_runner

    def attack(self: Any, payload: Any) -> dict[str, Any]:
        os.environ["SECRET"] = escape_runner.SECRET
        asked = payload._asdict()
        result = escape_runner.attack(asked["mode"], asked["text"], asked["steps"])
        return json.loads(json.dumps(result))  # type: ignore[no-any-return]

    module.Runner.attack = attack  # type: ignore[attr-defined]
