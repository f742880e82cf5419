"""Geoms: which shape each is, its size and pose, and the mass that it has."""

from __future__ import annotations

from math import pi

from ...model.pose import IDENTITY, Pose, rotation_from_z
from ...model.shapes import Box, Capsule, Cylinder, Sphere
from .compiler import chosen, fault, number, numbers
from .inertia import DENSITY, Mass, diagonal

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.pose import Vector
    from ...model.shapes import SimpleShape
    from .tree import Placed

TYPES = (
    "plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf",
)  # fmt: skip
SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}
"""How many sizes a shape has."""
HIDDEN = 3
"""The first of the groups that viewers hide."""


class Geom:
    """A geom.

    Attributes:
        thing: its element.
        type: its type.
        pose: T_body_geom.
        sizes: the radii and halves of lengths.
        group: its group.
        name: its name, made up if it has none.
    """

    __slots__ = ("group", "name", "pose", "sizes", "thing", "type")

    def __init__(self, thing: Placed, name: str) -> None:
        """Read a geom.

        Raises:
            YamaroError: a value is faulty.
        """
        given = thing.given
        self.thing = thing
        self.name = name
        self.type = chosen(given, "type", TYPES, "mesh" if False else "sphere")
        self.group = int(number(given, "group", 0.0))
        self.sizes: tuple[float, ...] = tuple(numbers(given, "size", 1, 3) or ())
        ends = numbers(given, "fromto", 6)
        if ends is not None:
            pose, half = between(ends, thing)
            radius = self.sizes[0] if self.sizes else 0.0
            round_ = self.type in ("capsule", "cylinder")
            self.sizes = (radius, half) if round_ else (radius, radius, half)
        else:
            pose = thing.context.compiler.pose(given)
        self.pose = pose if thing.pose is IDENTITY else thing.pose @ pose
        wanted = SIZES.get(self.type)
        if wanted is not None and "mesh" not in given:
            if len(self.sizes) < wanted or min(self.sizes[:wanted]) <= 0:
                raise fault(
                    f"a {self.type} has {wanted} size{'s' if wanted > 1 else ''} above 0",
                    given["size"][1] if "size" in given else thing.span,
                    f'write size="{" ".join(["0.1"] * wanted)}"',
                )
            self.sizes = self.sizes[:wanted]

    def shape(self) -> SimpleShape | None:
        """Return its shape as the model has it, or None if the model has no such shape."""
        sizes = self.sizes
        match self.type:
            case "box":
                return Box(2 * sizes[0], 2 * sizes[1], 2 * sizes[2])
            case "sphere":
                return Sphere(sizes[0])
            case "capsule":
                return Capsule(sizes[0], 2 * sizes[1])
            case "cylinder":
                return Cylinder(sizes[0], 2 * sizes[1])
        return None

    def is_solid(self) -> bool:
        """Return whether it can touch others without being named in a pair."""
        given = self.thing.given
        return bool(number(given, "contype", 1.0) or number(given, "conaffinity", 1.0))

    def is_seen(self) -> bool:
        """Return whether viewers show it."""
        return self.group < HIDDEN

    def mass(self) -> Mass | None:
        """Return its mass at its pose in the body, or None if it is not of a shape with volume."""
        given = self.thing.given
        if self.type == "ellipsoid":
            a, b, c = self.sizes
            volume = 4 / 3 * pi * a * b * c
            moments = ((b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5)
        else:
            shape = self.shape()
            if shape is None:
                return None
            volume = shape.volume()
            xx, _, _, yy, _, zz = shape.inertia(1.0)
            moments = (xx, yy, zz)
        weight = number(given, "density", DENSITY) * volume
        weight = number(given, "mass", weight)
        return Mass(weight, self.pose, diagonal(weight * each for each in moments))


def between(ends: list[float], thing: Placed) -> tuple[Pose, float]:
    """Return the pose in the middle of two points, its z axis along them, and half their distance.

    Raises:
        YamaroError: they are at one place.
    """
    a, b = ends[:3], ends[3:]
    x, y, z = (p - q for p, q in zip(a, b, strict=True))
    length = (x * x + y * y + z * z) ** 0.5
    if length <= 0:
        raise fault("'fromto' has no length", thing.given["fromto"][1], "name two points")
    middle: Vector = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2)
    return Pose(rotation_from_z((x / length, y / length, z / length)), middle), length / 2
