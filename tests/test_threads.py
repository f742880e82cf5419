"""Hundreds of conversions come out the same from eight threads at once as one after the other."""

from __future__ import annotations

import gc
import os
import random
import sys
import threading
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import yamaro
from yamaro.sandbox import jail

THREADS = 8
ROUNDS = 4
JOBS_IN_ROUND = 100

EXAMPLES = Path(__file__).parents[1] / "examples"

# Two robots with the same names for all they have, and other things behind them.
WALKER = """
import: own
robot: walker
variables: {total/global: 0}
functions:
  Leg:
    input: [side, length]
    body:
      process: |
        total += length
        own.seen.append(side)
        angle = own.turn(length, len(own.seen))
        print("leg", side, round(angle, 6))
      part:
        name: leg_$(side)
        joint:
          parent: base
          xyz: $([length, 0, angle])
          type: revolute
          limit: {lower: -1, upper: 1, effort: 2, velocity: 3}
        link:
          geometry: cylinder
          scale: $(length / 10) $(length)
          mass: $(length * 2)
          visual:
          collision:
model:
  link/name=base:
  for:
    iterator: i
    range: $(2 + n % 5)
    body:
      Leg: {side: $(i), length: $(0.1 + n / 100)}
  include: {path: ../shared/head.yaml, n: $(n), later: '$(lambda x: x * n)'}
  note/total=$(total), seen=$(len(own.seen)), name=$(own.name()):
"""
OWN = """
import math
import sys
from dataclasses import dataclass, field

NAME = "{name}"
seen = []

@dataclass
class Angle:
    value: float
    history: list = field(default_factory=list)

def turn(length, count):
    return Angle(math.atan2(length, count)).value

def name():  # as pickle and others come to a module
    return sys.modules[Angle.__module__].NAME

def fail(n):
    return [n, {{"a": 1}}[n]]
"""
HEAD = """
import: own
variables: {count: $(n % 3 + 1)}
model:
  for:
    iterator: k
    range: count
    body:
      eye/number=$(k), of=$(later(k)), by=$(own.name()):
  print: head $(n) of $(own.name())
  old: ${unused}
"""

# One of many faults, below a function in a loop in a function, in an included file.
FAULTY = """
robot: faulty
model:
  link/name=base:
  print: before $(n)
  process: found = [n]
  include: {path: shared/faults.yaml, n: $(n)}
"""
FAULTS = """
import: own
functions:
  Inner:
    input: how
    body:
      process: |
        if how == 0:
            1 / (how - n + n)
        elif how == 1:
            own.fail(n)
      if: {condition: how == 2, body: {a: $(nowhere + n)}}
      elif: {condition: how == 3, body: {include: hand.yaml}}
      elif: {condition: how == 4, body: {'$(f"bad name {n}")': }}
      elif: {condition: how == 5, body: {Outer: {what: $(how)}}}
      elif: {condition: how == 6, body: {a: '$(load_yaml("own.py"))'}}
      elif: {condition: how == 7, body: {part: {name: p, lnik: $(n), joint: {type: hinge}}}}
      else: {a/b=$(how): $(n)}
  Outer:
    input: how
    body:
      for: {iterator: j, range: 3, body: {Inner: $(how)}}
model:
  Outer: $(n % 9)
"""
DEEP = """
functions:
  Deep:
    input: k
    body: {if: {condition: k, body: {Deep: $(k - 1)}}, else: {v: $(n)}}
out: {Deep: $(250 + n)}
"""
# What files that are not trusted may do, and what each conversion has limits for.
SAFE = """
import: math
variables: {total/global: 0, table: "$({k: k * n for k in range(n)})"}
functions:
  Row:
    input: [k]
    body:
      process: total += math.floor(k * n / 2)
      print: row $(k) of $(n)
      row/k=$(k), total=$(total), text=$("x" * (k + n)): $(sorted(table.values())[:k])
out:
  for: {iterator: k, range: $(1 + n % 6), body: {Row: {k: $(k)}}}
  if: {condition: n % 4 == 0, body: {a: '$(len([0] * (n * 100_000)))'}}
"""
UNREADABLE = "out:\n  a: $(1 +)\n  b: [1, 2\n"
MALFORMED = "out:\n  a: $(1 +)\n  b: ${old}\n  for: {iteratr: i, range: 3, body: {c: }}\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("robots")
    for name in ("alpha", "beta", "shared"):
        (folder / name).mkdir()
        (folder / name / "own.py").write_text(OWN.format(name=name))
    for name in ("alpha", "beta"):
        (folder / name / "robot.yaml").write_text(WALKER)
    (folder / "shared" / "head.yaml").write_text(HEAD)
    (folder / "shared" / "faults.yaml").write_text(FAULTS)
    for name, text in (
        ("faulty", FAULTY),
        ("deep", DEEP),
        ("safe", SAFE),
        ("unreadable", UNREADABLE),
        ("malformed", MALFORMED),
    ):
        (folder / f"{name}.yaml").write_text(text)
    return folder


