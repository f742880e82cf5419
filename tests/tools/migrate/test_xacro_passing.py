"""Names that macros read from their callers are passed to the functions as parameters."""

from __future__ import annotations

from pathlib import Path

from tests.tools.migrate.against_xacro import holds
from tests.tools.migrate.test_xacro_migration import hold_for, migrated

FINGER = '<xacro:macro name="finger" params=""><link name="${side}_finger"/></xacro:macro>'
HAND = '<xacro:macro name="hand" params=""><xacro:finger/></xacro:macro>'
LEFT = '<xacro:arm side="left"/>'


def arm(content: str) -> str:
    return f'<xacro:macro name="arm" params="side">{content}</xacro:macro>'


def sources(folder: Path, *pieces: str) -> str:
    """Return the functions and model of a robot that is the same for two arguments."""
    argument = '<xacro:arg name="given" default="a"/>'
    made = migrated(folder, "\n".join([argument, *pieces]))["r.yaml"]
    hold_for(folder, ["given:=a"], ["given:=b"])
    return made.partition("functions:\n")[2]


def test_a_name_of_the_caller_becomes_a_parameter(tmp_path: Path) -> None:
    assert sources(tmp_path, FINGER, arm("<xacro:finger/>"), LEFT) == (
        "  Finger(side):\n"
        "    link/name=$(side)_finger:\n"
        "  Arm(side):\n"
        "    Finger: {side: $(side)}\n"
        "model:\n"
        "  Arm: {side: left}\n"
    )


def test_it_is_passed_through_macros_that_do_not_read_it(tmp_path: Path) -> None:
    made = sources(tmp_path, FINGER, HAND, arm("<xacro:hand/>"), LEFT)
    assert "    Hand: {side: $(side)}\n" in made
    assert "/child" not in made


def test_a_property_that_is_set_before_the_call_is_passed(tmp_path: Path) -> None:
    made = sources(
        tmp_path,
        FINGER,
        """\
        <xacro:macro name="arm" params="">
          <xacro:property name="side" value="left"/>
          <xacro:if value="${'$(arg given)' == 'b'}">
            <xacro:property name="side" value="right"/>
          </xacro:if>
          <xacro:finger/>
        </xacro:macro>
        <xacro:arm/>
        """,
    )
    assert "Finger: {side: $(side)}" in made
    assert "/child" not in made


def test_a_property_that_may_be_missing_is_not_passed(tmp_path: Path) -> None:
    made = sources(
        tmp_path,
        '<xacro:macro name="finger" params="n"><xacro:if value="${n}">'
        '<link name="${side}_finger"/></xacro:if></xacro:macro>',
        """\
        <xacro:macro name="arm" params="n">
          <xacro:if value="${n}"><xacro:property name="side" value="left"/></xacro:if>
          <xacro:finger n="${n}"/>
        </xacro:macro>
        <xacro:arm n="${'$(arg given)' == 'b'}"/>
        """,
    )
    assert "side/child: left" in made


def test_a_default_that_reads_a_name_of_the_caller_is_passed(tmp_path: Path) -> None:
    made = sources(
        tmp_path,
        '<xacro:macro name="finger" params="name:=${side}_one">'
        '<link name="${name}"/></xacro:macro>',
        arm('<xacro:finger/><xacro:finger name="other"/>'),
        LEFT,
    )
    assert "Finger: {name: $(side)_one}" in made
    assert "/child" not in made


def test_a_name_that_only_some_callers_have_is_not_passed(tmp_path: Path) -> None:
    made = sources(
        tmp_path,
        '<xacro:macro name="finger" params="n"><xacro:if value="${n}">'
        '<link name="${side}_finger"/></xacro:if></xacro:macro>',
        arm('<xacro:finger n="1"/>'),
        LEFT,
        '<xacro:finger n="0"/>',
    )
    assert "side/child: $(side)" in made


