"""Robots that nobody should write are drawn, or refused, but never end in a fault."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.effort import tried
from tests.later import Later
from tests.picture.drawing import needs_drawing, picture, pixels

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

pytestmark = needs_drawing


def link(geometry: str, more: str = "") -> str:
    return f'<link name="a">{more}<visual><geometry>{geometry}</geometry></visual></link>'


ODD = {
    "a box without size": link('<box size="0 0 0"/>'),
    "a flat box": link('<box size="1 1 0"/>'),
    "a box turned inside out": link('<box size="-1 1 1"/>'),
    "an endless box": link('<box size="inf 1 1"/>'),
    "a box beyond all numbers": link('<box size="1e300 1e300 1e300"/>'),
    "a box too small to see": link('<box size="1e-300 1e-300 1e-300"/>'),
    "a ball of no size": link('<sphere radius="0"/>'),
    "a cylinder of no length": link('<cylinder radius="1" length="0"/>'),
    "a capsule of nothing": link("<capsule/>"),
    "no number": link('<box size="a b c"/>'),
    "a mesh scaled to nothing": link('<mesh filename="box.stl" scale="0 0 0"/>'),
    "a mesh without triangles": link('<mesh filename="empty.obj"/>'),
    "a mesh without a name": link('<mesh filename=""/>'),
    "far away": link('<box size="1 1 1"/>').replace(
        "<geometry>", '<origin xyz="1e9 1e9 1e9"/><geometry>'
    ),
    "farther than floats reach": link('<box size="1 1 1"/>').replace(
        "<geometry>", '<origin xyz="1e200 0 0"/><geometry>'
    ),
    "a mass of nothing": link('<box size="1 1 1"/>', "<inertial/>"),
    "moments of no body": link(
        '<box size="1 1 1"/>',
        '<inertial><mass value="1"/><inertia ixx="1" ixy="5" ixz="5" iyy="0" iyz="5" izz="0"/>'
        "</inertial>",
    ),
    "endless moments": link(
        '<box size="1 1 1"/>',
        '<inertial><mass value="1e-300"/><inertia ixx="1e300" ixy="0" ixz="0" iyy="1e300" iyz="0"'
        ' izz="1e300"/></inertial>',
    ),
    "two links of one name": link('<box size="1 1 1"/>') * 2,
    "a joint to itself": link('<box size="1 1 1"/>')
    + '<joint name="j" type="revolute"><parent link="a"/><child link="a"/></joint>',
}


@pytest.mark.parametrize("name", tried(ODD, str, quick=4, usual=2))
def test_an_odd_robot_is_drawn(name: str, tmp_path: Path) -> None:
    trimesh.creation.box().export(tmp_path / "box.stl")
    (tmp_path / "empty.obj").write_text("v 0 0 0\n")
    path = picture(tmp_path, ODD[name], "--show", "visual,inertia,frames,grid")
    assert pixels(path).shape == (90, 120, 4)


@pytest.mark.parametrize("size", [1e-4, 1e4])
def test_a_tiny_or_huge_robot_looks_like_one_of_a_metre(size: float, tmp_path: Path) -> None:
    def drawn(edge: float) -> np.ndarray:
        box = f'<box size="{edge} {edge / 2} {edge / 3}"/>'
        return pixels(picture(tmp_path, link(box), "--show", "visual,grid"))

    assert abs(drawn(size) - drawn(1.0)).mean() < 3
