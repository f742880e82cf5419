"""A robot made of values: its links, joints, shapes, …, each at its place, and the URDF of it.

Readers of formats other than URDF make a `Robot` here from what they have read. Each function takes
values in SI and the `Place` where they are written, and returns an object of the model. Its
`element` is what says the same in URDF, by the rows of the schema, so that all that works on a
robot, such as checks, messages and the writers, works on this one. Values are rounded as they are
written, so that reading `robot.element`, or the text of it, gives the same robot.

    place = Place(span)
    arm = link(place, name="arm", inertial=inertial(place, mass=2.0, inertia=(1, 0, 0, 1, 0, 1)))
    limit = part(Limit, Place(span, {"upper": its_span}), upper=1.5, effort=10, velocity=2)
    elbow = joint(place, name="elbow", type="revolute", parent="base", child="arm", limit=limit)
    made = robot(place, name="two_links", links=[base, arm], joints=[elbow])
"""

from __future__ import annotations

from math import isfinite

from ..xml.tree import Element, RobotNote
from ..xml.values import Numbers
from .joint import Calibration, Dynamics, Joint, Limit, Mimic, SafetyController
from .link import Collision, Inertial, Link, Material, Visual
from .pose import IDENTITY, UNTURNED, X_AXIS, ZERO, Pose, rotation_from_rpy, unit_vector
from .robot import Robot
from .schema import ELEMENTS, MOMENTS, TEXT
from .shapes import SIMPLE_SHAPES, SIZES, UNSCALED, Mesh
from .values import number_in, numbers_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from typing import TypeVar

    from ..diagnostics import Frame as Step
    from ..source import Span
    from ..xml.tree import Node
    from .link import Color
    from .pose import Vector
    from .shapes import Inertia, Shape, SimpleShape

    Part = TypeVar("Part", Limit, Mimic, Dynamics, SafetyController, Calibration)
    Value = float | tuple[float, ...] | Numbers | str | None
    """`Numbers` keep how they were spelled; others are written with 15 digits."""

RECORDS = {
    Limit: "limit",
    Mimic: "mimic",
    Dynamics: "dynamics",
    SafetyController: "safety_controller",
    Calibration: "calibration",
}
"""The parts of a joint, with the names of their elements."""


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
    fields = ELEMENTS[name].fields
    made = {given: _value(value) for given, value in values.items() if value is not None}
    for given, value in made.items():
        field = fields.get(given)
        if field is None:
            raise TypeError(f"a '{name}' has no '{given}'")
        if field.count != (len(value.words) if isinstance(value, Numbers) else TEXT):
            raise TypeError(f"'{given}' of a '{name}' cannot be {values[given]!r}")
    ordered: dict[str, object] = {each: made[each] for each in fields if each in made}
    return Element(name, place.span, ordered, list(children), place.trace, place.values)


def note(
    kind: str, place: Place, values: Mapping[str, Value], children: Iterable[Node] = ()
) -> RobotNote:
    """Return a note for `robot`: what it has besides links and joints; see `extras.py`."""
    given: dict[str, object] = {
        name: _value(value) for name, value in values.items() if value is not None
    }
    return RobotNote(kind, place.span, given, list(children), place.trace, place.values)


def _value(value: Value) -> Numbers | str | None:
    if isinstance(value, (int, float)):
        value = (value,)
    if isinstance(value, tuple):
        if not all(map(isfinite, value)):
            raise ValueError(f"not all of {value!r} is finite")
        return Numbers.of(*value)
    return value


# --- shapes and poses ---------------------------------------------------------------------------


def pose(place: Place, position: Vector = ZERO, rpy: Vector = ZERO) -> Pose:
    """Return T_parent_frame: a position in metres; roll, pitch and yaw in radians."""
    origin = element("origin", place, {"xyz": position, "rpy": rpy})
    (x, y, z), (roll, pitch, yaw) = numbers_of(origin, "xyz"), numbers_of(origin, "rpy")
    rotation = rotation_from_rpy(roll, pitch, yaw) if any((roll, pitch, yaw)) else UNTURNED
    return Pose(rotation, (x, y, z), origin)


def simple_shape(place: Place, kind: str, *sizes: float) -> SimpleShape:
    """Return a box, cylinder, sphere or capsule of sizes in metres."""
    names = SIZES[kind]
    rows = [sizes] if len(names) < len(sizes) else [(size,) for size in sizes]
    values: dict[str, Value] = {
        name: row if len(row) > 1 else row[0] for name, row in zip(names, rows, strict=True)
    }
    written = element(kind, place, values)
    rounded = [number for name in names for number in numbers_of(written, name)]
    return SIMPLE_SHAPES[kind](*rounded, element=written)


def mesh(place: Place, filename: str, scale: Vector | None = None) -> Mesh:
    """Return the mesh of a file, with its factors along the axes."""
    written = element(Mesh.kind, place, {"filename": filename, "scale": scale})
    x, y, z = numbers_of(written, "scale") or UNSCALED
    return Mesh(filename, (x, y, z), element=written)


# --- links --------------------------------------------------------------------------------------


