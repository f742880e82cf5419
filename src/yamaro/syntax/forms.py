"""Elements and parts of fixed shape: where in them which expression is evaluated.

What has no statements inside has the same shape each time it is run; only the values of its
expressions differ. Its form lists these once, for all runs.
"""

from __future__ import annotations

from ..xml.tree import Comment, Element, PartElement, Text
from ..xml.values import format_number, format_value
from .nodes import Body, Content, ElementNode, PartNode, TextContent
from .template import Template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Protocol

    from ..diagnostics import Frame
    from ..source import Span
    from ..xml.tree import Node
    from .nodes import Attribute
    from .python import PythonCode

    class PartBuilder(Protocol):
        """Builds what a part holds."""

        def part_children(self, form: Form, values: tuple[Any, ...]) -> list[Node]:
            """Return the keys and elements of a part."""


LONGEST_NUMBER = 32
"""More characters than a float has in XML, or an integer that is not looked at beforehand."""

FormText = str | int | tuple[str | int, ...]
"""A text as it is written, the number of the hole whose value it is, or pieces to be joined."""

Piece = tuple["Node | None", "Form | None", int, int, FormText, "Any"]
"""A piece of a form's content: a node as it stands; an inner form, with where its holes begin and
end among those of the whole; or a text with its span."""


class Form:
    """The shape of one element or part.

    Attributes:
        name: the element's name, or "part".
        span: the place of its key.
        verbatim: whether it is written in angle brackets.
        body: the body it stands in.
        holes: the expressions in it and in what it holds, in the order in which they are
            evaluated, each with whether it is a piece of a longer text.
        joined: the texts of several pieces in it and in what it holds, each with its span.
        letters: no more than so many characters are in those, but for texts in holes.
        attributes: the name and the text of each attribute.
        value_spans: where the attributes' values are written.
        content: what it holds.
        static: the elements in its content that are always the same.
        text: the text that is all there is in it, with its span; None if there is more, or else.
    """

    __slots__ = (
        "attributes",
        "body",
        "content",
        "holes",
        "joined",
        "letters",
        "name",
        "span",
        "static",
        "text",
        "value_spans",
        "verbatim",
    )

    def __init__(
        self,
        name: str,
        span: Span,
        attributes: list[Attribute],
        content: Content,
        *,
        body: Body,
        verbatim: bool = False,
    ) -> None:
        """Take the shape of what `is_fixed`; see the class."""
        self.name = name
        self.span = span
        self.verbatim = verbatim
        self.body = body
        self.holes: list[tuple[PythonCode, bool]] = []
        self.joined: list[tuple[tuple[str | int, ...], Span]] = []
        self.attributes: list[tuple[str, FormText]] = []
        self.value_spans: dict[str, Span] = {}
        self.content: list[Piece] = []
        for attribute in attributes:
            assert isinstance(attribute.name, str)
            place = self.value_spans[attribute.name] = attribute.span
            self.attributes.append((attribute.name, self._text(attribute.value, place)))
        self._add_content(content)
        self.text: tuple[FormText, Span] | None = None
        if isinstance(content, TextContent) and not attributes:
            self.text = (self.content[0][4], content.span)
        self.letters = sum(
            len(piece) if isinstance(piece, str) else LONGEST_NUMBER
            for pieces, _ in self.joined
            for piece in pieces
        )
        self.static = [piece[0] for piece in self.content if isinstance(piece[0], Element)]

    def _text(self, value: str | Template, span: Span) -> FormText:
        """Return a text with the numbers of its holes, which are added."""
        if isinstance(value, str):
            return value
        pieces: list[str | int] = []
        for part in value.parts:
            if isinstance(part, str):
                pieces.append(part)
            else:
                pieces.append(len(self.holes))
                self.holes.append((part, value.only is None))
        if value.only is not None:
            return pieces[0]
        self.joined.append((tuple(pieces), span))
        return tuple(pieces)

    def _add_content(self, content: Content) -> None:
        if isinstance(content, TextContent):
            text = self._text(content.value, content.span)
            self.content.append((None, None, 0, 0, text, content.span))
        elif isinstance(content, Body):
            for statement in content.statements:
                if isinstance(statement, ElementNode):
                    assert statement.form is not None
                    first = len(self.holes)
                    self.holes += statement.form.holes
                    self.joined += (
                        (tuple(p if isinstance(p, str) else p + first for p in pieces), span)
                        for pieces, span in statement.form.joined
                    )
                    self.content.append((None, statement.form, first, len(self.holes), "", None))
                else:
                    assert isinstance(statement, (Element, Text, Comment))
                    self.content.append((statement, None, 0, 0, "", None))


