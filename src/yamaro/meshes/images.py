"""Images as PNG: the format of textures that every simulator takes."""

from __future__ import annotations

import struct
import zlib

from .formats import PNG, MeshFileError, MissingLibraryError, image_format

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from numpy.typing import NDArray

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
    return _SIGNATURE + b"".join(_chunk(kind, data) for kind, data in chunks)


def _chunk(kind: bytes, data: bytes) -> bytes:
    check = zlib.crc32(kind + data)
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)
