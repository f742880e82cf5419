"""Files that a build makes itself, such as the convex pieces of a mesh: in memory, with a path.

They are read like other files, by `files/regular.py`, for as long as the build is there that made
them; nothing is written to a disk, which a build in a jail could not do. What a build writes has
copies of them beside it.
"""

from __future__ import annotations

import os
from weakref import WeakValueDictionary

from .regular import MADE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

FOLDER = "assets"
"""The folder of their copies, and of copied and converted meshes, beside a document."""
_DIGITS = 12


class MadeFile:
    """A file in memory.

    Attributes:
        name: its path from a document beside which it is written; by its content, so that files of
            one name are equal.
        content: its bytes.
    """

    __slots__ = ("__weakref__", "content", "name")

    def __init__(self, name: str, content: bytes) -> None:
        self.name = name
        self.content = content

    @property
    def path(self) -> str:
        """Return the absolute path by which it is read."""
        return os.path.join(MADE, *self.name.split("/"))


_FILES: WeakValueDictionary[str, MadeFile] = WeakValueDictionary()


class MadeFiles:
    """The files that one build makes, by their names."""

    __slots__ = ("_files",)

    def __init__(self) -> None:
        self._files: dict[str, MadeFile] = {}

    def make(self, stem: str, ending: str, content: bytes) -> str:
        """Make a file; return its name, which begins with `stem`."""
        plain = "".join(
            each if (each.isascii() and each.isalnum()) or each == "-" else "_" for each in stem
        )
        name = f"{FOLDER}/{named_by_content(plain[:100] or 'mesh', ending, [content])}"
        self._add(name, content)
        return name

    def adopt(self, files: Mapping[str, bytes]) -> None:
        """Take files that another process made.

        Raises:
            ValueError: one is not called by its content.
        """
        for name, content in files.items():
            folder, _, base = name.partition("/")
            stem, ending = os.path.splitext(base)
            if folder != FOLDER or "/" in base or named_by_content(stem, ending, [content]) != base:
                raise ValueError(f"'{name}' is not the name of a file that a build makes")
            self._add(name, content)

    def _add(self, name: str, content: bytes) -> None:
        file = MadeFile(name, content)
        self._files[name] = _FILES.setdefault(file.path, file)

    def path_of(self, name: str) -> str | None:
        """Return the path of a file of this name, or None if there is none."""
        file = self._files.get(name)
        return None if file is None else file.path

    def of(self, paths: list[str]) -> dict[str, bytes]:
        """Return the files with these paths, as names and contents; other paths are passed over."""
        found = {file.path: file for file in self._files.values()}
        return {found[path].name: found[path].content for path in paths if path in found}

    def all(self) -> dict[str, bytes]:
        """Return the contents of all files by their names."""
        return {name: file.content for name, file in self._files.items()}


def is_made(path: str) -> bool:
    """Return whether a path is that of a file in memory."""
    return path.startswith(MADE)


def content_of(path: str) -> bytes:
    """Return the bytes of a file in memory.

    Raises:
        FileNotFoundError: the build that made it is gone.
    """
    file = _FILES.get(path)
    if file is None:
        raise FileNotFoundError(2, os.strerror(2), path)
    return file.content


def named_by_content(stem: str, ending: str, contents: list[bytes]) -> str:
    """Return a name marked with a digest of contents; that of a copy is not marked twice."""
    from hashlib import sha256

    digest = sha256()
    for content in contents:
        digest.update(len(content).to_bytes(8, "little"))
        digest.update(content)
    mark = f"-{digest.hexdigest()[:_DIGITS]}"
    return f"{stem.removesuffix(mark)}{mark}{ending}"
