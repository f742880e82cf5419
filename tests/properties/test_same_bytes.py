"""The same input gives the same bytes: on every run, in every place, with every Python."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.effort import is_tried
from tests.example_files import PROGRAMS
from tests.golden import case_id, find_cases, read_options

ROOT = Path(__file__).parents[2]
# Those that show where they run, or for which Python, differ by right.
ABOUT_THE_PLACE = ("cwd", "env", "find", "load", "dirname", "package", "python", "home")

# Folders give their entries in no order that anyone promises.
OTHER_ORDER = """
import os
from contextlib import contextmanager
listdir, scandir = os.listdir, os.scandir
os.listdir = lambda *path: sorted(listdir(*path), reverse=True)
@contextmanager
def in_order(*path):
    with scandir(*path) as entries:
        yield sorted(entries, key=lambda entry: entry.name, reverse=True)
os.scandir = in_order
"""
# As a window system or another host may do for all that runs in it.
HOST_OF_THE_LOCALE = """
import locale
locale.setlocale(locale.LC_ALL, "")
assert f"{1.5:n}" == "1,5", f"{1.5:n}"
"""
SCRIPT = """
import json, sys, warnings
from yamaro import build, YamaroError
results = {}
for path in sys.stdin.read().splitlines():
    messages = []
    try:
        built = build(path, on_message=messages.append)
        found = [built.xml(), [repr(w) for w in built.warnings], built.files, built.meshes]
    except YamaroError as error:
        found = [str(error)]
    results[path] = [*found, messages]
print(json.dumps(results))
"""


def plain_cases() -> list[Path]:
    """Return the cases that compile, and need no options and no particular place."""
    return [
        case
        for case in find_cases()
        if is_tried(case_id(case), quick=4, usual=2)
        and case.with_suffix(".xml").exists()
        and not read_options(case)
        and not any(word in case.read_text(encoding="utf-8") for word in ABOUT_THE_PLACE)
    ]


def failing_cases() -> list[Path]:
    """Return the cases that end with errors, and need no options and little time."""
    return [
        case
        for case in find_cases()
        if is_tried(case_id(case), quick=4, usual=3)
        and not case.with_suffix(".xml").exists()
        and not read_options(case)
        and not case.stem.startswith("recursion-in")
    ]


def build_all(
    paths: list[Path],
    *,
    python: str = sys.executable,
    cwd: Path = ROOT,
    prelude: str = "",
    **environment: str,
) -> dict[str, Any]:
    """Return what a process of its own gives for each file, messages included."""
    finished = subprocess.run(
        [python, "-c", prelude + SCRIPT],
        input="\n".join(map(str, paths)),
        capture_output=True,
        encoding="utf-8",
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT / "src"), "PYTHONUTF8": "1", **environment},
        check=True,
    )
    results: dict[str, Any] = json.loads(finished.stdout.splitlines()[-1])
    return results


@pytest.fixture(scope="module")
def files() -> list[Path]:
    return PROGRAMS + plain_cases()


@pytest.fixture(scope="module")
def expected(files: list[Path]) -> dict[str, Any]:
    results = build_all(files, PYTHONHASHSEED="0")
    assert len(results) > 100
    return results


@pytest.fixture(scope="module")
def expected_errors() -> dict[str, Any]:
    results = build_all(failing_cases(), PYTHONHASHSEED="0")
    assert len(results) > 100
    return results


def test_the_seed_of_hashes_and_the_order_of_folders_change_nothing(
    files: list[Path], expected: dict[str, Any], expected_errors: dict[str, Any]
) -> None:
    other: dict[str, Any] = {"prelude": OTHER_ORDER, "PYTHONHASHSEED": "4242"}
    assert build_all(files, **other) == expected
    assert build_all(failing_cases(), **other) == expected_errors


@pytest.mark.slow
def test_the_working_directory_changes_nothing(
    files: list[Path], expected: dict[str, Any], tmp_path: Path
) -> None:
    got = build_all(files, cwd=tmp_path)
    # All but the last, what is printed: an example prints the directory itself.
    assert {path: result[:-1] for path, result in got.items()} == {
        path: result[:-1] for path, result in expected.items()
    }


@pytest.mark.slow
def test_a_locale_of_ascii_and_an_optimised_python_change_nothing(
    files: list[Path], expected: dict[str, Any], expected_errors: dict[str, Any]
) -> None:
    other: dict[str, Any] = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "utf-8"}
    assert build_all(files, PYTHONOPTIMIZE="2", **other) == expected  # which asserts nothing
    assert build_all(failing_cases(), **other) == expected_errors


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("localedef"), reason="needs localedef")
def test_a_host_that_writes_numbers_with_a_comma_changes_nothing(
    files: list[Path], expected: dict[str, Any], tmp_path: Path
) -> None:
    made = tmp_path / "de_DE.UTF-8"
    command = ["localedef", "--inputfile", "de_DE", "--charmap", "UTF-8", str(made)]
    if subprocess.run(command, capture_output=True).returncode or not made.exists():
        pytest.skip("the system has no sources of locales")
    got = build_all(files, prelude=HOST_OF_THE_LOCALE, LC_ALL=made.name, LOCPATH=str(tmp_path))
    assert got == expected


def other_pythons() -> list[str]:
    """Return other interpreters at hand that have PyYAML."""
    names = [f"python3.{minor}" for minor in range(10, 16)]
    found = [path for name in names if (path := shutil.which(name))]
    found += [str(path) for path in sorted(ROOT.glob(".venv*/bin/python"))]
    ask = "import sys, yaml; print(sys.version_info[:2] >= (3, 10) and sys.version_info[:2])"
    pythons: dict[str, str] = {}
    for path in found:
        finished = subprocess.run([path, "-c", ask], capture_output=True, encoding="utf-8")
        version = finished.stdout.strip()
        if finished.returncode == 0 and version not in ("False", str(sys.version_info[:2])):
            pythons.setdefault(version, path)
    return list(pythons.values())


@pytest.mark.slow
def test_another_python_changes_nothing(files: list[Path], expected: dict[str, Any]) -> None:
    pythons = other_pythons()
    if not pythons:
        pytest.skip("there is no other Python here")
    for python in pythons:
        got = build_all(files, python=python)
        # numpy is not everywhere, and what Python says itself differs.
        xml = {path: result[0] for path, result in got.items() if "numpy" not in result[0]}
        assert xml == {path: expected[path][0] for path in xml}, python
        assert len(xml) > 100
