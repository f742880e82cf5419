"""Elements and parts of fixed shape: where in them which expression is evaluated.

What has no statements inside has the same shape each time it is run; only the values of its
expressions differ. Its form lists these once, for all runs. If nothing is evaluated in an element,
it is made here, as it will be written.
"""

from __future__ import annotations

from ..xml.forms import Form
from ..xml.tree import Comment, Element, Text, inheriting
from ..xml.values import is_comment_text
from .nodes import (
    Body,
    CommentNode,
    Content,
    ElementNode,
    PartNode,
    Statement,
    TextContent,
    TextNode,
)
from .python import Template

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..source import Span
    from ..xml.forms import FormText
    from ..xml.tree import Node
    from .nodes import Attribute
    from .python import PythonCode

LONGEST_NUMBER = 32
"""More characters than a float has in XML, or an integer that is not looked at beforehand."""


class EvaluatedForm(Form):
    """The form of a statement, with the expressions whose values go into its holes.

    Attributes:
        holes: the expressions in it and in what it holds, in the order in which they are
            evaluated, each with whether it is a piece of a longer text.
        joined: the texts of several pieces in it and in what it holds, each with its span.
        letters: at most this number of characters are in those, except for texts in holes.
    """

    __slots__ = ("holes", "joined", "letters")

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
        super().__init__(name, span, body=body, verbatim=verbatim)
        self.holes: list[tuple[PythonCode, bool]] = []
        self.joined: list[tuple[tuple[str | int, ...], Span]] = []
        for attribute in attributes:
            assert isinstance(attribute.name, str)
            place = self.value_spans[attribute.name] = attribute.span
            self.attributes.append((attribute.name, self._text(attribute.value, place)))
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
        if isinstance(content, TextContent) and not attributes:
            self.text = (self.content[0][4], content.span)
        self.letters = sum(
            len(piece) if isinstance(piece, str) else LONGEST_NUMBER
            for pieces, _ in self.joined
            for piece in pieces
        )

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


def form_of(node: ElementNode | PartNode, body: Body) -> EvaluatedForm | None:
    """Return the form of a node that is in `body`, or None if its shape is not fixed."""
    if isinstance(node, PartNode):
        if not has_fixed_shape(node.body):
            return None
        return EvaluatedForm("part", node.span, [], node.body, body=body)
    name, attributes, content = node.name, node.attributes, node.content
    if not isinstance(name, str) or not has_fixed_shape(content):
        return None
    if not all(isinstance(attribute.name, str) for attribute in attributes):
        return None
    return EvaluatedForm(name, node.span, attributes, content, body=body, verbatim=node.verbatim)


def has_fixed_shape(content: Content) -> bool:
    """Return whether what an element holds has the same shape each time it is run."""
    if isinstance(content, Body):
        return all(
            isinstance(statement, (Element, Text, Comment))
            or (isinstance(statement, ElementNode) and statement.form is not None)
            for statement in content.statements
        )
    return content is None or isinstance(content, TextContent)


def as_put_out(statement: Statement, body: Body) -> Statement:
    """Return an element, text or comment in which nothing is evaluated as it will be written.

    What is evaluated, or may fail when it is run, is returned as it is.
    """
    if isinstance(statement, ElementNode):
        return element_put_out(statement, body)
    if isinstance(statement, PartNode):
        statement.form = form_of(statement, body)
    if isinstance(statement, TextNode) and isinstance(statement.value, str):
        return Text(statement.value, statement.span)
    if isinstance(statement, CommentNode) and isinstance(statement.value, str):
        if is_comment_text(statement.value):
            return Comment(statement.value, statement.span)
    return statement


def element_put_out(node: ElementNode, body: Body) -> Element | ElementNode:
    """Return an element as it will be written, or as it is if something in it is evaluated."""
    form = form_of(node, body)
    children = static_children(node.content)
    if form is None or form.holes or children is None:
        node.form = form
        return node
    return inheriting(
        str(node.name),
        node.span,
        attributes={str(attribute.name): attribute.value for attribute in node.attributes},
        children=children,
        value_spans={str(attribute.name): attribute.span for attribute in node.attributes},
        verbatim=node.verbatim,
        body=body,
    )


def static_children(content: Content) -> list[Node] | None:
    """Return what an element's content puts out, or None if it has to be run."""
    if content is None:
        return []
    if isinstance(content, Body) and content.is_static:
        return content.statements  # type: ignore[return-value]  # `is_static` says what they are
    if isinstance(content, TextContent) and isinstance(content.value, str):
        return [Text(content.value, content.span)]
    return None


NO_CHILDREN: list[Node] = []
"""What an element holds that is empty; nobody changes an element that the parser has made."""
