"""Writes a corpus of public robots in USD, and asks OpenUSD and pinocchio what they make of it.

    python bench/usd.py [CORPUS] [--only REGEX] [--positions N]

OpenUSD's validators look at each file. At random positions of the joints, the poses of links and
frames and the mass matrix are compared with those that pinocchio finds in the URDF, to 1e-5: USD
has single precision.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.sdf import robots  # noqa: E402

import yamaro  # noqa: E402 - after the path
from tests.consumers import usd_judges  # noqa: E402

TOLD = frozenset(("links without mass", "inertias of links without mass", "floating joints"))


def judged(path: Path, usd: Path, positions: int) -> str:
    """Return what became of a robot: "agrees", or why not."""
    try:
        build = yamaro.build(path, meshes="none", on_message=lambda line: None)
        made = yamaro.build(path, target="usd", meshes="none", on_message=lambda line: None)
    except yamaro.YamaroError as error:
        errors = [each for each in error.diagnostics if each.severity == "error"]
        return f"refused: {errors[0].code}"
    usd.write_text(made.xml(), encoding="utf-8")
    complaints = usd_judges.complaints_of(usd)
    if complaints:
        return f"not accepted: {complaints[0]}"
    told = TOLD & {loss.what for loss in made.losses}
    if told:
        return f"differs, as reported: {sorted(told)[0]}"
    return usd_judges.disagreement(build.xml(), usd, build.robot, positions=positions) or "agrees"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="")
    parser.add_argument("--positions", type=int, default=20)
    wanted = parser.parse_args()
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number, path in enumerate(robots(wanted.corpus)):
            if not re.search(wanted.only, str(path)):
                continue
            usd = Path(folder, f"robot{number}.usda")  # OpenUSD keeps what it has read
            try:
                verdict = judged(path, usd, wanted.positions)
            except Exception as error:
                verdict = f"ERROR {type(error).__name__}: {str(error).splitlines()[0][:200]}"
            counts[verdict if verdict.startswith(("refused", "differs")) else verdict[:40]] += 1
            if verdict != "agrees":
                print(f"{path.relative_to(wanted.corpus)}: {verdict}", flush=True)
    for verdict, count in counts.most_common():
        print(f"{count:5d}  {verdict}")


if __name__ == "__main__":
    main()
