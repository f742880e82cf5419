"""Geoms: which shape each is, its size and pose, and the mass that it has."""

from __future__ import annotations

from math import pi

from ...model.pose import IDENTITY, UNTURNED, Pose, rotation_from_z
from ...model.shapes import Box, Capsule, Cylinder, Sphere
from .compiler import MAXVAL, SMALLEST, chosen, fault, number, numbers, truth
from .inertia import DENSITY, Mass, diagonal

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...model.making import Value
    from ...model.pose import Vector
    from ...model.shapes import SimpleShape
    from .assets import Assets
    from .meshes import MeshAsset
    from .tree import Placed

    Sizes = tuple[float, ...]

TYPES = (
    "plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf",
)  # fmt: skip
SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}
"""How many sizes a shape has: radii, and halves of lengths."""
OF_MESHES = ("mesh", "sdf")
CONNECTORS = ("capsule", "cylinder", "ellipsoid", "box")
"""The shapes that can be given by two points."""
HIDDEN = 3
"""The first of the groups that viewers hide."""
THOMSEN = 1.6075
"""The exponent of the surface of an ellipsoid; http://www.numericana.com/answer/ellipsoid.htm."""
LAYER = 1e-6
"""The thickness in m of the shell of an ellipsoid, as MuJoCo takes it."""


class Geom:
    """A geom.

    Attributes:
        thing: its element.
        name: its name; one without is given one with its shape.
        type: its type.
        pose: T_body_geom.
        sizes: the radii and halves of lengths; none of a mesh.
        group: its group.
        mesh: the mesh that it is, or None.
    """

    __slots__ = ("group", "mesh", "name", "pose", "sizes", "thing", "type")

    def __init__(self, thing: Placed, assets: Assets) -> None:
        """Read a geom.

        Raises:
            YamaroError: a value is faulty, or the mesh is not there.
        """
        given = thing.given
        self.thing = thing
        self.name = thing.name
        self.type = chosen(given, "type", TYPES, "sphere")
        self.group = int(number(given, "group", 0.0))
        self.sizes: Sizes = tuple(numbers(given, "size", 1, 3) or ())
        self.mesh: MeshAsset | None = None
        named = given.get("mesh")
        mesh = assets.mesh(*named) if named is not None else None
        ends = numbers(given, "fromto", 6)
        if ends is not None:
            if self.type not in CONNECTORS:
                raise fault(
                    f"a {self.type} takes no 'fromto'",
                    given["fromto"][1],
                    f'write type="capsule"; {", ".join(CONNECTORS)} take it',
                )
            pose, half = between(ends, thing)
            radius = self.sizes[0] if self.sizes else 0.0
            is_round = self.type in ("capsule", "cylinder")
            self.sizes = (radius, half) if is_round else (radius, radius, half)
        else:
            pose = thing.context.compiler.pose(given)
        if thing.pose is not IDENTITY:
            pose = thing.pose @ pose
        if self.type in OF_MESHES:
            self.sizes = ()
            self.mesh = mesh
            if mesh is None:
                raise fault("this geom names no mesh", thing.span, 'write mesh="…"')
        elif mesh is not None:
            self.sizes, place = self._fitted(mesh)
            pose = pose @ place
        self.pose = pose
        if any(abs(size) > MAXVAL for size in self.sizes):
            span = given["size"][1] if "size" in given else thing.span
            raise fault("this size is too large", span, f"MuJoCo takes up to {MAXVAL:g} m")
        wanted = SIZES.get(self.type)
        if wanted is not None:
            if len(self.sizes) < wanted or min(self.sizes[:wanted]) <= 0:
                raise fault(
                    f"a {self.type} has {wanted} size{'s' if wanted > 1 else ''} above 0",
                    given["size"][1] if "size" in given else thing.span,
                    f'write size="{" ".join(["0.1"] * wanted)}"',
                )
            self.sizes = self.sizes[:wanted]

    def _fitted(self, mesh: MeshAsset) -> tuple[Sizes, Pose]:
        """Return the sizes of a shape that fits a mesh, and T_geom_shape.

        Source: MuJoCo, user_mesh.cc: FitGeom.
        """
        given = self.thing.given
        pose, (a, b, c), _ = mesh.axes()
        sizes: Sizes
        if truth(self.thing.context.compiler.given, "fitaabb", False):
            inverse = pose.inverse()
            axes = [*zip(*map(inverse.apply, mesh.corners()[0]), strict=True)]
            x, y, z = ((min(axis) + max(axis)) / 2 for axis in axes)
            a, b, c = ((max(axis) - min(axis)) / 2 for axis in axes)
            pose = pose @ Pose(UNTURNED, (x, y, z))
            across = max(a, b)
            sizes = {
                "sphere": (max(a, b, c),),
                "capsule": (across, c - across),
                "cylinder": (across, c),
            }.get(self.type, (a, b, c))
        else:
            across = (a + b) / 2
            sizes = {
                "sphere": ((a + b + c) / 3,),
                "capsule": (across, max(0.0, c - across / 2)),
                "cylinder": (across, c),
            }.get(self.type, (a, b, c))
        factor = number(given, "fitscale", 1.0)
        return tuple(factor * size for size in sizes), pose

    def shape(self) -> tuple[str, dict[str, Value]] | None:
        """Return the element that its shape is in URDF, and its values; None for none."""
        sizes = self.sizes
        match self.type:
            case "box":
                return "box", {"size": (2 * sizes[0], 2 * sizes[1], 2 * sizes[2])}
            case "sphere":
                return "sphere", {"radius": sizes[0]}
            case "capsule" | "cylinder":
                return self.type, {"radius": sizes[0], "length": 2 * sizes[1]}
        return None

    def is_solid(self) -> bool:
        """Return whether it can touch others without being named in a pair."""
        given = self.thing.given
        return bool(number(given, "contype", 1.0) or number(given, "conaffinity", 1.0))

    def is_seen(self) -> bool:
        """Return whether viewers show it."""
        return self.group < HIDDEN

    def mass(self) -> Mass | None:
        """Return its mass at its pose in the body, or None if it has none."""
        given = self.thing.given
        weight = number(given, "mass", -1.0)
        density = number(given, "density", DENSITY)
        if (weight if weight >= 0 else density) <= SMALLEST:
            return None
        if self.mesh is not None:
            size = self.mesh.moments().size
            mass = weight if weight >= 0 else density * size
            pose, _, moments = self.mesh.axes()
            return Mass(mass, self.pose @ pose, diagonal(mass * each for each in moments))
        if self.type not in SIZES:
            return None
        is_shell = truth(given, "shellinertia", False)
        size, moments = (_shell if is_shell else _solid)(self.type, self.sizes)
        mass = weight if weight >= 0 else density * size
        return Mass(mass, self.pose, diagonal(mass * each for each in moments))


