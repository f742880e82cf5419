"""Check of one joint's values: its type, its axis, and the order and presence of its limits."""

from __future__ import annotations

from math import hypot

from ..diagnostics import WARNING
from ..model.joint import CONTINUOUS, LIMITED, PLANAR, REVOLUTE, SINGLE
from ..model.schema import ELEMENTS, JOINT_TYPES, joint_type_hint, joint_type_meant
from ..model.values import attribute_text
from ..xml.tree import Element
from .context import JOINTS, CheckContext, shown
from .link import check_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .context import Children

UNIT_TOLERANCE = 1e-3
"""How far from 1 the length of an axis may be: three digits, as 0.707 for 1/√2, are enough."""

WITH_AXIS = (*SINGLE, PLANAR)


def check_joint(joint: Element, children: Children, owner: Element, context: CheckContext) -> None:
    """Check the pose of a joint, and the values that its type gives a meaning to."""
    context.stage = JOINTS
    check_pose(children.get("origin"), joint, context)
    kind = attribute_text(joint, "type")
    if kind is None:
        return
    if kind not in JOINT_TYPES:
        from ..fixes import respelling

        context.report(
            "unknown-joint-type",
            f"joint '{_name(joint)}' has the type '{kind}', which is not a URDF joint type",
            joint,
            attribute="type",
            hint=joint_type_hint(kind),
            fix=respelling(joint.value_span("type"), kind, joint_type_meant(kind), is_safe=True),
        )
        return
    axis = children.get("axis")
    if axis is not None and kind in WITH_AXIS:
        _check_axis(axis, joint, context)
    limit = children.get("limit")
    if limit is not None:
        if kind in LIMITED and (
            attribute_text(limit, "lower") is None and attribute_text(limit, "upper") is None
        ):
            context.report(
                "missing-limit",
                f"joint '{_name(joint)}' is {kind}, but its limit has no 'lower' and "
                "no 'upper': both default to 0, so it cannot move",
                limit,
                hint=_limit_hint(kind, "add `lower=-1, upper=1` to it"),
                severity=WARNING,
            )
        elif kind != CONTINUOUS:
            _check_order(limit, "lower", "upper", joint, context)
    elif kind in LIMITED:
        context.report(
            "missing-limit",
            f"joint '{_name(joint)}' is {kind} and has no limit, which URDF requires",
            joint,
            hint=_limit_hint(kind, "add `limit/lower=-1, upper=1, effort=10, velocity=2:`"),
        )
    safety = children.get("safety_controller")
    if safety is not None:
        _check_order(safety, "soft_lower_limit", "soft_upper_limit", joint, context)
    dynamics = children.get("dynamics")
    if dynamics is not None:
        _check_dynamics(dynamics, joint, context)


def _name(joint: Element) -> str:
    return attribute_text(joint, "name") or ""


def _check_axis(axis: Element, joint: Element, context: CheckContext) -> None:
    text = attribute_text(axis, "xyz")
    if text is None or ("axis", text) in context.sound:
        return
    xyz = context.numbers.row(axis, "xyz", 3)
    if not xyz:
        return
    length = hypot(*xyz)
    if length == 0:
        context.report(
            "zero-axis",
            f"the axis of joint '{_name(joint)}' is zero, so it has no direction",
            axis,
            attribute="xyz",
            hint="write the direction that the joint moves along or rotates about, such as 0 0 1",
        )
    elif abs(length - 1) > UNIT_TOLERANCE:
        from ..fixes import renumbering

        unit = " ".join(shown(part / length) for part in xyz)
        context.report(
            "axis-not-unit",
            f"the axis of joint '{_name(joint)}' has the length {shown(length)} instead of 1",
            axis,
            attribute="xyz",
            hint=f"write {unit}; some parsers scale the motion by the length",
            fix=renumbering(axis.value_span("xyz"), unit),
        )
    else:
        context.sound.add(("axis", text))


# --- limits -----------------------------------------------------------------------------------


def _limit_hint(kind: str, hint: str) -> str:
    if kind == REVOLUTE:
        return f"{hint}, or make the joint continuous if it rotates without limits"
    return hint


def _check_order(
    element: Element, lower_name: str, upper_name: str, joint: Element, context: CheckContext
) -> None:
    """Check that the lower bound, 0 where it is absent, is not above the upper."""
    texts = (attribute_text(element, lower_name), attribute_text(element, upper_name))
    if ("order", *texts) in context.sound:
        return
    lower, upper = (
        0.0 if text is None else context.numbers.number(element, name)
        for name, text in zip((lower_name, upper_name), texts, strict=True)
    )
    if lower is None or upper is None or lower <= upper:
        context.sound.add(("order", *texts))
        return
    absent = [n for n in (lower_name, upper_name) if attribute_text(element, n) is None]
    context.report(
        "limit-order",
        f"'{lower_name}' ({shown(lower)}) of joint '{_name(joint)}' is "
        f"greater than '{upper_name}' ({shown(upper)})",
        element,
        attribute=upper_name if lower_name in absent else lower_name,
        hint=f"also write '{absent[0]}', which defaults to 0" if absent else "swap the two",
    )


def _check_dynamics(dynamics: Element, joint: Element, context: CheckContext) -> None:
    """Check that it says something: urdfdom refuses a joint whose dynamics is bare."""
    if any(attribute_text(dynamics, name) is not None for name in ELEMENTS["dynamics"].attributes):
        return
    context.report(
        "missing-attribute",
        f"the dynamics of joint '{_name(joint)}' has neither 'damping' nor 'friction'",
        dynamics,
        hint="write `dynamics/damping=0.1, friction=0.0:` or remove it",
    )
