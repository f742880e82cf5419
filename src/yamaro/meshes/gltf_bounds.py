"""Bounds of glTF: its nodes are a tree, and its accessors no longer than what is in a file."""

from __future__ import annotations

from .bounds import BODY, MOST_NAMES, MOST_PLACED
from .formats import MeshFileError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

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
        _check_tree(_list(document, "nodes"))
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


def _check_tree(nodes: list[Any]) -> None:
    """Refuse nodes with two parents, or in a circle: readers would not end."""
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
