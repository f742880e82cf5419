"""The robots of `robots/`: each is the vendor's except for what it lists; all formats have readers.

`tests/shelf.py` reads both sides by other people's programs, and describes the files.
"""

from __future__ import annotations

import importlib.util
import json
import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import yaml
from lxml import etree

import yamaro
from tests import shelf
from tests.consumers import oracles
from tests.consumers.usd_judges import complaints_of
from tests.effort import tried
from tests.later import Later
from yamaro.commands.main import main

if TYPE_CHECKING:
    import mujoco
    import scipy.optimize as scipy
else:
    mujoco, scipy = Later("mujoco"), Later("scipy.optimize")

NAMES = shelf.names()
VENDORS = [(name, vendor) for name in NAMES for vendor in shelf.vendor_files(name)]
FORMATS = ("urdf", "sdf", "mjcf", "usd")

each_robot = pytest.mark.parametrize("name", NAMES)
each_written = pytest.mark.parametrize("name", tried(NAMES, str, quick=4, usual=1))
"""Those that are written in all formats, which takes most of the time."""
each_model = pytest.mark.parametrize(
    ("name", "vendor"),
    VENDORS,
    ids=lambda value: shelf.model_of(value) if isinstance(value, Path) else value,
)


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Give the folder with all formats of a robot, by its name."""

    @cache
    def write(name: str) -> Path:
        robot = yamaro.build(str(shelf.main_file(name))).robot
        formats = [*FORMATS, *(["srdf"] if robot.groups else [])]
        folder = tmp_path_factory.mktemp(name)
        command = [str(shelf.main_file(name)), "-q", "--to", ",".join(formats), "-o", f"{folder}/"]
        assert main(command) == 0
        return folder

    return write


def of_kind(folder: Path, ending: str) -> Path:
    (path,) = (one for one in folder.glob(f"*{ending}") if one.name != "scene.xml")
    return path


def mass_in(folder: Path) -> float:
    """Return the mass of a robot, as yourdfpy reads its URDF."""
    read = shelf.read_urdf(of_kind(folder, ".urdf").read_text(encoding="utf-8"))
    return float(sum(link.get("mass", 0.0) for link in read["links"].values()))


@cache
def recorded(vendor: Path) -> Any:
    return json.loads(vendor.read_text(encoding="utf-8"))


@cache
def urdf_of(name: str, vendor: Path) -> str:
    """Return the URDF of a robot as a text; loops, which have a file beside it, are left out."""
    return yamaro.build(str(shelf.main_file(name)), variables=recorded(vendor)["set"]).xml()


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location(
        "shelf_script", shelf.ROBOTS.parent / "scripts" / "shelf.py"
    )
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# --- the vendor's robot -----------------------------------------------------------------------


@each_model
def test_what_differs_from_the_vendor_is_listed_with_a_reason(name: str, vendor: Path) -> None:
    found = shelf.differences(recorded(vendor), shelf.read_urdf(urdf_of(name, vendor)))
    listed = shelf.listed(name, vendor)
    assert found.keys() - listed.keys() == set(), "is not listed: see scripts/shelf differences"
    assert listed.keys() - found.keys() == set(), "is listed, but is the same"
    wrong = [path for path in found if not shelf.are_same(path, listed[path], found[path])]
    assert wrong == []


@each_model
def test_pinocchio_puts_all_links_where_those_of_the_vendor_are(name: str, vendor: Path) -> None:
    record = recorded(vendor)
    urdf = urdf_of(name, vendor)
    expected = shelf.patched(record, shelf.listed(name, vendor), shelf.read_urdf(urdf))
    ours = shelf.Placing(urdf)
    theirs = shelf.Placing(shelf.urdf_of(expected))
    compared = 0
    for positions in shelf.random_positions(expected, 20):
        here, there = ours(positions), theirs(positions)
        links = [link for link in there if link in here]
        compared += len(links)
        off = {link: float(abs(here[link] - there[link]).max()) for link in links}
        assert max(off.values()) <= shelf.POSE, max(off, key=lambda link: off[link])
    assert compared >= 20 * 0.9 * len(expected["links"])


@pytest.mark.parametrize("name", sorted({name for name, _ in VENDORS}))
def test_it_is_shorter_than_what_the_vendor_wrote(name: str) -> None:
    theirs = sum(recorded(vendor)["source"]["lines"] for vendor in shelf.vendor_files(name))
    assert shelf.own_lines(name) < theirs


@each_model
def test_the_source_has_a_licence_and_a_commit(name: str, vendor: Path) -> None:
    source = recorded(vendor)["source"]
    assert source["license"] in {
        "Apache-2.0",
        "BSD-2-Clause",
        "BSD-3-Clause",
        "BSD-3-Clause-Clear",
        "MIT",
        "Zlib",
    }
    assert re.fullmatch(r"[0-9a-f]{40}", source["commit"])
    assert source["license"] in (shelf.ROBOTS / name / "README.md").read_text(encoding="utf-8")


def test_the_platform_of_the_delta_is_where_three_spheres_meet(
    written: Callable[[str], Path],
) -> None:
    """Pinocchio reads the tree; what closes it is solved here from the file beside the URDF."""
    arm, rod, base_radius, platform_radius = 0.3545, 0.8, 0.2, 0.052
    urdf = of_kind(written("delta"), ".urdf")
    loops = yaml.safe_load(urdf.with_suffix(".loops.yaml").read_text(encoding="utf-8"))["loops"]
    record = shelf.read_urdf(urdf.read_text(encoding="utf-8"))
    moving = [name for name, joint in record["joints"].items() if joint["type"] != "fixed"]
    passive = [name for name in moving if not name.startswith("joint_")]
    random = np.random.default_rng(3)
    place = shelf.Placing(urdf.read_text(encoding="utf-8"))

    def open_by(values: Any, motors: dict[str, float]) -> Any:
        found = place({**motors, **dict(zip(passive, values, strict=True))})
        ends = [[found[link][:3, 3] for link in loop["between"]] for loop in loops]
        return np.concatenate([one - other for one, other in ends])

    for _ in range(5):
        motors = {f"joint_{i}": random.uniform(-0.3, 0.8) for i in (1, 2, 3)}
        solved = scipy.least_squares(
            open_by, np.zeros(len(passive)), args=(motors,), xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        assert abs(solved.fun).max() < 1e-10
        centres = []
        for i, angle in enumerate(motors.values()):
            inward = base_radius + arm * math.cos(angle) - platform_radius
            turn = math.radians(120 * i)
            centres.append(
                [inward * math.cos(turn), inward * math.sin(turn), -arm * math.sin(angle)]
            )
        found = place({**motors, **dict(zip(passive, solved.x, strict=True))})["platform"]
        assert found[:3, 3] == pytest.approx(lower_point(centres, rod), abs=1e-9)
        assert found[:3, :3] == pytest.approx(np.eye(3), abs=1e-9)


def lower_point(centres: Any, radius: float) -> Any:
    """Return the lower of the two points that are one distance from three others."""
    a, b, c = map(np.array, centres)
    normal = np.cross(b - a, c - a)
    area = normal @ normal
    to_middle = (
        np.cross(normal, b - a) * ((c - a) @ (c - a))
        + np.cross(c - a, normal) * ((b - a) @ (b - a))
    ) / (2 * area)  # of the circle through them
    height = math.sqrt((radius**2 - to_middle @ to_middle) / area)
    points = [a + to_middle + sign * height * normal for sign in (1, -1)]
    return min(points, key=lambda point: float(point[2]))


# --- the formats and their readers ------------------------------------------------------------


@each_robot
def test_check_finds_nothing_and_its_own_test_passes(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "--strict", str(shelf.main_file(name))]) == 0, capsys.readouterr().err
    files = [str(path) for path in sorted((shelf.ROBOTS / name).glob("*/*.yaml"))]
    assert main(["fmt", "--check", *files]) == 0, capsys.readouterr().err
    assert main(["test", str(shelf.ROBOTS / name)]) == 0, capsys.readouterr().err


@each_written
def test_urdfdom_accepts_it(name: str, written: Callable[[str], Path]) -> None:
    run = oracles.run_check_urdf(of_kind(written(name), ".urdf"))
    assert run.returncode == 0, run.stdout + run.stderr


@each_written
def test_mujoco_holds_it_still_where_it_starts(name: str, written: Callable[[str], Path]) -> None:
    model = mujoco.MjModel.from_xml_path(str(written(name) / "scene.xml"))
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_SENSOR  # a lidar takes most of the time
    data = mujoco.MjData(model)
    assert model.body_mass.sum() == pytest.approx(mass_in(written(name)), rel=1e-6)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    start = data.qpos.copy()
    mujoco.mj_forward(model, data)
    inside = [float(contact.dist) for contact in data.contact if contact.dist < -1e-3]
    assert inside == [], "parts of it are in each other, or in the ground"
    while data.time < 1.0:
        mujoco.mj_step(model, data)
    assert not any(warning.number for warning in data.warning)
    moved = {
        model.joint(index).name: float(abs(data.qpos[at] - start[at]).max())
        for index in range(model.njnt)
        if (at := slice(int(model.jnt_qposadr[index]), _end_of_joint(model, index)))
    }
    assert max(moved.values(), default=0.0) < 0.1, max(moved, key=lambda joint: moved[joint])


def _end_of_joint(model: Any, index: int) -> int:
    last = index + 1 == model.njnt
    return int(model.nq if last else model.jnt_qposadr[index + 1])


@each_written
def test_drake_reads_the_sdf(name: str, written: Callable[[str], Path]) -> None:
    oracles.require_module("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant: Any = MultibodyPlant(1e-3)
    (instance,) = Parser(plant).AddModels(str(of_kind(written(name), ".sdf")))
    if not yamaro.build(str(shelf.main_file(name))).robot.loops:  # Drake reads them, and no more
        plant.Finalize()
    found = sum(plant.get_body(body).default_mass() for body in plant.GetBodyIndices(instance))
    assert found == pytest.approx(mass_in(written(name)), rel=1e-6)


@each_written
def test_openusd_reads_the_usd(name: str, written: Callable[[str], Path]) -> None:
    from pxr import Usd, UsdPhysics

    path = of_kind(written(name), ".usda")
    assert complaints_of(path) == []
    stage = Usd.Stage.Open(str(path))
    masses = [UsdPhysics.MassAPI(prim).GetMassAttr().Get() or 0.0 for prim in stage.Traverse()]
    assert sum(masses) == pytest.approx(mass_in(written(name)), rel=1e-5)


@each_written
def test_pinocchio_takes_the_pairs_of_the_srdf(name: str, written: Callable[[str], Path]) -> None:
    found = list(written(name).glob("*.srdf"))
    if not found:
        pytest.skip("it has no groups")
    urdf = str(of_kind(written(name), ".urdf"))
    pinocchio = oracles.require_module("pinocchio")
    model = pinocchio.buildModelFromUrdf(urdf)
    geometry = pinocchio.buildGeomFromUrdf(model, urdf, pinocchio.COLLISION)
    geometry.addAllCollisionPairs()
    before = len(geometry.collisionPairs)
    pinocchio.removeCollisionPairs(model, geometry, str(found[0]))
    assert len(geometry.collisionPairs) <= before
    names = {link.get("name") for link in etree.parse(urdf).iterfind("link")}
    disabled = etree.parse(str(found[0])).findall("disable_collisions")
    assert {pair.get(side) for pair in disabled for side in ("link1", "link2")} <= names


# --- the folder -------------------------------------------------------------------------------


def test_the_page_of_all_robots_is_up_to_date(script: ModuleType) -> None:
    page = (shelf.ROBOTS / "README.md").read_text(encoding="utf-8")
    assert page == script.table(), "run scripts/shelf table"


@each_robot
def test_the_packages_files_are_up_to_date(name: str, script: ModuleType) -> None:
    for path, text in script.package(name).items():
        assert (shelf.ROBOTS / name / path).read_text(encoding="utf-8") == text
    assert (
        etree.parse(str(shelf.ROBOTS / name / "package.xml")).findtext("name") == f"yamaro_{name}"
    )
    assert (shelf.ROBOTS / name / "picture.png").stat().st_size < 60_000
