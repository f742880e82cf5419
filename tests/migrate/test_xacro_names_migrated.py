"""Names that mean several things in xacro, and properties in places that hide them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.migrate.against_xacro import holds, moved

MACRO_IN_FILE = '<xacro:macro name="m" params=""><link name="l${size}"/></xacro:macro>'


@pytest.mark.parametrize(
    "inside",
    [
        '<xacro:property name="con" value="$(arg con)"/><link name="l${con}"/>',
        '<xacro:property name="own" value="$(arg con)"/><link name="l${own}_${con}"/>',
        '<link name="l$(arg con)_${con}"/>',
        '<xacro:if value="${con != \'\'}"><link name="l$(arg con)"/></xacro:if><link name="x"/>',
        """<link name="l${'$(arg con)' + con}"/>""",
    ],
)
def test_one_name_for_argument_parameter_and_property_is_three_things(
    tmp_path: Path, inside: str
) -> None:
    for default in ("", "a"):
        argument = f'<xacro:arg name="con" default="{default}"/>'
        macro = f"""<xacro:macro name="m" params="con:=''">{inside}</xacro:macro>"""
        for call in ('<xacro:m con="$(arg con)"/>', '<xacro:m con="b"/>', "<xacro:m/>"):
            holds(tmp_path, {"r.xacro": argument + macro + call}, "con:=z")


def test_the_argument_is_read_in_a_macro_of_another_file_with_a_parameter_of_its_name(
    tmp_path: Path,
) -> None:
    inner = '<xacro:property name="con" value="$(arg con)"/><link name="l${con}"/>'
    files = {
        "m.xacro": f'<xacro:macro name="m" params="con">{inner}</xacro:macro>',
        "r.xacro": '<xacro:arg name="con" default="a"/><xacro:include filename="m.xacro"/>'
        '<xacro:m con="b"/>',
    }
    holds(tmp_path, files, "con:=z")


@pytest.mark.parametrize("place", ["before", "behind"])
@pytest.mark.parametrize("around", ["{}", "<xacro:if value='true'>{}</xacro:if>"])
def test_a_property_in_a_condition_is_seen_by_macros_of_other_files(
    tmp_path: Path, place: str, around: str
) -> None:
    chosen = "".join(
        f"""<xacro:{tag} value="${{'$(arg kind)' == 'a'}}"><xacro:property name="size" """
        f'value="{value}"/></xacro:{tag}>'
        for tag, value in (("if", "1 1 1"), ("unless", "2 2 2"))
    )
    include = '<xacro:include filename="m.xacro"/>'
    chosen = around.format(chosen)
    both = chosen + include if place == "before" else include + chosen
    files = {
        "m.xacro": MACRO_IN_FILE,
        "r.xacro": f'<xacro:arg name="kind" default="a"/>{both}<xacro:m/>',
    }
    holds(tmp_path, files, "kind:=b")


def test_a_property_in_a_condition_in_an_element_is_one_of_the_file(tmp_path: Path) -> None:
    inside = '<xacro:property name="size" value="3"/>'
    files = {
        "m.xacro": MACRO_IN_FILE,
        "r.xacro": '<xacro:include filename="m.xacro"/><gazebo><xacro:if value="true">'
        f"{inside}</xacro:if></gazebo><xacro:m/>",
    }
    holds(tmp_path, files)


def test_stray_text_is_no_difference(tmp_path: Path) -> None:
    inside = "\n#### link ####\n<link name='${n}'/>\n#### joint ####\n"
    macro = f'<xacro:macro name="m" params="n">{inside}</xacro:macro>'
    again = macro + 'a<xacro:m n="a"/> b<xacro:m n="b"/><xacro:m n="c"/>'
    migration = holds(tmp_path, {"r.xacro": again})
    assert "- <#text>: ' #### link #### '" in migration.files["r.yaml"]


@pytest.mark.parametrize("base", ["d.yaml", "data/d.yaml", "../other/d.yaml"])
def test_data_is_found_from_the_file_that_calls_the_macro(tmp_path: Path, base: str) -> None:
    reads = """<link name="l${xacro.load_yaml(file)['x']}"/>"""
    files = {
        "lib/m.xacro": f'<xacro:macro name="m" params="file">{reads}</xacro:macro>',
        "main/r.xacro": f'<xacro:include filename="../lib/m.xacro"/><xacro:m file="{base}"/>',
        f"main/{base}": "x: 3\n",
    }
    migration = moved(tmp_path, files, "main/r.xacro")
    assert migration.faults == []
    assert migration.differences == []
