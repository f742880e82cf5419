"""Whether a mesh stays within bounds, and which other files it names, before a library reads it.

A few kilobytes can place a body a million times, or define entities that grow. So each format's own
way to repeat things is counted first. All of it is linear.
"""

from __future__ import annotations

import os
from urllib.parse import unquote

from .formats import DAE, GLB, GLTF, OBJ, PLY, MeshFileError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import Any

MOST_PLACED = 10_000
"""Bodies that a file may place, each as often as it is placed."""
MOST_BYTES_PLACED = 512 << 20
"""Bytes of the descriptions of those bodies, each counted as often as it is placed."""
BODY = 5_000
"""Corners whose reading takes as long as making a body of them."""
MOST_CORNERS_SORTED = 100_000_000
"""Corners of an OBJ, times its materials."""
MOST_NAMES = 256
"""Other files that a mesh or material may name."""
LARGEST_MATERIALS = 4 << 20
"""Bytes of an MTL file."""


def check_bounds(data: bytes, kind: str) -> list[str]:
    """Return the names of other files in a mesh, as they are written.

    Raises:
        MeshFileError: it is not of that format, or its content would grow beyond all bounds.
    """
    checks: dict[str, Callable[[bytes], list[str]]] = {
        DAE: check_collada,
        GLTF: check_gltf,
        GLB: check_glb,
        OBJ: _check_obj,
        PLY: _check_ply,
    }
    return checks[kind](data) if kind in checks else []


def path_of(folder: str, name: str) -> str:
    """Return the path of a file that a mesh names."""
    name = name.removeprefix("file://").removeprefix("./")
    name = unquote(name).replace("\\", "/") if "%" in name or "\\" in name else name
    return os.path.normpath(os.path.join(folder, name)) if "\0" not in name else ""


class Body:
    """What can be placed: a node or object with what it holds.

    Attributes:
        own: bodies that it is itself, and the bytes of their descriptions.
        inside: the keys or bodies that it places.
    """

    __slots__ = ("inside", "own")

    def __init__(self) -> None:
        self.own: list[tuple[int, int]] = []
        self.inside: list[Body | str] = []


def check_placed(roots: Iterable[Body], known: dict[str, list[Body]]) -> None:
    """Raise MeshFileError if bodies place one another in a circle, or too often.

    Args:
        roots: what the scene shows.
        known: bodies by their keys.
    """
    sums: dict[int, tuple[int, int]] = {}
    placed = size = 0
    for root in roots:
        own_placed, own_size = _summed(root, known, sums)
        placed, size = placed + own_placed, size + own_size
        if placed > MOST_PLACED or size > MOST_BYTES_PLACED:
            raise MeshFileError(f"it places more than {MOST_PLACED:,} bodies, or too large ones")


def _summed(
    root: Body, known: dict[str, list[Body]], sums: dict[int, tuple[int, int]]
) -> tuple[int, int]:
    """Return how many bodies a body places, and their bytes; without recursion."""
    entered: set[int] = set()
    pending: list[tuple[Body, bool]] = [(root, False)]
    while pending:
        body, is_left = pending.pop()
        key = id(body)
        inside = []
        for each in body.inside:
            inside += known.get(each, []) if isinstance(each, str) else [each]
        if is_left:
            parts = [*body.own, (1, 0), *(sums[id(each)] for each in inside)]
            sums[key] = (sum(part[0] for part in parts), sum(part[1] for part in parts))
            continue
        if key in sums:
            continue
        if key in entered:
            raise MeshFileError("its bodies place one another in a circle")
        entered.add(key)
        pending.append((body, True))
        pending.extend((each, False) for each in inside if id(each) not in sums)
    return sums[id(root)]


# --- texts --------------------------------------------------------------------------------------


def _check_obj(data: bytes) -> list[str]:
    """Return the names after `mtllib`."""
    materials = _lines_after(data, b"usemtl", MOST_PLACED)
    # The library sorts the corners for each, and makes a body of it.
    work = len(materials) * (data.count(b"v ") + BODY)
    if len(materials) >= MOST_PLACED or work > MOST_CORNERS_SORTED:
        raise MeshFileError("it has too many materials")
    names = _lines_after(data, b"mtllib", MOST_NAMES)
    return [name.decode("utf-8", "replace") for name in names]


