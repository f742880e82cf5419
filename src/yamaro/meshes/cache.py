"""Converted meshes on the disk, kept from one run to the next by what was converted.

The cache may be lost, broken or not writable at any time: then a mesh is converted again. An entry
is written whole before it gets its name, so that several processes can share the folder.
"""

from __future__ import annotations

import os
import sys
from functools import cache
from hashlib import sha256

from ..files.regular import read_start

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

VARIABLE = "YAMARO_CACHE"
"""The environment variable that names another folder, or turns the cache off."""
OFF = ("", "0", "no", "off", "false")
MOST_BYTES = 512 << 20
"""Bytes of all entries; the ones that were not used for longest are removed beyond that."""
LARGEST_ENTRY = MOST_BYTES // 8
_KEPT = 3 * MOST_BYTES // 4
_MAGIC = b"yamaro mesh 1\n"
"""Begins an entry; the number changes with what entries hold, or how meshes are converted."""
CONVERTERS = ("yamaro", "trimesh", "pycollada", "pillow", "numpy")
_DIGEST = 32
_ENDING = ".mesh"
_UNFINISHED = ".tmp"
SECONDS_TO_WRITE = 3600.0
"""Age at which an unfinished entry is one that nobody writes any more."""


class MeshCache:
    """A folder of entries, each named by a key."""

    __slots__ = ("_folder", "_is_pruned")

    def __init__(self, folder: str) -> None:
        """Keep entries in a folder, which is made when the first one is written."""
        self._folder = folder
        self._is_pruned = False

    def get(self, key: bytes) -> bytes | None:
        """Return an entry, or None if there is none or it is broken."""
        path = self._path(key)
        try:
            found = read_start(path, LARGEST_ENTRY + len(_MAGIC) + _DIGEST)
            content = found[len(_MAGIC) + _DIGEST :]
            if found[: -len(content) or None] != _MAGIC + sha256(content).digest():
                return None
            os.utime(path)  # used now, so that it is kept
        except (OSError, ValueError):
            return None
        return content

    def put(self, key: bytes, content: bytes) -> None:
        """Keep an entry, if that is possible."""
        if len(content) > LARGEST_ENTRY:
            return
        path = self._path(key)
        unfinished = f"{path}.{os.getpid()}-{os.urandom(4).hex()}{_UNFINISHED}"
        try:
            os.makedirs(self._folder, mode=0o700, exist_ok=True)
            with open(unfinished, "xb") as file:
                file.write(_MAGIC + sha256(content).digest() + content)
            os.replace(unfinished, path)
        except (OSError, ValueError):
            _remove(unfinished)
            return
        if not self._is_pruned:
            self._is_pruned = True
            self._prune()

    def _path(self, key: bytes) -> str:
        return os.path.join(self._folder, sha256(key).hexdigest() + _ENDING)

    def _prune(self) -> None:
        """Remove what was not used for longest if there is too much, and what was not finished."""
        import time

        entries: list[tuple[float, int, str]] = []
        try:
            with os.scandir(self._folder) as found:
                for each in found:
                    about = each.stat(follow_symlinks=False)
                    if each.name.endswith(_ENDING):
                        entries.append((about.st_mtime, about.st_size, each.path))
                    elif each.name.endswith(_UNFINISHED):
                        if about.st_mtime < time.time() - SECONDS_TO_WRITE:
                            _remove(each.path)
        except OSError:  # another process prunes as well
            return
        size = sum(each[1] for each in entries)
        if size <= MOST_BYTES:
            return
        for _, bytes_freed, path in sorted(entries):
            if size <= _KEPT:
                return
            _remove(path)
            size -= bytes_freed


def _remove(path: str) -> None:
    try:
        os.unlink(path)
    except (OSError, ValueError):
        return


def cache_folder(environ: Mapping[str, str], platform: str = sys.platform) -> str | None:
    """Return where the cache is; None if it is turned off, or there is no home folder.

    Sources: the XDG Base Directory Specification, by which relative paths do not count; Apple's
    File System Programming Guide; Microsoft's known folders.
    """
    own = environ.get(VARIABLE)
    if own is not None:
        return None if own.strip().lower() in OFF or not os.path.isabs(own) else own
    home = os.path.expanduser("~")
    named = environ.get("LOCALAPPDATA" if platform == "win32" else "XDG_CACHE_HOME", "")
    if platform == "win32":
        top, inner = named, os.path.join("yamaro", "Cache")
    elif platform == "darwin" and not named:
        top, inner = os.path.join(home, "Library", "Caches"), "yamaro"
    else:
        top, inner = named if os.path.isabs(named) else os.path.join(home, ".cache"), "yamaro"
    return os.path.join(top, inner, "meshes") if os.path.isabs(top) else None


def key_of(work: str, data: bytes, kind: str, path: str) -> bytes | None:
    """Return what decides what a mesh or texture is converted to: the converter and all it reads.

    Args:
        work: what is done with it.
        data: the bytes of the file.
        kind: its format.
        path: where it is; the files that it names are looked for beside it.

    Returns:
        The key, or None if it is not known what is read.
    """
    from .bounds import check_bounds, names_in_materials
    from .formats import OBJ, MeshFileError

    parts = [_MAGIC, work.encode(), _converter().encode(), kind.encode(), data]
    try:
        names = check_bounds(data, kind)
    except MeshFileError:
        return None
    for name in names:
        for target, content in _contents_beside(path, name):
            parts += [os.fsencode(name), content]
            if kind == OBJ and content:
                for inner in names_in_materials(content):
                    for _, texture in _contents_beside(target, inner):
                        parts += [os.fsencode(inner), texture]
    return b"".join(sha256(each).digest() for each in parts)


def _contents_beside(path: str, name: str) -> Iterator[tuple[str, bytes]]:
    """Yield where a file may be that another one names, and what is in it: nothing if it is not.

    The loader tries the name, and its last word.
    """
    from .bounds import path_of
    from .formats import LARGEST_FILE

    words = name.split()
    for spelling in dict.fromkeys((name.strip(), words[-1] if words else "")):
        target = path_of(os.path.dirname(path), spelling)
        try:
            yield target, read_start(target, LARGEST_FILE)
        except (OSError, ValueError):
            yield target, b""


@cache
def _converter() -> str:
    """Return the versions of what converts; another version may give something else."""
    from importlib.metadata import PackageNotFoundError, version

    found = []
    for package in CONVERTERS:
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            found.append(package)
    return "\n".join(found)
