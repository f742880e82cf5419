"""Where the file is that a mesh or texture names."""

from pathlib import Path

import pytest

from yamaro import YamaroError, build
from yamaro.files.mesh_files import MeshFinder
from yamaro.files.packages import PackageFinder
from yamaro.policy import Policy
from yamaro.rendering import render
from yamaro.source import Source, Span


def span_in(folder: Path) -> Span:
    return Span(Source("robot", name="robot.urdf", path=str(folder / "robot.urdf")), 0, 5)


def package(folder: Path, name: str) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
    return folder


def mesh(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("solid none\nendsolid none\n")
    return path


def finder(**environ: str) -> MeshFinder:
    return MeshFinder(PackageFinder(environ))


def test_each_way_to_name_a_file_finds_it(tmp_path: Path) -> None:
    arm = package(tmp_path / "src" / "arm_description", "arm_description")
    path = mesh(arm / "meshes" / "arm.stl")
    span = span_in(arm / "urdf")
    for name in (
        "package://arm_description/meshes/arm.stl",
        "../meshes/arm.stl",
        str(path),
        path.as_uri(),
    ):
        assert finder().resolve(name, span) == str(path), name


def test_a_package_of_a_sourced_workspace_is_found(tmp_path: Path) -> None:
    prefix = tmp_path / "install"
    path = mesh(prefix / "share" / "arm" / "arm.stl")
    mesh(prefix / "share" / "ament_index" / "resource_index" / "packages" / "arm")
    found = finder(AMENT_PREFIX_PATH=str(prefix)).resolve(
        "package://arm/arm.stl", span_in(tmp_path)
    )
    assert found == str(path)


def test_a_model_of_a_simulator_is_found(tmp_path: Path) -> None:
    path = mesh(tmp_path / "models" / "box" / "box.dae")
    environ = {"GZ_SIM_RESOURCE_PATH": str(tmp_path / "models")}
    assert finder(**environ).resolve("model://box/box.dae", span_in(tmp_path)) == str(path)


def test_a_relative_name_means_another_file_in_another_folder(tmp_path: Path) -> None:
    here, there = mesh(tmp_path / "a" / "m.stl"), mesh(tmp_path / "b" / "m.stl")
    looks = finder()
    assert looks.resolve("m.stl", span_in(tmp_path / "a")) == str(here)
    assert looks.resolve("m.stl", span_in(tmp_path / "b")) == str(there)


@pytest.mark.parametrize("name", ["none.stl", "https://a.org/a.stl", "package://no/a.stl", "\0"])
def test_what_is_not_there_is_not_found(name: str, tmp_path: Path) -> None:
    assert finder().resolve(name, span_in(tmp_path)) is None


def test_a_missing_mesh_tells_where_it_was_looked_for(tmp_path: Path) -> None:
    text = "model: {part: {name: a, link: {geometry: meshes/a.stl, visual: }}}"
    (warning,) = build(tmp_path / "robot.yaml", text=text).warnings
    assert f"searched for {tmp_path / 'meshes' / 'a.stl'}" in render(warning)


def test_an_unknown_package_tells_how_to_name_its_folder(tmp_path: Path) -> None:
    text = "model: {part: {name: a, link: {geometry: package://robby/a.stl, visual: }}}"
    (warning,) = build(tmp_path / "robot.yaml", text=text).warnings
    assert "--package robby:=FOLDER" in render(warning)


def test_a_finished_build_finds_meshes_in_every_mode(tmp_path: Path) -> None:
    path = mesh(tmp_path / "a.stl")
    text = "model: {part: {name: a, link: {geometry: a.stl, visual: }}}"
    for mode in ("trusted", "safe"):
        built = build(tmp_path / "robot.yaml", text=text, policy=Policy(mode))
        assert built.finder.resolve("a.stl", span_in(tmp_path)) == str(path)
        assert built.meshes == [str(path)]


def test_a_build_in_safe_mode_finds_no_mesh_outside_of_its_folders(tmp_path: Path) -> None:
    (tmp_path / "robot").mkdir()
    path = mesh(tmp_path / "secret.stl")
    built = build(
        tmp_path / "robot" / "robot.yaml", text="robot: {link/name=a: }", policy=Policy("safe")
    )
    with pytest.raises(YamaroError, match="path-outside"):
        built.finder.resolve(str(path), span_in(tmp_path / "robot"))
