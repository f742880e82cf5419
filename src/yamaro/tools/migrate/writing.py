"""A source as YAML: its lines, statements in short heads, texts as scalars."""

from __future__ import annotations

from collections import Counter

from ...syntax.names import STATEMENTS, is_identifier
from ...yaml.brackets import find_close
from ...yaml.nodes import type_plain
from .document import RECORD_WIDTH, WIDTH, Body, Entry, Flow, Quoted, Row, joined, spaced, words_of

MOST_IN_BRACES = 6
LONGEST_KEY = 1000
"""Characters that a key may have before YAML wants a `?` in front of it."""


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


def _write_entries(body: Body, margin: str, out: list[str], *, key: str | None = None) -> None:
    """Write entries as a mapping, or as a list of mappings if a key comes again.

    Args:
        body: the entries.
        margin: where they are, or the key above them, if there is one: the dashes of a list are
            right below it, other entries further in.
        out: takes the lines.
        key: the key above them.
    """
    below = margin if key is None else f"{margin}  "
    is_function = key == "functions"
    entries = [
        with_short_head(entry, len(below) + 2, is_function=is_function, following=following)
        for entry, following in zip(body, [*body.entries[1:], None], strict=False)
    ]
    keys = [entry.key for entry in entries]
    times = Counter(keys)
    repeated = [key for key in keys if times[key] > 1]
    first = next((at for at, key in enumerate(keys) if key in keys[:at]), len(keys))
    is_tail = {key.partition("/")[0] for key in (*repeated, *keys[first:])} <= _SHAPES
    is_row = not is_tail and (
        2 * len(repeated) >= len(keys)
        or any(map(_has_item, repeated))
        or not _OF_MODELS.isdisjoint(keys)
    )
    margin = margin if repeated else below
    inner = f"{margin}  " if repeated else margin
    seen: set[str] = set()
    for index, entry in enumerate(entries):
        branches = {own.key for own in _branches(entries, index)}
        is_item = bool(repeated) and (is_row or not seen or not seen.isdisjoint(branches))
        seen = branches if is_item else seen | branches
        _write_comment(entry.comment, margin if is_item else inner, out)
        _write_entry(entry, f"{margin}- " if is_item else inner, inner, out)
    _write_comment(body.remark, inner, out)


_SHAPES = frozenset(("visual", "collision"))
"""Entries of which all but the first may be items of a list below the others."""
ACCEPTS = "yamaro: allow"
"""Begins a comment that accepts findings."""
_OF_MODELS = frozenset(("part", "include", "functions", "variables"))
"""Statements of a body in which each thing has an item of its own, if it is a list."""


def _branches(entries: list[Entry], index: int) -> list[Entry]:
    """Return an entry with the other branches of its condition below it, or none for a branch."""
    if entries[index].key.partition(" ")[0] in ("elif", "else"):
        return []
    end = index + 1
    while end < len(entries) and entries[end].key.partition(" ")[0] in ("elif", "else"):
        end += 1
    return entries[index:end]


def _has_item(key: str) -> bool:
    """Return if a key is that of a statement: each of a row of these has an item of its own."""
    word = key.partition(" ")[0]
    if word in ("elif", "else"):
        return False
    return word in STATEMENTS or key.rpartition(".")[2][:1].isupper()


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
    if ACCEPTS in ending:  # what it accepts is in its line
        lines[0 if takes_comment else -1] += f"  # {ending.replace(f' {ACCEPTS}', f' # {ACCEPTS}')}"
    elif ending and takes_comment and len(lines[0]) + len(ending) + 4 <= WIDTH:
        lines[0] += f"  # {ending}"
    else:
        _write_comment(ending, above, out)
    out += lines


def _write_pair(entry: Entry, head: str, margin: str, out: list[str], remarks: list[str]) -> bool:
    """Write key and value; return whether a comment may be at the end of the first line.

    What is remarked in a mapping in braces is added to `remarks`.
    """
    key = scalar_of(entry.key, in_flow=False)
    if len(key) > LONGEST_KEY:
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
        braces = _in_braces(value, remarks, value.width) if value.in_braces else None
        line = f"{head}{key}: {braces}"
        if braces is not None and len(line) <= value.width:
            out.append(line)
            return True
        remarks.clear()
        if value.wraps:
            pieces = [
                f"{scalar_of(own.key, in_flow=True)}: {scalar_of(str(own.value), in_flow=True)}"
                for own in value
            ]
            lines = _wrapped(pieces, WIDTH - len(margin) - 4)
            out += [f"{head}{key}: {{", *(f"{margin}    {row}" for row in lines), f"{margin}  }}"]
            return True
        out.append(f"{head}{key}:")
        _write_entries(value, margin, out, key=entry.key)
    return True


def _write_text(text: str, head: str, margin: str, out: list[str]) -> bool:
    """Write a text after its key; return whether a comment may be at the end of that line."""
    if isinstance(text, Row) and len(head) + len(text) >= WIDTH and is_plain(text, in_flow=False):
        out.append(head)
        out += [f"{margin}  {line}" for line in _wrapped(text.pieces, WIDTH - len(margin) - 2)]
        return False
    lines = text.split("\n")
    if len(lines) == 1 or not all(line.isprintable() for line in lines):
        scalar = scalar_of(text, in_flow=False)
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


