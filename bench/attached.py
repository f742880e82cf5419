"""Composes robots by `attach`, and compares them with those that vendors compose in xacro.

    python bench/attached.py [CORPUS]

CORPUS is the folder that bench/robots.py takes. Names differ by the prefixes; the tree, the types,
axes and limits of joints, masses, inertias and the poses of all links at zero have to be the same.
A `world` that an attached robot begins with stays as an empty link, and is left out.
"""

from __future__ import annotations

import argparse
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

import numpy as np

import yamaro

ROOT = Path(__file__).parents[1]
FRANKA = "src/frankaemika+franka_ros/franka_description"
UR = "src/UniversalRobots+Universal_Robots_ROS2_Description"
CELL = (
    "src/UniversalRobots+Universal_Robots_ROS2_Tutorials/my_dual_robot_cell/"
    "my_dual_robot_cell_description"
)
ROBOTIQ = "src/PickNikRobotics+ros2_robotiq_gripper/robotiq_description"
PACKAGES = {
    "franka_description": FRANKA,
    "ur_description": UR,
    "robotiq_description": ROBOTIQ,
    "my_dual_robot_cell_description": CELL,
}
DUAL = FRANKA.replace("src/", "expected/") + "/robots/dual_panda/dual_panda_example.urdf.xacro.urdf"

FR3 = f"""
- include: @/{FRANKA}/robots/fr3/fr3.urdf.xacro
- attach: {{path: @/{FRANKA}/robots/common/hand.urdf.xacro, to: fr3_link8, rpy: 0 0 $(-pi / 4)}}
"""
PANDAS = f"""
- link/name=base:
- 'for side, y in {{1: -0.5, 2: 0.5}}':
    attach:
      path: @/{FRANKA}/robots/panda/panda.urdf.xacro
      to: base
      prefix: $(side)_
      xyz: 0 $(y) 1
      hand: true
"""
GRIPPER = f"""
- include: {{path: @/{UR}/urdf/ur.urdf.xacro, ur_type: ur5e, name: ur}}
- attach: {{path: @/{ROBOTIQ}/urdf/robotiq_2f_85_gripper.urdf.xacro, to: tool0, prefix: hand_}}
"""
GRIPPER_IN_XACRO = f"""<robot name="ur" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="@/{UR}/urdf/ur.urdf.xacro"/>
  <xacro:include filename="@/{ROBOTIQ}/urdf/robotiq_2f_85_macro.urdf.xacro"/>
  <xacro:robotiq_gripper name="hand" prefix="hand_" parent="tool0" use_fake_hardware="true"
      com_port="/dev/ttyUSB0"><origin xyz="0 0 0" rpy="0 0 0"/></xacro:robotiq_gripper>
</robot>"""
ARMS = f"""
- include: cell.urdf
- "for owner, kind in {{'alice': 'ur3e', 'bob': 'ur5e'}}":
    attach:
      path: @/{UR}/urdf/ur.urdf.xacro
      to: $(owner)_robot_mount
      prefix: $(owner)_
      ur_type: $(kind)
      name: $(owner)
"""


class Link(NamedTuple):
    """What is compared of a link."""

    parent: str
    joint: tuple[object, ...]
    inertial: list[float]
    pose: Any


def rotation(roll: float, pitch: float, yaw: float) -> Any:
    (a, b, c), (d, e, f) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, a, -d], [0, d, a]])
    about_y = np.array([[b, 0, e], [0, 1, 0], [-e, 0, b]])
    return np.array([[c, -f, 0], [f, c, 0], [0, 0, 1]]) @ about_y @ about_x


def row(element: ElementTree.Element | None, name: str, default: str = "0 0 0") -> list[float]:
    text = default if element is None else element.get(name, default)
    return [float(word) for word in text.split()]


def pose_of(element: ElementTree.Element) -> Any:
    origin, T = element.find("origin"), np.eye(4)
    T[:3, :3], T[:3, 3] = rotation(*row(origin, "rpy")), row(origin, "xyz")
    return T


def links_of(urdf: str, name: Callable[[str], str]) -> dict[str, Link]:
    """Return the links of a robot, without empty ones that are called world or …_world."""
    root = ElementTree.fromstring(urdf)
    joints = {each.find("child").get("link"): each for each in root.findall("joint")}
    found: dict[str, Link] = {}
    for element in root.findall("link"):
        own = at = element.get("name")
        T = np.eye(4)
        while at in joints:
            T, at = pose_of(joints[at]) @ T, joints[at].find("parent").get("link")
        joint, parent = joints.get(own), ""
        if joint is not None:
            parent = joint.find("parent").get("link")
            if parent.endswith("_world") and parent in joints:
                parent = joints[parent].find("parent").get("link")
        if own.endswith("_world") and not len(element):
            continue
        found[name(own)] = Link(parent and name(parent), facts(joint), inertial(element), T)
    return found


