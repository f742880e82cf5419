"""Whatever is fed to the compiler ends in XML or in a diagnostic: no traceback, no hang.

The number of inputs is `YAMARO_FUZZ_EXAMPLES`, 3,000 by default; `scripts/fuzz` runs 100,000. Eight
in ten are the examples, cases and documents of this project with a few slips of the hand in them;
one is a random tree of the language's words, one a random text. `YAMARO_FUZZ_SEED` gives others.
"""

from __future__ import annotations

import os
import random
import re
import signal
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st
from lxml import etree

from yamaro.compiler import UsageError, build
from yamaro.diagnostics import YamaroError, render
from yamaro.runtime.loader import FileLoader

ROOT = Path(__file__).parents[2]
COUNT = int(os.environ.get("YAMARO_FUZZ_EXAMPLES", "3000"))
MUTATED, GROWN = COUNT * 8 // 10, max(COUNT // 10, 1)
SEED = int(os.environ.get("YAMARO_FUZZ_SEED", "1"))
SECONDS = 20
"""How long one input may take, on a busy machine, before it counts as a hang."""

HARMFUL = re.compile(
    r"\b(open|while|system|exec|eval|breakpoint|remove|input|iter|kill|unlink|rmtree|mkdir|sleep)\b"
    r"|\*\*\s*[\w(]|\d{6}|<<|\bnumpy\b|(\bcycle|count|repeat)\("
)
"""Python that could do harm, and numbers that make a lawful program run for hours."""
HARMLESS = re.compile(r"\*\*[A-Z]\w*|input:|<<:|load_yaml")
WORD = re.compile(r"[A-Za-z_]\w+")


# --- the inputs -------------------------------------------------------------------------------


def read_seeds() -> list[tuple[Path, str]]:
    """Return files that stand where others include them, and texts that stand alone.

    Functions that call themselves 1,000 deep are left out: doubling one of their lines makes a
    lawful program that would take 2 to the power of 1,000 steps.
    """
    paths = sorted((ROOT / "examples").rglob("*.yaml"))
    paths += sorted((ROOT / "tests" / "cases").rglob("*.yaml"))
    seeds = [(path, path.read_text(encoding="utf-8", errors="replace")) for path in paths]
    for document in sorted((ROOT / "docs").rglob("*.md")):
        blocks = re.findall(r"^```yaml.*?\n(.*?)^```", document.read_text(), re.DOTALL | re.M)
        seeds += [(document.with_suffix(".yaml"), block) for block in blocks]
    return [(path, text) for path, text in seeds if is_harmless(text) and "recurs" not in path.stem]


def is_harmless(text: str) -> bool:
    """Tell whether the Python in a random text can do no harm and comes to an end.

    Running code is what the language is for, so code that never ends is no fault of the compiler.
    """
    return HARMFUL.search(HARMLESS.sub("", text)) is None


