"""The output tree: elements that remember where in the YAML they were made, and their writer.

Values stay Python objects (or the text as it was spelled) until they are written; number
formatting, value formatting and escaping happen here and nowhere else.
"""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame, InputFault, YamaroError, failure, settle
from ..policy import Limits
from ..source import Span

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Protocol, TypeVar

    Key = TypeVar("Key")
    Value = TypeVar("Value")

    class Places(Protocol):
        """Where the values of an element's attributes are written; a dict is one."""

        def get(self, attribute: str, /) -> Span | None:
            """Return the place of an attribute's value, or None where there is none."""


class LiteralList(list[object]):
    """A list written as a YAML list under an element: numbers for `part`, an error elsewhere."""

    __slots__ = ()


class Text:
    """Text between tags; `value` is the spelling as written, or what an expression gave."""

    __slots__ = ("span", "value")

    def __init__(self, value: object, span: Span) -> None:
        """Hold a value and the place it was written."""
        self.value = value
        self.span = span


class Comment:
    """An XML comment."""

    __slots__ = ("span", "text")

    def __init__(self, text: str, span: Span) -> None:
        """Hold the comment's text, which must not contain `--`."""
        self.text = text
        self.span = span


class Element:
    """An XML element with its provenance."""

    __slots__ = (
        "attributes",
        "body",
        "children",
        "name",
        "span",
        "trace",
        "value_spans",
        "verbatim",
    )

    def __init__(
        self,
        name: str,
        span: Span,
        attributes: dict[str, object] | None = None,
        children: list[Node] | None = None,
        trace: Frame | None = None,
        value_spans: Places | None = None,
        verbatim: bool = False,
        body: object = None,
    ) -> None:
        """Make an element.

        Args:
            name: a checked XML name.
            span: the place of the key that made the element.
            attributes: names and values in the order of output; None values are not written.
            children: elements, text and comments in order.
            trace: the calls and includes that led here; INHERITED where they are those of the part
                or of the child of the root around it.
            value_spans: where the attributes' values are written; `span` stands in for the rest.
            verbatim: written in angle brackets: plain XML, whatever its name.
            body: identity of the mapping the element's key was written in.
        """
        self.name = name
        self.span = span
        self.attributes = attributes if attributes is not None else {}
        self.children = children if children is not None else []
        self.trace = trace
        self.value_spans = value_spans
        self.verbatim = verbatim
        self.body = body

    def with_children(self, children: list[Node]) -> Element:
        """Return the same element with other children; attributes are shared, not copied."""
        return type(self)(
            self.name,
            self.span,
            self.attributes,
            children,
            self.trace,
            self.value_spans,
            self.verbatim,
            self.body,
        )

    def value_span(self, attribute: str) -> Span:
        """Return where the attribute's value was written, or else the element's own place."""
        if self.value_spans is not None:
            return self.value_spans.get(attribute) or self.span
        return self.span

    def name_span(self, attribute: str) -> Span:
        """Return where the attribute's name was written, or its value where that is unknown."""
        value = self.value_span(attribute)
        text, end = value.source.text, value.start
        if self.attributes.get(attribute) == "" and text.startswith(attribute, end):
            # The place of an empty value is its name.
            return Span(value.source, end, end + len(attribute))
        while end > 0 and text[end - 1] in " \t\r\n:='\"":
            end -= 1
        if not text.endswith(attribute, 0, end):
            return value
        return Span(value.source, end - len(attribute), end)

    def elements(self) -> list[Element]:
        """Return the child elements, without text and comments."""
        return [child for child in self.children if isinstance(child, Element)]

    def text(self) -> str:
        """Return the text children joined, as it would be written, unescaped."""
        return "".join(format_value(c.value) for c in self.children if isinstance(c, Text))

    def __repr__(self) -> str:
        return f"<Element {self.name} at {self.span.place()}>"


class PartElement(Element):
    """A `part` as evaluated, before it is lowered to a joint and a link."""

    __slots__ = ()


