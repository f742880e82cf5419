"""Compares what two robots have besides elements of URDF: their notes and blocks."""

from __future__ import annotations

from ...model.compare import Difference, compare
from ...model.values import values_of
from ...xml.tree import Element
from .elements import name_of
from .notes import (
    ROBOT,
    actuators_in_order,
    frames_of_sites,
    home_of,
    is_setting,
    made_names,
    settings_of,
    without_name,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...xml.tree import Node

OWN_ORDER = ("sensor", "state", "robot-group", "robot-loop")
"""The notes whose order means something."""


def compare_notes(
    expected: tuple[Element, Sequence[Element]], actual: tuple[Element, Sequence[Element]]
) -> list[Difference]:
    """Return what differs in the notes and blocks of two robots, each with its `<robot>`."""
    first, second = _sorted_notes(*expected), _sorted_notes(*actual)
    differences: list[Difference] = []
    for key, note in first.items():
        if key not in second:
            differences.append(Difference((key,), "is missing"))
            continue
        differences += [
            Difference((key, *each.path[1:]), each.message) for each in compare(note, second[key])
        ]
    differences += [Difference((key,), "should not be there") for key in second if key not in first]
    in_blocks = {f"sensor '{name_of(each)}'" for each in expected[1] if "of" in each.attributes}
    orders = [actuators_in_order(notes) for _, notes in (expected, actual)]
    if orders[0] != orders[1] and sorted(orders[0]) == sorted(orders[1]):
        differences.append(Difference(("actuators",), "are in another order"))
    for kind in OWN_ORDER:
        rows = [
            [key for key, note in notes.items() if note.name == kind and key not in in_blocks]
            for notes in (first, second)
        ]
        if rows[0] != rows[1] and sorted(rows[0]) == sorted(rows[1]):
            differences.append(Difference((f"{kind}s",), "are in another order"))
    return differences


def _sorted_notes(root: Element, notes: Sequence[Element]) -> dict[str, Element]:
    """Return the notes of a robot by what they are, all blocks of one thing in one.

    What a block of a link says of a site is said of the link that the site is.
    """
    found: dict[str, Element] = {}
    blocks: dict[tuple[str, str, str], list[Element]] = {}
    frames = frames_of_sites(root, notes)
    for note in notes:
        values = values_of(note)
        home = home_of(note)
        if note.name == "naming":
            continue
        if note.name == "raw-block":
            for each in note.elements():
                if each.name == "actuator" and home == ROBOT:
                    each = each.with_children(
                        [own for own in each.elements() if [*own.attributes] != ["joint"]]
                    )
                    if not each.children and not each.attributes:
                        continue  # it only says the order
                frame = frames.get((home[1], name_of(each)))
                if each.name == "site" and home[0] == "link" and frame is not None:
                    block = blocks.setdefault((values["format"], "link", frame), [])
                    block += settings_of(each)
                else:
                    blocks.setdefault((values["format"], *home), []).append(each)
            continue
        key = f"{note.name} '{name_of(note)}'" if name_of(note) else note.name
        if note.name in ("actuator", "dynamics", "surface"):
            key = f"{note.name} of {home[0]} '{home[1]}'"
            key += f", collision {values['index']}" if note.name == "surface" else ""
        note = _without(note, "of")  # the format whose blocks have it as well
        if note.name == "state":
            note = note.with_children([_without(each, "written") for each in note.elements()])
        if note.name == "base" or key not in found:
            found[key] = note
        elif note.name == "state":
            found[key] = found[key].with_children([*found[key].children, *note.children])
    for (format, kind, name), elements in blocks.items():
        key = f"{format} of {kind} '{name}'" if (kind, name) != ROBOT else format
        by_tag: dict[str, list[Element]] = {}
        for each in elements:
            by_tag.setdefault("" if is_setting(each) else each.name, []).append(each)
        by_tag.get("", []).sort(key=lambda setting: setting.name)
        geoms = [each for each in by_tag.get("geom", []) if [*each.attributes] != ["name"]]
        by_tag["geom"] = sorted(geoms, key=name_of)  # their order means nothing
        ordered: list[Node] = [each for _, row in sorted(by_tag.items()) for each in row]
        if ordered:
            found[key] = Element("block", elements[0].span, {}, ordered)
    return found


def without_made_names(root: Element) -> Element:
    """Return a robot without the names of shapes that the reader of MJCF made up."""
    children: list[Node] = []
    for child in root.children:
        if isinstance(child, Element) and child.name == "link":
            made = {id(each): without_name(each) for each in made_names(child)}
            inner = [made.get(id(each), each) for each in child.children]
            child = child.with_children(inner) if made else child
        children.append(child)
    return root.with_children(children)


def _without(element: Element, attribute: str) -> Element:
    copy = element.with_children(element.children)
    copy.attributes = {name: value for name, value in element.attributes.items()
                       if name != attribute}  # fmt: skip
    return copy