class Job:
    """A file to convert, with a variable, in one of several ways."""

    def __init__(self, path: str, n: int | None, way: str) -> None:
        self.path = path
        self.way = way
        self.variables: dict[str, Any] = {} if n is None else {"n": n}
        self.policy = yamaro.Policy("safe" if path.endswith("safe.yaml") else "trusted")

    def program(self) -> yamaro.Program:
        """Return a program of the file, of which nothing is read yet."""
        return yamaro.Program(self.path, policy=self.policy)

    def outcome(self, program: yamaro.Program) -> tuple[object, ...]:
        """Return all that can be seen of a conversion.

        Args:
            program: of the job's file, for the ways that take one.
        """
        messages: list[str] = []
        convert: Callable[..., yamaro.Build]
        given: dict[str, Any]
        try:
            if self.way == "convert":
                return yamaro.convert(self.path, **self.variables), [], []
            if self.way == "program.convert":
                return program.convert(**self.variables), [], []
            if self.way.startswith("program"):
                convert, given = program.build, {"variables": self.variables}
            else:
                words = [f"{name}:={value}" for name, value in self.variables.items()]
                convert, given = partial(yamaro.build, self.path), {"command_line": words}
                given["policy"] = self.policy
            strict = self.way.endswith("strict")
            build = convert(**given, on_message=messages.append, strict=strict)
            told = [str(yamaro.YamaroError([warning])) for warning in build.warnings]
            return build.xml(), [*told, *build.files, *build.meshes], messages
        except yamaro.YamaroError as error:
            return "failed", str(error), messages


def jobs(folder: Path) -> list[Job]:
    """Return the jobs, with files, variables and ways mixed."""
    random_choice = random.Random(4).choice
    talking = ["alpha/robot.yaml", "beta/robot.yaml"]
    silent = [f"{name}.yaml" for name in ("faulty", "deep", "safe") * 4]
    silent += ["unreadable.yaml", "malformed.yaml"]
    examples = [str(EXAMPLES / name / f"{name}.yaml") for name in ("arm", "hexapod", "world")]
    result = []
    for number in range(ROUNDS * JOBS_IN_ROUND):
        path = random_choice(talking * 6 + silent + examples)
        if path in talking:  # which print, and warn
            way = random_choice(["build", "strict", "program.build", "program.strict"])
        elif path in examples:
            way = random_choice(["build", "program.build", "convert", "program.convert"])
        elif path in ("faulty.yaml", "safe.yaml"):  # which print
            way = random_choice(["build", "program.build"])
        else:
            way = random_choice(["build", "program.build", "convert", "program.convert"])
        n = None if path in examples else number % 97
        result.append(Job(str(folder / path), n, way))
    return result


def programs(jobs: list[Job]) -> dict[str, yamaro.Program]:
    """Return a program for each file, of which nothing is read yet."""
    return {job.path: job.program() for job in jobs}