class RobotWord(PartElement):
    """A robot's statement or section as evaluated, before it is lowered: `mirror`, `states`.

    Its children are its own keys, whose names are as they were written and need not be XML's. A
    list under a key is one `LiteralList`; an item that is a mapping or list is an element `-`. The
    last child is an element `body` if it has one: what the body made, or the file it attaches.
    """

    __slots__ = ()


Node = Element | Text | Comment


class IncludedRobot:
    """The `body` of what stands under the root of an XML file that is included.

    Attributes:
        prefix: what the include puts before the names of its links and joints.
    """

    __slots__ = ("prefix",)

    def __init__(self, prefix: str) -> None:
        """Begin with nothing in it."""
        self.prefix = prefix


Shared = dict[int, dict[str, "Any"]]
"""The elements that stand in several places of a tree, by identity, each with notes of what has
been worked out for it once for all its places; and the lists of children that several elements
have. Where nothing is shared, it is empty. What is in it is never changed."""


def unshared(root: Element, trace: Frame | None = None) -> Element:
    """Return a copy of a tree in which no element stands twice, each with a trace of its own.

    The copy may be changed. `trace` is that of a root which inherits its own.
    """
    top = with_trace(root, trace if root.trace is INHERITED else root.trace)
    pending = [(top, top.trace)]
    while pending:
        element, inherited = pending.pop()
        element.attributes = dict(element.attributes)
        children = element.children = list(element.children)
        for index, child in enumerate(children):
            if isinstance(child, Element):
                own = inherited if child.trace is INHERITED else child.trace
                copy = children[index] = with_trace(child, own)
                begins = element is top or isinstance(child, PartElement)
                pending.append((copy, own if begins else inherited))
    return top


def with_trace(element: Element, trace: Frame | None) -> Element:
    """Return an element that is the same but for its trace; its children are shared."""
    copy = element.with_children(element.children)
    copy.trace = trace
    return copy


# --- what comes again ---------------------------------------------------------------------------

MOST_REMEMBERED = 4096
"""How much of a kind is remembered at a time; what is forgotten is only worked out again."""
LONGEST_ROW_REMEMBERED = 24
"""Characters of a row of numbers worth remembering: longer ones are computed, and seldom equal."""


def remember(known: dict[Key, Value], key: Key, value: Value) -> None:
    """Keep what has been worked out for when it comes again, in bounded memory."""
    if len(known) >= MOST_REMEMBERED:
        known.clear()
    known[key] = value


# --- values to text ---------------------------------------------------------------------------


def format_number(value: float) -> str:
    """Return a float as `repr` of the value rounded to 15 significant digits; no minus zero."""
    text = f"{value:.15g}"
    if "." in text and "e" not in text:
        return text  # `repr` says the same: what has 15 digits comes through a float unchanged
    rounded = float(text)
    if rounded - rounded != 0:  # the largest floats have no room to be rounded up
        rounded = value
    return repr(rounded) if rounded else "0.0"


def format_value(value: Any) -> str:
    """Return the text a value has in XML: language rule "number to text"."""
    kind = type(value)
    if kind is str:
        return value  # type: ignore[no-any-return]
    if kind is float:
        return format_number(value)
    if kind is bool:
        return "true" if value else "false"
    if kind is int:
        return str(value)
    if value is None:
        return ""
    return _format_other(value)


def _format_other(value: Any) -> str:
    plain = plain_value(value)
    if type(plain) in (str, float, bool, int):
        return format_value(plain)
    if isinstance(plain, (list, tuple)):
        items = [plain_value(item) for item in plain]
        if all(is_number(item) for item in items):
            return " ".join(format_value(item) for item in items)
    _refuse_without_text(plain)
    return str(value)


def _refuse_without_text(value: Any) -> None:
    """Raise InputFault for a function, an iterator and the like: their texts are chance."""
    kind: Any = type(value)
    if kind.__str__ is not object.__str__:
        return
    if callable(value):
        raise InputFault("no-text", "a function is no text", "to call it, write name(…)")
    if hasattr(kind, "__next__"):
        raise InputFault("no-text", "an iterator is no text", "write list(…) around it")
    if kind.__repr__ is object.__repr__:
        hint = f"give the class {kind.__name__} a __str__, or write what is meant of it"
        raise InputFault("no-text", f"an object of the class {kind.__name__} is no text", hint)


