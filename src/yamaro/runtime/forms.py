"""Elements of fixed shape: filled in with values, and built once for values that come again.

An element node without statements inside has the same shape each time it is run; only the values
of its expressions differ. A `Form` builds the output element from the values. It keeps what it has
built, inner elements included, and gives out the very same element when the same values come
again, so that a loop that makes a thousand equal links makes one.
"""

from __future__ import annotations

from ..diagnostics import INHERITED, Frame
from ..source import Span
from ..syntax.nodes import Body, Content, ElementNode, TextContent
from ..xmltree import Comment, Element, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..xmltree import Node, Shared

MAX_KNOWN = 64
"""How many elements a form keeps, and after how many new ones in a row it gives up keeping."""

_PLAIN = frozenset((str, int, float, bool, type(None)))
"""Types of values that are equal for good once they are equal."""


class Forms:
    """The forms of one conversion, and the elements that stand in several places of its tree."""

    __slots__ = ("_emitted", "_in_parts", "_kept", "_outside", "shared")

    def __init__(self) -> None:
        """Start with no form and nothing shared."""
        self.shared: Shared = {}
        self._kept: list[Element] = []  # what `shared` names by identity has to live
        self._emitted: set[int] = set()
        self._in_parts: dict[ElementNode, Form] = {}
        self._outside: dict[ElementNode, Form] = {}

    def of(self, node: ElementNode, body: Body | None, *, in_part: bool) -> Form:
        """Return the form of a node that has `holes`."""
        forms = self._in_parts if in_part else self._outside
        form = forms.get(node)
        if form is None:
            form = forms[node] = Form(node, body, self, in_part=in_part)
        return form

    def share(self, element: Element) -> None:
        """Note that an element stands in several places."""
        if id(element) not in self.shared:
            self.shared[id(element)] = {}
            self._kept.append(element)

    def emit(self, element: Element) -> None:
        """Note that an element that the parser made is output, perhaps not for the first time."""
        if id(element) in self._emitted:
            self.share(element)
        else:
            self._emitted.add(id(element))


class Form:
    """One element node of fixed shape."""

    __slots__ = (
        "_attributes",
        "_body",
        "_built",
        "_content",
        "_forms",
        "_keeps_none",
        "_known",
        "_misses",
        "_name",
        "_node",
        "_value_spans",
        "holes",
    )

    def __init__(
        self, node: ElementNode, body: Body | None, forms: Forms, *, in_part: bool
    ) -> None:
        """Work out the shape of a node that has `holes`; `body` is the one that it stands in."""
        assert node.holes is not None
        assert isinstance(node.name, str)
        self.holes = node.holes
        self._node = node
        self._name = node.name
        self._body = body
        self._forms = forms
        self._keeps_none = in_part  # in a part, None leaves the key out
        self._known: dict[object, Element] | None = {}
        self._misses = 0
        self._built = 0
        self._attributes: list[tuple[str, str, int]] = []  # name, and value or its hole
        self._content: list[_Piece] = []
        self._value_spans: dict[str, Span] = {}
        hole = 0
        for attribute in node.attributes:
            name, value = attribute.name, attribute.value
            assert isinstance(name, str)
            self._value_spans[name] = attribute.span
            if isinstance(value, str):
                self._attributes.append((name, value, -1))
            else:
                self._attributes.append((name, "", hole))
                hole += 1
        self._add_content(node.content, hole, in_part=in_part)

    def _add_content(self, content: Content, hole: int, *, in_part: bool) -> None:
        if isinstance(content, TextContent):
            if isinstance(content.value, str):
                self._content.append(_Piece(node=Text(content.value, content.span)))
            else:
                self._content.append(_Piece(first=hole, span=content.span))
        elif isinstance(content, Body):
            for statement in content.statements:
                if isinstance(statement, ElementNode):
                    form = self._forms.of(statement, content, in_part=in_part)
                    end = hole + len(form.holes)
                    self._content.append(_Piece(form=form, first=hole, end=end))
                    hole = end
                else:
                    assert isinstance(statement, (Element, Text, Comment)), "the shape is fixed"
                    self._content.append(_Piece(node=statement))

    def element(self, values: tuple[Any, ...]) -> Element:
        """Return an element with these values, one value for each of `holes`.

        It may stand in other places as well, and inherits its trace.
        """
        known = self._known
        if known is None:
            return self.make(values, INHERITED)
        key = _key(values)
        if key is None:
            return self.make(values, INHERITED)
        found = known.get(key)
        if found is not None:
            self._misses = 0
            self._forms.share(found)
            return found
        self._misses += 1
        if self._misses > MAX_KNOWN:
            self._known = None
        elif len(known) >= MAX_KNOWN:
            known.clear()
        found = known[key] = self.make(values, INHERITED)
        return found

    def make(self, values: tuple[Any, ...], trace: Frame | None) -> Element:
        """Return an element of its own with these values; what stands in it may be shared."""
        attributes: dict[str, object] = {}
        for name, text, hole in self._attributes:
            value = text if hole < 0 else values[hole]
            if value is not None:
                attributes[name] = value
        children: list[Node] = []
        for piece in self._content:
            if piece.node is not None:
                children.append(piece.node)
            elif piece.form is not None:
                children.append(piece.form.element(values[piece.first : piece.end]))
            else:
                value = values[piece.first]
                if value is not None or self._keeps_none:
                    children.append(Text(value, piece.span))
        if self._built < 2:
            self._share_static()
        return Element(
            self._name,
            self._node.span,
            attributes=attributes,
            children=children,
            trace=trace,
            value_spans=self._value_spans,
            verbatim=self._node.verbatim,
            body=self._body,
        )

    def _share_static(self) -> None:
        """Note, when a second element is built, that what the parser made is in both."""
        self._built += 1
        if self._built == 2:
            for piece in self._content:
                if isinstance(piece.node, Element):
                    self._forms.share(piece.node)


class _Piece:
    """A piece of a form's content: a node as it stands, an inner form, or the text of one hole."""

    __slots__ = ("end", "first", "form", "node", "span")

    def __init__(
        self,
        *,
        node: Node | None = None,
        form: Form | None = None,
        first: int = 0,
        end: int = 0,
        span: Span | None = None,
    ) -> None:
        """Hold one of the three; an inner form's values are those from `first` to before `end`."""
        self.node = node
        self.form = form
        self.first = first
        self.end = end
        self.span: Any = span


def _key(values: tuple[Any, ...]) -> object:
    """Return what tells values apart by all that can be seen of them, or None for what cannot be.

    In Python 1, 1.0 and True are equal, and so are 0.0 and -0.0.
    """
    kinds = tuple(map(type, values))
    if not _PLAIN.issuperset(kinds):
        return None
    if 0.0 in values:
        return values, kinds, tuple(map(str, values))
    return values, kinds
