"""Which macros and blocks give things to parts only, so that they may be written with its keys.

A function does not know where it is called: `xyz` is a pose in a part, and an element elsewhere.
So the files are written as if every macro and block that may be in a part were in parts only. What
turns out to be elsewhere too is noted, and the files are written again without it.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    Content = str | tuple[str | None, str]
    """A macro by its name, or a block by the name of its macro and its own."""

IN_PART = "in a part"
"""Where something is that is written in a joint, link or section of a part."""


class Placing:
    """Knows which macros and blocks give things to parts only.

    Attributes:
        in_parts: those that do, as far as is known.
    """

    def __init__(self, candidates: Iterable[Content]) -> None:
        self.in_parts: set[Content] = set(candidates)
        self._used: set[tuple[Content, Content | None]] = set()

    def note(self, content: Content, place: Content | None) -> None:
        """Note that what a macro or block gives is put into a part, another of them, or neither."""
        self._used.add((content, place))

    def settle(self) -> bool:
        """Return whether all was written as it has to be; if not, remember what is not in parts."""
        known = len(self.in_parts)
        while wrong := {
            content
            for content, place in self._used
            if content in self.in_parts and place != IN_PART and place not in self.in_parts
        }:
            self.in_parts -= wrong
        self._used.clear()
        return len(self.in_parts) == known
