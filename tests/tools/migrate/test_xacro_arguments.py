"""Arguments and variables of the environment come over as what they are, under their own names."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.same_robot import is_same_robot
from tests.tools.migrate.against_xacro import migrated_for, model_of, moved
from tests.tools.migrate.test_xacro_migration import HEAD, migrated
from yamaro import build
from yamaro.codes import ADJUSTABLE
from yamaro.policy import Limits
from yamaro.tools.migrate.xacro.command import migrate_robot, remarks_on
from yamaro.xml.reader import decode_xml


def test_an_argument_stays_apart_from_a_parameter_of_its_name(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:arg name="n" default="main_"/>
        <xacro:macro name="arm" params="n:=$(arg n)">
          <link name="${n}tool"/>
          <link name="$(arg n)${n}mount"/>
        </xacro:macro>
        <xacro:arm/>
        <xacro:arm n="second_"/>
        """,
        "",
        "other_",
    )
    assert "arguments:\n  n: main_\nvariables:\n  arg_n: $(n)\n" in made
    assert "link/name=$(arg_n)$(n)mount:" in made


def test_texts_that_xacro_would_read_as_truth_values_are_reported(tmp_path: Path) -> None:
    path = tmp_path / "r.xacro"
    path.write_text(
        f"""{HEAD}
        <xacro:arg name="con" default=""/>
        <xacro:arg name="direct" default=""/>
        <xacro:arg name="flag" default="true"/>
        <xacro:arg name="count" default="3"/>
        <xacro:arg name="unused" default=""/>
        <xacro:macro name="m" params="con:='' flag count unused">
          <xacro:property name="con" value="$(arg con)"/>
          <link name="l${{con}}_$(arg direct)_${{flag}}_${{count}}"/>
        </xacro:macro>
        <xacro:m con="$(arg con)" flag="$(arg flag)" count="$(arg count)" unused="$(arg unused)"/>
        </robot>
        """
    )
    source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
    migration = migrate_robot(source, str(tmp_path), arguments=(), packages={}, limits=Limits())
    assert migration.has_section
    assert migration.texts == ["con"]
    assert any(
        line.startswith("with con:=true xacro writes True, ") for line in remarks_on(migration)
    )


def test_an_argument_stays_apart_from_a_property_of_its_name(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:arg name="n" default="deck"/>
        <xacro:property name="n" value="hull"/>
        <link name="${n}"/>
        <link name="$(arg n)_2"/>
        """,
        "",
        "keel",
    )
    assert "link/name=$(n):" in made
    assert "link/name=$(arg_n)_2:" in made


def test_a_property_made_of_its_own_argument_needs_no_other_name(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:arg name="n" default="deck"/>
        <xacro:property name="n" value="$(arg n)"/>
        <link name="${n}"/><link name="$(arg n)_2"/>
        """,
        "",
        "keel",
    )
    assert "arg_" not in made


def test_a_given_argument_that_is_not_declared_is_declared(tmp_path: Path) -> None:
    xacro = pytest.importorskip("xacro")
    path = tmp_path / "r.urdf.xacro"
    path.write_text(f'{HEAD}<link name="$(arg side)_arm"/></robot>')
    source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
    migration = migrate_robot(
        source, str(tmp_path), arguments=["side:=left"], packages={}, limits=Limits()
    )
    assert migration.faults == []
    (tmp_path / "r.yaml").write_text(migration.files["r.yaml"])
    for side in ("left", "right"):
        expected = xacro.process_file(str(path), mappings={"side": side}).toxml()
        made = build(tmp_path / "r.yaml", command_line=[f"side:={side}"], allow=ADJUSTABLE)
        assert is_same_robot(expected.encode(), made.xml().encode())


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("", ""),
        *(("TEST_ON", value) for value in ("1", "0.2", "true", "False", "2")),
        *(("TEST_FLAG", value) for value in ("true", "1", "7")),
        *(("TEST_LENGTH", value) for value in ("2", "1e-1")),
        ("TEST_AT", "1 2 3"),
        *(("TEST_KIND", value) for value in ("side", "3")),
        *(("TEST_MORE", value) for value in ("", "0.5", "4")),
    ],
)
def test_a_variable_of_the_environment_is_read_as_xacro_reads_its_text(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, name: str, value: str
) -> None:
    xacro = pytest.importorskip("xacro")
    files = migrated(
        tmp_path,
        """\
        <xacro:property name="on" value="$(optenv TEST_ON 0)"/>
        <xacro:property name="length" value="$(optenv TEST_LENGTH 0.5)"/>
        <xacro:property name="at" value="$(optenv TEST_AT 0 0 0)"/>
        <xacro:property name="kind" value="$(optenv TEST_KIND front)"/>
        <xacro:property name="more" value="$(optenv TEST_MORE)"/>
        <xacro:arg name="flag" default="$(optenv TEST_FLAG false)"/>
        <xacro:if value="${on}"><link name="on"/></xacro:if>
        <xacro:if value="$(optenv TEST_FLAG 0)"><link name="on_${on}_${kind}"/></xacro:if>
        <xacro:if value="${$(optenv TEST_LENGTH 1) > 1}"><link name="long"/></xacro:if>
        <xacro:if value="${more != ''}"><link name="more"><a>${more * 2}</a></link></xacro:if>
        <xacro:if value="$(arg flag)"><link name="flag"/></xacro:if>
        <link name="base">
          <visual>
            <origin xyz="${at}" rpy="${length + 1} 0 0"/>
            <geometry><sphere radius="${length}"/></geometry>
          </visual>
        </link>
        """,
    )
    assert "length: $(env('TEST_LENGTH', 0.5))" in files["r.yaml"]
    assert "kind: $(env('TEST_KIND', 'front'))" in files["r.yaml"]
    assert "more: $(env('TEST_MORE', 0) if env('TEST_MORE', '') else '')" in files["r.yaml"]
    assert "at: $(env('TEST_AT', '0 0 0'))" in files["r.yaml"]
    if name:
        monkeypatch.setenv(name, value)
    expected = xacro.process_file(str(tmp_path / "r.urdf.xacro"), mappings={}).toxml()
    made = build(tmp_path / "out/r.yaml", on_message=lambda line: None, allow=ADJUSTABLE)
    assert is_same_robot(expected.encode(), made.xml().encode())


