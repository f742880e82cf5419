"""What a robot holds for SDF alone, put into what is written for it."""

from __future__ import annotations

from ...model.values import attribute_text
from ...xml.tree import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ...xml.tree import Node

    Key = tuple[str, str | None]


def merged(made: Element, block: Iterable[Element]) -> Element:
    """Return an element with what a block says of it, which wins.

    An element of the block is put into the one of its tag and its name that is written already:
    attributes and texts replace those there, and other elements are put into it likewise. Without
    one it is added. Where one of the two has several elements of a tag without names, those of the
    block replace all.
    """
    own: dict[Key, list[Element]] = {}
    for child in made.elements():
        own.setdefault(_key(child), []).append(child)
    others: dict[Key, list[Element]] = {}
    for each in block:
        others.setdefault(_key(each), []).append(each)
    changed: dict[int, list[Node]] = {}
    added: list[Node] = []
    for key, new in others.items():
        old = own.get(key) or own.get((key[0], None), [])
        if not old or (key[1] is None and key[0] in SEVERAL):
            added += new
        elif len(old) == len(new) == 1:
            changed[id(old[0])] = [_put_into(old[0], new[0])]
        else:
            changed |= {id(each): [] for each in old}
            changed[id(old[0])] = [*new]
    children: list[Node] = []
    for node in made.children:
        children += changed.get(id(node), [node])
    return made.with_children([*children, *added])


SEVERAL = frozenset(("plugin",))
"""Elements that are beside each other, even if they have no names."""


def _put_into(old: Element, new: Element) -> Element:
    if not new.elements() and new.text().strip():
        result = new.with_children(new.children)
    else:
        result = merged(old, new.elements())
    result.attributes = {**old.attributes, **new.attributes}
    if result.name == "sensor":  # its name in SDF, where sensors of two links may have one
        for child in result.elements():
            if child.name == "name":
                result.attributes["name"] = child.text().strip()
                result.children.remove(child)
    return result


def _key(element: Element) -> Key:
    return element.name, attribute_text(element, "name")


def type_in(block: Iterable[Element]) -> str | None:
    """Return the type that a block gives a joint, such as `ball`, or None."""
    for each in block:
        if each.name == "type":
            return each.text().strip() or None
    return None
