"""`yamaro lsp` in Neovim: every feature, asserted on what its buffers hold.

`scripts/editors --install` installs the versions; without one its test is skipped.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.editors.editing import (
    FOUND,
    HERE,
    ROBOT,
    YAMAROS,
    drive,
    found_by,
    write_found,
    write_robot,
)
from tests.waiting import PATIENCE


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
    path = write_robot(tmp_path)
    told = drive(
        [VERSIONS[version], "--clean", "--headless", str(path), "-c", f"luafile {HERE}/nvim.lua"],
        tmp_path,
        {"XDG_STATE_HOME": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path)},
    )
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
    assert told["offered"] == {
        "joint: {type: re": "revolute",
        "joint: {type: fixed, parent: ba": "base",
        "joint: {type: fixed, xyz: 0 0 $(le": "reach",
        "Ar": "Arm",
        "include: le": "leg.yaml",
        "include: package://ro": "rover_description",
    }
    assert told["refused"].startswith("'made' is assigned in `process` at ")
    assert told["highlights"] == 4
    assert "the joint to the parent" in told["manual"]
    assert told["xacro diagnostic"] == [7, "xacro-undefined"]
    assert told["xacro definition"] == '  <xacro:property name="width" value="0.1"/>'
    assert '<xacro:property name="width" value="0.1">' in told["xacro hover"]
    assert told["xacro fixed"] == '      <origin xyz="0 ${width} 0"/>'
    assert told["fixed"] == "    joint: {type: fixed, parent: base, xyz: 0 0 $(reach)}"
    assert told["signature"] == ["Arm(side, size=1)", 1]
    assert told["folds"] > 5
    assert told["links"] == 2
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
    path = write_robot(tmp_path).rename(tmp_path / "rover.yaml")
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


@pytest.mark.skipif("0.11" not in VERSIONS, reason="needs Neovim 0.11")
def test_neovim_finds_the_files_that_are_yamaros(tmp_path):
    write_found(tmp_path)
    setup = HERE.parents[1] / "editors" / "nvim" / "yamaro.lua"
    names = ", ".join(f"'{name}'" for name in FOUND)
    show = f"""for _, name in ipairs({{ {names} }}) do
      vim.cmd.edit(name)
      io.stdout:write(name .. ' ' .. vim.bo.filetype .. '\\n')
    end"""
    commands = [f"luafile {setup}", "lua vim.lsp.enable('yamaro', false)", f"lua {show}", "qall!"]
    done = subprocess.run(
        [VERSIONS["0.11"], "--clean", "--headless", *(f"+{each}" for each in commands)],
        cwd=tmp_path,
        env={**os.environ, "HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert found_by(done, "yamaro") == YAMAROS, done.stderr
