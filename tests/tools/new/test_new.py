"""`yamaro new`: the folder that it makes, and what it refuses."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from tests.waiting import PATIENCE
from yamaro import __version__, output
from yamaro.commands.main import main
from yamaro.tools.new import package as picture
from yamaro.tools.new.package import fault_of_name, files_of

FILES = {
    ".github/workflows/robot.yml",
    ".gitignore",
    ".pre-commit-config.yaml",
    "CMakeLists.txt",
    "README.md",
    "config/ros2_controllers.yaml",
    "config/ros_gz_bridge.yaml",
    "launch/bringup.launch.py",
    "launch/description.launch.py",
    "launch/display.launch.py",
    "launch/gazebo.launch.py",
    "package.xml",
    "pyproject.toml",
    "rviz/rover.rviz",
    "test/rover.test.yaml",
    "urdf/rover.yaml",
    "urdf/wheel.yaml",
    "worlds/flat.sdf",
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def no_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "picture_of", lambda name, folder: None)


@pytest.fixture
def some_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "picture_of", lambda name, folder: b"a picture")


def made(folder: Path) -> set[str]:
    return {str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file()}


@pytest.mark.usefixtures("no_picture")
def test_a_package_is_made(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "rover"]) == 0
    assert made(here / "rover") == FILES
    assert "picture.png" not in (here / "rover" / "README.md").read_text().partition("## ")[0]
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith("rover: a robot, as a package for pip and for colcon\n")
    assert "the README has no picture yet: pip install 'yamaro[picture]'" in told.err


@pytest.mark.usefixtures("some_picture")
def test_the_readme_shows_the_picture(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "rover"]) == 0
    assert made(here / "rover") == {*FILES, "picture.png"}
    assert (here / "rover" / "picture.png").read_bytes() == b"a picture"
    assert "\n![The robot](picture.png)\n" in (here / "rover" / "README.md").read_text()
    assert "no picture" not in capsys.readouterr().err


@pytest.mark.slow
def test_the_picture_is_drawn(here: Path) -> None:
    command = [sys.executable, "-m", "yamaro", "new", "rover"]
    subprocess.run(command, check=True, timeout=PATIENCE)
    assert (here / "rover" / "picture.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.usefixtures("no_picture")
def test_a_package_is_made_in_a_workspace(here: Path) -> None:
    assert main(["new", "ws/src/rover/"]) == 0
    assert made(here / "ws" / "src" / "rover") == FILES


@pytest.mark.usefixtures("no_picture")
def test_the_robot_is_as_it_should_be(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "rover"]) == 0
    files = [
        str(each) for each in (here / "rover").glob("*/*.yaml") if each.parent.name != "config"
    ]
    assert main(["fmt", "--check", *files]) == 0
    robot = "rover/urdf/rover.yaml"
    for camera in ("true", "false"):
        for hardware in ("mock", "gazebo"):
            words = [f"camera:={camera}", f"hardware:={hardware}"]
            assert main(["check", "--strict", robot, *words]) == 0
    assert main(["check", "--strict", robot, "--to", "mjcf"]) == 0
    capsys.readouterr()
    assert main(["-q", robot, "--to", "controllers"]) == 0
    assert capsys.readouterr().out == Path("rover/config/ros2_controllers.yaml").read_text()
    capsys.readouterr()
    assert main(["test", "rover"]) == 0
    assert "rover.test.yaml: 4 passed" in capsys.readouterr().out


def test_the_files_name_the_package() -> None:
    files = files_of("my_rover", has_picture=False)
    for path, text in files.items():
        for word in ("NAME", "DISTRIBUTION", "YAMARO", "PICTURE"):
            assert f"@{word}@" not in text, path
    root = ElementTree.fromstring(files["package.xml"])
    assert root.findtext("name") == "my_rover"
    assert root.findtext("export/build_type") == "ament_cmake"
    project = files["pyproject.toml"]
    assert 'name = "my-rover"' in project
    assert '[project.entry-points."yamaro.packages"]\nmy_rover = "my_rover"' in project
    assert f'dependencies = ["yamaro>={__version__}"]' in project
    hooks = yaml.safe_load(files[".pre-commit-config.yaml"])["repos"][0]["hooks"]
    assert [each["id"] for each in hooks] == ["yamaro-fmt", "yamaro-check", "yamaro-test"]


@pytest.mark.skipif(sys.version_info < (3, 11), reason="needs tomllib")
def test_the_versions_are_the_same() -> None:
    import tomllib

    files = files_of("rover", has_picture=False)
    version = tomllib.loads(files["pyproject.toml"])["project"]["version"]
    assert ElementTree.fromstring(files["package.xml"]).findtext("version") == version


# --- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("", "is empty"),
        ("r", "at least two characters"),
        ("My-Rover", "for example 'my_rover'"),
        ("MyRover", "for example 'my_rover'"),
        ("my rover", "for example 'my_rover'"),
        ("my.rover", "for example 'my_rover'"),
        ("2wheels", "for example 'wheels'"),
        ("_rover", "for example 'rover'"),
        ("rover_", "for example 'rover'"),
        ("my__rover", "for example 'my_rover'"),
        ("röver", "for example 'r_ver'"),
        ("ロボット", "lower-case letters"),
        ("class", "for example 'class_robot'"),
        ("test", "for example 'test_robot'"),
        ("json", "for example 'json_robot'"),
        ("yamaro", "Yamaro itself"),
        ("r" * 65, "more than 64"),
    ],
)
def test_a_name_that_cannot_be_is_refused(
    here: Path, name: str, reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    fault = fault_of_name(name)
    assert fault is not None and reason in fault
    assert main(["new", name]) == 2
    assert reason in capsys.readouterr().err
    assert list(here.iterdir()) == []


@pytest.mark.parametrize("name", ["rover", "rover_2", "r2", "ur5_description", "r" * 64])
def test_a_name_that_can_be(name: str) -> None:
    assert fault_of_name(name) is None


@pytest.mark.usefixtures("some_picture")
@pytest.mark.parametrize("kind", ["folder", "file", "link"])
def test_what_exists_is_left_as_it_is(
    here: Path, kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if kind == "folder":
        (here / "rover").mkdir()
    elif kind == "file":
        (here / "rover").write_text("mine")
    else:
        (here / "rover").symlink_to("nowhere")
    before = os.lstat(here / "rover")
    assert main(["new", "rover"]) == 2
    assert "'rover' exists; 'yamaro new' makes a new folder" in capsys.readouterr().err
    assert os.lstat(here / "rover") == before
    assert [each.name for each in here.iterdir()] == ["rover"]


@pytest.mark.usefixtures("some_picture")
@pytest.mark.parametrize(("module", "name"), [(output, "_write_new"), (os, "rename")])
def test_nothing_is_left_if_it_fails(
    here: Path,
    module: object,
    name: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def fail(*arguments: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(module, name, fail)
        assert main(["new", "rover"]) == 1
    assert "cannot make 'rover': No space left on device" in capsys.readouterr().err
    assert list(here.iterdir()) == []


def test_a_folder_that_appears_meanwhile_is_not_replaced(
    here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def draw(name: str, folder: str) -> bytes:
        os.mkdir(folder)
        return b""

    monkeypatch.setattr(picture, "picture_of", draw)
    assert main(["new", "rover"]) == 1
    assert list(here.iterdir()) == [here / "rover"]
    assert list((here / "rover").iterdir()) == []


def test_a_new_robot_takes_no_variables(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "rover", "a:=1"]) == 2
    assert "has no argument to set" in capsys.readouterr().err


# --- of a robot that exists -------------------------------------------------------------------

LAMP = """\
robot: lamp
model:
- include: shade.yaml
- part: {name: foot, link: {visual: {geometry: ../meshes/foot.stl}}}
- Shade: foot
"""
SHADE = """\
functions:
- Shade(parent)/parent:
  - part:
      name: shade
      joint: {type: continuous, parent: $(parent), xyz: 0 0 30cm, axis: z}
      link: {geometry: sphere, radius: 10cm, mass: 300 g, visual: }
