"""Joints and links of xacro become parts, with the conditions, calls and blocks in them."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest

from tests.tools.migrate.against_xacro import migrated_for, model_of

N = '<xacro:arg name="n" default="1"/>'
BASE = '<link name="base"/>'
ENDS = '<parent link="base"/><child link="a_link"/>'
LIMIT = '<limit lower="-1" upper="1" effort="2" velocity="3"/>'
MANY = '<xacro:if value="${$(arg n) > 1}">'
FEW = '<xacro:unless value="${$(arg n) > 1}">'
BOX = '<geometry><box size="1 1 1"/></geometry>'
MASS = '<mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'


def part(folder: Path, text: str) -> str:
    """Return the last part of a robot, which is the one of xacro for several arguments."""
    made = migrated_for(folder, N + text, "1", "2", "3")
    lines = model_of(made)
    start = max(index for index, line in enumerate(lines) if line.endswith("part:"))
    return textwrap.dedent("\n".join(lines[start + 1 :])) + "\n"


def test_the_origin_of_a_joint_may_be_a_block(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <xacro:macro name="arm" params="name *origin">
          <joint name="${name}_joint" type="fixed">
            <xacro:insert_block name="origin"/>
            <parent link="base"/>
            <child link="${name}_link"/>
          </joint>
          <link name="${name}_link"/>
        </xacro:macro>
        <link name="base"/>
        <xacro:arm name="a"><origin xyz="0 0 1" rpy="0 0 0"/></xacro:arm>
        <xacro:arm name="b"><origin xyz="0 0 2"/></xacro:arm>
        """,
    )
    assert made == textwrap.dedent("""\
        robot: r
        functions:
          Arm(name, **Origin):
            part:
              name: $(name)
              joint:
                type: fixed
                parent: base
                Origin:
        model:
        - link/name=base:
        - Arm: {name: a, Origin: {xyz: 0 0 1}}
        - Arm: {name: b, Origin: {xyz: 0 0 2}}
        """)