def plain_value(value: Any) -> Any:
    """Return a numpy scalar or array as the Python value it stands for, all else unchanged."""
    if type(value).__module__ == "numpy" and hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, float):
        return float(value)
    if isinstance(value, int) and not isinstance(value, bool):
        return int(value)
    if isinstance(value, str):
        return str(value)
    return value


def is_number(value: object) -> bool:
    """Tell whether a value is an int or a float (booleans are not numbers here)."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


# --- writing ----------------------------------------------------------------------------------

_TEXT_ESCAPES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"}
_ATTRIBUTE_ESCAPES = {
    "&": "&amp;",
    "<": "&lt;",
    ">": "&gt;",
    '"': "&quot;",
    "\t": "&#9;",
    "\n": "&#10;",
    "\r": "&#13;",
}
_TEXT_TABLE = str.maketrans(_TEXT_ESCAPES)
_ATTRIBUTE_TABLE = str.maketrans(_ATTRIBUTE_ESCAPES)

_LONGEST_REMEMBERED = 16
"""Characters of a value worth remembering: longer ones seldom come again, and there are many."""


_spelled: dict[str, str] = {}
"""Values of attributes as they are written, whatever document they are of."""


def write(root: Element) -> str:
    """Return the tree as an XML document; raise YamaroError where XML cannot hold a character."""
    return "".join(write_pieces(root, {}))


def write_pieces(root: Element, shared: Shared, limits: Limits | None = None) -> list[str]:
    """Return the pieces of text that make the document, which spares putting them together.

    Raises:
        YamaroError: XML cannot hold a character, or the document passes one of the limits, which
            by default are those of trusted files.
    """
    out = ['<?xml version="1.0"?>\n']
    limits = limits or Limits()
    _Writer(root, shared, limits).write_root(out)
    if sum(map(len, out)) > limits.output:
        raise _too_long(root, limits)
    return out


def _too_long(root: Element, limits: Limits) -> YamaroError:
    return failure(
        "limit-output",
        f"the XML has more than {limits.output:,} characters, which is the limit",
        root.span,
        hint=limits.hint("output"),
    )


class _Writer:
    """Writes elements, remembering what comes again: values of attributes and shared elements."""

    __slots__ = (
        "_depth",
        "_limits",
        "_long",
        "_most_long",
        "_most_margin",
        "_outermost",
        "_passages",
        "_root",
        "_shared",
    )

    def __init__(self, root: Element, shared: Shared, limits: Limits) -> None:
        self._root = root
        self._outermost = root  # the child of the root that is being written
        self._shared = shared
        self._limits = limits
        self._most_margin = 2 * (limits.xml_depth - 1)  # two spaces a level
        self._depth = 0  # of what stands inline among text
        self._long = 0  # characters of long values; those of others are counted in the end
        self._most_long = limits.output
        self._passages: dict[int, _Passage] = {}

    def write_root(self, out: list[str]) -> None:
        """Write the whole; what an error is about came the way of the child of the root it is in.

        Raises:
            YamaroError: see `write_pieces`.
        """
        try:
            self.write(self._root, "", "\n", out, frozenset(("xml",)))
        except YamaroError as error:
            settle(error.diagnostics, self._outermost.trace)
            settle(error.diagnostics, None)
            raise

    def write(
        self, element: Element, margin: str, end: str, out: list[str], prefixes: frozenset[str]
    ) -> None:
        """Write an element: on lines of its own, or with no space added if `end` is empty."""
        name = element.name
        head = f"{margin}<{name}"
        for key, value in element.attributes.items():
            if type(value) is not str:
                if value is None:
                    continue
                value = format_value(value)
            if not value.isidentifier():  # most names are, and have nothing to escape
                escaped = _spelled.get(value)
                if escaped is None:
                    escaped = _attribute_text(value, element, key)
                    if len(value) <= _LONGEST_REMEMBERED:
                        remember(_spelled, value, escaped)
                    else:
                        self._long += len(value)
                        if self._long > self._most_long:
                            raise _too_long(self._root, self._limits)
                value = escaped
            head += f' {key}="{value}"'
        if ":" in head:
            prefixes = _prefixes_inside(element, prefixes)
        children = element.children
        if not children:
            out.append(f"{head}/>{end}")
            return
        for child in children:
            if type(child) is Text:
                self._write_mixed(element, head, end, out, prefixes)
                return
        if len(margin) >= self._most_margin:
            raise self._too_deep(element)
        if not end:
            self._go_deeper(element)
        out.append(f"{head}>{end}")
        deeper = margin + "  " if end else ""
        if end and id(children) in self._shared:
            self._write_shared(children, element, deeper, out, prefixes)
        else:
            self._write_children(children, element, deeper, end, out, prefixes)
        out.append(f"{margin}</{name}>{end}")
        if not end:
            self._depth -= 1

    def _go_deeper(self, element: Element) -> None:
        """Note that what stands in an element is written inline, where no margin tells how deep."""
        self._depth += 1
        if self._depth >= self._limits.xml_depth:
            raise self._too_deep(element)

    def _too_deep(self, element: Element) -> YamaroError:
        return failure(
            "limit-xml-depth",
            f"elements are nested more than {self._limits.xml_depth} deep, which is the limit",
            element.span,
            hint=self._limits.hint("xml_depth"),
            trace=element.trace,
        )

    def _write_children(
        self,
        children: list[Node],
        owner: Element,
        margin: str,
        end: str,
        out: list[str],
        prefixes: frozenset[str],
    ) -> None:
        shared = self._shared
        is_outermost = owner is self._root
        for child in children:
            if is_outermost and isinstance(child, Element):
                self._outermost = child
            if not isinstance(child, Element):
                if isinstance(child, Comment):
                    out.append(f"{margin}<!--{_comment_text(child, owner)}-->{end}")
            elif shared and end and id(child) in shared:
                self._write_shared(child, child, margin, out, prefixes)
            else:
                self.write(child, margin, end, out, prefixes)

    def _write_shared(
        self,
        what: Element | list[Node],
        owner: Element,
        margin: str,
        out: list[str],
        prefixes: frozenset[str],
    ) -> None:
        """Write an element, or children, of several places: from the second on, in one piece."""
        passage = self._passages.get(id(what))
        if passage is not None and passage.margin == margin and passage.prefixes == prefixes:
            out.append(passage.text or passage.put_together(out))
            return
        start = len(out)
        if isinstance(what, Element):
            self.write(what, margin, "\n", out, prefixes)
        else:
            self._write_children(what, owner, margin, "\n", out, prefixes)
        self._passages[id(what)] = _Passage(margin, prefixes, start, len(out))

    def _write_mixed(
        self, element: Element, head: str, end: str, out: list[str], prefixes: frozenset[str]
    ) -> None:
        """Write an element that holds text; its elements stand inline so that no space is added."""
        self._go_deeper(element)
        inner: list[str] = []
        for child in element.children:
            if element is self._root and isinstance(child, Element):
                self._outermost = child
            if isinstance(child, Text):
                text = format_value(child.value)
                self._long += len(text)
                if self._long > self._most_long:
                    raise _too_long(self._root, self._limits)
                inner.append(_element_text(text, child.span, element))
            elif isinstance(child, Comment):
                inner.append(f"<!--{_comment_text(child, element)}-->")
            else:
                self.write(child, "", "", inner, prefixes)
        content = "".join(inner)
        out.append(f"{head}>{content}</{element.name}>{end}" if content else f"{head}/>{end}")
        self._depth -= 1


class _Passage:
    """Where a shared element was written, so that its text can be used again in its like.

    The text is only put together for a second place: of elements in elements that stand in several
    places, one text is needed.
    """

    __slots__ = ("margin", "prefixes", "start", "stop", "text")

    def __init__(self, margin: str, prefixes: frozenset[str], start: int, stop: int) -> None:
        """Say that pieces `start` to `stop` were written at a margin, with prefixes declared."""
        self.margin = margin
        self.prefixes = prefixes
        self.start = start
        self.stop = stop
        self.text = ""

    def put_together(self, out: list[str]) -> str:
        """Return the element's text, made of the pieces written for it."""
        self.text = "".join(out[self.start : self.stop])
        return self.text


