"""Joints of SDFormat: axis, limits, dynamics, mimic."""

from __future__ import annotations

from ...model.joint import FIXED, FLOATING, SINGLE
from ..output import APPROXIMATED, Loss
from ..shared_losses import leader_of, lost_of_joints
from ..tags import Tag, given, row_of
from .links import pose_tag

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.joint import Joint
    from ...model.robot import Robot
    from ...xml.tree import Element


MIMIC_HINT = "--sdf-version 1.11 has them"


class JointWriter:
    """Makes the joints of a model.

    Attributes:
        losses: what SDFormat cannot hold of them.
    """

    __slots__ = ("_has_mimic", "_names", "_robot", "losses")

    def __init__(
        self, robot: Robot, names: Mapping[str, str], version: str, losses: list[Loss]
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

    def tag(
        self,
        joint: Joint,
        *,
        parent: str,
        child: str,
        relative_to: str,
        more: Sequence[Tag | Element],
    ) -> Tag | None:
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
            self._approximate(joint, "floating joints", "free links")
            return None
        if kind not in (*SINGLE, FIXED):
            self._approximate(joint, f"{kind} joints", "fixed joints")
            kind = FIXED
        content = [
            *pose_tag(joint.origin, relative_to),
            Tag("parent", parent),
            Tag("child", child),
        ]
        if kind != FIXED:
            content.append(self._axis(joint))
        return Tag(
            "joint",
            [*content, *more],
            span=joint.span,
            trace=joint.trace,
            name=self._names[joint.name],
            type=kind,
        )

    def _axis(self, joint: Joint) -> Tag:
        axis = [Tag("xyz", row_of(joint.axis)), Tag("limit", self._limit(joint))]
        dynamics = joint.dynamics
        if dynamics is not None:
            values = given(("damping", dynamics.damping), ("friction", dynamics.friction))
            axis.append(Tag("dynamics", values, span=dynamics.span, trace=joint.trace))
        return Tag("axis", [*axis, *self._mimic(joint)])

    def _mimic(self, joint: Joint) -> list[Tag]:
        mimic, leader = joint.mimic, leader_of(self._robot, joint)
        if mimic is None or leader is None or not self._has_mimic:
            return []
        values = [Tag("multiplier", mimic.multiplier), Tag("offset", mimic.offset)]
        return [Tag("mimic", [*values, Tag("reference", 0)], joint=self._names[leader.name])]

    def _limit(self, joint: Joint) -> list[Tag]:
        limit = joint.limit
        if limit is None:
            return []
        lower, upper = joint.lower, joint.upper
        if lower is not None and upper is not None and lower > upper:
            lower, upper = upper, lower
            self._approximate(joint, "limits in the wrong order", "swapping them")
        return given(
            ("lower", lower),
            ("upper", upper),
            ("effort", limit.effort),
            ("velocity", limit.velocity),
        )

    def _approximate(self, joint: Joint, name: str, how: str) -> None:
        self.losses.append(
            Loss(
                APPROXIMATED,
                name,
                f"joint '{joint.name}'",
                joint.span,
                trace=joint.trace,
                how=how,
            )
        )
