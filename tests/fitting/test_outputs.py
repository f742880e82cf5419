"""Shapes that are made in the outputs: files beside them, and spheres in SRDF."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh
from trimesh import creation

import yamaro
from yamaro.commands.main import main

SOURCE = """
robot: r
model:
  - part: {name: base, link: {geometry: tube.stl, mass: 1, collision: {%s}}}
"""


def written(folder: Path, words: str) -> str:
    creation.annulus(0.8, 1.0, 2.0).export(folder / "tube.stl")
    path = folder / "robot.yaml"
    path.write_text(SOURCE % words)
    return str(path)


def test_pieces_are_files_beside_the_robot_trusted_or_in_safe_mode(tmp_path: Path) -> None:
    path = written(tmp_path, "decompose: 2")
    build = yamaro.build(path)
    names = [each.attributes["filename"] for each in build.root.iter() if each.name == "mesh"]
    assert names == list(build.assets) and names
    for name, data in build.assets.items():
        (tmp_path / "piece.stl").write_bytes(data)
        assert trimesh.load(tmp_path / "piece.stl").is_convex, name
    assert yamaro.build(path, policy=yamaro.Policy("safe")).assets == build.assets
    assert yamaro.build(path, target="sdf", base="fixed").assets == build.assets


@pytest.mark.parametrize("words", ["decompose: 2", "fit: hull"])
@pytest.mark.parametrize("target", ["mjcf", "usd"])
def test_convex_pieces_are_not_approximated_by_their_hulls(
    words: str, target: str, tmp_path: Path
) -> None:
    if target == "usd":
        pytest.importorskip("pxr")
    path = written(tmp_path, words)
    told = [each.what for each in yamaro.build(path, target=target, base="fixed").losses]
    assert "meshes of collisions" not in told
    (tmp_path / "plain.yaml").write_text(SOURCE % "")
    plain = yamaro.build(str(tmp_path / "plain.yaml"), target=target, base="fixed").losses
    assert "meshes of collisions" in [each.what for each in plain]


def test_commands_that_show_a_robot_need_no_file_for_its_pieces(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, "decompose: 2")
    assert main(["why", path, "base_link/collision"]) == 0
    assert main(["tree", path]) == 0
    assert main([path]) == 2
    assert "made of others" in capsys.readouterr().err


def test_srdf_has_the_spheres_that_the_urdf_has(tmp_path: Path) -> None:
    pytest.importorskip("pinocchio")
    path = written(tmp_path, "spheres: 2")
    again = tmp_path / "again.urdf"  # in which nothing says how the spheres were made
    again.write_text(yamaro.build(path).xml(), encoding="utf-8")
    root = yamaro.build(path, target="srdf", base="fixed").root
    (same,) = [
        each
        for each in yamaro.build(again, target="srdf", base="fixed").root.iter()
        if each.name == "link_sphere_approximation"
    ]
    (told,) = [each for each in root.iter() if each.name == "link_sphere_approximation"]
    assert told.attributes["link"] == same.attributes["link"] == "base_link"
    assert [each.attributes for each in same.elements()] == [
        each.attributes for each in told.elements()
    ]
    found = [
        [*map(float, str(each.attributes["center"]).split()), float(str(each.attributes["radius"]))]
        for each in told.elements()
    ]
    collisions = yamaro.build(path).robot.links["base_link"].collisions
    expected = [[*each.pose.position, *each.shape.size] for each in collisions if each.shape]
    assert len(found) == len(expected) == 2
    for sphere, other in zip(found, expected, strict=True):
        assert sphere == pytest.approx(other, abs=1e-9)
