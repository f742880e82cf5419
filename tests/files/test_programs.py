"""Programs are found on PATH, and never where untrusted files may be."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

from yamaro.files.regular import find_program

COMMAND = Path(__file__).parents[2] / "editors" / "vscode" / "src" / "command.js"


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with programs; the working directory has some of their names."""
    for folder in ("here", "there"):
        (tmp_path / folder).mkdir()
        for name in ("git", "git.exe", "yamaro", "yamaro.exe"):
            (tmp_path / folder / name).write_text("")
            (tmp_path / folder / name).chmod(0o755)
    (tmp_path / "there" / "text").write_text("")
    (tmp_path / "there" / "folder").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    return tmp_path / "there"


@pytest.mark.parametrize("before", ["", ".", "../here", "here", ".."])
def test_a_program_is_not_searched_for_in_the_working_directory(
    before: str, programs: Path
) -> None:
    found = str(programs / ("git.exe" if os.name == "nt" else "git"))
    assert find_program("git", os.pathsep.join([before, str(programs), before])) == found
    assert find_program("git", before) is None
    assert find_program("./git", before) == "./git"


@pytest.mark.skipif(os.name == "nt", reason="all files are programs")
def test_only_files_that_can_be_run_are_programs(programs: Path) -> None:
    assert find_program("text", str(programs)) is None
    assert find_program("folder", str(programs)) is None


@pytest.mark.skipif(shutil.which("node") is None, reason="needs node")
def test_the_extension_of_vs_code_finds_yamaro_as_yamaro_finds_programs(programs: Path) -> None:
    windows = f"{programs}/yamaro.exe".replace("/", "\\")
    cases = [
        ["yamaro", {"PATH": f":.:../here:{programs}"}, "linux", str(programs / "yamaro")],
        ["yamaro", {"PATH": ":.:../here"}, "linux", ""],
        ["yamaro", {}, "linux", ""],
        ["text", {"PATH": str(programs)}, "linux", ""],
        ["folder", {"PATH": str(programs)}, "linux", ""],
        ["/usr/bin/yamaro", {"PATH": ""}, "linux", "/usr/bin/yamaro"],
        ["yamaro", {"Path": f";.;..\\here;{programs}"}, "win32", windows],
        ["yamaro", {"Path": ";."}, "win32", ""],
    ]
    # On Linux a path with a backslash is a name: there is such a file for the case of Windows.
    Path(windows).write_text("")
    Path(windows).chmod(0o755)
    script = (
        f"const {{ findProgram }} = require({json.dumps(str(COMMAND))});"
        "const cases = JSON.parse(process.argv[1]);"
        "console.log(JSON.stringify(cases.map(([name, environment, platform]) =>"
        " findProgram(name, { environment, platform }))));"
    )
    done = subprocess.run(
        ["node", "-e", script, json.dumps(cases)], capture_output=True, text=True, check=True
    )
    assert json.loads(done.stdout) == [case[3] for case in cases]
