"""The page of `yamaro view`, as a person uses it: in a browser, by mouse and by sight."""

from __future__ import annotations

import json
import math
import random
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.consumers import oracles
from tests.tools.view.conftest import EXAMPLES, Page, Viewer
from tests.waiting import wait_for
from yamaro.picture.request import NAMED_VIEWS

Start = Callable[..., Viewer]

LAMP = """\
robot: lamp
variables:
  height: 0.4
  is_red: true
  label: plain
functions:
  Arm:
    input: name, side
    body:
      part:
        name: $(name)
        joint:
          type: revolute
          parent: base
          xyz: 0 $(side * 0.2) 0.05
          axis: 0 1 0
          limit: {lower: -1.2, upper: 0.8, effort: 5, velocity: 2}
        link:
          geometry: box
          scale: 0.06 0.06 $(height)
          pivot: 0 0 $(-height / 2)
          mass: 0.4
          visual:
            material: $("red" if is_red else "blue")
          collision:
model:
- material/name=red:
    color/rgba=0.9 0.05 0.05 1:
- material/name=blue:
    color/rgba=0.05 0.1 0.9 1:
- part:
    name: base
    joint: {type: fixed, parent: root_link}
    link:
      geometry: cylinder
      scale: 0.3 0.05
      mass: 2
      visual:
      collision:
- Arm: left, 1
- Arm: right, -1
"""
LINE_OF_LINK = LAMP.splitlines().index("        link:") + 1
LINE_OF_VISUAL = LAMP.splitlines().index("          visual:") + 1
LINE_OF_CALL = LAMP.splitlines().index("- Arm: right, -1") + 1


@pytest.fixture
def lamp(page: Page, view: Start, tmp_path: Path) -> Page:
    """The page with the lamp on it."""
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP, encoding="utf-8")
    page.show(view(path))
    return page


def reds(pixels: Any) -> int:
    """Count the pixels that are red, whatever the light."""
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(((red > 90) & (red > 2.2 * green) & (red > 2.2 * blue)).sum())


def blues(pixels: Any) -> int:
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(((blue > 90) & (blue > 1.8 * green) & (blue > 1.8 * red)).sum())


def center_of_reds(pixels: Any) -> tuple[float, float]:
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    rows, columns = np.nonzero((red > 90) & (red > 2.2 * green) & (red > 2.2 * blue))
    return float(columns.mean()), float(rows.mean())


def test_the_robot_is_seen_in_its_colours(lamp: Page) -> None:
    pixels = lamp.stage()
    assert reds(pixels) > 3000  # two arms
    lamp.press("#show-visual")
    assert reds(lamp.stage()) == 0


def test_a_slider_moves_the_robot_within_the_limits(lamp: Page) -> None:
    before = lamp.stage()
    slider = "#joints [data-joint=left_joint] input[type=range]"
    x, y = lamp.middle_of(slider)
    lamp.drag(x, y, right=400)  # far past its end
    lamp.wait_for("Math.abs(yamaro.robot.joints.get('left_joint').angle - 0.8) < 1e-9")
    moved = np.abs(lamp.stage() - before).sum(axis=2) > 60
    assert moved.sum() > 1000
    assert (
        lamp.run("document.querySelector('[data-joint=left_joint] input.number').value") == "45.8"
    )


def test_a_field_takes_degrees(lamp: Page) -> None:
    lamp.press("#joints [data-joint=right_joint] input.number")
    lamp.run("document.activeElement.select()")
    lamp.type("-30")
    lamp.run("document.activeElement.blur()")
    angle = lamp.run("yamaro.robot.joints.get('right_joint').angle")
    assert angle == pytest.approx(math.radians(-30))


