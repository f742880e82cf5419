"""Comments that accept findings where they are: `# yamaro: allow CODE`, in XML `<!-- … -->`.

A comment accepts what is found in its line, in the block or element that begins there, and in what
is called or included there. On a line of its own, before everything else in the file, it accepts
what is found in the whole file.
"""

from __future__ import annotations

import re
from bisect import bisect_right

from .codes import ADJUSTABLE
from .diagnostics import ACCEPTED, Meant, suggest
from .fixes import Edit, Fix
from .source import Source, Span, holds_xml

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from .diagnostics import Diagnostic, Frame, Reporter

    Lines = tuple[int, int]
    """A first and a last line, both counted from 1."""

UNUSED = "unused-allow"
MOST_STEPS = 100
"""Calls and includes that are looked at for a comment."""
_REMARK = re.compile(r"(?:^(?:#+|<!--)|\s#+)\s*yamaro:\s*([A-Za-z]+)\b:?")
"""At the beginning of a comment, or after a further `#`: one that quotes it in a text is prose."""
_CODE = re.compile(r"[\s,]*([A-Za-z0-9]+(?:[._-]+[A-Za-z0-9]+)*)")
_SIGN_IN_TAG = re.compile(r"[>\"']")
_REST_OF_LINE = re.compile(r"[^\r\n]*")
_OTHER_WORDS = ("accept", "allowed", "disable", "ignore", "noqa", "suppress")
"""What tools of other languages write in place of `allow`."""


class Allowance:
    """A comment that accepts findings.

    Attributes:
        span: the comment.
        word: `allow`, or what is written in its place.
        codes: the codes of what it accepts, each where it is written.
        lines: where that is found.
        has_line: whether nothing else is in its line.
    """

    __slots__ = ("codes", "has_line", "lines", "span", "word")

    def __init__(
        self, span: Span, word: Span, codes: Sequence[Span], lines: Lines, *, has_line: bool
    ) -> None:
        self.span = span
        self.word = word
        self.codes = {code.written(): code for code in codes}
        self.lines = lines
        self.has_line = has_line

    def accepts(self, code: str, line: int) -> bool:
        """Return whether a finding with a code is accepted, at a line of this file."""
        first, last = self.lines
        return first <= line <= last and code in self.codes


def accept(diagnostics: Iterable[Diagnostic]) -> None:
    """Mark what comments accept; among it are only errors that do not prevent a document."""
    for diagnostic in diagnostics:
        if is_accepted(diagnostic.code, diagnostic.span, diagnostic.trace):
            diagnostic.severity = ACCEPTED


def set_aside(diagnostics: list[Diagnostic]) -> list[Diagnostic]:
    """Take what is accepted out of a list, and return it."""
    accepted = [each for each in diagnostics if each.severity == ACCEPTED]
    if accepted:
        diagnostics[:] = [each for each in diagnostics if each.severity != ACCEPTED]
    return accepted


def is_accepted(code: str, span: Span, trace: Frame | None) -> bool:
    """Return whether a comment accepts what is found at a place to which calls have led."""
    return next(allowing(code, span, trace), None) is not None


def allowing(code: str, span: Span, trace: Frame | None) -> Iterator[Allowance]:
    """Give the comments that accept what is found at a place to which calls have led."""
    steps = 0
    place: Span | None = span
    while place is not None:
        source = place.source
        if source.has_remarks and code in ADJUSTABLE:
            line, _ = place.location()
            for allowance in allowances_of(source):
                if allowance.accepts(code, line):
                    yield allowance
        if trace is None or steps == MOST_STEPS:
            return
        place, trace, steps = trace.span, trace.parent, steps + 1


def allowances_of(source: Source) -> Sequence[Allowance]:
    """Return the comments of a file that accept findings, in order."""
    found: list[Allowance] | None = source.allowances
    if found is None:
        found = source.allowances = list(_read(source)) if source.has_remarks else []
    return found


