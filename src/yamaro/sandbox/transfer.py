"""The outcome of a conversion as bytes, and back: that is how it leaves a jail.

The bytes may come from an attacker. So everything is checked before it is used: numbers by their
range, codes by their form, paths, and the document by a parser. Nothing is run, and whatever does
not fit makes the whole answer a broken one. What remains free is text for people, which is escaped
where it is shown.
"""

from __future__ import annotations

import os
from itertools import pairwise

from ..diagnostics import ACCEPTED, ERROR, FRAME_KINDS, WARNING, Diagnostic, Frame, YamaroError
from ..fixes import Edit, Fix
from ..policy import Limits
from ..source import (
    STANDARD_INPUT_NAME,
    OverlaidSpan,
    Reading,
    RecordedSpan,
    Source,
    Span,
)
from ..xml.tree import Comment, Element, Text
from ..xml.values import bad_name_character, format_value, is_comment_text
from ..xml.wellformed import check_document
from ..xml.writer import write_pieces
from .jail.protocol import JailAnswerBroken, pack, unpack

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Container, Mapping, Sequence

    from ..xml.tree import Node


# --- what leaves a jail -----------------------------------------------------------------------


class Document:
    """A document in one output format.

    Attributes:
        format: the format.
        file_name: what its file is called.
        text: the document.
        root: its tree, if it was asked for.
        losses: what the format cannot hold, as warnings.
        assets: what belongs beside the document by its path, or None if that is not known yet.
        robot: the tree of the robot as it was run for this format, if it was asked for and is not
            that of the outcome.
        notes: what comes with that tree.
        refusal: why there is no document, or "".
    """

    __slots__ = (
        "assets",
        "file_name",
        "format",
        "losses",
        "notes",
        "refusal",
        "robot",
        "root",
        "text",
    )

    def __init__(
        self,
        format: str,
        text: str,
        *,
        root: Element | None = None,
        losses: Sequence[Diagnostic] = (),
        assets: Mapping[str, bytes] | None = None,
        robot: Element | None = None,
        notes: Sequence[Element] = (),
        file_name: str = "",
        refusal: str = "",
    ) -> None:
        self.format = format
        self.file_name = file_name
        self.refusal = refusal
        self.text = text
        self.root = root
        self.losses = losses
        self.assets = assets
        self.robot = robot
        self.notes = notes


class Outcome:
    """The result of a conversion.

    Attributes:
        messages: what was printed, line by line.
        diagnostics: errors and warnings, in order.
        pieces: the document in UTF-8, in pieces; empty if there are errors.
        files: the files read.
        meshes: the meshes referred to.
        made: those of them that the conversion made, their bytes by their names.
        root: the finished tree, if it was asked for and there is one.
        notes: what comes with the tree of a robot, such as its sensors.
        documents: the documents in the output formats asked for, if there are any.
        noted: the values of names where they are declared, if they were asked for.
    """

    __slots__ = (
        "diagnostics",
        "documents",
        "files",
        "made",
        "meshes",
        "messages",
        "noted",
        "notes",
        "pieces",
        "root",
    )

    def __init__(
        self,
        *,
        messages: Sequence[str] = (),
        diagnostics: Sequence[Diagnostic] = (),
        pieces: Sequence[str] = (),
        files: Sequence[str] = (),
        meshes: Sequence[str] = (),
        made: Mapping[str, bytes] | None = None,
        root: Element | None = None,
        notes: Sequence[Element] = (),
        documents: Sequence[Document] = (),
        noted: Sequence[Reading] = (),
    ) -> None:
        self.messages = list(messages)
        self.diagnostics = list(diagnostics)
        self.pieces = list(pieces)
        self.files = list(files)
        self.meshes = list(meshes)
        self.made = made or {}
        self.root = root
        self.notes = list(notes)
        self.documents = list(documents)
        self.noted = list(noted)

    @property
    def has_errors(self) -> bool:
        """Return whether the conversion has failed."""
        return any(diagnostic.severity == ERROR for diagnostic in self.diagnostics)


# --- its bytes --------------------------------------------------------------------------------


_ELEMENT, _TEXT, _COMMENT = b"e", b"t", b"c"
_RECORDED = b"r"
"""Begins a place that holds more than the stretch of text; those that do not begin with a digit."""
LONGEST_CODE = 60
LONGEST_EDIT = 20_000
"""Bytes that an edit writes."""
MOST_EDITS = 1_000
"""Edits of a fix."""
LONGEST_PATH = 4096
"""Bytes of a path, and of a name that files are shown under: PATH_MAX of Linux."""


