"""What is published: one version, and notes from the changelog."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from typing import Any

import pytest

import yamaro

REPOSITORY = Path(__file__).parents[1]

CHANGELOG = """# Changelog

## [Unreleased]

- later

## [0.2.0] - 2027-01-02

### Added

- `yamaro new`, see [how](docs/new.md#a) and [why](https://example.com/a).

## [0.1.1]

- no date

## [0.1.0] - 2026-12-24
"""


@pytest.fixture
def script() -> Any:
    path = REPOSITORY / "scripts" / "release_notes.py"
    spec = importlib.util.spec_from_file_location("release_notes", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_notes_are_those_of_the_version(script: Any) -> None:
    assert script.notes(CHANGELOG, "0.2.0") == (
        "### Added\n\n- `yamaro new`, see how and [why](https://example.com/a).\n"
    )


@pytest.mark.parametrize(
    ("version", "reason"),
    [
        ("0.3.0", "there is no heading"),
        ("0.1.1", "has no date"),
        ("0.1.0", "nothing is said"),
        ("Unreleased", "has no date"),
    ],
)
def test_a_version_without_notes_is_not_released(script: Any, version: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        script.notes(CHANGELOG, version)


def test_the_changelog_has_notes_of_this_version(script: Any) -> None:
    text = (REPOSITORY / "CHANGELOG.md").read_text(encoding="utf-8")
    assert "\n### Added\n" in script.notes(text, yamaro.__version__)


def test_the_version_is_in_one_place(script: Any) -> None:
    assert script.version() == yamaro.__version__
    project = (REPOSITORY / "pyproject.toml").read_text(encoding="utf-8")
    assert 'dynamic = ["version"]' in project
    assert re.search(r"^version =", project, re.MULTILINE) is None
    assert 'path = "src/yamaro/__init__.py"' in project


def test_the_documents_name_this_version() -> None:
    page = (REPOSITORY / "docs" / "check-in-ci.md").read_text(encoding="utf-8")
    assert set(re.findall(r"(?:rev: |yamaro@)v([\w.]+)", page)) == {yamaro.__version__}


def test_actions_are_pinned() -> None:
    for path in (REPOSITORY / ".github" / "workflows").glob("*.yml"):
        for used in re.findall(r"uses: (\S+)", path.read_text(encoding="utf-8")):
            assert re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", used), (path.name, used)


def test_the_workflow_runs_all_versions_of_python() -> None:
    project = (REPOSITORY / "pyproject.toml").read_text(encoding="utf-8")
    versions = re.findall(r'"Programming Language :: Python :: (3\.\d+)"', project)
    workflow = (REPOSITORY / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8")
    (listed,) = re.findall(r"python: \[(.*)\]", workflow)
    assert re.findall(r"[\d.]+", listed) == versions
