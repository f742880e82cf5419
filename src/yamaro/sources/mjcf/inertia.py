"""Mass and inertia of bodies: as they are given, or of the geoms in them, as MuJoCo takes them."""

from __future__ import annotations

from math import pi

from ...model.inertia import principal_axes
from ...model.pose import IDENTITY, UNTURNED, ZERO, Pose, multiply, rotation_about, transposed
from .compiler import SMALLEST, chosen, fault, number, numbers, truth

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...model.pose import Rotation, Vector
    from .shapes import Geom
    from .tree import Body, Placed

LARGEST_GROUP = 5
"""The last of the groups of geoms: mjNGROUP − 1."""
DENSITY = 1000.0
"""In kg/m³: what a geom has that says nothing of it."""


class Mass:
    """A mass, its centre and its inertia about that centre.

    Attributes:
        mass: in kg.
        pose: T_body_inertial: its position is the centre of mass.
        inertia: the whole matrix along these axes.
        is_along_principal_axes: whether MuJoCo takes the axes of the pose as they are; others it
            works out, with the greatest moment first.
    """

    __slots__ = ("inertia", "is_along_principal_axes", "mass", "pose")

    def __init__(
        self, mass: float, pose: Pose, inertia: Rotation, *, is_along_principal_axes: bool = True
    ) -> None:
        self.mass = mass
        self.pose = pose
        self.inertia = inertia
        self.is_along_principal_axes = is_along_principal_axes

    def is_nothing(self) -> bool:
        """Return whether it has neither mass nor inertia, as what stands still may in MuJoCo."""
        return not self.mass and not any(map(any, self.inertia))

    def in_order(self) -> Mass:
        """Return it along axes with the greatest moment first, if the matrix is diagonal.

        Source: MuJoCo, engine_util_solve.c: mju_eig3 swaps two moments by a quarter turn about the
        third axis, of neighbours: the first two, the last two, the first two.
        """
        if any((self.inertia[0][1], self.inertia[0][2], self.inertia[1][2])):
            return self
        moments, pose = [self.inertia[i][i] for i in range(3)], self.pose
        for first in (0, 1, 0):
            if moments[first] < moments[first + 1]:
                moments[first : first + 2] = moments[first + 1], moments[first]
                axis = (1.0, 0.0, 0.0) if first else (0.0, 0.0, 1.0)
                pose = pose @ Pose(rotation_about(axis, pi / 2), ZERO)
        return Mass(self.mass, pose, diagonal(moments), is_along_principal_axes=False)

    def along(self) -> tuple[Pose, Vector]:
        """Return the pose along the principal axes, and the moments about them."""
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = self.inertia
        if xy == xz == yz == 0:
            return self.pose, (xx, yy, zz)
        moments, turn = principal_axes(self.inertia)
        return self.pose @ Pose(turn, ZERO), moments


def diagonal(moments: Iterable[float]) -> Rotation:
    """Return the matrix with a diagonal."""
    xx, yy, zz = moments
    return ((xx, 0.0, 0.0), (0.0, yy, 0.0), (0.0, 0.0, zz))


def mass_of(body: Body, geoms: Iterable[Geom]) -> Mass | None:
    """Return the mass of a body, or None if it has none.

    Args:
        body: the body.
        geoms: the geoms in it.

    Raises:
        YamaroError: a value is faulty.
    """
    settings = body.thing.context.compiler.given
    source = chosen(settings, "inertiafromgeom", ("false", "true", "auto"), "auto")
    if body.inertial is not None and source != "true":
        found = _given(body.inertial)
    elif source == "false":
        found = None
    else:
        found = _of_geoms(body, geoms)
    return _bounded(body, found)


