"""Tests of `yamaro_add_robot` in CMake without ROS, with Make and with Ninja."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.consumers.oracles import require_program
from tests.waiting import PATIENCE

MODULE = Path(__file__).parents[2] / "ros/yamaro_ros/cmake/yamaro.cmake"
GENERATORS = {"Unix Makefiles": "make", "Ninja": "ninja"}
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
FILES = {
    "robot.urdf.yaml": (
        "robot: rover\n"
        "arguments: {width: 1.0, sides: [middle]}\n"
        "variables: {all/global: $(sides)}\n"
        "model:\n"
        "- include: parts of it/arm.yaml\n"
        "- part: {name: base, link: {geometry: box, size: $(width) 1 1, visual: }}\n"
    ),
    "parts of it/arm.yaml": "model: {include: hand.yaml}\n",
    "parts of it/hand.yaml": (
        "import: sizes\n"
        "model:\n"
        "- for side in all:\n"
        "  - part:\n"
        "      name: $(side)\n"
        "      joint: {type: fixed, parent: base}\n"
        "      link: {geometry: hand.obj, mass: $(sizes.MASS), visual: }\n"
    ),
    "parts of it/sizes.py": "MASS = 1\n",
    "parts of it/hand.obj": TETRAHEDRON,
}
ADDED = re.compile(r"Building (\S+) with Yamaro")


class Project:
    """A project of CMake in which a robot is built."""

    def __init__(self, folder: Path, generator: str) -> None:
        self.source = folder / "source"
        self.binary = folder / "build"
        self.generator = generator
        for name, text in FILES.items():
            path = self.source / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        self.cmake = require_program("cmake")
        self.environment = {**os.environ, "LANG": "C", "LC_ALL": "C"}
        for name in ("AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH", "CMAKE_PREFIX_PATH"):
            self.environment.pop(name, None)

    def run(self, *words: str | Path, check: bool = True) -> str:
        """Run a command in the folder of the build; return what it printed."""
        self.binary.mkdir(exist_ok=True)
        done = subprocess.run(
            words, cwd=self.binary, env=self.environment, text=True, timeout=PATIENCE,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
        )  # fmt: skip
        assert not check or done.returncode == 0, done.stdout
        return done.stdout

    def configure(self, *lines: str, check: bool = True) -> str:
        """Configure a project of these lines."""
        text = ["cmake_minimum_required(VERSION 3.20)", "project(demo NONE)", "enable_testing()"]
        text += [f'include("{MODULE}")', *lines]
        (self.source / "CMakeLists.txt").write_text("\n".join(text) + "\n")
        yamaro = Path(sys.executable).parent / "yamaro"
        return self.run(
            self.cmake, "-G", self.generator, f"-DYAMARO_COMMAND={yamaro}",
            f"-DCMAKE_INSTALL_PREFIX={self.binary.parent / 'installed'}", self.source, check=check,
        )  # fmt: skip

    def build(self) -> list[str]:
        """Build; return the names of the documents that were written, sorted."""
        output = self.run(self.cmake, "--build", ".")
        assert "Configuring done" not in output
        return sorted(ADDED.findall(output))

    def change(self, name: str, old: str, new: str) -> None:
        """Change a file; its time is later than that of all documents."""
        path = self.source / name
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))
        self.touch(path)

    def touch(self, path: Path) -> None:
        """Make a path newer than what was built, as if some time had passed."""
        built = [file.stat().st_mtime for file in self.binary.rglob("*") if file.is_file()]
        time = max(built) + 0.001
        os.utime(path, (time, time))


@pytest.fixture(params=GENERATORS)
def project(request: pytest.FixtureRequest, tmp_path: Path) -> Project:
    require_program(GENERATORS[request.param])
    return Project(tmp_path, request.param)


@pytest.fixture
def made(tmp_path: Path) -> Project:
    require_program("make")
    return Project(tmp_path, "Unix Makefiles")


def test_a_robot_is_built_again_when_any_of_its_files_has_changed(project: Project) -> None:
    project.configure("yamaro_add_robot(robot.urdf.yaml)")
    assert project.build() == ["robot.urdf"]
    assert project.build() == []
    for name, old, new in (
        ("robot.urdf.yaml", "width: 1.0", "width: 2.0"),
        ("parts of it/hand.yaml", "name: $(side)", "name: hand_$(side)"),
        ("parts of it/sizes.py", "1", "3"),
        ("parts of it/hand.obj", "v 0 0 1", "v 0 0 2"),
    ):
        project.change(name, old, new)
        assert project.build() == ["robot.urdf"], name
        assert project.build() == [], name
    urdf = (project.binary / "robot.urdf").read_text()
    assert '"hand_middle_link"' in urdf
    assert 'mass value="3"' in urdf


def test_an_include_that_is_new_counts_from_then_on(project: Project) -> None:
    """Without configuring again, which `Project.build` checks."""
    project.configure("yamaro_add_robot(robot.urdf.yaml)")
    project.build()
    new = project.source / "new.yaml"
    new.write_text("model: {part: {name: new, joint: {type: fixed, parent: base}}}\n")
    project.change(
        "parts of it/arm.yaml", "model: {include: hand.yaml}", "model: {include: ../new.yaml}"
    )
    assert project.build() == ["robot.urdf"]
    assert project.build() == []
    project.change("new.yaml", "name: new", "name: newer")
    assert project.build() == ["robot.urdf"]
    assert "newer" in (project.binary / "robot.urdf").read_text()
    project.change("robot.urdf.yaml", "- include: parts of it/arm.yaml\n", "")
    assert project.build() == ["robot.urdf"]
    new.unlink()
    assert project.build() == []


def test_a_mesh_that_appears_counts(project: Project) -> None:
    project.configure("yamaro_add_robot(robot.urdf.yaml OPTIONS -q)")
    mesh = project.source / "parts of it/hand.obj"
    mesh.unlink()
    text = FILES["parts of it/hand.yaml"].replace("mass: $(sizes.MASS), ", "")
    (project.source / "parts of it/hand.yaml").write_text(text)
    assert project.build() == ["robot.urdf"]
    assert project.build() == []
    assert '"hand.obj"' in (project.binary / "robot.urdf").read_text()
    mesh.write_text(TETRAHEDRON)
    project.touch(mesh.parent)
    assert project.build() == ["robot.urdf"]
    assert '"../source/parts of it/hand.obj"' in (project.binary / "robot.urdf").read_text()


def test_a_faulty_robot_stops_the_build_and_keeps_the_last_good_one(project: Project) -> None:
    project.configure("yamaro_add_robot(robot.urdf.yaml)")
    project.build()
    before = (project.binary / "robot.urdf").read_text()
    project.change("parts of it/hand.yaml", "for side in all", "for side in al")
    for _ in range(2):
        output = project.run(project.cmake, "--build", ".", check=False)
        assert "error[undefined-name]: name 'al' is not defined" in output
        assert f"{project.source}/parts of it/hand.yaml:3:15" in output
        assert "hint: did you mean 'all'?" in output
    assert (project.binary / "robot.urdf").read_text() == before
    project.change("parts of it/hand.yaml", "for side in al", "for side in all")
    assert project.build() == ["robot.urdf"]


def test_several_formats_are_built_and_installed(project: Project) -> None:
    project.configure(
        "yamaro_add_robot(robot.urdf.yaml TO urdf sdf mjcf TARGET described",
        '  VARIABLES width:=2 "sides:=[left, right]" INSTALL_DESTINATION share/robots)',
        "get_target_property(files described YAMARO_OUTPUTS)",
        'file(WRITE "${CMAKE_BINARY_DIR}/files.txt" "${files}")',
    )
    assert project.build() == ["robot.sdf", "robot.urdf", "robot.xml"]
    assert project.build() == []
    files = (project.binary / "files.txt").read_text().split(";")
    assert files == [
        f"{project.binary}/{name}" for name in ("robot.urdf", "robot.sdf", "robot_mjcf/robot.xml")
    ]
    project.run(project.cmake, "--install", ".")
    installed = project.binary.parent / "installed/share/robots"
    names = {str(path.relative_to(installed)) for path in installed.rglob("*") if path.is_file()}
    copies = {name for name in names if "assets/" in name}
    assert names - copies == {
        "robot.urdf", "robot.sdf", "robot_mjcf/robot.xml", "robot_mjcf/scene.xml",
    }  # fmt: skip
    urdf = (installed / "robot.urdf").read_text()
    assert '"left_link"' in urdf
    mesh = re.findall(r'filename="(assets/hand-\w+\.obj)"', urdf)[0]
    assert (installed / mesh).read_text() == TETRAHEDRON


def test_it_works_in_folders_that_did_not_include_it(made: Project) -> None:
    for name, text in (
        ("a", f'include("{MODULE}")\n'), ("b", "yamaro_add_robot(../robot.urdf.yaml CHECK)\n")
    ):  # fmt: skip
        (made.source / name).mkdir()
        (made.source / name / "CMakeLists.txt").write_text(text)
    made.configure("")
    lists = made.source / "CMakeLists.txt"
    text = lists.read_text().replace(f'include("{MODULE}")', "add_subdirectory(a)")
    lists.write_text(text + "add_subdirectory(b)\n")
    made.run(made.cmake, made.source)
    assert made.build() == ["robot.urdf"]
    assert made.build() == []
    assert (made.binary / "b/robot.urdf").exists()


def test_in_a_ros_package_meshes_are_named_in_their_packages(made: Project) -> None:
    (made.source / "package.xml").write_text("<package><name>rover_description</name></package>")
    made.configure("yamaro_add_robot(robot.urdf.yaml OUTPUT urdf/r.urdf TRUST jail)")
    assert made.build() == ["r.urdf"]
    urdf = (made.binary / "urdf/r.urdf").read_text()
    assert '"package://rover_description/parts of it/hand.obj"' in urdf


def test_check_adds_a_test(made: Project) -> None:
    made.configure(
        "yamaro_add_robot(robot.urdf.yaml CHECK OPTIONS --gazebo --allow root-inertia)",
        "yamaro_add_robot(robot.urdf.yaml TARGET bad VARIABLES width:=0 OUTPUT bad.urdf CHECK)",
    )
    listed = json.loads(made.run("ctest", "--show-only=json-v1"))
    assert [test["name"] for test in listed["tests"]] == ["yamaro_check_robot", "yamaro_check_bad"]
    assert "100% tests passed" in made.run("ctest", "-R", "check_robot", "--output-on-failure")
    output = made.run("ctest", "-R", "check_bad", "--output-on-failure", check=False)
    assert f"{made.source}/robot.urdf.yaml:6:" in output
    made.run(made.cmake, "-DBUILD_TESTING=OFF", ".")
    assert json.loads(made.run("ctest", "--show-only=json-v1"))["tests"] == []


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ("robot.yaml", "there is no file"),
        (
            "robot.urdf.yaml TO urfd",
            (
                "unknown format 'urfd'; TO takes "
                "urdf, sdf, mjcf, srdf, usd, interface, mjlab, isaaclab and controllers"
            ),
        ),
        ("robot.urdf.yaml T urdf", "unknown argument 'T;urdf'"),
        ("robot.urdf.yaml TRUST no", "TRUST is trust, jail or safe, not 'no'"),
        ("robot.urdf.yaml TO urdf sdf OUTPUT a", "formats: 2, files: 1"),
        ("robot.urdf.yaml OUTPUT", "nothing follows OUTPUT"),
    ],
)
def test_wrong_arguments_are_explained(made: Project, arguments: str, told: str) -> None:
    output = made.configure(f"yamaro_add_robot({arguments})", check=False)
    assert told in " ".join(output.split())
    assert f"yamaro_add_robot({arguments.split()[0]})" in " ".join(output.split())


def test_find_package_finds_it_beside_the_command(made: Project) -> None:
    """As pip installs it: bin/yamaro and share/yamaro/cmake, with bin on the PATH."""
    prefix = made.binary.parent / "environment"
    (prefix / "bin").mkdir(parents=True)
    (prefix / "bin/yamaro").symlink_to(Path(sys.executable).parent / "yamaro")
    (prefix / "share/yamaro").mkdir(parents=True)
    (prefix / "share/yamaro/cmake").symlink_to(MODULE.parent)
    made.environment["PATH"] = f"{prefix}/bin:/usr/bin:/bin"
    (made.source / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\nproject(demo NONE)\n"
        "find_package(yamaro REQUIRED)\nyamaro_add_robot(robot.urdf.yaml)\n"
    )
    made.run(made.cmake, made.source)
    assert made.build() == ["robot.urdf"]
