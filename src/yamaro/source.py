"""Source text, and spans: stretches of the text of a file.

A span is a pair of character offsets, the end exclusive. Line and column are worked out only when
a diagnostic is shown, so carrying a span costs next to nothing.

Objects that programs get are `Public`, and their `repr` ends with that place.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

STANDARD_INPUT = "-"
"""The path that means standard input."""
STANDARD_INPUT_NAME = "<standard input>"
"""What standard input is called in messages."""
COMMAND_LINE = "<command line>"
"""What the source is called that holds a `name:=value`."""
KEYWORD_ARGUMENT = "<keyword argument>"
"""What the source is called that holds a variable given from Python."""
XML_ENDINGS = (".urdf", ".xacro", ".xml", ".sdf")
"""Endings of the names of files that hold XML, which is included as it is."""
YAML_ENDINGS = (".yaml", ".yml")
"""Endings of the names of files that hold YAML, though it may begin with `<`, as in `<arm>:`."""


_LONGEST = 60
"""Characters of a value in a `repr`."""


class Public:
    """An object that programs get: `dir()` lists what it offers them, and `repr` says what it is.

    Attributes:
        _internal: the attributes of a class that only Yamaro itself uses.
    """

    __slots__ = ()

    _internal: frozenset[str] = frozenset()

    def __dir__(self) -> list[str]:
        hidden = {name for kind in type(self).__mro__ for name in vars(kind).get("_internal", ())}
        return [
            name
            for name in object.__dir__(self)
            if name not in hidden and (name[0] != "_" or name[:2] == name[-2:] == "__")
        ]

    def __repr__(self) -> str:
        """Return the class, the values that can be said in a word or two, and the place."""
        values: dict[str, str] = {}
        for kind in type(self).__mro__:
            for name in vars(kind).get("__slots__", ()):
                value = getattr(self, name, None) if name[0] != "_" else None
                if isinstance(value, (bool, int, float, str, tuple)) and value not in ("", ()):
                    values.setdefault(name, repr(value))
        hidden = {name for kind in type(self).__mro__ for name in vars(kind).get("_internal", ())}
        said = [
            f"{name}={text}"
            for name, text in sorted(values.items(), key=lambda pair: pair[0] != "name")
            if name not in hidden and len(text) <= _LONGEST and " object at 0x" not in text
        ]
        span = getattr(self, "span", None)
        if span is not None:
            said.append(f"at {span.place()}")
        return f"<{' '.join([type(self).__name__, *said])}>"


class Source(Public):
    """The text of one file, with the name it is shown under.

    Attributes:
        is_xml: whether it has been read as XML: a robot in URDF or xacro, taken as it is.
        allowances: the comments that accept findings, once they are read; see `allowances.py`.
    """

    __slots__ = ("_has_remarks", "_line_starts", "allowances", "is_xml", "name", "path", "text")

    def __init__(self, text: str, *, name: str, path: str = "") -> None:
        """Hold `text`; `name` is shown to people, `path` is absolute, or empty if there is none."""
        self.text = text
        self.name = name
        self.path = path
        self.is_xml = False
        self.allowances: Any = None
        self._has_remarks: bool | None = None
        self._line_starts: list[int] | None = None

    @property
    def has_remarks(self) -> bool:
        """Return whether there may be comments that are meant for Yamaro."""
        if self._has_remarks is None:
            self._has_remarks = "yamaro:" in self.text
        return self._has_remarks

    def line_starts(self) -> list[int]:
        """Return the offset at which each line begins; LF, CRLF and a lone CR end a line."""
        if self._line_starts is None:
            starts = [0]
            text = self.text
            if "\r" in text:
                text = text.replace("\r\n", " \n").replace("\r", "\n")  # of the same length
            end = text.find("\n")
            while end >= 0:
                starts.append(end + 1)
                end = text.find("\n", end + 1)
            self._line_starts = starts
        return self._line_starts

    def location(self, offset: int) -> tuple[int, int]:
        """Return the line and column of `offset`, both counted from 1, in characters."""
        from bisect import bisect_right

        starts = self.line_starts()
        line = bisect_right(starts, offset)
        return line, offset - starts[line - 1] + 1

    def line_text(self, line: int) -> str:
        """Return line number `line`, counted from 1, without its line break."""
        starts = self.line_starts()
        end = starts[line] if line < len(starts) else len(self.text)
        return self.text[starts[line - 1] : end].rstrip("\r\n")


class Span:
    """A stretch of a source: offsets in characters, the end exclusive."""

    __slots__ = ("end", "source", "start")

    def __init__(self, source: Source, start: int, end: int) -> None:
        """Mark `source.text[start:end]`."""
        self.source = source
        self.start = start
        self.end = end

    def location(self) -> tuple[int, int]:
        """Return the line and column of the first character, both counted from 1."""
        return self.source.location(self.start)

    def place(self) -> str:
        """Return the span as `name:line:column`."""
        line, column = self.location()
        return f"{self.source.name}:{line}:{column}"

    def written(self) -> str:
        """Return the characters the span covers."""
        return self.source.text[self.start : self.end]

    def key(self) -> tuple[str, str, int, int]:
        """Return a value equal for spans of the same place."""
        return (self.source.path, self.source.name, self.start, self.end)

    def __repr__(self) -> str:
        return f"Span({self.place()}, {self.written()!r})"


class Reading:
    """A variable that an expression read.

    Attributes:
        name: the variable.
        value: its value then, as text.
        span: where it was set; None if that is not known.
        given: if this notes the value at a declaration, where it was set instead, as by an include.
    """

    __slots__ = ("given", "name", "span", "value")

    def __init__(self, name: str, value: str, span: Span | None, given: Span | None = None) -> None:
        self.name = name
        self.value = value
        self.span = span
        self.given = given


class RecordedSpan(Span):
    """A span that also holds how its text got its value; see `runtime/recording.py`.

    Attributes:
        readings: the variables that its expressions read, in order.
        name_span: for a joint or link of a part, where the part's name is written.
        others: further places that the value is computed from, such as a link's pose.
    """

    __slots__ = ("name_span", "others", "readings")

    def __init__(
        self,
        span: Span,
        readings: tuple[Reading, ...] = (),
        *,
        name_span: Span | None = None,
        others: tuple[Span, ...] = (),
    ) -> None:
        """Mark the same stretch as another span."""
        super().__init__(span.source, span.start, span.end)
        self.readings = readings
        self.name_span = name_span
        self.others = others


class OverlaidSpan(RecordedSpan):
    """A span in an overlay, of a value that takes the place of another one; or of one beside it.

    Attributes:
        replaced: where the value was given before, or what lacked it; None for what is only beside
            a value that an overlay changed.
        note: the same in words, for messages.
    """

    __slots__ = ("note", "replaced")

    def __init__(self, span: Span, note: str, replaced: Span | None = None) -> None:
        """Mark the same stretch as another span."""
        recorded = span if isinstance(span, RecordedSpan) else None
        super().__init__(
            span,
            recorded.readings if recorded is not None else (),
            name_span=recorded.name_span if recorded is not None else None,
            others=recorded.others if recorded is not None else (),
        )
        self.note = note
        self.replaced = replaced


def joined(first: Span, second: Span) -> Span:
    """Return the place of a value that is computed from two: the first, noting the other."""
    if type(first) is not RecordedSpan:
        return first
    inner = second.others if isinstance(second, RecordedSpan) else ()
    others = (*first.others, second, *inner)
    return RecordedSpan(first, first.readings, name_span=first.name_span, others=others)


def is_xml_file(path: str) -> bool:
    """Return whether a file holds XML by its name alone."""
    return path.lower().endswith(XML_ENDINGS)


def holds_xml(path: str, data: bytes | str) -> bool:
    """Return whether a file holds XML: by its name, or if that is not decisive, by how it begins.

    `<arm>:` begins YAML anyway.
    """
    if path.lower().endswith((*XML_ENDINGS, *YAML_ENDINGS)):
        return is_xml_file(path)
    if isinstance(data, str):
        start = data.lstrip("\ufeff \t\r\n")
    else:
        start = data.lstrip(b"\xef\xbb\xbf\xff\xfe\0 \t\r\n").decode("latin-1").replace("\0", "")
    return start.startswith("<") and not start.partition(">")[2].startswith(":")


def html_of(result: object) -> str | None:
    """Return the HTML that shows a `Build` or `Robot` in a notebook, or None if no tool makes it.

    Results lie below the tools, and may not import one: the tool is found by its module `notebook`.
    """
    from importlib import import_module
    from importlib.util import find_spec
    from pkgutil import iter_modules

    for tool in iter_modules(import_module("yamaro.tools").__path__):
        module = f"yamaro.tools.{tool.name}.notebook"
        if find_spec(module) is not None:
            show: Callable[[object], str] = import_module(module).html_of
            return show(result)
    return None
