"""Finds the comments of a text: the text between libyaml's tokens that is not white space."""

from __future__ import annotations

from ..source import Source, Span
from .libyaml import DeepParser, YAMLError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator


class Comment(Span):
    """A comment, from its `#` to the end of its line."""

    __slots__ = ()

    @property
    def text(self) -> str:
        """Return the comment as it is written, with its `#`."""
        return self.written()

    @property
    def has_line(self) -> bool:
        """Return whether nothing else is in its line."""
        _, column = self.location()
        return not self.source.text[self.start - column + 1 : self.start].strip()


def find_comments(source: Source, text: str) -> list[Comment]:
    """Return the comments of a source in order.

    Args:
        source: what they are comments of.
        text: its text, with blanks in place of what is not YAML.
    """
    comments: list[Comment] = []
    for start, end in _gaps(text):
        at = text.find("#", start, end)
        while at >= 0:
            stop = _end_of_line(text, at, end)
            comments.append(Comment(source, at, stop))
            at = text.find("#", stop, end)
    return comments


def _gaps(text: str) -> Iterator[tuple[int, int]]:
    """Give the stretches of a text in which only white space and comments stand."""
    parser = DeepParser(text)
    at = 0
    try:
        while (token := parser.get_token()) is not None:
            start, end = token.start_mark.index, token.end_mark.index
            if start > at:
                yield at, start
            if getattr(token, "style", None) in ("|", ">"):
                yield start + 1, _end_of_line(text, start, len(text))
            at = max(at, end)
    except YAMLError:  # a fault that its explanation found elsewhere
        return
    finally:
        parser.dispose()
    yield at, len(text)


def _end_of_line(text: str, start: int, end: int) -> int:
    ends = [at for sign in "\r\n" if (at := text.find(sign, start, end)) >= 0]
    return min(ends, default=end)
