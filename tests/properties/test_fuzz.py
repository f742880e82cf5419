"""Whatever is fed to the compiler ends in XML or in a diagnostic: no traceback, no hang.

The number of inputs is `YAMARO_FUZZ_EXAMPLES`, 2,000 of each kind by default; `scripts/fuzz` runs
100,000.
"""

from __future__ import annotations

import os
import random
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lxml import etree

from yamaro.compiler import UsageError, build
from yamaro.diagnostics import YamaroError, render
from yamaro.runtime.loader import MemoryLoader

ROOT = Path(__file__).parents[2]
COUNT = int(os.environ.get("YAMARO_FUZZ_EXAMPLES", "2000"))
SEED = int(os.environ.get("YAMARO_FUZZ_SEED", "1"))
SECONDS = 20
"""How long one input may take, on a busy machine, before it counts as a hang."""

SEEDS = sorted((ROOT / "examples").rglob("*.yaml")) + sorted((ROOT / "tests/cases").rglob("*.yaml"))
HARMFUL = re.compile(
    r"\b(open|while|system|exec|eval|breakpoint|remove|input|iter)\b|\*\*\s*\w|\d{7}"
)


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


def outcome(text: str) -> str:
    """Compile a text as the main file of an otherwise empty folder; return what came of it."""
    path = "/fuzz/robot.yaml"
    loader = MemoryLoader({path: text})
    with no_hang():
        try:
            xml = build(path, loader=loader, on_message=lambda _: None).xml()
        except YamaroError as error:
            require_readable(error)
            return "diagnostic"
        except UsageError:
            return "usage"
    etree.fromstring(xml.encode())
    return "xml"


def require_readable(error: YamaroError) -> None:
    """Require that an error says something, with a code and a place."""
    assert any(diagnostic.severity == "error" for diagnostic in error.diagnostics)
    for diagnostic in error.diagnostics:
        assert render(diagnostic).startswith(f"{diagnostic.severity}[{diagnostic.code}]: ")
        line, column = diagnostic.span.location()
        assert line >= 1
        assert column >= 1


def mutate(text: str, rng: random.Random) -> str:
    """Return the text with a few random changes, of the kinds a slip of the hand makes."""
    for _ in range(rng.randint(1, 4)):
        lines = text.split("\n")
        row = rng.randrange(len(lines))
        at = rng.randrange(len(text) + 1)
        kind = rng.randrange(10)
        if kind == 0:
            text = text[:at] + text[at + rng.randint(1, 3) :]
        elif kind == 1:
            text = text[:at] + rng.choice(SIGNS) + text[at:]
        elif kind == 2:
            lines.insert(row, lines[rng.randrange(len(lines))])
            text = "\n".join(lines)
        elif kind == 3:
            del lines[row]
            text = "\n".join(lines)
        elif kind == 4:
            lines[row] = " " * rng.randint(0, 8) + lines[row].lstrip()
            text = "\n".join(lines)
        elif kind == 5:
            words = text.split(" ")
            i, j = rng.randrange(len(words)), rng.randrange(len(words))
            words[i], words[j] = words[j], words[i]
            text = " ".join(words)
        elif kind == 6:
            text = text[:at]
        elif kind == 7:
            key, colon, _ = lines[row].partition(":")
            lines[row] = key + colon + rng.choice(VALUES)
            text = "\n".join(lines)
        elif kind == 8:
            _, colon, value = lines[row].partition(":")
            indent = len(lines[row]) - len(lines[row].lstrip())
            lines[row] = " " * indent + rng.choice(KEYS) + (colon or ":") + value
            text = "\n".join(lines)
        else:
            other = rng.choice(SEEDS).read_text(encoding="utf-8", errors="replace").split("\n")
            start = rng.randrange(len(other))
            text = "\n".join(lines[:row] + other[start : start + 5] + lines[row:])
        if not text:
            return text
    return text


SIGNS = "{}[]()'\"$:#,&*!|>%@`/\\-=<?\t\n\x00\x07é\u2028 "
VALUES = (
    " ", " null", " 1e400", " .nan", " -1", " $(1/0)", " $(x", " [1, 2]", " {a: 1}", " [{a: 1}]",
    " $([1, 2])", " $(None)", " ''", " a b c", " 1 2", " $(lambda: 1)", " *x", " &x y", " !t z",
    " |", " $(print)", " $('é')", " 0x1F", " package://nowhere/x.stl", " true",
)  # fmt: skip
KEYS = (
    "part", "if", "elif", "else", "for", "include", "variables", "functions", "print", "model",
    "robot", "name", "joint", "link", "Call", "ns.Call", "$(x)", "$('part')", "a/b=1", "a/b", "<a>",
    "<#text>", "'#comment'", "condition", "body", "iterator", "range", "in", "path", "namespace",
    "geometry", "scale", "mass", "density", "inertial", "inertia", "collision", "visual", "xyz",
    "rpy", "pivot", "axis", "limit", "mimic", "type", "parent", "material", "input", "<<", "",
)  # fmt: skip


def is_harmless(text: str) -> bool:
    """Tell whether the Python in a random text can do no harm and comes to an end.

    Running code is what the language is for, so code that never ends is no fault of the compiler.
    """
    return HARMFUL.search(text.replace("**Block", "").replace("**Custom", "")) is None


def test_mutated_files_end_in_xml_or_a_diagnostic() -> None:
    rng = random.Random(SEED)
    texts = [path.read_text(encoding="utf-8", errors="replace") for path in SEEDS]
    counts = {"xml": 0, "diagnostic": 0, "usage": 0}
    for number in range(COUNT):
        text = mutate(rng.choice(texts), rng)
        if not is_harmless(text):
            continue
        try:
            counts[outcome(text)] += 1
        except BaseException as error:
            pytest.fail(f"input {number} of seed {SEED}: {type(error).__name__}: {error}\n{text}")
    # The mutations must neither spare nor ruin everything, or they test nothing.
    assert counts["xml"] > COUNT / 100
    assert counts["diagnostic"] > COUNT / 10
    assert counts["usage"] == 0


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


@settings(max_examples=COUNT, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(st.tuples(st.sampled_from(["model", "variables", "functions"]) | keys, bodies)))
def test_random_trees_end_in_xml_or_a_diagnostic(sections: list[tuple[str, object]]) -> None:
    text = spelled(sections)
    if is_harmless(text):
        assert outcome(text) in ("xml", "diagnostic")


@settings(max_examples=COUNT, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.text(max_size=200))
def test_random_texts_end_in_xml_or_a_diagnostic(text: str) -> None:
    if is_harmless(text):
        assert outcome(text) in ("xml", "diagnostic")
