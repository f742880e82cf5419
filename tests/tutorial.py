"""The files of docs/tutorial.md as they are after each step, for its pictures.

python -m tests.tutorial FOLDER     writes FOLDER/1/robot.yaml, FOLDER/2/robot.yaml, …
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from tests.fenced import DEFAULT_FILE, REPOSITORY, read_blocks

STEP = re.compile(r"^## (\d+)\. ")


def files_of_steps() -> dict[int, dict[str, str]]:
    """Return the texts of the files after each step, by their names."""
    markdown = (REPOSITORY / "docs" / "tutorial.md").read_text(encoding="utf-8")
    lines = enumerate(markdown.splitlines(), start=1)
    begins = {int(found[1]): line for line, text in lines if (found := STEP.match(text))}
    ends = [*list(begins.values())[1:], sys.maxsize]
    blocks = [block for block in read_blocks(markdown) if block.language == "yaml"]
    files: dict[str, str] = {}
    steps = {}
    for step, end in zip(begins, ends, strict=True):
        for block in blocks:
            is_here = begins[step] < block.line < end
            if is_here and not block.words & {"error", "fragment", "whole"}:
                name = block.settings.get("file", DEFAULT_FILE)
                before = files.get(name, "") if "continued" in block.words else ""
                files[name] = before + block.text
        steps[step] = dict(files)
    return steps


def main(folder: Path) -> None:
    """Write the files of each step into a folder of its number."""
    for step, files in files_of_steps().items():
        place = folder / str(step)
        place.mkdir(parents=True, exist_ok=True)
        for name, text in files.items():
            (place / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m tests.tutorial FOLDER")
    main(Path(sys.argv[1]))
