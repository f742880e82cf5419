"""scripts/check-prose finds expressions that are not plain English."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[1]
CHECK = REPOSITORY / "scripts" / "check-prose"


def check(*paths: Path) -> tuple[int, str]:
    run = subprocess.run(
        [sys.executable, CHECK, *paths], capture_output=True, text=True, check=False
    )
    assert run.stderr == ""
    return run.returncode, run.stdout


@pytest.mark.parametrize(
    ("name", "text", "found"),
    [
        ("a.md", "# X\n\nX is no\nrobot.\n", "a.md: 3: 'is no': write: is not a …\n"),
        ("a.md", "It ends in silence.\n", "a.md: 1: 'in silence': write: without a warning\n"),
        ("a.py", '"""X."""\n# read anew\n', "a.py: 2: 'anew': write: again; from scratch\n"),
        ("a.py", 'x = f"{y} is\\ntold"\n', "a.py: 1: 'told': write: reported, shown\n"),
    ],
)
def test_an_expression_is_found_at_its_line(
    tmp_path: Path, name: str, text: str, found: str
) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert check(tmp_path / name) == (1, found)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.md", "There is no robot. `anew`\n```\nanew\n```\n"),
        ("a.py", 'anew = "a new one"  # there is no other\n'),
    ],
)
def test_code_and_plain_english_pass(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert check(tmp_path / name) == (0, "")