def test_a_save_shows_the_new_robot_and_keeps_camera_joints_and_selection(lamp: Page) -> None:
    lamp.run("yamaro.setJoint('left_joint', 0.5)")
    lamp.press("#tree [data-link=right_link]")
    x, y = lamp.middle_of("#canvas")
    lamp.drag(x, y + 200, right=90)  # turn the camera
    camera = lamp.run("yamaro.stage.camera.matrixWorld.toArray()")
    before = lamp.stage()
    lamp.save(LAMP.replace("height: 0.4", "height: 0.6"))
    assert (np.abs(lamp.stage() - before).sum(axis=2) > 60).sum() > 500
    assert lamp.run("yamaro.robot.joints.get('left_joint').angle") == 0.5
    assert lamp.run("yamaro.stage.camera.matrixWorld.toArray()") == camera
    assert lamp.text("#origin-title") == "right_link"


def test_an_error_is_shown_over_the_last_good_robot_and_goes_away(lamp: Page) -> None:
    lamp.save(LAMP.replace("$(height)", "$(hieght)"))
    said = lamp.text("#fault")
    assert "error[undefined-name]: name 'hieght'" in said
    assert f"lamp.yaml:{LINE_OF_LINK + 2}:" in said and "$(hieght)" in said and "^^^^^^" in said
    assert "did you mean 'height'?" in said
    lamp.press("#fault-fold")
    assert reds(lamp.stage()) > 3000  # the robot as it was
    lamp.save(LAMP)
    assert lamp.text("#fault") == ""


def test_a_file_that_cannot_be_built_at_first_is_shown_once_it_can(
    page: Page, view: Start, tmp_path: Path
) -> None:
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP.replace("model:", "modle:"), encoding="utf-8")
    page.show(view(path))
    assert "did you mean `model`?" in page.text("#fault")
    page.save(LAMP)
    assert page.text("#fault") == "" and reds(page.stage()) > 3000


def test_a_file_that_is_missing_is_seen_when_it_appears(
    page: Page, view: Start, tmp_path: Path
) -> None:
    path = tmp_path / "lamp.yaml"
    path.write_text("robot: two\nmodel:\n  include: parts/more.yaml\n", encoding="utf-8")
    page.show(view(path))
    assert "parts/more.yaml" in page.text("#fault")
    (tmp_path / "parts").mkdir()
    page.save("model:\n  link/name=found:\n", name="parts/more.yaml")
    page.wait_for("Boolean(yamaro.robot?.links.has('found'))")
    assert page.text("#fault") == ""


def test_a_click_on_the_robot_tells_its_lines_and_calls(lamp: Page) -> None:
    pixels = lamp.stage()
    box = lamp.run(
        "(() => { const r = document.getElementById('canvas').getBoundingClientRect();"
        " return [r.x, r.y]; })()"
    )
    red = (pixels[..., 0] > 90) & (pixels[..., 0] > 2.2 * pixels[..., 1])
    rows, columns = np.nonzero(red)
    leftmost = int(columns.argmin())
    lamp.click(box[0] + int(columns[leftmost]) + 8, box[1] + int(rows[leftmost]))
    lamp.wait_for("!document.getElementById('origin').hidden")
    # The camera looks from the front right, so what is leftmost on the screen is on the right.
    assert lamp.text("#origin-title") == "right_link"
    assert lamp.text("#origin [data-kind=visual] .place") == f"lamp.yaml:{LINE_OF_VISUAL}"
    assert lamp.text("#origin [data-kind=link] .place") == f"lamp.yaml:{LINE_OF_LINK}"
    assert lamp.text("#origin-calls") == f"in Arm, called at lamp.yaml:{LINE_OF_CALL}"


def test_what_is_selected_opens_in_the_editor_at_its_line(
    page: Page, view: Start, tmp_path: Path
) -> None:
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP, encoding="utf-8")
    note = tmp_path / "opened"
    editor = tmp_path / "my-editor"
    editor.write_text(f'#!/bin/sh\necho "$@" > {note}.new && mv {note}.new {note}\n')
    editor.chmod(0o755)
    page.show(view(path, "--editor", f"{editor} {{file}} {{line}} {{column}}"))
    page.press("#tree [data-link=left_link]")
    assert page.text("#origin-open") == "Open in my-editor"
    page.press("#origin-open")
    wait_for(note.exists)
    assert note.read_text().split() == [str(path), str(LINE_OF_LINK), "9"]


