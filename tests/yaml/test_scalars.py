"""Scalars: typed as YAML 1.2 says, written as numbers are read, traced to where they stand."""

from __future__ import annotations

import re
from decimal import Context, Decimal
from typing import Any

import pytest
import yaml
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from tests.effort import examples
from yamaro.diagnostics import Reporter, YamaroError
from yamaro.source import Source
from yamaro.xml.values import format_number
from yamaro.yaml.nodes import MappingNode, ScalarNode, type_plain
from yamaro.yaml.reader import read

# --- types ------------------------------------------------------------------------------------

# YAML 1.2.2, section 10.3.2, "Tag Resolution" of the core schema, in the order of its table.
CORE_SCHEMA = [
    (re.compile(r"null|Null|NULL|~|"), lambda text: None),
    (re.compile(r"true|True|TRUE"), lambda text: True),
    (re.compile(r"false|False|FALSE"), lambda text: False),
    (re.compile(r"[-+]?[0-9]+"), lambda text: int(text)),
    (re.compile(r"0o[0-7]+"), lambda text: int(text, 8)),
    (re.compile(r"0x[0-9a-fA-F]+"), lambda text: int(text, 16)),
    (re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?"), lambda text: float(text)),
    (re.compile(r"[-+]?(\.inf|\.Inf|\.INF)"), lambda text: float(text.replace(".", ""))),
    (re.compile(r"\.nan|\.NaN|\.NAN"), lambda text: float("nan")),
]

likely = st.text(alphabet="0123456789+-._eExXoObaAfFnNiIlLtTrRuU~:", max_size=8)
spelled = st.one_of([st.from_regex(pattern, fullmatch=True) for pattern, _ in CORE_SCHEMA])


def type_by_the_schema(text: str) -> object:
    for pattern, value_of in CORE_SCHEMA:
        if pattern.fullmatch(text):
            return value_of(text)
    return text


def show(value: object) -> str:
    return f"{type(value).__name__} {value!r}"


@settings(max_examples=examples(1000))
@given(spelled | likely | st.text(max_size=10))
@example("0o8")
@example("0x")
@example("1_000")
@example("1:30")
@example("+0x1")
@example("٣")
@example("1e5")
@example(".e5")
@example(".")
@example("-")
@example("NaN")
@example("infinity")
@example("no")
def test_plain_scalars_are_typed_by_the_core_schema(text: str) -> None:
    assert show(type_plain(text)) == show(type_by_the_schema(text))


@settings(max_examples=examples(300))
@given(likely)
def test_plain_scalars_are_typed_as_another_reader_types_them(text: str) -> None:
    ruamel = pytest.importorskip("ruamel.yaml")
    # What ruamel.yaml reads beyond YAML 1.2: 1_000, 0b1, -0x1, 0x_, dates, and `=` for a value.
    assume("_" not in text and not re.match(r"[-+]?0b|[-+]0[xo]|\d{4}-|[-+]?\d+:", text))
    assume(text == "" or text[0] not in ":-" or text[1:2] not in ("", ":"))
    reader = ruamel.YAML(typ="safe", pure=True)
    reader.version = (1, 2)
    try:
        theirs = reader.load(f"k: {text}\n")["k"]
    except (ruamel.YAMLError, TypeError, ValueError):
        assume(False)
    ours = type_plain(text)
    assert show(ours) == show(theirs)


@pytest.mark.parametrize("text", ["9" * 4301, "-" + "9" * 4301])
def test_an_integer_too_long_for_python_is_told(text: str) -> None:
    with pytest.raises(OverflowError):
        type_plain(text)


# --- numbers to text --------------------------------------------------------------------------

finite = st.floats(allow_nan=False, allow_infinity=False)


@settings(max_examples=examples(1000))
@given(finite)
@example(1.7976931348623157e308)
@example(5e-324)
@example(-0.0)
@example(0.1 + 0.2)
def test_a_float_is_written_with_15_significant_digits(value: float) -> None:
    text = format_number(value)
    assert text != "-0.0"
    if abs(value) < 1e-290 or abs(value) > 1e308:  # fewer digits, or no room to round up
        assert float(text) == pytest.approx(value, rel=1e-14, abs=1e-305)
        return
    rounded = Context(prec=15).plus(Decimal(value))
    assert Decimal(text) == rounded
    assert len(Decimal(text).normalize().as_tuple().digits) <= 15


@given(finite.filter(lambda value: abs(value) > 1e-290 or value == 0))
def test_what_is_written_reads_and_writes_the_same(value: float) -> None:
    text = format_number(value)
    read_again = type_plain(text)
    assert isinstance(read_again, float)
    assert format_number(read_again) == text


@given(st.integers(-(10**15) + 1, 10**15 - 1), st.integers(-30, 30))
def test_a_decimal_of_15_digits_keeps_its_value(digits: int, exponent: int) -> None:
    spelled = Decimal(digits).scaleb(exponent)
    assert Decimal(format_number(float(spelled))) == spelled


# --- places -----------------------------------------------------------------------------------

ESCAPES = {
    "0": "\0", "a": "\a", "b": "\b", "t": "\t", "n": "\n", "v": "\v", "f": "\f", "r": "\r",
    "e": "\x1b", '"': '"', "\\": "\\", "/": "/", "N": "\x85", "_": "\xa0", "L": "\u2028",
    "P": "\u2029", " ": " ", "\t": "\t",
}  # fmt: skip
"""YAML 1.2.2, section 5.7."""
LENGTHS = {"x": 2, "u": 4, "U": 8}

words = st.sampled_from(
    ["a", "$(x)", "it's", '"q"', "b\\c", "é", "😀", "#", "x: y", "-", "''", "\t"]
)
texts = st.one_of(
    st.text(alphabet=st.characters(codec="utf-8", exclude_characters="\ufeff"), max_size=20),
    st.lists(words, max_size=20).map(" ".join),
    st.lists(st.lists(words, max_size=5).map(" ".join), max_size=6).map("\n".join),
)


def read_scalar(source_text: str) -> ScalarNode:
    source = Source(source_text, name="t.yaml")
    root = read(source, reporter=Reporter())
    assert isinstance(root, MappingNode)
    _, node = root.pairs[0]
    assert isinstance(node, ScalarNode)
    return node


def spelled_at(source: str, at: int, style: str) -> tuple[str, int]:
    """Return the character that the source spells at `at`, and the length of its spelling."""
    if style == '"' and source[at] == "\\":
        kind = source[at + 1]
        if kind in LENGTHS:
            digits = source[at + 2 : at + 2 + LENGTHS[kind]]
            return chr(int(digits, 16)), 2 + len(digits)
        return ESCAPES[kind], 2
    if style == "'" and source.startswith("''", at):
        return "'", 2
    return source[at], 1


def require_right_offsets(node: ScalarNode) -> None:
    source = node.source.text
    offsets = [node.offset(index) for index in range(len(node.text))]
    assert offsets == sorted(offsets)
    for index, char in enumerate(node.text):
        if char.isspace():
            assert node.start <= offsets[index] <= node.end
            continue
        spelled, length = spelled_at(source, offsets[index], node.style)
        assert spelled == char, (index, char, offsets[index])
        span = node.span(index, index + 1)
        assert span.start == offsets[index]
        assert span.end <= span.start + length


@settings(max_examples=examples(500))
@given(texts, st.sampled_from(["", "'", '"', "|", ">"]), st.integers(10, 80), st.booleans())
def test_every_character_is_traced_to_its_place(
    text: str, style: str, width: int, is_unicode: bool
) -> None:
    dumped = yaml.dump(
        {"k": text}, default_style=style or None, width=width, allow_unicode=is_unicode
    )
    source = dumped.replace('"k":', "k:").replace("'k':", "k:")
    try:
        node = read_scalar(source)
    except YamaroError:
        assume(False)
    assume(node.text == text)  # PyYAML does not write every text in every style
    require_right_offsets(node)


indents = st.integers(1, 4).map(lambda n: " " * n)
plain_words = st.sampled_from(["a", "$(x)", "it's", 'q"', "b\\c", "é", "😀", "x:y", "a#b"])


@given(st.lists(st.lists(plain_words, min_size=1, max_size=4), min_size=1, max_size=5), indents)
def test_characters_of_a_plain_scalar_over_several_lines_are_traced(
    lines: list[list[str]], indent: str
) -> None:
    node = read_scalar(f"k:\n{indent}" + f"\n{indent}".join(map(" ".join, lines)) + "\n")
    assert node.text == " ".join(word for line in lines for word in line)
    require_right_offsets(node)


@given(
    st.lists(st.sampled_from(["a", "$(x)", '\\"', "\\\\", "\\x41", "\\u00e9", "\\U0001F600",
                              " ", "\\ ", "\\t", "\\\n   ", "\n  ", "\n\n  ", "\\n", "é"]))
)  # fmt: skip
def test_characters_of_a_double_quoted_scalar_are_traced(pieces: list[str]) -> None:
    node = read_scalar('k: "' + "".join(pieces) + '"\n')
    require_right_offsets(node)


@given(
    st.sampled_from(["|", ">", "|-", ">-", "|+", ">+", "|2", ">2", "| # note", ">- # note"]),
    st.lists(st.sampled_from(["a", "$(x) b", "", "  deeper", "é # no comment", "'q'"]), min_size=1),
    st.sampled_from(["\n", "\r\n"]),
)
def test_characters_of_a_block_scalar_are_traced(
    header: str, lines: list[str], line_break: str
) -> None:
    assume(lines[0].strip() == lines[0] or "2" in header)
    written = line_break.join([f"k: {header}", *(f"  {line}" for line in lines), "z: 1", ""])
    try:
        node = read_scalar(written)
    except YamaroError:
        assume(False)
    require_right_offsets(node)


@given(st.lists(st.sampled_from("ab\n\r"), max_size=12).map("".join))
def test_lines_and_columns_count_as_an_editor_does(text: str) -> None:
    source = Source(text, name="t.yaml")
    lines = re.split(r"\r\n|\r|\n", text)
    for offset in range(len(text) + 1):
        before = re.split(r"\r\n|\r|\n", text[:offset])
        inside_break = text[offset - 1 : offset + 1] == "\r\n"
        line, column = source.location(offset)
        if not inside_break:
            assert (line, column) == (len(before), len(before[-1]) + 1)
        assert source.line_text(line) == lines[line - 1]


def test_the_type_of_a_node_is_known_to_the_checker() -> None:
    node: Any = read_scalar("k: v\n")
    assert node == "v"
    assert hash(node) == hash("v")
    assert repr(node) == "ScalarNode('v')"
