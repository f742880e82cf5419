"""Compares the robots of a corpus as `yamaro diff` does, and judges what it says.

    python bench/changes.py [CORPUS] [--only REGEX]

Of each robot of the corpus (its URDF, and what xacro makes of its xacro files):

- the robot does not differ from itself, and what Yamaro makes of a xacro file not from what xacro
  makes of it;
- the changes to other robots are the mirror image of the changes back;
- of each kind of change that is planted in it, exactly that one is found;
- pinocchio agrees, at 20 random positions, whether the robot with a planted change moves the same.
"""

from __future__ import annotations

import os
import random
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from lxml import etree
from robots import Corpus, corpus_asked_for

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import yamaro  # noqa: E402 - after the path
from tests.model.test_kinematics import Pinocchio  # noqa: E402
from yamaro import Robot  # noqa: E402
from yamaro.model import Joint  # noqa: E402
from yamaro.model.changes.change import Change, Changes  # noqa: E402

DISTANCES = (1, 7, 100)
"""How far apart in the list the robots are that are compared: relatives, and strangers."""
POSITIONS = 20
WIDEST = 4.0
"""How far from zero joints are moved: where there are no limits, some write the largest number."""
MOVING = ("revolute", "continuous", "prismatic")
NEW_NAME = "another_name_of_it"
REFERENCES = {
    "link": [
        *(("link", "name"), ("joint/parent", "link"), ("joint/child", "link")),
        ("gazebo", "reference"),
    ],
    "joint": [
        *(("joint", "name"), ("joint/mimic", "joint"), ("gazebo", "reference")),
        *(("transmission/joint", "name"), ("ros2_control/joint", "name")),
    ],
}
"""Where links and joints are named: paths of elements, and their attributes."""
SWAPPED = {"added": "removed", "removed": "added"}
Expected = tuple[str, str, str, str]
"""Kind, what it is about, its name, and which value: as in `Change`."""


def robots(corpus: Corpus) -> Iterator[Path]:
    """Yield the URDF files of the corpus."""
    yield from (corpus.path(row) for row in corpus.rows("urdf.tsv"))
    yield from (corpus.folder / row["expected"] for row in corpus.rows("xacro.tsv"))


# --- a robot and itself; there and back ---


def made_by_yamaro(corpus: Corpus, row: dict[str, str]) -> Changes:
    """Return the changes from what Yamaro makes of a xacro file to what xacro makes of it."""
    path = corpus.path(row)
    os.chdir(path.parent)
    arguments = [f"{name}:={value}" for name, value in corpus.arguments(row).items()]
    built = yamaro.build(
        path,
        command_line=arguments,
        packages=corpus.packages(row),
        on_message=lambda line: None,
        meshes="keep",
    )
    expected = corpus.real((corpus.folder / row["expected"]).read_text(encoding="utf-8"))
    return built.robot.changes(Robot.from_xml(expected), has_extras=False)


def mirrored(changes: Changes) -> object:
    """Return the changes as they are expected on the way back."""
    names = changes.links
    moved = {names.get(each, each) for c in changes if c.moved for each in c.moved.links}
    motion = changes.motion
    rows = []
    for change in changes:
        what = re.sub(r"\[(\d+)→(\d+)\]", r"[\2→\1]", change.what)
        own = (change.new_name or change.name, change.name if change.new_name else None)
        kind = SWAPPED.get(change.kind, change.kind)
        if change.of == "robot":
            own = ("", None)
        rows.append(repr((kind, change.of, *own, what, change.after, change.before)))
    return (
        *(sorted(rows), sorted(moved), motion.is_same, names.get(motion.reference, "")),
        sorted(changes.joints[name] for name in motion.ranges),
        sorted(changes.joints[name] for name in motion.opposite),
        {new: old for old, new in names.items()},
    )


def as_they_are(changes: Changes) -> object:
    moved = {each for c in changes if c.moved for each in c.moved.links}
    motion = changes.motion
    rows = [
        repr((c.kind, c.of, *(("", None) if c.of == "robot" else (c.name, c.new_name)),
              c.what, c.before, c.after))
        for c in changes
    ]  # fmt: skip
    return (
        *(sorted(rows), sorted(moved), motion.is_same, motion.reference),
        *(sorted(motion.ranges), sorted(motion.opposite), changes.links),
    )


