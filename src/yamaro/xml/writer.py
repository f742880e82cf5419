"""Writes a tree as an XML document."""

from __future__ import annotations

from ..diagnostics import YamaroError, failure, settle
from ..policy import Limits
from ..source import Span
from .tree import Comment, Element, Text
from .values import (
    Numbers,
    check_characters,
    escaped_attribute,
    escaped_text,
    format_value,
    remember,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .tree import Memo, Node

_LONGEST_REMEMBERED = 16
"""Characters of a value worth remembering: longer ones seldom come again, and there are many."""


def write(root: Element) -> str:
    """Return the tree as an XML document; raise YamaroError where XML cannot hold a character."""
    return "".join(write_pieces(root))


def write_pieces(root: Element, limits: Limits | None = None) -> list[str]:
    """Return the pieces of text that make the document, which spares putting them together.

    Raises:
        YamaroError: XML cannot hold a character, or the document passes one of the limits, which
            by default are those of trusted files.
    """
    out = ['<?xml version="1.0"?>\n']
    limits = limits or Limits()
    _Writer(root, limits).write_root(out)
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
    """Writes elements, remembering values of attributes, and texts in the memos of elements."""

    __slots__ = (
        "_depth",
        "_limits",
        "_long",
        "_most_long",
        "_most_margin",
        "_outermost",
        "_root",
        "_spelled",
    )

    def __init__(self, root: Element, limits: Limits) -> None:
        self._root = root
        self._outermost = root  # the child of the root that is being written
        self._limits = limits
        self._most_margin = 2 * (limits.xml_depth - 1)  # two spaces a level
        self._depth = 0  # of what stands inline among text
        self._long = 0  # characters of long values; those of others are counted in the end
        self._most_long = limits.output
        self._spelled: dict[str, str] = {}  # values of attributes as they are written

    def write_root(self, out: list[str]) -> None:
        """Write the whole; what an error is about came the way of the child of the root it is in.

        Raises:
            YamaroError: see `write_pieces`.
        """
        try:
            self._write(self._root, "", "\n", out, frozenset(("xml",)))
        except YamaroError as error:
            settle(error.diagnostics, self._outermost.trace)
            settle(error.diagnostics, None)
            raise

    def _write(
        self, element: Element, margin: str, end: str, out: list[str], prefixes: frozenset[str]
    ) -> None:
        """Write an element: on lines of its own, or with no space added if `end` is empty."""
        head = self._head(element, margin)
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
        self._write_children(children, element, margin + "  " if end else "", end, out, prefixes)
        out.append(f"{margin}</{element.name}>{end}")
        if not end:
            self._depth -= 1

    def _head(self, element: Element, margin: str) -> str:
        """Return the start of an element's tag, with its attributes."""
        head = f"{margin}<{element.name}"
        for key, value in element.attributes.items():
            if type(value) is not str:
                if value is None:
                    continue
                value = value.text if type(value) is Numbers else format_value(value)
            if not value.isidentifier():  # most names are, and have nothing to escape
                escaped = self._spelled.get(value)
                if escaped is None:
                    escaped = self._escaped(value, element, key)
                value = escaped
            head += f' {key}="{value}"'
        return head

    def _escaped(self, value: str, element: Element, key: str) -> str:
        escaped = _attribute_text(value, element, key)
        if len(value) <= _LONGEST_REMEMBERED:
            remember(self._spelled, value, escaped)
            return escaped
        self._long += len(value)
        if self._long > self._most_long:
            raise _too_long(self._root, self._limits)
        return escaped

    def _go_deeper(self, element: Element) -> None:
        """Note that what is in an element is written inline, where no margin shows how deep."""
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
        is_outermost = owner is self._root
        for child in children:
            if not isinstance(child, Element):
                if isinstance(child, Comment):
                    out.append(f"{margin}<!--{_comment_text(child, owner)}-->{end}")
                continue
            if is_outermost:
                self._outermost = child
            memo = child.memo
            if memo is None or not end:
                self._write(child, margin, end, out, prefixes)
            elif memo.own is None:
                self._write_again(child, memo, margin, out, prefixes)
            else:
                self._write_alike(child, memo, memo.own, margin, out, prefixes)

    def _write_again(
        self, element: Element, memo: Memo, margin: str, out: list[str], prefixes: frozenset[str]
    ) -> None:
        """Write an element of several places: from the second on, in one piece."""
        passage: _Passage | None = memo.written
        if passage is not None and passage.fits(out, margin, prefixes):
            out.append(passage.text or passage.put_together())
            return
        start = len(out)
        self._write(element, margin, "\n", out, prefixes)
        memo.written = _Passage(out, margin, prefixes, start)

    def _write_alike(
        self,
        element: Element,
        memo: Memo,
        own: int,
        margin: str,
        out: list[str],
        prefixes: frozenset[str],
    ) -> None:
        """Write an element that differs from others in its name and its first children alone."""
        children, inner = element.children, margin + "  "
        passage: _Passage | None = memo.written
        name = element.attributes.get("name")
        if (
            passage is not None
            and passage.before_name
            and type(name) is str
            and name.isidentifier()  # which has nothing to escape
            and passage.fits(out, inner, prefixes)
        ):
            out.append(f"{passage.before_name}{name}{passage.after_name}")
            out += [f"{self._head(child, inner)}/>\n" for child in children[:own]]  # type: ignore[arg-type]
            out += (passage.text or passage.put_together(), passage.end)
            return
        head = self._head(element, margin)
        is_mixed = any(isinstance(child, Text) for child in children)
        if ":" in head or is_mixed or not children or len(margin) >= self._most_margin:
            self._write(element, margin, "\n", out, prefixes)
            return
        out.append(f"{head}>\n")
        self._write_children(children[:own], element, inner, "\n", out, prefixes)
        start = len(out)
        self._write_children(children[own:], element, inner, "\n", out, prefixes)
        memo.written = passage = _Passage(out, inner, prefixes, start)
        passage.end = f"{margin}</{element.name}>\n"
        before_name = f'{margin}<{element.name} name="'
        if type(name) is str and name.isidentifier() and head.startswith(before_name):
            passage.before_name = before_name
            passage.after_name = f"{head[len(before_name) + len(name) :]}>\n"
        out.append(passage.end)

    def _write_mixed(
        self, element: Element, head: str, end: str, out: list[str], prefixes: frozenset[str]
    ) -> None:
        """Write an element that holds text; its elements stand inline so that no space is added."""
        self._go_deeper(element)
        inner: list[str] = []
        for child in element.children:
            if isinstance(child, Text):
                text = format_value(child.value)
                self._long += len(text)
                if self._long > self._most_long:
                    raise _too_long(self._root, self._limits)
                inner.append(_element_text(text, child.span, element))
            elif isinstance(child, Comment):
                inner.append(f"<!--{_comment_text(child, element)}-->")
            else:
                if element is self._root:
                    self._outermost = child
                self._write(child, "", "", inner, prefixes)
        content = "".join(inner)
        out.append(f"{head}>{content}</{element.name}>{end}" if content else f"{head}/>{end}")
        self._depth -= 1


class _Passage:
    """What was written of an element, so that its text can be used again for its like.

    The text is only put together for a second place: of elements in elements that are in several
    places, one text is needed.
    """

    __slots__ = (
        "after_name",
        "before_name",
        "end",
        "margin",
        "out",
        "prefixes",
        "start",
        "stop",
        "text",
    )

    def __init__(self, out: list[str], margin: str, prefixes: frozenset[str], start: int) -> None:
        """Say that the pieces from `start` on were written at a margin, with prefixes declared."""
        self.out = out
        self.margin = margin
        self.prefixes = prefixes
        self.start = start
        self.stop = len(out)
        self.text = ""
        self.end = ""  # the end tag around, if this is what is in an element
        self.before_name = self.after_name = ""  # and the start tag, except for the name in it

    def fits(self, out: list[str], margin: str, prefixes: frozenset[str]) -> bool:
        """Return whether the same would be written at a place of a document."""
        return self.out is out and self.margin == margin and self.prefixes == prefixes

    def put_together(self) -> str:
        """Return the text, made of the pieces written for it."""
        self.text = "".join(self.out[self.start : self.stop])
        return self.text


def _element_text(text: str, span: Span, element: Element) -> str:
    if text.isalnum() and text.isascii():
        return text
    check_characters(text, span, trace=element.trace)
    return escaped_text(text)


def _attribute_text(text: str, element: Element, key: str) -> str:
    if not (text.isascii() and text.isprintable()):
        check_characters(text, element.value_span(key), trace=element.trace)
    elif not ("&" in text or "<" in text or ">" in text or '"' in text):
        return text  # finding nothing to escape is several times faster than escaping nothing
    return escaped_attribute(text)


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
                f"the XML prefix '{prefix}' is declared without a URI"
                if not address
                else f"the XML prefix '{prefix}' is reserved and cannot be declared",
                element.value_span(f"xmlns:{prefix}"),
                hint=f"write xmlns:{prefix}=https://…"
                if not address
                else "remove the declaration, or use another prefix",
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
    "xacro": "xacro tags are not supported here; see docs/coming-from-xacro.md",
    "xmlns": "xmlns: begins the attributes that declare prefixes: name/xmlns:gz=https://…",
}