def to_bytes(outcome: Outcome) -> bytes:
    """Return an outcome as bytes."""
    packer = _Packer()
    diagnostics = pack([packer.diagnostic(each) for each in outcome.diagnostics])
    nodes, document = b"", ""
    notes = pack([packer.tree(note) for note in outcome.notes])
    documents = pack([packer.document(each) for each in outcome.documents])
    noted = pack([packer.reading(each) for each in outcome.noted])
    if outcome.root is not None:
        nodes = packer.tree(outcome.root)  # of which the document is made again
    else:
        document = "".join(outcome.pieces)
    return pack(
        [
            _texts(outcome.messages),
            pack(packer.sources),
            pack(packer.frames),
            diagnostics,
            _text(document),
            _texts(outcome.files),
            _texts(outcome.meshes),
            nodes,
            notes,
            documents,
            noted,
            pack([each for name, data in outcome.made.items() for each in (_text(name), data)]),
        ]
    )


def from_bytes(data: bytes, limits: Limits | None = None, *, texts: Container[str] = ()) -> Outcome:
    """Return the outcome that some bytes describe.

    Args:
        data: what came out of a jail.
        limits: what a conversion may use, by default what a trusted one may.
        texts: the output formats whose documents are not XML.

    Raises:
        JailAnswerBroken: they do not describe one.
    """
    limits = limits or Limits()
    try:
        messages, sources, frames, diagnostics, document, files, meshes, *rest = unpack(data)
        nodes, notes, documents, noted, made = rest
        made_parts = unpack(made)
        unpacker = _Unpacker(unpack(sources), unpack(frames))
        printed = _read_texts(messages)
        if sum(map(len, printed)) + len(printed) > 2 * (limits.printed + 1):
            raise ValueError("more is printed than may be")
        outcome = Outcome(
            messages=printed,
            diagnostics=[unpacker.diagnostic(each) for each in unpack(diagnostics)],
            files=[_read_file(each) for each in unpack(files)],
            meshes=[_read_name(each) for each in unpack(meshes)],
            made=dict(zip(map(_read_inner, made_parts[::2]), made_parts[1::2], strict=True)),
            root=unpacker.tree(nodes) if nodes else None,
            notes=[unpacker.tree(each) for each in unpack(notes)],
            documents=[unpacker.document(each, limits, texts) for each in unpack(documents)],
            noted=[unpacker.reading(each) for each in unpack(noted)],
        )
        if (document or nodes) and not outcome.has_errors:
            if outcome.root is None:
                text = document.decode()
            else:
                try:
                    text = "".join(write_pieces(outcome.root, limits))
                except YamaroError as error:
                    raise ValueError(error.diagnostics[0].message) from None
            check_document(text, limits)
            outcome.pieces = [text]
        return outcome
    except (ValueError, IndexError) as error:
        raise JailAnswerBroken(f"its answer is malformed: {error}") from None


