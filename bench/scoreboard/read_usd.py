"""USD as OpenUSD opens it, with the joints and bodies of UsdPhysics.

Values that UsdPhysics has no place for count under any of the names that simulators read: those of
Newton, Isaac Sim (PhysX) and MuJoCo.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .facts import NONE, Array, Body, Facts, Joint, ball, box, cylinder, moved, plain, pose, turned

VELOCITY = ("newton:velocityLimit", "physxJoint:maxJointVelocity",
            "physxJointAxis:{}:maxJointVelocity", "physxLimit:{}:maxJointVelocity")  # fmt: skip
DAMPING = ("newton:damping", "physxJointAxis:{}:viscousFrictionCoefficient")
"""With an angle in degrees, as velocities have it; None of these holds the damping of a drive."""
SI = {
    "effort": ("drive:{}:physics:maxForce", "newton:effortLimit"),
    "damping": ("mjc:damping",),
    "friction": ("newton:friction", "mjc:frictionloss", "physxJointAxis:{}:staticFrictionEffort",
                 "physxJoint:jointFriction"),
    "armature": ("newton:armature", "physxJoint:armature", "mjc:armature",
                 "physxJointAxis:{}:armature"),
}  # fmt: skip
SENSORS = {
    "Camera": "camera", "IsaacImuSensor": "imu", "IsaacContactSensor": "contact",
    "IsaacRaycastSensor": "lidar", "OmniLidar": "lidar", "IsaacLightBeamSensor": "lidar",
}  # fmt: skip
OF_MUJOCO = {
    "gyro": "imu", "accelerometer": "imu", "touch": "contact", "force": "force_torque",
    "torque": "force_torque", "rangefinder": "lidar", "magnetometer": "magnetometer",
}  # fmt: skip
"""The kinds of MjcSensor."""


def read(path: Path) -> Facts:
    """Return what is in a USD file."""
    return _Reading(path).facts


class _Reading:
    """The facts of one stage."""

    def __init__(self, path: Path) -> None:
        from pxr import Usd, UsdGeom, UsdPhysics

        self.usd, self.geom, self.physics = Usd, UsdGeom, UsdPhysics
        self.stage = Usd.Stage.Open(str(path))
        self.cache = UsdGeom.XformCache()
        self.facts = Facts("usd")
        prims = list(self.stage.Traverse(Usd.TraverseInstanceProxies()))
        self.links = {
            str(prim.GetPath()): prim for prim in prims if prim.HasAPI(UsdPhysics.RigidBodyAPI)
        }
        if not self.links:
            raise ValueError("no prim has the PhysicsRigidBodyAPI")
        self.edges: dict[str, list[Any]] = {}
        self.names: dict[str, str] = {}
        held = set()
        for prim in prims:
            if prim.IsA(UsdPhysics.Joint):
                joint = UsdPhysics.Joint(prim)
                ends = [self._end(each) for each in (joint.GetBody0Rel(), joint.GetBody1Rel())]
                self.names[str(prim.GetPath())] = plain(self._name(prim))
                if ends[0] != ends[1] and not joint.GetExcludeFromArticulationAttr().Get():
                    self.edges.setdefault(ends[0], []).append((prim, ends[1]))
                    held.add(ends[1])
        self.roots = [each for each in self.links if each not in held]
        self._bodies()
        self._values(prims)
        self.facts.place = self.place

    def place(self, positions: Mapping[str, float]) -> dict[str, Array]:
        return {
            name: at @ np.linalg.inv(self.inner[path])
            for path, name, at in self._walked(positions)
            if path in self.heads
        }

    def _walked(self, positions: Mapping[str, float]) -> Iterator[tuple[str, str, Array]]:
        """Yield each link, the joint that moves it, and its pose."""
        pending = [(root, "", self._world(self.links[root])) for root in self.roots]
        pending += self._hung("", "", np.eye(4), positions)
        seen = set()
        while pending:
            path, moves, at = pending.pop(0)
            if path in seen or path not in self.links:
                continue
            seen.add(path)
            yield path, moves, at
            pending += self._hung(path, moves, at, positions)

    def _hung(
        self, path: str, moves: str, at: Array, positions: Mapping[str, float]
    ) -> Iterator[tuple[str, str, Array]]:
        """Yield the links that joints hold on one, or on the world: "", where it is fixed."""
        for prim, child in self.edges.get(path, ()):
            turn, own = np.eye(4), moves
            if not prim.IsA(self.physics.FixedJoint):
                own = self.names[str(prim.GetPath())]
                value = positions.get(own, 0.0)
                axis = np.eye(3)["XYZ".index(prim.GetAttribute("physics:axis").Get() or "X")]
                if prim.IsA(self.physics.PrismaticJoint):
                    turn = pose(np.eye(3), axis * value)
                else:
                    turn = turned(axis, value)
            holder = prim.GetRelationship("physics:body0").GetTargets() if not path else ()
            start = self._world(self.stage.GetPrimAtPath(holder[0])) if holder else at
            yield child, own, start @ _local(prim, 0) @ turn @ np.linalg.inv(_local(prim, 1))

    def _end(self, relation: Any) -> str:
        """Return the path of the link that a joint names; "" for the world."""
        targets = relation.GetTargets()
        return str(targets[0]) if targets and str(targets[0]) in self.links else ""

    def _name(self, prim: Any) -> str:
        given = prim.GetAttribute("isaac:nameOverride")
        name = given.Get() if given and given.HasAuthoredValue() else prim.GetDisplayName()
        return str(name or prim.GetName())

    def _world(self, prim: Any) -> Array:
        rows = np.array(self.cache.GetLocalToWorldTransform(prim)).T
        sizes = np.linalg.norm(rows[:3, :3], axis=0)
        return pose(rows[:3, :3] / sizes, rows[:3, 3])

    def _bodies(self) -> None:
        facts = self.facts
        self.heads: set[str] = set()
        self.inner: dict[str, Array] = {}
        """Of each link its pose in the frame of its body: that of the first link."""
        first: dict[str, Array] = {}
        for path, moves, at in self._walked({}):
            if moves not in first:
                first[moves] = at
                self.heads.add(path)
                facts.bodies[moves] = Body()
            prim = self.links[path]
            inner = self.inner[path] = np.linalg.inv(first[moves]) @ at
            facts.frames.setdefault(plain(self._name(prim)), (moves, inner))
            facts.root = facts.root or plain(self._name(prim))
            self._mass(prim, facts.bodies[moves], inner)
            self._below(prim, moves, inner)

    def _mass(self, prim: Any, body: Body, inner: Array) -> None:
        mass = self.physics.MassAPI(prim)
        axes = _matrix(mass.GetPrincipalAxesAttr().Get())
        diagonal = np.array(mass.GetDiagonalInertiaAttr().Get() or (0, 0, 0), dtype=float)
        center = np.array(mass.GetCenterOfMassAttr().Get() or (0, 0, 0), dtype=float)
        center = np.where(np.isfinite(center), center, 0.0)
        full = prim.GetAttribute("newton:inertia")
        inertia = axes @ np.diag(diagonal) @ axes.T
        if full and full.HasAuthoredValue():
            xx, yy, zz, xy, xz, yz = full.Get()
            inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turn = inner[:3, :3]
        value = float(mass.GetMassAttr().Get() or 0)
        body.add(value, moved(center[None], inner)[0], turn @ inertia @ turn.T)

    def _below(self, link: Any, moves: str, inner: Array) -> None:
        """Read the frames, shapes and sensors below a link."""
        into = inner @ np.linalg.inv(self._world(link))
        walk = iter(self.usd.PrimRange(link, self.usd.TraverseInstanceProxies()))
        for prim in walk:
            if prim != link and str(prim.GetPath()) in self.links:
                walk.PruneChildren()
                continue
            if prim != link and prim.IsA(self.geom.Xformable):
                self.facts.frames.setdefault(
                    plain(self._name(prim)), (moves, into @ self._world(prim))
                )
            kind = SENSORS.get(prim.GetTypeName(), "")
            if kind:
                self.facts.sensors.append((kind, moves))
            if prim.HasAPI(self.physics.CollisionAPI):
                for shape in self.usd.PrimRange(prim, self.usd.TraverseInstanceProxies()):
                    matrix = np.array(self.cache.GetLocalToWorldTransform(shape)).T
                    points = self._points(shape)
                    if len(points):
                        self.facts.bodies[moves].touch(moved(points, into @ matrix))

    def _points(self, prim: Any) -> Array:
        def value(name: str) -> Any:
            return prim.GetAttribute(name).Get()

        kind, geom = prim.GetTypeName(), self.geom
        if kind == "Cube":
            return box(*[value("size") / 2] * 3)
        if kind == "Sphere":
            return ball(value("radius"))
        if kind in ("Cylinder", "Capsule"):
            half, axis = value("height") / 2, value("axis")
            points = (
                cylinder(value("radius"), half)
                if kind == "Cylinder"
                else ball(value("radius"), half=half)
            )
            return np.roll(points, {"X": 1, "Y": 2, "Z": 0}[axis], axis=1)
        if prim.IsA(geom.Mesh) and value("points") is not None:
            return np.array(value("points"), dtype=float).reshape(-1, 3)
        return NONE

    def _values(self, prims: list[Any]) -> None:
        facts = self.facts
        for prim in prims:
            kind = prim.GetTypeName()
            if kind in ("PhysicsRevoluteJoint", "PhysicsPrismaticJoint"):
                self._joint(prim, "linear" if "Prismatic" in kind else "angular")
        for prim in prims:
            kind = prim.GetTypeName()
            for relation in prim.GetRelationships():
                targets = [self.names.get(str(each), "") for each in relation.GetTargets()]
                targets = [each for each in targets if each]
                is_actuator = relation.GetName() in ("newton:targets", "mjc:target")
                if is_actuator and "Actuator" in kind:
                    for name in targets:
                        facts.drives[name] = _gain(prim) or facts.drives.get(name)
                        joint = facts.joints.get(name)
                        if joint and joint.effort is None:
                            joint.effort = _effort(prim)
            if kind == "MjcSensor":
                self._sensor(prim)

    def _joint(self, prim: Any, axis: str) -> None:
        facts = self.facts
        unit = math.pi / 180 if axis == "angular" else 1.0
        name = self.names[str(prim.GetPath())]

        def first(names: tuple[str, ...], scale: float = 1.0) -> float | None:
            for each in names:
                attribute = prim.GetAttribute(each.format(axis))
                if attribute and attribute.HasAuthoredValue():
                    number = attribute.Get()
                    if isinstance(number, (int, float)):
                        return float(number) * scale
            return None

        found = {key: first(names) for key, names in SI.items()}
        joint = Joint("revolute" if axis == "angular" else "prismatic")
        lower, upper = (
            prim.GetAttribute(f"physics:{end}Limit").Get() for end in ("lower", "upper")
        )
        joint.lower, joint.upper = (
            (-math.inf if lower is None else lower * unit),
            (math.inf if upper is None else upper * unit),
        )
        joint.effort = found["effort"]
        if joint.effort is None:
            span = prim.GetAttribute("mjc:actuatorfrcrange:max")
            joint.effort = span.Get() if span and span.HasAuthoredValue() else None
        joint.velocity = first(VELOCITY, unit)
        damping = first(DAMPING, 1 / unit)
        joint.damping = (found["damping"] if damping is None else damping) or 0.0
        joint.friction, joint.armature = found["friction"] or 0.0, found["armature"] or 0.0
        facts.joints[name] = joint
        stiffness = prim.GetAttribute(f"drive:{axis}:physics:stiffness").Get() or 0.0
        resistance = prim.GetAttribute(f"drive:{axis}:physics:damping").Get() or 0.0
        schemas = prim.GetMetadata("apiSchemas")
        applied = list(schemas.GetAddedOrExplicitItems()) if schemas else []
        if f"PhysicsDriveAPI:{axis}" in applied and (stiffness or resistance):
            facts.drives[name] = float(stiffness) / unit or None
        self._mimic(prim, name, unit, applied)

    def _mimic(self, prim: Any, name: str, unit: float, applied: list[str]) -> None:
        def leader(relation: str) -> str:
            targets = prim.GetRelationship(relation).GetTargets()
            return self.names.get(str(targets[0]), "") if targets else ""

        def number(key: str, default: float) -> float:
            attribute = prim.GetAttribute(key)
            value = attribute.Get() if attribute else None
            return default if value is None else float(value)

        if leader("newton:mimicJoint"):
            offset = number("newton:mimicCoef0", 0.0) * unit
            of = leader("newton:mimicJoint"), number("newton:mimicCoef1", 1.0), offset
            self.facts.mimics[name] = of
            return
        for each in applied:
            if each.startswith("PhysxMimicJointAPI:"):
                key = f"physxMimicJoint:{each.rpartition(':')[2]}"
                gear, offset = -number(f"{key}:gearing", 0.0), -number(f"{key}:offset", 0.0) * unit
                self.facts.mimics[name] = leader(f"{key}:referenceJoint"), gear, offset

    def _sensor(self, prim: Any) -> None:
        kind = OF_MUJOCO.get(str(prim.GetAttribute("mjc:type").Get() or ""))
        for target in prim.GetRelationship("mjc:target").GetTargets() if kind else ():
            at = self.stage.GetPrimAtPath(target)
            while at and str(at.GetPath()) not in self.links:
                at = at.GetParent()
            if at:
                moves = self.facts.frames[plain(self._name(at))][0]
                self.facts.sensors.append((str(kind), moves))


def _gain(prim: Any) -> float | None:
    """Return the stiffness of an actuator of Newton or MuJoCo."""
    for name in ("newton:kp", "newton:pdControl:kp", "newton:stiffness"):
        attribute = prim.GetAttribute(name)
        if attribute and attribute.HasAuthoredValue():
            return float(attribute.Get())
    bias = prim.GetAttribute("mjc:biasPrm")
    numbers = bias.Get() if bias else None
    if numbers is not None and len(numbers) > 1 and numbers[1]:
        return -float(numbers[1]) * _gear(prim) ** 2
    return None


def _effort(prim: Any) -> float | None:
    """Return the greatest effort of an actuator of MuJoCo, or of the controls of a motor."""
    is_motor = _gain(prim) is None
    for name in ("mjc:forceRange:max", "mjc:ctrlRange:max")[: 1 + is_motor]:
        attribute = prim.GetAttribute(name)
        if attribute and attribute.HasAuthoredValue():
            return float(attribute.Get()) * _gear(prim)
    return None


def _gear(prim: Any) -> float:
    attribute = prim.GetAttribute("mjc:gear")
    numbers = attribute.Get() if attribute else None
    return abs(float(numbers[0])) if numbers is not None and len(numbers) else 1.0


def _local(joint: Any, number: int) -> Array:
    position = joint.GetAttribute(f"physics:localPos{number}").Get() or (0, 0, 0)
    return pose(_matrix(joint.GetAttribute(f"physics:localRot{number}").Get()), position)


def _matrix(quaternion: Any) -> Array:
    """Return the rotation of a quaternion of Gf; where there is none, or of zeros, no rotation."""
    if quaternion is None:
        return np.eye(3)
    numbers = np.array([quaternion.GetReal(), *quaternion.GetImaginary()], dtype=float)
    size = float(np.linalg.norm(numbers))
    if not size:
        return np.eye(3)
    w, x, y, z = numbers / size
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
