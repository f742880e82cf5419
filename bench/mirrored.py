"""Mirrors the left legs of public robots, and compares them with the right legs of their vendors.

    python bench/mirrored.py [CORPUS]

CORPUS is the folder that bench/robots.py takes. A table counts the values that differ by more than
a part in a thousand and more than 1e-9; below it each is listed. Vendors write right legs by hand,
from another CAD model, or with the left leg's numbers, so that differences are expected.
"""

from __future__ import annotations

import argparse
import tempfile
import warnings
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import yamaro

ROOT = Path(__file__).parents[1]
VALUES = {
    "joint/origin": ("xyz", "rpy"),
    "joint/axis": ("xyz",),
    "joint/limit": ("lower", "upper", "effort", "velocity"),
    "link/inertial/origin": ("xyz",),
    "link/inertial/mass": ("value",),
    "link/inertial/inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"),
}
Names = dict[str, ElementTree.Element]


class Leg(NamedTuple):
    """A left leg: its first joint, and how its names become those of the right one."""

    robot: str
    path: str
    first: str
    old: str
    new: str


LEGS = [
    Leg(
        "A1, front",
        "src/Gepetto+example-robot-data/robots/a1_description/urdf/a1.urdf",
        "FL_hip_joint",
        "FL",
        "FR",
    ),
    Leg(
        "A1, rear",
        "src/Gepetto+example-robot-data/robots/a1_description/urdf/a1.urdf",
        "RL_hip_joint",
        "RL",
        "RR",
    ),
    Leg(
        "Digit",
        "src/adubredu+DigitRobot.jl/urdf/digit_model.urdf",
        "hip_abduction_left",
        "left",
        "right",
    ),
    Leg(
        "NAO",
        "src/ros-naoqi+nao_robot/nao_description/urdf/naoV50_generated_urdf/nao.urdf",
        "LHipYawPitch",
        "L",
        "R",
    ),
    Leg(
        "Talos",
        "expected/Gepetto+example-robot-data/robots/talos_data/robots/talos_reduced.urdf.urdf",
        "leg_left_1_joint",
        "left",
        "right",
    ),
]


def leg_of(robot: ElementTree.Element, first: str) -> list[ElementTree.Element]:
    """Return the joints and links from a joint on; names with a slash are those of sensors."""
    links = {each.get("name"): each for each in robot.iter("link")}
    found: list[ElementTree.Element] = []
    pending = [first]
    joints = {each.get("name"): each for each in robot.findall("joint")}
    while pending:
        joint = joints[pending.pop(0)]
        child = joint.find("child").get("link")
        found += [joint, links[child]]
        pending += [
            name
            for name, each in joints.items()
            if each.find("parent").get("link") == child and "/" not in name
        ]
    return found


def rename(leg: Leg, elements: list[ElementTree.Element]) -> dict[str, str]:
    """Return what `rename` needs: a word, or whole names where the side is a letter of a word."""
    if leg.old != "L":
        return {leg.old: leg.new}
    names = {each.get("name") for each in elements}
    return {name: ("r" if name[0] == "l" else "R") + name[1:] for name in sorted(names)}


def mirrored(
    leg: Leg, elements: list[ElementTree.Element], axes: str
) -> tuple[ElementTree.Element, dict[str, str]]:
    """Return a robot of the left leg and its image."""
    base = elements[0].find("parent").get("link")
    words = rename(leg, elements)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        part = ElementTree.Element("robot", name="leg")
        part.extend(elements)
        ElementTree.ElementTree(part).write(folder / "leg.urdf")
        listed = ", ".join(f"{old}: {new}" for old, new in words.items())
        (folder / "robot.yaml").write_text(
            f"robot: mirrored\nmodel:\n- link/name={base}:\n- mirror:\n"
            f"    rename: {{{listed}}}\n    axes: {axes}\n    body:\n      include: leg.urdf\n"
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ElementTree.fromstring(yamaro.convert(folder / "robot.yaml")), words


def named(robot: ElementTree.Element) -> Names:
    return {f"{each.tag} {each.get('name')}": each for each in robot if each.get("name")}


def numbers(element: ElementTree.Element, path: str, attribute: str) -> tuple[float, ...]:
    """Return the numbers at a place, with what URDF takes if they are left out."""
    found = element.find(path.partition("/")[2])
    value = None if found is None else found.get(attribute)
    if value is None:
        value = "1 0 0" if path == "joint/axis" else "0 0 0" if attribute in ("xyz", "rpy") else "0"
    return tuple(map(float, value.split()))


def is_near(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return all(abs(a - b) <= max(1e-9, 1e-3 * abs(b)) for a, b in zip(one, other, strict=True))


def what_it_is(
    path: str, attribute: str, ours: tuple[float, ...], theirs: tuple[float, ...], left: object
) -> str:
    """Return in words how a value of the vendor differs."""
    if theirs == left:
        return "the vendor has the left leg's value, not mirrored"
    if is_near(ours, tuple(-each for each in theirs)):
        return "the opposite sign"
    if is_near(tuple(map(abs, ours)), tuple(map(abs, theirs))):
        return "other signs"
    if path == "joint/limit":
        return "another range or rating"
    largest = max(map(abs, theirs)) or 1.0
    part = max(abs(a - b) for a, b in zip(ours, theirs, strict=True)) / largest
    return f"another number, by {100 * part:.2g} %"


def compare(leg: Leg, robot: ElementTree.Element, axes: str) -> tuple[int, list[str]]:
    """Return how many values were compared, and a line for each that differs."""
    elements = leg_of(robot, leg.first)
    made, words = mirrored(leg, elements, axes)
    ours, theirs = named(made), named(robot)
    count, lines = 0, []
    for element in elements:
        old = element.get("name")
        new = words.get(old) or "_".join(words.get(word, word) for word in old.split("_"))
        key = f"{element.tag} {new}"
        if key not in theirs:
            lines.append(f"{key}: the vendor's robot has none")
            continue
        for path, attributes in VALUES.items():
            if not path.startswith(element.tag):
                continue
            if path in ("joint/axis", "joint/limit") and element.get("type") == "fixed":
                continue
            for attribute in attributes:
                count += 1
                one = numbers(ours[key], path, attribute)
                other = numbers(theirs[key], path, attribute)
                if not is_near(one, other):
                    left = numbers(element, path, attribute)
                    reason = what_it_is(path, attribute, one, other, left)
                    shown = " ".join(f"{x:g}" for x in one), " ".join(f"{x:g}" for x in other)
                    place = f"{path.partition('/')[2]}@{attribute}"
                    lines.append(f"{key} {place}: {shown[0]}, vendor {shown[1]}: {reason}")
    return count, lines


def main() -> None:
    """Compare all legs, with the axes treated as each robot does."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", nargs="?", type=Path, default=ROOT.parent / "shared" / "corpus")
    options = parser.parse_args()
    if not options.corpus.exists():
        parser.exit(0, "no corpus, nothing compared\n")
    details = []
    print("| leg | axes | values | same | different |\n|---|---|---:|---:|---:|")
    for leg in LEGS:
        robot = ElementTree.parse(options.corpus / leg.path).getroot()
        found = {axes: compare(leg, robot, axes) for axes in ("keep", "mirror")}
        axes = min(found, key=lambda each: len(found[each][1]))
        count, lines = found[axes]
        print(f"| {leg.robot} | {axes} | {count} | {count - len(lines)} | {len(lines)} |")
        details += [f"\n{leg.robot}:", *(f"- {line}" for line in lines)]
    print("\n".join(details))


if __name__ == "__main__":
    main()
