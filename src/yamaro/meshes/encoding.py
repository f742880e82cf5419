"""What simulators read without libraries: surfaces as OBJ, triangles as STL, images as PNG."""

from __future__ import annotations

import struct
import zlib
from itertools import chain

from .formats import PNG, STL_HEADER_BYTES, MeshFileError, MissingLibraryError, image_format

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from numpy.typing import NDArray

    from .surfaces import Surface
    from .triangles import TriangleMesh

    Array = NDArray[Any]


def obj_of(surfaces: Sequence[Surface], *, has_texture: bool = False) -> bytes:
    """Return surfaces as one OBJ without materials.

    Args:
        surfaces: the surfaces.
        has_texture: whether to write where in a texture the corners are; each surface has that.
    """
    lines: list[str] = []
    count = 0
    for surface in surfaces:
        lines += _rows("v", surface.points)
        if has_texture and surface.texture_points is not None:
            lines += _rows("vt", surface.texture_points)
        form = "f {0}/{0} {1}/{1} {2}/{2}" if has_texture else "f {} {} {}"
        corners = (surface.triangles + (count + 1)).tolist()
        lines += [form.format(*corner) for corner in corners]
        count += len(surface.points)
    return ("\n".join(lines) + "\n").encode("ascii")


def _rows(word: str, numbers: Array) -> list[str]:
    """Return a line for each row, with as many digits as a number of four bytes holds."""
    form = f"{word}{' %.9g' * numbers.shape[1]}"
    return [form % tuple(each) for each in numbers.tolist()]


def obj_of_triangles(mesh: TriangleMesh) -> bytes:
    """Return triangles as OBJ."""
    lines = ["v {:.9g} {:.9g} {:.9g}".format(*vertex) for vertex in mesh.vertices]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.triangles]
    return ("\n".join(lines) + "\n").encode("ascii")


def stl_of(mesh: TriangleMesh) -> bytes:
    """Return triangles as binary STL; normals are left to the reader, which works them out."""
    vertices = mesh.vertices
    pieces = [bytes(STL_HEADER_BYTES - 4), struct.pack("<I", len(mesh.triangles))]
    facet = struct.Struct("<12f2x")
    for triangle in mesh.triangles:
        corners = chain.from_iterable(vertices[index] for index in triangle)
        pieces.append(facet.pack(0.0, 0.0, 0.0, *corners))
    return b"".join(pieces)


# --- images as PNG ----------------------------------------------------------------------------


_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_BITS, _RGB = 8, 2


def is_png(data: bytes) -> bool:
    """Return whether bytes are a PNG, by how they begin."""
    return image_format(data[:64]) == PNG


def png_of(data: bytes) -> bytes:
    """Return an image of another format as PNG; the bytes may be those of an untrusted file.

    Raises:
        MeshFileError: it is not an image, or has too many pixels.
        MissingLibraryError: Pillow is not installed.
    """
    try:
        import numpy as np
        import PIL.Image

        from .library import open_image
    except ImportError as error:
        raise MissingLibraryError(error.name or str(error)) from error
    try:
        return encoded(np.asarray(open_image(data, PIL.Image.open).convert("RGB")))
    except MeshFileError:
        raise
    except Exception as error:
        raise MeshFileError(f"it is broken: {error}") from error


def encoded(pixels: NDArray[Any]) -> bytes:
    """Return pixels as PNG, the same bytes for the same pixels whatever is installed.

    Args:
        pixels: H×W×3 from 0 to 255, the first row on top.

    Source: Portable Network Graphics (PNG) Specification, 2nd edition, 5 and 11.2.
    """
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + pixel_row.tobytes() for pixel_row in pixels.astype("u1"))
    head = struct.pack(">IIBBBBB", width, height, _BITS, _RGB, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    pieces = [_SIGNATURE]
    for kind, data in chunks:
        check = zlib.crc32(kind + data)
        pieces += [struct.pack(">I", len(data)), kind, data, struct.pack(">I", check)]
    return b"".join(pieces)
