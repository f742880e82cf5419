"""Judges each robot of a corpus, and counts what was found: for sdf.py and usd.py."""

from __future__ import annotations

import argparse
import csv
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import yamaro  # noqa: E402 - after the path
from yamaro.result import Build  # noqa: E402

Judge = Callable[[Path, Path, int], str]
SHOWN = 60
"""Characters of a verdict by which robots are counted."""


class RefusedError(Exception):
    """A robot is not written, for the reason of this code."""


def robots(corpus: Path) -> Iterator[Path]:
    """Yield the URDF files of a corpus, and what xacro makes of its xacro files."""
    with (corpus / "urdf.tsv").open(encoding="utf-8", newline="") as file:
        yield from (corpus / "src" / row["path"] for row in csv.DictReader(file, delimiter="\t"))
    yield from sorted((corpus / "expected").rglob("*.urdf"))


def built(path: Path, **options: Any) -> Build:
    """Return a robot in a format, without meshes.

    Raises:
        RefusedError: it is not written.
    """
    try:
        return yamaro.build(path, meshes="none", on_message=lambda line: None, **options)
    except yamaro.YamaroError as error:
        first = next(each for each in error.diagnostics if each.severity == "error")
        raise RefusedError(first.code) from None


def run(doc: str | None, judge: Judge) -> None:
    """Judge the robots that the command line names, and print each verdict and how many have it.

    Args:
        doc: what the command does.
        judge: returns what is wrong with a robot, or ""; it takes the file, a folder that is
            removed in the end, and how many positions are tried.
    """
    parser = argparse.ArgumentParser(description=doc)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="")
    parser.add_argument("--positions", type=int, default=20)
    wanted = parser.parse_args()
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for path in robots(wanted.corpus):
            if not re.search(wanted.only, str(path)):
                continue
            try:
                verdict = judge(path, Path(folder), wanted.positions) or "agrees"
            except RefusedError as error:
                verdict = f"refused: {error}"
            except Exception as error:
                verdict = f"ERROR {type(error).__name__}: {str(error).splitlines()[0][:200]}"
            counts[verdict[:SHOWN]] += 1
            if verdict != "agrees":
                print(f"{path.relative_to(wanted.corpus)}: {verdict}", flush=True)
    for verdict, count in counts.most_common():
        print(f"{count:5d}  {verdict}")
