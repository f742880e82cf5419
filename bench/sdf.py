"""Writes a corpus of public robots in SDFormat, and asks others what they make of it.

    python bench/sdf.py [CORPUS] [--only REGEX] [--positions N]

Each robot of the corpus (its URDF, and what xacro makes of its xacro files) is written in SDFormat
1.9 and 1.11. Drake reads it. At random positions of its joints, the poses of all links and frames,
the mass matrix and the inverse dynamics are compared with those of pinocchio, which reads the URDF;
so are total mass, limits and damping. Debian's libsdformat reads version 1.9 (`ign sdf -k`). Each
element and value is looked up in its descriptions of them.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.verdicts import built, run  # noqa: E402 - after the path

from tests.consumers import sdf_judges  # noqa: E402


def judged(path: Path, folder: Path, positions: int) -> str:
    """Return what became of a robot: "agrees", or why not."""
    build = built(path)
    urdf = folder / "robot.urdf"
    urdf.write_text(build.xml(), encoding="utf-8")
    for version in ("1.9", "1.11"):
        made = built(path, target="sdf", sdf_version=version)
        text = made.xml()
        sdf = folder / f"robot-{version}.sdf"
        sdf.write_text(text, encoding="utf-8")
        complaint = sdf_judges.complaint_of_description(text)
        if complaint and "<gazebo" in build.xml():
            complaint = ""  # contents of plugins and sensors are copied
        if not complaint and version == "1.9" and shutil.which("ign"):
            complaint = sdf_judges.complaint_of_libsdformat(sdf)
        if complaint:
            return f"{version} not accepted: {complaint}"
    return sdf_judges.disagreement(urdf, sdf, build.robot, made.losses, positions=positions)


if __name__ == "__main__":
    run(__doc__, judged)
