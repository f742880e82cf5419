"""A workspace of ROS 2 with robots in it, and Debian's colcon, which builds it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests.consumers.oracles import missing, require_program
from tests.waiting import PATIENCE

ROOT = Path(__file__).parents[2]
YAMARO = Path(sys.executable).parent / "yamaro"
SYSTEM_PYTHON = "/usr/bin/python3"

MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>A robot</description>
  <maintainer email="robots@example.org">Robots</maintainer>
  <license>Apache-2.0</license>
  {depend}
  <export><build_type>{build_type}</build_type></export>
</package>
"""
ROVER = {
    "package.xml": MANIFEST.format(
        name="rover_description",
        build_type="ament_cmake",
        depend="<buildtool_depend>ament_cmake</buildtool_depend>\n"
        "  <buildtool_depend>yamaro_ros</buildtool_depend>\n"
        "  <depend>arm_description</depend>",
    ),
    "CMakeLists.txt": (
        "cmake_minimum_required(VERSION 3.20)\n"
        "project(rover_description NONE)\n"
        "find_package(ament_cmake REQUIRED)\n"
        "find_package(yamaro_ros REQUIRED)\n"
        "yamaro_add_robot(urdf/rover.urdf.yaml CHECK\n"
        "  INSTALL_DESTINATION share/${PROJECT_NAME}/urdf)\n"
        "install(DIRECTORY urdf DESTINATION share/${PROJECT_NAME})\n"
        "ament_package()\n"
    ),
    "urdf/rover.urdf.yaml": (
        "robot: rover\n"
        "model:\n"
        "- link/name=base_link:\n"
        "- include: package://rover_description/urdf/parts/wheels.yaml\n"
        "- include: package://arm_description/urdf/arm.yaml\n"
    ),
    "urdf/parts/wheels.yaml": "model: {include: wheel.yaml}\n",
    "urdf/parts/wheel.yaml": (
        "model:\n"
        "- part:\n"
        "    name: wheel\n"
        "    joint: {type: continuous, parent: base_link, axis: y}\n"
        "    link: {geometry: sphere, radius: 0.1, mass: 1, visual: }\n"
    ),
}
ARM = {
    "package.xml": MANIFEST.format(name="arm_description", build_type="ament_python", depend=""),
    "setup.py": (
        "from glob import glob\n"
        "from setuptools import setup\n"
        "share = 'share/arm_description'\n"
        "index = 'share/ament_index/resource_index/packages'\n"
        "setup(name='arm_description', version='0.1.0', packages=[], data_files=[\n"
        "    (index, ['resource/arm_description']), (share, ['package.xml']),\n"
        "    (share + '/urdf', glob('urdf/*.yaml')), (share + '/meshes', glob('meshes/*'))])\n"
    ),
    "resource/arm_description": "",
    "urdf/arm.yaml": (
        "model:\n"
        "- part:\n"
        "    name: arm\n"
        "    joint: {type: fixed, parent: base_link}\n"
        "    link: {geometry: ../meshes/arm.obj, mass: 1, visual: }\n"
    ),
    "meshes/arm.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
}


class Workspace:
    """A workspace, built with colcon."""

    def __init__(self, folder: Path) -> None:
        """Make its packages.

        These are yamaro_ros, a robot in CMake, one in Python that it includes, and one that
        `yamaro new` makes.
        """
        require_program("colcon")
        if not Path("/usr/share/ament_cmake").is_dir():
            missing("ament_cmake")
        self.folder = folder
        source = folder / "src"
        shutil.copytree(
            ROOT / "ros/yamaro_ros",
            source / "yamaro_ros",
            ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"),
        )
        for package, files in (("rover_description", ROVER), ("arm_description", ARM)):
            for name, text in files.items():
                path = source / package / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
        subprocess.run([YAMARO, "new", source / "cart"], check=True, capture_output=True)
        self.cart = source / "cart"
        self.rover = source / "rover_description"
        self.share = folder / "install/rover_description/share/rover_description"
        kept = {name: value for name, value in os.environ.items() if "COV" in name}
        self.environment = {
            **kept,
            "PATH": "/usr/bin:/bin",
            "LC_ALL": "C.UTF-8",
            "HOME": str(folder),
        }

    def run(self, *words: str, check: bool = True) -> str:
        """Run a command in the workspace; return what it printed."""
        done = subprocess.run(
            words, cwd=self.folder, env=self.environment, text=True, timeout=PATIENCE,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
        )  # fmt: skip
        assert not check or done.returncode == 0, done.stdout
        return done.stdout

    def build(self, *packages: str, check: bool = True) -> str:
        """Build all packages, or some."""
        select = ["--packages-select", *packages] if packages else []
        return self.run(
            "colcon", "build", "--event-handlers", "console_direct+", *select, "--cmake-args",
            f"-DYAMARO_COMMAND={YAMARO}", f"-DPython3_EXECUTABLE={SYSTEM_PYTHON}",
            f"-Dyamaro_DIR={ROOT / 'ros/yamaro_ros/cmake'}", check=check,
        )  # fmt: skip

    def sourced(self, command: str, check: bool = True) -> str:
        """Run a command line with the set-up of the workspace sourced."""
        return self.run("sh", "-c", f". install/setup.sh && {command}", check=check)

    def change(self, path: Path, old: str, new: str) -> None:
        """Change a file; it is then newer than all that was built, as if some time had passed."""
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new, 1))
        built = [file.stat().st_mtime for file in (self.folder / "build").rglob("*.urdf")]
        time = max(built) + 0.001
        os.utime(path, (time, time))
