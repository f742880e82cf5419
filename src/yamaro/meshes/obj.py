"""Surfaces as Wavefront OBJ, triangles as binary STL: what simulators read without libraries."""

from __future__ import annotations

import struct
from itertools import chain

from .formats import STL_HEADER_BYTES

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