def state() -> tuple[object, ...]:
    """Return what is the whole process's, and no conversion's."""
    modules = sorted(name for name in sys.modules if name == "own" or name.startswith("_yamaro"))
    return sys.getrecursionlimit(), gc.get_threshold(), gc.isenabled(), os.getcwd(), modules


def in_sequence(jobs: list[Job]) -> list[tuple[object, ...]]:
    known = programs(jobs)
    return [job.outcome(known[job.path]) for job in jobs]


def at_once(jobs: list[Job]) -> list[tuple[object, ...]]:
    """Return the outcomes of jobs that threads take one by one from a heap, all at once."""
    outcomes: list[tuple[object, ...]] = [()] * len(jobs)
    known = programs(jobs)
    pending = list(enumerate(jobs))
    together = threading.Barrier(THREADS)

    def work() -> None:
        together.wait()
        while pending:
            try:
                number, job = pending.pop()
            except IndexError:  # another took the last
                return
            outcomes[number] = job.outcome(known[job.path])

    threads = [threading.Thread(target=work) for _ in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return outcomes


@pytest.fixture(scope="module", autouse=True)
def _threads_alone() -> Iterator[None]:
    """Convert in the threads themselves what would be converted in processes of their own.

    And keep a tool that measures coverage out: what is traced does without the deep stack.
    """
    trace, trace_of_threads = sys.gettrace(), threading.gettrace()
    sys.settrace(None)
    threading.settrace(None)  # type: ignore[arg-type]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(jail, "check_available", lambda: "it is not wanted")
        yield
    threading.settrace(trace_of_threads)  # type: ignore[arg-type]
    sys.settrace(trace)


@pytest.fixture(scope="module")
def all_jobs(folder: Path) -> list[Job]:
    return jobs(folder)


@pytest.fixture(scope="module")
def expected(all_jobs: list[Job]) -> list[tuple[object, ...]]:
    """Return what each job gives from files that are read anew."""
    return [job.outcome(job.program()) for job in all_jobs]


@pytest.mark.slow
def test_the_jobs_are_of_many_kinds(
    all_jobs: list[Job], expected: list[tuple[object, ...]]
) -> None:
    count = len(all_jobs)
    assert len({repr(outcome) for outcome in expected}) > 0.3 * count
    failures = [str(outcome[1]) for outcome in expected if outcome[0] == "failed"]
    assert sum(bool(outcome[2]) for outcome in expected) > 0.3 * count  # that print
    assert len({failure.partition(":")[0] for failure in failures}) > 8
    assert 0.2 * count < len(failures) < 0.6 * count
    assert any("limit-sequence" in failure for failure in failures)  # as untrusted files have them


@pytest.fixture
def frequent_switches() -> Iterator[None]:
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(before)


def compare(
    run: Callable[[list[Job]], list[tuple[object, ...]]],
    jobs: list[Job],
    expected: list[tuple[object, ...]],
) -> None:
    """Run all jobs, in rounds, each of which reads its files anew."""
    before = state()
    for start in range(0, len(jobs), JOBS_IN_ROUND):
        some = slice(start, start + JOBS_IN_ROUND)
        for job, outcome, wanted in zip(jobs[some], run(jobs[some]), expected[some], strict=True):
            assert outcome == wanted, (job.path, job.way, job.variables)
    assert state() == before


@pytest.mark.slow
def test_eight_threads_give_what_one_gives(
    all_jobs: list[Job], expected: list[tuple[object, ...]]
) -> None:
    compare(at_once, all_jobs, expected)


@pytest.mark.slow
@pytest.mark.usefixtures("frequent_switches")
def test_threads_that_switch_a_hundred_times_as_often_give_the_same(
    all_jobs: list[Job], expected: list[tuple[object, ...]]
) -> None:
    compare(at_once, all_jobs[:200], expected[:200])


@pytest.mark.slow
def test_one_after_the_other_they_give_the_same_again(
    all_jobs: list[Job], expected: list[tuple[object, ...]]
) -> None:
    compare(in_sequence, all_jobs, expected)
