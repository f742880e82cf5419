"""`$(…)` inside texts: what is an expression, what is not, and where it stands."""

from __future__ import annotations

import pytest

from yamaro.diagnostics import Reporter, YamaroError
from yamaro.source import Source
from yamaro.syntax.context import ParseContext
from yamaro.syntax.keys import find_outside
from yamaro.syntax.python import (
    PythonCode,
    Template,
    expression_without_dollars,
    parse_template,
    ros_call,
    ros_words,
    skip_expression,
)
from yamaro.yaml.nodes import PLAIN, ScalarNode


def parse(text: str) -> tuple[str | Template, list[str]]:
    """Return the parsed text and the codes of its warnings."""
    context = ParseContext(Reporter())
    node = ScalarNode(text, PLAIN, Source(text, name="t.yaml"), 0, len(text))
    parsed = parse_template(node, context=context)
    return parsed, [warning.code for warning in context.reporter.diagnostics]


def parts(text: str) -> list[tuple[str, str]] | str:
    parsed, _ = parse(text)
    if isinstance(parsed, str):
        return parsed
    return [
        ("text", part) if isinstance(part, str) else ("expression", part.span().written())
        for part in parsed.parts
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("plain", "plain"),
        ("$", "$"),
        ("5 $ and $x", "5 $ and $x"),
        ("$$(x)", "$(x)"),
        ("$$$(x)", "$$(x)"),
        ("$${x}", "${x}"),
        ("$(x)", [("expression", "x")]),
        ("a$(x)b", [("text", "a"), ("expression", "x"), ("text", "b")]),
        ("$(x)$( y )", [("expression", "x"), ("expression", "y")]),
        ("$(f(')'))!", [("expression", "f(')')"), ("text", "!")]),
        ("$$(a)$(b)", [("text", "$(a)"), ("expression", "b")]),
    ],
)
def test_texts_fall_into_pieces(text: str, expected: object) -> None:
    assert parts(text) == expected


def test_a_template_knows_its_places() -> None:
    parsed, _ = parse("ab $(x) $(y)")
    assert isinstance(parsed, Template)
    assert parsed.span().written() == "ab $(x) $(y)"
    first = parsed.parts[1]
    assert isinstance(first, PythonCode)
    assert first.span().written() == "x"


def test_xacros_spelling_is_a_warning() -> None:
    assert parse("${x} and ${y")[1] == ["xacro-syntax", "xacro-syntax"]
    assert parse("$${x}")[1] == []


@pytest.mark.parametrize(
    ("text", "code", "place"),
    [
        ("a $(b", "unclosed-expression", "$("),
        ("a $()", "empty-expression", "$()"),
        ("a $( )", "empty-expression", "$( )"),
        ("a $(1 +) b", "python-syntax", None),
        ("$(a]", "unclosed-expression", "$("),
        ("$('a)", "unclosed-expression", "$("),
    ],
)
def test_faults_are_shown_where_they_stand(text: str, code: str, place: str | None) -> None:
    with pytest.raises(YamaroError) as caught:
        parse(text)
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.code == code
    if place is not None:
        assert diagnostic.span.written() == place


@pytest.mark.parametrize(
    ("text", "call"),
    [
        ("find pkg", "__find__('pkg')"),
        ("find-pkg-share my_pkg", "__find__('my_pkg')"),
        ("arg name", "name"),
        ("env HOME", "__env__('HOME')"),
        ("optenv A b c", "__env__('A', 'b c')"),
        ("optenv A", "__env__('A', '')"),
        ("find - 1", None),
        ("find if x else y", None),
        ("env in x", None),
        ("find a b", None),
        ("other x", None),
        ("find", None),
    ],
)
def test_forms_of_ros_are_two_adjacent_words(text: str, call: str | None) -> None:
    words = ros_words(text)
    assert (ros_call(words) if words else None) == call


@pytest.mark.parametrize(
    ("text", "meaning", "quoted"),
    [
        ("a == 1", "a == 1", []),
        ("$(a) == 'left'", " (a) == 'left'", []),
        ("'$(a)' == b", "'$(a)' == b", [1]),
        ("$(arg a) + 1", "(a) + 1", []),
        ("$(a", " (a", []),
    ],
)
def test_dollars_in_a_condition_are_only_parentheses(
    text: str, meaning: str, quoted: list[int]
) -> None:
    assert expression_without_dollars(text) == (meaning, quoted)


def test_expressions_are_opaque_to_the_grammar_of_keys() -> None:
    text = "a$(b / c)/d"
    assert find_outside(text, "/", 0, len(text)) == 9
    assert skip_expression(text, 1) == 9
    assert skip_expression(text, 0) == 0
    assert skip_expression("a$(b", 1) == 1
    assert find_outside("$(a / b", "/", 0, 7) == 4  # never closed: no expression
    assert find_outside("abc", "/", 0, 3) == -1
