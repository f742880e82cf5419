"""Feeds a target what it begins with, and measures which branches of its modules that reaches.

    python -m tests.fuzz.replay TARGET REPORT

Nothing is imported from yamaro before coverage.py looks. The report is coverage.py's JSON, with
what came of the inputs.
"""

from __future__ import annotations

import importlib.util
import json
import sys
from pathlib import Path

import coverage

PACKAGE = Path(str(importlib.util.find_spec("yamaro").origin)).parent  # type: ignore[union-attr]


def measure() -> coverage.Coverage:
    """Return what measures the branches of the compiler, and nothing else."""
    measured = coverage.Coverage(
        branch=True, config_file=False, data_file=None, include=[f"{PACKAGE}/*"]
    )
    for words in ("if TYPE_CHECKING:", "raise AssertionError", "pragma: no cover"):
        measured.exclude(words)
    return measured


def main(name: str, report: Path) -> None:
    measured = measure()
    measured.start()
    from .session import Session
    from .targets import TARGETS

    target = TARGETS[name]
    session = Session(target)
    texts = target.seeds()
    for text in texts:
        session.feed(text)
    measured.stop()
    measured.json_report(outfile=str(report), include=[str(path) for path in target.paths()])
    found = json.loads(report.read_text())
    found.update(inputs=len(texts), faults=session.told(), counts=session.counts)
    report.write_text(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
