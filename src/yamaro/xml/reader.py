"""Reads XML into elements of the output tree, which remember where in the file they stand."""

from __future__ import annotations

import re

from ..diagnostics import YamaroError, failure
from ..policy import Limits
from ..source import Source, Span
from .tree import Comment, Element, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


_OF_SDF = re.compile(r"<sdf[\s>]")
_FIRST_TAG = re.compile(r"<([A-Za-z]\w*)")
_OF_MUJOCO = ("mujoco", "mujocoinclude")
_LATE_DECLARATION = re.compile(r"\A\s+<\?xml\s[^>]*?\?>")
_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)
_DECLARATION = re.compile(r"<\?xml\s[^>]*?\?>")
_ENCODING = re.compile(rb"""<\?xml\s[^>]*?\bencoding\s*=\s*["']([A-Za-z][A-Za-z0-9._-]*)["']""")
_BYTE_ORDER_MARKS = (
    (b"\xef\xbb\xbf", "utf-8"),
    (b"\xff\xfe\x00\x00", "utf-32-le"),
    (b"\x00\x00\xfe\xff", "utf-32-be"),
    (b"\xff\xfe", "utf-16-le"),
    (b"\xfe\xff", "utf-16-be"),
)
_WITHOUT_MARK = ((b"<\x00?\x00", "utf-16-le"), (b"\x00<\x00?", "utf-16-be"))
"""How a declaration begins in UTF-16."""
_ENCODINGS = frozenset(
    [
        *"utf-8 utf8 us-ascii ascii latin1 latin-1 koi8-r koi8-u tis-620 macintosh".split(),
        *"gb2312 gbk gb18030 big5 big5-hkscs euc-kr euc-jp shift-jis iso-2022-jp".split(),
        *(f"iso-8859-{number}" for number in range(1, 17) if number != 12),
        *(f"{start}125{digit}" for start in ("windows-", "cp") for digit in range(9)),
        *(f"{start}{page}" for start in ("ibm", "cp") for page in (437, 850, 852, 855, 866)),
    ]
)
"""The encodings that a file may declare: those of text in which the declaration itself can be read.

Python has codecs besides that are not for text (punycode, undefined), or that hide text.
"""
_ADVICE = {
    "mismatched tag": "each <tag> needs a </tag>; close the last opened element first",
    "not well-formed (invalid token)": "in a text or value, write &lt; for < and &amp; for &",
    "unbound prefix": 'declare it at the root, as in xmlns:xacro="http://www.ros.org/wiki/xacro"',
    "no element found": "the file ends before its root element is closed",
    "duplicate attribute": "give each attribute only once in a tag",
    "junk after document element": "a file has one root element, which contains all others",
}


class XmlDocument:
    """What an XML file holds.

    Attributes:
        root: its root element.
        before, after: the comments around it.
    """

    __slots__ = ("after", "before", "root")

    def __init__(self, root: Element, before: list[Comment], after: list[Comment]) -> None:
        self.root = root
        self.before = before
        self.after = after


def decode_xml(data: bytes, *, name: str, path: str) -> Source:
    """Return the bytes of an XML file as a source, in the encoding that its first bytes show.

    Raises:
        YamaroError: `xml-encoding`: it is not in that encoding, or nobody knows it.
    """
    encoding, start = "utf-8", 0
    declared = _ENCODING.match(data.lstrip())
    if declared:
        encoding = declared[1].decode("ascii")
    for mark, of_mark in _BYTE_ORDER_MARKS:
        if data.startswith(mark):
            encoding, start = of_mark, len(mark)
            declared = None
            break
    for beginning, of_beginning in _WITHOUT_MARK:
        if data.startswith(beginning):
            encoding = of_beginning
    if declared and encoding.lower().replace("_", "-") not in _ENCODINGS:
        at = len(data) - len(data.lstrip()) + declared.start(1)
        end = at + len(encoding)
        is_wide = encoding.lower().replace("_", "-").startswith(("utf-16", "utf-32"))
        message = f"the file is not in {encoding}" if is_wide else f"unknown encoding '{encoding}'"
    else:
        try:
            return Source(data[start:].decode(encoding), name=name, path=path)
        except UnicodeDecodeError as error:
            at = start + error.start
            end = at + 1
            message = f"the byte 0x{data[at]:02X} is not {encoding.upper()}"
    source = Source(data.decode("latin-1"), name=name, path=path)
    raise failure(
        "xml-encoding",
        message,
        Span(source, at, end),
        hint='declare the encoding of the file: <?xml version="1.0" encoding="UTF-8"?>'
        if declared
        else 'declare the encoding of the file: <?xml version="1.0" encoding="ISO-8859-1"?>',
    )


class CData(Text):
    """Text from `<![CDATA[…]]>`."""

    __slots__ = ()