def _text(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _texts(texts: Sequence[str]) -> bytes:
    return pack([_text(text) for text in texts])


def _read_text(data: bytes) -> str:
    return data.decode("utf-8", "surrogatepass")


def _read_texts(data: bytes) -> list[str]:
    return [_read_text(each) for each in unpack(data)]


def _read_code(data: bytes) -> str:
    """Return the code of a diagnostic, which is in kebab-case, perhaps with a version in it."""
    code = data.decode("ascii")
    words = code.replace(".", "-").split("-")  # as in `capsule-needs-urdf-1.1`
    if len(code) > LONGEST_CODE or not all(
        word.isalnum() and word == word.lower() for word in words
    ):
        raise ValueError("the code of a diagnostic is not in kebab-case")
    return code


def _read_name(data: bytes) -> str:
    """Return what a file is called, which may be no path."""
    name = _read_text(data)
    if len(data) > LONGEST_PATH or "\0" in name:
        raise ValueError("a file cannot have such a name")
    os.fsencode(name)
    return name


def _read_file(data: bytes) -> str:
    """Return the path of a file that was read, or what standard input is called."""
    return STANDARD_INPUT_NAME if data == STANDARD_INPUT_NAME.encode() else _read_path(data)


def _read_path(data: bytes) -> str:
    path = _read_name(data)
    if not os.path.isabs(path):
        raise ValueError("a path is not absolute")
    return path


def _read_inner(data: bytes) -> str:
    """Return the path of a file that is below a folder.

    A hidden one is directly in it; whether it may be there, the table of targets says.
    """
    path = _read_name(data)
    steps = path.split("/")
    is_hidden = len(steps) == 1 and path[:1] == "." and path not in (".", "..")
    is_below = all(step and (step[0] != "." or is_hidden) for step in steps)
    if not is_below or {"\\", ":"} & set(path):
        raise ValueError("a file is not below its folder")
    return path


def _numbers(*numbers: int) -> bytes:
    return b" ".join(b"%d" % number for number in numbers)


def _read_numbers(data: bytes, count: int) -> list[int]:
    if len(data) > 21 * count:
        raise ValueError("a number is too long")
    numbers = data.split(b" ")
    if len(numbers) != count or not all(map(bytes.isdigit, numbers)):
        raise ValueError("numbers are missing")
    return [int(each) for each in numbers]


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

    def recorded(self, span: Span, *, is_inner: bool = False) -> bytes:
        """Pack a place in the tree, with the variables that were read there if it has them.

        Of a place that another one notes, further places are not packed.
        """
        if not isinstance(span, RecordedSpan):
            return self.span(span)
        readings = [self.reading(each) for each in span.readings]
        others = [] if is_inner else [self.recorded(each, is_inner=True) for each in span.others]
        name_span = None if is_inner else span.name_span
        replaced, note = None, ""
        if isinstance(span, OverlaidSpan) and not is_inner:
            replaced, note = span.replaced, span.note
        return pack(
            [
                _RECORDED,
                self.span(span),
                b"" if name_span is None else self.recorded(name_span, is_inner=True),
                pack(readings),
                pack(others),
                b"" if replaced is None else self.recorded(replaced, is_inner=True),
                _text(note),
            ]
        )

    def reading(self, reading: Reading) -> bytes:
        places = [
            b"" if span is None else self.span(span) for span in (reading.span, reading.given)
        ]
        return pack([_text(reading.name), _text(reading.value), *places])

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
                self._fix(diagnostic.fix),
            ]
        )

    def _fix(self, fix: Fix | None) -> bytes:
        if fix is None:
            return b""
        edits = [pack([self.span(each.span), _text(each.text)]) for each in fix.edits]
        return pack([_text(fix.title), _numbers(fix.is_safe), pack(edits)])

    def document(self, document: Document) -> bytes:
        assets = document.assets
        return pack(
            [
                _text(document.format),
                _text(document.file_name),
                _text(document.refusal),
                _text(document.text),
                self._optional_tree(document.root),
                self._optional_tree(document.robot),
                pack([self.tree(note) for note in document.notes]),
                pack([self.diagnostic(each) for each in document.losses]),
                _numbers(assets is not None),
                *(each for name, data in (assets or {}).items() for each in (_text(name), data)),
            ]
        )

    def _optional_tree(self, root: Element | None) -> bytes:
        return b"" if root is None else self.tree(root)

    def tree(self, root: Element) -> bytes:
        """Pack all nodes, each after the one it is in, with the number of that."""
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
            return pack([_TEXT, _numbers(parent), self.recorded(node.span), text])
        if isinstance(node, Comment):
            return pack([_COMMENT, _numbers(parent), self.span(node.span), _text(node.text)])
        attributes = []
        for name, value in node.attributes.items():
            if value is not None:
                place = self.recorded(node.value_span(name))
                attributes.append(pack([_text(name), _text(format_value(value)), place]))
        return pack(
            [
                _ELEMENT,
                _numbers(parent),
                self.recorded(node.span),
                _text(node.name),
                _numbers(self.frame(node.trace), node.verbatim),
                pack(attributes),
            ]
        )


