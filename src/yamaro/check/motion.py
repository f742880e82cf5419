"""Advice on how joints move, and what they move."""

from __future__ import annotations

from ..model.joint import CONTINUOUS, FLOATING, LIMITED, PLANAR
from .context import CheckContext, counted, shown
from .tree import is_fixed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..model.joint import Joint, Limit, Mimic
    from ..model.link import Link
    from ..model.robot import Robot
    from ..xml.tree import Element
    from .tree import Tree

    Joints = Mapping[str, Joint]

ROUNDING = 1e-6
"""How far beside 0 a bound may be that is meant to be 0, in m and rad."""


def advise_on_motion(robot: Robot, tree: Tree, context: CheckContext) -> None:
    """Report limits that say something else than they seem to, and links without mass that move."""
    zeros: list[_Found] = []
    soft: list[_Found] = []
    endless: list[_Found] = []
    home = robot.states.get("home")
    for joint in tree.joints.values():
        context.outermost = joint.element
        _find_ignored_limits(joint, endless)
        bounds = _advise_on_joint(joint, tree.joints, context)
        if bounds is None:
            continue
        lower, upper = bounds
        start = home.positions.get(joint.name) if home is not None else None
        is_placed = start is not None and lower - ROUNDING <= start <= upper + ROUNDING
        has_zero = lower - ROUNDING <= 0 <= upper + ROUNDING
        if joint.mimic is None and joint.limit is not None and not is_placed and not has_zero:
            attribute = "lower" if lower > 0 else "upper"
            zeros.append(_Found(joint, joint.limit.element, attribute, bounds))
        _find_soft_limits(joint, bounds, soft)
    context.outermost = None
    _advise_on_ignored_limits(endless, context)
    _advise_on_zeros(zeros, context)
    _advise_on_soft_limits(soft, context)
    _advise_on_massless(tree.links, tree.joints, context)


class _Found:
    """What one joint has of a fault that several may have."""

    __slots__ = ("attribute", "bounds", "element", "joint")

    def __init__(
        self, joint: Joint, element: Element, attribute: str, bounds: tuple[float, float]
    ) -> None:
        self.joint = joint
        self.element = element
        self.attribute = attribute
        self.bounds = bounds

    def place(self) -> tuple[Element, str]:
        return self.element, self.attribute


def _others(group: Sequence[_Found]) -> list[str]:
    """Return the names of the joints of a group, without the first."""
    names = dict.fromkeys(each.joint.name for each in group)
    return list(names)[1:]


def _advise_on_joint(
    joint: Joint, joints: Joints, context: CheckContext
) -> tuple[float, float] | None:
    """Report what is wrong with one joint; return its bounds if it has a range."""
    _advise_on_follower(joint, joints, context)
    limit = joint.limit
    if limit is None:
        return None
    if joint.type not in LIMITED:
        return None
    lower, upper = _bound(limit, "lower"), _bound(limit, "upper")
    if lower is None or upper is None or lower > upper:
        return None  # reported elsewhere
    written = limit.element.attributes
    if "lower" not in written and "upper" not in written:
        return None
    if lower == upper:
        context.warn(
            "no-range",
            f"'lower' and 'upper' of joint '{joint.name}' are both {shown(lower)}, so it cannot "
            "move",
            limit.element,
            attribute="upper" if "upper" in written else "lower",
            hint="set a range, or make it fixed",
        )
        return None
    return lower, upper


def _advise_on_follower(joint: Joint, joints: Joints, context: CheckContext) -> None:
    """Report a joint that mimics one that moves, but cannot follow it.

    A hand that is fixed as a whole is fine.
    """
    mimic = joint.mimic
    master = joints.get(mimic.joint) if mimic is not None else None
    if mimic is None or master is None or is_fixed(master):
        return
    if is_fixed(joint):
        context.warn(
            "fixed-mimic",
            f"joint '{joint.name}' mimics '{master.name}', but is fixed",
            mimic.element,
            attribute="joint",
            hint="use a type that moves, or remove the mimic",
        )
    elif mimic.number("multiplier") == 0:
        context.warn(
            "fixed-mimic",
            f"joint '{joint.name}' mimics '{master.name}' with the multiplier 0, so it never moves",
            mimic.element,
            attribute="multiplier",
            hint="write the ratio of the two motions, or remove the mimic",
        )
    else:
        _advise_on_reach(joint, mimic, master, context)
    for each, other in ((joint, "it"), (master, f"'{master.name}'")):
        if each.type in (FLOATING, PLANAR):
            context.warn(
                "mimic-type",
                f"joint '{joint.name}' cannot mimic '{master.name}': {other} is {each.type}",
                mimic.element,
                attribute="joint",
                hint="only joints that move along or about one axis follow each other",
            )