def report_unused(source: Source, reporter: Reporter, is_looked_for: Callable[[str], bool]) -> None:
    """Report what comments of a file accept in vain.

    Args:
        source: the file.
        reporter: holds what was found, in which `accept` has marked what is accepted.
        is_looked_for: whether a code is found in this run wherever it applies.
    """
    used = {
        (allowance, each.code)
        for each in reporter.diagnostics
        if each.severity == ACCEPTED
        for allowance in allowing(each.code, each.span, each.trace)
    }
    for allowance in allowances_of(source):
        if allowance.word.written() != "allow":
            word = allowance.word.written()
            message = f"'{word}' is not a word that accepts findings"
            reporter.report(UNUSED, message, allowance.word, hint=Meant.of(word, "allow"))
            continue
        if not allowance.codes:
            _report(allowance, "this comment names no code to accept", reporter)
        elif allowance.has_line and not allowance.lines[1]:
            message = "a comment on a line of its own accepts nothing, except at the head of a file"
            hint = "write it at the end of the line of the finding"
            _report(allowance, message, reporter, hint=hint)
        else:
            for code, span in allowance.codes.items():
                if code not in ADJUSTABLE:
                    message = f"'{code}' is not a code that can be accepted"
                    near = suggest(code, ADJUSTABLE)
                    if near is not None:
                        reporter.report(UNUSED, message, span, hint=Meant.of(code, near))
                        continue
                    hint = "--allow takes the same codes; a reason can follow them in parentheses"
                    _report(allowance, message, reporter, span=span, hint=hint)
                elif code != UNUSED and (allowance, code) not in used and is_looked_for(code):
                    where = "in this file" if allowance.has_line else "here"
                    message = f"there is no '{code}' to accept {where}"
                    _report(allowance, message, reporter, span=span)


def _report(
    allowance: Allowance,
    message: str,
    reporter: Reporter,
    *,
    span: Span | None = None,
    hint: str | None = None,
) -> None:
    fix = _removal(allowance, span)
    reporter.report(UNUSED, message, span or allowance.span, hint=hint or fix.title, fix=fix)


def _removal(allowance: Allowance, code: Span | None) -> Fix:
    """Return the fix that removes a code, or the comment if it holds no other."""
    source = allowance.span.source
    text = source.text
    others = [span for span in allowance.codes.values() if span is not code]
    if code is not None and others:
        following = [span for span in others if span.start > code.end]
        if following:
            start, end = code.start, following[0].start
        else:
            start, end = others[-1].end, code.end
        return Fix(f"remove '{code.written()}'", [Edit(Span(source, start, end), "")])
    start, end = allowance.span.start, allowance.span.end
    while start > 0 and text[start - 1] in " \t":
        start -= 1
    if allowance.has_line:
        end += 2 if text.startswith("\r\n", end) else text[end : end + 1] in ("\n", "\r")
    return Fix("remove the comment", [Edit(Span(source, start, end), "")])


def acceptance(diagnostic: Diagnostic) -> Fix | None:
    """Return the fix that accepts a finding where it is; None if that cannot be written there."""
    code, source = diagnostic.code, diagnostic.span.source
    if code not in ADJUSTABLE or not source.path:
        return None
    line, _ = diagnostic.span.location()
    layout = _layout(source)
    first, last = layout.joined(line)
    comment = f"  # yamaro: allow {code}"
    if _is_xml(source):
        comment = f" <!-- yamaro: allow {code} -->"
    at = layout.end_of_line(line)
    for each in allowances_of(source):
        is_here = not each.has_line and first <= each.span.location()[0] <= last
        if is_here and each.codes and each.word.written() == "allow":
            comment, at = f", {code}", max(span.end for span in each.codes.values())
    text = source.text[:at] + comment + source.text[at:]
    new = Source(text, name=source.name, path=source.path)
    new.is_xml = source.is_xml
    start = diagnostic.span.start + (len(comment) if at < diagnostic.span.start else 0)
    if not is_accepted(code, Span(new, start, start), None):
        return None
    return Fix(f"accept '{code}' here", [Edit(Span(source, at, at), comment)])


