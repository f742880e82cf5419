"""What the model holds of a robot: links, joints, shapes, materials, and where they are written."""

import pickle
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import yamaro
from tests.later import Later
from tests.model.robots import JOINTS
from yamaro import Robot, YamaroError, build
from yamaro.model import Box, Capsule, Cylinder, Joint, Link, Mesh, Pose, Sphere, Visual
from yamaro.model.reading import read_robot
from yamaro.xml.tree import Element

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation
else:
    Rotation = Later("scipy.spatial.transform", "Rotation")

MATERIALS = '<material name="red"><color rgba="1 0 0 0.5"/></material><material name="none"/>'
ARM_OF_PARTS = """\
robot: arm
states: {home: {j2: 0}}
model:
- material/name=steel: {color/rgba=0.5 0.5 0.5 1: }
- part: {name: base, link: {geometry: sphere, scale: 0.1, mass: 1}}
- part:
    name: j2
    joint:
      type: revolute
      parent: base
      axis: z
      limit: {lower: -1, upper: 1, effort: 1, velocity: 1}
      actuator: {command: position}
    link:
      geometry: sphere
      scale: 0.1
      mass: 1
      sensor/name=lidar: {type: lidar}
- part: {name: tool, joint: {type: fixed, parent: j2}}
"""


def robot_with(content: str) -> Robot:
    return Robot.from_xml(f'<robot name="r">{MATERIALS}<link name="a">{content}</link></robot>')


def visuals_of(content: str) -> tuple[Visual, ...]:
    return robot_with(content).links["a"].visuals


def visual(geometry: str, more: str = "") -> str:
    return f"<visual>{more}<geometry>{geometry}</geometry></visual>"


# --- shapes and poses -------------------------------------------------------------------------


def test_each_kind_of_shape_has_its_size() -> None:
    found = visuals_of(
        visual('<box size="1 2 3"/>')
        + visual('<cylinder radius="0.5" length="2"/>')
        + visual('<sphere radius="0.25"/>')
        + visual('<capsule radius="0.5" length="4"/>')
        + visual('<mesh filename="a.stl" scale="1 -2 3"/>')
        + visual('<mesh filename="a.stl"/>')
    )
    assert [each.shape for each in found] == [
        Box(1, 2, 3),
        Cylinder(0.5, 2),
        Sphere(0.25),
        Capsule(0.5, 4),
        Mesh("a.stl", (1, -2, 3)),
        Mesh("a.stl"),
    ]


def test_a_shape_stands_where_its_origin_says() -> None:
    origin = '<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>'
    (found,) = visuals_of(visual('<sphere radius="1"/>', origin))
    matrix = np.array(found.pose.matrix())
    turned = Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix()
    np.testing.assert_allclose(matrix[:3, :3], turned, atol=1e-12)
    np.testing.assert_allclose(matrix[:, 3], [1, 2, 3, 1])


def test_an_origin_may_be_a_quaternion() -> None:
    quaternion = [0.1, -0.2, 0.3, 0.4]
    origin = f'<origin quat_xyzw="{" ".join(map(str, quaternion))}"/>'
    (found,) = visuals_of(visual('<sphere radius="1"/>', origin))
    expected = Rotation.from_quat(quaternion).as_matrix()
    np.testing.assert_allclose(found.pose.rotation, expected, atol=1e-12)


def test_a_pose_is_undone_by_its_inverse() -> None:
    (found,) = visuals_of(visual("", '<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>'))
    expected = np.linalg.inv(found.pose.matrix())
    np.testing.assert_allclose(found.pose.inverse().matrix(), expected, atol=1e-12)
    there_and_back = found.pose @ found.pose.inverse()
    np.testing.assert_allclose(there_and_back.matrix(), np.eye(4), atol=1e-12)


# --- materials --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("material", "color"),
    [
        ("", None),
        ('<material name="red"/>', (1, 0, 0, 0.5)),
        ('<material name="none"/>', None),
        ('<material name="own"><color rgba="0 1 0 1"/></material>', (0, 1, 0, 1)),
        ('<material name=""><color rgba="0 0 1 1"/></material>', (0, 0, 1, 1)),
        ('<material name="red"><color rgba="0 1 0 1"/></material>', (1, 0, 0, 0.5)),
        ('<material name="wild"><color rgba="7 -1 0 1"/></material>', (7, -1, 0, 1)),
        ('<material name="short"><color rgba="1 1"/></material>', None),
    ],
)
def test_a_visual_has_the_colour_that_its_material_means(
    material: str, color: tuple[float, ...] | None
) -> None:
    robot = robot_with(visual('<sphere radius="1"/>', material))
    found = robot.material_of(robot.links["a"].visuals[0])
    assert (found.color if found is not None else None) == color


