"""Target: the grammar of keys. The short way, the whole grammar and a regular expression agree.

A key is read or refused. What is read joins to the key: only signs and spaces stand between the
places of its names and values. In a body a key says what it says alone, the second time too.
"""

from __future__ import annotations

import re
from typing import Any

from yamaro.diagnostics import Reporter, YamaroError
from yamaro.rendering import render
from yamaro.source import Source
from yamaro.syntax import statements
from yamaro.syntax.context import ParseContext
from yamaro.syntax.keys import PlainKeyPlaces, find_outside, parse_plain_key
from yamaro.syntax.names import STATEMENTS, head_of
from yamaro.syntax.nodes import Attribute, ElementNode
from yamaro.syntax.python import Template, skip_expression
from yamaro.xml.tree import Element
from yamaro.xml.values import bad_name_character
from yamaro.yaml.nodes import DOUBLE, PLAIN, ScalarNode

from .checks import require_readable, require_sound

MODULES = ("syntax/keys.py", "syntax/names.py")
GAP = re.compile(r"""\s*/\s*|\s*:?\s*=\s*['"]?|\s*['"]{0,2}\s*,\s*|['"]?\s*""")
VALUE = r"""'(?P<single>[^']*)'|"(?P<double>[^"]*)"|(?P<bare>(?!\s*['"])[^,]*?)"""
ATTRIBUTE = re.compile(rf"\s*(?P<name>[^=,]*?)\s*(?::\s*)?=\s*(?:{VALUE})\s*(?P<end>,|\Z)", re.S)
"""An attribute of a key without `$`, written down from the reference and not from the parser."""


def check(text: str) -> str:
    """Read a key; return what came of it."""
    require_found(text)
    key = node_of(text)
    context = ParseContext(Reporter())
    try:
        node: Any = statements.parse_statement(key, nothing(key), context)
    except YamaroError as error:
        code = require_readable(error)
        require_refused(text, code)
        require_same_in_body(key, [render(diagnostic) for diagnostic in error.diagnostics])
        return code
    require_sound(context.reporter.diagnostics)
    is_element = isinstance(node, ElementNode)
    if is_element:
        require_joined(node, key)
        require_by_the_expression(node, text)
        require_plain(node, key)
    else:
        assert "/" not in text or parse_plain_key(text) is None or head_of(text)
    require_same_in_body(key, [render(diagnostic) for diagnostic in context.errors])
    return type(node).__name__


def node_of(text: str) -> ScalarNode:
    """Return a key as the reader would: plain if that is how it can be written, else in quotes."""
    if text.isprintable() and text.isascii():
        return ScalarNode(text, PLAIN, Source(f"- {text}:\n", name="t.yaml"), 2, 2 + len(text))
    written = "".join(f"\\U{ord(char):08X}" for char in text)
    source = Source(f'- "{written}":\n', name="t.yaml")
    return ScalarNode(text, DOUBLE, source, 2, 4 + len(written))


def nothing(key: ScalarNode) -> ScalarNode:
    """Return the empty value behind a key."""
    return ScalarNode("", PLAIN, key.source, key.end + 1, key.end + 1)


def require_found(text: str) -> None:
    """Require that signs are found as by looking at each."""
    for signs in ("/", "=,", ",", "'"):
        at, expected = 0, -1
        while at < len(text) and expected < 0:
            behind = skip_expression(text, at)
            if behind == at and text[at] in signs:
                expected = at
            at = max(behind, at + 1)
        assert find_outside(text, signs, 0, len(text)) == expected


# --- the whole grammar ------------------------------------------------------------------------


def shown(name: str | Template) -> str:
    return name if isinstance(name, str) else name.span().written()


