"""Puts another name for the first item of a list in what a loop does."""

from __future__ import annotations

import re

from ....xml.tree import Comment, Text
from ....xml.values import format_value
from .steps import (
    require,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ....xml.tree import Node
    from .program import XacroProgram


class Rewriting:
    """Puts a name in the place of a list's first item."""

    def __init__(self, first: str, name: str, program: XacroProgram) -> None:
        """Take the item's expression, as `items[0]`, and its new name."""
        listed, _, index = first[:-1].partition("[")
        self._first = re.compile(rf"(?<![\w.]){listed}\s*\[\s*{index}\s*\]")
        self._name = name
        self._program = program

    def node(self, node: Node) -> Node:
        """Return an element with the name in all its expressions."""
        if isinstance(node, Text):
            return Text(self.text(format_value(node.value)), node.span)
        if isinstance(node, Comment):
            return node
        children = [self.node(child) for child in node.children]
        changed = node.with_children(children)
        changed.attributes = {
            name: self.text(format_value(value)) for name, value in node.attributes.items()
        }
        return changed

    def text(self, text: str) -> str:
        """Return a text with the name in its expressions."""
        return re.sub(r"\$\{([^}]*)\}", self._replaced, text)

    def _replaced(self, found: re.Match[str]) -> str:
        inner = found[1]
        changed = self._first.sub(self._name, inner)
        known = self._program.truths, self._program.numbers
        require(changed == inner or not any(inner.strip() in kinds for kinds in known))
        return f"${{{changed}}}"
