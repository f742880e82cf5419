"""Triangle meshes: reading them from files.

STL (binary and ASCII) and OBJ are read here, without any library; other formats through trimesh.
"""

from __future__ import annotations

from ..files.regular import open_regular, read_start
from .formats import (
    LARGEST_FILE,
    NO_TRIANGLES,
    OBJ,
    STL,
    STL_HEADER_BYTES,
    MeshFileError,
    MissingLibraryError,
    is_binary_stl,
    mesh_format,
    unreadable,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from typing import TypeVar

    Vector = tuple[float, float, float]
    T = TypeVar("T")

LARGEST_MESH_MEASURED = 100 << 20
"""Bytes of a mesh that is read only to measure its size."""
LARGEST_TEXT_MEASURED = 20 << 20
"""The same for a mesh in text, which takes longer."""

MERGE_FRACTION = 1e-7
"""Vertices nearer than this part of the mesh's size are the same one: the step of a float32."""


class TriangleMesh:
    """Corners of triangles, in metres as the file has them, and the triangles as index triples."""

    __slots__ = ("triangles", "vertices")

    def __init__(
        self, vertices: Sequence[Vector], triangles: Sequence[tuple[int, int, int]]
    ) -> None:
        """Hold the mesh; a triangle's corners run counterclockwise as seen from outside."""
        self.vertices = vertices
        self.triangles = triangles


def joined(meshes: Iterable[TriangleMesh]) -> TriangleMesh:
    """Return meshes as one, in which corners at the same point are one."""
    return _merged(
        mesh.vertices[index] for mesh in meshes for each in mesh.triangles for index in each
    )


def is_closed(mesh: TriangleMesh) -> bool:
    """Return whether the surface has no border, so that it encloses a body.

    That is so when every edge is run along as often one way as the other: then, and only then,
    the volume integrals do not depend on where the origin is.
    """
    forth: list[int] = []
    back: list[int] = []
    row = len(mesh.vertices)  # numbers for edges: a million take a third of the time of pairs
    for i, j, k in mesh.triangles:
        for start, end in ((i, j), (j, k), (k, i)):
            if start < end:
                forth.append(start * row + end)
            elif end < start:
                back.append(end * row + start)
    if len(forth) != len(back):
        return False
    forth.sort()
    back.sort()
    return forth == back


# --- reading ----------------------------------------------------------------------------------


def read_mesh(
    path: str, allows: Callable[[str], bool] | None = None, *, snaps: bool = True
) -> TriangleMesh:
    """Return the mesh in the file, corners at the same point merged.

    Args:
        path: the file.
        allows: whether another file that this one names may be read, such as the buffer of
            a glTF; None allows all.
        snaps: whether corners that only rounding keeps apart are merged where the mesh is open.

    Raises:
        MeshFileError: the file cannot be opened, or has no format that is read.
        MissingLibraryError: the format needs trimesh, or what trimesh needs for it.
    """

    def read(data: bytes, kind: str, path: str) -> TriangleMesh:
        if kind == STL:
            return read_stl(data)
        return _parse_obj(data) if kind == OBJ else _through_library(data, kind, path, allows)

    mesh = read_by(read, path)
    if not mesh.triangles:
        raise MeshFileError(NO_TRIANGLES)
    return mesh if not snaps or is_closed(mesh) else _snapped(mesh)


def read_by(read: Callable[[bytes, str, str], T], path: str) -> T:
    """Read a mesh file with `read`, which takes its bytes, format and path.

    Raises:
        MeshFileError: its bytes have no format that is read, or it cannot be opened, or is too
            large.
    """
    try:
        data = read_start(path, LARGEST_FILE + 1)
        if len(data) > LARGEST_FILE:
            raise MeshFileError(f"it is larger than {LARGEST_FILE >> 20} MB")
        kind = mesh_format(data)
        if kind is None:
            raise unreadable(path)
        return read(data, kind, path)
    except OSError as error:
        raise MeshFileError(error.strerror or str(error)) from error
    except MemoryError as error:
        raise MeshFileError("there is not enough memory for it") from error


def _through_library(
    data: bytes, kind: str, path: str, allows: Callable[[str], bool] | None
) -> TriangleMesh:
    try:
        from .library import read_bodies
    except ImportError as error:
        raise MissingLibraryError(error.name or str(error)) from error

    corners: list[Vector] = []
    for body in read_bodies(data, kind, path, allows):
        points: list[Vector] = [(x, y, z) for x, y, z in body.points.tolist()]
        _check_finite(number for point in points for number in point)
        corners.extend(points[index] for triangle in body.triangles.tolist() for index in triangle)
    return _merged(corners)


def read_stl(data: bytes) -> TriangleMesh:
    """Return the mesh in the bytes of an STL, binary or text."""
    return _parse_binary_stl(data) if is_binary_stl(data) else _parse_ascii_stl(data)


def _merged(corners: Iterable[Vector]) -> TriangleMesh:
    """Return a mesh of corners, three to a triangle, those at the same point merged."""
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
    numbers = _binary_stl_numbers(data)
    _check_finite(numbers)
    return _merged(zip(numbers[0::3], numbers[1::3], numbers[2::3], strict=True))


def _binary_stl_numbers(data: bytes) -> list[float]:
    """Return x, y and z of all corners in turn."""
    from itertools import chain
    from struct import iter_unpack

    facets = iter_unpack("<12x9f2x", memoryview(data)[STL_HEADER_BYTES:])
    return list(chain.from_iterable(facets))


def mesh_extent(path: str, scale: tuple[float, ...]) -> float | None:
    """Return the longest side of the bounding box of an STL or OBJ in metres, scaled.

    None for other files, for one without corners, and for one of more than `LARGEST_MESH_MEASURED`
    bytes, or `LARGEST_TEXT_MEASURED` if it is text.
    """
    import os
    from math import isfinite

    if not path.lower().endswith((".stl", ".obj")):
        return None
    try:
        with open_regular(path) as file:
            if os.fstat(file.fileno()).st_size > LARGEST_MESH_MEASURED:
                return None
            data = file.read()
    except OSError:
        return None
    numbers = _binary_stl_numbers(data) if is_binary_stl(data) else _corners_in_text(data)
    if not numbers or not all(map(isfinite, numbers)):
        return None
    axes = [numbers[axis::3] for axis in range(3)]
    return max((max(axis) - min(axis)) * abs(scale[i]) for i, axis in enumerate(axes))


def _corners_in_text(data: bytes) -> list[float]:
    """Return x, y and z of all corners of an OBJ or ASCII STL; none if one cannot be read."""
    import re

    if len(data) > LARGEST_TEXT_MEASURED:
        return []
    corner = rb"(?im)^[ \t]*v(?:ertex)?[ \t]+(\S+)[ \t]+(\S+)[ \t]+(\S+)"
    try:
        return [float(word) for found in re.findall(corner, data) for word in found]
    except ValueError:
        return []


def _parse_ascii_stl(data: bytes) -> TriangleMesh:
    words = data.lower().split()
    indices = [index for index, word in enumerate(words) if word == b"vertex"]
    try:
        numbers = [float(words[index + axis]) for index in indices for axis in (1, 2, 3)]
    except (ValueError, IndexError) as error:
        raise MeshFileError("a vertex of the ASCII STL is not three numbers") from error
    if len(indices) % 3:
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
                for index in range(1, len(face) - 1):
                    corners += (face[0], face[index], face[index + 1])
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
