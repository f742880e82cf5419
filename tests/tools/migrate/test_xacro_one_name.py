"""An argument, properties of several files, and parameters that share a name stay what they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.against_xacro import holds

ARGUMENT = '<xacro:arg name="side" default="left"/>'
INCLUDE = '<xacro:include filename="p.xacro"/>'
BOTH = '<link name="a_${side}"/><link name="b_$(arg side)"/>'
SET = '<xacro:property name="side" value="{}"/>'
SETS = (
    '<xacro:macro name="m" params=""><xacro:property name="side" value="left" scope="{}"/>'
    "</xacro:macro>"
)


@pytest.mark.parametrize("value", ["left", "right", "${'le' + 'ft'}"])
@pytest.mark.parametrize("order", ["ai", "ia"])
def test_the_command_line_changed_a_property_of_an_included_file(
    tmp_path: Path, value: str, order: str
) -> None:
    head = {"ai": ARGUMENT + INCLUDE, "ia": INCLUDE + ARGUMENT}[order]
    holds(tmp_path, {"r.xacro": head + BOTH, "p.xacro": SET.format(value)}, "side:=top")


@pytest.mark.parametrize("deeper", ['<xacro:include filename="q.xacro"/>', ""])
def test_a_property_of_a_file_that_an_included_file_includes_stays_its_own(
    tmp_path: Path, deeper: str
) -> None:
    files = {
        "r.xacro": ARGUMENT + INCLUDE + BOTH,
        "p.xacro": deeper + SET.format("left" if not deeper else "$(arg side)_2"),
        "q.xacro": SET.format("left") + BOTH.replace('name="', 'name="q'),
    }
    holds(tmp_path, files, "side:=top")


def test_an_argument_that_nothing_reads_hid_the_property_of_its_name(tmp_path: Path) -> None:
    files = {
        "r.xacro": INCLUDE + '<xacro:include filename="q.xacro"/><link name="a_${side}"/>',
        "p.xacro": SET.format("right"),
        "q.xacro": ARGUMENT,
    }
    holds(tmp_path, files, "side:=top")


@pytest.mark.parametrize("scope", ["global", "parent"])
def test_a_property_that_a_macro_sets_is_not_the_argument_of_its_name(
    tmp_path: Path, scope: str
) -> None:
    text = ARGUMENT + SETS.format(scope) + "<xacro:m/>" + BOTH
    holds(tmp_path, {"r.xacro": text}, "side:=top")


def test_a_property_is_the_argument_again_after_it_was_something_else(tmp_path: Path) -> None:
    text = ARGUMENT + SET.format("right") + '<link name="c_${side}"/>' + SET.format("$(arg side)")
    holds(tmp_path, {"r.xacro": text + BOTH}, "side:=top")
    holds(
        tmp_path,
        {
            "r.xacro": ARGUMENT + INCLUDE + SET.format("$(arg side)") + BOTH,
            "p.xacro": SET.format("right"),
        },
        "side:=top",
    )


def test_the_property_that_was_set_last_was_hidden_by_that_of_the_main_file(tmp_path: Path) -> None:
    text = SET.format("left") + INCLUDE + '<link name="a_${side}"/><xacro:m side="${side}"/>'
    macro = '<xacro:macro name="m" params="side"><link name="${side}_m"/></xacro:macro>'
    made = holds(tmp_path, {"r.xacro": text, "p.xacro": SET.format("right") + macro})
    assert "side/global: left" in made.files["r.yaml"]


def test_a_constant_that_several_files_define_stays_that_of_each(tmp_path: Path) -> None:
    text = SET.format("left") + INCLUDE + '<link name="a_${side}"/>'
    made = holds(tmp_path, {"r.xacro": text, "p.xacro": SET.format("left")})
    assert "/global" not in made.files["r.yaml"]


def test_a_default_of_a_parameter_reads_the_argument_of_its_name_in_several_files(
    tmp_path: Path,
) -> None:
    macro = (
        '{}<xacro:macro name="{}" params="n side:=$(arg side)"><link name="${{n}}_${{side}}"/>'
        "</xacro:macro>"
    )
    files = {
        "r.xacro": INCLUDE + '<xacro:include filename="q.xacro"/><xacro:m n="a"/><xacro:n n="b"/>',
        "p.xacro": macro.format(ARGUMENT, "m"),
        "q.xacro": macro.format(ARGUMENT, "n"),
    }
    made = holds(tmp_path, files, "side:=top")
    assert "include: {path: p.yaml, side: $(side)}" in made.files["r.yaml"]


def test_a_default_made_of_a_property_of_its_name_was_lost(tmp_path: Path) -> None:
    files = {
        "r.xacro": '<xacro:property name="sizes" value="${dict(side=0.25)}"/>'
        + INCLUDE
        + """<xacro:arg name="side" default="${str(sizes['side'] * 2)}"/>"""
        + '<xacro:include filename="q.xacro"/><link name="a"><x>${side}</x></link>',
        "p.xacro": SET.format("${sizes['side']}"),
        "q.xacro": "<link name='b'><x>$(arg side)</x></link>",
    }
    holds(tmp_path, files, "side:=0.75")


def test_a_property_made_of_one_of_an_arguments_name_was_made_of_the_argument(
    tmp_path: Path,
) -> None:
    text = (
        '<xacro:arg name="len" default="2"/><xacro:property name="len" value="${$(arg len) * 2}"/>'
        '<xacro:property name="more" value="${len + 1}"/><link name="a_${more}"/>'
    )
    holds(tmp_path, {"r.xacro": text}, "len:=5")
