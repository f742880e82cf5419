"""Mesh files in the two formats that MuJoCo reads: binary STL, and OBJ of one material."""

from __future__ import annotations

from ...meshes.formats import OBJ, STL, MeshFileError, is_binary_stl
from ...meshes.obj import obj_of, stl_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...meshes.surfaces import Surface
    from ...model.link import Color
    from ..mesh_contents import MeshContents

_MATERIAL_WORDS = (b"mtllib", b"usemtl")


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
    groups: dict[object, list[Surface]] = {}
    for surface in contents.surfaces_of(path):
        mixed = None if surface.point_colors is None else id(surface)
        key = (surface.color, None if surface.texture is None else id(surface.texture), mixed)
        groups.setdefault(key, []).append(surface)
    return [_part(surfaces) for surfaces in groups.values()]


def collision_part(contents: MeshContents, path: str) -> list[Part]:
    """Return a mesh to collide with, in one part.

    Raises:
        MeshFileError, MissingLibraryError: see `MeshContents.surfaces_of`.
    """
    return [_kept(contents, path) or Part(obj_of(contents.surfaces_of(path)), ".obj")]


def _kept(contents: MeshContents, path: str) -> Part | None:
    """Return an STL or OBJ as it is, a text STL as binary one; None for other formats."""
    kind = contents.format_of(path)
    data = contents.bytes_of(path)
    if kind == OBJ:
        return Part(data, ".obj")
    if kind != STL:
        return None
    if is_binary_stl(data):
        return Part(data, ".stl")
    from ...meshes.triangles import read_stl

    mesh = read_stl(data)
    if not mesh.triangles:
        raise MeshFileError("it has no triangles")
    return Part(stl_of(mesh), ".stl")


def _has_materials(part: Part) -> bool:
    return part.ending == ".obj" and any(word in part.data for word in _MATERIAL_WORDS)


def _part(surfaces: list[Surface]) -> Part:
    """Return surfaces that look the same."""
    first = surfaces[0]
    has_texture = first.texture is not None and first.texture_points is not None
    part = Part(obj_of(surfaces, has_texture=has_texture), ".obj")
    if has_texture:
        from ...meshes.images import encoded

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
