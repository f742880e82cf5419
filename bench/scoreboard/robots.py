"""The robots: where each comes from, and its folder as tools are given it.

A URDF, or what xacro makes of a xacro file, is `robot.urdf` with its meshes in `meshes/` beside it:
every tool finds them there, and none has to know of packages. An MJCF is in its own folder.
"""

from __future__ import annotations

import importlib.metadata
import os
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from bench.others import expanded
from lxml import etree

PIP = ("example-robot-data", "6.0.0")


@dataclass(frozen=True)
class Robot:
    """A robot of a public collection."""

    name: str
    kind: str
    path: str
    """Of its file, in its repository or in the folder of robots of the Python package."""
    licence: str
    repository: str = ""
    """owner/name on GitHub; "" for the Python package."""
    commit: str = ""
    packages: Mapping[str, str] = field(default_factory=dict)
    arguments: Mapping[str, str] = field(default_factory=dict)

    @property
    def format(self) -> str:
        """The format that its authors write it in."""
        ending = Path(self.path).suffix
        return {".xacro": "xacro", ".xml": "mjcf"}.get(ending, "urdf")

    @property
    def read_as(self) -> str:
        """The format in which outside readers read it."""
        return "mjcf" if self.format == "mjcf" else "urdf"


UR = "UniversalRobots/Universal_Robots_ROS2_Description", "2221ec0f720fb1af99339eb891639b499b62f1da"
XARM = "xArm-Developer/xarm_ros2", "3654ba7bb2a0e502088251728d07263ea399d4a4"
ROBOTIQ = "PickNikRobotics/ros2_robotiq_gripper", "3b6cf8ff9106384e72c23de7d3ba989fb6b41141"
BCR = "blackcoffeerobotics/bcr_bot", "b62eeb4b83f70f4ba3789532e72ef9ea0bca3b48"
SO_ARM = "TheRobotStudio/SO-ARM100", "fda892cba81032c46c40976a48c9ceadbf40a9ca"
UNITREE = "unitreerobotics/unitree_mujoco", "c598f103acb87a5fd3de7c9037f4dab6aa7f232b"
OPENARM = "enactic/openarm_mujoco", "396c88d87fc7eb485e4497ac043c4d95f526139e"
MINK = "kevinzakka/mink", "cf1a302ff31b1f620abecdcbdebfd2c42d125a54"

ROBOTS = (
    Robot("Panda", "arm with a gripper", "panda_description/urdf/panda.urdf", "Apache-2.0"),
    Robot("Go1", "quadruped with cameras", "go1_description/urdf/go1.urdf", "BSD-3-Clause"),
    Robot("G1", "humanoid", "g1_description/urdf/g1_29dof_rev_1_0.urdf", "BSD-3-Clause"),
    Robot("Allegro", "hand", "allegro_hand_description/urdf/allegro_right_hand.urdf", "BSD"),
    Robot("TIAGo", "mobile manipulator", "tiago_description/robots/tiago.urdf", "Apache-2.0"),
    Robot("Iris", "drone", "iris_description/robots/iris.urdf", "Apache-2.0"),
    Robot("UR5e", "arm", "urdf/ur.urdf.xacro", "BSD-3-Clause", *UR,
          packages={"ur_description": ""}, arguments={"ur_type": "ur5e", "name": "ur5e"}),
    Robot("xArm6", "arm with a gripper", "xarm_description/urdf/xarm_device.urdf.xacro",
          "BSD-3-Clause", *XARM,
          packages={"xarm_description": "xarm_description", "xarm_controller": "xarm_controller"},
          arguments={"dof": "6", "add_gripper": "true"}),
    Robot("2F-85", "gripper", "robotiq_description/urdf/robotiq_2f_85_gripper.urdf.xacro",
          "BSD-3-Clause", *ROBOTIQ, packages={"robotiq_description": "robotiq_description"}),
    Robot("bcr_bot", "mobile robot with sensors", "urdf/bcr_bot.xacro", "Apache-2.0", *BCR,
          packages={"bcr_bot": ""},
          arguments={"sim_gz": "true", "camera_enabled": "true", "two_d_lidar_enabled": "true"}),
    Robot("SO-101", "arm", "Simulation/SO101/so101_new_calib.xml", "Apache-2.0", *SO_ARM),
    Robot("H1", "humanoid", "unitree_robots/h1/h1.xml", "BSD-3-Clause", *UNITREE),
    Robot("ALOHA", "two arms with grippers", "examples/aloha/aloha.xml", "BSD-3-Clause", *MINK),
    Robot("OpenArm", "two arms", "v1/openarm_bimanual.xml", "Apache-2.0", *OPENARM),
    Robot("Shadow Hand", "hand", "examples/shadow_hand/right_hand.xml", "Apache-2.0", *MINK),
)  # fmt: skip


