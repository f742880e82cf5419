"""Compares what robots cost MuJoCo, and what MoveIt checks, with meshes and with fitted shapes.

    python bench/planning.py ROBOT.urdf [FITTED.urdf ...]

ROBOT.urdf collides with meshes, and each FITTED.urdf is what `yamaro fit` made of it. MuJoCo tells
the time of `mj_collision`, the number of contacts at random positions, and steps in a second. The
SRDF of `yamaro --to srdf` tells the pairs of links that MoveIt checks. FCL, which MoveIt uses,
judges them by the triangles of ROBOT.urdf at 10,000 random positions of its own: `missed` are pairs
that are not checked although they touch at some of these positions and do not at rest, `needless`
ones that are checked and touch at none. Needs trimesh, mujoco and python-fcl.
"""

from __future__ import annotations

import sys
import tempfile
from itertools import combinations
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import fcl
import numpy as np
import trimesh
from shapes import cost, pose_of

from yamaro.commands.main import main as yamaro

STATES = 10_000
ENOUGH = 50
"""At so many positions a pair touches if no more are looked at, and it does not at some."""
Pair = tuple[str, str]


class Judge:
    """A robot of meshes in FCL.

    Attributes:
        links: the names of the links that collide.
        at_rest: pairs that touch at rest.
        often: the part of the random positions at which pairs touch; they are left out if they
            touch at none.
    """

    def __init__(self, path: Path) -> None:
        root = ElementTree.parse(path).getroot()
        self._joints = {
            child.attrib["link"]: joint
            for joint in root.iter("joint")
            if (child := joint.find("child")) is not None
        }
        self._order = [link.attrib["name"] for link in root.iter("link")]
        self._order.sort(key=lambda name: len(self._above(name)))
        self._objects, self._around = {}, {}
        for link in root.iter("link"):
            parts = []
            for collision in link.iter("collision"):
                mesh = collision.find("geometry/mesh")
                if mesh is not None:
                    part = trimesh.load(path.parent / mesh.attrib["filename"], force="mesh")
                    part.apply_scale([*map(float, mesh.get("scale", "1 1 1").split())])
                    part.apply_transform(pose_of(collision))
                    parts.append(part)
            if parts:
                whole = trimesh.util.concatenate(parts)
                shape = fcl.BVHModel()
                shape.beginModel(len(whole.vertices), len(whole.faces))
                shape.addSubModel(whole.vertices, whole.faces)
                shape.endModel()
                name, middle = link.attrib["name"], whole.bounds.mean(axis=0)
                radius = float(np.linalg.norm(whole.vertices - middle, axis=1).max())
                self._objects[name] = fcl.CollisionObject(shape, fcl.Transform())
                self._around[name] = middle, radius
        self.links = [*self._objects]
        self.at_rest = {pair for pair, hits in self._touching(np.zeros(1)).items() if hits}
        self.often = self._touching(np.random.default_rng(7).random(STATES))

    def _above(self, name: str) -> list[str]:
        found = []
        while name in self._joints:
            name = self._joints[name].find("parent").attrib["link"]  # type: ignore[union-attr]
            found.append(name)
        return found

    def _poses(self, seeds: Any) -> dict[str, Any]:
        """Return the poses of all links, N×4×4 each, at random positions, or at rest for zeros."""
        random = np.random.default_rng(11)
        values: dict[str, Any] = {}
        for joint in self._joints.values():
            limit, kind = joint.find("limit"), joint.get("type")
            low, high = -np.pi, np.pi
            if limit is not None and kind != "continuous":
                low, high = (float(limit.get(name, 0)) for name in ("lower", "upper"))
            at = low + random.random(len(seeds)) * (high - low)
            values[joint.attrib["name"]] = at if seeds.any() else np.clip(0 * at, low, high)
        for joint in self._joints.values():
            mimic = joint.find("mimic")
            if mimic is not None:
                factor, offset = float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0))
                values[joint.attrib["name"]] = factor * values[mimic.attrib["joint"]] + offset
        poses: dict[str, Any] = {}
        for name in self._order:
            if name not in self._joints:
                poses[name] = np.tile(np.eye(4), (len(seeds), 1, 1))
                continue
            joint = self._joints[name]
            given = joint.find("axis")
            axis = np.array(
                [*map(float, (given.get("xyz", "1 0 0") if given is not None else "1 0 0").split())]
            )
            axis /= np.linalg.norm(axis) or 1
            at, moved = values[joint.attrib["name"]], np.tile(np.eye(4), (len(seeds), 1, 1))
            if joint.get("type") in ("revolute", "continuous"):
                x, y, z = axis  # Rodrigues' formula
                cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
                sine, cosine = np.sin(at)[:, None, None], np.cos(at)[:, None, None]
                moved[:, :3, :3] = np.eye(3) + sine * cross + (1 - cosine) * (cross @ cross)
            elif joint.get("type") == "prismatic":
                moved[:, :3, 3] = at[:, None] * axis
            parent = joint.find("parent")
            assert parent is not None
            poses[name] = poses[parent.attrib["link"]] @ pose_of(joint) @ moved
        return poses

    def _touching(self, seeds: Any) -> dict[Pair, float]:
        poses = self._poses(seeds)
        found = {}
        for one, other in combinations(self.links, 2):
            (a, ra), (b, rb) = self._around[one], self._around[other]
            apart = poses[one][:, :3, :3] @ a + poses[one][:, :3, 3]
            apart = apart - poses[other][:, :3, :3] @ b - poses[other][:, :3, 3]
            near = np.flatnonzero(np.linalg.norm(apart, axis=1) <= ra + rb)
            hits, looked_at = 0, len(seeds)
            for index in near:
                pairs = [(self._objects[each], poses[each][index]) for each in (one, other)]
                for thing, pose in pairs:
                    thing.setTransform(fcl.Transform(pose[:3, :3], pose[:3, 3]))
                hits += bool(fcl.collide(pairs[0][0], pairs[1][0]))
                if hits == ENOUGH and hits <= index:
                    looked_at = index + 1
                    break
            if hits:
                found[pair_of(one, other)] = hits / looked_at
        return found


