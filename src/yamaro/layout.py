"""The style of YAML files: libyaml's tokens and comments, with other white space around them.

Only white space changes: tokens and comments keep their text and their order. Line breaks stay
where the author put them.
"""

from __future__ import annotations

import re

from yaml.tokens import (
    AliasToken,
    AnchorToken,
    BlockEndToken,
    BlockEntryToken,
    BlockMappingStartToken,
    BlockSequenceStartToken,
    FlowEntryToken,
    FlowMappingEndToken,
    FlowMappingStartToken,
    FlowSequenceEndToken,
    FlowSequenceStartToken,
    KeyToken,
    ScalarToken,
    StreamEndToken,
    StreamStartToken,
    TagToken,
    ValueToken,
)

from .diagnostics import Reporter, YamaroError
from .yaml.libyaml import DeepParser
from .yaml.nodes import ScalarNode
from .yaml.reader import read_on

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any

    from .policy import Limits
    from .source import Source


# --- the collections around a place, with the columns that they have and will have ------------


INDENT = 2
"""Columns that each level is further in than the one around it."""


class Level:
    """A block collection.

    Attributes:
        is_list: whether it is a list, whose items begin with a dash.
        old: the column in which its keys or dashes are.
        new: the column in which they will be.
        has_end: whether a token ends it; a list in the same column as the key above it has none.
    """

    __slots__ = ("has_end", "is_list", "new", "old")

    def __init__(self, *, is_list: bool, old: int, new: int) -> None:
        self.is_list = is_list
        self.old = old
        self.new = new
        self.has_end = True


class Bracket:
    """A flow collection that is open.

    Attributes:
        content: the column in which its lines begin.
        closing: the column of its closing bracket, if that begins a line.
    """

    __slots__ = ("closing", "content")

    def __init__(self, *, content: int, closing: int) -> None:
        self.content = content
        self.closing = closing


class OwnLine:
    """A comment with nothing else in its line.

    Attributes:
        text: the comment with its `#`.
        column: where it is.
        is_apart: whether a blank line is before it.
    """

    __slots__ = ("column", "is_apart", "text")

    def __init__(self, text: str, column: int, *, is_apart: bool) -> None:
        self.text = text
        self.column = column
        self.is_apart = is_apart


def comment_column(
    comment: OwnLine, levels: Sequence[Level], following: tuple[int, int], *, is_in_body: bool
) -> int:
    """Return the column that a comment in its own line moves to.

    It goes with what follows, unless it is further in: then with the level before it that it is
    in.

    Args:
        comment: the comment.
        levels: those around what is before it.
        following: the column of what follows, now and later.
        is_in_body: whether what is before it is a key or dash whose value would follow.
    """
    old, new = following
    if comment.column <= old:
        return new
    found, target = old, new
    for level in levels:
        if found < level.old <= comment.column:
            found, target = level.old, level.new
    if is_in_body and levels and comment.column > levels[-1].old:
        return levels[-1].new + INDENT
    return target


# --- scalars of several lines, moved to another column as a whole -----------------------------


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
    first = next((line for line in lines if line.strip(" ")), max(lines, key=len, default=""))
    indent = old + digits[0] if digits else len(first) - len(first.lstrip(" "))
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


# --- layout -----------------------------------------------------------------------------------


_OPENING = (FlowMappingStartToken, FlowSequenceStartToken)
_CLOSING = (FlowMappingEndToken, FlowSequenceEndToken)
_BLOCK_STARTS = (BlockMappingStartToken, BlockSequenceStartToken)
_STRUCTURE = (*_BLOCK_STARTS, BlockEndToken)
_AFTER_A_NAME = (AliasToken, AnchorToken, TagToken)
"""Tokens whose name would go on with a `:` or `,` that follows at once."""
_HEADS = (ValueToken, BlockEntryToken)
"""Tokens that a value follows."""
REMARK_GAP = 2
"""Columns between a line and the comment at its end, at least."""


