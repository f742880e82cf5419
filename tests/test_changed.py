"""`scripts/test --changed` runs the tests of what a change can break."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests import changed
from tests.changed import ALWAYS, CORE, ELSEWHERE, ROOT, changed_files, paths_for

MODULES = sorted(
    path.relative_to(ROOT).as_posix()
    for path in (ROOT / "src" / "yamaro").rglob("*.py")
    if path.read_text(encoding="utf-8").count("\n") > 1
)


def test_what_is_named_exists() -> None:
    named = {*CORE, *ALWAYS, *(path for paths in ELSEWHERE.values() for path in paths)}
    assert [path for path in sorted({*named, *ELSEWHERE}) if not (ROOT / path).exists()] == []


def test_every_module_has_tests() -> None:
    assert [module for module in MODULES if set(paths_for([module])) == set(ALWAYS)] == []


def test_a_module_asks_for_its_room_for_those_that_import_it_and_for_the_core() -> None:
    asked = set(paths_for(["src/yamaro/model/kinematics.py"]))
    assert {"tests/model", "tests/check", "tests/test_cases.py", "tests/tools/sweep"} <= asked
    assert "tests/test_layout.py" not in asked


def test_a_tool_asks_for_its_own_tests_only() -> None:
    assert set(paths_for(["src/yamaro/tools/lsp/hover.py"])) == {"tests/tools/lsp", *ALWAYS}


def test_what_tests_share_asks_for_the_tests_that_import_it() -> None:
    assert "tests/test_docs.py" in paths_for(["tests/fenced.py"])
    assert "tests/tools/view" in paths_for(["tests/tools/view/conftest.py"])


def test_a_change_of_the_harness_asks_for_all() -> None:
    assert paths_for(["docs/cli.md", "pyproject.toml"]) == ["tests"]


def test_new_and_uncommitted_files_count_and_else_the_last_commit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(changed, "ROOT", tmp_path)

    def git(*arguments: str) -> None:
        author = ["-c", "user.name=a", "-c", "user.email=a@example.org"]
        subprocess.run(["git", *author, *arguments], cwd=tmp_path, check=True, capture_output=True)

    git("init")
    for name in ("a.md", "b.md"):
        (tmp_path / name).write_text("1\n")
        git("add", name)
        git("commit", "-m", name)
    assert changed_files(None) == ["b.md"]
    (tmp_path / "a.md").write_text("2\n")
    (tmp_path / "c.md").write_text("1\n")
    assert changed_files(None) == ["a.md", "c.md"]
    assert changed_files("HEAD~1") == ["a.md", "b.md", "c.md"]