def _advise_on_reach(joint: Joint, mimic: Mimic, master: Joint, context: CheckContext) -> None:
    """Report a joint whose range leaves out all positions that it would follow to."""
    ranges = []
    for each in (joint, master):
        limit = each.limit if each.type in LIMITED else None
        lower, upper = (None if limit is None else _bound(limit, n) for n in ("lower", "upper"))
        if lower is None or upper is None or lower >= upper:
            return
        ranges.append((lower, upper))
    (lower, upper), ends = ranges
    factor = mimic.number("multiplier") if mimic.written("multiplier") is not None else 1.0
    offset = mimic.number("offset") if mimic.written("offset") is not None else 0.0
    if factor is None or offset is None:
        return
    least, most = sorted(factor * end + offset for end in ends)
    if min(upper, most) - max(lower, least) <= ROUNDING:
        context.warn(
            "fixed-mimic",
            f"joint '{joint.name}' would follow '{master.name}' from {shown(least)} to "
            f"{shown(most)}, but its range is {shown(lower)} to {shown(upper)}, so it never moves",
            mimic.element,
            attribute="joint",
            hint="check the signs of multiplier, offset and limits",
        )


def _bound(limit: Limit, attribute: str) -> float | None:
    """Return a bound, which is 0 where it is left out; None if it is faulty."""
    return 0.0 if limit.written(attribute) is None else limit.number(attribute)


def _find_ignored_limits(joint: Joint, found: list[_Found]) -> None:
    """Note bounds of a joint without any: parsers ignore them, simulators do not stop it."""
    limit = joint.limit
    if joint.type != CONTINUOUS or limit is None:
        return
    attribute = next((each for each in ("lower", "upper") if limit.number(each)), None)
    if attribute is not None:
        found.append(_Found(joint, limit.element, attribute, (0.0, 0.0)))


def _advise_on_ignored_limits(found: Sequence[_Found], context: CheckContext) -> None:
    """Report, once, bounds of continuous joints."""
    for group in context.apart("ignored-limit", found, _Found.place):
        first = group[0]
        context.outermost = first.joint.element
        context.warn(
            "ignored-limit",
            f"joint '{first.joint.name}' is continuous, so '{first.attribute}' is ignored",
            first.element,
            attribute=first.attribute,
            hint="make it revolute if it has limits; a continuous joint rotates without limits",
            notes=counted(_others(group), "joint", "has such a limit"),
        )
        context.outermost = None


def _advise_on_zeros(found: Sequence[_Found], context: CheckContext) -> None:
    """Report, once, ranges without 0: viewers, planners and simulators start there."""
    for group in context.apart("zero-outside-limits", found, _Found.place):
        first = group[0]
        lower, upper = first.bounds
        context.outermost = first.joint.element
        context.warn(
            "zero-outside-limits",
            f"joint '{first.joint.name}' goes from {shown(lower)} to {shown(upper)}, which "
            "excludes 0",
            first.element,
            attribute=first.attribute,
            hint="most programs start with all joints at 0; write a state `home` with a position "
            "for it, or include 0 in the range with another origin",
            notes=counted(_others(group), "joint", "has such a range"),
        )
        context.outermost = None


def _find_soft_limits(joint: Joint, bounds: tuple[float, float], found: list[_Found]) -> None:
    """Note soft limits beyond the limits: the safety controller then never acts."""
    safety = joint.safety_controller
    for attribute in ("soft_lower_limit", "soft_upper_limit"):
        soft = safety.number(attribute) if safety is not None else None
        if safety is None or soft is None or soft == 0:
            continue
        if not bounds[0] <= soft <= bounds[1]:
            found.append(_Found(joint, safety.element, attribute, bounds))


def _advise_on_soft_limits(found: Sequence[_Found], context: CheckContext) -> None:
    """Report, once, soft limits beyond the limits."""
    for group in context.apart("soft-limit-outside", found, _Found.place):
        first = group[0]
        lower, upper = first.bounds
        soft = first.joint.safety_controller
        value = soft.number(first.attribute) if soft is not None else None
        context.outermost = first.joint.element
        context.warn(
            "soft-limit-outside",
            f"'{first.attribute}' of joint '{first.joint.name}' is {shown(value or 0.0)}, outside "
            f"of its limits {shown(lower)} to {shown(upper)}",
            first.element,
            attribute=first.attribute,
            hint="soft limits must be between 'lower' and 'upper'",
            notes=counted(_others(group), "joint", "has such soft limits"),
        )
        context.outermost = None


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
    code = "massless-moving"
    for group in context.apart(code, moved, lambda each: (links[each.child].element, "name")):
        joint = group[0]
        more = len(group) - 1
        context.warn(
            code,
            f"link '{joint.child}' is moved by joint '{joint.name}', but has no mass",
            links[joint.child].element,
            attribute="name",
            hint="add a mass and a shape, or an inertial: without it, MuJoCo "
            "rejects the robot and Gazebo ignores the link",
            notes=[f"{more} more moving link{'s have' if more > 1 else ' has'} none"]
            if more
            else (),
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
