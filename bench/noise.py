"""Counts what `yamaro check` finds in good robots of a corpus: how many are clean, the median.

A robot is good if `check_urdf` of urdfdom reads it without a word. Of these, the first 90 by the
SHA-256 of their paths are taken, and at most three of a repository, so that no family of robots
outweighs the others. Findings about files are not counted: a corpus has no meshes.
"""

from __future__ import annotations

import argparse
import hashlib
import subprocess
from collections import Counter
from pathlib import Path
from statistics import median

from verdicts import ROOT, robots

import yamaro

ROBOTS = 90
OF_A_REPOSITORY = 3
NOT_COUNTED = ("missing-mesh-file", "unknown-package", "hidden-package")


def is_good(path: Path) -> bool:
    """Return whether urdfdom reads a robot and has nothing to say of it."""
    run = subprocess.run(["check_urdf", str(path)], capture_output=True, text=True, check=False)
    said = (run.stdout + run.stderr).lower()
    return run.returncode == 0 and "error" not in said and "warning" not in said


def sample(corpus: Path) -> list[Path]:
    taken: list[Path] = []
    of_repository: Counter[str] = Counter()
    paths = {str(path.relative_to(corpus)): path for path in robots(corpus)}
    for name in sorted(paths, key=lambda name: hashlib.sha256(name.encode()).digest()):
        repository = name.split("/")[1]
        if of_repository[repository] < OF_A_REPOSITORY and is_good(paths[name]):
            of_repository[repository] += 1
            taken.append(paths[name])
        if len(taken) == ROBOTS:
            break
    return taken


def findings(path: Path) -> list[str]:
    """Return the codes of what `check` finds."""
    try:
        build = yamaro.build(path, advice=True, on_message=lambda line: None)
        found = build.warnings
    except yamaro.YamaroError as error:
        found = error.diagnostics
    return [each.code for each in found if each.code not in NOT_COUNTED]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--each", action="store_true", help="print what is found in each robot")
    wanted = parser.parse_args()
    counts, codes, in_robots = [], Counter[str](), Counter[str]()
    for path in sample(wanted.corpus):
        found = findings(path)
        counts.append(len(found))
        codes.update(found)
        in_robots.update(set(found))
        if wanted.each:
            print(f"{path.relative_to(wanted.corpus)}: {dict(Counter(found))}", flush=True)
    print(f"{len(counts)} robots: {counts.count(0)} clean, median {median(counts):g} findings")
    for code, count in codes.most_common():
        print(f"{count:5d} in {in_robots[code]:3d} robots  {code}")


if __name__ == "__main__":
    main()
