"""Which links of a robot collide in MuJoCo, and that a gripper holds with all its fingers."""

from __future__ import annotations

import struct
from itertools import chain
from pathlib import Path
from typing import Any

import pytest

import yamaro
from tests.consumers.oracles import require_module
from tests.targets.standing import Standing

# Links in a row; the third one turns into the first if it is turned back.
CHAIN = """\
robot: chain
base: fixed
model:
- part: {name: a, link: {geometry: box, size: 1 0.2 0.2, mass: 1, collision: }}
- part:
    name: b
    joint: {type: continuous, parent: a, xyz: 0.5 0 0, axis: z}
    link: {geometry: box, size: 0.1 0.1 0.1, mass: 1, collision: }
- part:
    name: c
    joint: {type: continuous, parent: b, xyz: 0.5 0 0, axis: z}
    link: {geometry: box, size: 0.4 0.2 0.2, mass: 1, collision: }
"""
OVERLAPS = "contacts of links that overlap at home"


def built(folder: Path, text: str) -> yamaro.Build:
    path = folder / "robot.yaml"
    path.write_text(text)
    return yamaro.build(path, target="mjcf", on_message=print)


def contacts(build: yamaro.Build) -> set[frozenset[str]]:
    """Return the pairs of bodies that touch at home."""
    mujoco = require_module("mujoco")
    model = mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_forward(model, data)
    found = set()
    for each in data.contact[: data.ncon]:
        bodies = (model.body(model.geom_bodyid[geom]).name for geom in (each.geom1, each.geom2))
        found.add(frozenset(bodies))
    return found


def lost(build: yamaro.Build) -> list[str]:
    return [loss.owner for loss in build.losses if loss.what == OVERLAPS]


def test_links_that_overlap_at_home_have_no_contacts_and_that_is_reported(tmp_path: Path) -> None:
    turned = CHAIN + "states: {home: {b: 180deg}}\n"
    kept = turned + "collisions: {keep: [[c_link, a_link]]}\n"
    assert contacts(built(tmp_path, kept)) == {frozenset(("a_link", "c_link"))}
    assert lost(built(tmp_path, kept)) == []
    build = built(tmp_path, turned)
    assert contacts(build) == set()
    assert lost(build) == ["links 'a_link' and 'c_link'"]
    (loss,) = (each for each in build.losses if each.what == OVERLAPS)
    assert loss.span.location()[0] == 12


def test_links_that_do_not_overlap_at_home_collide_later(tmp_path: Path) -> None:
    build = built(tmp_path, CHAIN)
    assert lost(build) == []
    mujoco = require_module("mujoco")
    model = mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets))
    data = mujoco.MjData(model)
    data.joint("b_joint").qpos = 3.14159
    mujoco.mj_forward(model, data)
    assert data.ncon > 0


def test_links_that_touch_at_home_collide(tmp_path: Path) -> None:
    touching = CHAIN.replace("size: 0.4 0.2 0.2", "size: 1 0.2 0.2")  # c from 0.5 to 1.5
    build = built(tmp_path, touching)
    assert lost(build) == []
    assert 'body2="c_link"' in build.xml()  # adjacent to b
    assert 'body1="a_link" body2="c_link"' not in build.xml()


def test_links_that_are_fixed_to_one_another_need_nothing(tmp_path: Path) -> None:
    fixed = CHAIN.replace("continuous, parent: b, xyz: 0.5 0 0, axis: z", "fixed, parent: b")
    fixed = fixed.replace("size: 0.1 0.1 0.1", "size: 0.6 0.1 0.1")
    build = built(tmp_path, fixed)
    # b and c move as one; both overlap a, which carries b and is fixed in the world
    assert contacts(build) == set()
    assert lost(build) == ["links 'a_link' and 'c_link'"]


