"""Feeds a target with random inputs, for a Python or a system that atheris is not made for.

python -m tests.fuzz.plain TARGET SECONDS SEED FOLDER
"""

from __future__ import annotations

import random
import sys
from pathlib import Path

from .session import Session
from .targets import TARGETS


def main(name: str, seconds: float, seed: int, folder: Path) -> None:
    target = TARGETS[name]
    rng = random.Random(seed)
    session = Session(target)
    mutator = target.mutator()
    while session.seconds() < seconds:
        session.feed(mutator.make(rng)[: target.longest])
    session.save(folder / "session.json")


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))
