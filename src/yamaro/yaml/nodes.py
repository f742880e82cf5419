"""YAML nodes: scalars with text, style and place; sequences; mappings that keep repeated keys."""

from __future__ import annotations

from ..source import Source, Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from array import array
    from collections.abc import Iterable, Iterator
    from typing import Any


# --- FlexiDict: an ordered mapping in which a key may stand several times ---------------------


class FlexiDict:
    """A sequence of key-value pairs that can also be asked by key.

    Iterating gives the pairs in order; `d["key"]` is the list of that key's values, `d[2]` the
    third pair.
    """

    __slots__ = ("pairs",)

    def __init__(self, pairs: Iterable[tuple[Any, Any]] = ()) -> None:
        self.pairs: list[tuple[Any, Any]] = list(pairs)

    def add(self, key: Any, value: Any) -> None:
        """Append a pair, even if the key is there already."""
        self.pairs.append((key, value))

    def keys(self) -> list[Any]:
        """Return every different key once, in the order of first appearance."""
        return list(dict.fromkeys(key for key, _ in self.pairs))

    def __getitem__(self, key: Any) -> Any:
        """Return the values of a key as a list, or the pair at an integer index.

        Raises:
            KeyError: no pair has that key.
            IndexError: there is no pair at that index.
        """
        if isinstance(key, int) and not isinstance(key, bool):
            return self.pairs[key]
        values = [value for own, value in self.pairs if own == key]
        if not values:
            raise KeyError(key)
        return values

    def __contains__(self, key: object) -> bool:
        return any(own == key for own, _ in self.pairs)

    def __iter__(self) -> Iterator[tuple[Any, Any]]:
        return iter(self.pairs)

    def __len__(self) -> int:
        return len(self.pairs)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FlexiDict) and self.pairs == other.pairs

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"FlexiDict({self.pairs!r})"


# --- nodes ------------------------------------------------------------------------------------


PLAIN, SINGLE, DOUBLE, LITERAL, FOLDED = "", "'", '"', "|", ">"


class ScalarNode(Span):
    """A scalar: its text after YAML's own unquoting, and its style; the span of its spelling.

    Most of a file is scalars, and most of them are asked for their place: being a span, a scalar
    needs no other object for it.
    """

    __slots__ = ("_offsets", "anchor", "style", "text")

    _offsets: array[int]  # of the characters of the text, once they were asked for

    def __init__(
        self,
        text: str,
        style: str,
        source: Source,
        start: int,
        end: int,
        anchor: str | None = None,
    ) -> None:
        """Hold a scalar whose spelling is `source.text[start:end]`."""
        self.text = text
        self.style = style
        self.source = source
        self.start = start
        self.end = end
        self.anchor = anchor

    def span(self, start: int = 0, end: int | None = None) -> Span:
        """Return the place of `text[start:end]`; of the whole scalar, quotes included, by default.

        An empty scalar has the place where it would begin.
        """
        if start == 0 and end is None:
            return self
        end = len(self.text) if end is None else end
        first = self.offset(start)
        last = self.offset(end - 1) + 1 if end > start else first
        return Span(self.source, first, max(first, last))

    def anchor_span(self) -> Span:
        """Return the place of the scalar's anchor, such as `&name`."""
        written = f"&{self.anchor}"
        start = max(self.source.text.rfind(written, 0, self.start), 0)
        return Span(self.source, start, start + len(written))

    def offset(self, index: int) -> int:
        """Return the offset in the source of the character `text[index]`."""
        length = len(self.text)
        raw_length = self.end - self.start
        if self.style == PLAIN and raw_length == length:
            return self.start + index
        if self.style in (SINGLE, DOUBLE) and raw_length == length + 2:
            return self.start + 1 + index
        try:
            offsets = self._offsets
        except AttributeError:  # few scalars are asked, but some for each of many expressions
            from array import array

            offsets = self._offsets = array("q", _align(self))
        return offsets[index] if index < len(offsets) else self.end

    def __eq__(self, other: object) -> bool:
        if isinstance(other, str):
            return self.text == other
        return isinstance(other, ScalarNode) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"ScalarNode({self.text!r})"


class ScalarPiece(ScalarNode):
    """A stretch of a scalar's text as a scalar of its own, such as the condition in `if a > 1:`."""

    __slots__ = ("_first", "_whole")

    def __init__(self, whole: ScalarNode, start: int, end: int) -> None:
        """Take `whole.text[start:end]`."""
        span = whole.span(start, end) if (start, end) != (0, len(whole.text)) else whole
        super().__init__(whole.text[start:end], PLAIN, whole.source, span.start, span.end)
        self._whole = whole
        self._first = start

    def offset(self, index: int) -> int:
        """Return the offset in the source of the character `text[index]`."""
        return self._whole.offset(self._first + index)


class SequenceNode:
    """A sequence of nodes."""

    __slots__ = ("end", "is_flow", "items", "source", "start")

    def __init__(self, source: Source, start: int, end: int, is_flow: bool) -> None:
        """Start an empty sequence."""
        self.items: list[YamlNode] = []
        self.source = source
        self.start = start
        self.end = end
        self.is_flow = is_flow

    def span(self) -> Span:
        """Return the place of the sequence."""
        return Span(self.source, self.start, self.end)


class MappingNode(FlexiDict):
    """A mapping: pairs of a scalar and a node, repeated keys kept."""

    __slots__ = ("end", "is_flow", "source", "start")

    def __init__(self, source: Source, start: int, end: int, is_flow: bool) -> None:
        """Start an empty mapping."""
        self.pairs = []
        self.source = source
        self.start = start
        self.end = end
        self.is_flow = is_flow

    def span(self) -> Span:
        """Return the place of the mapping."""
        return Span(self.source, self.start, self.end)


