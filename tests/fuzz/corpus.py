"""The inputs: seeds out of the project's own files, and the corpora that the fuzzers found.

A corpus is a file of one JSON string per line. A byte that is no UTF-8 is a lone surrogate in it,
as Python has it with `surrogateescape`.
"""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from tests.golden import CASES
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.source import Source
from yamaro.yaml.nodes import MappingNode, ScalarNode, quoted
from yamaro.yaml.reader import read

from . import reader

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
FILE_MARK = "#file "
NAMED_FILE = re.compile(r"(?<![\w./-])[\w./-]{1,60}\.yaml")
LARGE = 20_000
"""Characters of a file that is too large to begin with."""


def read_corpus(target: str) -> list[str]:
    lines = (HERE / "corpus" / f"{target}.jsonl").read_text("ascii").splitlines()
    return [json.loads(line) for line in lines]


def write_corpus(target: str, texts: Iterable[str]) -> None:
    lines = [json.dumps(text) for text in sorted(set(texts), key=lambda text: (len(text), text))]
    (HERE / "corpus" / f"{target}.jsonl").write_text("".join(f"{line}\n" for line in lines))


def to_text(data: bytes) -> str:
    return data.decode("utf-8", "surrogateescape")


def to_bytes(text: str) -> bytes:
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:  # other surrogates: bytes that are no UTF-8 in their place
        return text.encode("utf-8", "surrogatepass")


# --- seeds ------------------------------------------------------------------------------------


@functools.cache
def find_files() -> list[Path]:
    """Return the YAML files of the project that stand for themselves."""
    paths = sorted((ROOT / "examples").rglob("*.yaml"))
    paths += sorted(CASES.rglob("*.yaml"))
    return [path for path in paths if not path.name.startswith("_") and path.stat().st_size < LARGE]


@functools.cache
def find_blocks() -> list[str]:
    """Return the YAML in the documents of the project."""
    texts = [path.read_text("utf-8") for path in sorted((ROOT / "docs").rglob("*.md"))]
    found = [re.findall(r"^```yaml.*?\n(.*?)^```", text, re.DOTALL | re.M) for text in texts]
    return [block for blocks in found for block in blocks]


@functools.cache
def seeds_of(target: str) -> list[str]:
    """Return what a target begins with: files, or the keys or values in them."""
    if target == "pipeline":
        return [*map(with_named_files, find_files()), *find_blocks(), *legal_python(), *MESHES]
    texts = [to_text(path.read_bytes()) for path in find_files()] + find_blocks()
    if target == "reader":
        return texts
    is_key = target == "keys"
    found = {
        text for file in texts for text, key in scalars_in(file) if key == is_key or "$" in text
    }
    return sorted(found)


VALUES = "{i: 7, x: 0.25, s: left leg, v: [3, 1.5, 2], d: {a: 1, b: [2, 3]}}"
"""Variables of the names that the Python in tests/hostile goes by."""
MESHES = [
    f"model:\n  part: {{name: a, link: {{geometry: cube.{kind}, density: 9, scale: 2 1 1}}}}"
    for kind in ("stl", "obj")
]


NUMPY = (
    "import: [numpy as np, math, statistics]\nvariables: {i: 7, x: 0.25}\nprocess: |\n"
    "  a = np.array([1, 2, 3]); b = np.array([0.5, 1.25, -2.0]); m = np.array([[1, 2], [3, 4]])\n"
    "  R = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])\n"
)


def legal_python() -> list[str]:
    """Return files with the Python that safe mode knows."""
    plain = f"import: [math, statistics]\nvariables: {VALUES}\n"
    return [
        *(f"{plain}print: {quoted(f'$({line})')}\n" for line in hostile("legal-expressions")),
        *(f"{plain}process: {quoted(line)}\nprint: $(v)\n" for line in hostile("legal-statements")),
        *(f"{NUMPY}print: {quoted(f'$({line})')}\n" for line in hostile("legal-numpy")),
        *(f"{NUMPY}process: {quoted(line)}\n" for line in hostile("legal-numpy-statements")),
    ]


def hostile(name: str) -> list[str]:
    lines = (ROOT / "tests" / "hostile" / f"{name}.txt").read_text("utf-8").splitlines()
    return [line.removeprefix("! ") for line in lines]


def with_named_files(path: Path) -> str:
    """Return a file and those it names, in one text."""
    texts = {path.name: to_text(path.read_bytes())}
    pending = [texts[path.name]]
    while pending:
        for name in NAMED_FILE.findall(pending.pop()):
            other = path.parent / name
            if name not in texts and other.is_file() and len(texts) < 6:
                texts[name] = to_text(other.read_bytes())
                pending.append(texts[name])
    main, *others = texts.items()
    return main[1] + "".join(f"\n{FILE_MARK}{name}\n{text}" for name, text in others)


def scalars_in(text: str) -> Iterator[tuple[str, bool]]:
    """Give the text of each scalar, and whether it is a key."""
    try:
        root: Any = read(Source(text, name="seed.yaml"), reporter=Reporter())
    except YamaroError:
        return
    for node in reader.walk(root):
        if isinstance(node, MappingNode):
            yield from ((key.text, True) for key, _ in node.pairs)
        if isinstance(node, ScalarNode):
            yield node.text, False