class Missing(Exception):
    """A robot is not available; the message says why."""


@dataclass(frozen=True)
class Source:
    """A robot on this machine."""

    robot: Robot
    folder: Path
    """What a tool is given a copy of."""
    path: Path
    """The file that readers read, in that folder."""
    original: Path
    """The file as its authors wrote it, where its packages are."""
    packages: Mapping[str, Path]


def brought(robot: Robot, cache: Path) -> Source:
    """Bring a robot into the cache, if it is not there."""
    if robot.repository:
        base = _cloned(robot, cache / "repositories")
    else:
        base = _installed() / "robots"
    original = base / robot.path
    if not original.exists():
        raise Missing(f"{robot.path} is not in {base}")
    packages = {name: base / at for name, at in robot.packages.items()}
    packages.setdefault(PIP[0], base.parent)
    if robot.format == "mjcf":
        return Source(robot, original.parent, original, original, packages)
    folder = cache / "robots" / robot.name.lower().replace(" ", "-")
    path = folder / "robot.urdf"
    if not path.exists():
        shutil.rmtree(folder, ignore_errors=True)
        _gather(_urdf(robot, original, packages), original, packages, folder)
    return Source(robot, folder, path, original, packages)


def _installed() -> Path:
    try:
        files = importlib.metadata.files(PIP[0]) or []
    except importlib.metadata.PackageNotFoundError as error:
        raise Missing(f"pip install {PIP[0]}=={PIP[1]}") from error
    file = next(each for each in files if each.name == "package.xml")
    return Path(str(file.locate())).resolve().parent


def _cloned(robot: Robot, cache: Path) -> Path:
    folder = cache / robot.repository.replace("/", "-")
    folders = robot.packages.values() or [str(Path(robot.path).parent)]
    folder /= "-".join(each.rpartition("/")[2] for each in folders) or "all"
    stamp = folder / ".git" / f"has-{robot.commit}"
    if stamp.exists():
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    url = f"https://github.com/{robot.repository}"
    for command in (
        ["init", "-q"],
        ["remote", "add", "origin", url],
        ["config", "remote.origin.promisor", "true"],
        ["config", "remote.origin.partialclonefilter", "blob:none"],
        ["fetch", "-q", "--depth", "1", "--filter=blob:none", "origin", robot.commit],
        *([["sparse-checkout", "set", *folders]] if all(folders) else []),
        ["-c", "advice.detachedHead=false", "checkout", "-q", "FETCH_HEAD"],
    ):
        environment = {**os.environ, "GIT_TERMINAL_PROMPT": "0", "GIT_LFS_SKIP_SMUDGE": "1"}
        done = subprocess.run(
            ["git", "-C", str(folder), *command], capture_output=True, text=True, env=environment
        )
        if done.returncode:
            raise Missing(f"{url} at {robot.commit[:7]}: {done.stderr.strip().splitlines()[-1]}")
    stamp.touch()
    return folder


def _urdf(robot: Robot, path: Path, packages: Mapping[str, Path]) -> str:
    if robot.format == "urdf":
        return path.read_text(encoding="utf-8")
    text = expanded(path, robot.arguments, lambda name: str(packages[name]))
    if text is None:
        raise Missing(f"xacro has an error with {path}")
    return text


def _gather(text: str, original: Path, packages: Mapping[str, Path], folder: Path) -> None:
    """Write a URDF with its meshes beside it."""
    root = etree.fromstring(text.encode())
    (folder / "meshes").mkdir(parents=True)
    names: dict[Path, str] = {}
    for mesh in root.iterfind("link//mesh"):
        uri = mesh.get("filename").removeprefix("file://")
        if uri.startswith("package://"):
            package, _, rest = uri.removeprefix("package://").partition("/")
            if package not in packages:
                raise Missing(f"package {package}")
            path = packages[package] / rest
        else:
            path = original.parent / uri
        path = path.resolve()
        if path not in names:
            taken = {each.lower() for each in names.values()}
            name, parent = path.name.replace(" ", "_"), path.parent
            while name.lower() in taken:
                name, parent = f"{parent.name}_{name}", parent.parent
            names[path] = name
            shutil.copyfile(path, folder / "meshes" / name)
            beside = path.with_suffix(".mtl")
            if path.suffix.lower() == ".obj" and beside.exists():
                shutil.copyfile(beside, folder / "meshes" / beside.name)
        mesh.set("filename", f"meshes/{names[path]}")
    etree.ElementTree(root).write(folder / "robot.urdf", encoding="utf-8", xml_declaration=True)
