"""The short forms of `material`: a name, a colour and a texture."""

from __future__ import annotations

from ..diagnostics import failure, suggest
from ..xml.tree import Comment, Element, Text
from .fields import (
    Record,
    check_once,
    check_plain,
    is_left_out,
    misspelt,
    read_record,
    refuse_misspelt,
    word_of,
)
from .numbers import read_attribute

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node
    from .lowering import Lowering

ENTRIES = ("name", "color", "texture")
EXAMPLE = "material: {name: red, color: 0.8 0.1 0.1 1}"


def lower_material(lowering: Lowering, key: Element) -> Element:
    """Return `<material name=…>` with `<color>` and `<texture>` as they are written.

    Raises:
        YamaroError: no name, or a faulty colour or texture.
    """
    record, details = _split(lowering, key)
    refuse_misspelt(record, ENTRIES)
    present = {*record.values, *(each.name for each in details if isinstance(each, Element))}
    for each in details:
        if type(each) is Element and each.name not in ENTRIES and not each.verbatim:
            near = suggest(each.name, ENTRIES)
            if near is not None:
                raise misspelt(key, each.span, each.name, near, present)
    if "name" not in record.values:
        raise failure(
            "missing-name",
            "a material needs a name",
            key.span,
            hint=f"write {EXAMPLE}, or material: red for one that is defined elsewhere",
            trace=key.trace,
        )
    is_short = any(isinstance(child, Text) for child in key.children)
    taken = _taken_details(record)
    details[:0] = taken
    value = record.values.pop("name")
    if value == "" and any(_is_look(detail) for detail in details):
        # exporters leave the name empty, and the colour says it all
        name = ""
    else:
        what = "material" if is_short else "name"
        name = word_of(what, value, record.span("name"), owner=key)
    return Element(
        "material",
        key.span,
        attributes={"name": name, **record.values},
        children=[_lower_detail(lowering, detail) for detail in details],
        trace=key.trace,
        value_spans=record.places(),
    )


def _split(lowering: Lowering, key: Element) -> tuple[Record, list[Node]]:
    """Return the material's attributes, the name among them, and the rest of its body."""
    named: list[Node] = []
    details: list[Node] = []
    seen: dict[str, Element] = {}
    for child in key.children:
        is_key = type(child) is Element and not child.verbatim
        if not is_key or not isinstance(child, Element):
            (details if isinstance(child, (Comment, Element)) else named).append(child)
            continue
        if is_left_out(child):
            continue
        if child.name not in ENTRIES:
            details.append(child)
            continue
        target = named if child.name == "name" else details
        if child.name in seen:
            check_once(lowering, seen[child.name], child)
            target.remove(seen[child.name])
        seen[child.name] = child
        target.append(child)
    head = Element(
        key.name,
        key.span,
        attributes=key.attributes,
        children=named,
        trace=key.trace,
        value_spans=key.value_spans,
    )
    return read_record(lowering, head, "name"), details


def _is_look(detail: Node) -> bool:
    return isinstance(detail, Element) and detail.name in ("color", "texture")


def _taken_details(record: Record) -> list[Element]:
    """Take colour and texture out of the values that a mapping gave: `material: $(steel)`."""
    key = record.key
    return [
        Element(name, span, {}, [Text(record.values.pop(name), span)], key.trace)
        for name in [name for name in record.values if name in ("color", "texture")]
        if name not in key.attributes
        for span in [record.span(name)]
    ]


def _lower_detail(lowering: Lowering, detail: Node) -> Node:
    if not isinstance(detail, Element):
        return detail
    if type(detail) is Element and not detail.verbatim:
        if detail.name == "color":
            return _lower_color(lowering, detail)
        if detail.name == "texture":
            return _lower_texture(lowering, detail)
    check_plain(lowering, detail, "material")
    return detail


def lower_color_material(lowering: Lowering, key: Element) -> Element:
    """Return the `<material>` of a `color` in a visual, named after the first link that has it.

    Raises:
        YamaroError: the colour is faulty.
    """
    color = _lower_color(lowering, key)
    text = color.attributes["rgba"]
    assert isinstance(text, str)
    rgba = tuple(map(float, text.split()))
    name = lowering.colors.get(rgba)
    if name is None:
        stem = name = f"{lowering.link_name}_color"
        taken = lowering.colors.values()
        number = 1
        while name in taken:
            number += 1
            name = f"{stem}_{number}"
        lowering.colors[rgba] = name
    return Element("material", key.span, {"name": name}, [color], key.trace)


def _lower_color(lowering: Lowering, key: Element) -> Element:
    record = read_record(lowering, key, "rgba")
    refuse_misspelt(record, ("rgba",))
    _require(record, "rgba", "four numbers: color: 0.8 0.1 0.1 1")
    rgba = read_attribute(lowering, record, "rgba", count=4, name="rgba")
    record.values["rgba"] = rgba.text
    return record.element()


def _lower_texture(lowering: Lowering, key: Element) -> Element:
    record = read_record(lowering, key, "filename")
    refuse_misspelt(record, ("filename",))
    _require(record, "filename", "a file: texture: package://arm/red.png")
    file, span = record.values["filename"], record.span("filename")
    record.values["filename"] = word_of("texture", file, span, owner=key)
    return record.element()


def _require(record: Record, name: str, what: str) -> None:
    """Raise an error if an attribute is missing."""
    key = record.key
    if name not in record.values:
        raise failure(
            "empty-value",
            f"'{key.name}' is empty",
            key.span,
            hint=f"give it {what}",
            trace=key.trace,
        )