def test_a_material_that_one_visual_defines_serves_another() -> None:
    defined = '<material name="blue"><color rgba="0 0 1 1"/></material>'
    robot = robot_with(
        visual('<sphere radius="1"/>', '<material name="blue"/>')
        + visual('<sphere radius="1"/>', defined)
    )
    first, second = (robot.material_of(each) for each in robot.links["a"].visuals)
    assert first is second is robot.materials["blue"]
    assert first.color == (0.0, 0.0, 1.0, 1.0)


def test_a_material_may_have_a_texture() -> None:
    material = '<material name="wood"><texture filename="wood.png"/></material>'
    robot = robot_with(visual('<sphere radius="1"/>', material))
    assert robot.materials["wood"].texture == "wood.png"


# --- links and joints -------------------------------------------------------------------------


def test_a_collision_is_no_visual() -> None:
    content = '<collision name="c"><geometry><sphere radius="1"/></geometry></collision>'
    link = robot_with(content).links["a"]
    assert [(each.name, each.shape) for each in link.collisions] == [("c", Sphere(1))]
    assert link.visuals == ()


def test_a_link_has_its_mass_and_inertia() -> None:
    link = robot_with(
        '<inertial><origin xyz="1 0 0"/><mass value="2"/>'
        '<inertia ixx="1" ixy="2" ixz="3" iyy="4" iyz="5" izz="6"/></inertial>'
    ).links["a"]
    assert link.mass == 2.0
    assert link.inertial is not None
    assert link.inertial.inertia == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert link.inertial.matrix()[1] == (2.0, 4.0, 5.0)
    assert link.inertial.pose.position == (1.0, 0.0, 0.0)


def test_a_joint_has_all_that_is_written_in_it() -> None:
    robot = Robot.from_xml(
        '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="prismatic">'
        '<parent link="a"/><child link="b"/><axis xyz="0 0 2"/>'
        '<limit lower="-1" upper="2" effort="3" velocity="4"/>'
        '<dynamics damping="5"/><calibration rising="6"/>'
        '<safety_controller soft_lower_limit="7" k_velocity="8"/>'
        '<mimic joint="k" multiplier="0" offset="9"/></joint></robot>'
    )
    joint = robot.joints["j"]
    assert (joint.type, joint.parent, joint.child, joint.axis) == ("prismatic", "a", "b", (0, 0, 1))
    limit, mimic = joint.limit, joint.mimic
    assert limit is not None
    assert mimic is not None
    assert [limit.lower, limit.upper, limit.effort, limit.velocity] == [-1, 2, 3, 4]
    assert limit.jerk is None
    assert [mimic.joint, mimic.multiplier, mimic.offset] == ["k", 0, 9]
    assert joint.dynamics is not None
    assert [joint.dynamics.damping, joint.dynamics.friction] == [5, 0]
    assert joint.calibration is not None
    assert [joint.calibration.rising, joint.calibration.falling] == [6, None]
    assert joint.safety_controller is not None
    assert joint.safety_controller.soft_lower_limit == 7
    assert robot.findings == ()


def test_links_and_joints_are_in_the_order_written() -> None:
    robot = Robot.from_xml(JOINTS)
    assert list(robot.links)[:3] == ["base", "turned", "spun"]
    assert list(robot.joints)[-2:] == ["drift", "float"]
    assert [link.name for link in robot.roots] == ["base"]
    assert [joint.name for joint in robot.joints_below("base")] == [
        "turn", "echo", "drift", "float",
    ]  # fmt: skip
    held = robot.parent_joint("held")
    assert held is not None
    assert held.name == "hold"
    assert robot.parent_joint("base") is None


def test_an_empty_link_on_a_fixed_joint_is_a_frame() -> None:
    robot = Robot.from_xml(JOINTS)
    assert list(robot.frames) == ["held"]
    frame = robot.frames["held"]
    assert (frame.name, frame.link) == ("held", "slid")
    assert frame.pose.position == (0.0, 0.0, 0.1)
    assert frame.span.written() == "joint"