def read_xml(source: Source, limits: Limits | None = None, *, exact: bool = False) -> XmlDocument:
    """Return what a text holds as XML. Space between elements is kept as it is.

    Args:
        source: the text.
        limits: how deep it may be, by default as deep as in trusted files.
        exact: keep CDATA sections as such, and refuse prefixes that are not declared.

    Raises:
        YamaroError: `xml-syntax` at the place where the text is not XML, `xml-entity` where it
            declares what other parsers would read from elsewhere, or a limit is passed.
    """
    source.is_xml = True
    limits = limits or Limits()
    try:
        return XmlReader(source, limits, exact, source.text).read()
    except YamaroError as error:
        # The parsers of Gazebo and MuJoCo take these faults, so that their users do not see them.
        first = _FIRST_TAG.search(_COMMENT.sub("", source.text))
        is_taken = (first is not None and first[1] in _OF_MUJOCO) or _OF_SDF.search(source.text)
        if error.diagnostics[0].code != "xml-syntax" or not is_taken:
            raise
        # A text of the same length without `--` in comments, and space before `<?xml`.
        text = source.text
        text = _LATE_DECLARATION.sub(lambda found: " " * len(found[0]), text)

        def comment(found: re.Match[str]) -> str:
            body = found[1]
            if "--" in body:
                body = body.replace("--", "- ").replace("--", "- ")
            return f"<!--{body[:-1]} -->" if body.endswith("-") else f"<!--{body}-->"

        mended = _COMMENT.sub(comment, text)
        if mended == source.text:
            raise
    return XmlReader(source, limits, exact, mended).read()


class TagSpan(Span):
    """The place of a tag's name, which finds those of its attributes' values when asked."""

    __slots__ = ("_values",)

    _values: dict[str, Span]

    def get(self, attribute: str, /) -> Span | None:
        """Return the place of an attribute's value, without its quotes."""
        try:
            values = self._values
        except AttributeError:  # most tags are never asked
            values = self._values = {}
            text, position = self.source.text, self.end
            while (found := _ATTRIBUTE.match(text, position)) and found["name"]:
                start, end = found.span("value")
                is_empty = start + 1 == end - 1
                # An empty value is at its name.
                place = found.span("name") if is_empty else (start + 1, end - 1)
                values.setdefault(found["name"], Span(self.source, *place))
                position = found.end()
        return values.get(attribute)


_ATTRIBUTE = re.compile(
    r"""\s*(?:(?P<end>/?>)|(?P<name>[^\s=<>"'/]+)\s*=\s*(?P<value>"[^"]*"|'[^']*'))"""
)


_TOKEN = re.compile(r"""<!--.*?-->|<!\[CDATA\[|\]\]>|<(?:[^"'<>]|"[^"]*"|'[^']*')*>""", re.DOTALL)


BLOCK = 1024
"""Bytes to look through at most for an offset in characters."""
_CONTINUING = bytes(range(0x80, 0xC0))
"""The bytes of UTF-8 that begin no character."""


def _count(data: bytes) -> int:
    """Return how many characters of UTF-8 begin in some bytes."""
    return len(data.translate(None, _CONTINUING))


