"""Meshes: where the file of each is, how it is scaled and turned, and the mass that it encloses."""

from __future__ import annotations

import os
from math import hypot, sqrt

from ...diagnostics import failure
from ...model.inertia import principal_axes
from ...model.pose import IDENTITY, UNTURNED, ZERO, Pose
from .compiler import SMALLEST, chosen, fault, numbers, vector

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ...model.pose import Rotation, Vector
    from ..host import Host
    from .tree import Thing

    Triangle = tuple[int, int, int]

LEGACY, EXACT, CONVEX, SHELL = "legacy", "exact", "convex", "shell"
UNSCALED = (1.0, 1.0, 1.0)
NOT_OF_FILES = frozenset(("maxhullvert", "smoothnormal"))
"""What a mesh says that no file has, and no model."""


class Moments:
    """The mass of a mesh of density 1.

    Attributes:
        size: its volume in m³; of a shell, its area in m².
        center: the centre of mass.
        inertia: about that centre.
    """

    __slots__ = ("center", "inertia", "size")

    def __init__(self, size: float, center: Vector, inertia: Rotation) -> None:
        self.size = size
        self.center = center
        self.inertia = inertia


class MeshAsset:
    """A mesh of a model.

    Attributes:
        thing: its element.
        name: its name.
        path: its file from the folder of the main file, or "" if it is in the document.
        scale: its factors along the axes.
        turn: T_file_mesh, before the scale.
    """

    __slots__ = ("_corners", "_host", "_moments", "name", "path", "scale", "thing", "turn")

    def __init__(self, thing: Thing, host: Host) -> None:
        """Read a mesh.

        Raises:
            YamaroError: a value is faulty.
        """
        self.thing = thing
        self._host = host
        file = thing.text("file") or ""
        compiler = thing.context.compiler
        self.path = thing.context.path(file, compiler.meshdir) if file else ""
        self.name = thing.name
        if not self.name:
            stem = os.path.basename(file.replace("\\", "/")).rpartition(".")[0]
            self.name = thing.context.prefix + stem
        if not self.name:
            raise fault("this mesh has neither a name nor a file", thing.span, 'write name="…"')
        given = thing.given
        self.scale = vector(given, "scale", UNSCALED)
        position = vector(given, "refpos")
        turn = UNTURNED
        if "refquat" in given:
            turn = compiler.rotation({"quat": given["refquat"]})
        self.turn = IDENTITY if (position, turn) == (ZERO, UNTURNED) else Pose(turn, position)
        self._corners: tuple[Sequence[Vector], Sequence[Triangle]] | None = None
        self._moments: Moments | None = None

    def in_geom(self) -> Pose | None:
        """Return T_geom_file without the scale, or None if no pose and scale together say it.

        MuJoCo subtracts `refpos`, turns back by `refquat`, and scales what that gives.
        """
        if self.turn is IDENTITY:
            return IDENTITY
        a, b, c = self.scale
        inverse = self.turn.inverse()
        if self.turn.rotation == UNTURNED or a == b == c:
            x, y, z = inverse.position
            return Pose(inverse.rotation, (a * x, b * y, c * z))
        return None

    def filename(self) -> str:
        """Return what names its file in URDF."""
        return self._host.filename(self.path, self.thing.element.value_span("file"))

    # --- geometry ---

    def corners(self) -> tuple[Sequence[Vector], Sequence[Triangle]]:
        """Return its corners as MuJoCo places them before it centers the mesh, and its triangles.

        Raises:
            YamaroError: the file is not there, or cannot be read.
        """
        if self._corners is None:
            points, triangles = self._read()
            if self.turn is not IDENTITY:
                inverse = self.turn.inverse()
                points = [inverse.apply(point) for point in points]
            if self.scale != UNSCALED:
                a, b, c = self.scale
                points = [(x * a, y * b, z * c) for x, y, z in points]
                if a * b * c < 0:
                    triangles = [(i, k, j) for i, j, k in triangles]
            self._corners = points, triangles
        return self._corners

    def _read(self) -> tuple[Sequence[Vector], Sequence[Triangle]]:
        from array import array

        from ...meshes.formats import MeshFileError, MissingLibraryError

        given = self.thing.given
        if not self.path:
            flat = numbers(given, "vertex", 12, 1 << 24)
            faces = numbers(given, "face", 3, 1 << 24)
            if flat is None:
                raise fault(
                    f"the mass of the mesh '{self.name}' is not known: it is made by MuJoCo",
                    self.thing.span,
                    "give the body an <inertial>",
                )
            points = [*zip(flat[::3], flat[1::3], flat[2::3], strict=False)]
            if faces is None:
                from ...model.hull import hull

                return points, hull(points)
            whole = [*map(int, faces)]
            if not all(0 <= index < len(points) for index in whole):
                raise fault("a face has a vertex that is not there", given["face"][1], "from 0")
            return points, [*zip(whole[::3], whole[1::3], whole[2::3], strict=True)]
        span = self.thing.element.value_span("file")
        path = self._host.find(self.filename(), span)
        if path is None:
            raise failure(
                "missing-mesh",
                f"the mesh '{self.path}' is not found, but mass is computed from it",
                span,
                hint="a path starts at the folder of the main file and 'meshdir' of <compiler>",
            )
        try:
            mesh = self._host.mesh(path)
        except (MeshFileError, MissingLibraryError) as error:
            raise failure(
                "bad-mesh",
                f"the mesh '{self.path}' cannot be read: {error}",
                span,
                hint="MuJoCo reads binary STL, OBJ and MSH; give the body an <inertial>",
            ) from error
        single = array("f", [number for point in mesh.vertices for number in point])  # as MuJoCo
        points = [*zip(single[::3], single[1::3], single[2::3], strict=True)]
        return points, mesh.triangles

    def moments(self) -> Moments:
        """Return the mass of the mesh at density 1, by the method that it asks for."""
        if self._moments is None:
            points, triangles = self.corners()
            kind = chosen(self.thing.given, "inertia", (CONVEX, EXACT, LEGACY, SHELL), LEGACY)
            if kind == CONVEX:
                from ...model.hull import hull

                triangles = hull(points)
            found = moments_of(points, triangles, kind)
            if found is None:
                raise fault(
                    f"the mesh '{self.name}' encloses no volume, but mass is computed from it",
                    self.thing.span,
                    'write inertia="shell", or give the body an <inertial>',
                )
            self._moments = found
        return self._moments

    def axes(self) -> tuple[Pose, Vector]:
        """Return the pose in the geom along its principal axes, and half the edges of the box.

        The box has the same inertia; its longest edge is along z.
        """
        found = self.moments()
        values, turn = principal_axes(found.inertia)
        columns = [*zip(*turn, strict=True)]
        order = sorted(range(3), key=lambda i: -values[i])
        a, b, c = (values[i] for i in order)
        x, y = columns[order[0]], columns[order[1]]
        z = (
            x[1] * y[2] - x[2] * y[1],
            x[2] * y[0] - x[0] * y[2],
            x[0] * y[1] - x[1] * y[0],
        )
        rotation = ((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2]))
        size = found.size
        halves = (
            sqrt(max(6 * (b + c - a) / size, 0.0)) / 2,
            sqrt(max(6 * (a + c - b) / size, 0.0)) / 2,
            sqrt(max(6 * (a + b - c) / size, 0.0)) / 2,
        )
        return Pose(rotation, found.center), halves