# --- comments and lines ---------------------------------------------------------------------------


def _is_xml(source: Source) -> bool:
    return source.is_xml or holds_xml(source.path, source.text)


def _layout(source: Source) -> _YamlLayout | _XmlLayout:
    return _XmlLayout(source) if _is_xml(source) else _YamlLayout(source)


def _read(source: Source) -> Iterator[Allowance]:
    layout = _layout(source)
    for comment in layout.comments:
        remark = _REMARK.search(comment.written())
        if remark is None or (remark.start() and comment.written().startswith("<!--")):
            continue
        word = remark[1]
        if word != "allow" and word not in _OTHER_WORDS and suggest(word, ["allow"]) is None:
            continue
        start = comment.start
        codes: list[Span] = []
        at = remark.end()
        while (code := _CODE.match(comment.written(), at)) is not None:
            codes.append(Span(source, start + code.start(1), start + code.end(1)))
            at = code.end()
        text = source.text
        _, column = comment.location()
        before = text[comment.start - column + 1 : comment.start]
        after = _REST_OF_LINE.match(text, comment.end)
        has_line = not before.strip(" \t\ufeff") and not (after and after[0].strip())
        lines = (0, 0)
        if not has_line:
            lines = layout.lines_around(comment)
        elif comment.start < layout.start:
            lines = (1, len(source.line_starts()))
        yield Allowance(
            comment, Span(source, start + remark.start(1), start + remark.end(1)), codes,
            lines if word == "allow" else (0, 0), has_line=has_line,
        )  # fmt: skip


class _YamlLayout:
    """The lines of YAML that belong together.

    Attributes:
        comments: the comments.
        start: where the first key or value is.
    """

    __slots__ = ("_joined", "_source", "_texts", "comments", "start")

    def __init__(self, source: Source) -> None:
        from .yaml.comments import find_comments

        self._source = source
        self.comments: Sequence[Span] = find_comments(source, source.text)
        self._texts: dict[int, int] = {}  # where the line ends that begins a block scalar
        self._joined: list[Lines] = []
        self.start = len(source.text)
        self._read()

    def _read(self) -> None:
        """Note the lines over which a value in brackets or quotes goes on, or a text."""
        from .yaml.libyaml import DeepParser, YAMLError

        parser = DeepParser(self._source.text)
        depth = start = 0
        try:
            while (token := parser.get_token()) is not None:
                kind = type(token).__name__
                begin, end = token.start_mark.index, token.end_mark.index
                if end > begin and kind not in _HEAD_TOKENS:
                    self.start = min(self.start, begin)
                if kind.startswith("Flow") and kind.endswith("StartToken"):
                    start = begin if depth == 0 else start
                    depth += 1
                elif kind.startswith("Flow") and kind.endswith("EndToken"):
                    depth -= 1
                    if depth == 0:
                        self._join(start, end)
                elif kind == "ScalarToken" and depth == 0:
                    self._join(begin, end)
                    if token.style in ("|", ">"):
                        self._texts[self._source.location(begin)[0]] = begin
        except YAMLError:
            return
        finally:
            parser.dispose()

    def _join(self, start: int, end: int) -> None:
        text = self._source.text
        end = start + len(text[start:end].rstrip())
        first, last = self._source.location(start)[0], self._source.location(end)[0]
        if last == first:
            return
        if self._joined and self._joined[-1][1] >= first:
            first = self._joined.pop()[0]
        self._joined.append((first, last))

    def joined(self, line: int) -> Lines:
        """Return the lines over which what is in a line goes on."""
        at = bisect_right(self._joined, (line, len(self._source.text))) - 1
        if at >= 0 and line <= self._joined[at][1]:
            return self._joined[at]
        return line, line

    def lines_around(self, comment: Span) -> Lines:
        """Return the lines that a comment at the end of one is about: with the block below it."""
        source = self._source
        first, last = self.joined(comment.location()[0])
        text = source.text[source.line_starts()[first - 1] : comment.start]
        column = len(text) - len(text.lstrip(" -?"))
        has_list = text.rstrip().endswith(":") and not text[:column].strip()
        for number in range(last + 1, len(source.line_starts()) + 1):
            line = source.line_text(number)
            content = line.lstrip(" ")
            indentation = len(line) - len(content)
            if not content.strip() or content.startswith("#"):
                continue
            is_item = has_list and indentation == column and content.startswith(("- ", "-\t"))
            if indentation <= column and not is_item and content.strip() != "-":
                break
            last = number
        return first, last

    def end_of_line(self, line: int) -> int:
        """Return where a comment on a line can be written."""
        first, last = self.joined(line)
        source = self._source
        number = first if first in self._texts else last
        start = source.line_starts()[number - 1]
        return start + len(source.line_text(number).rstrip())


