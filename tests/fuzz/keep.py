"""Makes the corpus of a target out of what libFuzzer's `-merge=1` found in folders of inputs.

    python -m tests.fuzz.keep TARGET CONTROL_FILE

The control file of a merge tells, for each input from the smallest on, what it reaches that those
before it do not: new places (COV), and places reached more often or in other company (FT).
"""

from __future__ import annotations

import sys
from pathlib import Path

from .corpus import to_text, write_corpus
from .session import Session
from .targets import TARGETS

MOST = 300
"""Inputs in a corpus that is checked in."""
MOST_CHARACTERS = 200_000


def choose(control: str) -> list[Path]:
    """Return the inputs that reach something new, those that reach most new places first."""
    lines = control.splitlines()
    paths = [Path(line) for line in lines[2 : 2 + int(lines[0])]]
    found = {"COV": [0] * len(paths), "FT": [0] * len(paths)}
    for line in lines[2 + len(paths) :]:
        kind, number, *features = line.split(" ")
        if kind in found:
            found[kind][int(number)] = len(features)
    worth = sorted(zip(found["COV"], found["FT"], paths, strict=True), reverse=True)
    return [path for places, features, path in worth if places or features]


def main(name: str, control: Path) -> None:
    session = Session(TARGETS[name])
    chosen: list[str] = []
    size = 0
    for path in choose(control.read_text()):
        text = to_text(path.read_bytes())
        if size + len(text) <= MOST_CHARACTERS and session.feed(text) is not None:
            chosen.append(text)
            size += len(text)
        if len(chosen) == MOST:
            break
    write_corpus(name, chosen)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
