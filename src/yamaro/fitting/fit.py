"""A shape that is worked out from a mesh: what is asked for, the result, and how it is kept.

What is worked out depends on the content of the mesh and on what is asked for, on nothing else: so
the cache can keep it from one run to the next.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..meshes.encoding import stl_of
from ..meshes.formats import MeshFileError, MissingLibraryError
from ..meshes.triangles import TriangleMesh, joined, read_mesh, read_stl
from ..model.shapes import SIMPLE_SHAPES

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..meshes.cache import MeshCache
    from ..model.pose import Vector
    from ..model.shapes import SimpleShape

    Color = tuple[float, float, float, float]

FIT, DECOMPOSE, SPHERES, TRIANGLES = "fit", "decompose", "spheres", "triangles"
"""The words by which a shape is asked for."""
BEST, HULL = "best", "hull"
LARGEST_COORDINATE = 1e6
"""In metres: a mesh that reaches farther has no size that makes sense."""
_VERSION = 11
"""Changes where the same question gets another answer."""


class Wanted:
    """What is asked for.

    Attributes:
        word: FIT, DECOMPOSE, SPHERES or TRIANGLES.
        kind: with FIT one of `FITS` of the schema, else "".
        count: the greatest number of pieces, spheres or triangles; 0 with FIT.
        covers: whether it has to contain the mesh.
    """

    __slots__ = ("count", "covers", "kind", "word")

    def __init__(self, word: str, *, kind: str = "", count: int = 0, covers: bool = False) -> None:
        """Ask for a shape; see the class."""
        self.word = word
        self.kind = kind
        self.count = count
        self.covers = covers

    def __str__(self) -> str:
        """Return it as it is written in YAML."""
        return f"{self.word}: {self.kind or self.count}{', cover: true' if self.covers else ''}"


class Placed:
    """A simple shape where it is in the frame of the mesh.

    Attributes:
        shape: the shape.
        xyz: its middle, in metres.
        rpy: its rotation, in radians.
    """

    __slots__ = ("rpy", "shape", "xyz")

    def __init__(self, shape: SimpleShape, xyz: Vector, rpy: Vector) -> None:
        """Place a shape."""
        self.shape = shape
        self.xyz = xyz
        self.rpy = rpy


class Fit:
    """What was worked out.

    Attributes:
        pieces: simple shapes, and meshes, each as the bytes of an STL in metres; none where the
            mesh has few enough triangles as it is.
        distance: the greatest distance between the surface of the mesh and that of the pieces
            together, both ways, in metres.
        excess: how much more volume the pieces together have, as a part of the mesh's volume; None
            for a mesh that is not closed.
        size: the longest side of the box around the mesh, in metres.
        colors: of each piece red, green, blue and alpha from 0 to 1, or None; empty without any.
        loses: what the mesh looks like and the pieces do not: `texture`, `colours`,
            `smallest colours` or "".
    """

    __slots__ = ("colors", "distance", "excess", "loses", "pieces", "size")

    def __init__(
        self,
        pieces: tuple[Placed | bytes, ...],
        *,
        distance: float,
        excess: float | None,
        size: float,
        colors: tuple[Color | None, ...] = (),
        loses: str = "",
    ) -> None:
        """Hold a result; see the class."""
        self.colors = colors if any(colors) else ()
        self.loses = loses
        self.pieces = pieces
        self.distance = distance
        self.excess = excess
        self.size = size


def work_out(
    path: str,
    scale: tuple[float, ...],
    wanted: Wanted,
    *,
    allows: Callable[[str], bool] | None = None,
    cache: MeshCache | None = None,
    known: dict[bytes, Fit] | None = None,
) -> Fit:
    """Return a shape for the mesh in a file.

    Args:
        path: the file.
        scale: factors along the axes of the mesh.
        wanted: what is asked for.
        allows: whether another file that this one names may be read; None allows all.
        cache: keeps results from one run to the next.
        known: keeps them in this run.

    Raises:
        MeshFileError: the file cannot be read, or has no surface that a shape fits.
        MissingLibraryError: a library is not installed.
    """
    key = _key(path, scale, wanted)
    if key is None or known is None:
        known, key = {}, key or b""
    if key not in known:
        kept = None if cache is None or not key else cache.get(key)
        try:
            known[key] = unpacked(kept or b"")
        except (ValueError, KeyError, IndexError):  # there is none, or it is broken
            mesh = _scaled(read_mesh(path, allows), scale)
            parts: list[tuple[TriangleMesh, Color | None]] = [(mesh, None)]
            lost = ""
            if wanted.word == TRIANGLES and len(mesh.triangles) > wanted.count:
                from .lighter import parts_by_color

                found, lost = parts_by_color(path, allows)
                parts = [(_scaled(part, scale), color) for part, color in found]
                if len(parts) == 1:
                    parts = [(mesh, parts[0][1])]
            known[key] = fitted(mesh, wanted, parts)
            if known[key].pieces:
                is_whole = wanted.word != TRIANGLES or len(known[key].pieces) == len(parts)
                known[key].loses = lost or ("" if is_whole else "smallest colours")
            if cache is not None and key:
                cache.put(key, packed(known[key]))
    return known[key]


def _key(path: str, scale: tuple[float, ...], wanted: Wanted) -> bytes | None:
    from ..files.regular import read_start
    from ..meshes.cache import key_of
    from ..meshes.formats import LARGEST_FILE, mesh_format

    try:
        data = read_start(path, LARGEST_FILE + 1)
    except OSError:
        return None
    work = f"shape {_VERSION} of scale {' '.join(map(repr, scale))}; {wanted}"
    return key_of(work, data, mesh_format(data) or "", path)


def _scaled(mesh: TriangleMesh, scale: tuple[float, ...]) -> TriangleMesh:
    x, y, z = scale
    triangles = mesh.triangles
    if x * y * z < 0:  # a reflection, which turns the inside out
        triangles = [(i, k, j) for i, j, k in triangles]
    vertices = [(a * x, b * y, c * z) for a, b, c in mesh.vertices]
    return TriangleMesh(vertices, triangles)


def fitted(
    mesh: TriangleMesh,
    wanted: Wanted,
    parts: Sequence[tuple[TriangleMesh, Color | None]] = (),
) -> Fit:
    """Return a shape for a mesh; with TRIANGLES of its parts, each of which has one colour.

    Raises:
        MeshFileError: it has no surface that a shape fits.
        MissingLibraryError: a library is not installed.
    """
    try:
        import numpy  # noqa: F401 - all that is worked out needs it
    except ImportError as error:
        raise MissingLibraryError(error.name or str(error)) from error
    from .quality import quality_of
    from .sampling import without_twins

    size = _size(mesh)
    if wanted.word == TRIANGLES:
        return _lightened(mesh, parts or [(mesh, None)], wanted.count, size=size)
    mesh = without_twins(mesh)
    pieces: list[Placed | TriangleMesh]
    match wanted.word:
        case "fit" if wanted.kind == HULL:
            from .hull import hull_of

            pieces = [hull_of(mesh)]
        case "fit":
            from .primitives import primitive_of

            pieces = [primitive_of(mesh, wanted.kind, covers=wanted.covers)]
        case "decompose":
            from .pieces import decompose

            pieces = [*decompose(mesh, wanted.count)]
        case "spheres":
            from ..model.shapes import Sphere
            from .spheres import spheres_of

            found = spheres_of(mesh, wanted.count, cover=wanted.covers)
            pieces = [Placed(Sphere(radius), xyz, (0.0, 0.0, 0.0)) for xyz, radius in found]
        case _:
            raise AssertionError(wanted.word)
    distance, excess = quality_of(mesh, pieces)
    return Fit(
        tuple([stl_of(each) if isinstance(each, TriangleMesh) else each for each in pieces]),
        distance=distance,
        excess=excess,
        size=size,
    )


def _lightened(
    mesh: TriangleMesh,
    parts: Sequence[tuple[TriangleMesh, Color | None]],
    count: int,
    *,
    size: float,
) -> Fit:
    """Return the parts of a mesh with at most `count` triangles, or no pieces if it has no more."""
    from .lighter import lighter
    from .quality import volume_of
    from .sampling import arrays_of, enclosed

    volume = volume_of(mesh)
    total = sum(len(part.triangles) for part, _ in parts)
    pieces, distance = [part for part, _ in parts], 0.0
    if total > count:
        pieces, distance = lighter(pieces, count, size=size)
    if sum(len(each.triangles) for each in pieces) >= total:
        return Fit((), distance=0.0, excess=None if volume is None else 0.0, size=size)
    kept = [index for index, piece in enumerate(pieces) if piece.triangles]
    excess = volume and round(enclosed(*arrays_of(joined(pieces))) / volume - 1, 6) + 0.0
    return Fit(
        tuple(stl_of(pieces[index]) for index in kept),
        distance=distance,
        excess=excess,
        size=size,
        colors=tuple(parts[index][1] for index in kept),
    )


def _size(mesh: TriangleMesh) -> float:
    """Return the longest side of the box around a mesh.

    Raises:
        MeshFileError: it is a point, or not of this world.
    """
    import numpy as np

    from .sampling import arrays_of

    corners, _ = arrays_of(mesh)
    size = float(np.ptp(corners, axis=0).max())
    if not size > 0:
        raise MeshFileError("all its corners are at one point")
    if not abs(corners).max() <= LARGEST_COORDINATE:
        raise MeshFileError(
            f"it reaches farther than {LARGEST_COORDINATE / 1000:g} km; in other units than metres "
            "it needs its 'scale'"
        )
    return size


# --- as bytes -----------------------------------------------------------------------------------


_SHAPE, _MESH = b"s", b"m"


def packed(fit: Fit) -> bytes:
    """Return a result as bytes."""
    from ..sandbox.jail.protocol import pack

    excess = "" if fit.excess is None else repr(fit.excess)
    parts = [f"{fit.distance!r} {fit.size!r} {excess}".encode(), fit.loses.encode()]
    for piece, color in zip(fit.pieces, fit.colors or (None,) * len(fit.pieces), strict=True):
        if isinstance(piece, bytes):
            parts.append(_MESH + " ".join(map(repr, color or ())).encode() + b"\n" + piece)
        else:
            numbers = (*piece.shape.size, *piece.xyz, *piece.rpy)
            parts.append(_SHAPE + f"{piece.shape.kind} {' '.join(map(repr, numbers))}".encode())
    return pack(parts)


def unpacked(data: bytes) -> Fit:
    """Return the result that some bytes hold.

    Raises:
        ValueError: they hold none; so do KeyError and IndexError.
    """
    from ..sandbox.jail.protocol import unpack

    head, loses, *parts = unpack(data)
    distance, size, *excess = map(float, head.split())
    pieces: list[Placed | bytes] = []
    colors: list[Color | None] = []
    for part in parts:
        if part[:1] == _MESH:
            row, _, content = part[1:].partition(b"\n")
            read_stl(content)
            pieces.append(content)
            red, green, blue, alpha = map(float, row.split() or (0, 0, 0, 0))
            colors.append((red, green, blue, alpha) if row else None)
            continue
        colors.append(None)
        kind, *words = part[1:].decode("ascii").split()
        numbers = [*map(float, words)]
        a, b, c, d, e, f = numbers[-6:]
        pieces.append(Placed(SIMPLE_SHAPES[kind](*numbers[:-6]), (a, b, c), (d, e, f)))
    return Fit(
        tuple(pieces),
        distance=distance,
        excess=excess[0] if excess else None,
        size=size,
        colors=tuple(colors),
        loses=loses.decode("ascii"),
    )
