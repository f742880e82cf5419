"""Scalars of several lines, moved to another column as a whole."""

from __future__ import annotations

import re

BREAK = re.compile("(\r\n|[\r\n\x85\u2028\u2029])")
"""What ends a line in YAML 1.1, which libyaml reads."""
_HEADER = re.compile(r"([|>][-+0-9]*)([ \t]*)(#.*)?")


class BlockScalar:
    """A block scalar in another column.

    Attributes:
        lines: its lines, the header first.
        has_blank_end: whether blank lines without a meaning follow.
        is_open: whether a line break after its last line would change its value.
    """

    __slots__ = ("has_blank_end", "is_open", "lines")

    def __init__(self, lines: list[str], *, has_blank_end: bool, is_open: bool) -> None:
        self.lines = lines
        self.has_blank_end = has_blank_end
        self.is_open = is_open


def move_block_scalar(written: str, *, old: int, new: int) -> BlockScalar:
    """Return a block scalar moved to another column.

    Args:
        written: from its `|` or `>` up to what follows.
        old: the column of the key or dash before it, as the file has it.
        new: that column later, or where the content of a document of one scalar would be.
    """
    pieces = BREAK.split(written)
    header, breaks = pieces[0], pieces[1::2]
    lines = pieces[2::2]
    match = _HEADER.match(header)
    assert match is not None, "libyaml gives only scalars that begin so"
    sign, _, remark = match.groups()
    digits = [int(char) for char in sign if char.isdigit()]
    is_last_broken = not lines or not lines[-1].strip(" ")
    indent = old + digits[0] if digits else _indent_of(lines)
    target = new + digits[0] if digits else new + 2
    if lines and not lines[-1].strip(" ") and len(lines[-1]) <= indent:
        lines.pop()  # the white space before what follows, or nothing at the end of the file
    moved = [" " * target + line[indent:] if len(line) > indent else "" for line in lines]
    is_keeping = "+" in sign
    count = len(moved)
    if not is_keeping:
        while moved and not moved[-1]:
            moved.pop()
    head = f"{sign}  {remark.rstrip()}" if remark else sign
    return BlockScalar(
        [head, *_with_breaks(moved, breaks[1:])],
        has_blank_end=not is_keeping and count > len(moved),
        is_open=not is_last_broken and "-" not in sign,
    )


def _indent_of(lines: list[str]) -> int:
    for line in lines:
        if line.strip(" "):
            return len(line) - len(line.lstrip(" "))
    return max(map(len, lines), default=0)


def _with_breaks(lines: list[str], breaks: list[str]) -> list[str]:
    """Return lines that are separated by line breaks of other kinds joined by these."""
    joined: list[str] = []
    is_joined = False
    for index, line in enumerate(lines):
        if is_joined:
            joined[-1] += line
        else:
            joined.append(line)
        kind = breaks[index] if index < len(breaks) else "\n"
        is_joined = kind not in ("\n", "\r\n", "\r") and index + 1 < len(lines)
        if is_joined:
            joined[-1] += kind
    return joined


def move_flow_scalar(written: str, *, shift: int, least: int) -> list[str]:
    """Return the lines of a plain or quoted scalar, moved.

    Args:
        written: how it is spelled, of several lines.
        shift: columns by which the line moves that it begins in.
        least: the least column for the lines after the first.
    """
    pieces = BREAK.split(written)
    first, lines = pieces[0], pieces[2::2]
    indents = [len(line) - len(line.lstrip(" \t")) for line in lines if line.strip(" \t")]
    shift = max(shift, least - min(indents, default=0))
    moved = [_stripped(first)]
    for index, line in enumerate(lines):
        text = line.lstrip(" \t")
        if text:
            text = " " * (len(line) - len(text) + shift) + text
        moved.append(text if index == len(lines) - 1 else _stripped(text))
    return _with_breaks(moved, pieces[1::2])


def _stripped(line: str) -> str:
    """Return a line without the white space at its end, unless a backslash makes it meant."""
    short = line.rstrip(" \t")
    return line if short.endswith("\\") else short
