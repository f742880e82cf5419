"""Sources as YAML: how they are laid out, and that two readers find in them what they hold."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from yamaro.diagnostics import Reporter
from yamaro.source import Source
from yamaro.tools.migrate.document import (
    Body,
    Entry,
    Quoted,
    element_key,
    literal,
)
from yamaro.tools.migrate.writing import write_document
from yamaro.yaml.nodes import MappingNode, ScalarNode, SequenceNode, type_plain
from yamaro.yaml.reader import read

Pairs = list[tuple[str, Any]]


def pairs_of(body: Body) -> Pairs:
    """Return what a body holds; an empty value and an empty body are nothing."""
    return [
        (e.key, (pairs_of(e.value) or "") if isinstance(e.value, Body) else str(e.value or ""))
        for e in body
    ]


def read_by_yamaro(text: str) -> Pairs:
    reporter = Reporter()
    node = read(Source(text, name="robot.yaml", path=""), reporter=reporter)
    assert reporter.diagnostics == []
    return pairs_of_node(node)


def pairs_of_node(node: Any) -> Any:
    if isinstance(node, MappingNode):
        return [(key.text, pairs_of_node(value)) for key, value in node.pairs]
    if isinstance(node, SequenceNode):
        return [pair for item in node.items for pair in pairs_of_node(item)]
    assert isinstance(node, ScalarNode)
    return node.text


def read_by_ruamel(text: str) -> Pairs:
    ruamel = pytest.importorskip("ruamel.yaml")
    return pairs_of_value(ruamel.YAML(typ="base", pure=True).load(StringIO(text)))


def pairs_of_value(value: Any) -> Any:
    if isinstance(value, dict):
        return [(key, pairs_of_value(inner)) for key, inner in value.items()]
    if isinstance(value, list):
        return [pair for item in value for pair in pairs_of_value(item)]
    return value


def written(body: Body, comment: str = "") -> str:
    """Return a document in which both readers find what it holds."""
    text = write_document(body, comment)
    assert read_by_yamaro(text) == pairs_of(body)
    assert read_by_ruamel(text) == pairs_of(body)
    return text


def body(*pairs: tuple[str, Any], in_braces: bool = False) -> Body:
    return Body([Entry(*pair) for pair in pairs], in_braces=in_braces)


# --- layout ---------------------------------------------------------------------------------------


def test_entries_stand_below_each_other() -> None:
    inner = body(("b", "1"), ("c", None))
    assert written(body(("a", inner), ("d", "2"))) == "a:\n  b: 1\n  c:\nd: 2\n"


def test_keys_that_come_again_make_a_list() -> None:
    inner = body(("b", "1"))
    text = written(body(("a", inner), ("a", "2"), ("c", None)))
    assert text == "- a:\n    b: 1\n- a: 2\n- c:\n"


def test_a_list_is_right_below_its_key() -> None:
    text = written(body(("x", body(("a", "1"), ("a", body(("b", "2"), ("b", "3")))))))
    assert text == "x:\n- a: 1\n- a:\n  - b: 2\n  - b: 3\n"


def test_braces_hold_what_fits_into_the_line() -> None:
    inner = body(("b", "1"), ("c", body(("d", "2"), in_braces=True)), in_braces=True)
    assert written(body(("a", inner))) == "a: {b: 1, c: {d: 2}}\n"


@pytest.mark.parametrize(
    "inner",
    [
        body(("b", "1"), ("b", "2"), in_braces=True),
        body(*[(name, "1") for name in "bcdefgh"], in_braces=True),
        body(("b", body(("c", "1"))), in_braces=True),
        body(("b", "x" * 100), in_braces=True),
    ],
    ids=["keys come again", "too many", "a body with lines of its own", "too long"],
)
def test_what_is_too_much_for_braces_has_lines_of_its_own(inner: Body) -> None:
    assert written(body(("a", inner))).startswith(("a:\n  ", "a:\n- "))


def test_a_line_with_braces_may_have_100_characters() -> None:
    fits = body(("a", body(("b", "x" * (100 - len("a: {b: }"))), in_braces=True)))
    assert len(written(fits)) == len("\n") + 100
    longer = body(("a", body(("b", "x" * (101 - len("a: {b: }"))), in_braces=True)))
    assert written(longer).count("\n") == 2


def test_one_with_attributes_only_may_have_more() -> None:
    limit = Body([Entry("b", "x" * (120 - len("a: {b: }")))], in_braces=True, width=120)
    assert len(written(body(("a", limit)))) == len("\n") + 120


def test_a_text_of_several_lines_is_a_block() -> None:
    assert written(body(("a", body(("b", "one\n\n two"))))) == "a:\n  b: |-\n    one\n\n     two\n"


def test_a_block_that_begins_with_space_tells_its_indentation() -> None:
    assert written(body(("a", "  one\ntwo"))) == "a: |2-\n    one\n  two\n"


def test_a_long_key_is_marked() -> None:
    assert written(body(("k" * 1001, "1"))) == f"? {'k' * 1001}\n: 1\n"
    assert written(body(("k" * 1001, body(("a", None))))) == f"? {'k' * 1001}\n:\n  a:\n"


def test_comments_stand_above_their_entries_and_at_the_end() -> None:
    inner = body(("b", "1"))
    inner.note("the end\n\nof it")
    whole = Body()
    whole.note("first")
    whole.append(Entry("a", inner, "second"))
    text = written(whole, "the file")
    assert text == "# the file\n# first\n# second\na:\n  b: 1\n  # the end\n  #\n  # of it\n"


def test_comments_in_braces_stand_above_them() -> None:
    inner = Body(in_braces=True)
    inner.note("of b")
    inner.add("b", "1")
    inner.note("of the end")
    assert written(body(("a", inner))) == "# of b\n# of the end\na: {b: 1}\n"
    twice = body(("a", inner), ("a", None))
    assert written(twice) == "# of b\n# of the end\n- a: {b: 1}\n- a:\n"


def test_the_entries_of_another_body_come_with_its_remarks() -> None:
    other = body(("b", "1"))
    other.note("of c")
    whole = Body()
    whole.note("of b")
    whole.extend(other)
    whole.add("c")
    assert written(whole) == "# of b\nb: 1\n# of c\nc:\n"


# --- quoting --------------------------------------------------------------------------------------

PLAIN = ["a b", "a#b", "a:b", "-a", "-1", "?a", ":a", "a's", 'a "b"', "$(a)", "a\\b", "é"]
QUOTED = {
    "": "''",
    "~": "'~'",
    "null": "'null'",
    " a": "' a'",
    "a ": "'a '",
    "a: b": "'a: b'",
    "a #b": "'a #b'",
    "a:": "'a:'",
    "#a": "'#a'",
    "- a": "'- a'",
    "-": "'-'",
    "? a": "'? a'",
    "---": "'---'",
    "... a": "'... a'",
    "'a'": "\"'a'\"",
    '"a"': "'\"a\"'",
    "'a\"": "'''a\"'",
    "@a": "'@a'",
    "`a": "'`a'",
    "%a": "'%a'",
    "*a": "'*a'",
    "&a": "'&a'",
    "!a": "'!a'",
    "|": "'|'",
    ">a": "'>a'",
    "[a]": "'[a]'",
    "{a}": "'{a}'",
    ",a": "',a'",
    "a\tb": '"a\\tb"',
    'a\t"\\': '"a\\t\\"\\\\"',
    "a\x85\u2028\U000e0001": '"a\\x85\\u2028\\U000e0001"',
}


@pytest.mark.parametrize("text", PLAIN)
def test_what_reads_as_a_text_is_plain(text: str) -> None:
    assert written(body(("k", text))) == f"k: {text}\n"


@pytest.mark.parametrize(("text", "yaml"), QUOTED.items())
def test_what_would_read_as_something_else_is_quoted(text: str, yaml: str) -> None:
    out = write_document(body(("k", text)))
    assert out == f"k: {yaml}\n"
    assert read_by_yamaro(out) == read_by_ruamel(out) == [("k", text)]


@pytest.mark.parametrize("text", ["a, b", "a]", "a}", "[a", "{a", "?a", ":a"])
def test_in_braces_more_is_quoted(text: str) -> None:
    out = written(body(("a", body(("k", text), (text, "v"), in_braces=True))))
    assert out == f"a: {{k: '{text}', '{text}': v}}\n"


@pytest.mark.parametrize("text", ["1", "-1.5", "1e-4", "0x1f", ".inf", "true", "False"])
def test_a_value_that_is_to_be_a_text_is_quoted(text: str) -> None:
    assert written(body(("k", text))) == f"k: {text}\n"
    assert written(body(("k", Quoted(text)))) == f"k: '{text}'\n"
    assert written(body(("k", Quoted(f"a{text}")))) == f"k: a{text}\n"


def test_line_breaks_in_braces_are_escaped() -> None:
    inner = body(("k", "a\nb"), in_braces=True)
    assert written(body(("a", inner))) == 'a: {k: "a\\nb"}\n'


@pytest.mark.parametrize(
    ("attributes", "key"),
    [
        ({}, "a"),
        ({"b": "1"}, "a/b=1"),
        ({"b": "1 2", "c": ""}, "a/b=1 2, c="),
        ({"b": "1, 2"}, "a/b='1, 2'"),
        ({"b": " 1"}, "a/b=' 1'"),
        ({"b": "it's, so"}, 'a/b="it\'s, so"'),
        ({"b": "'a'"}, "a/b=\"'a'\""),
        ({"b": "$(c)"}, "a/b=$(c)"),
        ({"b": "$$(c), d"}, "a/b='$$(c), d'"),
        ({"b": "$(c(1, 'x'))"}, "a/b=$(c(1, 'x'))"),
        ({"b": "'a', \"b\""}, "a/b=$('\\'a\\', \"b\"')"),
    ],
)
def test_an_element_is_a_key(attributes: dict[str, str], key: str) -> None:
    assert element_key("a", attributes) == key
    assert element_key("a", attributes, bracketed=True) == f"<{key}>"


def test_nothing_in_a_literal_is_evaluated() -> None:
    assert literal("$(a) ${b} $c $$") == "$$(a) $${b} $c $$"


# --- whatever it holds ----------------------------------------------------------------------------

CHARACTERS = st.one_of(
    st.sampled_from(" -?:,[]{}#&*!|>'\"%@`~=\\$()/.0127aeinotrux"),
    st.characters(exclude_categories=["Cs", "Cc"]),
    st.sampled_from("\t\x85\xa0"),
)
WORDS = st.text(CHARACTERS, max_size=12)
LINES = st.lists(st.text(CHARACTERS, max_size=8).map(str.rstrip), min_size=2, max_size=4)


def is_one_text(lines: list[str]) -> bool:
    return bool(lines[0].strip() and lines[-1].strip())


VALUES = st.one_of(st.none(), WORDS, WORDS.map(Quoted), LINES.filter(is_one_text).map("\n".join))


def bodies(values: st.SearchStrategy[Any]) -> st.SearchStrategy[Body]:
    keys = WORDS.filter(lambda key: key != "<<")  # no name in XML, and a merge in YAML
    entries = st.lists(st.builds(Entry, keys, values), min_size=1, max_size=8)
    return st.builds(Body, entries, in_braces=st.booleans())


@given(bodies(st.recursive(VALUES, bodies, max_leaves=12)))
def test_whatever_a_source_holds_is_read_from_it(whole: Body) -> None:
    written(whole)


@given(WORDS)
def test_a_quoted_text_is_never_anything_else(text: str) -> None:
    out = write_document(body(("k", Quoted(text))))
    value = out.removeprefix("k: ").removesuffix("\n")
    assert value[0] in "'\"" or isinstance(type_plain(value), str)


@pytest.mark.parametrize(
    "text",
    [
        " ".join(f"$({'x' * 20}{number})" for number in range(8)),
        " ".join(f"$(word{number} + 'two words: one' * 2)" for number in range(8)),
        f"$({' + '.join(f'number_{number}' for number in range(30))})",
        f"it's {'quoted: ' * 20}text",
        f""""it's" {"both " * 30}""".strip(),
        f"$(' # '.join([{'1, ' * 50}]))",
        "word " * 40 + "# no",
        "two  spaces " * 20,
        "- " * 80 + "x",
        "a: b " * 40 + "c",
        "x" * 300,
        " leading " + "word " * 40,
        "back\\slash it's " * 20 + '"',
    ],
)
def test_a_long_value_goes_on_in_the_next_line_and_is_read_as_it_was(text: str) -> None:
    body = Body()
    body.add("inner", Body([Entry("key", text)]))
    written = write_document(body)
    assert read_by_yamaro(written) == [("inner", [("key", text)])]
    assert read_by_ruamel(written) == [("inner", [("key", text)])]
    if text.strip() == text and "  " not in text and "\\" not in text and " " in text:
        assert all(len(line) <= 100 for line in written.splitlines())