def test_a_block_may_give_an_origin_or_none(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""\
        {N}
        <xacro:macro name="arm" params="name **at">
          <link name="${{name}}_link"/>
          <joint name="${{name}}_joint" type="fixed">
            <parent link="base"/><child link="${{name}}_link"/><xacro:insert_block name="at"/>
          </joint>
        </xacro:macro>
        {BASE}
        <xacro:arm name="a"><at><origin xyz="0 0 1" rpy="0 0 0"/></at></xacro:arm>
        <xacro:arm name="b"><at>{MANY}<origin xyz="0 0 2"/></xacro:if></at></xacro:arm>
        """,
        "1",
        "2",
    )
    assert "        parent: base\n        At:\n" in made


def test_keys_stand_in_conditions_of_which_one_holds(tmp_path: Path) -> None:
    joint = f"""{BASE}<joint name="a_joint" type="revolute">{ENDS}
        {MANY}<origin xyz="0 0 $(arg n)" rpy="0 0 0"/>{LIMIT}</xacro:if>
        {FEW}<origin xyz="0 1 0" rpy="0 0 1"/><limit effort="2" velocity="3"/></xacro:unless>
        </joint><link name="a_link"/>"""
    assert part(tmp_path, joint) == textwrap.dedent("""\
        name: a
        joint:
          type: revolute
          parent: base
          if n > 1:
            xyz: 0 0 $(n)
            limit: {lower: -1, upper: 1, effort: 2, velocity: 3}
          else:
            xyz: 0 1 0
            rpy: 0 0 1
            <limit/effort=2, velocity=3>:
        """)


def test_an_origin_in_a_condition_is_a_pose_there(tmp_path: Path) -> None:
    joint = f"""{BASE}<joint name="a_joint" type="fixed">{ENDS}
        {MANY}<origin xyz="0 0 $(arg n)" rpy="0 0 0"/></xacro:if></joint><link name="a_link"/>"""
    assert part(tmp_path, joint).splitlines()[4:] == ["  if n > 1: {xyz: 0 0 $(n)}"]


def test_statements_stand_among_the_sections_of_a_link(tmp_path: Path) -> None:
    link = f"""\
        <xacro:macro name="red" params=""><material name="red"><color rgba="1 0 0 1"/></material>
        </xacro:macro>
        <xacro:macro name="shell" params="size">
          <collision><geometry><box size="${{size}}"/></geometry></collision>
        </xacro:macro>
        <link name="a_link">
          <visual><origin xyz="0 0 1" rpy="0 0 0"/>{BOX}<xacro:red/></visual>
          {MANY}<visual>{BOX}</visual><inertial>{MASS}</inertial></xacro:if>
          <xacro:shell size="1 2 3"/>
          <visual>{MANY}<origin xyz="0 0 1"/></xacro:if>{BOX}</visual>
        </link>"""
    assert part(tmp_path, link) == textwrap.dedent("""\
        name: a
        link:
        - geometry: box
          scale: 1 1 1
          visual:
            xyz: 0 0 1
            Red:
          if n > 1:
            visual:
            inertial: {mass: 2, inertia: 1 0 0 1 0 1}
          Shell: {size: 1 2 3}
        - visual:
            if n > 1: {xyz: 0 0 1}
        """)
    assert "collision: {geometry: box, scale: $(size)}" in (tmp_path / "out/r.yaml").read_text()


def test_a_geometry_that_a_call_makes_is_an_element(tmp_path: Path) -> None:
    link = """\
        <xacro:macro name="mesh" params="file"><mesh filename="${file}.stl"/></xacro:macro>
        <xacro:macro name="ball" params=""><geometry><sphere radius="1"/></geometry></xacro:macro>
        <link name="a_link">
          <visual><geometry><xacro:mesh file="a"/></geometry></visual>
          <collision><xacro:ball/></collision>
        </link>"""
    assert part(tmp_path, link) == textwrap.dedent("""\
        name: a
        link:
          visual:
            <geometry>:
              Mesh: {file: a}
          <collision>:
            Ball:
        """)


@pytest.mark.parametrize(
    ("inertial", "made"),
    [
        (MASS, "inertial: {mass: 2, inertia: 1 0 0 1 0 1}\n"),
        (
            f'<origin xyz="0 0 1"/>{MASS}',
            "inertial: {mass: 2, xyz: 0 0 1, inertia: 1 0 0 1 0 1}\n",
        ),
        (MASS.replace(' value="2"', ""), "<inertial>:\n"),
        (f'<origin xyz="0 0 1"/>{MASS}<more/>', "inertial:\n      mass: 2\n"),
    ],
)
def test_an_inertial_that_a_call_makes_is_not_moved_with_its_link(
    tmp_path: Path, inertial: str, made: str
) -> None:
    pose = '<origin xyz="1 2 3" rpy="0 0 0"/>'
    link = f"""\
        <xacro:macro name="heavy" params=""><inertial>{inertial}</inertial></xacro:macro>
        <link name="a_link">
          <visual>{pose}{BOX}</visual><collision>{pose}{BOX}</collision><xacro:heavy/>
        </link>"""
    assert part(tmp_path, link).splitlines()[2:] == [
        "  geometry: box",
        "  scale: 1 1 1",
        "  visual: {xyz: 1 2 3}",
        "  collision: {xyz: 1 2 3}",
        "  Heavy:",
    ]
    assert f"\n    {made}" in (tmp_path / "out/r.yaml").read_text()


def test_a_joint_moves_to_its_link_past_other_elements(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """\
        <link name="base"/><link name="a_link"/>
        <!-- rubber -->
        <gazebo reference="a_link"/>
        <joint name="a_joint" type="fixed"><parent link="base"/><child link="a_link"/></joint>
        <link name="b_link"/><link name="c_link"/>
        <joint name="b_joint" type="fixed"><parent link="a_link"/><child link="b_link"/></joint>
        <joint name="c_joint" type="fixed"><parent link="a_link"/><child link="c_link"/></joint>
        """,
    )
    assert model_of(made) == [
        "- link/name=base:",
        "- part: {name: a, joint: {type: fixed, parent: base}}",
        "# rubber",
        "- gazebo/reference=a_link:",
        "- part: {name: b, joint: {type: fixed, parent: a_link}}",
        "- part: {name: c, joint: {type: fixed, parent: a_link}}",
    ]


@pytest.mark.parametrize(
    "robot",
    [
        # what an expression reads is set in between
        f"""<link name="a_link"/><xacro:property name="l" value="2"/>
        <joint name="a_joint" type="fixed">{ENDS}</joint>""",
        f"""<xacro:property name="l" value="1"/><link name="a_link">
        <gazebo><xacro:property name="l" value="3"/></gazebo></link>
        <joint name="a_joint" type="fixed">{ENDS}<origin xyz="0 0 ${{l}}" rpy="0 0 0"/></joint>""",
        f"""<xacro:macro name="set" params=""><xacro:property name="l" value="3" scope="parent"/>
        <a/></xacro:macro><xacro:property name="l" value="1"/>
        <link name="a_link"><gazebo><xacro:set/></gazebo></link>
        <joint name="a_joint" type="fixed">{ENDS}<origin xyz="0 0 ${{l}}" rpy="0 0 0"/></joint>""",
        # there may be no limit
        f"""<joint name="a_joint" type="revolute">{ENDS}{MANY}{LIMIT}</xacro:if></joint>
        <link name="a_link"/>""",
        f"""<xacro:property name="kind" value="fixed"/>
        <joint name="a_joint" type="${{kind}}">{ENDS}</joint><link name="a_link"/>""",
        # the parent is a matter of conditions
        f"""<joint name="a_joint" type="fixed"><child link="a_link"/>
        {MANY}<parent link="base"/></xacro:if>{FEW}<parent link="base"/></xacro:unless>
        </joint><link name="a_link"/>""",
        # there may be two origins
        f"""<joint name="a_joint" type="fixed">{ENDS}
        {MANY}<origin xyz="0 0 1" rpy="0 0 0"/></xacro:if>
        <xacro:if value="${{$(arg n) &lt; 3}}"><origin xyz="0 0 2" rpy="0 0 0"/></xacro:if>
        </joint><link name="a_link"/>""",
        # a link that has an origin
        f"""<xacro:macro name="at" params="*o"><joint name="a_joint" type="fixed">{ENDS}</joint>
        <link name="a_link"><xacro:insert_block name="o"/></link></xacro:macro>
        <xacro:at><origin xyz="0 0 1" rpy="0 0 0"/></xacro:at>""",
        # a property in the link
        f"""<joint name="a_joint" type="fixed">{ENDS}</joint><link name="a_link">
        <xacro:property name="m" value="2"/><visual name="${{m}}">{BOX}</visual></link>""",
        # it is not known what the call makes
        f"""<xacro:macro name="any" params=""><xacro:element xacro:name="axis" xyz="0 0 1"/>
        </xacro:macro><joint name="a_joint" type="fixed">{ENDS}<xacro:any/></joint>
        <link name="a_link"/>""",
    ],
)
def test_a_joint_that_may_come_out_in_another_way_stays_an_element(
    tmp_path: Path, robot: str
) -> None:
    made = migrated_for(tmp_path, N + BASE + robot, "1", "2", "3")
    assert "part:" not in made
    assert "joint/name=a_joint" in made


def test_links_in_other_elements_are_no_parts(tmp_path: Path) -> None:
    made = migrated_for(tmp_path, f'<gazebo><link name="x"><visual>{BOX}</visual></link></gazebo>')
    assert "part" not in made


UR = """\
    <xacro:macro name="look_up" params="name">
      <xacro:property name="offset" value="${dict(a=0.5, b=0.25)[name]}" scope="parent"/>
    </xacro:macro>
    <xacro:macro name="mesh_path" params="name">
      <xacro:look_up name="${name}"/>
      <xacro:property name="mesh" value="${name}_${offset}.stl" scope="parent"/>
    </xacro:macro>
    <xacro:macro name="mesh_of" params="name">
      <xacro:mesh_path name="${name}"/>
      <mesh filename="${mesh}"/>
    </xacro:macro>
    """


def test_a_link_whose_mesh_a_macro_finds_is_a_part(tmp_path: Path) -> None:
    link = f"""{UR}{BASE}
        <link name="a_link">
          <visual><geometry><xacro:mesh_of name="a"/></geometry></visual>
        </link>
        <joint name="a_joint" type="fixed"><origin xyz="0 0 1"/>{ENDS}</joint>"""
    assert part(tmp_path, link) == textwrap.dedent("""\
        name: a
        link:
          visual:
            <geometry>:
              MeshOf: {name: a}
        joint: {type: fixed, parent: base, xyz: 0 0 1}
        """)


def test_what_a_link_looks_up_first_is_looked_up_first_in_its_part(tmp_path: Path) -> None:
    shape = '<origin xyz="0 0 ${offset}"/><geometry><sphere radius="1"/></geometry>'
    link = f"""{UR}{BASE}
        <link name="a_link">
          <!-- how far -->
          <xacro:look_up name="a"/>
          <visual>{shape}</visual>
          <collision>{shape}</collision>
        </link>
        <joint name="a_joint" type="fixed"><origin xyz="0 0 1"/>{ENDS}</joint>"""
    assert part(tmp_path, link) == textwrap.dedent("""\
        name: a
        link:
          # how far
          LookUp: {name: a}
          geometry: sphere
          scale: 1
          xyz: 0 0 $(offset)
          visual:
          collision:
        joint: {type: fixed, parent: base, xyz: 0 0 1}
        """)


@pytest.mark.parametrize(
    "link",
    [
        # set behind what reads it
        """<link name="a_link"><visual><origin xyz="0 0 ${offset}"/>BOX</visual>
        <xacro:look_up name="a"/></link>""",
        # read by the name
        '<link name="a_${offset}"><xacro:look_up name="a"/><visual>BOX</visual></link>',
        # set in a section
        '<link name="a_link"><visual><xacro:look_up name="a"/>BOX</visual></link>',
    ],
)
def test_a_link_that_sets_what_is_read_before_stays_an_element(tmp_path: Path, link: str) -> None:
    made = migrated_for(
        tmp_path,
        f"""<xacro:property name="offset" value="1"/>{UR}
        <xacro:macro name="arm" params="">
          <xacro:property name="offset" value="2"/>
          {link.replace("BOX", BOX)}
        </xacro:macro>
        <xacro:arm/>""",
        "1",
    )
    assert "part:" not in made


def test_a_joint_that_reads_what_links_set_stays_where_it_is(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{UR}{BASE}
        <link name="a_link"><xacro:look_up name="a"/><visual>{BOX}</visual></link>
        <link name="b_link"><xacro:look_up name="b"/><visual>{BOX}</visual></link>
        <joint name="a_joint" type="fixed"><origin xyz="0 0 ${{offset}}"/>{ENDS}</joint>""",
        "1",
    )
    assert made.index("name: b") < made.index("joint/name=a_joint")


