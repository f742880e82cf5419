"""Marks what needs the command of a tool: each tool is a folder that can be left out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import pytest

from yamaro.commands.command_table import command_named

TOOLS = (
    "diff", "fmt", "guide", "lsp", "mcp", "migrate", "new", "picture", "sweep", "test", "tree",
    "view", "watch", "why",
)  # fmt: skip


def needs(*tools: str) -> pytest.MarkDecorator:
    """Return the mark of a test that runs the commands of these tools."""
    gone = [tool for tool in tools if command_named(tool) is None]
    return pytest.mark.skipif(bool(gone), reason=f"without {', '.join(gone)}")


def marked(cases: Iterable[Any]) -> list[Any]:
    """Mark the cases whose texts name tools; a tuple has a value for each argument."""
    found = []
    for case in cases:
        values = case if isinstance(case, tuple) else (case,)
        named = [tool for tool in TOOLS if tool in set(_words(values))]
        found.append(pytest.param(*values, marks=needs(*named)) if named else case)
    return found


def _words(value: object) -> Iterator[str]:
    if isinstance(value, str):
        yield from value.split()
    elif isinstance(value, (list, tuple)):
        for each in value:
            yield from _words(each)
