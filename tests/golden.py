"""The golden cases, as tests/cases/README.md describes them: files, and pages of many cases.

`CASES` is a folder in which each case is a file of its own, with its expected output beside it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

STORED = Path(__file__).parent / "cases"
OPTIONS = ("args", "command", "env", "python", "strict")
HEADING = re.compile(rb"^### (\S+)\n", re.MULTILINE)
OUTPUT = re.compile(rb"^=== (xml|err)\n", re.MULTILINE)
SUFFIXES = (".yaml", ".xml", ".err")

Page = dict[str, dict[str, bytes]]
"""What the files of each case on a page hold, by the suffix of their names."""


def read_page(data: bytes) -> Page:
    """Return the cases of a page: `### name`, the input, and `=== xml`, `=== err` with outputs."""
    preface, *pieces = HEADING.split(data)
    assert not preface, "a page begins with the heading of a case"
    page: Page = {}
    for name, case in zip(pieces[::2], pieces[1::2], strict=True):
        text, *outputs = OUTPUT.split(case)
        files = {
            f".{kind.decode()}": of for kind, of in zip(outputs[::2], outputs[1::2], strict=True)
        }
        assert name.decode() not in page, f"{name.decode()} is there twice"
        page[name.decode()] = {".yaml": text, **files}
    return page


def write_page(page: Page) -> bytes:
    pieces = []
    for name, files in page.items():
        pieces.append(b"### %s\n%s" % (name.encode(), files[".yaml"]))
        pieces += [b"=== %s\n%s" % (s[1:].encode(), files[s]) for s in SUFFIXES[1:] if s in files]
    return b"".join(pieces)


def unpack(folder: Path) -> Path:
    """Write all cases as files into a folder, which then holds nothing else."""
    wanted: dict[Path, bytes] = {}
    for path in STORED.rglob("*"):
        if path.is_file() and path.suffix != ".pyc":
            wanted[folder / path.relative_to(STORED)] = path.read_bytes()
    for path in STORED.glob("*/*.txt"):
        place = folder / path.relative_to(STORED)
        for name, files in read_page(wanted.pop(place)).items():
            for suffix, data in files.items():
                file = place.with_name(name + suffix)
                assert file not in wanted, f"{file.name} is in {path.name} and elsewhere"
                wanted[file] = data
    for path in folder.rglob("*"):
        if path.is_file() and path not in wanted and path.suffix != ".pyc" and path.name[0] != ".":
            path.unlink(missing_ok=True)
    for path, data in wanted.items():
        if not path.exists() or path.read_bytes() != data:
            path.parent.mkdir(parents=True, exist_ok=True)
            # Other processes do the same at the same time.
            new = path.with_name(f".{path.name}.{os.getpid()}")
            new.write_bytes(data)
            new.replace(path)
    return folder


CASES = unpack(Path(__file__).parents[1] / "build" / "cases")


def find_cases() -> list[Path]:
    return sorted(path for path in CASES.glob("*/*.yaml") if not path.name.startswith("_"))


def areas(cases: Iterable[Path]) -> dict[str, list[Path]]:
    """Return cases by the folder that they are in."""
    found: dict[str, list[Path]] = {}
    for case in cases:
        found.setdefault(case.parent.name, []).append(case)
    return found


def case_id(path: Path) -> str:
    return f"{path.parent.name}/{path.stem}"


def read_options(case: Path) -> dict[str, str]:
    """Return the options in the comment lines that a case begins with."""
    options = {}
    # Cases about encodings are no UTF-8, so the head is read as bytes.
    for line in case.read_bytes().removeprefix(b"\xef\xbb\xbf").decode("latin-1").splitlines():
        if not line.startswith("#"):
            break
        name, _, value = line[1:].strip().partition(":")
        if name in OPTIONS:
            options[name] = value.strip()
    return options


def read_expected(path: Path) -> str:
    return path.read_bytes().decode() if path.exists() else ""


def store(case: Path, suffix: str, text: str) -> None:
    """Keep what a case gives now, where its input is kept; nothing when it is empty."""
    data = text.encode()
    place = STORED / case.parent.name
    targets = [case.with_suffix(suffix)]
    if (place / case.name).exists():
        targets.append(place / case.with_suffix(suffix).name)
    else:
        for path in place.glob("*.txt"):
            page = read_page(path.read_bytes())
            if case.stem in page:
                page[case.stem].pop(suffix, None)
                page[case.stem] |= {suffix: data} if data else {}
                path.write_bytes(write_page(page))
    for target in targets:
        if data:
            target.write_bytes(data)
        else:
            target.unlink(missing_ok=True)
