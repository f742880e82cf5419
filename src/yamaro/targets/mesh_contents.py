"""What the meshes and textures of a robot hold, for formats that take them only in other forms.

What parses files that others wrote runs in a jail if they are not trusted. A file is parsed once,
whatever its name is and however often it is shown.
"""

from __future__ import annotations

import os

from ..files.regular import read_start
from ..meshes.formats import LARGEST_FILE, MeshFileError, MissingLibraryError, mesh_format
from ..sandbox.jail.protocol import JailError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..meshes.cache import MeshCache
    from ..meshes.surfaces import MeshSurfaces
    from ..source import Span
    from .mesh_paths import MeshPaths


class MeshContents:
    """Reads the files that shapes and materials name."""

    __slots__ = ("_bytes", "_cache", "_finder", "_run", "_surfaces", "_textures")

    def __init__(self, paths: MeshPaths) -> None:
        """Read files where these paths lead."""
        self._finder = paths.finder
        self._run = paths.run
        self._cache = _cache() if paths.is_cached else None
        self._bytes: dict[str, bytes] = {}
        self._surfaces: dict[bytes, MeshSurfaces] = {}
        self._textures: dict[bytes, bytes] = {}

    def path_of(self, filename: str, span: Span) -> str | None:
        """Return the path of a file that is referred to at a span; None if it is not there."""
        return self._finder.reachable(filename, span)

    def bytes_of(self, path: str) -> bytes:
        """Return what is in a file.

        Raises:
            MeshFileError: it cannot be read, or is too large.
        """
        found = self._bytes.get(path)
        if found is None:
            try:
                found = read_start(path, LARGEST_FILE + 1)
            except OSError as error:
                raise MeshFileError(error.strerror or str(error)) from error
            if len(found) > LARGEST_FILE:
                raise MeshFileError(f"it is larger than {LARGEST_FILE >> 20} MB")
            self._bytes[path] = found
        return found

    def format_of(self, path: str) -> str:
        """Return the format of a mesh.

        Raises:
            MeshFileError: it cannot be read, or has no format that is read.
        """
        found = mesh_format(self.bytes_of(path))
        if found is None:
            raise MeshFileError("it has no format that is read")
        return found

    def surfaces_of(self, path: str, *, is_kept: bool = False) -> MeshSurfaces:
        """Return the surfaces of a mesh, with their colours and textures.

        Args:
            path: the file.
            is_kept: whether the cache keeps them as they are, and not what is made of them.

        Raises:
            MeshFileError: it cannot be read.
            MissingLibraryError: its format needs a library that is not installed.
        """
        key = self._key(path)
        if key not in self._surfaces:
            try:
                from ..meshes.surfaces import read_packed, unpacked
            except ImportError as error:
                raise MissingLibraryError(error.name or str(error)) from error

            def read() -> bytes:
                data = self._answer(lambda: read_packed(path, self._finder.allows))
                self._surfaces[key] = unpacked(data)  # raises what the cache must not keep
                return data

            data = self.kept(path, "surfaces", read) if is_kept else read()
            if key not in self._surfaces:
                self._surfaces[key] = unpacked(data)
        return self._surfaces[key]

    def texture_of(self, path: str) -> bytes:
        """Return an image as PNG, as it is if it is one.

        Raises:
            MeshFileError: it cannot be read.
            MissingLibraryError: its format needs a library that is not installed.
        """
        from ..meshes.encoding import is_png, png_of

        data = self.bytes_of(path)
        if is_png(data):
            return data
        key = self._key(path)
        if key not in self._textures:
            self._textures[key] = self.kept(
                path, "texture", lambda: self._answer(lambda: png_of(data))
            )
        return self._textures[key]

    def kept(self, path: str, work: str, convert: Callable[[], bytes]) -> bytes:
        """Return what a file is converted to: from the cache, if it was converted before.

        Args:
            path: the file.
            work: names the conversion.
            convert: does it.
        """
        if self._cache is None:
            return convert()
        from ..meshes.cache import key_of

        data = self.bytes_of(path)
        key = key_of(work, data, mesh_format(data) or "", path)
        if key is None:
            return convert()
        found = self._cache.get(key)
        if found is None:
            found = convert()
            self._cache.put(key, found)
        return found

    def _answer(self, work: Callable[[], bytes]) -> bytes:
        try:
            return self._run(work)
        except JailError as error:
            if error.limit in ("memory", "answer"):
                raise MeshFileError("it takes too much memory") from None
            raise MeshFileError(f"reading it was ended: {error}") from None

    def _key(self, path: str) -> bytes:
        """Return what the content of a file is kept by; files beside it may count, as textures."""
        from hashlib import sha256

        return sha256(self.bytes_of(path)).digest() + os.fsencode(os.path.dirname(path))


def _cache() -> MeshCache | None:
    from ..meshes.cache import MeshCache, cache_folder

    folder = cache_folder(os.environ)
    return None if folder is None else MeshCache(folder)
