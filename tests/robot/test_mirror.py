"""`mirror` against pinocchio: the image moves as a reflection of the original would.

S is the reflection in the plane. The position of a joint is negated if its axis is kept although
its image is the opposite. With positions mirrored so, each link's pose is S·T·S, and the mass
matrix and the efforts of a motion are the same up to these signs, under mirrored gravity.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from lxml import etree

from tests.consumers.oracles import CheckUrdf, Matrix, require_module
from tests.robot.mirrored_trees import Tree, random_tree
from tests.robot.written import convert_text

NORMALS = {"yz": 0, "xz": 1, "xy": 2}
TREES = [
    pytest.param(random_tree(seed, plane, axes), id=f"{seed}-{plane}-{axes}")
    for seed in range(8)
    for plane in NORMALS
    for axes in ("keep", "mirror")
]


def half(urdf: str, word: str) -> str:
    """Return the robot with the joints and links of one side only, and no joint that follows one.

    Of such joints `Halves.followed` knows, as pinocchio refuses leaders of some types and places.
    """
    root = etree.fromstring(urdf.encode())
    for element in list(root):
        if not element.get("name", "").startswith((word, "base")):
            root.remove(element)
        for mimic in element.findall("mimic"):
            element.remove(mimic)
    return etree.tostring(root).decode()


def axis_of(joint: Any) -> Matrix:
    axis = joint.find("axis")
    return np.array([1.0, 0, 0] if axis is None else [float(x) for x in axis.get("xyz").split()])


class Halves:
    """Both sides of a robot in pinocchio, and the signs between their positions."""

    def __init__(self, tree: Tree) -> None:
        self.pinocchio = require_module("pinocchio")
        self.urdf = convert_text(tree.program())
        self.S = np.eye(3)
        self.S[NORMALS[tree.plane], NORMALS[tree.plane]] = -1
        self.left, self.right = (
            self.pinocchio.buildModelFromXML(half(self.urdf, word)) for word in ("left", "right")
        )
        self.root = etree.fromstring(self.urdf.encode())
        self.sign = {name: self._sign_of(name) for name in list(self.left.names)[1:]}

    def _sign_of(self, name: str) -> float:
        """Return whether a joint's position counts as that of its image: from the two axes."""
        left = self.root.find(f"joint[@name='{name}']")
        right = self.root.find(f"joint[@name='{name.replace('left', 'right')}']")
        image = self.S @ axis_of(left)
        if left.get("type") != "prismatic":
            image = -image
        return 1.0 if np.allclose(image, axis_of(right), atol=1e-8) else -1.0

    def followed(self, values: dict[str, float], *, offset: float = 1) -> dict[str, float]:
        """Return positions, or velocities with an offset of 0, with those that mimics give.

        A follower is written after its leader.
        """
        values = dict(values)
        for mimic in self.root.iterfind("joint/mimic"):
            name, leader = mimic.getparent().get("name"), mimic.get("joint")
            if name in values:
                ratio = float(mimic.get("multiplier", "1"))
                values[name] = ratio * values[leader] + offset * float(mimic.get("offset", "0"))
        return values

    def positions(self, model: Any, values: dict[str, float]) -> Matrix:
        """Return the configuration of one side; a continuous joint has cosine and sine."""
        q = self.pinocchio.neutral(model)
        values = self.followed(values)
        for joint, name in zip(model.joints, model.names, strict=True):
            value = values.get(name)
            if value is None:
                continue
            turned = (np.cos(value), np.sin(value)) if joint.nq == 2 else (value,)
            q[joint.idx_q : joint.idx_q + joint.nq] = turned
        return q

    def motion(self, model: Any, values: dict[str, float]) -> Matrix:
        v = np.zeros(model.nv)
        values = self.followed(values, offset=0)
        for joint, name in zip(model.joints, model.names, strict=True):
            if name in values:
                v[joint.idx_v] = values[name]
        return v

    def mirrored(self, values: dict[str, float]) -> dict[str, float]:
        return {name.replace("left", "right"): self.sign[name] * values[name] for name in values}

    def random_values(self, seed: int) -> dict[str, float]:
        dice = np.random.default_rng(seed)
        return {name: dice.uniform(-1.5, 1.5) for name in self.sign}

    def order(self) -> tuple[list[int], list[int], Matrix]:
        """Return the places of the joints in velocities of both sides, and their signs."""
        lefts, rights, signs = [], [], []
        for joint, name in zip(self.left.joints, self.left.names, strict=True):
            if name in self.sign:
                other = self.right.joints[self.right.getJointId(name.replace("left", "right"))]
                lefts.append(joint.idx_v)
                rights.append(other.idx_v)
                signs.append(self.sign[name])
        return lefts, rights, np.array(signs)


@pytest.fixture(params=TREES)
def halves(request: pytest.FixtureRequest) -> Halves:
    return Halves(request.param)


def test_links_of_the_image_are_where_the_reflection_has_them(halves: Halves) -> None:
    values = halves.random_values(1)
    poses = {}
    for model, positions in (
        (halves.left, values),
        (halves.right, halves.mirrored(values)),
    ):
        data = model.createData()
        halves.pinocchio.framesForwardKinematics(model, data, halves.positions(model, positions))
        for frame, pose in zip(model.frames, data.oMf, strict=True):
            poses[frame.name] = pose
    names = [name for name in poses if name.startswith("left_") and name.endswith("_link")]
    assert len(names) >= 2
    for name in names:
        image = poses[name.replace("left", "right")]
        expected = halves.S @ poses[name].rotation @ halves.S
        np.testing.assert_allclose(image.rotation, expected, atol=1e-9)
        np.testing.assert_allclose(image.translation, halves.S @ poses[name].translation, atol=1e-9)


def test_mass_matrix_and_efforts_are_those_of_the_reflection(halves: Halves) -> None:
    values, speeds, rates = (halves.random_values(seed) for seed in (1, 2, 3))
    gravity = np.array([1.3, -2.1, -9.4])
    found = []
    for model, way, S in (
        (halves.left, lambda each: each, np.eye(3)),
        (halves.right, halves.mirrored, halves.S),
    ):
        model.gravity.linear = S @ gravity
        data = model.createData()
        q = halves.positions(model, way(values))
        v, a = halves.motion(model, way(speeds)), halves.motion(model, way(rates))
        efforts = halves.pinocchio.rnea(model, data, q, v, a)
        masses = halves.pinocchio.crba(model, data, q)
        masses = np.triu(masses) + np.triu(masses, 1).T
        found.append((efforts.copy(), masses))
    lefts, rights, signs = halves.order()
    (efforts, masses), (image_efforts, image_masses) = found
    np.testing.assert_allclose(image_efforts[rights], signs * efforts[lefts], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(
        image_masses[np.ix_(rights, rights)],
        signs[:, None] * masses[np.ix_(lefts, lefts)] * signs,
        rtol=1e-9,
        atol=1e-9,
    )


@pytest.mark.parametrize("tree", TREES)
def test_the_image_of_the_image_is_the_original(tree: Tree) -> None:
    urdf = convert_text(tree.there_and_back())

    def side(word: str) -> str:
        elements = [each for each in etree.fromstring(urdf.encode()) if each.tag != "comment"]
        own = [each for each in elements if each.get("name").startswith(word)]
        return "".join(etree.tostring(each).decode().strip() for each in own)

    assert side("left_")
    assert side("old_").replace("old_", "left_") == side("left_")


@pytest.mark.parametrize("tree", TREES[::7])
def test_urdfdom_accepts_the_robot(tree: Tree) -> None:
    found = CheckUrdf(convert_text(tree.program()))
    assert found.accepts, found.output