def _element_text(text: str, span: Span, element: Element) -> str:
    if text.isalnum() and text.isascii():
        return text
    check_characters(text, span, trace=element.trace)
    return text.translate(_TEXT_TABLE)


def _attribute_text(text: str, element: Element, key: str) -> str:
    if not (text.isascii() and text.isprintable()):
        check_characters(text, element.value_span(key), trace=element.trace)
    elif not ("&" in text or "<" in text or ">" in text or '"' in text):
        return text  # finding nothing to escape is several times faster than escaping nothing
    return text.translate(_ATTRIBUTE_TABLE)


def _comment_text(comment: Comment, element: Element) -> str:
    check_characters(comment.text, comment.span, trace=element.trace)
    return comment.text


def _prefixes_inside(element: Element, prefixes: frozenset[str]) -> frozenset[str]:
    """Return the prefixes that are declared inside an element, having checked those it uses."""
    prefixed = [
        key for key, value in element.attributes.items() if ":" in key and value is not None
    ]
    if prefixed:
        prefixes = _declared(element, prefixes)
        for key in prefixed:
            if not key.startswith("xmlns:"):
                _check_prefix(key, element, prefixes)
    if ":" in element.name:
        _check_prefix(element.name, element, prefixes)
    return prefixes


def _declared(element: Element, prefixes: frozenset[str]) -> frozenset[str]:
    """Return the prefixes that are declared inside an element, its own name included."""
    new = {
        key[6:]: format_value(value)
        for key, value in element.attributes.items()
        if key.startswith("xmlns:") and value is not None
    }
    for prefix, address in new.items():
        if not address or prefix in ("xml", "xmlns"):
            raise failure(
                "undeclared-prefix",
                f"the XML prefix '{prefix}' is declared without an address"
                if not address
                else f"the XML prefix '{prefix}' has its meaning and cannot be declared",
                element.value_span(f"xmlns:{prefix}"),
                hint=f"write xmlns:{prefix}=https://…"
                if not address
                else "leave the declaration out, or name another prefix",
                trace=element.trace,
            )
    return prefixes.union(new) if new else prefixes


