"""Robots that come over from xacro read as if a person had written them."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest

from tests.tools.migrate.test_xacro_migration import HEAD, hold_for, migrated
from yamaro.commands.main import main
from yamaro.tools.migrate.document import Body, Row
from yamaro.tools.migrate.writing import write_document
from yamaro.tools.migrate.xacro.python import negated


def test_comments_above_arguments_and_blocks_go_with_them(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <!-- how long it is -->
        <xacro:arg name="length" default="2"/>
        <xacro:include filename="lib.xacro"/>
        <a l="$(arg length)" c="$(arg colour)"><xacro:insert_block name="paint"/></a>
        """,
        lib="""\
        <!-- what colour it has -->
        <xacro:arg name="colour" default="red"/>
        <!-- the paint -->
        <xacro:property name="paint"><p/></xacro:property>
        """,
    )
    assert made["r.yaml"].splitlines()[:4] == [
        "robot: r",
        "arguments:",
        "  length: {default: 2, help: how long it is}",
        "  colour: {default: red, help: what colour it has}",
    ]
    assert made["lib.yaml"] == textwrap.dedent("""\
        # the arguments are declared in r.yaml
        functions:
          # the paint
          Paint()/global:
            p:
        """)


def test_the_comment_above_a_file_stays(tmp_path: Path) -> None:
    made = migrated(tmp_path, '<xacro:include filename="lib.xacro"/>', lib="<a/>")
    assert made["lib.yaml"] == "model:\n  a:\n"
    text = (tmp_path / "lib.xacro").read_text()
    (tmp_path / "lib.xacro").write_text(f"<!-- Copyright:\n     its makers -->\n{text}")
    (tmp_path / "r.urdf.xacro").unlink()
    made = migrated(tmp_path, '<xacro:include filename="lib.xacro"/>')
    assert made["lib.yaml"] == "# Copyright:\n# its makers\nmodel:\n  a:\n"


def test_conditions_are_turned_round_and_opposite_ones_joined(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="side" value="left"/>
        <xacro:property name="has_arm" value="true"/>
        <xacro:unless value="${side == 'left'}"><a/></xacro:unless>
        <xacro:if value="${side == 'left'}"><b/></xacro:if>
        <xacro:if value="${(not has_arm)}"><c/></xacro:if>
        <xacro:unless value="${not has_arm}"><d/></xacro:unless>
        """,
    )
    assert made["r.yaml"].partition("model:\n")[2] == (
        "- if side != 'left':\n"
        "    a:\n"
        "- else:\n"
        "    b:\n"
        "- if not has_arm:\n"
        "    c:\n"
        "- else:\n"
        "    d:\n"
    )


def test_opposite_conditions_stay_two_where_the_first_changes_what_they_read(
    tmp_path: Path,
) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="is_first" value="true"/>
        <xacro:if value="${is_first}"><xacro:property name="is_first" value="false"/><a/></xacro:if>
        <xacro:unless value="${is_first}"><b/></xacro:unless>
        """,
    )
    assert "else:" not in made["r.yaml"]
    assert "  if not is_first:\n    b:\n" in made["r.yaml"]


@pytest.mark.parametrize(
    ("condition", "opposite"),
    [
        ("a", "not a"),
        ("not a", "bool(a)"),  # it may be a text, which is not a condition
        ("not (a or b)", "bool(a or b)"),
        ("not (a == 1 or not b)", "a == 1 or not b"),
        ("not (a < b)", "a < b"),
        ("a or b", "not (a or b)"),
        ("a == b", "a != b"),
        ("x in xs", "x not in xs"),
        ("x not in f(xs)", "x in f(xs)"),
        ("a < b", "not (a < b)"),
        ("0 < a < b", "not (0 < a < b)"),
        ("(a + b) == c", "not ((a + b) == c)"),
        ("n['k']", "not n['k']"),
        ("not a and b", "not (not a and b)"),
    ],
)
def test_the_opposite_of_a_condition(condition: str, opposite: str) -> None:
    assert negated(condition) == opposite