def facts(joint: ElementTree.Element | None) -> tuple[object, ...]:
    """Return what a joint does."""
    if joint is None:
        return ()
    kind, limit = joint.get("type"), joint.find("limit")
    if kind == "fixed":
        return (kind,)
    limits = [] if limit is None else sorted((k, float(v)) for k, v in limit.attrib.items())
    return (kind, row(joint.find("axis"), "xyz", "1 0 0"), limits)


def inertial(link: ElementTree.Element) -> list[float]:
    found = link.find("inertial")
    if found is None:
        return []
    moments = sorted(found.find("inertia").attrib.items())
    origin = row(found.find("origin"), "xyz") + row(found.find("origin"), "rpy")
    return [float(found.find("mass").get("value")), *origin, *(float(v) for _, v in moments)]


def worst(ours: dict[str, Link], theirs: dict[str, Link]) -> tuple[str, float]:
    """Return what differs, and the largest difference of two poses."""
    if ours.keys() != theirs.keys():
        return f"links {sorted(ours.keys() ^ theirs.keys())}", 0.0
    pairs = [(ours[name], theirs[name], name) for name in ours]
    different = [name for one, other, name in pairs if one[:3] != other[:3]]
    largest = max(float(np.abs(one.pose - other.pose).max()) for one, other, _ in pairs)
    return f"{different}" if different else "nothing", largest


class Trial:
    """Builds robots from a corpus."""

    def __init__(self, corpus: Path, folder: Path) -> None:
        self.corpus, self.folder = corpus, folder
        self.packages = {name: str(corpus / path) for name, path in PACKAGES.items()}

    def build(self, name: str, text: str, *given: str) -> str:
        path = self.folder / name
        text = text.replace("@/", f"{self.corpus}/").replace("@CORPUS@", str(self.corpus))
        path.write_text(text)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return yamaro.convert(path, *given, packages=self.packages)

    def program(self, model: str) -> str:
        return self.build("robot.yaml", f"robot: composed\nmodel:{model}")

    def say(self, what: str, ours: str, theirs: str, name: Callable[[str], str]) -> bool:
        found = links_of(ours, name)
        different, largest = worst(found, links_of(theirs, lambda each: each))
        print(f"| {what} | {len(found)} | {different} | {largest:.1e} |")
        return different == "nothing" and largest <= 1e-12


def cell(urdf: str) -> str:
    """Return the dual cell without its arms."""
    root = ElementTree.fromstring(urdf)
    arms = ("alice_", "bob_")
    for element in list(root):
        child = element.find("child")
        own = element.get("name", "") if child is None else child.get("link")
        if own.startswith(arms) and not own.endswith("robot_mount"):
            root.remove(element)
    return ElementTree.tostring(root, encoding="unicode")


def main() -> None:
    """Compose each robot in both ways."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    options = parser.parse_args()
    if not options.corpus.exists():
        parser.exit(0, "no corpus, nothing compared\n")
    corpus = options.corpus.resolve()
    with tempfile.TemporaryDirectory() as folder:
        trial = Trial(corpus, Path(folder))
        print("| robot | links | differs | poses |\n|---|---:|---|---:|")
        vendor = corpus / (FRANKA.replace("src/", "expected/") + "/robots/fr3")
        fr3 = (vendor / "fr3.urdf.xacro#hand.urdf").read_text()
        same = [
            trial.say(
                "FR3 with its hand",
                trial.program(FR3),
                fr3,
                lambda name: name.replace("panda_", "fr3_"),
            ),
            trial.say(
                "two Pandas with hands",
                trial.program(PANDAS),
                (corpus / DUAL).read_text(),
                lambda name: name if name == "base" else f"panda_{name.replace('_panda', '', 1)}",
            ),
            trial.say(
                "UR5e with a Robotiq 2F-85",
                trial.program(GRIPPER),
                trial.build("ur.urdf.xacro", GRIPPER_IN_XACRO, "ur_type:=ur5e", "name:=ur"),
                lambda name: name,
            ),
        ]
        composed = corpus / CELL.replace("src/", "expected/")
        urdf = (composed / "urdf/my_dual_robot_cell.urdf.xacro.urdf").read_text()
        (Path(folder) / "cell.urdf").write_text(cell(urdf))
        same.append(trial.say("UR3e and UR5e in a cell", trial.program(ARMS), urdf, lambda n: n))
    raise SystemExit(not all(same))


if __name__ == "__main__":
    main()
