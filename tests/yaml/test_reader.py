"""YAML text to nodes: repeated keys, merges, anchors, and what is refused."""

from __future__ import annotations

from typing import Any

import pytest

from tests.counting import calls_of
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.yaml.nodes import MappingNode, ScalarNode, SequenceNode, YamlNode
from yamaro.yaml.reader import read, read_fragment

MAX_DEPTH = Limits().yaml_depth


def parse(text: str) -> YamlNode:
    return read(Source(text, name="t.yaml"), reporter=Reporter())


def plain(node: YamlNode) -> Any:
    if isinstance(node, ScalarNode):
        return node.text
    if isinstance(node, SequenceNode):
        return [plain(item) for item in node.items]
    return [(key.text, plain(value)) for key, value in node]


def refused(text: str) -> tuple[str, str, str]:
    """Return code, place and text of the only error."""
    with pytest.raises(YamaroError) as caught:
        parse(text)
    (diagnostic,) = caught.value.diagnostics
    line, column = diagnostic.span.location()
    return diagnostic.code, f"{line}:{column}", diagnostic.span.written()


def test_repeated_keys_keep_their_order() -> None:
    assert plain(parse("a: 1\nb: 2\na: 3\n")) == [("a", "1"), ("b", "2"), ("a", "3")]


def test_nodes_know_where_they_stand() -> None:
    root = parse("a: &x [1, 'two']\nb: {c: \"d\"}\n")
    assert isinstance(root, MappingNode)
    (a, items), (_, inner) = root.pairs
    assert [a.span().written(), items.span().written()] == ["a", "[1, 'two']"]
    assert isinstance(items, SequenceNode)
    assert isinstance(inner, MappingNode)
    assert [item.span().written() for item in items.items] == ["1", "'two'"]
    assert inner.span().written() == '{c: "d"}'
    assert (items.is_flow, root.is_flow) == (True, False)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a: &x {p: 1, q: 2}\nb: {r: 0, <<: *x, p: 3}", [("r", "0"), ("q", "2"), ("p", "3")]),
        ("a: &x {p: 1}\nb: {<<: [*x, {p: 2, q: 3}]}", [("p", "1"), ("q", "3")]),
        ("a: &x {p: 1, p: 2}\nb: {<<: *x}", [("p", "1"), ("p", "2")]),
        ("a: &x [{p: 1}, {p: 2}]\nb: {<<: *x}", [("p", "1"), ("p", "2")]),
        ("a: &x {p: 1}\nb: {'<<': *x}", [("<<", [("p", "1")])]),
        ("a: &x {p: 1}\nb: {<<: *x, <<: {q: 2}}", [("p", "1"), ("q", "2")]),
    ],
)
def test_merges_stand_where_they_are_written(text: str, expected: Any) -> None:
    assert plain(parse(text))[1] == ("b", expected)


def test_an_anchor_may_be_given_anew() -> None:
    assert plain(parse("a: &x 1\nb: *x\nc: &x [2]\nd: *x")) == [
        ("a", "1"), ("b", "1"), ("c", ["2"]), ("d", ["2"]),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ("empty-file", "1:1", "")),
        ("# only a comment\n", ("empty-file", "1:1", "")),
        ("a: 1\n---\nb: 2\n", ("several-documents", "2:1", "---")),
        ("a: !!str 1\n", ("yaml-tag", "1:4", "!!str")),
        ("a: &x !t [1]\n", ("yaml-tag", "1:7", "!t")),
        ("a: [!t ]\n", ("yaml-tag", "1:5", "!t")),
        ("[a]: 1\n", ("complex-key", "1:1", "[a]")),
        ("a: *x\n", ("undefined-alias", "1:4", "*x")),
        ("a: &x [*x]\n", ("alias-cycle", "1:8", "*x")),
        ("a: {<<: 1}\n", ("bad-merge", "1:9", "1")),
        ("a: \x07\n", ("control-character", "1:4", "\x07")),
        ("a: é\x7f\n", ("control-character", "1:5", "\x7f")),
        ("a: 1\ufeff\n", ("misplaced-bom", "1:5", "\ufeff")),
        ("'a'/b: \n  c: 1\n", ("yaml-quote", "1:1", "'a'/b")),
        ("- 'a'b: c\n", ("yaml-quote", "1:3", "'a'b")),
    ],
)
def test_what_has_no_meaning_is_refused_at_its_place(
    text: str, expected: tuple[str, str, str]
) -> None:
    assert refused(text) == expected


