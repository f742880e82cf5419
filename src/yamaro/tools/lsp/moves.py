"""Where places of an earlier text are in the text of now."""

from __future__ import annotations


class Move:
    """From one text to another; nothing is known of the stretch in which they differ.

    Attributes:
        old: the earlier text.
        new: the later one.
    """

    __slots__ = ("_end", "_same", "new", "old")

    def __init__(self, old: str, new: str) -> None:
        """Compare two texts: how much is the same at the begin, and at the end."""
        self.old = old
        self.new = new
        self._same = _common(old, new)
        self._end = _common(old[self._same :][::-1], new[self._same :][::-1])

    def shift(self, start: int, end: int) -> int | None:
        """Return by how much a stretch of the old text has moved; None if it has changed."""
        if end <= self._same:
            return 0
        if start >= len(self.old) - self._end:
            return len(self.new) - len(self.old)
        return None

    def back(self, offset: int) -> int:
        """Return where an offset of the new text was in the old one; -1 if it is new."""
        if offset <= self._same:
            return offset
        if offset >= len(self.new) - self._end:
            return offset - (len(self.new) - len(self.old))
        return -1


def _common(one: str, other: str) -> int:
    """Return how many characters two texts begin with in common."""
    most = min(len(one), len(other))
    if one[:most] == other[:most]:
        return most
    least = 0
    while most - least > 1:
        middle = (least + most) // 2
        if one[:middle] == other[:middle]:
            least = middle
        else:
            most = middle
    return least
