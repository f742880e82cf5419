"""Joints of UsdPhysics: axes, limits, drives.

The axis of a joint is X, Y or Z in USD: here always X, to which both of its frames are turned.
"""

from __future__ import annotations

from math import degrees, inf
from typing import TYPE_CHECKING

from pxr import Gf, Sdf, Usd, UsdPhysics

from ...model.joint import CONTINUOUS, FIXED, FLOATING, PLANAR, PRISMATIC, SINGLE
from ...model.kinematics import WORLD
from ...model.pose import Pose, multiply, rotation_about, rotation_from_z
from ..gains import POSITION, VELOCITY, Gains
from ..holding import lost_of_actuator, lost_of_joints, lost_values
from .prims import element_of, quaternion_of

if TYPE_CHECKING:
    from ...model.joint import Joint
    from ...model.pose import Rotation, Vector
    from ...model.robot import Robot
    from ...source import Span
    from ...xml.tree import Element
    from ..bodies import Bodies
    from .prims import Names

KINDS = {PRISMATIC: UsdPhysics.PrismaticJoint, FIXED: UsdPhysics.FixedJoint}
LOOPS = {
    "fixed": UsdPhysics.FixedJoint,
    "ball": UsdPhysics.SphericalJoint,
    "revolute": UsdPhysics.RevoluteJoint,
}


class JointWriter:
    """Makes the joints of one robot.

    Attributes:
        elements: for each joint, an element at its place.
        losses: what USD cannot hold.
    """

    def __init__(
        self,
        stage: Usd.Stage,
        robot: Robot,
        bodies: Bodies,
        paths: dict[str, str],
        names: Names,
        root: str,
        *,
        is_fixed: bool,
    ) -> None:
        """Start.

        Args:
            stage: takes the joints.
            robot: the robot.
            bodies: which links are bodies.
            paths: the prims of links and frames.
            names: names prims.
            root: the path of the robot.
            is_fixed: whether its root is fixed in the world.
        """
        self._stage = stage
        self._robot = robot
        self._bodies = bodies
        self._paths = paths
        self._names = names
        self._is_fixed = is_fixed
        self._chosen = Gains(robot, is_fixed=is_fixed, has_armature=False)
        self._folder = names.new(root, "joints")
        self.elements: list[Element] = []
        self.losses = lost_of_joints(robot, "usd")

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
                self.elements.append(element_of(prim.GetPrim(), root))
        for joint in robot.joints.values():
            if robot.parent_joint(joint.child) is joint and joint.child in bodies.carriers:
                actuator = robot.actuators.get(joint.name)
                if actuator is not None:
                    self.losses += lost_of_actuator(actuator)
                    is_reflected = actuator.rotor_inertia is not None
                    held = () if is_reflected else ("gear",)
                    self.losses += lost_values(actuator, "usd", but=held)
                if joint.type == FLOATING:
                    how = "links that no joint holds"
                    self.losses.approximate("floating joints", joint, how=how)
                elif not bodies.is_dissolved(joint):
                    self._add(joint)
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
            self.elements.append(element_of(prim.GetPrim(), loop))

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
            self._drive(prim, joint)
        elif joint.type == PLANAR:
            for freedom in ("transX", "rotY", "rotZ"):
                limit = UsdPhysics.LimitAPI.Apply(prim.GetPrim(), freedom)
                limit.CreateLowAttr(1.0)  # no position is above and below at once: it is locked
                limit.CreateHighAttr(-1.0)
        self.elements.append(element_of(prim.GetPrim(), joint, places=self._places_in(joint)))

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

    # --- limits and drives ---

    def _drive(self, prim: UsdPhysics.RevoluteJoint, joint: Joint) -> None:
        """Write what drives and what damps a joint: gains of angular drives are per degree."""
        actuator = self._robot.actuators.get(joint.name)
        damping = joint.dynamics.damping if joint.dynamics is not None else 0.0
        effort = joint.limit.effort if joint.limit is not None else None
        if actuator is None and not damping and effort is None:
            return
        is_linear = joint.type == PRISMATIC
        unit = 1.0 if is_linear else degrees(1)
        kp = kd = 0.0  # in SI; those that are not given are as in MJCF
        if actuator is not None and actuator.command == POSITION:
            kp = actuator.kp if actuator.kp is not None else self._chosen.of_position(joint)
            kd = actuator.kd if actuator.kd is not None else self._chosen.damping(joint, kp)
        elif actuator is not None and actuator.command == VELOCITY:
            kd = self._chosen.of_velocity(joint, actuator)
        if actuator is not None and actuator.command not in (POSITION, VELOCITY):
            what, how = "effort actuators", "drives without gains"
            self.losses.approximate(what, joint, part=actuator, how=how)
        if joint.dynamics is not None and damping:
            what, how = "damping values of joints", "the damping of their drives"
            part = joint.dynamics
            self.losses.approximate(what, joint, part=part, field="damping", how=how)
        drive = UsdPhysics.DriveAPI.Apply(prim.GetPrim(), "linear" if is_linear else "angular")
        drive.CreateTypeAttr("force")
        if effort is not None:
            drive.CreateMaxForceAttr(effort)
        drive.CreateStiffnessAttr(kp / unit)
        drive.CreateDampingAttr((kd + damping) / unit)

    def _places_in(self, joint: Joint) -> dict[str, Span]:
        """Return where the values of a joint are written, by their names in USD."""
        limit, dynamics = joint.limit, joint.dynamics
        actuator = self._robot.actuators.get(joint.name)
        found = {}
        if limit is not None:
            found["lowerLimit"] = limit.span_of("lower")
            found["upperLimit"] = limit.span_of("upper")
            found["maxForce"] = limit.span_of("effort")
        if dynamics is not None:
            found["damping"] = dynamics.span_of("damping")
        if actuator is not None:
            found["stiffness"] = actuator.span_of("kp")
            if actuator.command == POSITION:
                found["damping"] = actuator.span_of("kd")
            elif actuator.command == VELOCITY:
                found["damping"] = actuator.span_of("kd" if actuator.kp is None else "kp")
        return found

    # --- loops ---


def _x_to(axis: Vector) -> Rotation:
    """Return a rotation that takes x to an axis."""
    quarter = rotation_about((0.0, 1.0, 0.0), -1.5707963267948966)  # x to z
    return multiply(rotation_from_z(axis), quarter)
