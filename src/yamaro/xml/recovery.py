"""Reads XML that is being written: what is not well-formed is hidden, and open tags are closed.

So an editor knows the names of a file while it is edited. What is wrong with the file says
`read_xml`. Hidden characters are replaced with spaces, and the places of all others are known.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from itertools import accumulate

from ..diagnostics import YamaroError
from ..policy import Limits
from .reader import XmlReader

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Source
    from .tree import Element

_NAME = re.compile(r"[^\W\d][\w:.-]*")
_ATTRIBUTE = re.compile(
    r"""(\s+[^\W\d][\w:.-]*\s*=\s*)("(?:[^"<]|<(?=[\s=\d]))*"|'(?:[^'<]|<(?=[\s=\d]))*')"""
)
_END_OF_TAG = re.compile(r"\s*/?>")
_END_TAG = re.compile(r"</([^\W\d][\w:.-]*)?[ \t]*(>?)")
_JUNK = re.compile(r"[^<>\n]*")
_REST_OF_LINE = re.compile(r"[^\n]*")
_SPECIAL = (("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">"))
_FORBIDDEN = re.compile(
    "&(?!(?:#[0-9]{1,6}|#x[0-9a-fA-F]{1,5}|amp|lt|gt|quot|apos);)"
    "|]]>|[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]"
)
_NOT_SPACE = re.compile(r"\S")


class Tag:
    """A start tag, or an empty element.

    Attributes:
        name: of the element.
        start: where its `<` is.
        end: where the tag ends.
        close: where its end tag begins; where it ends itself if it has none.
        stop: where the element ends.
    """

    __slots__ = ("close", "end", "name", "start", "stop")

    def __init__(self, name: str, start: int, end: int) -> None:
        self.name = name
        self.start = start
        self.end = self.close = self.stop = end


class Tags:
    """The tags of a text, well-formed or not.

    Attributes:
        found: the start tags in order.
        completed: the text with what is not well-formed hidden, and the end tags that it lacks.
    """

    def __init__(self, text: str) -> None:
        """Look through a text."""
        self.found: list[Tag] = []
        self._text = text
        self._pieces: list[str] = []
        self._length = 0
        self._inserted: list[tuple[int, int]] = []
        self._open: list[Tag] = []
        self._unclosed: set[str] = set()
        self._last = -1  # where the last end tag of the root is
        self._is_ended = False  # there is a root element, and it is closed
        self._scan()
        self.completed = "".join(self._pieces)
        self._starts = [start for start, _ in self._inserted]
        self._sums = [0, *accumulate(length for _, length in self._inserted)]

    def origin(self, offset: int) -> int:
        """Return where in the text an offset of the completed text is."""
        index = bisect_right(self._starts, offset)
        if index and offset < self._inserted[index - 1][0] + self._inserted[index - 1][1]:
            offset = self._inserted[index - 1][0]  # in what is inserted
            index -= 1
        return offset - self._sums[index]

    def around(self, offset: int) -> list[Tag]:
        """Return the tags of the elements that an offset is in, the outermost first."""
        return [each for each in self.found if each.end <= offset <= each.close and
                each.close != each.end]  # fmt: skip

    def _scan(self) -> None:
        text, at = self._text, 0
        while at < len(text):
            start = text.find("<", at)
            start = len(text) if start < 0 else start
            self._add_text(text[at:start])
            at = start
            if at == len(text):
                break
            special = next((each for each in _SPECIAL if text.startswith(each[0], at)), None)
            if special is not None:
                at = self._add_special(at, *special)
            elif text.startswith("</", at):
                at = self._add_end(at)
            elif self._is_ended or (name := _NAME.match(text, at + 1)) is None:
                self._add(" ")
                at += 1
            else:
                at = self._add_tag(at, name[0])
        for tag in reversed(self._open):
            self._insert(f"</{tag.name}>")
            tag.close = tag.stop = len(text)

    def _add(self, piece: str) -> None:
        self._pieces.append(piece)
        self._length += len(piece)

    def _insert(self, piece: str) -> None:
        self._inserted.append((self._length, len(piece)))
        self._add(piece)

    def _add_text(self, text: str) -> None:
        self._add(_without_forbidden(text) if self._open else _hidden(text))

    def _add_special(self, at: int, opener: str, closer: str) -> int:
        """Add a comment, or hide a declaration; one without end ends at the end of its line."""
        text = self._text
        end = -1 if opener in self._unclosed else text.find(closer, at + len(opener))
        if end < 0:
            self._unclosed.add(opener)  # nor do those that follow
            rest = _REST_OF_LINE.match(text, at)
            end = rest.end() if rest is not None else len(text)
            self._add(_hidden(text[at:end]))
            return end
        end += len(closer)
        written = text[at:end]
        inner = written[len(opener) : -len(closer)]
        is_fine = opener == "<![CDATA[" or (
            opener == "<!--" and "--" not in inner and not inner.endswith("-")
        )
        is_kept = is_fine and bool(self._open) and not _FORBIDDEN.search(inner.replace("&", ""))
        self._add(written if is_kept else _hidden(written))
        return end

    def _add_end(self, at: int) -> int:
        found = _END_TAG.match(self._text, at)
        assert found is not None  # it matches a mere `</`
        end = found.end()
        name = found[1] or ""
        names = [each.name for each in self._open]
        is_early = names.count(name) == 1 and names[0] == name and at < self._last
        if name not in names or is_early:
            self._add(_hidden(self._text[at:end]))
            return end
        while True:
            tag = self._open.pop()
            tag.close = tag.stop = at
            if tag.name == name:
                break
            self._insert(f"</{tag.name}>")
        self._add(self._text[at:end])
        if not found[2]:
            self._insert(">")
        tag.stop = end
        self._is_ended = not self._open
        return end

    def _add_tag(self, start: int, name: str) -> int:
        text = self._text
        at = start + 1 + len(name)
        tag = Tag(name, start, at)
        if not self.found:
            self._last = text.rfind(f"</{name}")
        self.found.append(tag)
        self._add(text[start:at])
        given = set()
        while (found := _ATTRIBUTE.match(text, at)) is not None:
            key = found[1].partition("=")[0].strip()
            value = _without_forbidden(found[2]).replace("<", " ")
            self._add(_hidden(found[0]) if key in given else found[1] + value)
            given.add(key)
            at = found.end()
        while (close := _END_OF_TAG.match(text, at)) is None:
            junk = _JUNK.match(text, at)
            end = junk.end() if junk is not None else at
            if text[end : end + 1] != ">":
                self._add(_hidden(text[at:end]))
                self._insert(">")
                tag.end = end
                self._open.append(tag)
                return end
            is_empty = text[end - 1] == "/"
            self._add(_hidden(text[at : end - is_empty]))
            at = end - is_empty
        self._add(close[0])
        tag.end = tag.close = tag.stop = close.end()
        if close[0].strip() == ">":
            self._open.append(tag)
        elif not self._open:
            self._is_ended = True
        return tag.end


def _hidden(text: str) -> str:
    return _NOT_SPACE.sub(" ", text)


def _without_forbidden(text: str) -> str:
    return _FORBIDDEN.sub(lambda found: " " * len(found[0]), text)


def read_broken(source: Source, tags: Tags, limits: Limits | None = None) -> Element | None:
    """Return the root of a text that is not well-formed, as far as it can be read, or None."""
    try:
        return _CompletedReader(source, limits or Limits(), tags).read().root
    except YamaroError:
        return None


class _CompletedReader(XmlReader):
    """Reads a completed text, and finds places in that which it is made of."""

    def __init__(self, source: Source, limits: Limits, tags: Tags) -> None:
        super().__init__(source, limits, False, tags.completed)
        self._is_ascii = False  # offsets differ from those of the source
        self._tags = tags

    def _offset(self, index: int) -> int:
        return self._tags.origin(super()._offset(index))
