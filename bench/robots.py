"""Brings a corpus of public robots over to Yamaro, and says of each whether it stayed the same.

    python bench/robots.py [CORPUS] [--only REGEX]

CORPUS is a folder with `urdf.tsv` and `xacro.tsv` (by default ../shared/corpus beside the project):
paths of files below its `src/`, and for xacro the arguments, the packages and a file with what
xacro makes of it. Three things are tried:

- each URDF is migrated and built again;
- each robot in xacro is migrated, its sources built with its arguments, and with others
  (bench/others.py);
- each xacro file is included in a Yamaro file that holds nothing else.

The lines of what was migrated are counted as well, and what in them is not as a person would write
it (bench/reading.py). Robots that parsers refuse are built with their own faults allowed, and are
counted too.

Robots are compared by tests/same_robot.py, which knows lxml and nothing of Yamaro.
"""

from __future__ import annotations

import argparse
import csv
import os
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from xml.dom import minidom

from others import Arguments, Others, expanded
from reading import reading_table

import yamaro
from yamaro.policy import Limits
from yamaro.tools.migrate.document import element_key
from yamaro.tools.migrate.urdf import build_allowing, migrate_file
from yamaro.tools.migrate.xacro.command import XacroMigration, migrate_robot
from yamaro.xml.reader import decode_xml

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests.same_robot import is_same_robot  # noqa: E402 - after the path

UNKNOWN = "/opt/ros/unknown/share"
Row = dict[str, str]


class Tally:
    """What came of one kind of trial."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.tried = 0
        self.same = 0
        self.failures: list[str] = []
        self.seconds: list[float] = []
        self.allowed: dict[str, Sequence[str]] = {}

    def add(self, path: str, trial: Callable[[], bool]) -> None:
        """Count a trial, which tells whether a robot stayed the same, or raises why not."""
        self.tried += 1
        began = time.perf_counter()
        try:
            reason = "" if trial() else "differs"
        except Exception as error:
            reason = f"{type(error).__name__}: {str(error).splitlines()[0]}"
        self.seconds.append(time.perf_counter() - began)
        if reason:
            self.failures.append(f"{self.name}: {path}: {reason}")
        else:
            self.same += 1

    def note_allowed(self, path: Path, codes: Sequence[str]) -> None:
        """Note the faults of a robot that had to be allowed."""
        if codes:
            self.allowed[str(path)] = codes

    def row(self) -> str:
        share = 100 * self.same / max(self.tried, 1)
        middle = statistics.median(self.seconds) if self.seconds else 0.0
        return f"| {self.name} | {self.tried} | {self.same} | {share:.1f} % | {middle:.3f} s |"


class Corpus:
    """The robots of a folder."""

    def __init__(self, folder: Path, only: str) -> None:
        self.folder = folder
        self._only = re.compile(only)

    def rows(self, table: str) -> Iterable[Row]:
        """Return the rows of a table that are asked for."""
        with (self.folder / table).open(encoding="utf-8") as file:
            rows = csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
            return [row for row in rows if self._only.search(row["path"])]

    def path(self, row: Row) -> Path:
        return self.folder / "src" / row["path"]

    def real(self, text: str) -> str:
        """Return a text with the places that stand in it as @NAME@."""
        text = text.replace("@CORPUS@/", f"{self.folder}/")
        return text.replace("@UNKNOWN@/", f"{UNKNOWN}/")

    def packages(self, row: Row) -> dict[str, str]:
        """Return the folders of the packages that a robot asks for."""
        pairs = (item.split("=", 1) for item in row["packages"].split(";") if item)
        source = self.folder / "src"
        return {name: str(source / at) if at else f"{UNKNOWN}/{name}" for name, at in pairs}

    def arguments(self, row: Row) -> dict[str, str]:
        return dict(re.findall(r"(\S+?):=(.*?)(?=\s\S+?:=|$)", self.real(row["args"])))


def corpus_asked_for(doc: str | None) -> Corpus:
    """Return the corpus that the command line names, and set what its xacro files read.

    Args:
        doc: what the command does, in its first line.
    """
    parser = argparse.ArgumentParser(description=(doc or "").splitlines()[0])
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    parser.add_argument("--only", default="", help="robots whose path has this regular expression")
    options = parser.parse_args()
    if not options.corpus.exists():
        sys.exit(f"there is no corpus at {options.corpus}")
    os.environ.update(ROS_VERSION="2", ROS_DISTRO="humble")
    return Corpus(options.corpus.resolve(), options.only)


def migrates(path: Path, lines: list[float], texts: dict[str, str], tally: Tally) -> bool:
    """Tell whether a URDF that is migrated and built again is the same; note the share of lines."""
    migration = migrate_file(str(path), Limits())
    texts[str(path)] = migration.text
    source = path.read_bytes()
    lines.append(len(migration.text.splitlines()) / len(source.splitlines()))
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "robot.yaml"
        made.write_text(migration.text, encoding="utf-8")
        xml = yamaro.build(made, on_message=print, allow=migration.allowed, meshes="keep").xml()
    tally.note_allowed(path, migration.allowed)
    return is_same_robot(source, xml.encode())


def migrates_xacro(
    corpus: Corpus,
    row: Row,
    lines: dict[str, tuple[int, int]],
    texts: dict[str, str],
    tally: Tally,
    others: Others,
) -> bool:
    """Tell whether the migrated sources of a robot make what xacro makes of it."""
    path = corpus.path(row)
    os.chdir(path.parent)
    expected = corpus.real((corpus.folder / row["expected"]).read_text(encoding="utf-8"))
    arguments = [f"{name}:={value}" for name, value in corpus.arguments(row).items()]
    packages = corpus.packages(row)
    source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
    with tempfile.TemporaryDirectory() as folder:
        migration = migrate_robot(
            source, folder, arguments=arguments, packages=packages, limits=Limits()
        )
        for name, text in migration.files.items():
            made = Path(folder) / name
            made.parent.mkdir(parents=True, exist_ok=True)
            made.write_text(text, encoding="utf-8")
        for origin, name in migration.origins.items():
            count = len(Path(origin).read_bytes().splitlines())
            texts[origin] = migration.files[name]
            lines[origin] = (count, len(migration.files[name].splitlines()))
        is_told = bool(migration.faults or migration.differences)
        built = yamaro.build(
            Path(folder) / migration.main,
            command_line=arguments,
            packages=packages,
            on_message=lambda line: None,
            allow=migration.allowed,
            meshes="keep",
        )
        tally.note_allowed(path, migration.allowed)
        is_same = is_same_robot(expected.encode(), built.xml().encode())
        try_others(corpus, row, migration, Path(folder), others)
    if not is_same and not is_told:
        raise AssertionError("differs, and nothing says so")
    return is_same


def try_others(
    corpus: Corpus, row: Row, migration: XacroMigration, folder: Path, others: Others
) -> None:
    """Build the sources of a robot with other arguments, and compare that with xacro's."""
    given, packages = corpus.arguments(row), corpus.packages(row)
    files = [*migration.origins, *migration.layout.theirs]
    path = corpus.path(row)
    told = {str(each) for each in (*migration.differences, *migration.faults)}
    told |= {why for _, why, _ in migration.lost}
    others.robots += 1
    for name, value in Arguments(files, given, packages).others():
        arguments = given | {name: value}
        expected = expanded(path, arguments, lambda own: packages.get(own, f"{UNKNOWN}/{own}"))
        if expected is None:
            continue
        line = [f"{own}:={text}" for own, text in arguments.items()]
        try:
            built, _ = build_allowing(
                lambda codes, line=line: yamaro.build(
                    folder / migration.main,
                    command_line=line,
                    packages=packages,
                    on_message=lambda line: None,
                    allow=codes,
                    meshes="keep",
                )
            )
            is_same = is_same_robot(expected.encode(), built.xml().encode())
            result = "same" if is_same else "silent"
        except yamaro.YamaroError:
            result = "told"  # by the error
        if result == "silent" and any(f"{name}:={value}" in each for each in told):
            result = "told"
        others.add(row["path"], f"{name}:={value}", result)


