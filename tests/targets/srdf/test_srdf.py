"""SRDF, as pinocchio reads it, and its pairs against contacts that pinocchio finds by itself."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

import yamaro
from tests.consumers import oracles

INERTIA = (
    '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    "</inertial>"
)


@pytest.fixture(autouse=True)
def _judge() -> None:
    oracles.require_module("pinocchio")


def chain_of(count: int, reach: float) -> str:
    """Return the URDF of an arm of rods."""
    rod = '<geometry><cylinder radius="0.05" length="0.2"/></geometry>'
    parts = []
    for i in range(count):
        parts.append(f'<link name="l{i}"><collision>{rod}</collision>{INERTIA}</link>')
        if i:
            axis = "1 0 0" if i % 2 else "0 1 0"
            parts.append(
                f'<joint name="j{i}" type="revolute"><parent link="l{i - 1}"/>'
                f'<child link="l{i}"/><origin xyz="0 0 0.22"/><axis xyz="{axis}"/>'
                f'<limit lower="-{reach}" upper="{reach}" effort="1" velocity="1"/></joint>'
            )
    return f'<robot name="rods">{"".join(parts)}</robot>'


def srdf_of(path: Path, **given: Any) -> ElementTree.Element:
    return ElementTree.fromstring(yamaro.build(path, target="srdf", **given).xml())


def pairs_of(root: ElementTree.Element, reason: str) -> set[tuple[str, str]]:
    return {
        (each.attrib["link1"], each.attrib["link2"])
        for each in root.findall("disable_collisions")
        if each.attrib["reason"] == reason
    }


def contacts(urdf: str, pairs: set[tuple[str, str]], samples: int) -> set[tuple[str, str]]:
    """Return the pairs that touch at random positions, as pinocchio reads the URDF."""
    import pinocchio

    model = pinocchio.buildModelFromXML(urdf)
    shapes = pinocchio.buildGeomFromUrdfString(model, urdf, pinocchio.GeometryType.COLLISION)
    owners = []
    for pair in sorted(pairs):
        one, other = (shapes.getGeometryId(f"{link}_0") for link in pair)
        shapes.addCollisionPair(pinocchio.CollisionPair(one, other))
        owners.append(pair)
    data, found = model.createData(), shapes.createData()
    random = np.random.default_rng(99)
    touching = set()
    for _ in range(samples):
        q = random.uniform(model.lowerPositionLimit, model.upperPositionLimit)
        if pinocchio.computeCollisions(model, data, shapes, found, q, False):
            touching |= {
                pair
                for pair, each in zip(owners, found.collisionResults, strict=True)
                if each.isCollision()
            }
    return touching


@pytest.mark.parametrize("reach", [0.6, 1.2])
def test_what_never_touches_does_not_touch_at_fresh_positions(
    tmp_path: Path, reach: float, request: pytest.FixtureRequest
) -> None:
    path = tmp_path / "rods.urdf"
    path.write_text(chain_of(8, reach))
    root = srdf_of(path)
    never = pairs_of(root, "Never")
    assert never
    assert contacts(path.read_text(), never, 5_000) == set()
    links = [f"l{i}" for i in range(8)]
    checked = {(a, b) for a in links for b in links if a < b}
    for reason in ("Never", "Adjacent", "Always", "Default"):
        checked -= pairs_of(root, reason)
    if reach > 1:
        assert checked


@pytest.mark.slow
def test_what_never_touches_does_not_touch_at_a_hundred_thousand_positions(tmp_path: Path) -> None:
    path = tmp_path / "rods.urdf"
    path.write_text(chain_of(14, 1.2))
    never = pairs_of(srdf_of(path), "Never")
    assert contacts(path.read_text(), never, 100_000) == set()


def test_a_pair_that_rarely_touches_is_checked(tmp_path: Path) -> None:
    """Two balls on two arms meet only where three angles are right at once."""
    ball = '<geometry><sphere radius="0.004"/></geometry>'

    def joint(name: str, parent: str, child: str, axis: str, xyz: str) -> str:
        return (
            f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
            f'<origin xyz="{xyz}"/><axis xyz="{axis}"/>'
            '<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>'
        )

    links = "".join(
        f'<link name="{name}">{INERTIA}{inner}</link>'
        for name, inner in (
            ("base", f"<collision>{ball}</collision>"), ("a", ""), ("b", ""), ("c", ""),
            ("tip", f"<collision>{ball}</collision>"),
            ("post", f"<collision>{ball}</collision>"),
        )
    )  # fmt: skip
    joints = (
        joint("j1", "base", "a", "0 0 1", "0 0 0")
        + joint("j2", "a", "b", "0 1 0", "0.2 0 0")
        + joint("j3", "b", "c", "0 0 1", "0.2 0 0")
        + joint("j4", "c", "tip", "0 1 0", "0.2 0 0")
        + joint("j5", "base", "post", "0 0 1", "0.3 0.25 0.1")
    )
    urdf = f'<robot name="rare">{links}{joints}</robot>'
    path = tmp_path / "rare.urdf"
    path.write_text(urdf)
    assert contacts(urdf, {("post", "tip")}, 2_000) == set()
    reasons = {
        (each.attrib["link1"], each.attrib["link2"]): each.attrib["reason"]
        for each in srdf_of(path).findall("disable_collisions")
    }
    assert reasons == {("base", "post"): "Adjacent", ("base", "tip"): "Adjacent"}


ARM = """
robot: arm
base: fixed
model:
- part: {name: base, link: {geometry: box, size: 0.2 0.2 0.1, mass: 1, collision: null}}
- part:
    name: upper
    joint: {type: revolute, parent: base, axis: y, limit: &limit {lower: -1, upper: 1, effort: 1,
      velocity: 1}}
    link: {geometry: box, size: 0.05 0.05 0.3, mass: 1, xyz: 0 0 0.3, collision: null}
