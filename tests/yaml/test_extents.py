"""Where nodes begin and end: the text between, read by itself, is the node again."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from yamaro.diagnostics import Reporter
from yamaro.source import Source
from yamaro.yaml.nodes import FOLDED, LITERAL, MappingNode, ScalarNode, SequenceNode
from yamaro.yaml.reader import read

ROOT = Path(__file__).parents[2]
FILES = sorted(ROOT.glob("examples/*/*.yaml"))


def nodes(root: Any) -> Iterator[Any]:
    yield root
    for child in root.items if isinstance(root, SequenceNode) else ():
        yield from nodes(child)
    for pair in root.pairs if isinstance(root, MappingNode) else ():
        for child in pair:
            yield from nodes(child)


def plain(node: Any) -> Any:
    if isinstance(node, ScalarNode):
        return node.text
    if isinstance(node, SequenceNode):
        return [plain(item) for item in node.items]
    return [(key.text, plain(value)) for key, value in node]


def read_text(text: str) -> Any:
    return read(Source(text, name="t.yaml"), reporter=Reporter())


@pytest.mark.parametrize(
    ("text", "extent"),
    [
        ("a:\n  b: 1 # c\n  # d\n\ne: 2", "b: 1"),
        ("a:\n- b\n- c # d\ne: 2", "- b\n- c"),
        ("a:\n  - [b,\n     c] # d\ne: 2", "- [b,\n     c]"),
        ("a: {b: 1, # c\n  d: 2} # e\n", "{b: 1, # c\n  d: 2}"),
        ("a:\n  b:\n    c:\n\n\nd: 1", "b:\n    c:"),
        ("a:\n  b: c\n    d # e\n\nf: 1", "b: c\n    d"),
        ("a:\n  b: |\n    c\n  d: 'e\n    f' # g\nh: 1", "b: |\n    c\n  d: 'e\n    f'"),
        ("x: &x [1]\na:\n  b: *x # c\nd: 1", "b: *x"),
        ("a: &x\n  b: 1\n  c: 2\nd: 1", "b: 1\n  c: 2"),
        ("a: # b\n  - c: 1\n    d: 2\n\n  # e\nf: 1", "- c: 1\n    d: 2"),
    ],
)
def test_a_collection_ends_with_what_stands_in_it(text: str, extent: str) -> None:
    (node,) = [value for key, value in read_text(text) if key.text == "a"]
    assert node.span().written() == extent


@pytest.mark.parametrize("file", FILES, ids=lambda file: f"{file.parent.name}/{file.stem}")
def test_the_text_of_an_extent_is_the_node(file: Path) -> None:
    text = file.read_text()
    count = 0
    for node in nodes(read_text(text)):
        if node.start == node.end:
            assert node.text == ""
            continue
        if isinstance(node, ScalarNode) and node.text == "null":
            continue  # a document that holds nothing else is empty
        column = Source(text, name="t").location(node.start)[1] - 1
        if isinstance(node, ScalarNode) and node.style in (LITERAL, FOLDED):
            alone = f"a: {text[node.start : node.end]}"
            again = read_text(alone).pairs[0][1]
        else:
            assert text[node.end - 1].strip() or ends_with_block_scalar(node)
            again = read_text(" " * column + text[node.start : node.end])
        assert plain(again) == plain(node)
        count += 1
    assert count > 20


def ends_with_block_scalar(node: Any) -> bool:
    while not isinstance(node, ScalarNode):
        node = node.items[-1] if isinstance(node, SequenceNode) else node.pairs[-1][1]
    return node.style in (LITERAL, FOLDED)