def test_variables_behind_includes_stand_at_the_top_if_the_includes_leave_them_alone(
    tmp_path: Path,
) -> None:
    text = """\
        <xacro:include filename="lib.xacro"/>
        <!-- metres -->
        <xacro:property name="length" value="2"/>
        <xacro:property name="half" value="${length / 2}"/>
        <a l="${half}"/>
        """
    assert migrated(tmp_path, text, lib="<b/>")["r.yaml"].splitlines()[1:5] == [
        "variables:",
        "  # metres",
        "  length: 2",
        "  half: $(length / 2)",
    ]
    materials = '<material name="red"><color rgba="1 0 0 1"/></material>\n'
    assert migrated(tmp_path, materials + textwrap.dedent(text), lib="<b/>")["r.yaml"].startswith(
        "robot: r\nvariables:\n"
    )
    own = '<xacro:property name="length" value="9"/><b l="${length}"/>'
    made = migrated(tmp_path, text, lib=own)["r.yaml"]
    assert made.index("include") < made.index("length")


def test_macros_in_a_macro_see_its_names_without_more_ado(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:macro name="arm" params="prefix">
          <xacro:macro name="joint_of" params="name"><j n="${prefix}${name}"/></xacro:macro>
          <xacro:macro name="link_of" params="name"><l n="${prefix}${name}"/></xacro:macro>
          <xacro:joint_of name="a"/>
          <xacro:link_of name="b"/>
        </xacro:macro>
        <xacro:arm prefix="left_"/>
        """,
    )
    assert made["r.yaml"] == textwrap.dedent("""\
        robot: r
        functions:
          Arm(prefix):
            functions:
              JointOf(name):
                j/n=$(prefix)$(name):
              LinkOf(name):
                l/n=$(prefix)$(name):
            JointOf: {name: a}
            LinkOf: {name: b}
        model:
          Arm: {prefix: left_}
        """)


def test_what_a_macro_hands_down_is_declared_with_its_own_variables(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:macro name="inner" params="is_shown">
          <xacro:if value="${is_shown}"><i v="${depth}" w="${wide}"/></xacro:if>
        </xacro:macro>
        <xacro:macro name="outer" params="depth">
          <xacro:property name="wide" value="${depth * 2}"/>
          <xacro:inner is_shown="true"/>
        </xacro:macro>
        <xacro:outer depth="4"/>
        <xacro:inner is_shown="false"/>
        """,
    )
    outer = made["r.yaml"].partition("  Outer(depth):\n")[2]
    assert outer.partition("model:")[0] == (
        "    variables:\n"
        "      depth/child: $(depth)\n"
        "      wide/child: $(depth * 2)\n"
        "    Inner: {is_shown: true}\n"
    )


def test_many_inputs_go_on_several_lines_and_are_read_as_one(tmp_path: Path) -> None:
    names = [f"parameter_{number}" for number in range(12)]
    made = migrated(
        tmp_path,
        f"""\
        <xacro:macro name="m" params="{" ".join(names)}"><a v="${{parameter_11}}"/></xacro:macro>
        <xacro:m {" ".join(f'{name}="{name}"' for name in names)}/>
        """,
    )
    lines = made["r.yaml"].partition("input:")[2].partition("    body:")[0].splitlines()
    assert lines[0] == ""
    assert len(lines) == 3
    assert all(len(line) <= 100 for line in lines)
    assert " ".join(line.strip() for line in lines).strip() == ", ".join(names)


def test_a_row_that_needs_quotes_is_folded_as_a_text() -> None:
    row = Row(["*a"] + ["b" * 30] * 4)
    assert write_document(Body([])) == ""
    body = Body()
    body.add("input", row)
    first, second = f"'{', '.join(row.pieces[:3])},", f"{', '.join(row.pieces[3:])}'"
    assert write_document(body) == f"input:\n  {first}\n  {second}\n"


