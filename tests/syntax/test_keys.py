"""Plain keys, which are read by a short way, say what the grammar of keys says."""

from __future__ import annotations

from typing import Any

from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.effort import examples
from yamaro.diagnostics import INHERITED, Reporter, YamaroError
from yamaro.rendering import render
from yamaro.source import Source
from yamaro.syntax.context import ParseContext
from yamaro.syntax.keys import PlainKeyPlaces, find_outside, parse_plain_key
from yamaro.syntax.nodes import Body, ElementNode
from yamaro.syntax.parser import parse
from yamaro.syntax.python import skip_expression
from yamaro.syntax.statements import parse_pairs, parse_statement
from yamaro.xml.tree import Comment, Element, Text
from yamaro.yaml.nodes import PLAIN, ScalarNode

words = [
    "link",
    "a",
    "b",
    "name",
    "if",
    "Arm",
    "é",
    "x:y",
    "_",
    "-",
    ".",
    "1",
    "xyz=0 0 1",
    "#text",
]
signs = [
    "/",
    "=",
    "==",
    ",",
    " ",
    "  ",
    ":",
    "\t",
    "\u00a0",
    "'",
    '"',
    "$",
    "$(a)",
    "$$(",
    "(",
    "<",
]
pieces = st.sampled_from(words + signs)
keys = st.lists(pieces, min_size=1, max_size=12).map("".join) | st.lists(
    st.tuples(pieces, pieces, pieces).map("".join), min_size=1, max_size=4
).map(lambda found: "link/" + ", ".join(found))


def node_of(text: str) -> ScalarNode:
    return ScalarNode(text, PLAIN, Source(f"- {text}:\n", name="t.yaml"), 2, 2 + len(text))


def nothing(key: ScalarNode) -> ScalarNode:
    """Return the empty value behind a key."""
    return ScalarNode("", PLAIN, key.source, key.end + 1, key.end + 1)


def by_the_grammar(key: ScalarNode) -> object:
    """Return all that the whole grammar makes of a key without content, or what it says of it."""
    try:
        node: Any = parse_statement(key, nothing(key), ParseContext(Reporter()))
    except YamaroError as error:
        return [render(diagnostic) for diagnostic in error.diagnostics]
    if not isinstance(node, ElementNode):
        return type(node)
    found = [(own.name, own.value, own.span.key(), own.name_span.key()) for own in node.attributes]
    return node.name, found


@settings(max_examples=examples(500))
@given(keys)
@example("link/name=a, type=b")
@example("link/name:=a")
@example("link/a=1, a=2")
@example("link/a=,b= ")
@example("link/a=1,")
@example("link /a='1, 2', b=3")
@example("part /a=1")
def test_a_plain_key_says_what_the_grammar_says(text: str) -> None:
    plain = parse_plain_key(text)
    if plain is None:
        return
    key = node_of(text)
    name, attributes = plain

    places = PlainKeyPlaces(key) if attributes else None
    element = Element(name, key, attributes=attributes, value_spans=places)
    assert by_the_grammar(key) == (
        name,
        [
            (own, value, element.value_span(own).key(), element.name_span(own).key())
            for own, value in attributes.items()
        ],
    )
    assert places is None or places.get("no_attribute") is None


@settings(max_examples=examples(500))
@given(keys)
def test_a_key_in_a_body_says_what_the_grammar_says(text: str) -> None:
    key = node_of(text)
    expected = by_the_grammar(key)
    for statement in put_out_twice(key, expected):
        if isinstance(statement, Element):
            found = [
                (own, value, statement.value_span(own).key())
                for own, value in statement.attributes.items()
            ]
            assert isinstance(expected, tuple)
            assert (statement.name, found) == (expected[0], [own[:3] for own in expected[1]])


def put_out_twice(key: ScalarNode, expected: object) -> list[object]:
    """Return what a body makes of a key that stands in it twice: first new, then known."""
    context = ParseContext(Reporter())
    body = parse_pairs([(key, nothing(key)), (key, nothing(key))], context)
    errors = [render(error) for error in context.errors]
    assert errors == (expected * 2 if isinstance(expected, list) else [])
    return list(body.statements)


@settings(max_examples=examples(500))
@given(keys, st.sampled_from(["/", "=,", ",", " ", "'"]), st.integers(0, 9), st.integers(0, 40))
def test_signs_are_found_as_by_looking_at_each(text: str, signs: str, start: int, end: int) -> None:
    end = min(end, len(text))
    at, expected = start, -1
    while at < end and expected < 0:
        after = skip_expression(text, at)
        if after == at and text[at] in signs:
            expected = at
        at = max(after, at + 1)
    assert find_outside(text, signs, start, end) == expected


def test_what_is_not_evaluated_is_made_once() -> None:
    text = """
model:
- link/name=base:
    visual:
      <#comment>: a -- b
    inertial:
      <#comment>: a - b
      mass: 1
      <#text>: x
      <origin>:
      origin/xyz='0, 1':
      part: {}
- link/name=$(name):
    mass: null
"""
    document = parse(Source(text, name="t.yaml")).require()
    base, dynamic = document.model[0].statements
    assert isinstance(base, ElementNode), "a comment in it may fail"
    inertial = statements_in(base)[1]
    assert isinstance(inertial, ElementNode), "a part is run"
    comment, mass, words, origin, placed, _ = statements_in(inertial)
    assert isinstance(comment, Comment)
    assert isinstance(words, Text)
    for element in (mass, origin, placed, statements_in(dynamic)[0]):
        assert isinstance(element, Element)
        assert element.trace is INHERITED
    assert mass.body is origin.body is inertial.content
    assert (mass.verbatim, origin.verbatim) == (False, True)
    assert [child.value for child in mass.children] == ["1"]
    assert placed.attributes == {"xyz": "0, 1"}
    assert placed.value_span("xyz").written() == "0, 1"


def statements_in(node: object) -> list[Any]:
    """Return what stands in an element that is run."""
    assert isinstance(node, ElementNode)
    assert isinstance(node.content, Body)
    return list(node.content.statements)
