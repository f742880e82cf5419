"""Measures a sweep of the quadruped without its models: rate, memory, and what a variant costs.

The rate is compared with that of one loop in one process, on all processors that there are. The
machine may have other work, so the time of the cores is compared too: what all processes of the
sweep take for a variant, beside what the loop takes. At a scale of 1 there are 10,000 variants;
`--scale 10` makes 100,000 of them.
"""

from __future__ import annotations

import os
import resource
import tempfile
import threading
import time
import warnings
from collections.abc import Iterator
from pathlib import Path

from measuring import Figure, Setting, main

import yamaro

QUADRUPED = Path(__file__).parent.parent / "examples" / "quadruped" / "quadruped.yaml"
AXES = {"thigh_length": [0.15, 0.35], "calf_length": [0.15, 0.35], "foot_radius": [0.015, 0.03]}
INTERVAL = 0.5
PAGE = os.sysconf("SC_PAGE_SIZE")


class Memory:
    """Looks at the memory of this process and those that it has started, now and then."""

    def __init__(self) -> None:
        self.sums: list[int] = []
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._look)

    def __enter__(self) -> Memory:
        self._thread.start()
        return self

    def __exit__(self, *error: object) -> None:
        self._is_over.set()
        self._thread.join()

    def at(self, part: float) -> float:
        """Return the largest sum up to a part of the time, in MB."""
        return max(self.sums[: max(1, round(len(self.sums) * part))]) / 1e6

    def _look(self) -> None:
        while not self._is_over.wait(INTERVAL):
            self.sums.append(sum(map(resident, [os.getpid(), *children(os.getpid())])))


def children(pid: int) -> list[int]:
    """Return the processes that a process has started."""
    found: list[int] = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += map(int, task.read_text().split())
        except OSError:
            continue
    return found


def resident(pid: int) -> int:
    """Return the bytes of memory of a process, without what it shares with others."""
    try:
        words = Path(f"/proc/{pid}/statm").read_text().split()
    except OSError:
        return 0
    return (int(words[1]) - int(words[2])) * PAGE


def cpu_seconds() -> float:
    """Return the time of the cores that this process and those that it has ended took."""
    return sum(
        used.ru_utime + used.ru_stime
        for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


def loop(count: int) -> tuple[float, float]:
    """Return seconds, and those of the core, that a variant takes in one loop in this process."""
    program = yamaro.load(QUADRUPED)
    program.convert(thigh_length=0.2)
    began, began_core = time.perf_counter(), time.process_time()
    for i in range(count):
        program.convert(
            thigh_length=0.15 + 0.2 * i / count, calf_length=0.35 - 0.2 * i / count,
            foot_radius=0.015 + 0.015 * i / count,
        )  # fmt: skip
    return (time.perf_counter() - began) / count, (time.process_time() - began_core) / count


def measure(setting: Setting) -> Iterator[Figure]:
    samples = setting.sized(10_000, 20)
    tried = max(10, samples // 100)
    cores = len(os.sched_getaffinity(0))
    before = loop(tried)
    with tempfile.TemporaryDirectory() as folder, Memory() as memory:
        began, began_core = time.perf_counter(), cpu_seconds()
        done = yamaro.sweep(QUADRUPED, folder, vary=AXES, samples=samples, method="latin")
        seconds, core = time.perf_counter() - began, cpu_seconds() - began_core
        size = sum(path.stat().st_size for path in Path(folder, "table").iterdir())
        counts = done.summary().counts
    assert counts["ok"] == samples, counts
    after = loop(tried)
    each, each_core = ((one + other) / 2 for one, other in zip(before, after, strict=True))
    rate, load = samples / seconds, os.getloadavg()[0]
    share = rate * each / cores
    detail = (
        f"{samples:,} in {seconds:,.0f} s, {rate:,.0f}/s; loop {1 / each:,.0f}/s; load {load:.1f}"
    )
    yield Figure(f"sweep on {cores} cores / cores × one loop", share, " ×", detail, least=0.8)
    detail = f"sweep {core / samples * 1e3:.2f} ms, loop {each_core * 1e3:.2f} ms"
    yield Figure("loop / sweep, time of the cores", each_core * samples / core, " ×", detail)
    detail = f"{memory.at(0.1):,.0f} MB, {memory.at(1):,.0f} MB in the end"
    growth = memory.at(1) / memory.at(0.1)
    yield Figure("memory at the end / after a tenth", growth, " ×", detail, most=1.3)
    yield Figure("table, for a variant", size / samples, " B")


if __name__ == "__main__":
    warnings.simplefilter("ignore", yamaro.YamaroWarning)
    main(measure, __doc__)
