"""Mesh files in the two formats that MuJoCo reads: binary STL, and OBJ of one material."""

from __future__ import annotations

from math import hypot
from struct import Struct, iter_unpack

from ...meshes.encoding import obj_of, obj_of_triangles, stl_of
from ...meshes.formats import (
    NO_TRIANGLES,
    OBJ,
    STL,
    STL_HEADER_BYTES,
    MeshFileError,
    is_binary_stl,
)
from ...sandbox.jail.protocol import pack, unpack

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ...meshes.surfaces import Surface
    from ...model.link import Color
    from ..mesh_contents import MeshContents

    Point = tuple[float, float, float]

MOST_FACETS = 200_000
"""Triangles of an STL that MuJoCo reads."""
FLAT = 1e-6
"""What is nearer to a plane than this part of its size is in it."""
_MATERIAL_WORDS = (b"mtllib", b"usemtl")


class FlatMeshError(MeshFileError):
    """A mesh has no convex hull."""


class Part:
    """A file of a mesh, and how what is in it looks.

    Attributes:
        data: the file.
        ending: of its name.
        color: its colour, or None if the mesh says nothing of it.
        texture: a PNG, or None.
        is_mixed: whether the colour is the mean of those of its corners.
    """

    __slots__ = ("color", "data", "ending", "is_mixed", "texture")

    def __init__(self, data: bytes, ending: str) -> None:
        self.data = data
        self.ending = ending
        self.color: Color | None = None
        self.texture: bytes | None = None
        self.is_mixed = False


def visual_parts(contents: MeshContents, path: str) -> list[Part]:
    """Return a mesh to be seen, in a part for each colour and texture.

    Raises:
        MeshFileError, MissingLibraryError: see `MeshContents.surfaces_of`.
    """
    kept = _kept(contents, path)
    if kept is not None and not _has_materials(kept):
        return [kept]
    converted = contents.kept(path, "mjcf visual", lambda: _packed(_visual_parts(contents, path)))
    return _unpacked(converted)


def _visual_parts(contents: MeshContents, path: str) -> list[Part]:
    groups: dict[object, list[Surface]] = {}
    for surface in contents.surfaces_of(path):
        mixed = None if surface.point_colors is None else id(surface)
        key = (surface.color, None if surface.texture is None else id(surface.texture), mixed)
        groups.setdefault(key, []).append(surface)
    return [_part(surfaces) for surfaces in groups.values()]


def collision_part(contents: MeshContents, path: str) -> list[Part]:
    """Return a mesh to collide with, in one part.

    Raises:
        FlatMeshError: all its corners are in a plane, so that it has no convex hull.
        MeshFileError, MissingLibraryError: see `MeshContents.surfaces_of`.
    """
    part = _kept(contents, path)
    if part is None:
        part = Part(
            contents.kept(path, "mjcf collision", lambda: obj_of(contents.surfaces_of(path))),
            ".obj",
        )
    if is_flat(points_of(part)):
        raise FlatMeshError("all its corners are in a plane")
    return [part]


def _kept(contents: MeshContents, path: str) -> Part | None:
    """Return an STL or OBJ as it is, a text STL as binary one; None for other formats.

    MuJoCo takes no STL of more than `MOST_FACETS`, so that such a one becomes an OBJ.
    """
    kind = contents.format_of(path)
    data = contents.bytes_of(path)
    if kind == OBJ:
        return Part(data, ".obj")
    if kind != STL:
        return None
    count = int.from_bytes(data[80:84], "little") if is_binary_stl(data) else None
    if count is not None and 0 < count <= MOST_FACETS:
        return Part(data, ".stl")
    (part,) = _unpacked(contents.kept(path, "mjcf stl", lambda: _packed([_rewritten(data)])))
    return part


def _rewritten(data: bytes) -> Part:
    """Return an STL as binary one, or as OBJ if it has too many triangles."""
    from ...meshes.triangles import read_stl

    mesh = read_stl(data)
    if not mesh.triangles:
        raise MeshFileError(NO_TRIANGLES)
    if len(mesh.triangles) > MOST_FACETS:
        return Part(obj_of_triangles(mesh), ".obj")
    return Part(stl_of(mesh), ".stl")


def points_of(part: Part) -> Iterator[Point]:
    """Yield the corners of a part, one after the other."""
    if part.ending == ".stl":
        for corners in iter_unpack("<12x9f2x", memoryview(part.data)[STL_HEADER_BYTES:]):
            x, y, z, *others = corners
            yield (x, y, z)
            yield (others[0], others[1], others[2])
            yield (others[3], others[4], others[5])
        return
    for line in part.data.splitlines():
        words = line.split()
        if len(words) >= 4 and words[0] == b"v":
            yield (float(words[1]), float(words[2]), float(words[3]))


def is_flat(points: Iterator[Point]) -> bool:
    """Return whether all points are in one plane; of most meshes it looks at a few."""
    try:
        origin = next(points, None)
        if origin is None:
            return True
        first: Point | None = None
        normal: Point | None = None
        for point in points:
            way = _minus(point, origin)
            size = hypot(*way)
            if first is None:
                first = way if size else None
            elif normal is None:
                across = _cross(first, way)
                normal = across if hypot(*across) > FLAT * hypot(*first) * size else None
            elif abs(_dot(normal, way)) > FLAT * hypot(*normal) * max(size, hypot(*first)):
                return False
    except ValueError:  # what is not a number is for MuJoCo to say
        return False
    return True


def _minus(a: Point, b: Point) -> Point:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _cross(a: Point, b: Point) -> Point:
    x, y, z = a
    u, v, w = b
    return (y * w - z * v, z * u - x * w, x * v - y * u)


def _dot(a: Point, b: Point) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _has_materials(part: Part) -> bool:
    return part.ending == ".obj" and any(word in part.data for word in _MATERIAL_WORDS)


def _part(surfaces: list[Surface]) -> Part:
    """Return surfaces that look the same."""
    first = surfaces[0]
    has_texture = first.texture is not None and first.texture_points is not None
    part = Part(obj_of(surfaces, has_texture=has_texture), ".obj")
    if has_texture:
        from ...meshes.encoding import encoded

        assert first.texture is not None
        part.texture = encoded(first.texture)
    elif first.point_colors is not None:
        mean = (first.point_colors.mean(axis=0) / 255).round(6).tolist()
        part.color = (mean[0], mean[1], mean[2], mean[3])
        part.is_mixed = bool((first.point_colors != first.point_colors[0]).any())
    elif first.color is not None:
        red, green, blue, alpha = first.color
        part.color = (round(red, 6), round(green, 6), round(blue, 6), round(alpha, 6))
    return part


# --- in the cache -------------------------------------------------------------------------------

_COLOR = Struct("<4d")


def _packed(parts: list[Part]) -> bytes:
    """Return parts as bytes."""
    return pack(
        [
            pack(
                [
                    part.data,
                    part.ending.encode(),
                    b"" if part.color is None else _COLOR.pack(*part.color),
                    part.texture or b"",
                    b"mixed" if part.is_mixed else b"",
                ]
            )
            for part in parts
        ]
    )


def _unpacked(data: bytes) -> list[Part]:
    """Return the parts that `_packed` made bytes of."""
    parts = []
    for each in unpack(data):
        content, ending, color, texture, mixed = unpack(each)
        part = Part(content, ending.decode())
        if color:
            red, green, blue, alpha = _COLOR.unpack(color)
            part.color = (red, green, blue, alpha)
        part.texture = texture or None
        part.is_mixed = bool(mixed)
        parts.append(part)
    return parts