def stl(low: float, high: float) -> bytes:
    """Return a cube from corner to corner, as triangles."""
    at = (low, high)
    faces = []
    for axis in range(3):
        for side in at:
            square = [(0, 0), (1, 0), (1, 1), (0, 1)]
            corners = []
            for u, v in square:
                corner = [at[u], at[v]]
                corner.insert(axis, side)
                corners.append(corner)
            faces += [corners[:3], [corners[0], *corners[2:]]]
    facets = (struct.pack("<12f2x", 0, 0, 0, *chain(*each)) for each in faces)
    return b"\0" * 80 + struct.pack("<I", len(faces)) + b"".join(facets)


@pytest.mark.parametrize(("scale", "is_one"), [("1 1 1", False), ("2 2 2", True)])
def test_meshes_overlap_at_their_size(scale: str, is_one: bool, tmp_path: Path) -> None:
    (tmp_path / "cube.stl").write_bytes(stl(-0.2, 0.2))
    text = CHAIN.replace(
        "geometry: box, size: 0.4 0.2 0.2, mass: 1, collision: ",
        "inertial: {mass: 1, inertia: 1 0 0 1 0 1}, "
        f"collision: {{geometry: cube.stl, scale: {scale}, xyz: -0.2 0 0}}",
    )
    build = built(tmp_path, text)
    assert bool(lost(build)) == is_one
    assert contacts(build) == set()


def test_a_free_robot_stands_on_the_lowest_corner_of_its_meshes(tmp_path: Path) -> None:
    (tmp_path / "cube.stl").write_bytes(stl(-0.2, 0.3))
    text = """\
robot: cube
base: free
model:
- part:
    name: a
    link: {mass: 1, geometry: box, size: 1 1 1, collision: {geometry: cube.stl, scale: 1 1 2}}
"""
    build = built(tmp_path, text)
    assert '<body name="a_link" pos="0 0 0.4' in build.xml()
    assert '<key name="home" qpos="0 0 0.4' in build.xml()


# A gripper with a motor in one of three fingers, which is the lightest.
GRIPPER = """\
robot: gripper
base: fixed
functions:
  Follower(name, side):
  - part:
      name: $(name)
      joint:
        type: revolute
        parent: base
        xyz: 0 $(side) 0
        axis: y
        limit: {lower: 0, upper: 0.8, effort: 1, velocity: 1}
        mimic: {joint: motor_joint}
      link: {geometry: box, size: 0.05 0.01 0.02, pivot: -0.025 0 0, mass: 0.03}
model:
- part: {name: base, link: {geometry: box, size: 0.1 0.1 0.1, mass: 1}}
- part:
    name: motor
    joint:
      type: revolute
      parent: base
      axis: y
      limit: {lower: 0, upper: 0.8, effort: 0.1, velocity: 1}
      actuator: {command: position}
    link: {geometry: box, size: 0.05 0.01 0.02, pivot: -0.025 0 0, mass: 0.02}
- Follower: one, 0.1
- Follower: two, 0.2
"""


def test_a_motor_carries_the_joints_that_follow_it(tmp_path: Path) -> None:
    mujoco = require_module("mujoco")
    build = built(tmp_path, GRIPPER)
    for name, content in {**build.assets, "gripper.xml": build.xml().encode()}.items():
        (tmp_path / name).write_bytes(content)
    found: Any = Standing(mujoco.MjModel.from_xml_string(build.xml(), dict(build.assets)))
    assert not found.warnings
    assert found.weak == []
    assert found.worst < 0.05


def test_an_actuator_of_a_joint_without_a_parent_is_lost(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        '<robot name="r"><link name="a"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        '<joint name="j" type="continuous"><parent link="none"/><child link="a"/></joint>'
        '<transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
        '<joint name="j"><hardwareInterface>PositionJointInterface</hardwareInterface></joint>'
        '<actuator name="m"/></transmission></robot>'
    )
    build = yamaro.build(path, target="mjcf", on_message=print)
    assert "joint 'j'" in {loss.owner for loss in build.losses}
    require_module("mujoco").MjModel.from_xml_string(build.xml())
