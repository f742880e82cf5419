"""Elements of fixed shape: where in them which expression is evaluated.

An element node without statements inside has the same shape each time it is run; only the values
of its expressions differ. Its form lists these once, for all runs.
"""

from __future__ import annotations

from ..xmltree import Comment, Element, Text
from .nodes import Body, Content, ElementNode, TextContent
from .template import Template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..source import Span
    from ..xmltree import Node
    from .python import PythonCode

FormText = str | int | tuple[str | int, ...]
"""A text as it is written, the number of the hole whose value it is, or pieces to be joined."""

Piece = tuple["Node | None", "Form | None", int, int, FormText, "Any"]
"""A piece of a form's content: a node as it stands; an inner form, with where its holes begin and
end among those of the whole; or a text with its span."""


class Form:
    """The shape of one element node.

    Attributes:
        name: the element's name.
        span: the place of its key.
        verbatim: whether it is written in angle brackets.
        body: the body it stands in.
        holes: the expressions in it and in what it holds, in the order in which they are
            evaluated, each with whether it is a piece of a longer text.
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
        "name",
        "span",
        "static",
        "text",
        "value_spans",
        "verbatim",
    )

    def __init__(self, node: ElementNode, body: Body) -> None:
        """Take the shape of a node that stands in `body`, and which `is_fixed`."""
        assert isinstance(node.name, str)
        self.name = node.name
        self.span = node.span
        self.verbatim = node.verbatim
        self.body = body
        self.holes: list[tuple[PythonCode, bool]] = []
        self.attributes: list[tuple[str, FormText]] = []
        self.value_spans: dict[str, Span] = {}
        self.content: list[Piece] = []
        for attribute in node.attributes:
            assert isinstance(attribute.name, str)
            self.attributes.append((attribute.name, self._text(attribute.value)))
            self.value_spans[attribute.name] = attribute.span
        self._add_content(node.content)
        self.text: tuple[FormText, Span] | None = None
        if isinstance(node.content, TextContent) and not self.attributes:
            self.text = (self.content[0][4], node.content.span)
        self.static = [piece[0] for piece in self.content if isinstance(piece[0], Element)]

    def _text(self, value: str | Template) -> FormText:
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
        return pieces[0] if value.only is not None else tuple(pieces)

    def _add_content(self, content: Content) -> None:
        if isinstance(content, TextContent):
            self.content.append((None, None, 0, 0, self._text(content.value), content.span))
        elif isinstance(content, Body):
            for statement in content.statements:
                if isinstance(statement, ElementNode):
                    assert statement.form is not None
                    first = len(self.holes)
                    self.holes += statement.form.holes
                    self.content.append((None, statement.form, first, len(self.holes), "", None))
                else:
                    assert isinstance(statement, (Element, Text, Comment))
                    self.content.append((statement, None, 0, 0, "", None))


def is_fixed(node: ElementNode) -> bool:
    """Tell whether an element has the same shape each time it is run."""
    if not isinstance(node.name, str):
        return False
    if not all(isinstance(attribute.name, str) for attribute in node.attributes):
        return False
    content = node.content
    if isinstance(content, Body):
        return all(
            isinstance(statement, (Element, Text, Comment))
            or (isinstance(statement, ElementNode) and statement.form is not None)
            for statement in content.statements
        )
    return content is None or isinstance(content, TextContent)
