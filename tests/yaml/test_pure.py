"""PyYAML's parser in Python, which browsers get, gives what libyaml gives."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.effort import tried
from tests.golden import CASES, case_id, find_cases
from tests.waiting import PATIENCE
from yamaro.yaml.pure import PureParser

ROOT = Path(__file__).parents[2]
PIECES = """
"|'|[|]|{|}|:|: |-|- |,|&a |*a|>|%|#| #|\\|?|? |@|`|~|…|😀|\\ud800|\\U00110000|\\x4
""".strip().split("|")
PIECES += ["|", "\t", " ", "\n", "\r\n", "\r", "\n\t", "\n---\n", "\x85", "\u2028"]


def events_of(parser: Any, text: str) -> tuple[list[tuple[object, ...]], bool]:
    """Return the events of a text with their places, and whether all of it is YAML."""
    events: list[tuple[object, ...]] = []
    try:
        reading = parser(text)
        while (event := reading.get_event()) is not None:
            value = getattr(event, "value", None)
            is_empty = value == ""  # libyaml puts these before the next token
            places = [] if is_empty else [event.start_mark.index, event.end_mark.index]
            style = getattr(event, "style", None) or ""
            names = [getattr(event, name, None) for name in ("anchor", "tag")]
            events.append((type(event).__name__, value, style, *names, *places))
    except yaml.YAMLError:
        return events, False
    return events, True


def texts() -> Iterator[str]:
    paths = [*CASES.glob("*/*.yaml"), *ROOT.glob("examples/*/*.yaml")]
    for path in sorted(paths):
        text = path.read_bytes().decode("utf-8", "replace")
        if len(text) < 20_000 and "\ufeff" not in text:
            yield text


def edited(text: str, random: random.Random) -> str:
    for _ in range(random.randint(1, 3)):
        at = random.randrange(len(text) + 1)
        piece = random.choice((*PIECES, ""))
        text = text[:at] + piece + text[at + (not piece or random.random() < 0.3) :]
    return text


@pytest.mark.skipif(not yaml.__with_libyaml__, reason="there is no libyaml")
def test_the_events_of_all_cases_are_those_of_libyaml_also_with_random_edits() -> None:
    draw = random.Random(7)
    count, faulty, disputed = 0, 0, []
    for text in tried(texts(), str, quick=8, usual=3):
        for given in (text, *(edited(text, draw) for _ in range(3))):
            expected, is_yaml = events_of(yaml.CSafeLoader, given)
            events, is_accepted = events_of(PureParser, given)
            if is_accepted and is_yaml:
                assert events == expected, given
            elif is_accepted or is_yaml:
                disputed.append(given)
            count += 1
            faulty += not is_yaml
    assert faulty > count / 10
    assert not set(disputed).intersection(texts())
    # Rare ones are left: a comment right behind `>`, odd tags.
    assert len(disputed) < count / 100, disputed


@pytest.mark.parametrize(
    ("text", "problem", "begins_with"),
    [
        (r'a: "x\ud800"', "found invalid Unicode character escape code", r"\ud800"),
        (r'a: "\\ud800 \udfffx"', "found invalid Unicode character escape code", r"\udfff"),
        (r'a: "b \UFFFFFFFF"', "found invalid Unicode character escape code", r"\UFFFFFFFF"),
        ("%include x\na: 1", "found unknown directive name", " x"),
        ("a: {b:, c}", "found unexpected ':'", ":, c"),
        ("a:\n  b\n\t c", "found a tab character that violates indentation", "\t c"),
    ],
)
def test_what_libyaml_refuses_is_refused_at_its_place(
    text: str, problem: str, begins_with: str
) -> None:
    with pytest.raises(yaml.YAMLError) as caught:
        list(yaml.parse(text, Loader=PureParser))
    error: Any = caught.value
    assert error.problem == problem
    assert text[error.problem_mark.index :].startswith(begins_with)


WITHOUT_LIBYAML = """
import sys
sys.modules["yaml._yaml"] = None
import pytest
from yamaro.yaml import libyaml
assert libyaml.Parser.__name__ == "PureParser"
sys.exit(pytest.main(sys.argv[1:]))
"""


@pytest.mark.slow
def test_cases_give_the_same_bytes_and_messages_without_libyaml() -> None:
    test = "tests/test_cases.py::test_case_gives_exactly_what_is_expected"
    names = [f"{test}[{name}]" for name in tried(map(case_id, find_cases()), str, quick=8, usual=3)]
    once = "--hypothesis-profile=quick"  # most cases are compiled once, not three times
    options = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", once, *names]
    environment = {
        k: v for k, v in os.environ.items() if not k.startswith(("COVERAGE_", "PYTEST_"))
    }
    finished = subprocess.run(
        [sys.executable, "-c", WITHOUT_LIBYAML, *options],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        timeout=10 * PATIENCE,
    )
    assert finished.returncode == 0, finished.stdout[-5000:] + finished.stderr[-2000:]
    assert " passed" in finished.stdout
