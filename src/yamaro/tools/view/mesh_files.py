"""The files that the page may fetch: the meshes and textures of a robot, and what these refer to.

The page asks for them by keys made here, never by a path. A mesh names its textures and its
buffers itself, and whoever wrote it may be an enemy: so such a file counts only if it is of a kind
that meshes need, and lies where the robot may read.
"""

from __future__ import annotations

import json
import os
import re
from hashlib import blake2b
from urllib.parse import unquote

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...runtime.reach import Reach

CONTENT_TYPES = {
    ".stl": "model/stl",
    ".obj": "model/obj",
    ".dae": "model/vnd.collada+xml",
    ".gltf": "model/gltf+json",
    ".glb": "model/gltf-binary",
}
"""The meshes that the page can show, by the endings of their names."""
COMPANION_TYPES = {
    ".mtl": "model/mtl",
    ".bin": "application/octet-stream",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".webp": "image/webp",
    ".bmp": "image/bmp",
    ".gif": "image/gif",
    ".tga": "image/x-tga",
}
"""What a mesh or a material may have besides, by the endings of their names."""
MOST_BYTES_SEARCHED = 64 << 20
"""Bytes of a mesh in which names of other files are looked for."""
MOST_COMPANIONS = 256

_DAE_NAMES = re.compile(rb"<init_from>\s*(?:<ref>\s*)?([^<]+?)\s*<")
_OBJ_NAMES = re.compile(rb"^[ \t]*mtllib[ \t]+([^\r\n]+?)[ \t]*\r?$", re.MULTILINE)
_MTL_NAMES = re.compile(
    rb"^[ \t]*(?:map_\w+|bump|disp|norm)[ \t]+([^\r\n]+?)[ \t]*\r?$", re.MULTILINE
)
_GLTF_CHUNK = b"JSON"


class MeshFiles:
    """The files that may be fetched for one robot, by key.

    Attributes:
        paths: the file of each key.
    """

    __slots__ = ("_known", "_reach", "paths")

    def __init__(self, reach: Reach | None) -> None:
        """Begin without files; of those outside `reach` none will be given."""
        self._reach = reach
        self._known: dict[str, dict[str, object] | None] = {}
        self.paths: dict[str, str] = {}

    def add(self, path: str) -> dict[str, object] | None:
        """Return what the page has to know of a mesh or texture; None if it may not be read.

        That is its key, which changes with the file's content, its ending, and the keys of the
        files it refers to, by the names it has for them.
        """
        if path not in self._known:
            self._known[path] = self._describe(path)
        return self._known[path]

    def _describe(self, path: str) -> dict[str, object] | None:
        key = self._key(path, {**CONTENT_TYPES, **COMPANION_TYPES})
        if key is None:
            return None
        companions: dict[str, str] = {}
        for name, companion in _companions(path):
            companion_key = self._key(companion, COMPANION_TYPES)
            if companion_key is not None:
                companions[name] = companion_key
        return {"key": key, "ending": _ending(path), "companions": companions}

    def _key(self, path: str, types: dict[str, str]) -> str | None:
        """Note a file, and return its key, or None if it is not to be had."""
        if _ending(path) not in types:
            return None
        if self._reach is not None and not self._reach.allows(path):
            return None
        try:
            status = os.stat(path)
        except (OSError, ValueError):
            return None
        mark = f"{path}\0{status.st_mtime_ns}\0{status.st_size}"
        key = blake2b(mark.encode("utf-8", "surrogatepass"), digest_size=12).hexdigest()
        self.paths[key] = path
        return key


def content_type(path: str) -> str:
    """Return the MIME type of a file that may be fetched."""
    return {**CONTENT_TYPES, **COMPANION_TYPES}.get(_ending(path), "application/octet-stream")


def _ending(path: str) -> str:
    return os.path.splitext(path)[1].lower()


def _companions(path: str) -> Iterable[tuple[str, str]]:
    """Return name and path of each file that a mesh refers to, directly or through a material."""
    found: dict[str, str] = {}
    pending = [path]
    while pending and len(found) < MOST_COMPANIONS:
        owner = pending.pop()
        for name in _names_in(owner):
            companion = os.path.normpath(os.path.join(os.path.dirname(owner), _as_path(name)))
            if name not in found and os.path.isfile(companion):
                found[name] = companion
                if _ending(companion) == ".mtl":
                    pending.append(companion)
    return list(found.items())[:MOST_COMPANIONS]


def _names_in(path: str) -> list[str]:
    """Return the names of other files that a mesh or material has in it, as it spells them."""
    ending = _ending(path)
    if ending not in (".dae", ".obj", ".mtl", ".gltf", ".glb"):
        return []
    try:
        with open(path, "rb") as file:
            data = file.read(MOST_BYTES_SEARCHED)
    except OSError:
        return []
    if ending in (".gltf", ".glb"):
        return _names_in_gltf(data, is_binary=ending == ".glb")
    pattern = {".dae": _DAE_NAMES, ".obj": _OBJ_NAMES, ".mtl": _MTL_NAMES}[ending]
    names = [match.decode("utf-8", "replace") for match in pattern.findall(data)]
    if ending == ".mtl":  # options may stand before the name, as in "map_Kd -s 1 1 1 wood.png"
        names += [name.split()[-1] for name in names if name.startswith("-")]
    return list(dict.fromkeys(names))


def _names_in_gltf(data: bytes, *, is_binary: bool) -> list[str]:
    if is_binary:
        if data[16:20] != _GLTF_CHUNK:
            return []
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    try:
        document = json.loads(data)
        entries = [*document.get("buffers", ()), *document.get("images", ())]
        names = [entry.get("uri") for entry in entries]
    except (ValueError, AttributeError, TypeError, RecursionError):
        return []
    return [name for name in names if isinstance(name, str) and not name.startswith("data:")]


def _as_path(name: str) -> str:
    """Return the path that a name in a mesh stands for."""
    name = name.removeprefix("file://").removeprefix("./")
    return unquote(name).replace("\\", "/") if "%" in name or "\\" in name else name