"""
STL = b"""\
solid foot
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid
"""


@pytest.fixture
def lamp(here: Path) -> Path:
    files = {"yaml/lamp.yaml": LAMP.encode(), "yaml/shade.yaml": SHADE.encode()}
    for path, data in {**files, "meshes/foot.stl": STL}.items():
        (here / path).parent.mkdir(exist_ok=True)
        (here / path).write_bytes(data)
    return here / "yaml" / "lamp.yaml"


@pytest.mark.usefixtures("lamp")
def test_a_package_is_made_of_a_robot(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "lamp_description", "yaml/lamp.yaml"]) == 0, capsys.readouterr().err
    folder = here / "lamp_description"
    assert made(folder) - {"picture.png"} == {
        ".github/workflows/robot.yml",
        ".gitignore",
        ".pre-commit-config.yaml",
        "CMakeLists.txt",
        "README.md",
        "meshes/foot.stl",
        "package.xml",
        "pyproject.toml",
        "test/lamp.test.yaml",
        "urdf/lamp.yaml",
        "urdf/shade.yaml",
    }
    texts = [
        (folder / path).read_text() for path in made(folder) if path[-4:] not in (".png", ".stl")
    ]
    assert not [text for text in texts if re.search("@[A-Z]+@", text)]
    assert ElementTree.parse(folder / "package.xml").findtext("name") == "lamp_description"
    assert "yamaro_add_robot(urdf/lamp.yaml" in (folder / "CMakeLists.txt").read_text()
    capsys.readouterr()
    assert main(["test", "lamp_description"]) == 0
    assert capsys.readouterr().out == "lamp_description/test/lamp.test.yaml: 1 passed\n"


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("lamp.urdf", "takes a robot in YAML, not 'lamp.urdf'; 'yamaro migrate' makes one"),
        ("missing.yaml", "cannot read 'missing.yaml'"),
        ("yaml/lamp & co.yaml", "its name has more than letters, digits, '_', '.' and '-'"),
    ],
)
def test_what_is_not_a_robot_in_yaml_is_refused(
    file: str, said: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", "lamp_description", file]) == 2
    assert said in capsys.readouterr().err
    assert not (here / "lamp_description").exists()


def test_a_robot_with_an_error_gives_no_package(
    lamp: Path, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lamp.write_text(LAMP.replace("- Shade: foot", "- Shade: $(fot)"))
    assert main(["new", "lamp_description", str(lamp)]) == 1
    assert "error[undefined-name]" in capsys.readouterr().err
    assert not (here / "lamp_description").exists()


def test_packages_that_it_is_read_from_are_dependencies(
    lamp: Path, here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(here))
    (here / "shades" / "yaml").mkdir(parents=True)
    (here / "shades" / "package.xml").write_text("<package><name>shades</name></package>")
    (here / "shades" / "yaml" / "shade.yaml").write_text(SHADE)
    lamp.write_text(LAMP.replace("shade.yaml", "package://shades/yaml/shade.yaml"))
    assert main(["new", "lamp_description", str(lamp)]) == 0, capsys.readouterr().err
    manifest = ElementTree.parse(here / "lamp_description" / "package.xml")
    assert [each.text for each in manifest.iterfind("exec_depend")] == ["yamaro_ros", "shades"]
    assert not list((here / "lamp_description").rglob("shade.yaml"))


def test_a_file_elsewhere_is_not_forgotten(
    lamp: Path, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here.parent / "elsewhere.yaml").write_text(SHADE)
    lamp.write_text(LAMP.replace("shade.yaml", "../../elsewhere.yaml"))
    assert main(["new", "lamp_description", str(lamp)]) == 1
    assert "elsewhere.yaml', which its package would not have" in capsys.readouterr().err
    assert not (here / "lamp_description").exists()
