"""ARCHITECTURE.md maps every module, and no other."""

from __future__ import annotations

import re
from pathlib import Path

REPOSITORY = Path(__file__).parents[1]
PACKAGE = REPOSITORY / "src" / "yamaro"

PHASE = re.compile(r"\*\*`([\w/]+/)`\*\*")
MODULE = re.compile(r"`(\w+\.py)`")


def modules_mapped() -> list[str]:
    """Return the modules in the first cells of the table, with their folders.

    Tools that are not there are left out: each can be deleted as a folder.
    """
    text = (REPOSITORY / "ARCHITECTURE.md").read_text(encoding="utf-8")
    table = text.split("\n## Modules\n")[1].split("\n## ")[0]
    folder = ""
    found = []
    for line in table.splitlines():
        if not line.startswith("| "):
            continue
        cell = line.split("|")[1]
        phase = PHASE.search(cell)
        folder = phase[1] if phase else folder
        found += [folder + name for name in MODULE.findall(cell)]
    tools = {each.name for each in (PACKAGE / "tools").iterdir()}
    return [each for each in found if each[:6] != "tools/" or each.split("/")[1] in tools]


def modules_there() -> list[str]:
    paths = [path.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py")]
    return sorted(path for path in paths if not path.endswith("__init__.py"))


def test_every_module_is_mapped_once() -> None:
    assert sorted(modules_mapped()) == modules_there()


def test_every_file_that_is_named_exists() -> None:
    text = (REPOSITORY / "ARCHITECTURE.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`(\w+/\w+\.py)\b", text))
    assert len(named) > 20
    assert sorted(name for name in named if not (PACKAGE / name).exists()) == []
