"""A run of all tests says at its start how many there are and how long they take."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.forecast import in_words
from tests.waiting import PATIENCE

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.1, "about 10 seconds"),
        (44, "about 40 seconds"),
        (100, "about 2 minutes"),
        (200, "about 3 minutes"),
        (900, "about 15 minutes"),
    ],
)
def test_a_time_is_said_roughly(seconds: float, words: str) -> None:
    assert in_words(seconds) == words


@pytest.mark.slow
def test_a_parallel_run_tells_the_number_of_tests_and_remembers_their_time(tmp_path: Path) -> None:
    tests = tmp_path / "test_two.py"
    tests.write_text(
        "import pytest, time\n"
        "def test_a(): time.sleep(1)\n"
        "def test_b(): pass\n"
        "@pytest.mark.slow\n"
        "def test_c(): raise AssertionError\n"
    )
    command = [sys.executable, "-m", "pytest", "-q", "-n", "1", "-m", "not slow", str(tests)]
    command += ["--rootdir", str(tmp_path), "-c", str(ROOT / "pyproject.toml")]
    command += ["-p", "tests.conftest", "-o", f"cache_dir={tmp_path}/cache"]
    for _ in range(2):
        done = subprocess.run(
            command, capture_output=True, text=True, cwd=ROOT, timeout=PATIENCE, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
        assert re.search(r"^2 tests, about 10 seconds$", done.stdout, re.MULTILINE), done.stdout
    (remembered,) = (tmp_path / "cache" / "v" / "forecast").iterdir()
    assert float(remembered.read_text()) >= 0.5
