"""What differs between two joints."""

from __future__ import annotations

from ..joint import FIXED, FLOATING, PRISMATIC
from ..quantities import unit_of
from ..schema import ELEMENTS
from .context import Owner

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...source import Span
    from ..joint import Joint
    from ..schema import Thing
    from ..values import Written
    from .context import Comparing, Place

WITH_NUMBERS = ("limit", "dynamics", "safety_controller", "calibration")
"""The parts of a joint that are made of numbers."""


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
    kind = PRISMATIC if PRISMATIC in (one.type, other.type) else one.type
    for part in WITH_NUMBERS:
        values = (getattr(one, part), getattr(other, part))
        if values[0] is not values[1]:
            _compare_numbers(ELEMENTS[part], values, owner, comparing, kind)
    _compare_mimics(one, other, owner, comparing, unit=unit_of("position", kind))


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
    thing: Thing,
    values: tuple[Written | None, Written | None],
    owner: Owner,
    comparing: Comparing,
    joint_type: str,
) -> None:
    """Compare two limits, or other parts of joints that may be left out.

    A joint without dynamics has those of 0; one without a limit has none.
    """
    left_out = 0.0 if thing.name == "dynamics" else None
    for name, field in thing.fields.items():
        before, after = (left_out if each is None else getattr(each, name) for each in values)
        comparing.number(
            owner,
            f"{thing.name}.{name}",
            (before, after),
            unit=unit_of(field.kind, joint_type),
            places=(_value_place(values[0], name), _value_place(values[1], name)),
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
