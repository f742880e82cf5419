"""Meshes: where the file of each is, how it is scaled and turned, and the mass that it encloses."""

from __future__ import annotations

import os
from math import hypot, isfinite, sqrt

from ...diagnostics import failure
from ...model.hull import hull
from ...model.pose import IDENTITY, UNTURNED, ZERO, Pose, multiply, transposed
from .compiler import SMALLEST, chosen, fault, numbers, vector

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ...model.pose import Rotation, Vector
    from ...source import Span
    from ..host import Host
    from .tree import Thing

    Triangle = tuple[int, int, int]

LEGACY, EXACT, CONVEX, SHELL = "legacy", "exact", "convex", "shell"
ALIGNED = 1e-7
"""Products of inertia below this part of the largest moment do not turn a mesh."""
MOST_TURNS = 500
_PLANES = ((1, 2), (0, 2), (0, 1))
UNSCALED = (1.0, 1.0, 1.0)
NOT_OF_FILES = frozenset(("maxhullvert", "smoothnormal"))
"""What a mesh says that no file has, and no model."""


class UnknownMassError(Exception):
    """Only MuJoCo knows the mass of a mesh.

    Attributes:
        reason: why.
        span: where the mesh is written.
    """

    def __init__(self, reason: str, span: Span) -> None:
        super().__init__(reason)
        self.reason = reason
        self.span = span


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
            self.name = thing.context.named(stem, thing.kind)
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
        return self._host.filename(self.path, self.thing.where("file"))

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
                reason = f"MuJoCo makes the mesh '{self.name}'"
                raise UnknownMassError(reason, self.thing.span)
            single = array("f", flat)
            inline = [*zip(single[::3], single[1::3], single[2::3], strict=False)]
            if faces is None:
                return inline, hull(inline)
            whole = [*map(int, faces)]
            if not all(0 <= index < len(inline) for index in whole):
                raise fault("a face has a vertex that is not there", given["face"][1], "from 0")
            return inline, [*zip(whole[::3], whole[1::3], whole[2::3], strict=True)]
        span = self.thing.where("file")
        path = self._host.find(self.filename(), span)
        if path is None:
            raise failure(
                "missing-mesh",
                f"the mesh '{self.path}' is not found, but mass is computed from it",
                span,
                hint="a path starts at the folder of the main file and 'meshdir' of <compiler>",
            )
        try:
            points, triangles = self._in_file(path)
        except (MeshFileError, MissingLibraryError) as error:
            raise failure(
                "bad-mesh",
                f"the mesh '{self.path}' cannot be read: {error}",
                span,
                hint="MuJoCo reads binary STL, OBJ and MSH; give the body an <inertial>",
            ) from error
        single = array("f", [number for point in points for number in point])  # as MuJoCo
        return [*zip(single[::3], single[1::3], single[2::3], strict=True)], triangles

    def _in_file(self, path: str) -> tuple[Sequence[Vector], Sequence[Triangle]]:
        """Return the corners and triangles of a file; those of the hull if it has no triangles."""
        from ...meshes.formats import NO_TRIANGLES, MeshFileError

        if path.lower().endswith(".msh"):
            return _of_msh(self._host.data(path))
        try:
            mesh = self._host.mesh(path)
        except MeshFileError as error:
            if str(error) != NO_TRIANGLES or not path.lower().endswith(".obj"):
                raise
            words = [line.split() for line in self._host.data(path).splitlines()]
            lines = [each[1:4] for each in words if len(each) >= 4 and each[0] == b"v"]
            points = [(float(x), float(y), float(z)) for x, y, z in lines]
            return points, hull(points)
        return mesh.vertices, mesh.triangles

    def moments(self) -> Moments:
        """Return the mass of the mesh at density 1, by the method that it asks for."""
        if self._moments is None:
            points, triangles = self.corners()
            kind = chosen(self.thing.given, "inertia", (CONVEX, EXACT, LEGACY, SHELL), LEGACY)
            if kind == CONVEX:
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

    def axes(self) -> tuple[Pose, Vector, Vector]:
        """Return the pose in the geom along its principal axes, half the edges of a box, moments.

        The box has the same inertia; its longest edge is along z. The moments are for 1 kg.
        """
        found = self.moments()
        (a, b, c), rotation = aligned(found.inertia)
        size = found.size
        halves = (
            sqrt(max(6 * (b + c - a) / size, 0.0)) / 2,
            sqrt(max(6 * (a + c - b) / size, 0.0)) / 2,
            sqrt(max(6 * (a + b - c) / size, 0.0)) / 2,
        )
        return Pose(rotation, found.center), halves, (a / size, b / size, c / size)


def _of_msh(data: bytes) -> tuple[Sequence[Vector], Sequence[Triangle]]:
    """Return the corners and triangles of a file in MuJoCo's own format.

    Four counts (of corners, normals, texture points, triangles) are before rows of float32 and, of
    the triangles, int32. Source: MuJoCo's manual, "Legacy MSH file format".
    """
    from array import array
    from struct import Struct

    from ...meshes.formats import MeshFileError

    head = Struct("<4i")
    if len(data) < head.size:
        raise MeshFileError("it has no head")
    corners, normals, texture, faces = head.unpack_from(data)
    size = head.size + 12 * (corners + normals + faces) + 8 * texture
    if min(corners, normals, texture, faces) < 0 or len(data) != size:
        raise MeshFileError("its size is not that of its counts")
    flat = array("f", data[head.size : head.size + 12 * corners])
    rows = array("i", data[size - 12 * faces :])
    points = [*zip(flat[::3], flat[1::3], flat[2::3], strict=True)]
    if rows and not 0 <= min(rows) <= max(rows) < corners:
        raise MeshFileError("a triangle has a corner that is not there")
    if not all(isfinite(number) for number in flat):
        raise MeshFileError("a coordinate is not a finite number")
    return points, [*zip(rows[::3], rows[1::3], rows[2::3], strict=True)] or hull(points)


def aligned(inertia: Rotation) -> tuple[Vector, Rotation]:
    """Return the moments and axes along which MuJoCo turns a mesh, the largest moment first.

    It turns in the plane of the largest product of inertia until that is below `ALIGNED` of the
    largest moment; what is left is not part of the model. Found by compiling meshes; the method is
    Jacobi's: G. H. Golub and C. F. Van Loan, Matrix Computations, 4th edition, 8.5.
    """
    turn = UNTURNED
    least = ALIGNED * max(abs(each) for line in inertia for each in line)
    found = inertia
    for _ in range(MOST_TURNS):
        found = multiply(multiply(transposed(turn), inertia), turn)
        row, column = max(_PLANES, key=lambda plane: abs(found[plane[0]][plane[1]]))
        product = found[row][column]
        if abs(product) <= least:
            break
        ratio = (found[column][column] - found[row][row]) / (2 * product)
        tangent = (1.0 if ratio >= 0 else -1.0) / (abs(ratio) + sqrt(1 + ratio * ratio))
        cosine = 1 / sqrt(1 + tangent * tangent)
        sine = tangent * cosine
        step = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        step[row][row] = step[column][column] = cosine
        step[row][column], step[column][row] = sine, -sine
        (a, b, c), (d, e, f), (g, h, i) = step
        turn = multiply(turn, ((a, b, c), (d, e, f), (g, h, i)))
    moments = (found[0][0], found[1][1], found[2][2])
    columns = transposed(turn)
    first, second, third = sorted(range(3), key=lambda axis: -moments[axis])
    x, y = columns[first], columns[second]
    z = (x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0])
    return (moments[first], moments[second], moments[third]), transposed((x, y, z))


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
