"""Holds how long modules and functions may be: `python -m tests.sizes` lists those that are longer.

The lines of a module are all of its lines. Those of a function go from its `def` to its end,
without the docstring and the decorators; a function inside another one counts for both.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCES = (ROOT / "src" / "yamaro", ROOT / "ros" / "yamaro_ros")
MOST_OF_MODULE = 500
MOST_OF_FUNCTION = 40


def too_long(text: str, name: str) -> Iterator[tuple[str, int]]:
    """Give what is too long in a module, as `module.py` or `module.py:function`, with its lines."""
    lines = len(text.splitlines())
    if lines > MOST_OF_MODULE:
        yield name, lines
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            lines = lines_of(node)
            if lines > MOST_OF_FUNCTION:
                yield f"{name}:{node.name}", lines


def lines_of(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Return the lines of a function without its docstring."""
    assert function.end_lineno is not None
    lines = function.end_lineno - function.lineno + 1
    first = function.body[0]
    if ast.get_docstring(function, clean=False) is not None:
        assert first.end_lineno is not None
        lines -= first.end_lineno - first.lineno + 1
    return lines


def faults() -> list[str]:
    """Return what is too long in the packages."""
    most = f"a module may have {MOST_OF_MODULE}, a function {MOST_OF_FUNCTION}"
    found: list[str] = []
    for source in SOURCES:
        for path in sorted(source.rglob("*.py")):
            name = path.relative_to(source).as_posix()
            for long, lines in too_long(path.read_text(encoding="utf-8"), name):
                found.append(f"{long} has {lines} lines; {most}")
    return found


if __name__ == "__main__":
    sys.exit("\n".join(faults()) or None)
