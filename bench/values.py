"""Changes values of public robots, one at a time, and asks whether each format shows it.

    python bench/values.py [FORMAT ...] [--corpus CORPUS] [--every N] [--times N]

A value is an attribute or a text of a URDF. Its kind is where it is: the names of the elements
around it. Of each kind, a few values are changed, in different robots. Then the output has to be
another one, or report other losses, or have reported a loss at the value or at an element around
it.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.features import urdf  # noqa: E402 - after the path
from bench.losses import MESHES, text_of  # noqa: E402
from bench.verdicts import robots  # noqa: E402

import yamaro  # noqa: E402
from yamaro.result import Build  # noqa: E402

FORMATS = ("mjcf", "sdf", "usd")
NAMES = ("name", "link", "joint", "reference", "filename")
"""Attributes that name something: with another value, the robot is another one."""
IGNORED = re.compile(
    r"/axis@xyz|/link@type|umping|/mean$|/noise/type|always_on|/noise.*@type|/mechanical(_reduction|Reduction)"
)
"""Kinds of which only some values mean anything, such as the length of an axis; and the reduction
of a gear, since outputs are about the joint."""
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?", re.IGNORECASE)


class Value:
    """A value of a URDF: its kind, where it begins and ends, and the places of what is around."""

    def __init__(self, kind: str, start: int, text: str, places: frozenset[int]) -> None:
        self.kind = kind
        self.start = start
        self.text = text
        self.places = places | {start}

    def changed(self) -> list[str]:
        """Return other values: for each number, one in which that is another one."""
        text, found = self.text, []
        for each in NUMBER.finditer(text):
            number = f"{float(each[0]) * 0.9 + 0.013:.6g}"
            found.append(text[: each.start()] + number + text[each.end() :])
        if len(found) == len(self.text.split()):
            return found
        return [f"{self.text}x"]


def values(text: str) -> Iterator[Value]:
    """Yield the values of a URDF that do not name anything."""
    pending = [("", each) for each in urdf.tree(text).children]
    for path, node in pending:
        own = f"{path}/{node.name}"
        if node.name in ("visual", "collision") and _is_mesh(node):
            continue  # they are left out
        pending += [(own, child) for child in node.children]
        for name, value in node.attributes.items():
            for start in node.value_place(name):
                if name not in NAMES and text.startswith(value, start) and value.strip():
                    match = re.search(rf"\b{re.escape(name)}\s*=", node.tag)
                    at = frozenset((node.place + match.start(),)) if match else frozenset()
                    yield Value(f"{own}@{name}", start, value, node.places() | at)
        inner = node.text.strip()
        if inner and not node.children and text.startswith(inner, node.text_place):
            yield Value(own, node.text_place, inner, node.places())


def _is_mesh(shape: urdf.Node) -> bool:
    geometry = shape.first("geometry")
    return geometry is None or geometry.first("mesh") is not None


def built(path: Path, text: str, formats: list[str]) -> dict[str, Build]:
    """Return a robot in the formats that can be written."""
    found = {}
    for format in formats:
        try:
            found[format] = yamaro.build(
                path,
                text=text,
                target=format,
                meshes=MESHES[format],
                base="fixed",
                on_message=lambda line: None,
            )
        except yamaro.YamaroError:
            continue
    return found


def shown(build: Build) -> object:
    losses = {(each.kind, each.what, each.owner, each.how) for each in build.losses}
    return build.xml(), build.assets, losses


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("formats", nargs="*", default=list(FORMATS))
    parser.add_argument("--corpus", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--times", type=int, default=2)
    wanted = parser.parse_args()
    seen: Counter[str] = Counter()
    silent: Counter[tuple[str, str]] = Counter()
    for path in list(robots(wanted.corpus))[:: wanted.every]:
        text = text_of(path)
        if urdf.is_xacro(text):
            continue
        chosen = {
            each.kind: each
            for each in values(text)
            if seen[each.kind] < wanted.times and not IGNORED.search(each.kind)
        }
        before = built(path, text, wanted.formats) if chosen else {}
        for value in chosen.values() if before else ():
            seen[value.kind] += 1
            for other in value.changed():
                changed = text[: value.start] + other + text[value.start + len(value.text) :]
                after = built(path, changed, list(before))
                for format, build in after.items():
                    if shown(build) != shown(before[format]):
                        continue
                    if any(each.span.start in value.places for each in before[format].losses):
                        continue
                    silent[format, value.kind] += 1
                    name = path.relative_to(wanted.corpus)
                    print(f"{format}: {name}: SILENT {value.kind}: '{value.text}' to '{other}'")
    print(f"{sum(seen.values()):,} values of {len(seen):,} kinds, {len(silent):,} kinds silent")
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main())
