"""URDF that is made of values is what reading it gives, and knows where it is written."""

from __future__ import annotations

import pytest

from yamaro import Robot
from yamaro.model import making
from yamaro.model.making import Place, element
from yamaro.model.schema import ELEMENTS, TEXT
from yamaro.source import Source, Span
from yamaro.xml.tree import Element
from yamaro.xml.values import Numbers
from yamaro.xml.writer import write

SOURCE = Source("<mujoco> range='-1 1' </mujoco>", name="arm.xml")
WHOLE = Span(SOURCE, 0, 8)
RANGE = Span(SOURCE, 16, 20)
HERE = Place(WHOLE)

TWO_LINKS = """\
<?xml version="1.0"?>
<robot name="two_links" version="1.1">
  <material name="steel">
    <color rgba="0.5 0.5 0.5 1.0"/>
  </material>
  <link name="base"/>
  <link name="arm">
    <inertial>
      <origin xyz="0.0 0.0 0.1" rpy="0.0 0.0 0.0"/>
      <mass value="1.5"/>
      <inertia ixx="0.1" ixy="0.0" ixz="0.0" iyy="0.2" iyz="0.0" izz="0.3"/>
    </inertial>
    <visual name="look">
      <geometry>
        <mesh filename="package://a/arm.stl"/>
      </geometry>
      <material name="steel"/>
    </visual>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="0.0 0.0 0.3" rpy="0.0 0.0 1.5"/>
    <axis xyz="0.0 0.0 2.0"/>
    <limit lower="-1.0" upper="1.0" effort="10.0" velocity="2.0"/>
    <mimic joint="shoulder" multiplier="-1.0"/>
  </joint>
</robot>
"""


def two_links() -> Element:
    """Return the robot of TWO_LINKS, made of values."""
    moments = {"izz": 0.1 + 0.2, "ixx": 0.1, "ixy": 0.0, "ixz": 0.0, "iyy": 0.2, "iyz": 0.0}
    inertial = [
        making.origin(HERE, (0.0, 0.0, 0.1)),
        element("mass", HERE, {"value": 1.5}),
        element("inertia", HERE, moments),
    ]
    mesh = element("mesh", HERE, {"filename": "package://a/arm.stl", "scale": None})
    look = [element("geometry", HERE, {}, [mesh]), making.material(HERE, "steel")]
    limits = {"velocity": 2, "effort": 10, "lower": -1, "upper": 1}
    elbow = [
        making.origin(HERE, (0.0, 0.0, 0.3), (0.0, 0.0, 1.5)),
        element("axis", HERE, {"xyz": (0.0, 0.0, 2.0)}),
        element("limit", Place(WHOLE, {"lower": RANGE, "upper": RANGE}), limits),
        element("mimic", HERE, {"joint": "shoulder", "multiplier": -1.0}),
    ]
    parts = [
        making.material(HERE, "steel", (0.5, 0.5, 0.5, 1.0)),
        making.link(HERE, "base"),
        making.link(
            HERE,
            "arm",
            [
                element("inertial", HERE, {}, inertial),
                element("visual", HERE, {"name": "look"}, look),
            ],
        ),
        making.joint(HERE, "elbow", "revolute", "base", "arm", elbow),
    ]
    return element("robot", HERE, {"name": "two_links", "version": "1.1"}, parts)


def test_what_is_made_of_values_is_written_as_urdf() -> None:
    assert write(two_links()) == TWO_LINKS


def test_what_is_made_knows_where_it_is_written() -> None:
    (limit,) = (each for each in two_links().iter() if each.name == "limit")
    assert limit.span is WHOLE
    assert limit.value_span("upper") is RANGE
    assert limit.value_span("effort") is WHOLE


def test_the_model_reads_numbers_as_they_are_written():
    robot = Robot.from_xml(write(two_links()))
    arm, elbow = robot.links["arm"], robot.joints["elbow"]
    assert arm.inertial is not None
    assert arm.inertial.inertia[5] == 0.3 != 0.1 + 0.2
    assert elbow.axis == (0.0, 0.0, 1.0)
    assert elbow.limit is not None
    assert elbow.limit.effort == 10.0
    assert elbow.mimic is not None
    assert elbow.mimic.offset == 0.0


@pytest.mark.parametrize(
    ("values", "fault"),
    [
        ({"uper": 1.0}, "a 'limit' has no 'uper'"),
        ({"upper": 1.0, "uper": 1.0}, "a 'limit' has no 'uper'"),
        ({"upper": "1"}, "'upper' of a 'limit' cannot be '1'"),
        ({"upper": (1.0, 2.0)}, r"'upper' of a 'limit' cannot be \(1.0, 2.0\)"),
    ],
)
def test_a_value_that_the_schema_does_not_list_is_refused(values, fault) -> None:
    with pytest.raises(TypeError, match=fault):
        element("limit", HERE, values)


def test_numbers_stay_as_they_are_spelled() -> None:
    mass = element("mass", HERE, {"value": Numbers.spelled(("1.20",))})
    assert write(mass).endswith('<mass value="1.20"/>\n')


@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_a_number_that_is_not_finite_is_refused(number: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        element("axis", HERE, {"xyz": (0.0, number, 0.0)})
    made = element("axis", HERE, {"xyz": (1e308, 1e308, 0.0)})
    assert made.attributes["xyz"] == "1e+308 1e+308 0.0"


@pytest.mark.parametrize("name", ELEMENTS)
def test_every_value_of_the_schema_is_made_by_its_row(name: str) -> None:
    values: dict[str, str | tuple[float, ...]] = {
        each: "other" if field.count == TEXT else tuple(i / 8 for i in range(1, field.count + 1))
        for each, field in ELEMENTS[name].fields.items()
    }
    made = element(name, HERE, dict(reversed(values.items())))
    assert list(made.attributes) == list(values)
    for each, value in values.items():
        assert made.attributes[each] == (value if isinstance(value, str) else Numbers.of(*value))
