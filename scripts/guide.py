"""Writes the page of `yamaro guide`: how to work with the command, and the cheat sheet.

python scripts/guide.py            writes src/yamaro/tools/guide/guide.md
python scripts/guide.py --check    only reports whether it is out of date
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from derived import update

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


if __name__ == "__main__":
    sys.exit(update({GUIDE: written()}, sys.argv[1:]))