def inertial(place: Place, *, mass: float, inertia: Inertia, pose: Pose = IDENTITY) -> Inertial:
    """Return the mass of a link in kg, and its inertia in kg·m² along the axes of the pose."""
    weight = element("mass", place, {"value": mass})
    moments = element("inertia", place, dict(zip(MOMENTS, inertia, strict=True)))
    xx, xy, xz, yy, yz, zz = (number_in(moments, name) or 0.0 for name in MOMENTS)
    return Inertial(
        element("inertial", place, {}, [*_origin_of(pose), weight, moments]),
        mass=number_in(weight, "value") or 0.0,
        pose=pose,
        inertia=(xx, xy, xz, yy, yz, zz),
    )


def material(
    place: Place, *, name: str, color: Color | None = None, texture: str | None = None
) -> Material:
    """Return a material, or what refers to one by its name alone."""
    children: list[Element] = []
    if color is not None:
        children.append(element("color", place, {"rgba": color}))
        red, green, blue, alpha = numbers_of(children[0], "rgba")
        color = (red, green, blue, alpha)
    if texture is not None:
        children.append(element("texture", place, {"filename": texture}))
    written = element("material", place, {"name": name}, children)
    return Material(written, name=name, color=color, texture=texture)


def visual(
    place: Place,
    *,
    shape: Shape,
    pose: Pose = IDENTITY,
    material: Material | None = None,
    name: str | None = None,
) -> Visual:
    """Return a shape that is seen."""
    looks = [] if material is None else [material.element]
    written = _section("visual", place, shape, pose, looks, name)
    return Visual(written, name=name or "", pose=pose, shape=shape, material=material)


def collision(
    place: Place, *, shape: Shape, pose: Pose = IDENTITY, name: str | None = None
) -> Collision:
    """Return a shape that collides."""
    written = _section("collision", place, shape, pose, [], name)
    return Collision(written, name=name or "", pose=pose, shape=shape)


def _section(
    kind: str, place: Place, shape: Shape, pose: Pose, looks: list[Element], name: str | None
) -> Element:
    assert shape.element is not None, "a function above made it"
    geometry = element("geometry", place, {}, [shape.element])
    return element(kind, place, {"name": name}, [*_origin_of(pose), geometry, *looks])


def _origin_of(pose: Pose) -> list[Element]:
    return [] if pose.element is None else [pose.element]


def link(
    place: Place,
    *,
    name: str,
    inertial: Inertial | None = None,
    visuals: Sequence[Visual] = (),
    collisions: Sequence[Collision] = (),
) -> Link:
    """Return a link."""
    inner = [*([] if inertial is None else [inertial]), *visuals, *collisions]
    written = element("link", place, {"name": name}, [each.element for each in inner])

    def fill(made: Link) -> None:
        made.inertial, made.visuals, made.collisions = inertial, tuple(visuals), tuple(collisions)

    return Link(written, name=name, trace=place.trace, read_rest=fill)


# --- joints -------------------------------------------------------------------------------------


def part(kind: type[Part], place: Place, **values: Value) -> Part:
    """Return the limit, mimic, dynamics, … of a joint, with the values that the schema lists."""
    return kind(element(RECORDS[kind], place, values), number_in)


def joint(
    place: Place,
    *,
    name: str,
    type: str,
    parent: str,
    child: str,
    origin: Pose = IDENTITY,
    axis: Vector | None = None,
    limit: Limit | None = None,
    mimic: Mimic | None = None,
    dynamics: Dynamics | None = None,
    safety_controller: SafetyController | None = None,
    calibration: Calibration | None = None,
) -> Joint:
    """Return a joint; its axis may have any length, and is x where it is left out."""
    children = [
        element("parent", place, {"link": parent}),
        element("child", place, {"link": child}),
    ]
    children += _origin_of(origin)
    direction = X_AXIS
    if axis is not None:
        children.append(element("axis", place, {"xyz": axis}))
        x, y, z = numbers_of(children[-1], "xyz")
        direction = unit_vector((x, y, z))
    parts = (calibration, dynamics, limit, mimic, safety_controller)
    children += [each.element for each in parts if each is not None]

    def fill(made: Joint) -> None:
        made.type, made.origin, made.axis = type, origin, direction
        made.limit, made.dynamics = limit, dynamics
        made.safety_controller, made.calibration = safety_controller, calibration

    return Joint(
        element("joint", place, {"name": name, "type": type}, children),
        name=name,
        parent=parent,
        child=child,
        mimic=mimic,
        trace=place.trace,
        read_rest=fill,
    )


# --- robots -------------------------------------------------------------------------------------


def robot(
    place: Place,
    *,
    name: str,
    links: Sequence[Link],
    joints: Sequence[Joint],
    materials: Sequence[Material] = (),
    notes: Sequence[Element] = (),
    version: str | None = None,
) -> Robot:
    """Return a robot; its notes say what it has besides links and joints."""
    children = [each.element for things in (materials, links, joints) for each in things]
    return Robot(
        element("robot", place, {"name": name, "version": version}, children),
        links=list(links),
        joints=list(joints),
        materials=list(materials),
        find=list,
        notes=notes,
        recognizes=False,
    )
