"""`yamaro lsp` in Neovim: every feature, asserted on what its buffers hold.

`scripts/editors --install` installs the versions; without one its test is skipped.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.waiting import PATIENCE

HERE = Path(__file__).parent
ROBOT = """robot: rover
variables:
  length: 0.5
  half: $(length / 2)
functions:
  Arm(side, size=1):
  - print: $(side) $(size)
model:
- part:
    name: base
- part:
    name: arm
    joint: {type: fixed, parent: bse, xyz: 0 0 0}
    link: {geometry: box, size: 1 1 1, mass: 6, xyz: "$('🤖'[:0])0 0 $(length)", rpy: 0 0 $(half)}
- part:
    name: tip
    joint: {type: fixed, parent: base} # here
- include: leg.yaml
"""


def _versions() -> dict[str, str]:
    """Return the programs that are there, by `0.7` or `0.11`."""
    candidates = [Path(sys.executable).with_name("nvim"), Path("/usr/bin/nvim")]
    found: dict[str, str] = {}
    for path in [*map(str, candidates), shutil.which("nvim") or ""]:
        if path and os.access(path, os.X_OK):
            done = subprocess.run([path, "--version"], capture_output=True, text=True, check=False)
            version = done.stdout.partition("v")[2].split("\n")[0]
            found.setdefault(".".join(version.split(".")[:2]), path)
    return found


VERSIONS = _versions()


@pytest.mark.slow
@pytest.mark.parametrize("version", ["0.7", "0.11"])
def test_every_feature_works_in_neovim(tmp_path, version):
    if version not in VERSIONS:
        pytest.skip(f"needs Neovim {version}")
    (tmp_path / "leg.yaml").write_text("model:\n")
    path = tmp_path / "rover.urdf.yaml"
    path.write_text(ROBOT)
    result = tmp_path / "result.json"
    done = subprocess.run(
        [VERSIONS[version], "--clean", "--headless", str(path), "-c", f"luafile {HERE}/nvim.lua"],
        cwd=tmp_path,
        env={
            **os.environ,
            "YAMARO_COMMAND": json.dumps([sys.executable, "-m", "yamaro", "lsp"]),
            "YAMARO_RESULT": str(result),
            "XDG_STATE_HOME": str(tmp_path),
            "XDG_CACHE_HOME": str(tmp_path),
        },
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert result.exists(), done.stdout + done.stderr
    told = json.loads(result.read_text())
    assert "fault" not in told, (told, done.stderr)
    assert [key for key, value in told.items() if key.startswith("reached") and not value] == []
    line, column, message = told["diagnostic"]
    assert (line, column) == (12, 33)
    assert "did you mean 'base_link'" in message
    assert told["definition"] == "  length: 0.5"
    assert "mass 6 kg" in told["hover"]
    assert "inertia 1 0 0 1 0 1" in told["hover"]
    assert "at zero" in told["hover"]
    base = ROBOT.replace("bse", "base").rstrip("\n")
    assert told["renamed"] == base.replace("length", "reach")
    assert told["completed"] == "    joint: {type: }"
    assert told["fixed"] == "    joint: {type: fixed, parent: base, xyz: 0 0 $(reach)}"
    assert told["signature"] == ["Arm(side, size=1)", 1]
    assert told["folds"] > 5
    assert told["links"] == 1
    assert told["formatted"] == "robot: rover"
    if version == "0.11":
        assert told["hint"] == "= 0.25"


@pytest.mark.slow
def test_the_set_up_of_the_docs_starts_the_server(tmp_path):
    if "0.11" not in VERSIONS:
        pytest.skip("needs Neovim 0.11")
    folder = tmp_path / "config" / "nvim" / "plugin"
    folder.mkdir(parents=True)
    shutil.copy(HERE.parents[1] / "editors" / "nvim" / "yamaro.lua", folder)
    path = tmp_path / "rover.yaml"
    path.write_text(ROBOT)
    (tmp_path / "leg.yaml").write_text("model:\n")
    script = tmp_path / "look.lua"
    script.write_text(
        "vim.wait(30000, function() return #vim.diagnostic.get(0) > 0 end, 50)\n"
        "local found = vim.diagnostic.get(0)[1]\n"
        "io.stdout:write(vim.bo.filetype .. ' ' .. (found and found.code or 'nothing'))\n"
        "vim.cmd('qall!')\n"
    )
    done = subprocess.run(
        [VERSIONS["0.11"], "--headless", str(path), "-c", f"luafile {script}"],
        cwd=tmp_path,
        env={
            **os.environ,
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
            "XDG_CONFIG_HOME": str(tmp_path / "config"),
            "XDG_DATA_HOME": str(tmp_path),
            "XDG_STATE_HOME": str(tmp_path),
            "XDG_CACHE_HOME": str(tmp_path),
        },
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert done.stdout.strip() == "yamaro unknown-parent", done.stderr