def _given(thing: Placed) -> Mass:
    """Return what `<inertial>` says."""
    given = thing.given
    if "mass" not in given:
        raise fault("this inertial has no mass", thing.span, 'write mass="1"')
    mass = number(given, "mass", 0.0)
    full, diag = numbers(given, "fullinertia", 6), numbers(given, "diaginertia", 3)
    pose = thing.context.compiler.pose(given)
    if thing.pose is not IDENTITY:
        pose = thing.pose @ pose
    if full is not None:
        xx, yy, zz, xy, xz, yz = full
        rows: Rotation = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
        return Mass(mass, pose, rows, is_along_principal_axes=False)
    return Mass(mass, pose, diagonal(diag or (0.0, 0.0, 0.0)))


def _of_geoms(body: Body, geoms: Iterable[Geom]) -> Mass | None:
    """Return the mass of the geoms of a body together."""
    settings = body.thing.context.compiler.given
    groups = numbers(settings, "inertiagrouprange", 2) or [0.0, float(LARGEST_GROUP)]
    parts = [
        part
        for geom in geoms
        if groups[0] <= geom.group <= groups[1]
        and (part := geom.mass()) is not None
        and part.mass > SMALLEST
    ]
    if not parts:
        return None
    if len(parts) == 1:
        return parts[0]
    total = sum(part.mass for part in parts)
    x, y, z = (sum(p.mass * p.pose.position[i] for p in parts) / total for i in range(3))
    sums = [0.0] * 6
    for part in parts:
        turn = part.pose.rotation
        inertia = part.inertia
        if turn != UNTURNED:
            inertia = multiply(multiply(turn, inertia), transposed(turn))
        px, py, pz = part.pose.position
        dx, dy, dz, m = px - x, py - y, pz - z, part.mass
        moved = (
            m * (dy * dy + dz * dz), m * (dx * dx + dz * dz), m * (dx * dx + dy * dy),
            -m * dx * dy, -m * dx * dz, -m * dy * dz,
        )  # fmt: skip
        own = (
            inertia[0][0], inertia[1][1], inertia[2][2],
            inertia[0][1], inertia[0][2], inertia[1][2],
        )  # fmt: skip
        sums = [s + o + a for s, o, a in zip(sums, own, moved, strict=True)]
    xx, yy, zz, xy, xz, yz = sums
    noise = 1e-16 * (xx + yy + zz)
    xy, xz, yz = (0.0 if abs(each) < noise else each for each in (xy, xz, yz))
    rows: Rotation = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    return Mass(total, Pose(UNTURNED, (x, y, z)), rows, is_along_principal_axes=False)


def _bounded(body: Body, found: Mass | None) -> Mass | None:
    """Return a mass within the bounds that the compiler sets."""
    settings = body.thing.context.compiler.given
    least, least_moment = number(settings, "boundmass", 0.0), number(settings, "boundinertia", 0.0)
    balances = truth(settings, "balanceinertia", False)
    if not (least or least_moment or balances):
        return found
    if found is None:  # MuJoCo then takes the pose of the body for that of its inertia
        found = Mass(0.0, body.thing.context.compiler.pose(body.thing.given), diagonal(ZERO))
    pose, moments = found.along()
    mass = max(found.mass, least)
    a, b, c = (max(each, least_moment) for each in moments)
    if balances and (a + b < c or a + c < b or b + c < a):
        a = b = c = (a + b + c) / 3
    if (mass, (a, b, c)) == (found.mass, moments):
        return found
    return Mass(mass, pose, diagonal((a, b, c))) if mass or a else None


def scaled(masses: dict[str, Mass], total: float) -> dict[str, Mass]:
    """Return masses that are of a total together: `settotalmass`."""
    before = sum(each.mass for each in masses.values())
    factor = total / before if before > SMALLEST else 1.0
    return {
        name: Mass(
            each.mass * factor,
            each.pose,
            (
                tuple(value * factor for value in each.inertia[0]),
                tuple(value * factor for value in each.inertia[1]),
                tuple(value * factor for value in each.inertia[2]),
            ),  # type: ignore[arg-type]
        )
        for name, each in masses.items()
    }
