"""What a reader of another format may ask of the build: files, meshes, limits, a reporter."""

from __future__ import annotations

import os

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..diagnostics import Reporter
    from ..files.mesh_files import MeshFinder
    from ..meshes.triangles import TriangleMesh
    from ..policy import Limits
    from ..source import Source, Span


class Host:
    """Gives a reader what it needs, under the limits of the build and from where it may read.

    Attributes:
        source: the main file.
        limits: how much the reader may use.
        model: the name of the model that is wanted of a file with several; None for the first.
        is_part: whether the robot is to be a part of another one: the file is included or attached.
        reporter: takes warnings.
        finder: finds the files of meshes and textures.
    """

    __slots__ = ("_read", "finder", "is_part", "limits", "model", "reporter", "source")

    def __init__(
        self,
        source: Source,
        *,
        read: Callable[[str, Span], Source],
        finder: MeshFinder,
        limits: Limits,
        reporter: Reporter,
        model: str | None = None,
        is_part: bool = False,
    ) -> None:
        self.source = source
        self.finder = finder
        self.limits = limits
        self.model = model
        self.is_part = is_part
        self.reporter = reporter
        self._read = read

    @property
    def folder(self) -> str:
        """Return the folder of the main file, in which its relative paths start."""
        path = self.source.path
        return os.path.dirname(path) if path else os.getcwd()

    def read(self, path: str, span: Span) -> Source:
        """Return the text of an XML file that the document includes at a span.

        Raises:
            YamaroError: it cannot be read, may not be read, or is one too many.
        """
        return self._read(os.path.join(self.folder, path), span)

    def filename(self, path: str, span: Span) -> str:
        """Return what `<mesh filename>` says at a span for an absolute path.

        The finder of meshes looks from the folder of the file in which a name is written.
        """
        home = os.path.dirname(span.source.path) if span.source.path else os.getcwd()
        try:
            return os.path.relpath(path, home).replace(os.sep, "/")
        except ValueError:  # on another drive
            return path

    def find(self, path: str, span: Span) -> str | None:
        """Return the absolute path of a mesh or texture, None if it is not there.

        Args:
            path: as `filename` gave it.
            span: where it is named.

        Raises:
            YamaroError: it lies where it may not be read.
        """
        return self.finder.resolve(path, span)

    def mesh(self, path: str) -> TriangleMesh:
        """Return the triangles of a mesh file that `find` found.

        Raises:
            MeshFileError, MissingLibraryError: it cannot be read.
        """
        from ..meshes.triangles import read_mesh

        return read_mesh(path, self.finder.allows, snaps=False)

    def data(self, path: str) -> bytes:
        """Return the bytes of a mesh file that `find` found.

        Raises:
            MeshFileError: it cannot be read, or is too large.
        """
        from ..files.regular import read_start
        from ..meshes.formats import LARGEST_FILE, MeshFileError

        try:
            data = read_start(path, LARGEST_FILE + 1)
        except OSError as error:
            raise MeshFileError(error.strerror or str(error)) from error
        if len(data) > LARGEST_FILE:
            raise MeshFileError(f"it is larger than {LARGEST_FILE >> 20} MB")
        return data
