"""What is written parses back to the same tree, with lxml as the reader."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from tests.effort import examples
from yamaro.api import build
from yamaro.diagnostics import YamaroError
from yamaro.files.loader import MemoryLoader

# XML 1.0 (fifth edition), production 2: Char.
characters = st.one_of(
    st.sampled_from("\t\n\r &<>\"'$({)}/=,:#-éß😀\x7f\x85\xa0\u2028\ufeff"),
    st.characters(exclude_categories=("Cs", "Cc"), exclude_characters="\ufffe\uffff"),
)
texts = st.lists(characters, max_size=12).map("".join)
# A part of production 4, NameStartChar, and 4a, NameChar, that is sure to hold surprises.
starts = st.sampled_from("aZ_éΩ中😀ͰⰀ")
parts = st.sampled_from("aZ_é-.09·‿̀")
names = st.builds(str.__add__, starts, st.text(parts, max_size=5)).filter(
    lambda name: not name.lower().startswith("xml")
)
attributes = st.dictionaries(names | st.just("xml:lang"), texts, max_size=3)
comments = texts.filter(lambda text: "--" not in text and not text.endswith("-"))

# A tree is (name, attributes, children); a child is a tree, a text or a comment (None, text).
leaves: st.SearchStrategy[Any] = st.tuples(names, attributes, st.just([]))
trees = st.recursive(
    leaves,
    lambda inner: st.tuples(
        names,
        attributes,
        st.lists(st.one_of(inner, texts, st.tuples(st.none(), comments)), max_size=4),
    ),
    max_leaves=8,
)


def literal(text: str) -> str:
    """Return a text as YAML text in which no expression is seen."""
    return text.replace("$(", "$$(").replace("${", "$${")


def spell_attribute(name: str, value: str, draw: Any) -> str:
    """Return `name=value` in one of the spellings that the grammar of keys has for the value."""
    written = literal(value)
    spellings = [f"$({value!r})"]
    if "'" not in value:
        spellings.append(f"'{written}'")
    if '"' not in value:
        spellings.append(f'"{written}"')
    if "," not in value and value == value.strip() and value[:1] not in ("'", '"'):
        spellings.append(written)
    colon, space = draw(st.sampled_from(["", ":"])), draw(st.sampled_from(["", " "]))
    return f"{name}{colon}={space}{draw(st.sampled_from(spellings))}"


def spell(tree: Any, draw: Any) -> dict[str, Any]:
    """Return a tree as an entry of a body in list form, for JSON, of which YAML is a superset."""
    name, given_attributes, children = tree
    key = name
    if given_attributes:
        pairs = [spell_attribute(own, value, draw) for own, value in given_attributes.items()]
        key += "/" + draw(st.sampled_from([",", ", "])).join(pairs)
    if draw(st.booleans()) or name[0].isupper():
        key = f"<{key}>"
    body: list[dict[str, Any]] = []
    for child in children:
        if isinstance(child, str):
            body.append({"<#text>": literal(child)})
        elif child[0] is None:
            body.append({"<#comment>": literal(child[1])})
        else:
            body.append(spell(child, draw))
    return {key: body or None}


def to_yaml(value: object) -> str:
    """Return JSON in which nothing is left that YAML forbids, surrogate pairs included."""
    dumped = json.dumps(value, ensure_ascii=False)
    return "".join(char if char.isprintable() else f"\\U{ord(char):08x}" for char in dumped)


def as_read(tree: Any) -> Any:
    """Return what a reader must see of a tree: texts joined, line ends in comments as XML's."""
    name, given_attributes, children = tree
    seen: list[Any] = []
    for child in children:
        if isinstance(child, str):
            if seen and isinstance(seen[-1], str):
                child = seen.pop() + child
            if child:
                seen.append(child)
        elif child[0] is None:
            text = child[1].replace("\r\n", "\n").replace("\r", "\n")
            seen.append((None, text))
        else:
            seen.append(as_read(child))
    return (name, list(given_attributes.items()), seen)


def read_back(element: Any, *, keep_space: bool) -> Any:
    """Return lxml's tree in the form of `as_read`."""
    children: list[Any] = [element.text] if element.text else []
    for child in element:
        if child.tag is etree.Comment:
            children.append((None, child.text or ""))
        else:
            children.append(child)
        if child.tail:
            children.append(child.tail)
    return children if keep_space else [c for c in children if not isinstance(c, str)]


def require_same(expected: Any, element: Any) -> None:
    name, given_attributes, children = expected
    assert element.tag == name
    language = "{http://www.w3.org/XML/1998/namespace}"
    pairs = [(key.replace(language, "xml:"), value) for key, value in element.attrib.items()]
    assert pairs == given_attributes
    # Space is added between tags only where there is no text, or it would change the text.
    has_text = any(isinstance(child, str) for child in children)
    found = read_back(element, keep_space=has_text)
    assert len(found) == len(children)
    for child, other in zip(children, found, strict=True):
        if isinstance(child, str) or child[0] is None:
            assert other == child
        else:
            require_same(child, other)


@settings(max_examples=examples(400))
@given(trees, st.data())
def test_what_is_written_parses_back_to_the_same_tree(tree: Any, data: st.DataObject) -> None:
    text = to_yaml([{"<root>": [spell(tree, data.draw)]}])
    xml = build("/t.yaml", loader=MemoryLoader({"/t.yaml": text})).xml()
    root = etree.fromstring(xml.encode(), etree.XMLParser(remove_blank_text=False))
    assert [child.tag for child in root] == [tree[0]]
    require_same(as_read(tree), root[0])


@given(st.characters(categories=("Cc", "Cs")) | st.sampled_from("\ufffe\uffff"))
def test_a_character_that_xml_forbids_is_an_error_at_its_place(char: str) -> None:
    text = f'out: ["<a/b=$(chr({ord(char)}))>": ]\n'
    loader = MemoryLoader({"/t.yaml": text})
    if char in "\t\n\r\x85" or "\x7f" <= char <= "\x9f":
        value = etree.fromstring(build("/t.yaml", loader=loader).xml().encode())[0].get("b")
        assert value == char
        return
    with pytest.raises(YamaroError) as caught:
        build("/t.yaml", loader=loader)
    assert [diagnostic.code for diagnostic in caught.value.diagnostics] == ["control-character"]
    assert caught.value.diagnostics[0].span.written().startswith("$(chr(")
