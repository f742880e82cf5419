"""One run of a target: feeds it, counts what came of the inputs, and keeps those with a fault."""

from __future__ import annotations

import json
import os
import signal
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .targets import Target

SECONDS = 40
"""How long one input may take, on a busy machine, before it counts as a hang."""


class Hang(BaseException):
    """An input took too long; no `except Exception` may swallow this."""


@contextmanager
def no_hang() -> Iterator[None]:
    def ring(*_: object) -> None:
        raise Hang

    if not hasattr(signal, "SIGALRM"):
        yield
        return
    before = signal.signal(signal.SIGALRM, ring)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


class Session:
    """Feeds a target, and remembers.

    Attributes:
        counts: how many inputs ended in what.
        faults: for each place that raised what must not be: the shortest input, and what was said.
    """

    def __init__(self, target: Target) -> None:
        self.target = target
        self.counts = Counter[str]()
        self.faults: dict[str, tuple[str, str]] = {}
        self.start = time.monotonic()

    def feed(self, text: str) -> str | None:
        """Check a text; return what came of it, or None for a fault."""
        try:
            with no_hang(), warnings.catch_warnings():
                warnings.simplefilter("ignore")  # Python's, on the syntax of expressions
                outcome = self.target.check(text)
        except KeyboardInterrupt:
            raise
        except BaseException as error:
            self.add_fault(error, text)
            return None
        self.counts[outcome] += 1
        return outcome

    def add_fault(self, error: BaseException, text: str) -> None:
        place = place_of(error)
        if place not in self.faults or len(text) < len(self.faults[place][0]):
            self.faults[place] = (text, "".join(traceback.format_exception(error)))

    def seconds(self) -> float:
        return time.monotonic() - self.start

    def told(self) -> str:
        """Return every fault, with its input."""
        return "\n\n".join(
            f"=== {place}\n{trace}\ninput: {text!r}"
            for place, (text, trace) in sorted(self.faults.items())
        )

    def save(self, path: Path, **others: object) -> None:
        """Write what is known to a file."""
        found = {"counts": self.counts, "faults": self.faults, "seconds": self.seconds(), **others}
        path.with_suffix(".new").write_text(json.dumps(found))
        os.replace(path.with_suffix(".new"), path)


def place_of(error: BaseException) -> str:
    """Return the kind of an error and the line that raised it: one fault, one name."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if "yamaro" in frame.filename or "fuzz" in frame.filename]
    last = (own or frames)[-1]
    return f"{type(error).__name__} at {Path(last.filename).name}:{last.lineno}"
