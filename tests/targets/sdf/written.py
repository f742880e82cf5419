"""Writes robots in SDFormat for tests."""

from __future__ import annotations

import os

import yamaro
from yamaro.model import Robot
from yamaro.policy import Limits
from yamaro.targets.bodies import Bodies, is_world
from yamaro.targets.mesh_paths import KEEP, MeshPaths
from yamaro.targets.output import Loss, Wanted
from yamaro.targets.sdf import write
from yamaro.xml.writer import write_pieces


def is_fixed_by_default(robot: Robot) -> bool:
    """Return whether the root stands for the world or has no mass."""
    root = robot.roots[0]
    return is_world(robot, root) or root.mass == 0


def sdf_of(
    build: yamaro.Build, version: str = "", *, fixed: bool | None = None
) -> tuple[str, list[Loss]]:
    """Return a robot in SDFormat, and what is lost in it."""
    robot = build.robot
    is_fixed = is_fixed_by_default(robot) if fixed is None else fixed
    paths = MeshPaths(KEEP, os.getcwd(), build.finder)
    wanted = Wanted("sdf", name="robot", is_fixed=is_fixed, paths=paths, version=version)
    output = write(robot, wanted)
    return "".join(write_pieces(output.root, Limits())), list(output.losses)


def refusal_of(robot: Robot) -> str:
    """Return why a simulator would refuse a robot, or "" if it would not."""
    for name in Bodies(robot).without_mass:
        joint = robot.parent_joint(name)
        if joint is not None and joint.type not in ("fixed", "floating"):
            return "massless-moving"
    return ""
