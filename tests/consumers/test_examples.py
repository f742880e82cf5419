"""Every example robot is read by the programs that robots are made for, with the right masses.

An example is a folder below examples/ with one main file: the YAML file that no other there names.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from lxml import etree

import yamaro
from tests.consumers import oracles
from tests.example_files import EXAMPLES, programs_in
from tests.tools_there import needs
from yamaro.commands.main import main

# These make no robot, and are judged by their own tests.
OTHER_XML = re.compile(r"^(sdf|mujoco|launch|world)\b[^\n]*:", re.MULTILINE)

# Warnings that an example shows on purpose.
SHOWN_WARNINGS = {
    "leg_robot/robot.yaml": ["assumed-limit"] * 2,  # one for each leg
}


def main_files(folder: Path) -> list[Path]:
    texts = {path: path.read_text(encoding="utf-8") for path in programs_in(folder)}
    return [
        path
        for path in texts
        if not any(path.name in text for other, text in texts.items() if other != path)
    ]


FOLDERS = sorted(path for path in EXAMPLES.glob("*") if path.is_dir())
MAINS = [path for folder in FOLDERS for path in main_files(folder)]
ROBOTS = [path for path in MAINS if not OTHER_XML.search(path.read_text(encoding="utf-8"))]


def name_of(path: Path) -> str:
    return path.relative_to(EXAMPLES).as_posix()


robots = pytest.mark.parametrize("path", ROBOTS, ids=name_of)


def compile_example(path: Path) -> str:
    return yamaro.build(str(path)).xml()


def parse(path: Path) -> etree._Element:
    return etree.fromstring(compile_example(path).encode())


def total_mass(root: etree._Element) -> float:
    return sum(float(mass.get("value")) for mass in root.iterfind("link/inertial/mass"))


@pytest.mark.skipif(not EXAMPLES.exists(), reason="there are no examples")
def test_each_folder_of_examples_has_one_main_file() -> None:
    assert ROBOTS, "no robot among the examples"
    for folder in FOLDERS:
        assert len(main_files(folder)) == 1, main_files(folder)


@pytest.mark.parametrize("path", MAINS, ids=name_of)
def test_example_compiles_with_no_warning_but_those_it_shows(path: Path) -> None:
    build = yamaro.build(str(path), advice=True)
    shown = SHOWN_WARNINGS.get(name_of(path), [])
    assert [warning.code for warning in build.warnings] == shown
    assert etree.fromstring(build.xml().encode()).tag == build.root.name


@robots
def test_check_urdf_accepts(path: Path) -> None:
    verdict = oracles.CheckUrdf(compile_example(path))
    assert verdict.accepts, verdict.output


@robots
def test_yourdfpy_finds_every_link_and_joint(path: Path) -> None:
    root = parse(path)
    robot = oracles.load_yourdfpy(compile_example(path), path.parent)
    assert robot.validate()
    assert list(robot.link_map) == [link.get("name") for link in root.findall("link")]
    assert list(robot.joint_map) == [joint.get("name") for joint in root.findall("joint")]


@robots
def test_pinocchio_moves_every_joint_and_weighs_the_same(path: Path) -> None:
    pinocchio = oracles.require_module("pinocchio")
    root = parse(path)
    model = oracles.load_pinocchio(compile_example(path))
    moving = {joint.get("name") for joint in root.findall("joint") if joint.get("type") != "fixed"}
    # The first two names are the world and the free joint of the root.
    assert set(list(model.names)[2:]) == moving
    assert pinocchio.computeTotalMass(model) == pytest.approx(total_mass(root), rel=1e-9)


@robots
def test_mujoco_accepts_every_inertia(path: Path) -> None:
    root = parse(path)
    model = oracles.load_mujoco(compile_example(path))
    assert model.nbody == len(root.findall("link")) + 1
    assert sum(model.body_mass) == pytest.approx(total_mass(root), rel=1e-9)


@robots
def test_inertia_of_primitive_shapes_is_what_others_compute(path: Path) -> None:
    compared = 0
    for link in parse(path).findall("link"):
        inertial = link.find("inertial")
        if inertial is None:
            continue
        mass, actual = oracles.urdf_inertia(inertial)
        pose = oracles.urdf_pose(inertial)
        owners = [*link.findall("collision"), *link.findall("visual")]
        there = [oracles.urdf_shape(o) for o in owners if oracles.urdf_pose(o) == pose]
        shapes = [shape for shape in there if shape is not None]
        if not shapes:
            continue
        kind, size = shapes[0]
        for judge in (oracles.pinocchio_inertia, oracles.mujoco_inertia):
            expected = judge(kind, size, mass)
            np.testing.assert_allclose(
                actual, expected, rtol=1e-6, atol=1e-9 * mass, err_msg=link.get("name")
            )
        compared += 1
    assert compared > 0, "no link has a primitive shape in its inertial frame"


@needs("tree")
@robots
def test_tree_tells_the_total_mass(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tree", "--trust", "-q", str(path)]) == 0
    summary = capsys.readouterr().out
    told = re.search(r"([0-9.]+) kg$", summary.rstrip())
    assert told is not None, summary
    assert float(told[1]) == pytest.approx(total_mass(parse(path)), rel=1e-3)
