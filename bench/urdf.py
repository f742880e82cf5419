"""Writes a corpus of public robots as URDF, and asks urdfdom whether it takes them.

    python bench/urdf.py [CORPUS] [--only REGEX]

`check_urdf` reads each file that is written. What it refuses has to have been reported.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.verdicts import built, run  # noqa: E402 - after the path


def judged(path: Path, folder: Path, _: int) -> str:
    """Return what became of a robot: "", or what is wrong."""
    build = built(path, target="urdf")
    urdf = folder / "robot.urdf"
    urdf.write_text(build.xml(), encoding="utf-8")
    done = subprocess.run(["check_urdf", str(urdf)], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return ""
    reported = sorted({each.code for each in build.warnings})
    return f"refused by check_urdf; reported: {', '.join(reported)}"


if __name__ == "__main__":
    run(__doc__, judged)