def between(ends: list[float], thing: Placed) -> tuple[Pose, float]:
    """Return the pose in the middle of two points, and half their distance.

    Its z axis points from the second to the first.

    Raises:
        YamaroError: they are at one place.
    """
    a, b = ends[:3], ends[3:]
    x, y, z = (p - q for p, q in zip(a, b, strict=True))
    length = (x * x + y * y + z * z) ** 0.5
    if length < SMALLEST:
        raise fault("'fromto' has no length", thing.given["fromto"][1], "name two points")
    middle: Vector = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2)
    return Pose(rotation_from_z((x / length, y / length, z / length)), middle), length / 2


# --- volume and inertia of shapes -------------------------------------------------------------


def _solid(kind: str, sizes: Sizes) -> tuple[float, Vector]:
    """Return the volume of a shape in m³, and the moments of inertia for a mass of 1 kg."""
    if kind == "ellipsoid":
        a, b, c = sizes
        moments = ((b * b + c * c) / 5, (a * a + c * c) / 5, (a * a + b * b) / 5)
        return 4 / 3 * pi * a * b * c, moments
    shape: SimpleShape
    match kind:
        case "box":
            shape = Box(2 * sizes[0], 2 * sizes[1], 2 * sizes[2])
        case "sphere":
            shape = Sphere(sizes[0])
        case "capsule":
            shape = Capsule(sizes[0], 2 * sizes[1])
        case _:
            shape = Cylinder(sizes[0], 2 * sizes[1])
    xx, _, _, yy, _, zz = shape.inertia(1.0)
    return shape.volume(), (xx, yy, zz)


def _shell(kind: str, sizes: Sizes) -> tuple[float, Vector]:
    """Return the surface of a shape in m², and the moments of inertia of 1 kg spread over it.

    Sources: https://en.wikipedia.org/wiki/List_of_moments_of_inertia, put together by the parallel
    axis theorem; the surface of an ellipsoid is K. Thomsen's, and its inertia that between two
    ellipsoids, as in MuJoCo.
    """
    r = sizes[0]
    match kind:
        case "sphere":
            return 4 * pi * r * r, (2 / 3 * r * r,) * 3
        case "capsule":
            half, length = sizes[1], 2 * sizes[1]
            area = 4 * pi * r * r + 2 * pi * r * length
            ball = 4 * pi * r * r / area
            tube = 1 - ball
            # Two halves of a sphere: the centre of each is r/2 from its flat side.
            across = tube * (6 * r * r + length * length) / 12
            across += ball * (2 / 3 * r * r + (half + r / 2) ** 2 - r * r / 4)
            return area, (across, across, tube * r * r + ball * 2 / 3 * r * r)
        case "cylinder":
            half, length = sizes[1], 2 * sizes[1]
            area = 2 * pi * r * r + 2 * pi * r * length
            ends = 2 * pi * r * r / area
            tube = 1 - ends
            across = tube * (6 * r * r + length * length) / 12
            across += ends * (r * r / 4 + half * half)
            return area, (across, across, tube * r * r + ends * r * r / 2)
        case "ellipsoid":
            a, b, c = sizes
            powers = (a * b) ** THOMSEN + (b * c) ** THOMSEN + (c * a) ** THOMSEN
            area = 4 * pi * (powers / 3) ** (1 / THOMSEN)
            p, q, s = a + LAYER, b + LAYER, c + LAYER
            inner, outer = a * b * c, p * q * s
            share = 1 / (outer - inner)
            return area, (
                share * (outer * (q * q + s * s) - inner * (b * b + c * c)) / 5,
                share * (outer * (p * p + s * s) - inner * (a * a + c * c)) / 5,
                share * (outer * (p * p + q * q) - inner * (a * a + b * b)) / 5,
            )
        case _:
            x, y, z = sizes
            area = 8 * (x * y + y * z + z * x)
            sides = (8 * y * z / area, 8 * z * x / area, 8 * x * y / area)  # of x, of y, of z
            spread = [
                sum(
                    share * (own * own if side == axis else own * own / 3)
                    for side, share in enumerate(sides)
                )
                for axis, own in enumerate((x, y, z))
            ]
            xx, yy, zz = spread
            return area, (yy + zz, xx + zz, xx + yy)
