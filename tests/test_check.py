"""The structural check: bad robots get exactly their one finding, good robots get none."""

from __future__ import annotations

from xml.parsers import expat

from yamaro.source import Source, Span
from yamaro.xmltree import Comment, Element, Text


class UrdfReader:
    """Reads URDF into elements whose spans are real: the source is the URDF text itself."""

    def __init__(self, text: str, *, name: str = "robot.urdf") -> None:
        self.source = Source(text, name=name)
        self.stack: list[Element] = []
        self.root: Element | None = None
        self.parser = expat.ParserCreate()
        self.parser.ordered_attributes = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.text
        self.parser.CommentHandler = self.comment
        self.encoded = text.encode()
        self.parser.Parse(self.encoded, True)

    def offset(self) -> int:
        return len(self.encoded[: self.parser.CurrentByteIndex].decode())

    def start(self, name: str, attributes: list[str]) -> None:
        start = self.offset()
        position = start + 1 + len(name)
        span = Span(self.source, start, position)
        values: dict[str, object] = {}
        spans = {}
        for key, value in zip(attributes[::2], attributes[1::2], strict=True):
            values[key] = value
            equals = self.source.text.index("=", self.source.text.index(key, position))
            while self.source.text[equals] not in "\"'":
                equals += 1
            close = self.source.text.index(self.source.text[equals], equals + 1)
            spans[key] = Span(self.source, equals + 1, close)
            position = close
        element = Element(name, span, attributes=values, value_spans=spans)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)

    def end(self, name: str) -> None:
        self.stack.pop()

    def text(self, data: str) -> None:
        if data.strip():
            span = Span(self.source, self.offset(), self.offset() + len(data))
            self.stack[-1].children.append(Text(data, span))

    def comment(self, data: str) -> None:
        if self.stack:
            self.stack[-1].children.append(Comment(data, self.stack[-1].span))


def read(text: str) -> Element:
    root = UrdfReader(text).root
    assert root is not None
    return root