def test_the_argument_of_a_name_that_is_passed_stays_what_it_is(tmp_path: Path) -> None:
    sources(
        tmp_path,
        '<xacro:macro name="finger" params="">'
        '<link name="${given}_$(arg given)_finger"/></xacro:macro>',
        '<xacro:macro name="arm" params="given"><xacro:finger/></xacro:macro>',
        '<xacro:arm given="left"/>',
    )


def test_a_call_in_a_block_has_the_names_of_where_it_is_written(tmp_path: Path) -> None:
    sources(
        tmp_path,
        FINGER,
        '<xacro:macro name="around" params="side **content">'
        '<link name="${side}_around"/><xacro:insert_block name="content"/></xacro:macro>',
        arm('<xacro:around side="outer"><b><xacro:finger/></b></xacro:around>'),
        LEFT,
    )


def test_a_macro_that_is_called_by_its_name_gets_it_too(tmp_path: Path) -> None:
    made = sources(tmp_path, FINGER, arm('<xacro:call macro="finger"/>'), LEFT)
    assert "Finger: {side: $(side)}" in made


def test_a_macro_whose_name_is_computed_sees_the_names_of_its_caller(tmp_path: Path) -> None:
    made = sources(
        tmp_path, FINGER, '<xacro:property name="which" value="finger"/>',
        arm('<xacro:call macro="${which}"/>'), LEFT,
    )  # fmt: skip
    assert "side/child: $(side)" in made


def test_a_name_that_a_macro_sets_for_its_caller_is_seen_by_what_that_calls(
    tmp_path: Path,
) -> None:
    made = sources(
        tmp_path,
        FINGER,
        """\
        <xacro:macro name="choose" params="side">
          <xacro:property name="side" value="${side}_$(arg given)" scope="parent"/>
        </xacro:macro>
        """,
        arm('<xacro:choose side="${side}"/><xacro:finger/>'),
        LEFT,
    )
    assert "side/bridge: $(side)_$(given)" in made
    assert "/child" not in made


def test_a_macro_of_a_file_that_a_macro_includes_reads_a_property_of_that_macro(
    tmp_path: Path,
) -> None:
    outer = """<xacro:macro name="outer" params="n:=2">
        <xacro:property name="size" value="$(arg g)"/>
        <xacro:include filename="f.xacro"/>
        <xacro:macro name="inner" params="k"><xacro:leaf k="${k}_${size}"/></xacro:macro>
        <xacro:inner k="a"/><xacro:if value="${n > 1}"><xacro:inner k="b"/></xacro:if>
        </xacro:macro>"""
    leaf = '<xacro:macro name="leaf" params="k"><link name="${k}_${size}"/></xacro:macro>'
    argument = '<xacro:arg name="g" default="1"/>'
    made = holds(
        tmp_path, {"r.xacro": argument + outer + "<xacro:outer/>", "f.xacro": leaf}, "g:=7"
    )
    assert "size/child: $(g)" in made.files["r.yaml"]


def test_a_block_keeps_the_values_of_who_calls_though_the_macro_has_variables_of_these_names(
    tmp_path: Path,
) -> None:
    inner = """<xacro:macro name="inner" params="name size:=9 **content">
        <link name="${name}"><s>${size}</s><xacro:insert_block name="content"/></link>
        </xacro:macro>"""
    outer = """<xacro:macro name="outer" params="prefix *origin **content">
        <xacro:property name="name" value="${prefix}_o"/>
        <xacro:inner name="${name}"><c><a>${prefix}</a><xacro:insert_block name="origin"/>
        <xacro:insert_block name="content"/></c></xacro:inner></xacro:macro>"""
    call = """<xacro:outer prefix="x"><origin xyz="0 0 ${size}" n="${name}"/>
        <content><b>${name} ${size} $(arg prefix)</b></content></xacro:outer>"""
    start = """<xacro:arg name="prefix" default="top"/>
        <xacro:property name="size" value="3"/><xacro:property name="name" value="n"/>"""
    later = f'<xacro:property name="size" value="4"/>{call.replace("x", "y", 1)}'
    later = later.replace("<yacro", "<xacro", 1)
    made = holds(tmp_path, {"r.xacro": start + inner + outer + call + later}, "prefix:=q")
    assert "outer_size: $(size)" in made.files["r.yaml"]


