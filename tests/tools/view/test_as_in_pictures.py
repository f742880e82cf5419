"""The page of `yamaro view` shows a robot as `yamaro picture` draws it: camera, pose, colours."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.consumers import oracles
from tests.picture.drawing import require_drawing
from tests.tools.view.conftest import EXAMPLES, Page
from tests.tools.view.test_page import Start
from yamaro import Policy, build
from yamaro.confined import Reader
from yamaro.picture.request import Request

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # VTK's, of its own

# By link, the colours of its visual bodies as the page has them, each from 0 to 1.
COLORS = """
(() => {
  const found = {};
  for (const { kind, link, group } of yamaro.robot.shapes) {
    if (kind !== "visual") continue;
    group.traverse((node) => {
      if (!node.isMesh || node.isLineSegments2) return;
      const { r, g, b } = node.material.color.clone().getRGB({}, "srgb");
      (found[link] ??= []).push([r, g, b, node.material.opacity]);
    });
  }
  return found;
})()
"""


def drawing_of(path: Path) -> Any:
    """Return what `yamaro picture` makes of a robot."""
    require_drawing()
    from yamaro.picture.draw import Drawing

    request = Request("out.png", {}, {})
    return Drawing(build(path), request, Reader(Policy("trusted"), readable=[], name=str(path)))


def colors_in(drawing: Any) -> dict[str, list[list[float]]]:
    found: dict[str, list[list[float]]] = {}
    for body in drawing._figure._bodies:
        look = body.actor.GetProperty()
        found.setdefault(body.link, []).append([*look.GetColor(), look.GetOpacity()])
    return found


def check_colors(page: Page, drawing: Any) -> None:
    here, there = page.run(COLORS), colors_in(drawing)
    assert sorted(here) == sorted(there) and here
    for link, colors in there.items():
        assert np.array(sorted(here[link])) == pytest.approx(np.array(sorted(colors)), abs=2e-3), (
            link
        )


@pytest.mark.parametrize(
    "name",
    [
        "quadruped/quadruped.yaml",
        "hand/hand.yaml",
        "pan_tilt/pan_tilt.yaml",
        pytest.param("hexapod/hexapod.yaml", marks=pytest.mark.slow),
        pytest.param("humanoid/humanoid.yaml", marks=pytest.mark.slow),
        pytest.param("mobile_manipulator/mobile_manipulator.yaml", marks=pytest.mark.slow),
    ],
)
def test_an_example_is_shown_as_in_its_picture(
    page: Page, view: Start, tmp_path: Path, name: str
) -> None:
    shutil.copytree(EXAMPLES, tmp_path / "examples")  # some include files of others
    path = tmp_path / "examples" / name
    drawing = drawing_of(path)
    from yamaro.model.positions import home_positions
    from yamaro.picture.request import NAMED_VIEWS, View
    from yamaro.picture.stage import VIEW_ANGLE, fitted

    page.show(view(path, "--trust"))
    page.run("yamaro.stage.drawNow()")
    positions = home_positions(drawing._robot)
    wanted = {joint.name: positions[joint.name] for joint in drawing._robot.free_joints()}
    found = page.run(
        "Object.fromEntries([...yamaro.robot.joints.values()].map(j => [j.name, j.jointValue[0]]))"
    )
    assert {joint: found[joint] for joint in wanted} == pytest.approx(wanted)
    check_colors(page, drawing)

    camera = page.run(
        "(({camera, controls}) => ({position: camera.position.toArray(), fov: camera.fov,"
        " target: controls.target.toArray(), aspect: camera.aspect}))(yamaro.stage)"
    )
    view_wanted = View(*NAMED_VIEWS["iso"], is_flat=False)
    taken = fitted(view_wanted, drawing.outline(), camera["aspect"])
    assert camera["fov"] == VIEW_ANGLE
    distance = float(np.linalg.norm(taken.position - taken.target))
    assert camera["target"] == pytest.approx(taken.target, abs=0.01 * distance)
    assert camera["position"] == pytest.approx(taken.position, abs=0.02 * distance)
    here = np.array(camera["position"]) - camera["target"]
    there = (taken.position - taken.target) / distance
    assert here / np.linalg.norm(here) == pytest.approx(there, abs=1e-6)


def test_meshes_have_the_colours_that_they_have_in_pictures(
    page: Page, view: Start, tmp_path: Path
) -> None:
    """Colours of a file go before the robot's; a file without any takes the robot's."""
    trimesh = oracles.require_module("trimesh")
    box = trimesh.creation.box([0.2, 0.4, 0.6])
    box.export(tmp_path / "plain.stl")
    box.export(tmp_path / "plain.obj")
    painted = box.copy()
    painted.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.PBRMaterial(baseColorFactor=[200, 60, 20, 255])
    )
    painted.export(tmp_path / "painted.glb")
    (tmp_path / "painted.mtl").write_text("newmtl paint\nKd 0.2 0.4 0.8\n")
    text = (tmp_path / "plain.obj").read_text()
    faces = text.index("\nf ") + 1
    (tmp_path / "painted.obj").write_text(
        f"mtllib painted.mtl\n{text[:faces]}usemtl paint\n{text[faces:]}"
    )
    painted.visual = trimesh.visual.ColorVisuals(painted, vertex_colors=[30, 160, 90, 255])
    painted.visual = trimesh.visual.TextureVisuals(
        material=trimesh.visual.material.SimpleMaterial(diffuse=[30, 160, 90, 255])
    )
    painted.export(tmp_path / "painted.dae")
    names = ("plain.stl", "plain.obj", "painted.glb", "painted.obj", "painted.dae")
    body = "".join(
        f'<joint name="{name}" type="fixed"><parent link="base"/><child link="{name}"/>'
        f'<origin xyz="0 {index} 0"/></joint><link name="{name}"><visual><geometry>'
        f'<mesh filename="{name}"/></geometry><material name="m"><color rgba="0.9 0.1 0.5 1"/>'
        "</material></visual></link>"
        for index, name in enumerate(names)
    )
    path = tmp_path / "meshes.urdf"
    path.write_text(f'<robot name="meshes"><link name="base"/>{body}</robot>')
    page.show(view(path))
    check_colors(page, drawing_of(path))


def test_colours_of_corners_go_before_the_material(page: Page, view: Start, tmp_path: Path) -> None:
    lines = [f"v {x} {y} 0 0.1 0.8 0.2" for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    (tmp_path / "corners.obj").write_text("\n".join([*lines, "f 1 2 3", "f 1 3 4", ""]))
    path = tmp_path / "corners.urdf"
    path.write_text(
        '<robot name="r"><link name="a"><visual><geometry><mesh filename="corners.obj"/></geometry>'
        '<material name="m"><color rgba="1 0 0 1"/></material></visual></link></robot>'
    )
    page.show(view(path))
    page.press("[data-view=top]")
    pixels = page.stage()
    rows, columns = pixels.shape[0] // 2, pixels.shape[1] // 2
    here = pixels[rows - 40 : rows + 40, columns - 40 : columns + 40].mean(axis=(0, 1))
    (body,) = drawing_of(path)._figure._bodies
    corners = body.actor.GetMapper().GetInput().GetPointData().GetScalars()
    assert np.array(corners.GetTuple(0))[:3] == pytest.approx([25, 204, 51], abs=1)
    assert here[1] > 1.5 * max(here[0], here[2])  # green, and not red