# --- leniency ---------------------------------------------------------------------------------


def test_what_is_half_written_takes_defaults_and_is_listed() -> None:
    robot = Robot.from_xml(
        '<robot><link/><link name="a"><visual/><visual><geometry/></visual>'
        '<visual><geometry><box size="1 x 3"/></geometry></visual><inertial/></link>'
        '<joint/><joint name="j" type="hinge"><axis xyz="0 0 0"/><limit upper="1 2"/></joint>'
        "</robot>"
    )
    assert [each.shape for each in robot.links["a"].visuals] == [None, None, Box(0, 0, 0)]
    joint = robot.joints["j"]
    assert joint.axis == (1.0, 0.0, 0.0)
    assert joint.upper is None
    assert joint.limit is not None
    assert joint.limit.upper == 1
    assert [(found.code, found.span.written()) for found in robot.findings] == [
        ("missing-attribute", "link"),
        ("missing-element", "visual"),
        ("missing-element", "geometry"),
        ("not-a-number", "1 x 3"),
        ("missing-attribute", "joint"),
        ("missing-attribute", "joint"),
        ("unknown-joint-type", "hinge"),
        ("wrong-count", "1 2"),
    ]
    assert robot.findings[3].message == "'size' of 'box' takes three numbers, not '1 x 3'"


def test_findings_are_in_the_order_written_whatever_was_used_before() -> None:
    text = (
        '<robot name="r"><link name="a"><inertial><mass value="x"/></inertial></link>'
        '<joint name="j" type="hinge"/></robot>'
    )
    robot = Robot.from_xml(text)
    assert robot.joints["j"].type == "hinge"
    assert robot.links["a"].mass == 0
    codes = [found.code for found in robot.findings]
    assert codes == ["not-a-number", "unknown-joint-type"]
    assert codes == [found.code for found in Robot.from_xml(text).findings]


def test_a_link_and_a_joint_have_only_what_is_documented() -> None:
    robot = Robot.from_xml(JOINTS)
    assert not hasattr(robot.links["base"], "masses")
    with pytest.raises(AttributeError, match="orgin"):
        _ = robot.joints["turn"].orgin  # type: ignore[attr-defined]


def test_of_two_links_of_a_name_the_first_counts() -> None:
    robot = Robot.from_xml(
        '<robot name="r"><link name="a"><inertial><mass value="1"/></inertial></link>'
        '<link name="b"/><link name="a"/></robot>'
    )
    assert robot.links["a"].mass == 1
    assert list(robot.links) == ["a", "b"]
    assert [link.name for link in robot.all_links] == ["a", "b", "a"]


@pytest.mark.parametrize("text", ["1_0", "1 "])
def test_a_number_that_only_some_parsers_read_is_read_and_listed(text: str) -> None:
    robot = robot_with(f'<inertial><mass value="{text}"/></inertial>')
    assert robot.mass == float(text.split()[0])
    assert [found.code for found in robot.findings] == ["not-a-number"]


@pytest.mark.parametrize("number", ["1e999", "nan", "inf"])
def test_a_number_that_is_none_is_left_out(number: str) -> None:
    robot = robot_with(f'<inertial><mass value="{number}"/></inertial>')
    assert robot.mass == 0
    assert [found.code for found in robot.findings] == ["not-a-number"]


def test_what_is_not_a_robot_is_refused(tmp_path: Path) -> None:
    with pytest.raises(YamaroError) as error:
        Robot.from_xml("<sdf/>")
    assert [found.code for found in error.value.diagnostics] == ["not-urdf"]
    with pytest.raises(YamaroError, match="xml-syntax"):
        Robot.from_xml("<robot>")
    with pytest.raises(FileNotFoundError):
        Robot.from_urdf(tmp_path / "none.urdf")
    with pytest.raises(YamaroError, match="its root is 'launch'"):
        _ = build("-", text="launch:\n  node:\n").robot


def test_a_robot_in_a_file_has_the_places_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text('<robot name="r">\n  <link name="a"/>\n</robot>', encoding="utf-8")
    link = Robot.from_urdf(path).links["a"]
    assert link.span.place() == f"{path}:2:4"
    assert link.span.source.path == str(path)
    assert link.span_of("name").written() == "a"


# --- robots that are built --------------------------------------------------------------------

