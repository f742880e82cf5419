"""Kills the processes of sweeps at random moments, lets them go on, and compares the tables.

Each sweep is run by a process, with two workers that have a process each. One of these processes,
or the one that runs the sweep, is killed; after that the sweep goes on with `resume`. In the end
its table has to be that of a sweep that nobody disturbed, byte for byte. The robot writes down each
of its builds, which shows that no variant is built twice except for those that a kill has cut off:
the chunks at work when the sweep is killed, or the one variant at which a worker is. With dask
that is the chunk of the worker.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from sweeps import children

ROBOT = """
robot: logged
import: [os]
arguments:
  width: {default: 0.2, range: [0.1, 0.4]}
  legs: {default: 4, choices: [4, 6, 8]}
  log: {type: text, default: ""}
model:
- part:
    name: base
    link: {geometry: box, scale: $(width) 0.2 0.1, mass: 2, visual: , collision: }
- for i in range(legs * 4):
  - part:
      name: leg$(i)
      joint: {type: fixed, parent: base, xyz: $(width / 2) $(0.1 * i) 0}
      link: {geometry: cylinder, scale: 0.02 $(width), mass: 0.2, visual: , collision: }
- process: |
    if log:
        file = os.open(log, os.O_WRONLY | os.O_APPEND | os.O_CREAT)
        os.write(file, f"{width!r} {legs}\\n".encode())
        os.close(file)
"""
RUN = """
import sys, yamaro
yamaro.sweep(sys.argv[1], sys.argv[2], vary={"width": None, "legs": None},
             fixed={"log": sys.argv[3]}, samples=int(sys.argv[4]), seed=int(sys.argv[5]),
             chunk=int(sys.argv[6]), engine=sys.argv[7], resume=True)
"""
CHUNK = 25
PATIENCE = 300


class Trial:
    """A sweep that is killed again and again."""

    def __init__(
        self, folder: Path, samples: int, seed: int, engine: str, chance: random.Random
    ) -> None:
        self.runs = folder / "runs"
        self.log = folder / "log"
        self.robot = folder / "robot.yaml"
        self.robot.write_text(ROBOT, encoding="utf-8")
        self.samples = samples
        self.seed = seed
        self.engine = engine
        self._pause, self._share = (1.2, 0.6) if engine.startswith("local") else (8.0, 0.8)
        self.kills = Counter[str]()
        self._chance = chance

    def start(self, log: str, folder: Path) -> subprocess.Popen[bytes]:
        words = [str(self.robot), str(folder), log]
        numbers = map(str, (self.samples, self.seed, CHUNK))
        command = [sys.executable, "-c", RUN, *words, *numbers, self.engine]
        return subprocess.Popen(command)

    def run(self, most: int) -> None:
        """Run the sweep to its end, with at most so many kills."""
        while True:
            built = len(self._logged())
            done = self._done()
            process = self.start(str(self.log), self.runs)
            workers = self._disturb(process, most)
            self._check(self._logged()[built:], done, workers)
            if process.returncode == 0:
                return
            assert process.returncode == -signal.SIGKILL, process.returncode
            self._wait_for_orphans()

    def _disturb(self, process: subprocess.Popen[bytes], most: int) -> int:
        """Kill until the process has ended; return how many workers were killed."""
        workers = 0
        while True:
            try:
                process.wait(self._chance.uniform(0.05, self._pause))
                return workers
            except subprocess.TimeoutExpired:
                if self.kills.total() >= most:
                    process.wait(PATIENCE)
                    return workers
            inner = descendants(process.pid)
            if inner and self._chance.random() < self._share:
                if kill(self._chance.choice(inner)):
                    workers += 1
                    self.kills["workers"] += 1
            elif kill(process.pid):
                self.kills["sweeps"] += 1
                process.wait()
                return workers

    def _check(self, built: list[str], done: set[int], workers: int) -> None:
        """Check what one run has built: nothing of what was done before, hardly anything twice."""
        again = {self._number(each) // CHUNK for each in built} & done
        assert not again, f"chunks that were done are built again: {again}"
        twice = sum(count - 1 for count in Counter(built).values())
        most = workers if self.engine.startswith("local") else workers * CHUNK
        assert twice <= most, f"{twice} variants are built twice, with {workers} workers killed"

    def _number(self, line: str) -> int:
        """Return which variant has written a line."""
        if not hasattr(self, "_numbers"):
            import yamaro

            columns = yamaro.Sweep(self.runs.parent / "undisturbed").columns("width", "legs")
            rows = zip(columns["id"], columns["width"], columns["legs"], strict=True)
            self._numbers = {f"{width!r} {legs}": number for number, width, legs in rows}
        return self._numbers[line]

    def _logged(self) -> list[str]:
        return self.log.read_text().splitlines() if self.log.exists() else []

    def _done(self) -> set[int]:
        return {int(path.stem[5:]) for path in self.runs.glob("table/part-*.parquet")}

    def _wait_for_orphans(self) -> None:
        """Wait until the processes of a killed sweep have ended, as they do at once."""
        until = time.monotonic() + PATIENCE
        while self._is_held():
            assert time.monotonic() < until, "a process of a killed sweep goes on"
            time.sleep(0.01)

    def _is_held(self) -> bool:
        """Return whether a process goes on that builds variants for a sweep that is killed."""
        for path in Path("/proc").glob("[0-9]*"):
            try:
                words = (path / "cmdline").read_bytes()
                environment = (path / "environ").read_bytes()
            except OSError:
                continue
            is_ours = str(self.robot.parent).encode() in environment
            if b"yamaro.tools.sweep.worker" in words and is_ours:
                return True
        return False

    def tables(self, folder: Path) -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in sorted(folder.glob("table/*"))}


def descendants(pid: int) -> list[int]:
    """Return the processes that a process has started, and those that these have."""
    return [each for child in children(pid) for each in (child, *descendants(child))]


def kill(pid: int) -> bool:
    """Kill a process; return whether it was there."""
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=50, help="how many kills (default: 50)")
    parser.add_argument("--samples", type=int, default=2000, help="variants of a sweep")
    parser.add_argument("--seed", type=int, default=0, help="which moments are chosen")
    parser.add_argument("--engine", default="local:2", help="local:2 (the default) or dask:2")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    kills = Counter[str]()
    sweeps = 0
    began = time.monotonic()
    while kills.total() < options.kills:
        with tempfile.TemporaryDirectory() as name:
            os.environ["YAMARO_BENCH_FOLDER"] = name
            trial = Trial(Path(name), options.samples, sweeps, options.engine, chance)
            undisturbed = Path(name, "undisturbed")
            assert trial.start("", undisturbed).wait(PATIENCE) == 0
            trial.run(options.kills - kills.total())
            wanted, found = trial.tables(undisturbed), trial.tables(trial.runs)
            assert wanted == found, "the tables differ"
            assert not list(Path(name).rglob("*.tmp")), "files are left that were not written whole"
            kills += trial.kills
            sweeps += 1
    what = f"{kills['sweeps']} sweeps and {kills['workers']} workers killed"
    seconds = time.monotonic() - began
    what = f"{options.engine}: {what}"
    print(f"{what}, in {sweeps} sweeps of {options.samples:,} variants: all tables are equal")
    print(f"{seconds:.0f} s, load {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
