"""What is in a picture: pixel by pixel, the robot that was written."""

import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.effort import sample
from tests.later import Later
from tests.picture.drawing import (
    SIZE,
    box_of,
    draw,
    frames,
    like,
    needs_drawing,
    picture,
    pixels,
)
from tests.waiting import PATIENCE
from yamaro.commands.main import main

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

pytestmark = needs_drawing

RED = '<material name="red"><color rgba="1 0 0 1"/></material>'
BLUE = '<material name="blue"><color rgba="0 0.1 1 1"/></material>'
BALL = '<geometry><sphere radius="0.1"/></geometry>'


def link(content: str, name: str = "a") -> str:
    return f'<link name="{name}">{content}</link>'


def visual(geometry: str, more: str = "", at: str = "0 0 0") -> str:
    return f'<visual><origin xyz="{at}"/><geometry>{geometry}</geometry>{more}</visual>'


def two_balls(kind: str = "revolute", more: str = "") -> str:
    """Return a red ball at the origin, and a blue one at the end of an arm along z."""
    blue = visual('<sphere radius="0.1"/>', BLUE, at="0 0 1")
    return (
        link(visual('<sphere radius="0.1"/>', RED))
        + link(blue, "b")
        + f'<joint name="swing" type="{kind}"><parent link="a"/><child link="b"/>'
        f'<axis xyz="1 0 0"/><limit lower="-1" upper="1.5" effort="1" velocity="1"/>{more}</joint>'
    )


def test_the_robot_is_in_the_middle_and_the_background_is_white(tmp_path: Path) -> None:
    image = pixels(picture(tmp_path, link(visual('<box size="1 1 1"/>', RED))))
    assert image.shape == (90, 120, 4)
    assert (image[0, 0] == 255).all()
    left, top, right, bottom = box_of(like(image, 255, 0, 0))
    assert abs((left + right) / 2 - 60) <= 2
    assert abs((top + bottom) / 2 - 45) <= 2
    assert bottom - top > 70


def test_a_front_view_has_the_shape_of_a_box_in_proportion(tmp_path: Path) -> None:
    content = link(visual('<box size="0.3 2 1"/>', RED))
    views = {"front": 2.0, "top": 2 / 0.3, "left": 0.3}
    for view, proportion in views.items():
        image = pixels(picture(tmp_path, content, "--view", view, "--size", "300x300"))
        left, top, right, bottom = box_of(like(image, 255, 0, 0))
        assert (right - left) / (bottom - top) == pytest.approx(proportion, rel=0.06), view


def test_views_look_from_where_their_names_say(tmp_path: Path) -> None:
    ahead = visual('<sphere radius="0.1"/>', RED, at="1 0 0.5")
    to_the_left = visual('<sphere radius="0.1"/>', BLUE, at="0 1 0")
    content = link(visual('<sphere radius="0.1"/>') + ahead + to_the_left)

    def middles(view: str) -> tuple[np.ndarray, np.ndarray]:
        image = pixels(picture(tmp_path, content, "--view", view))
        red, blue = box_of(like(image, 255, 0, 0)), box_of(like(image, 0, 25, 255))
        return np.array([red[0] + red[2], red[1] + red[3]]) / 2, np.array(
            [blue[0] + blue[2], blue[1] + blue[3]]
        ) / 2

    red, blue = middles("top")
    assert red[1] < blue[1], "what is ahead is above"
    assert blue[0] < red[0], "what is on the left is on the left"
    red, blue = middles("front")
    assert blue[0] > red[0], "the robot's left is on the right of who looks at it"
    red, blue = middles("back")
    assert blue[0] < red[0]
    red, blue = middles("left")
    assert red[0] < blue[0], "from its left, a robot looks to the left"
    red, blue = middles("90,0")
    assert red[0] < blue[0], "an azimuth of 90 degrees is its left"


