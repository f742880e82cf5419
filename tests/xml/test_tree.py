"""Values to text, and trees to XML."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from yamaro.diagnostics import YamaroError
from yamaro.source import Source, Span
from yamaro.xml.tree import Comment, Element, Text
from yamaro.xml.values import format_value, is_number
from yamaro.xml.writer import write

PLACE = Span(Source("key: value", name="t.yaml"), 0, 3)


class Degrees(float):
    def __str__(self) -> str:
        return "never asked"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("a", "a"), (None, ""), (True, "true"), (False, "false"), (3, "3"), (-0.0, "0.0"),
        (0.1 + 0.2, "0.3"), (1.0, "1.0"), (1e-7, "1e-07"), (1e22, "1e+22"), (2**70, str(2**70)),
        (float("inf"), "inf"), (float("nan"), "nan"),
        ([1, 2.5, 3], "1 2.5 3"), ((0.1 + 0.2, -0.0), "0.3 0.0"), ([], ""),
        (["a", 1], "['a', 1]"), ([True], "[True]"), ({"a": 1}, "{'a': 1}"),
        (np.float64(0.1) + np.float64(0.2), "0.3"), (np.int32(4), "4"), (np.bool_(True), "true"),
        (np.array([1.0, 2.0]), "1.0 2.0"), (np.float32(0.5), "0.5"), (np.str_("s"), "s"),
        ([np.float64(1.0), np.int64(2)], "1.0 2"),
        (Degrees(1.5), "1.5"), (Fraction(1, 2), "1/2"), (Decimal("0.10"), "0.10"),
    ],
)  # fmt: skip
def test_values_become_text(value: object, text: str) -> None:
    assert format_value(value) == text


def test_booleans_are_no_numbers() -> None:
    assert [is_number(value) for value in (1, 1.0, True, "1", None)] == [True, True] + [False] * 3


def element(name: str, *children: Element | Text | Comment, **attributes: object) -> Element:
    return Element(name, PLACE, attributes=attributes, children=list(children))


def text(value: object) -> Text:
    return Text(value, PLACE)


def test_elements_are_indented_and_texts_are_not_touched() -> None:
    tree = element(
        "a",
        element("b", text(" x "), element("c"), Comment("note", PLACE), text("y")),
        Comment(" z ", PLACE),
        element("d", text("")),
        e="<\"'&\n",
        left_out=None,
    )
    assert write(tree) == (
        '<?xml version="1.0"?>\n'
        '<a e="&lt;&quot;\'&amp;&#10;">\n'
        "  <b> x <c/><!--note-->y</b>\n"
        "  <!-- z -->\n"
        "  <d/>\n"
        "</a>\n"
    )


def test_an_element_tells_its_text_and_its_place() -> None:
    tree = element("a", text(1.50), text("m"), element("b"))
    assert tree.text() == "1.5m"
    assert [child.name for child in tree.elements()] == ["b"]
    assert tree.value_span("none") is tree.span
    assert repr(tree) == "<Element a at t.yaml:1:1>"


@pytest.mark.parametrize(
    ("tree", "message"),
    [
        (element("gz:a"), "the XML prefix 'gz' of 'gz:a' is not declared"),
        (element("a", **{"gz:b": 1}), "the XML prefix 'gz' of 'gz:b' is not declared"),
        (element("xmlns:a"), "the XML prefix 'xmlns' of 'xmlns:a' is not declared"),
        (
            element("a", **{"xmlns:b": None, "b:c": 1}),
            "the XML prefix 'b' of 'b:c' is not declared",
        ),
        (element("a", **{"xmlns:b": ""}), "the XML prefix 'b' is declared without a URI"),
        (
            element("a", **{"xmlns:xml": "x"}),
            "the XML prefix 'xml' is reserved and cannot be declared",
        ),
    ],
)
def test_prefixes_have_to_be_declared(tree: Element, message: str) -> None:
    with pytest.raises(YamaroError) as caught:
        write(tree)
    (diagnostic,) = caught.value.diagnostics
    assert (diagnostic.code, diagnostic.message) == ("undeclared-prefix", message)


def test_a_declared_prefix_reaches_inwards_only() -> None:
    inner = element("gz:b", **{"xml:lang": "en"})
    assert '<gz:b xml:lang="en"/>' in write(element("a", inner, **{"xmlns:gz": "u"}))
    with pytest.raises(YamaroError):
        write(element("a", element("b", **{"xmlns:gz": "u"}), element("gz:c")))


@pytest.mark.parametrize(
    "tree",
    [
        element("a", text("x\x07")),
        element("a", b="\x00"),
        element("a", Comment("\ufffe", PLACE)),
        element("a", text("\ud800")),
    ],
)
def test_characters_that_xml_forbids_are_refused(tree: Element) -> None:
    with pytest.raises(YamaroError) as caught:
        write(tree)
    assert caught.value.diagnostics[0].code == "control-character"
