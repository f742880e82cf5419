"""Compares compiling a long file without expressions with PyYAML's libyaml reading its events.

The file is like a robot that was brought over from URDF: 150,000 lines, 4.6 MB. Reading the events
is the least that any program has to do which reads YAML with PyYAML at its fastest.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import yaml
from measuring import YAMARO, Figure, Setting, main, run_in_turns, shown, take_turns, timed

import yamaro

LINK = """\
  link/name=link_{i}:
    inertial:
      origin/xyz=0.125 0.25 {x}, rpy=0 0 0:
      mass/value=1.5:
      inertia/ixx=0.0125, ixy=0, ixz=0, iyy=0.0125, iyz=0, izz=0.0125:
    visual:
      origin/xyz=0 0 0, rpy=0 1.5707 0:
      geometry:
        cylinder/radius=0.0525, length=0.2125:
      material/name=grey:
    collision:
      geometry:
        box/size=0.1 0.1 0.2:
"""
JOINT = """\
  joint/name=joint_{i}, type=revolute:
    parent/link=link_{parent}:
    child/link=link_{i}:
    origin/xyz=0 0 0.1, rpy=0 0 0:
    axis/xyz=0 0 1:
    limit/lower=-1.5, upper=1.5, effort=10, velocity=2:
"""
LINES_OF_A_LINK = LINK.count("\n") + JOINT.count("\n")
MATERIAL = """\
  material/name=grey:
    color/rgba=0.5 0.5 0.5 1:
"""

READ_EVENTS = """
import sys, yaml
with open(sys.argv[1], "rb") as file:
    for event in yaml.parse(file, Loader=yaml.CLoader):
        pass
"""


def write_flat(path: Path, lines: int) -> int:
    """Write a robot of so many lines, to within a link, and return the number of its links."""
    links = max(1, lines // LINES_OF_A_LINK)
    with path.open("w", encoding="utf-8") as file:
        file.write("robot: flat\nmodel:\n")
        for i in range(links):
            file.write(LINK.format(i=i, x=i / 10_000))
            if i:
                # Ten legs, so that the joints make no chain as long as the file.
                file.write(JOINT.format(i=i, parent=max(0, i - 10)))
        file.write(MATERIAL)
    return links


def read_events(path: Path) -> None:
    with path.open("rb") as file:
        for _ in yaml.parse(file, Loader=yaml.CLoader):
            pass


def measure(setting: Setting) -> Iterator[Figure]:
    lines = setting.sized(150_000, 100)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "flat.yaml")
        links = write_flat(path, lines)
        if yamaro.convert(path).count("<link ") != links:
            sys.exit("links are missing in what Yamaro writes")

        commands = {
            "yamaro": [*YAMARO, str(path)],
            "events": [sys.executable, "-c", READ_EVENTS, str(path)],
        }
        found = run_in_turns(commands, setting)
        ratio = found["yamaro"] / found["events"]
        work = f"{lines:,} flat lines / reading events"
        yield Figure(work, ratio, " ×", shown(found), most=4)

        works = {
            "yamaro": lambda: timed(lambda: yamaro.convert(path)),
            "events": lambda: timed(lambda: read_events(path)),
        }
        found = take_turns(works, setting)
        ratio = found["yamaro"] / found["events"]
        yield Figure("the same in one process", ratio, " ×", shown(found))


if __name__ == "__main__":
    main(measure, __doc__)
