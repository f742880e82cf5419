"""What the scripts of this folder share: they run things in turns, and show figures beside limits.

Times are told as ratios of medians. Whatever is compared takes turns in one run, so that what else
the machine does falls on all alike.
"""

from __future__ import annotations

import argparse
import compileall
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

import yamaro

BIN = Path(sys.executable).parent
YAMARO = [str(BIN / "yamaro")]
XACRO = [str(BIN / "xacro")]

# What people's machines have: modules compiled once, and kept.
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"
}

# A process counts the memory of the one that starts it until it runs, so a small one has to.
PEAK_OF = """
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
"""


class Setting(NamedTuple):
    """How large the work is and how often it is repeated; limits hold for a scale of 1."""

    scale: float = 1.0
    runs: int = 5

    def sized(self, count: int, least: int = 1) -> int:
        """Return a count at this scale."""
        return max(least, round(count * self.scale))


class Figure(NamedTuple):
    """One line of the result."""

    work: str
    value: float
    unit: str  # " ×" or " ms"
    detail: str = ""
    most: float | None = None
    least: float | None = None

    def is_met(self) -> bool:
        """Tell whether the value is within its limit."""
        is_low_enough = self.most is None or self.value <= self.most
        return is_low_enough and (self.least is None or self.value >= self.least)

    def limit(self) -> str:
        """Return the limit in words."""
        if self.most is not None:
            return f"≤ {self.most:g}{self.unit}"
        return "" if self.least is None else f"≥ {self.least:g}{self.unit}"

    def row(self, setting: Setting) -> str:
        """Return the line of the table."""
        limit = self.limit() if setting.scale == 1 else ""
        verdict = ("ok" if self.is_met() else "missed") if limit else ""
        value = f"{self.value:.{2 if self.value < 10 else 1}f}{self.unit}"
        return f"| {self.work:<44} | {value:>8} | {limit:<8} | {verdict:<6} | {self.detail} |"


HEADER = (
    f"| {'work':<44} | {'figure':>8} | {'limit':<8} |        | medians |\n|---|---:|---|---|---|"
)


def run(command: list[str], output: Path | str = os.devnull) -> float:
    """Return the seconds that a whole process takes, which writes to a file as people let it."""
    with open(output, "wb") as file:
        started = time.perf_counter()
        done = subprocess.run(command, stdout=file, stderr=subprocess.PIPE, env=ENVIRONMENT)
        seconds = time.perf_counter() - started
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr.decode()}")
    return seconds


def peak_memory(command: list[str]) -> int:
    """Return the most bytes of memory that a process has at any time."""
    wrapped = [sys.executable, "-c", PEAK_OF, *command]
    done = subprocess.run(wrapped, stdout=subprocess.PIPE, env=ENVIRONMENT, check=True)
    return int(done.stdout) * (1 if sys.platform == "darwin" else 1024)


def timed(work: Callable[[], object], clock: Callable[[], float] = time.perf_counter) -> float:
    """Return the seconds by a clock that work in this process takes."""
    started = clock()
    work()
    return clock() - started


def take_turns(works: Mapping[str, Callable[[], float]], setting: Setting) -> dict[str, float]:
    """Return the median seconds of each work; they take turns, after one turn to warm up."""
    for work in works.values():
        work()
    seconds: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(setting.runs):
        for name, work in works.items():
            seconds[name].append(work())
    return {name: statistics.median(found) for name, found in seconds.items()}


def run_in_turns(commands: Mapping[str, list[str]], setting: Setting) -> dict[str, float]:
    """Return the median seconds of each command, as a whole process."""
    return take_turns(
        {name: lambda command=command: run(command) for name, command in commands.items()},
        setting,
    )


def shown(medians: Mapping[str, float]) -> str:
    """Return medians in words."""
    return ", ".join(f"{name} {seconds * 1e3:,.1f} ms" for name, seconds in medians.items())


def main(measure: Callable[[Setting], Iterable[Figure]], description: str | None) -> None:
    """Run a script: read its options, measure, print the table; fail if a limit is missed."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--scale", type=float, default=1.0, help="how much of the work to do")
    parser.add_argument("--runs", type=int, default=5, help="runs of each (default: 5)")
    parser.add_argument("--rows", action="store_true", help="leave out the head of the table")
    options = parser.parse_args()
    setting = Setting(options.scale, options.runs)
    compileall.compile_dir(os.path.dirname(yamaro.__file__), quiet=1)
    if not options.rows:
        print(HEADER, flush=True)
    is_met = True
    for figure in measure(setting):
        print(figure.row(setting), flush=True)
        is_met = is_met and figure.is_met()
    if setting.scale == 1 and not is_met:
        sys.exit(1)
