"""The order in which properties of xacro become variables.

xacro evaluates a property when it is read first, so that one may be made of names that are defined
further down. A variable is evaluated where it is declared: it has to follow those names.
"""

from __future__ import annotations

from ....xml.tree import Element
from ....xml.values import format_value
from .names import defined_in, names_in, used_in
from .program import XacroProgram

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ....xml.tree import Node
    from ..elements import Endings


def in_order(nodes: list[Node], endings: Endings, program: XacroProgram) -> list[Node]:
    """Return what is in one place, properties behind what their values are made of.

    They take along the comments above them, and those at the ends of their lines (`endings`).
    """
    elements = [node for node in nodes if isinstance(node, Element)]
    if not any(element.name == "xacro:property" for element in elements):
        return nodes
    defined = {id(element): _defined_by(element, program) for element in elements}
    moved: dict[int, list[Node]] = {}
    """Properties by what they have to follow."""
    for index, element in enumerate(elements):
        if _is_lazy(element):
            rest = elements[index + 1 :]
            last = _last_needed(element, elements[:index], rest, defined, program)
            if last is not None:
                moved.setdefault(id(last), []).append(element)
    if not moved:
        return nodes
    away = {id(element) for row in moved.values() for element in row}
    result: list[Node] = []

    groups = _with_comments(nodes, endings)

    def put(node: Node) -> None:
        result.extend(groups[id(node)])
        for element in moved.get(id(node), ()):
            put(element)

    for element in elements:
        if id(element) not in away:
            put(element)
    return result + groups[0]


def _with_comments(nodes: list[Node], endings: Endings) -> dict[int, list[Node]]:
    """Return each element with what is around it, by identity, and what comes last under 0."""
    groups: dict[int, list[Node]] = {}
    above: list[Node] = []
    latest: list[Node] = []
    for node in nodes:
        if isinstance(node, Element):
            latest = groups[id(node)] = [*above, node]
            above = []
        elif latest and endings.get(id(node)) == "following":
            latest += [*above, node]
            above = []
        else:
            above.append(node)
    groups[0] = above
    return groups


def _is_lazy(element: Element) -> bool:
    given = element.attributes
    return (
        element.name == "xacro:property"
        and "$" in format_value(given.get("value"))
        and "scope" not in given
        and format_value(given.get("lazy_eval", "true")).lower() in ("true", "1")
    )


def _defined_by(element: Element, program: XacroProgram) -> set[str]:
    """Return the names that an element defines where it stands, or what it includes or calls."""
    if element.name == "xacro:macro":
        return set()
    includes = [own for own in element.iter() if own.name == "xacro:include"]
    names = defined_in(element) | program.handed_to(element)
    for path in program.namespaces.reached_by(includes):
        names |= defined_in(program.roots[path])
    return names


def _last_needed(
    element: Element,
    before: list[Element],
    after: list[Element],
    defined: dict[int, set[str]],
    program: XacroProgram,
) -> Element | None:
    """Return the last of the elements below that a property needs, if it needs one."""
    own = format_value(element.attributes.get("name"))
    known = set().union(*(defined[id(each)] for each in before))
    needed = names_in(format_value(element.attributes["value"])) - known - {own}
    last = None
    for index, each in enumerate(after):
        new = defined[id(each)] & needed
        if new:
            last = index
            needed -= new
    if last is None:
        return None
    between = after[: last + 1]
    is_read = any(own in _read_by(each, program) for each in between)
    is_defined_again = any(own in defined[id(each)] for each in between)
    return None if is_read or is_defined_again else after[last]


def _read_by(element: Element, program: XacroProgram) -> set[str]:
    """Return the names that are read where an element stands, also by what it calls or includes."""
    names: set[str] = set()
    seen: set[int] = set()
    pending = [element]
    while pending:
        root = pending.pop()
        if root.name == "xacro:property" or id(root) in seen:
            continue
        seen.add(id(root))
        inside = {id(own) for own in root.iter() if own.name == "xacro:macro" and own is not root}
        if root is not element or root.name != "xacro:macro":
            names |= used_in(root, without=inside)
            pending += _reached_by(root, inside, program)
    return names


def _reached_by(root: Element, inside: set[int], program: XacroProgram) -> Iterator[Element]:
    """Return the macros that an element calls, and the files that it includes."""
    for own in root.iter(inside):
        macro = program.macro_called(own)
        if macro is not None:
            yield macro.element
        elif own.name == "xacro:include":
            for path in program.files.files_of(own):
                yield program.roots[path]
