"""The interface of a robot says what the programs find that read its documents.

What Newton and Isaac Sim find is compared by `bench/interface.py`, which takes a Python that has
Newton; here it is written down for one robot, as Newton 1.8 found it.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import yamaro
from tests.consumers import interface_judges as judges
from tests.consumers import oracles
from tests.consumers.driven import ONE_JOINT, saved
from tests.consumers.test_examples import ROBOTS, name_of

ROOT = Path(__file__).parents[2]
SCHEMA = json.loads((ROOT / "docs/interface.schema.json").read_text(encoding="utf-8"))
FORMATS = {"urdf": "urdf", "mjcf": "xml", "sdf": "sdf"}
Interface = dict[str, Any]

INERTIAL = """<inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"""


def urdf(links: str, *joints: str, name: str = "tree") -> str:
    """Return a robot of links with mass, and of joints: `name type parent child`."""
    text = "".join(f'<link name="{each}">{INERTIAL}</link>' for each in links.split())
    for joint in joints:
        own, kind, parent, child = joint.split()
        text += (
            f'<joint name="{own}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="5" velocity="2"/></joint>'
        )
    return f'<robot name="{name}">{text}</robot>'


TREE = urdf(
    "base z1 a1 B1 z2 a2 fix tip loose",
    "jz1 revolute base z1",
    "ja2 prismatic a1 a2",
    "ja1 continuous base a1",
    "jB1 revolute base B1",
    "jz2 revolute z1 z2",
    "jfix fixed z2 fix",
    "jtip revolute fix tip",
    "jloose floating base loose",
)
"""The order of the file is neither that of names nor that of a walk through the tree."""

FULL = """
robot: full
base: free
model:
- part:
    name: base
    link:
    - {geometry: box, size: 0.4 0.3 0.1, mass: 6}
    - sensor/name=scan: {type: lidar, rays: 12, rows: 2, tilt: 20deg}
    - sensor/name=imu: {type: imu}
- part:
    name: wheel
    joint: {type: continuous, parent: base, axis: y, actuator: {command: velocity}}
    link:
    - {geometry: sphere, radius: 0.05, mass: 0.5}
    - sensor/name=front: {type: lidar, rays: 3}
    - sensor/name=near: {type: range}
- part:
    name: world
    joint:
      type: prismatic
      parent: wheel
      axis: y
      limit: {lower: -1, upper: 1, effort: 5, velocity: 5}
      actuator: {command: effort}
      sensor/name=load: {type: force_torque}
    link:
    - {geometry: sphere, radius: 0.05, mass: 0.5}
    - sensor/name=eye: {type: camera}
- part:
    name: slider
    joint: {type: planar, parent: base, axis: z}
    link: {geometry: sphere, radius: 0.05, mass: 0.5}
- mjcf:
  - actuator:
    - motor/name=extra,joint=wheel_joint:
  - sensor:
    - actuatorfrc/name=drive,actuator=wheel_joint:
  - worldbody:
    - replicate/count=11,offset=1 0 0,sep=-:
      - body/name=post:
        - joint/name=turn:
        - geom/size=.1:
        - replicate/count=2,offset=0 1 0:
          - site/name=mark:
  - sensor:
    - jointpos/name=turned,joint=turn:
    - framepos/name=seen,objtype=site,objname=mark:
"""
"""What MJCF writes under several names, and adds; a sensor of each kind of size."""


def interface_of(path: Path, **options: Any) -> Interface:
    """Return the interface of a robot, which has to be as the schema says."""
    build = yamaro.build(path, target="interface", on_message=lambda line: None, **options)
    found: Interface = json.loads(build.xml())
    jsonschema.validate(found, SCHEMA)
    return found


def check(path: Path, consumer: str, folder: Path, **options: Any) -> None:
    """Compare what a program finds with what the interface says."""
    interface = interface_of(path, **options)
    listing = interface["consumers"][consumer]
    built = yamaro.build(
        path, target=listing["format"], meshes="none", on_message=lambda line: None, **options
    )
    document = folder / f"document.{FORMATS[listing['format']]}"
    document.write_text(built.xml(), encoding="utf-8")
    if consumer == "pinocchio":
        oracles.require_module("pinocchio")
        is_fixed = interface["base"] == "fixed"
        found = judges.of_pinocchio(built.xml(), is_fixed=is_fixed)
    elif consumer == "mujoco":
        oracles.require_module("mujoco")
        found = judges.of_mujoco(document)
    else:
        oracles.require_module("pydrake")
        found = judges.of_drake(document)
    assert judges.difference(listing, found) == ""


@pytest.mark.parametrize("consumer", ["pinocchio", "mujoco", "drake"])
@pytest.mark.parametrize("path", ROBOTS, ids=name_of)
def test_each_program_finds_in_examples_what_the_interface_says(
    path: Path, consumer: str, tmp_path: Path
) -> None:
    check(path, consumer, tmp_path, allow=["lost-in-urdf"])


@pytest.mark.parametrize("consumer", ["pinocchio", "mujoco", "drake"])
@pytest.mark.parametrize("base", ["fixed", "free"])
@pytest.mark.parametrize("text", [TREE, FULL], ids=["tree", "full"])
def test_each_program_finds_in_trees_what_the_interface_says(
    text: str, base: str, consumer: str, tmp_path: Path
) -> None:
    check(saved(tmp_path, text), consumer, tmp_path, base=base)


@pytest.mark.parametrize(
    "joints",
    [
        ("j1 floating base f1", "j2 continuous f1 c1", "j3 floating base f2", "j4 fixed base c2"),
        ("j1 fixed base c2", "j2 floating c2 f2", "j3 floating f2 f1", "j4 continuous f2 c1"),
    ],
)
@pytest.mark.parametrize("links", ["base f1 f2 c1 c2", "f2 c1 f1 c2 base"])
@pytest.mark.parametrize("base", ["fixed", "free"])
def test_drake_has_free_links_after_the_world_those_with_others_first(
    joints: tuple[str, ...], links: str, base: str, tmp_path: Path
) -> None:
    check(saved(tmp_path, urdf(links, *joints)), "drake", tmp_path, base=base)


def test_newton_goes_depth_first_by_path_and_isaac_breadth_first_as_written(tmp_path: Path) -> None:
    """The orders are those that Newton 1.8 told, and Isaac Lab 3.0 makes of them for PhysX."""
    pytest.importorskip("pxr")
    path = saved(tmp_path, TREE)
    consumers = interface_of(path, base="fixed")["consumers"]
    assert judges.said(consumers["newton"]) == {
        "positions": 13,
        "velocities": 12,
        "joints": [
            ("/tree/joints/base_world", 0, 0, 0, 0),
            ("/tree/joints/jB1", 0, 1, 0, 1),
            ("/tree/joints/ja1", 1, 1, 1, 1),
            ("/tree/joints/ja2", 2, 1, 2, 1),
            ("/tree/joints/jz1", 3, 1, 3, 1),
            ("/tree/joints/jz2", 4, 1, 4, 1),
            ("/tree/joints/jfix", 5, 0, 5, 0),
            ("/tree/joints/jtip", 5, 1, 5, 1),
            ("joint_9", 6, 7, 6, 6),
        ],
        "bodies": [f"/tree/{name}" for name in "base B1 a1 a2 z1 z2 fix tip loose".split()],
        "actuators": [],
        "sensors": [],
    }
    names = [each["yamaro"] for each in consumers["newton"]["joints"]]
    assert names == [None, *"jB1 ja1 ja2 jz1 jz2 jfix jtip jloose".split()]
    isaac = consumers["isaac"]
    assert [each["name"] for each in isaac["joints"]] == "jz1 ja1 jB1 jz2 ja2 jtip".split()
    assert [each["name"] for each in isaac["bodies"]] == "base z1 a1 B1 z2 a2 fix tip".split()
    free = interface_of(path, base="free")["consumers"]
    first, *_ = free["newton"]["joints"]
    assert first == {"name": "joint_1", "yamaro": None, "q": [0, 7], "v": [0, 6]}
    assert free["isaac"] == isaac  # where a free base is, is apart


def test_planar_joints_have_three_freedoms_in_usd(tmp_path: Path) -> None:
    """As Newton 1.8 told: it moves the axes of a joint that have limits, if these leave room."""
    pytest.importorskip("pxr")
    path = saved(
        tmp_path, urdf("base cart arm", "jcart planar base cart", "jarm revolute cart arm")
    )
    found = interface_of(path, base="fixed")["consumers"]
    moving = [each for each in found["newton"]["joints"] if each["v"][1]]
    assert [(each["yamaro"], each["q"], each["v"]) for each in moving] == [
        ("jcart", [0, 3], [0, 3]),
        ("jarm", [3, 1], [3, 1]),
    ]
    names = [each["name"] for each in found["isaac"]["joints"]]
    assert names == ["jcart:0", "jcart:1", "jcart:2", "jarm"]


def test_each_program_has_all_joints_by_the_names_of_the_robot(tmp_path: Path) -> None:
    pytest.importorskip("pxr")
    names = "world _a_ a::b 1st ü.x joints base"
    joints = (
        *("w revolute base world", "x revolute world a::b", "a::b revolute base 1st"),
        *("_j_ continuous 1st _a_", "base prismatic _a_ ü.x", "z revolute ü.x joints"),
    )
    found = interface_of(saved(tmp_path, urdf(names, *joints)), base="free")
    moving = {each["name"] for each in found["joints"]}
    for name, consumer in found["consumers"].items():
        own = [each["yamaro"] for each in consumer["joints"] if each["yamaro"] is not None]
        assert sorted(own) == sorted(moving), name
        links = [each["yamaro"] for each in consumer["bodies"] if each["yamaro"] is not None]
        assert sorted(links) == sorted(names.split()), name
    drake = {each["yamaro"]: each["name"] for each in found["consumers"]["drake"]["joints"]}
    assert drake["a::b"] != "a::b"  # which SDFormat does not take


def test_blocks_and_values_for_one_format_are_in_the_order_of_that_format(tmp_path: Path) -> None:
    text = """
