"""Packages of robots that Python packages bring."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest

import yamaro
from tests.files.test_packages import install_package, make_package
from tests.files.wheels import EXPLODES, install
from tests.tools_there import needs
from yamaro import Policy, YamaroError
from yamaro.commands.main import main
from yamaro.files.installed import InstalledPackages
from yamaro.files.packages import PackageFinder
from yamaro.sandbox import jail

needs_jail = pytest.mark.skipif(
    jail.check_available() is not None, reason=f"no jail here: {jail.check_available()}"
)
MODES = ["trusted", "safe", pytest.param("jail", marks=needs_jail)]

STL = "solid w\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
STL += "endloop\nendfacet\nendsolid w\n"
ROVER = {"rover/__init__.py": EXPLODES, "rover/wheel.stl": STL}
ROVER["rover/wheel.yaml"] = """
model:
- link/name=wheel:
  - visual:
    - geometry:
      - mesh/filename=package://rover/wheel.stl:
"""
MAIN = "robot: r\nmodel:\n- include: package://rover/wheel.yaml\n"


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder of Python packages, in a world without ROS."""
    folder = tmp_path / "site-packages"
    folder.mkdir()
    monkeypatch.setattr(sys, "path", [*sys.path, str(folder)])
    for name in ("AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(tmp_path / "cache"))
    return folder


def robot(tmp_path: Path, text: str = MAIN) -> str:
    path = tmp_path / "home" / "robot.yaml"
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)
    return str(path)


def codes(path: str, mode: str = "trusted") -> list[str]:
    try:
        return [each.code for each in yamaro.build(path, policy=Policy(mode)).warnings]
    except YamaroError as error:
        return [each.code for each in error.diagnostics]


# --- where they are -------------------------------------------------------------------------------


def test_an_entry_point_names_the_folder_of_a_module(site: Path) -> None:
    install(site, "rover-robots", ROVER, entry_points="rover = rover\nwheels=rover.parts")
    (site / "rover" / "parts").mkdir()
    finder = PackageFinder()
    assert finder.find("rover", "/") == str(site / "rover")
    assert finder.find("wheels", "/") == str(site / "rover" / "parts")
    assert finder.resolve_uri("package://rover/a.stl", "/") == str(site / "rover" / "a.stl")
    assert finder.find("rover-robots", "/") is None
    assert {"rover", "wheels"} <= set(finder.names("/"))


@pytest.mark.parametrize(
    "value", ["nowhere", "rover.nowhere", "../rover", "rover:robot", "", "rover/parts", ".rover"]
)
def test_what_is_not_a_module_with_a_folder_is_not_found(site: Path, value: str) -> None:
    install(site, "rover", ROVER, entry_points=f"rover = {value}")
    assert PackageFinder().find("rover", "/") is None


def test_only_the_group_counts(site: Path) -> None:
    install(site, "rover", ROVER, entry_points="# a = rover\n[console_scripts]\nb = rover")
    assert InstalledPackages([str(site)]).all() == {}


def test_the_first_folder_of_the_path_wins(site: Path, tmp_path: Path) -> None:
    second = tmp_path / "second"
    for folder in (site, second):
        install(folder, "rover", ROVER, entry_points="rover = rover")
    assert InstalledPackages([str(second), str(site)]).folder("rover") == str(second / "rover")


