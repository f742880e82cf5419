"""Reads on after what is not YAML: lines with a fault are hidden, so that the others can be read.

What is hidden becomes blanks, so that all offsets stay. First as little as possible is hidden: the
value after a key. If there is a fault in the same line again, all of the entry goes with what is
indented below it, then the dash before it, and at last the rest of the file.
"""

from __future__ import annotations

from bisect import bisect_right

from ..diagnostics import YamaroError, failure
from ..source import Source, Span
from .reader import NodeBuilder, Reading

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import NoReturn

    from ..diagnostics import Diagnostic
    from ..policy import Limits

MAX_FAULTS = 20
"""Faults to hide in a text, before the rest of it is hidden."""
MAX_CHARACTERS = 2_000_000
"""Characters to read again, besides three times the text."""
_VALUE, _ENTRY, _LINE, _REST = range(4)
"""What is hidden at the first, second, third and last fault of a line."""
_GOES_ON = "[{\"'|>&*!"
"""How a value begins that goes on in the lines below it without being a mapping or a list."""
_CHARACTERS = ("control-character", "misplaced-bom")
_STRUCTURE = ("yaml-syntax", "yaml-tab", "several-documents")
"""Faults that lines which follow each other have together, and those behind a hidden line."""


class Recovery:
    """One text with faults, being read again and again."""

    def __init__(self, source: Source, limits: Limits) -> None:
        """Begin with nothing hidden."""
        self._source = source
        self._limits = limits
        self._text = source.text  # as it is to be read
        self._starts = source.line_starts()
        self._hidden: list[Span] = []
        self._errors: list[Diagnostic] = []
        self._times: dict[int, int] = {}  # how often a line had a fault
        self._behind = -1  # the first line behind what was hidden last
        self._furthest = -1  # the last place from which lines were hidden

    def run(self, fault: Diagnostic, builder: NodeBuilder) -> Reading:
        """Return what can be read, after a first try with `builder` came to a fault."""
        left = MAX_CHARACTERS + 3 * len(self._text)
        for times in range(MAX_FAULTS + 2):
            left -= fault.span.end
            if not self._hide(fault, builder, is_last=times >= MAX_FAULTS or left < 0):
                break
            kept: list[Diagnostic] = []
            builder = NodeBuilder(self._source, self._limits, text=self._text, errors=kept)
            try:
                refuse_characters(Source(self._text, name=self._source.name))
                root = builder.build()
            except YamaroError as error:
                fault = error.diagnostics[0]
                continue
            self._errors.extend(error for error in kept if not self._is_caused(error))
            self._hidden.extend(node.span() for node in builder.absent)
            self._hidden.sort(key=lambda span: span.start)
            self._errors.sort(key=lambda error: error.span.start)
            return Reading(root, self._errors, self._hidden, self._text)
        self._text = ""
        everything = Span(self._source, 0, len(self._source.text))
        return Reading(None, self._errors, [everything], self._text)

    def _is_caused(self, error: Diagnostic) -> bool:
        """Return whether an alias has no anchor because that is hidden."""
        if error.code != "undefined-alias":
            return False
        anchor = "&" + error.span.written()[1:]
        return any(anchor in span.written() for span in self._hidden)

    def _hide(self, fault: Diagnostic, builder: NodeBuilder, *, is_last: bool) -> bool:
        """Hide what a fault is in, and note it unless it follows from another.

        Returns:
            Whether it makes sense to read on.
        """
        at = fault.span.start
        fault.span = Span(self._source, at, fault.span.end)
        if fault.code in _CHARACTERS and not is_last:
            self._errors.append(fault)
            self._hidden.append(Span(self._source, at, at + 1))
            self._text = f"{self._text[:at]} {self._text[at + 1 :]}"
            self._times[self._line_at(at)] = 1
            return at < len(self._source.text) and not is_binary(self._source.text)
        if builder.open_flow is not None:
            at = min(at, builder.open_flow.start)
        line = self._line_at(at)
        while line > 0 and self._is_blank(line, self._source.text):
            line -= 1
        times = self._times.get(line, 0)
        self._times[line] = times + 1
        if not times and not self._is_caused_by_hiding(fault, line):
            self._errors.append(fault)
        if is_last or times >= _REST:
            self._hide_from(self._starts[line], len(self._starts) - 1)
        elif times or fault.code not in _STRUCTURE or not self._hide_above(line):
            self._hide_in(line, at, times)
        return times <= _REST

    def _is_caused_by_hiding(self, fault: Diagnostic, line: int) -> bool:
        """Return whether a fault is likely to be there only because something is hidden."""
        return (
            (self._is_blank(line, self._text) and not self._is_blank(line, self._source.text))
            or (line == self._behind and fault.code in _STRUCTURE)
            # Faults are met in order, so this one goes across what is hidden.
            or fault.span.start < self._furthest
        )

    def _hide_in(self, line: int, at: int, extent: int) -> None:
        """Hide the value, the entry or all of a line, and what belongs to it below."""
        text = self._source.text
        dash = self._indented(line)
        key = self._behind_dashes(dash, line)
        begin = dash if extent == _LINE else key
        goes_on = True
        if extent == _VALUE and (value := self._value_behind(key, line)) and at >= value:
            begin, goes_on = value, text[value] in _GOES_ON
        column = (dash if extent == _LINE else key) - self._starts[line]
        has_list = begin == dash
        last = self._last_below(line, column, has_list=has_list) if goes_on else line
        self._behind = self._next_line(last + 1)
        if begin == key and self._column(self._behind) <= dash - self._starts[line]:
            begin = dash  # nothing is left of the item
        self._hide_from(begin, last)

    def _hide_above(self, line: int) -> bool:
        """Hide the lines above that cause a line not to fit; return whether there are any."""
        first = self._misfit_above(line)
        if first is None:
            return False
        self._behind = line
        self._hide_from(self._indented(first), line - 1)
        return True

    def _misfit_above(self, line: int) -> int | None:
        """Return the first of the lines above to hide because a line does not fit to them, or None.

        Those may be an item without a space behind its dash, or lines that are indented deeper by
        mistake: if they are fewer than those from this line on in its column.
        """
        column = self._column(line)
        first, deeper = line, 0
        above = line - 1
        while above >= 0:
            if not self._is_void(above):
                if self._column(above) <= column:
                    break
                first, deeper = above, deeper + 1
            above -= 1
        if above >= 0 and self._column(above) == column:
            start = self._indented(above)
            sign, behind = self._source.text[start], self._source.text[start + 1 : start + 2]
            return above if sign == "-" and behind.strip() else None
        level, below = 0, line
        while level <= deeper and (own := self._column(below)) >= column:
            level += own == column
            below = self._next_line(below + 1)
        return first if 0 < deeper < level else None

    def _is_void(self, line: int) -> bool:
        """Return whether a line holds no more than a comment."""
        start = self._indented(line)
        return start >= self._end_of(line) or self._source.text[start] == "#"

    def _last_below(self, line: int, column: int, *, has_list: bool) -> int:
        """Return the last line below `line` that is deeper than `column`, or closes a bracket.

        With `has_list`, the items of a list at that column are deeper, too.
        """
        last = line
        below = self._next_line(line + 1)
        while below < len(self._starts):
            start = self._indented(below)
            words = self._source.text[start : self._end_of(below)].strip()
            own = start - self._starts[below]
            is_item = has_list and own == column and words[:2].strip() == "-"
            if own <= column and not is_item and words.strip("]}), \t"):
                break
            last = below
            below = self._next_line(below + 1)
        return last

    def _hide_from(self, begin: int, last: int) -> None:
        """Put blanks from an offset to the end of a line; comments stay."""
        end = self._end_of(last)
        self._hidden.append(Span(self._source, begin, end))
        self._furthest = max(self._furthest, begin)
        pieces = [self._text[:begin]]
        line = self._line_at(begin)
        while begin < end:
            stop = min(self._end_of(line), end)
            comment = _comment_in(self._source.text, max(begin, self._starts[line]), stop)
            pieces.append(" " * (comment - begin))
            following = self._starts[line + 1] if line < last else end
            pieces.append(self._text[comment:following])
            begin = following
            line += 1
        pieces.append(self._text[end:])
        self._text = "".join(pieces)

    def _line_at(self, offset: int) -> int:
        return bisect_right(self._starts, offset) - 1

    def _next_line(self, line: int) -> int:
        """Return the first line from `line` on that holds more than a comment."""
        while line < len(self._starts) and self._is_void(line):
            line += 1
        return line

    def _is_blank(self, line: int, text: str) -> bool:
        return not text[self._starts[line] : self._end_of(line)].strip()

    def _end_of(self, line: int) -> int:
        """Return where a line ends, before its line break."""
        end = self._starts[line + 1] if line + 1 < len(self._starts) else len(self._source.text)
        while end > self._starts[line] and self._source.text[end - 1] in "\r\n":
            end -= 1
        return end

    def _indented(self, line: int) -> int:
        """Return where the text of a line begins, behind its spaces."""
        start, end = self._starts[line], self._end_of(line)
        while start < end and self._source.text[start] == " ":
            start += 1
        return start

    def _column(self, line: int) -> int:
        """Return how far a line is indented; -1 behind the last."""
        return self._indented(line) - self._starts[line] if line < len(self._starts) else -1

    def _behind_dashes(self, start: int, line: int) -> int:
        """Return where the entry begins behind the dashes of list items at `start`."""
        text, end = self._source.text, self._end_of(line)
        while text.startswith("- ", start):
            start += 2
            while start < end and text[start] == " ":
                start += 1
        return start

    def _value_behind(self, key: int, line: int) -> int:
        """Return where the value begins in the line of a key, or 0 if there is none."""
        text, end = self._source.text, self._end_of(line)
        colon = text.find(": ", key, end)
        if colon < 0:
            return 0
        value = colon + 2
        while value < end and text[value] == " ":
            value += 1
        return value if value < end else 0


