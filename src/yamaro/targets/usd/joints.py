"""Joints of UsdPhysics: axes, limits, and what Newton's and PhysX's schemas hold besides.

The axis of a joint is X, Y or Z in USD: here always X, to which both of its frames are turned.
What UsdPhysics has no place for is written for Newton by `newton-usd-schemas`, and for PhysX, which
Isaac Sim runs, by `PhysxJointAxisAPI`: https://pypi.org/project/newton-usd-schemas/ and
https://pypi.org/project/physx-usd-schemas/. Both measure angles in degrees, as UsdPhysics does;
Newton's actuators alone are in radians.
"""

from __future__ import annotations

from math import degrees, inf
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, Usd, UsdPhysics, Vt

from ...model.joint import (
    CONTINUOUS,
    FIXED,
    FLOATING,
    PLANAR,
    PRISMATIC,
    SINGLE,
    UNLIMITED,
    Joint,
)  # fmt: skip
from ...model.kinematics import WORLD
from ...model.pose import Pose, multiply, rotation_about, rotation_from_z
from ...model.values import numbers_of
from ..gains import POSITION, VELOCITY
from ..holding import leader_of, lost_of_joints
from ..translation import SOFTNESS, Translation
from .control import ControlWriter
from .prims import element_of, quaternion_of, set_values

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.pose import Rotation, Vector
    from ...source import Span
    from ...xml.tree import Element
    from ..elements import Owner
    from .prims import Writing

KINDS = {PRISMATIC: UsdPhysics.PrismaticJoint, FIXED: UsdPhysics.FixedJoint}
EQUALITY = {"solref": [0.004, 1.0], "solimp": [0.99, 0.999, 0.001, 0.5, 2.0]}
"""How stiff it is that a joint follows another: in MJCF the same."""
LOOPS = {
    "fixed": UsdPhysics.FixedJoint,
    "ball": UsdPhysics.SphericalJoint,
    "revolute": UsdPhysics.RevoluteJoint,
}


