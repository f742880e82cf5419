"""Formats all files there are with `yamaro fmt`, and compares them before and after.

    python bench/style.py [CORPUS] [--only REGEX]

The files are the examples, those in the docs, the golden cases, what is in bench/ and tests/, and
all that `yamaro migrate` makes of a corpus of public robots, each as it is and with all indentation
doubled. A second time has to change nothing; nodes, their order and style, and comments have to be
as before; so have output and warnings, where a file is a program. The examples and what is migrated
have to be in the style already. A file of 5,000 lines has to be formatted within a second.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from lsp import robot
from robots import ROOT, Corpus

import yamaro
from tests.fenced import read_blocks
from tests.golden import find_cases, read_options
from tests.tools.test_format import build_of, laid_out
from yamaro.layout import formatted
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.tools.migrate.urdf import migrate_file
from yamaro.tools.migrate.xacro.command import migrate_robot
from yamaro.xml.reader import decode_xml
from yamaro.yaml.comments import find_comments

LINES = 5000
MOST_SECONDS = 1.0
RUNS = 5
INDENTATION = re.compile(r"^( *)((?:- )*)", re.MULTILINE)
KEPT = re.compile(r"[|>][-+0-9]*\s*(#.*)?$|^ *\? ", re.MULTILINE)
"""What begins a text whose lines keep their distance from the first."""


class Tally:
    """What came of the files of one kind."""

    def __init__(self, kind: str, *, is_styled: bool) -> None:
        self.kind = kind
        self.is_styled = is_styled
        self.counts: Counter[str] = Counter()
        self.wrong: list[str] = []

    def add(self, name: str, text: str) -> str | None:
        """Format a text; return it formatted, or None if it is not YAML."""
        try:
            new = laid_out(text)
        except yamaro.YamaroError:
            self.counts["not YAML"] += 1
            return None
        except AssertionError as error:
            self.wrong.append(f"{self.kind}: {name}: {str(error).splitlines()[0]}")
            return None
        self.counts["right"] += 1
        self.counts["in the style"] += new == text
        if self.is_styled and new != text:
            self.wrong.append(f"{self.kind}: {name}: not in the style")
        return new

    def add_output(self, name: str, is_same: bool) -> None:
        self.counts["same output"] += is_same
        if not is_same:
            self.wrong.append(f"{self.kind}: {name}: another output")

    def row(self) -> str:
        names = ("right", "in the style", "same output", "not YAML")
        return f"| {self.kind} | " + " | ".join(str(self.counts[name]) for name in names) + " |"


def files(*folders: str) -> Iterator[tuple[str, str]]:
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*.y*ml")):
            data = path.read_bytes()
            try:
                yield str(path.relative_to(ROOT)), data.decode()
            except UnicodeDecodeError:
                continue


def documents() -> Iterator[tuple[str, str]]:
    for path in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        for block in read_blocks(path.read_text(encoding="utf-8")):
            if block.language == "yaml":
                yield f"{path.name}:{block.line}", block.text


def cases(tally: Tally) -> None:
    for path in find_cases():
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        name = str(path.relative_to(ROOT))
        new = tally.add(name, text)
        if new is not None and "limit" not in read_options(path).get("args", ""):
            os.chdir(path.parent)
            tally.add_output(name, build_of(path, new) == build_of(path, text))


def migrated(corpus: Corpus) -> Iterator[tuple[str, str, bool]]:
    """Yield the files that `yamaro migrate` makes, and whether it has written or copied them."""
    for row in corpus.rows("urdf.tsv"):
        yield row["path"], migrate_file(str(corpus.path(row)), Limits()).text, True
    for row in corpus.rows("xacro.tsv"):
        path = corpus.path(row)
        os.chdir(path.parent)
        with tempfile.TemporaryDirectory() as folder:
            migration = migrate_robot(
                decode_xml(path.read_bytes(), name=path.name, path=str(path)),
                folder,
                arguments=[f"{name}:={value}" for name, value in corpus.arguments(row).items()],
                packages=corpus.packages(row),
                limits=Limits(),
            )
        written = set(migration.origins.values())
        for name, text in migration.files.items():
            if name.endswith((".yaml", ".yml")):
                yield f"{row['path']}: {name}", text, name in written


def doubled(text: str) -> str:
    """Return a text with all its indentation doubled, that after dashes too."""
    return INDENTATION.sub(lambda m: 2 * m[1] + m[2].replace("- ", "-   "), text)


def seconds(text: str) -> float:
    """Return the shortest time of the processor that a text was formatted in."""
    found = []
    for _ in range(RUNS):
        began = time.process_time()
        formatted(Source(text, name="robot.yaml"))
        found.append(time.process_time() - began)
    return min(found)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="", help="robots whose path has this regular expression")
    options = parser.parse_args()
    os.environ.update(ROS_VERSION="2", ROS_DISTRO="humble")
    tallies = []

    def tally(kind: str, *, is_styled: bool = False) -> Tally:
        tallies.append(Tally(kind, is_styled=is_styled))
        return tallies[-1]

    for kind, rows, is_styled in (
        ("examples", files("examples"), True),
        ("docs", documents(), False),
        ("files of tests and bench", files("bench", "tests/hostile", "tests/fuzz"), False),
    ):
        kept = tally(kind, is_styled=is_styled)
        for name, text in rows:
            kept.add(name, text)
    cases(tally("cases"))
    if options.corpus.exists():
        made = tally("migrated", is_styled=True)
        twice = tally("migrated, with doubled indentation")
        copied = tally("data that xacro files load")
        for name, text, is_written in migrated(Corpus(options.corpus.resolve(), options.only)):
            if not is_written:
                copied.add(name, text)
                continue
            made.add(name, text)
            new = twice.add(name, doubled(text))
            if new is not None and not KEPT.search(text) and new != text:
                twice.wrong.append(f"{twice.kind}: {name}: not as it was before")
    print("| files | as before | in the style | same output | not YAML |\n|---|--:|--:|--:|--:|")
    for each in tallies:
        print(each.row())
    text = robot(LINES)
    remarked = re.sub(r"(?m)$", "  # a comment", text)
    assert find_comments(Source(remarked, name="robot.yaml"), remarked)
    longest = 0.0
    for what, content in (("plain", text), ("a comment in each line", remarked)):
        least = seconds(content)
        longest = max(longest, least)
        print(f"\n{content.count(chr(10))} lines, {what}: {least * 1000:.0f} ms of the processor")
    wrong = [each for kept in tallies for each in kept.wrong]
    print("", *wrong, sep="\n")
    sys.exit(1 if wrong or longest > MOST_SECONDS else 0)


if __name__ == "__main__":
    main()
