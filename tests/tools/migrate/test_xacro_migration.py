"""Robots in xacro become sources of the same structure that make the same robot."""

from __future__ import annotations

import os
import sys
import textwrap
from pathlib import Path

import pytest

from tests.effort import tried
from tests.same_robot import is_same_robot
from tests.tools.migrate.migrating import assert_in_style
from tests.xacro.test_corpus import CORPUS, UNKNOWN, real, rows
from yamaro import build
from yamaro.codes import ADJUSTABLE
from yamaro.commands.main import main
from yamaro.policy import Limits
from yamaro.source import Source
from yamaro.tools.migrate.xacro.command import DiskHost, migrate_robot
from yamaro.tools.migrate.xacro.program import XacroProgram
from yamaro.tools.migrate.xacro.python import CannotMigrate, Translator, typed
from yamaro.xml.reader import decode_xml

HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'


def migrated(folder: Path, text: str, **files: str) -> dict[str, str]:
    """Return the sources of a robot, which were found to make the same robot."""
    (folder / "r.urdf.xacro").write_text(f"{HEAD}\n{textwrap.dedent(text)}</robot>\n")
    for name, content in files.items():
        (folder / f"{name}.xacro").write_text(f"{HEAD}\n{textwrap.dedent(content)}</robot>\n")
    path = folder / "r.urdf.xacro"
    source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
    migration = migrate_robot(
        source, str(folder / "out"), arguments=[], packages={}, limits=Limits()
    )
    assert migration.faults == []
    assert [str(each) for each in migration.differences] == []
    assert migration.lost == []
    for name, content in migration.files.items():
        (folder / "out" / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / "out" / name).write_text(content)
    for name in migration.origins.values():
        assert_in_style(name, migration.files[name])
    return migration.files


def translator() -> Translator:
    """Return what translates the expressions of a robot with an argument `is_sim`."""
    text = f'{HEAD}<xacro:arg name="is_sim" default="true"/></robot>'
    program = XacroProgram(
        Source(text, name="r.xacro", path="/r.xacro"), DiskHost(Limits(), {}), {}
    )
    return Translator(
        program,
        rename=lambda name: name,
        argument=lambda name: name,
        is_namespace=lambda name: False,
        data_folder="",
    )


def hold_for(folder: Path, *several: list[str]) -> list[str]:
    """Hold that the sources of a robot make what xacro does for arguments; return what was said."""
    xacro = pytest.importorskip("xacro")
    said: list[str] = []
    for arguments in several:
        given = dict(argument.split(":=") for argument in arguments)
        expected = xacro.process_file(str(folder / "r.urdf.xacro"), mappings=given).toxml()
        made = build(
            folder / "out/r.yaml", command_line=arguments, on_message=said.append, allow=ADJUSTABLE
        )
        assert is_same_robot(expected.encode(), made.xml().encode()), arguments
    return said


def test_macros_become_functions_and_properties_variables(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <!-- The wheels -->
        <xacro:arg name="prefix" default="my_"/>
        <xacro:property name="radius" value="0.1"/>
        <xacro:property name="width" value="${radius / 2}"/>
        <xacro:macro name="wheel_unit" params="side y:=0.5 *origin">
          <!-- in the middle -->
          <link name="$(arg prefix)${side}_wheel">
            <visual>
              <xacro:insert_block name="origin"/>
              <geometry><cylinder radius="${radius}" length="${width}"/></geometry>
            </visual>
          </link>
          <xacro:if value="${y > 0.4}"><far/></xacro:if>
          <xacro:unless value="${y > 0.4}"><near at="${y}"/></xacro:unless>
        </xacro:macro>
        <xacro:wheel_unit side="left"><origin xyz="0 0 1"/></xacro:wheel_unit>
        <xacro:wheel_unit side="right" y="0.1"><origin xyz="0 0 2"/></xacro:wheel_unit>
        """,
    )
    assert made["r.yaml"] == textwrap.dedent("""\
        robot: r
        arguments:
          prefix: {default: my_, help: The wheels}
        variables:
          radius: 0.1
          width: $(radius / 2)
        functions:
          WheelUnit(side, y=0.5, **Origin):
            # in the middle
            part:
              link/name=$(prefix)$(side)_wheel:
                visual:
                  geometry: cylinder
                  scale: $(radius) $(width)
                  Origin:
            if y > 0.4:
              far:
            else:
              near/at=$(y):
        model:
        - WheelUnit: {side: left, Origin: {xyz: 0 0 1}}
        - WheelUnit: {side: right, y: 0.1, Origin: {xyz: 0 0 2}}
        """)


def test_a_joint_and_its_link_become_a_part(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="l" value="0.3"/>
        <link name="base_link"/>
        <joint name="arm_joint" type="fixed">
          <parent link="base_link"/><child link="arm_link"/><origin xyz="0 0 ${l}" rpy="0 0 0"/>
        </joint>
        <link name="arm_link">
          <visual><geometry><box size="${l} 0.1 0.1"/></geometry></visual>
        </link>
        """,
    )
    assert made["r.yaml"].splitlines()[4:] == [
        "  link/name=base_link:",
        "  part:",
        "    name: arm",
        "    joint: {type: fixed, parent: base_link, xyz: 0 0 $(l)}",
        "    link:",
        "      visual: {geometry: box, scale: $(l) 0.1 0.1}",
    ]


