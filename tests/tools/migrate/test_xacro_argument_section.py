"""Arguments of xacro become the section `arguments`, with types that take what they may be."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.test_xacro_migration import hold_for, migrated
from yamaro import YamaroError, build


def section(folder: Path, text: str, **files: str) -> str:
    """Return the section `arguments` of a robot, or "" if it has none."""
    made = migrated(folder, text, **files)["r.yaml"]
    _, _, rest = made.partition("arguments:\n")
    lines = rest.splitlines()
    end = next((at for at, line in enumerate(lines) if line[:1] != " "), len(lines))
    return "\n".join(lines[:end]) + "\n" * bool(rest)


@pytest.mark.parametrize(
    ("default", "use", "entry"),
    [
        ("left_", '<link name="$(arg n)a"/>', "n: left_"),
        ("", '<link name="$(arg n)a"/>', "n: ''"),
        ("true", '<xacro:if value="$(arg n)"><link name="a"/></xacro:if>', "n: true"),
        ("0.5", '<a n="${$(arg n) * 2}"/>', "n: 0.5"),
        ("0 0 1", '<a n="$(arg n)"/>', "n: 0 0 1"),
        ("3", '<xacro:property name="n" value="$(arg n)"/><a n="${n + 1}"/>', "n: 3"),
        ("007", '<a n="$(arg n)"/>', "n: '007'"),
    ],
)
def test_the_default_gives_the_type(tmp_path: Path, default: str, use: str, entry: str) -> None:
    assert section(tmp_path, f'<xacro:arg name="n" default="{default}"/>{use}') == f"  {entry}\n"


def test_a_text_keeps_its_spelling(tmp_path: Path) -> None:
    text = (
        '<xacro:arg name="n" default="a"/><xacro:arg name="m" default="b"/><link name="$(arg n)"/>'
    )
    assert section(tmp_path, text)
    hold_for(tmp_path, ["n:=007"], ["n:=1.50"], ["n:=true"], ["n:=x"])


def test_a_count_is_an_integer(tmp_path: Path) -> None:
    loop = """
    <xacro:arg name="n" default="2"/>
    <xacro:macro name="loop" params="i n">
      <xacro:if value="${i &lt; n}"><a i="${i}"/><xacro:loop i="${i + 1}" n="${n}"/></xacro:if>
    </xacro:macro>
    <xacro:loop i="0" n="$(arg n)"/>"""
    assert section(tmp_path, loop) == "  n: {default: 2, type: integer}\n"
    hold_for(tmp_path, ["n:=0"], ["n:=3"], ["n:=3.0"])


@pytest.mark.parametrize(
    ("default", "use"),
    [
        # a text by default, which is computed with where it is a number
        ("none", """<xacro:property name="m" value="$(arg n)"/>
         <xacro:if value="${m != 'none'}"><a n="${m * 2}"/></xacro:if>"""),
        # a truth value or one of several texts
        ("false", """<xacro:if value="${'$(arg n)' == 'gripper'}"><a/></xacro:if>"""),
        # a number or a text
        ("1", """<xacro:if value="${'$(arg n)' == 'none'}"><a/></xacro:if>"""),
    ],
)  # fmt: skip
def test_what_no_type_takes_stays_a_variable(tmp_path: Path, default: str, use: str) -> None:
    text = f'<xacro:arg name="n" default="{default}"/>{use}'
    assert section(tmp_path, text) == ""
    hold_for(tmp_path, ["n:=2"], ["n:=none"], ["n:=gripper"]) if default != "none" else hold_for(
        tmp_path, ["n:=2"], ["n:=3.5"]
    )


def test_a_comment_that_goes_with_one_argument_is_its_help(tmp_path: Path) -> None:
    text = """
    <!-- how long -->
    <xacro:arg name="length" default="2"/>
    <!-- sizes -->
    <xacro:arg name="width" default="2"/>
    <xacro:arg name="height" default="2"/> <!-- in metres -->
    <!-- its colour,
         such as red -->
    <xacro:arg name="colour" default="blue"/>
    <a n="$(arg length) $(arg width) $(arg height) $(arg colour)"/>"""
    assert section(tmp_path, text) == (
        "  length: {default: 2, help: how long}\n"
        "  # sizes\n"
        "  width: 2\n"
        "  height: {default: 2, help: in metres}\n"
        "  # its colour,\n"
        "  # such as red\n"
        "  colour: blue\n"
    )


LIB = '<b n="$(arg n)"/><xacro:macro name="arm"><c n="$(arg n)"/></xacro:macro>'
ONCE = '<xacro:arg name="n" default="a"/><xacro:include filename="lib.xacro"/><xacro:arm/>'


IN_MACRO = """
<xacro:macro name="m" params="n"><xacro:include filename="lib.xacro"/></xacro:macro>
<xacro:arg name="n" default="a"/><xacro:m n="1"/>"""


def test_a_file_that_reads_an_argument_gets_it_from_its_include(tmp_path: Path) -> None:
    made = migrated(tmp_path, ONCE, lib=LIB)
    assert "arguments:\n  n: a\n" in made["r.yaml"]
    assert "include: {path: lib.yaml, n: $(n)}\n" in made["r.yaml"]
    assert hold_for(tmp_path, ["n:=b"]) == []


@pytest.mark.parametrize(
    ("robot", "lib"),
    [
        (f'{ONCE}<xacro:include filename="lib.xacro"/>', LIB),  # twice
        (ONCE, LIB + '<xacro:include filename="more.xacro"/>'),  # in another file
        (f'<xacro:property name="n" value="$(arg n)"/>{ONCE}', LIB + '<d n="${n}"/>'),
        (IN_MACRO, '<b n="$(arg n)"/>'),
    ],
)
def test_where_an_include_cannot_pass_it_other_files_see_it_too(
    tmp_path: Path, robot: str, lib: str
) -> None:
    migrated(tmp_path, robot, lib=lib, more='<e n="$(arg n)"/>')
    hold_for(tmp_path, [], ["n:=b"])


def test_defaults_may_be_made_of_arguments_above(tmp_path: Path) -> None:
    text = """
    <xacro:arg name="kind" default="a"/>
    <xacro:arg name="path" default="arms/$(arg kind).yaml"/>
    <a n="$(arg path)"/>"""
    assert section(tmp_path, text) == "  kind: a\n  path: arms/$(kind).yaml\n"
    hold_for(tmp_path, ["kind:=b"], ["path:=c"])


def test_nothing_else_can_be_passed(tmp_path: Path) -> None:
    section(tmp_path, '<xacro:arg name="n" default="a"/><a n="$(arg n)"/>')
    with pytest.raises(YamaroError, match="unknown-argument"):
        build(tmp_path / "out" / "r.yaml", command_line=["m:=1"])


OWN = '<xacro:property name="n" value="lib"/><b n="${n} $(arg n)"/>'
OF_CALLER = """
<xacro:macro name="inner"><b n="${n}"/></xacro:macro>
<xacro:macro name="m" params="n"><xacro:inner/></xacro:macro>"""


@pytest.mark.parametrize(
    ("lib", "call", "is_named_otherwise"),
    [(OF_CALLER, '<xacro:m n="1"/>', False), (OWN, "", True)],
)
def test_the_main_file_reads_an_argument_by_its_name_if_nothing_there_has_it(
    tmp_path: Path, lib: str, call: str, is_named_otherwise: bool
) -> None:
    text = f"""
    <xacro:arg name="n" default="a"/>
    <xacro:include filename="lib.xacro"/>
    <a n="$(arg n)"/>{call}"""
    made = migrated(tmp_path, text, lib=lib)["r.yaml"]
    assert ("arg_n" in made) is is_named_otherwise
    hold_for(tmp_path, [], ["n:=b"])
