"""Comments stay where they say something: above what follows them, or at the end of its line."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest

from tests.tools.migrate.migrating import migrated as migrated_urdf
from tests.tools.migrate.migrating import model_of
from tests.tools.migrate.test_xacro_migration import migrated
from yamaro.api import build


def test_a_unit_behind_a_property_stays_in_its_line(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="mass" value="1.5" /> <!-- [kg] -->
        <xacro:property name="width" value="0.47" /> <!-- [m] -->
        <xacro:property name="speed" value="20" /> <!-- [rad/s] -->
        <link name="base"/> <!-- the foot -->
        <link name="arm"/>
        <a m="${mass}" w="${width}" s="${speed}"/>
        """,
    )
    assert "  mass: 1.5  # [kg]\n  width: 0.47  # [m]\n  speed: 20  # [rad/s]\n" in made["r.yaml"]
    assert "  link/name=base:  # the foot\n  link/name=arm:\n" in made["r.yaml"]


def test_units_stay_with_their_variables_when_these_change_places(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:property name="area" value="${side ** 2}"/> <!-- m² -->
        <xacro:property name="side" value="2"/> <!-- m -->
        <a l="${area}"/>
        """,
    )
    assert "  side: 2  # m\n  area: $(side ** 2)  # m²\n" in made["r.yaml"]


def test_units_of_arguments_go_with_them_to_the_main_file(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <xacro:include filename="lib.xacro"/> <!-- the library -->
        <a l="$(arg length)" c="$(arg colour)"/>
        """,
        lib="""\
        <xacro:arg name="length" default="2"/> <!-- in metres -->
        <xacro:arg name="colour" default="red"/> <!-- its paint -->
        <b/>
        """,
    )
    assert (
        "  length: {default: 2, help: in metres}\n  colour: {default: red, help: its paint}\n"
    ) in made["r.yaml"]
    assert "include: lib.yaml  # the library\n" in made["r.yaml"]
    assert "metres" not in made["lib.yaml"]


def test_comments_behind_what_a_part_says_in_other_words_stay_at_its_keys() -> None:
    assert model_of("""\
        <link name="base"/>
        <joint name="a_joint" type="revolute"> <!-- the hinge -->
          <parent link="base"/> <!-- on the base -->
          <child link="a_link"/>
          <origin xyz="0 0 1" rpy="0 0 0"/> <!-- up there -->
          <axis xyz="0 0 1"/> <!-- upwards -->
          <limit lower="-1" upper="1"
                 effort="1" velocity="1"/> <!-- rad -->
        </joint>
        <link name="a_link"> <!-- the bone -->
          <inertial>
            <mass value="2"/> <!-- kg -->
            <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/> <!-- from CAD -->
          </inertial>
          <visual>
            <geometry><box size="1 1 1"/></geometry> <!-- metres -->
          </visual> <!-- what is seen -->
        </link>
        """) == textwrap.dedent("""\
        link/name=base:
        part:
          name: a
          joint:  # the hinge
            type: revolute
            parent: base  # on the base
            xyz: 0 0 1  # up there
            axis: 0 0 1  # upwards
            limit: {lower: -1, upper: 1, effort: 1, velocity: 1}  # rad
          link:  # the bone
            inertial:
              mass: 2  # kg
              inertia: 1 0 0 1 0 1  # from CAD
            visual:  # what is seen
              geometry: box
              scale: 1 1 1  # metres
        """)


@pytest.mark.parametrize(
    ("inside", "yaml"),
    [
        ('<a n="1"/> <!-- x --> <!-- y -->', "a/n=1:  # x y\n"),
        ('<a n="1"/><!-- x -->\n<!-- above b -->\n<b/>', "a/n=1:  # x\n# above b\nb:\n"),
        ('<a n="1"/> <!-- above b --> <b/>', "a/n=1:\n# above b\nb:\n"),
        ("<a>1</a> <!-- x -->", "a: 1  # x\n"),
        ("<a>1 <!-- x --></a>", "a: 1  # x\n"),
        ("<a> <!-- x -->\n1</a>", "a: 1  # x\n"),
        ("<a>\n<!-- x -->\n1</a>", "# x\na: 1\n"),
        ("<a><b/> <!-- x -->\n</a>", "a:\n  b:  # x\n"),
        ("<a> <!-- x -->\n<b/></a>", "a: {b: }  # x\n"),
        ("<a>\n<b/>\n</a> <!-- x -->", "a: {b: }  # x\n"),
        ("<a> <!-- only -->\n</a>", "a:  # only\n"),
        ("<a/> <!-- one\ntwo --><b/>", "a:\n# one\n# two\nb:\n"),
        ("<a/> <!-- one\ntwo -->\n<b/>", "# one\n# two\na:\nb:\n"),
        ("<a/>\n<!-- last -->", "a:\n# last\n"),
        (f"<a/> <!-- {'long ' * 19}-->\n<b/>", f"# {('long ' * 19).strip()}\na:\nb:\n"),
        ("<a/> <!-- #ff0000 -->\n<b/>", "a:  # #ff0000\nb:\n"),
    ],
)
def test_a_comment_is_where_it_was(inside: str, yaml: str) -> None:
    text = migrated_urdf(f'<robot name="r">\n{inside}\n</robot>\n')
    assert text == f"robot: r\nmodel:\n{textwrap.indent(yaml, '  ')}"