def test_a_variable_is_changed_by_hand_and_the_file_is_not(lamp: Page) -> None:
    tall = "yamaro.robot.bounds().max.z"
    before = lamp.run(tall)
    lamp.press("#variables [data-variable=height] input.number")
    lamp.run("document.activeElement.select()")
    lamp.after(lambda: lamp.type("0.7"))
    assert lamp.run(tall) - before == pytest.approx(0.3, abs=1e-6)
    assert lamp.text("#assignments") == "height:=0.7"
    assert lamp.viewer.path.read_text(encoding="utf-8") == LAMP
    lamp.after(lambda: lamp.press("#variables [data-variable=height] .undo"))
    assert lamp.run(tall) == pytest.approx(before)


def test_arguments_have_sliders_in_their_range_and_menus_of_their_choices(
    page: Page, view: Start, tmp_path: Path
) -> None:
    entries = """\
arguments:
  height: {default: 40, unit: cm, range: [10, 90], step: 5, help: of an arm}
  gain: {default: 1, log: true, range: [0.01, 100]}
  paint: {default: "red", choices: ["red", "blue"]}
variables: {is_red: "$(paint == 'red')", label: plain}
"""
    path = tmp_path / "lamp.yaml"
    start, end = LAMP.index("variables:"), LAMP.index("functions:")
    path.write_text(LAMP[:start] + entries + LAMP[end:], encoding="utf-8")
    page.show(view(path))
    ends = "(e => [e.min, e.max, e.step])(document.querySelector({}))"
    slider = "#variables [data-variable={}] input[type=range]"
    assert page.run(ends.format(json.dumps(slider.format("height")))) == ["10", "90", "5"]
    least, most, _ = page.run(ends.format(json.dumps(slider.format("gain"))))
    assert [float(least), float(most)] == pytest.approx([math.log(0.01), math.log(100)])
    assert "cm" in page.text("#variables [data-variable=height] .name")
    before = page.run("yamaro.robot.bounds().max.z")
    x, y = page.middle_of(slider.format("height"))
    page.after(lambda: page.drag(x, y, right=400))  # far past its end
    assert page.run("yamaro.robot.bounds().max.z") - before == pytest.approx(0.5, abs=1e-6)
    choose = "(e => { e.value = '1'; e.dispatchEvent(new Event('change')); })"
    menu = "document.querySelector('#variables [data-variable=paint] select')"
    page.after(lambda: page.run(f"{choose}({menu})"))
    assert blues(page.stage()) > 3000
    assert page.text("#assignments") == "height:=90 paint:=blue"


def test_a_switch_sets_a_truth_value(lamp: Page) -> None:
    lamp.after(lambda: lamp.press("#variables [data-variable=is_red] .switch"))
    pixels = lamp.stage()
    assert reds(pixels) == 0 and blues(pixels) > 3000
    assert lamp.text("#assignments") == "is_red:=false"


def test_a_value_that_fails_is_shown_as_an_error_and_can_be_taken_back(lamp: Page) -> None:
    lamp.press("#variables [data-variable=height] input.number")
    lamp.run("document.activeElement.select()")
    lamp.after(lambda: lamp.type("-1"))
    assert "error[" in lamp.text("#fault")
    lamp.after(lambda: lamp.press("#variable-reset"))
    assert lamp.text("#fault") == ""


def test_a_field_keeps_its_value_while_the_file_has_an_error(lamp: Page) -> None:
    lamp.press("#variables [data-variable=height] input.number")
    lamp.run("document.activeElement.select()")
    lamp.after(lambda: lamp.type("0.7"))
    lamp.run("document.activeElement.blur()")
    lamp.save(LAMP.replace("model:", "model: [", 1))
    assert "error[" in lamp.text("#fault")
    lamp.save(LAMP)
    assert lamp.text("#fault") == "" and lamp.text("#assignments") == "height:=0.7"
    assert lamp.run("yamaro.robot.bounds().max.z") == pytest.approx(0.05 + 0.7)


