"""`Parsed`: what a parse gives of files with errors, and what it says of them."""

from __future__ import annotations

import random
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
import yaml

from tests import effort
from yamaro import YamaroError
from yamaro.source import Source
from yamaro.syntax.nodes import Document, FunctionsNode, Parsed, VariablesNode
from yamaro.syntax.parser import parse

EXAMPLES = Path(__file__).parents[2] / "examples"
DELETIONS = effort.examples(1_000)

TWO_FAULTS = """\
variables:
  length: 0.3
  width: 0.2
  sizes: [1, 2
  height: 0.1
functions:
  Leg:
    input: side
    body:
    - link/name=$(side + "_leg):
model:
- Leg: left
"""


def parsed(text: str) -> Parsed:
    return parse(Source(text, name="t.yaml"))


def told(text: str) -> list[str]:
    """Return line and code of each error, in the order they are told in."""
    return [f"{one.span.location()[0]} {one.code}" for one in parsed(text).errors]


def names(document: Document) -> list[str]:
    """Return the variables and functions at the root of a file."""
    found: list[str] = []
    for section in document.sections:
        if isinstance(section, VariablesNode):
            found.extend(str(entry.name) for entry in section.entries)
        if isinstance(section, FunctionsNode):
            found.extend(function.name for function in section.functions)
    return found


def test_one_fault_does_not_hide_another_and_what_is_declared_is_there() -> None:
    assert told(TWO_FAULTS) == ["4 yaml-open", "10 unclosed-expression"]
    found = parsed(TWO_FAULTS)
    assert names(found.document) == ["length", "width", "sizes", "height", "Leg"]
    assert len(found.document.model) == 1
    assert [span.written() for span in found.hidden] == ["[1, 2"]


def test_whether_errors_raise_is_up_to_the_caller() -> None:
    found = parsed(TWO_FAULTS)
    with pytest.raises(YamaroError) as caught:
        found.require()
    assert caught.value.diagnostics == found.errors
    good = parsed("variables: {a: 1}\nmodel:")
    assert good.require() is good.document
    assert good.errors == []


def test_what_is_no_yaml_comes_first_since_it_hides_the_rest() -> None:
    text = "variables:\n  a: $(1 +\nmodel:\n- link/name=b: [1\n"
    assert told(text) == ["4 yaml-open", "2 unclosed-expression"]
    lines = [one.span.location()[0] for one in parsed(text).diagnostics]
    assert lines == [2, 4]


@pytest.mark.parametrize(
    ("text", "errors"),
    [
        # What is missing may be in the hidden lines.
        ("model:\n- if:\n    condition: 1\n    body: %a\n- else: {b: }", ["4 yaml-quote"]),
        ("model:\n- if:\n    %condition: 1\n    body: {a: }", ["3 yaml-quote"]),
        ("model:\n- %if:\n    condition: 1\n- else: {a: }", ["2 yaml-quote"]),
        ("model:\n- for:\n    iterator: [i\n    in: [1]\n    body: {a: }", ["3 yaml-open"]),
        ("out:\n  if:\n    condition: !a\n    body: {a: }", ["3 yaml-tag"]),
        ("%robot: a", ["1 yaml-quote"]),
        # What stands below a key whose value is hidden may belong to something else.
        ("functions:\n  A:\n    input: a    body:\n    - print: 1\nmodel:", ["3 yaml-quote"]),
        # Of one line, one thing is told.
        ("model:\n- a b {c: [d}", ["2 yaml-open"]),
        # What is elsewhere is told, and so is what tells of characters.
        ("a:\n  if:\n    body: {b: }\nc: [1", ["4 yaml-open", "2 missing-key"]),
        ("model:\n- a: x: y\n- b/c=$(: 1", ["2 yaml-quote", "3 unclosed-expression"]),
        ("a:\n- b: x: y\n  c d:\n    e: $(+)", ["2 yaml-quote", "3 bad-name", "4 python-syntax"]),
    ],
)  # fmt: skip
def test_what_hidden_lines_may_have_caused_is_held_back(text: str, errors: list[str]) -> None:
    assert told(text) == errors


def test_warnings_that_hidden_lines_may_have_caused_are_held_back() -> None:
    text = "model:\n- inlcude:\n    path: a\n"
    assert [one.code for one in parsed(text).warnings] == ["misspelt-statement"]
    assert parsed(f"{text}- b: [").warnings == []
    assert [one.code for one in parsed(f"{text}functions: [").warnings] == ["misspelt-statement"]


def test_a_file_too_deep_for_the_stack_is_told_of() -> None:
    deep = "".join(f"{' ' * n}a:\n" for n in range(1, 190))
    assert told(f"model:\n{deep}") == ["1 too-deep"]


def test_a_file_without_errors_loads_nothing_that_is_for_errors() -> None:
    code = (
        "import sys; from yamaro.source import Source; from yamaro.syntax.parser import parse;"
        "parse(Source('variables: {a: 1}  # b', name='t')).require();"
        "print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = done.stdout.split()
    assert "yamaro.syntax.nodes" in loaded
    for name in ("yaml.recovery", "yaml.explanations", "yaml.comments", "yaml.recovery"):
        assert f"yamaro.{name}" not in loaded


@cache
def examples() -> dict[str, str]:
    """Return the texts of the examples that are programs."""
    texts = {str(path): path.read_text() for path in sorted(EXAMPLES.glob("*/*.yaml"))}
    return {name: text for name, text in texts.items() if not parsed(text).errors}


def test_the_examples_are_read() -> None:
    assert len(examples()) >= 11
    assert all(parsed(text).hidden == [] for text in examples().values())


def test_a_file_that_lacks_a_character_is_parsed_and_told_of() -> None:
    choose = random.Random(13)
    faulty = hidden = 0
    for _ in range(DELETIONS):
        name, text = choose.choice(sorted(examples().items()))
        at = choose.randrange(len(text))
        shorter = text[:at] + text[at + 1 :]
        found = parse(Source(shorter, name=name))
        assert isinstance(found.document, Document)
        if not found.errors:
            assert isinstance(yaml.compose(shorter, Loader=yaml.CSafeLoader), yaml.MappingNode)
        assert all(text.startswith("#") for text in (one.text for one in found.comments))
        faulty += bool(found.errors)
        hidden += bool(found.hidden)
    assert faulty > DELETIONS // 5
    assert hidden > DELETIONS // 20