@pytest.mark.parametrize("color", [(1, 0.5, 0), (0, 0.7, 0.2), (0.1, 0.2, 0.9), (1, 1, 0)])
def test_a_shape_has_the_colour_it_is_given(
    color: tuple[float, float, float], tmp_path: Path
) -> None:
    rgba = " ".join(map(str, color))
    material = f'<material name="m"><color rgba="{rgba} 1"/></material>'
    image = pixels(picture(tmp_path, link(visual('<sphere radius="1"/>', material))))
    wanted = tuple(round(255 * part) for part in color)
    assert like(image, *wanted).sum() > 0.8 * np.pi * 35**2


def test_a_translucent_shape_shows_what_is_behind(tmp_path: Path) -> None:
    veil = '<material name="veil"><color rgba="0 0.1 1 0.3"/></material>'
    behind = visual('<sphere radius="0.2"/>', RED)
    image = pixels(
        picture(tmp_path, link(behind + visual('<sphere radius="1"/>', veil)), "--view", "front")
    )
    red, _, blue, _ = image[45, 60]
    assert red > 80
    assert blue > 30


@pytest.mark.parametrize("kind", ["cylinder", "capsule"])
def test_a_cylinder_and_a_capsule_stand_along_z(kind: str, tmp_path: Path) -> None:
    shape = f'<{kind} radius="0.2" length="1"/>'
    image = pixels(
        picture(tmp_path, link(visual(shape, RED)), "--view", "front", "--size", "200x200")
    )
    left, top, right, bottom = box_of(like(image, 255, 0, 0))
    height = {"cylinder": 1.0, "capsule": 1.4}[kind]
    assert (bottom - top) / (right - left) == pytest.approx(height / 0.4, rel=0.06)


def test_a_joint_position_moves_what_hangs_on_it(tmp_path: Path) -> None:
    def blue_ball(*options: str) -> tuple[float, float]:
        image = pixels(picture(tmp_path, two_balls(), "--view", "front", *options))
        red, blue = box_of(like(image, 255, 0, 0)), box_of(like(image, 0, 25, 255))
        return blue[0] - red[0], blue[1] - red[1]

    across, down = blue_ball()
    assert abs(across) <= 1
    assert down < -50, "it is above"
    across, down = blue_ball("--joints", "swing=-1.5708")
    assert across > 50, "about x by -90 degrees it goes to the left, from the front to the right"
    assert abs(down) <= 1


def test_a_mimic_joint_follows(tmp_path: Path) -> None:
    green = '<material name="green"><color rgba="0 0.8 0 1"/></material>'
    follower = (
        link(visual('<sphere radius="0.1"/>', green, at="0 0 -1"), "c")
        + '<joint name="follow" type="revolute"><parent link="a"/><child link="c"/>'
        '<axis xyz="1 0 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/>'
        '<mimic joint="swing"/></joint>'
    )
    content = two_balls() + follower
    image = pixels(picture(tmp_path, content, "--view", "front", "--joints", "swing=1.5708"))
    blue, lime = box_of(like(image, 0, 25, 255)), box_of(like(image, 0, 204, 0))
    assert abs(blue[1] - lime[1]) <= 1
    assert lime[0] > blue[0] + 50


def test_collision_is_shown_only_when_asked(tmp_path: Path) -> None:
    content = link(
        visual('<sphere radius="0.2"/>', RED)
        + '<collision><geometry><box size="1 1 1"/></geometry></collision>'
    )
    _, top, _, bottom = box_of(like(pixels(picture(tmp_path, content)), 255, 0, 0))
    assert bottom - top > 70
    image = pixels(picture(tmp_path, content, "--show", "collision"))
    assert not like(image, 255, 0, 0).any()
    assert (image[45, 60, :3] < 240).any()


def test_collision_stands_in_for_a_visual_that_is_not_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content = link('<collision><geometry><box size="1 1 1"/></geometry></collision>')
    image = pixels(picture(tmp_path, content))
    assert (image[45, 60, :3] < 240).any()
    assert "no visual shapes; its collision shapes are shown" in capsys.readouterr().err