def test_the_current_folder_is_not_a_folder_of_python_packages(
    site: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`python -m yamaro` puts it first, and it may be that of an untrusted robot."""
    install(site, "rover", ROVER, entry_points="rover = rover")
    monkeypatch.chdir(site)
    assert InstalledPackages(["", str(site)]).folder("rover") is None


def test_what_setuptools_develops_is_found(site: Path) -> None:
    (site / "rover.egg-info").mkdir()
    (site / "rover.egg-info" / "entry_points.txt").write_text("[yamaro.packages]\nrover = rover\n")
    (site / "rover").mkdir()
    assert PackageFinder().find("rover", "/") == str(site / "rover")


# --- editable installs ----------------------------------------------------------------------------


def editable(site: Path, project: Path, own: dict[str, str]) -> None:
    """Install a project as `pip install -e` does: its files stay where they are."""
    (project / "robots" / "rover").mkdir(parents=True)
    (site / "rover").mkdir()  # `pip uninstall` left it
    install(site, "rover", own, entry_points="rover = rover")
    url = {"url": project.as_uri(), "dir_info": {"editable": True}}
    (site / "rover-1.0.dist-info" / "direct_url.json").write_text(json.dumps(url))


def test_a_pth_file_leads_to_an_editable_package(site: Path, tmp_path: Path) -> None:
    project = tmp_path / "project"
    editable(site, project, {"_rover.pth": f"# where it is\nimport os\n{project / 'robots'}\n"})
    assert PackageFinder().find("rover", "/") == str(project / "robots" / "rover")


def test_the_table_of_a_finder_leads_to_an_editable_package(site: Path, tmp_path: Path) -> None:
    project = tmp_path / "project"
    mapping = {"rover": str(project / "robots" / "rover")}
    text = f"{EXPLODES}MAPPING: dict[str, str] = {mapping!r}\n"
    editable(site, project, {"__editable___rover_1_0_finder.py": text})
    assert PackageFinder().find("rover", "/") == str(project / "robots" / "rover")


@pytest.mark.parametrize("layout", ["src/rover", "rover"])
def test_the_project_leads_to_an_editable_package(site: Path, tmp_path: Path, layout: str) -> None:
    project = tmp_path / "a project"
    editable(site, project, {})
    (project / layout).mkdir(parents=True)
    assert PackageFinder().find("rover", "/") == str(project / layout)


def test_an_editable_package_that_is_nowhere_is_reported(
    site: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    editable(site, tmp_path / "project", {})
    (site / "rover").rmdir()
    assert main([robot(tmp_path)]) == 1
    hint = "hint: the Python package 'rover' says that it is the folder of the module 'rover'"
    assert hint in capsys.readouterr().err


@pytest.mark.parametrize("mode", MODES)
def test_an_editable_package_is_read_in_every_mode(site: Path, tmp_path: Path, mode: str) -> None:
    project = tmp_path / "project"
    editable(site, project, {"_rover.pth": f"{project / 'robots'}\n"})
    for name, text in ROVER.items():
        (project / "robots" / name).write_text(text)
    assert codes(robot(tmp_path), mode) == []


# --- in a build -----------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
def test_a_robot_takes_files_and_meshes_of_a_python_package(
    site: Path, tmp_path: Path, mode: str
) -> None:
    install(site, "rover", ROVER, entry_points="rover = rover")
    build = yamaro.build(robot(tmp_path), policy=Policy(mode))
    assert build.warnings == []
    assert build.meshes == [str(site / "rover" / "wheel.stl")]
    assert str(site / "rover" / "wheel.yaml") in build.files
    assert "rover" not in sys.modules


@pytest.mark.parametrize("mode", MODES)
def test_packages_take_files_of_other_packages(site: Path, tmp_path: Path, mode: str) -> None:
    for one, other in (("a", "b"), ("b", "c")):
        text = f"model:\n- include: package://{other}/part.yaml\n"
        files = {f"{one}/part.yaml": text, f"{one}/__init__.py": EXPLODES}
        install(site, one, files, entry_points=f"{one} = {one}")
    install(site, "c", {"c/part.yaml": "model:\n- link/name=c:\n"}, entry_points="c = c")
    text = "robot: r\nmodel:\n- include: $(find a)/part.yaml\n"
    build = yamaro.build(robot(tmp_path, text), policy=Policy(mode))
    assert '<link name="c"/>' in build.xml()


@pytest.mark.parametrize("words", [["check"], ["--to", "sdf"], ["--deps", "--safe"]])
def test_the_commands_find_python_packages(
    site: Path, tmp_path: Path, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    install(site, "rover", ROVER, entry_points="rover = rover")
    assert main([*words, robot(tmp_path)]) == 0
    assert "error" not in capsys.readouterr().err


@needs("migrate")
def test_migrate_finds_python_packages(site: Path, tmp_path: Path) -> None:
    link = '<robot name="r"><link name="a"/></robot>'
    install(site, "rover", {"rover/a.xacro": link}, entry_points="rover = rover")
    main_file = tmp_path / "r.urdf.xacro"
    main_file.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:include filename="$(find rover)/a.xacro"/></robot>'
    )
    assert main(["migrate", str(main_file), "-o", str(tmp_path / "out")]) == 0


@pytest.mark.parametrize("mode", ["safe", pytest.param("jail", marks=needs_jail)])
def test_a_package_is_read_only_if_the_file_names_it(site: Path, tmp_path: Path, mode: str) -> None:
    project = tmp_path / "project"
    editable(site, project, {"_rover.pth": f"{project / 'robots'}\n"})
    part = project / "robots" / "rover" / "part.yaml"
    part.write_text("model:\n- link/name=a:\n")
    by_path = f"robot: r\nmodel:\n- include: {part}\n"
    assert codes(robot(tmp_path, by_path), mode) == ["path-outside"]
    named = by_path + "- print: $(find('rover'))\n"
    assert codes(robot(tmp_path, named), mode) == ["path-outside"]  # it is named later
    named = by_path.replace("model:\n", "model:\n- print: $(find('rover'))\n")
    assert codes(robot(tmp_path, named), mode) == []


@needs_jail
def test_python_in_a_jail_reads_a_package_only_if_it_names_it(site: Path, tmp_path: Path) -> None:
    project = tmp_path / "project"
    editable(site, project, {"_rover.pth": f"{project / 'robots'}\n"})
    (project / "robots" / "rover" / "secret").write_text("abc")
    secret = project / "robots" / "rover" / "secret"
    text = f"robot: r\nmodel:\n- link/name=$(open('{secret}').read()):\n"
    assert codes(robot(tmp_path, text), "jail") == ["python-error"]


def test_a_package_that_holds_the_home_folder_is_not_read(
    site: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = tmp_path / "project"
    monkeypatch.setenv("HOME", str(project / "robots" / "rover" / "me"))
    editable(site, project, {"_rover.pth": f"{project / 'robots'}\n"})
    (project / "robots" / "rover" / "wheel.yaml").write_text("model:\n- link/name=a:\n")
    assert codes(robot(tmp_path), "safe") == ["path-outside"]
    assert codes(robot(tmp_path), "trusted") == []


# --- ROS ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
def test_a_ros_package_hides_a_python_package_with_a_warning(
    site: Path, tmp_path: Path, mode: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    share = Path(install_package(tmp_path / "opt", "rover"))
    (share / "wheel.yaml").write_text("model:\n- link/name=of_ros:\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "opt"))
    install(site, "rover-robots", ROVER, entry_points="rover = rover", version="2.5")
    build = yamaro.build(robot(tmp_path), policy=Policy(mode))
    assert '<link name="of_ros"/>' in build.xml()
    (warning,) = build.warnings
    assert warning.code == "hidden-package"
    assert warning.span.written() == "package://rover/wheel.yaml"
    assert warning.notes == (
        f"the ROS package is {share}",
        f"the Python package is {site / 'rover'} (rover-robots 2.5)",
    )


def test_a_package_in_both_forms_is_no_clash(
    site: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    share = Path(install_package(tmp_path / "opt", "rover"))
    (share / "wheel.yaml").write_text("model:\n- link/name=a:\n")
    (share / "package.xml").write_text(
        "<package><name>rover</name><version>1.0</version></package>"
    )
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "opt"))
    install(site, "rover", ROVER, entry_points="rover = rover", version="1.0")
    assert codes(robot(tmp_path)) == []
    (share / "package.xml").write_text(
        "<package><name>rover</name><version>1.1</version></package>"
    )
    assert codes(robot(tmp_path)) == ["hidden-package"]


def test_the_package_around_a_file_is_no_clash(site: Path, tmp_path: Path) -> None:
    """Who works on a package has an older one installed."""
    own = Path(make_package(tmp_path / "home", "rover"))
    (own / "wheel.yaml").write_text("model:\n- link/name=a:\n")
    install(site, "rover", ROVER, entry_points="rover = rover")
    assert codes(robot(tmp_path)) == []


def test_a_folder_that_is_given_is_no_clash(site: Path, tmp_path: Path) -> None:
    install(site, "rover", ROVER, entry_points="rover = rover")
    other = tmp_path / "other"
    other.mkdir()
    (other / "wheel.yaml").write_text("model:\n- link/name=a:\n")
    build = yamaro.build(robot(tmp_path), packages={"rover": str(other)})
    assert build.warnings == []
    assert '<link name="a"/>' in build.xml()


# --- what is not there ----------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("rovre", "did you mean 'rover'?"),
        ("rover-robots", "the Python package 'rover-robots' brings 'rover'"),
        (
            "plain",
            (
                "the Python package 'plain' is installed, but does not say where its robots are: "
                "it needs an entry point in the group 'yamaro.packages'"
            ),
        ),
        (
            "tractor",
            (
                "source its ROS workspace, install its Python package with pip, or set its "
                "folder: --package tractor:=FOLDER"
            ),
        ),
    ],
)
def test_an_unknown_package_says_what_to_do(
    site: Path, tmp_path: Path, mode: str, name: str, hint: str
) -> None:
    install(site, "rover-robots", ROVER, entry_points="rover = rover")
    install(site, "plain", {"plain/__init__.py": EXPLODES})
    with pytest.raises(YamaroError) as caught:
        yamaro.build(robot(tmp_path, MAIN.replace("rover", name)), policy=Policy(mode))
    (error,) = caught.value.diagnostics
    assert (error.code, error.hint) == ("unknown-package", hint)
    assert f"searched in {site} (entry points 'yamaro.packages')" in error.notes


# --- the cache of robot_descriptions --------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("inner", ["arm", "arm-0123abc/arm", "robots_ros/robots/arm_description"])
def test_clones_of_robot_descriptions_are_found(
    site: Path, tmp_path: Path, mode: str, inner: str
) -> None:
    folder = tmp_path / "cache" / inner
    folder.mkdir(parents=True)
    if inner.startswith("robots"):
        make_package(folder, "arm")
    (folder / "arm.yaml").write_text("model:\n- link/name=a:\n")
    text = "robot: r\nmodel:\n- include: package://arm/arm.yaml\n"
    before = sorted((tmp_path / "cache").rglob("*"))
    assert codes(robot(tmp_path, text), mode) == []
    assert sorted((tmp_path / "cache").rglob("*")) == before


def test_a_python_package_goes_before_a_clone(site: Path, tmp_path: Path) -> None:
    (tmp_path / "cache" / "rover").mkdir(parents=True)
    assert PackageFinder().find("rover", "/") == str(tmp_path / "cache" / "rover")
    install(site, "rover", ROVER, entry_points="rover = rover")
    assert PackageFinder().find("rover", "/") == str(site / "rover")


def test_no_cache_is_made(site: Path, tmp_path: Path) -> None:
    assert PackageFinder().find("rover", "/") is None
    assert not os.path.exists(tmp_path / "cache")
