"""Finds the files that meshes and textures refer to: the one lookup for all who need them."""

from __future__ import annotations

import os

from ..diagnostics import YamaroError, failure
from .loader import LoadError
from .regular import MADE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..source import Span
    from ..xml.tree import Element
    from .installed import InstalledPackage
    from .made import MadeFiles
    from .packages import PackageFinder
    from .readable import Reach

FILE_ELEMENTS = ("mesh", "texture")
"""The elements of URDF whose `filename` names a file."""

RELATIVE, KEEP, ABSOLUTE, COPY, NONE = "relative", "keep", "absolute", "copy", "none"
"""How an output may name these files; `package://NAME` and `package://` are two more."""


class MeshFinder:
    """Finds the files that meshes and textures refer to, and remembers where they are.

    A name is `package://name/path`, `model://name/path`, `file:///path`, or a path, absolute or
    relative to the file in which it is written. `PackageFinder.find` finds packages.
    """

    __slots__ = ("_found", "_made", "_packages", "_reach", "_start")

    def __init__(
        self, packages: PackageFinder, reach: Reach | None = None, *, start: str = ""
    ) -> None:
        """Look for files.

        Args:
            packages: knows where packages are.
            reach: the files that may be read; None allows all.
            start: the folder of the main file. A relative path may come from there, as an argument
                of a function or macro in another folder.
        """
        self._packages = packages
        self._reach = reach
        self._start = start
        self._found: dict[tuple[str, str], str | None] = {}
        self._made: MadeFiles | None = None

    @property
    def made(self) -> MadeFiles:
        """Return the files that this build makes itself."""
        if self._made is None:
            from .made import MadeFiles

            self._made = MadeFiles()
        return self._made

    @property
    def has_made(self) -> bool:
        """Return whether this build made files itself."""
        return self._made is not None

    def make(self, stem: str, content: bytes) -> str:
        """Make a mesh out of the bytes of an STL; return the name by which it is referred to."""
        return self.made.make(stem, ".stl", content)

    def made_among(self, paths: list[str]) -> dict[str, bytes]:
        """Return those of some files that this build made, by their paths beside a document."""
        return self._made.of(paths) if self._made is not None else {}

    def resolve(self, filename: str, span: Span) -> str | None:
        """Return the absolute path of a file referred to at a span, or None if it is not there.

        Raises:
            YamaroError: it lies where it may not be read.
        """
        if self._made is not None and (path := self._made.path_of(filename)) is not None:
            return path
        key = (filename, _directory(span))
        if key not in self._found:
            self._found[key] = self._find(filename, span)
        return self._found[key]

    def _find(self, filename: str, span: Span) -> str | None:
        path = self.path_meant(filename, span)
        if path is None:
            return None
        if self._reach is not None:  # whether or not a file is there
            self._check_reach(self._reach, path, filename, span)
        if os.path.isfile(path):
            return path
        if not self._start or "://" in filename:
            return None
        path = self._packages.resolve_uri(filename, self._start, span)
        return path if path and self.allows(path) and os.path.isfile(path) else None

    def reachable(self, filename: str, span: Span) -> str | None:
        """Return what `resolve` does, and None for a file that may not be read."""
        try:
            return self.resolve(filename, span)
        except YamaroError:
            return None

    def package_folder(self, package: str, directory: str) -> str | None:
        """Return the folder of a package, looked for from a folder and from the main file."""
        found = self._packages.find(package, directory)
        return found or (self._packages.find(package, self._start) if self._start else None)

    @staticmethod
    def _check_reach(reach: Reach, path: str, filename: str, span: Span) -> None:
        try:
            reach.check(path)
        except LoadError as error:
            message = f"the file '{filename}' cannot be read: {error}"
            raise failure(error.code, message, span, hint=error.hint) from None

    def path_meant(self, filename: str, span: Span) -> str | None:
        """Return the absolute path that a name means, whether or not a file is there.

        None is for a package that is nowhere, and for what is on no disk, such as `https://`.
        """
        if "\x00" in filename:
            return None
        return self._packages.resolve_uri(filename, _directory(span), span)

    def allows(self, path: str) -> bool:
        """Return whether a file may be read, such as a texture that a mesh names."""
        return self._reach is None or path.startswith(MADE) or self._reach.allows(path)

    @property
    def reach(self) -> Reach | None:
        """Return the files that may be read; None where all may be."""
        return self._reach

    @property
    def roots(self) -> list[str]:
        """Return the files and folders that may be read; none where everything may be."""
        return [] if self._reach is None else self._reach.roots

    def package_clashes(self) -> list[tuple[InstalledPackage, str, Span | None]]:
        """Return the Python packages that ROS packages of their names were taken for."""
        return self._packages.clashes()

    def places_meant(self, filename: str, folders: Iterable[str]) -> list[str]:
        """Return the absolute paths that a name in files of these folders may mean."""
        if "\x00" in filename:
            return []
        found = (self._packages.resolve_uri(filename, folder) for folder in folders)
        return list(dict.fromkeys(path for path in found if path))

    def package_around(self, path: str) -> tuple[str, str] | None:
        """Return name and folder of the package that a file is in, or None."""
        return self._packages.package_around(path)

    def package_fault(self, package: str, span: Span) -> tuple[str, list[str]] | None:
        """Return how to get a package, and where it was looked for, or None if it is known."""
        directory = _directory(span)
        if self._packages.find(package, directory, span) is not None:
            return None
        places = self._packages.looked_at(package, directory)
        return self._packages.hint_for(package, directory), places

    def referred_to(self, root: Element) -> list[str]:
        """Return the files of every mesh and texture in a tree, each once, in order.

        A file that is not found is named as it is written.
        """
        files: dict[str, None] = {}
        pending = [root]
        seen: set[int] = set()  # an element may be in several places
        while pending:
            element = pending.pop()
            if id(element) in seen:
                continue
            seen.add(id(element))
            if element.name in FILE_ELEMENTS and element.attributes.get("filename"):
                filename = str(element.attributes["filename"])
                span = element.value_span("filename")
                files.setdefault(self.resolve(filename, span) or filename)
            pending.extend(reversed(element.elements()))
        return list(files)


def _directory(span: Span) -> str:
    path = span.source.path
    return os.path.dirname(path) if path else os.getcwd()
