"""`yamaro lsp` in Emacs with eglot, asserted on what its buffers hold.

`scripts/editors --install` installs it; without it the test is skipped.
"""

from __future__ import annotations

import os
import shutil
import subprocess
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

SETUP = HERE.parents[1] / "editors" / "emacs" / "yamaro.el"
ELPA = Path("/usr/share/emacs/site-lisp/elpa")


def _has_eglot() -> bool:
    return shutil.which("emacs") is not None and bool(list(ELPA.glob("eglot-*")))


@pytest.mark.slow
@pytest.mark.skipif(not _has_eglot(), reason="needs Emacs with eglot")
def test_features_work_in_eglot(tmp_path):
    path = write_robot(tmp_path)
    told = drive(
        ["emacs", "-Q", "--batch", "-l", str(HERE / "eglot.el")],
        tmp_path,
        {
            "HOME": str(tmp_path),
            "LANG": "C.UTF-8",
            "YAMARO_FILE": str(path),
            "YAMARO_SETUP": str(SETUP),
        },
    )
    assert told["mode"] == "yamaro-mode"
    assert "did you mean 'base_link'" in told["diagnostic"]
    assert told["definition"] == "  length: 0.5"
    assert told["renamed"] == ROBOT.replace("bse", "base").replace("length", "reach")
    assert told["completed"] == "    joint: {type: "
    assert told["fixed"] == "    joint: {type: fixed, parent: base, xyz: 0 0 $(reach)}"
    assert told["formatted"] == "robot: rover"
    assert "mass 6 kg" in told["hover"]
    assert told["symbols"] > 1
    assert told["references"] == 4
    assert told["signature"] == "Arm(side, size=1)"
    assert told["refused"].startswith("'made' is assigned in `process` at ")
    assert "name 'widht' is not defined" in told["xacro diagnostic"]
    assert told["xacro definition"] == '  <xacro:property name="width" value="0.1"/>'
    assert '<xacro:property name="width" value="0.1">' in told["xacro hover"]


@pytest.mark.skipif(not _has_eglot(), reason="needs Emacs with eglot")
def test_emacs_finds_the_files_that_are_yamaros(tmp_path):
    write_found(tmp_path)
    show = f"""(progn
      (add-to-list 'package-directory-list "{ELPA}") (package-initialize) (load "{SETUP}")
      (remove-hook 'yamaro-mode-hook #'eglot-ensure)
      (dolist (name (list {" ".join(f'"{name}"' for name in FOUND)}))
        (find-file name) (princ (format "%s %s\\n" name major-mode))))"""
    done = subprocess.run(
        ["emacs", "-Q", "--batch", "-l", "package", "--eval", show],
        cwd=tmp_path,
        env={**os.environ, "HOME": str(tmp_path), "LANG": "C.UTF-8"},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert found_by(done, "yamaro-mode") == YAMAROS, done.stderr
