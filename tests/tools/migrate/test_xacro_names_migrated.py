"""Names that mean several things in xacro, and properties in places that hide them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.against_xacro import holds, is_same, moved

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


@pytest.mark.parametrize(
    "value",
    ["$(arg never_declared)", "$(find not_there)/x", "${no_such_name + 1}", "$(env NO_SUCH)"],
)
@pytest.mark.parametrize("reader", ["", '<xacro:if value="$(arg on)"><b b="${p}"/></xacro:if>'])
def test_a_property_that_nothing_reads_need_not_have_a_value(
    tmp_path: Path, value: str, reader: str
) -> None:
    macro = '<xacro:macro name="m" params=""><a a="${p}"/></xacro:macro>'
    text = f'<xacro:arg name="on" default="false"/><xacro:property name="p" value="{value}"/>'
    holds(tmp_path, {"r.xacro": text + macro + reader + '<link name="base"/>'})


@pytest.mark.parametrize("default", ["$(find not_there)/x.yaml", "$(env NO_SUCH)"])
def test_a_default_that_is_not_reached_need_not_have_a_value(tmp_path: Path, default: str) -> None:
    inside = f'<xacro:arg name="limits" default="{default}"/><link name="$(arg limits)"/>'
    text = (
        """<xacro:arg name="arm" default=""/><xacro:unless value="${'$(arg arm)' == ''}">"""
        f'{inside}</xacro:unless><link name="base"/>'
    )
    migration = holds(tmp_path, {"r.xacro": text})
    assert "limits is None" in migration.files["r.yaml"]
    assert is_same(tmp_path, migration, "arm:=a", "limits:=b")


@pytest.mark.parametrize(
    "order",
    [
        "{y}{include}{macro}",
        "{y}{macro}{include}",
        "{y}<other/>{include}{macro}",
        "{z}{y}{include}",
    ],
)
def test_a_property_may_stand_before_the_names_it_is_made_of(tmp_path: Path, order: str) -> None:
    text = order.format(
        y='<xacro:property name="y" value="${length * 3}"/>',
        z='<xacro:property name="z" value="${y + 1}"/>',
        include='<xacro:include filename="w.xacro"/>',
        macro='<xacro:macro name="m" params=""><link name="l${y}"/></xacro:macro>',
    )
    call = '<link name="l${z}"/>' if "{z}" in order else "<xacro:m/>"
    files = {
        "w.xacro": '<xacro:property name="length" value="2"/>',
        "m.xacro": text,
        "r.xacro": f'<xacro:include filename="m.xacro"/>{call}',
    }
    holds(tmp_path, files)


def test_all_digits_of_a_number_stand_in_a_name(tmp_path: Path) -> None:
    text = '<xacro:property name="y" value="${0.1 + 0.2}"/><link name="l${y}"/><a a="1 ${y}"/>'
    made = holds(tmp_path, {"r.xacro": text}).files["r.yaml"]
    assert "link/name=l$(str(y)):" in made
    assert "a/a=1 $(y):" in made


@pytest.mark.parametrize("around", ["{}", "<xacro:if value='${len(t) > 1}'>{}</xacro:if>"])
def test_a_file_that_a_macro_includes_may_redefine_its_parameter(
    tmp_path: Path, around: str
) -> None:
    lowered = '<xacro:property name="t" value="${t.lower()}" lazy_eval="false"/>'
    chosen = (
        """<xacro:if value="${t == 'hand_e'}"><xacro:property name="t" value="E"/></xacro:if>"""
    )
    files = {
        "n.xacro": '<link name="a_${t}"/>' + around.replace("{}", lowered) + chosen,
        "r.xacro": '<xacro:macro name="m" params="t"><xacro:include filename="n.xacro"/>'
        '<link name="l${t}"/></xacro:macro><xacro:m t="HAND_E"/><xacro:m t="Other"/>',
    }
    holds(tmp_path, files)


def test_a_property_of_a_global_one_that_an_included_macro_sets_is_kept(tmp_path: Path) -> None:
    files = {
        "p.xacro": '<xacro:macro name="plate" params="">'
        '<xacro:property name="size" value="3" scope="global"/></xacro:macro>',
        "r.xacro": '<xacro:macro name="grip" params="plate"><xacro:if value="${plate}">'
        '<xacro:include filename="p.xacro"/><xacro:plate/>'
        '<xacro:property name="len" value="${size}" scope="local"/></xacro:if>'
        '<link name="l${len}"/></xacro:macro><xacro:grip plate="true"/>',
    }
    assert holds(tmp_path, files).lost == []


@pytest.mark.parametrize(
    ("default", "quoted"),
    [("01", True), ("1", True), ("0.10", True), ("true", True), ("01", False)],
)
def test_a_number_in_quotes_stays_the_text_that_it_is(
    tmp_path: Path, default: str, quoted: bool
) -> None:
    given = "'$(arg v)'" if quoted else "$(arg v)"
    text = (
        f'<xacro:arg name="v" default="{default}"/><xacro:macro name="m" params="v">'
        f"""<xacro:if value="${{v == '{default}'}}"><link name="yes"/></xacro:if>"""
        '<link name="l$(arg v)"/><link name="m${v}"/></xacro:macro>'
        f'<xacro:m v="{given}"/>'
    )
    migration = moved(tmp_path, {"r.xacro": text})
    assert migration.faults == []
    assert is_same(tmp_path, migration)


BLOCK = '<block><origin xyz="{} 0 0" rpy="0 0 0"/></block>'


@pytest.mark.parametrize(
    "given",
    [
        "<xacro:if value='${on}'>{0}</xacro:if><xacro:if value='${not on}'>{1}</xacro:if>",
        "<xacro:if value='$(arg on)'>{0}</xacro:if><xacro:unless value='${on}'>{1}</xacro:unless>",
        '<xacro:if value="true"><xacro:if value="true">{0}</xacro:if></xacro:if>',
    ],
)
@pytest.mark.parametrize("more", ["", " *tip"])
def test_a_block_may_be_chosen_by_conditions(tmp_path: Path, given: str, more: str) -> None:
    tip = '<xacro:insert_block name="tip"/>' if more else ""
    text = (
        (
            '<xacro:arg name="on" default="true"/><xacro:property name="on" value="$(arg on)"/>'
            f'<xacro:macro name="m" params="name **block{more}">'
            '<joint name="${name}" type="fixed"><parent link="base"/><child link="${name}_link"/>'
            '<xacro:insert_block name="block"/></joint><link name="${name}_link"/>'
            f"{tip}</xacro:macro>"
            f'<link name="base"/><xacro:m name="a">{given}{"<tip/>" if more else ""}</xacro:m>'
        )
        .replace("{0}", BLOCK.format(1))
        .replace("{1}", BLOCK.format(-1))
    )
    others = () if "true" in given else ("on:=false",)
    assert holds(tmp_path, {"r.xacro": text}, *others).lost == []


@pytest.mark.parametrize("value", ["false", "1", "007", "a", ""])
def test_a_default_in_quotes_is_the_text_that_it_is(tmp_path: Path, value: str) -> None:
    text = (
        f"""<xacro:macro name="m" params="on:='{value}'">"""
        f"""<xacro:if value="${{on == '{value}'}}"><link name="yes"/></xacro:if>"""
        '<link name="l${on}"/></xacro:macro><xacro:m/>'
    )
    holds(tmp_path, {"r.xacro": text})


def test_a_property_of_the_main_file_that_a_macro_sets_globally_hid_what_is_set(
    tmp_path: Path,
) -> None:
    files = {
        "r.xacro": """<xacro:property name="g" value="0"/>
        <xacro:macro name="set" params="v">
          <xacro:property name="g" value="${v}" scope="global"/>
        </xacro:macro>
        <xacro:macro name="wrap" params="v"><xacro:set v="${v + 1}"/><a v="${g}"/></xacro:macro>
        <xacro:wrap v="3"/><b v="${g}"/><xacro:set v="9"/><c v="${g}"/>"""
    }
    holds(tmp_path, files)


def test_a_number_of_the_environment_without_quotes_was_compared_as_text(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VERSION", "2")
    holds(
        tmp_path,
        {
            "r.xacro": """<xacro:if value="${$(env VERSION) == 2}"><a/></xacro:if>
            <xacro:if value="${'$(env VERSION)' == '2'}"><b/></xacro:if>
            <xacro:if value="${$(optenv UNSET_VERSION 3) > 2}"><c/></xacro:if>"""
        },
    )
