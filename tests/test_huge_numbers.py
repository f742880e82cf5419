"""Numbers that are hardly numbers any more end in a diagnostic or in a robot, never in a fault."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.later import Later
from yamaro.commands.main import main

if TYPE_CHECKING:
    import trimesh
else:
    trimesh = Later("trimesh")

NUMBERS = ["1e110", "1e200", "1e308", "1e-110", "1e-320", "inf", "nan", "-1e200", "0", "9" * 400]
SHAPES = [
    '<sphere radius="{0}"/>',
    '<box size="{0} {0} {0}"/>',
    '<cylinder radius="{0}" length="{0}"/>',
    '<capsule radius="{0}" length="{0}"/>',
    '<mesh filename="box.stl" scale="{0} {0} {0}"/>',
    '<mesh filename="huge.obj" scale="{0} 1 1"/>',
]
LINK = """\
<robot name="r"><link name="a"><inertial><mass value="{mass}"/>
<inertia ixx="{mass}" ixy="0" ixz="0" iyy="{mass}" iyz="0" izz="{mass}"/></inertial>
<visual><origin xyz="{0} 0 {0}" rpy="{0} 0 1"/><geometry>{shape}</geometry></visual>
<collision><geometry>{shape}</geometry></collision></link></robot>
"""
PART = """\
robot: r
model:
- part:
    name: a
    joint: {{type: fixed, parent: root_link, xyz: {0} 0 0}}
    link: {{geometry: {shape}, scale: {scale}, {mass}, visual: , collision: }}
"""
SCALES = {"sphere": 1, "box": 3, "cylinder": 2, "capsule": 2, "box.stl": 3, "huge.obj": 3}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    trimesh.creation.box().export(tmp_path / "box.stl")
    corners = "v 0 0 0\nv 1e160 0 0\nv 0 1e160 0\nv 0 0 1e160\n"
    (tmp_path / "huge.obj").write_text(corners + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    return tmp_path


def check_no_fault(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) in (0, 1)
    said = capsys.readouterr().err
    assert "internal error" not in said and "Warning:" not in said


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("shape", SHAPES)
def test_a_shape_of_any_size_in_a_urdf_is_looked_at(
    number: str, shape: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for mass in ("1", number):
        text = LINK.format(number, shape=shape.format(number), mass=mass)
        (folder / "r.urdf").write_text(text)
        check_no_fault(["check", "--trust", "r.urdf"], capsys)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("shape", SCALES)
def test_a_part_of_any_size_is_built_or_refused(
    number: str, shape: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for mass in ("mass: 1", f"density: {number}"):
        scale = " ".join([number] * SCALES[shape])
        (folder / "r.yaml").write_text(PART.format(number, shape=shape, scale=scale, mass=mass))
        check_no_fault(["r.yaml", "-o", "r.urdf"], capsys)
        check_no_fault(["check", "--trust", "r.yaml"], capsys)


def test_a_mesh_whose_volume_is_no_number_is_named(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = PART.format(0, shape="huge.obj", scale="1 1 1", mass="mass: 1")
    (folder / "r.yaml").write_text(text)
    assert main(["r.yaml", "-o", "r.urdf"]) == 1
    assert "error[bad-number]: the mesh 'huge.obj' is too large" in capsys.readouterr().err
