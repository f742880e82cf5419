"""What a scene holds of a robot: shapes, materials, masses, and where they were written."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.scene.robots import robot_of
from yamaro import build
from yamaro.tools.scene.robot import Robot, Shape

MATERIALS = '<material name="red"><color rgba="1 0 0 0.5"/></material><material name="none"/>'


def shapes_of(content: str, folder: Path) -> list[Shape]:
    text = f'<robot name="r">{MATERIALS}<link name="a">{content}</link></robot>'
    return list(robot_of(text, folder).shapes())


def visual(geometry: str, more: str = "") -> str:
    return f"<visual>{more}<geometry>{geometry}</geometry></visual>"


def test_each_kind_of_shape_has_its_size(tmp_path: Path) -> None:
    found = shapes_of(
        visual('<box size="1 2 3"/>')
        + visual('<cylinder radius="0.5" length="2"/>')
        + visual('<sphere radius="0.25"/>')
        + visual('<capsule radius="0.5" length="4"/>')
        + visual('<mesh filename="a.stl" scale="1 -2 3"/>')
        + visual('<mesh filename="a.stl"/>'),
        tmp_path,
    )
    assert [(shape.kind, shape.size) for shape in found] == [
        ("box", (1, 2, 3)),
        ("cylinder", (0.5, 2)),
        ("sphere", (0.25,)),
        ("capsule", (0.5, 4)),
        ("mesh", (1, -2, 3)),
        ("mesh", (1, 1, 1)),
    ]


def test_a_shape_stands_where_its_origin_says(tmp_path: Path) -> None:
    origin = '<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>'
    (shape,) = shapes_of(visual('<sphere radius="1"/>', origin), tmp_path)
    matrix = np.array(shape.pose.matrix())
    turned = Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix()
    np.testing.assert_allclose(matrix[:3, :3], turned, atol=1e-12)
    np.testing.assert_allclose(matrix[:, 3], [1, 2, 3, 1])


def test_an_origin_may_be_a_quaternion(tmp_path: Path) -> None:
    quaternion = [0.1, -0.2, 0.3, 0.4]
    origin = f'<origin quat_xyzw="{" ".join(map(str, quaternion))}"/>'
    (shape,) = shapes_of(visual('<sphere radius="1"/>', origin), tmp_path)
    expected = Rotation.from_quat(quaternion).as_matrix()
    np.testing.assert_allclose(shape.pose.rotation, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("material", "color"),
    [
        ("", None),
        ('<material name="red"/>', (1, 0, 0, 0.5)),
        ('<material name="none"/>', None),
        ('<material name="own"><color rgba="0 1 0 1"/></material>', (0, 1, 0, 1)),
        ('<material name=""><color rgba="0 0 1 1"/></material>', (0, 0, 1, 1)),
        ('<material name="red"><color rgba="0 1 0 1"/></material>', (1, 0, 0, 0.5)),
        ('<material name="wild"><color rgba="7 -1 0 1"/></material>', (1, 0, 0, 1)),
        ('<material name="short"><color rgba="1 1"/></material>', None),
    ],
)
def test_a_visual_has_the_colour_that_its_material_means(
    material: str, color: tuple[float, ...] | None, tmp_path: Path
) -> None:
    (shape,) = shapes_of(visual('<sphere radius="1"/>', material), tmp_path)
    assert shape.color == color


def test_a_material_that_one_visual_defines_serves_another(tmp_path: Path) -> None:
    defined = '<material name="blue"><color rgba="0 0 1 1"/></material>'
    first, second = shapes_of(
        visual('<sphere radius="1"/>', '<material name="blue"/>')
        + visual('<sphere radius="1"/>', defined),
        tmp_path,
    )
    assert first.color == second.color == (0, 0, 1, 1)


def test_a_collision_is_no_visual(tmp_path: Path) -> None:
    (shape,) = shapes_of(
        '<collision><geometry><sphere radius="1"/></geometry></collision>', tmp_path
    )
    assert not shape.is_visual
    assert shape.color is None


def test_a_mesh_has_its_file_or_none(tmp_path: Path) -> None:
    (tmp_path / "there.stl").write_bytes(b"")
    there, away = shapes_of(
        visual('<mesh filename="there.stl"/>') + visual('<mesh filename="away.stl"/>'), tmp_path
    )
    assert there.path == str(tmp_path / "there.stl")
    assert away.path is None


def test_a_link_has_its_mass_and_moments(tmp_path: Path) -> None:
    inertial = (
        '<inertial><origin xyz="1 0 0"/><mass value="2"/>'
        '<inertia ixx="1" ixy="2" ixz="3" iyy="4" iyz="5" izz="6"/></inertial>'
    )
    robot = robot_of(f'<robot name="r"><link name="a">{inertial}</link></robot>', tmp_path)
    found = robot.links["a"].inertial
    assert found is not None
    assert (found.mass, found.moments) == (2.0, (1, 2, 3, 4, 5, 6))
    assert found.pose.position == (1, 0, 0)


def test_what_is_half_written_takes_defaults(tmp_path: Path) -> None:
    text = (
        '<robot><link/><link name="a"><visual/><visual><geometry/></visual>'
        '<visual><geometry><box size="1 x 3"/></geometry></visual><inertial/></link>'
        '<joint/><joint name="j" type="revolute"><axis xyz="0 0 0"/><limit/></joint></robot>'
    )
    robot = robot_of(text, tmp_path)
    assert [shape.size for shape in robot.shapes()] == [(0, 0, 0)]
    assert robot.joints["j"].axis == (1, 0, 0)


def test_a_shape_tells_the_line_and_the_call_that_made_it(tmp_path: Path) -> None:
    text = """\
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
    built = build(tmp_path / "robot.yaml", text=text)
    robot = Robot(built.root, built.finder)
    first, second = robot.shapes()
    assert first.element.span.location()[0] == 11
    calls = [shape.element.trace for shape in (first, second)]
    assert [trace.span.location()[0] if trace else None for trace in calls] == [14, 15]
