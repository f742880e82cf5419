"""Reading on behind what is no YAML: what is told, what is hidden, and what is still read."""

from __future__ import annotations

from typing import Any

import pytest

from yamaro.diagnostics import Reporter
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.yaml.nodes import MappingNode, ScalarNode, SequenceNode
from yamaro.yaml.reader import Reading, read_on
from yamaro.yaml.recovery import MAX_FAULTS


def read(text: str) -> Reading:
    return read_on(Source(text, name="t.yaml"), reporter=Reporter(), limits=Limits())


def plain(node: Any) -> Any:
    if isinstance(node, ScalarNode):
        return node.text
    if isinstance(node, SequenceNode):
        return [plain(item) for item in node.items]
    if isinstance(node, MappingNode):
        return [(key.text, plain(value)) for key, value in node]
    return None


def errors(text: str) -> list[str]:
    """Return line and code of each error."""
    return [f"{one.span.location()[0]} {one.code}" for one in read(text).errors]


@pytest.mark.parametrize(
    ("text", "told", "left"),
    [
        # A value is hidden, and its key stays.
        ("a: [1, 2\nb: 3", ["1 yaml-open"], [("a", ""), ("b", "3")]),
        ("a: x: y\nb: 3", ["1 yaml-quote"], [("a", ""), ("b", "3")]),
        ("a: %x\nb: 3", ["1 yaml-quote"], [("a", ""), ("b", "3")]),
        ('a: "x\nb: "y"\nc: 1', ["1 yaml-open"], [("a", ""), ("b", "y"), ("c", "1")]),
        ('a: "\\q"\nb: 3', ["1 yaml-escape"], [("a", ""), ("b", "3")]),
        # What a value goes on with goes with it, and so does a bracket that closes it.
        ("a: [1,\n  2: 3: 4,\n  5\n]\nb: 3", ["1 yaml-open"], [("a", ""), ("b", "3")]),
        ("a: {b: 1,\n  c: [1}\nd: 2", ["2 yaml-open"], [("a", ""), ("d", "2")]),
        ("a: | x\n  y\nb: 3", ["1 yaml-syntax"], [("a", ""), ("b", "3")]),
        # The lines below a key stay, where only its value was at fault.
        ("a: x: y\n  b: 1\nc: 2", ["1 yaml-quote"], [("a", [("b", "1")]), ("c", "2")]),
        # A line without a key goes with what is below it.
        ("a: 1\nfoo\n  b: 1\nc: 2", ["2 yaml-syntax"], [("a", "1"), ("c", "2")]),
        ("a:\n  b: 1\n  foo\n  c: 2", ["3 yaml-syntax"], [("a", [("b", "1"), ("c", "2")])]),
        # Of an item of a list its other entries stay; without any, the dash goes, too.
        ("- a: [1\n  b: 2\n- c: 3", ["1 yaml-open"], [[("a", ""), ("b", "2")], [("c", "3")]]),
        ("- %a\n- c: 3", ["1 yaml-quote"], [[("c", "3")]]),
        # Lines that do not fit are told of once.
        ("a: 1\n  b: 2\n  c: 3\nd: 4", ["2 yaml-syntax"], [("a", "1"), ("d", "4")]),
        ("a:\n\tb: 1\n\tc: 2\nd: 4", ["2 yaml-tab"], [("a", ""), ("d", "4")]),
        ("a:\n    b: 1\n  c: 2\n  d: 3", ["3 yaml-syntax"], [("a", [("c", "2"), ("d", "3")])]),
        ("a:\n- b: 1\n-c: 2\n- d: 3", ["4 yaml-syntax"], [("a", [[("b", "1")], [("d", "3")]])]),
        # Faults of the nodes hide nothing else.
        ("a: !x 1\nb: *c\nd: 2", ["1 yaml-tag", "2 undefined-alias"],
         [("a", "1"), ("b", ""), ("d", "2")]),
        ("a: {b: 1}\n---\nc: 2", ["2 several-documents"], [("a", [("b", "1")])]),
        ("? [a]\n: 1\nb: 2", ["1 complex-key"], [("", "1"), ("b", "2")]),
        ("a:\n  <<: 1\n  b: 2", ["2 bad-merge"], [("a", [("b", "2")])]),
        ("a: &x\n  b: *x\nc: 1", ["2 alias-cycle"], [("a", [("b", "")]), ("c", "1")]),
        # Characters that YAML forbids are blanks.
        ("a: 1\x00\nb: \x07\nc: 3", ["1 control-character", "2 control-character"],
         [("a", "1"), ("b", ""), ("c", "3")]),
        ("a: 1\nb: \ufeff2", ["2 misplaced-bom"], [("a", "1"), ("b", "2")]),
        # Several faults.
        ("a: [1\nb: %c\nd: 'x' y\ne: 1", ["1 yaml-open", "2 yaml-quote", "3 yaml-quote"],
         [("a", ""), ("b", ""), ("d", ""), ("e", "1")]),
        # Nothing can be had of these.
        ("\x00\x01\x02\x00\x00\x00", ["1 control-character"], None),
        ("", ["1 empty-file"], None),
        ("# nothing", ["1 empty-file"], None),
    ],
)  # fmt: skip
def test_a_fault_hides_what_belongs_to_it(text: str, told: list[str], left: Any) -> None:
    assert errors(text) == told
    assert plain(read(text).root) == left


def test_an_anchor_that_is_hidden_is_not_missed() -> None:
    assert errors("a: [&x 1\nb: *x\nc: *y") == ["1 yaml-open", "3 undefined-alias"]


def test_what_is_hidden_is_told_and_keeps_offsets() -> None:
    reading = read("a: 1\nb: [1, 2 # why\nc: é\n")
    assert [(span.start, span.end) for span in reading.hidden] == [(8, 19)]
    assert reading.text == "a: 1\nb:       # why\nc: é\n"


def test_a_fault_too_deep_hides_one_value() -> None:
    deep = "[" * 300 + "]" * 300
    assert errors(f"a: {deep}\nb: 1") == ["1 too-deep"]
    assert plain(read(f"a: {deep}\nb: 1").root) == [("a", ""), ("b", "1")]


def test_aliases_that_expand_without_measure_are_told_of_once() -> None:
    lines = ["a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 12)]
    reading = read("\n".join(lines))
    assert [error.code for error in reading.errors] == ["alias-bomb"]
    assert reading.root is None


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_faults_without_end_hide_the_rest(end: str) -> None:
    text = end.join(["a: 1", *(f"b{n}: x: y" for n in range(MAX_FAULTS + 9)), "c: 1"])
    reading = read(text)
    assert len(reading.errors) == MAX_FAULTS + 1
    keys = [key for key, _ in plain(reading.root)]
    assert keys == ["a", *(f"b{n}" for n in range(MAX_FAULTS))]
    assert len(reading.text) == len(text)