class XmlReader:
    """Builds the tree while expat reads."""

    def __init__(self, source: Source, limits: Limits, exact: bool, text: str) -> None:
        self._source = source
        self._whole = text  # what is read: of the same length as that of the source
        self._exact = exact
        self._is_cdata = False
        self._prefixes = {"xml": 1}  # how many of the open elements declare each
        self._declared: list[tuple[int, list[str]]] = []  # at which depth which are
        self._limits = limits
        self._before: list[Comment] = []
        self._after: list[Comment] = []
        self._root: Element | None = None
        self._open: list[Element] = []
        self._text: list[str] = []
        self._spaces: dict[str, Text] = {}  # each is used for all that are equal
        self._token = 0  # where the tag, comment or similar begins that came last, in bytes
        self._is_ascii = source.text.isascii()
        self._bytes = b""
        self._starts = [0]  # how many characters are before each block of bytes

    def read(self) -> XmlDocument:
        """Return what the text holds; raise YamaroError where it is not XML, or has too much."""
        from pyexpat import ExpatError

        text = self._whole
        declaration = _DECLARATION.match(text)
        if declaration:  # its encoding is no longer that of the text, and its version is nobody's
            text = " " * declaration.end() + text[declaration.end() :]
        self._bytes = text.encode("utf-8", "surrogatepass")
        from pyexpat import ParserCreate

        parser = ParserCreate("utf-8")
        parser.buffer_text = True
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._characters
        parser.CommentHandler = self._comment
        parser.EntityDeclHandler = self._entity
        if self._exact:
            parser.StartCdataSectionHandler = self._start_cdata
            parser.EndCdataSectionHandler = self._end_cdata
        self._parser = parser
        try:
            parser.Parse(self._bytes, True)
        except ExpatError as error:
            raise self._fault(error) from None
        assert self._root is not None
        return XmlDocument(self._root, self._before, self._after)

    # --- what expat reports-------------------------------------------------------------------

    def _start(self, name: str, attributes: dict[str, Any]) -> None:
        if self._text:
            self._flush()
        self._token = start = self._parser.CurrentByteIndex
        if not self._is_ascii:
            start = self._offset(start)
        span = TagSpan(self._source, start + 1, start + 1 + len(name))
        element = Element(name, span, attributes, [], None, span, True)
        if self._open:
            self._open[-1].children.append(element)
        else:
            self._root = element
        self._open.append(element)
        if self._exact and (":" in name or ":" in "".join(attributes)):
            self._check_prefixes(element)
        if len(self._open) > self._limits.xml_depth:
            raise failure(
                "limit-xml-depth",
                f"elements are nested more than {self._limits.xml_depth} deep, which is the limit",
                span,
                hint=self._limits.hint("xml_depth"),
            )

    def _end(self, name: str) -> None:
        if self._text:
            self._flush()
        self._token = self._parser.CurrentByteIndex
        self._open.pop()
        if self._declared and len(self._open) < self._declared[-1][0]:
            for prefix in self._declared.pop()[1]:
                self._prefixes[prefix] -= 1

    def _start_cdata(self) -> None:
        self._flush()
        self._token = self._parser.CurrentByteIndex
        self._is_cdata = True

    def _end_cdata(self) -> None:
        self._flush()
        self._token = self._parser.CurrentByteIndex
        self._is_cdata = False

    def _characters(self, text: str) -> None:
        self._text.append(text)

    def _comment(self, text: str) -> None:
        self._flush()
        self._token = self._parser.CurrentByteIndex
        start = self._here()
        comment = Comment(text, Span(self._source, start, start + len("<!---->") + len(text)))
        if self._open:
            self._open[-1].children.append(comment)
        else:
            (self._after if self._root else self._before).append(comment)

    def _entity(self, name: str, _is_parameter: int, value: str | None, *_others: object) -> None:
        if value is None or "&" in value or "%" in value:
            raise failure(
                "xml-entity",
                f"the entity '{name}' is external, or contains other entities",
                self._entity_span(name),
                hint="write its text where it is used",
            )

    def _entity_span(self, name: str) -> Span:
        """Return where the name of an entity stands that is being declared."""
        text, end = self._source.text, self._here()
        start = text.find(name, max(text.rfind("<!ENTITY", 0, end), 0))
        return Span(self._source, start, start + len(name))

    # --- helpers ----------------------------------------------------------------------------

    def _flush(self) -> None:
        """Put the text that has come so far into the element that is open."""
        if not self._text:
            return
        text = self._text[0] if len(self._text) == 1 else "".join(self._text)
        self._text.clear()
        space = self._spaces.get(text)
        if space is not None and not self._is_cdata:
            self._open[-1].children.append(space)
            return
        end = self._here()
        start = end - len(text)
        if not self._source.text.startswith(text, max(start, 0)):
            token = self._offset(self._token)
            found = _TOKEN.match(self._source.text, token)
            start = found.end() if found else token  # the last tag, comment or similar ends there
        span = Span(self._source, start, max(start, end))
        made = CData(text, span) if self._is_cdata else Text(text, span)
        self._open[-1].children.append(made)
        if self._exact and not self._is_cdata and text.isspace():
            self._spaces[text] = made

    def _check_prefixes(self, element: Element) -> None:
        """Refuse prefixes that are not declared here, having noted those that are."""
        used = [name for name in element.attributes if ":" in name]
        if used:
            new = [name[6:] for name in used if name.startswith("xmlns:")]
            if new:
                self._declared.append((len(self._open), new))
                for prefix in new:
                    self._prefixes[prefix] = self._prefixes.get(prefix, 0) + 1
        if ":" in element.name:
            used.append(element.name)
        for name in used:
            prefix = name.partition(":")[0]
            if prefix != "xmlns" and not self._prefixes.get(prefix):
                message = "unbound prefix"
                raise failure(
                    "xml-syntax",
                    f"this is not well-formed XML: {message} '{prefix}'",
                    element.span if name == element.name else element.name_span(name),
                    hint=_ADVICE[message],
                )

    def _here(self) -> int:
        """Return where in the text expat is."""
        return self._offset(self._parser.CurrentByteIndex)

    def _offset(self, index: int) -> int:
        if self._is_ascii:
            return index
        block = index // BLOCK
        while len(self._starts) <= block:
            end = len(self._starts) * BLOCK
            self._starts.append(self._starts[-1] + _count(self._bytes[end - BLOCK : end]))
        return self._starts[block] + _count(self._bytes[block * BLOCK : index])

    def _fault(self, error: Any) -> YamaroError:
        from pyexpat import ErrorString

        message = ErrorString(error.code) or "this is not XML"
        length = len(self._source.text)
        offset = max(0, min(self._offset(self._parser.ErrorByteIndex), length))
        if not self._source.text.lstrip().startswith("<"):
            first = Span(self._source, 0, min(1, length))
            told = 'it begins with a tag, such as <robot name="arm">'
            return failure("xml-syntax", "this is not XML", first, hint=told)
        hint = _ADVICE.get(message)
        notes: tuple[str, ...] = ()
        if self._open and message in ("mismatched tag", "no element found"):
            opened = self._open[-1]
            message = f"{message}: <{opened.name}> is open"
            notes = (f"<{opened.name}> begins at {opened.span.place()}",)
        return failure(
            "xml-syntax",
            f"this is not well-formed XML: {message}",
            Span(self._source, offset, min(offset + 1, length)),
            hint=hint,
            notes=notes,
        )