PLACED = """
    <xacro:macro name="arm" params="name *origin">
      <joint name="${name}_joint" type="fixed">
        <parent link="base"/><child link="${name}_link"/><xacro:insert_block name="origin"/>
      </joint>
      <link name="${name}_link"/>
    </xacro:macro>
    """


def test_the_pose_in_a_block_is_left_out_if_it_is_zeros(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{PLACED}{BASE}
        <xacro:arm name="a"><origin xyz="0 0 0" rpy="0 0 0"/></xacro:arm>
        <xacro:arm name="b"><origin/></xacro:arm>
        <xacro:arm name="c"><!-- upright --><origin rpy="0 0 1"/></xacro:arm>""",
    )
    assert model_of(made)[1:] == [
        "- Arm: {name: a}",
        "- Arm: {name: b}",
        "- Arm:",
        "    name: c",
        "    # upright",
        "    Origin: {rpy: 0 0 1}",
    ]


def test_a_block_that_is_in_a_part_and_in_an_element_is_an_element(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{PLACED.replace("<link", '<a><xacro:insert_block name="origin"/></a><link')}{BASE}
        <xacro:arm name="a"><origin xyz="0 0 1"/></xacro:arm>""",
    )
    assert "<origin/xyz=0 0 1>:" in made


def test_a_block_that_is_handed_on_to_an_element_is_an_element(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{PLACED}{BASE}
        <xacro:macro name="camera" params="*origin">
          <sensor><xacro:insert_block name="origin"/></sensor>
        </xacro:macro>
        <xacro:macro name="both" params="*origin">
          <xacro:arm name="a"><xacro:insert_block name="origin"/></xacro:arm>
          <xacro:camera><xacro:insert_block name="origin"/></xacro:camera>
        </xacro:macro>
        <xacro:both><origin xyz="0 0 1"/></xacro:both>""",
    )
    assert "<origin/xyz=0 0 1>:" in made


def test_a_block_that_is_handed_on_to_a_part_is_a_pose(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{PLACED}{BASE}
        <xacro:macro name="left_arm" params="*origin">
          <xacro:arm name="left"><xacro:insert_block name="origin"/></xacro:arm>
        </xacro:macro>
        <xacro:left_arm><origin xyz="0 0 1"/></xacro:left_arm>""",
    )
    assert "  LeftArm:\n    Origin: {xyz: 0 0 1}\n" in made or "LeftArm: {Origin" in made