def _in_braces(body: Body, remarks: list[str], width: int) -> str | None:
    """Return a mapping as `{key: value, …}`, or None if it does not fit on one line.

    What is remarked in it is added to `remarks`. One that takes more than `width` characters may
    give None.
    """
    if len(body.entries) > MOST_IN_BRACES or not body.entries or width < 0:
        return None
    pieces: list[str] = []
    keys = set()
    for entry in body:
        is_call = body.has_call and entry is body.entries[-1]
        if entry.key in keys or (entry.value is None and len(body.entries) > 1 and not is_call):
            return None
        if entry.ending or (entry.comment and pieces):  # it is better right at its key
            return None
        if isinstance(entry.value, Body) and entry.value.opening:
            return None
        remarks += filter(None, [entry.comment])
        keys.add(entry.key)
        value: str | None
        if isinstance(entry.value, Body):
            left = width - len(entry.key) - len("{: }")
            value = _in_braces(entry.value, remarks, left) if entry.value.in_braces else None
        else:
            value = "" if entry.value is None else scalar_of(entry.value, in_flow=True)
        if value is None or "\n" in value:
            return None
        pieces.append(f"{scalar_of(entry.key, in_flow=True)}: {value}")
    remarks += filter(None, [body.remark])
    return f"{{{', '.join(pieces)}}}"


# --- texts as scalars that YAML reads as these texts and no others ----------------------------


_INDICATORS = frozenset("-?:,[]{}#&*!|>'\"%@`")
_OPENING = frozenset("-?:")
_NULLS = frozenset(("", "~", "null", "Null", "NULL"))
_FLOW = frozenset(",[]{}")


def scalar_of(text: str, *, in_flow: bool) -> str:
    """Return a text as a YAML scalar that is read as this text and none other."""
    if isinstance(text, Flow):
        return str(text)
    if is_plain(text, in_flow=in_flow) and not (
        isinstance(text, Quoted) and not isinstance(type_plain(text), str)
    ):
        return str(text)
    if text.isprintable():
        if "'" in text and '"' not in text and "\\" not in text:
            return f'"{text}"'
        return "'" + text.replace("'", "''") + "'"
    return '"' + "".join(map(_escaped, text)) + '"'


def is_plain(text: str, *, in_flow: bool) -> bool:
    """Return whether a text can be a scalar without quotes."""
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


# --- statements in their short heads: `if length > 1:`, `for i in range(6):`, `Leg(side, y=0):`


_IN_HEADS = frozenset(("condition", "iterator", "range", "in", "input", "body"))
"""Keys that have another meaning, or are an error, directly below a short head."""


def with_short_head(
    entry: Entry, width: int, *, is_function: bool = False, following: Entry | None = None
) -> Entry:
    """Return a statement with a short head, or the entry itself where it cannot have one.

    A head that YAML would want in quotes stays in the long form, as does one that is too wide.

    Args:
        entry: a key with its value.
        width: how many characters the line has before the key.
        is_function: whether the entry is a function that is defined.
        following: the entry after it.
    """
    statement = entry.value
    if not isinstance(statement, Body) or statement.remark:
        return entry
    *parts, inner = statement.entries or [Entry("")]
    if inner.key != "body" or inner.comment or inner.ending or isinstance(inner.value, str):
        return entry
    head = _signature(entry.key, parts) if is_function else _head(entry.key, parts)
    if not head or not is_plain(head, in_flow=False) or width + len(head) + 1 > WIDTH:
        return entry
    content = Body(inner.value or ())
    if any(own.key in _IN_HEADS for own in content):
        return entry
    if inner.value is not None:
        content.remark = inner.value.remark
        content.opening = spaced(statement.opening, inner.value.opening)
    is_last = following is None or following.key not in ("elif", "else")
    content.in_braces = entry.key == "if" and is_last and _is_brief(content)
    comments = [part.comment for part in parts]
    short = Entry(head, content or None, joined(entry.comment, *comments))
    short.ending = spaced(entry.ending, *(part.ending for part in parts))
    return short


def _is_brief(content: Body) -> bool:
    """Return whether a body is one short element or call, which may be on the line of the head."""
    entries = content.entries
    if len(entries) != 1 or not is_identifier(entries[0].key) or entries[0].key in STATEMENTS:
        return False
    value = entries[0].value
    return value.in_braces if isinstance(value, Body) else value is not None


def _head(word: str, parts: list[Entry]) -> str:
    """Return the short head of a condition or a loop, or an empty text if it has none."""
    keys = [part.key for part in parts]
    texts = [part.value for part in parts if isinstance(part.value, str) and "$" not in part.value]
    if len(texts) < len(parts) or not all(texts):
        return ""
    if word in ("if", "elif") and keys == ["condition"]:
        return f"{word} {texts[0]}"
    if word == "for" and keys == ["iterator", "in"]:
        return f"for {texts[0]} in {texts[1]}"
    return ""


def _signature(name: str, parts: list[Entry]) -> str:
    """Return the name of a function with its parameters, or an empty text if that cannot be."""
    name, slash, scope = name.partition("/")
    if not parts:
        return f"{name}(){slash}{scope}"
    if [part.key for part in parts] != ["input"] or not isinstance(parts[0].value, Row):
        return ""
    head = f"{name}({parts[0].value})"
    is_closed = find_close(head, len(name) + 1) == len(head) - 1  # not inside of quotes
    return f"{head}{slash}{scope}" if is_closed else ""
