"""Finds the errors that may be there only because lines with a fault in their YAML were hidden."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..diagnostics import Diagnostic
    from ..source import Source, Span

_OF_WHAT_IS_AROUND = frozenset(
    """bad-root empty-file hidden-value lone-else misplaced-statement missing-key misspelt-statement
    mixed-list not-a-body not-a-text not-indented two-roots""".split()
)
"""Codes about what is around a place, or is missing there."""
_OF_CHARACTERS = frozenset(
    """attribute-twice bad-key empty-expression number-too-long python-syntax
    unclosed-expression""".split()
)
"""Codes about the characters at a place, whatever they are in."""


def without_follow_ons(
    found: Iterable[Diagnostic], source: Source, hidden: Sequence[Span]
) -> list[Diagnostic]:
    """Return the diagnostics that would be there if nothing were hidden, as far as is known.

    Nothing is reported of lines of which something is hidden. What is about the things around its
    place is left out if something is hidden beside its line, or below a line beside it; and below
    a key whose value is hidden, only what is about characters is kept.
    """
    kept: list[Diagnostic] = []
    lines: _Lines | None = None
    for diagnostic in found:
        lines = lines or _Lines(source, hidden)
        line = diagnostic.span.location()[0]
        code = diagnostic.code
        if line in lines.hidden:
            continue
        if line in lines.below and code not in _OF_CHARACTERS:
            continue
        if line in lines.beside and code in _OF_WHAT_IS_AROUND:
            continue
        kept.append(diagnostic)
    return kept


class _Lines:
    """Where lines stand to what is hidden; they are counted from 1.

    Attributes:
        hidden: those of which something is hidden.
        below: those below a line of which something is hidden, and indented deeper.
        beside: those in whose mapping or list something is hidden: between such a line and what is
            hidden, no line is indented less than it.
    """

    def __init__(self, source: Source, hidden: Sequence[Span]) -> None:
        """Look at all lines once for each stretch that is hidden."""
        self._source = source
        self.hidden: set[int] = set()
        self.below: set[int] = set()
        self.beside: set[int] = set()
        count = len(source.line_starts())
        for span in hidden:
            first = source.location(span.start)[0]
            last = source.location(max(span.end - 1, span.start))[0]
            depth = self._depth_of_key(first)
            self.hidden.update(range(first, last + 1))
            self._look_beside(depth, range(first - 1, 0, -1))
            self._look_beside(depth, range(last + 1, count + 1))
            self._look_below(depth, range(last + 1, count + 1))

    def _look_beside(self, least: int, lines: range) -> None:
        for line in lines:
            depth = self._depth(line)
            if depth is not None and depth <= least:
                least = depth
                self.beside.add(line)

    def _look_below(self, key: int, lines: range) -> None:
        for line in lines:
            depth = self._depth(line)
            if depth is not None and depth <= key:
                break
            self.below.add(line)

    def _depth(self, line: int) -> int | None:
        """Return how deep a line is, or None if it is blank or a comment.

        The items of a list are deeper than a key in the same column.
        """
        text = self._source.line_text(line)
        words = text.lstrip(" ")
        if not words.strip() or words.startswith("#"):
            return None
        return 2 * (len(text) - len(words)) + words.startswith("- ")

    def _depth_of_key(self, line: int) -> int:
        """Return how deep the first key of a line is."""
        text = self._source.line_text(line)
        return 2 * (len(text) - len(text.lstrip(" -")))
