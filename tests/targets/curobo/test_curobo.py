"""cuRobo's configuration, against the robot's URDF and the keys that cuRobo reads."""

from __future__ import annotations

import re
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import pytest
import yaml

import yamaro

if TYPE_CHECKING:
    from yamaro import Build

pytest.importorskip("pinocchio")

KEYS: dict[str, Any] = {
    "format_version": float,
    "urdf_path": str,
    "base_link": str,
    "tool_frames": [str],
    "collision_link_names": [str],
    "collision_spheres": {str: [{"center": [float], "radius": float}]},
    "collision_sphere_buffer": float,
    "self_collision_buffer": {str: float},
    "self_collision_ignore": {str: [str]},
    "mesh_link_names": [str],
    "grasp_contact_link_names": [str],
    "lock_joints": {str: float},
    "cspace": {
        "joint_names": [str],
        "default_joint_position": [float],
        "cspace_distance_weight": [float],
        "null_space_weight": [float],
        "max_acceleration": [float],
        "max_jerk": [float],
    },
}
"""The keys of `kinematics`. Source: `KinematicsLoaderCfg` and `CSpaceParams` of cuRobo."""

ARM = """\
robot: arm
states: {home: {a_joint: 0.5, finger_joint: 20 mm}}
model:
- part: {name: base, link: {geometry: sphere, radius: 0.1, mass: 1, collision: }}
- part:
    name: a
    joint:
      type: revolute
      parent: base
      xyz: 0 0 0.2
      axis: x
      limit: {lower: -0.5, upper: 0.5, effort: 1, velocity: 1, acceleration: 8}
    link:
      collision/name=low: {geometry: sphere, radius: 50 mm, xyz: 0.1 0 0.2}
      collision/name=high: {geometry: sphere, radius: 0.04, xyz: 0 -10cm 0.3, rpy: 90deg 0 0}
- part:
    name: b
    joint:
      type: revolute
      parent: a
      xyz: 0 0 0.5
      axis: x
      limit: {lower: 0.2, upper: 3, effort: 1, velocity: 1, jerk: 90}
    link: {geometry: sphere, radius: 0.05, collision: }
- part:
    name: finger
    joint:
      type: prismatic
      parent: b
      xyz: 0 0 0.22
      axis: x
      limit: {lower: 0, upper: 0.04, effort: 1, velocity: 1}
    link: {geometry: sphere, radius: 0.02, collision: }
- part:
    name: thumb
    joint:
      type: prismatic
      parent: b
      axis: -x
      mimic: finger
      limit: {lower: 0, upper: 0.04, effort: 1, velocity: 1}
    link: {geometry: box, size: 0.1 0.1 0.1, collision: }
groups:
  arm: {chain: [base, b]}
  hand: {links: [finger, thumb], parent: b, end_effector: true}
"""


def _built(folder: Path, text: str) -> tuple[Build, dict[str, Any]]:
    path = folder / "arm.yaml"
    path.write_text(text, encoding="utf-8")
    build = yamaro.build(path, target="curobo", on_message=lambda line: None)
    return build, yaml.safe_load(build.xml())["robot_cfg"]["kinematics"]


def _check(value: object, form: object, where: str) -> None:
    """Compare the types of a value with a form, in which one entry stands for all."""
    if isinstance(form, list):
        assert isinstance(value, list), where
        for each in value:
            _check(each, form[0], where)
    elif isinstance(form, dict) and str in form:
        assert isinstance(value, dict), where
        for key, each in value.items():
            assert isinstance(key, str)
            _check(each, form[str], f"{where}/{key}")
    elif isinstance(form, dict):
        assert isinstance(value, dict), where
        assert set(value) <= set(form), where
        for key, each in value.items():
            _check(each, form[key], f"{where}/{key}")
    else:
        assert type(value) is form, where


def test_the_keys_are_those_of_curobo(tmp_path: Path) -> None:
    _, found = _built(tmp_path, ARM)
    assert set(found) == set(KEYS)
    assert set(found["cspace"]) == set(KEYS["cspace"])
    _check(found, KEYS, "kinematics")


