"""Advice on how joints move, and what they move."""

from __future__ import annotations

from ..model.values import attribute_text, child_named
from ..xml.tree import Element
from .context import CheckContext, shown
from .tree import is_fixed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .tree import Tree

ROUNDING = 1e-6
"""How far beside 0 a bound may be that is meant to be 0, in m and rad."""
LIMITED = ("revolute", "prismatic")


def advise_on_motion(tree: Tree, context: CheckContext) -> None:
    """Report limits that say something else than they seem to, and links without mass that move."""
    for name, joint in tree.joints.items():
        context.outermost = joint
        _advise_on_joint(name, joint, tree, context)
    context.outermost = None
    _advise_on_massless(tree, context)


def _advise_on_joint(name: str, joint: Element, tree: Tree, context: CheckContext) -> None:
    _advise_on_fixed_follower(name, joint, tree, context)
    limit = child_named(joint, "limit")
    kind = attribute_text(joint, "type")
    if limit is None:
        return
    if kind == "continuous":
        _advise_on_continuous(name, limit, context)
    if kind not in LIMITED:
        return
    lower, upper = (_bound(limit, attribute, context) for attribute in ("lower", "upper"))
    if lower is None or upper is None or lower > upper:
        return  # told of elsewhere
    if "lower" not in limit.attributes and "upper" not in limit.attributes:
        return
    if lower == upper:
        context.warn(
            "no-range",
            f"'lower' and 'upper' of joint '{name}' are both {shown(lower)}, so it cannot move",
            limit,
            attribute="upper" if "upper" in limit.attributes else "lower",
            hint="set a range, or make it fixed",
        )
        return
    if child_named(joint, "mimic") is None and not lower - ROUNDING <= 0 <= upper + ROUNDING:
        _advise_on_zero(name, limit, lower, upper, context)
    _advise_on_soft_limits(name, joint, lower, upper, context)


def _advise_on_fixed_follower(name: str, joint: Element, tree: Tree, context: CheckContext) -> None:
    """Report a fixed joint that mimics one that moves; a hand that is fixed as a whole is fine."""
    mimic = child_named(joint, "mimic") if is_fixed(joint) else None
    master = attribute_text(mimic, "joint")
    if mimic is not None and master in tree.joints and not is_fixed(tree.joints[master]):
        context.warn(
            "fixed-mimic",
            f"joint '{name}' mimics '{master}', but is fixed",
            mimic,
            attribute="joint",
            hint="use a type that moves, or remove the mimic",
        )


def _bound(element: Element, attribute: str, context: CheckContext) -> float | None:
    """Return a bound, which is 0 where it is left out; None if it is faulty."""
    if attribute_text(element, attribute) is None:
        return 0.0
    return context.number(element, attribute)


def _advise_on_continuous(name: str, limit: Element, context: CheckContext) -> None:
    """Report bounds of a joint without any: parsers ignore them, simulators do not stop it."""
    given = [each for each in ("lower", "upper") if context.number(limit, each)]
    if given:
        context.warn(
            "ignored-limit",
            f"joint '{name}' is continuous, so '{given[0]}' is ignored",
            limit,
            attribute=given[0],
            hint="make it revolute if it has limits; a continuous joint rotates without limits",
        )


def _advise_on_zero(
    name: str, limit: Element, lower: float, upper: float, context: CheckContext
) -> None:
    """Report a range without 0: viewers, planners and simulators start there."""
    context.warn(
        "zero-outside-limits",
        f"joint '{name}' goes from {shown(lower)} to {shown(upper)}, which excludes 0",
        limit,
        attribute="lower" if lower > 0 else "upper",
        hint="most programs start with all joints at 0; set another start "
        "position, or include 0 in the range with another origin",
    )


def _advise_on_soft_limits(
    name: str, joint: Element, lower: float, upper: float, context: CheckContext
) -> None:
    """Report soft limits beyond the limits: the safety controller then never acts."""
    safety = child_named(joint, "safety_controller")
    if safety is None:
        return
    for attribute in ("soft_lower_limit", "soft_upper_limit"):
        soft = context.number(safety, attribute)
        if soft is not None and soft != 0 and not lower <= soft <= upper:
            context.warn(
                "soft-limit-outside",
                f"'{attribute}' of joint '{name}' is {shown(soft)}, outside of its limits "
                f"{shown(lower)} to {shown(upper)}",
                safety,
                attribute=attribute,
                hint="soft limits must be between 'lower' and 'upper'",
            )


# --- links that move and weigh nothing --------------------------------------------------------


def _advise_on_massless(tree: Tree, context: CheckContext) -> None:
    """Report, once, links that a joint moves and that have no mass, with what is fixed to them.

    MuJoCo refuses such a robot, and Gazebo drops the link with all that hangs on it.
    """
    heavy = _heavy_bodies(tree)
    moved = [
        (name, child)
        for name, joint in tree.joints.items()
        if not is_fixed(joint) and (child := child_of(joint)) in tree.links and child not in heavy
    ]
    if not moved:
        return
    name, child = moved[0]
    more = len(moved) - 1
    context.warn(
        "massless-moving",
        f"link '{child}' is moved by joint '{name}', but has no mass",
        tree.links[child],
        attribute="name",
        hint="add a mass and a shape, or an inertial: without it, MuJoCo "
        "rejects the robot and Gazebo ignores the link",
        notes=[f"{more} more moving link{'s have' if more > 1 else ' has'} none"] if more else (),
    )


def child_of(joint: Element) -> str:
    """Return the name of a joint's child, or ""."""
    return attribute_text(child_named(joint, "child"), "link") or ""


def _heavy_bodies(tree: Tree) -> set[str]:
    """Return the links of which they, or what is rigidly fixed below them, have an inertial."""
    fixed_to = {
        child_of(joint): attribute_text(child_named(joint, "parent"), "link") or ""
        for joint in tree.joints.values()
        if is_fixed(joint)
    }
    heavy: set[str] = set()
    for name, link in tree.links.items():
        above: str | None = name if child_named(link, "inertial") is not None else None
        while above is not None and above not in heavy:
            heavy.add(above)
            above = fixed_to.get(above)
    return heavy
