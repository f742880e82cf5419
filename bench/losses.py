"""Checks for a corpus of public robots that each loss in an output format is reported.

    python bench/losses.py [FORMAT ...] [--corpus CORPUS] [--only REGEX] [--show N] [--every N]

For each robot and format: (the features of the input) − (those that are read back from the output)
has to be what is reported as lost, approximated or renamed. Features are things such as a link, a
mass, a limit, a shape or a plugin. Their readers, bench/features/, know the formats and nothing of
Yamaro. A feature that is missing in the output must lie in an element at which a loss is
reported; at an element that is reported as lost, a feature must be missing.

Inputs are the URDF files of the corpus, and what xacro makes of its xacro files. URDF says nothing
of what SRDF holds: there, groups, states and pairs of links to keep are added to each robot.
"""

from __future__ import annotations

import argparse
import re
import sys
import traceback
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.features import mjcf, sdf, srdf, urdf  # noqa: E402
from bench.features.feature import Feature, Key, nearest  # noqa: E402
from bench.verdicts import robots  # noqa: E402

import yamaro  # noqa: E402 - after the path
from yamaro.result import Build  # noqa: E402

NAMELESS = frozenset(
    (
        *("gazebo", "in shape", "in sensor", "visual", "collision", "shape name", "color"),
        *("texture", "plugin"),
    )
)
"""Features that do not say whose they are: one that is missing may be any of them."""
COUNTED = frozenset(("visual", "collision", "mimic"))
"""Features that an output has no more of than the input."""


def _read_usd(text: str, own: Mapping[str, str]) -> Iterator[Key]:
    from bench.features import usd  # which needs usd-core

    return usd.read(text, own)


READERS = {"sdf": sdf.read, "mjcf": mjcf.read, "usd": _read_usd, "srdf": srdf.read}
MESHES = {"sdf": "keep", "mjcf": "none", "usd": "none", "srdf": "none"}
"""Formats other than SDF need the files of meshes, which the corpus does not have."""
TOLERANCES = {"sdf": 1e-9, "mjcf": 1e-9, "usd": 1e-6, "srdf": 1e-9}
"""How far numbers may be off, as part of them: USD has single precision."""


class Verdict:
    """What was found for a robot in a format.

    Attributes:
        silent: features that are missing and not reported.
        invented: losses where nothing is missing, as texts.
        added: features that are in the output and not in the input.
        told: how many features are missing and reported.
        kept: how many features are in the output.
    """

    def __init__(self) -> None:
        self.silent: list[Feature] = []
        self.invented: list[str] = []
        self.added: list[str] = []
        self.told = 0
        self.kept = 0


def compare(features: Iterable[Feature], build: Build, format: str) -> Verdict:
    """Return what is missing in an output, and what is reported."""
    names = {
        new: re.sub(r".*?'(.*?)'($| of link .*)", r"\1", loss.owner)
        for loss in build.losses
        if loss.kind == "renamed"
        for new in (loss.how, *loss.how.split(", "))  # a joint of several numbers is several
    }
    groups: dict[Key, list[Feature]] = defaultdict(list)
    for feature in features:
        groups[feature.key].append(feature)
    read = READERS[format](build.xml(), names)
    found: Counter[Key] = Counter(nearest(read, groups, TOLERANCES[format]))
    for key in groups:  # in SRDF, a pair is kept by saying nothing of it
        if key[0] == "kept":
            found[key] = 1 - found[("disabled", *key[1:])]
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
    for key, count in found.items():
        if key[0] in COUNTED and count > len(groups[key]):
            verdict.added.append(" ".join(map(str, key)))
    for loss in build.losses:
        if loss.kind == "lost" and loss.span.start not in missing_at:
            verdict.invented.append(f"{loss.what}: {loss.owner} at {loss.span.place()}")
    return verdict


def built(path: Path, format: str) -> tuple[Build | str, list[Feature]]:
    """Return a robot in a format, or why it is not written, and its features."""
    text = text_of(path)
    given = None
    if format == "srdf":
        planted = srdf.Planted(path, text)
        features, path = planted.features, path.with_suffix(".yaml")
        given = planted.text
    else:
        features = urdf.read(text, has_meshes=MESHES[format] != "none")
    try:
        build = yamaro.build(
            path, target=format, meshes=MESHES[format], on_message=lambda line: None, text=given
        )
    except yamaro.YamaroError as error:
        first = next(each for each in error.diagnostics if each.severity == "error")
        return first.code, []
    return build, features


def text_of(path: Path) -> str:
    """Return the text of a URDF."""
    return path.read_bytes().decode().removeprefix("\ufeff")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formats", nargs="*", default=list(READERS))
    parser.add_argument("--corpus", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="")
    parser.add_argument("--show", type=int, default=5)
    parser.add_argument("--every", type=int, default=1, help="takes only each N-th robot")
    wanted = parser.parse_args()
    has_failed = False
    for format in wanted.formats:
        counts: Counter[str] = Counter()
        refused: Counter[str] = Counter()
        for path in list(robots(wanted.corpus))[:: wanted.every]:
            if not re.search(wanted.only, str(path)):
                continue
            has_failed |= judge(path, format, counts, refused, wanted.show, wanted.corpus)
        print(f"\n{format}: " + ", ".join(f"{counts[name]:,} {name}" for name in NAMES))
        for code, count in refused.most_common():
            print(f"  {count:5d} refused: {code}")
    return 1 if has_failed else 0


NAMES = (
    "robots", "features kept", "told", "silent", "invented", "added", "robots that are honest",
    "faults of ours",
)  # fmt: skip


def judge(
    path: Path, format: str, counts: Counter[str], refused: Counter[str], show: int, corpus: Path
) -> bool:
    """Count what was found for a robot; return whether it is not what it should be."""
    counts["robots"] += 1
    name = f"{format}: {path.relative_to(corpus)}"
    try:
        if urdf.is_xacro(text_of(path)):
            counts["robots"] -= 1
            return False
        build, features = built(path, format)
        if isinstance(build, str):
            refused[build] += 1
            return False
        verdict = compare(features, build, format)
    except Exception:
        counts["faults of ours"] += 1
        print(f"{name}: {traceback.format_exc(limit=-3)}")
        return True
    counts["features kept"] += verdict.kept
    counts["told"] += verdict.told
    counts["silent"] += len(verdict.silent)
    counts["invented"] += len(verdict.invented)
    counts["added"] += len(verdict.added)
    for feature in verdict.silent[:show]:
        print(f"{name}: SILENT {feature}")
    for invented in verdict.invented[:show]:
        print(f"{name}: INVENTED {invented}")
    for added in verdict.added[:show]:
        print(f"{name}: ADDED {added}")
    is_honest = not (verdict.silent or verdict.invented or verdict.added)
    counts["robots that are honest"] += is_honest
    return not is_honest


if __name__ == "__main__":
    sys.exit(main())
