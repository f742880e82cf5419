"""Makes the inputs in a folder the corpus of a target; of many, those that reach most.

python -m tests.fuzz.keep TARGET FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path

import coverage

from .corpus import to_text, write_corpus
from .replay import measure
from .session import Session
from .targets import TARGETS, Target

MOST = 300
"""Inputs in a corpus that is checked in."""
MOST_CHARACTERS = 200_000


def choose(candidates: list[str], target: Target) -> list[str]:
    """Return few inputs that reach what all reach, filled up with the shortest of the others."""
    session, measured = Session(target), measure()
    reached = {text: what_it_reaches(text, session, measured) for text in candidates}
    rest = {text: features for text, features in reached.items() if features}
    chosen: list[str] = []
    while rest and len(chosen) < MOST:
        best = max(rest, key=lambda text: (len(rest[text]), -len(text), text))
        new = rest.pop(best)
        chosen.append(best)
        rest = {text: left for text, features in rest.items() if (left := features - new)}
    size = sum(map(len, chosen))
    for text in sorted(set(candidates) - set(chosen), key=lambda text: (len(text), text)):
        size += len(text)
        if len(chosen) >= MOST or size > MOST_CHARACTERS:
            break
        chosen.append(text)
    return chosen


def what_it_reaches(text: str, session: Session, measured: coverage.Coverage) -> set[object]:
    """Return the steps from line to line that an input leads through, and what came of it."""
    measured.erase()
    measured.start()
    outcome = session.feed(text)
    measured.stop()
    data = measured.get_data()
    steps = {(path, step) for path in data.measured_files() for step in data.arcs(path) or ()}
    return {*steps, outcome} if outcome is not None else set()  # no fault is kept


def main(name: str, folder: Path) -> None:
    candidates = [to_text(path.read_bytes()) for path in folder.iterdir()]
    write_corpus(name, choose(candidates, TARGETS[name]))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
