"""Checks for a corpus of public robots that each loss in an output format is reported.

    python bench/losses.py [FORMAT ...] [--corpus CORPUS] [--only REGEX] [--show N]

For each robot and format: (the features of the input) − (those that are read back from the output)
has to be what is reported as lost, approximated or renamed. Features are things such as a link, a
mass, a limit, a shape or a plugin. Their readers, bench/features/, know the formats and nothing of
Yamaro. A feature that is missing in the output must lie in an element at which a loss is
reported; at an element that is reported as lost, a feature must be missing.

Inputs are the URDF files of the corpus, and what xacro makes of its xacro files.
"""

from __future__ import annotations

import argparse
import csv
import re
import sys
import traceback
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.features import mjcf, sdf, urdf  # noqa: E402
from bench.features.feature import Feature, Key, rounded  # noqa: E402

import yamaro  # noqa: E402 - after the path
from yamaro.result import Build  # noqa: E402

NAMELESS = frozenset(
    ("gazebo", "in shape", "in sensor", "visual", "collision", "color", "texture", "plugin")
)
"""Features that do not say whose they are: one that is missing may be any of them."""
READERS = {"sdf": sdf.read, "mjcf": mjcf.read}
MESHES = {"sdf": "keep", "mjcf": "none"}
"""MuJoCo's format needs the files of meshes, which the corpus does not have."""


def robots(corpus: Path) -> Iterator[Path]:
    """Yield the URDF files of the corpus."""
    with (corpus / "urdf.tsv").open(encoding="utf-8", newline="") as file:
        yield from (corpus / "src" / row["path"] for row in csv.DictReader(file, delimiter="\t"))
    yield from sorted((corpus / "expected").rglob("*.urdf"))


class Verdict:
    """What was found for a robot in a format.

    Attributes:
        silent: features that are missing and not reported.
        invented: losses where nothing is missing, as texts.
        told: how many features are missing and reported.
        kept: how many features are in the output.
    """

    def __init__(self) -> None:
        self.silent: list[Feature] = []
        self.invented: list[str] = []
        self.told = 0
        self.kept = 0


def compare(text: str, build: Build, format: str, *, has_meshes: bool) -> Verdict:
    """Return what is missing in an output, and what is reported."""
    features = urdf.read(text, has_meshes=has_meshes)
    names = {
        loss.owner.rpartition(" ")[2].strip("'"): loss.how
        for loss in build.losses
        if loss.kind == "renamed"
    }
    found: Counter[Key] = Counter(map(rounded, READERS[format](build.xml(), names)))
    groups: dict[Key, list[Feature]] = defaultdict(list)
    for feature in features:
        groups[rounded(feature.key)].append(feature)
    places = {loss.span.start for loss in build.losses}
    verdict = Verdict()
    missing_at: set[int] = set()
    for key, group in groups.items():
        if key[0] == "optional":
            missing_at.update(place for each in group for place in each.places)
            continue
        missing = max(0, len(group) - found[key])
        verdict.kept += len(group) - missing
        reported = [each for each in group if not places.isdisjoint(each.places)]
        verdict.told += min(missing, len(reported))
        if missing:
            missing_at.update(place for each in reported for place in each.places)
        if key[0] in NAMELESS:
            missing_at.update(place for each in group for place in each.places)
            rest = [each for each in group if places.isdisjoint(each.places)]
            verdict.silent += rest[: max(0, missing - len(reported))]
    for loss in build.losses:
        if loss.kind == "lost" and loss.span.start not in missing_at:
            verdict.invented.append(f"{loss.what}: {loss.owner} at {loss.span.place()}")
    return verdict


def built(path: Path, format: str) -> Build | str:
    """Return a robot in a format, or why it is not written."""
    try:
        return yamaro.build(
            path, target=format, meshes=MESHES[format], on_message=lambda line: None
        )
    except yamaro.YamaroError as error:
        first = next(each for each in error.diagnostics if each.severity == "error")
        return first.code


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formats", nargs="*", default=list(READERS))
    parser.add_argument("--corpus", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="")
    parser.add_argument("--show", type=int, default=5)
    wanted = parser.parse_args()
    has_failed = False
    for format in wanted.formats:
        counts: Counter[str] = Counter()
        refused: Counter[str] = Counter()
        for path in robots(wanted.corpus):
            if not re.search(wanted.only, str(path)):
                continue
            has_failed |= judge(path, format, counts, refused, wanted.show, wanted.corpus)
        print(f"\n{format}: " + ", ".join(f"{counts[name]:,} {name}" for name in NAMES))
        for code, count in refused.most_common():
            print(f"  {count:5d} refused: {code}")
    return 1 if has_failed else 0


NAMES = (
    "robots", "features kept", "told", "silent", "invented", "robots that are honest",
    "faults of ours",
)  # fmt: skip


def judge(
    path: Path, format: str, counts: Counter[str], refused: Counter[str], show: int, corpus: Path
) -> bool:
    """Count what was found for a robot; return whether it is not what it should be."""
    counts["robots"] += 1
    name = f"{format}: {path.relative_to(corpus)}"
    try:
        build = built(path, format)
        if isinstance(build, str):
            refused[build] += 1
            return False
        text = path.read_bytes().decode().removeprefix("\ufeff")
        if urdf.is_xacro(text):
            counts["robots"] -= 1
            return False
        verdict = compare(text, build, format, has_meshes=MESHES[format] != "none")
    except Exception:
        counts["faults of ours"] += 1
        print(f"{name}: {traceback.format_exc(limit=-3)}")
        return True
    counts["features kept"] += verdict.kept
    counts["told"] += verdict.told
    counts["silent"] += len(verdict.silent)
    counts["invented"] += len(verdict.invented)
    for feature in verdict.silent[:show]:
        print(f"{name}: SILENT {feature}")
    for invented in verdict.invented[:show]:
        print(f"{name}: INVENTED {invented}")
    is_honest = not (verdict.silent or verdict.invented)
    counts["robots that are honest"] += is_honest
    return not is_honest


if __name__ == "__main__":
    sys.exit(main())