def test_each_file_is_migrated_and_what_is_shared_is_global(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:include filename="lib.xacro"/>
        <xacro:box name="a" size="${side}"/>
        """,
        lib="""\
        <xacro:property name="side" value="2"/>
        <xacro:property name="own" value="3"/>
        <xacro:macro name="box" params="name size">
          <b name="${name}" s="${size * own}"/>
        </xacro:macro>
        """,
    )
    assert made["lib.yaml"] == textwrap.dedent("""\
        variables:
          side/global: 2
          own: 3
        functions:
          Box(name, size)/global:
            b/name=$(name), s=$(size * own):
        """)
    assert "  include: lib.yaml\n" in made["r.yaml"]


def test_an_argument_whose_default_needs_a_property_gets_it_where_that_is_known(
    tmp_path: Path,
) -> None:
    migrated(
        tmp_path,
        """\
        <xacro:property name="base" value="b"/>
        <xacro:arg name="top" default="${base}_top"/>
        <xacro:macro name="use" params="side">
          <xacro:property name="name" value="${side}_arm"/>
          <xacro:arg name="path" default="${name}/x"/>
          <use path="$(arg path)" top="$(arg top)"/>
        </xacro:macro>
        <xacro:use side="l"/>
        <xacro:use side="r"/>
        """,
    )
    hold_for(tmp_path, [], ["path:=given"], ["top:=t"])


@pytest.mark.parametrize(
    "text",
    [
        """<xacro:arg name="kind" default="x"/>
        <xacro:if value="${'$(arg kind)' == 'x'}"><xacro:arg name="size" default="1"/></xacro:if>
        <xacro:arg name="size" default="2"/><a size="$(arg size)"/>""",
        """<xacro:arg name="kind" default="x"/>
        <xacro:if value="${'$(arg kind)' == 'x'}"><xacro:include filename="lib.xacro"/></xacro:if>
        <xacro:arg name="size" default="2"/><a size="$(arg size)"/>""",
        """<xacro:arg name="kind" default="x"/>
        <xacro:macro name="first" params="is_first"><xacro:if value="${is_first}">
        <xacro:arg name="size" default="5"/></xacro:if></xacro:macro>
        <xacro:first is_first="${'$(arg kind)' == 'y'}"/>
        <xacro:arg name="size" default="2"/><a size="$(arg size)"/>""",
    ],
)
def test_of_several_defaults_that_counts_which_is_reached_first(tmp_path: Path, text: str) -> None:
    migrated(tmp_path, text, lib='<xacro:arg name="size" default="3"/>')
    hold_for(tmp_path, [], ["kind:=y"], ["size:=7"], ["kind:=y", "size:=7"])


def test_a_default_that_reads_a_parameter_means_that_of_the_caller(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="prefix" value="top_"/>
        <xacro:macro name="arm" params="prefix tf:=${prefix}"><a p="${prefix}" t="${tf}"/>
        </xacro:macro>
        <xacro:arm prefix="l_"/><xacro:arm prefix="r_" tf="x_"/>
        """,
    )
    assert "  Arm(prefix, tf):\n" in made["r.yaml"]
    assert "- Arm: {prefix: l_, tf: $(prefix)}\n" in made["r.yaml"]


