"""Measures what `build(...).robot` costs next to the build, with all links and joints read.

The robots are that of bench/legs/ with many legs, the hexapod of the examples, and ten of the
corpus if it is there.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from time import process_time

from legs import FOLDER
from measuring import Figure, Setting, main, shown, timed

import yamaro

REPOSITORY = Path(__file__).parents[1]
CORPUS = REPOSITORY.parent / "shared" / "corpus"


def medians(path: Path, setting: Setting, **variables: object) -> dict[str, float]:
    """Return the median seconds of the processor for building a robot and for its model."""
    seconds: dict[str, list[float]] = {"build": [], "robot": []}
    for _ in range(setting.runs + 1):
        found: list[yamaro.Build] = []
        seconds["build"].append(timed(partial(build_into, found, path, variables), process_time))
        seconds["robot"].append(timed(partial(read_all, found[0]), process_time))
    return {name: sorted(each[1:])[setting.runs // 2] for name, each in seconds.items()}


def build_into(found: list[yamaro.Build], path: Path, variables: dict[str, object]) -> None:
    found.append(yamaro.build(path, variables=variables, on_message=lambda line: None))


def read_all(build: yamaro.Build) -> None:
    """Read the whole model: the rest of a link or joint is read when one value is used."""
    for link in build.robot.all_links:
        _ = link.visuals
    for joint in build.robot.all_joints:
        _ = joint.origin


def figure(work: str, found: dict[str, float], most: float | None) -> Figure:
    return Figure(
        f"{work}: model / build", found["robot"] / found["build"], " ×", shown(found), most
    )


def measure(setting: Setting) -> Iterator[Figure]:
    legs = setting.sized(1_000)
    yield figure(f"legs {legs:,}", medians(FOLDER / "legs.yaml", setting, n=legs), 0.3)
    hexapod = REPOSITORY / "examples" / "hexapod" / "hexapod.yaml"
    yield figure("hexapod", medians(hexapod, setting), 0.3)
    if not CORPUS.exists():
        return
    with (CORPUS / "urdf.tsv").open(encoding="utf-8", newline="") as file:
        paths = [row["path"] for row in csv.DictReader(file, delimiter="\t")]
    for path in paths[:: len(paths) // 10][:10]:
        yield figure(path.rpartition("/")[2], medians(CORPUS / "src" / path, setting), None)


if __name__ == "__main__":
    main(measure, __doc__)
