"""What comes with what is attached; and `<replicate>`, which puts copies under other names."""

from __future__ import annotations

from ...diagnostics import YamaroError, failure
from ...model.pose import UNTURNED, ZERO, rotate
from ...xml.mjcf_references import kind_in, references, words
from ...xml.tree import Element
from .compiler import fault, given_by, numbers, vector
from .document import WORLD, text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ...policy import Limits
    from ...xml.tree import Node
    from .compiler import Compiler
    from .document import Document

    Names = set[tuple[str, str]]
    """Names, each with the kind of what has it."""

ASSETS = frozenset(("mesh", "hfield", "material", "texture", "plugin"))
"""The kinds that are in no body."""
WORLD_BODY = "world"
"""The name of the body around all others."""
SUFFIX = "{suffix}"
"""What is after the names in a document that a copy attaches, as an attribute of `<attach>`."""
IN_BODIES = {"freejoint": "joint", "flexcomp": "flex"}
COST = 25
"""As many statements of YAML take about as long as an element that is copied."""
SECTIONS = {
    "tendon": "tendon", "actuator": "actuator", "sensor": "sensor", "equality": "equality",
    "contact": "contact", "custom": "custom", "deformable": "deformable",
}  # fmt: skip
"""The sections whose elements name what is in bodies, and the kinds of these."""


def names_in(element: Element) -> Names:
    """Return the names of what is in an element, and its own."""
    found = set()
    for each in element.iter():
        name = text(each, "name")
        if name:
            found.add((IN_BODIES.get(each.name, each.name), name))
    return found


def _copy(element: Element, change: Callable[[Element, dict[str, object]], None]) -> Element:
    """Return a copy of an element and all in it, with changed attributes."""
    attributes = dict(element.attributes)
    change(element, attributes)
    children: list[Node] = [
        _copy(child, change) if isinstance(child, Element) else child for child in element.children
    ]
    return Element(
        element.name, element.span, attributes, children, value_spans=element.value_spans
    )


def renamed(element: Element, suffix: str, names: Names, *, is_named: bool) -> Element:
    """Return a copy with a suffix after some names; `is_named`: also those of what is in it."""

    def change(each: Element, attributes: dict[str, object]) -> None:
        for attribute, value in attributes.items():
            kind = kind_in(each, attribute)
            if kind is not None:
                found = words(each, value)
                if any((kind, name) in names for name in found):
                    changed = (name + suffix * ((kind, name) in names) for name in found)
                    attributes[attribute] = " ".join(changed)
        if each.name == "attach":
            attributes[SUFFIX] = str(attributes.get(SUFFIX, "")) + suffix
        own = text(each, "name")
        if own and (is_named or each is element):
            attributes["name"] = own + suffix

    return _copy(element, change)


def refers_to(element: Element, names: Names) -> bool:
    """Return whether an element, or one in it, names one of these."""
    return any(reference in names for each in element.iter() for reference in references(each))


def too_many(element: Element, limits: Limits) -> YamaroError:
    """Return the error for copies of more elements than the limit of statements allows."""
    return failure(
        "limit-statements",
        f"this {element.name} copies more than {limits.statements // COST:,} elements, the limit",
        element.span,
        hint=f"make fewer copies; {limits.hint('statements')}, of which a copy takes {COST}",
    )


def replicate(document: Document, compiler: Compiler, limits: Limits) -> None:
    """Put copies in the place of each `<replicate>`, and of what names what is in one.

    Raises:
        YamaroError: a value is faulty, or there are too many copies.
    """
    left = [limits.statements]
    for section in document.sections(WORLD):
        if any(each.name == "replicate" for each in section.iter()):
            _replicate_in(section, document, compiler, limits, left)


def _replicate_in(
    around: Element, document: Document, compiler: Compiler, limits: Limits, left: list[int]
) -> None:
    children: list[Node] = []
    for child in around.children:
        if isinstance(child, Element) and child.children:
            _replicate_in(child, document, compiler, limits, left)
        if isinstance(child, Element) and child.name == "replicate":
            children += _copies(child, document, compiler, limits, left)
        else:
            children.append(child)
    around.children = children


def _copies(
    element: Element, document: Document, compiler: Compiler, limits: Limits, left: list[int]
) -> list[Element]:
    """Return the copies of what is in a `<replicate>`, each in a frame of its own.

    Each is turned by the angles times its number, and moved from the one before as that is turned.
    """
    given = given_by(element)
    count = numbers(given, "count", 1)
    if count is None or count[0] < 1 or count[0] != int(count[0]):
        span = given["count"][1] if "count" in given else element.span
        raise fault("'count' is a whole number from 1", span, 'write count="4"')
    left[0] -= COST * int(count[0]) * sum(1 for _ in element.iter())
    if left[0] < 0:
        raise too_many(element, limits)
    offset, angles = vector(given, "offset"), numbers(given, "euler", 3) or [0.0, 0.0, 0.0]
    separator = given.get("sep", ("", None))[0]
    names: Names = set()
    for child in element.elements():
        names |= names_in(child)
    suffixes, found = [], []
    place = ZERO
    for index in range(int(count[0])):
        suffix = f"{separator}{index:0{len(str(int(count[0])))}}"
        suffixes.append(suffix)
        turn = [index * angle for angle in angles]
        attributes: dict[str, object] = {
            "pos": " ".join(map(repr, place)),
            "euler": " ".join(map(repr, turn)),
        }
        if "childclass" in given:
            attributes["childclass"] = given["childclass"][0]
        frame = Element("frame", element.span, attributes, value_spans=element.value_spans)
        frame.children = [
            renamed(child, suffix, names, is_named=True) if isinstance(child, Element) else child
            for child in element.children
        ]
        found.append(frame)
        rotation = compiler.euler(turn) if any(turn) else UNTURNED
        x, y, z = (p + q for p, q in zip(place, rotate(rotation, offset), strict=True))
        place = (x, y, z)
    _copy_referring(document, names, suffixes)
    return found


def _copy_referring(document: Document, names: Names, suffixes: list[str]) -> None:
    """Copy what names what was replicated, and what names these copies in turn."""
    pending = names
    while pending:
        made: Names = set()
        for section in document.root.elements():
            kind = SECTIONS.get(section.name)
            if kind is None:
                continue
            children: list[Node] = []
            for child in section.children:
                if isinstance(child, Element) and refers_to(child, pending):
                    name = text(child, "name")
                    if name:
                        made.add((kind, name))
                    children += [
                        renamed(child, suffix, pending, is_named=False) for suffix in suffixes
                    ]
                else:
                    children.append(child)
            section.children = children
        pending = made


def grown(names: Names, document: Document) -> Names:
    """Return names in a part of a document, with those of what names nothing outside of it."""
    found = {*names, ("body", WORLD_BODY)}
    pending = [
        (kind, each)
        for section in document.root.elements()
        if (kind := SECTIONS.get(section.name)) is not None
        for each in section.elements()
    ]
    for _ in SECTIONS:  # what is in one names what is in others
        left = []
        for kind, each in pending:
            if is_within(each, found):
                name = text(each, "name") or ""
                found |= {(kind, name), (each.name, name)}
            else:
                left.append((kind, each))
        if len(left) == len(pending):
            break
        pending = left
    return found


def is_within(element: Element, names: Names) -> bool:
    """Return whether an element names nothing in bodies and sections but what is among names."""
    return all(
        reference in names or reference[0] in ASSETS
        for each in element.iter()
        for reference in references(each)
    )
