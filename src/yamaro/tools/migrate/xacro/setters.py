"""Macros that set properties whose names they are given: their calls become these properties.

A variable has no computed name. But where a macro does nothing but set `${name}` for its caller,
and a call says `name="tip"`, what the call does is to set `tip`.
"""

from __future__ import annotations

import re

from ....xacro.statements import parse_parameters
from ....xacro.templates import guess_value
from ....xml.tree import Element, Text
from ....xml.values import format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ....xml.tree import Node

_HOLE = re.compile(r"\$\{([^}]*)\}")


def without_setters(roots: Mapping[str, Element]) -> dict[str, Element]:
    """Return the root elements of files with properties in place of the calls of such macros."""
    macros = [own for root in roots.values() for own in root.iter() if own.name == "xacro:macro"]
    names = [_name_of(macro) for macro in macros]
    setters = {
        name: macro
        for name, macro in zip(names, macros, strict=True)
        if names.count(name) == 1 and _is_setter(macro)
    }
    if not setters:
        return dict(roots)
    calls = [own for root in roots.values() for own in root.iter() if _called(own) in setters]
    replaced = {id(call): _properties(setters[_called(call)], call) for call in calls}
    kept = {_called(call) for call in calls if replaced[id(call)] is None}
    gone = {id(macro) for name, macro in setters.items() if name not in kept}
    return {path: _changed(root, replaced, gone) for path, root in roots.items()}


def _name_of(macro: Element) -> str:
    return format_value(macro.attributes.get("name")).removeprefix("xacro:")


def _called(element: Element) -> str:
    """Return the name of the macro that a tag would call, in whatever namespace."""
    return element.name.removeprefix("xacro:").rpartition(".")[2] if ":" in element.name else ""


def _is_setter(macro: Element) -> bool:
    """Return whether a macro only sets properties for its caller, one at least by a name given."""
    inside = macro.elements()
    names = [format_value(own.attributes.get("name")) for own in inside]
    return (
        any("$" in name for name in names)
        and all(own.name == "xacro:property" and not own.elements() for own in inside)
        and all({"name", "value", "scope"} == own.attributes.keys() for own in inside)
        and all(own.attributes["scope"] in ("parent", "global") for own in inside)
        and not any(
            isinstance(own, Text) and format_value(own.value).strip() for own in macro.children
        )
    )


def _properties(macro: Element, call: Element) -> list[Element] | None:
    """Return the properties that a call sets, or None if they are not known."""
    if "." in call.name or call.elements():
        return None
    given = {name: format_value(value) for name, value in call.attributes.items()}
    for parameter in parse_parameters(format_value(macro.attributes.get("params"))):
        if parameter.is_forwarded or parameter.is_block:
            return None
        if parameter.default is not None:
            given.setdefault(parameter.name, parameter.default)
    made = []
    for own in macro.elements():
        text = {key: format_value(value) for key, value in own.attributes.items()}
        name = _HOLE.sub(lambda found: given.get(found[1].strip(), "$"), text["name"])
        value = _with_given(text["value"], given)
        if "$" in name or value is None:
            return None
        attributes: dict[str, object] = {"name": name, "value": value}
        if text["scope"] == "global":
            attributes["scope"] = "global"
        made.append(Element("xacro:property", call.span, attributes))
    return made


def _with_given(text: str, given: Mapping[str, str]) -> str | None:
    """Return a text with the values of parameters in it; None if one cannot be put there."""
    alone = _HOLE.fullmatch(text)
    if alone and alone[1].strip() in given:
        return given[alone[1].strip()]
    pieces = []
    for index, piece in enumerate(_HOLE.split(text)):
        if index % 2 == 0:
            pieces.append(piece)
            continue
        inner = _expression_with(piece, given)
        if inner is None:
            return None
        pieces.append(f"${{{inner}}}")
    return "".join(pieces)


def _expression_with(python: str, given: Mapping[str, str]) -> str | None:
    import ast

    try:
        tree = ast.parse(python.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return None
    names = [node for node in ast.walk(tree) if isinstance(node, ast.Name) and node.id in given]
    made = python.strip().encode()
    for node in sorted(names, key=lambda own: own.col_offset, reverse=True):
        value = given[node.id]
        whole = _HOLE.fullmatch(value)
        if "$" in value and not whole:
            return None
        inner = whole[1].strip() if whole else repr(guess_value(value))
        own = inner if inner.isidentifier() or not whole else f"({inner})"
        made = made[: node.col_offset] + own.encode() + made[node.end_col_offset :]
    return made.decode()


def _changed(
    element: Element, replaced: Mapping[int, list[Element] | None], gone: set[int]
) -> Element:
    """Return an element with properties in place of calls, and without some macros."""
    children: list[Node] = []
    for child in element.children:
        if not isinstance(child, Element):
            children.append(child)
            continue
        properties = replaced.get(id(child))
        if properties is not None:
            children += properties
        elif id(child) not in gone:
            children.append(_changed(child, replaced, gone))
    return element.with_children(children)
