"""What came of a conversion as bytes, and back: that is how it leaves a jail.

Who wrote the bytes may be an enemy. So each number is checked before it is used, nothing is run,
and whatever does not fit makes the whole answer a broken one.
"""

from __future__ import annotations

from .diagnostics import ERROR, WARNING, Diagnostic, Frame
from .jail.limits import JailAnswerBroken
from .jail.packing import pack, unpack
from .source import Source, Span
from .xmltree import Comment, Element, Text, format_value

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from .xmltree import Node

_ELEMENT, _TEXT, _COMMENT = b"e", b"t", b"c"


class Outcome:
    """What came of a conversion.

    Attributes:
        messages: what was printed, line by line.
        diagnostics: errors and warnings, in order.
        pieces: the document in UTF-8, in pieces; empty if there are errors.
        files: the files read.
        meshes: the meshes referred to.
        root: the finished tree, if it was asked for and there is one.
    """

    __slots__ = ("diagnostics", "files", "meshes", "messages", "pieces", "root")

    def __init__(
        self,
        *,
        messages: Sequence[str] = (),
        diagnostics: Sequence[Diagnostic] = (),
        pieces: Sequence[str] = (),
        files: Sequence[str] = (),
        meshes: Sequence[str] = (),
        root: Element | None = None,
    ) -> None:
        """Hold it."""
        self.messages = list(messages)
        self.diagnostics = list(diagnostics)
        self.pieces = list(pieces)
        self.files = list(files)
        self.meshes = list(meshes)
        self.root = root

    @property
    def has_errors(self) -> bool:
        """Tell whether the conversion has failed."""
        return any(diagnostic.severity == ERROR for diagnostic in self.diagnostics)


def to_bytes(outcome: Outcome) -> bytes:
    """Return an outcome as bytes."""
    packer = _Packer()
    diagnostics = pack([packer.diagnostic(each) for each in outcome.diagnostics])
    nodes = b"" if outcome.root is None else packer.tree(outcome.root)
    return pack(
        [
            _texts(outcome.messages),
            pack(packer.sources),
            pack(packer.frames),
            diagnostics,
            _text("".join(outcome.pieces)),
            _texts(outcome.files),
            _texts(outcome.meshes),
            nodes,
        ]
    )


def from_bytes(data: bytes) -> Outcome:
    """Return the outcome that some bytes tell of.

    Raises:
        JailAnswerBroken: they tell of none.
    """
    try:
        messages, sources, frames, diagnostics, document, files, meshes, nodes = unpack(data)
        unpacker = _Unpacker(unpack(sources), unpack(frames))
        return Outcome(
            messages=_read_texts(messages),
            diagnostics=[unpacker.diagnostic(each) for each in unpack(diagnostics)],
            pieces=[_read_text(document)],
            files=_read_texts(files),
            meshes=_read_texts(meshes),
            root=unpacker.tree(nodes) if nodes else None,
        )
    except (ValueError, IndexError) as error:
        raise JailAnswerBroken(f"the answer is none: {error}") from None


