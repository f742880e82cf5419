"""Writes the page of `yamaro guide`: how to work with the command, and the cheat sheet.

python scripts/guide.py            writes src/yamaro/tools/guide/guide.md
python scripts/guide.py --check    only reports whether it is out of date
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
GUIDE = ROOT / "src" / "yamaro" / "tools" / "guide" / "guide.md"
HEAD = ROOT / "scripts" / "guide_head.md"
SHEET = ROOT / "docs" / "cheat-sheet.md"
FOR_PEOPLE = re.compile(r"</?div[^>]*>|<!--.*?-->|^# .*$", re.MULTILINE)
LINK = re.compile(r"\[([^][\n]+)\]\([^)\s]+\)")
FENCED = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)


def written() -> str:
    """Return the text that the page has to have."""
    _, _, sheet = SHEET.read_text(encoding="utf-8").partition('<div class="sheet" markdown>')
    pieces = FENCED.split(sheet)  # text and examples in turn
    pieces[::2] = [LINK.sub(r"\1", FOR_PEOPLE.sub("", text)) for text in pieces[::2]]
    text = HEAD.read_text(encoding="utf-8") + "".join(pieces).strip() + "\n"
    return re.sub(r"\n{3,}", "\n\n", text)


def main(arguments: list[str]) -> int:
    """Write the page, or report that it differs; return the exit status."""
    text = written()
    if GUIDE.is_file() and GUIDE.read_text(encoding="utf-8") == text:
        return 0
    print(GUIDE.relative_to(ROOT))
    if arguments == ["--check"]:
        return 1
    GUIDE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