def test_an_include_whose_name_depends_on_an_argument_still_does(tmp_path: Path) -> None:
    library = {
        f"parts/{name}.urdf": f'<xacro:macro name="arm" params=""><{name}/></xacro:macro>'
        for name in ("long", "short")
    }
    (tmp_path / "parts").mkdir()
    text = """\
        <xacro:arg name="kind" default="long"/>
        <xacro:include filename="parts/$(arg kind).urdf.xacro"/>
        <xacro:arm/>
        """
    made = migrated(tmp_path, text, **library)
    assert "  include: parts/$(kind).yaml\n" in made["r.yaml"]
    assert sorted(made) == ["parts/long.yaml", "parts/short.yaml", "r.yaml"]
    hold_for(tmp_path, [], ["kind:=short"])


def test_prefixes_that_an_included_file_declares_are_declared(tmp_path: Path) -> None:
    (tmp_path / "other.xml").write_text('<robot xmlns:b="http://b.org"><b:x/></robot>')
    made = migrated(tmp_path, '<xacro:include filename="other.xml"/>')
    assert made["r.yaml"].startswith("robot/name=r, xmlns:b=http://b.org:\n")


def test_numbers_with_units_that_are_expressions_become_numbers(tmp_path: Path) -> None:
    (tmp_path / "limits.yaml").write_text(
        "a: !radians pi / 2  # a quarter\nb: [!degrees 2*45, !degrees 90]\nc: !meters 1.5\n"
    )
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="limits" value="${xacro.load_yaml('limits.yaml')}"/>
        <a a="${limits.a}" b="${limits.b[0]} ${limits.b[1]}" c="${limits.c}"/>
        """,
    )
    assert made["limits.yaml"] == (
        "a: !radians 1.5707963267948966  # a quarter\nb: [!degrees 90.0, !degrees 90]\n"
        "c: !meters 1.5\n"
    )


def test_truth_values_are_shown_as_xacro_does_where_these_arguments_do_not_lead(
    tmp_path: Path,
) -> None:
    migrated(
        tmp_path,
        """\
        <xacro:arg name="sim" default="false"/>
        <xacro:arg name="fake" default="true"/>
        <xacro:property name="n" value="2"/>
        <xacro:macro name="control" params="sim fake:=^|false n">
          <xacro:property name="both" value="${sim and fake}"/>
          <xacro:if value="${sim}">
            <c sim="${sim}" not="${not sim}" fake="${fake}" both="${both}" n="${n}" is="${n > 1}"/>
          </xacro:if>
        </xacro:macro>
        <xacro:control sim="$(arg sim)" fake="$(arg fake)" n="${n}"/>
        <xacro:control sim="$(arg sim)" n="3"/>
        """,
    )
    assert "n=$(n)" in (tmp_path / "out/r.yaml").read_text()
    hold_for(tmp_path, [], ["sim:=true"], ["sim:=true", "fake:=false"])


def test_an_argument_may_be_a_list_of_python(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:arg name="names" default="['a','b']"/>
        <xacro:arg name="shown" default="[1,2]"/>
        <xacro:property name="all" value="${$(arg names)}"/>
        <a first="${all[0]}" n="${len($(arg names))}" s="$(arg shown)"/>
        """,
    )
    assert "  names: $(['a','b'])\n" in made["r.yaml"]
    assert "  shown: '[1,2]'\n" in made["r.yaml"]
    hold_for(tmp_path, [], ["names:=['c']"])


