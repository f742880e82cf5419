"""The files that the page may fetch: meshes and textures of a robot, and companions of these.

The page asks for them by keys made here, never by a path. A mesh names its textures and its
buffers itself, and may be untrusted: so such a file counts only if its bytes are of a kind that
meshes need, and it lies where the robot may read. That is looked up in a jail where there is one.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from hashlib import blake2b

from ...confined import Reader
from ...files.readable import Reach
from ...files.regular import MADE, read_start
from ...meshes.bounds import (
    LARGEST_MATERIALS,
    MOST_NAMES,
    check_bounds,
    names_in_materials,
    path_of,
)
from ...meshes.formats import (
    BMP,
    DAE,
    GIF,
    GLB,
    GLTF,
    JPEG,
    LARGEST_FILE,
    OBJ,
    PNG,
    STL,
    TGA,
    WEBP,
    MeshFileError,
    image_format,
    mesh_format,
    unreadable,
)
from ...sandbox.jail.protocol import JailError, pack, unpack

MATERIALS, BUFFER = "mtl", "bin"
CONTENT_TYPES = {
    STL: "model/stl",
    OBJ: "model/obj",
    DAE: "model/vnd.collada+xml",
    GLTF: "model/gltf+json",
    GLB: "model/gltf-binary",
    MATERIALS: "model/mtl",
    BUFFER: "application/octet-stream",
    PNG: "image/png",
    JPEG: "image/jpeg",
    WEBP: "image/webp",
    BMP: "image/bmp",
    GIF: "image/gif",
    TGA: "image/x-tga",
}
"""What the page can show, by formats."""
_MESHES = (STL, OBJ, DAE, GLTF, GLB)
_SIGN_BYTES = 64
MOST_REFUSED = 8
"""Textures of a mesh that are named when they are not images."""


class Contents:
    """The type of a mesh or texture, by its bytes.

    Attributes:
        kind: its format; "" if it has none that the page can show.
        fault: why it is not shown, or "".
        companions: path and format of each file that it refers to, by the names it has for them.
        refused: names of files that it refers to as textures, and that are not images.
    """

    __slots__ = ("companions", "fault", "kind", "refused")

    def __init__(self, kind: str, fault: str = "") -> None:
        self.kind = kind
        self.fault = fault
        self.companions: dict[str, tuple[str, str]] = {}
        self.refused: list[str] = []


class Library:
    """The contents of files, each looked up once for as long as it stays as it is."""

    def __init__(self, reader: Reader | None, reach: Reach | None) -> None:
        """Begin; `reader` may be None for files that are trusted."""
        self._reader = reader
        self._reach = reach
        self._known: dict[str, tuple[str, Contents]] = {}

    def look_up(self, paths: Iterable[str]) -> None:
        """Look at several files at once."""
        marks = {path: _mark(path) for path in dict.fromkeys(paths)}
        self._known = {
            path: known for path, known in self._known.items() if marks.get(path) == known[0]
        }
        new = [path for path, mark in marks.items() if mark and path not in self._known]
        for path, contents in zip(new, self._read(new), strict=True):
            self._known[path] = (marks[path], contents)

    def contents(self, path: str) -> tuple[str, Contents] | None:
        """Return mark and contents of a file; None if it is not there."""
        mark = _mark(path)
        if not mark:
            return None
        known = self._known.get(path)
        if known is None or known[0] != mark:
            known = self._known[path] = (mark, self._read([path])[0])
        return known

    def _read(self, paths: Sequence[str]) -> list[Contents]:
        """Return what files are, read in one jail, or one by one if that one is ended."""
        try:
            return self._read_together(paths)
        except (JailError, ValueError) as error:
            if len(paths) == 1:
                return [Contents("", f"reading it was ended: {error}")]
        return [self._read([path])[0] for path in paths]

    def _read_together(self, paths: Sequence[str]) -> list[Contents]:
        def work() -> bytes:
            found = [_look_at(path, self._reach) for path in paths]
            parts = [[each.kind, each.fault, each.companions, each.refused] for each in found]
            return pack([json.dumps(each).encode() for each in parts])

        if not paths:
            return []
        data = work() if self._reader is None else self._reader.run(work)
        found = [_from_bytes(each) for each in unpack(data)]
        if len(found) != len(paths):
            raise ValueError("the answer holds another number of files")
        return found


class MeshFiles:
    """The files that may be fetched for one robot, by key.

    Attributes:
        paths: the file of each key.
        types: the MIME type of each key.
    """

    __slots__ = ("_library", "_reach", "paths", "types")

    def __init__(self, reach: Reach | None, library: Library | None = None) -> None:
        """Begin without files; of those outside `reach` none will be given."""
        self._reach = reach
        self._library = library or Library(None, reach)
        self.paths: dict[str, str] = {}
        self.types: dict[str, str] = {}

    def add(self, path: str) -> dict[str, object] | None:
        """Return what the page has to know about a mesh or texture; None if it may not be read.

        That is its key, which changes with the file's content, its format as an ending, the keys
        of the files it refers to, by the names it has for them, and perhaps why it is not shown.
        """
        if not self._allows(path):
            return None
        found = self._library.contents(path)
        if found is None or not (found[1].kind or found[1].fault):
            return None
        contents = found[1]
        told: dict[str, object] = {"key": self._key(path, contents.kind), "companions": {}}
        told["ending"] = f".{contents.kind}"
        if contents.fault:
            return {**told, "fault": contents.fault}
        keys = {name: self._key(*each) for name, each in contents.companions.items()}
        told["companions"] = {name: key for name, key in keys.items() if key}
        return told

    def _allows(self, path: str) -> bool:
        return self._reach is None or path.startswith(MADE) or self._reach.allows(path)

    def refused_by(self, path: str) -> list[str]:
        """Return the names of textures in a mesh that are not images."""
        found = self._library.contents(path)
        return found[1].refused if found is not None else []

    def _key(self, path: str, kind: str) -> str:
        """Note a file, and return its key; nothing is noted of what may not be fetched."""
        mark = _mark(path)
        if not mark or not self._allows(path):
            return ""
        key = blake2b(mark.encode("utf-8", "surrogatepass"), digest_size=12).hexdigest()
        if kind in CONTENT_TYPES:
            self.paths[key] = path
            self.types[key] = CONTENT_TYPES[kind]
        return key


def _mark(path: str) -> str:
    """Return a text that changes with a file's content; "" if there is no file."""
    if path.startswith(MADE):
        return path  # which names its content
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return ""
    return f"{path}\0{status.st_mtime_ns}\0{status.st_size}"


