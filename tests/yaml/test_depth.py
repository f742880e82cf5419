"""Text that is nested more deeply than libyaml reads: 1,000 levels from version 0.2.6 on."""

from __future__ import annotations

from typing import Any

import pytest

from yamaro.diagnostics import YamaroError
from yamaro.layout import Layout
from yamaro.policy import TRUSTED, Limits
from yamaro.source import Source
from yamaro.yaml.comments import find_comments
from yamaro.yaml.libyaml import DeepParser
from yamaro.yaml.nodes import MappingNode
from yamaro.yaml.pure import PureParser
from yamaro.yaml.reader import NodeBuilder

DEPTH = 1500
TEXTS = {
    "brackets": "&a x: " + "[" * DEPTH + "]" * DEPTH + " # end\n",
    "braces": "x: " + "{a: " * DEPTH + "}" * DEPTH + " # end\n",
    "block": "".join(" " * level + "a:\n" for level in range(DEPTH)) + " " * DEPTH + "b # end\n",
    "dashes": "- " * DEPTH + "b # end\n",
}


def everything(parser: Any, what: str) -> list[tuple[Any, ...]]:
    found = []
    while (next_one := getattr(parser, what)()) is not None:
        marks = next_one.start_mark.index, next_one.end_mark.index
        found.append((type(next_one).__name__, getattr(next_one, "value", None), *marks))
    return found


@pytest.mark.parametrize("what", ["get_event", "get_token"])
@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_a_deep_text_gives_what_the_parser_in_python_reads(text: str, what: str) -> None:
    assert everything(DeepParser(text), what) == everything(PureParser(text), what)


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_nodes_comments_and_layout_of_a_deep_text(text: str) -> None:
    source = Source(text, name="deep.yaml")
    root = NodeBuilder(source, Limits(TRUSTED, yaml_depth=DEPTH + 5)).build()
    depth = 0
    node: Any = root
    while children := (
        [value for _, value in node.pairs]
        if isinstance(node, MappingNode)
        else getattr(node, "items", [])
    ):
        node, depth = children[0], depth + 1
    assert depth >= DEPTH - 1
    assert [source.text[one.start : one.end] for one in find_comments(source, text)] == ["# end"]
    assert "".join(Layout(text).run().split()) == "".join(text.split())


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS.keys())
def test_the_limit_is_named_and_not_what_libyaml_says(text: str) -> None:
    with pytest.raises(YamaroError) as caught:
        NodeBuilder(Source(text, name="deep.yaml"), Limits(TRUSTED, yaml_depth=1200)).build()
    assert [one.code for one in caught.value.diagnostics] == ["too-deep"]