@pytest.mark.slow
def test_a_default_that_is_changed_in_the_file_wins_over_the_field(lamp: Page) -> None:
    lamp.press("#variables [data-variable=height] input.number")
    lamp.run("document.activeElement.select()")
    lamp.after(lambda: lamp.type("0.7"))
    lamp.run("document.activeElement.blur()")
    lamp.save(LAMP.replace("height: 0.4", "height: 0.3"))
    assert lamp.run("document.querySelector('[data-variable=height] input.number').value") == "0.3"
    assert lamp.text("#assignments") == ""


def test_a_warning_leads_to_its_link(page: Page, view: Start, tmp_path: Path) -> None:
    text = LAMP.replace(
        "          collision:\nmodel",
        "          collision:\n            geometry: meshes/$(name).stl\nmodel",
    )
    path = tmp_path / "lamp.yaml"
    path.write_text(text, encoding="utf-8")
    page.show(view(path))
    assert "'meshes/left.stl' of link 'left_link' does not exist" in page.text("#warnings")
    page.press("#warnings .title")
    assert page.text("#origin-title") == "left_link"
    assert f"searched for {tmp_path / 'meshes' / 'left.stl'}" in page.text("#warnings .more")
    assert page.run("yamaro.robot.highlighted.selected") == "left_link"
    boxes = "yamaro.robot.shapes.filter(s => s.group.getObjectByName('missing')).map(s => s.kind)"
    assert page.run(boxes) == ["collision", "collision"]


def test_the_search_finds_links_and_joints(lamp: Page) -> None:
    rows = "[...document.querySelectorAll('#tree .row:not([hidden])')].map(r => r.dataset.link)"
    assert lamp.run(rows) == ["root_link", "base_link", "left_link", "right_link"]
    lamp.run(
        "(() => { const s = document.getElementById('tree-search'); s.hidden = false;"
        " s.value = 'RIGHT_jo'; s.dispatchEvent(new Event('input')); })()"
    )
    assert lamp.run(rows) == ["right_link"]


def test_switches_show_collision_inertia_frames_and_axes(lamp: Page) -> None:
    lamp.press("#show-visual")
    empty = lamp.stage()
    for kind in ("collision", "inertia", "frames", "axes"):
        lamp.press(f"#show-{kind}")
        seen = np.abs(lamp.stage() - empty).sum(axis=2) > 40
        assert seen.sum() > 100, kind
        lamp.press(f"#show-{kind}")
        assert np.abs(lamp.stage() - empty).max() == 0, kind


def test_a_box_is_its_own_box_of_equal_inertia(lamp: Page) -> None:
    # The inertia of a homogeneous box a × b × c about its centre, turned by a random rotation.
    generator = np.random.default_rng(7)
    for _ in range(20):
        mass, sides = generator.uniform(0.1, 5), generator.uniform(0.01, 2, 3)
        a, b, c = sides
        moments = mass / 12 * np.array([b * b + c * c, a * a + c * c, a * a + b * b])
        turn, _ = np.linalg.qr(generator.normal(size=(3, 3)))
        tensor = turn @ np.diag(moments) @ turn.T
        entries = [tensor[i, j] for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))]
        box = lamp.run(f"yamaro.equivalentBox({mass!r}, {json.dumps(list(map(float, entries)))})")
        assert sorted(box["size"]) == pytest.approx(sorted(sides), rel=1e-6)
        axes = np.array(box["axes"])
        assert np.linalg.det(axes) == pytest.approx(1)
        for side, axis in zip(box["size"], axes, strict=True):
            own = turn[:, np.abs(sides - side).argmin()]
            assert abs(axis @ own) == pytest.approx(1, abs=1e-6)
    assert lamp.run("yamaro.equivalentBox(1, [1, 0, 0, 1, 0, 3])") is None  # no body has that


# --- positions, against another program ---------------------------------------------------------

