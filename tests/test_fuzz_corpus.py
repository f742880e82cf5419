"""Whatever is fed to the targets of tests/fuzz ends as it should, and a fault in them is found.

`scripts/fuzz` feeds them for longer; here is what it found worth keeping, and a few hundred random
inputs more. So that finding nothing means something, faults are planted.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from itertools import chain
from typing import Any

import pytest

from tests.effort import examples, is_tried
from tests.fuzz import pipeline
from tests.fuzz.corpus import FILE_MARK, read_corpus, to_bytes, to_text
from tests.fuzz.session import Session
from tests.fuzz.targets import TARGETS
from yamaro.diagnostics import did_you_mean
from yamaro.runtime import statements as loops
from yamaro.sandbox import jail
from yamaro.syntax import keys, python
from yamaro.xml import forms
from yamaro.xml import writer as xml_writer
from yamaro.yaml import brackets
from yamaro.yaml import nodes as yaml_nodes
from yamaro.yaml import recovery as yaml_characters
from yamaro.yaml.reader import NodeBuilder

SEED = 1
MORE = 1_000
"""Random inputs that may be needed to find a planted fault."""
RANDOM = {
    "reader": examples(400),
    "keys": examples(600),
    "template": examples(600),
    "pipeline": examples(800),
}


@pytest.fixture(scope="module")
def corpora() -> dict[str, list[str]]:
    return {name: read_corpus(name) for name in TARGETS}


@pytest.mark.parametrize("name", TARGETS)
def test_the_corpus_ends_as_it_should(name: str, corpora: dict[str, list[str]]) -> None:
    session = Session(TARGETS[name])
    for text in corpora[name]:
        session.feed(text)
    assert not session.faults, session.told()
    assert len(session.counts) >= LEAST_OUTCOMES[name], "the corpus shows little"


LEAST_OUTCOMES = {"reader": 15, "keys": 10, "template": 6, "pipeline": 50}
"""In how many ways the inputs of a corpus end: accepted, or refused with one of so many codes."""


@pytest.mark.parametrize("name", TARGETS)
def test_random_inputs_end_as_they_should(name: str) -> None:
    session = Session(TARGETS[name])
    for text in TARGETS[name].inputs(RANDOM[name], SEED):
        session.feed(text)
    assert not session.faults, session.told()
    # The changes must neither spare nor ruin everything, or they test nothing.
    accepted = sum(session.counts[outcome] for outcome in ACCEPTED[name])
    assert RANDOM[name] / 20 < accepted < RANDOM[name] * 9 / 10


ACCEPTED = {
    "reader": ["read"],
    "keys": ["ElementNode", "DynamicNode", "CallNode"],
    "template": ["template", "expression"],
    "pipeline": ["xml"],
}


@pytest.mark.parametrize("name", TARGETS)
def test_a_corpus_is_small_and_sorted(name: str, corpora: dict[str, list[str]]) -> None:
    texts = corpora[name]
    assert 100 <= len(texts) <= 300
    assert sum(map(len, texts)) < 200_000
    assert texts == sorted(set(texts), key=lambda text: (len(text), text))
    assert all(to_text(to_bytes(text)) == text for text in texts)
    assert all(len(to_bytes(text)) <= TARGETS[name].longest for text in texts)


def test_the_corpus_of_the_pipeline_has_inputs_of_several_files(
    corpora: dict[str, list[str]],
) -> None:
    several = [text for text in corpora["pipeline"] if f"\n{FILE_MARK}" in text]
    assert len(several) >= 5
    assert pipeline.files_in("a\n#file b.yaml\nc\n#file ../d.yaml\ne\udcff") == {
        pipeline.MAIN: b"a\n",
        f"{pipeline.FOLDER}/b.yaml": b"c\n",
        f"{pipeline.FOLDER.rpartition('/')[0]}/d.yaml": b"e\xff",
    }


@pytest.mark.slow
@pytest.mark.skipif(jail.check_available() is not None, reason="the kernel has no jail")
def test_safe_files_give_the_same_in_a_jail(corpora: dict[str, list[str]]) -> None:
    for text in corpora["pipeline"][::8]:
        jailed = pipeline.result_of(text, mode="safe")
        with pipeline.without_jail():
            assert pipeline.result_of(text, mode="safe") == jailed


# --- planted faults ---------------------------------------------------------------------------

Plant = Callable[[pytest.MonkeyPatch], None]


def in_place_of(original: Any, replacement: Any) -> Plant:
    """Return what replaces a function wherever it was imported, in the targets too."""

    def plant(patch: pytest.MonkeyPatch) -> None:
        for name, module in list(sys.modules.items()):
            if name.startswith(("yamaro", "tests.fuzz")):
                for attribute, value in list(vars(module).items()):
                    if value is original:
                        patch.setattr(module, attribute, replacement)

    return plant


def of_class(owner: type, name: str, replacement: Any) -> Plant:
    return lambda patch: patch.setattr(owner, name, replacement)


def keeping_the_colon(text: str) -> keys.PlainKey | None:
    plain = parse_plain_key(text)
    if plain is None:
        return None
    return plain[0], {f"{own}:" if f"{own}:=" in text else own: plain[1][own] for own in plain[1]}


def trimming_blanks_only(text: str, start: int, end: int) -> tuple[int, int]:
    piece = text[start:end]
    return start + len(piece) - len(piece.lstrip(" ")), start + len(piece.rstrip(" "))


def looking_into_expressions(text: str, characters: str, start: int, end: int) -> int:
    return min((at for sign in characters if (at := text.find(sign, start, end)) >= 0), default=-1)


def knowing_no_escapes_of_four(raw: str, at: int, style: str) -> int:
    return 2 if raw.startswith("\\", at) else spelled_length(raw, at, style)


def knowing_no_triple_quotes(text: str, start: int) -> int:
    end = text.find(text[start], start + 1)
    return end + 1 if end >= 0 else -1


def knowing_no_comments(text: str, start: int) -> int:
    return find_close(text.replace("#", "_"), start)


def one_too_far(self: python.PythonCode, line: int, column: int) -> int:
    return min(position(self, line, column) + 1, len(self.text))


def taking_equal_for_the_same(values: tuple[Any, ...]) -> object:
    return values if key_of(values) is not None else None


def numbering(word: str, candidates: Any) -> str | None:
    hints.append(word)
    return f"{len(hints)}: {did_you_mean(word, candidates)}"


def escaping_nothing(text: str, *_: object) -> str:
    return text


def failing(*_: object, **__: object) -> Any:
    raise KeyError("a fault")


hints: list[str] = []
parse_plain_key, spelled_length = keys.parse_plain_key, yaml_nodes._spelled_length
find_close, position, key_of = brackets.find_close, python.PythonCode.position, forms.key_of

PLANTED: list[tuple[str, str, Plant]] = [
    ("reader", "escapes", in_place_of(spelled_length, knowing_no_escapes_of_four)),
    ("reader", "anchors", of_class(NodeBuilder, "_after_properties", lambda self, start: start)),
    ("reader", "surrogates", in_place_of(yaml_characters.refuse_characters, lambda source: None)),
    ("keys", "colons", in_place_of(parse_plain_key, keeping_the_colon)),
    ("keys", "white space", in_place_of(keys.trim, trimming_blanks_only)),
    ("keys", "expressions", in_place_of(keys.find_outside, looking_into_expressions)),
    ("template", "triple quotes", in_place_of(brackets.end_of_string, knowing_no_triple_quotes)),
    ("template", "comments", in_place_of(find_close, knowing_no_comments)),
    ("template", "places", of_class(python.PythonCode, "position", one_too_far)),
    ("pipeline", "escaping", in_place_of(xml_writer._attribute_text, escaping_nothing)),
    ("pipeline", "sharing", in_place_of(key_of, taking_equal_for_the_same)),
    ("pipeline", "chance", in_place_of(did_you_mean, numbering)),
    ("pipeline", "a traceback", in_place_of(loops.unpack, failing)),
]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "plant"),
    [
        pytest.param(name, plant, id=f"{name}-{fault}")
        for name, fault, plant in PLANTED
        if is_tried(fault, quick=6, usual=2)
    ],
)
def test_a_planted_fault_is_found(
    name: str, plant: Plant, corpora: dict[str, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    target = TARGETS[name]
    inputs = chain(corpora[name], target.seeds(), target.inputs(MORE, SEED))
    plant(monkeypatch)
    session = Session(TARGETS[name])
    found = next((text for text in inputs if session.feed(text) is None), None)
    assert found is not None, (
        "neither the corpus, nor the files of the project, nor slips of the hand in them show it"
    )
