"""What scripts share that write parts of the docs: tables between two marks, and `--check`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


class Tables:
    """The tables in a page, each between `<!-- WORD: NAME -->` and `<!-- end of WORD -->`."""

    def __init__(self, word: str, table_of: Callable[[str], str]) -> None:
        """Take what makes the table of a name."""
        self._table_of = table_of
        pattern = rf"(<!-- {word}: ([^\n]*) -->\n).*?(<!-- end of {word} -->)"
        self._block = re.compile(pattern, re.DOTALL)

    def names(self, text: str) -> list[str]:
        """Return the names of the tables in a page."""
        return [found[2] for found in self._block.finditer(text)]

    def fill(self, text: str) -> str:
        """Return a page with its tables as they have to be."""
        return self._block.sub(
            lambda found: f"{found[1]}\n{self._table_of(found[2])}\n{found[3]}", text
        )


def update(texts: Mapping[Path, str], arguments: list[str]) -> int:
    """Write the files that differ from these texts, and print them; return the exit status.

    With the argument `--check` none is written, and it is a failure if one differs.
    """
    is_check = arguments == ["--check"]
    stale = {path: text for path, text in texts.items() if path.read_text("utf-8") != text}
    for path, text in stale.items():
        print(path.relative_to(ROOT))
        if not is_check:
            path.write_text(text, encoding="utf-8")
    return 1 if stale and is_check else 0