def test_numbers_have_one_space_between_them(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="x" value="1"/>
        <joint name="j"><origin xyz="${x}     ${x + 1}  0" rpy=" 0 0 ${x} "/></joint>
        """,
    )
    assert "origin/xyz=$(x) $(x + 1) 0, rpy=0 0 $(x):" in made["r.yaml"]


def test_of_several_defaults_of_an_argument_that_of_the_main_file_counts_if_it_is_first(
    tmp_path: Path,
) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="n" default="1"/>
        <xacro:include filename="lib.xacro"/>
        <xacro:arg name="n" default="3"/>
        <a n="$(arg n)"/>
        """,
        lib='<xacro:arg name="n" default="2"/><b n="$(arg n)"/>',
    )
    assert "arguments:\n  n: 1\n" in made["r.yaml"]
    assert "is None" not in made["r.yaml"] + made["lib.yaml"]


def test_a_material_without_a_name_is_short(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <link name="a_link"><visual><geometry><sphere radius="1"/></geometry>
        <material name=""><color rgba="1 0 0 1"/></material></visual></link>
        """,
    )
    assert "material/name=: {color: 1 0 0 1}" in made["r.yaml"]


def test_a_macro_that_is_nowhere_is_called_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("r.xacro").write_text(
        f'{HEAD}\n  <xacro:arg name="n" default="1"/>\n'
        '  <xacro:property name="n" value="$(arg n)"/>\n'
        '  <xacro:if value="${n > 1}"><xacro:ERROR_too_many/></xacro:if>\n'
        '  <link name="base"/>\n</robot>\n'
    )
    assert main(["migrate", "r.xacro", "-o", "out"]) == 0
    told = capsys.readouterr().err
    assert told.startswith("warning[not-migrated]: there is no macro 'ERROR_too_many'\n --> r.xac")
    assert "the sources call it too, which is an error where it is reached" in told
    assert main(["out/r.yaml", "-q"]) == 0
    assert main(["out/r.yaml", "-q", "n:=2"]) == 1
    assert "ERRORTooMany" in capsys.readouterr().err


def test_a_minus_before_an_expression_goes_into_it(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="x" value="2"/>
        <xacro:property name="name" value="left"/>
        <xacro:property name="back" value="-${x}"/>
        <xacro:property name="row" value="1 2"/>
        <a p="-${x} 0 -${x + 1}" q="${x}-${x}" r="arm-${name}" s="-${name}" t="-${2*x}"
           u="-${row}" v="-${max(x, 1)} 0" w="${back}"/>
        """,
    )
    assert "  back: $(-x)\n" in made["r.yaml"]
    assert (
        "a/p=$(-x) 0 $(-(x + 1)), q=$(x)-$(x), r=arm-$(name), s=-$(name), t=$(-(2*x)), "
        "u=-$(row), v=$(-max(x, 1)) 0, w=$(back):"
    ) in made["r.yaml"]


@pytest.mark.parametrize(
    ("lib", "scope"),
    [
        # a parameter or property of a macro, a text, a word of a path
        ('<xacro:macro name="m" params="size"><b v="${size}"/></xacro:macro>', ""),
        ('<xacro:macro name="m" params="">SIZE<b v="${size}"/></xacro:macro><xacro:m/>', ""),
        ("<b v=\"${dict(size=3)['size']}\"/>", ""),
        ('<b v="${1}size"/>', ""),
        # the variable itself
        ('<b v="${size}"/>', "/global"),
        ('<xacro:macro name="m" params="n"><b v="${n + size}"/></xacro:macro>', "/global"),
        (
            '<xacro:macro name="m" params="size:=^"><b v="${size}"/></xacro:macro><xacro:m/>',
            "/global",
        ),
        ('<xacro:macro name="m" params="n:=${size}"><b v="${n}"/></xacro:macro>', "/global"),
        ('<xacro:if value="${size > 1}"><b/></xacro:if>', "/global"),
    ],
)
def test_a_variable_is_global_only_if_another_file_reads_it(
    tmp_path: Path, lib: str, scope: str
) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="size" value="2"/>
        <a v="${size}"/>
        <xacro:include filename="lib.xacro"/>
        """,
        lib=lib.replace("SIZE", '<xacro:property name="size" value="3"/>'),
    )
    assert f"  size{scope}: 2\n" in made["r.yaml"]


def test_an_argument_is_passed_only_if_another_file_reads_it(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="size" default="2"/>
        <xacro:arg name="width" default="3"/>
        <xacro:include filename="lib.xacro"/>
        <a v="$(arg size)" w="$(arg width)"/>
        """,
        lib="""\
        <b w="$(arg width)"/>
        <xacro:macro name="m" params="size"><b v="${size}"/></xacro:macro>
        """,
    )
    assert "arguments:\n  size: 2\n  width: 3\nmodel:\n" in made["r.yaml"]
    assert "  include: {path: lib.yaml, width: $(width)}\n" in made["r.yaml"]


