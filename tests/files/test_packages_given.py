"""Folders of ROS packages that are given by name: `--package` and `packages=`."""

from __future__ import annotations

from pathlib import Path

import pytest

import yamaro
from tests.tools_there import needs
from yamaro.commands.main import main
from yamaro.commands.reports import usage_told
from yamaro.files.packages import PackageFinder
from yamaro.sandbox import jail

needs_jail = pytest.mark.skipif(jail.check_available() is not None, reason="no jail here")

ROBOT = "robot: arm\nmodel:\n  include: $(find('hand'))/hand.yaml\n"
HAND = "model:\n  link/name=hand:\n"
XML = '<?xml version="1.0"?>\n<robot name="arm">\n  <link name="hand"/>\n</robot>\n'


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Have a robot in one folder, and what it includes in another."""
    (tmp_path / "robot").mkdir()
    (tmp_path / "far" / "hand").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "robot")
    Path("robot.yaml").write_text(ROBOT)
    Path("../far/hand/hand.yaml").write_text(HAND)
    return tmp_path


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    status = main(list(words))
    captured = capsys.readouterr()
    return status, captured.out, captured.err


# --- the command ----------------------------------------------------------------------------------


def test_without_it_the_package_is_not_found(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = outcome(capsys, "robot.yaml")
    assert (status, out) == (1, "")
    assert err.startswith("error[unknown-package]: the package 'hand' is not found")


@pytest.mark.parametrize("mode", [[], ["--safe"], ["--trust"]])
def test_a_package_may_be_given(mode: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    words = ["robot.yaml", "--package", "hand:=../far/hand", *mode]
    assert outcome(capsys, *words) == (0, XML, "")


def test_a_package_may_be_given_with_an_equals_sign(capsys: pytest.CaptureFixture[str]) -> None:
    assert outcome(capsys, "robot.yaml", "--package=hand:=../far/hand") == (0, XML, "")


@needs("tree")
def test_check_and_tree_take_packages(capsys: pytest.CaptureFixture[str]) -> None:
    given = ["robot.yaml", "--package", "hand:=../far/hand"]
    assert outcome(capsys, "check", *given) == (0, "robot.yaml: ok\n", "")
    status, out, err = outcome(capsys, "tree", *given)
    assert (status, out.splitlines()[0], err) == (0, "hand", "")


def test_several_packages_may_be_given_and_the_last_of_a_name_counts(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "other").mkdir()
    words = ["--package", "arm:=.", "--package", "hand:=../other", "--package", "hand:=../far/hand"]
    assert outcome(capsys, *words, "robot.yaml") == (0, XML, "")


@pytest.mark.parametrize(
    ("given", "problem"),
    [
        ("hand", "'--package' takes NAME:=FOLDER, not 'hand'"),
        ("hand=../far", "'--package' takes NAME:=FOLDER, not 'hand=../far'"),
        (":=../far", "'--package' takes NAME:=FOLDER, not ':=../far'"),
        ("hand:=", "'--package' takes NAME:=FOLDER, not 'hand:='"),
        ("hand:=../near", "the folder '../near' of the package 'hand' does not exist"),
        ("hand:=robot.yaml", "the folder 'robot.yaml' of the package 'hand' does not exist"),
    ],
)
def test_what_is_no_folder_is_wrong_usage(
    given: str, problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    told = f"yamaro: error: {problem}\n{usage_told('build')}\n"
    assert outcome(capsys, "robot.yaml", "--package", given) == (2, "", told)


# --- from Python ----------------------------------------------------------------------------------


def test_build_and_load_take_packages() -> None:
    packages = {"hand": "../far/hand"}
    assert yamaro.build("robot.yaml", packages=packages).xml() == XML
    program = yamaro.load("robot.yaml", packages=packages)
    packages.clear()
    assert program.convert() == XML
    assert program.build().xml() == XML


def test_a_given_package_is_within_reach_of_safe_mode() -> None:
    build = yamaro.build(
        "robot.yaml", packages={"hand": "../far/hand"}, policy=yamaro.Policy("safe")
    )
    assert build.xml() == XML


def test_a_given_package_comes_before_one_that_is_found(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = folder / "ros" / "hand"
    found.mkdir(parents=True)
    (found / "package.xml").write_text("<package><name>hand</name></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder / "ros"))
    assert PackageFinder().find("hand", ".") == str(found)
    given = PackageFinder(given={"hand": "../far/hand"})
    assert given.find("hand", ".") == str(folder / "far" / "hand")
    assert "hand" in given.names(".")


def test_meshes_and_includes_by_uri_are_found_in_it(folder: Path) -> None:
    robot = (
        "robot: arm\nmodel:\n- include: package://hand/hand.yaml\n- part:\n    name: tip\n"
        "    joint: {type: fixed, parent: hand}\n    link:\n      geometry: package://hand/tip.stl\n"
        "      visual:\n"
    )
    mesh = folder / "far" / "hand" / "tip.stl"
    mesh.write_text("solid tip\nendsolid tip\n")
    build = yamaro.build("robot.yaml", text=robot, packages={"hand": "../far/hand"})
    assert build.warnings == []
    assert build.meshes == [str(mesh)]


def test_xacro_files_find_it(folder: Path) -> None:
    (folder / "far" / "hand" / "hand.xacro").write_text('<robot><link name="hand"/></robot>')
    Path("arm.xacro").write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:include filename="$(find hand)/hand.xacro"/></robot>'
    )
    robot = "robot: arm\nmodel:\n  include: arm.xacro\n"
    assert yamaro.build("robot.yaml", text=robot, packages={"hand": "../far/hand"}).xml() == XML


# --- beside the package of the file ---------------------------------------------------------------


@pytest.mark.parametrize("mode", ["trusted", "safe", pytest.param("jail", marks=needs_jail)])
def test_packages_beside_that_of_the_file_are_found_without_a_workspace(
    mode: str, tmp_path: Path
) -> None:
    for name, folder in (("arm", "arm"), ("hand", "a_hand")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
    (tmp_path / "a_hand" / "hand.yaml").write_text("model:\n  link/name=hand:\n")
    main_file = tmp_path / "arm" / "arm.yaml"
    main_file.write_text("robot: arm\nmodel:\n  include: package://hand/hand.yaml\n")
    built = yamaro.build(main_file, policy=yamaro.Policy(mode))
    assert '<link name="hand"/>' in built.xml()
