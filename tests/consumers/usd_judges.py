"""OpenUSD, as a judge of USD: its validators, and a model of pinocchio made of what it reads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from yamaro.model import Robot

Matrix = np.ndarray[Any, Any]
TOLERANCE = 1e-5


def complaints_of(path: Path) -> list[str]:
    """Return what OpenUSD's validators find."""
    from pxr import Usd, UsdValidation

    stage = Usd.Stage.Open(str(path))
    context = UsdValidation.ValidationContext(
        UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    )
    return [error.GetMessage() for error in context.Validate(stage)]


def disagreement(
    urdf: str, usd: Path, robot: Robot, *, positions: int, placeholders: int = 0
) -> str:
    """Return where the robot that OpenUSD reads moves otherwise than the URDF, or "".

    Args:
        urdf: the robot in URDF, as text.
        usd: the robot in USD.
        robot: the robot.
        positions: how many random positions are tried.
        placeholders: how many links without mass have 1 g.
    """
    import pinocchio

    try:
        model = pinocchio.buildModelFromXML(urdf)
    except (ValueError, RuntimeError) as error:
        return f"pinocchio: {str(error).splitlines()[0][:120]}"
    read = _Read(usd, robot)
    total = sum(inertia.mass for inertia in model.inertias)
    found = sum(inertia.mass for inertia in read.model.inertias)
    found -= 1e-3 * placeholders
    root = robot.links[robot.roots[0].name].mass
    if abs(found - total) > TOLERANCE * max(total, 1e-3) and abs(found - total - root) > 1e-5:
        return f"mass {found} != {total}"
    random = np.random.default_rng(5)
    for _ in range(positions):
        fault = _at(model, read, robot, random)
        if fault:
            return fault
    return ""


def _at(model: Any, read: _Read, robot: Robot, random: Any) -> str:
    import pinocchio

    q, p = pinocchio.neutral(model), np.zeros(read.model.nq)
    ours, theirs = [], []
    for name, joint in robot.joints.items():
        if joint.type not in ("revolute", "continuous", "prismatic"):
            continue
        angle = random.uniform(-1, 1)
        mine, other = model.joints[model.getJointId(name)], read.joint(name)
        if mine.nq == 2:
            q[mine.idx_q : mine.idx_q + 2] = np.cos(angle), np.sin(angle)
        else:
            q[mine.idx_q] = angle
        p[other.idx_q] = angle
        ours.append(mine.idx_v)
        theirs.append(other.idx_v)
    data, found = model.createData(), read.model.createData()
    pinocchio.framesForwardKinematics(model, data, q)
    pinocchio.framesForwardKinematics(read.model, found, p)
    for name in robot.links:
        frame = read.frames.get(name)
        if frame is None:
            continue
        wanted = data.oMf[model.getFrameId(name, pinocchio.FrameType.BODY)].homogeneous
        off = np.abs(found.oMf[frame].homogeneous - wanted).max()
        if off > TOLERANCE * max(1, np.abs(wanted).max()):
            return f"pose of {name} off by {off:.1e}"
    if not ours:
        return ""
    mass = [pinocchio.crba(*each) for each in ((model, data, q), (read.model, found, p))]
    mass = [np.triu(each) + np.triu(each, 1).T for each in mass]
    wanted = mass[0][np.ix_(ours, ours)]
    off = np.abs(mass[1][np.ix_(theirs, theirs)] - wanted).max()
    if off > TOLERANCE * np.abs(wanted).max():
        return f"mass matrix off by {off:.1e}"
    return ""


