"""Angles that are whole numbers of degrees are written in degrees, and the robot stays the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.migrate.migrating import migrated as migrated_urdf
from tests.tools.migrate.test_xacro_migration import hold_for, migrated

JOINT = """
<link name="base_link"/>
<joint name="a_joint" type="{kind}">
  <parent link="base_link"/><child link="a_link"/>
  <origin xyz="0 0 {angle}" rpy="{angle} 0 0"/>
  <limit lower="-{angle}" upper="{angle}" effort="{angle}" velocity="{angle}"/>
</joint>
<link name="a_link"/>
"""


def made(folder: Path, angle: str, before: str = "", kind: str = "revolute") -> str:
    """Return the source of a robot with a joint in which an angle is in several places."""
    text = migrated(folder, before + JOINT.format(angle=angle, kind=kind))["r.yaml"]
    hold_for(folder, [])
    return text


@pytest.mark.parametrize(
    ("angle", "degrees"),
    [
        ("${pi/2}", "90"),
        ("${radians(45)}", "45"),
        ("${math.radians(45)}", "45"),
        ("${30 * pi / 180}", "30"),
        ("${2*pi}", "360"),
        ("1.5707963267948966", "90"),
        ("3.14159265358979", "180"),
    ],
)
def test_whole_degrees_are_in_degrees(tmp_path: Path, angle: str, degrees: str) -> None:
    text = made(tmp_path, angle)
    assert f"rpy: {degrees}deg 0 0" in text
    assert f"limit: {{lower: -{degrees}deg, upper: {degrees}deg, effort: " in text
    assert f"velocity: {degrees}deg/s}}" in text
    assert text.count("deg") - text.count("deg/s") == 3  # neither the position nor the effort


@pytest.mark.parametrize("angle", ["1.5708", "1.570796327", "${pi/7}", "${1.5}", "0.5", "20"])
def test_other_angles_stay_as_they_are(tmp_path: Path, angle: str) -> None:
    assert "deg" not in made(tmp_path, angle)


def test_what_slides_has_no_degrees(tmp_path: Path) -> None:
    assert made(tmp_path, "${pi/2}", kind="prismatic").count("deg") == 1


@pytest.mark.parametrize(
    ("before", "angle", "is_known"),
    [
        ('<xacro:property name="M_PI" value="3.1415926535897931"/>', "${M_PI/2}", True),
        ('<xacro:property name="d" value="${pi/180}"/>', "${90*d}", True),
        ('<xacro:property name="d" value="3.1416"/>', "${d/2}", False),
        ('<xacro:property name="pi" value="3"/>', "${pi/2}", False),
        ('<xacro:arg name="d" default="${pi}"/><xacro:property name="d" value="$(arg d)"/>',
         "${d/2}", False),
        ('<xacro:property name="d" value="${pi}"/><xacro:property name="d" value="${pi/2}"/>',
         "${d}", False),
        ('<xacro:property name="d" value="${pi}"/><xacro:macro name="m" params="d"/>',
         "${d}", False),
    ],
)  # fmt: skip
def test_names_count_if_they_always_have_one_number(
    tmp_path: Path, before: str, angle: str, is_known: bool
) -> None:
    assert ("deg" in made(tmp_path, angle, before)) is is_known


def test_where_every_letter_counts_numbers_stay(tmp_path: Path) -> None:
    urdf = f'<robot name="r">{JOINT.format(angle="1.5707963267948966", kind="revolute")}</robot>'
    assert "rpy: 90deg 0 0" in migrated_urdf(urdf)
    assert "deg" not in migrated_urdf(urdf, exact=True)
