"""Robots made of values are what reading their URDF gives, and know where they are written."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.model.robots import EXAMPLES, JOINTS
from yamaro import Robot, build
from yamaro.model import making
from yamaro.model.joint import Calibration, Dynamics, Limit, Mimic, SafetyController
from yamaro.model.making import Place
from yamaro.model.pose import IDENTITY
from yamaro.model.schema import ELEMENTS, TEXT
from yamaro.model.shapes import Mesh
from yamaro.source import Source, Span
from yamaro.xml.values import Numbers
from yamaro.xml.writer import write

ROOT = Path(__file__).parents[2]
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
    <collision>
      <geometry>
        <box size="0.1 0.2 0.3"/>
      </geometry>
    </collision>
    <collision>
      <origin xyz="1.0 2.0 3.0" rpy="0.0 0.0 1.5"/>
      <geometry>
        <cylinder radius="0.1" length="0.4"/>
      </geometry>
    </collision>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="0.0 0.0 0.3" rpy="0.0 0.0 0.0"/>
    <axis xyz="0.0 0.0 2.0"/>
    <limit lower="-1.0" upper="1.0" effort="10.0" velocity="2.0"/>
    <mimic joint="shoulder" multiplier="-1.0"/>
  </joint>
</robot>
"""


def two_links():
    """Return the robot of TWO_LINKS, made of values."""
    arm = making.link(
        HERE,
        name="arm",
        inertial=making.inertial(
            HERE,
            mass=1.5,
            inertia=(0.1, 0.0, 0.0, 0.2, 0.0, 0.1 + 0.2),
            pose=making.pose(HERE, (0.0, 0.0, 0.1)),
        ),
        visuals=[
            making.visual(
                HERE,
                name="look",
                shape=making.mesh(HERE, "package://a/arm.stl"),
                material=making.material(HERE, name="steel"),
            )
        ],
        collisions=[
            making.collision(HERE, shape=making.simple_shape(HERE, "box", 0.1, 0.2, 0.3)),
            making.collision(
                HERE,
                pose=making.pose(HERE, (1.0, 2.0, 3.0), (0.0, 0.0, 1.5)),
                shape=making.simple_shape(HERE, "cylinder", 0.1, 0.4),
            ),
        ],
    )
    elbow = making.joint(
        HERE,
        name="elbow",
        type="revolute",
        parent="base",
        child="arm",
        origin=making.pose(HERE, (0.0, 0.0, 0.3)),
        axis=(0.0, 0.0, 2.0),
        limit=making.part(
            Limit,
            Place(WHOLE, {"lower": RANGE, "upper": RANGE}),
            velocity=2,
            effort=10,
            lower=-1,
            upper=1,
        ),
        mimic=making.part(Mimic, HERE, joint="shoulder", multiplier=-1.0),
    )
    return making.robot(
        HERE,
        name="two_links",
        version="1.1",
        links=[making.link(HERE, name="base"), arm],
        joints=[elbow],
        materials=[making.material(HERE, name="steel", color=(0.5, 0.5, 0.5, 1.0))],
    )


def test_a_robot_made_of_values_is_written_as_urdf():
    assert write(two_links().element) == TWO_LINKS


def test_what_is_made_knows_where_it_is_written():
    limit = two_links().joints["elbow"].limit
    assert limit.span is WHOLE
    assert limit.span_of("upper") is RANGE
    assert limit.span_of("effort") is WHOLE


def test_values_are_rounded_as_they_are_written():
    robot = two_links()
    assert robot.links["arm"].inertial.inertia[5] == 0.3 != 0.1 + 0.2
    assert robot.joints["elbow"].axis == (0.0, 0.0, 1.0)
    assert robot.joints["elbow"].limit.effort == 10.0
    assert robot.joints["elbow"].mimic.offset == 0.0


@pytest.mark.parametrize(
    ("values", "fault"),
    [
        ({"uper": 1.0}, "a 'limit' has no 'uper'"),
        ({"upper": "1"}, "'upper' of a 'limit' cannot be '1'"),
        ({"upper": (1.0, 2.0)}, r"'upper' of a 'limit' cannot be \(1.0, 2.0\)"),
    ],
)
def test_a_value_that_the_schema_does_not_list_is_refused(values, fault):
    with pytest.raises(TypeError, match=fault):
        making.element("limit", HERE, values)


def test_numbers_stay_as_they_are_spelled():
    mass = making.element("mass", HERE, {"value": Numbers.spelled(("1.20",))})
    assert write(mass).endswith('<mass value="1.20"/>\n')


@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_a_number_that_is_not_finite_is_refused(number):
    with pytest.raises(ValueError, match="finite"):
        making.element("axis", HERE, {"xyz": (0.0, number, 0.0)})


def test_notes_say_what_a_robot_has_besides():
    link = making.link(HERE, name="base")
    imu = making.note("sensor", HERE, {"name": "imu", "type": "imu", "link": "base", "rate": 50})
    robot = making.robot(HERE, name="r", links=[link], joints=[], notes=[imu])
    assert robot.sensors["imu"].rate == 50.0
    assert robot.sensors["imu"].link == "base"