def _lines_after(data: bytes, word: bytes, most: int) -> list[bytes]:
    """Return what follows a word at the start of a line, each once; a line is looked at once."""
    found: dict[bytes, None] = {}
    end = 0
    while (start_of_word := data.find(word, end)) >= 0 and len(found) < most:
        start = data.rfind(b"\n", end, start_of_word) + 1 or end
        end = data.find(b"\n", start_of_word)
        end = len(data) if end < 0 else end
        after = start_of_word + len(word)
        if not data[start:start_of_word].strip() and data[after : after + 1] in (b" ", b"\t"):
            found.setdefault(data[after:end].strip())
    return list(found)


def names_in_materials(data: bytes) -> list[str]:
    """Return the names of images in an MTL file; options may be before a name."""
    names: list[str] = []
    for line in data[:LARGEST_MATERIALS].splitlines():
        words = line.split(None, 1)
        if len(words) < 2 or not (
            words[0].startswith(b"map_") or words[0] in (b"bump", b"disp", b"norm")
        ):
            continue
        name = words[1].strip().decode("utf-8", "replace")
        names.append(name)
        if name.startswith("-"):  # as in "map_Kd -s 1 1 1 wood.png"
            names.append(name.split()[-1])
        if len(names) >= MOST_NAMES:
            break
    return list(dict.fromkeys(names))


def _check_ply(data: bytes) -> list[str]:
    """Refuse a header that promises more than the file can hold."""
    end = data.find(b"end_header", 0, 1 << 16)
    if end < 0:
        raise MeshFileError("its header has no end")
    for line in data[:end].splitlines():
        words = line.split()
        if words[:1] == [b"element"]:
            _check_count(words[-1], len(data))
    return []


def _check_count(word: bytes, size: int) -> None:
    if not word.isdigit() or len(word) > 12 or int(word) > size:
        raise MeshFileError("it says that it holds more than it can")


# --- glTF: nodes are a tree, and accessors no longer than what is in a file -------------------


LARGEST_JSON = 64 << 20
MOST_NUMBERS = 50_000_000
"""Items of all accessors, each as often as a primitive of a node uses it."""
_CHUNK = b"JSON"


def check_glb(data: bytes) -> list[str]:
    """Return the names of other files in a binary glTF."""
    if data[16:20] != _CHUNK:
        raise MeshFileError("its first chunk is not JSON")
    return check_gltf(data[20 : 20 + int.from_bytes(data[12:16], "little")])


def check_gltf(data: bytes) -> list[str]:
    """Return the names of other files in a glTF; raise MeshFileError if it is out of bounds."""
    import json

    if len(data) > LARGEST_JSON:
        raise MeshFileError(f"its JSON is larger than {LARGEST_JSON >> 20} MB")
    try:
        document: Any = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise MeshFileError(f"its JSON is broken: {error}") from None
    if not isinstance(document, dict) or not isinstance(document.get("asset"), dict):
        raise MeshFileError("it is not glTF")
    try:
        # Of nodes with two parents, or in a circle, readers would find no end.
        nodes = _list(document, "nodes")
        above: dict[int, int] = {}
        for number, node in enumerate(nodes):
            for child in node.get("children", ()):
                _index(child, nodes)
                if child in above:
                    raise MeshFileError("its nodes are not a tree")
                above[child] = number
        reached = [number for number in range(len(nodes)) if number not in above]
        for number in reached:  # grows meanwhile
            reached += nodes[number].get("children", ())
        if len(reached) != len(nodes):
            raise MeshFileError("its nodes are not a tree")
        _check_numbers(document)
        entries = [*_list(document, "buffers"), *_list(document, "images")]
        names = [entry.get("uri") for entry in entries]
    except (AttributeError, TypeError, IndexError, KeyError):
        raise MeshFileError("its parts are not as glTF has them") from None
    uris = [name for name in names if isinstance(name, str) and not name.startswith("data:")]
    return list(dict.fromkeys(uris))[:MOST_NAMES]


def _list(document: dict[str, Any], name: str) -> list[Any]:
    found = document.get(name, [])
    if not isinstance(found, list):
        raise TypeError(name)
    return found


def _index(value: object, entries: list[Any]) -> Any:
    if type(value) is not int or not 0 <= value < len(entries):
        raise IndexError(value)
    return entries[value]