def require_joined(node: ElementNode, key: ScalarNode) -> None:
    """Require that names and values, in order, are all of a key but for signs and spaces."""
    places = [(own.name_span, own.span, own) for own in node.attributes]
    if key.style != PLAIN:
        for name_span, span, _ in places:
            assert key.start <= name_span.start <= name_span.end <= span.end <= key.end
        return
    text = key.text
    slash = find_outside(text, "/", 0, len(text))
    at = slash if slash >= 0 else len(text)
    if isinstance(node.name, str) and "$" not in text[:at]:
        angled = text.startswith("<")
        assert (text[1:at] if angled else text[:at]).strip() in (node.name, f"{node.name}>")
    for name_span, span, own in places:
        start, end = name_span.start - key.start, name_span.end - key.start
        assert GAP.fullmatch(text, at, start), f"{text[at:start]!r} is left out"
        require_written(own, name_span.written())
        value_start, at = span.start - key.start, span.end - key.start
        if value_start == start:  # an empty value has the place of `name=`
            assert span.written().endswith("=")
            assert own.value == ""
            continue
        assert GAP.fullmatch(text, end, value_start), f"{text[end:value_start]!r} is left out"
        if isinstance(own.value, str) and "$" not in span.written():
            assert own.value == span.written()
    assert set(text[at:]) <= set("'\"> \t\n\r\x0b\x0c\x1c\x1d\x1e\x1f\x85\xa0")


def require_written(own: Attribute, written: str) -> None:
    if isinstance(own.name, str) and "$" not in written:
        assert own.name == written
        assert bad_name_character(own.name) is None


# --- a regular expression ---------------------------------------------------------------------


def by_the_expression(text: str) -> tuple[str, list[tuple[str, str]]] | None:
    """Return name and attributes of a key in which no `$` stands, or None if it is none."""
    name, slash, rest = text.partition("/")
    found: list[tuple[str, str]] = []
    at = 0
    while slash:
        attribute = ATTRIBUTE.match(rest, at)
        if attribute is None:
            return None
        value = attribute["bare"]
        if value is None:
            value = attribute["double"] if attribute["single"] is None else attribute["single"]
        found.append((attribute["name"], value))
        at = attribute.end()
        if not attribute["end"]:
            break
    names = [own for own, _ in found]
    if len(set(names)) < len(names) or any(bad_name_character(own) is not None for own in names):
        return None
    name = name.rstrip()
    return (name, found) if bad_name_character(name) is None else None


def require_by_the_expression(node: ElementNode, text: str) -> None:
    if "$" not in text and not text.startswith("<"):
        expected = by_the_expression(text)
        assert expected is not None, "the regular expression refuses it"
        assert (node.name, [(own.name, own.value) for own in node.attributes]) == (
            expected[0],
            expected[1],
        )


def require_refused(text: str, code: str) -> None:
    if "$" not in text and code in ("bad-key", "bad-name", "attribute-twice"):
        if not text.startswith("<") and not set(text[:1]) & set(" \t"):
            assert by_the_expression(text) is None, "the regular expression reads it"
        assert parse_plain_key(text) is None


# --- the short way ----------------------------------------------------------------------------


def require_plain(node: ElementNode, key: ScalarNode) -> None:
    """Require that the short way, if it reads a key, says what the grammar says."""
    plain = parse_plain_key(key.text)
    if plain is None:
        return
    name, attributes = plain
    places = PlainKeyPlaces(key) if attributes else None
    element = Element(name, key, attributes=attributes, value_spans=places)
    assert node.name == name
    assert [(own.name, own.value) for own in node.attributes] == list(attributes.items())
    for own in node.attributes:
        assert own.span.key() == element.value_span(str(own.name)).key()
        if key.style == PLAIN:  # behind escapes a name is not looked for
            assert own.name_span.key() == element.name_span(str(own.name)).key()
    assert name not in STATEMENTS


def require_same_in_body(key: ScalarNode, errors: list[str]) -> None:
    """Require that a body says the same of a key that stands in it twice: first new, then known."""
    if key.text in ("if", "elif", "else", "functions", "variables") or head_of(key.text):
        return  # they look at what stands before them
    context = ParseContext(Reporter())
    body = statements.parse_pairs([(key, nothing(key)), (key, nothing(key))], context)
    assert [render(error) for error in context.errors] == errors * 2
    assert errors or len(body.statements) == 2
