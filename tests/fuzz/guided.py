"""Feeds a target with atheris, which keeps and changes what reaches something new.

    python -m tests.fuzz.guided TARGET SECONDS SEED FOLDER

What it finds goes to FOLDER/corpus, what it counted to FOLDER/session.json. Three in ten changes
are libFuzzer's, the others our own slips of the hand.
"""

from __future__ import annotations

import os
import random
import sys
from pathlib import Path

import atheris  # type: ignore

with atheris.instrument_imports(include=["yamaro"]):
    from .session import Session
    from .targets import TARGETS

from .corpus import to_bytes, to_text

SEEDS_IN_SECOND = 30
"""Seeds to begin a run with, for each second of it: else a short one did nothing but read them."""


def main(name: str, seconds: float, seed: int, folder: Path) -> None:
    target = TARGETS[name]
    session = Session(target)
    mutator = target.mutator()
    seeds, corpus = folder / "seeds", folder / "corpus"
    for path in (seeds, corpus):
        path.mkdir(parents=True, exist_ok=True)
    texts = target.seeds()
    if len(texts) > seconds * SEEDS_IN_SECOND:
        texts = random.Random(seed).sample(texts, int(seconds * SEEDS_IN_SECOND))
    for number, text in enumerate(texts):
        (seeds / str(number)).write_bytes(to_bytes(text))

    def feed(data: bytes) -> None:
        session.feed(to_text(data))
        if session.seconds() > seconds:
            session.save(folder / "session.json")
            sys.stderr.flush()
            os._exit(0)

    def change(data: bytes, longest: int, number: int) -> bytes:
        rng = random.Random(number)
        if rng.random() < 0.3:
            return bytes(atheris.Mutate(data, longest))
        return to_bytes(mutator.mutate(to_text(data), rng))[:longest]

    options = [f"-seed={seed}", f"-max_len={target.longest}", "-timeout=0", "-rss_limit_mb=4096"]
    options.append(f"-artifact_prefix={folder}/")  # inputs that take long
    atheris.Setup([sys.argv[0], *options, str(corpus), str(seeds)], feed, custom_mutator=change)
    atheris.Fuzz()


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))
