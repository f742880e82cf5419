"""`yamaro lsp` in Emacs with eglot, asserted on what its buffers hold.

`scripts/editors --install` installs it; without it the test is skipped.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.editors.test_nvim import ROBOT
from tests.waiting import PATIENCE

HERE = Path(__file__).parent
SETUP = HERE.parents[1] / "editors" / "emacs" / "yamaro.el"
ELPA = Path("/usr/share/emacs/site-lisp/elpa")


def _has_eglot() -> bool:
    return shutil.which("emacs") is not None and bool(list(ELPA.glob("eglot-*")))


@pytest.mark.slow
@pytest.mark.skipif(not _has_eglot(), reason="needs Emacs with eglot")
def test_features_work_in_eglot(tmp_path):
    (tmp_path / "leg.yaml").write_text("model:\n")
    path = tmp_path / "rover.urdf.yaml"
    path.write_text(ROBOT)
    result = tmp_path / "result.json"
    done = subprocess.run(
        ["emacs", "-Q", "--batch", "-l", str(HERE / "eglot.el")],
        cwd=tmp_path,
        env={
            **os.environ,
            "HOME": str(tmp_path),
            "LANG": "C.UTF-8",
            "YAMARO_COMMAND": json.dumps([sys.executable, "-m", "yamaro", "lsp"]),
            "YAMARO_FILE": str(path),
            "YAMARO_RESULT": str(result),
            "YAMARO_SETUP": str(SETUP),
        },
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert result.exists(), done.stdout + done.stderr
    told = json.loads(result.read_text(encoding="utf-8"))
    assert "fault" not in told, (told, done.stderr)
    assert [key for key, value in told.items() if key.startswith("reached") and not value] == []
    assert told["mode"] == "yamaro-mode"
    assert "did you mean 'base_link'" in told["diagnostic"]
    assert told["definition"] == "  length: 0.5"
    assert told["renamed"] == ROBOT.replace("bse", "base").replace("length", "reach")
    assert told["completed"] == "    joint: {type: "
    assert told["fixed"] == "    joint: {type: fixed, parent: base, xyz: 0 0 $(reach)}"
    assert told["formatted"] == "robot: rover"
    assert "mass 6 kg" in told["hover"]
    assert told["symbols"] > 1
