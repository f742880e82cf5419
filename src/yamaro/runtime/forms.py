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
from ..syntax.python import PythonCode
from ..syntax.template import Template
from ..xmltree import Comment, Element, Text, format_value
from .scope import MISSING, Scope
from .values import ALWAYS_WRITABLE, Values, is_writable

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..xmltree import Node, Shared

MAX_KNOWN = 64
"""How many elements a form keeps, and after how many new ones in a row it gives up keeping."""

_PLAIN = frozenset((str, int, float, bool, type(None)))
"""Types of values that are equal for good once they are equal."""

_Text = str | int | tuple[str | int, ...]
"""A text as it is written, the number of the hole whose value it is, or pieces to be joined."""

_Piece = tuple["Node | None", "Form | None", int, int, "_Text", "Any"]
"""A piece of a form's content: a node as it stands; an inner form, with where its values stand in
those of the whole; or a text with its span."""


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

    def of(self, node: ElementNode, body: Body | None, in_part: bool) -> Form:
        """Return the form of a node that has `holes`."""
        forms = self._in_parts if in_part else self._outside
        form = forms.get(node)
        if form is None:
            form = forms[node] = Form(node, body, self, in_part)
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
    """One element node of fixed shape.

    Attributes:
        holes: the expressions in it, in order, each with whether it is a piece of a longer text.
    """

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

    def __init__(self, node: ElementNode, body: Body | None, forms: Forms, in_part: bool) -> None:
        """Work out the shape of a node that has `holes`; `body` is the one that it stands in."""
        assert isinstance(node.name, str)
        self.holes: list[tuple[PythonCode, bool]] = []
        self._node = node
        self._name = node.name
        self._body = body
        self._forms = forms
        self._keeps_none = in_part  # in a part, None leaves the key out
        self._known: dict[object, Element] | None = {}
        self._misses = 0
        self._built = 0
        self._attributes: list[tuple[str, _Text]] = []
        self._content: list[_Piece] = []
        self._value_spans: dict[str, Span] = {}
        for attribute in node.attributes:
            assert isinstance(attribute.name, str)
            self._value_spans[attribute.name] = attribute.span
            self._attributes.append((attribute.name, self._text(attribute.value)))
        self._add_content(node.content, in_part)

    def _text(self, value: str | Template) -> _Text:
        """Take in the expressions of a text."""
        if isinstance(value, str):
            return value
        pieces: list[str | int] = []
        for part in value.parts:
            if isinstance(part, str):
                pieces.append(part)
            else:
                pieces.append(len(self.holes))
                self.holes.append((part, value.only is None))
        return pieces[0] if value.only is not None else tuple(pieces)

    def _add_content(self, content: Content, in_part: bool) -> None:
        if isinstance(content, TextContent):
            if isinstance(content.value, str):
                self._content.append((Text(content.value, content.span), None, 0, 0, "", None))
            else:
                text = self._text(content.value)
                self._content.append((None, None, 0, 0, text, content.span))
        elif isinstance(content, Body):
            for statement in content.statements:
                if isinstance(statement, ElementNode):
                    form = self._forms.of(statement, content, in_part)
                    first = len(self.holes)
                    self.holes += form.holes
                    self._content.append((None, form, first, len(self.holes), "", None))
                else:
                    assert isinstance(statement, (Element, Text, Comment)), "the shape is fixed"
                    self._content.append((statement, None, 0, 0, "", None))

    def evaluate(self, scope: Scope, values: Values) -> tuple[Any, ...]:
        """Return the value of each hole, sure that it can be written.

        Raises:
            YamaroError: an expression failed, or what it gives cannot be made a text.
        """
        evaluator = values.evaluator
        evaluate, get = evaluator.evaluate, scope.get
        results = []
        for python, is_piece in self.holes:
            name = python.name
            value = MISSING if name is None else get(name, MISSING)
            if value is MISSING:
                value = evaluate(python, scope)
            if type(value) not in ALWAYS_WRITABLE and not is_writable(value):
                text = evaluator.guard(format_value, value, python.span())
                if is_piece:
                    value = text
            results.append(value)
        return tuple(results)

    def element(self, values: tuple[Any, ...]) -> Element:
        """Return an element with these values, one value for each of `holes`.

        It may stand in other places as well, and inherits its trace.
        """
        known = self._known
        key = None if known is None else _key(values)
        if known is None or key is None:
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
        for name, text in self._attributes:
            value = text if type(text) is str else _filled(text, values)
            if value is not None:
                attributes[name] = value
        children: list[Node] = []
        for node, form, first, end, text, span in self._content:
            if node is not None:
                children.append(node)
            elif form is not None:
                children.append(form.element(values[first:end]))
            else:
                value = _filled(text, values)
                if value is not None or self._keeps_none:
                    children.append(Text(value, span))
        if self._built < 2:
            self._share_static()
        own = self._node
        return Element(
            self._name,
            own.span,
            attributes,
            children,
            trace,
            self._value_spans,
            own.verbatim,
            self._body,
        )

    def _share_static(self) -> None:
        """Note, when a second element is built, that what the parser made is in both."""
        self._built += 1
        if self._built == 2:
            for node, *_ in self._content:
                if isinstance(node, Element):
                    self._forms.share(node)


def _filled(text: _Text, values: tuple[Any, ...]) -> Any:
    """Return the value of a text: of its one expression, or its pieces joined."""
    if type(text) is int:
        return values[text]
    assert type(text) is tuple
    words = []
    for piece in text:
        value = piece if type(piece) is str else values[piece]  # type: ignore[index]
        if type(value) is str:
            words.append(value)
        else:
            words.append("None" if value is None else format_value(value))
    return "".join(words)


def _key(values: tuple[Any, ...]) -> object:
    """Return what tells values apart by all that can be seen of them, or None for what cannot be.

    In Python 1, 1.0 and True are equal, and so are 0.0 and -0.0.
    """
    if len(values) == 1:
        value = values[0]
        kind = type(value)
        if kind is str:
            return value
        return (value, kind, str(value)) if kind in _PLAIN else None
    kinds = tuple(map(type, values))
    if not _PLAIN.issuperset(kinds):
        return None
    if 0.0 in values:
        return values, kinds, tuple(map(str, values))
    return values, kinds
