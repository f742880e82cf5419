"""Reads the attacks in tests/hostile/escapes: texts that safe mode has to refuse or to bound.

=== name of the attack
# where it comes from, or what it tries
mode: exec                  (eval if left out)
code: unsafe-code           (or limit-…, an exception's name, or harmless)
at: the piece of the code that the error points at    (not for harmless)
value: what it gives        (only for harmless: its repr)
steps: a smaller limit, where the usual one takes long to reach
---
the code, of which ⟪'a'*9⟫ stands for what Python makes of 'a'*9
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

FOLDER = Path(__file__).parent / "escapes"
MADE = re.compile("⟪(.*?)⟫")


class Payload(NamedTuple):
    """One attack, and what has to come of it."""

    file: str
    name: str
    mode: str
    code: str
    at: str
    value: str
    steps: int | None
    text: str


def read_payloads() -> list[Payload]:
    """Return all attacks, in the order of the files."""
    found = []
    for path in sorted(FOLDER.glob("*.txt")):
        for section in path.read_text(encoding="utf-8").split("\n=== ")[1:]:
            head, _, text = section.partition("\n---\n")
            name, *lines = head.split("\n")
            assert lines and lines[0].startswith("# "), f"{name}: where is it from?"
            fields = dict(
                line.split(": ", 1) for line in lines if line and not line.startswith("#")
            )
            unknown = fields.keys() - {"mode", "code", "at", "value", "steps"}
            assert text and not unknown, f"{path.name}: {name}: {unknown}"
            found.append(
                Payload(
                    file=path.stem,
                    name=name,
                    mode=fields.get("mode", "eval"),
                    code=fields["code"],
                    at=_made(fields.get("at", "")),
                    value=fields.get("value", ""),
                    steps=int(fields["steps"]) if "steps" in fields else None,
                    text=_made(text.rstrip("\n")),
                )
            )
    return found


def _made(text: str) -> str:
    return MADE.sub(lambda match: str(eval(match[1])), text)
