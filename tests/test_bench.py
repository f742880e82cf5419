"""The scripts of bench/ run, on little work; what they say of time is for scripts/bench."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.built_site import SITE, build_site
from tests.effort import tried
from tests.waiting import PATIENCE

BENCH = Path(__file__).parents[1] / "bench"
OTHERS = {
    *("controllers", "moveit"),
    *("attached", "changes", "engines", "fresh", "interface", "losses", "mass", "measuring"),
    *("guide_tokens", "isaaclab_articulations", "mirrored", "mjcf", "mjcf_in", "mjlab_entities"),
    *(
        "killed",
        "newton_orders",
        "noise",
        "others",
        "overlays",
        "play",
        "reading",
        "robots",
        "run",
        "sdf",
        "simready",
    ),
    *("lsp_xacro", "style", "training", "urdf", "usd"),
    *("batch", "fit_bytes", "fits", "fits_of_others", "planning", "sdf_in", "shapes"),
    *("values", "verdicts"),
}
"""What measures no time by itself, and what needs a corpus that is not part of the project."""
SCRIPTS = sorted({path.stem for path in BENCH.glob("*.py")} - OTHERS)

pytestmark = [
    pytest.mark.skipif(find_spec("xacro") is None, reason="needs xacro to compare with"),
    pytest.mark.skipif(sys.platform == "win32", reason="tells no peak of memory"),
]


def run(script: str, *arguments: str) -> list[str]:
    """Run a script and return the lines it prints."""
    command = [sys.executable, str(BENCH / f"{script}.py"), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE + 60)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.splitlines()


@pytest.mark.slow
@pytest.mark.parametrize("script", tried(SCRIPTS, str, quick=6, usual=2))
def test_a_script_prints_a_table_of_figures(
    script: str, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> None:
    if script == "playground":
        build_site(tmp_path_factory)
        monkeypatch.setenv("PLAYGROUND", str(SITE / "playground"))
    head, line, *rows = run(script, "--scale", "0.002", "--runs", "1")
    assert head.startswith("| work")
    assert line.startswith("|---")
    assert rows
    assert {row.count("|") for row in rows} == {head.count("|")}


@pytest.mark.slow
def test_one_command_runs_the_scripts_and_names_the_machine() -> None:
    machine, _, *table = run("run", "start", "--scale", "0.002", "--runs", "1")
    assert f"Python {sys.version_info.major}.{sys.version_info.minor}" in machine
    assert len(table) > 2


def test_one_command_knows_all_scripts() -> None:
    text = "\n".join(run("run", "--help"))
    assert all(script in text for script in SCRIPTS)
