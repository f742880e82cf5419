"""What a run works out once for elements of equal content.

Elements that are equal share a `Memo`: one element that is in several places, or several that
differ in a name and in a few children of their own only. Lowering, the checks and the writer note
in it what they have worked out, each of them for the next time. There is nothing else by which they
know what they have seen before, so elements without a memo are each worked out separately.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, TypeVar

    Key = TypeVar("Key")
    Value = TypeVar("Value")

MOST_REMEMBERED = 4096
"""How much of a kind is remembered at a time; what is forgotten is only worked out again."""
LONGEST_ROW_REMEMBERED = 24
"""Characters of a row of numbers worth remembering: longer ones are computed, and seldom equal."""


class Memo:
    """Notes on the elements that have it. These never change, or else in the same way.

    Attributes:
        own: None if it is one element; else these have names of their own, and this number of their
            first children.
        lowered: what the element is lowered to.
        resolved: the element with the name that a reference in it means.
        checked: the run of the checks that found nothing wrong in it, if one did.
        written: the text of it, or of what is in it except for its own children.
        renamed: what it becomes where meshes are named in another way.
    """

    __slots__ = ("checked", "lowered", "own", "renamed", "resolved", "written")

    def __init__(self, own: int | None = None) -> None:
        """Begin with nothing worked out."""
        self.own = own
        self.lowered: Any = None
        self.resolved: Any = None
        self.checked: Any = None
        self.written: Any = None
        self.renamed: Any = None


def remember(known: dict[Key, Value], key: Key, value: Value) -> None:
    """Keep what has been worked out for when it comes again, in bounded memory."""
    if len(known) >= MOST_REMEMBERED:
        known.clear()
    known[key] = value
