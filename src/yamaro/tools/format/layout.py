"""Layout: libyaml's tokens and the comments between them, with other white space around them.

Only white space changes: tokens and comments keep their text and their order. Line breaks stay
where the author put them.
"""

from __future__ import annotations

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

from ...yaml.libyaml import DeepParser
from .levels import INDENT, Bracket, Level, OwnLine, comment_column
from .scalars import BREAK, move_block_scalar, move_flow_scalar

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

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
            self._finish()
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
        self._write_remark(remark)
        before = list(self._levels) if comments else []
        self._apply_pending(token, begins_line=True)
        target = self._target(token)
        self._write_comments(comments, before, token, target, is_value=is_value)
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

    def _write_remark(self, remark: str) -> None:
        """Write the comment at the end of a line, as far from it as it was but not nearer."""
        if remark:
            text = remark.lstrip()
            spaces = remark[: len(remark) - len(text)]
            is_wide = len(spaces) > REMARK_GAP and not spaces.strip(" ")
            self._put((spaces if is_wide else " " * REMARK_GAP) + text)

    def _write_comments(
        self,
        comments: list[OwnLine],
        before: list[Level],
        token: Any,
        target: int,
        *,
        is_value: bool,
    ) -> None:
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

    def _finish(self) -> None:
        if self.parts and not self._is_open:
            self.parts.append("\n")

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
                self._write_block_scalar(token, written)
                return
            if token.end_mark.line > token.start_mark.line:
                self._write_flow_scalar(token, written)
                return
        if kind in _OPENING:
            self._open_bracket(token)
        elif kind in _CLOSING:
            self._brackets.pop()
        self._put(written)
        self._line = token.start_mark.line

    def _open_bracket(self, token: Any) -> None:
        """Note where the lines of a flow collection begin."""
        base = self._brackets[-1].content if self._brackets else self._least_column()
        if self._is_last_in_line(token):
            self._brackets.append(Bracket(content=base + INDENT, closing=base))
        else:
            self._brackets.append(Bracket(content=self._column + 1, closing=self._column))

    def _is_last_in_line(self, token: Any) -> bool:
        at, text = token.end_mark.index, self._text
        while text[at : at + 1] in (" ", "\t"):
            at += 1
        return text[at : at + 1] in ("", "#", "\r", "\n")

    def _least_column(self) -> int:
        """Return the column in which a value begins below its key or dash."""
        return self._levels[-1].new + INDENT if self._levels else 0

    def _write_block_scalar(self, token: Any, written: str) -> None:
        level = self._levels[-1] if self._levels else Level(is_list=False, old=0, new=0)
        block = move_block_scalar(written, old=level.old, new=level.new)
        self._write_lines(block.lines)
        self._is_spaced, self._is_open = block.has_blank_end, block.is_open
        self._line = token.end_mark.line
        self._is_line_begun = False

    def _write_flow_scalar(self, token: Any, written: str) -> None:
        least = self._least_column()
        self._write_lines(move_flow_scalar(written, shift=self._shift, least=least))
        self._line = token.end_mark.line

    def _write_lines(self, lines: list[str]) -> None:
        self._put(lines[0])
        for line in lines[1:]:
            self._break_line(is_apart=False)
            self._put(line)
