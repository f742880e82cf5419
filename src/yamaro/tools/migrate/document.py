"""Yamaro sources as a tree of keys and values, and how a person would lay them out as YAML."""

from __future__ import annotations

import re
from collections import Counter

from ...syntax.names import STATEMENTS
from ...yaml.scalars import type_plain

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

WIDTH = 100
"""Characters that a line with a mapping in braces may have."""
RECORD_WIDTH = 120
"""And one such as a limit, or a section of a link, which is read at a glance."""
MOST_IN_BRACES = 6
LONGEST_KEY = 1000
"""Characters that a key may have before YAML wants a `?` in front of it."""

_SPACE = re.compile(r"\s+")
_INDICATORS = frozenset("-?:,[]{}#&*!|>'\"%@`")
_OPENING = frozenset("-?:")
_NULLS = frozenset(("", "~", "null", "Null", "NULL"))
_FLOW = frozenset(",[]{}")


class Body:
    """A mapping of the language: entries in order, whose keys may come again."""

    __slots__ = ("entries", "in_braces", "latest", "opening", "remark", "width")

    def __init__(
        self, entries: Iterable[Entry] = (), *, in_braces: bool = False, width: int = WIDTH
    ) -> None:
        """Hold entries; `in_braces` says that they go on one line if it is no wider."""
        self.entries = list(entries)
        self.in_braces = in_braces
        self.width = width
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


Value = Body | str | None


class Quoted(str):
    """A text that would else be a number, true or nothing, and is to be none of these."""

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
    return f"$({_as_python(value)})"


def _as_python(value: str) -> str:
    """Return a text as one expression: for one that holds both kinds of quotes."""
    pieces = []
    for piece, is_expression in _pieces(value):
        if is_expression:
            pieces.append(f"str({piece[2:-1]})")
        elif piece:
            pieces.append(repr(piece.replace("$$(", "$(").replace("$${", "${")))
    return " + ".join(pieces)


def without_expressions(text: str) -> str:
    """Return a text with `$()` in place of each expression."""
    return "".join("$()" if is_expression else piece for piece, is_expression in _pieces(text))


def words_of(text: str) -> list[str]:
    """Return the words of a text; an expression is no more than a piece of one."""
    words = [""]
    for piece, is_expression in _pieces(text):
        if is_expression:
            words[-1] += piece
            continue
        first, *others = _SPACE.split(piece)
        words[-1] += first
        words += others
    return [word for word in words if word]


def _pieces(text: str) -> Iterator[tuple[str, bool]]:
    """Return the pieces of a text, and of each whether it is an expression."""
    if "$(" not in text:
        yield text, False
        return
    from ...syntax.template import skip_expression

    start = position = 0
    while (at := text.find("$(", position)) >= 0:
        end = skip_expression(text, at)
        if end <= at or text[at - 1 : at] == "$":
            position = at + 2
            continue
        yield text[start:at], False
        yield text[at:end], True
        start = position = end
    yield text[start:], False


# --- writing ----------------------------------------------------------------------------------


def write_document(sections: Body, comment: str = "") -> str:
    """Return the sections of a file as YAML, under a comment of the whole file."""
    out: list[str] = []
    _write_comment(comment, "", out)
    _write_entries(sections, "", out)
    return "".join(f"{line}\n" for line in out)


def _write_comment(comment: str, margin: str, out: list[str]) -> None:
    for line in comment.splitlines():
        words = line.split(" ")
        fits = len(margin) + 2 + len(line) <= RECORD_WIDTH
        rows = [line] if fits else _filled(words, WIDTH - len(margin) - 2)
        out += [f"{margin}# {row}".rstrip() for row in rows]


def _write_entries(body: Body, margin: str, out: list[str]) -> None:
    """Write entries as a mapping, or as a list of mappings if a key comes again."""
    keys = [entry.key for entry in body]
    times = Counter(keys)
    repeated = [key for key in keys if times[key] > 1]
    is_row = 2 * len(repeated) >= len(keys) or any(map(_is_statement, repeated))
    seen: set[str] = set()
    for entry in body:
        _write_comment(entry.comment, margin, out)
        if not repeated:
            _write_entry(entry, margin, margin, out)
            continue
        is_item = is_row or not seen or entry.key in seen
        seen = {entry.key} if is_item else seen | {entry.key}
        _write_entry(entry, f"{margin}- " if is_item else f"{margin}  ", f"{margin}  ", out)
    _write_comment(body.remark, margin, out)


def _is_statement(key: str) -> bool:
    """Return if a key is that of a statement: each of a row of these has an item of its own."""
    return key in STATEMENTS or key.rpartition(".")[2][:1].isupper()


def _write_entry(entry: Entry, head: str, margin: str, out: list[str]) -> None:
    """Write an entry that begins with `head` and whose further lines stand at `margin`."""
    lines: list[str] = []
    remarks: list[str] = []
    takes_comment = _write_pair(entry, head, margin, lines, remarks)
    ending = entry.ending
    if isinstance(entry.value, Body):
        ending = spaced(entry.value.opening, ending)
    above = head.removesuffix("- ")
    _write_comment("\n".join(remarks), above, out)
    if ending and takes_comment and len(lines[0]) + len(ending) + 4 <= WIDTH:
        lines[0] += f"  # {ending}"
    else:
        _write_comment(ending, above, out)
    out += lines


