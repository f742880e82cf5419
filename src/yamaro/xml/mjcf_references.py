"""What names what in MJCF: for its reader, and where the names in blocks for it change."""

from __future__ import annotations

from .values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from .tree import Element

REFERENCES = {
    "joint": "joint", "joint1": "joint", "joint2": "joint", "jointinparent": "joint",
    "body": "body", "body1": "body", "body2": "body", "target": "body", "node": "body",
    "subtree1": "body", "subtree2": "body",
    "site": "site", "site1": "site", "site2": "site", "cranksite": "site", "slidersite": "site",
    "refsite": "site", "sidesite": "site",
    "geom": "geom", "geom1": "geom", "geom2": "geom",
    "tendon": "tendon", "tendon1": "tendon", "tendon2": "tendon",
    "actuator": "actuator", "camera": "camera", "mesh": "mesh", "hfield": "hfield",
    "material": "material", "texture": "texture", "flex": "flex", "instance": "plugin",
}  # fmt: skip
"""The attributes that name something, and the kinds of what they name."""
OBJECTS = {"objname": "objtype", "refname": "reftype"}
"""The attributes that name something whose kind another one says."""
DIRECTIONS = frozenset(("framequat", "framexaxis", "frameyaxis", "framezaxis"))
"""The sensors that measure the axes of what they are at."""
SHARED = frozenset(("material", "texture", "mesh", "hfield", "key"))
"""What several robots in a document share, or what is found by its name, as a state is."""


def kind_in(element: Element, attribute: str) -> str | None:
    """Return the kind of what an attribute of an element names, or None if it names nothing."""
    if attribute in OBJECTS:
        kind = format_value(element.attributes.get(OBJECTS[attribute]))
        return "body" if kind == "xbody" else kind
    return REFERENCES.get(attribute)


def measured_bodies(sensor: str, said: Callable[[str], str | None]) -> set[str]:
    """Return the bodies along the axes of whose inertia a sensor measures.

    Args:
        sensor: the name of its element.
        said: gives the text of an attribute.
    """
    found = set()
    if sensor in DIRECTIONS and said("objtype") == "body":
        found.add(said("objname") or "")
    if said("reftype") == "body":
        found.add(said("refname") or "")
    return found


def words(element: Element, value: object) -> list[str]:
    """Return the names in the value of an attribute, of which only a flex has several."""
    text = format_value(value)
    return text.split() if element.name == "flex" else [text]


def references(element: Element) -> Iterator[tuple[str, str]]:
    """Yield what an element names: the kind and the name."""
    for attribute, value in element.attributes.items():
        kind = kind_in(element, attribute)
        if kind is not None:
            for word in words(element, value):
                yield kind, word