# --- planted changes ---


def plant_mass(root: etree._Element, source: random.Random) -> Expected:
    mass = pick(root.findall("link/inertial/mass"), source)
    mass.set("value", str(float(mass.get("value")) + 1.5))
    return ("changed", "link", owner(mass), "mass")


def plant_center(root: etree._Element, source: random.Random) -> Expected:
    inertial = pick(root.findall("link/inertial"), source)
    move(child(inertial, "origin"), 0.25)
    return ("changed", "link", owner(inertial), "center_of_mass")


def plant_inertia(root: etree._Element, source: random.Random) -> Expected:
    inertia = pick(root.findall("link/inertial/inertia"), source)
    inertia.set("iyy", str(float(inertia.get("iyy")) * 1.01 + 0.01))
    return ("changed", "link", owner(inertia), "inertia")


def plant_limit(root: etree._Element, source: random.Random) -> Expected:
    limit = pick(root.findall("joint/limit[@upper]"), source)
    limit.set("upper", str(abs(float(limit.get("upper"))) * 2 + 1))
    return ("changed", "joint", owner(limit), "limit.upper")


def plant_effort(root: etree._Element, source: random.Random) -> Expected:
    limit = pick(root.findall("joint/limit[@effort]"), source)
    limit.set("effort", str(abs(float(limit.get("effort"))) * 2 + 1))
    return ("changed", "joint", owner(limit), "limit.effort")


def plant_damping(root: etree._Element, source: random.Random) -> Expected:
    joint = moving(root, source)
    dynamics = child(joint, "dynamics")
    dynamics.set("damping", str(float(dynamics.get("damping", 0)) + 0.5))
    return ("changed", "joint", joint.get("name"), "dynamics.damping")


def plant_axis(root: etree._Element, source: random.Random) -> Expected:
    joint = moving(root, source)
    axis = child(joint, "axis")
    old = [float(each) for each in axis.get("xyz", "1 0 0").split()]
    axis.set("xyz", " ".join(str(-each) for each in old))
    return ("changed", "joint", joint.get("name"), "axis")


def plant_origin(root: etree._Element, source: random.Random) -> Expected:
    joint = pick(root.findall("joint[@type]"), source)
    move(child(joint, "origin"), 0.01)
    return ("changed", "joint", joint.get("name"), "origin")


def plant_rotation(root: etree._Element, source: random.Random) -> Expected:
    joint = pick(root.findall("joint[@type]"), source)
    origin = child(joint, "origin")
    roll, *others = [float(each) for each in origin.get("rpy", "0 0 0").split()]
    origin.set("rpy", " ".join(map(str, (roll + 0.1, *others))))
    return ("changed", "joint", joint.get("name"), "origin")


def plant_twin(root: etree._Element, source: random.Random) -> None:
    """Write the same rotation in another way, which is no change."""
    origin = child(pick(root.findall("joint[@type]"), source), "origin")
    roll, pitch, yaw = (float(each) for each in origin.get("rpy", "0 0 0").split())
    origin.set("rpy", f"{roll + np.pi} {np.pi - pitch} {yaw + np.pi}")


def plant_order(root: etree._Element, source: random.Random) -> None:
    """Write links and joints in another order, which is no change.

    Links that define materials are left alone: of each name, the first definition counts.
    """
    own = [e for e in root if e.tag == "joint" or (e.tag == "link" and not defines(e))]
    for element in own:
        root.remove(element)
    source.shuffle(own)
    root.extend(own)


def defines(link: etree._Element) -> bool:
    return any(len(material) > 0 for material in link.iter("material"))


def plant_type(root: etree._Element, source: random.Random) -> Expected:
    joint = moving(root, source)
    joint.set("type", "fixed")
    return ("changed", "joint", joint.get("name"), "type")


def plant_link_name(root: etree._Element, source: random.Random) -> Expected:
    return ("renamed", "link", rename("link", root, source), "")