def test_endless_depth_is_refused() -> None:
    assert refused("[" * (MAX_DEPTH + 5))[0] == "too-deep"
    parse("[" * (MAX_DEPTH - 5) + "]" * (MAX_DEPTH - 5))


def test_aliases_of_aliases_cannot_fill_the_memory() -> None:
    lines = ["l0: &l0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"l{n}: &l{n} [{', '.join([f'*l{n - 1}'] * 10)}]" for n in range(1, 9)]
    assert refused("\n".join(lines))[0] == "alias-bomb"


def test_an_empty_scalar_has_an_empty_place() -> None:
    root = parse("a: &x\nb: {c, d: }\n")
    assert isinstance(root, MappingNode)
    for _, node in [root.pairs[0], *root.pairs[1][1]]:  # type: ignore[misc]
        assert isinstance(node, ScalarNode)
        assert (node.text, node.start) == ("", node.end)


def test_a_fragment_is_placed_in_its_file() -> None:
    root = parse("a: 'x = [1, \"two\"]'\n")
    assert isinstance(root, MappingNode)
    scalar = root.pairs[0][1]
    assert isinstance(scalar, ScalarNode)
    start = scalar.text.index("[")
    fragment = read_fragment(scalar, start, len(scalar.text))
    assert isinstance(fragment, SequenceNode)
    assert plain(fragment) == ["1", "two"]
    assert fragment.items[0].span().written() == "1"
    assert fragment.items[1].span().written() == '"two"'


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("a:\n  #text: x\n", ["comment-entry"]),
        ("a:\n  - #comment: x\n", ["comment-entry"]),
        ("a: |\n  #text: x\n", []),
        ("a: 1 # see #text: below\n", []),
        ("b: &x [1]\na: [*x, *x]\n# c\n#text: x\n", ["comment-entry"]),
    ],
)
def test_a_comment_that_looks_like_text_is_a_warning(text: str, codes: list[str]) -> None:
    reporter = Reporter()
    read(Source(text, name="t.yaml"), reporter=reporter)
    assert [warning.code for warning in reporter.diagnostics] == codes


def test_the_work_grows_with_the_number_of_comment_entries_and_no_faster() -> None:
    def work(count: int) -> int:
        return calls_of(lambda: parse("a:\n" + "  # b\n  #comment: c\n  d: e\n" * count))

    assert work(1_000) < 11 * work(100)


def test_an_anchor_may_end_the_file() -> None:
    assert plain(parse("a: &x")) == [("a", "")]


@pytest.mark.parametrize("text", ["x #text: y", "- #text: y\n  b: 1", "b: #text: y"])
def test_only_a_line_that_begins_like_an_entry_is_one(text: str) -> None:
    reporter = Reporter()
    read(Source(text, name="t.yaml"), reporter=reporter)
    expected = ["comment-entry"] if text.startswith("-") else []
    assert [warning.code for warning in reporter.diagnostics] == expected


@pytest.mark.parametrize("between", [" ", "\n", " # a note\n", "   #'\n\n", "\n# one\n  # two\n"])
def test_a_scalar_begins_behind_its_anchor_and_comments(between: str) -> None:
    text = f"\n&a{between}two words"
    node = parse(text)
    assert isinstance(node, ScalarNode)
    assert text[node.start : node.end] == node.text == "two words"


def test_numbers_with_units_are_converted_where_that_is_asked() -> None:
    text = "[!degrees 180, !radians 2, !millimeters 5, !meters 1, !foot 1, !inches 1, 3]"
    node = read(Source(text, name="t.yaml"), reporter=Reporter(), units=True)
    assert [float(each) for each in plain(node)] == pytest.approx(
        [3.141592653589793, 2, 0.005, 1, 0.3048, 0.0254, 3]
    )
    with pytest.raises(YamaroError, match="yaml-tag"):
        parse(text)


def test_a_unit_needs_a_number() -> None:
    with pytest.raises(YamaroError, match="'pi' is not a number, which !radians requires"):
        read(Source("a: !radians pi", name="t.yaml"), reporter=Reporter(), units=True)