def _write_pair(entry: Entry, head: str, margin: str, out: list[str], remarks: list[str]) -> bool:
    """Write key and value, and tell whether a comment may be at the end of the first line.

    What is remarked in a mapping in braces is added to `remarks`.
    """
    key = _scalar(entry.key, in_flow=False)
    if len(key) > LONGEST_KEY or len(head) + len(key) + 1 > RECORD_WIDTH:
        words = _foldable(entry.key, key) or [key]
        first, *others = _filled(words, WIDTH - len(margin) - 2)
        out += [f"{head}? {first}", *(f"{margin}  {line}" for line in others)]
        head, key = margin, ""
    value = entry.value
    if value is None:
        out.append(f"{head}{key}:")
    elif isinstance(value, str):
        return _write_text(value, f"{head}{key}:", margin, out)
    else:
        braces = _in_braces(value, remarks) if value.in_braces else None
        line = f"{head}{key}: {braces}"
        if braces is not None and len(line) <= value.width:
            out.append(line)
            return True
        remarks.clear()
        out.append(f"{head}{key}:")
        _write_entries(value, f"{margin}  ", out)
    return True


def _write_text(text: str, head: str, margin: str, out: list[str]) -> bool:
    """Write a text behind its key, and tell whether a comment may be at the end of that line."""
    if isinstance(text, Row) and len(head) + len(text) >= WIDTH and _is_plain(text, in_flow=False):
        out.append(head)
        out += [f"{margin}  {line}" for line in _wrapped(text.pieces, WIDTH - len(margin) - 2)]
        return False
    lines = text.split("\n")
    if len(lines) == 1 or not all(line.isprintable() for line in lines):
        scalar = _scalar(text, in_flow=False)
        if len(head) + 1 + len(scalar) > WIDTH and (pieces := _foldable(text, scalar)):
            out.append(head)
            out += [f"{margin}  {line}" for line in _filled(pieces, WIDTH - len(margin) - 2)]
            return False
        out.append(f"{head} {scalar}")
        return True
    indicator = "2" if lines[0].startswith(" ") else ""
    out.append(f"{head} |{indicator}-")
    out += [f"{margin}  {line}".rstrip() for line in lines]
    return True


def _wrapped(pieces: list[str], width: int) -> list[str]:
    """Return pieces with commas between them as lines no wider than asked, if that can be."""
    lines = [""]
    for piece in pieces:
        longer = f"{lines[-1]}, {piece}" if lines[-1] else piece
        if lines[-1] and len(longer) >= width:
            lines[-1] += ","
            lines.append(piece)
        else:
            lines[-1] = longer
    return lines


def _foldable(text: str, scalar: str) -> list[str]:
    """Return the words of a scalar between which it may go on in the next line, or none.

    YAML reads each such line break as one space.
    """
    if "  " in text or text != text.strip() or "\\" in scalar or not text.isprintable():
        return []
    words = words_of(text)
    if " ".join(words) != text or len(scalar) != len(text):
        words = scalar.split(" ")
    return words if " " in scalar else []


def _filled(words: list[str], width: int) -> list[str]:
    """Return words as lines no wider than asked, if that can be; only long words are broken."""
    lines = [""]
    for word in words:
        pieces = [word] if len(word) <= width else word.split(" ")
        for piece in pieces:
            if lines[-1] and len(lines[-1]) + 1 + len(piece) > width:
                lines.append(piece)
            else:
                lines[-1] = spaced(lines[-1], piece)
    return lines


def _in_braces(body: Body, remarks: list[str]) -> str | None:
    """Return a mapping as `{key: value, …}`, or None if it is none for one line.

    What is remarked in it is added to `remarks`.
    """
    if len(body.entries) > MOST_IN_BRACES or not body.entries:
        return None
    pieces: list[str] = []
    keys = set()
    for entry in body:
        if entry.key in keys or (entry.value is None and len(body.entries) > 1):
            return None
        if entry.ending or (entry.comment and pieces):  # it is better right at its key
            return None
        if isinstance(entry.value, Body) and entry.value.opening:
            return None
        remarks += filter(None, [entry.comment])
        keys.add(entry.key)
        value: str | None
        if isinstance(entry.value, Body):
            value = _in_braces(entry.value, remarks) if entry.value.in_braces else None
        else:
            value = "" if entry.value is None else _scalar(entry.value, in_flow=True)
        if value is None or "\n" in value:
            return None
        pieces.append(f"{_scalar(entry.key, in_flow=True)}: {value}")
    remarks += filter(None, [body.remark])
    return f"{{{', '.join(pieces)}}}"


def _scalar(text: str, *, in_flow: bool) -> str:
    """Return a text as a YAML scalar that is read as this text and none other."""
    if _is_plain(text, in_flow=in_flow) and not _is_typed(text):
        return str(text)
    if text.isprintable():
        if "'" in text and '"' not in text and "\\" not in text:
            return f'"{text}"'
        return "'" + text.replace("'", "''") + "'"
    return '"' + "".join(map(_escaped, text)) + '"'


def _is_plain(text: str, *, in_flow: bool) -> bool:
    if text in _NULLS or not text.isprintable() or text != text.strip():
        return False
    first = text[0]
    if first in _INDICATORS and (first not in _OPENING or len(text) < 2 or text[1] in " ,[]{}"):
        return False
    if ": " in text or " #" in text or text.endswith(":"):
        return False
    if text.startswith(("---", "...")):
        return False
    if not in_flow:
        return True
    return _FLOW.isdisjoint(text) and not (first == "?" or first == ":")


def _is_typed(text: str) -> bool:
    return isinstance(text, Quoted) and not isinstance(type_plain(text), str)


_SHORT_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def _escaped(char: str) -> str:
    if char in _SHORT_ESCAPES:
        return _SHORT_ESCAPES[char]
    if char.isprintable():
        return char
    code = ord(char)
    if code < 0x100:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