def test_a_block_needs_no_other_name_for_what_is_passed_under_its_own(tmp_path: Path) -> None:
    holder = """<xacro:macro name="holder" params="side *origin">
        <link name="${side}"><xacro:insert_block name="origin"/></link></xacro:macro>"""
    around = arm('<xacro:holder side="${side}"><o n="${side}"/></xacro:holder>')
    made = holds(tmp_path, {"r.xacro": holder + around + LEFT})
    assert "outer_" not in made.files["r.yaml"]


def test_lists_of_data_are_copied_where_macros_take_from_them(tmp_path: Path) -> None:
    macro = """<xacro:macro name="each" params="items kind"><xacro:if value="${items}">
        <xacro:property name="one" value="${items.pop(0)}"/><link name="${kind}_${one}"/>
        <xacro:each items="${items}" kind="${kind}"/></xacro:if></xacro:macro>"""
    main = """<xacro:property name="data" value="${xacro.load_yaml('d.yaml')}"/>
        <xacro:each items="${data['wheels']}" kind="a"/>
        <xacro:property name="mine" value="${data['wheels']}"/>
        <xacro:each items="${mine}" kind="b"/><n>${len(mine)} ${len(data['wheels'])}</n>"""
    holds(tmp_path, {"r.xacro": macro + main, "d.yaml": "wheels: [left, right]\n"})


def test_a_parameter_that_is_no_name_is_left_out(tmp_path: Path) -> None:
    made = holds(
        tmp_path, {"r.xacro": '<xacro:macro name="pi" params="3.14"/><link name="a${1}"/>'}
    )
    assert "3.14" not in made.files["r.yaml"]


SETTER = """<xacro:macro name="set" params="name value:=5"><xacro:property name="${name}"
    value="${value * 2}" scope="parent"/></xacro:macro>"""


def test_a_macro_that_sets_a_property_whose_name_it_is_given_becomes_that_property(
    tmp_path: Path,
) -> None:
    use = """<xacro:set name="upper" value="3"/><xacro:set name="lower" value="${upper + k}"/>
        <link name="arm"><m>${upper} ${lower}</m></link>"""
    robot = f"""<xacro:arg name="a" default="1"/>{SETTER}
        <xacro:macro name="arm" params="k">{use}</xacro:macro><xacro:set name="body"/>
        <link name="base"><m>${{body}}</m></link><xacro:arm k="$(arg a)"/>"""
    made = holds(tmp_path, {"r.xacro": robot}, "a:=0.5")
    assert made.lost == []
    assert "Set" not in made.files["r.yaml"]


def test_a_file_that_a_macro_includes_changes_the_parameters_of_that_macro(tmp_path: Path) -> None:
    macro = """<xacro:macro name="hand" params="tip:=pst side:=none more:=1">
        <xacro:include filename="s.xacro"/><xacro:finger/>
        <link name="${tip}_${side}_${more}"/></xacro:macro>"""
    upper = """<xacro:macro name="upper" params="name value"><xacro:property name="${name}"
        value="${value.upper()}" scope="parent"/></xacro:macro>
        <xacro:property name="tip" default="x"/><xacro:property name="more" default="7"/>
        <xacro:upper name="tip" value="${tip}"/><xacro:property name="side" value="left"/>
        <xacro:macro name="finger" params="">
        <link name="f_${side}_${tip}_${more}"/></xacro:macro>"""
    robot = f"""<xacro:arg name="t" default="ab"/>{macro}<xacro:hand/>
        <xacro:hand tip="$(arg t)" more="3"/>"""
    holds(tmp_path, {"r.xacro": robot, "s.xacro": upper}, "t:=cd")
