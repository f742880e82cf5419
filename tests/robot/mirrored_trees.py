"""Random robots in the body of a `mirror`, and what a reflection makes of their motion."""

from __future__ import annotations

import random
from typing import NamedTuple

AXES = ("1 0 0", "0 1 0", "0 0 1", "0 -1 0", "-1 0 0")


class Tree(NamedTuple):
    """A program whose robot has random links in the body of a `mirror`."""

    body: str
    plane: str
    axes: str

    def program(self) -> str:
        """Return the YAML of the robot."""
        return (
            "robot: random\nmodel:\n- link/name=base:\n"
            f"- mirror:\n    plane: {self.plane}\n    axes: {self.axes}\n"
            f"    rename: {{left: right}}\n    body:\n{self.body}"
        )

    def there_and_back(self) -> str:
        """Return a program in which the image is mirrored once more, to `old` names."""
        inner = "".join(f"      {line}\n" for line in self.body.splitlines())
        return (
            "robot: random\nmodel:\n- link/name=base:\n"
            f"- mirror:\n    plane: {self.plane}\n    axes: {self.axes}\n"
            "    rename: {left: new, right: old}\n    body:\n"
            f"    - mirror:\n        plane: {self.plane}\n        axes: {self.axes}\n"
            f"        rename: {{left: right}}\n        body:\n{inner}"
        )


def random_tree(seed: int, plane: str, axes: str) -> Tree:
    """Return a tree of 2 to 40 links with joints, inertia and mimics of all kinds."""
    dice = random.Random(seed)
    parts: list[str] = []
    leaders: list[str] = []
    for number in range(dice.randint(2, 40)):
        parent = "base" if number == 0 else f"left_{dice.randrange(number)}"
        joint = _joint(dice, parent, leaders)
        if "mimic" not in joint and "fixed" not in joint:
            leaders.append(f"left_{number}")
        parts.append(
            f"    - part:\n        name: left_{number}\n        joint: {{{joint}}}\n"
            f"        link: {{{_link(dice)}}}\n"
        )
    return Tree("".join(parts), plane, axes)


def _joint(dice: random.Random, parent: str, leaders: list[str]) -> str:
    kind = dice.choice(("revolute", "continuous", "prismatic", "fixed"))
    words = [f"type: {kind}", f"parent: {parent}", f"xyz: {_row(dice)}", f"rpy: {_row(dice, 3)}"]
    if kind == "fixed":
        return ", ".join(words)
    axis = _row(dice, 1) if dice.random() < 0.3 else dice.choice(AXES)
    words.append(f"axis: {axis}")
    lower, upper = dice.uniform(-2, 0), dice.uniform(0.1, 2)
    if kind != "continuous":
        words.append(f"limit: {{lower: {lower}, upper: {upper}, effort: 9, velocity: 3}}")
    if leaders and kind != "continuous" and dice.random() < 0.3:
        ratio, offset = dice.uniform(-2, 2), dice.uniform(-1, 1)
        leader = dice.choice(leaders)
        words.append(f"mimic: {{joint: {leader}, multiplier: {ratio}, offset: {offset}}}")
    return ", ".join(words)


def _link(dice: random.Random) -> str:
    """Return an inertial with products of inertia that a body can have: the sum of three points."""
    moments = [0.0] * 6
    for _ in range(4):
        x, y, z = (dice.uniform(-0.3, 0.3) for _ in range(3))
        for index, moment in enumerate((y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z)):
            moments[index] += moment
        moments[5] += x * x + y * y
    row = " ".join(map(repr, moments))
    pose = f"xyz: {_row(dice)}, rpy: {_row(dice, 3)}"
    return f"inertial: {{mass: {dice.uniform(0.1, 5)}, {pose}, inertia: {row}}}"


def _row(dice: random.Random, most: float = 0.5) -> str:
    return " ".join(repr(round(dice.uniform(-most, most), 6)) for _ in range(3))
