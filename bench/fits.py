"""Sums up what `yamaro fit` makes of whole robots, in a table.

    python bench/fits.py ROBOT.urdf ... [--words 'shape=best decompose=8']

For each robot and each of the words (options of `yamaro fit`, such as `shape=capsule`) there is a
line: how many meshes, each counted once, and how many shapes they get; the median and the greatest
distance between the surfaces, as a part of the mesh's size; the median excess of volume of the
meshes that are closed; and the seconds of the processor for all of them. The distances and volumes
are Yamaro's own; `bench/shapes.py` lets trimesh measure them.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

WORDS = "shape=best shape=capsule shape=hull decompose=8 spheres=24 triangles=2000"
ROW = re.compile(
    r"^(\S+)\s+(\S+)\s+(as it is|\d+ [a-z]+|[a-z]+)\s+([\d.]+) mm\s+([\d.]+) %\s+"
    r"(?:open|([+-][\d.]+) %)(?:\s+[\d.]+)?$",
    re.MULTILINE,
)


def summary(text: str) -> str:
    """Return cells of the table from what `yamaro fit` says of a robot."""
    rows = {row[1]: row for row in ROW.findall(text)}.values()
    shapes = sum(int(row[2].split()[0]) if row[2][0].isdigit() else 1 for row in rows)
    parts = [float(row[4]) for row in rows]
    volumes = [float(row[5]) for row in rows if row[5]]
    excess = f"{median(volumes):+.1f} % of {len(volumes)}" if volumes else "–"
    return (
        f"{len(rows)} | {shapes} | {median(parts):.1f} % | {max(parts):.1f} % | {excess}"
        if rows
        else "0 | | | |"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="+", type=Path)
    parser.add_argument("--words", default=WORDS)
    options = parser.parse_args()
    print("| robot | word | meshes | shapes | distance, median | greatest | volume | seconds |")
    print("|---|---|---|---|---|---|---|---|")
    for robot in options.robots:
        for word in options.words.split():
            with tempfile.TemporaryDirectory() as folder:
                target = str(Path(folder) / robot.name)
                begun = os.times()
                done = subprocess.run(
                    [sys.executable, "-m", "yamaro", "fit", str(robot), "-o", target, f"--{word}"],
                    capture_output=True,
                    text=True,
                    env={**os.environ, "YAMARO_CACHE": "off"},
                )
                ended = os.times()
                seconds = ended.children_user - begun.children_user
            if done.returncode:
                sys.exit(done.stderr)
            print(
                f"| {robot.stem} | `{word}` | {summary(done.stderr)} | {seconds:.0f} |", flush=True
            )


if __name__ == "__main__":
    main()