def test_spheres_are_those_of_the_urdf(tmp_path: Path) -> None:
    _, found = _built(tmp_path, ARM)
    urdf = ElementTree.fromstring(yamaro.build(tmp_path / "arm.yaml", target="urdf").xml())
    wanted: dict[str, list[tuple[list[float], float]]] = {}
    for link in urdf.iter("link"):
        for collision in link.iter("collision"):
            origin, sphere = collision.find("origin"), collision.find("geometry/sphere")
            if sphere is not None:
                xyz = "0 0 0" if origin is None else origin.get("xyz", "0 0 0")
                each = ([float(value) for value in xyz.split()], float(sphere.attrib["radius"]))
                wanted.setdefault(link.attrib["name"], []).append(each)
    spheres = {
        link: [(each["center"], each["radius"]) for each in row]
        for link, row in found["collision_spheres"].items()
    }
    assert spheres == wanted
    assert spheres["a_link"] == [([0.1, 0.0, 0.2], 0.05), ([0.0, -0.1, 0.3], 0.04)]
    assert found["collision_link_names"] == [*wanted] == [*found["self_collision_buffer"]]


def test_what_is_planned_and_what_is_locked(tmp_path: Path) -> None:
    build, found = _built(tmp_path, ARM)
    assert (found["base_link"], found["tool_frames"]) == ("base_link", ["b_link"])
    assert found["lock_joints"] == {"finger_joint": 0.02}
    assert found["grasp_contact_link_names"] == ["finger_link"]
    space = found["cspace"]
    assert space["joint_names"] == ["a_joint", "b_joint", "finger_joint"]
    assert space["default_joint_position"] == pytest.approx([0.5, 1.6, 0.02])
    assert space["max_acceleration"] == [8, 10, 10]  # 10 and 500 are the defaults of CSpaceParams
    assert space["max_jerk"] == [500, 90, 500]
    codes = [(each.kind, each.what, each.owner) for each in build.losses]
    assert codes == [
        ("lost", "collisions that are not spheres", "link 'thumb_link'"),
        ("approximated", "missing limits of acceleration", "joint 'b_joint'"),
        ("approximated", "missing limits of acceleration", "joint 'finger_joint'"),
        ("approximated", "missing limits of jerk", "joint 'a_joint'"),
        ("approximated", "missing limits of jerk", "joint 'finger_joint'"),
    ]


@pytest.mark.parametrize("keep", [False, True])
def test_pairs_are_neighbours_and_those_that_never_touch(tmp_path: Path, *, keep: bool) -> None:
    """Only the finger touches something: it turns 0.22 m from b, and `high` is 0.224 m from it."""
    text = ARM + ("collisions: {keep: [[base, b]]}\n" if keep else "")
    _, found = _built(tmp_path, text)
    ignored = found["self_collision_ignore"]
    pairs = [{one, other} for one, row in ignored.items() for other in row]
    kept = [{"a_link", "finger_link"}] + ([{"base_link", "b_link"}] if keep else [])
    every = [{*pair} for pair in combinations(found["collision_link_names"], 2)]
    assert all(pair in pairs or pair in kept for pair in every)
    assert len(pairs) == len(every) - len(kept)


def test_without_spheres_and_groups_the_ends_are_planned(tmp_path: Path) -> None:
    text = re.sub(r"geometry: sphere, radius: [\d.]+( mm)?", "geometry: cylinder, scale: 1 1", ARM)
    _, found = _built(tmp_path, text.partition("groups:")[0])
    assert found["collision_link_names"] == []
    assert found["collision_spheres"] == found["self_collision_ignore"] == {}
    assert found["tool_frames"] == ["finger_link", "thumb_link"]
    assert "lock_joints" not in found
    _, nothing = _built(tmp_path, "robot: arm\nmodel: []\n")
    assert "cspace" not in nothing