robot: two
base: fixed
model:
- part: {name: base, link: {geometry: box, size: 1 1 1, mass: 1}}
- if target == 'mjcf':
  - part:
      name: only
      joint: {type: continuous, parent: base, axis: z}
      link: {geometry: sphere, radius: 0.1, mass: 1}
- part:
    name: all
    joint: {type: continuous, parent: base, axis: z}
    link: {geometry: sphere, radius: 0.1, mass: 1}
"""
    found = interface_of(saved(tmp_path, text))["consumers"]
    names = {
        name: [each["name"] for each in consumer["joints"] if each["v"][1]]
        for name, consumer in found.items()
        if "joints" in consumer
    }
    assert names.pop("mujoco") == ["only_joint", "all_joint"]
    assert all(len(each) == 1 for each in names.values())
    assert {"pinocchio", "drake"} <= names.keys()


@pytest.mark.parametrize(
    ("actuator", "chosen"),
    [
        ("{}", ["kp", "kd"]),
        ("{kp: 7}", ["kd"]),
        ("{kp: 7, kd: 1}", None),
        ("{command: velocity}", ["kd"]),
        ("{command: velocity, kd: 3}", None),
        ("{frequency: 2, armature: 0.1}", None),
    ],
)
def test_gains_are_those_of_mjcf(actuator: str, chosen: list[str] | None, tmp_path: Path) -> None:
    mujoco = oracles.require_module("mujoco")
    path = saved(tmp_path, ONE_JOINT.format(actuator=actuator))
    model = mujoco.MjModel.from_xml_string(yamaro.build(path, target="mjcf").xml())
    (joint,) = interface_of(path)["joints"]
    own, driven = joint["actuator"], model.actuator("arm_joint")
    gain = own["kd"] if own["command"] == "velocity" else own["kp"]
    assert driven.gainprm[0] == pytest.approx(gain, rel=1e-9)
    if own["command"] == "position":  # whose damping MuJoCo works out from the inertia
        assert -driven.biasprm[2] == pytest.approx(own["kd"], rel=0.02)
    assert own.get("chosen") == chosen


def test_without_openusd_the_orders_of_usd_are_not_there_and_that_is_reported(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in [each for each in sys.modules if each.startswith("yamaro.targets.usd")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "pxr", None)
    build = yamaro.build(saved(tmp_path, TREE), target="interface", base="fixed")
    consumers = json.loads(build.xml())["consumers"]
    assert [name for name, each in consumers.items() if "refused" in each] == ["newton", "isaac"]
    assert "usd-core" in consumers["newton"]["refused"]
    assert [each.code for each in build.warnings] == ["lost-in-interface"]
    assert build.warnings[0].hint == "pip install 'yamaro[usd]'"
