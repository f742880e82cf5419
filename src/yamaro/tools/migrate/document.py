"""Yamaro sources as a tree of keys and values; pieces of text in the language's own spelling."""

from __future__ import annotations

import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ...source import Span

WIDTH = 100
"""Characters that a line with a mapping in braces may have."""
RECORD_WIDTH = 120
"""And one such as a limit, or a section of a link, which is read at a glance."""

_SPACE = re.compile(r"\s+")
MOST_UNCLOSED = 100
"""Brackets of expressions without an end that are looked for in a text, each to the end of it."""


class Body:
    """A mapping of the language: entries in order, whose keys may come again."""

    __slots__ = (
        "entries", "has_call", "in_braces", "latest", "opening", "remark", "span", "width", "wraps",
    )  # fmt: skip

    def __init__(
        self, entries: Iterable[Entry] = (), *, in_braces: bool = False, width: int = WIDTH
    ) -> None:
        """Hold entries; with `in_braces`, they go on one line if `width` allows it."""
        self.entries = list(entries)
        self.in_braces = in_braces
        self.width = width
        self.has_call = False
        """Whether its last entry is a call without arguments, which may stay in the braces."""
        self.span: Span | None = None
        """Where the source has the joint or shape that it is of."""
        self.wraps = False
        """Whether it may go on several lines in its braces; it holds short texts alone."""
        self.remark = ""
        """A comment for the entry that comes next, or below the last one."""
        self.opening = ""
        """A comment at the end of the line whose key the body is below."""
        self.latest: Entry | None = None
        """What was written last: a comment at the end of a line belongs to it."""

    def add(self, key: str, value: Value = None) -> None:
        """Append an entry."""
        self.append(Entry(key, value))

    def append(self, entry: Entry) -> None:
        """Append an entry, below what was remarked before it."""
        entry.comment = joined(self.remark, entry.comment)
        self.remark = ""
        self.entries.append(entry)
        self.latest = entry

    def note(self, comment: str) -> None:
        """Remark something about what comes next."""
        self.remark = joined(self.remark, comment)

    def note_end(self, comment: str) -> None:
        """Remark something at the end of the line of what was written last."""
        if self.latest is not None:
            self.latest.note_end(comment)
        else:
            self.note(comment)

    def extend(self, other: Body) -> None:
        """Append the entries of another body, and what is remarked around them."""
        for entry in other.entries:
            self.append(entry)
        self.note(other.remark)
        self.opening = spaced(self.opening, other.opening)

    def __iter__(self) -> Iterator[Entry]:
        """Run over the entries."""
        return iter(self.entries)

    def __bool__(self) -> bool:
        """Return whether there is anything in it."""
        return bool(self.entries or self.remark or self.opening)

    def bodies(self) -> Iterator[Body]:
        """Yield it and all bodies in it, in order; entries may be changed meanwhile."""
        yield self
        for entry in list(self.entries):
            if isinstance(entry.value, Body):
                yield from entry.value.bodies()

    def entries_below(self) -> Iterator[Entry]:
        """Yield its entries and those of all bodies in it."""
        for body in self.bodies():
            yield from list(body.entries)


Value = Body | str | None


class Quoted(str):
    """A text that would else be a number, true or nothing, and is to be none of these."""

    __slots__ = ()


class Flow(str):
    """A list in brackets, which is written as it is."""

    __slots__ = ()


class Row(str):
    """A text of several pieces with commas between them, which may go on several lines."""

    __slots__ = ("pieces",)
    pieces: list[str]

    def __new__(cls, pieces: list[str]) -> Row:
        """Join the pieces."""
        row = super().__new__(cls, ", ".join(pieces))
        row.pieces = pieces
        return row


class Entry:
    """A key with its value.

    Attributes:
        key: as it is written.
        value: a text is in the language's own spelling (see `literal`).
        comment: what YAML comments above it say, line by line.
        ending: what the comment at the end of its first line says.
    """

    __slots__ = ("comment", "ending", "key", "value")

    def __init__(self, key: str, value: Value = None, comment: str = "") -> None:
        self.key = key
        self.value = value
        self.comment = comment
        self.ending = ""

    def note_end(self, comment: str) -> None:
        """Remark something at the end of the first line, or above it if it takes several."""
        if "\n" in comment:
            self.comment = joined(self.comment, comment)
        else:
            self.ending = spaced(self.ending, comment)


def spaced(*comments: str) -> str:
    """Return comments one after the other."""
    return " ".join(filter(None, comments))


def joined(*comments: str) -> str:
    """Return comments one below the other."""
    return "\n".join(filter(None, comments))


def literal(text: str) -> str:
    """Return a text spelled so that nothing in it is evaluated."""
    return text.replace("$(", "$$(").replace("${", "$${")


def element_key(name: str, attributes: dict[str, str], *, bracketed: bool = False) -> str:
    """Return the key of an element, `name/attribute=value, …`; values as the language has them."""
    key = name
    if attributes:
        key += "/" + ", ".join(f"{name}={_attribute(value)}" for name, value in attributes.items())
    return f"<{key}>" if bracketed else key


def _attribute(value: str) -> str:
    outside = without_expressions(value)
    if "," not in outside and value == value.strip() and not value.startswith(("'", '"')):
        return value
    if "'" not in outside:
        return f"'{value}'"
    if '"' not in outside:
        return f'"{value}"'
    terms = []  # of one expression, as both kinds of quotes are in it
    for piece, is_expression in pieces_of(value):
        if is_expression:
            terms.append(f"str({piece[2:-1]})")
        elif piece:
            terms.append(repr(piece.replace("$$(", "$(").replace("$${", "${")))
    return f"$({' + '.join(terms)})"


def without_expressions(text: str) -> str:
    """Return a text with `$()` in place of each expression."""
    return "".join("$()" if is_expression else piece for piece, is_expression in pieces_of(text))


def words_of(text: str) -> list[str]:
    """Return the words of a text; an expression is no more than a piece of one."""
    words = [""]
    for piece, is_expression in pieces_of(text):
        if is_expression:
            words[-1] += piece
            continue
        first, *others = _SPACE.split(piece)
        words[-1] += first
        words += others
    return [word for word in words if word]


def pieces_of(text: str) -> Iterator[tuple[str, bool]]:
    """Return the pieces of a text, and of each whether it is an expression."""
    if "$(" not in text:
        yield text, False
        return
    from ...syntax.python import skip_expression

    start = position = unclosed = 0
    while (at := text.find("$(", position)) >= 0 and unclosed < MOST_UNCLOSED:
        end = at if text[at - 1 : at] == "$" else skip_expression(text, at)
        if end <= at:
            unclosed += text[at - 1 : at] != "$"
            position = at + 2
            continue
        yield text[start:at], False
        yield text[at:end], True
        start = position = end
    yield text[start:], False
