"""Surfaces as bytes, and back: that is how they leave a jail.

The bytes come from an untrusted process, so everything in them is checked: types, counts, that
numbers are finite and that corners are there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..sandbox.jail.limits import JailAnswerBroken
from ..sandbox.jail.packing import pack, unpack
from .formats import MeshFileError, MissingLibraryError
from .library import MOST_REFUSED
from .surfaces import MeshSurfaces, Surface, check_surface, read_surfaces

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[Any]

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
