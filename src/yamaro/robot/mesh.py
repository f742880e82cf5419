"""Triangle meshes: reading them from files, and the integrals over the body they enclose.

STL (binary and ASCII) and OBJ are read here, without any library; other formats through trimesh.
"""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from typing import Any, TypeVar

    from .transforms import Vector

    T = TypeVar("T")

MESH_ENDINGS = (
    "stl", "dae", "obj", "glb", "gltf", "ply", "off", "3mf", "3ds", "fbx", "x3d", "wrl",
    "mesh", "msh", "step", "stp", "usd", "usda", "usdc", "usdz",
)  # fmt: skip
"""File endings by which a geometry is taken for a mesh, in lower case."""

TRIMESH_ENDINGS = frozenset(("dae", "glb", "gltf", "ply", "off", "3mf"))

LARGEST_FILE = 1 << 30
"""Bytes of a mesh that is read: as objects of Python it takes many times as much memory."""

STL_HEADER_BYTES = 84
STL_FACET_BYTES = 50
MERGE_FRACTION = 1e-7
"""Vertices nearer than this part of the mesh's size are the same one: the step of a float32."""


class MeshFileError(Exception):
    """A mesh file cannot be read; the text says why."""


class MissingLibraryError(Exception):
    """A mesh file needs a library that is not installed; the text names the library."""


class TriangleMesh:
    """Corners of triangles, in metres as the file has them, and the triangles as index triples."""

    __slots__ = ("triangles", "vertices")

    def __init__(
        self, vertices: Sequence[Vector], triangles: Sequence[tuple[int, int, int]]
    ) -> None:
        """Hold the mesh; a triangle's corners run counterclockwise as seen from outside."""
        self.vertices = vertices
        self.triangles = triangles


class SolidMoments:
    """Volume integrals of the body that a mesh encloses, for density 1.

    Attributes:
        volume: ∫ dV, in m³, never negative.
        first: ∫ x dV, three numbers, in m⁴.
        second: ∫ x·xᵀ dV as xx, xy, xz, yy, yz, zz, in m⁵.
    """

    __slots__ = ("first", "second", "volume")

    def __init__(self, volume: float, first: Vector, second: tuple[float, ...]) -> None:
        """Hold the integrals."""
        self.volume = volume
        self.first = first
        self.second = second

    def scaled(self, scale: Vector) -> SolidMoments:
        """Return the integrals of the body stretched along its axes; a mirrored body has volume."""
        sx, sy, sz = scale
        factor = abs(sx * sy * sz)
        x, y, z = self.first
        pairs = (sx * sx, sx * sy, sx * sz, sy * sy, sy * sz, sz * sz)
        return SolidMoments(
            factor * self.volume,
            (factor * sx * x, factor * sy * y, factor * sz * z),
            tuple(factor * p * s for p, s in zip(pairs, self.second, strict=True)),
        )

    def center(self) -> Vector:
        """Return the centre of mass of the homogeneous body, in metres."""
        x, y, z = self.first
        return (x / self.volume, y / self.volume, z / self.volume)


def solid_moments(mesh: TriangleMesh) -> SolidMoments:
    """Return the volume integrals of a closed mesh, summed over tetrahedra.

    Every triangle a, b, c makes a tetrahedron with a point o near the mesh. With d = a·(b × c),
    relative to o, and s = a + b + c: ∫dV = d/6, ∫x dV = d/24·s, and
    ∫x·xᵀ dV = d/120·(a·aᵀ + b·bᵀ + c·cᵀ + s·sᵀ). A mesh turned inside out gives the same body.

    Source: J. Blow and A. J. Binstock, How to find the inertia tensor (or other mass properties)
    of a 3D solid body represented by a triangle mesh, 2004.
    """
    ox, oy, oz = _middle(mesh.vertices)
    points = [(x - ox, y - oy, z - oz) for x, y, z in mesh.vertices]
    volume = mx = my = mz = xx = xy = xz = yy = yz = zz = 0.0
    for i, j, k in mesh.triangles:
        ax, ay, az = points[i]
        bx, by, bz = points[j]
        cx, cy, cz = points[k]
        d = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        sx, sy, sz = ax + bx + cx, ay + by + cy, az + bz + cz
        volume += d
        mx += d * sx
        my += d * sy
        mz += d * sz
        xx += d * (ax * ax + bx * bx + cx * cx + sx * sx)
        xy += d * (ax * ay + bx * by + cx * cy + sx * sy)
        xz += d * (ax * az + bx * bz + cx * cz + sx * sz)
        yy += d * (ay * ay + by * by + cy * cy + sy * sy)
        yz += d * (ay * az + by * bz + cy * cz + sy * sz)
        zz += d * (az * az + bz * bz + cz * cz + sz * sz)
    sign = -1.0 if volume < 0 else 1.0
    second = (xx, xy, xz, yy, yz, zz)
    return _moved(
        sign * volume / 6,
        (sign * mx / 24, sign * my / 24, sign * mz / 24),
        tuple(sign * value / 120 for value in second),
        (ox, oy, oz),
    )