INERTIA = """\
    <xacro:macro name="box_inertia" params="m x y z *origin">
      <inertial>
        <xacro:insert_block name="origin"/>
        <mass value="${m}"/>
        <inertia ixx="${m*(y*y+z*z)/12}" ixy="0" ixz="0" iyy="${m*(x*x+z*z)/12}" iyz="0"
                 izz="${m*(x*x+y*y)/12}"/>
      </inertial>
    </xacro:macro>
    """


def test_a_parameter_that_nothing_reads_any_more_goes(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        f"""\
        {INERTIA}
        <xacro:macro name="outer" params="name size">
          <xacro:inner name="${{name}}" size="${{size}}"/>
        </xacro:macro>
        <xacro:macro name="inner" params="name size unused">
          <xacro:property name="double" value="${{size * missing}}"/>
          <link name="${{name}}_link">
            <collision><geometry><box size="1 1 1"/></geometry></collision>
            <xacro:box_inertia m="2" x="1" y="1" z="1"><origin xyz="0 0 0"/></xacro:box_inertia>
          </link>
        </xacro:macro>
        <xacro:outer name="a" size="2"/>
        """.replace(" unused", " unused:=1"),
    )["r.yaml"]
    assert "BoxInertia" not in made
    assert "  Outer(name):\n    Inner: {name: $(name)}\n" in made
    assert "  Inner(name, unused=1):\n" in made  # which was never read
    assert "  Outer: {name: a}\n" in made


def test_another_name_of_an_argument_that_nothing_reads_goes(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="prefix" default="my_"/>
        <xacro:macro name="arm" params="prefix"><a n="${prefix}"/></xacro:macro>
        <xacro:macro name="leg" params="prefix"><xacro:arm prefix="$(arg prefix)"/></xacro:macro>
        <xacro:arm prefix="$(arg prefix)"/>
        """,
    )
    assert "arg_prefix: $(prefix)" in made["r.yaml"]
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="prefix" default="my_"/>
        <xacro:macro name="arm" params="prefix:=$(arg prefix)"><a n="${prefix}"/></xacro:macro>
        <xacro:arm prefix="$(arg prefix)"/>
        """,
    )
    assert made["r.yaml"].count("arg_prefix") in (0, 2)


