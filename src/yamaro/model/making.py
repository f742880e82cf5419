"""URDF made of values: the elements of links, joints, shapes, …, each at its place.

Readers of formats other than URDF make a `<robot>` of what they have read. Each function takes
values in SI and the `Place` where they are written, and returns an element, by the rows of the
schema, so that all that works on a robot, such as checks, messages and the writers, works on this
one.

    place = Place(span)
    weight = element("mass", place, {"value": 2.0})
    limit = element("limit", Place(span, {"upper": its_span}), {"upper": 1.5, "effort": 10})
    elbow = joint(place, "elbow", "revolute", "base", "arm", [limit])
"""

from __future__ import annotations

from math import isfinite

from ..xml.tree import Element, RobotNote
from ..xml.values import Numbers
from .pose import ZERO
from .schema import ELEMENTS, TEXT

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Node
    from .pose import Vector

    Value = float | tuple[float, ...] | Numbers | str | None
    """`Numbers` keep how they were spelled; others are written with 15 digits."""


class Place:
    """Where something is written.

    Attributes:
        span: the whole.
        values: the places of values, by their names in the schema.
        trace: the calls and includes that led there.
    """

    __slots__ = ("span", "trace", "values")

    def __init__(
        self, span: Span, values: Mapping[str, Span] | None = None, trace: Step | None = None
    ) -> None:
        self.span = span
        self.values = values if values is not None else {}
        self.trace = trace


def element(
    name: str, place: Place, values: Mapping[str, Value], children: Iterable[Node] = ()
) -> Element:
    """Return an element of URDF, with its values in the order of the schema; None is not written.

    Raises:
        TypeError: it has no value of that name, or not as many numbers, or not a text.
        ValueError: a number is not finite.
    """
    ordered: dict[str, object] = {}
    for given, field in ELEMENTS[name].fields.items():
        value = values.get(given)
        if value is not None:
            made = value if type(value) is str else _numbers(value)
            if field.count != (len(made.words) if isinstance(made, Numbers) else TEXT):
                raise TypeError(f"'{given}' of a '{name}' cannot be {value!r}")
            ordered[given] = made
            if len(ordered) == len(values):
                break
    else:
        for given, value in values.items():
            if value is not None and given not in ordered:
                raise TypeError(f"a '{name}' has no '{given}'")
    return Element(name, place.span, ordered, [*children], place.trace, place.values)


def note(
    kind: str, place: Place, values: Mapping[str, Value], children: Iterable[Node] = ()
) -> RobotNote:
    """Return a note for `robot`: what it has besides links and joints; see `extras.py`."""
    given: dict[str, object] = {
        name: value if type(value) is str else _numbers(value)
        for name, value in values.items()
        if value is not None
    }
    return RobotNote(kind, place.span, given, [*children], place.trace, place.values)


def _numbers(value: float | tuple[float, ...] | Numbers | str) -> Numbers | str:
    if isinstance(value, (Numbers, str)):
        return value
    row = value if isinstance(value, tuple) else (value,)
    if not isfinite(sum(row)) and not all(map(isfinite, row)):
        raise ValueError(f"not all of {value!r} is finite")
    return Numbers.of(*row)


def origin(place: Place, position: Vector = ZERO, rpy: Vector = ZERO) -> Element:
    """Return T_parent_frame: a position in metres; roll, pitch and yaw in radians."""
    return element("origin", place, {"xyz": position, "rpy": rpy})


def material(
    place: Place, name: str, color: tuple[float, ...] | None = None, texture: str | None = None
) -> Element:
    """Return a material, or what refers to one by its name alone."""
    children = []
    if color is not None:
        children.append(element("color", place, {"rgba": color}))
    if texture is not None:
        children.append(element("texture", place, {"filename": texture}))
    return element("material", place, {"name": name}, children)


def link(place: Place, name: str, children: Iterable[Node] = ()) -> Element:
    """Return a link with what is in it."""
    return element("link", place, {"name": name}, children)


def joint(
    place: Place, name: str, type: str, parent: str, child: str, children: Iterable[Node] = ()
) -> Element:
    """Return a joint between two links, with what is in it besides them."""
    ends = (element("parent", place, {"link": parent}), element("child", place, {"link": child}))
    return element("joint", place, {"name": name, "type": type}, [*ends, *children])