EVERY_JOINT = """\
<robot name="every">
  <link name="base"/> <link name="a"/> <link name="b"/> <link name="c"/> <link name="d"/>
  <link name="e"/>
  <joint name="slide" type="prismatic">
    <parent link="base"/> <child link="a"/> <origin xyz="0.1 0.2 0.3" rpy="0.4 -0.5 0.6"/>
    <axis xyz="0.6 0 0.8"/> <limit lower="-0.5" upper="0.7" effort="1" velocity="1"/>
  </joint>
  <joint name="turn" type="revolute">
    <parent link="a"/> <child link="b"/> <origin xyz="0 -0.2 0.1" rpy="-1 0.2 2"/>
    <axis xyz=" 0 0.8 -0.6"/> <limit lower="-2" upper="1.5" effort="1" velocity="1"/>
  </joint>
  <joint name="roll" type="continuous">
    <parent link="b"/> <child link="c"/> <origin xyz="0.3 0 0"/> <axis xyz="0 0 -1"/>
  </joint>
  <joint name="stay" type="fixed">
    <parent link="c"/> <child link="d"/> <origin rpy="0.7 0 -0.3" xyz="0 0 1"/>
  </joint>
  <joint name="follow" type="revolute">
    <parent link="c"/> <child link="e"/> <origin xyz="0 0.4 0"/> <axis xyz="1 0 0"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="turn" multiplier="-1.5" offset="0.25"/>
  </joint>
</robot>
"""


@pytest.mark.slow
def test_links_stand_where_another_program_puts_them(
    page: Page, view: Start, tmp_path: Path
) -> None:
    """Five robots, one after another in the same file, at random joint positions."""
    for name in ("arm", "hexapod", "quadruped", "pan_tilt"):
        shutil.copytree(EXAMPLES / name, tmp_path / name)
    (tmp_path / "every.urdf").write_text(EVERY_JOINT, encoding="utf-8")
    names = (
        "arm/arm.yaml",
        "hexapod/hexapod.yaml",
        "quadruped/quadruped.yaml",
        "pan_tilt/pan_tilt.yaml",
    )
    for index, path in enumerate([tmp_path / name for name in names] + [tmp_path / "every.urdf"]):
        page.show(view(path))
        urdf = page.run("yamaro.robot.description.urdf")
        judge = oracles.load_yourdfpy(urdf, path.parent)
        chance = random.Random(index)
        wanted = {}
        for name, joint in judge.joint_map.items():
            if joint.type != "fixed" and joint.mimic is None:
                limits = joint.limit if joint.type != "continuous" else None
                lower, upper = (limits.lower, limits.upper) if limits else (-3.0, 3.0)
                wanted[name] = chance.uniform(lower, upper)
        assert wanted
        page.run(f"Object.entries({json.dumps(wanted)}).forEach(([n, v]) => yamaro.setJoint(n, v))")
        judge.update_cfg(wanted)
        for link in judge.link_map:
            here = np.array(page.run(f"yamaro.pose({link!r})")).reshape(4, 4)
            assert here == pytest.approx(judge.get_transform(link), abs=1e-6), (path, link)


@pytest.mark.slow
def test_joints_of_several_degrees_of_freedom_move_in_their_own_frame(
    page: Page, view: Start, tmp_path: Path
) -> None:
    joint = (
        '<joint name="{0}" type="{0}"><parent link="base"/><child link="{0}_link"/>'
        '<origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>{1}</joint><link name="{0}_link"/>'
    )
    flat, free = joint.format("planar", '<axis xyz="0 0 1"/>'), joint.format("floating", "")
    path = tmp_path / "loose.urdf"
    path.write_text(f'<robot name="loose"><link name="base"/>{flat}{free}</robot>')
    page.show(view(path))
    page.run("yamaro.setJoint('planar', 0.3, 0.1, 0)")
    page.run("yamaro.setJoint('floating', 0.3, 0.1, 0.2, 0, 0, 1.5707963267948966)")
    planar = np.array(page.run("yamaro.pose('planar_link')")).reshape(4, 4)
    floating = np.array(page.run("yamaro.pose('floating_link')")).reshape(4, 4)
    # Turned by 90° about z, x of the joint is y of its parent, and y is -x.
    assert planar[:3, 3] == pytest.approx([1 - 0.1, 2 + 0.3, 3])
    assert floating[:3, 3] == pytest.approx([1 - 0.1, 2 + 0.3, 3 + 0.2])
    assert floating[:3, :3] == pytest.approx(np.diag([-1.0, -1.0, 1.0]), abs=1e-9)  # 180° in all


