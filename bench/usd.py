"""Writes a corpus of public robots in USD, and asks OpenUSD and pinocchio what they make of it.

    python bench/usd.py [CORPUS] [--only REGEX] [--positions N]

OpenUSD's validators look at each file. At random positions of the joints, the poses of links and
frames and the mass matrix are compared with those that pinocchio finds in the URDF, to 1e-5: USD
has single precision.
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.verdicts import built, run  # noqa: E402 - after the path

from tests.consumers import usd_judges  # noqa: E402

TOLD = "floating joints"
"""A loss by which a robot moves otherwise."""


def judged(path: Path, folder: Path, positions: int) -> str:
    """Return what became of a robot: "", or what is wrong."""
    build = built(path)
    made = built(path, target="usd")
    usd = folder / f"robot{len(list(folder.iterdir()))}.usda"  # OpenUSD keeps what it has read
    usd.write_text(made.xml(), encoding="utf-8")
    complaints = usd_judges.complaints_of(usd)
    if complaints:
        return f"not accepted: {complaints[0]}"
    if TOLD in {loss.what for loss in made.losses}:
        return f"differs, as reported: {TOLD}"
    placeholders = sum(loss.what == "links without mass" for loss in made.losses)
    return usd_judges.disagreement(
        build.xml(), usd, build.robot, positions=positions, placeholders=placeholders
    )


if __name__ == "__main__":
    run(__doc__, judged)