class _Read:
    """A robot, as pinocchio's model of the bodies and joints that OpenUSD finds in a file."""

    def __init__(self, path: Path, robot: Robot) -> None:
        import pinocchio
        from pxr import Usd, UsdGeom, UsdPhysics

        self.pin = pinocchio
        self.stage = Usd.Stage.Open(str(path))
        self.names = UsdGeom.XformCache()
        self.model = pinocchio.Model()
        self.frames: dict[str, int] = {}
        self._numbers: dict[str, int] = {}
        bodies = {
            str(prim.GetPath()): prim
            for prim in self.stage.Traverse()
            if prim.HasAPI(UsdPhysics.RigidBodyAPI)
        }
        joints = [
            UsdPhysics.Joint(prim) for prim in self.stage.Traverse() if prim.IsA(UsdPhysics.Joint)
        ]
        joints = [each for each in joints if not each.GetExcludeFromArticulationAttr().Get()]
        self._children: dict[str, list[Any]] = {}
        held = set()
        for joint in joints:
            targets = [rel.GetTargets() for rel in (joint.GetBody0Rel(), joint.GetBody1Rel())]
            first, second = (str(each[0]) if each else "" for each in targets)
            self._children.setdefault(first, []).append((joint, second))
            held.add(second)
        identity = pinocchio.SE3.Identity()
        for name in bodies:
            if name not in held:
                self._add(name, 0, self._world(bodies[name]))
        self._below("", 0, identity)

    def joint(self, name: str) -> Any:
        """Return the joint of the model that is called like one of the robot, nearly."""
        plain = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)
        plain = f"_{plain}" if plain[0].isdigit() else plain
        return self.model.joints[self._numbers[plain]]

    def _world(self, prim: Any) -> Any:
        return self._se3(self.names.GetLocalToWorldTransform(prim))

    def _se3(self, matrix: Any) -> Any:
        rows = np.array(matrix).T
        return self.pin.SE3(rows[:3, :3], rows[:3, 3])

    def _local(self, joint: Any, number: int) -> Any:
        position = joint.GetPrim().GetAttribute(f"physics:localPos{number}").Get()
        rotation = joint.GetPrim().GetAttribute(f"physics:localRot{number}").Get()
        return self.pin.SE3(_matrix_of(rotation), np.array(position, dtype=float))

    def _add(self, path: str, number: int, placement: Any) -> None:
        """Add a body that is at a placement in a joint of the model, and what is on it."""
        from pxr import UsdPhysics

        pin, prim = self.pin, self.stage.GetPrimAtPath(path)
        mass = UsdPhysics.MassAPI(prim)
        axes = _matrix_of(mass.GetPrincipalAxesAttr().Get())
        inertia = axes @ np.diag(mass.GetDiagonalInertiaAttr().Get()) @ axes.T
        center = np.array(mass.GetCenterOfMassAttr().Get() or (0, 0, 0))
        center = np.where(np.isfinite(center), center, 0.0)
        body = pin.Inertia(mass.GetMassAttr().Get(), center, inertia)
        self.model.appendBodyToJoint(number, body, placement)
        inner = [
            each
            for each in (prim, *prim.GetAllChildren())
            if each.GetTypeName() == "Xform" and not each.IsInstance()
        ]
        for each in inner:
            at = placement * self._world(prim).inverse() * self._world(each)
            frame = pin.Frame(each.GetName(), number, at, pin.FrameType.OP_FRAME)
            self.frames.setdefault(each.GetName(), self.model.addFrame(frame))
        self._below(path, number, placement)

    def _below(self, path: str, number: int, placement: Any) -> None:
        """Add what hangs on a body."""
        from pxr import UsdPhysics

        pin = self.pin
        for joint, child in self._children.get(path, ()):
            prim = joint.GetPrim()
            at, end = placement * self._local(joint, 0), self._local(joint, 1).inverse()
            if prim.IsA(UsdPhysics.FixedJoint):
                self._add(child, number, at * end)
                continue
            axis = np.array([1.0, 0.0, 0.0])
            sliding = prim.IsA(UsdPhysics.PrismaticJoint)
            kind = pin.JointModelPrismaticUnaligned if sliding else pin.JointModelRevoluteUnaligned
            below = self.model.addJoint(number, kind(axis), at, prim.GetName())
            self._numbers[prim.GetName()] = below
            self._add(child, below, end)


def _matrix_of(quaternion: Any) -> Matrix:
    """Return the rotation of a quaternion of Gf, whose own way through an angle is less exact."""
    w, (x, y, z) = quaternion.GetReal(), quaternion.GetImaginary()
    w, x, y, z = np.array([w, x, y, z], dtype=float) / np.sqrt(w * w + x * x + y * y + z * z)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