_HEAD_TOKENS = frozenset(
    ("StreamStartToken", "StreamEndToken", "DirectiveToken", "DocumentStartToken")
)


class _XmlLayout:
    """The lines of XML that belong together.

    Attributes:
        comments: the comments.
        start: where the root element begins.
    """

    __slots__ = ("_elements", "_source", "_tags", "comments", "start")

    def __init__(self, source: Source) -> None:
        self._source = source
        self._tags: list[Lines] = []  # offsets of each tag
        self._elements: dict[int, int] = {}  # where the element ends that a tag begins
        self.comments: list[Span] = []
        self.start = len(source.text)
        self._read()

    def _read(self) -> None:
        text, source = self._source.text, self._source
        open_tags: list[int] = []
        at = text.find("<")
        while at >= 0:
            for begin, sign in (("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">")):
                if text.startswith(begin, at):
                    end = text.find(sign, at + len(begin))
                    end = len(text) if end < 0 else end + len(sign)
                    if begin == "<!--":
                        self.comments.append(Span(source, at, end))
                    break
            else:
                end = _end_of_tag(text, at)
                self.start = min(self.start, at)
                self._tags.append((at, end))
                if text.startswith("</", at):
                    if open_tags:
                        self._elements[open_tags.pop()] = end
                elif text.startswith("/>", end - 2):
                    self._elements[at] = end
                else:
                    open_tags.append(at)
            at = text.find("<", end)

    def joined(self, line: int) -> Lines:
        """Return the lines of the tags in a line."""
        first, last = line, line
        for start, end in self._tags_in(line, line):
            first = min(first, self._source.location(start)[0])
            last = max(last, self._source.location(end - 1)[0])
        return first, last

    def _tags_in(self, first: int, last: int) -> Iterator[Lines]:
        """Give the tags in some lines."""
        starts = self._source.line_starts()
        begin = starts[first - 1]
        stop = starts[last] if last < len(starts) else len(self._source.text)
        at = max(bisect_right(self._tags, (begin, 0)) - 1, 0)
        for start, end in self._tags[at:]:
            if start >= stop:
                return
            if end > begin:
                yield start, end

    def lines_around(self, comment: Span) -> Lines:
        """Return the lines of the elements that begin in those of a comment, and of other tags."""
        source = self._source
        first, last = source.location(comment.start)[0], source.location(comment.end - 1)[0]
        found = list(self._tags_in(first, last))
        for start, end in found:
            first = min(first, source.location(start)[0])
            last = max(last, source.location(self._elements.get(start, end) - 1)[0])
        return first, last

    def end_of_line(self, line: int) -> int:
        """Return where a comment on a line can be written."""
        source = self._source
        _, last = self.joined(line)
        return source.line_starts()[last - 1] + len(source.line_text(last).rstrip())


def _end_of_tag(text: str, start: int) -> int:
    """Return the offset behind the `>` of a tag; values in quotes may hold one."""
    at = start
    for sign in _SIGN_IN_TAG.finditer(text, start):
        if sign.start() < at:
            continue
        if sign[0] == ">":
            return sign.end()
        end = text.find(sign[0], sign.end())
        if end < 0:
            break
        at = end + 1
    return len(text)
