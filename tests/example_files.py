"""The YAML files of `examples/` that can be compiled."""

from __future__ import annotations

from pathlib import Path

EXAMPLES = Path(__file__).parents[1] / "examples"
OTHERS = (".test.yaml", "study.yaml")
"""Ends of the names of files that are for `yamaro test` and `yamaro sweep`."""


def programs_in(folder: Path) -> list[Path]:
    """Return the files below a folder that describe robots, or other XML, or parts of it."""
    return sorted(path for path in folder.rglob("*.yaml") if not path.name.endswith(OTHERS))


PROGRAMS = programs_in(EXAMPLES)
