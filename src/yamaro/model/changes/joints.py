"""What differs between two joints."""

from __future__ import annotations

from ..joint import FIXED, FLOATING, PRISMATIC
from .context import Owner

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Span
    from ..joint import Joint
    from ..values import Written
    from .context import Comparing, Place

LIMIT = ("lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk")
DYNAMICS = {"damping": 0.0, "friction": 0.0}
SAFETY = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
CALIBRATION = ("rising", "falling")
_ANGULAR = {
    "lower": "rad", "upper": "rad", "effort": "N·m", "velocity": "rad/s",
    "acceleration": "rad/s²", "deceleration": "rad/s²", "jerk": "rad/s³",
    "damping": "N·m·s/rad", "friction": "N·m", "offset": "rad",
    "soft_lower_limit": "rad", "soft_upper_limit": "rad", "rising": "rad", "falling": "rad",
}  # fmt: skip
_LINEAR = {
    "lower": "m", "upper": "m", "effort": "N", "velocity": "m/s",
    "acceleration": "m/s²", "deceleration": "m/s²", "jerk": "m/s³",
    "damping": "N·s/m", "friction": "N", "offset": "m",
    "soft_lower_limit": "m", "soft_upper_limit": "m", "rising": "m", "falling": "m",
}  # fmt: skip


def compare_joints(one: Joint, other: Joint, comparing: Comparing) -> None:
    """Note in what two joints differ; their names are another matter."""
    owner = Owner("joint", one.name, new_name=other.name, places=(one.span, other.span))
    comparing.text(owner, "type", (one.type, other.type))
    comparing.named(owner, "parent", (one.parent, other.parent), comparing.link)
    comparing.named(owner, "child", (one.child, other.child), comparing.link)
    if one.origin is not other.origin:
        comparing.pose(owner, "origin", one.origin, other.origin, owner.places)
    if one.type not in (FIXED, FLOATING) and other.type not in (FIXED, FLOATING):
        _compare_axes(one, other, owner, comparing)
    units = _LINEAR if PRISMATIC in (one.type, other.type) else _ANGULAR
    for part, names in (
        ("limit", LIMIT),
        ("dynamics", DYNAMICS),
        ("safety_controller", SAFETY),
        ("calibration", CALIBRATION),
    ):
        values = (getattr(one, part), getattr(other, part))
        _compare_numbers(values, names, owner, comparing, part=part, units=units)
    _compare_mimics(one, other, owner, comparing, unit=units["offset"])


def _compare_axes(one: Joint, other: Joint, owner: Owner, comparing: Comparing) -> None:
    if comparing.tolerance.same_row(one.axis, other.axis):
        return
    opposite = tuple(-component for component in other.axis)
    is_opposite = comparing.tolerance.same_row(one.axis, opposite)
    comparing.row(
        owner,
        "axis",
        (one.axis, other.axis),
        remark="the opposite direction" if is_opposite else "",
        places=_places(one.inner("axis"), other.inner("axis")),
    )


def _places(one: object, other: object) -> Place:
    """Return where two elements are written."""
    return (getattr(one, "span", None), getattr(other, "span", None))


def _compare_numbers(
    values: tuple[Written | None, Written | None],
    names: tuple[str, ...] | dict[str, float],
    owner: Owner,
    comparing: Comparing,
    *,
    part: str,
    units: dict[str, str],
) -> None:
    """Compare the numbers of two limits, or of other groups that may be left out."""
    one, other = values
    if one is other:
        return
    for name in names:
        default = names[name] if isinstance(names, dict) else None
        before, after = (default if each is None else getattr(each, name) for each in values)
        places = (_value_place(one, name), _value_place(other, name))
        comparing.number(
            owner, f"{part}.{name}", (before, after), unit=units.get(name, ""), places=places
        )


def _value_place(part: Written | None, name: str) -> Span | None:
    return None if part is None else part.span_of(name)


def _compare_mimics(
    one: Joint, other: Joint, owner: Owner, comparing: Comparing, *, unit: str
) -> None:
    first, second = one.mimic, other.mimic
    if first is second:
        return
    places = _places(first, second)
    if first is None or second is None:
        values = (first and first.joint, second and second.joint)
        factors = [
            f"{each.multiplier:g} times its position"
            + (f", plus {each.offset:g} {unit}" if each.offset else "")
            for each in (first, second)
            if each is not None and (each.multiplier != 1 or each.offset)
        ]
        remark = factors[0] if factors else ""
        comparing.change(owner, "mimic.joint", *values, remark=remark, places=places)
        return
    comparing.named(
        owner, "mimic.joint", (first.joint, second.joint), comparing.joint, places=places
    )
    comparing.number(
        owner, "mimic.multiplier", (first.multiplier, second.multiplier), places=places
    )
    comparing.number(owner, "mimic.offset", (first.offset, second.offset), unit=unit, places=places)


def joint_facts(joint: Joint) -> dict[str, object]:
    """Return what to say of a joint that only one robot has."""
    return {"type": joint.type, "parent": joint.parent, "child": joint.child}