# --- in the jail ----------------------------------------------------------------------------------


def _look_at(path: str, reach: Reach | None) -> Contents:
    """Return what a mesh or texture is."""
    try:
        start = read_start(path, _SIGN_BYTES)
        kind = image_format(start)
        if kind in CONTENT_TYPES:
            return Contents(str(kind))
        data = read_start(path, LARGEST_FILE + 1)
        if len(data) > LARGEST_FILE:
            raise MeshFileError(f"it is larger than {LARGEST_FILE >> 20} MB")
        kind = mesh_format(data)
        if kind is None:
            raise unreadable(path)
        if kind not in _MESHES:
            return Contents("")
        contents = Contents(kind)
        _add_companions(contents, path, check_bounds(data, kind), reach)
        return contents
    except MeshFileError as error:
        return Contents("", str(error))
    except OSError as error:
        return Contents("", error.strerror or str(error))
    except (MemoryError, RecursionError):
        return Contents("", "it takes too much memory")


def _add_companions(
    contents: Contents, path: str, names: Sequence[str], reach: Reach | None
) -> None:
    """Add path and format of each file that a mesh names, directly or through a material."""
    found = contents.companions
    pending = [(os.path.dirname(path), name, contents.kind) for name in names]
    while pending and len(found) < MOST_NAMES:
        folder, name, owner = pending.pop(0)
        companion = path_of(folder, name)
        if name in found or not companion or (reach is not None and not reach.allows(companion)):
            continue
        try:
            found_kind = _kind_of_companion(companion, owner)
            if found_kind == MATERIALS:
                data = read_start(companion, LARGEST_MATERIALS)
                inner = names_in_materials(data)[: MOST_NAMES - len(found)]
                pending += [(os.path.dirname(companion), each, MATERIALS) for each in inner]
        except (OSError, ValueError):
            continue
        if found_kind:
            found[name] = (companion, found_kind)
        elif owner != OBJ and len(contents.refused) < MOST_REFUSED:
            contents.refused.append(name)


def _kind_of_companion(path: str, owner: str) -> str:
    """Return the format of a file that a mesh or material names; "" if they cannot use it.

    Buffers and materials have no sign, so their endings count too.
    """
    kind = image_format(read_start(path, _SIGN_BYTES))
    ending = os.path.splitext(path)[1].lower()
    if owner == OBJ:
        return MATERIALS if ending == ".mtl" else ""
    if owner in (GLTF, GLB) and ending == ".bin":
        return BUFFER
    return kind if kind is not None and kind in CONTENT_TYPES else ""


def _from_bytes(data: bytes) -> Contents:
    """Return the contents that some bytes describe; raise ValueError if they are malformed."""
    try:
        kind, fault, companions, refused = json.loads(data)
        if kind not in ("", *CONTENT_TYPES) or not isinstance(fault, str):
            raise ValueError("there is no such format")
        contents = Contents(kind, fault[:1000])
        contents.companions = {
            str(name): (str(path), str(own))
            for name, (path, own) in companions.items()
            if own in CONTENT_TYPES
        }
        contents.refused = [str(name)[:1000] for name in refused[:MOST_REFUSED]]
    except (TypeError, AttributeError, RecursionError) as error:
        raise ValueError(f"the answer is not valid: {error}") from None
    return contents