# --- other files --------------------------------------------------------------------------------


def test_a_urdf_opens_and_clicks_lead_to_its_lines(page: Page, view: Start, tmp_path: Path) -> None:
    path = tmp_path / "every.urdf"
    path.write_text(EVERY_JOINT, encoding="utf-8")
    page.show(view(path))
    page.press("#tree [data-link=c]")
    assert page.text("#origin [data-kind=joint] .place") == "every.urdf:12"
    assert page.text("#variables-pane") == ""


def test_a_link_says_how_good_the_shapes_are_that_were_worked_out(
    page: Page, view: Start, tmp_path: Path
) -> None:
    # A box around the half box x + y + z < 1 has six times its volume; its corner is 2/√3 away.
    faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "corner.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + faces)
    path = tmp_path / "robot.yaml"
    path.write_text(
        "robot: r\nmodel:\n- part: {name: a, link: {geometry: corner.obj, visual: , "
        "collision: {fit: box, cover: true}}}\n",
        encoding="utf-8",
    )
    page.show(view(path))
    page.press("#tree [data-link=a_link]")
    told = page.text("#origin-fits")
    assert told.startswith("fit: box, cover: true: at most 1.15e+03 mm from the mesh")
    assert told.endswith("500 % more volume")


def test_a_xacro_file_opens_with_its_arguments_as_fields(
    page: Page, view: Start, tmp_path: Path
) -> None:
    path = tmp_path / "post.urdf.xacro"
    path.write_text(
        '<robot name="post" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <xacro:arg name="height" default="0.5"/>\n'
        '  <xacro:macro name="post" params="name">\n'
        '    <link name="${name}">\n'
        '      <visual><geometry><box size="0.1 0.1 $(arg height)"/></geometry></visual>\n'
        "    </link>\n"
        "  </xacro:macro>\n"
        '  <xacro:post name="one"/>\n'
        "</robot>\n",
        encoding="utf-8",
    )
    page.show(view(path))
    page.press("#tree [data-link=one]")
    assert page.text("#origin [data-kind=link] .place") == "post.urdf.xacro:4"
    assert "called at post.urdf.xacro:8" in page.text("#origin-calls")
    page.press("#variables [data-variable=height] input.number")
    page.run("document.activeElement.select()")
    page.after(lambda: page.type("0.9"))
    assert page.run("yamaro.robot.bounds().max.z") == pytest.approx(0.45)


def test_meshes_of_each_format_are_seen(page: Page, view: Start, tmp_path: Path) -> None:
    write_meshes(tmp_path)
    names = sorted(path.name for path in tmp_path.iterdir() if path.suffix in MESH_ENDINGS)
    path = tmp_path / "meshes.yaml"
    parts = "".join(
        f"- link/name={name.replace('.', '_')}:\n"
        f"    visual:\n      geometry:\n        mesh/filename={name}:\n"
        f"- joint/name={name}, type=fixed:\n"
        f"    parent/link=base:\n    child/link={name.replace('.', '_')}:\n"
        for name in names
    )
    path.write_text(f"robot: meshes\nmodel:\n- link/name=base:\n{parts}", encoding="utf-8")
    page.show(view(path))
    sizes = page.run(
        "yamaro.robot.shapes.map(s => { const b = new yamaro.stage.Box3().setFromObject(s.group);"
        " return [s.link, ...b.max.toArray().map((v, i) => v - b.min.toArray()[i])]; })"
    )
    assert [name for name, *_ in sizes] == [name.replace(".", "_") for name in names]
    for name, *sides in sizes:
        assert sides == pytest.approx([0.2, 0.4, 0.6], abs=1e-5), name
    page.run("yamaro.robot.shapes.forEach(s => { s.group.visible = s.link === 'textured_obj' })")
    assert reds(page.stage()) > 1000  # the texture of the OBJ's material


