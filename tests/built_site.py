"""The site with the playground in it: built once, however many processes of a run show it."""

from __future__ import annotations

import fcntl
import subprocess
from pathlib import Path

import pytest

from tests.waiting import PATIENCE

ROOT = Path(__file__).parents[1]
SITE = ROOT / "build" / "site"


def build_site(temporary: pytest.TempPathFactory) -> str:
    """Build the site, unless this run has; return what the script printed."""
    ours = temporary.getbasetemp()
    of_all = ours.parent if ours.name.startswith("popen-") else ours  # with xdist
    printed = of_all / "site.txt"
    with (of_all / "site.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not printed.exists():
            made = subprocess.run(
                ["scripts/site"],
                cwd=ROOT,
                capture_output=True,
                text=True,
                timeout=3 * PATIENCE,
                check=False,
            )
            if "cannot be had" in made.stderr:
                pytest.skip(made.stderr.strip())
            assert made.returncode == 0, made.stdout[-3000:] + made.stderr[-3000:]
            printed.write_text(made.stdout)
        return printed.read_text()