FULL = """<robot name="full"><link name="a"/><link name="b">
  <visual><geometry><sphere radius="0.3"/></geometry>
    <material name="m"><color rgba="1 0 0 0.5"/><texture filename="m.png"/></material></visual>
  <collision name="c"><origin rpy="0.1 0.2 0.3"/><geometry>
    <capsule radius="0.1" length="1e-3"/></geometry></collision></link>
  <joint name="j" type="prismatic"><parent link="a"/><child link="b"/>
    <limit lower="0.123456789012345678" upper="1" effort="1" velocity="2" acceleration="3"
      deceleration="4" jerk="5"/>
    <dynamics damping="0.7" friction="0.01"/><calibration rising="0.1" falling="0.2"/>
    <safety_controller soft_lower_limit="-1" soft_upper_limit="1" k_position="3"
      k_velocity="4"/></joint></robot>"""


def remade(robot: Robot) -> Robot:
    """Return a robot that is made of the values of another one, by the schema's names."""

    def values_of(part, name: str) -> dict[str, float | str | None]:
        fields = ELEMENTS[name].fields
        return {each: getattr(part, each) for each in fields if part.written(each) is not None}

    def part(kind: type, name: str, given):
        return None if given is None else making.part(kind, HERE, **values_of(given, name))

    def pose(given):
        return given if given is IDENTITY else making.pose(HERE, given.position, given.rpy)

    def shape(given):
        if isinstance(given, Mesh):
            return making.mesh(HERE, given.filename, given.scale)
        return making.simple_shape(HERE, given.kind, *given.size)

    def material(given):
        if given is None:
            return None
        values = {"name": given.name, "color": given.color, "texture": given.texture}
        return making.material(HERE, **values)

    def link(given):
        inertial = given.inertial
        if inertial is not None:
            mass, inertia = inertial.mass, inertial.inertia
            inertial = making.inertial(HERE, mass=mass, inertia=inertia, pose=pose(inertial.pose))
        return making.link(
            HERE,
            name=given.name,
            inertial=inertial,
            visuals=[
                making.visual(
                    HERE,
                    shape=shape(each.shape),
                    pose=pose(each.pose),
                    material=material(each.material),
                    name=each.name or None,
                )
                for each in given.visuals
            ],
            collisions=[
                making.collision(
                    HERE, shape=shape(each.shape), pose=pose(each.pose), name=each.name or None
                )
                for each in given.collisions
            ],
        )

    def joint(given):
        return making.joint(
            HERE,
            name=given.name,
            type=given.type,
            parent=given.parent,
            child=given.child,
            origin=pose(given.origin),
            axis=given.axis,
            limit=part(Limit, "limit", given.limit),
            mimic=part(Mimic, "mimic", given.mimic),
            dynamics=part(Dynamics, "dynamics", given.dynamics),
            safety_controller=part(SafetyController, "safety_controller", given.safety_controller),
            calibration=part(Calibration, "calibration", given.calibration),
        )

    return making.robot(
        HERE,
        name=robot.name,
        version=robot.version,
        links=[link(each) for each in robot.all_links],
        joints=[joint(each) for each in robot.all_joints],
        materials=[material(each) for each in robot.own_materials],
    )


def said(thing: object) -> object:
    """Return all values of an object of the model, without its places."""
    if isinstance(thing, tuple):
        return tuple(map(said, thing))
    slots = getattr(type(thing), "__slots__", None)
    if slots is None:
        return thing
    inherited = (name for kind in type(thing).__mro__ for name in getattr(kind, "__slots__", ()))
    left_out = ("element", "trace", "read_rest")
    return {name: said(getattr(thing, name, None)) for name in inherited if name not in left_out}


@pytest.mark.parametrize("source", [FULL, JOINTS, *EXAMPLES], ids=["full", "joints", *EXAMPLES])
def test_reading_what_is_written_of_a_made_robot_gives_the_same(source):
    is_file = source in EXAMPLES
    before = build(ROOT / "examples" / source).robot if is_file else Robot.from_xml(source)
    made = remade(before)
    after = Robot.from_xml(write(made.element))
    assert not after.findings
    assert [said(each) for each in made.all_links] == [said(each) for each in after.all_links]
    assert [said(each) for each in made.all_joints] == [said(each) for each in after.all_joints]
    changes = before.changes(made, has_extras=False)
    assert {each.of for each in changes} <= {"element"}  # of other programs, such as `<gazebo>`


def test_every_field_of_a_joint_is_made_by_its_row():
    for kind, name in making.RECORDS.items():
        fields = ELEMENTS[name].fields
        values = {
            each: "other" if field.count == TEXT else number / 8
            for number, (each, field) in enumerate(fields.items(), start=1)
        }
        part = making.part(kind, HERE, **values)  # type: ignore[type-var]
        assert {each: getattr(part, each) for each in fields} == values