def plant_joint_name(root: etree._Element, source: random.Random) -> Expected:
    return ("renamed", "joint", rename("joint", root, source), "")


def plant_size(root: etree._Element, source: random.Random) -> Expected:
    sphere = pick(root.findall("link/*/geometry/cylinder"), source)
    sphere.set("length", str(float(sphere.get("length")) + 0.5))
    return ("changed", "link", owner(sphere), f"{sphere.getparent().getparent().tag}*.length")


def plant_mesh(root: etree._Element, source: random.Random) -> Expected:
    mesh = pick(root.findall("link/*/geometry/mesh"), source)
    mesh.set("filename", "another/file_of_it.stl")
    return ("changed", "link", owner(mesh), f"{mesh.getparent().getparent().tag}*.mesh")


def plant_added(root: etree._Element, source: random.Random) -> Expected:
    link = etree.SubElement(root, "link", name="another_link_of_it")
    etree.SubElement(etree.SubElement(link, "visual"), "geometry").append(
        etree.Element("sphere", radius="0.123")
    )
    joint = etree.SubElement(root, "joint", name="another_joint_of_it", type="fixed")
    etree.SubElement(joint, "parent", link=pick(root.findall("link"), source).get("name"))
    etree.SubElement(joint, "child", link="another_link_of_it")
    return ("added", "link", "another_link_of_it", "")


PLANTED: dict[str, Callable[[etree._Element, random.Random], Expected | None]] = {
    name.removeprefix("plant_"): function
    for name, function in list(globals().items())
    if name.startswith("plant_")
}


def pick(found: list[etree._Element], source: random.Random) -> etree._Element:
    if not found:
        raise LookupError
    return source.choice(found)


def moving(root: etree._Element, source: random.Random) -> etree._Element:
    joints = [each for each in root.findall("joint") if each.get("type") in MOVING]
    return pick([each for each in joints if each.find("mimic") is None], source)


def child(element: etree._Element, tag: str) -> etree._Element:
    found = element.find(tag)
    return etree.SubElement(element, tag) if found is None else found


def move(origin: etree._Element, by: float) -> None:
    x, *others = [float(each) for each in origin.get("xyz", "0 0 0").split()]
    origin.set("xyz", " ".join(map(str, (x + by, *others))))


def owner(element: etree._Element) -> str:
    while element.tag not in ("link", "joint"):
        element = element.getparent()
    return element.get("name")


def rename(kind: str, root: etree._Element, source: random.Random) -> str:
    """Rename a link or joint wherever it is meant; return what it was called."""
    old = pick(root.findall(f"{kind}[@name]"), source).get("name")
    for path, attribute in REFERENCES[kind]:
        for element in root.findall(path):
            if element.get(attribute) == old:
                element.set(attribute, NEW_NAME)
    rest = etree.tostring(root, encoding="unicode")
    if re.search(rf"(?<![\w/]){re.escape(old)}(?![\w/])", rest):
        raise LookupError  # something else has this name
    return old


def is_as_planted(expected: Expected | None, changes: list[Change]) -> bool:
    """Return whether what was found is what was planted; a link is added with its joint."""
    if expected is None:
        return not changes
    kind, of, name, what = expected
    if kind == "added":
        return [(c.kind, c.of) for c in changes] == [("added", "link"), ("added", "joint")]
    pattern = re.escape(what).replace(r"\*", r"(\[\d+\])?")
    return (
        len(changes) == 1
        and (changes[0].kind, changes[0].of, changes[0].name) == (kind, of, name)
        and re.fullmatch(pattern, changes[0].what) is not None
    )


# --- the judge ---


