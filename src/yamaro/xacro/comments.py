"""Which comments xacro removes: those right above what is expanded.

A comment belongs to the tag below it when at most one line break stands between them. It goes when
that tag does. What is expanded leaves a mark behind, at which taking away ends; the expansion of
a file has one such mark, which moves from tag to tag.
"""

from __future__ import annotations

from ..source import Span
from ..xml.tree import Comment, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..xml.tree import Node


class Mark(Text):
    """The space that an expanded tag leaves, as long as no other tag has left one since.

    Attributes:
        is_alive: whether it is still there.
    """

    __slots__ = ("is_alive",)

    def __init__(self, span: Span) -> None:
        super().__init__("\n\n", span)
        self.is_alive = True


class Comments:
    """Takes comments away, for one expansion."""

    __slots__ = ("_mark",)

    def __init__(self) -> None:
        self._mark: Mark | None = None

    def take_away(self, before: list[Node], span: Span, is_last: bool) -> Mark | None:
        """Take away the comments that belong to a tag, and return the mark it leaves, if any.

        Args:
            before: the nodes before the tag.
            span: the place of the tag.
            is_last: whether nothing follows in the element around.
        """
        index = _previous(before, len(before))
        while index >= 0:
            node = before[index]
            if isinstance(node, Text) and _is_margin(node):
                index = _previous(before, index)
            if index < 0 or not isinstance(before[index], Comment):
                return None if is_last else self._moved(span)
            del before[index]
            index = _previous(before, index)
        return None

    def _moved(self, span: Span) -> Mark:
        if self._mark is not None:
            self._mark.is_alive = False
        self._mark = Mark(span)
        return self._mark


def is_gone(node: Node) -> bool:
    """Return whether a node is a mark that has moved on."""
    return type(node) is Mark and not node.is_alive


def _previous(nodes: list[Node], index: int) -> int:
    index -= 1
    while index >= 0 and is_gone(nodes[index]):
        index -= 1
    return index


def _is_margin(text: Text) -> bool:
    value = str(text.value)
    return value.isspace() and value.count("\n") <= 1