def test_collision_shapes_are_shown_with_how_close_they_are_to_their_meshes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("scipy")
    triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "m.obj").write_text(triangle)
    section = "{geometry: m.obj, mass: 1, visual: , collision: {fit: box, cover: true}}"
    (tmp_path / "r.yaml").write_text(f"robot: r\nmodel:\n- part: {{name: base, link: {section}}}\n")
    command = ["picture", str(tmp_path / "r.yaml"), "-o", str(tmp_path / "r.png")]
    assert main([*command, "--show", "visual,collision"]) == 0
    assert "'base_link', fit: box, cover: true: at most " in capsys.readouterr().err
    assert main(command) == 0
    assert capsys.readouterr().err == ""


def test_frames_have_red_green_and_blue_axes(tmp_path: Path) -> None:
    image = pixels(picture(tmp_path, two_balls(), "--show", "frames", "--size", "300x300"))
    for color in ((219, 41, 48), (46, 158, 61), (41, 92, 219)):
        assert like(image, *color).sum() > 10, color


@pytest.mark.slow
def test_inertia_shows_a_box_of_the_size_of_the_body(tmp_path: Path) -> None:
    """For a solid box of 2 kg and edges 0.2, 0.4 and 1 m the moments are m/12·(b² + c²)."""
    moments = 'ixx="0.193333" iyy="0.173333" izz="0.033333" ixy="0" ixz="0" iyz="0"'
    inertial = f'<inertial><mass value="2"/><inertia {moments}/></inertial>'
    content = link(inertial + visual('<box size="0.2 0.4 1"/>'))
    options = ("--view", "front", "--size", "300x300")
    weighing = pixels(picture(tmp_path, content, "--show", "inertia", *options))
    solid = pixels(picture(tmp_path, content, *options))
    found, expected = (box_of(np.any(image[..., :3] < 245, axis=2)) for image in (weighing, solid))
    # The shadow on the floor is seen from the side, as nothing.
    np.testing.assert_allclose(found, expected, atol=2)


@pytest.mark.slow
def test_a_grid_lies_on_the_floor(tmp_path: Path) -> None:
    content = link(visual('<sphere radius="0.1"/>', RED))
    plain, with_grid = (
        pixels(picture(tmp_path, content, "--size", "300x300", "--show", show))
        for show in ("visual", "visual,grid")
    )
    corner = (slice(0, 300), slice(0, 40))
    assert (with_grid[corner] != plain[corner]).any()


def test_a_transparent_picture_is_clear_around_the_robot_and_solid_in_it(tmp_path: Path) -> None:
    image = pixels(picture(tmp_path, link(visual('<sphere radius="1"/>', RED)), "--transparent"))
    assert image[0, 0, 3] == 0
    assert image[45, 60, 3] == 255
    assert like(image, 255, 0, 0)[45, 60]
    assert 0 < (image[..., 3] == 0).mean() < 0.9


@pytest.mark.slow
def test_several_views_make_a_sheet(tmp_path: Path) -> None:
    content = link(visual('<sphere radius="1"/>', RED))
    for views, shape in (("iso,top", (90, 240)), ("iso,front,top", (180, 240))):
        image = pixels(picture(tmp_path, content, "--view", views))
        assert image.shape[:2] == shape
        assert like(image[:90, :120], 255, 0, 0).any()
        assert like(image[:90, 120:], 255, 0, 0).any()
    assert (image[90:, 120:] == 255).all(), "the fourth of three is blank"
    again = pixels(picture(tmp_path, content, *("--view", "iso"), *("--view", "top")))
    assert again.shape[:2] == (90, 240)