def form_of(node: ElementNode | PartNode, body: Body) -> Form | None:
    """Return the form of a node that stands in `body`, or None if its shape is not fixed."""
    if isinstance(node, PartNode):
        if not has_fixed_shape(node.body):
            return None
        return Form("part", node.span, [], node.body, body=body)
    name, attributes, content = node.name, node.attributes, node.content
    if not isinstance(name, str) or not has_fixed_shape(content):
        return None
    if not all(isinstance(attribute.name, str) for attribute in attributes):
        return None
    return Form(name, node.span, attributes, content, body=body, verbatim=node.verbatim)


def has_fixed_shape(content: Content) -> bool:
    """Tell whether what an element holds has the same shape each time it is run."""
    if isinstance(content, Body):
        return all(
            isinstance(statement, (Element, Text, Comment))
            or (isinstance(statement, ElementNode) and statement.form is not None)
            for statement in content.statements
        )
    return content is None or isinstance(content, TextContent)


def filled(text: FormText, values: tuple[Any, ...]) -> Any:
    """Return the value of a text: of its one expression, or its pieces joined."""
    kind = type(text)
    if kind is str:
        return text
    if kind is int:
        return values[text]  # type: ignore[index]
    words = []
    for piece in text:  # type: ignore[union-attr]
        if type(piece) is str:
            words.append(piece)
            continue
        value = values[piece]  # type: ignore[index]
        kind = type(value)
        if kind is str:
            words.append(value)
        elif kind is float:
            words.append(format_number(value))
        else:
            words.append("None" if value is None else format_value(value))
    return "".join(words)


_PLAIN = frozenset((str, int, float, bool, type(None)))
"""Types of values that are equal for good once they are equal."""


def key_of(values: tuple[Any, ...]) -> object:
    """Return what tells values apart by all that can be seen of them, or None for what cannot be.

    In Python 1, 1.0 and True are equal, and so are 0.0 and -0.0.
    """
    if len(values) == 1:
        value = values[0]
        kind = type(value)
        if kind is str:
            return value
        if kind not in _PLAIN:
            return None
        return (value, kind) if value else (kind, str(value))
    kinds = tuple(map(type, values))
    if not _PLAIN.issuperset(kinds):
        return None
    if 0.0 in values:
        zeros = [str(value) for value in values if type(value) is float and not value]
        if zeros:
            return values, kinds, tuple(zeros)
    return values, kinds


class FormedPart(PartElement):
    """A part of fixed shape, with the values in it; what it holds is built when it is asked for."""

    __slots__ = ("_builder", "_children", "form", "values")

    def __init__(
        self,
        form: Form,
        values: tuple[Any, ...],
        trace: Frame | None,
        builder: PartBuilder,
    ) -> None:
        """Hold one value for each hole of the form; `builder` makes the children."""
        self.name = form.name
        self.span = form.span
        self.attributes = _NOTHING
        self.trace = trace
        self.value_spans = None
        self.verbatim = False
        self.body = form.body
        self.form = form
        self.values = values
        self._builder = builder
        self._children: list[Node] | None = None

    @property
    def children(self) -> list[Node]:  # type: ignore[override]
        """The keys and elements of the part."""
        if self._children is None:
            self._children = self._builder.part_children(self.form, self.values)
        return self._children

    def with_children(self, children: list[Node]) -> PartElement:
        """Return the same part with other children."""
        part = PartElement(self.name, self.span, {}, children, self.trace)
        part.body = self.body
        return part


_NOTHING: dict[str, object] = {}
