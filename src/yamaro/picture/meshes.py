"""The meshes of a robot as surfaces to draw, and warnings about those that cannot be drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..check.context import label
from ..check.files import is_local
from ..diagnostics import WARNING, Diagnostic
from ..meshes.formats import MeshFileError, MissingLibraryError
from ..meshes.surfaces import read_packed, unpacked
from ..sandbox.jail.protocol import JailAnswerBroken, JailError, pack, unpack

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from ..confined import Reader
    from ..meshes.surfaces import MeshSurfaces, Surface
    from .figure import DrawnShape

BOX_HINT = "the picture shows a box instead"


def read_meshes(
    paths: Collection[str], allows: Callable[[str], bool], reader: Reader
) -> dict[str, MeshSurfaces | Exception]:
    """Return the surfaces in mesh files by path, or why they cannot be drawn.

    All are read in one jail. If that is ended, each is read in one of its own, so that the others
    are still drawn.

    Raises:
        YamaroError: the time is over.
    """
    order = list(dict.fromkeys(paths))
    if not order:
        return {}
    try:
        return _read_together(order, allows, reader)
    except JailError as error:
        if len(order) == 1:
            return {order[0]: _reason(error)}
    found: dict[str, MeshSurfaces | Exception] = {}
    for path in order:
        try:
            found.update(_read_together([path], allows, reader))
        except JailError as error:
            found[path] = _reason(error)
    return found


def _read_together(
    paths: Sequence[str], allows: Callable[[str], bool], reader: Reader
) -> dict[str, MeshSurfaces | Exception]:
    def read() -> bytes:
        pieces = []
        for path in paths:
            reader.check_time()
            pieces.append(read_packed(path, allows))
        return pack(pieces)

    pieces = unpack(reader.run(read))
    if len(pieces) != len(paths):
        raise JailAnswerBroken("the answer holds another number of meshes")
    return {path: _surfaces(piece) for path, piece in zip(paths, pieces, strict=True)}


def _surfaces(data: bytes) -> MeshSurfaces | Exception:
    try:
        return unpacked(data)
    except (MeshFileError, MissingLibraryError) as error:
        return error


def _listed(refused: Sequence[str]) -> str:
    """Return the textures that are left out: the first with the reason, the others as a number."""
    others = f", and without {len(refused) - 1} more" if len(refused) > 1 else ""
    return f"a texture: {refused[0]}{others}"


def _reason(error: JailError) -> MeshFileError:
    """Return the reason for a mesh whose reading was ended."""
    if error.limit in ("memory", "answer"):
        return MeshFileError("it takes too much memory")
    return MeshFileError(f"reading it was ended: {error}")


class Meshes:
    """The meshes of a robot.

    Attributes:
        warnings: one for each mesh that cannot be drawn, or not with its textures, except for
            what the check reports.
    """

    def __init__(self, found: dict[str, MeshSurfaces | Exception]) -> None:
        self.warnings: list[Diagnostic] = []
        self._found = found
        self._told: set[str] = set()

    def surfaces_of(self, shape: DrawnShape) -> list[Surface]:
        """Return the surfaces of a mesh; none if it cannot be drawn."""
        if shape.path is None:
            if shape.filename and not is_local(shape.filename):
                self._warn("missing-mesh-file", shape, "is not found")
            return []
        found = self._found[shape.path]
        if not isinstance(found, Exception):
            if found.refused:
                reason = f"is drawn without {_listed(found.refused)}"
                self._warn("bad-mesh", shape, reason, None)
            return found
        if isinstance(found, MissingLibraryError):
            hint = 'pip install "yamaro[picture]"'
            reason = f"needs the Python package '{found}'"
            self._warn("missing-extra", shape, reason, hint)
        else:
            self._warn("bad-mesh", shape, f"cannot be read: {found}")
        return []

    def _warn(self, code: str, shape: DrawnShape, reason: str, hint: str | None = BOX_HINT) -> None:
        if shape.filename in self._told:
            return
        self._told.add(shape.filename)
        self.warnings.append(
            Diagnostic(
                code,
                f"the mesh '{shape.filename}' of {label(shape.link.element)} {reason}",
                shape.filename_span,
                hint=hint,
                severity=WARNING,
                trace=shape.trace,
            )
        )
