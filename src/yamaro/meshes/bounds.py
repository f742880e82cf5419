"""Whether a mesh stays within bounds, and which other files it names, before a library reads it.

A few kilobytes can place a body a million times, hold an archive of gigabytes, or define entities
that grow. So each format's own way to repeat things is counted first. All of it is linear.
"""

from __future__ import annotations

import os
from urllib.parse import unquote

from .formats import DAE, GLB, GLTF, OBJ, OFF, PLY, THREEMF, MeshFileError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

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
    return _checks()[kind](data) if kind in _checks() else []


def _checks() -> dict[str, Callable[[bytes], list[str]]]:
    from .gltf_bounds import check_glb, check_gltf
    from .xml_bounds import check_collada, check_threemf

    return {
        DAE: check_collada,
        THREEMF: check_threemf,
        GLTF: check_gltf,
        GLB: check_glb,
        OBJ: _check_obj,
        PLY: _check_ply,
        OFF: _check_off,
    }


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
        inside = _inside(body, known)
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


def _inside(body: Body, known: dict[str, list[Body]]) -> list[Body]:
    found = []
    for each in body.inside:
        found += known.get(each, []) if isinstance(each, str) else [each]
    return found


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


def _check_off(data: bytes) -> list[str]:
    words: list[bytes] = []
    for line in data[: 1 << 16].splitlines():
        words += line.partition(b"#")[0].split()
        if len(words) >= 4:
            break
    for word in words[1:4]:
        _check_count(word, len(data))
    return []


def _check_count(word: bytes, size: int) -> None:
    if not word.isdigit() or len(word) > 12 or int(word) > size:
        raise MeshFileError("it says that it holds more than it can")