YamlNode = ScalarNode | SequenceNode | MappingNode


def pairs_below(root: YamlNode | None) -> Iterator[tuple[ScalarNode, YamlNode]]:
    """Yield the keys in a node, however deep, with their values; what aliases repeat comes once."""
    pending: list[YamlNode | None] = [root]
    seen: set[int] = set()
    while pending:
        node = pending.pop()
        if node is None or isinstance(node, ScalarNode) or id(node) in seen:
            continue
        seen.add(id(node))
        if isinstance(node, SequenceNode):
            pending.extend(node.items)
            continue
        for key, value in node.pairs:
            yield key, value
            pending.append(value)


# --- from a scalar's text back to its spelling ------------------------------------------------


def quoted(value: str) -> str:
    """Return a text as a quoted YAML scalar, in the quotes that leave it most readable."""
    if "'" in value and '"' not in value and "\\" not in value and value.isprintable():
        return f'"{value}"'
    return "'" + value.replace("'", "''") + "'"


_BREAKS = "\r\n\x85\u2028\u2029"
_WHITE = " \t" + _BREAKS


def _align(node: ScalarNode) -> list[int]:
    """Return the source offset of each character of a scalar's text.

    Follows the scalar through quotes, escapes, folded lines and block indentation. It is exact
    for every character that is not white space; white space is placed where its run begins.
    """
    raw = node.source.text[node.start : node.end]
    if node.style not in (LITERAL, FOLDED):
        indices = _align_flow(raw, node.style)
        if len(indices) == len(node.text):
            return [node.start + index for index in indices]
    at = _begin_of_content(raw, node.style)
    offsets = []
    for char in node.text:
        if char not in _WHITE:
            while at < len(raw) and raw[at] in _WHITE:
                at += 1
        offsets.append(node.start + min(at, len(raw)))
        if char not in _WHITE or raw.startswith(char, at):
            at += 1
    return offsets


def _align_flow(raw: str, style: str) -> list[int]:
    """Return the index in `raw` of each character of a plain or quoted scalar's text.

    Follows the folding of lines in YAML 1.2.2, section 6.5.
    """
    indices = []
    at, end = (0, len(raw)) if style == PLAIN else (1, len(raw) - 1)
    is_joined = False  # behind an escaped line break, which leaves nothing
    while at < end:
        if raw[at] in _WHITE:
            run = at
            breaks = []
            while at < end and raw[at] in _WHITE:
                if raw[at] in _BREAKS:
                    breaks.append(at)
                    at += raw.startswith("\r\n", at)
                at += 1
            if is_joined:
                indices.extend(breaks)
            elif breaks:  # one gives a space, more give themselves except for the first
                indices.extend(breaks[1:] or breaks)
            else:
                indices.extend(range(run, at))
        elif style == DOUBLE and raw.startswith(("\\\n", "\\\r"), at):
            at += 3 if raw.startswith("\r\n", at + 1) else 2
            is_joined = True
            continue
        else:
            indices.append(at)
            at += _spelled_length(raw, at, style)
        is_joined = False
    return indices


def _begin_of_content(raw: str, style: str) -> int:
    if style in (LITERAL, FOLDED):
        ends = [raw.find(char) for char in "\r\n" if char in raw]
        return min(ends) + 1 if ends else len(raw)
    return 1 if style in (SINGLE, DOUBLE) else 0


def _spelled_length(raw: str, at: int, style: str) -> int:
    """Return how many source characters spell the one at `at`."""
    if style == SINGLE and raw.startswith("''", at):
        return 2
    if style == DOUBLE and raw.startswith("\\", at):
        return 2 + {"x": 2, "u": 4, "U": 8}.get(raw[at + 1 : at + 2], 0)
    return 1


# --- types plain scalars by the YAML 1.2 core schema ------------------------------------------


_CONSTANTS: dict[str, bool | None] = {
    "": None,
    "~": None,
    "null": None,
    "Null": None,
    "NULL": None,
    "true": True,
    "True": True,
    "TRUE": True,
    "false": False,
    "False": False,
    "FALSE": False,
}
_SPECIAL_FLOATS = {
    sign + spelling: float(sign + "inf")
    for sign in ("", "+", "-")
    for spelling in (".inf", ".Inf", ".INF")
} | dict.fromkeys((".nan", ".NaN", ".NAN"), float("nan"))
_FLOAT_CHARACTERS = frozenset("0123456789.eE+-")
_NUMBER_STARTS = frozenset("0123456789.+-")
MAX_DIGITS = 4300


def is_null(text: str) -> bool:
    """Return whether a plain scalar is null."""
    return text in ("", "~", "null", "Null", "NULL")


def type_plain(text: str) -> object:
    """Return the value of a plain scalar: None, bool, int, float, or the text itself.

    Raises:
        OverflowError: the text is an integer of more digits than Python reads.
    """
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if text[0] not in _NUMBER_STARTS:
        return text
    digits = text[1:] if text[0] in "+-" else text
    if digits.isdigit() and digits.isascii():
        if len(digits) > MAX_DIGITS:
            raise OverflowError(text)
        return int(text)
    if text.startswith(("0x", "0o")):
        digits = text[2:]
        base, allowed = (16, "0123456789abcdefABCDEF") if text[1] == "x" else (8, "01234567")
        if digits and all(digit in allowed for digit in digits):
            return int(digits, base)
        return text
    if _FLOAT_CHARACTERS.issuperset(text):
        try:
            return float(text)
        except ValueError:
            return text
    return _SPECIAL_FLOATS.get(text, text)