SIGNS = "{}[]()'\"$:#,&*!|>%@`/\\-=<?~.+\t\r\n\x00\x07\x85é\u2028\ufeff\ud800😀 "
VALUES = (
    " ", " null", " 1e400", " .nan", " -1", " $(1/0)", " $(x", " [1, 2]", " {a: 1}", " [{a: 1}]",
    " $([1, 2])", " $(None)", " ''", " a b c", " 1 2", " $(lambda: 1)", " *x", " &x y", " !t z",
    " |", " $(print)", " $('é')", " 0x1F", " package://nowhere/x.stl", " true", " []", " {}", " >-",
    " $(True)", " $(b'x')", " $({1, 2})", " $(object())", " $(print('x'))", " $(exit(1))", " $()",
    " $(chr(0))", " $('\\ud800')", " ${x}", " $(find nowhere)", " $(env('NO'))", " $$(x)", " -.inf",
    " $(float('nan'))", " 1:30", " ./missing.yaml", " .", " \"\\x00\"", " '$(1)'", " 0 0 1",
    " $((1, 'a'))", " $(e)", " $(type)", " $(int)", " $(next(n for n in []))", " x=1", " x=1, x=2",
)  # fmt: skip
KEYS = (
    "part", "if", "elif", "else", "for", "include", "variables", "functions", "print", "model",
    "robot", "name", "joint", "link", "Call", "ns.Call", "$(x)", "$('part')", "a/b=1", "a/b", "<a>",
    "<#text>", "'#comment'", "condition", "body", "iterator", "range", "in", "path", "namespace",
    "geometry", "scale", "mass", "density", "inertial", "inertia", "collision", "visual", "xyz",
    "rpy", "pivot", "axis", "limit", "mimic", "type", "parent", "material", "input", "<<", "",
    "process", "import", "sdf/version='1.11'", "$('')", "$(None)", "a/$('b')=1", "a/b=$(1", "'a b'",
    "? [a]", "x/global", "x/parent", "x/child", "x/bridge", "Make/global", "origin/xyz=1",
    "Block", "$('if')", "$('Make')", "robot/a=1", "link/name=$(x)", "a:b", "xmlns:a/b=1",
)  # fmt: skip

Lines = list[str]