class Layout:
    """Lays out one text.

    Attributes:
        parts: the finished text, in pieces.
    """

    __slots__ = (
        "_brackets",
        "_column",
        "_is_line_begun",
        "_is_open",
        "_is_spaced",
        "_last",
        "_last_end",
        "_levels",
        "_line",
        "_pending",
        "_shift",
        "_text",
        "parts",
    )

    def __init__(self, text: str) -> None:
        """Take a text that libyaml can read."""
        self.parts: list[str] = []
        self._text = text
        self._levels: list[Level] = []
        self._brackets: list[Bracket] = []
        self._pending: list[Any] = []  # tokens without a text, before the next one
        self._last: Any = None  # the token before
        self._last_end = 0
        self._line = 0  # where the token before ends
        self._column = 0  # of what is written next
        self._shift = 0  # of the line that is being written
        self._is_line_begun = False  # whether something is written in the line
        self._is_spaced = False  # whether a blank line comes next
        self._is_open = False  # whether a line break at the end would change a value

    def run(self) -> str:
        """Return the text laid out."""
        parser = DeepParser(self._text)
        try:
            while (token := parser.get_token()) is not None:
                self._take(token)
        finally:
            parser.dispose()
        return "".join(self.parts)

    def _take(self, token: Any) -> None:
        kind = type(token)
        if kind in _STRUCTURE or kind is StreamStartToken:
            self._pending.append(token)
            return
        start = token.start_mark.index
        end = token.end_mark.index
        if kind is KeyToken and start == end:  # it has no sign
            self._pending.append(token)
            return
        if self._is_line_begun and token.start_mark.line == self._line:
            self._apply_pending(token, begins_line=False)
            if self._needs_space(token):
                self._put(" ")
        else:
            self._begin_line(token)
        if kind is StreamEndToken:
            if self.parts and not self._is_open:
                self.parts.append("\n")
            return
        self._write_token(token, self._text[start:end])
        self._last, self._last_end = token, end
        self._pending.clear()

    # --- lines ------------------------------------------------------------------------------------

    def _begin_line(self, token: Any) -> None:
        """Write the comments before a token, and the line break and indentation for it."""
        between = self._text[self._last_end : token.start_mark.index]
        is_value = self._is_value(token)
        comments: list[OwnLine] = []
        remark = ""
        is_apart = self._is_spaced
        if "#" in between:
            remark, comments, is_apart = self._comments_in(between)
        elif self._last is not None:
            is_apart = is_apart or token.start_mark.line - self._line > 1
        if self._is_line_begun and type(self._last) is BlockEntryToken and is_value:
            if not remark and not comments:  # a dash is in the line of its item
                self._apply_pending(token, begins_line=False)
                self._put(" ")
                self._shift = self._column - token.start_mark.column
                return
        if remark:
            text = remark.lstrip()
            spaces = remark[: len(remark) - len(text)]
            is_wide = len(spaces) > REMARK_GAP and not spaces.strip(" ")
            self._put((spaces if is_wide else " " * REMARK_GAP) + text)
        before = list(self._levels) if comments else []
        self._apply_pending(token, begins_line=True)
        target = self._target(token)
        is_end = type(token) is StreamEndToken
        following = (0, 0) if is_end else (token.start_mark.column, target)
        is_in_body = not is_value and type(self._last) in _HEADS
        for number, comment in enumerate(comments):
            if self._brackets:
                column = self._brackets[-1].content
            else:
                column = comment_column(comment, before, following, is_in_body=is_in_body)
            is_first_in_body = number == 0 and is_value
            self._break_line(is_apart=comment.is_apart and not is_first_in_body)
            self._put(" " * column + comment.text)
        has_blank = is_apart and (comments or not is_value)
        self._is_spaced = False
        if type(token) is StreamEndToken:
            return
        self._break_line(is_apart=bool(has_blank) and type(token) not in _CLOSING)
        self._shift = target - token.start_mark.column
        self._put(" " * target)

    def _comments_in(self, between: str) -> tuple[str, list[OwnLine], bool]:
        """Return the comment at the end of the line, those in lines of their own, and a blank."""
        lines = BREAK.split(between)[::2]
        remark = ""
        column = 0
        if self._is_line_begun:
            remark = lines[0].rstrip() if "#" in lines[0] else ""
            lines = lines[1:]
        else:
            column = self._last.end_mark.column if self._last is not None else 0
        comments: list[OwnLine] = []
        is_apart = self._is_spaced
        for number, line in enumerate(lines):
            text = line.strip()
            if text:
                at = line.index("#") + (0 if number else column)
                comments.append(OwnLine(text, at, is_apart=is_apart))
                is_apart = False
            elif number < len(lines) - 1:
                is_apart = True
        return remark, comments, is_apart

    def _break_line(self, *, is_apart: bool) -> None:
        if not self.parts:
            return
        self.parts.append("\n\n" if is_apart else "\n")
        self._column = 0
        self._is_line_begun = False

    def _put(self, text: str) -> None:
        self.parts.append(text)
        self._column += len(text)
        self._is_line_begun = True

    # --- where a line begins ----------------------------------------------------------------------

    def _is_value(self, token: Any) -> bool:
        """Return whether a token begins the value of the key or dash, or is in the bracket, before.

        Otherwise that is empty, and the token goes on with something around it.
        """
        last = type(self._last)
        if last in _OPENING or self._last is None:
            return True
        if last not in _HEADS and last is not KeyToken:
            return False
        if self._brackets:
            return False
        kinds = {type(each) for each in self._pending}
        if BlockEndToken in kinds:
            return False
        if not kinds.isdisjoint(_BLOCK_STARTS):
            return True
        kind = type(token)
        if KeyToken in kinds or kind in (KeyToken, ValueToken, StreamEndToken):
            return False
        return last is not BlockEntryToken if kind is BlockEntryToken else True

    def _target(self, token: Any) -> int:
        """Return the column that a token moves to when it begins a line."""
        kind = type(token)
        if self._brackets:
            bracket = self._brackets[-1]
            return bracket.closing if kind in _CLOSING else bracket.content
        if not self._levels:
            return 0
        level = self._levels[-1]
        if kind in (BlockEntryToken, KeyToken, ValueToken):
            return level.new
        if any(type(each) is KeyToken for each in self._pending):
            return level.new
        return level.new + INDENT if kind is not StreamEndToken else 0

    def _apply_pending(self, token: Any, *, begins_line: bool) -> None:
        """Open and close the block collections that begin and end before a token."""
        kind = type(token)
        for each in self._pending:
            if type(each) is BlockEndToken:
                self._close_endless()
                self._levels.pop()
            elif type(each) is KeyToken:
                if not self._brackets:
                    self._close_endless()
            elif type(each) in _BLOCK_STARTS:
                is_list = type(each) is BlockSequenceStartToken
                column = each.start_mark.column
                level = self._opened(column, is_list=is_list, begins_line=begins_line)
                self._levels.append(level)
        if self._brackets:
            return
        if kind is BlockEntryToken:
            if self._levels and not self._levels[-1].is_list:
                column = token.start_mark.column
                level = self._opened(column, is_list=True, begins_line=begins_line)
                level.has_end = False
                self._levels.append(level)
        elif kind in (KeyToken, ValueToken):
            self._close_endless()

    def _close_endless(self) -> None:
        if self._levels and not self._levels[-1].has_end:
            self._levels.pop()

    def _opened(self, column: int, *, is_list: bool, begins_line: bool) -> Level:
        """Return the level of a block collection that begins in a column."""
        if not self._levels:
            return Level(is_list=is_list, old=column, new=0)
        around = self._levels[-1]
        is_below_key = begins_line and not around.is_list and type(self._last) is not KeyToken
        new = around.new if is_list and is_below_key else around.new + INDENT
        return Level(is_list=is_list, old=column, new=new)

    # --- within a line ----------------------------------------------------------------------------

    def _needs_space(self, token: Any) -> bool:
        """Return whether a space is between a token and the one before it in its line."""
        kind, last = type(token), type(self._last)
        if kind is StreamEndToken:
            return False
        has_space: bool = token.start_mark.index > self._last_end
        if last in _OPENING:
            return False
        if kind in _CLOSING:
            if last in (ValueToken, *_AFTER_A_NAME, KeyToken):
                return has_space
            return False
        if kind is FlowEntryToken:
            return has_space and last in (ValueToken, *_AFTER_A_NAME, KeyToken)
        if kind is ValueToken:
            return last is not ScalarToken and last not in _CLOSING
        return True

    def _write_token(self, token: Any, written: str) -> None:
        kind = type(token)
        self._is_open = False
        if kind is ScalarToken:
            if token.style in ("|", ">"):
                level = self._levels[-1] if self._levels else Level(is_list=False, old=0, new=0)
                block = move_block_scalar(written, old=level.old, new=level.new)
                self._write_lines(block.lines)
                self._is_spaced, self._is_open = block.has_blank_end, block.is_open
                self._line = token.end_mark.line
                self._is_line_begun = False
                return
            if token.end_mark.line > token.start_mark.line:
                least = self._least_column()
                self._write_lines(move_flow_scalar(written, shift=self._shift, least=least))
                self._line = token.end_mark.line
                return
        if kind in _OPENING:
            base = self._brackets[-1].content if self._brackets else self._least_column()
            at, text = token.end_mark.index, self._text
            while text[at : at + 1] in (" ", "\t"):
                at += 1
            if text[at : at + 1] in ("", "#", "\r", "\n"):
                self._brackets.append(Bracket(content=base + INDENT, closing=base))
            else:
                self._brackets.append(Bracket(content=self._column + 1, closing=self._column))
        elif kind in _CLOSING:
            self._brackets.pop()
        self._put(written)
        self._line = token.start_mark.line

    def _least_column(self) -> int:
        """Return the column in which a value begins below its key or dash."""
        return self._levels[-1].new + INDENT if self._levels else 0

    def _write_lines(self, lines: list[str]) -> None:
        self._put(lines[0])
        for line in lines[1:]:
            self._break_line(is_apart=False)
            self._put(line)