- part:
    name: hand
    joint: {type: revolute, parent: upper, xyz: 0 0 0.6, axis: y, limit: *limit}
    link: {geometry: sphere, radius: 0.03, mass: 1, collision: null}
groups:
  arm: {chain: [base_link, upper_link]}
  hand: {links: [hand_link], parent: upper_link, end_effector: true}
  all: {groups: [arm, hand]}
states: {home: {upper: 0.5, hand: -0.5}}
"""


def test_the_greatest_number_as_a_limit_is_none(tmp_path: Path) -> None:
    names = [f"l{i}" for i in range(4)]
    found = {}
    for reach in (np.pi, np.finfo(float).max):
        urdf = tmp_path / "rods.urdf"
        urdf.write_text(chain_of(len(names), reach))
        root = srdf_of(urdf)
        found[reach] = [pairs_of(root, why) for why in ("Adjacent", "Never", "Always")]
    assert found[np.pi] == found[np.finfo(float).max]
    assert any(found[np.pi])


def test_groups_states_and_end_effectors(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM)
    root = srdf_of(path)
    states = {
        (each.attrib["name"], each.attrib["group"]): {
            joint.attrib["name"]: float(joint.attrib["value"]) for joint in each
        }
        for each in root.findall("group_state")
    }
    assert states == {
        ("home", "arm"): {"upper_joint": 0.5},
        ("home", "hand"): {"hand_joint": -0.5},
        ("home", "all"): {"upper_joint": 0.5, "hand_joint": -0.5},
    }
    effector = root.find("end_effector")
    assert effector is not None
    assert effector.attrib == {
        "name": "hand", "parent_link": "upper_link", "group": "hand", "parent_group": "arm",
    }  # fmt: skip
    virtual = root.find("virtual_joint")
    assert virtual is not None
    assert (virtual.attrib["type"], virtual.attrib["child_link"]) == ("fixed", "base_link")


def test_pinocchio_loads_states_and_pairs(tmp_path: Path) -> None:
    import pinocchio

    path = tmp_path / "arm.yaml"
    path.write_text(ARM)
    urdf, srdf = yamaro.build(path).xml(), tmp_path / "arm.srdf"
    srdf.write_text(yamaro.build(path, target="srdf").xml())
    model = pinocchio.buildModelFromXML(urdf)
    pinocchio.loadReferenceConfigurations(model, str(srdf), False)
    assert model.referenceConfigurations["home"] == pytest.approx([0.5, -0.5])
    shapes = pinocchio.buildGeomFromUrdfString(model, urdf, pinocchio.GeometryType.COLLISION)
    shapes.addAllCollisionPairs()
    before = len(shapes.collisionPairs)
    pinocchio.removeCollisionPairs(model, shapes, str(srdf))
    removed = before - len(shapes.collisionPairs)
    assert removed == len(ElementTree.parse(srdf).findall("disable_collisions")) > 0


def test_the_same_seed_gives_the_same_bytes(tmp_path: Path) -> None:
    path = tmp_path / "rods.urdf"
    path.write_text(chain_of(6, 1.5))
    texts = {yamaro.build(path, target="srdf").xml() for _ in range(2)}
    assert len(texts) == 1


def test_links_that_are_seen_and_touch_nothing_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM.replace("mass: 1, collision: null", "mass: 1, visual: null"))
    with pytest.raises(yamaro.YamaroError) as caught:
        yamaro.build(path, target="srdf")
    (found,) = caught.value.diagnostics
    assert found.code == "missing-collision"
    assert len(found.notes) == 1


def test_pairs_to_keep_are_checked(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM)
    assert pairs_of(srdf_of(path), "Adjacent") == {
        ("base_link", "upper_link"),
        ("hand_link", "upper_link"),
    }
    path.write_text(ARM + "collisions: {samples: 50, keep: [[upper_link, base_link]]}\n")
    assert pairs_of(srdf_of(path), "Adjacent") == {("hand_link", "upper_link")}


def _wanted() -> Any:
    """Return what is asked for, of a robot without meshes."""
    from yamaro.targets.mesh_paths import MeshPaths
    from yamaro.targets.output import Wanted

    finder: Any = None
    return Wanted("srdf", name="", is_fixed=True, paths=MeshPaths("keep", "", finder))


def test_the_search_knows_how_distances_grow(tmp_path: Path) -> None:
    """The slope of a distance is that of differences, for joints that turn, slide and follow."""
    from yamaro.targets.srdf.contacts import Scene

    ball = '<collision><geometry><sphere radius="0.05"/></geometry></collision>'
    rows = (
        ("j1", "revolute", "base", "a", "0 0 1", "0.3 0 0.1", ""),
        ("j2", "prismatic", "a", "b", "0.6 0 0.8", "0.2 0.1 0", ""),
        ("j3", "revolute", "b", "c", "0 1 0", "0.1 0.2 0.3", '<mimic joint="j1" multiplier="-2"/>'),
        ("k1", "revolute", "base", "d", "1 0 0", "-0.4 0.2 0", ""),
    )
    joints = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="0.3 -0.2 0.5"/><axis xyz="{axis}"/>{more}'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for name, kind, parent, child, axis, xyz, more in rows
    )
    links = "".join(f'<link name="{name}">{ball}{INERTIA}</link>' for name in ("base", *"abcd"))
    path = tmp_path / "robot.urdf"
    path.write_text(f'<robot name="slopes">{links}{joints}</robot>')
    robot = yamaro.build(path).robot
    scene = Scene(robot, [("base", "c"), ("c", "d")], _wanted())
    scene.measure()
    assert [joint.name for joint in scene.joints] == ["j1", "j2", "k1"]
    row, h = np.array([0.4, -0.3, 0.6]), 1e-6
    for number in (0, 1):
        _, slope = scene.distance(number, row)
        differences = [
            (scene.distance(number, row + step)[0] - scene.distance(number, row - step)[0])
            / (2 * h)
            for step in h * np.eye(3)
        ]
        assert slope == pytest.approx(differences, abs=1e-5)
    assert scene.moves(("base", "c"))