def includes(corpus: Corpus, row: Row) -> bool:
    """Tell whether a Yamaro file that includes a xacro file makes what xacro makes of it."""
    path = corpus.path(row)
    os.chdir(path.parent)
    expected = corpus.real((corpus.folder / row["expected"]).read_text(encoding="utf-8"))
    root = minidom.parseString(expected).documentElement
    if root.tagName == "robot" and not root.hasAttribute("name"):
        root.setAttribute("name", "including")  # a robot in YAML has that of its file
        expected = root.toxml()
    key = element_key(root.tagName, dict(root.attributes.items()))
    passed = "".join(
        f"\n    {name}: {quoted(value)}" for name, value in corpus.arguments(row).items()
    )
    built = yamaro.build(
        path.parent / "including.yaml",
        text=f"{quoted(key)}:\n  include:\n    path: {quoted(path.name)}{passed}\n",
        packages=corpus.packages(row),
        on_message=lambda line: None,
        meshes="keep",
    )
    return is_same_robot(expected.encode(), built.xml().encode())


def quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def main() -> None:
    corpus = corpus_asked_for(__doc__)
    lines: list[float] = []
    both: dict[str, tuple[int, int]] = {}
    texts: dict[str, str] = {}
    migrated, included = Tally("URDF migrated"), Tally("xacro included")
    moved = Tally("xacro migrated")
    others = Others()
    for row in corpus.rows("urdf.tsv"):
        path = corpus.path(row)
        migrated.add(row["path"], lambda path=path: migrates(path, lines, texts, migrated))
    for row in corpus.rows("xacro.tsv"):
        moved.add(
            row["path"], lambda row=row: migrates_xacro(corpus, row, both, texts, moved, others)
        )
        included.add(row["path"], lambda row=row: includes(corpus, row))
    print("| | robots | same | | median time |\n|---|--:|--:|--:|--:|")
    tallies = (migrated, moved, included)
    for tally in tallies:
        print(tally.row())
    print(f"\n{others.table()}")
    if lines:
        print(f"\nlines of migrated URDF: {statistics.median(lines):.2f} of the source's (median)")
    if both:
        before, after = (sum(counts) for counts in zip(*both.values(), strict=True))
        print(f"lines of migrated xacro: {after / before:.2f} of the sources' (all of them)")
    print(f"\n| in migrated sources | |\n|---|--:|\n{reading_table(texts.values())}")
    for tally in tallies:
        if tally.allowed:
            codes = sorted({code for each in tally.allowed.values() for code in each})
            print(f"{tally.name}: parsers refuse {len(tally.allowed)}: {', '.join(codes)}")
    print("", *(failure for tally in tallies for failure in tally.failures), sep="\n")
    print(*(f"told: {each}" for each in others.differing), sep="\n")
    print(*(f"differs, and nothing says so: {each}" for each in others.silent), sep="\n")
    sys.exit(1 if others.silent or any(tally.failures for tally in tallies) else 0)


if __name__ == "__main__":
    main()
