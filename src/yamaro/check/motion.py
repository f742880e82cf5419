"""Advice on how joints move, and what they move."""

from __future__ import annotations

from ..model.joint import CONTINUOUS, LIMITED
from .context import CheckContext, shown
from .tree import is_fixed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..model.joint import Joint, Limit
    from ..model.link import Link
    from .tree import Tree

    Joints = Mapping[str, Joint]

ROUNDING = 1e-6
"""How far beside 0 a bound may be that is meant to be 0, in m and rad."""


def advise_on_motion(tree: Tree, context: CheckContext) -> None:
    """Report limits that say something else than they seem to, and links without mass that move."""
    for joint in tree.joints.values():
        context.outermost = joint.element
        _advise_on_joint(joint, tree.joints, context)
    context.outermost = None
    _advise_on_massless(tree.links, tree.joints, context)


def _advise_on_joint(joint: Joint, joints: Joints, context: CheckContext) -> None:
    _advise_on_fixed_follower(joint, joints, context)
    limit = joint.limit
    if limit is None:
        return
    if joint.type == CONTINUOUS:
        _advise_on_continuous(joint.name, limit, context)
    if joint.type not in LIMITED:
        return
    lower, upper = _bound(limit, "lower"), _bound(limit, "upper")
    if lower is None or upper is None or lower > upper:
        return  # reported elsewhere
    written = limit.element.attributes
    if "lower" not in written and "upper" not in written:
        return
    if lower == upper:
        context.warn(
            "no-range",
            f"'lower' and 'upper' of joint '{joint.name}' are both {shown(lower)}, so it cannot "
            "move",
            limit.element,
            attribute="upper" if "upper" in written else "lower",
            hint="set a range, or make it fixed",
        )
        return
    if joint.mimic is None and not lower - ROUNDING <= 0 <= upper + ROUNDING:
        _advise_on_zero(joint.name, limit, lower, upper, context)
    _advise_on_soft_limits(joint, lower, upper, context)


def _advise_on_fixed_follower(joint: Joint, joints: Joints, context: CheckContext) -> None:
    """Report a fixed joint that mimics one that moves; a hand that is fixed as a whole is fine."""
    mimic = joint.mimic if is_fixed(joint) else None
    master = joints.get(mimic.joint) if mimic is not None else None
    if mimic is not None and master is not None and not is_fixed(master):
        context.warn(
            "fixed-mimic",
            f"joint '{joint.name}' mimics '{master.name}', but is fixed",
            mimic.element,
            attribute="joint",
            hint="use a type that moves, or remove the mimic",
        )


def _bound(limit: Limit, attribute: str) -> float | None:
    """Return a bound, which is 0 where it is left out; None if it is faulty."""
    return 0.0 if limit.written(attribute) is None else limit.number(attribute)


def _advise_on_continuous(name: str, limit: Limit, context: CheckContext) -> None:
    """Report bounds of a joint without any: parsers ignore them, simulators do not stop it."""
    given = [each for each in ("lower", "upper") if limit.number(each)]
    if given:
        context.warn(
            "ignored-limit",
            f"joint '{name}' is continuous, so '{given[0]}' is ignored",
            limit.element,
            attribute=given[0],
            hint="make it revolute if it has limits; a continuous joint rotates without limits",
        )


def _advise_on_zero(
    name: str, limit: Limit, lower: float, upper: float, context: CheckContext
) -> None:
    """Report a range without 0: viewers, planners and simulators start there."""
    context.warn(
        "zero-outside-limits",
        f"joint '{name}' goes from {shown(lower)} to {shown(upper)}, which excludes 0",
        limit.element,
        attribute="lower" if lower > 0 else "upper",
        hint="most programs start with all joints at 0; set another start "
        "position, or include 0 in the range with another origin",
    )


def _advise_on_soft_limits(joint: Joint, lower: float, upper: float, context: CheckContext) -> None:
    """Report soft limits beyond the limits: the safety controller then never acts."""
    safety = joint.safety_controller
    if safety is None:
        return
    for attribute in ("soft_lower_limit", "soft_upper_limit"):
        soft = safety.number(attribute)
        if soft is not None and soft != 0 and not lower <= soft <= upper:
            context.warn(
                "soft-limit-outside",
                f"'{attribute}' of joint '{joint.name}' is {shown(soft)}, outside of its limits "
                f"{shown(lower)} to {shown(upper)}",
                safety.element,
                attribute=attribute,
                hint="soft limits must be between 'lower' and 'upper'",
            )


# --- links that move and weigh nothing --------------------------------------------------------


def _advise_on_massless(links: Mapping[str, Link], joints: Joints, context: CheckContext) -> None:
    """Report, once, links that a joint moves and that have no mass, with what is fixed to them.

    MuJoCo refuses such a robot, and Gazebo drops the link with all below it.
    """
    heavy = _heavy_bodies(links, joints)
    moved = [
        joint
        for joint in joints.values()
        if not is_fixed(joint) and joint.child in links and joint.child not in heavy
    ]
    if not moved:
        return
    joint = moved[0]
    more = len(moved) - 1
    context.warn(
        "massless-moving",
        f"link '{joint.child}' is moved by joint '{joint.name}', but has no mass",
        links[joint.child].element,
        attribute="name",
        hint="add a mass and a shape, or an inertial: without it, MuJoCo "
        "rejects the robot and Gazebo ignores the link",
        notes=[f"{more} more moving link{'s have' if more > 1 else ' has'} none"] if more else (),
    )


def _heavy_bodies(links: Mapping[str, Link], joints: Joints) -> set[str]:
    """Return the links of which they, or what is rigidly fixed below them, have an inertial."""
    fixed_to = {joint.child: joint.parent for joint in joints.values() if is_fixed(joint)}
    heavy: set[str] = set()
    for name, link in links.items():
        above: str | None = name if link.inertial is not None else None
        while above is not None and above not in heavy:
            heavy.add(above)
            above = fixed_to.get(above)
    return heavy