def test_a_file_of_which_nothing_is_left_is_not_included(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <!-- the arguments -->
        <xacro:include filename="arguments.xacro"/>
        <xacro:include filename="lib.xacro"/>
        <a n="$(arg n)"/>
        """,
        arguments='<xacro:arg name="n" default="1"/>',
        lib='<xacro:include filename="arguments.xacro"/><b/>',
    )
    assert list(made) == ["r.yaml", "lib.yaml"]
    assert made["r.yaml"] == (
        "robot: r\narguments:\n  n: 1\nmodel:\n  include: lib.yaml\n  a/n=$(n):\n"
    )


def test_files_that_would_have_one_name_keep_their_endings(tmp_path: Path) -> None:
    made = migrated(tmp_path, '<xacro:include filename="r.xacro"/>', r="<a/>")
    assert list(made) == ["r.yaml", "r_xacro.yaml"]
    assert "include: r_xacro.yaml" in made["r.yaml"]


def test_one_short_entry_under_a_condition_is_on_its_line(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="n" default="2"/>
        <xacro:macro name="leg" params="x"><a x="${x}"/></xacro:macro>
        <xacro:if value="${$(arg n) > 1}"><xacro:leg x="1"/></xacro:if>
        <xacro:if value="${$(arg n) > 2}"><xacro:leg x="1"/></xacro:if>
        <xacro:if value="${$(arg n) > 1}"><b x="1"/></xacro:if>
        <xacro:if value="${$(arg n) > 1}"><!-- why --><c/></xacro:if>
        <xacro:if value="${$(arg n) == 1}"><d/></xacro:if>
        <xacro:unless value="${$(arg n) == 1}"><e/></xacro:unless>
        <link name="base_link"/>
        <joint name="a_joint" type="fixed"><parent link="base_link"/><child link="a_link"/>
          <xacro:if value="${$(arg n) > 1}"><limit effort="1" velocity="2" lower="0" upper="1"/>
          </xacro:if>
          <xacro:if value="${$(arg n) > 2}"><dynamics damping="1"/></xacro:if>
        </joint>
        <link name="a_link"/>
        """,
    )["r.yaml"]
    assert "- if n > 1: {Leg: {x: 1}}\n- if n > 2: {Leg: {x: 1}}\n- if n > 1:\n" in made
    assert "      if n > 1: {limit: {effort: 1, velocity: 2, lower: 0, upper: 1}}\n" in made
    assert "      if n > 2: {dynamics: {damping: 1}}\n" in made
    assert "- if n == 1:\n    d:\n- else:\n    e:\n" in made
    hold_for(tmp_path, ["n:=1"], ["n:=2"], ["n:=3"])


def test_only_what_comes_again_begins_an_item_of_a_list(tmp_path: Path) -> None:
    box = '<geometry><box size="1 1 1"/></geometry>'
    made = migrated(
        tmp_path,
        f"""\
        <link name="a_link">
          <inertial><mass value="1"/>
          <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
          <visual name="one"><origin xyz="0 0 1"/>{box}</visual>
          <visual><origin xyz="0 0 2"/><geometry><sphere radius="1"/></geometry></visual>
          <visual><origin xyz="0 0 3"/><geometry><sphere radius="2"/></geometry></visual>
          <collision>{box}</collision>
        </link>
        """,
    )
    assert made["r.yaml"].partition("link:\n")[2] == textwrap.indent(
        textwrap.dedent("""\
        - geometry: box
          scale: 1 1 1
          inertial: {mass: 1, inertia: 1 0 0 1 0 1}
          visual/name=one: {xyz: 0 0 1}
          visual: {geometry: sphere, scale: 1, xyz: 0 0 2}
        - visual: {geometry: sphere, scale: 2, xyz: 0 0 3}
          collision:
        """),
        "    ",
    )


def test_a_long_key_is_one_line_without_a_question_mark(tmp_path: Path) -> None:
    names = " ".join(f"quite_a_long_parameter_{number}" for number in range(6))
    values = " ".join(f'v{number}="${{{name}}}"' for number, name in enumerate(names.split()))
    given = " ".join(f'{name}="1"' for name in names.split())
    made = migrated(
        tmp_path,
        f"""\
        <xacro:macro name="m" params="{names}"><a {values}><b/></a><a {values}/></xacro:macro>
        <xacro:m {given}/>
        """,
    )
    assert "? " not in made["r.yaml"]


def test_a_macro_for_links_that_nothing_calls_has_the_keys_of_parts(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:macro name="ball" params="m r *origin">
          <inertial>
            <xacro:insert_block name="origin"/>
            <mass value="${m}"/>
            <inertia ixx="${m*r}" ixy="0" ixz="0" iyy="${m*r}" iyz="0" izz="${m*r}"/>
          </inertial>
        </xacro:macro>
        <link name="base"/>
        """,
    )
    assert "mass: $(m)\n" in made["r.yaml"]
    assert "inertia: $(m*r) 0 0 $(m*r) 0 $(m*r)\n" in made["r.yaml"]


def test_a_material_that_a_macro_puts_into_a_link_stays_an_element(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:macro name="blue"><material name="b"><color rgba="0 0 1 1"/></material></xacro:macro>
        <link name="base">
          <visual><geometry><sphere radius="1"/></geometry></visual>
          <xacro:blue/>
        </link>
        """,
    )
    assert "material/name=b: {color/rgba=0 0 1 1: }" in made["r.yaml"]


