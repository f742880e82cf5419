"""Mesh files as surfaces to draw: corners, triangles, and the colours or texture on them.

Units and axes are treated as ROS's tools treat them: the unit that a COLLADA file names counts, its
up axis does not, and numbers in all other formats are metres.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..sandbox.jail.protocol import JailAnswerBroken, pack, unpack
from .formats import (
    NO_TRIANGLES,
    STL,
    STL_HEADER_BYTES,
    MeshFileError,
    MissingLibraryError,
    is_binary_stl,
)
from .library import MOST_REFUSED, OWN_IMAGE, Body, check_corners, read_bodies
from .triangles import read_by, read_stl

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.floating[Any]]
    Whole = NDArray[np.integer[Any]]
    Array = NDArray[Any]

LARGEST_COORDINATE = 1e9
WIDEST_TEXTURE = 4096
"""Pixels along a side of a texture; a larger one is made smaller."""

MOST_TEXTURE_BYTES = 512 << 20

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


class Surface:
    """One surface of a mesh.

    Attributes:
        points: corners, N×3, in metres.
        triangles: indices of corners, M×3, counterclockwise seen from outside.
        color: red, green, blue, alpha from 0 to 1 of all of it, or None.
        point_colors: the same for each corner, N×4 from 0 to 255, or None.
        texture: an image, H×W×3 from 0 to 255, the first row on top; or None.
        texture_points: where in the image each corner is, N×2, from the lower left; or None.
        normals: directions of the corners, N×3, where the file's own have to do; or None.
    """

    __slots__ = (
        "color", "normals", "point_colors", "points", "texture", "texture_points", "triangles",
    )  # fmt: skip

    def __init__(self, points: Floats, triangles: Whole) -> None:
        self.points = points
        self.triangles = triangles
        self.color: tuple[float, ...] | None = None
        self.point_colors: NDArray[np.uint8] | None = None
        self.texture: NDArray[np.uint8] | None = None
        self.texture_points: Floats | None = None
        self.normals: Floats | None = None

    @property
    def has_look(self) -> bool:
        """Return whether the file gives it colours or a texture."""
        return any(each is not None for each in (self.color, self.point_colors, self.texture))


class MeshSurfaces(list[Surface]):
    """The surfaces of a mesh.

    Attributes:
        refused: a clause for each texture that is left out.
    """

    __slots__ = ("refused",)

    def __init__(self, surfaces: Iterable[Surface], refused: Sequence[str] = ()) -> None:
        super().__init__(surfaces)
        self.refused = list(refused)


def read_surfaces(path: str, allows: Callable[[str], bool] | None) -> MeshSurfaces:
    """Return the surfaces in a mesh file.

    Args:
        path: the file.
        allows: whether another file that this one names may be read, such as a texture.

    Raises:
        MeshFileError: the file cannot be read.
        MissingLibraryError: the format needs a library that is not installed.
    """
    refused: list[str] = []

    def read(data: bytes, kind: str, path: str) -> list[Surface]:
        if kind == STL:
            if not is_binary_stl(data):
                mesh = read_stl(data)
                points = np.array(mesh.vertices, float).reshape(-1, 3)
                return [Surface(points, np.array(mesh.triangles, int).reshape(-1, 3))]
            facets = np.frombuffer(data, _FACET, offset=STL_HEADER_BYTES)
            points = facets["corners"].reshape(-1, 3).astype(float)
            return [Surface(points, np.arange(len(points)).reshape(-1, 3))]
        bodies = read_bodies(data, kind, path, allows, has_colors=True, refused=refused)
        found = []
        size = 0
        for body in bodies:
            surface = Surface(body.points, body.triangles)
            visual = body.mesh.visual
            if visual.kind == "vertex":
                surface.point_colors = np.asarray(visual.vertex_colors, np.uint8)
            elif visual.kind == "face":
                surface.points = surface.points[body.triangles.ravel()]
                surface.triangles = np.arange(body.triangles.size).reshape(-1, 3)
                surface.point_colors = np.repeat(
                    np.asarray(visual.face_colors, np.uint8), 3, axis=0
                )
            elif visual.kind == "texture":
                _add_material(surface, body)
            size += surface.texture.nbytes if surface.texture is not None else 0
            if size > MOST_TEXTURE_BYTES:
                raise MeshFileError("its textures take too much memory")
            found.append(surface)
        return found

    found = [surface for surface in read_by(read, path) if len(surface.triangles)]
    if not found:
        raise MeshFileError(NO_TRIANGLES)
    for surface in found:
        check_surface(surface)
    return MeshSurfaces(found, refused)


def check_surface(surface: Surface) -> None:
    """Raise MeshFileError if a surface cannot be drawn: it may come from an untrusted file."""
    count = len(surface.points)
    triangles = surface.triangles
    if surface.points.shape != (count, 3) or triangles.shape != (len(triangles), 3):
        raise MeshFileError("its corners are not points")
    if not (abs(surface.points) <= LARGEST_COORDINATE).all():
        raise MeshFileError("a coordinate is not a number, or too large for one")
    check_corners(triangles, count)
    for numbers, width in (
        (surface.point_colors, 4), (surface.texture_points, 2), (surface.normals, 3)
    ):  # fmt: skip
        if numbers is not None and not (
            numbers.shape == (count, width) and np.isfinite(numbers).all()
        ):
            raise MeshFileError("its colours, directions or texture do not fit its corners")
    if surface.color is not None and not (
        len(surface.color) == 4 and all(0 <= part <= 1 for part in surface.color)
    ):
        raise MeshFileError("its colour is not valid")
    texture = surface.texture
    if texture is not None and not (
        texture.ndim == 3
        and texture.shape[2] == 3
        and min(texture.shape) > 0
        and max(texture.shape) <= WIDEST_TEXTURE
    ):
        raise MeshFileError("its texture is not an image")


def _add_material(surface: Surface, body: Body) -> None:
    material = body.mesh.visual.material
    image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
    if image is not None and OWN_IMAGE not in image.info:
        return
    uv = body.mesh.visual.uv
    if image is not None and uv is not None and len(uv) == len(surface.points):
        image.thumbnail((WIDEST_TEXTURE, WIDEST_TEXTURE))
        surface.texture = np.asarray(image.convert("RGB"))
        surface.texture_points = np.asarray(uv, float)[:, :2]
        surface.normals = np.asarray(body.mesh.vertex_normals, float) @ np.linalg.inv(
            body.T_file_body[:3, :3]
        )
        return
    color = np.clip(np.asarray(material.main_color, float) / 255, 0, 1)
    if getattr(material, "baseColorFactor", None) is not None:  # of glTF, whose numbers are linear
        linear = color[:3]  # as sRGB: IEC 61966-2-1
        curved = 1.055 * linear ** (1 / 2.4) - 0.055
        color[:3] = np.where(linear <= 0.0031308, 12.92 * linear, curved)
    surface.color = tuple(float(part) for part in color[:4])


# --- surfaces as bytes, and back: that is how they leave a jail -------------------------------


_SURFACES, _FAULT, _MISSING = b"s", b"f", b"m"
_LONGEST_REASON = 1_000
_FLOAT, _WHOLE, _BYTE = np.dtype("<f8"), np.dtype("<i4"), np.dtype("u1")


def read_packed(path: str, allows: Callable[[str], bool] | None) -> bytes:
    """Return what a mesh file holds, or why it cannot be read, as bytes."""
    try:
        surfaces = read_surfaces(path, allows)
        refused = "\n".join(surfaces.refused).encode("utf-8", "replace")
        return pack([_SURFACES, refused, *map(_packed, surfaces)])
    except MissingLibraryError as error:
        return _reason(_MISSING, str(error))
    except MeshFileError as error:
        return _reason(_FAULT, str(error))
    except (MemoryError, RecursionError):
        return _reason(_FAULT, "it takes too much memory")
    except Exception as error:
        return _reason(_FAULT, f"it is broken: {error}")


def unpacked(data: bytes) -> MeshSurfaces:
    """Return the surfaces that some bytes hold.

    Raises:
        MeshFileError: they say why there are none.
        MissingLibraryError: they say what is missing.
        JailAnswerBroken: they are malformed.
    """
    try:
        kind, *parts = unpack(data)
        if kind == _FAULT:
            raise MeshFileError(parts[0].decode("utf-8", "replace"))
        if kind == _MISSING:
            raise MissingLibraryError(parts[0].decode("utf-8", "replace"))
        if kind != _SURFACES or len(parts) < 2:
            raise ValueError(kind)
        refused = parts[0][:_LONGEST_REASON].decode("utf-8", "replace").splitlines()
        return MeshSurfaces(map(_unpacked, parts[1:]), refused[:MOST_REFUSED])
    except (ValueError, IndexError) as error:
        raise JailAnswerBroken(f"the answer is not valid: {error}") from None


def _reason(kind: bytes, text: str) -> bytes:
    return pack([kind, text[:_LONGEST_REASON].encode("utf-8", "replace")])


def _packed(surface: Surface) -> bytes:
    return pack(
        [
            _array(surface.points, _FLOAT),
            _array(surface.triangles, _WHOLE),
            _array(None if surface.color is None else np.array(surface.color), _FLOAT),
            _array(surface.point_colors, _BYTE),
            _array(surface.texture, _BYTE),
            _array(surface.texture_points, _FLOAT),
            _array(surface.normals, _FLOAT),
        ]
    )


def _unpacked(data: bytes) -> Surface:
    points, triangles, color, point_colors, texture, texture_points, normals = unpack(data)
    found, corners = _read(points, _FLOAT), _read(triangles, _WHOLE)
    if found is None or corners is None or not len(corners):
        raise ValueError("a surface has no triangles")
    surface = Surface(found, corners)
    own = _read(color, _FLOAT)
    surface.color = None if own is None else tuple(own.ravel().tolist())
    surface.point_colors = _read(point_colors, _BYTE)
    surface.texture = _read(texture, _BYTE)
    surface.texture_points = _read(texture_points, _FLOAT)
    surface.normals = _read(normals, _FLOAT)
    check_surface(surface)
    return surface


def _array(array: Array | None, kind: np.dtype[Any]) -> bytes:
    if array is None:
        return b""
    shape = b" ".join(b"%d" % length for length in array.shape)
    return pack([shape, np.ascontiguousarray(array, kind).tobytes()])


def _read(data: bytes, kind: np.dtype[Any]) -> Array | None:
    if not data:
        return None
    lengths, numbers = unpack(data)
    if len(lengths) > 40:
        raise ValueError("an array has too many dimensions")
    shape = tuple(int(length) for length in lengths.split())
    if min(shape, default=-1) < 0:
        raise ValueError("an array has no shape")
    return np.frombuffer(numbers, kind).reshape(shape)