def _comment_in(text: str, start: int, end: int) -> int:
    """Return where a comment begins in a stretch of a line, or its end if there is none."""
    at = text.find("#", start, end)
    while at >= 0:
        if (at == start or text[at - 1] in " \t") and not (
            '"' in text[start:at] or "'" in text[start:at]
        ):
            return at
        at = text.find("#", at + 1, end)
    return end


# --- the characters that YAML forbids, and those that only some readers allow -----------------


_NULS_OF_A_TEXT = 4
_MARK = "\ufeff"
_OTHER_BREAKS = {"\x85": "\\N", "\u2028": "\\L", "\u2029": "\\P"}


def refuse_characters(source: Source) -> None:
    """Raise YamaroError if the text holds a character that YAML forbids."""
    text = source.text
    if text.isascii():
        # The control characters are the only ASCII that YAML forbids, and libyaml names them.
        for char in "\x00\x7f":
            if char in text:
                _refuse_character(source, text.index(char))
        return
    if _MARK in text:
        from ..fixes import Edit, Fix

        at = text.index(_MARK)
        place = Span(source, at, at + 1)
        raise failure(
            "misplaced-bom",
            "a byte order mark (U+FEFF) is inside the text",
            place,
            hint="delete this invisible character; it often comes from pasting files together",
            fix=Fix("delete the byte order mark", [Edit(place, "")], is_safe=True),
        )
    places = [text.find(char) for char in "\ufffe\uffff\x00\x7f"]
    try:
        text.encode()
    except UnicodeEncodeError as error:  # a lone surrogate
        places.append(error.start)
    found = [at for at in places if at >= 0]
    if found:
        _refuse_character(source, min(found))
    breaks = [at for char in _OTHER_BREAKS if (at := text.find(char)) >= 0]
    if breaks:
        # They end a line, a comment too, for YAML 1.1 but not for YAML 1.2 and editors.
        at = min(breaks)
        char = source.text[at]
        raise failure(
            "control-character",
            f"the character U+{ord(char):04X} ends a line for some YAML parsers",
            Span(source, at, at + 1),
            hint=f'delete this invisible character; in a text write "{_OTHER_BREAKS[char]}" for it',
        )


def _refuse_character(source: Source, at: int) -> NoReturn:
    raise failure(
        "control-character",
        f"the character U+{ord(source.text[at]):04X} is not allowed in a YAML file",
        Span(source, at, at + 1),
        hint="delete this invisible character"
        if not is_binary(source.text)
        else "this file contains many of them and is probably not a text file",
    )


def is_binary(text: str) -> bool:
    """Return whether what should be a text has too many NULs to be one."""
    return text.count("\x00") >= _NULS_OF_A_TEXT


def first_control_character(text: str) -> int:
    """Return where the first control character is that libyaml refuses, or the text's length."""
    for at, char in enumerate(text):
        if char < " " and char not in "\t\n\r":
            return at
        if "\x7f" <= char <= "\x9f" and char != "\x85":
            return at
    return len(text)


# --- errors that may be there only because lines were hidden ----------------------------------


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
            text = self._source.line_text(first)
            depth = 2 * (len(text) - len(text.lstrip(" -")))
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
