"""The shapes a link can have: their words in URDF, their sizes, volume and inertia.

This is the one place that knows what kinds of shapes there are. Sizes are in metres, masses in
kilograms, inertias in kg·m². The middle of a shape is at the origin of its frame, and the axis of
a cylinder or capsule is z; only a mesh has its centre of mass elsewhere.

A `Solid` is a body with volume and inertia: the four simple shapes, and the body that a closed
mesh encloses. A `Shape` is what a visual or collision names: the simple shapes, or a mesh file.
"""

from __future__ import annotations

from math import hypot, pi

from ..source import Public
from .pose import ZERO

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.tree import Element
    from .inertia import SolidMoments
    from .pose import Vector

Inertia = tuple[float, float, float, float, float, float]
"""The inertia matrix as ixx, ixy, ixz, iyy, iyz, izz, in the order of URDF."""

NEGLIGIBLE = 1e-12
"""Products of inertia below this part of the moments are rounding, and become 0."""

UNSCALED: Vector = (1.0, 1.0, 1.0)


class _Shape(Public):
    """What the shapes have in common.

    Attributes:
        kind: the shape's word, which is also the name of its element in URDF.
        attributes: of that element: one for all sizes, or one for each.
        sizes: what its sizes are, in the order of the constructor and of `scale`.
        example: sizes to show in a hint.
        since: the first version of URDF that has it.
        element: the element it was read from, or None for a shape that was computed.
    """

    __slots__ = ("element",)
    _internal = frozenset(
        ("attributes", "center", "element", "example", "radius_around", "since", "sizes")
    )

    kind: str
    attributes: tuple[str, ...]
    sizes: tuple[str, ...]
    example: str
    since = "1.0"

    element: Element | None

    @property
    def span(self) -> Span | None:
        """Return where the shape is written; None for one that was computed."""
        return self.element.span if self.element is not None else None

    @property
    def size(self) -> tuple[float, ...]:
        """Return its numbers in the order of the constructor and of `scale`."""
        raise AssertionError

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Shape):
            return NotImplemented
        return type(self) is type(other) and self._values() == other._values()

    def __hash__(self) -> int:
        return hash((self.kind, self._values()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._values()))})"

    def _values(self) -> tuple[object, ...]:
        return self.size


class _SimpleShape(_Shape):
    """What the shapes that are made of numbers alone have in common."""

    __slots__ = ()

    def center(self) -> Vector:
        """Return the centre of mass in the shape's frame, in metres."""
        return ZERO


class _RoundShape(_SimpleShape):
    """A shape around z, with a radius and a length."""

    __slots__ = ("length", "radius")
    attributes = sizes = ("radius", "length")
    example = "0.05 0.3"

    def __init__(self, radius: float, length: float, *, element: Element | None = None) -> None:
        """Create the shape from its radius and length in metres."""
        self.radius = radius
        self.length = length
        self.element = element

    @property
    def size(self) -> tuple[float, ...]:
        """Return the radius and the length in metres."""
        return (self.radius, self.length)