def test_a_default_that_xacro_takes_for_a_text_stays_one(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:macro name="port" params="address:=0x9"><link name="port_${address}"/></xacro:macro>
        <xacro:port/>
        """,
    )
    assert "  Port(address='0x9'):\n" in made


def test_a_block_may_have_the_name_of_a_macro(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:property name="paint"><material name="grey"/></xacro:property>
        <xacro:macro name="paint">
          <gazebo><xacro:insert_block name="paint"/></gazebo>
        </xacro:macro>
        <xacro:paint/>
        <gazebo reference="a"><xacro:insert_block name="paint"/></gazebo>
        """,
    )
    assert model_of(made)[0].strip(" -") == "Paint:"


def test_an_argument_without_a_name_cannot_be_given(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:arg name="" default="true"/>
        <xacro:arg name="n" default="a"/>
        <link name="$(arg n)"/>
        """,
        "",
        "b",
    )
    assert "arguments:\n  n: a\n" in made


@pytest.mark.parametrize("given", ["'false'", "'true'", "false", "True", "1", "0", "'0'"])
def test_a_text_in_eval_is_read_as_python(tmp_path: Path, given: str) -> None:
    migrated_for(
        tmp_path,
        f"""\
        <xacro:macro name="m" params="fast:={given} slow:='false'">
          <link name="$(eval 'fast' if ${{fast}} else 'slow' if ${{slow}} else 'still')"/>
          <link name="$(eval 1 + ${{slow}})"/>
        </xacro:macro>
        <xacro:m/>
        """,
    )


def test_a_default_made_of_an_argument_whose_default_is_made_of_a_property(tmp_path: Path) -> None:
    migrated_for(
        tmp_path,
        """\
        <xacro:property name="sizes" value="${dict(r=0.1)}"/>
        <xacro:arg name="r" default="${sizes['r'] * 2}"/>
        <xacro:arg name="n" default="$(arg r)5"/>
        <link name="a"><r>$(arg r) $(arg n)</r></link>
        """,
        "",
        "7",
    )


def test_a_truth_value_of_eval_is_written_as_xacro_writes_it(tmp_path: Path) -> None:
    migrated_for(
        tmp_path,
        """\
        <xacro:arg name="n" default="false"/>
        <xacro:macro name="m" params="v:=$(arg n) k:=0">
          <link name="l${k}"><x a="$(eval not ${v})" b="$(eval ${k} + 1)"/></link>
        </xacro:macro>
        <xacro:m/>
        """,
        "",
        "true",
    )


def test_a_list_for_an_argument_that_is_used_as_a_text_is_told(tmp_path: Path) -> None:
    text = (
        '<xacro:arg name="names" default="a b"/><xacro:property name="own" value="$(arg names)"/>'
        '<link name="l_${own[0]}"/>'
    )
    made = moved(tmp_path, {"r.xacro": text})
    assert not made.has_section
    assert any("[1, 2] is a text to xacro and a list" in line for line in remarks_on(made))
