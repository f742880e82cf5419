"""Compares parsing a long file with faults in its YAML with parsing it without.

Lines with a fault are hidden and the file is read again, so a fault may cost one more reading. An
editor parses at each key that is pressed.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

from measuring import Figure, Setting, main, shown, take_turns, timed

from yamaro.source import Source
from yamaro.syntax.parser import parse

PART = """\
- part:
    name: part_{i}
    joint:
      type: revolute
      parent: {parent}
      xyz: 0 0 $(length * {i})
      limit: {{lower: -1, upper: 1, effort: 10, velocity: 2}}  # rad, N m, rad/s
    mass: $(2 * length)
    visual:
      size: [1, 2, 3]
"""
FAULT = "size: [1, 2, 3"
FAULTS = 20
"""Faults in the worst file: behind more of them the rest of the file is hidden."""


def write_parts(lines: int, faults: int) -> str:
    """Return a robot of so many lines; in some of its last parts a bracket is open."""
    count = max(lines // PART.count("\n"), faults + 1)
    parts = [PART.format(i=i, parent=f"part_{i - 1}" if i else "base") for i in range(count)]
    for i in range(count - faults, count):
        parts[i] = parts[i].replace(f"{FAULT}]", FAULT)
    return f"variables: {{length: 0.3}}\nmodel:\n{''.join(parts)}"


def parse_again(text: str, faults: int) -> float:
    source = Source(text, name="robot.yaml")
    seconds = timed(lambda: parse(source))
    if len(parse(source).errors) != faults:
        sys.exit("the faults are not those that were made")
    return seconds


def measure(setting: Setting) -> Iterator[Figure]:
    lines = setting.sized(5_000, 300)
    texts = {faults: write_parts(lines, faults) for faults in (0, 1, FAULTS)}
    found = take_turns(
        {
            f"{faults} faults": lambda text=text, faults=faults: parse_again(text, faults)
            for faults, text in texts.items()
        },
        setting,
    )
    sound, one, many = found.values()
    work = f"{lines:,} lines with a fault"
    yield Figure(f"{work} / without", one / sound, " ×", shown(found), most=2)
    yield Figure(f"{work}, beyond that without", (one - sound) * 1e3, " ms", most=100)
    yield Figure(f"{lines:,} lines with {FAULTS} faults / without", many / sound, " ×")


if __name__ == "__main__":
    main(measure, __doc__)