def test_comments_around_the_closing_tag_stay_at_the_end(tmp_path: Path) -> None:
    text = (
        '<robot name="r"> <!-- first -->\n<a/>\n<!-- last -->\n</robot> <!-- end -->\n<!-- off -->'
    )
    whole = "robot: r  # first\nmodel:\n  a:\n  # last\n# end\n# off\n"
    assert migrated_urdf(text) == whole
    (tmp_path / "after.xacro").write_text("<robot><b/></robot>\n<!-- after -->\n")
    made = migrated(tmp_path, '<xacro:include filename="after.xacro"/>')
    assert made["after.yaml"] == "model:\n  b:\n# after\n"


def test_comments_in_macros_and_their_calls_stay(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <link name="base"/>
        <xacro:macro name="leg" params="side *origin **more"> <!-- a leg -->
          <a side="${side}"> <!-- open -->
            <xacro:insert_block name="origin"/> <!-- where -->
            <xacro:insert_block name="more"/>
          </a>
        </xacro:macro>
        <xacro:leg side="left"> <!-- the first -->
          <!-- its place -->
          <at x="1"/> <!-- metres -->
          <more>
            <b/> <!-- beta -->
          </more>
          <!-- that is all -->
        </xacro:leg>
        <xacro:if value="${1 > 0}"> <!-- as it should be -->
          <c/>
        </xacro:if>
        """,
    )
    assert made["r.yaml"] == textwrap.dedent("""\
        robot: r
        functions:
          Leg(side, **Origin, **More):  # a leg
            a/side=$(side):  # open
              Origin:  # where
              More:
        model:
          link/name=base:
          Leg:  # the first
            side: left
            # its place
            Origin:  # metres
              at/x=1:
            More:
              b:  # beta
            # that is all
          if 1 > 0:  # as it should be
            c:
        """)


def test_links_and_joints_that_move_take_their_comments_along(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <link name="base"/> <!-- the base -->
        <link name="a_link"/> <!-- the arm -->
        <link name="b_link"/> <!-- the hand -->
        <!-- the shoulder -->
        <joint name="a_joint" type="fixed"> <!-- is stiff -->
          <parent link="base"/><child link="a_link"/>
        </joint>
        <joint name="b_joint" type="fixed">
          <parent link="a_link"/><child link="b_link"/>
        </joint> <!-- the wrist -->
        """,
    )
    assert made["r.yaml"].partition("model:\n")[2] == textwrap.dedent("""\
        - link/name=base:  # the base
        # the shoulder
        - part:  # the arm
            name: a
            joint: {type: fixed, parent: base}  # is stiff
        - part: {name: b, joint: {type: fixed, parent: a_link}}  # the hand the wrist
        """)


def test_what_accepts_findings_stays_in_its_line_however_long_that_gets(tmp_path: Path) -> None:
    made = migrated(
        tmp_path,
        """\
        <link name="base"/>
        <joint name="elbow" type="revolute">
          <parent link="base"/>
          <child link="arm"/>
          <axis xyz="0 0 1"/>
          <limit lower="0.1" upper="1" effort="0" velocity="1"/> <!-- no motor --> \
<!-- yamaro: allow zero-limit, zero-outside-limits (it is not built in yet) -->
        </joint>
        <link name="arm"> <!-- yamaro: allow massless-moving -->
        </link>
        """,
    )
    accepts = "# yamaro: allow zero-limit, zero-outside-limits (it is not built in yet)\n"
    assert f"effort: 0, velocity: 1}}  # no motor {accepts}" in made["r.yaml"]
    assert "part:  # yamaro: allow massless-moving\n" in made["r.yaml"]
    assert build("r.yaml", text=made["r.yaml"], advice=True).warnings == []


def test_a_comment_in_a_link_that_holds_nothing_else_stays() -> None:
    text = migrated_urdf(
        """\
        <robot name="r">
          <link name="base"/>
          <joint name="fix" type="fixed"><parent link="base"/><child link="tool"/></joint>
          <link name="tool">  <!-- where the gripper is -->
          </link>
        </robot>
        """
    )
    assert "  # where the gripper is\n" in text