BALLS = """\
functions:
  Ball:
    input: at
    body:
      part:
        name: ball_$(at)
        joint: {type: fixed, parent: base}
        link:
          geometry: sphere
          scale: 0.1
          visual:
model:
- link/name=base:
- Ball: {at: 1}
- Ball: {at: 2}
"""


def test_a_shape_tells_the_line_and_the_call_that_made_it(tmp_path: Path) -> None:
    robot = build(tmp_path / "robot.yaml", text=BALLS).robot
    found = list(robot.visuals())
    assert [shown.span.location()[0] for _, shown in found] == [11, 11]
    calls = [shown.trace_in(link) for link, shown in found]
    assert [trace.span.location()[0] if trace else None for trace in calls] == [14, 15]


@pytest.mark.parametrize(
    "example", ["arm/arm.yaml", "hexapod/hexapod.yaml", "quadruped/quadruped.yaml"]
)
def test_the_robot_tells_the_same_places_as_the_tree(example: str) -> None:
    path = Path(__file__).parents[2] / "examples" / example
    built = build(path, on_message=lambda line: None)
    elements = [e for e in built.root.elements() if e.name in ("link", "joint")]
    expected = [(e.attributes["name"], e.span.place(), e.trace) for e in elements]
    robot = built.robot
    found: list[Link | Joint] = [*robot.all_links, *robot.all_joints]
    places = {id(each.element): (each.name, each.span.place(), each.trace) for each in found}
    in_order = [places[id(e)] for e in robot.element.elements() if id(e) in places]
    assert in_order == expected


def test_a_robot_that_left_a_jail_is_the_same(tmp_path: Path) -> None:
    pytest.importorskip("yamaro.sandbox.jail")
    path = tmp_path / "robot.yaml"
    path.write_text(BALLS, encoding="utf-8")
    plain = build(path).robot
    confined = build(path, policy=yamaro.Policy("safe")).robot
    assert list(confined.links) == list(plain.links) == ["base", "ball_1_link", "ball_2_link"]
    assert confined.pose("ball_2_link") == plain.pose("ball_2_link") == Pose()


def test_what_stands_in_several_links_is_one_object() -> None:
    robot = Robot.from_xml('<robot name="r"><link name="a"><visual/></link></robot>')
    link = robot.links["a"].element
    other = Element("link", link.span, {"name": "b"}, link.children)
    twice = read_robot(robot.element.with_children([link, other]))
    assert list(twice.links) == ["a", "b"]
    assert twice.links["a"].visuals[0] is twice.links["b"].visuals[0]
    assert len(twice.findings) == 1


@pytest.mark.parametrize(
    ("kind", "name", "said"),
    [
        ("joints", "j2", "the robot has no joint 'j2'; did you mean 'j2_joint'?"),
        ("joints", "j2_jont", "the robot has no joint 'j2_jont'; did you mean 'j2_joint'?"),
        ("links", "base", "the robot has no link 'base'; did you mean 'base_link'?"),
        ("links", "far away", "the robot has no link 'far away'"),
        ("states", "hme", "the robot has no state 'hme'; did you mean 'home'?"),
        ("sensors", "lidr", "the robot has no sensor 'lidr'; did you mean 'lidar'?"),
        ("actuators", "j2", "the robot has no actuator 'j2'; did you mean 'j2_joint'?"),
        ("frames", "tol", "the robot has no frame 'tol'; did you mean 'tool_link'?"),
        ("materials", "stel", "the robot has no material 'stel'; did you mean 'steel'?"),
    ],
)
def test_the_key_error_of_a_name_suggests_another(
    tmp_path: Path, kind: str, name: str, said: str
) -> None:
    (tmp_path / "arm.yaml").write_text(ARM_OF_PARTS)
    things = getattr(build(tmp_path / "arm.yaml").robot, kind)
    with pytest.raises(KeyError) as caught:
        things[name]
    assert caught.value.args == (said,)
    assert things.get(name) is None
    assert name not in things
    assert pickle.loads(pickle.dumps(things)).keys() == things.keys()


def test_the_key_error_knows_how_a_robot_names_its_joints(tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(
        "robot: r\nnaming: {joint: j_*}\nmodel:\n- part: {name: a}\n"
        "- part: {name: b, joint: {type: fixed, parent: a}}\n"
    )
    robot = build(tmp_path / "arm.yaml").robot
    with pytest.raises(KeyError, match="did you mean 'j_b'"):
        robot.joints["b"]