MESH_ENDINGS = (".stl", ".dae", ".obj", ".gltf", ".glb")


def write_meshes(folder: Path) -> None:
    """Write a box of 0.2 × 0.4 × 0.6 m in each format; the COLLADA file is in cm, with y up."""
    trimesh = oracles.require_module("trimesh")
    image = pytest.importorskip("PIL.Image").new("RGB", (4, 4), (230, 10, 10))
    box = trimesh.creation.box([0.2, 0.4, 0.6])
    for name in ("plain.stl", "plain.obj", "plain.glb", "plain.dae"):
        box.export(folder / name)
    textured = box.copy()
    material = trimesh.visual.material.SimpleMaterial(image=image, diffuse=[255, 255, 255, 255])
    textured.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)) + 0.5, material=material)
    textured.export(folder / "textured.obj")
    textured.export(folder / "textured.glb")
    for name, data in trimesh.exchange.gltf.export_gltf(trimesh.Scene([box])).items():
        (folder / name.replace("model.", "apart.")).write_bytes(data)
    big = box.copy()
    big.apply_scale(100)
    text = trimesh.exchange.dae.export_collada(big).decode()
    text = text.replace("<up_axis>Y_UP</up_axis>", "").replace(
        "</asset>", '<unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>'
    )
    (folder / "centimetres.dae").write_text(text, encoding="utf-8")


def test_names_that_javascript_objects_have_are_names_like_others(
    page: Page, view: Start, tmp_path: Path
) -> None:
    names = ["__proto__", "constructor", "toString", "hasOwnProperty", "valueOf", "length"]
    links = "".join(
        f'<link name="{name}"><visual><geometry><sphere radius="0.1"/></geometry>'
        f'<material name="{name}"/></visual></link>'
        for name in ["base", *names]
    )
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{name}"/>'
        f'<axis xyz="0 0 1"/><mimic joint="{names[0] if name != names[0] else "nobody"}"/></joint>'
        for parent, name in zip(["base", *names], names, strict=False)
    )
    odd = '<link name="odd"/><joint name="odd" type="constructor"><parent link="base"/>'
    odd += '<child link="odd"/></joint>'
    path = tmp_path / "names.urdf"
    path.write_text(f'<robot name="r">{links}{joints}{odd}</robot>', encoding="utf-8")
    page.show(view(path))
    rows = "[...document.querySelectorAll('#tree .row')].map(r => r.dataset.link)"
    assert sorted(page.run(rows)) == sorted(["base", "odd", *names])
    assert sorted(page.run("[...yamaro.robot.joints.keys()]")) == sorted(["odd", *names])
    assert page.run("yamaro.robot.shapes.length") == len(names) + 1
    page.press("#tree [data-link=__proto__]")
    assert page.text("#origin [data-kind=joint] .what") == "__proto__"
    page.run("yamaro.setJoint('__proto__', 1)")
    assert page.run("yamaro.robot.joints.get('valueOf').angle") == 1  # which mimics it
    assert page.run("({}).polluted === undefined && Object.keys(Object.prototype).length") == 0


def test_a_robot_in_ruins_is_shown_as_far_as_it_goes(
    page: Page, view: Start, tmp_path: Path
) -> None:
    """Loops, joints that lead nowhere, rings of mimics: what people have while they write."""
    joints = "".join(
        f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
        f'<limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="{model}"/></joint>'
        for name, parent, child, model in (
            ("one", "a", "b", "two"),
            ("two", "b", "c", "one"),
            ("loop", "c", "b", "nobody"),
            ("nowhere", "c", "gone", "one"),
            ("second", "d", "e", "one"),
        )
    )
    links = "".join(
        f'<link name="{name}"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>'
        for name in "abcdef"
    )
    path = tmp_path / "ruin.urdf"
    path.write_text(f'<robot name="ruin">{links}{joints}</robot>', encoding="utf-8")
    page.show(view(path))
    assert page.run("yamaro.robot.shapes.length") == 6
    assert sorted(page.run("yamaro.robot.dropped")) == ["loop", "nowhere"]
    assert page.text("#warnings-pane") != "" or page.text("#fault") != ""


