"""libsdformat, its schema and Drake, as judges of SDFormat; pinocchio reads the URDF.

Drake has no friction in joints, and treats mimic as a constraint of its solver: both are compared
as text.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

from yamaro.model import Robot
from yamaro.targets.losses import Loss

DESCRIPTIONS = Path("/usr/share/sdformat12/1.9")
"""The elements of SDFormat 1.9, as libsdformat describes them to itself."""
OTHERS = "{https://drake.mit.edu}"
"""The namespace of elements that are for Drake, which libsdformat lets through."""
TOLERANCE = 1e-9
Matrix = np.ndarray[Any, Any]


def complaint_of_description(text: str, folder: Path = DESCRIPTIONS) -> str:
    """Return the first element or value that libsdformat's descriptions do not know, or "".

    libsdformat itself says nothing of elements that it does not know. Its schema (.xsd) can judge
    nothing: it has no texts in `<pose>`, and declares `<model>` twice.

    Args:
        text: the document.
        folder: that of the descriptions. Where they are those of 1.9, `<mimic>` is let through.
    """
    if not folder.exists():
        return ""
    root = etree.fromstring(text.encode())
    return _fault(root, _described("root.sdf", folder), folder)


@cache
def _described(name: str, folder: Path) -> etree._Element:
    return etree.parse(str(folder / name)).getroot()


def _members(description: etree._Element, folder: Path) -> dict[str, etree._Element]:
    """Return the descriptions of the elements that an element may hold, by name."""
    found = {}
    for each in description:
        if each.tag == "include":
            name = each.get("filename")
            if (folder / name).exists():  # Debian has left some out
                inner = _described(name, folder)
                found[inner.get("name")] = inner
            else:
                found[name.removesuffix(".sdf")] = each
        elif each.tag == "element" and each.get("name"):
            inner = each
            if each.get("ref"):
                inner = _described(each.get("ref") + ".sdf", folder)
            found[each.get("name")] = inner
    return found


def _fault(element: etree._Element, description: etree._Element, folder: Path) -> str:
    if description.tag == "include":
        return ""
    attributes = {each.get("name"): each for each in description.findall("attribute")}
    for name in element.attrib:
        if name not in attributes:
            return f"<{element.tag}> has no attribute '{name}' (line {element.sourceline})"
    for name, attribute in attributes.items():
        if attribute.get("required") == "1" and name not in element.attrib:
            return f"<{element.tag}> needs '{name}' (line {element.sourceline})"
    fault = _fault_of_value(element, description.get("type") or "")
    if fault:
        return fault
    if description.find("element[@copy_data]") is not None:
        return ""
    members = _members(description, folder)
    for child in element:
        if child.tag == "mimic" and folder == DESCRIPTIONS:
            continue
        if child.tag.startswith(OTHERS):
            continue
        if child.tag not in members:
            return f"<{element.tag}> has no <{child.tag}> (line {child.sourceline})"
        fault = _fault(child, members[child.tag], folder)
        if fault:
            return fault
    for name, member in members.items():
        if member.get("required") in ("1", "+") and element.find(name) is None:
            if member.get("default") is None:
                return f"<{element.tag}> needs <{name}> (line {element.sourceline})"
    return ""


COUNTS = {"double": 1, "float": 1, "int": 1, "unsigned int": 1, "vector3": 3, "vector2d": 2}


def _fault_of_value(element: etree._Element, kind: str) -> str:
    words = (element.text or "").split()
    place = f"<{element.tag}> (line {element.sourceline})"
    count = COUNTS.get(kind) or {"pose": 6, "color": 4}.get(kind, 0)
    if kind == "pose" and not words:
        return ""
    if count and len(words) != count:
        return f"{place} has {len(words)} numbers"
    for word in words if count else ():
        try:
            (int if "int" in kind else float)(word)
        except ValueError:
            return f"{place}: '{word}' is not a number"
    return ""


def complaint_of_libsdformat(path: Path) -> str:
    """Return the first complaint of `ign sdf -k`, or ""."""
    with tempfile.TemporaryDirectory() as home:
        done = subprocess.run(
            ["ign", "sdf", "-k", str(path)],
            capture_output=True,
            text=True,
            env={**os.environ, "HOME": home},
            check=False,
        )
    lines = [line for line in done.stderr.splitlines() if "backtrace" not in line]
    if done.returncode == 0 and "Valid." in done.stdout and not lines:
        return ""
    return "; ".join([*lines, *done.stdout.splitlines()])[:300]


def disagreement(
    urdf: Path, sdf: Path, robot: Robot, losses: Sequence[Loss], *, positions: int
) -> str:
    """Return where Drake, which reads the SDF, and pinocchio, which reads the URDF, disagree.

    Args:
        urdf: the robot in URDF.
        sdf: the robot in SDFormat.
        robot: the robot.
        losses: what was told.
        positions: how many random positions are tried.
    """
    import pinocchio

    for inertia in etree.parse(str(urdf)).iterfind("link/inertial/inertia"):
        if not {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"} <= set(inertia.attrib):
            return "not judged: urdfdom leaves out an inertia of which numbers are missing"
    try:
        model = pinocchio.buildModelFromUrdf(str(urdf), pinocchio.JointModelFreeFlyer())
    except (ValueError, RuntimeError) as error:
        return f"pinocchio: {str(error).splitlines()[0][:120]}"
    return _Comparison(model, sdf, robot, losses).run(positions)


class _Comparison:
    """Compares one robot, as pinocchio and Drake see it."""

    def __init__(self, model: Any, sdf: Path, robot: Robot, losses: Sequence[Loss]) -> None:
        import pinocchio
        from pydrake.common import configure_logging
        from pydrake.multibody import parsing
        from pydrake.multibody.plant import MultibodyPlant

        configure_logging()
        self.pin = pinocchio
        self.model, self.data = model, model.createData()
        self.robot = robot
        self.told = {(loss.what, loss.owner) for loss in losses}
        self.plant: Any = MultibodyPlant(1e-3)
        parser: Any = parsing.Parser(self.plant)
        (self.instance,) = parser.AddModels(str(sdf))
        self.plant.set_gravity_enabled(self.instance, True)
        self.plant.Finalize()
        self.context = self.plant.CreateDefaultContext()
        self.root = robot.roots[0].name
        for name, actuator in robot.actuators.items():  # which the URDF does not say
            if actuator.armature and model.existJointName(name):
                model.armature[model.joints[model.getJointId(name)].idx_v] = actuator.armature

    def run(self, positions: int) -> str:
        total = sum(inertia.mass for inertia in list(self.model.inertias)[1:])
        found = self.plant.CalcTotalMass(self.context, [self.instance])
        placeholders = 1e-3 * sum(1 for what, _ in self.told if what == "links without mass")
        if abs(found - placeholders - total) > TOLERANCE * max(total, 1e-3):
            return f"mass {found} != {total}"
        fault = self._limits()
        if fault:
            return fault
        random = np.random.default_rng(7)
        for _ in range(positions):
            fault = self._at(random)
            if fault:
                return fault
        return ""

    def _joints(self) -> list[tuple[Any, Any]]:
        """Return the joints of one degree of freedom: pinocchio's number and Drake's joint."""
        pairs = []
        for name, joint in self.robot.joints.items():
            if joint.type in ("revolute", "continuous", "prismatic"):
                other = name
                if not self.plant.HasJointNamed(name, self.instance):
                    other = f"{name}_joint"
                pairs.append(
                    (self.model.getJointId(name), self.plant.GetJointByName(other, self.instance))
                )
        return pairs

    def _limits(self) -> str:
        for number, joint in self._joints():
            name = self.model.names[number]
            mine = self.robot.joints[name]
            pairs: list[tuple[str, float, float]] = [
                ("damping", joint.default_damping(), mine.dynamics.damping if mine.dynamics else 0)
            ]
            swapped = any(what == "limits in the wrong order" for what, _ in self.told)
            if mine.lower is not None and mine.upper is not None and not swapped:
                pairs.append(("lower", joint.position_lower_limits()[0], mine.lower))
                pairs.append(("upper", joint.position_upper_limits()[0], mine.upper))
            if mine.limit is not None and mine.limit.velocity:
                pairs.append(("velocity", joint.velocity_upper_limits()[0], mine.limit.velocity))
            for what, found, wanted in pairs:
                if abs(found - wanted) > TOLERANCE * max(abs(wanted), 1):
                    return f"{what} of {name}: {found} != {wanted}"
        return ""

    def _at(self, random: Any) -> str:
        """Return the disagreement at one random position, or ""."""
        pin, model, data, plant, context = (
            self.pin, self.model, self.data, self.plant, self.context,
        )  # fmt: skip
        q = pin.neutral(model)
        v, a = np.zeros(model.nv), np.zeros(model.nv)
        q_drake = np.zeros((plant.num_positions(), 1))
        v_drake, a_drake = (np.zeros((plant.num_velocities(), 1)) for _ in range(2))
        pairs = self._joints()
        for number, joint in pairs:
            angle, speed, push = random.uniform(-1, 1, 3)
            pj = model.joints[number]
            if pj.nq == 2:
                q[pj.idx_q], q[pj.idx_q + 1] = np.cos(angle), np.sin(angle)
            else:
                q[pj.idx_q] = angle
            v[pj.idx_v], a[pj.idx_v] = speed, push
            q_drake[joint.position_start()] = angle
            v_drake[joint.velocity_start()], a_drake[joint.velocity_start()] = speed, push
        # Bases that float are at the identity, also in Drake.
        for body in plant.GetFloatingBaseBodies():
            q_drake[plant.get_body(body).floating_positions_start()] = 1.0
        plant.SetPositions(context, q_drake)
        plant.SetVelocities(context, v_drake)
        self._q = q
        pin.framesForwardKinematics(model, data, q)
        return self._poses() or self._dynamics(q, v, a, a_drake, pairs)

    def _poses(self) -> str:
        base = self._pose_in_drake(self.root)
        origin = self._pose_in_pinocchio(self.root)
        for name in self._held(self.root):
            wanted = np.linalg.inv(origin) @ self._pose_in_pinocchio(name)
            found = self._pose_in_drake(name)
            if found is None:
                if name == self.root:
                    continue
                return f"no frame {name} in Drake"
            found = found if base is None else np.linalg.inv(base) @ found
            if np.abs(found - wanted).max() > TOLERANCE * max(1, np.abs(wanted).max()):
                return f"pose of {name}: off by {np.abs(found - wanted).max():.1e}"
        return self._whole(base)

    def _held(self, root: str) -> list[str]:
        """Return the links that joints hold, and not those that float."""
        found = [root]
        for name in found:
            found += [
                joint.child for joint in self.robot.joints_below(name) if joint.type != "floating"
            ]
        return found

    def _whole(self, base: Matrix | None) -> str:
        """Compare the inertia of the whole robot about its root."""
        plant, model, data = self.plant, self.model, self.data
        told = {what for what, _ in self.told}
        if told & {"links without mass", "floating joints"}:
            return ""
        frame = plant.world_frame() if base is None else plant.GetFrameByName(self.root)
        found = plant.CalcSpatialInertia(
            self.context, frame, plant.GetBodyIndices(self.instance)
        ).CopyToFullMatrix6()
        inertia = self.pin.crba(model, data, self._q)[:6, :6]
        order = [3, 4, 5, 0, 1, 2]  # Drake: rotation first
        wanted = (np.triu(inertia) + np.triu(inertia, 1).T)[np.ix_(order, order)]
        off = np.abs(found - wanted).max()
        if off > TOLERANCE * max(np.abs(wanted).max(), 1e-9):
            return f"inertia of the whole robot off by {off:.1e}"
        return ""

    def _pose_in_pinocchio(self, name: str) -> Matrix:
        frame = self.model.getFrameId(name, self.pin.FrameType.BODY)
        return np.asarray(self.data.oMf[frame].homogeneous)

    def _pose_in_drake(self, name: str) -> Matrix | None:
        for each in (name, f"{name}_link"):
            if self.plant.HasFrameNamed(each, self.instance):
                frame = self.plant.GetFrameByName(each, self.instance)
                pose = frame.CalcPoseInWorld(self.context).GetAsMatrix4()
                return np.asarray(pose)
        return None

    def _dynamics(
        self, q: Matrix, v: Matrix, a: Matrix, a_drake: Matrix, pairs: list[tuple[Any, Any]]
    ) -> str:
        pin, model, data, plant, context = (
            self.pin, self.model, self.data, self.plant, self.context,
        )  # fmt: skip
        if "floating joints" in {what for what, _ in self.told}:
            return ""  # these have other coordinates, as was said
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        ours = [model.joints[number].idx_v for number, _ in pairs]
        theirs = [joint.velocity_start() for _, joint in pairs]
        if not ours:
            return ""
        wanted = mass[np.ix_(ours, ours)]
        found = plant.CalcMassMatrix(context)[np.ix_(theirs, theirs)]
        if np.abs(found - wanted).max() > TOLERANCE * max(np.abs(wanted).max(), 1e-9):
            return f"mass matrix off by {np.abs(found - wanted).max():.1e}"
        from pydrake.multibody.tree import MultibodyForces

        forces = MultibodyForces(plant)
        plant.CalcForceElementsContribution(context, forces)
        torque = plant.CalcInverseDynamics(context, a_drake[:, 0], forces)[theirs]
        damping = np.array([joint.default_damping() for _, joint in pairs])
        wanted_torque = pin.rnea(model, data, q, v, a)[ours] + damping * v[ours]
        off = np.abs(torque - wanted_torque).max()
        if off > TOLERANCE * max(np.abs(wanted_torque).max(), 1e-9):
            return f"inverse dynamics off by {off:.1e}"
        return ""
