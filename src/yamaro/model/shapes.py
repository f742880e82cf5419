"""The shapes a link can have, with the volume and the inertia of each as a homogeneous body.

Sizes are in metres, masses in kilograms, inertias in kg·m². A shape stands in its own frame: its
middle at the origin, a cylinder's and a capsule's axis along z; only a mesh has its centre of mass
elsewhere.
"""

from __future__ import annotations

from math import pi

from .rotations import ZERO

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .mesh_integrals import SolidMoments
    from .rotations import Vector

Inertia = tuple[float, float, float, float, float, float]
"""The inertia matrix as ixx, ixy, ixz, iyy, iyz, izz, in the order of URDF."""

NEGLIGIBLE = 1e-12
"""Products of inertia below this part of the moments are rounding, and come out as 0."""


class Box:
    """A box given by the lengths of its edges."""

    __slots__ = ("x", "y", "z")

    def __init__(self, x: float, y: float, z: float) -> None:
        """Hold the lengths of the edges along the axes, in metres."""
        self.x = x
        self.y = y
        self.z = z

    def volume(self) -> float:
        """Return the volume in m³."""
        return self.x * self.y * self.z

    def center(self) -> Vector:
        """Return the centre of mass in the shape's frame, in metres."""
        return ZERO

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass: m/12·(y² + z²), ….

        Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid cuboid".
        """
        xx, yy, zz = self.x * self.x, self.y * self.y, self.z * self.z
        twelfth = mass / 12
        return (twelfth * (yy + zz), 0.0, 0.0, twelfth * (xx + zz), 0.0, twelfth * (xx + yy))


class Cylinder:
    """A cylinder along z."""

    __slots__ = ("length", "radius")

    def __init__(self, radius: float, length: float) -> None:
        """Hold the radius and the length in metres."""
        self.radius = radius
        self.length = length

    def volume(self) -> float:
        """Return the volume in m³: π·r²·l."""
        return pi * self.radius * self.radius * self.length

    def center(self) -> Vector:
        """Return the centre of mass in the shape's frame, in metres."""
        return ZERO

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass: m/12·(3r² + l²) twice, m·r²/2 about z.

        Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid cylinder".
        """
        rr = self.radius * self.radius
        across = mass * (3 * rr + self.length * self.length) / 12
        return (across, 0.0, 0.0, across, 0.0, mass * rr / 2)


class Sphere:
    """A sphere."""

    __slots__ = ("radius",)

    def __init__(self, radius: float) -> None:
        """Hold the radius in metres."""
        self.radius = radius

    def volume(self) -> float:
        """Return the volume in m³: 4/3·π·r³."""
        return 4 / 3 * pi * self.radius * self.radius * self.radius  # ** raises where it overflows

    def center(self) -> Vector:
        """Return the centre of mass in the shape's frame, in metres."""
        return ZERO

    def inertia(self, mass: float) -> Inertia:
        """Return the inertia about the centre of mass: 2/5·m·r².

        Source: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, "solid sphere".
        """
        moment = 2 / 5 * mass * self.radius * self.radius
        return (moment, 0.0, 0.0, moment, 0.0, moment)


class Capsule:
    """A cylinder along z with half a sphere on each end; its length is that of the cylinder."""

    __slots__ = ("length", "radius")

    def __init__(self, radius: float, length: float) -> None:
        """Hold the radius, and the length without the half spheres, in metres."""
        self.radius = radius
        self.length = length

    def volume(self) -> float:
        """Return the volume in m³: π·r²·(l + 4/3·r)."""
        return pi * self.radius * self.radius * (self.length + 4 / 3 * self.radius)

    def center(self) -> Vector:
        """Return the centre of mass in the shape's frame, in metres."""
        return ZERO

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


class Mesh:
    """The body enclosed by a closed mesh."""

    __slots__ = ("moments",)

    def __init__(self, moments: SolidMoments) -> None:
        """Hold the volume integrals of the mesh as scaled; the volume must not be 0."""
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

        Source: see `mesh.solid_moments`.
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


Shape = Box | Cylinder | Sphere | Capsule | Mesh