def moments_of(
    points: Sequence[Vector], triangles: Iterable[Triangle], kind: str
) -> Moments | None:
    """Return the mass of a mesh at density 1; None if it encloses no volume, or has no area.

    The volume is the sum of pyramids from a point within to each triangle: signed, and in the
    legacy method each of them positive. That point is the centroid of the surface while the centre
    of mass is looked for, and then the centre of mass.

    Source: MuJoCo, user_mesh.cc; J. O'Rourke, Computational Geometry in C, 2nd edition, 1.3.8.
    """
    faces = []
    area = cx = cy = cz = 0.0
    for i, j, k in triangles:
        a, b, c = points[i], points[j], points[k]
        ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
        normal = (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)
        twice = hypot(*normal)
        middle = ((a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3)
        faces.append((a, b, c, normal, middle, twice / 2))
        area += twice / 2
        cx += twice / 2 * middle[0]
        cy += twice / 2 * middle[1]
        cz += twice / 2 * middle[2]
    if area < SMALLEST:
        return None
    ox, oy, oz = cx / area, cy / area, cz / area
    size, center = area, (ox, oy, oz)
    if kind != SHELL:
        size = x = y = z = 0.0
        for _, _, _, normal, middle, _ in faces:
            dx, dy, dz = middle[0] - ox, middle[1] - oy, middle[2] - oz
            part = (dx * normal[0] + dy * normal[1] + dz * normal[2]) / 6
            if kind == LEGACY:
                part = abs(part)
            size += part
            x += part * (ox + 0.75 * dx)
            y += part * (oy + 0.75 * dy)
            z += part * (oz + 0.75 * dz)
        if size < SMALLEST:
            return None
        center = (x / size, y / size, z / size)
    ox, oy, oz = center
    total = xx = xy = xz = yy = yz = zz = 0.0
    for a, b, c, normal, middle, part_area in faces:
        if kind == SHELL:
            part, factor = part_area, 1 / 12
        else:
            dx, dy, dz = middle[0] - ox, middle[1] - oy, middle[2] - oz
            part, factor = (dx * normal[0] + dy * normal[1] + dz * normal[2]) / 6, 1 / 20
            if kind == LEGACY:
                part = abs(part)
        total += part
        ax, ay, az = a[0] - ox, a[1] - oy, a[2] - oz
        bx, by, bz = b[0] - ox, b[1] - oy, b[2] - oz
        gx, gy, gz = c[0] - ox, c[1] - oy, c[2] - oz
        sx, sy, sz = ax + bx + gx, ay + by + gy, az + bz + gz
        weight = part * factor
        xx += weight * (ax * ax + bx * bx + gx * gx + sx * sx)
        xy += weight * (ax * ay + bx * by + gx * gy + sx * sy)
        xz += weight * (ax * az + bx * bz + gx * gz + sx * sz)
        yy += weight * (ay * ay + by * by + gy * gy + sy * sy)
        yz += weight * (ay * az + by * bz + gy * gz + sy * sz)
        zz += weight * (az * az + bz * bz + gz * gz + sz * sz)
    if kind != SHELL:
        size = total
    return Moments(
        size,
        center,
        ((yy + zz, -xy, -xz), (-xy, xx + zz, -yz), (-xz, -yz, xx + yy)),
    )