def indent_of(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def end_of_block(lines: Lines, row: int) -> int:
    """Return the row behind the lines that stand deeper than line `row`."""
    end = row + 1
    while end < len(lines) and (
        not lines[end].strip() or indent_of(lines[end]) > indent_of(lines[row])
    ):
        end += 1
    return end


def insert_sign(text: str, at: int, rng: random.Random) -> str:
    return text[:at] + rng.choice(SIGNS) + text[at:]


def delete_some(text: str, at: int, rng: random.Random) -> str:
    return text[:at] + text[at + rng.randint(1, 3) :]


def cut_off(text: str, at: int, rng: random.Random) -> str:
    return text[:at]


def swap_words(text: str, at: int, rng: random.Random) -> str:
    words = text.split(" ")
    i, j = rng.randrange(len(words)), rng.randrange(len(words))
    words[i], words[j] = words[j], words[i]
    return " ".join(words)


def misspell_word(text: str, at: int, rng: random.Random) -> str:
    found = WORD.search(text, at)
    if found is None:
        return text
    i = rng.randrange(found.start(), found.end() - 1)
    return text[:i] + text[i + 1] + text[i] + text[i + 2 :]


def replace_word(text: str, at: int, rng: random.Random) -> str:
    words = list(WORD.finditer(text))
    if not words:
        return text
    found = rng.choice(words)
    return text[: found.start()] + rng.choice(words).group() + text[found.end() :]


def compute_word(text: str, at: int, rng: random.Random) -> str:
    found = WORD.search(text, at)
    if found is None:
        return text
    computed = rng.choice((f"$({found.group()})", f"$('{found.group()}')", f"'{found.group()}'"))
    return text[: found.start()] + computed + text[found.end() :]


def end_lines_otherwise(text: str, at: int, rng: random.Random) -> str:
    return text.replace("\n", rng.choice(("\r\n", "\r", "\n\n")))


def on_lines(change: Callable[[Lines, int, random.Random], None]) -> Mutation:
    """Return the mutation of a text that `change` makes on its lines, at a random one."""

    def mutation(text: str, at: int, rng: random.Random) -> str:
        lines = text.split("\n")
        change(lines, rng.randrange(len(lines)), rng)
        return "\n".join(lines)

    return mutation


def repeat_line(lines: Lines, row: int, rng: random.Random) -> None:
    lines.insert(row, rng.choice(lines))


def delete_line(lines: Lines, row: int, rng: random.Random) -> None:
    del lines[row]


def swap_lines(lines: Lines, row: int, rng: random.Random) -> None:
    other = rng.randrange(len(lines))
    lines[row], lines[other] = lines[other], lines[row]


def indent_line(lines: Lines, row: int, rng: random.Random) -> None:
    lines[row] = " " * rng.randint(0, 8) + lines[row].lstrip()


def give_value(lines: Lines, row: int, rng: random.Random) -> None:
    key, colon, _ = lines[row].partition(":")
    lines[row] = key + colon + rng.choice(VALUES)


def give_key(lines: Lines, row: int, rng: random.Random) -> None:
    _, colon, value = lines[row].partition(":")
    lines[row] = " " * indent_of(lines[row]) + rng.choice(KEYS) + (colon or ":") + value


def make_item(lines: Lines, row: int, rng: random.Random) -> None:
    indent = indent_of(lines[row])
    lines[row] = " " * indent + "- " + lines[row][indent:]


def delete_block(lines: Lines, row: int, rng: random.Random) -> None:
    del lines[row : end_of_block(lines, row)]


def move_block(lines: Lines, row: int, rng: random.Random) -> None:
    """Move or copy a line with what stands under it below another line, indented to fit."""
    end = end_of_block(lines, row)
    block = lines[row:end]
    if rng.random() < 0.5:
        del lines[row:end]
    target = rng.randrange(len(lines) + 1)
    indent = indent_of(lines[target - 1]) + rng.choice((0, 2)) if target else 0
    shift = indent - indent_of(block[0])
    lines[target:target] = [
        " " * max(indent_of(line) + shift, 0) + line.lstrip(" ") for line in block
    ]


def borrow_lines(lines: Lines, row: int, rng: random.Random) -> None:
    other = rng.choice(SEEDS)[1].split("\n")
    start = rng.randrange(len(other))
    lines[row:row] = other[start : end_of_block(other, start)][:12]


Mutation = Callable[[str, int, random.Random], str]
MUTATIONS: list[Mutation] = [
    insert_sign, delete_some, cut_off, swap_words, misspell_word, replace_word, compute_word,
    end_lines_otherwise,
    *map(on_lines, (
        repeat_line, delete_line, swap_lines, indent_line, give_value, give_key, make_item,
        delete_block, move_block, borrow_lines,
    )),
]  # fmt: skip


def mutate(text: str, rng: random.Random) -> str:
    """Return the text with a few random changes, of the kinds a slip of the hand makes."""
    for _ in range(rng.randint(1, 4)):
        if text:
            text = rng.choice(MUTATIONS)(text, rng.randrange(len(text) + 1), rng)
    return text


SEEDS = read_seeds()


# --- what comes of them -----------------------------------------------------------------------


class Hang(BaseException):
    """An input took too long; no `except Exception` may swallow this."""


@contextmanager
def no_hang() -> Iterator[None]:
    def ring(*_: object) -> None:
        raise Hang

    before = signal.signal(signal.SIGALRM, ring)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


class OneChanged(FileLoader):
    """The files of the disk, but for one that reads otherwise."""

    __slots__ = ("path", "text")

    def __init__(self, path: str, text: str) -> None:
        self.path = path
        self.text = text

    def read(self, path: str) -> bytes:
        if path == self.path:
            return self.text.encode("utf-8", "surrogatepass")
        return super().read(path)


def outcome(text: str, *, changed: Path = ROOT / "robot.yaml", main: Path | None = None) -> str:
    """Compile `main` in which the file `changed` reads `text`; return what came of it."""
    loader = OneChanged(str(changed), text)
    with no_hang():
        try:
            xml = build(str(main or changed), loader=loader, on_message=lambda _: None).xml()
        except YamaroError as error:
            require_readable(error)
            return "diagnostic"
        except UsageError:
            return "usage"
    try:
        etree.fromstring(xml.encode(), etree.XMLParser(huge_tree=True))
    except etree.XMLSyntaxError as error:
        # What xmlns:… is given is the writer's own; only the reader knows what an address is.
        if "is not a valid URI" not in str(error):
            raise
    return "xml"


def require_readable(error: YamaroError) -> None:
    """Require that an error says something, with a code and a place."""
    assert any(diagnostic.severity == "error" for diagnostic in error.diagnostics)
    for diagnostic in error.diagnostics:
        assert render(diagnostic).startswith(f"{diagnostic.severity}[{diagnostic.code}]: ")
        assert diagnostic.message.strip()
        assert "Traceback" not in render(diagnostic)
        span = diagnostic.span
        assert 0 <= span.start <= span.end <= len(span.source.text) + 1  # the end of the file
        line, column = span.location()
        assert line >= 1
        assert column >= 1


def place_of(error: BaseException) -> str:
    """Return the kind of an error and the line that raised it: one fault, one name."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__} at {Path(last.filename).name}:{last.lineno}"


def main_of(path: Path) -> Path:
    """Return a file that includes `path`, if its folder says so; else the path itself."""
    if path.name.startswith("_"):
        return next(
            (
                other
                for other in sorted(path.parent.glob("*.yaml"))
                if path.name in other.read_text(encoding="utf-8", errors="replace")
                and not other.name.startswith("_")
            ),
            path,
        )
    return path


def test_mutated_files_end_in_xml_or_a_diagnostic(capsys: pytest.CaptureFixture[str]) -> None:
    rng = random.Random(SEED)
    counts = Counter[str]()
    faults: dict[str, str] = {}
    for number in range(MUTATED):
        path, text = rng.choice(SEEDS)
        text = mutate(text, rng)
        if not is_harmless(text):
            counts["left out"] += 1
            continue
        try:
            counts[outcome(text, changed=path, main=main_of(path))] += 1
        except BaseException as error:
            if isinstance(error, KeyboardInterrupt):
                raise
            faults.setdefault(place_of(error), f"input {number} of {path}: {error}\n{text}")
    if "YAMARO_FUZZ_EXAMPLES" in os.environ:
        with capsys.disabled():
            print(f"\nseed {SEED}: {dict(counts)}, {len(faults)} faults")
    told = "\n\n".join(f"=== {place} in {fault}" for place, fault in faults.items())
    assert not faults, f"seed {SEED}\n{told}"
    # The mutations must neither spare nor ruin everything, or they test nothing.
    assert counts["xml"] > MUTATED / 20
    assert counts["diagnostic"] > MUTATED / 5
    assert counts["usage"] == 0


# --- random trees and texts -------------------------------------------------------------------

scalars = st.one_of(
    st.sampled_from([value.strip() for value in VALUES]),
    st.text(max_size=12),
    st.integers().map(str),
    st.floats().map(str),
)
keys = st.one_of(st.sampled_from(KEYS), st.text(min_size=1, max_size=8))


def spelled(tree: object, indent: int = 0) -> str:
    """Return a tree of lists, dicts and texts as YAML, not always rightly quoted."""
    pad = "  " * indent
    if isinstance(tree, list):
        if all(isinstance(item, tuple) for item in tree):
            return "".join(f"\n{pad}{key}:{spelled(value, indent + 1)}" for key, value in tree)
        return "".join(f"\n{pad}-{spelled(item, indent + 1)}" for item in tree)
    return f" {tree}"


bodies = st.recursive(
    scalars,
    lambda inner: st.lists(st.tuples(keys, inner), max_size=5) | st.lists(inner, max_size=3),
    max_leaves=25,
)


@settings(max_examples=GROWN, deadline=None, suppress_health_check=list(HealthCheck))
@seed(SEED)
@given(st.lists(st.tuples(st.sampled_from(["model", "variables", "functions"]) | keys, bodies)))
def test_random_trees_end_in_xml_or_a_diagnostic(sections: list[tuple[str, object]]) -> None:
    text = spelled(sections)
    if is_harmless(text):
        assert outcome(text) in ("xml", "diagnostic")


@settings(max_examples=GROWN, deadline=None, suppress_health_check=list(HealthCheck))
@seed(SEED)
@given(st.text(max_size=200))
def test_random_texts_end_in_xml_or_a_diagnostic(text: str) -> None:
    if is_harmless(text):
        assert outcome(text) in ("xml", "diagnostic")