class Box(_SimpleShape):
    """A box given by the lengths of its edges."""

    __slots__ = ("x", "y", "z")
    kind = "box"
    attributes = ("size",)
    sizes = ("x", "y", "z")
    example = "0.4 0.3 0.2"

    def __init__(self, x: float, y: float, z: float, *, element: Element | None = None) -> None:
        """Create a box from the lengths of its edges along the axes, in metres."""
        self.x = x
        self.y = y
        self.z = z
        self.element = element

    @property
    def size(self) -> tuple[float, ...]:
        """Return the lengths of the edges along the axes, in metres."""
        return (self.x, self.y, self.z)

    def radius_around(self) -> float:
        """Return the radius of the smallest sphere around the shape's middle that holds it."""
        return hypot(self.x, self.y, self.z) / 2

    def volume(self) -> float:
        """Return the volume in m³."""
        return self.x * self.y * self.z

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass: m/12·(y² + z²), ….

        Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid cuboid".
        """
        xx, yy, zz = self.x * self.x, self.y * self.y, self.z * self.z
        twelfth = mass / 12
        return (twelfth * (yy + zz), 0.0, 0.0, twelfth * (xx + zz), 0.0, twelfth * (xx + yy))


class Cylinder(_RoundShape):
    """A cylinder along z."""

    __slots__ = ()
    kind = "cylinder"

    def radius_around(self) -> float:
        """Return the radius of the smallest sphere around the shape's middle that holds it."""
        return hypot(self.radius, self.length / 2)

    def volume(self) -> float:
        """Return the volume in m³: π·r²·l."""
        return pi * self.radius * self.radius * self.length

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass: m/12·(3r² + l²) twice, m·r²/2 about z.

        Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid cylinder".
        """
        rr = self.radius * self.radius
        across = mass * (3 * rr + self.length * self.length) / 12
        return (across, 0.0, 0.0, across, 0.0, mass * rr / 2)


class Sphere(_SimpleShape):
    """A sphere."""

    __slots__ = ("radius",)
    kind = "sphere"
    attributes = sizes = ("radius",)
    example = "0.1"

    def __init__(self, radius: float, *, element: Element | None = None) -> None:
        """Create a sphere from its radius in metres."""
        self.radius = radius
        self.element = element

    @property
    def size(self) -> tuple[float, ...]:
        """Return the radius in metres."""
        return (self.radius,)

    def radius_around(self) -> float:
        """Return the radius of the smallest sphere around the shape's middle that holds it."""
        return self.radius

    def volume(self) -> float:
        """Return the volume in m³: 4/3·π·r³."""
        return 4 / 3 * pi * self.radius * self.radius * self.radius  # ** raises where it overflows

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass: 2/5·m·r².

        Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid sphere".
        """
        moment = 2 / 5 * mass * self.radius * self.radius
        return (moment, 0.0, 0.0, moment, 0.0, moment)


class Capsule(_RoundShape):
    """A cylinder along z with half a sphere on each end; its length is that of the cylinder."""

    __slots__ = ()
    kind = "capsule"
    since = "1.1"

    def radius_around(self) -> float:
        """Return the radius of the smallest sphere around the shape's middle that holds it."""
        return self.radius + self.length / 2

    def volume(self) -> float:
        """Return the volume in m³: π·r²·(l + 4/3·r)."""
        return pi * self.radius * self.radius * (self.length + 4 / 3 * self.radius)

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass.

        The mass is shared out by volume between the cylinder (c) and the two halves together (s).
        About z: c·r²/2 + 2/5·s·r². Across: c/12·(3r² + l²) + s·(2/5·r² + l²/4 + 3/8·l·r), by the
        parallel axis theorem from the half sphere's centre of mass, 3/8·r from its flat side.

        Source: D. Eberly, Polyhedral Mass Properties, for the method; the half sphere's centre of
        mass from https://en.wikipedia.org/wiki/List_of_centroids.
        """
        r, length = self.radius, self.length
        rr = r * r
        cylinder = mass * length / (length + 4 / 3 * r)
        spheres = mass - cylinder
        across = cylinder * (3 * rr + length * length) / 12
        across += spheres * (2 / 5 * rr + length * length / 4 + 3 / 8 * length * r)
        along = cylinder * rr / 2 + 2 / 5 * spheres * rr
        return (across, 0.0, 0.0, across, 0.0, along)


class MeshSolid:
    """The body that a closed mesh encloses."""

    __slots__ = ("moments",)

    def __init__(self, moments: SolidMoments) -> None:
        """Take the volume integrals of the mesh as scaled; the volume must not be 0."""
        self.moments = moments

    def volume(self) -> float:
        """Return the volume in m³."""
        return self.moments.volume

    def center(self) -> Vector:
        """Return the centre of mass in the mesh's frame, in metres."""
        return self.moments.center()

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass, along the mesh's axes.

        With C = ∫x·xᵀ dV − V·c·cᵀ about the centre of mass c: I = ρ·(trace(C)·1 − C).

        Source: see `inertia.solid_moments`.
        """
        moments = self.moments
        density = mass / moments.volume
        x, y, z = moments.center()
        mx, my, mz = moments.first
        xx, xy, xz, yy, yz, zz = moments.second
        xx, yy, zz = xx - x * mx, yy - y * my, zz - z * mz
        xy, xz, yz = xy - x * my, xz - x * mz, yz - y * mz
        noise = NEGLIGIBLE * (xx + yy + zz)
        ixy, ixz, iyz = (0.0 if abs(c) < noise else -density * c for c in (xy, xz, yz))
        return (density * (yy + zz), ixy, ixz, density * (xx + zz), iyz, density * (xx + yy))


class Mesh(_Shape):
    """A mesh file, by its name as written.

    Attributes:
        filename: a path, `package://…` or another URI, as it is written.
        scale: factors along the axes.
    """

    __slots__ = ("filename", "scale")
    kind = "mesh"
    attributes = ("filename", "scale")
    sizes = ("x", "y", "z")
    example = "0.001 0.001 0.001"

    def __init__(
        self, filename: str, scale: Vector = UNSCALED, *, element: Element | None = None
    ) -> None:
        """Name a mesh; the file is not read."""
        self.filename = filename
        self.scale = scale
        self.element = element

    @property
    def size(self) -> tuple[float, ...]:
        """Return the factors along the axes."""
        return self.scale

    def _values(self) -> tuple[object, ...]:
        return (self.filename, self.scale)


SimpleShape = Box | Cylinder | Sphere | Capsule
Solid = SimpleShape | MeshSolid
Shape = SimpleShape | Mesh

SIMPLE_SHAPES: dict[str, type[SimpleShape]] = {
    shape.kind: shape for shape in (Box, Cylinder, Sphere, Capsule)
}
"""The shapes that are made of numbers alone, by their words."""

SIZES = {kind: shape.attributes for kind, shape in SIMPLE_SHAPES.items()}
"""The attributes of a simple shape in URDF: one for all its sizes, or one for each."""

COUNTS = {kind: len(shape.sizes) for kind, shape in SIMPLE_SHAPES.items()}
"""How many numbers make a simple shape."""

SHAPE_WORDS = (*SIMPLE_SHAPES, Mesh.kind)
"""The words of all shapes, which are the names of their elements in URDF."""