def test_a_file_with_a_namespace_is_included_with_one(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="width" value="9"/>
        <xacro:include filename="gripper.xacro" ns="left"/>
        <xacro:include filename="gripper.xacro" ns="right"/>
        <xacro:include filename="lib.xacro" ns="tools"/>
        <xacro:left.finger name="thumb"><o/></xacro:left.finger>
        <xacro:right.finger name="thumb"><o/></xacro:right.finger>
        <xacro:tools.finger side="l"/>
        <xacro:if value="${width > left.width}"><w by="${2 * left.width + tools.width}"/></xacro:if>
        """,
        gripper="""\
        <xacro:include filename="inner.xacro"/>
        <xacro:property name="width" value="2"/>
        <xacro:macro name="finger" params="name *origin">
          <f name="${name}" w="${width * factor}"><xacro:insert_block name="origin"/></f>
          <xacro:tip name="${name}"/>
        </xacro:macro>
        """,
        inner="""\
        <xacro:property name="factor" value="3"/>
        <xacro:macro name="tip" params="name"><tip name="${name}"/></xacro:macro>
        """,
        lib="""\
        <xacro:property name="width" value="5"/>
        <xacro:macro name="finger" params="side"><f side="${side}" w="${width}"/></xacro:macro>
        """,
    )
    assert made["r.yaml"] == textwrap.dedent("""\
        robot: r
        variables:
          width/global: 9
        model:
        - include: {path: gripper.yaml, namespace: left}
        - include: {path: gripper.yaml, namespace: right}
        - include: {path: lib.yaml, namespace: tools}
        - left.Finger:
            name: thumb
            Origin:
              o:
        - right.Finger:
            name: thumb
            Origin:
              o:
        - tools.Finger: {side: l}
        - if width > left.width:
            w/by=$(2 * left.width + tools.width):
        """)
    assert "  width/parent: 2\n" in made["gripper.yaml"]
    assert "  Finger(name, **Origin)/parent:\n" in made["gripper.yaml"]


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ('<xacro:include filename="a.xacro" ns="${1}"/>', "the namespace '${1}' is computed"),
        (
            '<xacro:include filename="a.xacro" ns="A"/><xacro:include filename="a.xacro"/>',
            "the file is included without a namespace as well",
        ),
        (
            '<xacro:include filename="b.xacro"/><xacro:A.m/>',
            "the namespace 'A' is made in another file",
        ),
        (
            '<xacro:include filename="b.xacro" ns="B"/>',
            "the property 'p' is handed out of a namespace",
        ),
    ],
)
def test_what_namespaces_cannot_do_is_told(tmp_path: Path, text: str, why: str) -> None:
    a = '<xacro:macro name="m" params=""><a/></xacro:macro>'
    b = '<xacro:include filename="a.xacro" ns="A"/>'
    if "handed" in why:
        b = '<xacro:property name="p" value="1" scope="parent"/>'
    (tmp_path / "r.xacro").write_text(f'{HEAD}<xacro:property name="q" value="1"/>{text}</robot>')
    (tmp_path / "a.xacro").write_text(f"{HEAD}{a}</robot>")
    (tmp_path / "b.xacro").write_text(f"{HEAD}{b}</robot>")
    path = tmp_path / "r.xacro"
    source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
    migration = migrate_robot(
        source, str(tmp_path / "out"), arguments=[], packages={}, limits=Limits()
    )
    assert any(told.startswith(why) for _span, told, _hint in migration.lost)


@pytest.mark.parametrize(
    "text",
    [
        # what a macro reads of its caller
        """<xacro:macro name="inner" params=""><i v="${depth}"/></xacro:macro>
        <xacro:macro name="outer" params="depth"><xacro:inner/></xacro:macro>
        <xacro:outer depth="4"/>""",
        # forwarded parameters
        """<xacro:property name="n" value="7"/>
        <xacro:macro name="m" params="n:=^ k:=^|5"><i n="${n}" k="${k}"/></xacro:macro>
        <xacro:macro name="o" params="k"><xacro:m n="1"/></xacro:macro>
        <xacro:m/><xacro:o k="9"/>""",
        # a property handed to the caller
        """<xacro:macro name="read" params=""><xacro:property name="v" value="8" scope="parent"/>
        </xacro:macro>
        <xacro:macro name="use" params=""><xacro:read/><i v="${v}"/></xacro:macro><xacro:use/>""",
        # recursion in place of a loop
        """<xacro:macro name="loop" params="i"><xacro:if value="${i}"><c i="${i}"/>
        <xacro:loop i="${i - 1}"/></xacro:if></xacro:macro><xacro:loop i="3"/>""",
        # truth values in texts, numbers that are texts, quotes
        """<xacro:property name="f" value="true"/><a f="${f}" n="${not f}">${f}</a>
        <xacro:property name="row" value="1 2 3"/>
        <xacro:property name="x" value="${row.split()[1]}"/><b x="${x * 2}"/>
        <xacro:property name="q" value="'1.0'"/><c q="${q}"/>""",
        # blocks of content, computed tags and attributes, names with a dash
        """<xacro:macro name="my-wrap" params="**inside"><w><xacro:insert_block name="inside"/></w>
        </xacro:macro><xacro:my-wrap><any><x/><y v="1,2"/></any></xacro:my-wrap>
        <xacro:element xacro:name="e_${1 + 1}" k="v"><xacro:attribute name="z" value="3"/>
        </xacro:element>""",
        # a property that is never looked at
        '<xacro:property name="lazy" value="${nothing_has_this_name}"/><a/>',
        # what is said to the user, an attribute of a computed name, dicts with dots
        """<xacro:property name="cfg" value="${xacro.dotify(dict(a=1, b=2))}"/>
        <xacro:property name="k" value="key"/><xacro:property name="said"
        value="${xacro.message('from a', 'value') or 7}"/>
        ${xacro.message('a', 2, k)}<a v="${cfg.a + cfg.b}" s="${said}"/>
        <b><xacro:attribute name="${k}_x" value="${k}"/></b>""",
        # a macro that is defined anew
        """<xacro:macro name="m" params="n"><a n="${n}"/></xacro:macro><xacro:m n="1"/>
        <xacro:macro name="m" params="*b"><b><xacro:insert_block name="b"/></b></xacro:macro>
        <xacro:m><i/></xacro:m><xacro:m><j/></xacro:m>""",
        # a block as a property
        """<xacro:property name="grey"><color rgba="1 1 1 1"/></xacro:property>
        <m><xacro:insert_block name="grey"/></m>""",
    ],
)
def test_the_same_robot_comes_out(tmp_path: Path, text: str) -> None:
    assert "r.yaml" in migrated(tmp_path, text)


def test_what_cannot_be_carried_over_is_told_at_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("r.xacro").write_text(
        f'{HEAD}\n  <xacro:property name="n" value="1"/>\n'
        '  <xacro:property name="n" remove="true"/>\n  <a/>\n</robot>\n'
    )
    assert main(["migrate", "r.xacro", "-o", "out"]) == 0
    told = capsys.readouterr().err
    code = "not-migrated"
    assert told.startswith(f"warning[{code}]: the property 'n' is removed\n --> r.xacro:3:4\n  |\n")
    assert told.endswith("r.xacro: identical: 0 links, 0 joints; 1 file, out/r.yaml\n")
    assert "# not migrated: <xacro:property>" in Path("out/r.yaml").read_text()


def test_a_difference_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("r.xacro").write_text(
        f'{HEAD}\n<xacro:macro name="m" params=""><a/></xacro:macro>\n'
        '<xacro:macro name="use" params=""><xacro:m/></xacro:macro><xacro:use/>\n'
        '<xacro:macro name="m" params=""><b/></xacro:macro><xacro:use/></robot>\n'
    )
    assert main(["migrate", "r.xacro", "-o", "out"]) == 1
    told = capsys.readouterr().err
    assert "different: robot 'r', a: is missing" in told
    assert "this definition of 'm' is left out: there is another one below" in told


def test_what_is_in_the_folder_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("r.xacro").write_text(f'{HEAD}<xacro:arg name="n" default="1"/><a n="$(arg n)"/></robot>')
    assert main(["migrate", "r.xacro", "-o", "out/", "n:=5"]) == 0
    capsys.readouterr()
    Path("out/r.yaml").write_text("mine")
    assert main(["migrate", "r.xacro", "-o", "out"]) == 2
    assert "'out/r.yaml' already exists; --force replaces it" in capsys.readouterr().err
    assert Path("out/r.yaml").read_text() == "mine"
    assert main(["migrate", "r.xacro", "-o", "out", "--force", "-q"]) == 0
    assert capsys.readouterr().err == ""
    assert build("out/r.yaml", allow=ADJUSTABLE).xml().count('<a n="1"/>') == 1


@pytest.mark.parametrize(
    ("xacro", "python"),
    [
        ("radius * 2", "radius * 2"),
        ("math.pi / 2", "pi / 2"),
        ("math.fmod(a, 2)", "math.fmod(a, 2)"),
        ("cfg.arm.length", "cfg['arm']['length']"),
        ("cfg['arm'].length + other.x", "cfg['arm']['length'] + other['x']"),
        ("name.split('_')[0]", "name.split('_')[0]"),
        ("xacro.load_yaml(file).links", "load_yaml(file)['links']"),
        ("xacro.load_yaml('$(find arm)/a.yaml')", "load_yaml(find('arm') + '/a.yaml')"),
        ("xacro.arg('side')", "side"),
        ("'$(arg side)' == 'left'", "str(side) == 'left'"),
        ("'$(arg is_sim)' == 'true'", "str(is_sim).lower() == 'true'"),
        ("$(arg n) + 1", "n + 1"),
        ("python.len(a)", "len(a)"),
        ("xacro.dotify(a).b", "(a)['b']"),
        ("xacro.message('a', 1)", "(print('a', 1) or '')"),
        ("[x.y for x in rows]", "[x['y'] for x in rows]"),
    ],
)
def test_an_expression_is_translated(xacro: str, python: str) -> None:
    assert translator().expression(xacro) == python


@pytest.mark.parametrize("text", ["1 +", "xacro.tokenize(a)", "$(anon x)", "$(arg ${a})"])
def test_an_expression_without_counterpart_is_refused(text: str) -> None:
    with pytest.raises(CannotMigrate):
        translator().expression(text)


@pytest.mark.parametrize(
    ("text", "spelled"),
    [
        ("0.10", "0.10"),
        ("007", "007"),
        ("true", "true"),
        ("False", "False"),
        ("a b", "a b"),
        ("'5'", "5"),
        ("1e400", "1e400"),
        ("", ""),
        ("${x", None),
    ],
)
def test_a_value_keeps_its_type(text: str, spelled: str | None) -> None:
    if spelled is not None:
        assert typed(text) == spelled


@pytest.mark.skipif(not CORPUS.exists(), reason="there is no corpus")
@pytest.mark.slow
def test_robots_of_others_stay_the_same(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ROS_VERSION", "2")
    monkeypatch.setenv("ROS_DISTRO", "humble")
    count = same = 0
    for row in tried(rows(), lambda row: row["path"], quick=40, usual=16):
        pairs = [item.split("=", 1) for item in row["packages"].split(";") if item]
        packages = {name: f"{CORPUS}/src/{at}" if at else f"{UNKNOWN}/{name}" for name, at in pairs}
        path = CORPUS / "src" / row["path"]
        monkeypatch.chdir(path.parent)
        arguments = [part for part in real(row["args"]).split(" ") if ":=" in part]
        source = decode_xml(path.read_bytes(), name=path.name, path=str(path))
        folder = str(tmp_path / str(count))
        migration = migrate_robot(
            source, folder, arguments=arguments, packages=packages, limits=Limits()
        )
        count += 1
        if migration.faults or migration.differences:
            continue
        for name, text in migration.files.items():
            made = Path(folder, name)
            os.makedirs(made.parent, exist_ok=True)
            made.write_text(text)
        xml = build(
            Path(folder, migration.main),
            command_line=arguments,
            packages=packages,
            on_message=lambda line: None,
            allow=migration.allowed,
        ).xml()
        expected = real((CORPUS / row["expected"]).read_text("utf-8"))
        assert is_same_robot(expected.encode(), xml.encode()), row["path"]  # none silently
        same += 1
    assert same >= 0.97 * count


def test_without_the_package_xacro_it_is_compared_with_our_own_expansion(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "xacro", None)
    Path("r.xacro").write_text(f'{HEAD}<xacro:arg name="n" default="1"/><a n="$(arg n)"/></robot>')
    assert main(["migrate", "r.xacro", "-o", "out"]) == 0
    assert capsys.readouterr().err == (
        "r.xacro: identical: 0 links, 0 joints; 1 file, out/r.yaml\n"
        "compared with Yamaro's own expansion; with yamaro[xacro], with xacro's\n"
    )


def test_a_text_in_a_condition_of_xacro_stays_a_condition(tmp_path: Path) -> None:
    text = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">
      <xacro:property name="loud" value="ue"/>
      <xacro:macro name="tool" params="on:=''">
        <xacro:unless value="${not on}"><joint name="to_${on}"/></xacro:unless>
        <xacro:if value="${'tr' + loud}"><link name="after_${on}"/></xacro:if>
      </xacro:macro>
      <xacro:tool/>
      <xacro:tool on="flange"/>
    </robot>"""
    source = decode_xml(text.encode(), name="r.xacro", path=str(tmp_path / "r.xacro"))
    migration = migrate_robot(
        source, str(tmp_path / "out"), arguments=[], packages={}, limits=Limits()
    )
    assert not migration.faults
    assert not migration.differences
    assert "if bool(on):" in migration.files[migration.main]