def pair_of(one: str, other: str) -> Pair:
    """Return two names in their order."""
    return (one, other) if one < other else (other, one)


def disabled(robot: Path, folder: Path) -> dict[Pair, str]:
    """Return the pairs that the SRDF of a robot disables, and why."""
    written = folder / "robot.srdf"
    assert yamaro(["-q", str(robot), "--to", "srdf", "-o", str(written)]) == 0
    return {
        pair_of(each.attrib["link1"], each.attrib["link2"]): each.attrib["reason"]
        for each in ElementTree.parse(written).getroot().iter("disable_collisions")
    }


def main(before: Path, after: list[Path]) -> None:
    """Print a row for each file."""
    judge = Judge(before)
    always = {pair for pair, often in judge.often.items() if often == 1}
    print("| file | `mj_collision` | contacts | steps/s | checked | missed | needless |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for file in (before, *after):
            numbers = cost(file, Path(name))
            off = disabled(file, Path(name))
            pairs = {pair_of(*each) for each in combinations(judge.links, 2)}
            pairs -= {pair for pair, reason in off.items() if reason == "Adjacent"}
            missed = (pairs & off.keys() & judge.often.keys()) - judge.at_rest - always
            needless = pairs - off.keys() - judge.often.keys()
            print(
                f"| {file.parent.name}/{file.name} | {numbers[0]:.3f} ms | {numbers[1]:.1f} "
                f"| {numbers[2]:.0f} | {len(pairs - off.keys())} of {len(pairs)} "
                f"| {len(missed)} | {len(needless)} |",
                flush=True,
            )
            for pair in sorted(missed):
                print(f"missed: {' '.join(pair)}, {judge.often[pair]:.2%}", file=sys.stderr)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), [*map(Path, sys.argv[2:])])