def _middle(vertices: Sequence[Vector]) -> Vector:
    """Return the middle of the bounding box; far from the origin the sums would lose digits."""
    lows = [min(axis) for axis in zip(*vertices, strict=True)]
    highs = [max(axis) for axis in zip(*vertices, strict=True)]
    x, y, z = ((low + high) / 2 for low, high in zip(lows, highs, strict=True))
    return (x, y, z)


def _moved(volume: float, first: Vector, second: tuple[float, ...], offset: Vector) -> SolidMoments:
    """Return integrals that were taken about `offset`, about the origin (parallel axes)."""
    mx, my, mz = first
    ox, oy, oz = offset
    xx, xy, xz, yy, yz, zz = second
    return SolidMoments(
        volume,
        (mx + volume * ox, my + volume * oy, mz + volume * oz),
        (
            xx + 2 * ox * mx + volume * ox * ox,
            xy + ox * my + oy * mx + volume * ox * oy,
            xz + ox * mz + oz * mx + volume * ox * oz,
            yy + 2 * oy * my + volume * oy * oy,
            yz + oy * mz + oz * my + volume * oy * oz,
            zz + 2 * oz * mz + volume * oz * oz,
        ),
    )


def is_closed(mesh: TriangleMesh) -> bool:
    """Tell whether the surface has no border, so that it encloses a body.

    That is so when every edge is run along as often one way as the other: then, and only then,
    the volume integrals do not depend on where the origin is.
    """
    forth: list[tuple[int, int]] = []
    back: list[tuple[int, int]] = []
    for i, j, k in mesh.triangles:
        for start, end in ((i, j), (j, k), (k, i)):
            if start < end:
                forth.append((start, end))
            elif end < start:
                back.append((end, start))
    if len(forth) != len(back):
        return False
    forth.sort()
    back.sort()
    return forth == back


# --- reading ----------------------------------------------------------------------------------


def read_mesh(path: str) -> TriangleMesh:
    """Return the mesh in the file, corners at the same place made one.

    Raises:
        MeshFileError: the file cannot be opened, or is not what its ending says.
        MissingLibraryError: the format needs trimesh, or what trimesh needs for it.
    """
    mesh = read_by(_read, path)
    if not mesh.triangles:
        raise MeshFileError("it has no triangles")
    return mesh if is_closed(mesh) else _snapped(mesh)


def read_by(read: Callable[[str, str], T], path: str) -> T:
    """Return what `read` makes of a mesh file, given its path and ending.

    Raises:
        MeshFileError: no format has this ending, or the file cannot be opened, or is too large.
    """
    ending = mesh_ending(path)
    if ending not in ("stl", "obj") and ending not in TRIMESH_ENDINGS:
        raise MeshFileError(f"no reader for '.{ending}' files")
    try:
        if os.path.getsize(path) > LARGEST_FILE:
            raise MeshFileError(f"it is larger than {LARGEST_FILE >> 20} MB")
        return read(path, ending)
    except OSError as error:
        raise MeshFileError(error.strerror or str(error)) from error
    except MemoryError as error:
        raise MeshFileError("there is not enough memory for it") from error


def mesh_ending(filename: str) -> str:
    """Return the file ending in lower case without its dot, or an empty string."""
    name = filename.replace("\\", "/").rpartition("/")[2]
    return name.rpartition(".")[2].lower() if "." in name else ""


def _read(path: str, ending: str) -> TriangleMesh:
    if ending not in ("stl", "obj"):
        return _read_with_trimesh(path)
    with open(path, "rb") as file:
        data = file.read()
    if ending == "obj":
        return _parse_obj(data)
    if len(data) >= STL_HEADER_BYTES:
        count = int.from_bytes(data[80:84], "little")
        if len(data) == STL_HEADER_BYTES + STL_FACET_BYTES * count:
            return _parse_binary_stl(data)
    if data.lstrip()[:5].lower() == b"solid":
        return _parse_ascii_stl(data)
    raise MeshFileError("it is no STL file, or it is cut off")


