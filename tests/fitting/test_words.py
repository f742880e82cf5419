"""`fit` in parts, and `yamaro fit`: outputs, bad meshes, several runs, other formats."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from tests.effort import is_tried
from tests.fitting.solids import noisy
from tests.waiting import PATIENCE
from yamaro import YamaroError, build
from yamaro.commands.main import main
from yamaro.meshes.encoding import obj_of_triangles, stl_of
from yamaro.model.robot import Robot
from yamaro.model.shapes import Mesh, Shape
from yamaro.policy import JAIL, SAFE, Policy

ROBOT = """\
robot: arm
model:
- part:
    name: base
    link: {geometry: arm.stl, mass: 1, inertial: {inertia: 1 0 0 1 0 1},
      collision: {fit: FIT, surface: {friction: 0.5}}}
"""
URDF = """\
<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision name="shell">
      <origin xyz="0 0 1" rpy="0 1.5707963267949 0"/>
      <geometry><mesh filename="arm.stl" scale="2 2 2"/></geometry>
    </collision>
  </link>
  <joint name="j" type="continuous">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
  </joint>
</robot>
"""


def shapes_in(robot: Robot, link: str) -> list[Shape]:
    """Return the shapes that a link collides with."""
    return [each.shape for each in robot.links[link].collisions if each.shape is not None]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("YAMARO_CACHE", str(tmp_path / "cache"))
    mesh, pose = noisy("capsule", [0.05, 0.3], 1, 0.0)
    mesh.vertices = [pose.inverse().apply(point) for point in mesh.vertices]
    Path("arm.stl").write_bytes(stl_of(mesh))
    Path("arm.obj").write_bytes(obj_of_triangles(mesh))
    Path("arm.urdf").write_text(URDF, encoding="utf-8")


def test_every_run_gives_the_same_bytes(tmp_path: Path) -> None:
    Path("r.yaml").write_text(ROBOT.replace("FIT", "capsule"), encoding="utf-8")
    cold = build("r.yaml").xml()
    assert [*Path("cache").iterdir()]
    assert build("r.yaml").xml() == cold
    for mode in (SAFE, JAIL):
        assert build("r.yaml", policy=Policy(mode)).xml() == cold
    command = [sys.executable, "-m", "yamaro", "r.yaml"]
    environment = {**os.environ, "YAMARO_CACHE": "off", "PYTHONHASHSEED": "7"}
    alone = subprocess.run(
        command, capture_output=True, text=True, timeout=PATIENCE, env=environment, check=True
    )
    assert alone.stdout == cold


def test_work_on_several_shapes_says_how_far_it_is() -> None:
    rows = [f"    - collision: {{geometry: arm.stl, scale: {n}, fit: box}}" for n in (1, 2, 3, 4)]
    head = ["robot: r", "model:", "- part:", "    name: base", "    link:"]
    Path("r.yaml").write_text("\n".join([*head, *rows]), encoding="utf-8")
    parts_done: list[float] = []
    build("r.yaml", on_progress=parts_done.append)
    assert parts_done == [0, 0.25, 0.5, 0.75, 1]


def test_a_capsule_is_a_cylinder_and_two_spheres_in_urdf_1_0_alone() -> None:
    Path("r.yaml").write_text(ROBOT.replace("FIT", "capsule"), encoding="utf-8")
    outputs = build("r.yaml", target=["mjcf", "urdf", "sdf"], base="fixed", meshes="none").outputs
    kinds = [each.kind for each in shapes_in(outputs["urdf"].robot, "base_link")]
    assert kinds == ["cylinder", "sphere", "sphere"]
    assert [each.index for each in outputs["urdf"].robot.surfaces] == [0, 1, 2]
    assert outputs["mjcf"].xml().count('type="capsule"') == 1
    assert outputs["sdf"].xml().count("<capsule>") == 1
    text = ROBOT.replace("robot: arm", "robot/name=arm, version=1.1:").replace("model:\n", "")
    Path("new.yaml").write_text(text.replace("FIT", "capsule"), encoding="utf-8")
    assert build("new.yaml").xml().count("<capsule") == 1


BAD = {
    "empty": (b"", "not a valid STL"),
    "no triangles": (bytes(84), "has no triangles"),
    "not a number": (
        bytes(80) + struct.pack("<I12f2x", 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, float("nan"), 1, 0),
        "not a finite number",
    ),
    "one point": (bytes(80) + struct.pack("<I12f2x", 1, *[0.0] * 12), "at one point"),
    "a line": (
        bytes(80) + struct.pack("<I12f2x", 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0),
        "have no area",
    ),
    "texture only": (b"mtllib a.mtl\nvt 0 0\nvt 1 1\n", "has no triangles"),
    "light years": (
        bytes(80) + struct.pack("<I12f2x", 1, 0, 0, 0, 0, 0, 0, 1e30, 0, 0, 0, 1e30, 0),
        "needs its 'scale'",
    ),
    "no scene": (
        (
            b'<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
            b"<asset/><library_geometries/></COLLADA>"
        ),
        "missing, such as its scene",
    ),
    "corner that is not there": (b"v 0 0 0\nv 1 0 0\nf 1 2 3\n", "cannot be read"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_mesh_without_a_surface_is_an_error_at_its_name(name: str) -> None:
    data, reason = BAD[name]
    Path("arm.stl").write_bytes(data)
    Path("r.yaml").write_text(ROBOT.replace("FIT", "best"), encoding="utf-8")
    for policy in (Policy(), Policy(SAFE)):
        with pytest.raises(YamaroError) as caught:
            build("r.yaml", policy=policy)
        (error,) = caught.value.diagnostics
        assert error.code == "bad-mesh"
        assert reason in error.message
        assert error.span.written() == "arm.stl"


STRANGE = {
    "one triangle": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "flat": b"v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4\n",
    "open": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n",
    "inside out": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n",
    "corners twice": b"v 0 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 1\n"
    b"f 1 4 3\nf 2 3 5\nf 1 6 4\nf 3 4 5\nf 1 2 3\n",
    "twice": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + 2 * b"f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    "both sides": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    b"f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n",
    "in millimetres": b"v 0 0 0\nv 900 0 0\nv 0 300 0\nv 0 0 200\n"
    b"f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
}


WORDS = ("collision: {fit: hull}", "collision: {decompose: 4}",
         "collision: {spheres: 4, cover: true}", "visual: {triangles: 4}")  # fmt: skip


@pytest.mark.parametrize("word", WORDS)
@pytest.mark.parametrize("name", [*BAD, *STRANGE])
def test_each_word_has_an_answer_for_each_bad_mesh(name: str, word: str) -> None:
    """Flat meshes have no hull and no pieces; a volume that is written twice counts once."""
    if not is_tried(f"{name} {word}", quick=8, usual=3):
        return
    data, reason = BAD.get(name, (b"", ""))
    Path("arm.stl").write_bytes(data or STRANGE.get(name, b""))
    link = "{geometry: arm.stl, mass: 1, inertial: {inertia: 1 0 0 1 0 1}, WORD}"
    robot = f"robot: arm\nmodel:\n- part: {{name: base, link: {link}}}\n".replace("WORD", word)
    Path("r.yaml").write_text(robot, encoding="utf-8")
    if name in ("one triangle", "flat", "a line") and ("hull" in word or "decompose" in word):
        reason = "flat" if name != "a line" else "area"
        reason = "flat" if "hull" in word else reason
    if not reason:
        (fit,) = build("r.yaml", policy=Policy(SAFE)).robot.fits
        assert 1 <= fit.count <= 4
        assert fit.excess is None or fit.excess > -1e-6
        return
    with pytest.raises(YamaroError) as caught:
        build("r.yaml", policy=Policy(SAFE))
    (error,) = caught.value.diagnostics
    assert (error.code, error.span.written()) == ("bad-mesh", "arm.stl")
    assert reason in error.message


@pytest.mark.parametrize("kind", ["box", "cylinder", "capsule", "sphere"])
@pytest.mark.parametrize("name", STRANGE)
def test_other_meshes_get_a_shape_with_a_size(name: str, kind: str) -> None:
    Path("arm.stl").write_bytes(STRANGE[name])
    robot = ROBOT.replace("FIT", f"{kind}, cover: true")
    Path("r.yaml").write_text(robot, encoding="utf-8")
    found = build("r.yaml", policy=Policy(SAFE)).robot
    (fit,) = found.fits
    assert fit.covers
    assert (fit.excess is None) == (name in ("one triangle", "flat", "open"))
    for shape in shapes_in(found, "base_link"):
        assert min(shape.size) > 0


def test_yamaro_fit_writes_the_robot_and_says_how_good_the_shapes_are(
    capfd: pytest.CaptureFixture[str],
) -> None:
    before = Path("arm.urdf").read_bytes()
    assert main(["fit", "arm.urdf", "-o", "out/arm.urdf", "--shape", "capsule", "--cover"]) == 0
    said = capfd.readouterr().err
    assert "arm.stl" in said
    assert "capsule" in said
    robot = build("out/arm.urdf").robot
    cylinder, *ends = robot.links["arm"].collisions
    assert [each.name for each in (cylinder, *ends)] == ["shell", "shell_2", "shell_3"]
    assert shapes_in(robot, "arm")[0].size == pytest.approx((0.1, 0.6), rel=0.01)
    assert cylinder.pose.position == pytest.approx((0, 0, 1), abs=1e-4)
    assert abs(cylinder.pose.rotation[0][2]) == pytest.approx(1)
    assert Path("arm.urdf").read_bytes() == before
    assert main(["fit", "arm.urdf", "-o", "out/arm.urdf", "--links", "wrist*"]) == 1
    assert "nothing-to-fit" in capfd.readouterr().err
    assert shapes_in(build("out/arm.urdf").robot, "arm")[0].kind == "cylinder"
    assert main(["fit", "arm.urdf", "-o", "out/arm.urdf", "--links", "!a*"]) == 1
    assert "nothing-to-fit" in capfd.readouterr().err
    assert main(["fit", "arm.urdf", "-o", "out/arm.urdf", "--links", "!b*", "--shape", "box"]) == 0
    assert shapes_in(build("out/arm.urdf").robot, "arm")[0].kind == "box"


@pytest.mark.parametrize(
    ("options", "fault"),
    [
        (["--spheres", "0", "-o", "a.urdf"], "whole number from 1"),
        (["--shape", "capsul", "-o", "a.urdf"], "'--shape' takes"),
        (["--shape", "box", "--spheres", "4", "-o", "a.urdf"], "cannot be combined"),
        ([], "-o FILE"),
    ],
)
def test_yamaro_fit_is_told_what_it_can_do(
    options: list[str], fault: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(["fit", "arm.urdf", *options]) == 2
    assert fault in capfd.readouterr().err


MJCF = """\
<mujoco model="arm">
  <asset><mesh name="arm" file="arm.obj"/></asset>
  <worldbody>
    <body name="base">
      <joint name="j" type="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <geom name="shell" type="mesh" mesh="arm" friction="0.3 0.005 0.0001"/>
      <geom name="seen" type="mesh" mesh="arm" contype="0" conaffinity="0" pos="0 0 1"/>
    </body>
  </worldbody>
  <actuator><motor name="m" joint="j" gear="3"/></actuator>
