"""The meshes of a robot: each file read once, and a warning for each that cannot be drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...diagnostics import WARNING, Diagnostic
from ...robot.check_context import label
from ...robot.check_files import is_local
from ...robot.mesh import MeshFileError, MissingLibraryError
from .surfaces import read_surfaces

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..scene.robot import Link, Shape
    from .surfaces import Surface

BOX_HINT = "a box stands for it in the picture"


class Meshes:
    """Reads the meshes of a robot.

    Attributes:
        warnings: one for each mesh that cannot be drawn, but for those that the check tells of.
    """

    def __init__(self, allows: Callable[[str], bool]) -> None:
        """Begin without meshes; `allows` tells whether a file may be read that a mesh names."""
        self.warnings: list[Diagnostic] = []
        self._allows = allows
        self._surfaces: dict[str, list[Surface]] = {}
        self._told: set[str] = set()

    def surfaces_of(self, link: Link, shape: Shape) -> list[Surface]:
        """Return the surfaces of a mesh; none if it cannot be drawn."""
        path = shape.path
        if path is None:
            if shape.filename and not is_local(shape.filename):
                self._warn("missing-mesh-file", link, shape, "is not found")
            return []
        if path not in self._surfaces:
            self._surfaces[path] = []
            try:
                self._surfaces[path] = read_surfaces(path, self._allows)
            except MissingLibraryError as error:
                hint = 'pip install "yamaro[picture]"'
                reason = f"needs the Python package '{error}'"
                self._warn("missing-extra", link, shape, reason, hint)
            except MeshFileError as error:
                self._warn("bad-mesh", link, shape, f"cannot be read: {error}")
        return self._surfaces[path]

    def _warn(self, code: str, link: Link, shape: Shape, reason: str, hint: str = BOX_HINT) -> None:
        if shape.filename in self._told:
            return
        self._told.add(shape.filename)
        self.warnings.append(
            Diagnostic(
                code,
                f"the mesh '{shape.filename}' of {label(link.element)} {reason}",
                shape.geometry.value_span("filename"),
                hint=hint,
                severity=WARNING,
                trace=shape.geometry.trace,
            )
        )
