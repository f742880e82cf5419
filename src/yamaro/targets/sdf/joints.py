"""Joints of SDFormat: axis, limits, dynamics, mimic."""

from __future__ import annotations

from ...model.joint import FIXED, FLOATING, SINGLE
from ..output import APPROXIMATED, LOST, Loss
from ..tags import Tag, given, row_of
from .links import pose_tag

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...model.joint import Joint
    from ...model.values import Written
    from ...xml.tree import Element


class JointWriter:
    """Makes the joints of a model.

    Attributes:
        losses: what SDFormat cannot hold of them.
    """

    __slots__ = ("_joints", "_names", "_version", "losses")

    def __init__(
        self,
        joints: Mapping[str, Joint],
        names: Mapping[str, str],
        version: str,
        losses: list[Loss],
    ) -> None:
        """Start.

        Args:
            joints: of the robot.
            names: of the joints in SDFormat, by those in the robot.
            version: of SDFormat.
            losses: takes what SDFormat cannot hold.
        """
        self._joints = joints
        self._names = names
        self._version = version
        self.losses = losses

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
        self.lose_limits(joint)
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
        mimic = joint.mimic
        if mimic is None:
            return []
        leader = self._joints.get(mimic.joint)
        if leader is None or leader.type not in SINGLE:
            self._lose(joint, mimic, "mimic joints that follow one that does not turn or slide")
            return []
        if self._version == "1.9":
            self._lose(joint, mimic, "mimic joints", hint="--sdf-version 1.11 has them")
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

    def lose_limits(self, joint: Joint) -> None:
        """Note what SDFormat has no elements for."""
        if joint.safety_controller is not None:
            self._lose(joint, joint.safety_controller, "soft limits")
        if joint.calibration is not None:
            self._lose(joint, joint.calibration, "calibrations")
        limit = joint.limit
        if limit is not None and any(
            each is not None for each in (limit.acceleration, limit.deceleration, limit.jerk)
        ):
            self._lose(joint, limit, "limits of acceleration and jerk")
        if limit is not None and joint.type not in SINGLE:
            self._lose(joint, limit, f"limits of {joint.type} joints")
        if joint.type not in SINGLE and joint.mimic is not None:
            self._lose(joint, joint.mimic, f"{joint.type} mimic joints")
        if joint.type not in SINGLE and joint.dynamics is not None:
            self._lose(joint, joint.dynamics, f"dynamics of {joint.type} joints")

    def _lose(self, joint: Joint, what: Written, name: str, *, hint: str = "") -> None:
        owner, trace = f"joint '{joint.name}'", what.trace_in(joint)
        self.losses.append(Loss(LOST, name, owner, what.span, trace=trace, hint=hint))

    def _approximate(self, joint: Joint, name: str, how: str) -> None:
        self.losses.append(
            Loss(APPROXIMATED, name, f"'{joint.name}'", joint.span, trace=joint.trace, how=how)
        )
