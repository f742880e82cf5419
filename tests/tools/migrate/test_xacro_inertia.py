"""Inertia that xacro computes for a solid is left to be computed; any other stays as it is."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.against_xacro import migrated_for, model_of
from yamaro.tools.migrate.formulas import are_equal, is_inertia_of

N = '<xacro:arg name="n" default="2"/>'
BOX = """<xacro:macro name="box_inertia" params="m w d h">
  <inertia ixx="${m/12*(d*d+h*h)}" ixy="0" ixz="0" iyy="${m/12*(w**2+h**2)}" iyz="0"
           izz="${m*(w*w+d*d)/12}"/>
</xacro:macro>"""
CYLINDER = """<!-- its axis is z -->
<xacro:macro name="cylinder" params="radius length mass xyz:='0 0 0' rpy:='0 0 0'">
  <inertial>
    <mass value="${mass}"/>
    <origin xyz="${xyz}" rpy="${rpy}"/>
    <inertia ixx="${1.0/12*mass*(3*radius*radius+length*length)}" ixy="0" ixz="0"
             iyy="${1.0/12*mass*(3*radius*radius+length*length)}" iyz="0"
             izz="${0.5*mass*radius*radius}"/>
  </inertial>
</xacro:macro>"""
BALL = """<xacro:macro name="ball" params="r m *origin">
  <inertial>
    <xacro:insert_block name="origin"/>
    <mass value="${m}"/>
    <inertia ixx="${2*m*math.pow(r, 2)/5}" ixy="0" ixz="0" iyy="${0.4*m*r*r}" iyz="0"
             izz="${0.4*m*r*r}"/>
  </inertial>
</xacro:macro>"""


def test_a_link_whose_collision_is_the_solid_has_a_mass_only(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{N}{BOX}<link name="a_link">
          <inertial>
            <origin xyz="0 0 1" rpy="0 0 0"/>
            <mass value="3"/>
            <xacro:box_inertia m="3.0" h="0.5" w="$(arg n)" d="${{$(arg n)/2}}"/>
          </inertial>
          <collision>
            <origin xyz="0 0 1" rpy="0 0 0"/>
            <geometry><box size="$(arg n) ${{0.5*$(arg n)}} 0.5"/></geometry>
          </collision>
        </link>""",
        "1",
        "2.5",
    )
    assert model_of(made) == [
        "  part:",
        "    name: a",
        "    link:",
        "      geometry: box",
        "      scale: $(n) $(0.5*n) 0.5",
        "      xyz: 0 0 1",
        "      mass: 3",
        "      collision:",
    ]
    assert "functions" not in made


def test_a_solid_that_is_not_the_geometry_stands_in_the_inertial(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{N}
        {CYLINDER}
        <link name="a_link">
          <visual><geometry><mesh filename="a.stl"/></geometry></visual>
          <xacro:cylinder radius="0.1" length="$(arg n)" mass="3" xyz="0 0 ${{$(arg n)/2}}"/>
        </link>
        <link name="b_link">
          <collision>
            <origin xyz="0 0 0" rpy="0 0 0"/>
            <geometry><cylinder radius="0.1" length="1"/></geometry>
          </collision>
          <xacro:cylinder radius="0.1" length="1.0" mass="3"/>
        </link>""",
        "1",
        "2.5",
    )
    assert model_of(made) == [
        "- part:",
        "    name: a",
        "    link:",
        "      visual: {geometry: a.stl}",
        "      inertial: {mass: 3, xyz: 0 0 $(n/2), geometry: cylinder, scale: 0.1 $(n)}",
        "- part:",
        "    name: b",
        "    link:",
        "      geometry: cylinder",
        "      scale: 0.1 1",
        "      collision:",
        "      mass: 3",
    ]
    assert "axis" not in made


def test_the_origin_may_be_a_block(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{BALL}
        <xacro:macro name="unit" params="name *pose">
          <link name="${{name}}_link">
            <collision>
              <xacro:insert_block name="pose"/><geometry><sphere radius="1"/></geometry>
            </collision>
            <xacro:ball r="1.0" m="2"><xacro:insert_block name="pose"/></xacro:ball>
          </link>
        </xacro:macro>
        <xacro:unit name="a"><origin xyz="0 0 1" rpy="0 0 0"/></xacro:unit>
        <xacro:unit name="b"><origin xyz="0 0 1"/></xacro:unit>""",
    )
    function = made.partition("    part:\n")[2].partition("model:\n")[0]
    assert function.splitlines() == [
        "      name: $(name)",
        "      link:",
        "        geometry: sphere",
        "        scale: 1",
        "        collision: {Pose: }",
        "        inertial:",
        "          mass: 2",
        "          Pose:",
    ]


def test_formulas_that_stand_in_the_link_are_seen_too(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        f"""{N}<xacro:property name="s" value="${{dict(x=2, m=3)}}"/>
        <link name="a_link">
          <inertial>
            <mass value="${{s['m']}}"/>
            <inertia ixx="${{s['m']/12*(s['x']**2+$(arg n)**2)}}" ixy="0" ixz="0"
                     iyy="${{s['m']/12*(s['x']**2+$(arg n)**2)}}" iyz="0"
                     izz="${{s['m']*s['x']*s['x']/6}}"/>
          </inertial>
          <visual><geometry><box size="${{s['x']}} ${{s['x']}} $(arg n)"/></geometry></visual>
        </link>""",
        "1",
        "2.5",
    )
    assert model_of(made)[3:] == [
        "      geometry: box",
        "      scale: $(s['x']) $(s['x']) $(n)",
        "      mass: $(s['m'])",
        "      visual:",
    ]


