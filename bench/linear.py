"""Shows that ten times the work takes about ten times as long.

Each case is run small and ten times as large, as whole processes. A little more than ten times is
allowed: larger data fits less well in a processor's cache.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

from flat import write_flat
from legs import yamaro_command
from measuring import YAMARO, Figure, Setting, main, run_in_turns, shown

INCLUDES = """\
model:
  link/name=base:
  for:
    iterator: i
    range: {count}
    body:
      include:
        path: frame.yaml
        index: $(i)
"""

INCLUDED = """\
model:
  part:
    name: frame_$(index)
    joint: {type: fixed, parent: base, xyz: 0 0 $(index / 1000)}
"""

RECURSION = """\
functions:
  Segment:
    input: left, parent
    body:
      part:
        name: s$(left)
        joint: {{type: fixed, parent: $(parent), xyz: 0 0 $(left / 1000)}}
      if:
        condition: left > 1
        body:
          Segment: $(left - 1), s$(left)
model:
  link/name=base:
  Segment: {count}, base
"""

# What is read stands among the first, so that the work is the same however many there are.
VARIABLES = """\
variables:
{declarations}
functions:
  Frame:
    input: index
    body:
      part:
        name: frame_$(index)
        joint: {{type: fixed, parent: base, xyz: $(v0 + index) $(v1) $(v2 * v3)}}
model:
  link/name=base:
  for:
    iterator: i
    range: {frames}
    body:
      Frame: $(i)
"""


def includes(count: int, folder: Path) -> list[str]:
    (folder / "frame.yaml").write_text(INCLUDED)
    return compile_text(INCLUDES.format(count=count), folder / f"includes_{count}.yaml")


def recursion(count: int, folder: Path) -> list[str]:
    return compile_text(RECURSION.format(count=count), folder / f"recursion_{count}.yaml")


def flat_file(lines: int, folder: Path) -> list[str]:
    path = folder / f"flat_{lines}.yaml"
    write_flat(path, lines)
    return [*YAMARO, str(path)]


def variables(count: int, folder: Path, *, frames: int) -> list[str]:
    declarations = "\n".join(f"  v{i}: {i / 100}" for i in range(count))
    text = VARIABLES.format(declarations=declarations, frames=frames)
    return compile_text(text, folder / f"variables_{count}.yaml")


def compile_text(text: str, path: Path) -> list[str]:
    """Write a file, and return the command that compiles it."""
    path.write_text(text)
    return [*YAMARO, str(path)]


class Case(NamedTuple):
    """One kind of work, with the larger of its two sizes; the other is a tenth of that."""

    what: str
    size: int
    command: Callable[[int, Path], list[str]]
    most: float = 11


def cases(setting: Setting) -> list[Case]:
    frames = setting.sized(2_000)
    return [
        Case("legs", setting.sized(10_000, 10), lambda legs, _: yamaro_command(legs)),
        Case("includes of a small file", setting.sized(10_000, 10), includes),
        Case("levels of recursion", setting.sized(1_000, 10), recursion),
        Case("lines of a flat file", setting.sized(150_000, 1_000), flat_file),
        # The work does not grow, so only the declarations may cost.
        Case("variables in scope", 1_000, partial(variables, frames=frames), most=1.5),
    ]


def measure(setting: Setting) -> Iterator[Figure]:
    for case in cases(setting):
        small, large = case.size // 10, case.size
        with tempfile.TemporaryDirectory() as name:
            commands = {f"{size:,}": case.command(size, Path(name)) for size in (small, large)}
            found = run_in_turns(commands, setting)
        work = f"{large:,} / {small:,} {case.what}"
        ratio = found[f"{large:,}"] / found[f"{small:,}"]
        yield Figure(work, ratio, " ×", shown(found), most=case.most)


if __name__ == "__main__":
    main(measure, __doc__)
