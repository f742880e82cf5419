"""Where in a file a part of a value or text is written."""

from __future__ import annotations

from ..source import Span
from ..xml.tree import Comment, Element, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..diagnostics import Frame

_ENTITIES = {"lt": "<", "gt": ">", "amp": "&", "quot": '"', "apos": "'"}


class XacroPlace:
    """What is being evaluated: an attribute, a text or a comment, and how it was reached.

    Attributes:
        node: where it is written.
        attribute: the attribute of an element.
        trace: the calls and includes that led there.
        shift: how many characters of what is written come before the text in question.
    """

    __slots__ = ("attribute", "node", "shift", "trace")

    def __init__(self, node: Element | Text | Comment, attribute: str, trace: Frame | None) -> None:
        self.node = node
        self.attribute = attribute
        self.trace = trace
        self.shift = 0

    def span(self, start: int = 0, end: int | None = None) -> Span:
        """Return the place of the whole, or of a stretch of it."""
        node = self.node
        if isinstance(node, Element):
            value: object = node.attributes.get(self.attribute, "")
            whole = node.value_span(self.attribute)
        elif isinstance(node, Text):
            value, whole = node.value, node.span
        else:
            value, written = node.text, node.span
            whole = Span(written.source, written.start + len("<!--"), written.end - len("-->"))
        if end is None:
            return whole if isinstance(node, Element) else _trimmed(whole)
        return stretch(whole, str(value), start + self.shift, end + self.shift)


def stretch(whole: Span, value: str, start: int, end: int) -> Span:
    """Return where `value[start:end]` is written, or all of `whole` if that is not known."""
    written = whole.written()
    if written == value:
        return Span(whole.source, whole.start + start, whole.start + end)
    offsets = _offsets(written, value)
    if offsets is None or not start < end < len(offsets):
        return whole
    return Span(whole.source, whole.start + offsets[start], whole.start + offsets[end])


def _offsets(written: str, value: str) -> list[int] | None:
    """Return where each character of a value begins in what is written, and where the last ends."""
    offsets = []
    position = 0
    for char in value:
        offsets.append(position)
        own = written[position : position + 1]
        if own == "&":
            end = written.find(";", position)
            name = written[position + 1 : end]
            if end < 0 or not (name.startswith("#") or _ENTITIES.get(name) == char):
                return None
            position = end + 1
        elif own == char or (own in ("\t", "\n") and char == " "):
            position += 1
        elif own == "\r" and char in " \n":
            position += 2 if written.startswith("\r\n", position) else 1
        else:
            return None
    return [*offsets, position] if position == len(written) else None


def _trimmed(span: Span) -> Span:
    """Return a place without the white space around it."""
    written = span.written()
    start = span.start + len(written) - len(written.lstrip())
    end = span.start + len(written.rstrip())
    return Span(span.source, start, end) if start < end else span