def test_variables_of_opposite_conditions_have_conditional_values(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="is_left" default="true"/>
        <link name="base_link"/>
        <!-- which side -->
        <xacro:if value="$(arg is_left)">
          <xacro:property name="side" value="left"/>
          <xacro:property name="sign" value="1"/>
        </xacro:if>
        <xacro:unless value="$(arg is_left)">
          <xacro:property name="side" value="right"/>
          <xacro:property name="sign" value="${-1}"/>
        </xacro:unless>
        <a s="${side}" y="${sign * 0.5}"/>
        """,
    )
    assert made["r.yaml"] == textwrap.dedent("""\
        robot: r
        arguments:
          is_left: true
        variables:
          # which side
          side: $('left' if is_left else 'right')
          sign: $(1 if is_left else -1)
        model:
          link/name=base_link:
          a/s=$(side), y=$(sign * 0.5):
        """)
    hold_for(tmp_path, ["is_left:=true"], ["is_left:=false"])


@pytest.mark.parametrize(
    ("inside", "other"),
    [
        ('<xacro:property name="b" value="1"/>', '<xacro:property name="c" value="2"/>'),
        ('<xacro:property name="b" value="1"/>', '<xacro:property name="b" value="2"/><x/>'),
        ('<xacro:property name="b" value="1"/><!-- m -->', '<xacro:property name="b" value="2"/>'),
        ('<xacro:property name="b" value="1_${n}"/>', '<xacro:property name="b" value="2"/>'),
    ],
)
def test_other_variables_stay_in_their_conditions(tmp_path: Path, inside: str, other: str) -> None:
    made = migrated(
        tmp_path,
        f"""\
        <xacro:arg name="n" default="1"/>
        <xacro:property name="n" value="$(arg n)"/>
        <xacro:if value="${{n > 1}}">{inside}</xacro:if>
        <xacro:unless value="${{n > 1}}">{other}</xacro:unless>
        """,
    )
    assert "  if n > 1:\n" in made["r.yaml"]
    hold_for(tmp_path, ["n:=1"], ["n:=2"])


def test_variables_amid_a_model_stand_at_the_top_if_nothing_keeps_them(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="a" value="1"/>
        <xacro:macro name="m" params="x"><b x="${x}"/></xacro:macro>
        <xacro:m x="${a}"/>
        <!-- how wide -->
        <xacro:property name="width" value="${a * 2}"/> <!-- m -->
        <xacro:property name="from_lib" value="${height * 2}"/>
        <xacro:include filename="lib.xacro"/>
        <xacro:m x="${width}"/>
        <xacro:property name="twice" value="${width * 2}"/>
        <xacro:property name="again" value="1"/>
        <xacro:m x="${twice + again + from_lib}"/>
        <xacro:property name="again" value="2"/>
        <xacro:m x="${again}"/>
        """,
        lib='<xacro:property name="height" value="3"/>',
    )["r.yaml"]
    head, _, model = made.partition("functions:")
    assert head == textwrap.dedent("""\
        robot: r
        variables:
          a: 1
          # how wide
          width: $(a * 2)  # m
          twice: $(width * 2)
        """)
    assert model.index("lib.yaml") < model.index("M: {x: $(width)}") < model.index("again: 2")


def test_variables_that_a_macro_sets_anew_stay_where_they_are(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:macro name="set" params="">
          <xacro:property name="n" value="5" scope="global"/>
        </xacro:macro>
        <xacro:set/>
        <a n="${n}"/>
        <xacro:property name="m" value="${n + 1}"/>
        <a n="${m}"/>
        """,
    )["r.yaml"]
    assert made.index("Set:\n") < made.index("m: $(n + 1)")


def test_a_word_with_arg_in_it_reads_no_argument(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="margin" default="2"/>
        <xacro:include filename="lib.xacro"/>
        <xacro:m margin="$(arg margin)"/>
        """,
        lib='<xacro:macro name="m" params="margin"><b v="${margin} large"/></xacro:macro>',
    )
    assert "  margin: 2\n" in made["r.yaml"]
    assert "arg_margin" not in made["r.yaml"]