def _text(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _texts(texts: Sequence[str]) -> bytes:
    return pack([_text(text) for text in texts])


def _read_text(data: bytes) -> str:
    return data.decode("utf-8", "surrogatepass")


def _read_texts(data: bytes) -> list[str]:
    return [_read_text(each) for each in unpack(data)]


def _numbers(*numbers: int) -> bytes:
    return b" ".join(b"%d" % number for number in numbers)


def _read_numbers(data: bytes, count: int) -> list[int]:
    if len(data) > 21 * count:
        raise ValueError("a number is too long")
    numbers = [int(each) for each in data.split(b" ")]
    if len(numbers) != count:
        raise ValueError("numbers are missing")
    return numbers


class _Packer:
    """Packs what refers to sources and frames, and gathers these."""

    def __init__(self) -> None:
        self.sources: list[bytes] = []
        self.frames: list[bytes] = []
        self._known_sources: dict[int, int] = {}
        self._known_frames: dict[int, int] = {}
        self._kept: list[object] = []  # what is known by identity has to live

    def span(self, span: Span) -> bytes:
        source = span.source
        index = self._known_sources.get(id(source))
        if index is None:
            index = self._known_sources[id(source)] = len(self.sources)
            self._kept.append(source)
            self.sources.append(_texts([source.name, source.path, source.text]))
        length = len(source.text)
        return _numbers(index, min(span.start, length), min(span.end, length))

    def frame(self, frame: Frame | None) -> int:
        """Return the number of a frame, from 1; those it refers to come before it."""
        pending = [] if frame is None else [frame]
        while pending:
            last = pending[-1]
            before = [each for each in (last.parent, last.home) if each is not None]
            unknown = [each for each in before if id(each) not in self._known_frames]
            if unknown:
                pending += unknown
                continue
            pending.pop()
            if id(last) in self._known_frames:
                continue
            self._kept.append(last)
            around = [self._known_frames[id(e)] if e else 0 for e in (last.parent, last.home)]
            parts = [_text(last.kind), _text(last.name), self.span(last.span), _numbers(*around)]
            self.frames.append(pack(parts))
            self._known_frames[id(last)] = len(self.frames)
        return 0 if frame is None else self._known_frames[id(frame)]

    def diagnostic(self, diagnostic: Diagnostic) -> bytes:
        return pack(
            [
                _text(diagnostic.severity),
                _text(diagnostic.code),
                _text(diagnostic.message),
                self.span(diagnostic.span),
                _texts([] if diagnostic.hint is None else [diagnostic.hint]),
                _texts(diagnostic.notes),
                _numbers(self.frame(diagnostic.trace)),
            ]
        )

    def tree(self, root: Element) -> bytes:
        """Pack all nodes, each behind the one it stands in, whose number it tells."""
        nodes: list[bytes] = []
        pending: list[tuple[Node, int]] = [(root, 0)]
        while pending:
            node, parent = pending.pop()
            nodes.append(self._node(node, parent))
            if isinstance(node, Element):
                number = len(nodes) - 1
                pending.extend((child, number) for child in reversed(node.children))
        return pack(nodes)

    def _node(self, node: Node, parent: int) -> bytes:
        if isinstance(node, Text):
            text = _text(format_value(node.value))
            return pack([_TEXT, _numbers(parent), self.span(node.span), text])
        if isinstance(node, Comment):
            return pack([_COMMENT, _numbers(parent), self.span(node.span), _text(node.text)])
        attributes = []
        for name, value in node.attributes.items():
            if value is not None:
                place = self.span(node.value_span(name))
                attributes.append(pack([_text(name), _text(format_value(value)), place]))
        return pack(
            [
                _ELEMENT,
                _numbers(parent),
                self.span(node.span),
                _text(node.name),
                _numbers(self.frame(node.trace), node.verbatim),
                pack(attributes),
            ]
        )


class _Unpacker:
    """Unpacks what refers to sources and frames."""

    def __init__(self, sources: list[bytes], frames: list[bytes]) -> None:
        self._sources: list[Source] = []
        for data in sources:
            name, path, text = _read_texts(data)
            self._sources.append(Source(text, name=name, path=path))
        self._frames: list[Frame] = []
        for data in frames:
            self._frames.append(self._frame(data))

    def _frame(self, data: bytes) -> Frame:
        kind, name, place, around = unpack(data)
        parent, home = (self.frame(number) for number in _read_numbers(around, 2))
        return Frame(_read_text(kind), _read_text(name), self.span(place), parent=parent, home=home)

    def span(self, data: bytes) -> Span:
        index, start, end = _read_numbers(data, 3)
        source = self._sources[_checked(index, len(self._sources))]
        if not 0 <= start <= end <= len(source.text):
            raise ValueError("a place lies outside of its file")
        return Span(source, start, end)

    def frame(self, number: int) -> Frame | None:
        """Return a frame by its number, from 1; one that came before."""
        return self._frames[_checked(number - 1, len(self._frames))] if number else None

    def diagnostic(self, data: bytes) -> Diagnostic:
        severity, code, message, place, hints, notes, trace = unpack(data)
        if severity not in (ERROR.encode(), WARNING.encode()):
            raise ValueError("there is no such severity")
        return Diagnostic(
            _read_text(code),
            _read_text(message),
            self.span(place),
            hint=next(iter(_read_texts(hints)), None),
            notes=_read_texts(notes),
            severity=_read_text(severity),
            trace=self.frame(*_read_numbers(trace, 1)),
        )

    def tree(self, data: bytes) -> Element:
        nodes: list[Node] = []
        for each in unpack(data):
            kind, parent, place, *rest = unpack(each)
            node = self._node(kind, self.span(place), rest)
            if nodes:
                (number,) = _read_numbers(parent, 1)
                around = nodes[_checked(number, len(nodes))]
                if not isinstance(around, Element):
                    raise ValueError("a text holds another node")
                around.children.append(node)
            nodes.append(node)
        root = nodes[0]
        if not isinstance(root, Element):
            raise ValueError("the root is no element")
        return root

    def _node(self, kind: bytes, span: Span, rest: list[bytes]) -> Node:
        if kind == _TEXT:
            (text,) = rest
            return Text(_read_text(text), span)
        if kind == _COMMENT:
            (text,) = rest
            return Comment(_read_text(text), span)
        if kind != _ELEMENT:
            raise ValueError("there is no such kind of node")
        name, marks, packed = rest
        trace, verbatim = _read_numbers(marks, 2)
        element = Element(_read_text(name), span, trace=self.frame(trace), verbatim=bool(verbatim))
        places: dict[str, Span] = {}
        element.value_spans = places
        for each in unpack(packed):
            key, value, place = unpack(each)
            element.attributes[_read_text(key)] = _read_text(value)
            places[_read_text(key)] = self.span(place)
        return element


def _checked(index: int, count: int) -> int:
    if not 0 <= index < count:
        raise ValueError("there is no such number")
    return index
