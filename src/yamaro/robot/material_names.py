"""Gives each name of a material one look, also where robots are put together.

Parsers refuse a robot with two `<material>` of one name under its root, and give every visual the
first look that they meet under its name.
"""

from __future__ import annotations

import os

from ..xml.tree import Element, IncludedRobot, Text
from ..xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..xml.tree import Node

    Look = tuple[object, ...]


def settle_materials(root: Element) -> Element:
    """Return a robot in which materials that are put together do not clash.

    A material under the root that is defined before with the same look is left out. One of an
    included URDF whose name has another look elsewhere gets the prefix of the include, as does what
    refers to it. All else stays, for the checks to report.
    """
    children = root.children
    robots = {id(own): own for own in map(_robot_of, children) if own is not None and own.prefix}
    if robots:
        children = _with_prefixes(children, list(robots.values()))
    children = _without_repeated(children)
    return root if children is root.children else root.with_children(children)


def _robot_of(node: Node) -> IncludedRobot | None:
    """Return the file that a node of a robot was included from, if that is XML."""
    is_included = isinstance(node, Element) and isinstance(node.body, IncludedRobot)
    return node.body if is_included else None  # type: ignore[union-attr, return-value]


# --- definitions under the root -----------------------------------------------------------------


def _without_repeated(children: list[Node]) -> list[Node]:
    """Return the children of a robot without materials that are defined before, just as they are.

    Within one XML file that is included they stay as they are in it.
    """
    first: dict[str, Element] = {}
    kept: list[Node] = []
    for child in children:
        if isinstance(child, Element) and child.name == "material":
            earlier = first.setdefault(_name_of(child), child)
            is_of_same_file = _robot_of(child) is not None and child.body is earlier.body
            if earlier is not child and not is_of_same_file and _look(earlier) == _look(child):
                continue
        kept.append(child)
    return children if len(kept) == len(children) else kept


# --- prefixes -----------------------------------------------------------------------------------


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


# --- looks --------------------------------------------------------------------------------------


def _look(element: Element) -> Look:
    """Return what is equal for materials of the same content: numbers by value, files by path."""
    attributes = {
        name: _value(element, name, format_value(value))
        for name, value in element.attributes.items()
        if value is not None and not (element.name == "material" and name == "name")
    }
    inner = [
        format_value(child.value).strip() if isinstance(child, Text) else _look(child)
        for child in element.children
        if isinstance(child, (Text, Element))
    ]
    return (element.name, sorted(attributes.items()), sorted(map(repr, inner)))


def _value(element: Element, attribute: str, text: str) -> object:
    if attribute == "filename" and "://" not in text and not os.path.isabs(text):
        path = element.value_span(attribute).source.path
        return os.path.normpath(os.path.join(os.path.dirname(path), text))
    try:
        return repr([float(word) for word in text.split()])
    except ValueError:
        return text
