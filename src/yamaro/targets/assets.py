"""Copies of meshes and textures for a folder beside the output, named by their content.

A mesh that refers to other files keeps its own name and theirs, in a folder that is named by the
content of all of them: so what it refers to is found again, and nothing in it has to change.
"""

from __future__ import annotations

import os

from ..files.made import named_by_content
from ..files.regular import read_start
from ..meshes.bounds import MOST_NAMES, check_bounds, names_in_materials, path_of
from ..meshes.formats import DAE, GLTF, LARGEST_FILE, OBJ, MeshFileError, mesh_format
from ..sandbox.jail.protocol import JailError, pack, unpack

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from ..files.mesh_files import MeshFinder

    Run = Callable[[Callable[[], bytes]], bytes]

FOLDER = "assets"
"""The folder of the copies, beside the output."""


class Assets:
    """The copies that an output refers to, worked out when they are asked for."""

    __slots__ = ("_finder", "_known", "_run")

    def __init__(self, finder: MeshFinder, run: Run) -> None:
        """Copy files.

        Args:
            finder: decides which files may be read.
            run: runs what parses files that others wrote, in a jail if they are not trusted.
        """
        self._finder = finder
        self._run = run
        self._known: dict[str, tuple[str, dict[str, str]] | None] = {}

    def name_of(self, path: str) -> str | None:
        """Return the path of a file's copy from the folder of the output, or None if unreadable."""
        found = self._copies(path)
        return None if found is None else found[0]

    def of(self, paths: Iterable[str]) -> dict[str, bytes]:
        """Return the content of all copies of some files, by path from the folder of the output.

        Raises:
            OSError: a file cannot be read any more.
        """
        copies: dict[str, bytes] = {}
        for path in paths:
            found = self._copies(path) if os.path.isabs(path) else None
            for name, source in (found[1] if found else {}).items():
                if name not in copies:
                    copies[name] = read_start(source, LARGEST_FILE)
        return copies

    def _copies(self, path: str) -> tuple[str, dict[str, str]] | None:
        """Return the name of a file's copy, and all that are copied with it by their names."""
        if path not in self._known:
            try:
                self._known[path] = self._planned(path)
            except OSError:
                self._known[path] = None
        return self._known[path]

    def _planned(self, path: str) -> tuple[str, dict[str, str]] | None:
        if not self._finder.allows(path):
            return None
        data = read_start(path, LARGEST_FILE)
        companions = self._companions(path, data)
        base = os.path.basename(path)
        if not companions:
            stem, ending = os.path.splitext(base)
            name = f"{FOLDER}/{named_by_content(stem, ending, [data])}"
            return name, {name: path}
        top = os.path.commonpath([os.path.dirname(each) for each in (path, *companions)])
        inner = {_inside(top, each): each for each in (path, *companions)}
        contents: list[bytes] = []
        for name, source in sorted(inner.items()):
            contents += [os.fsencode(name), read_start(source, LARGEST_FILE)]
        folder = f"{FOLDER}/{named_by_content(os.path.splitext(base)[0], '', contents)}"
        return (
            f"{folder}/{_inside(top, path)}",
            {f"{folder}/{name}": source for name, source in inner.items()},
        )

    def _companions(self, path: str, data: bytes) -> list[str]:
        """Return the files that a mesh refers to by relative paths, and those that these do."""
        kind = mesh_format(data)
        if kind not in (OBJ, DAE, GLTF):
            return []

        def work() -> bytes:
            return pack([os.fsencode(each) for each in self._named_in(path, data, kind)])

        try:
            found = [os.fsdecode(each) for each in unpack(self._run(work))]
        except (JailError, ValueError):
            return []
        return [each for each in found[: 2 * MOST_NAMES] if self._is_companion(each, path)]

    def _is_companion(self, path: str, mesh: str) -> bool:
        """Return whether a file, as a jail may have named it, is one to copy."""
        return (
            os.path.isabs(path)
            and "\0" not in path
            and path != mesh
            and os.path.isfile(path)
            and self._finder.allows(path)
        )

    def _named_in(self, path: str, data: bytes, kind: str) -> list[str]:
        try:
            names = check_bounds(data, kind)
        except MeshFileError:
            return []
        found = self._beside(path, names)
        if kind == OBJ:
            for material in list(found):
                try:
                    text = read_start(material, LARGEST_FILE)
                except OSError:
                    continue
                found += self._beside(material, names_in_materials(text))
        return list(dict.fromkeys(found))

    def _beside(self, path: str, names: Iterable[str]) -> list[str]:
        """Return the files that are meant by relative names in a file."""
        folder = os.path.dirname(path)
        found = []
        for name in names:
            if "://" in name or os.path.isabs(name):
                continue
            target = path_of(folder, name)
            if self._is_companion(target, path):
                found.append(target)
        return found


def _inside(folder: str, path: str) -> str:
    return os.path.relpath(path, folder).replace(os.sep, "/")