def sphere(ixx: str, others: str = "${0.4*m*r*r}", params: str = "m r") -> str:
    """Return a macro that gives an inertia."""
    return f"""<xacro:macro name="own" params="{params}">
    <inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{others}" iyz="0" izz="{others}"/></xacro:macro>"""


@pytest.mark.parametrize(
    ("macro", "call"),
    [
        (sphere("${0.39999999*m*r*r}"), 'm="1" r="1"'),
        (sphere("${0.4*m*(r*r+s)}", params="m r s"), 'm="1" r="1" s="0"'),
        (sphere("${m*r*r/2}", "${m*(3*r*r+h*h)/12}", "m r h"), 'm="1" r="1" h="2"'),
        (sphere("${0.4*m*r*max(r, r)}"), 'm="1" r="1"'),
        (sphere("${0.4*m*r*r}"), 'm="2" r="1"'),  # not the mass of the link
        (sphere("${0.4*m*r*r}"), 'm="1" r="0"'),  # no body
        (sphere("${0.4*m*r*r}", params="m r:=${2.0/3}"), 'm="1"'),  # the default is computed
    ],
)
def test_any_other_inertia_stays(tmp_path: Path, macro: str, call: str) -> None:
    made = migrated_for(
        tmp_path,
        f"""{macro}<link name="a_link">
        <inertial><mass value="1"/><xacro:own {call}/></inertial></link>""",
    )
    assert model_of(made)[3:6] == [
        "      <inertial>:",
        "        mass/value=1:",
        "        Own: {" + call.replace('" ', ", ").replace('="', ": ").replace('"', "") + "}",
    ]
    assert "  Own(" in made


def test_numbers_are_not_taken_for_the_formula(tmp_path: Path) -> None:
    made = migrated_for(
        tmp_path,
        """<xacro:property name="x" value="4"/><link name="a_link">
        <inertial><mass value="1"/>
        <inertia ixx="${0.4*x*x}" ixy="0" ixz="0" iyy="${0.4*x*x}" iyz="0" izz="${0.4*x*x}"/>
        </inertial>
        <visual><geometry><sphere radius="4"/></geometry></visual></link>""",
    )
    assert "inertia: $(0.4*x*x) 0 0 $(0.4*x*x) 0 $(0.4*x*x)" in made


def test_a_function_that_is_called_elsewhere_stays(tmp_path: Path) -> None:
    origin = '<origin xyz="0 0 0" rpy="0 0 0"/>'
    made = migrated_for(
        tmp_path,
        f"""{BALL}{BOX}
        <!-- Copyright: its makers -->
        {CYLINDER}
        <link name="a_link"><xacro:ball m="1" r="2">{origin}</xacro:ball></link>
        <link name="b_link">
          <xacro:property name="r" value="2"/><xacro:ball m="1" r="${{r}}">{origin}</xacro:ball>
        </link>
        <link name="c_link"><xacro:cylinder radius="1" length="1" mass="2"/></link>""",
    )
    assert "inertial: {mass: 1, geometry: sphere, scale: 2}" in made
    assert "  Ball(" in made
    assert "  BoxInertia(" in made  # that nobody calls, and nobody did
    assert "Cylinder" not in made
    assert "# Copyright: its makers" in made


@pytest.mark.parametrize(
    ("kind", "sizes", "mass", "moments", "is_equal"),
    [
        ("sphere", ["$(r)"], "$(m)", ["$(2/5*m*r**2)"] * 3, True),
        ("sphere", ["$(d/2)"], "$(m)", ["$(m*d*d/10)"] * 3, True),
        ("sphere", ["-$(r)"], "$(m)", ["$(2/5*m*r**2)"] * 3, False),
        ("sphere", ["$(a.r[0])"], "2", ["$(0.8*a.r[0]**2)"] * 3, True),
        ("sphere", ["$(a.r[0])"], "2", ["$(0.8*a.r[1]**2)"] * 3, False),
        ("sphere", ["$(f(r))"], "2", ["$(0.8*f(r)**2)"] * 3, False),  # may differ each time
        ("sphere", ["$(r)"], "0", ["0"] * 3, False),
        ("sphere", ["1"], "2", ["0.8"] * 3, True),
        ("sphere", ["1", "1"], "2", ["0.8"] * 3, False),
        ("sphere", ["$(r)"], "$(m)", ["$(m/0)"] * 3, False),
        ("capsule", ["1", "1"], "2", ["0.8"] * 3, False),
    ],
)
def test_formulas_are_told_apart(
    kind: str, sizes: list[str], mass: str, moments: list[str], is_equal: bool
) -> None:
    ixx, iyy, izz = moments
    assert is_inertia_of(kind, sizes, mass, [ixx, "0", "0", iyy, "0", izz]) == is_equal


def test_words_are_compared_as_numbers() -> None:
    assert are_equal(["1", "$(a/2)"], ["1.0", "$(0.5*a)"])
    assert are_equal(["${f(a)}"], ["${f(a)}"])
    assert not are_equal(["1"], ["1", "1"])
    assert not are_equal(["$(a)"], ["$(b)"])