def _check_prefix(name: str, element: Element, prefixes: frozenset[str]) -> None:
    prefix = name.partition(":")[0]
    if prefix not in prefixes:
        raise failure(
            "undeclared-prefix",
            f"the XML prefix '{prefix}' of '{name}' is not declared",
            element.span,
            hint=_PREFIX_HINTS.get(prefix)
            or f"declare it on this or an outer element: xmlns:{prefix}=https://…",
            trace=element.trace,
        )


_PREFIX_HINTS = {
    "xacro": "xacro's tags do not exist here; see docs/coming-from-xacro.md",
    "xmlns": "xmlns: begins the attributes that declare prefixes: name/xmlns:gz=https://…",
}


def is_comment_text(text: str) -> bool:
    """Tell whether a comment can hold the text (production 15, Comment)."""
    return "--" not in text and not text.endswith("-")


def is_xml_character(char: str) -> bool:
    """Tell whether XML 1.0 allows the character (production 2, Char)."""
    code = ord(char)
    return (
        code in (0x9, 0xA, 0xD)
        or 0x20 <= code <= 0xD7FF
        or 0xE000 <= code <= 0xFFFD
        or code >= 0x10000
    )


def check_characters(text: str, span: Span, *, trace: Frame | None = None) -> None:
    """Raise YamaroError if the text holds a character that XML forbids."""
    if text.isprintable():
        return
    for char in text:
        if not is_xml_character(char):
            raise failure(
                "control-character",
                f"the character U+{ord(char):04X} cannot stand in XML",
                span,
                hint="remove it; XML allows only tab, line breaks and printable characters",
                trace=trace,
            )