@pytest.mark.parametrize(("inside", "joined"), [("<b/>", True), ("<xacro:set/>", False)])
def test_opposite_conditions_are_joined_if_nothing_changes_what_they_read(
    tmp_path: Path, inside: str, joined: bool
) -> None:
    made = migrated(
        tmp_path,
        f"""\
        <xacro:macro name="set" params="">
          <xacro:property name="kind" value="a" scope="parent"/>
        </xacro:macro>
        <xacro:macro name="m" params="">
          <xacro:set/>
          <xacro:if value="${{kind == 'a'}}">{inside}<c v="1"/></xacro:if>
          <xacro:unless value="${{kind == 'a'}}"><d v="1"/></xacro:unless>
        </xacro:macro>
        <xacro:m/>
        """,
    )
    assert ("else:" in made["r.yaml"]) is joined


def test_a_variable_is_local_if_other_files_only_have_parameters_of_its_name(
    tmp_path: Path,
) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="size" default="2"/>
        <xacro:arg name="given" default="3"/>
        <xacro:include filename="part.xacro"/>
        <xacro:piece size="$(arg size)"/>
        """,
        part="""\
        <xacro:macro name="piece" params="size">
          <a size="${size}" given="$(arg given)"/>
        </xacro:macro>
        """,
    )
    assert "  include: {path: part.yaml, given: $(given)}\n" in made["r.yaml"]


def test_a_variable_that_others_may_change_stays_global(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="size" value="2"/>
        <xacro:include filename="part.xacro"/>
        <xacro:change/>
        <a size="${size}"/>
        """,
        part="""\
        <xacro:macro name="change" params="">
          <xacro:property name="size" value="3" scope="global"/>
        </xacro:macro>
        """,
    )
    assert "size/global: 2" in made["r.yaml"]


def test_an_expression_that_is_only_a_number_is_that_number(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="a" value="${-1}"/><xacro:property name="b" value="${0.5}"/>
        <xacro:property name="c" value="${1e3}"/>
        <a a="${a}" b="${b}" c="${c}"/>
        """,
    )["r.yaml"]
    assert "  a: -1\n  b: 0.5\n  c: $(1e3)\n" in made
    hold_for(tmp_path, [])


def test_comments_stand_where_their_entries_do(tmp_path: Path) -> None:
    made = migrated(tmp_path, "<t><a/><!-- b --><b/><c/><d/><!-- a --><a/></t>")["r.yaml"]
    assert "  - a:\n    # b\n    b:\n    c:\n    d:\n  # a\n  - a:\n" in made


def test_an_argument_is_compared_with_a_text_as_it_is(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="lidar" default="urg"/>
        <xacro:arg name="sim" default="true"/>
        <link name="base">
          <xacro:if value="${'$(arg lidar)' == 'urg' and   '$(arg sim)' == 'true'}"><a/></xacro:if>
          <xacro:if value="${'rp' != '$(arg lidar)' and '$(arg sim)' != 'true'}"><b/></xacro:if>
        </link>
        """,
    )
    assert "if lidar == 'urg' and sim:" in made["r.yaml"]
    assert "if lidar != 'rp' and not sim:" in made["r.yaml"]


def test_a_sign_before_a_long_number_is_that_of_the_number(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <link name="base"/>
        <joint name="tip_joint" type="fixed">
          <parent link="base"/><child link="tip_link"/>
          <origin xyz="0 0 1" rpy="-${1/3} 0 0"/>
        </joint>
        <link name="tip_link"/><gazebo><v>x-${1/3}</v></gazebo>
        """,
    )
    assert "-(1/3)" in made["r.yaml"]
    assert "x-$(str(1/3))" in made["r.yaml"]
