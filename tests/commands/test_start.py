"""What the command loads for a plain build, and how its process ends."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from tests.waiting import PATIENCE

LEGS = Path(__file__).parents[2] / "bench" / "legs" / "legs.yaml"

SCRIPT = "import sys; from yamaro.commands.main import run_script; sys.exit(run_script())"
"""What the script `yamaro` does."""

MOST_MODULES = 85
"""Each costs a tenth of a millisecond; a new one belongs behind an import where it is used."""

OF_OTHER_BUILDS = {
    "yamaro.api",
    "yamaro.check.advice",
    "yamaro.check.files",
    "yamaro.check.material",
    "yamaro.check.outermost",
    "yamaro.commands.option_table",
    "yamaro.confined",
    "yamaro.jailed_builds",
    "yamaro.model.compare",
    "yamaro.model.extras",
    "yamaro.rendering",
    "yamaro.robot.extras",
    "yamaro.robot.attach",
    "yamaro.robot.control",
    "yamaro.robot.finish",
    "yamaro.robot.material",
    "yamaro.robot.mirror",
    "yamaro.robot.naming",
    "yamaro.robot.quantities",
    "yamaro.robot.rigid",
    "yamaro.robot.sections",
    "yamaro.runtime.argument_values",
    "yamaro.runtime.includes",
    "yamaro.runtime.modules",
    "yamaro.runtime.python_errors",
    "yamaro.runtime.recording",
    "yamaro.runtime.robot_words",
    "yamaro.safe",
    "yamaro.syntax.argument_section",
    "yamaro.syntax.heads",
    "yamaro.syntax.leaves",
    "yamaro.syntax.robot_words",
    "yamaro.targets",
    "yamaro.terminal",
    "yamaro.tools",
    "yamaro.units",
    "yamaro.xacro",
    "yamaro.xml.reader",
    "yamaro.yaml.recovery",
}
"""What serves a word, an option or a fault that the file does not have."""

NEVER = {"argparse", "ast", "copy", "dataclasses", "inspect", "json", "logging", "numpy"}
NEVER |= {"random", "tempfile", "threading", "traceback", "typing", "xml", "yaml"}


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def python(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)


@cache
def imported(*arguments: str) -> frozenset[str]:
    """Return the modules that a run of Python imports."""
    done = python("-X", "importtime", *arguments)
    assert done.returncode == 0
    lines = [line for line in done.stderr.splitlines() if line.startswith("import time:")]
    return frozenset(line.rpartition("|")[2].strip() for line in lines)


def imported_for_a_build() -> frozenset[str]:
    """Return the modules that a build imports, and an empty run of Python does not."""
    return imported("-c", SCRIPT, str(LEGS), "n:=6") - imported("-c", "pass")


def test_a_plain_build_imports_few_modules() -> None:
    own = {name for name in imported_for_a_build() if name.partition(".")[0] == "yamaro"}
    assert len(own) <= MOST_MODULES, sorted(own)


def test_a_plain_build_imports_nothing_that_serves_what_its_file_does_not_have() -> None:
    assert imported_for_a_build() & (OF_OTHER_BUILDS | NEVER) == frozenset()


def test_what_is_still_in_a_buffer_at_the_end_is_written() -> None:
    write = "import sys; sys.kept = open('left.txt', 'w'); sys.kept.write('all of it')"
    Path("robot.yaml").write_text(f"process: {write}\nmodel:\n  link/name=base:\n")
    assert python("-c", SCRIPT, "robot.yaml").returncode == 0
    assert Path("left.txt").read_text() == "all of it"


def test_threads_and_functions_that_run_at_the_end_are_waited_for() -> None:
    Path("last.py").write_text(
        "import atexit, threading, time\n"
        "def work():\n    time.sleep(0.2); open('thread.txt', 'w').close()\n"
        "threading.Thread(target=work).start()\n"
        "atexit.register(lambda: open('exit.txt', 'w').close())\n"
    )
    Path("robot.yaml").write_text("import: last\nmodel:\n  link/name=base:\n")
    assert python("-c", SCRIPT, "robot.yaml").returncode == 0
    assert Path("thread.txt").exists()
    assert Path("exit.txt").exists()


def test_what_runs_the_script_goes_on_when_it_has_ended() -> None:
    Path("robot.yaml").write_text("model:\n  link/name=base:\n")
    Path("script.py").write_text(SCRIPT)
    done = python("-m", "cProfile", "script.py", "robot.yaml", "-o", "robot.urdf")
    assert (done.returncode, "function calls" in done.stderr) == (0, True)


@pytest.mark.parametrize(("text", "status"), [("model:\n  link/name=base:\n", 0), ("model: [", 1)])
def test_the_status_is_that_of_the_command(text: str, status: int) -> None:
    Path("robot.yaml").write_text(text)
    assert python("-c", SCRIPT, "robot.yaml").returncode == status
