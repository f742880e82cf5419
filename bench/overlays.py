"""Writes overlays between robots of a corpus with `yamaro diff --overlay`, and judges them.

    python bench/overlays.py [CORPUS] [--only REGEX]

The pairs are 30 URDFs with up to ten of their values changed at random, and 20 xacro files with two
settings of their arguments. The first robot is built with the overlay. What lxml reads of all its
joints and masses has to be what it reads of the second robot, to the last bit, and the command has
to say so; of pairs in which an overlay cannot say all, what the names of both have in common.
"""

from __future__ import annotations

import io
import random
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from itertools import pairwise
from pathlib import Path

from lxml import etree
from robots import Corpus, corpus_asked_for

from yamaro.commands.main import main as command

CHANGED, SET = 30, 20
"""Pairs of each kind."""
PLACES = (
    *("joint/origin@xyz", "joint/origin@rpy", "joint/axis@xyz", "joint/limit@lower"),
    *("joint/limit@upper", "joint/limit@effort", "joint/limit@velocity", "joint/dynamics@damping"),
    *("joint/dynamics@friction", "joint/mimic@multiplier", "joint/mimic@offset"),
    *("joint/calibration@rising", "joint/safety_controller@k_velocity"),
    *("link/inertial/origin@xyz", "link/inertial/origin@rpy", "link/inertial/mass@value"),
    *(f"link/inertial/inertia@{name}" for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")),
)
"""The values that are changed and compared: the path of an element, and its attribute."""
NOTHING = {"xyz": "0 0 0", "rpy": "0 0 0", "damping": "0", "friction": "0", "offset": "0"}
"""What an attribute means that is left out."""

Values = dict[tuple[str, str], list[float] | str | None]
Side = tuple[str, list[str]]
Pair = tuple[Side, Side, list[str]]
"""Two files with their arguments, and options for both."""


def values_of(root: etree._Element) -> Values:
    """Return all values of joints and masses by the name of the joint or link, and the place."""
    found: Values = {}
    for owner in root:
        if owner.tag not in ("joint", "link"):
            continue
        name = f"{owner.tag} {owner.get('name')}"
        for place in PLACES:
            path, _, attribute = place.partition("@")
            kind, _, inner = path.partition("/")
            if kind != owner.tag:
                continue
            element = owner.find(inner)
            text = None if element is None else element.get(attribute)
            found[name, place] = numbers_in(text if text is not None else NOTHING.get(attribute))
    return found


def numbers_in(text: str | None) -> list[float] | str | None:
    try:
        return None if text is None else [float(each) for each in text.split()]
    except ValueError:
        return text


def planted(corpus: Corpus, folder: Path) -> Iterator[Pair]:
    """Yield URDFs with a copy beside them in which values are others."""
    draws = random.Random(17)
    paths = [corpus.path(row) for row in corpus.rows("urdf.tsv")]
    draws.shuffle(paths)
    count = 0
    for path in paths:
        try:
            root = etree.fromstring(path.read_bytes())
        except etree.XMLSyntaxError:
            continue
        names = [each.get("name") for each in root if each.tag in ("joint", "link")]
        elements = [
            (element, attribute)
            for place, _, attribute in (each.partition("@") for each in PLACES)
            for element in root.findall(f"./{place}")
            if isinstance(numbers_in(element.get(attribute)), list)
        ]
        if (
            b"xacro:" in path.read_bytes()
            or len(set(names)) < len(names)
            or len(elements) < 10
            or root.tag != "robot"
        ):
            continue
        for element, attribute in draws.sample(elements, draws.randint(1, 10)):
            row = [each * 0.9 + 0.013 for each in map(float, element.get(attribute).split())]
            element.set(attribute, " ".join(map(repr, row)))
        count += 1
        changed = folder / f"{count}.urdf"
        changed.write_bytes(etree.tostring(root))
        yield (str(path), []), (str(changed), []), []
        if count == CHANGED:
            return


def set_otherwise(corpus: Corpus) -> Iterator[Pair]:
    """Yield xacro files with two settings of their arguments, and the packages of both."""
    settings: dict[Path, list[list[str]]] = defaultdict(list)
    packages: dict[Path, list[str]] = {}
    for row in corpus.rows("xacro.tsv"):
        path = corpus.path(row)
        settings[path].append([f"{n}:={v}" for n, v in corpus.arguments(row).items()])
        found = corpus.packages(row)
        packages[path] = [
            word
            for name, folder in found.items()
            if Path(folder).is_dir()
            for word in ("--package", f"{name}:={folder}")
        ]
    count = 0
    for path, given in settings.items():
        for one, other in pairwise(given):
            yield (str(path), one), (str(path), other), packages[path]
            count += 1
            if count == SET:
                return


def yamaro(*words: str) -> tuple[int, str, str]:
    """Return the exit status of a command, and what it writes to standard output and error."""
    out, error = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(error):
        status = command(words)
    return status, out.getvalue(), error.getvalue()


def main() -> None:
    """Judge 50 pairs."""
    corpus = corpus_asked_for(__doc__)
    whole = faulty = values = said = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        overlay = folder / "overlay.yaml"
        pairs = [*planted(corpus, folder), *set_otherwise(corpus)]
        for number, (first, second, options) in enumerate(pairs):
            own = [
                word
                for option, side in (("--a", first), ("--b", second))
                for each in side[1]
                for word in (option, each)
            ]
            status, text, noted = yamaro(
                "diff", "--overlay", "--trust", first[0], second[0], *own, *options
            )
            overlay.write_text(text, encoding="utf-8")
            common = ("-q", "--meshes", "keep", *options)
            built, xml, messages = yamaro(first[0], *first[1], "--overlay", str(overlay), *common)
            told, expected, _ = yamaro(second[0], *second[1], *common)
            label = f"{number + 1} {Path(first[0]).name} {' '.join(own)}"
            if built or told or status > 1:
                print(f"{label}: {noted or messages}")
                faulty += 1
                continue
            got = values_of(etree.fromstring(xml.encode()))
            wanted = values_of(etree.fromstring(expected.encode()))
            wrong = [key for key in got.keys() & wanted.keys() if got[key] != wanted[key]]
            lost = [key for key in wrong if wanted[key] is not None]
            values += len(wanted)
            said += text.count(": ")
            whole += status == 0
            if lost or (number < CHANGED and (status or got != wanted)):
                faulty += 1
                print(f"{label}: {sorted(lost or wrong)[:3]} {noted[:300]}")
    print(
        f"{len(pairs)} pairs, {values} values, {said} lines; {whole} said in full, {faulty} faulty"
    )
    sys.exit(1 if faulty else 0)


if __name__ == "__main__":
    main()
