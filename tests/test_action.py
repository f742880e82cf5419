"""The GitHub action and the hooks: what they run does what their inputs say."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.waiting import PATIENCE

REPOSITORY = Path(__file__).parents[1]
GOOD = "robot: good\nmodel:\n- link/name=a:\n"
BAD = "robot:   bad\nmodel:\n- if:\n    conditon: true\n"


def read(name: str) -> Any:
    return yaml.safe_load((REPOSITORY / name).read_text(encoding="utf-8"))


def run_action(folder: Path, **inputs: str) -> subprocess.CompletedProcess[str]:
    """Run the last step of the action as GitHub does."""
    step = read("action.yml")["runs"]["steps"][-1]
    defaults = {
        name: str(each.get("default", "")) for name, each in read("action.yml")["inputs"].items()
    }
    given = defaults | inputs
    values = {
        name: given[text.removeprefix("${{ inputs.").removesuffix(" }}")]
        for name, text in step["env"].items()
    }
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.run(
        ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]],
        cwd=folder,
        env={**os.environ, **values, "PATH": path},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )


@pytest.fixture
def robots(tmp_path: Path) -> Path:
    (tmp_path / "robots" / "a b").mkdir(parents=True)
    (tmp_path / "robots" / "good.urdf.yaml").write_text(GOOD)
    (tmp_path / "robots" / "a b" / "bad.urdf.yaml").write_text(BAD)
    return tmp_path


def test_the_action_annotates_all_files_that_match(robots: Path) -> None:
    result = run_action(robots, files="robots/**/*.urdf.yaml\n")
    assert result.returncode == 1
    (line,) = result.stdout.splitlines()
    assert line.startswith("::error file=robots/a b/bad.urdf.yaml,line=4,")
    assert run_action(robots, files="robots/*.urdf.yaml").returncode == 0


def test_the_action_takes_arguments_and_files_line_by_line(robots: Path) -> None:
    (robots / "two.yaml").write_text(
        "robot: r\nvariables: {n: 1}\nmodel:\n- link/name=a:\n- link/name=b$(1 / n):\n"
    )
    files = "robots/good.urdf.yaml\ntwo.yaml"
    assert run_action(robots, files=files).returncode == 1
    allowed = run_action(robots, files=files, arguments="--allow several-roots")
    assert allowed.returncode == 0
    failed = run_action(robots, files="two.yaml", arguments="--allow several-roots n:=0")
    assert "title=python-error" in failed.stdout


def test_the_action_writes_a_report_and_checks_the_style(robots: Path) -> None:
    (robots / "robots" / "messy.urdf.yaml").write_text(GOOD.replace("- link", "  - link"))
    result = run_action(robots, files="robots/*.urdf.yaml", fmt="true", sarif="out/report.sarif")
    assert result.returncode == 1
    assert "+- link/name=a:" in result.stdout
    report = json.loads((robots / "out" / "report.sarif").read_text())
    assert report["runs"][0]["results"] == []


def test_what_a_checked_file_prints_or_holds_is_no_command_to_the_runner(robots: Path) -> None:
    (robots / "robots" / "print.urdf.yaml").write_text(
        "robot: r\nprint: '::stop-commands::x'\nmodel:\n- link/name=a:\n"
        '- print: "x\\n\\t::error::y\\r::add-mask::a ##[error]z"\n'
        "- print: '##[add-mask]a'\n"
        "- process: |\n    print(':', end='')\n    print(':error::x')\n"
        '- "$(1)##[error]x\\n::error::y":\n'
    )
    for name in ("good", "print"):
        result = run_action(
            robots, files=f"robots/{name}.urdf.yaml", sarif="x.sarif", arguments="--trust"
        )
        lines = (result.stdout + result.stderr).splitlines()
        obeyed = [line for line in lines if line.lstrip().startswith("::") or "##[" in line]
        findings = [line for line in obeyed if line.startswith("::error file=robots/print")]
        assert obeyed == findings
        assert len(findings) == (name == "print")


def test_a_difference_of_style_is_shown_while_the_runner_obeys_nothing(robots: Path) -> None:
    text = "robot:   r\nmodel:\n- link/name=a:\n- text: |\n    a\n ::error::x\n# ::error::x\n"
    (robots / "messy.yaml").write_text(text)
    lines = run_action(robots, files="messy.yaml", fmt="true").stdout.splitlines()
    first = next(at for at, line in enumerate(lines) if line.startswith("::stop-commands::"))
    token = lines[first].removeprefix("::stop-commands::")
    assert len(token) == 64
    assert lines[-1] == f"::{token}::"


def test_the_action_installs_with_pip_of_python_and_not_of_the_checkout(tmp_path: Path) -> None:
    step = next(
        each for each in read("action.yml")["runs"]["steps"] if "pip" in each.get("run", "")
    )
    assert step["working-directory"] == "${{ runner.temp }}"
    (tmp_path / "pip.py").write_text("open('RAN', 'w')")
    command = step["run"].replace("install", "--version").split("--quiet")[0]
    assert "--version" in command
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    result = subprocess.run(
        ["bash", "-c", command], cwd=tmp_path, env={**environment, "PATH": path}, check=False,
        capture_output=True, text=True,
    )  # fmt: skip
    assert result.stdout.startswith("pip ")
    assert not (tmp_path / "RAN").exists()


def test_the_action_refuses_to_check_nothing(robots: Path) -> None:
    result = run_action(robots, files="nothing/*.yaml")
    assert (result.returncode, result.stdout[:9]) == (2, "::error::")


def test_inputs_are_no_shell_code(robots: Path) -> None:
    run_action(robots, files="$(touch made)\n`touch made`", arguments="$(touch made); touch made")
    assert not (robots / "made").exists()


def test_the_hooks_run_commands_that_there_are() -> None:
    from yamaro.commands.command_table import all_commands

    hooks = read(".pre-commit-hooks.yaml")
    assert [hook["id"] for hook in hooks] == ["yamaro-check", "yamaro-fmt"]
    for hook in hooks:
        program, command = hook["entry"].split()
        assert program == "yamaro"
        assert all_commands()[command].takes_several
