"""What a macro calls and includes sees the macro's own names, as in xacro."""

from __future__ import annotations

from pathlib import Path

from tests.tools.migrate.test_xacro_migration import hold_for, migrated


def test_a_file_that_a_macro_includes_reads_its_parameters(tmp_path: Path) -> None:
    files = migrated(
        tmp_path,
        """\
        <xacro:macro name="arm" params="side">
          <xacro:include filename="hand.xacro"/>
        </xacro:macro>
        <xacro:arm side="left"/>
        <xacro:arm side="right"/>
        """,
        hand='<link name="${side}_hand"/>',
    )
    assert "include: {path: hand.yaml, side: $(side)}" in files["r.yaml"]
    assert hold_for(tmp_path, []) == []


def test_what_a_file_that_a_macro_includes_calls_sees_its_parameters(tmp_path: Path) -> None:
    files = migrated(
        tmp_path,
        """\
        <xacro:macro name="finger" params=""><link name="${side}_finger"/></xacro:macro>
        <xacro:macro name="arm" params="side">
          <xacro:include filename="hand.xacro"/>
        </xacro:macro>
        <xacro:arm side="left"/>
        """,
        hand='<link name="${side}_hand"/><xacro:finger/>',
    )
    assert "side/child: $(side)" in files["r.yaml"]
    assert hold_for(tmp_path, []) == []


def test_a_parameter_that_is_passed_on_is_not_shown_as_well(tmp_path: Path) -> None:
    files = migrated(
        tmp_path,
        """\
        <xacro:property name="side" value="middle"/>
        <xacro:macro name="hand" params="side"><link name="${side}_hand"/></xacro:macro>
        <xacro:macro name="arm" params="side"><xacro:hand side="${side}_upper"/></xacro:macro>
        <xacro:arm side="left"/>
        <link name="${side}"/>
        """,
    )
    assert "/child" not in files["r.yaml"]


def test_a_property_for_the_parent_of_a_file_that_a_macro_includes_is_for_its_caller(
    tmp_path: Path,
) -> None:
    migrated(
        tmp_path,
        """\
        <xacro:include filename="arm.xacro"/>
        <xacro:arm/>
        """,
        arm="""\
        <xacro:macro name="arm" params="">
          <xacro:include filename="settings.xacro"/>
          <xacro:include filename="hand.xacro"/>
          <xacro:hand/>
        </xacro:macro>
        """,
        settings='<xacro:property name="has_thumb" value="true" scope="parent"/>',
        hand="""\
        <xacro:macro name="hand" params="">
          <xacro:if value="${has_thumb}"><link name="thumb"/></xacro:if>
        </xacro:macro>
        """,
    )
    assert hold_for(tmp_path, []) == []


def test_a_parameter_hides_a_property_of_the_file_from_what_the_macro_calls(
    tmp_path: Path,
) -> None:
    migrated(
        tmp_path,
        """\
        <xacro:arg name="given" default="small"/>
        <xacro:property name="size" value="small"/>
        <xacro:macro name="hand" params=""><link name="${size}_hand"/></xacro:macro>
        <xacro:macro name="arm" params="size"><xacro:hand/></xacro:macro>
        <xacro:arm size="$(arg given)"/>
        <link name="${size}"/>
        """,
    )
    assert hold_for(tmp_path, ["given:=large"]) == []
