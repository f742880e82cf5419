"""Levels: the collections around a place, with the columns that they have and will have."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

INDENT = 2
"""Columns that each level is further in than the one around it."""


class Level:
    """A block collection.

    Attributes:
        is_list: whether it is a list, whose items begin with a dash.
        old: the column in which its keys or dashes are.
        new: the column in which they will be.
        has_end: whether a token ends it; a list in the same column as the key above it has none.
    """

    __slots__ = ("has_end", "is_list", "new", "old")

    def __init__(self, *, is_list: bool, old: int, new: int, has_end: bool = True) -> None:
        self.is_list = is_list
        self.old = old
        self.new = new
        self.has_end = has_end


class Bracket:
    """A flow collection that is open.

    Attributes:
        content: the column in which its lines begin.
        closing: the column of its closing bracket, if that begins a line.
    """

    __slots__ = ("closing", "content")

    def __init__(self, *, content: int, closing: int) -> None:
        self.content = content
        self.closing = closing


class OwnLine:
    """A comment with nothing else in its line.

    Attributes:
        text: the comment with its `#`.
        column: where it is.
        is_apart: whether a blank line is before it.
    """

    __slots__ = ("column", "is_apart", "text")

    def __init__(self, text: str, column: int, *, is_apart: bool) -> None:
        self.text = text
        self.column = column
        self.is_apart = is_apart


def comment_column(
    comment: OwnLine, levels: Sequence[Level], following: tuple[int, int], *, is_in_body: bool
) -> int:
    """Return the column that a comment in its own line moves to.

    It goes with what follows, unless it is further in: then with the level before it that it is
    in.

    Args:
        comment: the comment.
        levels: those around what is before it.
        following: the column of what follows, now and later.
        is_in_body: whether what is before it is a key or dash whose value would follow.
    """
    old, new = following
    if comment.column <= old:
        return new
    found, target = old, new
    for level in levels:
        if found < level.old <= comment.column:
            found, target = level.old, level.new
    if is_in_body and levels and comment.column > levels[-1].old:
        return levels[-1].new + INDENT
    return target
