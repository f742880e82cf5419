"""Gives the elements of an expansion the text that they have when xacro writes them.

xacro puts each child on a line of its own. So space between elements counts for nothing, texts that
meet have space between them, and only a text that is the one child stays as it is.
"""

from __future__ import annotations

from ..xml.reader import CData
from ..xml.tree import Element, Text
from .comments import is_gone

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node


def tidy(root: Element) -> None:
    """Tidy the children of an element, and of all in it."""
    pending = [root]
    for element in pending:
        children = element.children
        if not children or (len(children) == 1 and type(children[0]) is Text):
            continue
        kept = element.children = []
        last: Node | None = None
        for child in children:
            if type(child) is Element:
                kept.append(child)
                pending.append(child)
            elif not isinstance(child, Text):
                kept.append(child)
            elif _is_space(child):
                continue
            else:
                _keep_text(child, kept, isinstance(last, CData))
            last = child
        if not kept:
            there = [child for child in children if not is_gone(child)]
            element.children = there if len(there) == 1 and type(there[0]) is Text else []


def _is_space(text: Text) -> bool:
    value = str(text.value)
    return not isinstance(text, CData) and (not value or value.isspace())


def _keep_text(text: Text, kept: list[Node], is_after_cdata: bool) -> None:
    """Add a text after what is kept."""
    value = str(text.value)
    if kept and isinstance(kept[-1], Text):
        space = "" if isinstance(text, CData) and is_after_cdata else "\n"
        kept[-1] = Text(f"{kept[-1].value}{space}{value}", kept[-1].span)
    else:
        kept.append(text if type(text) is Text else Text(value, text.span))
