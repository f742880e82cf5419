"""Joints of SDFormat: axis, limits, dynamics, mimic; and what drives them, for Drake.

SDFormat has no actuators. Drake has elements of its own for them, in a namespace that others pass
over: the inertia of the rotor, which it multiplies by the square of the gear ratio, and the gains
of a servo, which it integrates implicitly and bounds by the effort of the joint. Its target is a
position and a velocity; with a gain of velocity alone it is a velocity servo. It also has an
element of its own for joints that follow others, and does not read SDFormat's. Source:
https://drake.mit.edu/doxygen_cxx/group__multibody__parsing.html.
"""

from __future__ import annotations

from ...model.joint import FIXED, FLOATING, SINGLE, UNLIMITED
from ...model.kinematics import WORLD
from ..elements import element, given
from ..gains import POSITION, VELOCITY, Gains
from ..holding import leader_of, lost_lines, lost_of_actuator, lost_of_joints, lost_values
from .links import pose_of, row_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.joint import Joint
    from ...model.robot import Robot
    from ...xml.tree import Element
    from ..elements import Attributes
    from ..losses import Losses

MIMIC_HINT = "--sdf-version 1.11 has them"


class JointWriter:
    """Makes the joints of a model.

    Attributes:
        losses: what SDFormat cannot hold of them.
        gains: those that are chosen where none are given.
        efforts: the greatest effort of each joint that was made and is driven, in N·m or N.
        has_drake: whether a joint that was made has elements of Drake.
    """

    __slots__ = ("_has_mimic", "_names", "_robot", "efforts", "gains", "has_drake", "losses")

    def __init__(
        self,
        robot: Robot,
        names: Mapping[str, str],
        version: str,
        losses: Losses,
        *,
        is_fixed: bool,
    ) -> None:
        """Start.

        Args:
            robot: the robot.
            names: of the joints in SDFormat, by those in the robot.
            version: of SDFormat.
            losses: takes what SDFormat cannot hold.
            is_fixed: whether its root is fixed in the world.
        """
        self._robot = robot
        self.gains = Gains(robot, is_fixed=is_fixed)
        self.efforts: dict[str, float | None] = {}
        self.has_drake = False
        self._names = names
        self._has_mimic = version != "1.9"
        self.losses = losses
        losses += lost_of_joints(robot, "sdf", has_mimic=self._has_mimic, mimic_hint=MIMIC_HINT)

    def made(
        self,
        joint: Joint,
        *,
        type: str | None,
        parent: str,
        child: str,
        relative_to: str,
        more: Sequence[Element],
    ) -> Element | None:
        """Return a joint; None for a floating one, which SDFormat has not.

        Args:
            joint: the joint.
            type: that in SDFormat, if the robot says one for it.
            parent: the name of the body that it is on.
            child: the name of the body that it moves.
            relative_to: the frame that the joint's origin is in.
            more: what else is in the joint.
        """
        kind = type or joint.type
        if kind == FLOATING:
            if joint.parent == WORLD:
                return None
            self.losses.approximate("floating joints", joint, how="free links")
            return None
        if type is None and kind not in (*SINGLE, FIXED):
            self.losses.approximate(f"{kind} joints", joint, how="fixed joints")
            kind = FIXED
        content = pose_of(joint.origin, relative_to) + given(("parent", parent), ("child", child))
        if kind in SINGLE:
            content += [self._axis(joint), *self._drive(joint), *self._follow(joint)]
        attributes: Attributes = {"name": self._names[joint.name], "type": kind}
        return element("joint", attributes, children=[*content, *more], owner=joint)

    def _axis(self, joint: Joint) -> Element:
        limit, dynamics, mimic = joint.limit, joint.dynamics, joint.mimic
        limits: list[Element] = []
        if limit is not None:
            lower, upper = joint.lower, joint.upper
            if lower is not None and upper is not None and lower > upper:
                lower, upper = upper, lower
                what, how = "limits in the wrong order", "swapping them"
                self.losses.approximate(what, joint, how=how)
            fastest = limit.acceleration
            self.has_drake = self.has_drake or fastest is not None
            bounds = {
                "lower": lower, "upper": upper, "effort": self._effort_of(joint),
                "velocity": limit.velocity, "drake:acceleration": fastest,
            }  # fmt: skip
            limits = given(
                *(pair for pair in bounds.items() if pair[1] is None or abs(pair[1]) < UNLIMITED)
            )
        axis = [element("xyz", text=row_of(joint.axis)), element("limit", children=limits)]
        if dynamics is not None:
            values = given(("damping", dynamics.damping), ("friction", dynamics.friction))
            axis.append(element("dynamics", children=values, owner=joint, part=dynamics))
        leader = leader_of(self._robot, joint)
        if mimic is not None and leader is not None and self._has_mimic:
            values = given(
                ("multiplier", mimic.multiplier), ("offset", mimic.offset), ("reference", 0)
            )
            axis.append(element("mimic", {"joint": self._names[leader.name]}, children=values))
        return element("axis", children=axis)

    def _effort_of(self, joint: Joint) -> float | None:
        """Return the greatest effort: that of the limit, or that of the motor if it is less."""
        effort = joint.limit.effort if joint.limit is not None else None
        actuator = self._robot.actuators.get(joint.name)
        stall = actuator.stall_torque if actuator is not None else None
        return stall if stall is not None and (effort is None or effort > stall) else effort

    def _drive(self, joint: Joint) -> list[Element]:
        """Return what drives a joint in Drake."""
        actuator = self._robot.actuators.get(joint.name)
        if actuator is None or joint.mimic is not None:
            return []
        self.losses += lost_of_actuator(actuator)
        self.losses += lost_values(actuator, "sdf")
        self.losses += lost_lines(actuator)
        command = actuator.command
        self.efforts[joint.name] = self._effort_of(joint)
        made: list[Element] = []
        if actuator.armature:
            inertia, gear = actuator.armature, 1.0
            if actuator.rotor_inertia is not None:
                inertia, gear = actuator.rotor_inertia, actuator.gear
            made += given(("drake:rotor_inertia", inertia), ("drake:gear_ratio", gear))
        kp = kd = 0.0  # those that are not given are as in MJCF
        if command == POSITION:
            kp = actuator.kp if actuator.kp is not None else self.gains.of_position(joint)
            kd = actuator.kd if actuator.kd is not None else self.gains.damping(joint, kp)
        elif command == VELOCITY:
            kd = self.gains.of_velocity(joint, actuator)
        if kp or kd:
            made.append(element("drake:controller_gains", {"p": kp, "d": kd}))
        self.has_drake = self.has_drake or bool(made)
        return made

    def _follow(self, joint: Joint) -> list[Element]:
        """Return what makes a joint follow another in Drake, which reads no `<mimic>`."""
        mimic, leader = joint.mimic, leader_of(self._robot, joint)
        if mimic is None or leader is None:
            return []
        self.has_drake = True
        attributes: Attributes = {
            "joint": self._names[leader.name],
            "multiplier": mimic.multiplier,
            "offset": mimic.offset,
        }
        return [element("drake:mimic", attributes, owner=joint, part=mimic)]
