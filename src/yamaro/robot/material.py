"""`material`: its short forms, and one look for each name where robots are put together."""

from __future__ import annotations

import os

from ..diagnostics import failure, suggest
from ..xml.tree import Comment, Element, IncludedRobot, Text
from ..xml.values import Numbers, format_value
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
    from collections.abc import Container, Iterator

    from ..xml.tree import Node
    from .lowering import Lowering

    Look = tuple[object, ...]

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
    if value == "" and any(
        isinstance(each, Element) and each.name in ("color", "texture") for each in details
    ):
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
            record = read_record(lowering, detail, "filename")
            refuse_misspelt(record, ("filename",))
            _require(record, "filename", "a file: texture: package://arm/red.png")
            file, span = record.values["filename"], record.span("filename")
            record.values["filename"] = word_of("texture", file, span, owner=detail)
            return record.element()
    check_plain(lowering, detail, "material")
    return detail


def lower_color_material(lowering: Lowering, key: Element) -> Element:
    """Return the `<material>` of a `color` in a visual, named after the first link that has it.

    Raises:
        YamaroError: the colour is faulty.
    """
    color = _lower_color(lowering, key)
    written = color.attributes["rgba"]
    assert type(written) is Numbers
    return material_of(lowering, color, written.written)


def material_of(
    lowering: Lowering, color: Element, rgba: tuple[float, ...], *, taken: Container[str] = ()
) -> Element:
    """Return the `<material>` of a colour, named after the first link that has it.

    Args:
        lowering: the run.
        color: the `<color>`.
        rgba: its numbers.
        taken: names that materials have already.
    """
    name = lowering.colors.get(rgba)
    if name is None:
        stem = name = f"{lowering.link_name}_color"
        own = lowering.colors.values()
        number = 1
        while name in own or name in taken:
            number += 1
            name = f"{stem}_{number}"
        lowering.colors[rgba] = name
    return Element("material", color.span, {"name": name}, [color], color.trace)


def _lower_color(lowering: Lowering, key: Element) -> Element:
    record = read_record(lowering, key, "rgba")
    refuse_misspelt(record, ("rgba",))
    _require(record, "rgba", "four numbers: color: 0.8 0.1 0.1 1")
    record.values["rgba"] = read_attribute(lowering, record, "rgba", count=4, name="rgba")
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


# --- materials of robots that are put together ------------------------------------------------


def settle_materials(root: Element) -> Element:
    """Return a robot in which materials that are put together do not clash.

    Parsers refuse a robot with two `<material>` of one name under its root, and give every visual
    the first look that they meet under its name.

    A material under the root that is defined before with the same look is left out. One of an
    included URDF whose name has another look elsewhere gets the prefix of the include, as does what
    refers to it. All else stays, for the checks to report.
    """
    children = root.children
    robots = {id(own): own for own in map(_robot_of, children) if own is not None and own.prefix}
    if robots:
        children = _with_prefixes(children, list(robots.values()))
    # Within one XML file that is included, materials stay as they are in it.
    first: dict[str, Element] = {}
    kept: list[Node] = []
    for child in children:
        if isinstance(child, Element) and child.name == "material":
            earlier = first.setdefault(_name_of(child), child)
            is_of_same_file = _robot_of(child) is not None and child.body is earlier.body
            if earlier is not child and not is_of_same_file and _look(earlier) == _look(child):
                continue
        kept.append(child)
    if len(kept) < len(children):
        children = kept
    return root if children is root.children else root.with_children(children)


def _robot_of(node: Node) -> IncludedRobot | None:
    """Return the file that a node of a robot was included from, if that is XML."""
    is_included = isinstance(node, Element) and isinstance(node.body, IncludedRobot)
    return node.body if is_included else None  # type: ignore[union-attr, return-value]


def _with_prefixes(children: list[Node], robots: list[IncludedRobot]) -> list[Node]:
    """Return the children of a robot, with prefixes in the names that mean another look."""
    looks: dict[str, Look] = {}
    for child in children:
        if isinstance(child, Element) and _robot_of(child) not in robots:
            for material in _defined_in(child):
                looks.setdefault(_name_of(material), _look(material))
    names = {id(robot): _clashing(robot, children, looks) for robot in robots}
    return [
        _renamed(child, names[id(child.body)], child.body.prefix)
        if isinstance(child, Element)
        and isinstance(child.body, IncludedRobot)
        and names.get(id(child.body))
        else child
        for child in children
    ]


def _clashing(robot: IncludedRobot, children: list[Node], looks: dict[str, Look]) -> set[str]:
    """Return the materials of an included robot that look otherwise elsewhere; note the others."""
    own: dict[str, Look] = {}
    for child in children:
        if isinstance(child, Element) and child.body is robot:
            for material in _defined_in(child):
                own.setdefault(_name_of(material), _look(material))
    clashing = {name for name, look in own.items() if looks.setdefault(name, look) != look}
    for name in clashing:
        looks.setdefault(robot.prefix + name, own[name])
    return clashing


def _renamed(element: Element, names: set[str], prefix: str) -> Element:
    """Return an element with a prefix before these names of materials, wherever they stand."""
    children: list[Node] = [
        _renamed(child, names, prefix) if isinstance(child, Element) else child
        for child in element.children
    ]
    is_same = all(one is other for one, other in zip(children, element.children, strict=True))
    changed = element if is_same else element.with_children(children)
    if element.name != "material" or _name_of(element) not in names:
        return changed
    changed = changed.with_children(changed.children)
    changed.attributes = {**element.attributes, "name": prefix + _name_of(element)}
    return changed


def _defined_in(element: Element) -> Iterator[Element]:
    """Give the materials with a look and a name in a child of a robot."""
    if element.name == "material":
        found = [element]
    elif element.name == "link":
        visuals = [each for each in element.elements() if each.name == "visual"]
        found = [each for one in visuals for each in one.elements() if each.name == "material"]
    else:
        return
    yield from (each for each in found if _name_of(each) and each.elements())


def _name_of(material: Element) -> str:
    return format_value(material.attributes.get("name"))


def _look(element: Element) -> Look:
    """Return what is equal for materials of the same content: numbers by value, files by path.

    Elements of different names may be in any order; of those of one name parsers read the first.
    """
    attributes = {
        name: _value(element, name, format_value(value))
        for name, value in element.attributes.items()
        if value is not None and not (element.name == "material" and name == "name")
    }
    inner = [
        ("", format_value(child.value).strip())
        if isinstance(child, Text)
        else (child.name, repr(_look(child)))
        for child in element.children
        if isinstance(child, (Text, Element))
    ]
    return (element.name, sorted(attributes.items()), sorted(inner, key=lambda each: each[0]))


def _value(element: Element, attribute: str, text: str) -> object:
    if attribute == "filename" and "://" not in text and not os.path.isabs(text):
        path = element.value_span(attribute).source.path
        return os.path.normpath(os.path.join(os.path.dirname(path), text))
    try:
        return repr([float(word) for word in text.split()])
    except ValueError:
        return text