def moves_the_same(one: str, other: str, changes: Changes) -> bool | None:
    """Return what pinocchio says, which compares all links at random positions; None if nothing."""
    try:
        judges = Pinocchio(one), Pinocchio(other)
    except ValueError:
        return None
    robot, twin = Robot.from_xml(one), Robot.from_xml(other)
    free = [joint for joint in robot.free_joints() if joint.type in MOVING]
    if len(free) < len(robot.free_joints()) or len(free) != len(twin.free_joints()):
        return None
    source = random.Random(5)
    for number in range(POSITIONS):
        given = {j.name: position(j, source) if number else 0.0 for j in free}
        new = {changes.joints[name]: at for name, at in given.items()}
        poses, others = (
            judge.poses(at | followers(each, at))
            for judge, each, at in zip(judges, (robot, twin), (given, new), strict=True)
        )
        top, other_top = changes.motion.reference, changes.links[changes.motion.reference]
        base, other_base = (
            np.linalg.inv(each[name]) for each, name in ((poses, top), (others, other_top))
        )
        for link, twin_link in changes.links.items():
            a, b = base @ poses[link], other_base @ others[twin_link]
            if not np.allclose(a, b, atol=1e-6):
                return False
    return True


def position(joint: Joint, source: random.Random) -> float:
    low, high = joint.range
    middle = min(max(0.0, low), high)
    return source.uniform(max(low, middle - WIDEST), min(high, middle + WIDEST))


def followers(robot: Robot, given: dict[str, float]) -> dict[str, float]:
    """Return the positions of joints that mimic others, which pinocchio moves on their own."""
    return {
        joint.name: joint.mimic.multiplier * given[joint.mimic.joint] + joint.mimic.offset
        for joint in robot.joints.values()
        if joint.mimic is not None and joint.mimic.joint in given
    }


class Tally:
    """How often each trial was done, and how often it came out."""

    def __init__(self) -> None:
        self.tried: Counter[str] = Counter()
        self.right: Counter[str] = Counter()
        self.wrong: list[str] = []

    def add(self, what: str, is_right: bool, where: str) -> None:
        self.tried[what] += 1
        if is_right:
            self.right[what] += 1
        else:
            self.wrong.append(f"{what}: {where}")


def try_planted(path: Path, name: str, tally: Tally) -> None:
    """Plant one change of each kind."""
    text = path.read_bytes()
    one = etree.tostring(etree.fromstring(text), encoding="unicode")
    for kind, plant in PLANTED.items():
        root = etree.fromstring(text)
        try:
            expected = plant(root, random.Random(name + kind))
        except (LookupError, ValueError, TypeError):  # nothing to change in this robot
            continue
        other = etree.tostring(root, encoding="unicode")
        changes = Robot.from_xml(one).changes(Robot.from_xml(other))
        right = is_as_planted(expected, changes.changes)
        tally.add(f"planted {kind}", right, f"{name}: {expected} gives {changes.changes[:4]}")
        judged = moves_the_same(one, other, changes)
        if judged is not None:
            where = f"{name}: {kind}: {changes.motion.reason}, pinocchio: {judged}"
            tally.add("moves the same, by pinocchio", changes.motion.is_same == judged, where)


def main() -> None:
    corpus = corpus_asked_for(__doc__)
    tally = Tally()
    paths = list(robots(corpus))
    for number, path in enumerate(paths):
        name = str(path.relative_to(corpus.folder))
        changes = Robot.from_urdf(path).changes(Robot.from_urdf(path))
        tally.add("x and x", not changes and changes.motion.is_same, name)
        for distance in DISTANCES:
            other = paths[(number + distance) % len(paths)]
            there = Robot.from_urdf(path).changes(Robot.from_urdf(other))
            back = Robot.from_urdf(other).changes(Robot.from_urdf(path))
            is_mirrored = mirrored(there) == as_they_are(back)
            tally.add("there and back", is_mirrored, f"{name} and {other}")
        try_planted(path, name, tally)
    for row in corpus.rows("xacro.tsv"):
        changes = made_by_yamaro(corpus, row)
        tally.add("xacro and Yamaro", not changes, f"{row['path']}: {changes.changes[:3]}")
    print("| | tried | right |\n|---|--:|--:|")
    for what, count in tally.tried.items():
        print(f"| {what} | {count} | {tally.right[what]} |")
    print("", *tally.wrong, sep="\n")
    sys.exit(1 if tally.wrong else 0)


if __name__ == "__main__":
    main()
