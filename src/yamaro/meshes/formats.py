"""The formats of meshes and images that are read, recognized by their bytes and not their names."""

from __future__ import annotations

STL, OBJ, DAE, GLTF, GLB, PLY = "stl", "obj", "dae", "gltf", "glb", "ply"
FORMAT_NAMES = {
    STL: "STL", OBJ: "OBJ", DAE: "COLLADA", GLB: "glTF", GLTF: "glTF", PLY: "PLY",
}  # fmt: skip
"""The formats of meshes that can be read, by their usual file endings."""

PNG, JPEG, GIF, WEBP, BMP, TIFF, TGA = "png", "jpeg", "gif", "webp", "bmp", "tiff", "tga"
IMAGE_FORMATS = (PNG, JPEG, GIF, WEBP, BMP, TIFF, TGA)

LARGEST_FILE = 256 << 20
"""Bytes of a mesh or texture that is read: as objects of Python it takes many times as much."""

STL_HEADER_BYTES = 84
STL_FACET_BYTES = 50

_SEARCHED = 1 << 16
_OBJ_WORDS = frozenset(
    b"v vt vn vp f fo l p o g s mg mtllib usemtl usemap maplib cstype deg bmat step curv curv2 "
    b"surf parm trim hole scrv sp end con bevel c_interp d_interp lod shadow_obj trace_obj ctech "
    b"stech".split()
)
_FOREIGN_COMMENTS = (b"#VRML", b"#X3D", b"#usda")
_IMAGE_MAGIC = (
    (b"\x89PNG\r\n\x1a\n", PNG),
    (b"\xff\xd8\xff", JPEG),
    (b"GIF87a", GIF),
    (b"GIF89a", GIF),
    (b"BM", BMP),
    (b"II*\0", TIFF),
    (b"MM\0*", TIFF),
)


NO_TRIANGLES = "it has no triangles"
"""Why a mesh of which nothing is to be seen cannot be read."""


class MeshFileError(Exception):
    """A mesh file cannot be read; the text says why."""


class MissingLibraryError(Exception):
    """A mesh file needs a library that is not installed; the text names the library."""


def mesh_format(data: bytes) -> str | None:
    """Return the format of a mesh, or None if it cannot be read."""
    if data.startswith(b"glTF"):
        return GLB
    if data[:4].strip() == b"ply":
        return PLY
    if is_binary_stl(data):
        return STL
    start = data[:_SEARCHED].removeprefix(b"\xef\xbb\xbf").lstrip()
    if start.startswith((b"<", b"\xff\xfe<\0", b"\xfe\xff\0<")):
        return DAE
    if start.startswith(b"{"):
        return GLTF
    if start[:5].lower() == b"solid":
        return STL
    # OBJ, by the first word that is not in a comment.
    if b"\0" in start or start.startswith(_FOREIGN_COMMENTS):
        return None
    has_comment = False
    for line in start.splitlines():
        words = line.split(None, 1)
        if not words:
            continue
        if words[0].startswith(b"#"):
            has_comment = True
            continue
        return OBJ if words[0] in _OBJ_WORDS else None
    return OBJ if has_comment else None


def is_binary_stl(data: bytes) -> bool:
    """Return whether there are as many facets as the header of a binary STL says."""
    if len(data) < STL_HEADER_BYTES:
        return False
    count = int.from_bytes(data[80:84], "little")
    return len(data) == STL_HEADER_BYTES + STL_FACET_BYTES * count


def image_format(start: bytes) -> str | None:
    """Return the format of an image by its first bytes, or None if it cannot be read."""
    for magic, kind in _IMAGE_MAGIC:
        if start.startswith(magic):
            return kind
    if start[:4] == b"RIFF" and start[8:12] == b"WEBP":
        return WEBP
    return TGA if _is_tga(start) else None


def _is_tga(start: bytes) -> bool:
    """Return whether bytes may be the header of a TGA, which begins with no sign of its own."""
    if len(start) < 18:
        return False
    has_map, kind, depth, flags = start[1], start[2], start[16], start[17]
    width, height = start[12] | start[13] << 8, start[14] | start[15] << 8
    return (
        has_map in (0, 1)
        and kind in (1, 2, 3, 9, 10, 11)
        and depth in (8, 15, 16, 24, 32)
        and flags & 0xC0 == 0
        and width > 0
        and height > 0
    )


def mesh_ending(filename: str) -> str:
    """Return the file ending in lower case without its dot, or an empty string."""
    name = filename.replace("\\", "/").rpartition("/")[2]
    return name.rpartition(".")[2].lower() if "." in name else ""


def unreadable(path: str) -> MeshFileError:
    """Return the error for a file that has none of the formats."""
    ending = mesh_ending(path)
    name = FORMAT_NAMES.get(ending)
    if name is None:
        return MeshFileError(f"no reader for '.{ending}' files")
    cut = ", or it is cut off" if ending == STL else ""
    return MeshFileError(f"it is not a valid {name} file{cut}")