def test_a_macro_that_is_called_in_an_element_too_gives_elements(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""
        <xacro:macro name="heavy" params=""><inertial>{MASS}</inertial></xacro:macro>
        <link name="a_link"><visual>{BOX}</visual><xacro:heavy/></link>
        <thing><xacro:heavy/></thing>""",
    )
    assert "<inertial>:" in made


def test_what_macros_give_parts_has_the_keys_of_parts(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{BASE}
        <xacro:macro name="hinge" params="">
          <axis xyz="0 0 1"/>{LIMIT}<dynamics damping="1"/>
        </xacro:macro>
        <xacro:macro name="red" params=""><material name="red"><color rgba="1 0 0 1"/></material>
        </xacro:macro>
        <joint name="a_joint" type="revolute">{ENDS}<xacro:hinge/></joint>
        <link name="a_link"><visual>{BOX}<xacro:red/></visual></link>""",
    )
    assert (
        "  Hinge():\n"
        "    axis: 0 0 1\n"
        "    limit: {lower: -1, upper: 1, effort: 2, velocity: 3}\n"
        "    dynamics: {damping: 1}\n"
    ) in made
    assert "  Red():\n    material: {name: red, color: 1 0 0 1}\n" in made


@pytest.mark.parametrize("again", ['<xacro:solid m="4"/>', f"<inertial>{MASS}</inertial>"])
def test_the_second_inertial_of_a_macro_was_lost(tmp_path: Path, again: str) -> None:
    made = migrated_for(
        tmp_path,
        f"""\
        <xacro:macro name="solid" params="m"><inertial><origin xyz="0 0 ${{m}}" rpy="0 0 0"/>
          <mass value="${{m}}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
        </inertial></xacro:macro>
        <link name="base"><xacro:solid m="3"/>{again}</link>
        """,
    )
    assert "Solid: {m: 3}" in made


@pytest.mark.parametrize("kind", ["texture", "mesh"])
def test_the_name_of_a_file_may_be_empty(tmp_path: Path, kind: str) -> None:
    texture = '<material name="red"><texture filename="{}"/></material>'.format
    shape = '<geometry><mesh filename="{}"/></geometry>'.format
    given = {"texture": (BOX, texture("$(arg n)")), "mesh": (shape("$(arg n)"), "")}[kind]
    fixed = {"texture": (BOX, texture("")), "mesh": (shape(""), "")}[kind]
    text = "".join(f"<visual>{''.join(pair)}</visual>" for pair in (given, fixed))
    migrated_for(
        tmp_path,
        f'<xacro:arg name="n" default="a.stl"/><link name="base">{text}</link>',
        "",
        "b.stl",
        " ",
    )
