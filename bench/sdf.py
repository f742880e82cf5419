"""Writes a corpus of public robots in SDFormat, and asks others what they make of it.

    python bench/sdf.py [CORPUS] [--only REGEX] [--positions N]

Each robot of the corpus (its URDF, and what xacro makes of its xacro files) is written in SDFormat
1.9 and 1.11. Drake reads it. At random positions of its joints, the poses of all links and frames,
the mass matrix and the inverse dynamics are compared with those of pinocchio, which reads the URDF;
so are total mass, limits and damping. Debian's libsdformat reads version 1.9 (`ign sdf -k`). Each
element and value is looked up in its descriptions of them.
"""

from __future__ import annotations

import argparse
import csv
import re
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import yamaro  # noqa: E402 - after the path
from tests.consumers import sdf_judges  # noqa: E402


def robots(corpus: Path) -> Iterator[Path]:
    """Yield the URDF files of the corpus."""
    with (corpus / "urdf.tsv").open(encoding="utf-8", newline="") as file:
        yield from (corpus / "src" / row["path"] for row in csv.DictReader(file, delimiter="\t"))
    yield from sorted((corpus / "expected").rglob("*.urdf"))


def judged(path: Path, folder: Path, positions: int) -> str:
    """Return what became of a robot: "agrees", or why not."""
    try:
        build = yamaro.build(path, meshes="none", deny=(), on_message=lambda line: None)
    except yamaro.YamaroError as error:
        return f"refused: {error.diagnostics[0].code}"
    robot = build.robot
    urdf = folder / "robot.urdf"
    urdf.write_text(build.xml(), encoding="utf-8")
    for version in ("1.9", "1.11"):
        made = yamaro.build(
            path, target="sdf", sdf_version=version, meshes="none", on_message=lambda line: None
        )
        text, losses = made.xml(), made.losses
        sdf = folder / f"robot-{version}.sdf"
        sdf.write_text(text, encoding="utf-8")
        complaint = sdf_judges.complaint_of_description(text)
        if complaint and "<gazebo" in build.xml():
            complaint = ""  # contents of plugins and sensors are copied
        if not complaint and version == "1.9" and shutil.which("ign"):
            complaint = sdf_judges.complaint_of_libsdformat(sdf)
        if complaint:
            return f"{version} not accepted: {complaint}"
    found = sdf_judges.disagreement(urdf, sdf, robot, losses, positions=positions)
    return found or "agrees"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="")
    parser.add_argument("--positions", type=int, default=20)
    wanted = parser.parse_args()
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for path in robots(wanted.corpus):
            if not re.search(wanted.only, str(path)):
                continue
            try:
                verdict = judged(path, Path(folder), wanted.positions)
            except Exception as error:
                verdict = f"ERROR {type(error).__name__}: {str(error).splitlines()[0][:200]}"
            kind = verdict.partition(":")[0] if verdict.startswith("refused") else verdict[:60]
            counts[verdict if verdict.startswith("refused") else kind] += 1
            if verdict != "agrees":
                print(f"{path.relative_to(wanted.corpus)}: {verdict}", flush=True)
    for verdict, count in counts.most_common():
        print(f"{count:5d}  {verdict}")


if __name__ == "__main__":
    main()
