"""Fixes: what a diagnostic would have changed in the text, as edits that a program can apply."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from .source import Span


_OF_NUMBERS = frozenset("0123456789.eE+- ")


class Edit:
    """One change of a text: what replaces the characters of a span; an empty span inserts."""

    __slots__ = ("span", "text")

    def __init__(self, span: Span, text: str) -> None:
        self.span = span
        self.text = text

    def __repr__(self) -> str:
        return f"Edit({self.span.place()}, {self.span.written()!r} -> {self.text!r})"


class Fix:
    """A way to remove the cause of a diagnostic.

    Attributes:
        title: what it does, for a menu: "change 'raduis' to 'radius'".
        edits: the changes, in order of place, none of which overlap; all of them or none.
        is_safe: whether it can be applied without asking: what is written has only this one
            meaning. A name of the user's is a guess, however near it is.
    """

    __slots__ = ("edits", "is_safe", "title")

    def __init__(self, title: str, edits: Iterable[Edit], *, is_safe: bool = False) -> None:
        self.title = title
        self.edits = tuple(edits)
        self.is_safe = is_safe

    def __repr__(self) -> str:
        return f"<{'safe' if self.is_safe else 'unsafe'} fix: {self.title}>"


def replacement(span: Span, text: str, *, is_safe: bool = False) -> Fix:
    """Return the fix that writes `text` in place of a span."""
    from .source import Span
    from .terminal import shortened

    title = f"change '{shortened(span.written())}' to '{shortened(text)}'"
    return Fix(title, [Edit(Span(span.source, span.start, span.end), text)], is_safe=is_safe)


def respelling(span: Span, word: str, near: str | None, *, is_safe: bool = False) -> Fix | None:
    """Return the fix that writes `near` in place of `word`, which is somewhere in a span.

    There is none if the word is not written there exactly once, such as when it was computed.
    """
    from .source import Span

    if not near or not word:
        return None
    # Only what means itself wherever YAML has a word.
    if not (near[0].isalpha() or near[0] == "_") or not all(
        c.isalnum() or c in "_-./:" for c in near
    ):
        return None
    written = span.written()
    places = [at for at in _occurrences(written, word) if _is_whole(written, at, word)]
    if len(places) > 1 and written[: places[0]] in ("", "<", "'", '"'):
        del places[1:]  # a key begins with the name that it is about
    if len(places) != 1:
        return None
    start = span.start + places[0]
    return replacement(Span(span.source, start, start + len(word)), near, is_safe=is_safe)


def renumbering(span: Span, numbers: str) -> Fix | None:
    """Return the fix that writes other numbers; None if there are no plain numbers in the span."""
    from .source import Span

    written = span.written()
    bare = written.strip("'\"")
    if not bare or not set(bare) <= _OF_NUMBERS:
        return None
    start = span.start + written.index(bare)
    return replacement(Span(span.source, start, start + len(bare)), numbers)


def _occurrences(text: str, word: str) -> list[int]:
    found = []
    at = text.find(word)
    while at >= 0:
        found.append(at)
        at = text.find(word, at + 1)
    return found


def _is_whole(text: str, at: int, word: str) -> bool:
    """Return whether no letter of a name goes on before or after a word."""
    end = at + len(word)
    before, after = text[max(at - 1, 0) : at], text[end : end + 1]
    goes_on_before = _goes_on(before) and _goes_on(word[0])
    return not goes_on_before and not (_goes_on(after) and _goes_on(word[-1]))


def _goes_on(character: str) -> bool:
    return character.isalnum() or character in ("_", "-")
