"""Gives the elements of an expansion the text that they have when xacro writes them.

xacro puts each child on a line of its own. So space between elements counts for nothing, texts that
meet have space between them, and only a text that is the one child stays as it is.
"""

from __future__ import annotations

from ..xmlreader import CData
from ..xmltree import Element, Text
from .comments import is_gone

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xmltree import Node


def tidy(root: Element) -> None:
    """Mend the children of an element, and of all in it."""
    pending = [root]
    while pending:
        element = pending.pop()
        children = element.children
        for child in children:
            if isinstance(child, Text):
                element.children = _tidied(children)
                break
        pending += [child for child in element.children if isinstance(child, Element)]


def _tidied(children: list[Node]) -> list[Node]:
    there = [child for child in children if not is_gone(child)]
    if len(there) == 1 and type(there[0]) is Text:
        return there
    kept: list[Node] = []
    for child in there:
        if isinstance(child, Text):
            value = str(child.value)
            if not isinstance(child, CData) and (not value or value.isspace()):
                continue
            if kept and isinstance(kept[-1], Text):
                kept[-1] = Text(f"{kept[-1].value}\n{value}", kept[-1].span)
                continue
            child = Text(value, child.span)
        kept.append(child)
    return kept
