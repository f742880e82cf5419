"""Loads the configurations for mjlab and Isaac Lab of a corpus of public robots, and compares them.

    TRAINING=ENVIRONMENT/bin/python python bench/training.py [CORPUS] [--only REGEX]

TRAINING is a Python that can import mjlab 1.6 and isaaclab 3.0. Each joint that moves alone gets an
actuator that takes positions. What the frameworks find is compared with what MuJoCo finds in the
MJCF: gains, limits, armature, friction, damping and where the joints start.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from math import inf
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from bench.verdicts import built, run  # noqa: E402 - after the path

from yamaro.output import write_files  # noqa: E402

Found = dict[str, Any]
SINGLE = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE))


class Judge:
    """A process that tells what a framework finds."""

    def __init__(self, script: str) -> None:
        self._process = subprocess.Popen(
            [os.environ["TRAINING"], str(ROOT / "bench" / script)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )

    def ask(self, line: str) -> Found:
        """Return what it answers; raise ValueError if the framework refuses a configuration."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(f"{line}\n")
        self._process.stdin.flush()
        answer: Found = json.loads(self._process.stdout.readline())
        if "error" in answer:
            raise ValueError(answer["error"])
        return answer


MJLAB, ISAACLAB = Judge("mjlab_entities.py"), Judge("isaaclab_articulations.py")


def driven(path: Path, folder: Path) -> Path:
    """Return a copy of a robot with an actuator in each joint that moves alone.

    It is without sensors: lidars have thousands of rays, which MuJoCo 3.11 reads for minutes.
    """
    tree = ElementTree.parse(path)
    root = tree.getroot()
    for name in ("gazebo", "sensor"):
        for each in root.findall(name):
            root.remove(each)
    if root.find("ros2_control") is None:
        control = ElementTree.SubElement(root, "ros2_control", name="all", type="system")
        for joint in root.findall("joint"):
            moves = joint.get("type") in ("revolute", "continuous", "prismatic")
            if moves and joint.find("mimic") is None:
                own = ElementTree.SubElement(control, "joint", name=joint.get("name", ""))
                ElementTree.SubElement(own, "command_interface", name="position")
    copy = folder / f"{path.stem}{len(list(folder.iterdir()))}.urdf"
    tree.write(copy, encoding="unicode")
    return copy


def written(path: Path, target: str, folder: Path) -> Path:
    """Write a configuration and what belongs beside it; return its path."""
    build = built(path, target=target)
    document = folder / f"robot_{target}.py"
    files = {str(folder / name): data for name, data in build.assets.items()}
    write_files({**files, str(document): build.xml().encode()})
    return document


def of_mujoco(path: Path) -> dict[str, Found]:
    """Return what MuJoCo finds in the MJCF, for each joint of one number."""
    model = mujoco.MjModel.from_xml_string(built(path, target="mjcf").xml())
    found: dict[str, Found] = {}
    for i in range(model.njnt):
        joint = model.joint(i)
        if int(joint.type[0]) in SINGLE:
            dof = joint.dofadr[0]
            found[joint.name] = {
                "home": float(model.key("home").qpos[joint.qposadr[0]]),
                "armature": float(model.dof_armature[dof]),
                "friction": float(model.dof_frictionloss[dof]),
                "damping": float(model.dof_damping[dof]),
            }
    for i in range(model.nu):
        actuator = model.actuator(i)
        own = found[model.joint(actuator.trnid[0]).name]
        own["gain"], own["kp"] = float(actuator.gainprm[0]), -float(actuator.biasprm[1])
        own["effort"] = float(actuator.forcerange[1]) or inf
    return found


def difference(name: str, mine: object, theirs: object, allowed: float = 1e-9) -> str:
    """Return what differs, or ""."""
    if isinstance(mine, float) and isinstance(theirs, float):
        if abs(mine - theirs) <= allowed * max(1.0, abs(mine)) or mine == theirs:
            return ""
    elif mine == theirs:
        return ""
    return f"{name} {mine} {theirs}"


def judged_in_mjlab(path: Path, folder: Path) -> str:
    expected = {name.rpartition("/")[2]: own for name, own in of_mujoco(path).items()}
    found = MJLAB.ask(str(written(path, "mjlab", folder)))
    if [*found["joints"]] != [*expected]:
        return "mjlab DIFFERS: joints"
    commanded = [name for name, own in expected.items() if "kp" in own]
    wrong = difference("commanded", commanded, found["commanded"])
    for name, own in expected.items():
        given = found["joints"][name]
        for key in ("home", "armature", "friction", "damping"):
            wrong = wrong or difference(f"{key} of {name}", own[key], given[key])
        if "kp" in own:
            wrong = wrong or difference(f"gain of {name}", own["gain"], given["gain"][0])
            effort = given["force"][1] or inf
            wrong = wrong or difference(f"effort of {name}", own["effort"], effort)
            if own["effort"] != inf and own["kp"]:
                scale = 0.25 * own["effort"] / own["kp"]
                wrong = wrong or difference(f"scale of {name}", scale, found["scale"][name])
    return f"mjlab DIFFERS: {wrong}" if wrong else ""


def judged_in_isaaclab(path: Path, folder: Path) -> str:
    expected = of_mujoco(path)
    listing = json.loads(built(path, target="interface").xml())["consumers"]["isaac"]
    document = written(path, "isaaclab", folder)
    names = {each["name"]: each["yamaro"] for each in listing["joints"]}
    found = ISAACLAB.ask(json.dumps([str(document), list(names)]))
    wrong = "" if Path(found["usd"]).is_file() else "there is no USD"
    for name, given in found["joints"].items():
        own = expected[names[name]]
        effort = given["joint_effort_limit"] or inf
        wrong = wrong or difference(f"kp of {name}", own["kp"] + 0.0, given["stiffness"])
        wrong = wrong or difference(f"effort of {name}", own["effort"], effort)
        for key, theirs in (
            ("armature", "armature"),
            ("friction", "friction"),
            ("damping", "viscous_friction"),
        ):
            wrong = wrong or difference(f"{key} of {name}", own[key], given[theirs] or 0.0)
    for name, label in names.items():
        if label in expected:
            home = found["home"].get(name, 0.0)
            wrong = wrong or difference(f"home of {name}", expected[label]["home"], home, 2e-6)
    return f"Isaac Lab DIFFERS: {wrong}" if wrong else ""


def judged(path: Path, folder: Path, positions: int) -> str:
    """Return what is wrong with the configurations of a robot, or ""."""
    copy = driven(path, folder)
    verdicts = []
    for name, judge in (("mjlab", judged_in_mjlab), ("Isaac Lab", judged_in_isaaclab)):
        inner = folder / f"{copy.stem}_{name}"
        inner.mkdir()
        try:
            verdicts.append(judge(copy, inner))
        except ValueError as error:
            verdicts.append(f"{name} refuses it: {str(error).splitlines()[0][:90]}")
    return "; ".join(filter(None, verdicts))


if __name__ == "__main__":
    run(__doc__, judged)
