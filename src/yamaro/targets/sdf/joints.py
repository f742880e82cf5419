"""Joints of SDFormat: axis, limits, dynamics, mimic."""

from __future__ import annotations

from ...model.joint import FIXED, FLOATING, SINGLE
from ..elements import element, given
from ..holding import leader_of, lost_of_joints
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
    """

    __slots__ = ("_has_mimic", "_names", "_robot", "losses")

    def __init__(
        self, robot: Robot, names: Mapping[str, str], version: str, losses: Losses
    ) -> None:
        """Start.

        Args:
            robot: the robot.
            names: of the joints in SDFormat, by those in the robot.
            version: of SDFormat.
            losses: takes what SDFormat cannot hold.
        """
        self._robot = robot
        self._names = names
        self._has_mimic = version != "1.9"
        self.losses = losses
        losses += lost_of_joints(robot, "sdf", has_mimic=self._has_mimic, mimic_hint=MIMIC_HINT)

    def made(
        self,
        joint: Joint,
        *,
        parent: str,
        child: str,
        relative_to: str,
        more: Sequence[Element],
    ) -> Element | None:
        """Return a joint; None for a floating one, which SDFormat has not.

        Args:
            joint: the joint.
            parent: the name of the body that it is on.
            child: the name of the body that it moves.
            relative_to: the frame that the joint's origin is in.
            more: what else is in the joint.
        """
        kind = joint.type
        if kind == FLOATING:
            self.losses.approximate("floating joints", joint, how="free links")
            return None
        if kind not in (*SINGLE, FIXED):
            self.losses.approximate(f"{kind} joints", joint, how="fixed joints")
            kind = FIXED
        content = pose_of(joint.origin, relative_to) + given(("parent", parent), ("child", child))
        if kind != FIXED:
            content.append(self._axis(joint))
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
            limits = given(
                ("lower", lower),
                ("upper", upper),
                ("effort", limit.effort),
                ("velocity", limit.velocity),
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
