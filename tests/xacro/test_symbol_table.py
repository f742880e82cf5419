"""Names in xacro files, as they are written."""

import pytest

from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.xacro.symbol_table import (
    arguments_in,
    assigned_in,
    called_by,
    computed_with,
    defined_in,
    definitions_in,
    given_in,
    macros_inside,
    names_in,
    outside_expressions,
    used_in,
    words_read,
)
from yamaro.xml.reader import read_xml
from yamaro.xml.tree import Element

FILE = """
<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="side" default="left"/>
  <xacro:property name="side" value="$(arg side)"/>
  <xacro:property name="length" value="${width * 2}"/>
  <xacro:property name="hook"><link name="${tip}"/></xacro:property>
  <xacro:macro name="arm" params="parent mass:=${heavy} *origin">
    <xacro:property name="own" value="1"/>
    <xacro:property name="reach" value="${own + length}" scope="parent"/>
    <xacro:property name="count" value="2" scope="global"/>
    <xacro:macro name="xacro:finger" params="index"><link name="f${index}"/></xacro:macro>
    <xacro:legs.leg side="$(arg side)"/>
    <xacro:if value="${size == 'big' and is_on}"><link name="x"/></xacro:if>
  </xacro:macro>
</robot>
"""


def robot(text: str = FILE) -> Element:
    return read_xml(Source(text, name="robot.xacro"), Limits()).root


def macro(name: str) -> Element:
    return next(own.element for own in definitions_in(robot()) if own.name == name)


def test_definitions_have_kinds() -> None:
    found = [(own.kind, own.name) for own in definitions_in(robot())]
    assert found == [
        ("argument", "side"),
        ("property", "side"),
        ("property", "length"),
        ("block", "hook"),
        ("macro", "arm"),
        ("property", "own"),
        ("property", "reach"),
        ("property", "count"),
        ("macro", "finger"),
    ]


def test_a_property_may_be_the_argument_of_its_name() -> None:
    found = [own.name for own in definitions_in(robot()) if own.is_of_argument]
    assert found == ["side"]


def test_properties_of_macros_are_the_macros_own() -> None:
    assert defined_in(robot()) == {"side", "length", "hook"}
    assert defined_in(macro("arm")) == {"own", "reach", "count"}
    assert defined_in(robot(), nested=True) == {"side", "length", "hook", "own", "reach", "count"}


def test_properties_are_assigned_for_others() -> None:
    assert assigned_in(robot()) == {"reach", "count"}
    assert assigned_in(robot(), "parent") == {"reach"}
    assert assigned_in(robot(), "global") == {"count"}


def test_macros_inside_a_macro_are_left_out() -> None:
    arm = macro("arm")
    assert len(macros_inside(arm)) == 1
    assert "index" in used_in(arm)
    assert "index" not in used_in(arm, macros_inside(arm))


def test_what_gives_a_name_a_value_is_found() -> None:
    given = {(name, text) for _, name, text in given_in(robot())}
    assert {
        ("side", "left"),
        ("length", "${width * 2}"),
        ("mass", "${heavy}"),
        ("parent", ""),
        ("side", "$(arg side)"),  # a call passes it
    } <= given


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("plain", set()),
        ("${a}/${b.c[d]}", {"a", "b", "d"}),
        ("${[x * a for x in row]}", {"a", "row"}),
        ("${(lambda x: x + a)(1)}", {"a"}),
        ("${a + $(arg b)}", {"a"}),
        ("${not python}", {"python"}),
        ("${1 +}", set()),
    ],
)
def test_names_are_those_that_expressions_read(text: str, names: set[str]) -> None:
    assert names_in(text) == names


def test_all_words_are_read_where_the_text_is_not_known() -> None:
    assert words_read("${a.b}") == {"a", "b"}
    assert words_read("${1 + oops oops}") == {"oops"}
    assert words_read("$(find package)/x") == set()
    assert words_read("$(arg side)") == {"arg", "side"}
    assert words_read("${ends nowhere") == {"ends", "nowhere"}


def test_arguments_have_names_of_their_own() -> None:
    text = "<robot><a x='$(arg one)' y=\"${xacro.arg('two')}\">$(arg three)</a></robot>"
    assert arguments_in(robot(text)) == {"one", "two", "three"}
    own = '<robot><xacro:property name="a" value="$(arg a)" xmlns:xacro="x"/></robot>'
    assert arguments_in(robot(own)) == set()
    assert arguments_in(robot(own), with_own=True) == {"a"}


def test_names_that_are_compared_with_texts_are_not_computed_with() -> None:
    assert computed_with(robot()) == {"width", "own", "length", "is_on"}


def test_texts_in_expressions_are_outside_of_them() -> None:
    assert outside_expressions("a ${b + 'c'} d") == "a 'c' d"


def test_a_tag_calls_a_macro_of_a_namespace() -> None:
    root = robot()
    called = [called_by(each) for each in root.iter() if "." in each.name]
    assert called == ["leg"]
    assert called_by(root) == ""
