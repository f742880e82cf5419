"""Counts what makes migrated sources unlike sources written by hand."""

from __future__ import annotations

import re
from collections.abc import Iterable

WIDTH = 120
"""Columns that a line may have."""
MARKS = {
    f"lines over {WIDTH} columns": re.compile(rf"^.{{{WIDTH + 1},}}$", re.MULTILINE),
    "`/global`": re.compile(r"[\w)]/global\b"),
    "`/child`": re.compile(r"[\w)]/child\b"),
    "`origin` keys": re.compile(r"(?:^|[{,-]) *[\"']?<?origin\b[/>:]", re.MULTILINE),
    "`../../`": re.compile(r"\.\./\.\./"),
    "lines in all": re.compile(r"\n"),
}


def reading_table(texts: Iterable[str]) -> str:
    """Return a table of how often each mark is found in sources."""
    counts = dict.fromkeys(MARKS, 0)
    for text in texts:
        for name, mark in MARKS.items():
            counts[name] += len(mark.findall(text))
    return "\n".join(f"| {name} | {count:,} |" for name, count in counts.items())