# --- a text in that style, which means the same afterwards ------------------------------------


class LayoutFault(Exception):
    """The text would mean something else afterwards: a fault of the formatter."""


def formatted(source: Source, limits: Limits | None = None) -> str:
    """Return the text of a source in Yamaro's style; only white space differs.

    Args:
        source: what to format. It must be YAML; what it means does not matter.
        limits: how deep it may be.

    Raises:
        YamaroError: it is not YAML as Yamaro reads it.
        LayoutFault: the formatter would change what the text means.
    """
    reading = read_on(source, reporter=Reporter(), limits=limits)
    if reading.errors:
        raise YamaroError(reading.errors)
    if isinstance(reading.root, ScalarNode):
        from .syntax.parser import parse

        parse(source).require()
    text = reading.text  # without the tabs of blank lines
    new = Layout(text).run()
    if "".join(new.split()) != "".join(source.text.split()):
        raise LayoutFault("formatting would change more than white space")
    if list(_meaning(new)) != list(_meaning(text)):
        raise LayoutFault("formatting would change the meaning of the file")
    end = source.text.find("\n")
    has_crlf = end > 0 and source.text[end - 1] == "\r"
    return new.replace("\n", "\r\n") if has_crlf else new


def _meaning(text: str) -> Iterator[tuple[Any, ...]]:
    """Give what libyaml reads in a text, without places."""
    parser = DeepParser(text)
    try:
        while (event := parser.get_event()) is not None:
            yield (
                type(event),
                getattr(event, "value", None),
                getattr(event, "style", None),
                bool(getattr(event, "flow_style", None)),
                getattr(event, "anchor", None),
                getattr(event, "tag", None),
            )
    finally:
        parser.dispose()