def test_flat_views_of_a_sheet_have_one_scale(tmp_path: Path) -> None:
    content = link(visual('<box size="0.2 2 0.2"/>', RED))
    image = pixels(picture(tmp_path, content, "--view", "front,left", "--size", "200x200"))
    front, left = (
        box_of(like(image[:, part], 255, 0, 0)) for part in (slice(200), slice(200, 400))
    )
    assert left[3] - left[1] == pytest.approx(front[3] - front[1], abs=1)


# --- meshes -----------------------------------------------------------------------------------


def mesh_visual(name: str, more: str = "", material: str = RED) -> str:
    return link(visual(f'<mesh filename="{name}" {more}/>', material))


FORMATS = ["stl", "stl_ascii", "obj", "dae", "glb", "ply"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", sample(FORMATS, every=3))
def test_each_format_of_meshes_is_drawn_like_the_box_it_holds(kind: str, tmp_path: Path) -> None:
    name = f"box.{kind.removesuffix('_ascii')}"
    trimesh.creation.box(extents=(0.4, 1, 0.6)).export(tmp_path / name, file_type=kind)
    options = ("--size", "200x150", "--transparent")
    drawn = pixels(picture(tmp_path, mesh_visual(name), *options))
    solid = pixels(picture(tmp_path, link(visual('<box size="0.4 1 0.6"/>', RED)), *options))
    assert abs(drawn[..., 3] - solid[..., 3]).mean() < 1


def test_a_mesh_is_scaled_and_may_be_mirrored(tmp_path: Path) -> None:
    trimesh.creation.box(extents=(400, 1000, 600)).export(tmp_path / "box.stl")
    mesh = mesh_visual("box.stl", 'scale="0.001 -0.001 0.001"')
    drawn = pixels(picture(tmp_path, mesh))
    solid = pixels(picture(tmp_path, link(visual('<box size="0.4 1 0.6"/>', RED))))
    assert abs(drawn - solid).mean() < 1.5


DAE_HEAD = '<unit name="millimeter" meter="0.001"/><up_axis>Y_UP</up_axis>'


def test_the_unit_of_a_collada_file_counts_and_its_up_axis_does_not(tmp_path: Path) -> None:
    trimesh.creation.box(extents=(400, 1000, 600)).export(tmp_path / "box.dae")
    text = (tmp_path / "box.dae").read_text(encoding="utf-8")
    start, end = text.index("<asset>"), text.index("</asset>")
    (tmp_path / "box.dae").write_text(f"{text[:start]}<asset>{DAE_HEAD}{text[end:]}")
    ruler = visual('<box size="0.1 0.1 2"/>', BLUE, at="0 1 0")
    views = ("--view", "front", "--transparent")
    mesh = link(visual('<mesh filename="box.dae"/>', RED) + ruler)
    solid = link(visual('<box size="0.4 1 0.6"/>', RED) + ruler)
    drawn, expected = (pixels(picture(tmp_path, each, *views)) for each in (mesh, solid))
    assert abs(drawn[..., 3] - expected[..., 3]).mean() < 1


def green_ball(path: Path, kind: str) -> None:
    ball = trimesh.creation.icosphere(radius=0.5)
    green = [0, 200, 0, 255]
    if kind == "ply":
        ball.visual.vertex_colors = green
    elif kind == "obj":
        material = trimesh.visual.material.SimpleMaterial(diffuse=green)
        ball.visual = trimesh.visual.TextureVisuals(uv=ball.vertices[:, :2], material=material)
    else:
        material = trimesh.visual.material.PBRMaterial(baseColorFactor=green)
        ball.visual = trimesh.visual.TextureVisuals(material=material)
    ball.export(path)


@pytest.mark.parametrize("material", sample(["", RED, '<material name="nowhere"/>'], every=3))
@pytest.mark.parametrize("kind", ["glb", "dae", "obj", "ply"])
def test_a_mesh_was_painted_over_where_rviz_shows_its_own_colours(
    kind: str, material: str, tmp_path: Path
) -> None:
    green_ball(tmp_path / f"ball.{kind}", kind)
    image = pixels(picture(tmp_path, mesh_visual(f"ball.{kind}", material=material)))
    assert like(image, 0, 200, 0)[45, 60]


@pytest.mark.parametrize("kind", ["stl", "obj", "ply"])
def test_a_mesh_without_colours_has_that_of_the_robot(kind: str, tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(radius=0.5)
    options = {"include_texture": False, "include_color": False} if kind == "obj" else {}
    ball.export(tmp_path / f"ball.{kind}", **options)
    assert like(pixels(picture(tmp_path, mesh_visual(f"ball.{kind}"))), 255, 0, 0)[45, 60]


def textured(folder: Path, image: str) -> None:
    """Write an OBJ of a square that faces x, with an image on it."""
    folder.mkdir(exist_ok=True)
    (folder / "square.obj").write_text(
        "mtllib square.mtl\nv 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 1 0 0\n"
        "usemtl m\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n"
    )
    (folder / "square.mtl").write_text(f"newmtl m\nKd 1 1 1\nmap_Kd {image}\n")


def test_a_texture_is_drawn_the_right_way_up(tmp_path: Path) -> None:
    import PIL.Image

    stripes = np.zeros((16, 16, 3), np.uint8)
    stripes[:8] = (230, 20, 20)
    stripes[8:] = (20, 20, 230)
    PIL.Image.fromarray(stripes).save(tmp_path / "stripes.png")
    textured(tmp_path, "stripes.png")
    image = pixels(picture(tmp_path, mesh_visual("square.obj", material=""), "--view", "front"))
    assert like(image, 230, 20, 20)[30, 60]
    assert like(image, 20, 20, 230)[60, 60]


def test_a_texture_that_is_not_an_image_is_a_warning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    textured(tmp_path, "stripes.png")
    (tmp_path / "stripes.png").write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n")
    picture(tmp_path, mesh_visual("square.obj", material=""), "--view", "front")
    error = capsys.readouterr().err
    without = "is drawn without a texture: the texture 'stripes.png' has no format that is read"
    assert error.count("warning[bad-mesh]: the mesh 'square.obj' of ") == 1
    assert without in error and " --> " in error


def test_a_texture_outside_of_the_robots_folders_is_not_read(tmp_path: Path) -> None:
    import PIL.Image

    secret = np.full((16, 16, 3), (230, 20, 20), np.uint8)
    PIL.Image.fromarray(secret).save(tmp_path / "secret.png")
    folder = tmp_path / "robot"
    textured(folder, "../secret.png")
    options = ("--view", "front")
    safe = pixels(picture(folder, mesh_visual("square.obj", material=""), *options))
    trusted = pixels(picture(folder, mesh_visual("square.obj", material=""), "--trust", *options))
    assert like(trusted, 230, 20, 20)[45, 60]
    assert not like(safe, 230, 20, 20).any()


def test_a_missing_mesh_is_a_box_and_a_warning(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content = link(
        visual('<sphere radius="0.2"/>', BLUE) + visual('<mesh filename="no.stl"/>', at="0 1 0")
    )
    image = pixels(picture(tmp_path, content, "--view", "front"))
    error = capsys.readouterr().err
    assert error.count("warning[missing-mesh-file]") == 1
    assert f"searched for {tmp_path / 'no.stl'}" in error
    left, top, right, bottom = box_of(like(image, 235, 130, 120))  # it is seen through
    assert right - left == pytest.approx(bottom - top, abs=2)


@pytest.mark.parametrize(
    ("name", "code", "said"),
    [
        ("broken.stl", "bad-mesh", "it is not a valid STL file"),
        ("broken.dae", "bad-mesh", "it is not a valid COLLADA file"),
        ("part.step", "bad-mesh", "no reader for '.step' files"),
        ("https://example.org/a.stl", "missing-mesh-file", "is not found"),
        ("model://nowhere/a.stl", "missing-mesh-file", "is not found"),
    ],
)
def test_a_mesh_that_cannot_be_drawn_is_a_box_and_a_warning(
    name: str, code: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if "://" not in name:
        (tmp_path / name).write_bytes(b"\x00\x01 nothing")
    image = pixels(picture(tmp_path, mesh_visual(name)))
    error = capsys.readouterr().err
    assert f"warning[{code}]" in error
    assert said in error
    assert f"robot.urdf:1:{error.partition('robot.urdf:1:')[2].split()[0]}" in error
    assert like(image, 230, 76, 64).any()


def test_a_mesh_that_cannot_be_drawn_is_an_error_with_strict(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "broken.stl").write_bytes(b"\x00\x01 nothing")
    source = tmp_path / "robot.urdf"
    source.write_text(f'<robot name="r">{mesh_visual("broken.stl")}</robot>')
    assert main(["picture", "--strict", str(source), "-o", str(tmp_path / "out.png")]) == 1
    assert "error[bad-mesh]" in capsys.readouterr().err
    assert not (tmp_path / "out.png").exists()


# --- films ------------------------------------------------------------------------------------


def test_a_turn_shows_the_robot_from_all_sides(tmp_path: Path) -> None:
    content = link(
        visual('<box size="1 0.2 0.2"/>') + visual('<sphere radius="0.2"/>', RED, at="0.6 0 0")
    )
    options = ("--turn", "--seconds", "0.4", "--view", "0,10")
    shots = frames(picture(tmp_path, content, *options, name="turn.gif"))
    assert len(shots) == 8, "20 a second"
    assert {shot.shape for shot in shots} == {(90, 120, 4)}
    assert all((shot[0, 0] == 255).all() for shot in shots), "on pure white"
    across = [np.nonzero(like(shot, 255, 0, 0))[1] for shot in shots]
    middles = [found.mean() if len(found) else None for found in across]
    assert middles[0] == pytest.approx(60, abs=2)
    assert middles[2] is not None
    assert middles[2] < 40, "a camera on its left has the front of the robot on the left"
    assert middles[6] is not None
    assert middles[6] > 80


def test_a_sweep_goes_to_both_limits_and_stays_in_the_picture(tmp_path: Path) -> None:
    options = ("--sweep", "swing", "--seconds", "0.4", "--view", "front")
    shots = frames(picture(tmp_path, two_balls(), *options, name="sweep.gif"))
    blue = [box_of(like(shot, 0, 25, 255)) for shot in shots]
    heights = [box[1] for box in blue]
    assert heights[0] == min(heights), "it begins upright"
    assert blue[2][0] < blue[0][0] < blue[6][0], "to the upper limit, then to the lower one"
    red = {box_of(like(shot, 255, 0, 0)) for shot in shots}
    assert len(red) == 1, "the camera stands still"
    for left, top, right, bottom in blue:
        assert 0 < left < right < 120
        assert 0 < top < bottom < 90


def test_a_film_is_as_long_as_asked_and_as_quick(tmp_path: Path) -> None:
    import PIL.Image

    options = ("--turn", "--seconds", "0.5", "--frames-per-second", "10")
    path = picture(tmp_path, two_balls(), *options, name="turn.gif")
    assert len(frames(path)) == 5
    with PIL.Image.open(path) as image:
        assert image.info["duration"] == 100


def test_a_transparent_film_has_nothing_left_of_the_frame_before(tmp_path: Path) -> None:
    options = ("--sweep", "all", "--seconds", "0.2", "--view", "front", "--transparent")
    shots = frames(picture(tmp_path, two_balls(), *options, name="sweep.gif"))
    for shot in shots:
        assert shot[0, 0, 3] == 0
        left, _, right, _ = box_of(like(shot, 0, 25, 255))
        assert right - left < 20


# --- files and errors -------------------------------------------------------------------------


def test_a_yaml_robot_is_drawn_with_its_variables(tmp_path: Path) -> None:
    source = tmp_path / "robot.yaml"
    source.write_text(
        "variables: {width: 1}\n"
        "model: {part: {name: a, link: {geometry: box, scale: '$([0.2, width, 0.5])', visual: }}}\n"
    )
    proportions = []
    for argument in ("width:=1", "width:=2"):
        path = draw(source, tmp_path / "out.png", "--view", "front", argument)
        left, top, right, bottom = box_of(np.any(pixels(path)[..., :3] < 240, axis=2))
        proportions.append((right - left) / (bottom - top))
    assert proportions == pytest.approx([2, 4], rel=0.15)


def test_a_picture_is_the_same_each_time(tmp_path: Path) -> None:
    first = picture(tmp_path, two_balls(), name="first.png").read_bytes()
    assert picture(tmp_path, two_balls(), name="second.png").read_bytes() == first


def test_a_failed_picture_leaves_the_old_file_as_it_was(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "out.png"
    output.write_bytes(b"old")
    source = tmp_path / "robot.urdf"
    source.write_text(f'<robot name="r">{two_balls()}</robot>')
    assert main(["picture", str(source), "-o", str(output), "--joints", "swnig=1"]) == 2
    assert "the robot has no joint 'swnig'; did you mean 'swing'?" in capsys.readouterr().err
    assert output.read_bytes() == b"old"


def test_a_robot_of_links_alone_is_drawn_as_frames(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    image = pixels(picture(tmp_path, link("")))
    assert "its frames are shown" in capsys.readouterr().err
    assert (image[..., :3] < 240).any()


def test_a_robot_without_links_is_a_white_picture(tmp_path: Path) -> None:
    source = tmp_path / "robot.urdf"
    source.write_text('<robot name="r"/>')
    image = pixels(draw(source, tmp_path / "out.png"))
    assert (image == 255).all()


def test_a_jpeg_is_opaque(tmp_path: Path) -> None:
    path = picture(tmp_path, two_balls(), name="out.jpg")
    assert path.read_bytes()[:3] == b"\xff\xd8\xff"
    assert pixels(path)[0, 0].min() > 250


def test_other_documents_are_not_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = tmp_path / "world.xml"
    source.write_text("<world/>")
    assert main(["picture", str(source), "-o", str(tmp_path / "out.png")]) == 2
    assert "needs a robot, but the root element is <world>" in capsys.readouterr().err


def test_without_opengl_it_is_said_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr("yamaro.picture.stage.EGL_LIBRARY", "libNone.so")
    monkeypatch.setattr("yamaro.picture.stage.SOFTWARE_LIBRARIES", ("libNone.so",))
    source = tmp_path / "robot.urdf"
    source.write_text(f'<robot name="r">{two_balls()}</robot>')
    assert main(["picture", str(source), "-o", str(tmp_path / "out.png")]) == 1
    error = capsys.readouterr().err
    code = "no-opengl"
    assert error.startswith(f"error[{code}]: nothing can be drawn here")
    assert "apt install libegl1 libgl1-mesa-dri" in error
    assert not (tmp_path / "out.png").exists()


def test_a_picture_on_standard_output_is_a_png_and_nothing_else(tmp_path: Path) -> None:
    source = tmp_path / "robot.yaml"
    part = "part: {name: a, link: {geometry: box, scale: 1 1 1, visual: }}"
    source.write_text(f"model: {{print: hello, {part}}}\n")
    command = [sys.executable, "-m", "yamaro", "picture", str(source), "-o", "-", "--size", SIZE]
    result = subprocess.run(command, capture_output=True, check=True, timeout=PATIENCE)
    assert result.stdout.startswith(b"\x89PNG")
    (tmp_path / "out.png").write_bytes(result.stdout)
    assert pixels(tmp_path / "out.png").shape == (90, 120, 4)
    assert b"hello" in result.stderr