</mujoco>
"""


def test_pieces_of_a_geom_of_mjcf_touch_as_it_did_and_it_is_seen_as_it_was() -> None:
    import mujoco

    geom = 'type="mesh" mesh="arm" contype="2" conaffinity="5" solref="0.01 1" rgba="1 0 0 1"'
    shell = '<geom name="shell" type="mesh" mesh="arm" friction="0.3 0.005 0.0001"/>'
    Path("arm.xml").write_text(MJCF.replace(shell, f'<geom name="shell" {geom}/>'), "utf-8")
    assert main(["fit", "arm.xml", "-o", "out/arm.xml", "--spheres", "3", "-q"]) == 0
    model = mujoco.MjModel.from_xml_path("out/arm.xml")
    balls = [g for g in range(model.ngeom) if model.geom_contype[g]]
    assert len(balls) == 3
    for ball in balls:
        assert model.geom_type[ball] == mujoco.mjtGeom.mjGEOM_SPHERE
        assert (model.geom_contype[ball], model.geom_conaffinity[ball]) == (2, 5)
        assert model.geom_solref[ball].tolist() == [0.01, 1]
    seen = [g for g in range(model.ngeom) if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_MESH]
    assert len(seen) == 2
    material = model.geom_matid[seen[0]]
    color = model.mat_rgba[material] if material >= 0 else model.geom_rgba[seen[0]]
    assert color.tolist() == [1, 0, 0, 1]


def test_mjcf_stays_mjcf_with_its_actuators_and_frictions(
    capfd: pytest.CaptureFixture[str],
) -> None:
    import mujoco

    Path("arm.xml").write_text(MJCF, encoding="utf-8")
    assert main(["fit", "arm.xml", "-o", "out/arm.urdf"]) == 0
    assert "out/arm.urdf holds MJCF" in capfd.readouterr().err
    assert main(["fit", "arm.xml", "-o", "out/arm.xml", "-q"]) == 0
    model = mujoco.MjModel.from_xml_path("out/arm.xml")
    colliding = [g for g in range(model.ngeom) if model.geom_contype[g]]
    assert [model.geom_type[g] for g in colliding] == [mujoco.mjtGeom.mjGEOM_CAPSULE]
    assert model.geom_size[colliding[0]][:2] == pytest.approx((0.05, 0.15), rel=0.01)
    assert model.geom_friction[colliding[0]][0] == pytest.approx(0.3)
    assert model.nu == 1


def test_a_lighter_mesh_keeps_its_colours_and_one_that_is_light_its_file() -> None:
    import trimesh

    parts = {"red": ((1.0, 0.0, 0.0, 1.0), 0.0), "blue": ((0.0, 0.0, 1.0, 0.5), 1.0)}
    scene = trimesh.Scene()
    for name, (color, x) in parts.items():
        ball = trimesh.creation.icosphere(3, 0.1)
        ball.apply_translation((x, 0, 0))
        material = trimesh.visual.material.PBRMaterial(baseColorFactor=color)
        ball.visual = trimesh.visual.TextureVisuals(material=material)
        scene.add_geometry(ball, geom_name=name)
    scene.export("balls.glb")
    text = URDF.replace("collision", "visual").replace("arm.stl", "balls.glb")
    Path("balls.urdf").write_text(text, encoding="utf-8")
    assert main(["fit", "balls.urdf", "-o", "out/balls.urdf", "--triangles", "800", "-q"]) == 0
    visuals = build("out/balls.urdf").robot.links["arm"].visuals
    found, count = {}, 0
    for visual in visuals:
        assert visual.material is not None
        assert isinstance(visual.shape, Mesh)
        mesh = trimesh.load(Path("out", visual.shape.filename), force="mesh")
        count += len(mesh.faces)
        assert mesh.extents.max() == pytest.approx(0.4, rel=0.03)
        found[round(float(mesh.centroid[0]))] = visual.material.color
    assert 4 <= count <= 800
    assert found == {
        0: pytest.approx(parts["red"][0]),
        2: pytest.approx(parts["blue"][0], abs=0.01),
    }
    assert main(["fit", "balls.urdf", "-o", "out/kept.urdf", "--triangles", "5000", "-q"]) == 0
    kept = Path("out/kept.urdf").read_text(encoding="utf-8")
    assert kept.count("balls.glb") == 1
    assert "<material" not in kept


def test_a_colour_that_is_too_small_to_stay_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    import trimesh

    scene = trimesh.Scene()
    for level, radius, x, color in ((4, 0.1, 0.0, (1.0, 0, 0, 1)), (1, 5e-4, 0.1, (0, 1.0, 0, 1))):
        ball = trimesh.creation.icosphere(level, radius)
        ball.apply_translation((x, 0, 0))
        material = trimesh.visual.material.PBRMaterial(baseColorFactor=color)
        ball.visual = trimesh.visual.TextureVisuals(material=material)
        scene.add_geometry(ball)
    scene.export("led.glb")
    text = URDF.replace("collision", "visual").replace("arm.stl", "led.glb")
    Path("led.urdf").write_text(text, encoding="utf-8")
    assert main(["fit", "led.urdf", "-o", "out/led.urdf", "--triangles", "300"]) == 0
    assert len(build("out/led.urdf").robot.links["arm"].visuals) == 1
    assert "lost-colors]: the smallest colours of the mesh 'led.glb'" in capsys.readouterr().err