class _Unpacker:
    """Unpacks what refers to sources and frames."""

    def __init__(self, sources: list[bytes], frames: list[bytes]) -> None:
        self._sources = []
        for data in sources:
            name, path, text = unpack(data)
            absolute = _read_path(path) if path else ""
            self._sources.append(Source(_read_text(text), name=_read_name(name), path=absolute))
        self._names: dict[bytes, str] = {}  # those of elements and attributes that are fine
        self._frames: list[Frame] = []
        for data in frames:
            kind, name, place, around = unpack(data)
            parent, home = map(self.frame, _read_numbers(around, 2))
            word = kind.decode()
            if word not in FRAME_KINDS:
                raise ValueError("there is no such step")
            frame = Frame(word, _read_text(name), self.span(place), parent=parent, home=home)
            self._frames.append(frame)

    def span(self, data: bytes) -> Span:
        index, start, end = _read_numbers(data, 3)
        source = self._sources[_checked(index, len(self._sources))]
        if not 0 <= start <= end <= len(source.text):
            raise ValueError("a place lies outside of its file")
        return Span(source, start, end)

    def recorded(self, data: bytes, *, is_inner: bool = False) -> Span:
        """Return a place in the tree."""
        if data[:1].isdigit():
            return self.span(data)
        mark, place, name_place, packed, others, replaced, note = unpack(data)
        if mark != _RECORDED:
            raise ValueError("there is no such kind of place")
        if is_inner and (name_place or others or note):
            raise ValueError("a place is nested too deeply")
        readings = [self.reading(each) for each in unpack(packed)]
        span = RecordedSpan(
            self.span(place),
            tuple(readings),
            name_span=self.recorded(name_place, is_inner=True) if name_place else None,
            others=tuple(self.recorded(each, is_inner=True) for each in unpack(others)),
        )
        if not note:
            return span
        before = self.recorded(replaced, is_inner=True) if replaced else None
        return OverlaidSpan(span, _read_text(note), before)

    def reading(self, data: bytes) -> Reading:
        name, value, *places = unpack(data)
        span, given = (self.span(place) if place else None for place in places)
        return Reading(_read_text(name), _read_text(value), span, given)

    def frame(self, number: int) -> Frame | None:
        """Return a frame by its number, from 1; one that came before."""
        return self._frames[_checked(number - 1, len(self._frames))] if number else None

    def diagnostic(self, data: bytes) -> Diagnostic:
        severity, code, message, place, hints, notes, trace, fix = unpack(data)
        if severity.decode() not in (ERROR, WARNING, ACCEPTED):
            raise ValueError("there is no such severity")
        return Diagnostic(
            _read_code(code),
            _read_text(message),
            self.span(place),
            hint=next(iter(_read_texts(hints)), None),
            notes=_read_texts(notes),
            severity=_read_text(severity),
            trace=self.frame(*_read_numbers(trace, 1)),
            fix=self._fix(fix) if fix else None,
        )

    def _fix(self, data: bytes) -> Fix:
        title, safety, packed = unpack(data)
        (is_safe,) = _read_numbers(safety, 1)
        edits: list[Edit] = []
        for each in unpack(packed):
            place, text = unpack(each)
            if len(text) > LONGEST_EDIT or len(edits) == MOST_EDITS:
                raise ValueError("a fix is too long")
            edits.append(Edit(self.span(place), text.decode()))
        if any(one.span.end > next_one.span.start for one, next_one in pairwise(edits)):
            raise ValueError("the edits of a fix overlap")
        return Fix(_read_text(title), edits, is_safe=bool(is_safe))

    def document(self, data: bytes, limits: Limits, texts: Container[str]) -> Document:
        code, file_name, refusal, packed, root, robot, notes, losses, *rest = unpack(data)
        has_assets, *assets = rest
        name, text = _read_code(code), packed.decode()
        if name not in texts and not refusal:
            check_document(text, limits)
        elif len(text) > limits.output:
            raise ValueError("a document is longer than it may be")
        names, contents = map(_read_inner, assets[::2]), assets[1::2]
        return Document(
            name,
            text,
            root=self.tree(root) if root else None,
            robot=self.tree(robot) if robot else None,
            notes=[self.tree(each) for each in unpack(notes)],
            losses=[self.diagnostic(each) for each in unpack(losses)],
            assets=dict(zip(names, contents, strict=True))
            if _read_numbers(has_assets, 1) != [0]
            else None,
            file_name=_read_inner(file_name) if file_name else "",
            refusal=_read_text(refusal),
        )

    def tree(self, data: bytes) -> Element:
        nodes: list[Node] = []
        for each in unpack(data):
            kind, parent, place, *rest = unpack(each)
            node = self._node(kind, self.recorded(place), rest)
            if nodes:
                (number,) = _read_numbers(parent, 1)
                around = nodes[_checked(number, len(nodes))]
                if not isinstance(around, Element):
                    raise ValueError("a text holds another node")
                around.children.append(node)
            nodes.append(node)
        root = nodes[0]
        if not isinstance(root, Element):
            raise ValueError("the root is not an element")
        return root

    def _node(self, kind: bytes, span: Span, rest: list[bytes]) -> Node:
        if kind == _TEXT:
            (text,) = rest
            return Text(_read_text(text), span)
        if kind == _COMMENT:
            (text,) = rest
            if not is_comment_text(_read_text(text)):
                raise ValueError("a comment ends within itself")
            return Comment(_read_text(text), span)
        if kind != _ELEMENT:
            raise ValueError("there is no such kind of node")
        name, marks, packed = rest
        trace, verbatim = _read_numbers(marks, 2)
        element = Element(self._name(name), span, trace=self.frame(trace), verbatim=bool(verbatim))
        places: dict[str, Span] = {}
        element.value_spans = places
        for each in unpack(packed):
            key, value, place = unpack(each)
            attribute = self._name(key)
            element.attributes[attribute] = _read_text(value)
            places[attribute] = self.recorded(place)
        return element

    def _name(self, data: bytes) -> str:
        name = self._names.get(data)
        if name is None:
            name = data.decode()
            if bad_name_character(name) is not None:
                raise ValueError("an element or attribute cannot have such a name")
            self._names[data] = name
        return name


def _checked(index: int, count: int) -> int:
    if not 0 <= index < count:
        raise ValueError("there is no such number")
    return index