@pytest.mark.slow
def test_robots_that_are_gone_leave_nothing_on_the_graphics_card(lamp: Page) -> None:
    held = (
        "[yamaro.stage.renderer.info.memory.geometries, yamaro.stage.renderer.info.memory.textures]"
    )
    lamp.run(
        "['collision', 'inertia', 'frames', 'axes'].forEach(kind =>"
        " document.getElementById(`show-${kind}`).click())"
    )
    lamp.press("#tree [data-link=left_link]")
    found = []
    for height in (0.5, 0.6, 0.7, 0.8):
        lamp.save(LAMP.replace("height: 0.4", f"height: {height}"))
        lamp.stage()
        found.append(lamp.run(held))
    assert found[0] == found[-1], found


@pytest.mark.slow
def test_the_page_fits_a_narrow_window(lamp: Page) -> None:
    lamp.resize(460, 860)
    try:
        assert lamp.run("document.documentElement.scrollWidth") <= 460
        lamp.press("#tabs [data-pane=tree]")
        lamp.wait_for("document.getElementById('tree').innerText.includes('left_link')")
        assert lamp.text("#joints") == ""
        lamp.press("#tabs [data-pane=variables]")
        assert "height" in lamp.text("#variables")
        assert reds(lamp.stage()) > 1000
    finally:
        lamp.resize(900, 600)


def test_the_page_says_when_yamaro_has_ended(browser: Page, view: Start, tmp_path: Path) -> None:
    path = tmp_path / "lamp.yaml"
    path.write_text(LAMP, encoding="utf-8")
    viewer = view(path)
    browser.show(viewer)
    assert viewer.end() == 0
    browser.wait_for("!document.getElementById('lost').hidden")
    browser.open("about:blank")
    browser.complaints.clear()  # of the connection that is refused


def test_a_robot_stands_and_is_seen_as_in_a_picture(
    page: Page, view: Start, tmp_path: Path
) -> None:
    """The page stood at the nearest limit, and looked from the other side."""
    joints = {"free": (-1, 1), "above": (0.5, 1.5), "below": (-0.75, -0.25)}
    body = "".join(
        f'<joint name="{name}" type="revolute"><parent link="base"/><child link="{name}_link"/>'
        f'<limit lower="{lower}" upper="{upper}" effort="1" velocity="1"/></joint>'
        f'<link name="{name}_link"/>'
        for name, (lower, upper) in joints.items()
    )
    path = tmp_path / "arm.urdf"
    path.write_text(f'<robot name="arm"><link name="base"/>{body}</robot>')
    page.show(view(path))
    found = {name: page.run(f"yamaro.robot.joints.get('{name}').angle") for name in joints}
    assert found == pytest.approx({"free": 0, "above": 1, "below": -0.5})
    x, y, z = page.run("yamaro.stage.camera.position.clone().sub(yamaro.stage.controls.target)"
                       ".normalize().toArray()")  # fmt: skip
    azimuth, elevation = NAMED_VIEWS["iso"]
    assert math.degrees(math.atan2(y, x)) == pytest.approx(azimuth, abs=1)
    assert math.degrees(math.asin(z)) == pytest.approx(elevation, abs=1)


def test_a_mesh_that_places_a_body_too_often_is_not_given_to_the_page(
    page: Page, view: Start, tmp_path: Path
) -> None:
    nodes = "".join(
        f'<node id="n{i}">' + f'<instance_node url="#n{i - 1}"/>' * 10 + "</node>"
        for i in range(1, 9)
    )
    (tmp_path / "bomb.dae").write_text(
        f'<COLLADA><library_nodes><node id="n0"/>{nodes}</library_nodes></COLLADA>'
    )
    path = tmp_path / "r.urdf"
    path.write_text(
        '<robot name="r"><link name="a"><visual><geometry><mesh filename="bomb.dae"/></geometry>'
        "</visual></link></robot>"
    )
    page.show(view(path))
    page.wait_for("document.body.innerText.includes('more than 10,000 bodies')")