def _check_numbers(document: dict[str, Any]) -> None:
    counts = [_count_of(accessor) for accessor in _list(document, "accessors")]
    sizes, bodies = [], []
    for mesh in _list(document, "meshes"):
        size = 0
        for primitive in mesh["primitives"]:
            used = [*primitive.get("attributes", {}).values(), primitive.get("indices", -1)]
            size += sum(_index(each, counts) for each in used if each != -1)
        sizes.append(size)
        bodies.append(len(mesh["primitives"]))
    placed = [node["mesh"] for node in _list(document, "nodes") if "mesh" in node]
    if max(sum(bodies), sum(_index(each, bodies) for each in placed)) > MOST_PLACED:
        raise MeshFileError(f"it places more than {MOST_PLACED:,} bodies")
    uses = BODY * sum(_index(each, bodies) for each in placed)
    if uses + sum(sizes) + sum(_index(each, sizes) for each in placed) > MOST_NUMBERS:
        raise MeshFileError("its accessors have too many items")


def _count_of(accessor: dict[str, Any]) -> int:
    count = accessor["count"]
    if type(count) is not int or count < 0:
        raise TypeError(count)
    return count


# --- COLLADA -----------------------------------------------------------------------------------


DEEPEST = 200
"""Elements in one another."""
_ENCODINGS = frozenset(("utf-8", "utf-16", "us-ascii", "ascii", "iso-8859-1", "windows-1252"))


class _Collada:
    """The nodes of a COLLADA file, and the images that it names, read through Expat."""

    def __init__(self, data: bytes) -> None:
        """Read a file; raise MeshFileError if it is not XML, or not of this kind."""
        from pyexpat import ExpatError, ParserCreate

        self.names: list[str] = []
        self.roots: list[Body] = []
        self.nodes: dict[str, list[Body]] = {}
        self._open: list[Body] = []
        self._geometry = ("", 0)
        self._depth = 0
        self._text: list[str] | None = None
        self._parser: Any = ParserCreate()
        self._parser.XmlDeclHandler = self._declared
        self._parser.StartDoctypeDeclHandler = self._doctype
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        try:
            self._parser.Parse(data, True)
        except ExpatError as error:
            raise MeshFileError(f"its XML is broken: {error}") from None
        except (ValueError, LookupError) as error:  # of an encoding that there is not
            raise MeshFileError(f"it cannot be decoded: {error}") from None

    def _declared(self, _version: str, encoding: str | None, _standalone: int) -> None:
        if encoding is not None and encoding.lower() not in _ENCODINGS:
            raise MeshFileError("its encoding is not UTF-8")

    @staticmethod
    def _doctype(*_: object) -> None:
        raise MeshFileError("it has a document type, which meshes do not need")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        name = tag.rpartition(":")[2]
        if self._depth == 0 and name != "COLLADA":
            raise MeshFileError("its root is not <COLLADA>")
        self._depth += 1
        if self._depth > DEEPEST:
            raise MeshFileError(f"it has more than {DEEPEST} elements in one another")
        if name in ("node", "visual_scene"):
            body = Body()
            (self._open[-1].inside if self._open else self.roots).append(body)
            self._open.append(body)
            if name == "node" and "id" in attributes:
                self.nodes.setdefault(f"#{attributes['id']}", []).append(body)
        elif name == "instance_node" and self._open:
            self._open[-1].inside.append(attributes.get("url", ""))
        elif name in ("instance_geometry", "instance_controller") and self._open:
            self._open[-1].inside.append(f"geometry {attributes.get('url', '')}")
        elif name == "geometry":
            self._geometry = (attributes.get("id", ""), self._parser.CurrentByteIndex)
        elif name == "init_from" and len(self.names) < MOST_NAMES:
            self._text = []
            self._parser.CharacterDataHandler = self._text.append

    def _end(self, tag: str) -> None:
        self._depth -= 1
        name = tag.rpartition(":")[2]
        if name in ("node", "visual_scene"):
            self._open.pop()
        elif name == "geometry":
            own, start = self._geometry
            body = Body()
            body.own.append((0, self._parser.CurrentByteIndex - start))
            self.nodes.setdefault(f"geometry #{own}", []).append(body)
        elif name == "init_from" and self._text is not None:
            self.names.append("".join(self._text).strip())
            self._text = None
            self._parser.CharacterDataHandler = None


def check_collada(data: bytes) -> list[str]:
    """Return the names of images in a COLLADA file; raise MeshFileError if it is out of bounds."""
    reader = _Collada(data)
    check_placed(reader.roots, reader.nodes)
    return [name for name in dict.fromkeys(reader.names) if name]