class JointWriter:
    """Makes the joints of one robot.

    Attributes:
        elements: for each joint, an element at its place.
        has_variants: whether there is a variant with actuators of Newton in place of drives.
        losses: what USD cannot hold.
        prims: the joints of the articulation, with those that fix roots first.
    """

    def __init__(self, writing: Writing) -> None:
        self._stage, self._robot = writing.stage, writing.robot
        self._bodies, self._paths = writing.bodies, writing.paths
        self._names, self._is_fixed = writing.names, writing.wanted.is_fixed
        self._control = ControlWriter(writing)
        self._translation = Translation(writing.robot, "usd")
        self._folder = writing.names.new(writing.root, "joints")
        self._prims: dict[str, UsdPhysics.Joint] = {}
        self._made: list[tuple[Usd.Prim, Owner, Mapping[str, Span]]] = []
        self.elements: list[Element] = []
        self.has_variants = False
        self.prims: list[Usd.Prim] = []
        self.losses = lost_of_joints(writing.robot, "usd")

    def write(self) -> None:
        """Write all joints, with those that fix the roots in the world, and those of loops."""
        robot, bodies = self._robot, self._bodies
        self._stage.DefinePrim(self._folder, "Scope")
        for root in robot.roots:
            if self._is_fixed and bodies.carriers[root.name] is not None:
                path = self._names.new(self._folder, f"{root.name}_{WORLD}")
                prim = UsdPhysics.FixedJoint.Define(self._stage, path)
                carrier = self._bodies.carriers[root.name]
                self._connect(prim, None, carrier, Pose(), self._bodies.poses[root.name])
                self._made.append((prim.GetPrim(), root, {}))
        for joint in robot.joints.values():
            if robot.parent_joint(joint.child) is joint and joint.child in bodies.carriers:
                actuator = robot.actuators.get(joint.name)
                if actuator is not None:
                    self._control.lose(actuator)
                if joint.type == FLOATING:
                    how = "links that no joint holds"
                    self.losses.approximate("floating joints", joint, how=how)
                elif not bodies.is_dissolved(joint):
                    self._add(joint)
        for joint in robot.joints.values():
            if joint.mimic is not None and joint.name in self._prims:
                self._follow(joint)
        for name, leader, multiplier, offset, element in self._translation.couplings:
            if name in self._prims and leader in self._prims:
                softness = {word: numbers_of(element, word) for word in SOFTNESS}
                self._couple(robot.joints[name], leader, multiplier, offset, softness)
        self.prims = [prim for prim, *_ in self._made]
        for loop in robot.loops.values():
            path = self._names.told(self._folder, "loop", loop.name, loop)
            prim = LOOPS[loop.type].Define(self._stage, path)
            first, second = loop.between
            bodies, turn = self._bodies, Pose()
            if loop.axis is not None and loop.type != FIXED:  # which turns about none
                turn = Pose(_x_to(loop.axis))
                prim.CreateAxisAttr("X")
            self._connect(
                prim,
                bodies.carriers[first],
                bodies.carriers[second],
                bodies.poses[first] @ turn,
                bodies.poses[second] @ turn,
            )
            prim.CreateExcludeFromArticulationAttr(True)  # in which no loop can be
            self._made.append((prim.GetPrim(), loop, {}))
        self._control.finish()
        for prim, owner, places in self._made:
            motor = self._control.elements.get(owner.name) if isinstance(owner, Joint) else None
            children = [motor] if motor is not None else []
            self.elements.append(element_of(prim, owner, children=children, places=places))
        self.losses += self._control.losses
        self.has_variants = self._control.has_variants

    def _add(self, joint: Joint) -> None:
        kind = UsdPhysics.RevoluteJoint if joint.type in SINGLE else UsdPhysics.Joint
        kind = KINDS.get(joint.type, kind)
        path = self._names.told(self._folder, "joint", joint.name, joint)
        prim = kind.Define(self._stage, path)
        turn = Pose() if joint.type == FIXED else Pose(_x_to(joint.axis))
        bodies = self._bodies
        self._connect(
            prim,
            bodies.carriers[joint.parent],
            bodies.carriers[joint.child],
            bodies.poses[joint.parent] @ joint.origin @ turn,
            bodies.poses[joint.child] @ turn,
        )
        if joint.type in SINGLE:
            prim.CreateAxisAttr("X")
            lower, upper = joint.lower, joint.upper
            if joint.type == CONTINUOUS or lower is None or upper is None:
                lower, upper = -inf, inf
            if lower > upper:
                what, how = "limits in the wrong order", "swapping them"
                self.losses.approximate(what, joint, how=how)
                lower, upper = upper, lower
            convert = float if joint.type == PRISMATIC else degrees
            prim.CreateLowerLimitAttr(convert(lower))
            prim.CreateUpperLimitAttr(convert(upper))
            self._control.write(prim, joint)
            self._resist(prim, joint)
            self._prims[joint.name] = prim
        elif joint.type == PLANAR:
            for freedom in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ"):
                is_free = freedom in ("transY", "transZ", "rotX")  # Newton moves what has limits
                end = -inf if is_free else 1.0  # what is above and below at once is locked
                limit = UsdPhysics.LimitAPI.Apply(prim.GetPrim(), freedom)
                limit.CreateLowAttr(end)
                limit.CreateHighAttr(-end)
        self._made.append((prim.GetPrim(), joint, self._places_in(joint)))

    def _connect(
        self,
        prim: UsdPhysics.Joint,
        first: str | None,
        second: str | None,
        at_first: Pose,
        at_second: Pose,
    ) -> None:
        """Join two bodies, where None is the world, at poses in them."""
        if first is not None:
            prim.CreateBody0Rel().SetTargets([Sdf.Path(self._paths[first])])
        if second is not None:
            prim.CreateBody1Rel().SetTargets([Sdf.Path(self._paths[second])])
        prim.CreateLocalPos0Attr(Gf.Vec3f(*at_first.position))
        prim.CreateLocalRot0Attr(Gf.Quatf(quaternion_of(at_first)))
        prim.CreateLocalPos1Attr(Gf.Vec3f(*at_second.position))
        prim.CreateLocalRot1Attr(Gf.Quatf(quaternion_of(at_second)))

    def path_of(self, name: str) -> str:
        """Return the path of a joint of one number, or "" if it is not written."""
        prim = self._prims.get(name)
        return "" if prim is None else str(prim.GetPath())

    def native(self, name: str, position: float) -> float:
        """Return a position in the unit that USD has for a joint."""
        is_linear = self._robot.joints[name].type == PRISMATIC
        return position if is_linear else degrees(position)

    # --- resistance, followers ---

    def _resist(self, prim: UsdPhysics.RevoluteJoint, joint: Joint) -> None:
        """Write what resists a joint, and how fast it may be, for Newton and for PhysX."""
        limit, dynamics = joint.limit, joint.dynamics
        actuator = self._robot.actuators.get(joint.name)
        is_linear = joint.type == PRISMATIC
        unit = 1.0 if is_linear else degrees(1)
        armature = dynamics.armature or None if dynamics is not None else None
        armature = actuator.armature if actuator is not None else armature
        damping = dynamics.damping / unit if dynamics is not None else None
        friction = dynamics.friction if dynamics is not None else None
        fastest = limit.velocity if limit is not None else None
        if fastest is not None and not 0 < fastest < UNLIMITED:
            if fastest <= 0:
                what = "velocity limits that are not positive"
                self.losses.lose(what, joint, part=limit, field="velocity")
            fastest = None
        speed = fastest * unit if fastest is not None else None
        newton = {
            "armature": armature, "damping": damping, "friction": friction, "velocityLimit": speed
        }  # fmt: skip
        physx = {
            "armature": armature,
            "viscousFrictionCoefficient": damping,
            "staticFrictionEffort": friction,
            "dynamicFrictionEffort": friction,
            "maxJointVelocity": speed,
        }
        axis = "linear" if is_linear else "angular"
        usd = prim.GetPrim()
        set_values(usd, "NewtonJointAPI", "newton", newton)
        set_values(usd, f"PhysxJointAxisAPI:{axis}", f"physxJointAxis:{axis}", physx)

    def _follow(self, joint: Joint) -> None:
        """Have a joint follow another: as NewtonMimicAPI says, which PhysX reads too."""
        leader = leader_of(self._robot, joint)
        if leader is None or joint.mimic is None:
            return  # which is reported with the losses of all joints
        is_linear = joint.type == PRISMATIC
        if leader.name not in self._prims or is_linear != (leader.type == PRISMATIC):
            what = "joints that follow one of another unit"
            self.losses.lose(what, joint, part=joint.mimic)
            return
        mimic = joint.mimic
        self._couple(joint, leader.name, mimic.multiplier, mimic.offset, EQUALITY)

    def _couple(
        self,
        joint: Joint,
        leader: str,
        multiplier: float,
        offset: float,
        softness: Mapping[str, Sequence[float]],
    ) -> None:
        prim = self._prims[joint.name].GetPrim()
        offset = offset if joint.type == PRISMATIC else degrees(offset)
        values = {"mimicCoef0": offset, "mimicCoef1": multiplier}
        set_values(prim, "NewtonMimicAPI", "newton", values, keeps_zeros=True)
        target = self._prims[leader].GetPath()
        prim.CreateRelationship("newton:mimicJoint", custom=False).SetTargets([target])
        prim.AddAppliedSchema("MjcEqualityJointAPI")  # as stiff as in MJCF, for Newton's MuJoCo
        for name, numbers in softness.items():
            if numbers:
                kind = Sdf.ValueTypeNames.DoubleArray
                attribute = prim.CreateAttribute(f"mjc:{name}", kind, custom=False)
                attribute.Set(Vt.DoubleArray(numbers))

    def _places_in(self, joint: Joint) -> dict[str, Span]:
        """Return where the values of a joint are written, by their names in USD."""
        limit, dynamics = joint.limit, joint.dynamics
        actuator = self._robot.actuators.get(joint.name)
        found = {}
        if limit is not None:
            found["lowerLimit"] = limit.span_of("lower")
            found["upperLimit"] = limit.span_of("upper")
            found["maxForce"] = limit.span_of("effort")
            found["velocityLimit"] = found["maxJointVelocity"] = limit.span_of("velocity")
        if dynamics is not None:
            friction = dynamics.span_of("friction")
            found["friction"] = friction
            found["staticFrictionEffort"] = found["dynamicFrictionEffort"] = friction
            found["viscousFrictionCoefficient"] = dynamics.span_of("damping")
            found["armature"] = dynamics.span_of("armature")
        if joint.mimic is not None:
            found["mimicCoef0"] = joint.mimic.span_of("offset")
            found["mimicCoef1"] = joint.mimic.span_of("multiplier")
        if actuator is not None:
            found["armature"] = actuator.span_of("armature")
            found["stiffness"] = actuator.span_of("kp")
            if actuator.command == POSITION:
                found["damping"] = actuator.span_of("kd")
            elif actuator.command == VELOCITY:
                found["damping"] = actuator.span_of("kd" if actuator.kd is not None else "kp")
        return found


def _x_to(axis: Vector) -> Rotation:
    """Return a rotation that takes x to an axis."""
    quarter = rotation_about((0.0, 1.0, 0.0), -1.5707963267948966)  # x to z
    return multiply(rotation_from_z(axis), quarter)