def _merged(corners: Iterable[Vector]) -> TriangleMesh:
    """Return a mesh of corners, three to a triangle, those at the same place made one."""
    indices: dict[Vector, int] = {}
    order = [indices.setdefault(corner, len(indices)) for corner in corners]
    return TriangleMesh(
        list(indices), list(zip(order[0::3], order[1::3], order[2::3], strict=True))
    )


def _snapped(mesh: TriangleMesh) -> TriangleMesh:
    """Return the mesh with corners made one that only rounding keeps apart."""
    spans = [max(axis) - min(axis) for axis in zip(*mesh.vertices, strict=True)]
    step = MERGE_FRACTION * max(spans)
    if not step > 0:
        return mesh
    places: dict[tuple[int, int, int], int] = {}
    targets = []
    for index, (x, y, z) in enumerate(mesh.vertices):
        place = (round(x / step), round(y / step), round(z / step))
        targets.append(places.setdefault(place, index))
    triangles = [(targets[i], targets[j], targets[k]) for i, j, k in mesh.triangles]
    return TriangleMesh(mesh.vertices, triangles)


def _parse_binary_stl(data: bytes) -> TriangleMesh:
    from itertools import chain
    from struct import iter_unpack

    facets = iter_unpack("<12x9f2x", memoryview(data)[STL_HEADER_BYTES:])
    numbers = list(chain.from_iterable(facets))
    _check_finite(numbers)
    return _merged(zip(numbers[0::3], numbers[1::3], numbers[2::3], strict=True))


def _parse_ascii_stl(data: bytes) -> TriangleMesh:
    words = data.lower().split()
    places = [place for place, word in enumerate(words) if word == b"vertex"]
    try:
        numbers = [float(words[place + axis]) for place in places for axis in (1, 2, 3)]
    except (ValueError, IndexError) as error:
        raise MeshFileError("a vertex of the ASCII STL is not three numbers") from error
    if len(places) % 3:
        raise MeshFileError("the ASCII STL has a facet without three vertices")
    _check_finite(numbers)
    return _merged(zip(numbers[0::3], numbers[1::3], numbers[2::3], strict=True))


def _parse_obj(data: bytes) -> TriangleMesh:
    """Read the vertices and faces of a Wavefront OBJ; polygons are cut into fans."""
    vertices: list[Vector] = []
    corners: list[Vector] = []
    try:
        for line in data.replace(b"\\\n", b" ").splitlines():
            words = line.partition(b"#")[0].split()
            if not words:
                continue
            if words[0] == b"v":
                vertices.append((float(words[1]), float(words[2]), float(words[3])))
            elif words[0] == b"f":
                face = [_obj_vertex(word, vertices) for word in words[1:]]
                for place in range(1, len(face) - 1):
                    corners += (face[0], face[place], face[place + 1])
    except (ValueError, IndexError) as error:
        raise MeshFileError("a line of the OBJ file cannot be read") from error
    _check_finite(number for vertex in vertices for number in vertex)
    return _merged(corners)


def _obj_vertex(word: bytes, vertices: list[Vector]) -> Vector:
    """Return the vertex of `7`, `7/1/3` or `-1`: counted from 1, or back from the last."""
    index = int(word.partition(b"/")[0])
    if index == 0 or index < -len(vertices):
        raise IndexError(index)
    return vertices[index - 1 if index > 0 else index]


def _check_finite(numbers: Iterable[float]) -> None:
    # The sum of finite numbers can overflow, but not for coordinates that mean anything.
    total = sum(numbers)
    if total - total != 0:
        raise MeshFileError("a coordinate is not a finite number")


def _read_with_trimesh(path: str) -> TriangleMesh:
    """Read a scene through trimesh: every body at its place, in metres."""
    try:
        import trimesh

        scene: Any = trimesh.load_scene(path, process=False)
        factor = metres(scene)
        body = scene.to_mesh()
    except ImportError as error:
        raise MissingLibraryError(error.name or str(error)) from error
    except OSError:
        raise
    except Exception as error:
        raise MeshFileError(f"trimesh cannot read it: {error}") from error
    vertices = [(x * factor, y * factor, z * factor) for x, y, z in body.vertices.tolist()]
    _check_finite(number for vertex in vertices for number in vertex)
    return _merged(vertices[index] for face in body.faces.tolist() for index in face)


def metres(scene: Any) -> float:
    """Return the length of the file's unit: COLLADA and 3MF name theirs, others are in metres."""
    units = getattr(scene, "units", None)
    if not units:
        return 1.0
    from trimesh.units import unit_conversion

    return float(unit_conversion(units, "meters"))
